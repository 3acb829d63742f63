// Effects of the main parameters. See effect_job.h. Derivatives are the engine's (gradient.h).
#include "app/session/effect_job.h"

#include "app/base/own_model.h"
#include "app/run/process.h"
#include "app/session/worker.h"
#include "app/study/effects.h"

#include <glib/gi18n.h>
#include <math.h>

static const struct {
  const char *path, *name;
} goals[SB_EFFECT_GOALS] = {{"cycle.force_return_margin_N", N_("return margin")},
                            {"cycle.force_breakaway_N", N_("break-away")},
                            {"cycle.energy_loss_J", N_("loss")},
                            {"cycle.leakage_per_cycle_m3", N_("leak")},
                            {"seals.outer.pressure_peak_Pa", N_("peak pressure")}};

struct SbEffectJob {
  SbWorker worker;
  SbModel *model;
  bool good;
  SbEffects effects; // the thread's until it has ended
};

int sb_effect_goal(int index) {
  return sb_figure_find(goals[index].path);
}

const char *sb_effect_goal_name(int index) {
  return _(goals[index].name);
}

static void work_effect_job(void *owner) {
  SbEffectJob *job = owner;
  SbParamId id[SB_PARAM_COUNT];
  size_t count = 0;
  int figure[SB_EFFECT_GOALS];
  const int kind = sb_model_number(job->model, SB_P_VALVE_KIND);
  sb_process_work_behind();
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    job->effects.step[i] = NAN;
    if (sb_param_is_main((SbParamId)i, kind) && sb_param((SbParamId)i)->kind == SB_PARAM_REAL) {
      id[count++] = (SbParamId)i;
    }
  }
  for (int k = 0; k < SB_EFFECT_GOALS; k++) {
    figure[k] = sb_effect_goal(k);
    for (int i = 0; i < SB_PARAM_COUNT; i++) {
      job->effects.change[k][i] = NAN;
    }
  }
  SbEvaluator *evaluator = NULL;
  SbGradient *gradient = NULL;
  const SbQuestion question = {.base = job->model,
                               .figure = figure,
                               .figure_count = SB_EFFECT_GOALS,
                               .cancelled = sb_worker_cancelled,
                               .data = &job->worker};
  if (sb_evaluator_create(&evaluator, NULL) == SB_OK &&
      sb_gradient_create(&gradient, evaluator, &question, id, count, NULL, NULL) == SB_OK) {
    g_autofree SbEffect *effect = g_new(SbEffect, count + 1);
    for (size_t k = 0; k < SB_EFFECT_GOALS; k++) {
      // What has a derivative of 0 has no effect; what has none is not known.
      for (size_t i = 0; i < count; i++) {
        job->effects.change[k][id[i]] = sb_gradient_slope(gradient, k, i) == 0 ? 0 : NAN;
      }
      const size_t found = sb_effects(effect, gradient, k, job->model);
      for (size_t i = 0; i < found; i++) {
        job->effects.change[k][id[effect[i].parameter]] = effect[i].change;
        job->effects.step[id[effect[i].parameter]] = effect[i].step;
      }
    }
    job->good = true;
  }
  sb_gradient_destroy(gradient);
  sb_evaluator_destroy(evaluator);
}

SbEffectJob *sb_effect_job_start(const SbModel *model, void (*done)(void *data), void *data) {
  SbEffectJob *job = g_new0(SbEffectJob, 1);
  job->model = sb_own_model(model);
  sb_worker_start(&job->worker, "effects", work_effect_job, job, done, data);
  return job;
}

bool sb_effect_job_take(const SbEffectJob *job, SbEffects *out) {
  *out = job->effects;
  return job->good;
}

void sb_effect_job_free(SbEffectJob *job) {
  if (job != NULL) {
    sb_worker_finish(&job->worker);
    sb_model_destroy(job->model);
    g_free(job);
  }
}
