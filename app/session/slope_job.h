// Derivatives of all figures of a run of solved rings by one parameter after another, with the
// engine's acceptance test (engine/valve/answer/gradient.h), computed on a thread of its own.
#pragma once

#include "engine/valve/answer/gradient.h"

typedef struct SbSlopeJob SbSlopeJob;

// Returns a job on a copy of `model`, which computes nothing yet. Freed by sb_slope_job_free().
SbSlopeJob *sb_slope_job_new(const SbModel *model);

// Starts the derivatives by a real parameter. The job must not be busy. `done` is called once on
// the main thread unless the job is freed before. The first parameter takes one run more, whose
// rings the job stores.
void sb_slope_job_start(SbSlopeJob *job, SbParamId id, void (*done)(void *data), void *data);

// Returns true from the start until sb_slope_job_take().
bool sb_slope_job_is_busy(const SbSlopeJob *job);

// Returns the derivatives, of all figures in the order of figures.def by *id, NULL where there are
// none. Only after `done`. Freed by sb_gradient_destroy().
SbGradient *sb_slope_job_take(SbSlopeJob *job, SbParamId *id);

// Cancels, waits, frees. Takes NULL.
void sb_slope_job_free(SbSlopeJob *job);
