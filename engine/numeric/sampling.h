// Where a study looks: distributions of parameters, and the points of its designs.
//
// Random numbers are functions of seed, sample and dimension (a counter goes through SplitMix64's
// finaliser, Steele, Lea and Flood 2014), so that a sample does not depend on which others were
// drawn. Points lie in the open unit cube; a distribution's quantile turns them into values.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// In (0, 1), with 53 bits.
double sb_random(uint64_t seed, uint64_t sample, uint32_t dimension);

typedef enum {
  SB_DISTRIBUTION_UNIFORM,    // a .. b
  SB_DISTRIBUTION_LOGUNIFORM, // a .. b, 0 < a: uniform in the logarithm
  SB_DISTRIBUTION_NORMAL,     // mean a, deviation b, cut off at low and high
  SB_DISTRIBUTION_LEVELS      // one of `count` values, each as likely
} SbDistributionKind;

typedef struct {
  SbDistributionKind kind;
  double a, b, low, high; // low, high of a normal one: -+INFINITY where it is not cut off
  const double *level;    // [count], borrowed
  size_t count;           // levels; of the other kinds, how many points a grid takes (0: not said)
} SbDistribution;

// Value below which the share `p` of (0, 1) lies.
double sb_distribution_quantile(const SbDistribution *distribution, double p);

// The same at a standard normal variate, exact far out in both tails.
double sb_distribution_at_normal(const SbDistribution *distribution, double z);

// Derivative of that by the variate; 0 of levels, which are constant between their steps.
double sb_distribution_slope(const SbDistribution *distribution, double z);

// Place `index` of a grid's `count` points.
double sb_distribution_grid(const SbDistribution *distribution, size_t index);

// Standard normal distribution function, and its inverse.
double sb_normal_share(double z);
double sb_normal_quantile(double p);

// `point` is [samples][dimensions] in all of these; SB_ERROR_MEMORY.
void sb_sample_random(double *point, size_t samples, size_t dimensions, uint64_t seed);

// Sobol's low-discrepancy sequence (GSL's, directions of Bratley and Fox 1988), its digits shifted
// by the seed. At most SB_SOBOL_DIMENSIONS dimensions, SB_ERROR_RANGE.
enum { SB_SOBOL_DIMENSIONS = 40 };
SbStatus sb_sample_sobol(double *point, size_t samples, size_t dimensions, uint64_t seed,
                         SbReport *report);

// Morris' trajectories (1991): `samples` / (dimensions + 1) of them, each of dimensions + 1 points
// that differ in one coordinate by half the range between levels 1/8, 3/8, 5/8 and 7/8.
#define SB_MORRIS_STEP 0.5
void sb_sample_morris(double *point, size_t samples, size_t dimensions, uint64_t seed);

// Saltelli's design: of `base` points A and B of a Sobol sequence in twice the dimensions (random
// ones beyond SB_SOBOL_DIMENSIONS), rows A, then B, then for each dimension A with that of B:
// base (dimensions + 2) points.
SbStatus sb_sample_saltelli(double *point, size_t base, size_t dimensions, uint64_t seed,
                            SbReport *report);
