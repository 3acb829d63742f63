// The verdict over all cases of a scene, computed on a thread beside the workbench.
#pragma once

#include "app/run/cases.h"
#include "app/run/runner.h"

typedef struct SbCasesJob SbCasesJob;

// Starts it for a whole run of the document's values; takes over the reference `handle`. `done` is
// called once on the main thread unless the job was freed before. Owned by the caller.
SbCasesJob *sb_cases_job_start(SbRunHandle *handle, const SbDocument *document,
                               void (*done)(void *data), void *data);

// The worst answers and the cases that give them; NULL before `done`. Borrowed.
const SbCaseVerdict *sb_cases_job_verdict(const SbCasesJob *job);

// The run that they are of.
const SbRun *sb_cases_job_run(const SbCasesJob *job);

// Cancels, waits, frees. Takes NULL.
void sb_cases_job_free(SbCasesJob *job);
