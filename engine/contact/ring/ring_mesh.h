// Graded triangle meshes of a circular section, and the order of their boundary.
//
// Internal to the ring. Six-node triangles (vertices 0-2, mid-sides 3 = 0-1, 4 = 1-2, 5 = 2-0) with
// curved boundary sides. Lengths are in any one unit [L]; the ring uses the section diameter.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/ring/ring_profile.h"

enum { SB_RING_ZONES_MAX = 24, SB_RING_VERTICES_MAX = 8 };

// A stretch of boundary with a wanted element side. The angle is measured at the section's centre
// from the bore (0) over the right flank (pi/2) to the floor (pi); the left half has negative
// angles. Of another profile than the circle it is the arc on each half over that half's, times pi.
typedef struct {
  double from, to; // from <= to [rad]
  double size;     // side length of the elements there [L]
} SbRingZone;

typedef struct {
  int nodes;      // vertices and mid-sides
  int elements;   // triangles
  int loop_count; // boundary nodes: vertex, mid-side, vertex, ...
  double *x;      // [2 * nodes] reference position (r, z) [L]
  int *tri;       // [6 * elements] nodes
  int *loop;      // [loop_count] in the order of the angle, even places are vertices
  double *angle;  // [loop_count] rising [rad]
  double arc[2];  // of the surface per angle, on the left and the right half [L/rad]
} SbRingMesh;

// What to mesh: an outline whose middle lies at r = `centre`, or a disc of `radius`. The size grows
// from each zone by `growth` per unit of arc, up to `size_max`. Surface vertices are put exactly at
// the `vertex` angles (contact edges).
typedef struct {
  double centre, radius;        // [L]
  const SbRingOutline *outline; // borrowed; NULL: the disc
  double size_max;              // [L]
  double growth;                // [-]
  int layers;                   // rows of elements from surface to centre; the disc's
  int zone_count;
  SbRingZone zone[SB_RING_ZONES_MAX];
  int vertex_count;
  double vertex[SB_RING_VERTICES_MAX]; // [rad]
} SbRingMeshPlan;

// Builds the mesh; owned, free with sb_ring_mesh_destroy. SB_ERROR_MEMORY if it does not fit.
SbStatus sb_ring_mesh_create(SbRingMesh **out, const SbRingMeshPlan *plan, SbReport *report);

// For create: the mesh of an outline (ring_triangles.c).
SbStatus sb_ring_triangles_create(SbRingMesh **out, const SbRingMeshPlan *plan, SbReport *report);

// Length of the free surface between two angles, from <= to.
double sb_ring_mesh_arc(const SbRingMesh *mesh, double from, double to);

// The mesh with the axial direction turned round: the nodes keep their numbers, boundary node i
// becomes -i, vertices 1 and 2 of each triangle change places. Owned.
SbStatus sb_ring_mesh_mirror(SbRingMesh **out, const SbRingMesh *mesh, SbReport *report);

// The mesh moved by `shift` along r. Owned.
SbStatus sb_ring_mesh_copy(SbRingMesh **out, const SbRingMesh *mesh, double shift,
                           SbReport *report);

// Parts of building one, for meshes of other bodies (tests of the elements against closed forms):
// an empty mesh with room for so many vertices, triangles and boundary nodes; a triangle of three
// vertices, counter-clockwise in (r, z), with its place; the mid-side nodes of all, straight ones.
SbRingMesh *sb_ring_mesh_allocate(int vertices, int triangles, int loop);
int sb_ring_mesh_add(SbRingMesh *mesh, int a, int b, int c);
SbStatus sb_ring_mesh_add_midsides(SbRingMesh *mesh, SbReport *report);

void sb_ring_mesh_destroy(SbRingMesh *mesh);

// Shape functions of the six-node triangle at area coordinates (l1, l2) of vertices 1 and 2.
void sb_ring_shape(double l1, double l2, double n[6], double dn1[6], double dn2[6]);

// A boundary side: its three nodes' shape functions at xi in -1 .. 1, and their slopes.
static inline void sb_ring_side_shape(double xi, double n[3], double d[3]) {
  n[0] = 0.5 * xi * (xi - 1.0);
  n[1] = 1.0 - xi * xi;
  n[2] = 0.5 * xi * (xi + 1.0);
  d[0] = xi - 0.5;
  d[1] = -2.0 * xi;
  d[2] = xi + 0.5;
}

// The sum of three nodes' values by their shapes or slopes.
static inline double sb_ring_side_sum(const double n[3], const double v[3]) {
  return n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
}

// Where on a side the nodal values v, which rise along it, give `wanted`: xi with its shapes and
// slopes.
void sb_ring_side_at(const double v[3], double wanted, double n[3], double d[3]);

// Gauss points of a side, exact to degree 5 and 7.
static const double SB_RING_X3[3] = {-0.774596669241483377, 0.0, 0.774596669241483377};
static const double SB_RING_W3[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
static const double SB_RING_X4[4] = {-0.861136311594052575, -0.339981043584856265,
                                     0.339981043584856265, 0.861136311594052575};
static const double SB_RING_W4[4] = {0.347854845137453857, 0.652145154862546143,
                                     0.652145154862546143, 0.347854845137453857};

// Finds the triangle (by its straight sides) that holds the reference point, or the nearest one,
// beginning at triangle `near`; returns its index and the area coordinates.
int sb_ring_mesh_locate(const SbRingMesh *mesh, const double x[2], int near, double *l1,
                        double *l2);
