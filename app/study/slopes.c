// Slopes of figures and threads for tasks; see the header.
#include "app/study/slopes.h"

#include "engine/valve/answer/gradient.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>

// ---- Slopes ----

// A valve that cannot be, or whose solver gave up, is an answer.
static SbStatus settle(SbStatus status, SbReport *report) {
  return status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY ? status : sb_succeed(report);
}

SbStatus sb_slopes(double *value, double *slope, SbEvaluator *evaluator, const SbSlopesAsked *asked,
                   const double *x, SbReport *report) {
  const size_t n = asked->parameters;
  SbOverride override[SB_SLOPES_PARAMETERS];
  SbParamId moved[SB_SLOPES_PARAMETERS];
  size_t column[SB_SLOPES_PARAMETERS], count = 0;
  if (n > SB_SLOPES_PARAMETERS) {
    return sb_fail(report, SB_ERROR_RANGE, "slopes by at most %d parameters", SB_SLOPES_PARAMETERS);
  }
  for (size_t k = 0; k < n; k++) {
    override[k] = (SbOverride){asked->parameter[k], x[k]};
    if (!asked->fixed[k]) {
      column[count] = k;
      moved[count++] = asked->parameter[k];
    }
  }
  for (size_t i = 0; i < asked->figures; i++) {
    value[i] = NAN;
    for (size_t k = 0; slope != NULL && k < n; k++) {
      slope[i * n + k] = asked->fixed[k] ? 0 : NAN;
    }
  }
  const SbQuestion question = {.base = asked->base,
                               .override = override,
                               .override_count = n,
                               .figure = asked->figure,
                               .figure_count = asked->figures,
                               .cancelled = asked->cancelled,
                               .data = asked->data};
  if (slope == NULL) {
    return settle(sb_evaluator_ask(value, evaluator, &question, report), report);
  }
  SbGradient *gradient = NULL;
  const SbStatus status =
      sb_gradient_create(&gradient, evaluator, &question, moved, count, NULL, report);
  for (size_t i = 0; gradient != NULL && i < asked->figures; i++) {
    value[i] = sb_gradient_value(gradient, i);
    for (size_t c = 0; c < count; c++) {
      slope[i * n + column[c]] = sb_gradient_slope(gradient, i, c);
    }
  }
  sb_gradient_destroy(gradient);
  return settle(status, report);
}

// ---- Tasks ----

enum { SLOPES_JOBS_MAX = 256 };

typedef struct {
  SbTask task;
  void *data;
  size_t count;
  atomic_size_t next;
  atomic_bool stop;
  pthread_mutex_t lock;
  // Under the lock: the error of the first task that had one.
  size_t failed;
  SbStatus status;
  SbReport report;
} Tasks;

static void note(Tasks *of, size_t index, SbStatus status, const SbReport *report) {
  if (status == SB_OK) {
    return;
  }
  pthread_mutex_lock(&of->lock);
  if (index < of->failed) {
    of->failed = index;
    of->status = status;
    of->report = *report;
  }
  pthread_mutex_unlock(&of->lock);
  atomic_store(&of->stop, true);
}

static void *work_slopes(void *data) {
  Tasks *of = data;
  SbEvaluator *evaluator = NULL;
  SbReport report = {0};
  const SbStatus status = sb_evaluator_create(&evaluator, &report);
  note(of, SIZE_MAX - 1, status, &report);
  size_t at;
  while (!atomic_load(&of->stop) && (at = atomic_fetch_add(&of->next, 1)) < of->count) {
    const SbStatus done = of->task(of->data, evaluator, at, &report);
    note(of, at, done, &report);
  }
  sb_evaluator_destroy(evaluator);
  return NULL;
}

SbStatus sb_tasks(SbTask task, void *data, size_t count, int jobs, SbReport *report) {
  Tasks of = {.task = task, .data = data, .count = count, .failed = SIZE_MAX};
  pthread_t thread[SLOPES_JOBS_MAX];
  int started = 0;
  pthread_mutex_init(&of.lock, NULL);
  // One of them is the calling thread.
  while (started + 1 < jobs && started < SLOPES_JOBS_MAX && (size_t)started + 1 < count &&
         pthread_create(&thread[started], NULL, work_slopes, &of) == 0) {
    started++;
  }
  (void)work_slopes(&of);
  for (int i = 0; i < started; i++) {
    pthread_join(thread[i], NULL);
  }
  pthread_mutex_destroy(&of.lock);
  if (of.status != SB_OK && report != NULL) {
    *report = of.report;
  }
  return of.status == SB_OK ? sb_succeed(report) : of.status;
}
