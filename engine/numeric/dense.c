// See dense.h.
#include "engine/numeric/dense.h"

#include <assert.h>
#include <cblas.h>
#include <lapacke.h>
#include <math.h>

bool sb_lu_factor(double *a, int *pivot, int n) {
  // LAPACK lets numbers that are not finite pass.
  return LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, a, n, pivot) == 0 &&
         isfinite(cblas_dasum(n * n, a, 1));
}

void sb_lu_solve(const double *a, const int *pivot, double *b, int n) {
  (void)LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', n, 1, a, n, pivot, b, n);
}

bool sb_eliminate(double *a, double *b, int n) {
  int pivot[SB_ELIMINATE_MAX];
  assert(n <= SB_ELIMINATE_MAX);
  if (!sb_lu_factor(a, pivot, n)) {
    return false;
  }
  sb_lu_solve(a, pivot, b, n);
  return true;
}

bool sb_factor_solve(double *a, int *pivot, double *b, int n, bool fresh) {
  // Our rows are LAPACK's columns: solve with the transpose.
  return (!fresh || LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, a, n, pivot) == 0) &&
         LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'T', n, 1, a, n, pivot, b, n) == 0;
}
