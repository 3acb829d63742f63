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
} SbShownRun;

// Takes the reference over; the handle's run must exist.
SbShownRun *sb_shown_run_new(SbRunHandle *handle, const SbParams *params);
SbShownRun *sb_shown_run_ref(SbShownRun *shown);
void sb_shown_run_unref(SbShownRun *shown); // takes NULL

// Reads frames that were published since; at most `limit` of them. True if there were any.
bool sb_shown_run_update(SbShownRun *shown, size_t limit);

// True if the trace has caught up with the frames.
bool sb_shown_run_complete(const SbShownRun *shown);
