// Graded triangle meshes of a circular section, and the order of their boundary.
//
// Internal to the ring. Six-node triangles (vertices 0-2, mid-sides 3 = 0-1, 4 = 1-2, 5 = 2-0) with
// curved boundary sides. Lengths are in any one unit; the ring uses the section diameter.
#pragma once

#include "engine/base/status.h"

enum { SB_RING_ZONES_MAX = 24, SB_RING_VERTICES_MAX = 8 };

// A stretch of boundary with a wanted element side. The angle is measured at the section's centre
// from the bore (0) over the right flank (pi/2) to the floor (pi); the left half has negative
// angles.
typedef struct {
  double from, to; // from <= to, rad
  double size;     // side length of the elements there
} SbRingZone;

typedef struct {
  int nodes;      // vertices and mid-sides
  int elements;   // triangles
  int loop_count; // boundary nodes: vertex, mid-side, vertex, ...
  double *x;      // [2 * nodes] reference position (r, z)
  int *tri;       // [6 * elements]
  int *loop;      // [loop_count] in the order of the angle, even places are vertices
  double *angle;  // [loop_count] rad, rising
} SbRingMesh;

// What to mesh: a disc of `radius` whose centre lies at r = `centre`. The size grows from each zone
// by `growth` per unit of arc, up to `size_max`. Surface vertices are put exactly at the `vertex`
// angles (contact edges).
typedef struct {
  double centre, radius;
  double size_max, growth;
  int layers; // rows of elements from surface to centre
  int zone_count;
  SbRingZone zone[SB_RING_ZONES_MAX];
  int vertex_count;
  double vertex[SB_RING_VERTICES_MAX];
} SbRingMeshPlan;

// Builds the mesh; owned, free with sb_ring_mesh_destroy. SB_ERROR_MEMORY if it does not fit.
SbStatus sb_ring_mesh_create(SbRingMesh **out, const SbRingMeshPlan *plan, SbReport *report);

// A structured mesh of the rectangle r0..r1 x z0..z1 with nr x nz cells of two triangles each, for
// closed-form checks; its loop is left empty.
SbStatus sb_ring_mesh_create_rectangle(SbRingMesh **out, double r0, double r1, double z0, double z1,
                                       int nr, int nz, SbReport *report);

void sb_ring_mesh_destroy(SbRingMesh *mesh);

// Shape functions of the six-node triangle at area coordinates (l1, l2) of vertices 1 and 2.
void sb_ring_shape(double l1, double l2, double n[6], double dn1[6], double dn2[6]);

// Finds the triangle (by its straight sides) that holds the reference point, or the nearest one;
// returns its index and the area coordinates. `start` is a first guess.
int sb_ring_mesh_locate(const SbRingMesh *mesh, const double x[2], double *l1, double *l2);
