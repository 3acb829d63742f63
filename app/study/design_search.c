// The search for a design: its problem, its starts and their optimum; see design.h.
#include "app/study/design_private.h"

#include "app/study/slopes.h"

#include <math.h>
#include <stdlib.h>

// The problem's figures, sides and variables, and their scales at the scene.
static SbStatus prepare(Problem *problem, const SbStudyFile *study, SbReport *report) {
  problem->study = study;
  problem->n = study->vary->len;
  problem->sign = study->design.maximise ? -1 : 1;
  problem->figure[problem->figures++] = study->design.figure;
  for (size_t k = 0; k < problem->n; k++) {
    const SbVary *vary = &g_array_index(study->vary, SbVary, k);
    problem->parameter[k] = vary->id;
    problem->fixed[k] = vary->distribution.kind == SB_DISTRIBUTION_LEVELS;
    if (!problem->fixed[k]) {
      problem->at[problem->free++] = k;
    }
  }
  for (size_t i = 0; i < 2 * study->limits.count; i++) {
    const SbLimit *limit = &study->limits.item[i / 2];
    const double bound = i % 2 == 0 ? limit->low : limit->high;
    size_t column = 0;
    while (column < problem->figures && problem->figure[column] != limit->figure) {
      column++;
    }
    problem->figure[column] = limit->figure;
    problem->figures = MAX(problem->figures, column + 1);
    if (isfinite(bound)) {
      problem->side[problem->sides++] =
          (Side){.limit = i / 2, .upper = i % 2 == 1, .bound = bound, .scale = 1, .column = column};
    }
  }
  SbEvaluator *evaluator = NULL;
  double value[FIGURES_MAX];
  SbStatus status = sb_evaluator_create(&evaluator, report);
  if (status == SB_OK) {
    const SbSlopesAsked asked = {.base = study->base,
                                 .figure = problem->figure,
                                 .figures = problem->figures,
                                 .cancelled = problem->cancelled,
                                 .data = problem->data};
    status = sb_slopes(value, NULL, evaluator, &asked, NULL, report);
  }
  sb_evaluator_destroy(evaluator);
  problem->scale = 1;
  if (status == SB_OK && fabs(value[0]) > 0 && isfinite(value[0])) {
    problem->scale = fabs(value[0]);
  }
  for (size_t i = 0; status == SB_OK && i < problem->sides; i++) {
    Side *side = &problem->side[i];
    const double here = isfinite(value[side->column]) ? fabs(value[side->column]) : 0;
    const double scale = fmax(fabs(side->bound), here);
    side->scale = scale > 0 ? scale : 1;
  }
  return status;
}

SbStatus sb_design_search(SbDesign *out, const SbStudyFile *study, int jobs,
                          bool (*cancelled)(void *data), void *data, SbReport *report) {
  *out = (SbDesign){.optimality = NAN,
                    .by_form = NAN,
                    .holds = NAN,
                    .interval = {NAN, NAN},
                    .starts = study->design.starts};
  Problem *problem = calloc(1, sizeof *problem);
  Start *start = calloc(study->design.starts + 1, sizeof *start), best;
  out->value = calloc(study->vary->len + 1, sizeof *out->value);
  out->figure = calloc(study->figures->len + 1, sizeof *out->figure);
  out->error = calloc(study->figures->len + 1, sizeof *out->error);
  out->reason = g_new0(char *, study->figures->len + 1);
  out->figures = study->figures->len;
  SbStatus status = SB_OK;
  if (problem == NULL || start == NULL || out->value == NULL || out->figure == NULL ||
      out->error == NULL) {
    status = sb_fail(report, SB_ERROR_MEMORY, "no memory for %zu starts", study->design.starts);
  } else {
    problem->cancelled = cancelled;
    problem->data = data;
    status = prepare(problem, study, report);
  }
  status = status == SB_OK ? sb_design_make_starts(start, problem, report) : status;
  status = status == SB_OK ? sb_design_run_starts(&best, out, problem, start, study->design.starts,
                                                  jobs, report)
                           : status;
  status = status == SB_OK ? sb_design_take_optimum(out, problem, &best, report) : status;
  if (status == SB_OK && out->feasible && study->design.tolerances->len > 0 &&
      study->limits.count > 0) {
    status = sb_design_over_tolerances(out, problem, &best, jobs, report);
  }
  free(problem);
  free(start);
  return status == SB_OK ? sb_succeed(report) : status;
}

void sb_design_release(SbDesign *design) {
  free(design->value);
  free(design->figure);
  free(design->error);
  for (size_t i = 0; i < design->figures; i++) {
    g_free(design->reason[i]);
  }
  g_free(design->reason);
  g_free(design->warnings);
  *design = (SbDesign){0};
}

char *sb_design_bounds(const SbDesign *design, const SbStudyFile *study) {
  GString *text = g_string_new(NULL);
  for (guint k = 0; k < study->vary->len; k++) {
    if (design->bound_active[k] != 0) {
      g_string_append_printf(text, "%s%s (%s)", text->len > 0 ? ", " : "",
                             sb_param(g_array_index(study->vary, SbVary, k).id)->key,
                             design->bound_active[k] < 0 ? "lower" : "upper");
    }
  }
  return g_string_free(text, text->len == 0);
}

double sb_design_margin(const SbDesign *design, const SbStudyFile *study, size_t limit) {
  const SbLimit *of = &study->limits.item[limit];
  const double figure = design->figure[sb_study_column_of(study, of->figure)];
  return isnan(figure) ? figure : fmin(figure - of->low, of->high - figure);
}
