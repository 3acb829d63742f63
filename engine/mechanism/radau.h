// Radau IIA of order 5: one step of a small stiff system, with quadratures carried along.
//
// Hairer and Wanner, Solving Ordinary Differential Equations II, IV.5 and IV.8 (3 stages,
// L-stable). The caller doubles steps for the error estimate (sb_radau_pair), which then is of the
// order of the result, and locates events by stepping to them again. Nothing is allocated. Leaves
// out: mass matrices, systems larger than SB_RADAU_MAX.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>
#include <stddef.h>

enum { SB_RADAU_MAX = 10, SB_RADAU_POWERS = 10, SB_RADAU_STAGES = 3 };

// dz[n] = rates of the state, power[powers] = integrands that do not feed back.
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
  double t, h;
  double z0[SB_RADAU_MAX], z1[SB_RADAU_MAX];
  double k[SB_RADAU_STAGES][SB_RADAU_MAX];
  double q[SB_RADAU_STAGES][SB_RADAU_POWERS];
} SbRadauStep;

typedef struct {
  long evaluations, newton_iterations, factorisations;
} SbRadauCounters;

// From (t, z) over h > 0. False if Newton's iteration did not converge (take a smaller h).
SB_CHECKED bool sb_radau_step(SbRadauStep *step, const SbRadauSystem *system, double t,
                              const double *z, double h, SbRadauCounters *counters);

// Two steps of h/2 and, against one of h, the scaled error of the pair (accept below 1). The pair
// is more accurate than that by about 31. False as above.
SB_CHECKED bool sb_radau_pair(SbRadauStep pair[2], double *error, double *local,
                              const SbRadauSystem *system, double t, const double *z, double h,
                              SbRadauCounters *counters);

// State z[n] at t + theta h, 0 <= theta <= 1, and the quadratures over (t, t + theta h); either may
// be NULL.
void sb_radau_dense(const SbRadauStep *step, const SbRadauSystem *system, double theta, double *z,
                    double *integral);
