// The clock of everything that tells how long it took.
#pragma once

#include <time.h>

// Seconds since some instant, of a clock that never goes back.
static inline double sb_clock_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
