// What figures do as parameters move by what is usual of each, for people.
#pragma once

#include "engine/valve/answer/gradient.h"

// A figure's change as a parameter moves by its tolerance, or by 5 % where it has none.
typedef struct {
  size_t parameter; // of the gradient
  double step;      // by which it moves [SI], > 0
  bool tolerance;   // its own; else 5 % of what it is
  double change;    // of the figure [SI]
  double error;     // estimate of the change's error [SI], > 0
} SbEffect;

// Those of the parameters by which the figure has a derivative that is not 0, the greatest change
// first. Returns their number; writes as many as there are parameters at most.
size_t sb_effects(SbEffect *out, const SbGradient *gradient, size_t figure, const SbModel *model);
