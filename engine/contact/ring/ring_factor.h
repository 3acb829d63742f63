// Direct solver for the ring's sparse equations in 2 x 2 blocks (one block row for each node).
// Private to engine/contact/ring.
//
// A = L U on the symmetric pattern of A, nodes ordered by approximate minimum degree (Amestoy,
// Davis and Duff 1996). Pivoting is only inside the blocks; a ring in equilibrium has definite
// pivots. The caller checks the residual.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>

// Numbers of a block.
enum { SB_RING_BLOCK = 4 };

// A solver with its factors; used by one thread at a time.
typedef struct SbRingFactor SbRingFactor;

// Creates a solver for `nodes` nodes. Block row i has blocks in the columns column[start[i]] to
// column[start[i + 1] - 1], in any order, including the diagonal; start[nodes + 1], start[0] = 0.
// The pattern is symmetric and is copied. NULL: no memory.
SbRingFactor *sb_ring_factor_create(int nodes, const int *start, const int *column);

// Frees the solver.
void sb_ring_factor_destroy(SbRingFactor *factor);

// Creates another solver, without factors, for the pattern of `factor`, which both solvers share;
// they may be freed in any order. NULL: no memory. Any thread may call it.
SbRingFactor *sb_ring_factor_like(const SbRingFactor *factor);

// Factorises A: value[4 k] to value[4 k + 3] is block k of the pattern by rows. Returns false if a
// pivot is singular or memory is short.
SB_CHECKED bool sb_ring_factor_compute(SbRingFactor *factor, const double *value);

// Writes A^-1 b to x[2 nodes]; x and b may be the same array. Requires a successful
// sb_ring_factor_compute().
void sb_ring_factor_solve(SbRingFactor *factor, double *x, const double *b);
