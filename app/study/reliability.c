// Searches and points of the method `reliability`; see the header.
#include "app/study/reliability.h"

#include "app/study/slopes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- One search ----

typedef struct {
  const SbStudyFile *study;
  SbReliability *out;
  bool (*cancelled)(void *data);
  void *data;
} Searches;

typedef struct {
  const Searches *all;
  const SbFailureMode *mode;
  SbEvaluator *evaluator;
  SbReport *report;
  double *by; // [vary][vary], slopes of values by variates
} Search;

// How far the limit's figure is on its good side, and how that changes with the variates.
static SbStatus limit_state(double *value, double *gradient, const double *u, void *data) {
  const Search *search = data;
  const SbStudyFile *study = search->all->study;
  const SbLimit *limit = &study->limits.item[search->mode->limit];
  const size_t n = study->vary->len;
  SbParamId parameter[SB_VARY_MAX];
  double x[SB_VARY_MAX], slope[SB_VARY_MAX];
  bool fixed[SB_VARY_MAX];
  sb_study_file_place(x, search->by, study, u);
  for (size_t k = 0; k < n; k++) {
    const SbVary *vary = &g_array_index(study->vary, SbVary, k);
    parameter[k] = vary->id;
    fixed[k] = vary->distribution.kind == SB_DISTRIBUTION_LEVELS;
  }
  const SbSlopesAsked asked = {.base = study->base,
                               .parameter = parameter,
                               .fixed = fixed,
                               .parameters = n,
                               .figure = &limit->figure,
                               .figures = 1,
                               .cancelled = search->all->cancelled,
                               .data = search->all->data};
  double figure = NAN;
  const SbStatus status = sb_slopes(&figure, slope, search->evaluator, &asked, x, search->report);
  const double sign = search->mode->upper ? -1 : 1;
  *value = sign * (figure - (search->mode->upper ? limit->high : limit->low));
  for (size_t j = 0; j < n; j++) {
    gradient[j] = 0;
    for (size_t k = 0; k < n; k++) {
      // What the variate does not move has no slope by it, known or not.
      gradient[j] += search->by[k * n + j] != 0 ? sign * slope[k] * search->by[k * n + j] : 0;
    }
  }
  return status;
}

static SbStatus search_one(void *data, SbEvaluator *evaluator, size_t index, SbReport *report) {
  const Searches *all = data;
  SbFailureMode *mode = &all->out->mode[index];
  const size_t n = all->study->vary->len;
  double *by = malloc((n * n + 1) * sizeof *by);
  if (by == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the slopes of %zu values", n);
  }
  Search search = {all, mode, evaluator, report, by};
  // To a thousandth of a deviation: the samples do not need more.
  const SbStatus status =
      sb_failure_point(&mode->found, mode->u, n, limit_state, &search, 1e-3, report);
  sb_study_file_place(mode->value, NULL, all->study, mode->u);
  free(by);
  return status;
}

// ---- All ----

SbStatus sb_reliability_search(SbReliability *out, const SbStudyFile *study, int jobs,
                               bool (*cancelled)(void *data), void *data, SbReport *report) {
  const size_t n = study->vary->len, most = 2 * study->limits.count;
  *out = (SbReliability){.mode = calloc(most + 1, sizeof *out->mode),
                         .memory = calloc(3 * n * most + 1, sizeof *out->memory)};
  if (out->mode == NULL || out->memory == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for %zu limits", study->limits.count);
  }
  out->centre = out->memory + 2 * n * most;
  for (size_t i = 0; i < most; i++) {
    const SbLimit *limit = &study->limits.item[i / 2];
    if (isfinite(i % 2 == 0 ? limit->low : limit->high)) {
      double *memory = out->memory + 2 * n * out->count;
      out->mode[out->count++] =
          (SbFailureMode){.limit = i / 2, .upper = i % 2 == 1, .u = memory, .value = memory + n};
    }
  }
  Searches all = {study, out, cancelled, data};
  const SbStatus status = sb_tasks(search_one, &all, out->count, jobs, report);
  for (size_t i = 0; status == SB_OK && i < out->count; i++) {
    const SbFailureMode *mode = &out->mode[i];
    if (mode->found.end == SB_SEARCH_FOUND && mode->found.beta > 0) {
      memcpy(out->centre + n * out->centres++, mode->u, n * sizeof *mode->u);
    }
  }
  return status;
}

void sb_reliability_release(SbReliability *reliability) {
  free(reliability->mode);
  free(reliability->memory);
  *reliability = (SbReliability){0};
}

SbStatus sb_reliability_points(double **value, double **u, const SbStudyFile *study,
                               const SbReliability *reliability, SbReport *report) {
  const size_t n = study->vary->len, samples = study->samples;
  *value = calloc(samples * n + 1, sizeof **value);
  *u = calloc(samples * n + 1, sizeof **u);
  if (*value == NULL || *u == NULL) {
    free(*value);
    free(*u);
    *value = *u = NULL;
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for %zu samples", samples);
  }
  sb_sample_importance(*u, samples, n, reliability->centre, reliability->centres, study->seed);
  for (size_t i = 0; i < samples; i++) {
    sb_study_file_place(*value + i * n, NULL, study, *u + i * n);
  }
  return sb_succeed(report);
}
