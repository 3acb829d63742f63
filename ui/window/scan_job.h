// Reads a scan and computes its figures on a thread of its own. All functions of this header run in
// the main thread.
#pragma once

#include "app/export/surface.h"

typedef struct SbScanJob SbScanJob;

// Starts reading `path`. `choices` are lines "name = value" with the names of sb_surface_choose();
// "": the defaults. Both are copied. `done` is called once with `user` in the main thread when the
// job has ended, also after a failure, unless the job was freed before. Never NULL; freed by
// sb_scan_job_free().
SbScanJob *sb_scan_job_start(const char *path, const char *choices, void (*done)(void *data),
                             void *user);

// From the call of `done` on: returns the scan with its figures, and sets *why to NULL; or
// returns NULL, and sets *why to a sentence. Both are borrowed from the job until it is freed.
const SbSurface *sb_scan_job_surface(const SbScanJob *job, const char **why);

// Waits for the thread and frees the job. The scan is read and computed to its end first.
void sb_scan_job_free(SbScanJob *job);
