// What a view is given: a run so far, where the playhead stands, what to compare with, and in which
// state the program is. Views are pure functions of this, a rectangle and a theme.
#pragma once

#include "app/base/theme.h"
#include "app/chart/trace.h"
#include "app/data/compare.h"
#include "engine/valve/sealbench.h"

typedef enum {
  SB_CHART_EMPTY,   // no run yet
  SB_CHART_RUNNING, // frames still come
  SB_CHART_DONE,    //
  SB_CHART_PARTIAL, // cancelled: what there is can be played
  SB_CHART_FAILED   // a solver gave up: the last good state stays
} SbChartState;

// One run as charts see it. All pointers are borrowed.
typedef struct {
  SbChartState state;
  const SbFrame *frames;       // `count` of them may be read
  size_t count;                //
  const SbTrace *trace;        // of the same frames; may lag behind count
  const SbModel *model;        // may be NULL
  const SbSummary *summary;    // NULL until the run has ended
  const SbLifeActuation *life; // of `life_count` actuations; likewise
  size_t life_count;
  // Contact profile of a frame's seal by its index; NULL function or NULL answer: none was kept.
  const SbContactProfile *(*profile)(const void *source, uint32_t index);
  // Solved shape of a frame's ring, likewise.
  const SbSealShape *(*shape)(const void *source, uint32_t index);
  const void *source;
} SbChartRun;

// A loop in `count` points: displacement [m] and force [N].
typedef struct {
  size_t count;
  const double *displacement, *force;
} SbChartCurve;

// What is predicted of a run that is not solved yet: its loop, and a run of one frame, that which
// stands where the playhead does, with its contacts' profiles and all figures.
typedef struct {
  SbChartCurve loop;
  SbChartRun run;
} SbChartPredicted;

// A run that is kept to compare with.
typedef struct {
  const SbChartRun *run;
  const char *name; // what it differs in: "section diameter 1.63 mm"
  int look;         // of SB_CHART_PINS: its colour and dashes
  size_t frame;     // that stands where the playhead does
} SbChartPin;

enum { SB_CHART_PINS = 2 };

// The role of its colour, and its dashes.
SbRole sb_chart_pin_role(int look);
const SbDash *sb_chart_pin_dash(int look);

// Part of a loop's plot that is enlarged over it: displacements [mm] and forces [N].
typedef struct {
  double x0, x1, y0, y1;
} SbChartZoom;

// A bookmark of the user's.
typedef struct {
  double time;
  const char *name;
} SbChartMarker;

typedef struct {
  SbChartRun run;
  const SbChartRun *earlier;     // shown at 45 % while `run` is being computed; NULL: none
  SbChartPin pin[SB_CHART_PINS]; // to compare with, `pin_count` of them
  size_t pin_count;
  // What `run`, which is then of former values, will be at the present ones; NULL: not known.
  const SbChartPredicted *predicted;
  const SbComparison *measured; // of `run`; NULL: nothing was measured
  const SbChartZoom *zoom;      // of the loop; NULL: all of it
  size_t playhead;              // frame shown
  bool playing;                 // no effect on layout
  double progress;              // of a running run, 0 to 1
  const SbChartMarker *marker;  // `marker_count` of them
  size_t marker_count;
  const char *title;    // "Piston valve, one actuation"
  const char *subtitle; // names of the files; the header adds the run's conditions
  const char *hash;     // of the parameters; the first eight digits are shown
  const char *stale;    // sentence of the amber strip; NULL: the run fits the parameters
  const char *failure;  // sentence of the red strip; NULL: none
} SbChartData;

// Flags of every view.
enum {
  SB_CHART_PANEL = 1 << 0,   // with the panel's ground, hairline and padding
  SB_CHART_COMPACT = 1 << 1, // the window's column: smaller title, no explaining lines
  SB_CHART_WHOLE = 1 << 2    // no playhead: the whole run is shown as played
};

// The frame under the playhead; NULL if there is none, or if it has no finite time, place and force
// (an engine's defect: the views then show the run without *now*).
const SbFrame *sb_chart_frame(const SbChartData *data);

// Frame nearest to a time [s]; the run must have frames.
size_t sb_chart_nearest(const SbChartRun *run, double time);

// Whether the run (NULL: no) is of the sliding-plate rig rather than of a valve.
bool sb_chart_is_rig(const SbChartRun *run);

// The whole run is readable: done, and the trace has caught up.
bool sb_chart_complete(const SbChartData *data);

// The same of a gasket valve, whatever has run: "chamber fills past the neck".
const char *sb_chart_gasket_phase(int stage);

// What a seal of a model (NULL: of the piston valve) is called, "Inner seal"; translated.
const char *sb_chart_seal_name(const SbModel *model, int seal);

// A force on the stem with what it is called and the colour it has.
typedef struct {
  const char *name; // translated
  double force;     // as in SbFrame [N]
  SbRole role;
} SbChartForce;

enum { SB_CHART_FORCES_MAX = 5 };

// The drive, and what it works against while the stem meets no stop: pressure, the spring of a
// valve that has one, friction of both seals. Returns how many.
size_t sb_chart_forces(SbChartForce *force, const SbModel *model, const SbFrame *frame);

// What happens after stage `stage` until the next: "both seals slide".
const char *sb_chart_phase(const SbChartRun *run, int stage);

// "actuation 400" or "cycle 2" of a run that shows several, counted from 0; "" where there is one.
// Written to `out` of SB_FORMAT_MAX bytes, which is returned.
const char *sb_chart_cycle_name(char *out, const SbChartRun *run, int cycle);

// "B-C" with an en dash: the stage a frame is in and the next; "B" where none follows. `run` may be
// NULL: a valve.
const char *sb_chart_span(const SbChartRun *run, int stage);

// State of a run that has ended.
SbChartState sb_chart_state_of(const SbSummary *summary);

// Fills a view of a run that the caller keeps. The trace is the caller's; the summary is read only
// once the run has ended.
void sb_chart_run_init(SbChartRun *out, const SbRun *run, const SbTrace *trace, SbChartState state);

// The force of a stage's mark as text, into `out` of SB_FORMAT_MAX bytes, which is returned: once
// the run has ended, the figure "cycle.stages.X.force_N" as every other surface prints it.
char *sb_chart_stage_force(char *out, const SbChartRun *run, SbStage stage, double force);

// Relative error to quote for forces and films: the run's estimate, or 0 when unknown.
double sb_chart_error_force(const SbChartRun *run);
double sb_chart_error_film(const SbChartRun *run);
double sb_chart_error_load(const SbChartRun *run);
