// Pharmacopoeial leakage test of sealed cans, simulated for cans with known losses: probability
// that a lot passes. The function has no state.
//
// As in USP <604> (SB_LEAKAGE_TEST_INIT): weigh 12 containers, store them T hours (at least three
// days) at 25 degC, weigh again; the rate is 365 (24/T) (W1 - W2) per year. With a net fill below
// 15 g the mean of the 12 is at most 525 mg and none exceeds 750 mg; else 3.5 % and 5 % of the
// fill. If one exceeds 750 mg (5 %) and none 1.1 g (7 %), 24 more are tested: at most 2 of the 36
// exceed 750 mg and none 1.1 g. The mean of the first 12 applies in both cases. All numbers are
// data and may be changed.
#pragma once

#include "engine/base/status.h"

#include <stdint.h>

// The rules of a test.
typedef struct {
  char edition[96];     // source of the numbers
  double duration;      // storage time T between the weighings [s]
  double temperature;   // of the storage [K]; informative, not used by sb_leakage_odds()
  int containers, more; // number in the first stage; added in the second stage
  // Largest number of containers above `single` (single_share): in the first stage, with which a
  // second stage is allowed; in both stages together, with which the lot passes.
  int beyond, beyond_all;
  double small_fill; // net fill below which the limits are masses, else fractions [kg]
  // Limits of the mean, of one container, and of each container in any stage [kg per 365 days].
  double mean, single, most;
  // The same limits for larger fills [fraction of the fill per 365 days].
  double mean_share, single_share, most_share;
  double balance; // standard deviation of one weighing [kg]
} SbLeakageTest;

// The rules of USP <604>.
#define SB_LEAKAGE_TEST_INIT                                                                       \
  {                                                                                                \
    .edition = "USP <604> Leak Rate", .duration = 72 * 3600.0, .temperature = 298.15,              \
    .containers = 12, .more = 24, .beyond = 1, .beyond_all = 2, .small_fill = 15e-3,               \
    .mean = 525e-6, .single = 750e-6, .most = 1100e-6, .mean_share = 0.035, .single_share = 0.05,  \
    .most_share = 0.07, .balance = 0                                                               \
  }

// Largest number of containers of a test.
enum { SB_LEAKAGE_CONTAINERS_MAX = 1000 };

// Result of the simulation.
typedef struct {
  size_t tests, passed, second; // number of tests simulated; passed; with a second stage
  double probability;           // passed divided by tests
  double interval[2];           // lower and upper end of its 95 % confidence interval
  bool dealt;                   // each can is a different sample; false: drawn with replacement
} SbLeakageOdds;

// Simulates `tests` (>= 10) tests of cans with the losses loss[samples] (>= 10) [kg per 365 days]
// (INFINITY: open can) and the net fill `fill` [kg]. With at least tests (containers + more)
// samples each can is a different one and the interval is Clopper and Pearson's; else cans are
// drawn with replacement, the interval follows from ten subsets, and `tests` is rounded up to a
// multiple of ten. Equal seeds give equal results. SB_ERROR_RANGE: fewer than ten samples or tests,
// a fill that is not positive, or invalid rules (duration or containers not positive, more or
// balance negative, more than SB_LEAKAGE_CONTAINERS_MAX containers).
SbStatus sb_leakage_odds(SbLeakageOdds *out, const SbLeakageTest *test, const double *loss,
                         size_t samples, double fill, size_t tests, uint64_t seed,
                         SbReport *report);
