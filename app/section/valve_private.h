// What the outlines of both kinds of valves share. Internal to valve*.c.
#pragma once

#include "app/section/valve.h"

// A part to be filled point by point; what does not fit is left out.
SbValveSolid *sb_valve_new_solid(SbValveOutline *valve, bool moves);
void sb_valve_add(SbValveSolid *solid, double x, double y);

// The outlines of a gasket valve, the stem with its side port or as if it had none, its channel
// alone.
void sb_valve_gasket_make(SbValveOutline *valve, const SbModel *model, bool port);
