// Reads a scan and finds its figures on a thread beside the window.
#pragma once

#include "app/export/surface.h"

typedef struct SbScanJob SbScanJob;

// `choices` are lines "name = value" by the names of sb_surface_choose(). `done` is called once on
// the main thread unless the job is freed before.
SbScanJob *sb_scan_job_start(const char *path, const char *choices, void (*done)(void *data),
                             void *user);

// Once it is done: what was found, or NULL and why. Both belong to the job.
const SbSurface *sb_scan_job_surface(const SbScanJob *job, const char **why);

// Waits for the thread; takes NULL.
void sb_scan_job_free(SbScanJob *job);
