// What samples say: moments, quantiles, probabilities with their intervals, indices of sensitivity.
//
// Values that are NaN are left out where nothing else is said.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SB_QUANTILES = 5 };
extern const double sb_quantile_shares[SB_QUANTILES]; // 0.001, 0.05, 0.5, 0.95, 0.999

// Whether values differ by more than rounding: 1e-12 of the largest magnitude, a thousand times
// what a run's figures that do not depend on a parameter differ by. False for fewer than two
// numbers.
bool sb_samples_vary(const double *value, size_t count, size_t stride);

typedef struct {
  size_t count; // of numbers
  bool varies;  // sb_samples_vary(); if false the deviation of two and more numbers is 0
  // NaN without any; the deviation of fewer than two. The mean is from min to max.
  double mean, deviation, min, max;
  double quantile[SB_QUANTILES]; // between the two nearest samples, linearly
} SbSummaryOfSamples;

// Of value[i * stride]. SB_ERROR_MEMORY.
SbStatus sb_samples_summary(SbSummaryOfSamples *out, const double *value, size_t count,
                            size_t stride, SbReport *report);

// Clopper and Pearson's interval of 95 % for the probability of which `count` trials saw `seen`.
void sb_probability_interval(double interval[2], size_t seen, size_t count);

// An index of sensitivity with its interval of 95 % by resampling.
typedef struct {
  double value, low, high;
} SbIndex;

// Shares of the variance that a parameter has alone, and with all others, of the values of
// Saltelli's design (sampling.h): Saltelli et al. (2010) for the first, Jansen (1999) for the
// total. Rows of which a value is missing are left out; NaN for fewer than two rows; 0 with an
// interval from 0 to 0 for values that do not vary.
// SB_ERROR_MEMORY.
SbStatus sb_sobol_indices(SbIndex *first, SbIndex *total, const double *value, size_t base,
                          size_t dimensions, uint64_t seed, SbReport *report);

// Morris' measures of one parameter: mean, mean magnitude and deviation of the elementary effects,
// each a change of the value over SB_MORRIS_STEP of the parameter's range of probability.
typedef struct {
  size_t count;
  double mean, magnitude, deviation;
} SbElementaryEffects;

// `point` is that of the design, value[samples] its values. Values that do not vary have the
// effects 0.
void sb_morris_effects(SbElementaryEffects *out, const double *value, const double *point,
                       size_t samples, size_t dimensions);
