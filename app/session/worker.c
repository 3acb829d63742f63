// See worker.h.
#include "app/session/worker.h"

#include "app/run/process.h"

static gboolean post(gpointer data) {
  SbWorker *worker = data;
  g_mutex_lock(&worker->lock);
  worker->source = 0;
  g_mutex_unlock(&worker->lock);
  worker->done(worker->data);
  return G_SOURCE_REMOVE;
}

static gpointer run(gpointer data) {
  SbWorker *worker = data;
  sb_process_work_behind();
  worker->work(worker->owner);
  g_mutex_lock(&worker->lock);
  worker->source = g_idle_add(post, worker);
  g_mutex_unlock(&worker->lock);
  return NULL;
}

void sb_worker_start(SbWorker *worker, const char *name, void (*work)(void *owner), void *owner,
                     void (*done)(void *data), void *data) {
  *worker = (SbWorker){.work = work, .owner = owner, .done = done, .data = data};
  g_mutex_init(&worker->lock);
  worker->thread = g_thread_new(name, run, worker);
}

void sb_worker_set_progress(void *worker, double share) {
  g_atomic_int_set(&((SbWorker *)worker)->per_mille, (gint)(1000 * share));
}

bool sb_worker_cancelled(void *worker) {
  return g_atomic_int_get(&((SbWorker *)worker)->cancel) != 0;
}

double sb_worker_progress(void *worker) {
  return g_atomic_int_get(&((SbWorker *)worker)->per_mille) / 1000.0;
}

void sb_worker_cancel(void *worker) {
  g_atomic_int_set(&((SbWorker *)worker)->cancel, 1);
}

void sb_worker_finish(SbWorker *worker) {
  sb_worker_cancel(worker);
  g_thread_join(worker->thread);
  if (worker->source != 0) {
    g_source_remove(worker->source);
  }
  g_mutex_clear(&worker->lock);
}
