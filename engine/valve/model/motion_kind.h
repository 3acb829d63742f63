// What the choices of models.motion compute: one row for each choice. Pure functions, for any
// thread.
#pragma once

#include "engine/valve/model/valve.h"

// A choice of models.motion.
typedef struct {
  bool valve;   // the valve moves: there are seals, doses and limits; else the sliding plate
  bool inertia; // the masses have inertia; else forces balance at each instant
  bool joints;  // the parts are constrained bodies, with reactions in their joints
  bool lives;   // a life of many actuations can follow (life.actuations)
} SbMotionKind;

// Returns the row of a choice (SB_MODEL_MOTION_...); static.
const SbMotionKind *sb_motion_choice(int choice);

// Returns the row of the model's choice; static.
const SbMotionKind *sb_motion_kind(const SbModel *model);
