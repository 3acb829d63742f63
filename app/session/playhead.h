// The playhead over the frames of a run: position, playing, speed and looping. It has no widgets
// and no signals: each function states whether the displayed frame changed.
//
// `frames` are the frames of the run that are available, [count], in the order of time; `trace` is
// the trace of these frames.
#pragma once

#include "app/chart/data.h"
#include "app/chart/trace.h"
#include "engine/valve/run/frame.h"

#include <glib.h>

// A position in a cycle that has the same meaning in runs of other values, durations and numbers of
// frames: the fraction of the time from one event to the next.
typedef struct {
  SbStage stage; // of the event
  int cycle;     // from 0
  double share;  // fraction of the time from the event to the next one, or to the end; NaN: unknown
  double time;   // since the event [s]
  double whole;  // fraction of the run's full time
} SbPlayheadPlace;

// Initialised by sb_playhead_init(). `frame`, `follows`, `loops` and `duration` may be set
// directly.
typedef struct {
  size_t frame;          // index of the displayed frame
  gboolean follows;      // the newest frame is displayed while a run grows
  gboolean playing;      // see sb_playhead_play()
  gboolean loops;        // playing starts again at the end
  double duration;       // playing time of the full run [s]
  double time;           // of the run, while playing [s]
  gint64 last;           // frame clock at the last tick [us]; 0: none
  gboolean waits;        // the run has not reached `place` yet; its newest frame is displayed
  SbPlayheadPlace place; // position that sb_playhead_return() restores
  size_t placed;         // frame to which the playhead returned; G_MAXSIZE: none
} SbPlayhead;

// Initialises the playhead to wait for the first run at the middle between stages C and D, to play
// a run in 10 s and to loop.
void sb_playhead_init(SbPlayhead *playhead);

// Returns the index of the frame whose time is nearest to `time` [s]; count > 0.
size_t sb_playhead_nearest(const SbFrame *frames, size_t count, double time);

// Returns the frame of the next event after the displayed frame (direction > 0) or of the last one
// before it (direction < 0), among `count` frames; if there is none, the last or first frame.
size_t sb_playhead_event(const SbPlayhead *playhead, const SbTrace *trace, size_t count,
                         int direction);

// Stores the position of the displayed frame in `place`, for sb_playhead_return() with another run.
// Does nothing while the playhead waits or is at the frame to which it returned, because a frame
// only approximates the position. `complete`: the run has ended; else the fraction of the last
// stage is unknown.
void sb_playhead_remember(SbPlayhead *playhead, const SbTrace *trace, const SbFrame *frames,
                          size_t count, gboolean complete);

// Moves to the stored position in the run of these frames. Moves to the newest frame instead if the
// playhead follows, or if a growing run (`complete` FALSE) has not reached the position (`waits`).
// A stage that a complete run does not reach is replaced by the fraction of the full time.
void sb_playhead_return(SbPlayhead *playhead, const SbTrace *trace, const SbFrame *frames,
                        size_t count, gboolean complete);

// Returns the frame of the complete run `other` at the position of `frame` in `run`; 0 if `run` has
// no frames.
size_t sb_playhead_same_place(const SbChartRun *run, size_t frame, const SbChartRun *other);

// Starts (`on`) or stops playing. At the last frame it starts from the beginning. Does not start
// with fewer than two frames.
void sb_playhead_play(SbPlayhead *playhead, const SbFrame *frames, size_t count, gboolean on);

// While playing, moves to the frame for the time `now` of the frame clock [us]. Returns whether the
// displayed frame changed or playing ended.
gboolean sb_playhead_tick(SbPlayhead *playhead, const SbFrame *frames, size_t count, gint64 now);
