// What measured.c leaves to measured_find.c.
#pragma once

#include "app/data/measured.h"

// Turns, zeroes and cuts the rows as they are in the file (SI), and finds the stages; `data` says
// what is not to be found. False with an issue.
bool sb_measured_find(SbMeasured *measured, const SbData *data, GPtrArray *issues);

// A cycle of those found; borrowed.
const SbMeasuredCycle *sb_measured_cycle(const SbMeasured *measured, size_t index);
