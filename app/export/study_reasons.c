// The reasons of everything that the JSON document of a study cannot state; see study_results.h.
#include "app/export/study_results.h"

#include <math.h>

// Counts the computed samples without a value of figure `k` (a column of the answers); *first
// becomes the first of them.
static size_t count_missing(size_t *first, const SbAnswers *answers, size_t k) {
  size_t count = 0;
  for (size_t i = 0; i < answers->samples; i++) {
    if (answers->status[i] == SB_OK && isnan(answers->value[i * answers->figures + k])) {
      *first = count++ == 0 ? i : *first;
    }
  }
  return count;
}

// Returns why statistics of figure `k` are missing or are not those of all samples; NULL: neither.
static char *figure_reason(const SbAnswers *answers, size_t k) {
  const size_t computed = sb_study_done(answers) - sb_study_failed(answers);
  size_t first = 0;
  const size_t missing = count_missing(&first, answers, k);
  if (missing > 0) {
    const char *why = g_hash_table_lookup(answers->reason, GSIZE_TO_POINTER(first));
    return g_strdup_printf("%zu of %zu samples have no value; the first is sample %zu: %s", missing,
                           computed, first + 1, why != NULL ? why : "");
  }
  return computed == 0 ? g_strdup("no sample was computed without a failure")
         : computed == 1
             ? g_strdup("the standard deviation and the indices of one sample are not defined")
             : NULL;
}

// Returns why the probability of a limit, its interval or its index is missing or certain; NULL:
// neither.
static const char *share_reason(const SbStudyFile *study, const SbLimitShare *share) {
  switch (study->method) {
  case SB_METHOD_MONTE_CARLO:
  case SB_METHOD_RELIABILITY:
    break;
  case SB_METHOD_SOBOL_SEQUENCE:
    return "the points of a sequence are not independent samples: they have no interval";
  default:
    return "the points of this method are not drawn from the parameters' distributions: no "
           "probability follows from them";
  }
  return share->reason[0] != '\0'    ? share->reason
         : !isnan(share->beta)       ? NULL
         : isnan(share->probability) ? "no sample has a value of it, or samples are missing"
                                     : "a probability of 0 or 1 has no index";
}

void sb_study_put_missing(SbJson *json, const SbAnswers *answers) {
  enum { MOST = 100 };
  sb_json_array(json, "missing");
  int shown = 0;
  for (size_t i = 0; shown < MOST && i < answers->samples; i++) {
    const char *reason = g_hash_table_lookup(answers->reason, GSIZE_TO_POINTER(i));
    if (answers->status[i] == SB_OK && reason != NULL) {
      sb_json_object(json, NULL);
      sb_json_count(json, "sample", i + 1);
      sb_json_string(json, "reason", reason);
      sb_json_object_end(json);
      shown++;
    }
  }
  sb_json_array_end(json);
}

SbStatus sb_study_put_reasons(SbJson *json, const SbStudyFile *study, const SbStudyDrawn *drawn,
                              const SbAnswers *answers, SbReport *report) {
  const bool indices =
      study->method == SB_METHOD_MORRIS || study->method == SB_METHOD_SOBOL_INDICES;
  SbStatus status = SB_OK;
  sb_json_object(json, "reasons");
  // Of samples about failures there are no statistics of figures.
  for (size_t k = 0; drawn->reliability == NULL && k < answers->figures; k++) {
    const char *path = sb_figure(g_array_index(study->figures, int, k))->path;
    g_autofree char *reason = figure_reason(answers, k);
    for (int part = 0; reason != NULL && part < (indices ? 2 : 1); part++) {
      g_autofree char *key = g_strconcat(part == 0 ? "figures." : "indices.", path, NULL);
      sb_json_string(json, key, reason);
    }
  }
  const size_t limits = study->limits.count;
  for (size_t i = 0; limits > 0 && status == SB_OK && i <= limits; i++) {
    SbLimitShare share;
    status = sb_study_limit_share(&share, study, drawn, answers, i, report);
    const char *reason = status == SB_OK ? share_reason(study, &share) : NULL;
    g_autofree char *key = i < limits ? g_strdup_printf("limits[%zu]", i) : g_strdup("any_limit");
    if (reason != NULL) {
      sb_json_string(json, key, reason);
    }
  }
  sb_json_object_end(json);
  return status;
}
