// See root.h.
#include "engine/numeric/root.h"

#include <float.h>
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
  size_t low = 0, high = count - 1;
  while (high - low > 1) {
    const size_t middle = (low + high) / 2;
    *(x[middle] <= at ? &low : &high) = middle;
  }
  return low;
}
