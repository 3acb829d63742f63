// Answers by a run whose plan has no more than the figures need; see the header.
#include "engine/valve/evaluate.h"

#include "engine/valve/model.h"
#include "engine/valve/run/run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct SbEvaluator {
  SbRun *run;              // NULL before the first question
  bool keeps;              // solved rings
  const SbEvaluator *near; // whose rings this one's are found near to; NULL: solved
  bool answered;           // the run is that of the last question
  SbReport why;            // there was none
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

// Whether the seals' steady states are the same for both: what they do not hang on is taken for
// alike, by all that sliding.h, what it calls and run_states.c read of a model; what is not named
// here, they may.
static bool same_states(SbModel *work, const SbModel *a, const SbModel *b) {
  *work = *a;
  work->params = b->params;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    SbSealModel *to = &work->seal[i];
    const SbSealModel *from = &b->seal[i];
    to->stored = from->stored;
    to->storage = from->storage;
    to->section_diameter_tolerance = from->section_diameter_tolerance;
    to->inner_diameter_tolerance = from->inner_diameter_tolerance;
    to->squeeze = from->squeeze;
    to->gland_fill = from->gland_fill;
  }
#define LIKE(member) work->member = b->member
  LIKE(storage_time), LIKE(storage_temperature), LIKE(recovery_time), LIKE(rubber);
  LIKE(radial_space_tolerance), LIKE(axial_width_tolerance), LIKE(bore_diameter_tolerance);
  LIKE(land_edge), LIKE(shape), LIKE(refill_travel), LIKE(refill_area), LIKE(housing_expansion);
  LIKE(ethanol), LIKE(temperature), LIKE(ambient_pressure), LIKE(supply), LIKE(filling_time);
  LIKE(discharge_coefficient), LIKE(chamber_stiffness), LIKE(stem_diameter);
  LIKE(stem_diameter_tolerance), LIKE(stem_mass), LIKE(density), LIKE(pressure_force);
  LIKE(parts), LIKE(moving_mass), LIKE(stroke), LIKE(reversal_force), LIKE(stiffness);
  LIKE(peak_force), LIKE(rise_time), LIKE(hold_time), LIKE(finger_damping), LIKE(damping_ratio);
  LIKE(amplitude), LIKE(frequency), LIKE(stribeck_speed), LIKE(tangential_stiffness);
  LIKE(stop_stiffness), LIKE(stop_restitution), LIKE(spring_stiffness), LIKE(spring_preload);
  LIKE(running_in), LIKE(rig), LIKE(rig_prominence), LIKE(look), LIKE(study);
  LIKE(motion_tolerance), LIKE(limits);
#undef LIKE
  return memcmp(work, b, sizeof *work) == 0;
}

static bool same_plan(const SbPlan *a, const SbPlan *b) {
  bool same = a->film_laws == b->film_laws && a->motion == b->motion && a->life == b->life &&
              a->film_history == b->film_history && a->frames == b->frames;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    same = same && a->seal[i] == b->seal[i];
  }
  return same; // the rest is the model's choices
}

// Whether the last question's run has solved all that a model and plan want solved.
static bool has_solved(const SbEvaluator *evaluator, const SbModel *model, const SbPlan *plan) {
  if (!evaluator->answered || !same_plan(plan, sb_run_plan(evaluator->run))) {
    return false;
  }
  SbModel *work = malloc(sizeof *work);
  const bool same = work != NULL && same_states(work, sb_run_model(evaluator->run), model);
  free(work);
  return same;
}

bool sb_evaluator_has_solved(const SbEvaluator *evaluator, const SbQuestion *question) {
  SbPlan plan;
  SbModel *model;
  bool has = false;
  if (sb_model_derive(&model, question->base, question->override, question->override_count, NULL) ==
      SB_OK) {
    sb_plan_figures(&plan, model, question->figure, question->figure_count);
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
    sb_plan_figures(&plan, model, question->figure, question->figure_count);
    status = evaluator->run == NULL ? sb_run_create(&evaluator->run, model, &plan, report)
             : has_solved(evaluator, model, &plan)
                 ? sb_run_renew_same(evaluator->run, model, report)
                 : sb_run_renew(evaluator->run, model, &plan, report);
  }
  sb_model_destroy(model);
  if (status == SB_OK) {
    sb_run_near(evaluator->run, evaluator->keeps,
                evaluator->near != NULL ? evaluator->near->run : NULL);
  }
  return status;
}

void sb_evaluator_near(SbEvaluator *evaluator, bool keeps, const SbEvaluator *near) {
  evaluator->keeps = keeps;
  evaluator->near = near;
  evaluator->answered = false; // what stands was found otherwise
}

SbStatus sb_evaluator_ask(double *value, SbEvaluator *evaluator, const SbQuestion *question,
                          SbReport *report) {
  SbReport own = {0};
  SbStatus status = prepare(evaluator, question, &own);
  evaluator->answered = status == SB_OK;
  if (evaluator->answered) {
    // Whoever asks many questions asks them side by side.
    const SbRunHooks hooks = {
        .cancelled = question->cancelled, .data = question->data, .alone = true};
    status = sb_run_execute(evaluator->run, &hooks, &own);
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
