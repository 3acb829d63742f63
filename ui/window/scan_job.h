// Reads a scan and computes its figures on a thread of its own. All functions of this header run in
// the main thread.
#pragma once

#include "app/export/surface.h"

typedef struct SbScanJob SbScanJob;

// Starts reading `path`. `choices` are lines "name = value" with the names of sb_surface_choose().
// Both are copied. `done` is called once with `user` in the main thread when it has ended, also
// after a failure, unless the job was freed before. Never NULL; freed by sb_scan_job_free().
SbScanJob *sb_scan_job_start(const char *path, const char *choices, void (*done)(void *data),
                             void *user);

// After `done`: returns the figures, and sets `*why` to NULL; or returns NULL, and sets `*why` to a
// sentence. Both are borrowed from the job.
const SbSurface *sb_scan_job_surface(const SbScanJob *job, const char **why);

// Cancels, waits for the thread and frees. Takes NULL.
void sb_scan_job_free(SbScanJob *job);
