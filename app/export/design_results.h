// What a search for a design found, as JSON.
#pragma once

#include "app/study/design.h"

// The limit that is missed by the least part of itself, -1: none is.
int sb_design_least_missed(const SbDesign *design, const SbStudyFile *study);

// The contract's JSON. Owned by the caller.
char *sb_design_json(const SbStudyFile *study, const SbDesign *design);
