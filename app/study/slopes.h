// Figures with their derivatives at points of a parameter space, and tasks that compute them on
// threads.
#pragma once

#include "engine/valve/sealbench.h"

#include <stdbool.h>
#include <stddef.h>

// Largest number of parameters.
enum { SB_SLOPES_PARAMETERS = 64 };

// The request; everything is borrowed.
typedef struct {
  const SbModel *base;        // values of all other parameters
  const SbParamId *parameter; // [parameters]
  const bool *fixed;          // [parameters]: no derivative is computed (0); others must be real
  size_t parameters;          // at most SB_SLOPES_PARAMETERS
  const int *figure;          // [figures]: indices of sb_figure()
  size_t figures;
  bool (*cancelled)(void *data); // called from any thread; NULL: never
  void *data;
} SbSlopesAsked;

// Writes value[figures] [SI] at x[parameters] [SI] and, if `slope` is not NULL, the derivatives
// slope[figures][parameters] (engine/valve/answer/gradient.h). Infeasible values, values out of
// range and solvers that do not converge are no errors: the figures are then NaN. So is a
// derivative that is not defined. Returns SB_OK, SB_ERROR_CANCELLED, SB_ERROR_MEMORY, or
// SB_ERROR_RANGE for too many parameters.
SbStatus sb_slopes(double *value, double *slope, SbEvaluator *evaluator, const SbSlopesAsked *asked,
                   const double *x, SbReport *report);

// Does task number `index` with the evaluator of its thread. Called from several threads.
typedef SbStatus (*SbTask)(void *data, SbEvaluator *evaluator, size_t index, SbReport *report);

// Does tasks 0 to count - 1 on up to `jobs` threads, one of them the calling thread, and waits for
// all. Each call of `task` receives `data` and the evaluator of its thread. Returns SB_OK, or the
// error of the failed task with the lowest number; no task is begun after an error.
SbStatus sb_tasks(SbTask task, void *data, size_t count, int jobs, SbReport *report);
