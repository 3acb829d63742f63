// Designs and distributions; see the header.
#include "engine/numeric/sampling.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_qrng.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint64_t mix(uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

double sb_random(uint64_t seed, uint64_t sample, uint32_t dimension) {
  const uint64_t bits = mix(mix(mix(seed) + sample) + dimension);
  return ((double)(bits >> 11) + 0.5) * 0x1p-53;
}

double sb_normal_share(double z) {
  return gsl_cdf_ugaussian_P(z);
}

double sb_normal_quantile(double p) {
  return gsl_cdf_ugaussian_Pinv(p);
}

// Of a normal variate truncated at l and h: the quantile at the fraction p of the probability in
// between, from the nearer tail, where differences of probabilities keep their digits.
static double cut_off(double l, double h, double p) {
  if (l > 0) {
    const double Ql = gsl_cdf_ugaussian_Q(l), Qh = isinf(h) ? 0 : gsl_cdf_ugaussian_Q(h);
    return gsl_cdf_ugaussian_Qinv(Ql - p * (Ql - Qh));
  }
  const double Pl = isinf(l) ? 0 : gsl_cdf_ugaussian_P(l);
  const double Ph = isinf(h) ? 1 : gsl_cdf_ugaussian_P(h);
  return gsl_cdf_ugaussian_Pinv(Pl + p * (Ph - Pl));
}

double sb_distribution_quantile(const SbDistribution *distribution, double p) {
  const double a = distribution->a, b = distribution->b;
  switch (distribution->kind) {
  case SB_DISTRIBUTION_UNIFORM:
    return a + (b - a) * p;
  case SB_DISTRIBUTION_LOGUNIFORM:
    return a * pow(b / a, p);
  case SB_DISTRIBUTION_NORMAL: {
    const double l = (distribution->low - a) / b, h = (distribution->high - a) / b;
    const double value = a + b * cut_off(l, h, p);
    return fmin(fmax(value, distribution->low), distribution->high);
  }
  case SB_DISTRIBUTION_LEVELS: {
    const size_t at = (size_t)(p * (double)distribution->count);
    return distribution->level[at < distribution->count ? at : distribution->count - 1];
  }
  }
  return NAN;
}

// The same distribution seen from its upper end.
static SbDistribution mirrored(const SbDistribution *of) {
  SbDistribution other = *of;
  if (of->kind == SB_DISTRIBUTION_NORMAL) {
    other.a = -of->a;
    other.low = -of->high;
    other.high = -of->low;
  } else {
    other.a = of->b;
    other.b = of->a;
  }
  return other;
}

double sb_distribution_at_normal(const SbDistribution *of, double z) {
  if (of->kind == SB_DISTRIBUTION_NORMAL && isinf(of->low) && isinf(of->high)) {
    return of->a + of->b * z;
  }
  // From the nearer end, where probabilities keep their digits.
  if (z <= 0 || of->kind == SB_DISTRIBUTION_LEVELS) {
    return sb_distribution_quantile(of, gsl_cdf_ugaussian_P(z));
  }
  const SbDistribution other = mirrored(of);
  const double value = sb_distribution_quantile(&other, gsl_cdf_ugaussian_Q(z));
  return of->kind == SB_DISTRIBUTION_NORMAL ? -value : value;
}

double sb_distribution_slope(const SbDistribution *of, double z) {
  const double density = exp(-z * z / 2) / sqrt(2 * M_PI);
  switch (of->kind) {
  case SB_DISTRIBUTION_UNIFORM:
    return (of->b - of->a) * density;
  case SB_DISTRIBUTION_LOGUNIFORM:
    return sb_distribution_at_normal(of, z) * log(of->b / of->a) * density;
  case SB_DISTRIBUTION_NORMAL: {
    if (isinf(of->low) && isinf(of->high)) {
      return of->b;
    }
    const double l = (of->low - of->a) / of->b, h = (of->high - of->a) / of->b;
    const double share = l > 0 ? gsl_cdf_ugaussian_Q(l) - gsl_cdf_ugaussian_Q(h)
                               : gsl_cdf_ugaussian_P(h) - gsl_cdf_ugaussian_P(l);
    const double t = (sb_distribution_at_normal(of, z) - of->a) / of->b;
    return of->b * share * exp((t * t - z * z) / 2);
  }
  case SB_DISTRIBUTION_LEVELS:
    break;
  }
  return 0;
}

