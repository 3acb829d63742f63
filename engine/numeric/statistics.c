// Estimates from samples; see the header.
#include "engine/numeric/statistics.h"

#include "engine/numeric/sampling.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const double sb_quantile_shares[SB_QUANTILES] = {0.001, 0.05, 0.5, 0.95, 0.999};

static int ascending(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

// Of sorted values, Hyndman and Fan's definition 7 (1996).
static double quantile(const double *sorted, size_t count, double share) {
  const double at = share * (double)(count - 1), below = floor(at);
  const size_t i = (size_t)below;
  return i + 1 < count ? sorted[i] + (at - below) * (sorted[i + 1] - sorted[i]) : sorted[count - 1];
}

bool sb_samples_vary(const double *value, size_t count, size_t stride) {
  const double rounding = 1e-12;
  double least = INFINITY, most = -INFINITY;
  for (size_t i = 0; i < count; i++) {
    const double v = value[i * stride];
    if (!isnan(v)) {
      least = fmin(least, v);
      most = fmax(most, v);
    }
  }
  return most - least > rounding * fmax(fabs(least), fabs(most));
}

SbStatus sb_samples_summary(SbSummaryOfSamples *out, const double *value, size_t count,
                            size_t stride, SbReport *report) {
  *out = (SbSummaryOfSamples){.mean = NAN, .deviation = NAN, .min = NAN, .max = NAN};
  for (int q = 0; q < SB_QUANTILES; q++) {
    out->quantile[q] = NAN;
  }
  double *sorted = malloc((count + 1) * sizeof *sorted);
  if (sorted == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for %zu samples", count);
  }
  size_t n = 0;
  for (size_t i = 0; i < count; i++) {
    const double v = value[i * stride];
    if (!isnan(v)) {
      sorted[n++] = v;
    }
  }
  out->count = n;
  if (n > 0) {
    // Sums in rising order: the same for the same set, in whatever order it came.
    qsort(sorted, n, sizeof *sorted, ascending);
    double sum = 0, squares = 0;
    for (size_t i = 0; i < n; i++) {
      sum += sorted[i];
    }
    out->mean = sum / (double)n;
    for (size_t i = 0; i < n; i++) {
      squares += (sorted[i] - out->mean) * (sorted[i] - out->mean);
    }
    out->min = sorted[0];
    out->max = sorted[n - 1];
    out->varies = sb_samples_vary(sorted, n, 1);
    // The sums round, too.
    out->mean = out->varies ? fmin(fmax(out->mean, out->min), out->max) : sorted[n / 2];
    out->deviation = n < 2 ? NAN : out->varies ? sqrt(squares / (double)(n - 1)) : 0;
    for (int q = 0; q < SB_QUANTILES; q++) {
      out->quantile[q] = quantile(sorted, n, sb_quantile_shares[q]);
    }
  }
  free(sorted);
  return sb_succeed(report);
}

void sb_probability_interval(double interval[2], size_t seen, size_t count) {
  const double k = (double)seen, n = (double)count;
  interval[0] = seen == 0 ? 0 : gsl_cdf_beta_Pinv(0.025, k, n - k + 1);
  interval[1] = seen >= count ? 1 : gsl_cdf_beta_Pinv(0.975, k + 1, n - k);
}

// First and total index of one parameter from chosen rows of its three blocks.
static void estimate(double out[2], const double *A, const double *B, const double *AB,
                     const size_t *row, size_t count) {
  double mean = 0, square = 0, alone = 0, all = 0;
  for (size_t i = 0; i < count; i++) {
    const double a = A[row[i]], b = B[row[i]];
    mean += (a + b) / (2 * (double)count);
  }
  for (size_t i = 0; i < count; i++) {
    const double a = A[row[i]] - mean, b = B[row[i]] - mean, ab = AB[row[i]] - mean;
    square += (a * a + b * b) / 2;
    alone += b * (ab - a);
    all += (a - ab) * (a - ab) / 2;
  }
  out[0] = square > 0 ? alone / square : NAN;
  out[1] = square > 0 ? all / square : NAN;
}

SbStatus sb_sobol_indices(SbIndex *first, SbIndex *total, const double *value, size_t base,
                          size_t dimensions, uint64_t seed, SbReport *report) {
  enum { RESAMPLES = 400 };
  size_t *row = malloc(2 * (base + 1) * sizeof *row);
  double *again = malloc(2 * RESAMPLES * sizeof *again);
  if (row == NULL || again == NULL) {
    free(row);
    free(again);
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the indices of %zu points", base);
  }
  size_t count = 0, *drawn = row + base + 1;
  for (size_t i = 0; i < base; i++) {
    bool whole = true;
    for (size_t block = 0; block < dimensions + 2; block++) {
      whole &= isfinite(value[block * base + i]);
    }
    if (whole) {
      row[count++] = i;
    }
  }
  const bool varies = sb_samples_vary(value, base * (dimensions + 2), 1);
  for (size_t k = 0; k < dimensions && count > 1 && !varies; k++) {
    first[k] = total[k] = (SbIndex){0, 0, 0};
  }
  for (size_t k = 0; k < dimensions && (count < 2 || varies); k++) {
    const double *AB = value + (k + 2) * base;
    double here[2] = {NAN, NAN};
    if (count > 1) {
      estimate(here, value, value + base, AB, row, count);
    }
    for (uint32_t r = 0; count > 1 && r < RESAMPLES; r++) {
      double other[2];
      for (size_t i = 0; i < count; i++) {
        drawn[i] = row[(size_t)(sb_random(seed, r, (uint32_t)i) * (double)count)];
      }
      estimate(other, value, value + base, AB, drawn, count);
      again[r] = other[0];
      again[RESAMPLES + r] = other[1];
    }
    SbIndex *const index[] = {&first[k], &total[k]};
    for (int which = 0; which < 2; which++) {
      *index[which] = (SbIndex){here[which], NAN, NAN};
      if (isfinite(here[which])) {
        double *sorted = again + which * RESAMPLES;
        qsort(sorted, RESAMPLES, sizeof *sorted, ascending);
        index[which]->low = quantile(sorted, RESAMPLES, 0.025);
        index[which]->high = quantile(sorted, RESAMPLES, 0.975);
      }
    }
  }
  free(row);
  free(again);
  return sb_succeed(report);
}

void sb_morris_effects(SbElementaryEffects *out, const double *value, const double *point,
                       size_t samples, size_t dimensions) {
  memset(out, 0, dimensions * sizeof *out);
  const bool varies = sb_samples_vary(value, samples, 1);
  // Welford's running mean and sum of squares, the latter in `deviation` until the end.
  for (size_t i = 0; i + 1 < samples; i++) {
    if ((i + 1) % (dimensions + 1) == 0) {
      continue; // the last of its trajectory
    }
    const double *from = point + i * dimensions, *to = from + dimensions;
    const double change = (value[i + 1] - value[i]) * (varies ? 1 : 0);
    for (size_t k = 0; k < dimensions && isfinite(change); k++) {
      if (to[k] != from[k]) {
        SbElementaryEffects *of = &out[k];
        const double effect = change / (to[k] - from[k]), n = (double)++of->count;
        const double off = effect - of->mean;
        of->mean += off / n;
        of->deviation += off * (effect - of->mean);
        of->magnitude += (fabs(effect) - of->magnitude) / n;
      }
    }
  }
  for (size_t k = 0; k < dimensions; k++) {
    const double n = (double)out[k].count;
    out[k].deviation = n > 1 ? sqrt(out[k].deviation / (n - 1)) : NAN;
    if (n < 1) {
      out[k].mean = out[k].magnitude = NAN;
    }
  }
}
