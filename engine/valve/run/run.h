// A run: the cycle of one scene, computed by the thread that calls sb_run_execute().
//
// Use: sb_run_create(), sb_run_execute(), then the functions that read; sb_run_destroy() at the
// end. One thread executes. Any other thread may at the same time read published frames, and
// profiles and shapes that they refer to: sb_run_frames() returns a constant array and the number
// of complete frames (acquire/release). A reader never waits, and a published frame does not change
// until the run is executed or renewed again.
#pragma once

#include "engine/valve/run/frame.h"
#include "engine/valve/run/plan.h"
#include "engine/valve/run/rig.h"
#include "engine/valve/shelf/shelf.h"
#include "engine/valve/states/perturbed.h"

#include <stdatomic.h>

// A run.
typedef struct SbRun SbRun;

// Callbacks of sb_run_execute(), called in its thread.
typedef struct {
  // Called every few milliseconds with the completed fraction of the work, 0 to 1, and the number
  // of published frames. NULL: not called.
  void (*progress)(void *data, double fraction, size_t frames);
  // True ends the run within 50 ms with SB_ERROR_CANCELLED; its frames so far remain. NULL: never.
  bool (*cancelled)(void *data);
  void *data;       // argument of both functions
  size_t work_used; // steps of output.work_limit that are not available to this run
  bool alone; // the run starts no thread of its own; false: it may solve the two seals concurrently
} SbRunHooks;

// Creates a run of `model` by `plan`; both are copied. SB_ERROR_MEMORY is its only error.
SbStatus sb_run_create(SbRun **out, const SbModel *model, const SbPlan *plan, SbReport *report);

// Turns a run that no thread executes into one for another model and plan (both are copied). Only
// its memory is reused; whatever was borrowed from it becomes invalid. After SB_ERROR_MEMORY it can
// only be renewed again or destroyed.
SbStatus sb_run_renew(SbRun *run, const SbModel *model, const SbPlan *plan, SbReport *report);

// Renews a run with its present plan for a model whose steady states of the seals are equal to the
// bit to those of the present model (the caller guarantees it): solved states are reused. If there
// are none it does the same as sb_run_renew().
SbStatus sb_run_renew_same(SbRun *run, const SbModel *model, SbReport *report);

// Frees a run that no thread executes.
void sb_run_destroy(SbRun *run);

