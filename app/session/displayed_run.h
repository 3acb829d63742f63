// A run as the window holds it: the engine's run, its thinned trace for drawing, and the view of
// both that charts take. Counted references, so that the shown, the earlier and the pinned run may
// be the same.
#pragma once

#include "app/chart/data.h"
#include "app/run/runner.h"
#include "engine/valve/answer/gradient.h"

#include <glib.h>

// How a run was solved.
typedef enum {
  SB_GRADE_CLOSED, // by closed forms in place of solved rings
  SB_GRADE_COARSE, // its rings to a tolerance of 1 %, with fewer frames
  SB_GRADE_NEAR,   // its rings started from those of a whole run of other values
  SB_GRADE_STORED, // read from a file: a whole run, of the same engine, but nothing starts from it
  SB_GRADE_WHOLE   // cold: the figures of `sealbench run`, to the bit
} SbRunGrade;

// Slopes of a run by a parameter (tangent.h).
typedef struct SbTangent SbTangent;

typedef struct SbDisplayedRun SbDisplayedRun;
struct SbDisplayedRun {
  int references;
  SbRunHandle *handle; // owned reference
  const SbRun *run;    // the handle's
  SbTrace *trace;      // owned
  SbChartRun chart;    // refers to both
  SbParams params;     // the values it was made from
  SbRunGrade grade;
  char *date; // of a stored one, "2026-11-23"; else NULL. Owned
  // Its slopes so far, owned, found in the background (session_slope.c); whether they were sought
  // at all; the run of no change that they are found with, owned.
  SbTangent *tangent[SB_PARAM_COUNT];
  bool sought[SB_PARAM_COUNT];
  // Derivatives of all its figures by one parameter each, with the engine's acceptance test; NULL:
  // not known so far. Owned. Whether they were computed.
  SbGradient *gradient[SB_PARAM_COUNT];
  bool differentiated[SB_PARAM_COUNT];
  SbDisplayedRun *level;
};

// Takes the reference over; the handle's run must exist.
SbDisplayedRun *sb_displayed_run_new(SbRunHandle *handle, const SbParams *params, SbRunGrade grade);

// Takes over how the handle's run has ended: summary, actuations and state. Only once it is done.
void sb_displayed_run_end(SbDisplayedRun *shown);

SbDisplayedRun *sb_displayed_run_ref(SbDisplayedRun *shown);
void sb_displayed_run_unref(SbDisplayedRun *shown); // takes NULL

// Reads frames that were published since; at most `limit` of them. True if there were any.
bool sb_displayed_run_update(SbDisplayedRun *shown, size_t limit);

// True if the trace has caught up with the frames.
bool sb_displayed_run_complete(const SbDisplayedRun *shown);
