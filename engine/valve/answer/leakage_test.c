// See leakage_test.h.
#include "engine/valve/answer/leakage_test.h"

#include "engine/numeric/sampling.h"
#include "engine/numeric/statistics.h"

#include <math.h>

static const double YEAR = 365 * 86400.0;
enum { PARTS = 10 };

// Where a test's cans come from.
typedef struct {
  const SbLeakageTest *test;
  const double *loss; // of the samples, or of a part of them
  size_t samples, stride, first;
  uint64_t seed;
  bool dealt;
  double mean, single, most; // limits [kg a year]
} Lot;

// The rate that is measured of can `i` of test `k`: its own and what two weighings add.
static double measured(const Lot *lot, size_t k, int i) {
  const SbLeakageTest *test = lot->test;
  const size_t each = (size_t)(test->containers + test->more);
  const uint32_t dimension = 2 * (uint32_t)i;
  const size_t at = lot->dealt
                        ? k * each + (size_t)i
                        : (size_t)(sb_random(lot->seed, k, dimension) * (double)lot->samples);
  const double noise = sb_normal_quantile(sb_random(lot->seed, k, dimension + 1));
  return lot->loss[lot->first + at * lot->stride] +
         noise * M_SQRT2 * test->balance * YEAR / test->duration;
}

static bool passes(const Lot *lot, size_t k, bool *second) {
  const SbLeakageTest *test = lot->test;
  double sum = 0;
  int beyond = 0;
  *second = false;
  for (int i = 0; i < test->containers; i++) {
    const double rate = measured(lot, k, i);
    if (rate > lot->most) {
      return false;
    }
    sum += rate;
    beyond += rate > lot->single;
  }
  if (beyond > test->beyond || sum > test->containers * lot->mean) {
    return false;
  }
  *second = beyond > 0;
  for (int i = 0; *second && i < test->more; i++) {
    const double rate = measured(lot, k, test->containers + i);
    if (rate > lot->most) {
      return false;
    }
    beyond += rate > lot->single;
  }
  return !*second || beyond <= test->beyond_all;
}

static void simulate(SbLeakageOdds *out, const Lot *lot, size_t tests) {
  *out = (SbLeakageOdds){.tests = tests, .dealt = lot->dealt};
  for (size_t k = 0; k < tests; k++) {
    bool second;
    out->passed += passes(lot, k, &second);
    out->second += second;
  }
  out->probability = (double)out->passed / (double)tests;
  sb_probability_interval(out->interval, out->passed, tests);
}

// Ten parts of the samples, each with a tenth of the tests: their scatter includes that of the
// samples. Student's factor 2.262 for nine degrees of freedom.
static void by_parts(SbLeakageOdds *out, const Lot *whole, size_t tests) {
  double value[PARTS], mean = 0, square = 0;
  SbLeakageOdds sum = {.tests = 0};
  for (size_t part = 0; part < PARTS; part++) {
    Lot lot = *whole;
    SbLeakageOdds of;
    lot.first = part;
    lot.stride = PARTS;
    lot.samples = (whole->samples - part + PARTS - 1) / PARTS;
    lot.seed = whole->seed + 1 + part;
    simulate(&of, &lot, (tests + PARTS - 1) / PARTS);
    sum.tests += of.tests;
    sum.passed += of.passed;
    sum.second += of.second;
    value[part] = of.probability;
    mean += of.probability / PARTS;
  }
  for (size_t part = 0; part < PARTS; part++) {
    square += (value[part] - mean) * (value[part] - mean) / (PARTS - 1);
  }
  const double half = 2.262 * sqrt(square / PARTS);
  *out = sum;
  out->probability = (double)sum.passed / (double)sum.tests;
  // Not less than the tests alone leave open.
  sb_probability_interval(out->interval, sum.passed, sum.tests);
  out->interval[0] = fmax(0, fmin(out->interval[0], out->probability - half));
  out->interval[1] = fmin(1, fmax(out->interval[1], out->probability + half));
}

static bool makes_sense(const SbLeakageTest *test, double fill) {
  return test->duration > 0 && test->balance >= 0 && test->containers > 0 && test->more >= 0 &&
         test->containers + test->more <= SB_LEAKAGE_CONTAINERS_MAX && fill > 0;
}

SbStatus sb_leakage_odds(SbLeakageOdds *out, const SbLeakageTest *test, const double *loss,
                         size_t samples, double fill, size_t tests, uint64_t seed,
                         SbReport *report) {
  if (samples < PARTS || tests < PARTS || !makes_sense(test, fill)) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "a leakage test requires at least %d cans and %d tests, and a can with a fill",
                   PARTS, PARTS);
  }
  const bool small = fill < test->small_fill;
  const Lot lot = {.test = test,
                   .loss = loss,
                   .samples = samples,
                   .stride = 1,
                   .seed = seed,
                   .dealt = samples / (size_t)(test->containers + test->more) >= tests,
                   .mean = small ? test->mean : test->mean_share * fill,
                   .single = small ? test->single : test->single_share * fill,
                   .most = small ? test->most : test->most_share * fill};
  if (lot.dealt) {
    simulate(out, &lot, tests);
  } else {
    by_parts(out, &lot, tests);
  }
  return sb_succeed(report);
}
