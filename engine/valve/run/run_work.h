// The budget of work of a run: a number of solver steps (Newton iterations of rings and films, time
// steps of the transient film), limited by output.work_limit. Forty segments of the motion count
// as one step: a segment takes some 4 us, the other steps 0.1 ms to 10 ms. Elapsed time does not
// count, so that a run ends at the same step on every machine.
//
// Start: SbWork work = {.limit = steps, .cancelled = f, .data = d}. Pass sb_work_step (to a motion
// sb_work_segment) and &work to a solver as its cancel callback. After the solver has returned,
// pass its status and the SbWork that it polled through sb_work_status().
//
// One thread uses an SbWork at a time. For concurrent solvers call sb_work_part() once for each,
// let each poll its own part, and call sb_work_add() for each part in a fixed order after they have
// ended. The result then does not depend on the order in which the threads run.
#pragma once

#include "engine/base/status.h"

// A budget of steps.
typedef struct {
  size_t done;  // steps used so far; 0 at the start
  size_t limit; // allowed steps; 0 allows none
  int segments; // of the motion that are not in `done`, 0 to 39; 0 at the start
  bool spent;   // false at the start; true once a step exceeded the limit: later ones fail too
  bool (*cancelled)(void *data); // called at each step; returns whether the user cancels; NULL: no
  void *data;                    // argument of `cancelled`
} SbWork;

// Counts one step. `data` is the SbWork. Returns true if the solver must stop with
// SB_ERROR_CANCELLED: the limit is exceeded (then `spent` is set), or `cancelled` returns true.
bool sb_work_step(void *data);

// Counts one segment of a motion, which is a fortieth of a step. Otherwise as sb_work_step().
bool sb_work_segment(void *data);

// Returns a budget whose limit is the remaining steps of `work` divided by `parts` (> 0, rounded
// down), with `spent` of `work`, done = 0, and `cancelled` and `data` NULL: the caller sets these
// two, to a function that may be called in the thread of the part. `work` is unchanged.
SbWork sb_work_part(const SbWork *work, size_t parts);

// Adds the steps of `part`, whose solver has ended, to `work`. Sets work->spent if part->spent is
// true, or if the part used more steps than `work` has left; then all of them count as used.
void sb_work_add(SbWork *work, const SbWork *part);

// Converts `status` of a solver that polled `work` (the part, if it polled a part). If `status` is
// SB_ERROR_CANCELLED and work->spent is true, returns SB_ERROR_NOT_CONVERGED and writes a report
// that names output.work_limit. Else returns `status` and leaves the report.
SbStatus sb_work_status(const SbWork *work, SbStatus status, SbReport *report);
