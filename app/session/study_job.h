// One drawn study (engine/valve/studies/study.h) in a thread of its own.
#pragma once

#include "engine/valve/studies/study.h"

#include <glib.h>

typedef struct SbStudyJob SbStudyJob;

// Starts to compute a study of a copy of `model`. done(data) is called once in the main thread at
// the end, unless the job was freed before. Freed by sb_study_job_free(). sb_worker_progress() and
// sb_worker_cancel() take the job; `done` follows a cancellation within one solve.
SbStudyJob *sb_study_job_start(SbStudyKind kind, const SbModel *model, void (*done)(void *data),
                               void *data);

// To be called once, after `done`: returns the study, freed by g_free(). NULL: it was cancelled or
// failed; *why is then a sentence, borrowed from the job, and otherwise not changed.
SbStudy *sb_study_job_take(SbStudyJob *job, const char **why);

// Cancels, waits for the thread and frees the job.
void sb_study_job_free(SbStudyJob *job);
