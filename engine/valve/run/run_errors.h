// Error estimates of a run's figures (run_errors.c): of the motion, by the differences between
// motions with perturbed states and other steps, and of all figures.
#pragma once

#include "engine/valve/run/run_private.h"

// Sets the motion's errors to 0, before a motion.
void sb_run_begin_errors(SbRun *run);

// Sets the motion's errors to NaN, after a motion whose errors are not known.
void sb_run_lose_errors(SbRun *run);

// Adds `share` times the absolute differences between the figures of the summaries `one` and
// `other` of two motions to run->motion_error.
void sb_run_add_errors(SbRun *run, const SbSummary *one, const SbSummary *other, double share);

enum { SB_RUN_PERTURBATIONS = 3 }; // kinds, for sb_run_perturb()

// Increases the kinetic friction of a state by its error. Returns false, and changes nothing, if
// there is none.
bool sb_run_add_kinetic_error(SbSealState *state);

// Perturbs the cycle's states by their errors of one kind, `index` below SB_RUN_PERTURBATIONS: 0
// kinetic friction larger, 1 static friction larger, 2 the ends of the inner contact moved. Returns
// false, and changes nothing, if the states have no error of this kind.
bool sb_run_perturb(SbRun *run, int index);

// Adds the error of the last motion's leakage that its films cause.
void sb_run_leak_error(SbRun *run);

// Sets summary.error of all figures; the figures and the motion's errors must be set.
void sb_run_fill_errors(SbRun *run);

// Warns of errors above SB_ERROR_LARGE. Returns SB_ERROR_NOT_CONVERGED instead of SB_OK for an
// error above SB_ERROR_USELESS, else `status`.
SbStatus sb_run_check_errors(SbRun *run, SbStatus status, SbReport *report);
