// The verdict over all cases of a scene (app/run/cases.h), computed in a thread of its own.
#pragma once

#include "app/run/cases.h"
#include "app/run/runner.h"

typedef struct SbCasesJob SbCasesJob;

// Starts the computation for a finished run of the document's values. The job takes over the
// caller's reference `handle`; `document` is copied. done(data) is called once in the main thread
// at the end, unless the job was freed before. Freed by sb_cases_job_free().
SbCasesJob *sb_cases_job_start(SbRunHandle *handle, const SbDocument *document,
                               void (*done)(void *data), void *data);

// Returns the worst answers and the cases that give them, [SB_VERDICT_COUNT]; NULL before `done`,
// or if the document could not be read again. Names in it are valid as long as the job.
const SbCaseVerdict *sb_cases_job_verdict(const SbCasesJob *job);

// Returns the run of the scene itself, from the start on.
const SbRun *sb_cases_job_run(const SbCasesJob *job);

// Cancels, waits for the thread and frees the job.
void sb_cases_job_free(SbCasesJob *job);
