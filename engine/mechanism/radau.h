// Radau IIA of order 5: one step of a small stiff system, with quadratures carried along.
//
// Hairer and Wanner, Solving Ordinary Differential Equations II, IV.5 and IV.8 (3 stages,
// L-stable). The caller doubles steps for the error estimate (sb_radau_pair), which then is of the
// order of the result, and ends them on events by stepping again. Nothing is allocated. Leaves
// out: mass matrices, systems larger than SB_RADAU_MAX.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>
#include <stddef.h>

enum { SB_RADAU_MAX = 7, SB_RADAU_POWERS = 7, SB_RADAU_STAGES = 3 };

// dz[n] = rates of the state, power[powers] = integrands that do not feed back, unless
// NULL. z and dz have room for SB_RADAU_MAX.
typedef void (*SbRadauRates)(double *dz, double *power, double t, const double *z, void *user);

typedef struct {
  size_t n, powers;
  SbRadauRates rates;
  void *user;
  double tolerance;             // relative
  double floor[SB_RADAU_MAX];   // absolute size per component below which errors are scaled by this
  double ceiling[SB_RADAU_MAX]; // absolute size above which they are; 0: none
  double noise[SB_RADAU_MAX];   // rounding of the rates: Newton's iteration ends there
} SbRadauSystem;

// One step, enough for dense output.
typedef struct {
  double t, h; // s
  double z0[SB_RADAU_MAX], z1[SB_RADAU_MAX];
  double k[SB_RADAU_STAGES][SB_RADAU_MAX];
  double q[SB_RADAU_STAGES][SB_RADAU_POWERS];
} SbRadauStep;

// From (t, z) over h > 0 in two steps of h/2; against one of h the difference of every component,
// over 31, as `local`, and the greatest scaled one as `error` (accept below 1). The pair is more
// accurate than that by about 31. False if Newton's iteration, counted in *iterations, did not
// converge (take a smaller h).
SB_CHECKED bool sb_radau_pair(SbRadauStep pair[2], double *error, double *local,
                              const SbRadauSystem *system, double t, const double *z, double h,
                              long *iterations);

// State z[n] at t + theta h, 0 <= theta <= 1, and the quadratures over (t, t + theta h); either may
// be NULL.
void sb_radau_dense(const SbRadauStep *step, const SbRadauSystem *system, double theta, double *z,
                    double *integral);
