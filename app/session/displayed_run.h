// A run as the window holds it: the engine's run, its thinned trace for drawing, and the view of
// both that charts take. Counted references, so that the shown, the earlier and the pinned run may
// be the same.
#pragma once

#include "app/chart/data.h"
#include "app/run/runner.h"

#include <glib.h>

typedef struct {
  int references;
  SbRunHandle *handle; // owned reference
  const SbRun *run;    // the handle's
  SbTrace *trace;      // owned
  SbChartRun chart;    // refers to both
  SbParams params;     // the values it was made from
} SbDisplayedRun;

// Takes the reference over; the handle's run must exist.
SbDisplayedRun *sb_displayed_run_new(SbRunHandle *handle, const SbParams *params);
SbDisplayedRun *sb_displayed_run_ref(SbDisplayedRun *shown);
void sb_displayed_run_unref(SbDisplayedRun *shown); // takes NULL

// Reads frames that were published since; at most `limit` of them. True if there were any.
bool sb_displayed_run_update(SbDisplayedRun *shown, size_t limit);

// True if the trace has caught up with the frames.
bool sb_displayed_run_complete(const SbDisplayedRun *shown);
