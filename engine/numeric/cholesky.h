// Direct solver for sparse symmetric positive definite systems A x = b, by A = L D L^T.
//
// The unknowns are ordered by approximate minimum degree (Amestoy, Davis and Duff 1996). The factor
// is computed by rows along the elimination tree (T.A. Davis, ACM Trans. Math. Softw. 31 (2005)
// 587). Use: create once for a pattern, compute for each matrix, solve for each right-hand side.
// contact/ring/ring_factor.h is a separate solver for systems of 2 x 2 blocks.
#pragma once

#include "engine/base/status.h"

typedef struct SbCholesky SbCholesky;

// Creates a solver for n >= 0 unknowns and analyses the pattern of A. Row i has its non-zero
// entries in the columns column[start[i]] to column[start[i + 1] - 1], in any order; start[n + 1],
// start[0] = 0. Each row includes its diagonal, and the pattern is symmetric (both triangles).
// `start` and `column` are borrowed until the solver is destroyed. Returns NULL if memory is short
// or the pattern is invalid.
SbCholesky *sb_cholesky_create(int n, const int *start, const int *column);

// Frees the solver.
void sb_cholesky_destroy(SbCholesky *factor);

// Factorises A, whose entry in column[k] is value[k], k < start[n]. `value` is only read during the
// call. Returns false if A is not positive definite; sb_cholesky_solve() must not be called then.
SB_CHECKED bool sb_cholesky_compute(SbCholesky *factor, const double *value);

// Replaces b[n] by A^-1 b, with the factor of the last sb_cholesky_compute() that returned true.
// Uses a work array of `factor`: one thread at a time.
void sb_cholesky_solve(const SbCholesky *factor, double *b);
