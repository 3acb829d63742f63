// Effects of parameters on a figure, each for a usual change of the parameter.
#pragma once

#include "engine/valve/answer/gradient.h"

// Change of a figure if a parameter increases by its tolerance, or by 5 % if it has none.
typedef struct {
  size_t parameter; // index of the parameter in the gradient
  double step;      // increase of the parameter [SI], > 0
  bool tolerance;   // `step` is the parameter's tolerance; else 5 % of its value
  double change;    // of the figure [SI], with its sign
  double error;     // estimate of the error of `change` [SI], > 0
} SbEffect;

// Writes the effects on figure `figure` (index in the gradient's list of figures) to
// out[sb_gradient_parameters(gradient)], the largest magnitude first, and returns their number.
// Parameters whose derivative is 0 or unknown are omitted. `model` is the one at which the gradient
// was computed.
size_t sb_effects(SbEffect *out, const SbGradient *gradient, size_t figure, const SbModel *model);
