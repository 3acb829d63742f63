// Time of a solve: the median of up to 20 calls after one warm-up, within a time budget.
#pragma once

#include "engine/base/status.h"

// Note of commands that print such a time.
#define SB_TIMING_NOTE                                                                             \
  "The time shown (wall_s) is the median of up to 20 cold solves after a warm-up; fewer if they "  \
  "would last more than half a second together."

// Solves once, from scratch, and writes the time that the solve took to *wall_s [s].
typedef SbStatus (*SbTimedSolve)(void *data, double *wall_s);

// Calls `solve` once, and while it returns SB_OK and the budget of 0.5 s lasts (the first call
// counts), up to 20 times more. Returns the first status that is not SB_OK, else SB_OK. *wall_s is
// the median of the calls after the first (of the first if there was no other) [s].
SbStatus sb_timing_median(double *wall_s, SbTimedSolve solve, void *data);
