// The derivatives of figures with respect to parameters as JSON.
#pragma once

#include "engine/valve/answer/gradient.h"

// Returns the JSON document of `sealbench sensitivity`. `scene` is the full path of its file, "-"
// for standard input.
char *sb_sensitivity_json(const SbGradient *gradient, const char *scene);
