// The playhead over one run's frames: where it stands, playing, speed and looping. No widgets, no
// signals: each call says whether the shown frame changed.
#pragma once

#include "engine/frame.h"
#include "engine/run.h"

#include <glib.h>

typedef struct {
  size_t frame;     // shown
  gboolean follows; // stays at the newest frame while a run grows
  gboolean playing; //
  gboolean loops;   // starts again at the end
  double duration;  // one cycle plays in this time [s]
  double time;      // of the cycle, while playing [s]
  gint64 last;      // frame clock at the last tick [us], 0 before the first
} SbPlayhead;

void sb_playhead_init(SbPlayhead *playhead);

// Frame whose time is nearest to `time`; `count` > 0. Times never decrease.
size_t sb_playhead_nearest(const SbFrame *frames, size_t count, double time);

// The event frame next after (direction > 0) or before the present one among `marks`; the last or
// first frame if there is none.
size_t sb_playhead_event(const SbPlayhead *playhead, const SbStageMark *marks, size_t count,
                         int direction);

// Starts or stops playing; from the end it starts again at the beginning.
void sb_playhead_play(SbPlayhead *playhead, const SbFrame *frames, size_t count, gboolean on);

// Moves on to the clock's `now` [us]. True if the frame changed or playing ended.
gboolean sb_playhead_tick(SbPlayhead *playhead, const SbFrame *frames, size_t count, gint64 now);
