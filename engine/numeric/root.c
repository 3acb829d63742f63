// See root.h.
#include "engine/numeric/root.h"

#include <float.h>
#include <gsl/gsl_interp.h>
#include <math.h>

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
    // Before the bracket is asked: at the root itself a step of nothing stays on its end.
    if (fabs(step) <= least) {
      return fmin(fmax(x - step, low), high);
    }
    *(value > 0.0 ? &high : &low) = x;
    x = x - step > low && x - step < high ? x - step : 0.5 * (low + high);
  }
  return x;
}

size_t sb_interval(const double *x, size_t count, double at) {
  return gsl_interp_bsearch(x, at, 0, count - 1);
}
