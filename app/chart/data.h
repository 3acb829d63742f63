// What a view draws: a run so far, the playhead, runs and data for comparison, and the state of the
// program. A view is a function of this, a rectangle and a theme only, without state of its own.
#pragma once

#include "app/chart/trace.h"
#include "app/data/compare.h"
#include "app/draw/theme.h"
#include "engine/valve/sealbench.h"

// State of a run.
typedef enum {
  SB_CHART_EMPTY,   // no run yet
  SB_CHART_RUNNING, // more frames will follow
  SB_CHART_DONE,    // complete
  SB_CHART_PARTIAL, // cancelled; its frames so far can be played
  SB_CHART_FAILED   // a solver did not converge; the run ends at the last good state
} SbChartState;

// One run as charts see it. All pointers are borrowed. All zeros is SB_CHART_EMPTY without frames.
typedef struct {
  SbChartState state;
  const SbFrame *frames;       // [count], in the order of time
  size_t count;                // frames that are available
  const SbTrace *trace;        // of these frames, possibly not yet of all; NULL only if count is 0
  const SbModel *model;        // may be NULL
  const SbSummary *summary;    // NULL until the run has ended
  const SbLifeActuation *life; // [life_count] actuations; NULL until the run has ended
  size_t life_count;
  // Returns the contact profile with the index SbSealFrame.profile, NULL for UINT32_MAX; a NULL
  // function or result: the run stored none. `source` is passed to it.
  const SbContactProfile *(*profile)(const void *source, uint32_t index);
  // Returns the solved ring with the index SbSealFrame.shape, as `profile`.
  const SbSealShape *(*shape)(const void *source, uint32_t index);
  const void *source;
} SbChartRun;

// A loop.
typedef struct {
  size_t count;
  const double *displacement; // [count], of the stem [m]
  const double *force;        // [count], of the drive [N]
} SbChartCurve;

// The prediction of a run that is not solved yet: its loop, and a run with one frame at the
// position of the playhead, with its contacts' profiles and all figures; `run.profile` is not NULL.
typedef struct {
  SbChartCurve loop;
  SbChartRun run;
} SbChartPredicted;

// A pinned run for comparison.
typedef struct {
  const SbChartRun *run;
  const char *name; // its name or difference: "section diameter 1.63 mm"
  int look;         // drawing style, 0 to SB_CHART_PINS - 1: colour and dashes
  size_t frame;     // frame of `run` at the position of the playhead
} SbChartPin;

// Largest number of pins that are drawn.
enum { SB_CHART_PINS = 2 };

// Returns the role of the colour of a drawing style (SbChartPin.look).
SbRole sb_chart_pin_role(int look);

// Returns the line of a drawing style (SbChartPin.look).
SbStroke sb_chart_pin_stroke(int look);

// Range of a loop's plot: displacements x0 to x1 [mm] and forces y0 to y1 [N].
typedef struct {
  double x0, x1, y0, y1;
} SbChartZoom;

// A bookmark of the user.
typedef struct {
  double time; // of the run [s]
  const char *name;
} SbChartMarker;

// Everything that views draw. All pointers are borrowed; each may be NULL. Initialise with zeros.
typedef struct {
  SbChartRun run;                // the live run
  const SbChartRun *earlier;     // drawn at 45 % opacity while `run` is computed; NULL: none
  SbChartPin pin[SB_CHART_PINS]; // [pin_count]
  size_t pin_count;
  // Prediction at the present values, while `run` belongs to earlier ones; NULL: none.
  const SbChartPredicted *predicted;
  const SbComparison *measured; // comparison with `run`; NULL: no measured data
  const SbChartZoom *zoom;      // range of the loop's plot; NULL: the full loop
  size_t playhead;              // index of the displayed frame; beyond the last: the last one
  bool playing;                 // the playhead moves with time
  double progress;              // fraction of a running run that is computed, 0 to 1
  const SbChartMarker *marker;  // [marker_count]
  size_t marker_count;
  const char *title;    // "Piston valve, one actuation"
  const char *subtitle; // names of the files; the header adds the run's conditions
  const char *hash;     // of the parameters; the first eight digits are drawn
  const char *stale;    // sentence of the amber strip; NULL: the run belongs to the parameters
  const char *failure;  // sentence of the red strip; NULL: none
} SbChartData;

