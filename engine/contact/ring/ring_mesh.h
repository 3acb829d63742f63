// Graded meshes of six-node triangles for a ring's section. Private to engine/contact/ring.
//
// Vertices 0-2, mid-sides 3 = 0-1, 4 = 1-2, 5 = 2-0, boundary sides curved. Lengths in any unit
// [L]; the ring uses section diameters.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/ring/ring_profile.h"

// Capacities of SbRingMeshPlan.
enum { SB_RING_ZONES_MAX = 24, SB_RING_VERTICES_MAX = 8 };

// A stretch of boundary with a desired element size. The material angle is measured at the
// section's centre from the bore (0) over the right flank (pi/2) to the floor (pi); the left half
// has negative angles. For a section that is not a circle it is pi times the arc length on each
// half divided by that of the half.
typedef struct {
  double from, to; // material angles, from <= to [rad]
  double size;     // side length of the elements [L]
} SbRingZone;

// A mesh.
typedef struct {
  int nodes;      // vertices and mid-sides
  int elements;   // triangles
  int loop_count; // boundary nodes: vertex, mid-side, vertex, ...
  double *x;      // [nodes][2] reference position (r, z) [L]
  int *tri;       // [elements][6] node numbers
  int *loop;      // [loop_count] boundary nodes by increasing angle, vertices at even places
  double *angle;  // [loop_count] material angle, increasing [rad]
  double arc[2];  // length of surface per angle on the left and right half [L/rad]
} SbRingMesh;

// Description of a mesh: an outline whose middle is at r = `centre`, or a disc of `radius`. The
// element size increases from each zone by `growth` per unit of arc, up to `size_max`. The boundary
// has vertices exactly at the `vertex` angles (contact edges).
typedef struct {
  double centre, radius;        // [L]
  const SbRingOutline *outline; // borrowed; NULL: a disc
  double size_max;              // [L]
  double growth;                // [1]
  int layers;                   // disc: rows of elements from surface to centre
  int zone_count;
  SbRingZone zone[SB_RING_ZONES_MAX];
  int vertex_count;
  double vertex[SB_RING_VERTICES_MAX]; // [rad]
} SbRingMeshPlan;

// Creates a mesh by `plan`. SB_ERROR_MEMORY: also if it needs too many nodes.
SbStatus sb_ring_mesh_create(SbRingMesh **out, const SbRingMeshPlan *plan, SbReport *report);

// Creates the mesh of an outline (ring_triangles.c). Called by sb_ring_mesh_create().
SbStatus sb_ring_triangles_create(SbRingMesh **out, const SbRingMeshPlan *plan, SbReport *report);

// Returns the length of the free surface between two angles, from <= to [L].
double sb_ring_mesh_arc(const SbRingMesh *mesh, double from, double to);

// Creates the mesh reflected in z. Nodes keep their numbers, boundary node i becomes -i, and
// vertices 1 and 2 of each triangle are exchanged.
SbStatus sb_ring_mesh_mirror(SbRingMesh **out, const SbRingMesh *mesh, SbReport *report);

// Creates a copy whose nodes are moved by `shift` [L] in r.
SbStatus sb_ring_mesh_copy(SbRingMesh **out, const SbRingMesh *mesh, double shift,
                           SbReport *report);

// Returns an empty mesh with space for `vertices` vertices with their mid-sides, `triangles`
// triangles and `loop` boundary nodes (vertices and mid-sides), or NULL: no memory. The caller sets
// x of the vertices and `nodes` to their number, adds the triangles, then the mid-sides, then sets
// loop, angle, loop_count and arc. Free it with sb_ring_mesh_destroy().
SbRingMesh *sb_ring_mesh_allocate(int vertices, int triangles, int loop);

// Adds a triangle of the vertices a, b, c, counter-clockwise in (r, z); returns its number.
int sb_ring_mesh_add(SbRingMesh *mesh, int a, int b, int c);

// Adds straight mid-side nodes to all triangles, numbered after the vertices; `nodes` increases.
// Call it once, after all sb_ring_mesh_add().
SbStatus sb_ring_mesh_add_midsides(SbRingMesh *mesh, SbReport *report);

// Frees the mesh and its arrays. Takes NULL.
void sb_ring_mesh_destroy(SbRingMesh *mesh);

// Computes the shape functions n and their derivatives at the area coordinates (l1, l2) of vertices
// 1 and 2.
void sb_ring_shape(double l1, double l2, double n[6], double dn1[6], double dn2[6]);

// Computes the shape functions n of a boundary side's three nodes at xi in [-1, 1], and their
// derivatives d.
static inline void sb_ring_side_shape(double xi, double n[3], double d[3]) {
  n[0] = 0.5 * xi * (xi - 1.0);
  n[1] = 1.0 - xi * xi;
  n[2] = 0.5 * xi * (xi + 1.0);
  d[0] = xi - 0.5;
  d[1] = -2.0 * xi;
  d[2] = xi + 0.5;
}

// Returns the sum of three nodal values weighted by shape functions or derivatives.
static inline double sb_ring_side_sum(const double n[3], const double v[3]) {
  return n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
}

// Finds xi at which the nodal values v, increasing along the side, give `wanted`; writes shape
// functions and derivatives there.
void sb_ring_side_at(const double v[3], double wanted, double n[3], double d[3]);

// Gauss points and weights of a side, exact to degree 5 and 7.
static const double SB_RING_X3[3] = {-0.774596669241483377, 0.0, 0.774596669241483377};
static const double SB_RING_W3[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
static const double SB_RING_X4[4] = {-0.861136311594052575, -0.339981043584856265,
                                     0.339981043584856265, 0.861136311594052575};
static const double SB_RING_W4[4] = {0.347854845137453857, 0.652145154862546143,
                                     0.652145154862546143, 0.347854845137453857};

// Finds the triangle (with straight sides) that contains the reference point x, or the nearest one,
// starting at triangle `near`. Returns its number, and its area coordinates in *l1, *l2.
int sb_ring_mesh_locate(const SbRingMesh *mesh, const double x[2], int near, double *l1,
                        double *l2);
