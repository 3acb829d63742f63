// Lays out the points of a study's method; see study_file.h.
#include "app/document/study_file_private.h"

#include <stdlib.h>

static void fill_grid(double *value, const SbStudyFile *study) {
  const size_t n = study->vary->len;
  for (size_t i = 0; i < study->samples; i++) {
    // The last parameter runs fastest.
    size_t rest = i;
    for (size_t k = n; k-- > 0;) {
      const SbDistribution *of = &g_array_index(study->vary, SbVary, k).distribution;
      value[i * n + k] = sb_distribution_grid(of, rest % of->count);
      rest /= of->count;
    }
  }
}

void sb_study_file_place(double *value, double *slope, const SbStudyFile *study, const double *u) {
  const size_t n = study->vary->len;
  for (size_t k = 0; k < n; k++) {
    const SbDistribution *of = &g_array_index(study->vary, SbVary, k).distribution;
    double variate = study->root == NULL ? u[k] : 0;
    for (size_t j = 0; study->root != NULL && j <= k; j++) {
      variate += study->root[k * n + j] * u[j];
    }
    value[k] = sb_distribution_at_normal(of, variate);
    for (size_t j = 0; slope != NULL && j < n; j++) {
      const double root = study->root != NULL ? study->root[k * n + j] : j == k;
      slope[k * n + j] = j <= k ? root * sb_distribution_slope(of, variate) : 0;
    }
  }
}

// Turns a point of the unit cube into values.
static void place(double *value, const double *unit, const SbStudyFile *study) {
  const size_t n = study->vary->len;
  double z[SB_VARY_MAX];
  for (size_t k = 0; k < n; k++) {
    const SbDistribution *of = &g_array_index(study->vary, SbVary, k).distribution;
    if (study->root == NULL) {
      value[k] = sb_distribution_quantile(of, unit[k]);
    } else {
      z[k] = sb_normal_quantile(unit[k]);
    }
  }
  if (study->root != NULL) {
    sb_study_file_place(value, NULL, study, z);
  }
}

SbStatus sb_study_file_points(double **value, double **unit, const SbStudyFile *study,
                              SbReport *report) {
  const size_t n = study->vary->len, samples = study->samples;
  double *values = calloc(samples * n + 1, sizeof *values);
  double *points = calloc(samples * n + 1, sizeof *points);
  SbStatus status = values != NULL && points != NULL
                        ? SB_OK
                        : sb_fail(report, SB_ERROR_MEMORY, "no memory for %zu samples", samples);
  if (status == SB_OK) {
    switch (study->method) {
    case SB_METHOD_GRID:
      (study->lines != NULL ? sb_study_grid_fill : fill_grid)(values, study);
      break;
    case SB_METHOD_SOBOL_SEQUENCE:
      status = sb_sample_sobol(points, samples, n, study->seed, report);
      break;
    case SB_METHOD_MORRIS:
      sb_sample_morris(points, samples, n, study->seed);
      break;
    case SB_METHOD_SOBOL_INDICES:
      status = sb_sample_saltelli(points, samples / (n + 2), n, study->seed, report);
      break;
    default:
      sb_sample_random(points, samples, n, study->seed);
    }
  }
  for (size_t i = 0; status == SB_OK && study->method != SB_METHOD_GRID && i < samples; i++) {
    place(values + i * n, points + i * n, study);
  }
  if (status != SB_OK || unit == NULL) {
    free(points);
    points = NULL;
  }
  if (status != SB_OK) {
    free(values);
    values = NULL;
  }
  *value = values;
  if (unit != NULL) {
    *unit = points;
  }
  return status;
}
