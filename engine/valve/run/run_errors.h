// Error estimates of a run (run_errors.c). The motion's errors are differences between motions,
// repeated with perturbed states and with other steps; from them and from the states' errors follow
// the errors of all figures. Errors are absolute, in SI; NaN: not known. Order: begin, the motion,
// for each perturbation a motion and add, leak, then fill and check when all figures are set.
#pragma once

#include "engine/valve/run/run_private.h"

// Sets the motion's errors to 0, before a motion.
void sb_run_begin_errors(SbRun *run);

// Sets the motion's errors to NaN, after a motion whose errors are not known.
void sb_run_lose_errors(SbRun *run);

// Adds `share` times the absolute differences between the figures of the summaries `one` and
// `other` of two motions to run->motion_error.
void sb_run_add_errors(SbRun *run, const SbSummary *one, const SbSummary *other, double share);

// Increases the kinetic friction of a state by its error. Returns false, and changes nothing, if
// the state has no such error.
bool sb_run_add_kinetic_error(SbSealState *state);

enum { SB_RUN_PERTURBATIONS = 3 }; // kinds, for sb_run_perturb()

// Perturbs the cycle's states by their errors of one kind, `index` below SB_RUN_PERTURBATIONS: 0
// kinetic friction larger, 1 static friction larger, 2 the ends of the inner contact moved. Returns
// false, and changes nothing, if the states have no error of this kind. The caller saves run->cycle
// before and restores it afterwards.
bool sb_run_perturb(SbRun *run, int index);

// Adds to run->leak_error the part of the last motion's leakage error that comes from the films.
void sb_run_leak_error(SbRun *run);

// Sets summary.error of all figures; the figures and the motion's errors must be set.
void sb_run_fill_errors(SbRun *run);

// Adds a warning to the run if a relative error exceeds the limit SB_ERROR_LARGE. If `status` is
// SB_OK and one exceeds SB_ERROR_USELESS, returns SB_ERROR_NOT_CONVERGED and writes `report`, else
// `status`. NaN exceeds nothing.
SbStatus sb_run_check_errors(SbRun *run, SbStatus status, SbReport *report);
