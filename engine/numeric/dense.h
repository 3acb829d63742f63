// Dense systems by LAPACK, n x n by columns where nothing else is said. Nothing is allocated.
#pragma once

#include "engine/base/status.h"

// Factors a in place with row exchanges, to be used by sb_lu_solve(); false if singular or not
// finite.
SB_CHECKED bool sb_lu_factor(double *a, int *pivot, int n);

// Solves a x = b for a factored a; b becomes x.
void sb_lu_solve(const double *a, const int *pivot, double *b, int n);

enum { SB_ELIMINATE_MAX = 256 };

// Both at once for n <= SB_ELIMINATE_MAX: a is lost.
SB_CHECKED bool sb_eliminate(double *a, double *b, int n);

// Solves a x = b in place: `a` is n x n by rows. `fresh` replaces it by its factors, with
// `pivot` [n]; else it holds those of an earlier call. False if singular.
SB_CHECKED bool sb_factor_solve(double *a, int *pivot, double *b, int n, bool fresh);
