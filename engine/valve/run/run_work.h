// The budget of work of a run: solver steps (Newton iterations of rings and films, steps of the
// transient film, segments of the motion) against output.work_limit. Seconds play no part, so that
// a run ends at the same place on every machine.
//
// Solvers poll sb_work_step() once a step, as they poll for a cancel; a poll beyond the limit ends
// the solver with SB_ERROR_CANCELLED, which sb_work_status() turns into SB_ERROR_NOT_CONVERGED.
// One thread uses an SbWork at a time. Threads that solve at the same time have budgets of their
// own (sb_work_part()), so that their order has no influence.
#pragma once

#include "engine/base/status.h"

// A budget of steps.
typedef struct {
  size_t done, limit;            // steps
  bool spent;                    // a step was refused; all later ones are refused too
  bool (*cancelled)(void *data); // returns whether the user cancels; NULL: never
  void *data;
} SbWork;

// Counts a step of `data`, an SbWork. Returns true if the solver must stop.
bool sb_work_step(void *data);

// Returns a budget of one of `parts` equal parts of the remaining steps.
SbWork sb_work_part(const SbWork *work, size_t parts);

// Adds the steps of a part that has ended; more than the remaining ones exhaust the budget.
void sb_work_add(SbWork *work, const SbWork *part);

// Returns the status of a solver that polled `work`: SB_ERROR_NOT_CONVERGED, with a report that
// names output.work_limit, in place of the SB_ERROR_CANCELLED of a spent budget.
SbStatus sb_work_status(const SbWork *work, SbStatus status, SbReport *report);
