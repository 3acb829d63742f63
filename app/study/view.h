// The drawn studies: each draws (engine/valve/studies) the results of the grid that a study file in
// assets/studies defines, computed for a given scene.
#pragma once

#include "engine/valve/studies/study.h"

// Computes a study of `model` on all processors; the result does not depend on their number.
// `hooks` may be NULL and is called in the calling thread. Returns SB_OK, also if solvers failed at
// points: out->complete is then false, the curves have gaps and a warning states why.
// SB_ERROR_INFEASIBLE: the scene lacks what the study needs; the report has the input.
// SB_ERROR_INPUT: the study's file is not among the shipped ones, or does not apply to the model;
// SB_ERROR_CANCELLED; or the error of a model that the study derives from `model`. An SbStudy owns
// nothing; it is too large for a stack.
SbStatus sb_study_make(SbStudy *out, SbStudyKind kind, const SbModel *model,
                       const SbStudyHooks *hooks, SbReport *report);
