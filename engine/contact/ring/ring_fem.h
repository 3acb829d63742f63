// Nearly incompressible finite-strain finite elements, plane or axisymmetric. Private to
// engine/contact/ring.
//
// Displacement (r, z) quadratic on six-node triangles plus a cubic bubble, pressure linear and
// discontinuous (Crouzeix-Raviart P2+/P1): no locking for any bulk modulus. Bubble and pressure are
// condensed in each element. Any consistent units; the ring uses lengths in section diameters and
// stresses in initial shear moduli.
//
// A Newton iteration: sb_ring_fem_assemble(), external forces (residual, sb_ring_fem_add()) and
// conditions, sb_ring_fem_solve(), sb_ring_fem_advance(). Positions and forces are (r, z).
#pragma once

#include "engine/contact/ring/ring_factor.h"
#include "engine/contact/ring/ring_mesh.h"

#include <stdbool.h>

// Gauss points of an element, and its condensed unknowns.
enum { SB_RING_FEM_POINTS = 7, SB_RING_INNER = 5 };

// Material W = c1 (J^(-2/3) I1 - 3) + c2 (J^(-4/3) I2 - 3) + bulk/2 (J - 1)^2.
typedef struct {
  double c1, c2, bulk; // unit of stress
} SbRingMaterial;

// Largest number of other nodes on which a prescribed traction depends.
enum { SB_RING_BESIDE = 5 };

// Boundary condition of a node, which replaces its two equations.
// count 0: free, the residual vanishes.
// count 1: n . du = gap; along the tangent t the residual balances the fraction `mix` of the normal
//   reaction (friction): (t + mix n) . R = drive, R the reaction.
// count 2: direction[k] . du = gap[k] for both rows.
// A curved surface turns its normal: dn/dx = curve t, dt/dx = -curve n per length along `axis`.
// `drive` (prescribed traction) changes with the positions of the nodes `beside`.
typedef struct {
  int count;
  double direction[2][2];                   // unit vectors (r, z): n and t, or two directions
  double gap[2];                            // prescribed displacements
  double mix, curve, drive;                 // friction coefficient; 1/length; force
  int axis;                                 // of `curve`: 0 r, 1 z
  int beside_count, beside[SB_RING_BESIDE]; // node numbers
  double drive_slope[SB_RING_BESIDE][2];    // derivative of `drive`, force/length
} SbRingCondition;

// A finite-element model with its state.
typedef struct SbRingFem SbRingFem;
struct SbRingFem {
  const SbRingMesh *mesh; // borrowed
  double around;          // 2 pi; -2 pi for negative radii; 0: plane
  SbRingMaterial material;
  double axial_spring;  // stiffness per node against a mean axial displacement; 0: none
  double axial_rest;    // mean axial displacement since saved state 1 at which the spring is free
  double axial_damping; // stiffness per node against mean axial motion within an iteration; 0: none
  double viscosity;     // resistance per reference volume against motion since saved state 1

  double *u;        // [nodes][2] displacement (r, z)
  double *inner;    // [elements][5] bubble (r, z), pressure (3 terms)
  double *saved[3]; // saved states, see sb_ring_fem_save()
  double *mass;     // [nodes] lumped reference volume

  double *residual;           // [nodes][2] condensed internal minus external force
  double *du;                 // [nodes][2] last solution
  double *du_path;            // [nodes][2] its derivative with respect to a path parameter
  SbRingCondition *condition; // [nodes]

  double residual_inner; // largest residual of the condensed equations
  double det_min;        // smallest det F at the last assembly
  double volume;         // deformed volume at the last assembly; plane: area

  bool balance_only; // assemble the residual only, without the tangent

  // Private: quadrature data, condensation, sparse rows, factor.
  double *gauss, *condensed;
  int *row_start, *column, *scatter, *diagonal;
  double *value, *raw, *rhs, *left;
  SbRingFactor *factor;
  int *work_int; // [nodes] work memory
  int *hollow;   // [loop_count] number of the concavity that contains a boundary node; 0: none
};