// Computes the whole cycle. `hooks` may be NULL. SB_ERROR_CANCELLED; SB_ERROR_NOT_CONVERGED: a
// solver failed, an error estimate is too large, or output.work_limit is exhausted; SB_ERROR_RANGE,
// SB_ERROR_INPUT, SB_ERROR_INFEASIBLE of a solver. Results computed before remain. The summary is
// valid after any status, with a reason for each figure that has no value. Executing again repeats
// the computation.
SbStatus sb_run_execute(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Lets the next sb_run_execute() store its ring states, so that other runs can start from them.
// Order: sb_run_keep_rings(), sb_run_execute(), sb_run_end_rings().
void sb_run_keep_rings(SbRun *run);

// Ends the storing. Until it is renewed and executed again the run may only be the `base` of others
// and be read (summary, frames); sb_run_sliding() must not be called.
void sb_run_end_rings(SbRun *run);

// Computes in advance what the first run that starts from the stored rings needs. Returns early if
// `stop` (not NULL; called with `data`) returns true. Any thread, also while others start from
// them.
void sb_run_prepare_rings(const SbRun *run, bool (*stop)(void *data), void *data);

// Lets the rings of `run` start from the ring states stored in `base`, which is borrowed until the
// next call of this or the next function; NULL: cold start (the default). Results depend only on
// `base` and the run's model. Call it after sb_run_create() or sb_run_renew() and before
// sb_run_execute().
void sb_run_start_from(SbRun *run, const SbRun *base);

// Like sb_run_start_from(), but rings are not solved: they are linearised about the stored states
// with respect to all differences of the models (ring_tangent.c), with the friction that follows.
// Film, motion and frames are then computed as usual. The prediction takes milliseconds for each
// state; it is exact at the base and has errors of second order near it. It does not detect changes
// of the contact's active set. Rings that roll or jam at the base cannot be predicted:
// SB_ERROR_NOT_CONVERGED from sb_run_execute(). NULL: cold start, rings are solved.
void sb_run_predict_from(SbRun *run, const SbRun *base);

// Sets how rings are evaluated after sb_run_predict_from(); SB_RINGS_FOLLOW by default. Before
// sb_run_execute().
void sb_run_rings_beside(SbRun *run, SbRingsBeside how);

// Returns the published frames, oldest first, and writes their number to *count; borrowed until the
// run is executed again, renewed or destroyed. Any thread.
const SbFrame *sb_run_frames(const SbRun *run, size_t *count);

// Returns the array of the joints' reactions at the published frame `frame`:
// SbSummary.bodies.joints elements, in the order of bodies.joint. NULL if not computed. Borrowed;
// any thread.
const SbReaction *sb_run_reactions(const SbRun *run, size_t frame);

// Serialises a converged run: sets *out to *size bytes, which the caller frees with free(). The
// bytes are valid for this build of the program only. SB_ERROR_INPUT: not converged, or with
// reactions of joints (not stored); SB_ERROR_MEMORY; *out is NULL then.
SbStatus sb_run_pack(void **out, size_t *size, const SbRun *run, SbReport *report);

// Creates a run from the bytes[size] of sb_run_pack(); `model` and `plan` must equal those of the
// packed run and are copied. Free the run with sb_run_destroy(). Its results can be read; it has no
// ring states, so it cannot be a base, and sb_run_sliding() must not be called. SB_ERROR_INPUT: the
// bytes are damaged, or of another build.
SbStatus sb_run_unpack(SbRun **out, const SbModel *model, const SbPlan *plan, const void *bytes,
                       size_t size, SbReport *report);

// Returns the largest number of frames that the run can have, for progress. Any thread.
size_t sb_run_capacity(const SbRun *run);

// Returns profile `index`, NULL if there is none; borrowed. Any thread, for an index of a published
// frame.
const SbContactProfile *sb_run_profile(const SbRun *run, uint32_t index);

// Indices of shapes are smaller than this.
enum { SB_RUN_SHAPES_MAX = 96 };

// Returns the solved ring shape `index`, NULL if there is none; borrowed. Any thread, for an index
// of a published frame.
const SbSealShape *sb_run_shape(const SbRun *run, uint32_t index);

// Returns the actuations of a life, oldest first, and writes their number to *count (0 without a
// life). Only after sb_run_execute(); borrowed.
const SbLifeActuation *sb_run_life(const SbRun *run, size_t *count);

// Computes, after sb_run_execute(), the steady state of `seal` at `speed` [m/s] > 0 in direction
// `way`, SB_CYCLE_IN or SB_CYCLE_OUT (cycle.h), under the pressures in the middle of B-C or F-A.
// The plan must have had SB_DEPTH_WHOLE for this seal and the run SB_OK; otherwise *out is
// meaningless. The state is interpolated as the motion's friction is (speed_states.h). More states
// are solved if needed; their errors, counts, steps of work and warnings are added to the summary.
// SB_ERROR_CANCELLED, SB_ERROR_MEMORY; SB_ERROR_NOT_CONVERGED if output.work_limit is exhausted.
SbStatus sb_run_sliding(SbSealState *out, SbRun *run, int seal, int way, double speed,
                        SbReport *report);

// Returns the summary; borrowed until the run is executed, renewed or destroyed. Only after
// sb_run_execute() or sb_run_unpack().
const SbSummary *sb_run_summary(const SbRun *run);

// Returns the run's copy of its model; borrowed. Any thread.
const SbModel *sb_run_model(const SbRun *run);

// Returns the run's copy of its plan; borrowed. Any thread.
const SbPlan *sb_run_plan(const SbRun *run);
