// Statistics of samples: moments, quantiles, confidence intervals, sensitivity indices.
//
// NaN means a missing value; missing values are ignored unless stated otherwise. The functions have
// no state and may be called concurrently.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Number of quantiles of a summary.
enum { SB_QUANTILES = 5 };

// Probabilities of these quantiles: 0.001, 0.05, 0.5, 0.95, 0.999.
extern const double sb_quantile_shares[SB_QUANTILES];

// Returns whether the values value[0], value[stride], ..., value[(count - 1) stride] differ by more
// than rounding, 1e-12 of their largest magnitude. False for fewer than two numbers.
bool sb_samples_vary(const double *value, size_t count, size_t stride);

// Summary of a sample, in the unit of its values.
typedef struct {
  size_t count;     // number of values that are not NaN
  bool varies;      // result of sb_samples_vary()
  double mean;      // NaN if `count` is 0, as are `min`, `max` and `quantile`
  double deviation; // standard deviation (n - 1); NaN if `count` < 2; 0 if the values do not vary
  double min, max;
  double quantile[SB_QUANTILES]; // at sb_quantile_shares, interpolated linearly (type 7)
} SbSummaryOfSamples;

// Computes the summary of value[0], value[stride], ..., value[(count - 1) stride]. The result does
// not depend on the order of the values. SB_ERROR_MEMORY is its only error.
SbStatus sb_samples_summary(SbSummaryOfSamples *out, const double *value, size_t count,
                            size_t stride, SbReport *report);

// Writes the 95 % interval of Clopper and Pearson for a probability (lower end, upper end), after
// `seen` events in `count` trials; 0 and 1 if `count` is 0.
void sb_probability_interval(double interval[2], size_t seen, size_t count);

// A sensitivity index, and its 95 % interval by bootstrap.
typedef struct {
  double value, low, high; // NaN: not defined
} SbIndex;

// Computes Sobol's indices of each parameter: first[dimensions], the fraction of the variance due
// to the parameter alone (Saltelli et al. 2010), and total[dimensions], the fraction including all
// interactions (Jansen 1999). value[base (dimensions + 2)] are the results of the rows of
// sb_sample_saltelli(). A row of A is ignored if it or one of its dimensions + 1 partners is
// missing. All indices are NaN if fewer than two rows remain, and 0 with the interval [0, 0] if the
// values do not vary. `seed` is that of the bootstrap. SB_ERROR_MEMORY is its only error.
SbStatus sb_sobol_indices(SbIndex *first, SbIndex *total, const double *value, size_t base,
                          size_t dimensions, uint64_t seed, SbReport *report);

// Elementary effects of one parameter: the changes of the value divided by the change
// +-SB_MORRIS_STEP of the coordinate.
typedef struct {
  size_t count;     // number of effects
  double mean;      // NaN if `count` is 0
  double magnitude; // mean of the magnitudes; NaN if `count` is 0
  double deviation; // standard deviation (n - 1); NaN if `count` < 2
} SbElementaryEffects;

// Computes the elementary effects out[dimensions] of the parameters. point[samples][dimensions] is
// the design of sb_sample_morris(), value[samples] has its results. A step with a missing value is
// ignored. If the values do not vary, all effects are 0.
void sb_morris_effects(SbElementaryEffects *out, const double *value, const double *point,
                       size_t samples, size_t dimensions);