// Bits of the parameter `flags` of views.
enum {
  SB_CHART_PANEL = 1 << 0,   // draw the panel's background, border and padding
  SB_CHART_COMPACT = 1 << 1, // for the window's column: smaller title, no explanations
  SB_CHART_WHOLE = 1 << 2    // no playhead: the full run is drawn as played
};

// Returns the frame at the playhead; NULL if there is none, or if its time, position or force is
// not finite (views then draw the run without the playhead).
const SbFrame *sb_chart_frame(const SbChartData *data);

// Returns the index of the frame nearest to a time [s]; the run must have frames.
size_t sb_chart_nearest(const SbChartRun *run, double time);

// Returns whether the live run is complete and its trace contains all frames.
bool sb_chart_complete(const SbChartData *data);

// Returns the name of seal `seal` (SB_OUTER, SB_INNER) of a model (NULL: of the piston valve),
// translated: "Inner seal". Static.
const char *sb_chart_seal_name(const SbModel *model, int seal);

// A force on the stem with its name and colour.
typedef struct {
  const char *name; // translated
  double force;     // drive > 0 into the canister; others > 0 push the stem out [N]
  SbRole role;
} SbChartForce;

// Largest number of forces.
enum { SB_CHART_FORCES_MAX = 5 };

// Writes the drive and the forces against it in `frame`, without the stops, to
// force[SB_CHART_FORCES_MAX], in this order: drive, pressure, the spring of a valve that has one,
// friction of the inner and of the outer seal. Returns their number.
size_t sb_chart_forces(SbChartForce *force, const SbModel *model, const SbFrame *frame);

// Returns what happens in a run after stage `stage` (SbStage) until the next one, translated: "both
// seals slide"; "" for another number. Static.
const char *sb_chart_phase(const SbChartRun *run, int stage);

// Writes "actuation 400" or "cycle 2" for cycle number `cycle` (from 0) of a run with several, and
// "" for a run with one, to out[SB_FORMAT_MAX]. Returns `out`.
const char *sb_chart_cycle_name(char *out, const SbChartRun *run, int cycle);

// Returns "B–C", the stage `stage` (SbStage) and the next one; "B" if none follows; "" for another
// number. `run` NULL: a valve. Static.
const char *sb_chart_span(const SbChartRun *run, int stage);

// Returns the state of a run that has ended: DONE, PARTIAL or FAILED by summary->status.
SbChartState sb_chart_state_of(const SbSummary *summary);

// Sets all fields of *out from a run; `run` and `trace` are borrowed as long as *out is used. The
// summary is set only if `state` is that of a run that has ended.
void sb_chart_run_init(SbChartRun *out, const SbRun *run, const SbTrace *trace, SbChartState state);

// Writes the force of a stage as text to out[SB_FORMAT_MAX] and returns `out`: run->summary's
// figure "cycle.stages.X.force_N", as every other output prints it, or before the run has ended (or
// if this figure is NaN) `force` [N], the force of the event in the trace.
char *sb_chart_stage_force(char *out, const SbChartRun *run, SbStage stage, double force);

// Returns the run's estimate of the relative error of forces; 0: unknown.
double sb_chart_error_force(const SbChartRun *run);

// Returns the run's estimate of the relative error of films; 0: unknown.
double sb_chart_error_film(const SbChartRun *run);

// Returns the run's estimate of the relative error of contact loads; 0: unknown.
double sb_chart_error_load(const SbChartRun *run);
