// Error against time for every solver, on cases whose answer is known independently.
//
// The answers are literature constants, closed forms, or reference solutions of other programs to
// the digits stated in bench.c. `sealbench bench` prints them; tests hold the errors.
#pragma once

#include "engine/base/status.h"

typedef struct {
  char solver[24];       // "reynolds", "disc", ...
  char name[64];         // the case: "M = 100, tolerance 0.001"
  size_t unknowns;       // 0 for a closed form
  size_t iterations;     // Newton or other; 0 for a closed form
  double wall_s;         // median of the repeats after one warm-up
  double error;          // relative, against the known answer; NaN if that is no better
  double error_estimate; // what the solver itself said; NaN if it says nothing
  double order; // observed against the case before: -d ln(error)/d ln(unknowns); NaN if none
} SbBenchCase;

// Number of cases.
size_t sb_bench_count(void);

// Runs case `index` `repeats` times (at least once) after a warm-up. `order` needs the results
// before it: `previous` may be NULL. A solver that fails gives its status and leaves error NaN.
SbStatus sb_bench_run(SbBenchCase *out, size_t index, int repeats, const SbBenchCase *previous,
                      SbReport *report);
