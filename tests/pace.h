// Limits of time that hold on any machine. What they promise is meant for the machine on which they
// were set; another may be slower, or share its caches and processors with others at the moment. So
// each run of what is timed stands beside a fixed piece of work of known time there, and a machine
// that is provably slower is not judged by the limit, but told.
#pragma once

#include "tests/sanitized.h"

#include <glib.h>
#include <math.h>
#include <time.h>

// Processor time of this thread [s]: what others do meanwhile does not count.
static inline double pace_clock(void) {
  struct timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// How many times slower than at home a piece of work runs now: elementary functions, divisions that
// wait for each other, and a sweep through memory beyond the first cache.
static inline double pace_now(void) {
  enum { ROUNDS = 20, SIZE = 16384 };
  const double at_home = 1.05e-3; // [s]
  static double memory[SIZE];
  double start = pace_clock(), x = 0.5;
  for (int k = 0; k < ROUNDS; k++) {
    for (int i = 0; i < SIZE / 16; i++) {
      x = sqrt(x + exp(-x)) / (1 + fabs(memory[(i * 577 + k) % SIZE]));
    }
    for (int i = 1; i < SIZE; i++) {
      memory[i] = 0.5 * (memory[i] + memory[i - 1]) + 1e-3 * x;
    }
  }
  double took = pace_clock() - start;
  return x > 0 ? took / at_home : INFINITY;
}

typedef struct {
  double least;  // processor time [s]
  double scaled; // the same at the pace of the machine at home [s]
  double pace;   // least of what was found
} PaceTime;

// The least of `repeats` runs of `what`.
static inline PaceTime pace_time(void (*what)(void *data), void *data, int repeats) {
  PaceTime t = {INFINITY, INFINITY, INFINITY};
  for (int i = 0; i < repeats; i++) {
    double before = pace_now(), start = pace_clock();
    what(data);
    double took = pace_clock() - start, pace = fmax(1, fmin(before, pace_now()));
    t.least = fmin(t.least, took);
    t.scaled = fmin(t.scaled, took / pace);
    t.pace = fmin(t.pace, pace);
  }
  return t;
}

// Holds a limit [s]. On a slower machine it is only told whether it holds, and three times as much
// fails. Sanitizers take their own time: not judged.
static inline void pace_limit(const char *what, const PaceTime *t, double limit) {
  g_test_message("%s: %.3g ms of processor time, limit %.3g ms; the machine runs at 1/%.2f", what,
                 1e3 * t->least, 1e3 * limit, t->pace);
  if (SB_SANITIZED || t->least < limit || t->scaled < limit) {
    return;
  }
  if (t->pace < 1.1) {
    g_assert_cmpfloat(t->least, <, limit);
  }
  g_assert_cmpfloat(t->scaled, <, 3 * limit);
  char *text = g_strdup_printf("%s: %.3g ms, limit %.3g ms, not judged on a machine %.2f times "
                               "slower than the limit is for",
                               what, 1e3 * t->least, 1e3 * limit, t->pace);
  g_test_skip(text);
  g_free(text);
}
