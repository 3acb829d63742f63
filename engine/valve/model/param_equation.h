// The main equation that a parameter enters, for its help text. The table is constant.
#pragma once

#include "engine/valve/model/params.h"

// An equation; all strings are static.
typedef struct {
  const char *prefix;   // beginning of the keys of its parameters ("rubber."); seal.outer.X and
                        // seal.inner.X count as seal.X; the longest matching prefix applies
  const char *equation; // UTF-8, lines separated by \n
  const char *source;   // author and year, or equation number of the thesis
  const char *room;     // folder or file of the code that solves it, "engine/contact"
} SbParamEquation;

// Returns the equation of a parameter; NULL if it enters none (drawing, output).
const SbParamEquation *sb_param_equation(SbParamId id);
