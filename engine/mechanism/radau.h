// Radau IIA of order 5 for small stiff systems, with quadratures, step doubling and dense output.
//
// Hairer and Wanner, Solving Ordinary Differential Equations II, IV.5 and IV.8 (3 stages,
// L-stable). sb_radau_pair() makes two half steps and estimates their error; the caller chooses the
// step size and locates events. Nothing is allocated; the functions have no state and may be called
// concurrently. Not supported: mass matrices, more than SB_RADAU_MAX unknowns.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>
#include <stddef.h>

// Largest number of unknowns, of quadratures, and the number of stages.
enum { SB_RADAU_MAX = 7, SB_RADAU_POWERS = 7, SB_RADAU_STAGES = 3 };

// Computes the rates dz[n] of the unknowns z[n] at time t and, unless `power` is NULL, the
// integrands power[powers] of quadratures; the rates must not depend on the quadratures. z and dz
// have SB_RADAU_MAX elements. `user` is SbRadauSystem.user.
typedef void (*SbRadauRates)(double *dz, double *power, double t, const double *z, void *user);

// A system and its tolerances.
typedef struct {
  size_t n;      // number of unknowns, <= SB_RADAU_MAX
  size_t powers; // number of quadratures, <= SB_RADAU_POWERS; 0: none
  SbRadauRates rates;
  void *user;                   // passed to `rates`
  double tolerance;             // relative, per step
  double floor[SB_RADAU_MAX];   // added to |z|: the error of z is scaled by tolerance (|z| + floor)
  double ceiling[SB_RADAU_MAX]; // upper limit of |z| + floor; 0: none
  double noise[SB_RADAU_MAX];   // rounding error of dz; 0: not known
  // Newton's iteration stops as soon as its updates are as small as `noise`, which exceeds the
  // tolerance. false: it stops there only where it does not converge further.
  bool noisy;
} SbRadauSystem;

// A completed step.
typedef struct {
  double t, h;                                // start and length [s]
  double z0[SB_RADAU_MAX], z1[SB_RADAU_MAX];  // unknowns at start and end
  double k[SB_RADAU_STAGES][SB_RADAU_MAX];    // rates at the stages
  double q[SB_RADAU_STAGES][SB_RADAU_POWERS]; // integrands at the stages
} SbRadauStep;

// Steps from (t, z[n]) over h > 0 in two steps of h/2, which are pair[0] and pair[1]. Compares them
// with one step of h: local[n] is the difference of each unknown divided by 31, *error the largest
// |local| divided by its tolerance. Accept the pair if *error < 1. Adds the number of Newton
// iterations to *iterations. Returns false if Newton's method did not converge: try a smaller h.
SB_CHECKED bool sb_radau_pair(SbRadauStep pair[2], double *error, double *local,
                              const SbRadauSystem *system, double t, const double *z, double h,
                              long *iterations);

// Computes from a completed step the unknowns z[n] at t + theta h and the quadratures
// integral[powers] over (t, t + theta h), 0 <= theta <= 1. `z` or `integral` may be NULL.
void sb_radau_dense(const SbRadauStep *step, const SbRadauSystem *system, double theta, double *z,
                    double *integral);
