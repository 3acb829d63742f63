// Shares of valves beyond limits; see the header.
#include "app/study/shares.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int sb_study_column_of(const SbStudyFile *study, int figure) {
  for (guint i = 0; i < study->figures->len; i++) {
    if (g_array_index(study->figures, int, i) == figure) {
      return (int)i;
    }
  }
  return -1;
}

// A valve that was computed belongs to the population, even without a value of this figure: the
// stem may never have moved.
static SbTrial trial_of(const SbStudyFile *study, const SbAnswers *answers, size_t sample,
                        size_t limit) {
  const SbLimit *of = &study->limits.item[limit];
  const int column = sb_study_column_of(study, of->figure);
  const double value = answers->value[sample * answers->figures + (size_t)column];
  const uint8_t status = answers->status[sample];
  return value < of->low || value > of->high                   ? SB_TRIAL_FAILS
         : !isnan(value)                                       ? SB_TRIAL_HOLDS
         : status == SB_OK || status == SB_ERROR_NOT_CONVERGED ? SB_TRIAL_UNKNOWN
                                                               : SB_TRIAL_LEFT_OUT;
}

// Of any limit: one that fails decides, then one that is not known.
static SbTrial trial_of_any(const SbStudyFile *study, const SbAnswers *answers, size_t sample) {
  SbTrial all = SB_TRIAL_LEFT_OUT;
  for (size_t limit = 0; limit < study->limits.count; limit++) {
    static const int rank[] = {[SB_TRIAL_LEFT_OUT] = 0,
                               [SB_TRIAL_HOLDS] = 1,
                               [SB_TRIAL_UNKNOWN] = 2,
                               [SB_TRIAL_FAILS] = 3};
    const SbTrial one = trial_of(study, answers, sample, limit);
    all = rank[one] > rank[all] ? one : all;
  }
  return all;
}

// Why nothing failed: what the searches of the limit's sides ended with.
static void tell_nothing(SbLimitShare *out, const SbStudyDrawn *drawn, size_t limit) {
  const char *said = NULL;
  for (size_t i = 0; drawn->reliability != NULL && i < drawn->reliability->count; i++) {
    const SbFailureMode *mode = &drawn->reliability->mode[i];
    if (mode->limit == limit && mode->found.end != SB_SEARCH_FOUND) {
      said = sb_failure_text(&mode->found);
    }
  }
  sb_text(out->reason, sizeof out->reason, "none of %zu samples is beyond it%s%s", out->of,
          said != NULL ? "; " : "", said != NULL ? said : "");
}

SbStatus sb_study_limit_share(SbLimitShare *out, const SbStudyFile *study,
                              const SbStudyDrawn *drawn, const SbAnswers *answers, size_t limit,
                              SbReport *report) {
  const size_t samples = answers->samples, n = study->vary->len;
  const SbReliability *about = drawn->reliability;
  *out = (SbLimitShare){.probability = NAN, .interval = {NAN, NAN}, .beta = NAN};
  uint8_t *trial = malloc(samples + 1);
  double *weight = malloc((samples + 1) * sizeof *weight);
  const bool memory = trial != NULL && weight != NULL;
  bool whole = true;
  for (size_t i = 0; memory && i < samples; i++) {
    trial[i] = (uint8_t)(limit < study->limits.count ? trial_of(study, answers, i, limit)
                                                     : trial_of_any(study, answers, i));
    whole &= answers->status[i] != SB_ANSWER_MISSING;
    out->unknown += trial[i] == SB_TRIAL_UNKNOWN;
    if (about != NULL) {
      weight[i] = sb_importance_weight(drawn->unit + i * n, n, about->centre, about->centres);
    }
  }
  if (memory) {
    SbWeightedShare share;
    sb_weighted_share(&share, about != NULL && about->centres > 0 ? weight : NULL, trial, samples);
    out->beyond = share.failed;
    out->of = share.known;
    out->unknown_share = share.unknown;
    // Some of the samples about failures have not the density that the weights are for.
    if (whole || about == NULL) {
      out->probability = share.probability;
      memcpy(out->interval, share.interval, sizeof out->interval);
    }
    out->certain = out->probability >= 1 && out->beyond == out->of && out->unknown == 0;
    if (out->certain) {
      sb_text(out->reason, sizeof out->reason,
              "every valve fails: all of %zu samples are beyond the limit", out->of);
    } else if (out->probability > 0 && out->probability < 1) {
      out->beta = -sb_normal_quantile(out->probability);
    } else if (out->probability == 0) {
      tell_nothing(out, drawn, limit);
    }
    if (out->unknown > 0) {
      const size_t used = strlen(out->reason);
      sb_text(out->reason + used, sizeof out->reason - used, "%s%zu samples have no value of it",
              used > 0 ? "; " : "", out->unknown);
    }
  }
  free(trial);
  free(weight);
  return memory ? SB_OK : sb_fail(report, SB_ERROR_MEMORY, "no memory for %zu samples", samples);
}
