// Answers by a run whose plan has no more than the figures need; see the header.
#include "engine/valve/answer/evaluate.h"

#include "engine/valve/model/model.h"
#include "engine/valve/run/run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct SbEvaluator {
  SbRun *run;               // NULL before the first question
  bool answered;            // the run is that of the last question
  const SbEvaluator *start; // of that question
  bool tangent;             // its rings are tangents
  SbRingsBeside rings;      // which do this
  bool kept;                // its rings are others' starts
  SbReport why;             // there was none
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

static bool same_rings(const SbSealModel *a, const SbSealModel *b) {
  return a->section_diameter == b->section_diameter && a->inner_diameter == b->inner_diameter &&
         a->modulus == b->modulus && a->reduced_modulus == b->reduced_modulus &&
         a->radius == b->radius && a->stretch_mean == b->stretch_mean &&
         a->section_fitted == b->section_fitted && a->interference == b->interference &&
         a->poisson_ratio == b->poisson_ratio && a->mooney_share == b->mooney_share;
}

// Whether parameters of `stage` are compared: those up to the stage `last`, except those of RUBBER
// and FLUID, which enter by values that the model derives. Real numbers count up to FRICTION.
// Choices and integers count up to LIFE, because they also decide the plan and its memory.
#define ENTERS(stage, last)                                                                        \
  (SB_ENTERS_##stage <= SB_ENTERS_##last && SB_ENTERS_##stage != SB_ENTERS_RUBBER &&               \
   SB_ENTERS_##stage != SB_ENTERS_FLUID)

// Returns whether the seals' steady states are the same for two models.
static bool same_states(const SbModel *a, const SbModel *b) {
  bool same = a->bore_circumference == b->bore_circumference && a->surface == b->surface &&
              a->data == b->data;
  if (b->groove_chamfer > 0) { // the chamfers of the grooves end at the stem
    same = same && a->stem_diameter == b->stem_diameter;
  }
#define SAME(last, stage, place)                      same = same && (!ENTERS(stage, last) || a->place == b->place);
#define SB_REAL(id, stage, where, place, ...)         SAME(FRICTION, stage, place)
#define SB_INT(id, stage, where, place, ...)          SAME(LIFE, stage, place)
#define SB_CHOICE(id, stage, type, where, place, ...) SAME(LIFE, stage, place)
#define SB_FLAGS(id, stage, where, place, ...)        SAME(LIFE, stage, place)
#include "engine/valve/model/params.def"
  return same && same_rings(&a->seal[SB_OUTER], &b->seal[SB_OUTER]) &&
         same_rings(&a->seal[SB_INNER], &b->seal[SB_INNER]);
}

static bool same_plan(const SbPlan *a, const SbPlan *b) {
  bool same = a->film_laws == b->film_laws && a->motion == b->motion && a->life == b->life &&
              a->film_history == b->film_history && a->frames == b->frames &&
              a->frame_films == b->frame_films && a->shelf == b->shelf;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    same = same && a->seal[i] == b->seal[i];
  }
  return same; // the remaining fields are the model's choices
}

// Returns whether the last question's run has solved all that a model and plan want solved.
static bool has_solved(const SbEvaluator *evaluator, const SbModel *model, const SbPlan *plan) {
  return evaluator->answered && same_plan(plan, sb_run_plan(evaluator->run)) &&
         same_states(sb_run_model(evaluator->run), model);
}

// A derived model has no limits: those of the base count.
static void plan_for(SbPlan *plan, const SbModel *model, const SbQuestion *question) {
  sb_plan_figures(plan, model, question->figure, question->figure_count,
                  question->as_run ? question->base : NULL);
}

bool sb_evaluator_has_solved(const SbEvaluator *evaluator, const SbQuestion *question) {
  SbPlan plan;
  SbModel *model;
  bool has = false;
  if (sb_model_derive(&model, question->base, question->override, question->override_count, NULL) ==
      SB_OK) {
    plan_for(&plan, model, question);
    has = has_solved(evaluator, model, &plan);
  }
  sb_model_destroy(model);
  return has;
}

static SbStatus prepare(SbEvaluator *evaluator, const SbQuestion *question, SbReport *report) {
  SbPlan plan;
  SbModel *model;
  SbStatus status =
      sb_model_derive(&model, question->base, question->override, question->override_count, report);
  if (status == SB_OK) {
    plan_for(&plan, model, question);
    status = evaluator->run == NULL ? sb_run_create(&evaluator->run, model, &plan, report)
             : question->start == evaluator->start && question->tangent == evaluator->tangent &&
                     question->rings == evaluator->rings && !question->keep && !evaluator->kept &&
                     has_solved(evaluator, model, &plan)
                 ? sb_run_renew_same(evaluator->run, model, report)
                 : sb_run_renew(evaluator->run, model, &plan, report);
  }
  sb_model_destroy(model);
  return status;
}

void sb_evaluator_forget(SbEvaluator *evaluator) {
  evaluator->answered = false;
}

SbStatus sb_evaluator_ask(double *value, SbEvaluator *evaluator, const SbQuestion *question,
                          SbReport *report) {
  SbReport own = {0};
  SbStatus status = prepare(evaluator, question, &own);
  evaluator->answered = status == SB_OK;
  if (evaluator->answered) {
    const SbRun *start = question->start != NULL ? question->start->run : NULL;
    (question->tangent ? sb_run_predict_from : sb_run_start_from)(evaluator->run, start);
    sb_run_rings_beside(evaluator->run, question->rings);
    evaluator->start = question->start;
    evaluator->tangent = question->tangent;
    evaluator->rings = question->rings;
    evaluator->kept = question->keep;
    if (question->keep) {
      sb_run_keep_rings(evaluator->run);
    }
    // A caller with many questions asks them on parallel threads, except the one that they start
    // from.
    const SbRunHooks hooks = {.cancelled = question->cancelled,
                              .data = question->data,
                              .work_used = question->work_used,
                              .alone = !question->keep};
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
