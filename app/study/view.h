// The drawn studies: each draws (engine/valve/studies) the results of the grid that a study file in
// assets/studies defines, computed for a given scene.
#pragma once

#include "engine/valve/studies/study.h"

// Computes a study of `model` on all processors; the result does not depend on their number.
// `hooks` may be NULL and is called in the calling thread. Returns as sb_study_view(), and
// SB_ERROR_INPUT if the study's file is not among the shipped ones. *out is complete after SB_OK;
// out->complete is false if points are missing. An SbStudy owns nothing; it is too large for a
// stack.
SbStatus sb_study_make(SbStudy *out, SbStudyKind kind, const SbModel *model,
                       const SbStudyHooks *hooks, SbReport *report);
