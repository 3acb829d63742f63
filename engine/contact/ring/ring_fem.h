// Nearly incompressible finite-strain finite elements in a plane or about an axis.
//
// Internal to the ring. Displacement (r, z) quadratic on six-node triangles plus a cubic bubble,
// pressure linear and discontinuous (Crouzeix-Raviart P2+/P1): free of locking for any bulk
// modulus. Bubble and pressure are condensed inside each element. All quantities in one consistent
// set of units (the ring passes lengths in section diameters and stress in initial shear moduli).
#pragma once

#include "engine/contact/ring/ring_factor.h"
#include "engine/contact/ring/ring_mesh.h"

#include <stdbool.h>

enum { SB_RING_FEM_POINTS = 7, SB_RING_INNER = 5 };

// W = c1 (J^(-2/3) I1 - 3) + c2 (J^(-4/3) I2 - 3) + bulk/2 (J - 1)^2.
typedef struct {
  double c1, c2, bulk; // Pa
} SbRingMaterial;

// What holds at one node: the rows of its two equations are replaced accordingly.
// count 0: free, the residual vanishes. count 1: n . du = gap, and along t the residual vanishes
// with a share `mix` of the normal reaction: (t + mix n) . R = drive. count 2: both `direction`
// rows hold: direction[k] . du = gap[k]. `curve` is the turn of the normal towards the tangent per
// length along x, r or z by `axis` (a curved surface): dn/dx = curve t, dt/dx = -curve n. `drive`
// changes with the places of the nodes `beside`.
enum { SB_RING_BESIDE = 5 };
typedef struct {
  int count;
  double direction[2][2];
  double gap[2];            // m
  double mix, curve, drive; // 1, 1/m, N
  int axis;                 // of `curve`: 0 r, 1 z
  int beside_count, beside[SB_RING_BESIDE];
  double drive_slope[SB_RING_BESIDE][2]; // N/m
} SbRingCondition;

typedef struct SbRingFem SbRingFem;
struct SbRingFem {
  const SbRingMesh *mesh; // borrowed
  double around;          // 2 pi, of radii that count inwards -2 pi; 0: a straight cord
  SbRingMaterial material;
  double axial_spring;  // stiffness per node against axial drift, 0 = none
  double axial_rest;    // mean drift since the saved state 1 at which the spring is slack
  double axial_damping; // the same against axial motion in one iteration only
  double viscosity;     // resistance per reference volume to motion since the saved state 1

  double *u;        // [2 nodes] displacement
  double *inner;    // [5 elements] bubble (r, z), pressure (3 terms)
  double *saved[3]; // room for three saved states
  double *mass;     // [nodes] reference volume lumped at the nodes

  double *residual;           // [2 nodes] condensed internal minus external force
  double *du;                 // [2 nodes] last solution
  double *du_path;            // [2 nodes] its change with the parameter of a path
  SbRingCondition *condition; // [nodes]

  double residual_inner; // largest residual of an element's own equations
  double det_min;        // least det F at the last assembly
  double volume;         // deformed, at the last assembly; the area in the plane

  bool balance_only; // what is assembled has no tangent of the nodes: nothing is solved with it

  // Private: quadrature data, condensation, sparse rows, factor.
  double *gauss, *condensed;
  int *row_start, *column, *scatter, *diagonal;
  double *value, *raw, *rhs, *left;
  SbRingFactor *factor;
  int *work_int; // [nodes] scratch
  int *hollow;   // [loop_count] number of the hollow that a boundary node lies in or by; 0: none
};

// Deformed place (r, z) of a node.
static inline void sb_ring_fem_place(const SbRingFem *fem, int node, double x[2]) {
  x[0] = fem->mesh->x[2 * node] + fem->u[2 * node];
  x[1] = fem->mesh->x[2 * node + 1] + fem->u[2 * node + 1];
}

// Owned, free with sb_ring_fem_destroy; keeps `mesh` borrowed. The state is zero.
SbStatus sb_ring_fem_create(SbRingFem **out, const SbRingMesh *mesh, SbRingMaterial material,
                            double around, SbReport *report);
void sb_ring_fem_destroy(SbRingFem *fem);

// For create only: numbers the hollows of the free section, [loop_count]; 0 where a node lies in
// none (ring_fold.c).
void sb_ring_hollows(int *hollow, const SbRingMesh *mesh);

// For create only: the sparse pattern and room for its factors.
SbStatus sb_ring_sparse_create(SbRingFem *fem, SbReport *report);

// Residual and condensed tangent of the elements at the current state (external terms are added by
// the caller afterwards). False if some point is turned inside out (det F <= 0).
SB_CHECKED bool sb_ring_fem_assemble(SbRingFem *fem);

// Adds to the tangent entry of (row node a, component i; column node b, component j).
void sb_ring_fem_add(SbRingFem *fem, int a, int i, int b, int j, double k);

// Solves for du under the nodes' conditions; keeps the raw rows of conditioned nodes.
SbStatus sb_ring_fem_solve(SbRingFem *fem, SbReport *report);

// The same in parts, for several right-hand sides: replaces the conditioned rows (rhs = -residual
// and gaps) and factorises; solves du for the present rhs. SB_ERROR_NOT_CONVERGED if singular.
SbStatus sb_ring_fem_factor(SbRingFem *fem, SbReport *report);
SbStatus sb_ring_fem_apply_factor(SbRingFem *fem, SbReport *report);

// The force R + K du that a conditioned node receives after the step, by the linear model.
void sb_ring_fem_reaction(const SbRingFem *fem, int node, double force[2]);

// u += step du with the matching bubble and pressure.
void sb_ring_fem_advance(SbRingFem *fem, double step);

// Largest residual over the rows that the conditions leave free.
double sb_ring_fem_free_residual(const SbRingFem *fem);

// Three places for a state: 0 is Newton's own, 1 the load stepper's, 2 the state before
// pseudo-transient continuation.
void sb_ring_fem_save(SbRingFem *fem, int place);
void sb_ring_fem_restore(SbRingFem *fem, int place);

// Stress at area coordinates of one element: Cauchy (rr, zz, rz, hoop), and J.
void sb_ring_fem_stress(const SbRingFem *fem, int element, double l1, double l2, double cauchy[4],
                        double *jacobian);

// A field [2 nodes] on another mesh of the same body at this mesh's nodes.
void sb_ring_fem_interpolate(double *out, const SbRingMesh *mesh, const double *field,
                             const SbRingMesh *from);

// Takes over the state of another mesh of the same body at this mesh's nodes.
void sb_ring_fem_transfer(SbRingFem *to, const SbRingFem *from);

// Takes over the state of the mirrored mesh (sb_ring_mesh_mirror), mirrored.
void sb_ring_fem_mirror(SbRingFem *to, const SbRingFem *from);
