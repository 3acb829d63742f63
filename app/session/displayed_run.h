// A run as the window displays it: the engine's run, its reduced trace for drawing, and the view of
// both that charts receive. Reference counted, because the displayed, the earlier and a pinned run
// may be the same. Main thread.
#pragma once

#include "app/chart/data.h"
#include "app/run/runner.h"
#include "engine/valve/answer/gradient.h"

#include <glib.h>

// How a run was computed.
typedef enum {
  SB_GRADE_CLOSED, // with closed forms in place of solved rings
  SB_GRADE_COARSE, // rings to a tolerance of 1 %, with fewer frames
  SB_GRADE_NEAR,   // rings by a warm start from those of a converged run of other values
  SB_GRADE_STORED, // read from a file: a converged run of the same engine, without a warm start
  SB_GRADE_WHOLE   // cold start: the figures of `sealbench run`, to the bit
} SbRunGrade;

// Derivatives of a run's frames and profiles by a parameter (app/session/tangent.h).
typedef struct SbTangent SbTangent;

// A displayed run. Members may be read; the arrays of derivatives are filled by session_slope.c.
typedef struct SbDisplayedRun SbDisplayedRun;
struct SbDisplayedRun {
  int references;
  SbRunHandle *handle; // a reference
  const SbRun *run;    // of the handle
  SbTrace *trace;      // owned
  SbChartRun chart;    // refers to `run` and `trace`
  SbParams params;     // values from which the run was computed
  SbRunGrade grade;
  char *date;                           // of a stored run, "2026-11-23"; else NULL
  SbTangent *tangent[SB_PARAM_COUNT];   // owned; NULL: not known
  bool sought[SB_PARAM_COUNT];          // `tangent` was computed, perhaps without a result
  SbGradient *gradient[SB_PARAM_COUNT]; // of all figures by one parameter; owned; NULL: not known
  bool differentiated[SB_PARAM_COUNT];  // `gradient` was computed, perhaps without a result
  SbDisplayedRun *level; // run without a change, for computing `tangent`; a reference or NULL
};

// Returns a displayed run with one reference, whose chart has no frames before
// sb_displayed_run_update(). It takes over the caller's reference `handle`, whose run must exist.
// `params` is copied.
SbDisplayedRun *sb_displayed_run_new(SbRunHandle *handle, const SbParams *params, SbRunGrade grade);

// Sets summary, actuations and state of `chart` from the end of the run. Call it once the handle is
// done (sb_run_handle_is_done()).
void sb_displayed_run_end(SbDisplayedRun *shown);

// Adds a reference and returns `shown`; takes NULL.
SbDisplayedRun *sb_displayed_run_ref(SbDisplayedRun *shown);

// Removes a reference; the last one frees the run.
void sb_displayed_run_unref(SbDisplayedRun *shown);

// Adds to the trace the frames that were published since the last call, at most `limit` of them (0:
// all). Returns whether there were any.
bool sb_displayed_run_update(SbDisplayedRun *shown, size_t limit);

// Returns whether the trace contains all published frames.
bool sb_displayed_run_complete(const SbDisplayedRun *shown);

// Returns whether all values of two sets are equal.
bool sb_same_values(const SbParams *a, const SbParams *b);

// Returns whether a run belongs to these values and drawings (sb_model_drawings()).
bool sb_displayed_run_is_of(const SbDisplayedRun *shown, const SbParams *params, uint64_t drawings);
