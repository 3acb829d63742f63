// The engine's own thread: it computes one run at a time, and a newer request replaces an older
// one. Results are reference counted and live until their last reference is released.
//
// Unlike the general rule, all functions here may be called from any thread at any time, also for
// one object, except as stated at sb_runner_destroy(). A handle must be referenced by the caller.
#pragma once

#include "engine/valve/sealbench.h"

// One run, being computed or computed.
typedef struct SbRunHandle SbRunHandle;

// Adds a reference and returns `handle`.
SbRunHandle *sb_run_handle_ref(SbRunHandle *handle);

// Removes a reference; the last one destroys the run. `handle` may be NULL.
void sb_run_handle_unref(SbRunHandle *handle);

// Returns a handle with one reference, status SB_OK and ticket 0 for a run that has ended with
// SB_OK outside of a runner. The handle owns `run` from now on. NULL if memory is short; then `run`
// is destroyed.
SbRunHandle *sb_run_handle_of(SbRun *run);

// Returns the run. Its published frames (sb_run_frames()) may be read while it is computed, its
// summary only when sb_run_handle_is_done(). NULL if the run could not be created: see the status.
// Borrowed from the handle.
const SbRun *sb_run_handle_run(const SbRunHandle *handle);

// Returns the ticket of the request that started the run (sb_runner_submit()).
unsigned sb_run_handle_ticket(const SbRunHandle *handle);

// Returns the fraction of the run that is computed, 0 to 1.
double sb_run_handle_fraction(const SbRunHandle *handle);

// Returns true once the run has ended: converged, failed or cancelled. Only then may the summary,
// the status and the report be read.
bool sb_run_handle_is_done(const SbRunHandle *handle);

// Returns the status of sb_run_create() or sb_run_execute(): SB_ERROR_CANCELLED if the run was
// cancelled or replaced, SB_ERROR_NOT_CONVERGED with the results up to the last good state.
SbStatus sb_run_handle_status(const SbRunHandle *handle);

// Returns the sentence that explains a status other than SB_OK. Borrowed from the handle.
const SbReport *sb_run_handle_report(const SbRunHandle *handle);

// The thread with its request that waits and its latest run.
typedef struct SbRunner SbRunner;

// Called in the runner's thread when a run has begun, has new frames (at most every 15 ms) or has
// ended, and when the runner is no longer busy. Must return immediately and must not call
// sb_runner_destroy(); typically it adds one idle source to the main loop unless one is pending.
typedef void (*SbRunnerNotify)(void *data);

// Starts the thread, with the locale "C" and a low priority; `last` lowers the priority further,
// for results that the user does not wait for. Returns NULL if the thread cannot be started or
// memory is short. Freed by sb_runner_destroy().
SbRunner *sb_runner_create(SbRunnerNotify notify, void *data, bool last);

// Cancels what is computed, waits for the end of the thread (typically below 50 ms) and frees the
// runner; `notify` is not called afterwards. Handles that others hold stay valid. `runner` may be
// NULL. No other thread may use the runner any more; not to be called by `notify`.
void sb_runner_destroy(SbRunner *runner);

// A request for a run.
typedef struct {
  const SbModel *model; // to be computed; sb_runner_submit() copies it
  SbPlanWishes wishes;  // what to compute in addition to the figures
  // A finished run that was computed with `keep`; sb_runner_submit() adds a reference. Its ring
  // states are the initial guess (sb_run_start_from()), or with `tangent` the point of
  // linearisation. NULL: cold start, which gives the results of the command line.
  SbRunHandle *start;
  bool tangent; // do not solve rings, but predict them to first order (sb_run_predict_from())
  bool keep;    // store the ring states, so that later requests can use this run as `start`
  bool alone;   // use no other threads than the runner's
} SbRunRequest;

// Requests a run. Cancels the run that is being computed and drops a request that waits. Returns
// the ticket of the request; tickets increase from 1.
unsigned sb_runner_submit(SbRunner *runner, const SbRunRequest *request);

// Cancels the run that is being computed and drops the request that waits. Does nothing if there
// are none. The cancelled run ends shortly afterwards, in the runner's thread.
void sb_runner_cancel(SbRunner *runner);

// Returns true while a request waits or is being computed.
bool sb_runner_is_busy(SbRunner *runner);

// Returns the run that began last, finished or not, with a reference that the caller releases with
// sb_run_handle_unref(); NULL before the first.
SbRunHandle *sb_runner_latest(SbRunner *runner);
