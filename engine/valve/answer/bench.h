// Accuracy and time of each solver on cases with a known result: literature constants, closed
// forms, or reference solutions of other programs (bench.c). `sealbench bench` prints them.
#pragma once

#include "engine/base/status.h"

// Result of a case.
typedef struct {
  char solver[24];       // "reynolds", "disc", ...
  char name[64];         // the case: "M = 100, tolerance 0.001"
  size_t unknowns;       // 0 for a closed form
  size_t iterations;     // Newton or other iterations; 0 for a closed form
  double wall_s;         // median elapsed time of the repeats [s]
  double error;          // relative, to the known result; NaN if that is not more accurate
  double error_estimate; // relative, by the solver itself; NaN: none
  double order; // observed order relative to `previous`: -d ln(error)/d ln(unknowns); NaN: none
} SbBenchCase;

// Returns the number of cases.
size_t sb_bench_count(void);

// Runs case `index` (from 0) once as warm-up and `repeats` >= 1 times. `previous` is the result of
// the case before, for `order` (NULL: not wanted). If the solver fails, its status is returned and
// `error` is NaN.
SbStatus sb_bench_run(SbBenchCase *out, size_t index, int repeats, const SbBenchCase *previous,
                      SbReport *report);
