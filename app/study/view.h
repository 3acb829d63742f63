// The studies that are drawn: each a view (engine/valve/studies) of a grid that a study file in
// assets/studies lays out, asked about the scene at hand.
#pragma once

#include "engine/valve/studies/study.h"

// Computes a study of `model` on all processors; what comes out does not depend on how many there
// are. `hooks` (told on this thread) and `report` may be NULL. As sb_study_view() otherwise;
// SB_ERROR_INPUT, too, where the study's file is not among what ships.
SbStatus sb_study_make(SbStudy *out, SbStudyKind kind, const SbModel *model,
                       const SbStudyHooks *hooks, SbReport *report);
