// One calibration on a thread of its own. All functions of this header run in the main thread.
#pragma once

#include "app/study/calibrate.h"

typedef struct SbCalibrateJob SbCalibrateJob;

// Starts the calibration of `study`, which the job owns from now on. `done` is called once in the
// main thread when it has ended, also after failure or cancellation, unless the job was freed
// before. Never NULL; freed by sb_calibrate_job_free(). sb_worker_progress() and sb_worker_cancel()
// of app/session/worker.h take the job.
SbCalibrateJob *sb_calibrate_job_start(SbStudyFile *study, void (*done)(void *data), void *data);

// Once, after `done`: moves the result to the caller: `out`, freed by sb_calibration_release(), and
// its study, freed by sb_study_file_free() after `out`. Returns true also if the fit has not
// converged, or if it was cancelled and has estimates (out->partial); *why is then not changed.
// Otherwise returns false, with `out` and `study` not changed, and sets *why to a sentence, freed
// by g_free().
bool sb_calibrate_job_take(SbCalibrateJob *job, SbCalibration *out, SbStudyFile **study,
                           char **why);

// Cancels, waits for the thread and frees.
void sb_calibrate_job_free(SbCalibrateJob *job);
