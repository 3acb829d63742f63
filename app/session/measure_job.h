// Reads a measured loop (app/data/measured.h) in a thread of its own.
#pragma once

#include "app/data/measured.h"

typedef struct SbMeasureJob SbMeasureJob;

// Starts to read the file of `data`, which the job owns from now on. `speed` is the speed of the
// scene's drive [m/s], for a file without displacement (sb_session_drive_speed(); 0: not constant).
// done(user) is called once in the main thread at the end, unless the job was freed before. Freed
// by sb_measure_job_free().
SbMeasureJob *sb_measure_job_start(SbData *data, double speed, void (*done)(void *data),
                                   void *user);

// To be called once, after `done`: returns the loop, freed by sb_measured_free(). NULL: it could
// not be read; *why is then the reason, borrowed from the job, otherwise NULL.
SbMeasured *sb_measure_job_take(SbMeasureJob *job, const SbIssue **why);

// Waits until the file is read and frees the job.
void sb_measure_job_free(SbMeasureJob *job);
