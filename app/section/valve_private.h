// Shared by valve*.c, which build the outlines of both kinds of valves.
#pragma once

#include "app/section/valve.h"

// Adds a part without points to `valve` and returns it, borrowed; `moves` as in SbValveSolid. At
// most SB_VALVE_SOLIDS_MAX parts.
SbValveSolid *sb_valve_new_solid(SbValveOutline *valve, bool moves);

// Appends a point (x, y) [m]; ignored if the part has SB_VALVE_POINTS_MAX points.
void sb_valve_add(SbValveSolid *solid, double x, double y);

// Builds the outlines of a gasket valve in *valve, which is all zeros before; `housing` is not set.
// `port`: the stem has its side port; else only the channel behind it is drawn.
void sb_valve_gasket_make(SbValveOutline *valve, const SbModel *model, bool port);
