// See root.h.
#include "engine/numeric/root.h"

#include "engine/numeric/dense.h"

#include <assert.h>
#include <float.h>
#include <gsl/gsl_interp.h>
#include <math.h>
#include <string.h>

double sb_bisect(SbFunction f, const void *context, double above, double below) {
  for (int i = 0; i < 200; i++) {
    const double middle = 0.5 * (above + below);
    if (middle == above || middle == below) {
      break;
    }
    *(f(middle, context) > 0.0 ? &above : &below) = middle;
  }
  return 0.5 * (above + below);
}

double sb_newton_bracketed(SbSlopedFunction f, const void *context, double low, double high,
                           double guess) {
  const double least = 2.0 * DBL_EPSILON * fmax(fabs(low), fabs(high));
  double x = fmin(fmax(guess, low), high);
  for (int i = 0; i < 200 && high - low > least; i++) {
    double slope;
    const double value = f(&slope, x, context);
    const double step = value / slope;
    // Tested before the bracket: at the root itself a zero step stays on its end.
    if (fabs(step) <= least) {
      return fmin(fmax(x - step, low), high);
    }
    *(value > 0.0 ? &high : &low) = x;
    x = x - step > low && x - step < high ? x - step : 0.5 * (low + high);
  }
  return x;
}

double sb_minimum(SbFunction f, const void *context, double low, double high, double digits) {
  const double ratio = 0.6180339887498949;
  const double least = digits * (high - low);
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double at_a = f(a, context), at_b = f(b, context);
  while (high - low > least) {
    if (at_a < at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - ratio * (high - low);
      at_a = f(a, context);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + ratio * (high - low);
      at_b = f(b, context);
    }
  }
  return 0.5 * (low + high);
}

size_t sb_interval(const double *x, size_t count, double at) {
  return gsl_interp_bsearch(x, at, 0, count - 1);
}

double sb_hermite(double *slope, double f, double width, const double value[2],
                  const double end[2]) {
  const double d = value[1] - value[0], a = width * end[0], b = width * end[1];
  const double c2 = 3.0 * d - 2.0 * a - b, c3 = a + b - 2.0 * d;
  *slope = (a + f * (2.0 * c2 + 3.0 * f * c3)) / width;
  return value[0] + f * (a + f * (c2 + f * c3));
}

static double largest(const double *r, size_t n) {
  double most = 0.0;
  for (size_t i = 0; i < n; i++) {
    most = fmax(most, fabs(r[i]));
  }
  return most;
}

// Derivatives of the residuals by the unknowns, by columns.
static bool differentiate(SbSystem f, void *context, const double *x, const double *r, size_t n,
                          double *slope) {
  for (size_t j = 0; j < n; j++) {
    double shifted[SB_SYSTEM_MAX] = {0.0};
    memcpy(shifted, x, n * sizeof *x);
    const double h = 1e-6 * fabs(x[j]) + 1e-12;
    shifted[j] += h;
    if (!f(&slope[j * n], shifted, context)) {
      return false;
    }
    for (size_t i = 0; i < n; i++) {
      slope[i + j * n] = (slope[i + j * n] - r[i]) / h;
    }
  }
  return true;
}

bool sb_solve_system(SbSystem f, void *context, double *x, size_t n, double tolerance,
                     SbBroyden *b) {
  enum { N = SB_SYSTEM_MAX, ITERATIONS_MAX = 40 };
  double r[N], next[N] = {0.0}, there[N], moved[N] = {0.0}, step[N], a[N * N];
  bool fresh = false;
  assert(n <= N);
  bool good = f(r, x, context);
  b->residual = good ? largest(r, n) : INFINITY;
  for (int i = 0; good && b->residual > tolerance; i++) {
    if (i >= ITERATIONS_MAX) {
      return false;
    }
    if (!b->known) {
      b->known = fresh = differentiate(f, context, x, r, n, b->slope);
    }
    memcpy(step, r, n * sizeof *r);
    memcpy(a, b->slope, sizeof a);
    const bool solvable = b->known && sb_eliminate(a, step, n);
    bool better = false;
    double share = -1.0;
    for (int k = 0; k < (fresh ? 12 : 1) && solvable && !better; k++, share *= 0.5) {
      for (size_t j = 0; j < n; j++) {
        moved[j] = share * step[j];
        next[j] = x[j] + moved[j];
      }
      better = f(there, next, context) && largest(there, n) < (fresh ? 1.0 : 0.5) * b->residual;
    }
    b->iterations++;
    if (!better && !fresh && solvable) {
      b->known = false;
      continue;
    }
    if (!better) {
      // A residual at rounding level cannot be bettered.
      b->known = false;
      return f(r, x, context) && b->residual <= 1e3 * tolerance;
    }
    double square = 0.0;
    for (size_t j = 0; j < n; j++) {
      square += moved[j] * moved[j];
    }
    for (size_t k = 0; k < n && square > 0.0; k++) {
      double miss = there[k] - r[k];
      for (size_t j = 0; j < n; j++) {
        miss -= b->slope[k + j * n] * moved[j];
      }
      for (size_t j = 0; j < n; j++) {
        b->slope[k + j * n] += miss * moved[j] / square;
      }
    }
    memcpy(x, next, n * sizeof *x);
    memcpy(r, there, n * sizeof *r);
    b->residual = largest(r, n);
    fresh = false;
  }
  return good;
}
