// Roots and minima of functions of one variable inside a bracket, and the interval of a table.
#pragma once

#include <stddef.h>

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
