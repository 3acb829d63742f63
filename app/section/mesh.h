// Items of a display list as triangles in device pixels with smooth edges, for the GL renderer.
//
// Fills are triangulated by ear clipping. A fill with `feather` is shrunk by half a pixel and gets
// a strip one pixel wide in which the coverage falls to zero. Lines become mitred strips whose
// vertices carry the distance across and along the line, from which the fragment shader computes
// the coverage.
#pragma once

#include "app/section/draw_list.h"

#include <stdint.h>

// A vertex; three form a triangle.
typedef struct {
  float x, y;       // [device px]
  uint8_t color[4]; // premultiplied red, green, blue, alpha
  float extra[4];   // values for the fragment shader (shaders/*.frag)
} SbMeshVertex;

// A growing list of triangles. The caller empties it by setting `count` to 0.
typedef struct {
  size_t count, capacity; // vertices
  SbMeshVertex *vertex;
  // Work space.
  size_t work_capacity;
  SbPoint *work;
  int *link;
} SbMesh;

// Initialises an empty list.
void sb_mesh_init(SbMesh *mesh);

// Frees the arrays.
void sb_mesh_finish(SbMesh *mesh);

// In the functions below `points` are the points of `item`, points[item->count] in logical pixels,
// and `scale` is device pixels per logical pixel.

// Appends the triangles of a fill (SB_DRAW_FILL).
void sb_mesh_fill(SbMesh *mesh, const SbDrawItem *item, const SbPoint *points, double scale);

// Appends the triangles of a line (SB_DRAW_STROKE).
void sb_mesh_stroke(SbMesh *mesh, const SbDrawItem *item, const SbPoint *points, double scale);

// Appends the triangles of a mesh (SB_DRAW_MESH) with scalars[item->count].
void sb_mesh_field(SbMesh *mesh, const SbDrawItem *item, const SbPoint *points,
                   const float *scalars, double scale);

// Appends a rectangle of the text atlas, `width` x `height` texels, which are device pixels: its
// top left corner is drawn at (x, y) [device px], and (u, v) is its upper left texel.
void sb_mesh_glyphs(SbMesh *mesh, double x, double y, double width, double height, double u,
                    double v, SbColor color);
