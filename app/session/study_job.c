// The thread of a study. It owns the study until it is done; only two atomic numbers are shared.
#include "app/session/study_job.h"

#include "app/base/own_model.h"
#include "app/session/worker.h"
#include "app/study/view.h"
#include "engine/valve/sealbench.h"

struct SbStudyJob {
  SbWorker worker;
  SbStudyKind kind;
  SbModel *model;
  SbStudy *study; // the thread's until it has ended
  SbStatus status;
  SbReport report;
};

static void work_study_job(void *owner) {
  SbStudyJob *job = owner;
  SbStudyHooks hooks = {sb_worker_set_progress, sb_worker_cancelled, &job->worker};
  job->status = sb_study_make(job->study, job->kind, job->model, &hooks, &job->report);
}

SbStudyJob *sb_study_job_start(SbStudyKind kind, const SbModel *model, void (*done)(void *data),
                               void *data) {
  SbStudyJob *job = g_new0(SbStudyJob, 1);
  job->kind = kind;
  job->model = sb_own_model(model);
  job->study = g_new(SbStudy, 1);
  sb_worker_start(&job->worker, "study", work_study_job, job, done, data);
  return job;
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
  sb_worker_finish(&job->worker);
  g_free(job->study);
  sb_model_destroy(job->model);
  g_free(job);
}
