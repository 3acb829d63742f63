// One calibration on a thread of its own: a study goes in, what it found comes out.
#pragma once

#include "app/study/calibrate.h"

typedef struct SbCalibrateJob SbCalibrateJob;

// Starts it; takes the study over. `done` is called once on the main thread unless the job was
// freed before. Owned by the caller.
SbCalibrateJob *sb_calibrate_job_start(SbStudyFile *study, void (*done)(void *data), void *data);

// Share done, 0 to 1.
double sb_calibrate_job_progress(SbCalibrateJob *job);

// Asks it to end; returns at once.
void sb_calibrate_job_cancel(SbCalibrateJob *job);

// Only after `done`: what was found, to be released by the caller, and its study, for the caller
// to free. False with a sentence in *why (owned by the caller). Once.
bool sb_calibrate_job_take(SbCalibrateJob *job, SbCalibration *out, SbStudyFile **study,
                           char **why);

// Cancels, waits, frees. Takes NULL.
void sb_calibrate_job_free(SbCalibrateJob *job);
