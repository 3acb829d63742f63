// The equation that a parameter enters first, for the help of its row: text, where it is from and
// the folder that solves it. docs/physics.md has the same with range and what is left out.
#pragma once

#include "engine/valve/params.h"

typedef struct {
  const char *prefix;   // of keys that it is for; seal.outer.X and seal.inner.X are as seal.X
  const char *equation; // UTF-8, lines apart by \n
  const char *source;   // author and year, or the thesis' number
  const char *room;     // folder or file of the source
} SbParamEquation;

// NULL where a parameter enters none: it says what is drawn, asked or put out.
const SbParamEquation *sb_param_equation(SbParamId id);
