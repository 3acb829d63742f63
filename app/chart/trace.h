// A run's frames boiled down to what a picture of the whole cycle needs: a thinned polyline, ranges
// and events. Grows with the run, reading each frame once, so that a chart of two million frames
// costs the same as one of two thousand.
#pragma once

#include "engine/valve/sealbench.h"

typedef struct SbTrace SbTrace;

// Thinned: neighbours differ by more than 1/4000 of a range in displacement, force or time, and
// every event is kept.
typedef struct {
  double time, displacement, force;
  size_t frame;
} SbTracePoint;

// `model` (may be NULL) tells the ranges to expect. Owned by the caller.
SbTrace *sb_trace_create(const SbModel *model);
void sb_trace_destroy(SbTrace *trace);

// Reads frames from where it stopped up to `count`, at most `limit` of them (0: all). True if some
// are left to read.
bool sb_trace_extend(SbTrace *trace, const SbFrame *frames, size_t count, size_t limit);

// Points so far; borrowed until the next extend.
const SbTracePoint *sb_trace_points(const SbTrace *trace, size_t *count);

// Frames read.
size_t sb_trace_frames(const SbTrace *trace);

// Least and largest so far; 0 without frames.
typedef struct {
  double time_max;
  double displacement_min, displacement_max;
  double force_min, force_max;
  double pressure_peak_max;           // of both seals
  double film_max, film_min;          // of sliding contacts; 0 if none slid
  double contact_left, contact_right; // outermost ends of all contacts; equal if there were none
} SbTraceRange;

SbTraceRange sb_trace_range(const SbTrace *trace);

// Events of the first cycle met so far, just before each event.
const SbStageMark *sb_trace_marks(const SbTrace *trace);

// Events of every cycle met so far, in their order, the first of each stage in each cycle; at most
// SB_TRACE_EVENTS_MAX. Borrowed until the next extend.
typedef struct {
  SbStageMark mark;
  SbStage stage;
  int cycle; // from 0
} SbTraceEvent;

enum { SB_TRACE_EVENTS_MAX = 600 };
const SbTraceEvent *sb_trace_events(const SbTrace *trace, size_t *count);

// A stage's event in a cycle, NULL if it is not met yet; and the frame where the stage ends: that
// of the next event, or the last of `count` frames.
const SbStageMark *sb_trace_mark(const SbTrace *trace, SbStage stage, int cycle);
size_t sb_trace_stage_end(const SbTrace *trace, SbStage stage, int cycle, size_t count);

// Index of the event whose stage a frame is in: the last at or before it, but an event's own frame
// still belongs to the stage before. -1 without events.
int sb_trace_event_of(const SbTrace *trace, const SbFrame *frames, size_t frame);

// Peaks of a rig's force met so far, the first peak first, at most SB_TRACE_PEAKS_MAX; borrowed
// until the next extend.
enum { SB_TRACE_PEAKS_MAX = 20000 };
const SbTracePoint *sb_trace_peaks(const SbTrace *trace, size_t *count);

// Index of the last point at or before a frame; 0 without points.
size_t sb_trace_find(const SbTrace *trace, size_t frame);
