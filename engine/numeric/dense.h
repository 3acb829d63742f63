// Direct solvers for small dense systems of n equations A x = b. The functions allocate nothing and
// may be called concurrently.
//
// sb_lu_factor(), sb_lu_solve() and sb_eliminate() store A by columns: A_ij = a[i + n*j]. They are
// faster than a threaded library for up to some dozens of rows. sb_factor_solve() stores A by rows.
#pragma once

#include "engine/base/status.h"

// Replaces a[n*n] (by columns) by its factors L and U with partial pivoting, and writes the row
// exchanges to pivot[n]. Returns false if A is singular: `a` and `pivot` are undefined then.
SB_CHECKED bool sb_lu_factor(double *a, size_t *pivot, size_t n);

// Replaces b[n] by A^-1 b. `a` and `pivot` are the results of sb_lu_factor().
void sb_lu_solve(const double *a, const size_t *pivot, double *b, size_t n);

// Largest n of sb_eliminate().
enum { SB_ELIMINATE_MAX = 256 };

// Replaces b[n] by A^-1 b, n <= SB_ELIMINATE_MAX. a[n*n] (by columns) is overwritten. Returns false
// if A is singular: `b` is unchanged then.
SB_CHECKED bool sb_eliminate(double *a, double *b, size_t n);

// Replaces b[n] by A^-1 b by LAPACK. With `factor` true, a[n*n] is A by rows; the function replaces
// it by its factors and writes the row exchanges to pivot[n] before it solves. With `factor` false,
// `a` and `pivot` must be those of an earlier call with `factor` true. Returns false if A is
// singular: `b` is unchanged then.
SB_CHECKED bool sb_factor_solve(double *a, int *pivot, double *b, int n, bool factor);
