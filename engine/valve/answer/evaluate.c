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

// Of a line of params.def: whether two have the same of a member that is declared there.
#define SAME_OWN(type, place) same = same && a->place == b->place;
#define SAME_IN(type, place)

static bool same_rings(const SbSealModel *a, const SbSealModel *b) {
  return a->section_diameter == b->section_diameter && a->inner_diameter == b->inner_diameter &&
         a->modulus == b->modulus && a->reduced_modulus == b->reduced_modulus &&
         a->radius == b->radius && a->stretch_mean == b->stretch_mean &&
         a->section_fitted == b->section_fitted && a->interference == b->interference &&
         a->poisson_ratio == b->poisson_ratio && a->mooney_share == b->mooney_share;
}

// Returns whether the seals' steady states are the same for `b` and the model of which `a` is a
// copy. Fields that these states do not depend on are ignored, out of all that the states' files
// (sliding*.c, breakaway.c, run_states.c, run_speeds.c, run_supply.c) read of a model. Any other
// row of params.def counts.
static bool same_states(SbModel *a, const SbModel *b) {
#define LIKE(member) a->member = b->member
  LIKE(storage_time), LIKE(storage_temperature), LIKE(recovery_time);
  LIKE(radial_space_tolerance), LIKE(axial_width_tolerance), LIKE(bore_diameter_tolerance);
  LIKE(land_edge), LIKE(refill_travel), LIKE(refill_area), LIKE(housing_expansion);
  LIKE(ethanol), LIKE(temperature), LIKE(ambient_pressure), LIKE(discharge_coefficient);
  LIKE(chamber_stiffness), LIKE(stem_diameter_tolerance), LIKE(stem_mass);
  LIKE(density), LIKE(stroke), LIKE(reversal_force), LIKE(stiffness), LIKE(peak_force);
  LIKE(rise_time), LIKE(hold_time), LIKE(finger_damping), LIKE(damping_ratio), LIKE(amplitude);
  LIKE(frequency), LIKE(stribeck_speed), LIKE(tangential_stiffness), LIKE(stop_stiffness);
  LIKE(stop_restitution), LIKE(spring_stiffness), LIKE(spring_preload), LIKE(rig_prominence);
  LIKE(motion_tolerance);
  if (!(b->groove_chamfer > 0)) {
    LIKE(stem_diameter); // where the chamfers of the grooves end
  }
#undef LIKE
  bool same = a->bore_circumference == b->bore_circumference && a->surface == b->surface &&
              a->data == b->data;
#define SB_REAL(id, where, place, ...)         SAME_##where(double, place)
#define SB_INT(id, where, place, ...)          SAME_##where(int, place)
#define SB_CHOICE(id, type, where, place, ...) SAME_##where(type, place)
#define SB_FLAGS(id, where, place, ...)        SAME_##where(unsigned, place)
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
  if (!evaluator->answered || !same_plan(plan, sb_run_plan(evaluator->run))) {
    return false;
  }
  SbModel *work = malloc(sizeof *work);
  bool same = false;
  if (work != NULL) {
    *work = *sb_run_model(evaluator->run);
    same = same_states(work, model);
  }
  free(work);
  return same;
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
    const SbRunHooks hooks = {
        .cancelled = question->cancelled, .data = question->data, .alone = !question->keep};
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
