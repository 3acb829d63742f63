// What a scene computes, as views and texts show it: a valve with rings, a valve with gaskets, or
// the sliding plate. One row for each. Code that shows these in different ways reads a property of
// the row. Pure functions, for any thread. Names are marked for translation: `_(row->force)`.
#pragma once

#include "engine/valve/figures/summary.h"
#include "engine/valve/model/valve.h"

typedef struct {
  // A stem moves: there are stages, a dose, a verdict and a section to draw. Else a thread pulls
  // the plate, and its force is shown over time.
  bool stem;
  bool gland;        // the seals are rings in glands
  bool pressure_map; // where the fluids' pressures act is an input; else it follows from the stem

  SbParamId across, up; // parameters on the axes of a new map of designs

  const char *seal[SB_SEAL_COUNT];       // "Inner seal"
  const char *short_name[SB_SEAL_COUNT]; // "inner"
  const char *friction[SB_SEAL_COUNT];   // of the seal, among the forces on the stem
  const char *off[SB_SEAL_COUNT];        // why the seal has no load now
  // What moves while the velocity of the frame is positive [0] and negative [1].
  const char *moves[2];
  // What happens after a stage until the next one; NULL: the contacts of the frames decide.
  const char *phase[SB_STAGE_COUNT];

  const char *loop;    // "Force and displacement"
  const char *axes;    // its units
  const char *force;   // force of a frame
  const char *picture; // what the section's view shows; NULL: the valve
} SbDevice;

// Returns the row of a choice of valve.kind; static.
const SbDevice *sb_device_of_kind(int kind);

// Returns the row of a model (NULL: the valve with rings); static.
const SbDevice *sb_device(const SbModel *model);
