// Graded meshes of six-node triangles for a ring's section. Private to engine/contact/ring.
//
// Nodes of a triangle: vertices 0-2 counter-clockwise in (r, z), mid-sides 3 = 0-1, 4 = 1-2,
// 5 = 2-0; boundary sides are curved. Lengths in any unit [L], the same everywhere; the ring uses
// section diameters. z is axial from the section's middle, r the distance from the valve's axis.
//
// The material angle is measured at the section's centre from the bore, the largest r (0), over the
// right flank, z > 0 (pi/2), to the floor, the smallest r (pi); the left half has the angles -pi
// to 0. For a section that is not a circle it is pi times the arc length from the bore divided by
// the arc length of the half.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/ring/ring_profile.h"

// Capacities of SbRingMeshPlan.
enum { SB_RING_ZONES_MAX = 24, SB_RING_VERTICES_MAX = 8 };

// A stretch of boundary with a desired element size.
typedef struct {
  double from, to; // material angles, from <= to [rad]; across the floor: to > pi or from < -pi
  double size;     // side length of the elements [L]
} SbRingZone;

// A mesh. The boundary nodes are those of a closed polygon, counter-clockwise from the floor
// (angle -pi) over the bore (0); the floor is not repeated as pi at the end.
typedef struct {
  int nodes;      // vertices and mid-sides
  int elements;   // triangles
  int loop_count; // boundary nodes: vertex, mid-side, vertex, ...
  double *x;      // [nodes][2] reference position (r, z) [L]
  int *tri;       // [elements][6] node numbers
  int *loop;      // [loop_count] boundary nodes by increasing angle, vertices at even places
  double *angle;  // [loop_count] material angle, increasing from -pi to below pi [rad]
  double arc[2];  // length of surface per angle on the left and right half [L/rad]
} SbRingMesh;

// Description of a mesh: an outline whose middle is at r = `centre`, or a disc of `radius` around
// it. The element size increases from each zone by `growth` per unit of arc, up to `size_max`.
typedef struct {
  double centre; // r of the section's middle [L]
  double radius; // disc: its radius [L]; not used with an outline
  // Borrowed during the call, in units of L = the radial height; NULL: a disc.
  const SbRingOutline *outline;
  double size_max; // largest element size [L]
  double growth;   // increase of the element size per length [1]
  int layers;      // disc: rows of elements from surface to centre, 3 to 20
  int zone_count;
  SbRingZone zone[SB_RING_ZONES_MAX]; // [zone_count], in any order
  int vertex_count;
  // [vertex_count] material angles at which the boundary must have a vertex (contact edges), in any
  // order [rad].
  double vertex[SB_RING_VERTICES_MAX];
} SbRingMeshPlan;

// Creates a mesh by `plan`. SB_ERROR_MEMORY: also if a disc needs too many nodes. SB_ERROR_INPUT:
// `layers` or `size_max` of a disc is out of range. SB_ERROR_NOT_CONVERGED: no mesh of good
// triangles was found.
SbStatus sb_ring_mesh_create(SbRingMesh **out, const SbRingMeshPlan *plan, SbReport *report);

// Creates the mesh of an outline (ring_triangles.c). Called by sb_ring_mesh_create().
SbStatus sb_ring_triangles_create(SbRingMesh **out, const SbRingMeshPlan *plan, SbReport *report);

// Returns the length of the undeformed surface between two material angles, from <= to [L]. Angles
// beyond -pi and pi continue around the section.
double sb_ring_mesh_arc(const SbRingMesh *mesh, double from, double to);

// Creates the mesh reflected in z. Nodes keep their numbers; loop[i] of the mirror is loop[0] for
// i = 0, else loop[loop_count - i]; vertices 1 and 2 of each triangle are exchanged.
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

// Frees the mesh and its arrays.
void sb_ring_mesh_destroy(SbRingMesh *mesh);

// Computes the shape functions n of a triangle's six nodes and their derivatives by l1 and l2 at
// the area coordinates (l1, l2) of vertices 1 and 2.
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

// Finds xi at which the nodal values v, monotonic along the side, give `wanted` (between v[0] and
// v[2]); writes shape functions and derivatives there.
void sb_ring_side_at(const double v[3], double wanted, double n[3], double d[3]);

// Gauss points X and weights W of a side in xi, three (exact to degree 5) and four (degree 7).
static const double SB_RING_X3[3] = {-0.774596669241483377, 0.0, 0.774596669241483377};
static const double SB_RING_W3[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
static const double SB_RING_X4[4] = {-0.861136311594052575, -0.339981043584856265,
                                     0.339981043584856265, 0.861136311594052575};
static const double SB_RING_W4[4] = {0.347854845137453857, 0.652145154862546143,
                                     0.652145154862546143, 0.347854845137453857};

// Finds the triangle (with straight sides) that contains the reference point x, or the nearest one,
// starting at triangle `near` (any valid number). Returns its number, and in *l1, *l2 the area
// coordinates of its vertices 1 and 2 (outside the triangle: negative, or a sum above 1).
int sb_ring_mesh_locate(const SbRingMesh *mesh, const double x[2], int near, double *l1,
                        double *l2);
