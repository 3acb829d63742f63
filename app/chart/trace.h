// A run's frames boiled down to what a picture of the whole cycle needs: a thinned polyline, ranges
// and events. Grows with the run, reading each frame once, so that a chart of two million frames
// costs the same as one of two thousand.
#pragma once

#include "engine/sealbench.h"

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

// Events met so far, just before each event.
const SbStageMark *sb_trace_marks(const SbTrace *trace);

// Peaks of a rig's force met so far, the first peak first, at most SB_TRACE_PEAKS_MAX; borrowed
// until the next extend.
enum { SB_TRACE_PEAKS_MAX = 20000 };
const SbTracePoint *sb_trace_peaks(const SbTrace *trace, size_t *count);

// Index of the last point at or before a frame; 0 without points.
size_t sb_trace_find(const SbTrace *trace, size_t frame);
