// Gaussian elimination with row exchanges (Golub and Van Loan, Matrix Computations, 3.4).
#include "engine/numeric/dense.h"

#include <assert.h>
#include <lapacke.h>
#include <math.h>

static void swap(double *a, double *b) {
  const double t = *a;
  *a = *b;
  *b = t;
}

bool sb_lu_factor(double *a, size_t *pivot, size_t n) {
  for (size_t k = 0; k < n; k++) {
    // Largest entry of the column to the diagonal.
    size_t best = k;
    for (size_t i = k + 1; i < n; i++) {
      if (fabs(a[i + k * n]) > fabs(a[best + k * n])) {
        best = i;
      }
    }
    pivot[k] = best;
    if (!(fabs(a[best + k * n]) > 0.0)) {
      return false;
    }
    for (size_t j = 0; best != k && j < n; j++) {
      swap(&a[k + j * n], &a[best + j * n]);
    }
    // Eliminate below; the factors replace the column.
    const double inverse = 1.0 / a[k + k * n];
    for (size_t i = k + 1; i < n; i++) {
      a[i + k * n] *= inverse;
    }
    for (size_t j = k + 1; j < n; j++) {
      const double top = a[k + j * n];
      for (size_t i = k + 1; i < n && top != 0.0; i++) {
        a[i + j * n] -= a[i + k * n] * top;
      }
    }
  }
  return true;
}

void sb_lu_solve(const double *a, const size_t *pivot, double *b, size_t n) {
  for (size_t k = 0; k < n; k++) {
    swap(&b[k], &b[pivot[k]]);
  }
  for (size_t k = 0; k < n; k++) {
    for (size_t i = k + 1; i < n; i++) {
      b[i] -= a[i + k * n] * b[k];
    }
  }
  for (size_t k = n; k-- > 0;) {
    b[k] /= a[k + k * n];
    for (size_t i = 0; i < k; i++) {
      b[i] -= a[i + k * n] * b[k];
    }
  }
}

bool sb_eliminate(double *a, double *b, size_t n) {
  size_t pivot[SB_ELIMINATE_MAX];
  assert(n <= SB_ELIMINATE_MAX);
  if (!sb_lu_factor(a, pivot, n)) {
    return false;
  }
  sb_lu_solve(a, pivot, b, n);
  return true;
}

bool sb_factor_solve(double *a, int *pivot, double *b, int n, bool factor) {
  // Our rows are LAPACK's columns: solve with the transpose.
  return (!factor || LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, a, n, pivot) == 0) &&
         LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'T', n, 1, a, n, pivot, b, n) == 0;
}