double sb_distribution_grid(const SbDistribution *distribution, size_t index) {
  if (distribution->kind == SB_DISTRIBUTION_LEVELS) {
    return distribution->level[index];
  }
  const size_t last = distribution->count - 1;
  // The ends exactly.
  return index == 0      ? distribution->a
         : index == last ? distribution->b
                         : sb_distribution_quantile(distribution, (double)index / (double)last);
}

void sb_sample_random(double *point, size_t samples, size_t dimensions, uint64_t seed) {
  for (size_t i = 0; i < samples; i++) {
    for (size_t k = 0; k < dimensions; k++) {
      point[i * dimensions + k] = sb_random(seed, i, (uint32_t)k);
    }
  }
}

SbStatus sb_sample_sobol(double *point, size_t samples, size_t dimensions, uint64_t seed,
                         SbReport *report) {
  if (dimensions == 0 || dimensions > SB_SOBOL_DIMENSIONS) {
    return sb_fail(report, SB_ERROR_RANGE, "a Sobol sequence has 1 to %d parameters, not %zu",
                   SB_SOBOL_DIMENSIONS, dimensions);
  }
  gsl_qrng *sequence = gsl_qrng_alloc(gsl_qrng_sobol, (unsigned)dimensions);
  if (sequence == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a Sobol sequence");
  }
  // GSL has 30 digits; the shift preserves their uniformity.
  enum { DIGITS = 30 };
  for (size_t i = 0; i < samples; i++) {
    double *row = point + i * dimensions;
    gsl_qrng_get(sequence, row);
    for (size_t k = 0; k < dimensions; k++) {
      const uint64_t shift = (uint64_t)(sb_random(seed, UINT64_MAX, (uint32_t)k) * (1 << DIGITS));
      const uint64_t digits = (uint64_t)(row[k] * (1 << DIGITS)) ^ shift;
      row[k] = ((double)digits + 0.5) / (1 << DIGITS);
    }
  }
  gsl_qrng_free(sequence);
  return sb_succeed(report);
}

void sb_sample_morris(double *point, size_t samples, size_t dimensions, uint64_t seed) {
  const size_t length = dimensions + 1;
  for (size_t i = 0; i < samples; i++) {
    const size_t trajectory = i / length, place = i % length;
    double *row = point + i * dimensions;
    if (place == 0) {
      for (size_t k = 0; k < dimensions; k++) {
        row[k] = (floor(4 * sb_random(seed, trajectory, (uint32_t)k)) + 0.5) / 4;
      }
      continue;
    }
    memcpy(row, row - dimensions, dimensions * sizeof *row);
    // The coordinate that moves: the one whose random rank is `place`.
    size_t moves = 0;
    for (size_t k = 0; k < dimensions; k++) {
      const double own = sb_random(seed + 1, trajectory, (uint32_t)k);
      size_t rank = 1;
      for (size_t j = 0; j < dimensions; j++) {
        const double other = sb_random(seed + 1, trajectory, (uint32_t)j);
        rank += other < own || (other == own && j < k);
      }
      moves = rank == place ? k : moves;
    }
    row[moves] += row[moves] < 0.5 ? SB_MORRIS_STEP : -SB_MORRIS_STEP;
  }
}

SbStatus sb_sample_saltelli(double *point, size_t base, size_t dimensions, uint64_t seed,
                            SbReport *report) {
  const size_t twice = 2 * dimensions;
  double *both = malloc(base * twice * sizeof *both);
  if (both == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for %zu points", base);
  }
  SbStatus status = SB_OK;
  if (twice <= SB_SOBOL_DIMENSIONS) {
    status = sb_sample_sobol(both, base, twice, seed, report);
  } else {
    sb_sample_random(both, base, twice, seed);
  }
  for (size_t block = 0; status == SB_OK && block < dimensions + 2; block++) {
    for (size_t i = 0; i < base; i++) {
      double *row = point + (block * base + i) * dimensions;
      memcpy(row, both + i * twice + (block == 1 ? dimensions : 0), dimensions * sizeof *row);
      if (block >= 2) {
        row[block - 2] = both[i * twice + dimensions + block - 2];
      }
    }
  }
  free(both);
  return status == SB_OK ? sb_succeed(report) : status;
}
