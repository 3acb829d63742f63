// Roots and minima of functions of one variable inside a bracket, roots of small systems, and the
// interval of a table.
#pragma once

#include "engine/base/status.h"

typedef double (*SbFunction)(double x, const void *context);

// Where f turns from positive at `above` to zero or negative at `below`, whichever of them is the
// greater, to the last digit. Neither end is evaluated.
double sb_bisect(SbFunction f, const void *context, double above, double below);

// A function with its slope.
typedef double (*SbSlopedFunction)(double *slope, double x, const void *context);

// Root of a rising f in [low, high] to the rounding of its ends: Newton's method from `guess`,
// bisection where that leaves the bracket.
double sb_newton_bracketed(SbSlopedFunction f, const void *context, double low, double high,
                           double guess);

// Place of the minimum of f in [low, high], where it has one, to `digits` of the bracket (1e-8:
// more a minimum does not hold); golden section.
double sb_minimum(SbFunction f, const void *context, double low, double high, double digits);

// Greatest i <= count - 2 with x[i] <= at, 0 if there is none; x increasing, count >= 2.
size_t sb_interval(const double *x, size_t count, double at);

// Cubic with the values and slopes of both ends of an interval of some width, at its fraction f;
// its slope.
double sb_hermite(double *slope, double f, double width, const double value[2],
                  const double end[2]);

// Residuals r of the unknowns x; false where they are not defined.
typedef bool (*SbSystem)(double *r, const double *x, void *context);

enum { SB_SYSTEM_MAX = 4 };

// What one solve hands on to the next. Zero-initialise.
typedef struct {
  double slope[SB_SYSTEM_MAX * SB_SYSTEM_MAX]; // derivatives of the residuals, n x n by columns
  bool known;                                  // if set
  size_t iterations;                           // of all solves
  double residual;                             // the largest one of the last
} SbBroyden;

// Solves f(x) = 0 for n <= SB_SYSTEM_MAX unknowns from the given ones by Newton's method.
// Derivatives come from an earlier solve or from differences and are corrected by Broyden's formula
// while each step at least halves the residual; with fresh ones steps are shortened until it falls.
// True if the largest residual is at most `tolerance`, or a thousand times that where rounding
// allows no less; f was then last called with x.
SB_CHECKED bool sb_solve_system(SbSystem f, void *context, double *x, size_t n, double tolerance,
                                SbBroyden *broyden);
