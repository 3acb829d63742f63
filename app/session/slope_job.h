// Derivatives of all figures of a run with solved rings by one parameter after another, with the
// engine's acceptance test (engine/valve/answer/gradient.h), computed in a thread of their own.
#pragma once

#include "engine/valve/answer/gradient.h"

typedef struct SbSlopeJob SbSlopeJob;

// Returns a job for a copy of `model`, which computes nothing yet. Freed by sb_slope_job_free().
SbSlopeJob *sb_slope_job_new(const SbModel *model);

// Starts to compute the derivatives by the real parameter `id`. The job must not be busy.
// done(data) is called once in the main thread at the end, unless the job was freed before. The
// first parameter takes one run more, whose ring states the job stores for the others.
void sb_slope_job_start(SbSlopeJob *job, SbParamId id, void (*done)(void *data), void *data);

// Returns true from the start until sb_slope_job_take().
bool sb_slope_job_is_busy(const SbSlopeJob *job);

// To be called once after each `done`: returns the derivatives of all figures, in the order of
// sb_figure(), by the parameter that is written to *id; NULL: there are none. Freed by
// sb_gradient_destroy().
SbGradient *sb_slope_job_take(SbSlopeJob *job, SbParamId *id);

// Cancels, waits for the thread and frees the job.
void sb_slope_job_free(SbSlopeJob *job);
