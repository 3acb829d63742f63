// One study on a thread of its own: a model goes in, a finished study comes out.
#pragma once

#include "engine/valve/studies/study.h"

#include <glib.h>

typedef struct SbStudyJob SbStudyJob;

// Starts it on a copy of `model`. `done` is called once on the main thread unless the job was freed
// before. Owned by the caller.
SbStudyJob *sb_study_job_start(SbStudyKind kind, const SbModel *model, void (*done)(void *data),
                               void *data);

// Share done, 0 to 1.
double sb_study_job_progress(SbStudyJob *job);

// Asks it to end; returns at once, the job ends within one solve.
void sb_study_job_cancel(SbStudyJob *job);

// Only after `done`: the study for the caller to keep (g_free), or NULL with a sentence in `*why`
// (borrowed). Once.
SbStudy *sb_study_job_take(SbStudyJob *job, const char **why);

// Cancels, waits, frees. Takes NULL.
void sb_study_job_free(SbStudyJob *job);
