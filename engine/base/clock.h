// A monotonic clock for measuring durations.
#pragma once

#include <time.h>

// Returns the time in seconds since an unspecified instant. It never decreases; only differences
// have a meaning. May be called from any thread.
static inline double sb_clock_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
