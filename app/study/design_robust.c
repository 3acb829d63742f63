// A design that keeps its limits over the tolerances: FORM draws the bounds in, samples check it.
#include "app/study/design_private.h"

#include "app/study/answers.h"
#include "app/study/reliability.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// By how much more than requested FORM's quantile may be missed.
#define ABOVE 0.002

// Probability that a limit fails, at most: the sum over all sides.
static double failure_by_form(const SbReliability *about) {
  double sum = 0;
  for (size_t i = 0; i < about->count; i++) {
    const SbFailurePoint *found = &about->mode[i].found;
    sum += found->end == SB_SEARCH_FOUND ? sb_normal_share(-found->beta) : !(found->value > 0);
  }
  return fmin(sum, 1);
}

// Normal quantile of a probability of failure, where it has one.
static double beta_of(double failure) {
  return -sb_normal_quantile(fmin(fmax(failure, 1e-15), 1 - 1e-15));
}

// Draws the bounds in by `beta` deviations of their figures.
static void shift_bounds(Problem *problem, const SbReliability *about, double beta) {
  for (size_t i = 0; i < problem->sides; i++) {
    const SbFailurePoint *found = &about->mode[i].found;
    const double linear = isfinite(found->slope) ? found->slope : 0;
    // What a deviation is on the way to the failure, where there is a way to speak of.
    const double deviation = found->end == SB_SEARCH_FOUND && fabs(found->beta) > 0.5
                                 ? found->value / found->beta
                                 : linear;
    problem->side[i].shift = fmax(beta * deviation, 0);
  }
}

static SbStatus check_by_samples(SbDesign *out, const SbStudyFile *about, int jobs,
                                 const SbReliability *reliability, const Problem *problem,
                                 SbReport *report) {
  SbParamId parameter[SB_VARY_MAX];
  double *value = NULL, *u = NULL;
  SbStatus status = sb_reliability_points(&value, &u, about, reliability, report);
  if (status != SB_OK) {
    return status;
  }
  for (guint k = 0; k < about->vary->len; k++) {
    parameter[k] = g_array_index(about->vary, SbVary, k).id;
  }
  g_autoptr(GError) error = NULL;
  SbAnswers answers = {0};
  const SbQuestions asked = {.base = about->base,
                             .base_sha256 = about->base_sha256,
                             .parameter = parameter,
                             .parameters = about->vary->len,
                             .figure = (const int *)(const void *)about->figures->data,
                             .figures = about->figures->len,
                             .value = value,
                             .samples = about->samples,
                             .jobs = jobs,
                             .cancelled = problem->cancelled,
                             .data = problem->data};
  const SbStudyDrawn drawn = {u, reliability};
  SbLimitShare share;
  if (!sb_answers_get(&answers, &asked, &error)) {
    status = error->code == SB_APP_ERROR_CANCELLED
                 ? sb_fail(report, SB_ERROR_CANCELLED, "cancelled")
                 : sb_fail(report, SB_ERROR_MEMORY, "%s", error->message);
  } else {
    status = sb_study_limit_share(&share, about, &drawn, &answers, about->limits.count, report);
  }
  if (status == SB_OK) {
    out->checked = true;
    out->samples = about->samples;
    // A valve of which a limit is not known does not meet it.
    out->holds = share.of > 0 ? (1 - share.unknown_share) * (1 - share.probability) : 0;
    out->interval[0] = 1 - share.interval[1];
    out->interval[1] = 1 - share.interval[0];
  }
  sb_answers_release(&answers);
  free(value);
  free(u);
  return status;
}

// Looks at the scatter about the design: failures by FORM, into *reliability, which is replaced.
static SbStatus look_about(SbReliability *reliability, SbStudyFile **about, const SbDesign *design,
                           const Problem *problem, int jobs, SbReport *report) {
  enum { SAMPLES = 1000 };
  const SbStudyFile *study = problem->study;
  sb_reliability_release(reliability);
  sb_study_file_free(*about);
  *about = sb_study_file_about(study, design->value, study->samples > 0 ? study->samples : SAMPLES);
  return sb_reliability_search(reliability, *about, jobs, problem->cancelled, problem->data,
                               report);
}

// Draws the bounds in until FORM's probability is `goal`'s, from the design that there is.
static SbStatus make_robust(SbDesign *out, Problem *problem, Start *best, SbReliability *about,
                            SbStudyFile **scatter, double *beta, double goal, int jobs,
                            SbReport *report) {
  enum { CYCLES = 8 };
  SbStatus status = SB_OK;
  for (int cycle = 0; status == SB_OK && out->feasible && cycle < CYCLES; cycle++) {
    const double now = beta_of(failure_by_form(about));
    // Robust enough, and no more than that unless the limits ask for nothing.
    if (now > goal - ABOVE && (now < goal + 0.02 || *beta <= 0)) {
      break;
    }
    *beta = *beta > 0 ? fmax(*beta + goal - now, 0) : goal;
    shift_bounds(problem, about, *beta);
    Start *start = calloc(problem->study->design.starts + 1, sizeof *start);
    status = start != NULL ? sb_design_make_starts(start, problem, report)
                           : sb_fail(report, SB_ERROR_MEMORY, "no memory for starts");
    if (status == SB_OK) {
      // From the last optimum; from everywhere where that is none any more.
      memcpy(start[0].v, best->v, sizeof best->v);
      status = sb_design_run_starts(best, out, problem, start, 1, jobs, report);
      if (status == SB_OK && best->breach > BREACH_NONE) {
        status = sb_design_run_starts(best, out, problem, start, problem->study->design.starts,
                                      jobs, report);
      }
    }
    free(start);
    if (status == SB_OK && (status = sb_design_take_optimum(out, problem, best, report)) == SB_OK) {
      status = look_about(about, scatter, out, problem, jobs, report);
    }
  }
  return status;
}

SbStatus sb_design_over_tolerances(SbDesign *out, Problem *problem, Start *best, int jobs,
                                   SbReport *report) {
  const double robust = problem->study->design.robust;
  enum { ROUNDS = 4 };
  SbReliability about = {0};
  SbStudyFile *scatter = NULL;
  // FORM's goal is by ABOVE more than requested, which make_robust() may miss.
  double beta = 0, goal = isfinite(robust) ? beta_of(1 - robust) + ABOVE : NAN;
  SbStatus status = look_about(&about, &scatter, out, problem, jobs, report);
  // FORM leaves out what the samples find: the search is repeated with the difference.
  for (int round = 0; status == SB_OK && round < ROUNDS; round++) {
    if (isfinite(robust)) {
      status = make_robust(out, problem, best, &about, &scatter, &beta, goal, jobs, report);
    }
    if (status == SB_OK) {
      out->by_form = 1 - failure_by_form(&about);
      status = check_by_samples(out, scatter, jobs, &about, problem, report);
    }
    const double target = isfinite(robust) ? robust : 0;
    out->met = out->holds >= target;
    const bool lavish = 1 - out->interval[0] < 0.8 * (1 - target) && beta > 0;
    if (!isfinite(robust) || !out->feasible || (out->met && !lavish)) {
      break;
    }
    goal += beta_of(1 - robust) - beta_of(1 - out->holds) + ABOVE;
  }
  sb_reliability_release(&about);
  sb_study_file_free(scatter);
  return status;
}
