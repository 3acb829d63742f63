// Roots and minima of functions of one variable in a bracket, roots of small systems, search in a
// table, cubic interpolation. The functions have no state of their own and may be called
// concurrently.
#pragma once

#include "engine/base/status.h"

// A function of x. `context` is the pointer that the caller passed to the solver.
typedef double (*SbFunction)(double x, const void *context);

// Returns the x between `above` and `below` at which f changes sign, to the last digit, by
// bisection. f must be positive at `above` and zero or negative at `below`. Either end may be the
// larger one; neither is evaluated.
double sb_bisect(SbFunction f, const void *context, double above, double below);

// A function that returns its value at x and writes its derivative to *slope. `context` is the
// pointer that the caller passed to the solver.
typedef double (*SbSlopedFunction)(double *slope, double x, const void *context);

// Returns the root of an increasing f in [low, high], to 2 DBL_EPSILON times the larger magnitude
// of the ends. Uses Newton's method from `guess`, and bisection if a step leaves the bracket. f
// must have a root in [low, high]; the ends are not evaluated. Without a root the result is an end.
double sb_newton_bracketed(SbSlopedFunction f, const void *context, double low, double high,
                           double guess);

// Returns the x at which f has its minimum in [low, high], by golden section search; f must be
// unimodal. The error is at most `digits` times (high - low); values below 1e-8 gain nothing in
// double precision.
double sb_minimum(SbFunction f, const void *context, double low, double high, double digits);

// Returns the largest i <= count - 2 with x[i] <= at, or 0 if at < x[0]. x[count] is increasing,
// count >= 2.
size_t sb_interval(const double *x, size_t count, double at);

// Returns the cubic Hermite polynomial at the fraction f (0 to 1) of an interval, and writes its
// derivative with respect to the coordinate to *slope. `width` is the length of the interval,
// `value` has the values and `end` the derivatives with respect to the coordinate at its two ends.
double sb_hermite(double *slope, double f, double width, const double value[2],
                  const double end[2]);

// Computes the residuals r[n] at x[n], n of sb_solve_system(). Returns false if they are not
// defined there.
typedef bool (*SbSystem)(double *r, const double *x, void *context);

// Largest number of unknowns of sb_solve_system().
enum { SB_SYSTEM_MAX = 4 };

// Jacobian that one solve passes to the next solve of a similar system. Initialise with {0}.
typedef struct {
  double slope[SB_SYSTEM_MAX * SB_SYSTEM_MAX]; // dr_i/dx_j = slope[i + n*j]
  bool known;                                  // `slope` has been set
  size_t iterations;                           // sum over all solves so far
  double residual; // max norm of r after the last solve; INFINITY if r is not defined
} SbBroyden;

// Solves f(x) = 0 for n <= SB_SYSTEM_MAX unknowns by a quasi-Newton method. x[n] has the initial
// guess and receives the solution. The Jacobian is that of `broyden`, or computed by differences.
// Broyden's formula updates it while each step at least halves the residual; otherwise it is
// recomputed and steps are shortened until the residual decreases. Returns true if the max norm of
// r is at most `tolerance`, or at most 1000 `tolerance` if rounding prevents a smaller one. f was
// then last called with the returned x. Returns false if r is not defined or 40 iterations were not
// enough; x is then the best point found.
SB_CHECKED bool sb_solve_system(SbSystem f, void *context, double *x, size_t n, double tolerance,
                                SbBroyden *broyden);
