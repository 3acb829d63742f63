// See measure_job.h.
#include "app/session/measure_job.h"

#include "app/session/worker.h"

struct SbMeasureJob {
  SbWorker worker;
  SbData *data;
  double speed;
  SbMeasured *measured;
  GPtrArray *issues;
};

static void work_measure_job(void *owner) {
  SbMeasureJob *job = owner;
  job->measured = sb_measured_read(job->data, job->speed, NULL, 0, job->issues);
}

SbMeasureJob *sb_measure_job_start(SbData *data, double speed, void (*done)(void *data),
                                   void *user) {
  SbMeasureJob *job = g_new0(SbMeasureJob, 1);
  job->data = data;
  job->speed = speed;
  job->issues = sb_issues_new();
  sb_worker_start(&job->worker, "measured", work_measure_job, job, done, user);
  return job;
}

SbMeasured *sb_measure_job_take(SbMeasureJob *job, const SbIssue **why) {
  *why = job->measured == NULL ? job->issues->pdata[0] : NULL;
  return g_steal_pointer(&job->measured);
}

void sb_measure_job_free(SbMeasureJob *job) {
  if (job == NULL) {
    return;
  }
  sb_worker_finish(&job->worker);
  sb_measured_free(job->measured);
  sb_data_free(job->data);
  g_ptr_array_unref(job->issues);
  g_free(job);
}
