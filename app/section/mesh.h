// The display list as triangles in device pixels, with soft edges: what the GL renderer uploads.
//
// Fills are triangulated by ear clipping; a feathered one is shrunk by half a pixel and gets a
// strip one pixel wide whose coverage falls to zero. Lines become mitred strips that carry the
// distance across and along, from which the fragment shader computes coverage.
#pragma once

#include "app/section/draw_list.h"

#include <stdint.h>

typedef struct {
  float x, y;
  uint8_t color[4]; // premultiplied
  float extra[4];   // see shaders/*.frag
} SbMeshVertex;

typedef struct {
  size_t count, capacity;
  SbMeshVertex *vertex;
  // Work space.
  size_t work_capacity;
  SbPoint *work;
  int *link;
} SbMesh;

void sb_mesh_init(SbMesh *mesh);
void sb_mesh_finish(SbMesh *mesh);

// Appends triangles; `scale` is device pixels per logical pixel.
void sb_mesh_fill(SbMesh *mesh, const SbDrawItem *item, const SbPoint *points, double scale);
void sb_mesh_stroke(SbMesh *mesh, const SbDrawItem *item, const SbPoint *points, double scale);
void sb_mesh_field(SbMesh *mesh, const SbDrawItem *item, const SbPoint *points,
                   const float *scalars, double scale);

// A rectangle of an atlas, device pixels.
void sb_mesh_glyphs(SbMesh *mesh, double x, double y, double width, double height, double u,
                    double v, SbColor color);
