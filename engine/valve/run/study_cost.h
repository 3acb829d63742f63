// Predicted time of a drawn study.
#pragma once

#include "engine/valve/model/study_kinds.h"
#include "engine/valve/model/valve.h"

// Returns the predicted processor time [s] of a study of `model`, accurate to a factor of two or
// three (cost.h); 0 if `kind` is outside the enumeration.
double sb_study_cost(SbStudyKind kind, const SbModel *model);
