// A run's frames reduced to what a picture of the full cycle needs: a thinned polyline, ranges and
// events. A trace grows with the run and reads each frame once, so that a chart of two million
// frames costs the same as one of two thousand.
#pragma once

#include "engine/valve/sealbench.h"

typedef struct SbTrace SbTrace;

// A point of the polyline. Neighbours differ by at least 1/4000 of an expected range in
// displacement, force or time (if a run is much longer than expected, by 1/2000, 1/1000, ...);
// events and the points before jumps are added.
typedef struct {
  double time;         // [s]
  double displacement; // of the stem [m]
  double force;        // of the drive [N]
  size_t frame;        // index of its frame
} SbTracePoint;

// Returns an empty trace. `model` (NULL: unknown) determines the expected ranges; it is read only
// during the call. Freed by sb_trace_destroy().
SbTrace *sb_trace_create(const SbModel *model);

// Frees a trace.
void sb_trace_destroy(SbTrace *trace);

// Reads the frames that were not read yet of frames[count], at most `limit` of them (0: all).
// `frames` begins with the first frame of the run in every call. Returns whether some are left to
// read.
bool sb_trace_extend(SbTrace *trace, const SbFrame *frames, size_t count, size_t limit);

// Returns the points so far and their number in *count. Borrowed until the next sb_trace_extend().
const SbTracePoint *sb_trace_points(const SbTrace *trace, size_t *count);

// Returns the number of frames that were read.
size_t sb_trace_frames(const SbTrace *trace);

// Ranges of all frames that were read; 0 without frames.
typedef struct {
  double time_max;                           // [s]
  double displacement_min, displacement_max; // [m]
  double force_min, force_max;               // [N]
  double pressure_peak_max;                  // largest SbSealFrame.pressure_peak of both seals [Pa]
  double film_max, film_min; // largest central film, smallest film of contacts [m]; 0: no film
  double contact_left, contact_right; // smallest left and largest right end of all contacts in
                                      // their seals' frames [m]; equal: no contact
} SbTraceRange;

// Returns the ranges.
SbTraceRange sb_trace_range(const SbTrace *trace);

// Returns the events of the first cycle, [SB_STAGE_COUNT] by SbStage; `reached` is false for those
// that were not read yet.
const SbStageMark *sb_trace_marks(const SbTrace *trace);

// An event: the first of a stage in a cycle.
typedef struct {
  SbStageMark mark;
  SbStage stage;
  int cycle; // from 0
} SbTraceEvent;

// Largest number of events; later ones are omitted.
enum { SB_TRACE_EVENTS_MAX = 600 };

// Returns the events of all cycles that were read, in their order, and their number in *count.
// Borrowed until the next sb_trace_extend().
const SbTraceEvent *sb_trace_events(const SbTrace *trace, size_t *count);

// Returns the event of a stage in a cycle (from 0); NULL: not read yet, or not reached. Borrowed
// until the next sb_trace_extend().
const SbStageMark *sb_trace_mark(const SbTrace *trace, SbStage stage, int cycle);

// Returns the index of the frame at which a stage of a cycle (from 0) ends: that of the next event,
// or, also if the stage was not reached, the last of the run's `count` frames (> 0).
size_t sb_trace_stage_end(const SbTrace *trace, SbStage stage, int cycle, size_t count);

// Returns the index in sb_trace_events() of the event whose stage contains frame number `frame` of
// frames[]: the last event before it (the frame of an event belongs to the stage before). -1: no
// event at or before it.
int sb_trace_event_of(const SbTrace *trace, const SbFrame *frames, size_t frame);

// Largest number of peaks; later ones are omitted.
enum { SB_TRACE_PEAKS_MAX = 20000 };

// Returns the peaks of the force of a sliding-plate rig that were read, in the order of time, and
// their number in *count. Borrowed until the next sb_trace_extend().
const SbTracePoint *sb_trace_peaks(const SbTrace *trace, size_t *count);

// Returns the index in sb_trace_points() of the last point at or before frame number `frame`; 0 if
// there is none.
size_t sb_trace_find(const SbTrace *trace, size_t frame);
