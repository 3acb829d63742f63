// See the header.
#include "app/session/slope_job.h"

#include "app/base/own_model.h"
#include "app/session/worker.h"

#include <glib.h>

struct SbSlopeJob {
  SbWorker worker;
  bool busy;
  SbModel *model;
  SbEvaluator *rings; // keeps the solved rings; NULL before the first parameter. The thread's
  SbParamId id;
  SbGradient *gradient; // the thread's until it has ended; owned
};

static void work_slope_job(void *owner) {
  SbSlopeJob *job = owner;
  int figure[SB_FIGURE_COUNT];
  double value[SB_FIGURE_COUNT];
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    figure[i] = i;
  }
  SbQuestion question = {.base = job->model,
                         .figure = figure,
                         .figure_count = SB_FIGURE_COUNT,
                         .as_run = true,
                         .keep = true,
                         .cancelled = sb_worker_cancelled,
                         .data = &job->worker};
  if (job->rings == NULL && sb_evaluator_create(&job->rings, NULL) == SB_OK &&
      sb_evaluator_ask(value, job->rings, &question, NULL) != SB_OK) {
    sb_evaluator_destroy(job->rings);
    job->rings = NULL;
  }
  question.keep = false;
  question.start = job->rings;
  SbEvaluator *evaluator = NULL;
  if (job->rings != NULL && sb_evaluator_create(&evaluator, NULL) == SB_OK) {
    (void)sb_gradient_create(&job->gradient, evaluator, &question, &job->id, 1, NULL, NULL);
  }
  sb_evaluator_destroy(evaluator);
}

SbSlopeJob *sb_slope_job_new(const SbModel *model) {
  SbSlopeJob *job = g_new0(SbSlopeJob, 1);
  job->model = sb_own_model(model);
  return job;
}

void sb_slope_job_start(SbSlopeJob *job, SbParamId id, void (*done)(void *data), void *data) {
  job->id = id;
  job->busy = true;
  sb_worker_start(&job->worker, "slopes", work_slope_job, job, done, data);
}

bool sb_slope_job_is_busy(const SbSlopeJob *job) {
  return job->busy;
}

SbGradient *sb_slope_job_take(SbSlopeJob *job, SbParamId *id) {
  sb_worker_finish(&job->worker);
  job->busy = false;
  *id = job->id;
  return g_steal_pointer(&job->gradient);
}

void sb_slope_job_free(SbSlopeJob *job) {
  if (job != NULL) {
    if (job->busy) {
      sb_worker_finish(&job->worker);
    }
    sb_gradient_destroy(job->gradient);
    sb_evaluator_destroy(job->rings);
    sb_model_destroy(job->model);
    g_free(job);
  }
}
