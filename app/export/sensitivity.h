// What figures do as parameters move: the derivatives of a gradient as JSON.
#pragma once

#include "engine/valve/answer/gradient.h"

// The contract's JSON of a scene; `scene` is the full path of its file, "-" for standard input.
// Owned by the caller (g_free).
char *sb_sensitivity_json(const SbGradient *gradient, const char *scene);
