// A ring whose contact ends are unknowns: a proof, on the elements of the ring solver.
//
// Each contact begins and ends at a vertex of the mesh. The nodes between its two ends are on the
// surface, the others are not; this set does not change. The unknowns are the displacements and the
// position of each end along the free section's outline. The mesh follows the ends: nodes of the
// outline slide along it, in proportion to their distance from the next ends, and inner vertices
// follow by the mean of their neighbours. The material does not move. Newton's method has one
// equation more per end ("bordered"):
//
//   F_end - F_mid / 12 = 0,
//
// F the contact's force minus the fluid's on the end's vertex and on the mid-side node next to it.
// The pressure above the fluid's is K d^(-1/2) + S d^(1/2) + ... at the distance d from the end,
// and K = 0 there. Of this sum the quadratic shape functions leave 0.711 K h^(1/2) on a side of the
// length h, and nothing of S: the end is right to second order in h.
//
// Lengths are in section diameters and stresses in shear moduli, as in ring_private.h. Sliding
// friction on the bore is Coulomb's, of the contact's own force. Floor and walls keep the states of
// stick and slip that the ring had, and their positions of the start of the step move with the
// mesh. Not in it: changes of the set, and paths with predictors.
#pragma once

#include "engine/contact/ring/ring_private.h"

typedef struct AlignedRing AlignedRing;

// Inputs for slopes: the modulus, the squeeze, and the shear strength of the bore's friction.
typedef enum { ALIGNED_MODULUS, ALIGNED_SQUEEZE, ALIGNED_SHEAR, ALIGNED_INPUTS } AlignedInput;

// Results: load [N], width of the bore's contact [m], drag [N], the floor's load [N].
enum { ALIGNED_LOAD, ALIGNED_WIDTH, ALIGNED_DRAG, ALIGNED_FLOOR, ALIGNED_RESULTS };

// Creates it from a solved ring with a mesh that was fitted to its contacts; `ring` is borrowed and
// changed. `friction`: Coulomb's coefficient of the bore, which slides to +x if it is positive; 0:
// none. NULL: too many contacts, or none.
AlignedRing *aligned_create(SbRing *ring, double friction);

// Frees it.
void aligned_destroy(AlignedRing *aligned);

// Solves. Returns the number of iterations, or -1: it does not converge.
int aligned_solve(AlignedRing *aligned);

// Computes the results of the present state.
void aligned_results(AlignedRing *aligned, double out[ALIGNED_RESULTS]);

// Returns the normal force of a surface [N].
double aligned_force(AlignedRing *aligned, SbRingSurface surface);

// Computes d ln(result) / d ln(input) of a solved state by one back-substitution.
bool aligned_slopes(AlignedRing *aligned, AlignedInput input, double out[ALIGNED_RESULTS]);

// Solves with an input multiplied by 1 + change and returns to the present state. Returns like
// aligned_solve(), and the results of the other state.
int aligned_solve_at(AlignedRing *aligned, AlignedInput input, double change,
                     double out[ALIGNED_RESULTS]);

// Returns the coefficients S of the pressure at both ends of the bore's contact [MPa/sqrt(mm)].
bool aligned_roots(AlignedRing *aligned, double out[2]);

// Finds the largest tension of nodes in contact [shear moduli] and the largest penetration of the
// others [section diameters], both >= 0: 0 in a true state.
void aligned_faults(AlignedRing *aligned, double *tension, double *penetration);
