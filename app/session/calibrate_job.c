// The thread of a calibration, which owns study and result until it is done.
#include "app/session/calibrate_job.h"

#include "app/session/worker.h"

struct SbCalibrateJob {
  SbWorker worker;
  SbStudyFile *study;
  SbCalibration found;
  bool started; // `found` is to be released
  GPtrArray *issues;
  SbStatus status;
  SbReport report;
};

static void work_calibrate_job(void *owner) {
  SbCalibrateJob *job = owner;
  const SbCalibrateHooks hooks = {.jobs = 1,
                                  .cancelled = sb_worker_cancelled,
                                  .progress = sb_worker_set_progress,
                                  .data = &job->worker};
  job->started = true;
  job->status = sb_calibrate(&job->found, job->study, &hooks, job->issues, &job->report);
}

SbCalibrateJob *sb_calibrate_job_start(SbStudyFile *study, void (*done)(void *data), void *data) {
  SbCalibrateJob *job = g_new0(SbCalibrateJob, 1);
  job->study = study;
  job->issues = sb_issues_new();
  sb_worker_start(&job->worker, "calibrate", work_calibrate_job, job, done, data);
  return job;
}

bool sb_calibrate_job_take(SbCalibrateJob *job, SbCalibration *out, SbStudyFile **study,
                           char **why) {
  const bool best = job->status == SB_ERROR_CANCELLED && job->found.partial;
  if (job->status != SB_OK && job->status != SB_ERROR_NOT_CONVERGED && !best) {
    *why = job->issues->len > 0          ? sb_issue_line(job->issues->pdata[0])
           : job->report.text[0] != '\0' ? g_strdup(job->report.text)
                                         : g_strdup(sb_status_text(job->status));
    return false;
  }
  *out = job->found;
  job->started = false;
  *study = g_steal_pointer(&job->study);
  return true;
}

void sb_calibrate_job_free(SbCalibrateJob *job) {
  if (job == NULL) {
    return;
  }
  sb_worker_finish(&job->worker);
  if (job->started) {
    sb_calibration_release(&job->found);
  }
  sb_study_file_free(job->study);
  g_ptr_array_unref(job->issues);
  g_free(job);
}
