// Reads a measured loop on a thread beside the window.
#pragma once

#include "app/data/measured.h"

typedef struct SbMeasureJob SbMeasureJob;

// `data` is taken over; `speed` as sb_measured_load(). `done` is called once on the main thread
// unless the job is freed before.
SbMeasureJob *sb_measure_job_start(SbData *data, double speed, void (*done)(void *data),
                                   void *user);

// What was asked; borrowed.
const SbData *sb_measure_job_data(const SbMeasureJob *job);

// Once it is done: the loop (owned by the caller), or NULL and why in *why (owned by the caller).
SbMeasured *sb_measure_job_take(SbMeasureJob *job, char **why);

// Waits for the thread; takes NULL.
void sb_measure_job_free(SbMeasureJob *job);
