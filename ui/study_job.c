// The thread of a study. It owns the study until it is done; only two atomic numbers are shared.
#include "ui/study_job.h"

struct SbStudyJob {
  SbStudyKind kind;
  SbModel model;
  SbStudy *study; // the thread's until it has ended
  SbStatus status;
  SbReport report;
  GThread *thread;
  void (*done)(void *data);
  void *data;
  GMutex lock;   // guards `source`
  guint source;  // posted by the thread as its last act
  int cancel;    // atomic
  int per_mille; // atomic: progress
};

static void on_progress(void *data, double fraction) {
  SbStudyJob *job = data;
  g_atomic_int_set(&job->per_mille, (int)(1000 * fraction));
}

static bool is_cancelled(void *data) {
  SbStudyJob *job = data;
  return g_atomic_int_get(&job->cancel) != 0;
}

static gboolean post(gpointer data) {
  SbStudyJob *job = data;
  g_mutex_lock(&job->lock);
  job->source = 0;
  g_mutex_unlock(&job->lock);
  job->done(job->data);
  return G_SOURCE_REMOVE;
}

static gpointer work(gpointer data) {
  SbStudyJob *job = data;
  SbStudyHooks hooks = {on_progress, is_cancelled, job};
  job->status = sb_study_make(job->study, job->kind, &job->model, &hooks, &job->report);
  g_mutex_lock(&job->lock);
  job->source = g_idle_add(post, job);
  g_mutex_unlock(&job->lock);
  return NULL;
}

SbStudyJob *sb_study_job_start(SbStudyKind kind, const SbModel *model, void (*done)(void *data),
                               void *data) {
  SbStudyJob *job = g_new0(SbStudyJob, 1);
  job->kind = kind;
  job->model = *model;
  job->study = g_new(SbStudy, 1);
  job->done = done;
  job->data = data;
  g_mutex_init(&job->lock);
  job->thread = g_thread_new("study", work, job);
  return job;
}

double sb_study_job_progress(SbStudyJob *job) {
  return g_atomic_int_get(&job->per_mille) / 1000.0;
}

void sb_study_job_cancel(SbStudyJob *job) {
  g_atomic_int_set(&job->cancel, 1);
}

SbStudy *sb_study_job_take(SbStudyJob *job, const char **why) {
  if (job->status != SB_OK) {
    *why = job->report.text[0] != '\0' ? job->report.text : sb_status_text(job->status);
    return NULL;
  }
  return g_steal_pointer(&job->study);
}

void sb_study_job_free(SbStudyJob *job) {
  if (job == NULL) {
    return;
  }
  sb_study_job_cancel(job);
  g_thread_join(job->thread);
  if (job->source != 0) {
    g_source_remove(job->source);
  }
  g_mutex_clear(&job->lock);
  g_free(job->study);
  g_free(job);
}
