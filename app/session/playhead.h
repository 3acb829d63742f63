// The playhead over one run's frames: where it stands, playing, speed and looping. No widgets, no
// signals: each call says whether the shown frame changed.
#pragma once

#include "app/chart/data.h"
#include "app/chart/trace.h"
#include "engine/valve/run/frame.h"

#include <glib.h>

// A place in a cycle that means the same in runs of other values, lengths and numbers of frames:
// how far it is on the way from one event to the next.
typedef struct {
  SbStage stage; // of the event
  int cycle;
  double share; // of the time to the next event, or to the end; NaN where that is not known
  double time;  // since the event [s]
  double whole; // share of the whole run's time
} SbPlayheadPlace;

typedef struct {
  size_t frame;     // shown
  gboolean follows; // stays at the newest frame while a run grows
  gboolean playing; //
  gboolean loops;   // starts again at the end
  double duration;  // one cycle plays in this time [s]
  double time;      // of the cycle, while playing [s]
  gint64 last;      // frame clock at the last tick [us], 0 before the first
  gboolean waits;   // the run has not come to `place` yet: shows its newest frame until then
  SbPlayheadPlace place;
  size_t placed; // the frame that it was returned to; G_MAXSIZE before
} SbPlayhead;

// Waits for the first run to come half way from stage C to D.
void sb_playhead_init(SbPlayhead *playhead);

// Frame whose time is nearest to `time`; `count` > 0. Times never decrease.
size_t sb_playhead_nearest(const SbFrame *frames, size_t count, double time);

// The event frame next after (direction > 0) or before the present one in a trace of `count`
// frames; the last or first frame if there is none.
size_t sb_playhead_event(const SbPlayhead *playhead, const SbTrace *trace, size_t count,
                         int direction);

// Remembers the place of the present frame, so that sb_playhead_return() finds it in another run.
// One that still waits, or stands where it was returned to, keeps its place: a frame is only near
// it. In a growing run (`complete` false) the last stage's share of its time is not known yet.
void sb_playhead_remember(SbPlayhead *playhead, const SbTrace *trace, const SbFrame *frames,
                          size_t count, gboolean complete);

// Moves to the remembered place, or to the newest frame if it follows or a growing run (`complete`
// false) is not that far; a stage that a complete run does not reach is found by its share of the
// time.
void sb_playhead_return(SbPlayhead *playhead, const SbTrace *trace, const SbFrame *frames,
                        size_t count, gboolean complete);

// The frame of a whole `other` run that stands where `frame` does in this one.
size_t sb_playhead_same_place(const SbChartRun *run, size_t frame, const SbChartRun *other);

// Starts or stops playing; from the end it starts again at the beginning.
void sb_playhead_play(SbPlayhead *playhead, const SbFrame *frames, size_t count, gboolean on);

// Moves on to the clock's `now` [us]. True if the frame changed or playing ended.
gboolean sb_playhead_tick(SbPlayhead *playhead, const SbFrame *frames, size_t count, gint64 now);
