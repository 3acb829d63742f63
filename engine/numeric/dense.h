// Small dense systems. For some dozens of rows, where a threaded
// library costs more than the work. Matrices are n x n by columns; nothing is allocated.
#pragma once

#include "engine/base/status.h"

// Factors a in place with row exchanges, to be used by sb_lu_solve(); false if singular.
SB_CHECKED bool sb_lu_factor(double *a, size_t *pivot, size_t n);

// Solves a x = b for a factored a; b becomes x.
void sb_lu_solve(const double *a, const size_t *pivot, double *b, size_t n);

enum { SB_ELIMINATE_MAX = 256 };

// Both at once for n <= SB_ELIMINATE_MAX: a is lost.
SB_CHECKED bool sb_eliminate(double *a, double *b, size_t n);

// Solves a x = b in place by LAPACK: `a` is n x n by rows. `fresh` replaces it by its factors, with
// `pivot` [n]; else it holds those of an earlier call. False if singular.
SB_CHECKED bool sb_factor_solve(double *a, int *pivot, double *b, int n, bool fresh);
