// The results of `sealbench design` as JSON.
#pragma once

#include "app/study/design.h"

// Returns the index (in study->limits) of the violated limit with the smallest violation relative
// to the larger magnitude of bound and figure; -1: no limit is violated. Requires design->found.
int sb_design_least_missed(const SbDesign *design, const SbStudyFile *study);

// Returns the column (in study->figures) of the first figure that has no value; -1: all have one.
int sb_design_lacking(const SbDesign *design);

// Returns why no design was found (design->found must be false), without a full stop.
char *sb_design_lacking_text(const SbStudyFile *study, const SbDesign *design);

// Returns the JSON document of `sealbench design`.
char *sb_design_json(const SbStudyFile *study, const SbDesign *design);
