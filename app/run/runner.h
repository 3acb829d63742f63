// The engine's own thread: one run at a time, the newest request wins, results are kept as long as
// anybody holds them.
//
// Any thread may call any function here. Hand-over is by a mutex and C11 atomics only, so that the
// thread sanitizer sees all of it.
#pragma once

#include "engine/valve/sealbench.h"

// One run, computed or being computed. Reference counted.
typedef struct SbRunHandle SbRunHandle;

SbRunHandle *sb_run_handle_ref(SbRunHandle *handle);

// Takes NULL. The last one frees the run.
void sb_run_handle_unref(SbRunHandle *handle);

// One of a run that has ended well and that nobody executes; takes it over. NULL if memory is
// short: the run is gone then.
SbRunHandle *sb_run_handle_of(SbRun *run);

// The run, whose published frames may be read at any time; NULL if it could not be created (see the
// report). Borrowed while the handle is held.
const SbRun *sb_run_handle_run(const SbRunHandle *handle);

// Number of the request that made it.
unsigned sb_run_handle_ticket(const SbRunHandle *handle);

// Fraction done, 0 to 1.
double sb_run_handle_fraction(const SbRunHandle *handle);

// True once it has ended in whatever way; only then may its summary, status and report be read.
bool sb_run_handle_is_done(const SbRunHandle *handle);
SbStatus sb_run_handle_status(const SbRunHandle *handle);
const SbReport *sb_run_handle_report(const SbRunHandle *handle); // borrowed

typedef struct SbRunner SbRunner;

// Called on the engine's thread when there is something new to look at: a run began, has more
// frames (at most every 15 ms), or ended. Must return at once; typically it posts one idle callback
// unless one is pending.
typedef void (*SbRunnerNotify)(void *data);

// Starts the thread; `last`: behind those of other runners, for what nobody waits for. NULL if the
// system has none left. Owned by the caller.
SbRunner *sb_runner_create(SbRunnerNotify notify, void *data, bool last);

// Cancels, waits for the thread (at most about 50 ms) and frees. After it returned `notify` is not
// called again. Handles stay valid. Takes NULL. Not from inside `notify`.
void sb_runner_destroy(SbRunner *runner);

// What is asked for.
typedef struct {
  const SbModel *model; // copied
  SbPlanWishes wishes;
  // A run that has ended, a reference is taken: solved rings start from its states
  // (sb_run_start_from()), if `keep` was asked for with it. NULL: cold, as any other program has
  // it.
  SbRunHandle *start;
  bool tangent; // they are not solved, but those of `start` to first order (sb_run_predict_from())
  bool keep;    // keeps its rings for others to start from
  bool alone;   // no thread beside the runner's
} SbRunRequest;

// Asks for a run. What is being computed is cancelled, what was waiting is dropped. Returns the
// request's ticket; tickets grow from 1.
unsigned sb_runner_submit(SbRunner *runner, const SbRunRequest *request);

// Stops what is being computed and drops what waits. May be called at any time, any number of
// times.
void sb_runner_cancel(SbRunner *runner);

// True while a request waits or is being computed.
bool sb_runner_is_busy(SbRunner *runner);

// The latest run that began (done or not), with a reference for the caller; NULL before the first.
SbRunHandle *sb_runner_latest(SbRunner *runner);
