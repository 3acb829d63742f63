// How long a solve takes: the median of 20 after one warm-up, within a time budget.
#pragma once

#include "engine/base/status.h"

#include <stddef.h>

#define SB_TIMING_NOTE                                                                             \
  "The time shown (wall_s) is the median of up to 20 cold solves after a warm-up; fewer where "    \
  "they "                                                                                          \
  "would last more than half a second together."

// Median of count > 0 times, which are sorted.
double sb_timing_middle(double *times, size_t count);

// Solves once and reports its time [s].
typedef SbStatus (*SbTimedSolve)(void *data, double *wall_s);

// Calls `solve` once, and while it succeeds and the budget of 0.5 s lasts up to 20 times more.
// Returns the first status that is not SB_OK; *wall_s is the median of the calls after the first
// (of the first if there was no other).
SbStatus sb_timing_median(double *wall_s, SbTimedSolve solve, void *data);
