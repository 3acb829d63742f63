// The engine's thread. Requests go through a mailbox of one slot; cancelling is a ticket number up
// to which everything is void, so that a late cancel can never hit the next request.
#include "app/run/runner.h"

#include "app/base/own_model.h"
#include "app/run/process.h"
#include "engine/base/clock.h"

#include <locale.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

struct SbRunHandle {
  atomic_uint references;
  unsigned ticket;
  SbRun *run;
  SbReport report;
  SbStatus status;
  atomic_uint permille;
  atomic_bool done; // released after status and report are written
};

struct SbRunner {
  pthread_t thread;
  SbRunnerNotify notify;
  void *data;
  bool last;
  atomic_uint void_up_to; // tickets up to this one are cancelled

  pthread_mutex_t mutex; // guards what follows
  pthread_cond_t wake;
  bool quit;
  SbRunRequest waiting; // asked for and not yet begun, owned; model NULL: none
  unsigned ticket;      // last one given out
  unsigned finished;    // last one that ended or was dropped
  SbRunHandle *latest;  // one reference
};

SbRunHandle *sb_run_handle_ref(SbRunHandle *handle) {
  atomic_fetch_add_explicit(&handle->references, 1, memory_order_relaxed);
  return handle;
}

void sb_run_handle_unref(SbRunHandle *handle) {
  if (handle != NULL &&
      atomic_fetch_sub_explicit(&handle->references, 1, memory_order_acq_rel) == 1) {
    sb_run_destroy(handle->run);
    free(handle);
  }
}

SbRunHandle *sb_run_handle_of(SbRun *run) {
  SbRunHandle *handle = calloc(1, sizeof *handle);
  if (handle == NULL) {
    sb_run_destroy(run);
    return NULL;
  }
  atomic_init(&handle->references, 1);
  atomic_init(&handle->permille, 1000);
  atomic_init(&handle->done, true);
  handle->run = run;
  handle->status = SB_OK;
  return handle;
}

const SbRun *sb_run_handle_run(const SbRunHandle *handle) {
  return handle->run;
}

unsigned sb_run_handle_ticket(const SbRunHandle *handle) {
  return handle->ticket;
}

double sb_run_handle_fraction(const SbRunHandle *handle) {
  return atomic_load_explicit(&handle->permille, memory_order_relaxed) / 1000.0;
}

bool sb_run_handle_is_done(const SbRunHandle *handle) {
  return atomic_load_explicit(&handle->done, memory_order_acquire);
}

SbStatus sb_run_handle_status(const SbRunHandle *handle) {
  return handle->status;
}

const SbReport *sb_run_handle_report(const SbRunHandle *handle) {
  return &handle->report;
}

// What one run's hooks know.
typedef struct {
  SbRunner *runner;
  SbRunHandle *handle;
  double notified; // [s]
} Job;

static bool is_cancelled(void *data) {
  const Job *job = data;
  return atomic_load_explicit(&job->runner->void_up_to, memory_order_relaxed) >=
         job->handle->ticket;
}

static void on_runner_progress(void *data, double fraction, size_t frames) {
  const double interval = 0.015;
  Job *job = data;
  unsigned permille = fraction > 0 ? (unsigned)(1000 * fraction) : 0;
  atomic_store_explicit(&job->handle->permille, permille, memory_order_relaxed);
  double time = sb_clock_seconds();
  if (time - job->notified >= interval) {
    job->notified = time;
    job->runner->notify(job->runner->data);
  }
}

// Makes `handle` the latest; the runner takes over the caller's reference.
static void show(SbRunner *runner, SbRunHandle *handle) {
  pthread_mutex_lock(&runner->mutex);
  SbRunHandle *before = runner->latest;
  runner->latest = handle;
  pthread_mutex_unlock(&runner->mutex);
  sb_run_handle_unref(before);
  runner->notify(runner->data);
}

static void clear_request(SbRunRequest *request) {
  sb_model_destroy(request->model);
  sb_run_handle_unref(request->start);
  *request = (SbRunRequest){0};
}

static void compute(SbRunner *runner, const SbRunRequest *request, unsigned ticket) {
  SbRunHandle *handle = calloc(1, sizeof *handle);
  if (handle == NULL) {
    return;
  }
  atomic_init(&handle->references, 2); // the runner's `latest`, and ours
  atomic_init(&handle->permille, 0);
  atomic_init(&handle->done, false);
  handle->ticket = ticket;
  SbPlan plan;
  sb_plan_wished(&plan, request->model, &request->wishes);
  handle->status = sb_run_create(&handle->run, request->model, &plan, &handle->report);
  if (handle->status == SB_OK) {
    show(runner, handle);
    Job job = {runner, handle, 0};
    SbRunHooks hooks = {.progress = on_runner_progress,
                        .cancelled = is_cancelled,
                        .data = &job,
                        .alone = request->alone};
    if (request->keep) {
      sb_run_keep_rings(handle->run);
    }
    (request->tangent ? sb_run_predict_from : sb_run_start_from)(
        handle->run, request->start != NULL ? request->start->run : NULL);
    handle->status = sb_run_execute(handle->run, &hooks, &handle->report);
    sb_run_start_from(handle->run, NULL);
    if (request->keep) {
      sb_run_end_rings(handle->run);
    }
    atomic_store_explicit(&handle->permille, 1000, memory_order_relaxed);
    atomic_store_explicit(&handle->done, true, memory_order_release);
    if (request->keep && handle->status == SB_OK) {
      runner->notify(runner->data);
      sb_run_prepare_rings(handle->run, is_cancelled, &job);
    }
  } else {
    atomic_store_explicit(&handle->done, true, memory_order_release);
    show(runner, handle);
  }
  sb_run_handle_unref(handle);
}

