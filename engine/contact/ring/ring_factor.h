// Factors of the ring's sparse equations, by blocks of two unknowns: a node's.
//
// A = L U with blocks of 2 x 2 on the pattern of A and its transpose, nodes in the order of least
// degree (Amestoy, Davis and Duff 1996). Nothing is exchanged but the two rows of a node, inside
// the inverse of its pivot: rows with conditions are scaled to their node, and a body in
// equilibrium has definite pivots. Who solves checks the residual. With a thousand unknowns this
// takes a third of the time of a sparse code by single unknowns, whose indices cost more than its
// products.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>

enum { SB_RING_BLOCK = 4 }; // numbers of a block

typedef struct SbRingFactor SbRingFactor;

// For `nodes` nodes; row i has the blocks of the columns column[start[i] .. start[i + 1]), the
// diagonal's among them, and the pattern is symmetric. Owned; NULL without memory.
SbRingFactor *sb_ring_factor_create(int nodes, const int *start, const int *column);
void sb_ring_factor_destroy(SbRingFactor *factor); // takes NULL

// Another one for the same pattern, which both hold: its order is not sought again. Owned; NULL
// without memory. From any thread.
SbRingFactor *sb_ring_factor_like(const SbRingFactor *factor);

// Factorises: value[4 k] is block k of the pattern, its rows one after the other. Allocates at the
// first call. False where a pivot has no inverse, or without memory.
SB_CHECKED bool sb_ring_factor_compute(SbRingFactor *factor, const double *value);

// x[2 nodes] = A^-1 b; x may be b. Allocates nothing.
void sb_ring_factor_solve(SbRingFactor *factor, double *x, const double *b);
