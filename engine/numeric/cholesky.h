// Sparse symmetric positive definite systems: A = L D L^T without exchanges.
//
// Unknowns in the order of least degree (Amestoy, Davis and Duff 1996); the factor by rows, each
// found by its path up the elimination tree (T.A. Davis, ACM Trans. Math. Softw. 31 (2005) 587).
// For stiffness and mass matrices of one unknown a node; the ring's blocks of two have their own
// (contact/ring/ring_factor.h).
#pragma once

#include "engine/base/status.h"

typedef struct SbCholesky SbCholesky;

// For n unknowns; row i has the columns column[start[i] .. start[i + 1]), its diagonal among them,
// and the pattern is symmetric. The pattern is borrowed as long as the factor lives. Owned; NULL
// without memory.
SbCholesky *sb_cholesky_create(int n, const int *start, const int *column);
void sb_cholesky_destroy(SbCholesky *factor); // takes NULL

// Factorises: value[k] belongs to column[k]. False where the matrix is not positive definite.
SB_CHECKED bool sb_cholesky_compute(SbCholesky *factor, const double *value);

// b becomes A^-1 b.
void sb_cholesky_solve(const SbCholesky *factor, double *b);