static void *work(void *data) {
  SbRunner *runner = data;
  sb_process_work_behind();
  if (runner->last) {
    sb_process_work_behind();
  }
  // Messages and numbers read the same whatever the program's locale.
  locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  if (plain != (locale_t)0) {
    uselocale(plain);
  }
  pthread_mutex_lock(&runner->mutex);
  while (!runner->quit) {
    if (runner->waiting.model == NULL) {
      pthread_cond_wait(&runner->wake, &runner->mutex);
      continue;
    }
    SbRunRequest request = runner->waiting;
    runner->waiting = (SbRunRequest){0};
    unsigned ticket = runner->ticket;
    pthread_mutex_unlock(&runner->mutex);
    compute(runner, &request, ticket);
    clear_request(&request);
    pthread_mutex_lock(&runner->mutex);
    runner->finished = ticket;
    pthread_mutex_unlock(&runner->mutex);
    // Last of all: now the runner is not busy any more.
    runner->notify(runner->data);
    pthread_mutex_lock(&runner->mutex);
  }
  pthread_mutex_unlock(&runner->mutex);
  if (plain != (locale_t)0) {
    uselocale(LC_GLOBAL_LOCALE);
    freelocale(plain);
  }
  return NULL;
}

SbRunner *sb_runner_create(SbRunnerNotify notify, void *data, bool last) {
  SbRunner *runner = calloc(1, sizeof *runner);
  if (runner == NULL) {
    return NULL;
  }
  runner->notify = notify;
  runner->last = last;
  runner->data = data;
  atomic_init(&runner->void_up_to, 0);
  pthread_mutex_init(&runner->mutex, NULL);
  pthread_cond_init(&runner->wake, NULL);
  if (pthread_create(&runner->thread, NULL, work, runner) != 0) {
    pthread_cond_destroy(&runner->wake);
    pthread_mutex_destroy(&runner->mutex);
    free(runner);
    return NULL;
  }
  return runner;
}

void sb_runner_destroy(SbRunner *runner) {
  if (runner == NULL) {
    return;
  }
  sb_runner_cancel(runner);
  pthread_mutex_lock(&runner->mutex);
  runner->quit = true;
  pthread_cond_signal(&runner->wake);
  pthread_mutex_unlock(&runner->mutex);
  pthread_join(runner->thread, NULL);
  sb_run_handle_unref(runner->latest);
  clear_request(&runner->waiting);
  pthread_cond_destroy(&runner->wake);
  pthread_mutex_destroy(&runner->mutex);
  free(runner);
}

unsigned sb_runner_submit(SbRunner *runner, const SbRunRequest *request) {
  SbRunRequest own = *request;
  own.model = sb_own_model(request->model);
  own.start = own.start != NULL ? sb_run_handle_ref(own.start) : NULL;
  pthread_mutex_lock(&runner->mutex);
  atomic_store_explicit(&runner->void_up_to, runner->ticket, memory_order_relaxed);
  unsigned ticket = ++runner->ticket;
  SbRunRequest dropped = runner->waiting;
  runner->waiting = own;
  pthread_cond_signal(&runner->wake);
  pthread_mutex_unlock(&runner->mutex);
  clear_request(&dropped);
  return ticket;
}

void sb_runner_cancel(SbRunner *runner) {
  pthread_mutex_lock(&runner->mutex);
  atomic_store_explicit(&runner->void_up_to, runner->ticket, memory_order_relaxed);
  SbRunRequest dropped = runner->waiting;
  runner->waiting = (SbRunRequest){0};
  if (dropped.model != NULL) {
    runner->finished = runner->ticket;
  }
  pthread_mutex_unlock(&runner->mutex);
  clear_request(&dropped);
}

bool sb_runner_is_busy(SbRunner *runner) {
  pthread_mutex_lock(&runner->mutex);
  bool busy = runner->finished != runner->ticket;
  pthread_mutex_unlock(&runner->mutex);
  return busy;
}

SbRunHandle *sb_runner_latest(SbRunner *runner) {
  pthread_mutex_lock(&runner->mutex);
  SbRunHandle *handle = runner->latest != NULL ? sb_run_handle_ref(runner->latest) : NULL;
  pthread_mutex_unlock(&runner->mutex);
  return handle;
}
