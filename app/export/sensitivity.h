// What figures do as parameters move: the derivatives of a gradient as JSON.
#pragma once

#include "engine/valve/gradient.h"

// The contract's JSON of a scene. Owned by the caller.
char *sb_sensitivity_json(const SbGradient *gradient);
