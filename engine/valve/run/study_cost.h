// Predicted time of a drawn study.
#pragma once

#include "engine/valve/model/study_kinds.h"
#include "engine/valve/model/valve.h"

// Sizes of the drawn studies, from which the number of solves follows.
enum {
  SB_SQUEEZE_RING_POINTS = 20, // points of the curve of a ring model
  SB_SQUEEZE_DISC_POINTS = 39, // points of the curve of a disc model
  SB_SQUEEZE_TABLE = 4,        // squeezes of the table in addition to that of the design
  SB_MODELS_PRESSURES = 5,
  SB_MODELS_SIZES = 5, // sizes at one pressure, the nominal one included
  SB_FILM_LAW_SPEEDS = 14,
  SB_FILM_LAW_LOADS = 5,
  SB_STORAGE_POINTS = 33, // points of a curve
  SB_STORAGE_TIMES = 7,   // times of the table in addition to that of the scene
  SB_LEAK_LINES = 5,
  SB_LEAK_POINTS = 39,      // points of a line
  SB_LEAK_RING_POINTS = 20, // points of a line of solved rings
  SB_LEAK_FINE = 9,         // additional points where the leak begins
  SB_LEAK_ROWS = 11,        // rows of the table
  SB_STRIBECK_LINES = 4,
  SB_STRIBECK_POINTS = 41,  // speeds of a line
  SB_TOLERANCE_SIZES = 7,   // sizes that vary
  SB_TOLERANCE_STEPS = 2,   // steps on either side of the nominal size
  SB_TOLERANCE_FIGURES = 5, // figures, each with two worst corners
  SB_PROPELLANTS_FLUIDS = 4,
  SB_PROPELLANTS_POINTS = 29, // temperatures of a curve
  SB_PROPELLANTS_TABLE = 5,   // temperatures of the table
  SB_PROPELLANTS_PARTS = 5    // parts of a change: all, pressure, film, rubber, expansion
};

// Returns the predicted processor time [s] of a study of `model`, accurate to a factor of two or
// three (cost.h); 0 if `kind` is outside the enumeration.
double sb_study_cost(SbStudyKind kind, const SbModel *model);
