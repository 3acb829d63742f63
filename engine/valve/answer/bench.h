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
  double error;          // relative to the known result; NaN if the known result is less accurate
  double error_estimate; // relative error as estimated by the solver; NaN: it has no estimate
  double order; // observed order relative to `previous`: -d ln(error)/d ln(unknowns); NaN: none
} SbBenchCase;

// Returns the number of cases.
size_t sb_bench_count(void);

// Runs case `index` (from 0) once as warm-up, then `repeats` >= 1 times with the time measured.
// `previous` is the result of case index - 1, from which `order` follows if it has the same solver
// with fewer unknowns (NULL: order is NaN). If the solver fails, its status is returned and
// out->error is NaN.
SbStatus sb_bench_run(SbBenchCase *out, size_t index, int repeats, const SbBenchCase *previous,
                      SbReport *report);