// Writes the deformed position (r, z) of a node to x[2].
static inline void sb_ring_fem_place(const SbRingFem *fem, int node, double x[2]) {
  x[0] = fem->mesh->x[2 * node] + fem->u[2 * node];
  x[1] = fem->mesh->x[2 * node + 1] + fem->u[2 * node + 1];
}

// Creates a model with zero displacement, without conditions, springs, damping and viscosity.
// `mesh` is borrowed; `around` is that of SbRingFem.
SbStatus sb_ring_fem_create(SbRingFem **out, const SbRingMesh *mesh, SbRingMaterial material,
                            double around, SbReport *report);

// Frees the model.
void sb_ring_fem_destroy(SbRingFem *fem);

// Numbers the concavities of the free section: hollow[loop_count], 0 for nodes in none
// (ring_fold.c). Called by sb_ring_fem_create().
void sb_ring_hollows(int *hollow, const SbRingMesh *mesh);

// Creates the sparse pattern and the factor. Called by sb_ring_fem_create().
SbStatus sb_ring_sparse_create(SbRingFem *fem, SbReport *report);

// Assembles residual and condensed tangent of the elements at the present state; the caller then
// adds external terms (sb_ring_contact_apply()) and sets fem->condition. Returns false if det F <=
// 0 at some point.
SB_CHECKED bool sb_ring_fem_assemble(SbRingFem *fem);

// Adds k to the tangent entry of row (node a, component i) and column (node b, component j).
void sb_ring_fem_add(SbRingFem *fem, int a, int i, int b, int j, double k);

// Solves for fem->du under the nodes' conditions; keeps the original rows of conditioned nodes for
// sb_ring_fem_reaction(). SB_ERROR_NOT_CONVERGED: singular.
SbStatus sb_ring_fem_solve(SbRingFem *fem, SbReport *report);

// First part of sb_ring_fem_solve(): replaces the conditioned rows, sets the right-hand side
// (-residual and gaps), and factorises. SB_ERROR_NOT_CONVERGED: singular.
SbStatus sb_ring_fem_factor(SbRingFem *fem, SbReport *report);

// Second part: solves for fem->du with the right-hand side fem->rhs [nodes][2]. The caller may
// change `rhs` and call it again. SB_ERROR_NOT_CONVERGED: the remaining residual is too large.
SbStatus sb_ring_fem_apply_factor(SbRingFem *fem, SbReport *report);

// Writes the reaction R + K du of a node with a condition after the step fem->du, by the linear
// model; `force` is that of the rigid surface on the node (r, z). Requires sb_ring_fem_solve().
void sb_ring_fem_reaction(const SbRingFem *fem, int node, double force[2]);

// Adds `step` times du to the displacement, with the corresponding bubble and pressure.
void sb_ring_fem_advance(SbRingFem *fem, double step);

// Returns the largest residual of the rows without conditions.
double sb_ring_fem_free_residual(const SbRingFem *fem);

// Saves the state in `place`: 0 (Newton's method), 1 (SB_RING_START: start of a load step) or 2
// (SB_RING_BEFORE: before an attempt of several steps). saved[place] begins with the saved
// displacements [nodes][2].
void sb_ring_fem_save(SbRingFem *fem, int place);

// Restores the state from one of these places.
void sb_ring_fem_restore(SbRingFem *fem, int place);

// Computes Cauchy stress (rr, zz, rz, hoop) and *jacobian J at the area coordinates l1, l2 (of
// vertices 1 and 2) of an element.
void sb_ring_fem_stress(const SbRingFem *fem, int element, double l1, double l2, double cauchy[4],
                        double *jacobian);

// Interpolates field[from->nodes][2] of another mesh of the same body at the nodes of `mesh` into
// out[nodes][2].
void sb_ring_fem_interpolate(double *out, const SbRingMesh *mesh, const double *field,
                             const SbRingMesh *from);

// Sets the state of `to` from that of another mesh of the same body.
void sb_ring_fem_transfer(SbRingFem *to, const SbRingFem *from);

// Sets the state of `to`, on the mirrored mesh (sb_ring_mesh_mirror()), to the reflected state of
// `from`.
void sb_ring_fem_mirror(SbRingFem *to, const SbRingFem *from);
