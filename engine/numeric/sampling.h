// Distributions of study parameters, and sampling designs.
//
// Random numbers are functions of seed, sample and dimension (SplitMix64's finaliser, Steele, Lea
// and Flood 2014). A sample does not depend on which other samples were drawn. Points of designs
// are in the open unit cube; the quantile function of a distribution converts a coordinate into a
// value. The functions have no state and may be called concurrently.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Returns a random number in the open interval (0, 1), with 53 bits. Equal arguments give equal
// numbers.
double sb_random(uint64_t seed, uint64_t sample, uint32_t dimension);

// Type of a distribution.
typedef enum {
  SB_DISTRIBUTION_UNIFORM,    // uniform in [a, b]
  SB_DISTRIBUTION_LOGUNIFORM, // logarithm uniform, in [a, b], 0 < a
  SB_DISTRIBUTION_NORMAL,     // mean a, standard deviation b > 0, truncated to [low, high]
  SB_DISTRIBUTION_LEVELS      // one of `count` values with equal probability
} SbDistributionKind;

// A distribution. a, b, low, high and levels have the unit of the parameter.
typedef struct {
  SbDistributionKind kind;
  double a, b;         // see SbDistributionKind; not used by LEVELS
  double low, high;    // NORMAL: ends of the range, -INFINITY and INFINITY: not truncated
  const double *level; // LEVELS: [count], borrowed
  size_t count;        // number of levels; for the other kinds, points of a grid (0: not given)
} SbDistribution;

// Returns the quantile: the value below which the fraction `p` of the probability is, 0 < p < 1.
// For LEVELS it is level[i] with i = p count, rounded down.
double sb_distribution_quantile(const SbDistribution *distribution, double p);

// Returns the quantile at p = Phi(z), z a standard normal variate. Accurate in both tails, where
// Phi(z) rounds to 0 or 1.
double sb_distribution_at_normal(const SbDistribution *distribution, double z);

// Returns the derivative of sb_distribution_at_normal() with respect to z, in the unit of the
// parameter; 0 for LEVELS.
double sb_distribution_slope(const SbDistribution *distribution, double z);

// Returns point `index` (from 0) of a grid of distribution->count points: level[index] for LEVELS;
// for UNIFORM and LOGUNIFORM (count >= 2) equal steps of probability from a to b, both included.
// Not defined for NORMAL.
double sb_distribution_grid(const SbDistribution *distribution, size_t index);

// Returns the standard normal distribution function Phi(z).
double sb_normal_share(double z);

// Returns the inverse of Phi: z with Phi(z) = p, 0 < p < 1.
double sb_normal_quantile(double p);

// Writes independent random points to point[samples][dimensions].
void sb_sample_random(double *point, size_t samples, size_t dimensions, uint64_t seed);

// Largest number of dimensions of sb_sample_sobol().
enum { SB_SOBOL_DIMENSIONS = 40 };

// Writes the first points of Sobol's low-discrepancy sequence to point[samples][dimensions] (GSL,
// directions of Bratley and Fox 1988). Its binary digits are shifted by random digits of `seed`.
// SB_ERROR_RANGE: `dimensions` is not 1 to SB_SOBOL_DIMENSIONS.
SbStatus sb_sample_sobol(double *point, size_t samples, size_t dimensions, uint64_t seed,
                         SbReport *report);

// Change of the one coordinate that differs between successive points of a Morris trajectory.
#define SB_MORRIS_STEP 0.5

// Writes Morris' trajectories (1991) to point[samples][dimensions]. Each trajectory has dimensions
// + 1 successive points; successive points differ in one coordinate by +-SB_MORRIS_STEP, between
// the levels 1/8, 3/8, 5/8 and 7/8. `samples` is a multiple of dimensions + 1.
void sb_sample_morris(double *point, size_t samples, size_t dimensions, uint64_t seed);

// Writes Saltelli's design to point[base (dimensions + 2)][dimensions]: `base` rows A, `base` rows
// B, then for each dimension k the rows A with coordinate k of B. A and B are the two halves of a
// Sobol sequence in 2 dimensions (of random points if that exceeds SB_SOBOL_DIMENSIONS). Input of
// sb_sobol_indices(). SB_ERROR_MEMORY is its only error.
SbStatus sb_sample_saltelli(double *point, size_t base, size_t dimensions, uint64_t seed,
                            SbReport *report);
