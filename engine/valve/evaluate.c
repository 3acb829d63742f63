// Answers by a run whose plan has no more than the figures need; see the header.
#include "engine/valve/evaluate.h"

#include "engine/valve/run/run.h"

#include <math.h>
#include <stdlib.h>

struct SbEvaluator {
  SbRun *run;    // NULL before the first question
  bool answered; // the run is that of the last question
  SbReport why;  // there was none
};

SbStatus sb_evaluator_create(SbEvaluator **out, SbReport *report) {
  *out = calloc(1, sizeof **out);
  if (*out == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for an evaluator");
  }
  return sb_succeed(report);
}

void sb_evaluator_destroy(SbEvaluator *evaluator) {
  if (evaluator != NULL) {
    sb_run_destroy(evaluator->run);
    free(evaluator);
  }
}

static SbStatus prepare(SbEvaluator *evaluator, const SbQuestion *question, SbReport *report) {
  SbPlan plan;
  SbModel *model;
  SbStatus status =
      sb_model_derive(&model, question->base, question->override, question->override_count, report);
  if (status == SB_OK) {
    sb_plan_figures(&plan, model, question->figure, question->figure_count);
    status = evaluator->run == NULL ? sb_run_create(&evaluator->run, model, &plan, report)
                                    : sb_run_renew(evaluator->run, model, &plan, report);
  }
  sb_model_destroy(model);
  return status;
}

SbStatus sb_evaluator_ask(double *value, SbEvaluator *evaluator, const SbQuestion *question,
                          SbReport *report) {
  SbReport own = {0};
  SbStatus status = prepare(evaluator, question, &own);
  evaluator->answered = status == SB_OK;
  if (evaluator->answered) {
    sb_run_start_from(evaluator->run, question->start != NULL ? question->start->run : NULL);
    if (question->keep) {
      sb_run_keep_rings(evaluator->run);
    }
    // Whoever asks many questions asks them side by side.
    const SbRunHooks hooks = {
        .cancelled = question->cancelled, .data = question->data, .alone = true};
    status = sb_run_execute(evaluator->run, &hooks, &own);
    if (question->keep) {
      sb_run_end_rings(evaluator->run);
    }
  }
  for (size_t i = 0; i < question->figure_count; i++) {
    value[i] = evaluator->answered
                   ? sb_figure_value(sb_run_summary(evaluator->run), question->figure[i])
                   : NAN;
  }
  evaluator->why = own;
  if (report != NULL) {
    *report = own;
  }
  return status;
}

const char *sb_evaluator_reason(const SbEvaluator *evaluator, int figure) {
  const SbSummary *summary = sb_evaluator_summary(evaluator);
  return summary != NULL ? sb_figure_reason(summary, figure) : evaluator->why.text;
}

const SbModel *sb_evaluator_model(const SbEvaluator *evaluator) {
  return evaluator->answered ? sb_run_model(evaluator->run) : NULL;
}

const SbSummary *sb_evaluator_summary(const SbEvaluator *evaluator) {
  return evaluator->answered ? sb_run_summary(evaluator->run) : NULL;
}

SbStatus sb_evaluator_sliding(SbSealState *out, SbEvaluator *evaluator, int seal, int way,
                              double speed, SbReport *report) {
  return sb_run_sliding(out, evaluator->run, seal, way, speed, report);
}
