// A motion of the valve with inertia and what is recorded during it: frames, stages, the film that
// the seals carry (run_record.c). Private to engine/valve/run. One thread uses a recorder; nothing
// has to be freed.
#pragma once

#include "engine/valve/run/run_valve.h"

// The stem at an instant.
typedef struct {
  double time, x, speed; // [s], [m], [m/s]
} SbRecordedPlace;

// A motion and the data recorded during it.
typedef struct {
  SbRun *run;
  SbValve valve;
  SbDynamicsModel model;
  SbDynamics motion;
  SbDynamicsEnergy energy; // at its end
  bool frames;             // record them; a run for the error estimate does not
  size_t count;            // frames written
  SbStage stage;           // last passed
  SbStageMark mark[SB_STAGE_COUNT];
  int direction;                // of the last sliding
  bool stopped;                 // the stem is in contact with the end stop
  double force_peak;            // [N]
  double return_least;          // smallest force that pushed the stem out while it slid back [N]
  double press;                 // force_peak when the stem meets the stop [N]
  double top;                   // largest displacement [m]
  double rested;                // time at which the last in-stroke came to rest [s]
  double dwell;                 // from the in-stroke's rest to stage E [s]
  double leak_from, leak_since; // place [m] and time [s] up to which it is known
  SbRecordedPlace last;         // where the stem was last seen
  double moved;                 // time at which it came there [s]
  long repeated;                // cycles of stick-slip skipped until then
  double home;                  // time at which the stem is back on its rest stop [s], 0: not yet
  double middle, middle_back;   // speed at the middle of B-C and of F-A [m/s], 0: not yet
  bool slips;                   // some contact has slid
  double net; // what the film carried out less what it carried back, mean of the actuations [m2]
  SbStatus status; // of the frames' reactions
  SbReport *report;
} SbRecorder;

// Makes the mechanism of the run's model and runs it to its end, to the tolerance `tolerance` [1]
// (0: the model's). With `frames` it adds the frames of the run and calls the hooks. A motion
// without frames leaves its warnings to the one that has them. *r, which may be uninitialised,
// refers to itself: do not copy it. The states of run->cycle must be solved.
// SB_ERROR_NOT_CONVERGED: the motion failed, or the budget is exhausted; SB_ERROR_RANGE,
// SB_ERROR_INPUT, SB_ERROR_INFEASIBLE: the mechanism is not valid; SB_ERROR_CANCELLED. After an
// error *r has the motion up to that instant.
SbStatus sb_run_record(SbRecorder *r, SbRun *run, bool frames, double tolerance,
                       const SbRunHooks *hooks, SbReport *report);
