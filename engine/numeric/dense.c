// Gaussian elimination with row exchanges; Jacobi's eigenvalues (Golub and Van Loan, Matrix
// Computations, 3.4 and 8.5).
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

// Rows or columns p and q of m, `step` apart, turned by an angle of cosine c and sine s.
static void rotate(double *p, double *q, size_t step, size_t n, double c, double s) {
  for (size_t k = 0; k < n * step; k += step) {
    const double before = p[k];
    p[k] = c * before - s * q[k];
    q[k] = s * before + c * q[k];
  }
}

void sb_eigen_symmetric(double *a, double *v, size_t n) {
  for (size_t i = 0; v != NULL && i < n * n; i++) {
    v[i] = i % (n + 1) == 0 ? 1.0 : 0.0;
  }
  bool rotated = true;
  for (int sweep = 0; sweep < 60 && rotated; sweep++) {
    rotated = false;
    for (size_t p = 0; p + 1 < n; p++) {
      for (size_t q = p + 1; q < n; q++) {
        const double off = a[p + q * n], low = a[p + p * n], high = a[q + q * n];
        if (fabs(off) <= 1e-17 * (fabs(low) + fabs(high))) {
          continue;
        }
        rotated = true;
        const double theta = 0.5 * (high - low) / off;
        const double t = copysign(1.0, theta) / (fabs(theta) + hypot(theta, 1.0));
        const double c = 1.0 / hypot(t, 1.0), s = t * c;
        rotate(&a[p * n], &a[q * n], 1, n, c, s);
        rotate(&a[p], &a[q], n, n, c, s);
        if (v != NULL) {
          rotate(&v[p * n], &v[q * n], 1, n, c, s);
        }
      }
    }
  }
}

bool sb_factor_solve(double *a, int *pivot, double *b, int n, bool fresh) {
  // Our rows are LAPACK's columns: solve with the transpose.
  return (!fresh || LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, a, n, pivot) == 0) &&
         LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'T', n, 1, a, n, pivot, b, n) == 0;
}
