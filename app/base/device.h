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

  // By seal, [SB_OUTER] and [SB_INNER].
  const char *seal[SB_SEAL_COUNT];       // its name, "Outer seal"
  const char *short_name[SB_SEAL_COUNT]; // "outer"
  const char *friction[SB_SEAL_COUNT];   // label of its friction among the forces on the stem
  const char *off[SB_SEAL_COUNT];        // text shown while the seal has no load
  // What moves while the velocity of the frame is positive [0] and negative [1].
  const char *moves[2];
  // What happens after a stage until the next one; NULL: the contacts of the frames decide.
  const char *phase[SB_STAGE_COUNT];

  const char *loop;    // title of the chart of the force, "Force and displacement"
  const char *axes;    // units of the axes of this chart, "N over mm"
  const char *force;   // label of the force of a frame
  const char *picture; // what the section's view shows; NULL: the valve
} SbDevice;

// Returns the row of a valve of `kind`, the index of a choice of the parameter valve.kind; static.
const SbDevice *sb_device_of_kind(int kind);

// Returns the row of a model (NULL: the valve with rings); static.
const SbDevice *sb_device(const SbModel *model);
