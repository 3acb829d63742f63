// A leakage test of sealed cans as a pharmacopoeia writes it, simulated on cans whose losses are
// known: what is the probability that a lot passes?
//
// As written in USP <604> (SB_LEAKAGE_TEST_INIT): weigh 12 containers, let them stand T hours, at
// least three days, at 25 degC, weigh them again; a container's rate is 365 (24/T) (W1 - W2) a
// year. With a net fill below 15 g the mean of the 12 is at most 525 mg and none is above 750 mg;
// else 3.5 % and 5 % of the fill. If one of them is above 750 mg (5 %) and none above 1.1 g (7 %),
// 24 more are tested: at most 2 of the 36 are above 750 mg and none above 1.1 g. The mean of the
// first 12 is asked for in either case. All of it is data and may be changed.
#pragma once

#include "engine/base/status.h"

#include <stdint.h>

typedef struct {
  char edition[96];          // where the numbers below come from
  double duration;           // T [s]
  double temperature;        // [K]
  int containers, more;      // of the first stage, and those added
  int beyond, beyond_all;    // above `single`: of the first for a second stage; of all that pass
  double small_fill;         // net fill below which rates count by mass [kg]
  double mean, single, most; // [kg a year of 365 days]
  double mean_share, single_share, most_share; // [of the fill a year]
  double balance;                              // standard deviation of one weighing [kg]
} SbLeakageTest;

#define SB_LEAKAGE_TEST_INIT                                                                       \
  {                                                                                                \
    .edition = "USP <604> Leak Rate", .duration = 72 * 3600.0, .temperature = 298.15,              \
    .containers = 12, .more = 24, .beyond = 1, .beyond_all = 2, .small_fill = 15e-3,               \
    .mean = 525e-6, .single = 750e-6, .most = 1100e-6, .mean_share = 0.035, .single_share = 0.05,  \
    .most_share = 0.07, .balance = 0                                                               \
  }

enum { SB_LEAKAGE_CONTAINERS_MAX = 1000 };

typedef struct {
  size_t tests, passed, second; // simulated; passed; that went to the second stage
  double probability;           // to pass
  double interval[2];           // of 95 %
  bool dealt;                   // every can was another sample; else drawn from them again
} SbLeakageOdds;

// Simulates `tests` tests of cans that lose loss[i] [kg a year], INFINITY for one that is open,
// with a net fill [kg]. Where there are enough samples each can is another one and the interval
// Clopper and Pearson's; else cans are drawn from the samples with replacement, and the interval
// comes from ten parts of them, each with tests of its own. Equal seeds give equal answers.
// SB_ERROR_RANGE: fewer than ten samples or tests, or a test that makes no sense.
SbStatus sb_leakage_odds(SbLeakageOdds *out, const SbLeakageTest *test, const double *loss,
                         size_t samples, double fill, size_t tests, uint64_t seed,
                         SbReport *report);
