// Gaussian elimination with row exchanges.
#include "engine/numeric/eliminate.h"

#include <lapacke.h>
#include <math.h>

bool sb_eliminate(double *a, double *b, size_t n) {
  for (size_t k = 0; k < n; k++) {
    // Largest entry of the column to the diagonal.
    size_t best = k;
    for (size_t i = k + 1; i < n; i++) {
      if (fabs(a[i + k * n]) > fabs(a[best + k * n])) {
        best = i;
      }
    }
    if (!(fabs(a[best + k * n]) > 0.0)) {
      return false;
    }
    if (best != k) {
      for (size_t j = k; j < n; j++) {
        const double t = a[k + j * n];
        a[k + j * n] = a[best + j * n];
        a[best + j * n] = t;
      }
      const double t = b[k];
      b[k] = b[best];
      b[best] = t;
    }
    // Eliminate below; the factors replace the column.
    const double inverse = 1.0 / a[k + k * n];
    for (size_t i = k + 1; i < n; i++) {
      a[i + k * n] *= inverse;
      b[i] -= a[i + k * n] * b[k];
    }
    for (size_t j = k + 1; j < n; j++) {
      const double top = a[k + j * n];
      for (size_t i = k + 1; i < n; i++) {
        a[i + j * n] -= a[i + k * n] * top;
      }
    }
  }
  for (size_t k = n; k-- > 0;) {
    b[k] /= a[k + k * n];
    for (size_t i = 0; i < k; i++) {
      b[i] -= a[i + k * n] * b[k];
    }
  }
  return true;
}

bool sb_factor_solve(double *a, int *pivot, double *b, int n, bool fresh) {
  // Our rows are LAPACK's columns: solve with the transpose.
  return (!fresh || LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, a, n, pivot) == 0) &&
         LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'T', n, 1, a, n, pivot, b, n) == 0;
}
