// Figures with their slopes at points of a parameter space, and tasks that ask for them side by
// side.
#pragma once

#include "engine/valve/sealbench.h"

#include <stdbool.h>
#include <stddef.h>

enum { SB_SLOPES_PARAMETERS = 64 };

// What is asked; everything is borrowed.
typedef struct {
  const SbModel *base;
  const SbParamId *parameter; // [parameters]
  const bool *fixed;          // [parameters]: does not move, its slope is 0; others are real
  size_t parameters;
  const int *figure; // [figures], figures.def
  size_t figures;
  bool (*cancelled)(void *data); // from any thread; may be NULL
  void *data;
} SbSlopesAsked;

// Figures value[figures] at x[parameters], NaN: none, and where `slope` is not NULL their slopes
// [figures][parameters] (engine/valve/answer/gradient.h), NaN: none. Values that make no valve, or
// are out of range, and solvers that do not converge are no errors but figures without a value.
// SB_ERROR_CANCELLED, _MEMORY.
SbStatus sb_slopes(double *value, double *slope, SbEvaluator *evaluator, const SbSlopesAsked *asked,
                   const double *x, SbReport *report);

// Task number `index`, with the evaluator of its thread.
typedef SbStatus (*SbTask)(void *data, SbEvaluator *evaluator, size_t index, SbReport *report);

// Does tasks 0 to count - 1 on up to `jobs` threads. The error of the first that failed, by number;
// none is begun after an error.
SbStatus sb_tasks(SbTask task, void *data, size_t count, int jobs, SbReport *report);
