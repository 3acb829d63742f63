// Studies: charts and tables that show how results of a scene depend on a varied quantity (squeeze,
// speed, storage time, choice of model ...).
//
// The result, SbStudy, has curves over one abscissa in a few panels, and a table. For a kind with
// sb_study_has_grid() the varied values are those of the file assets/studies/NAME.study, which the
// caller reads and passes as an SbStudyGrid; all other kinds depend on the SbModel only. Studies
// have no state: several may be computed concurrently.
#pragma once

#include "engine/base/status.h"
#include "engine/valve/answer/evaluate.h"
#include "engine/valve/model/study_kinds.h"
#include "engine/valve/model/valve.h"

// Capacities of SbStudy.
enum {
  SB_STUDY_PANELS = 4,
  SB_STUDY_SERIES = 10,
  SB_STUDY_POINTS = 128,
  SB_STUDY_MARKS = 4,
  SB_STUDY_COLUMNS = 12,
  SB_STUDY_ROWS = 24,
  SB_STUDY_NOTES = 8
};

// A quantity and its units. Values are in the SI unit `si`; `unit` is for display.
typedef struct {
  char quantity[48];
  char si[16], unit[16]; // SI unit and display unit; "1" and "" if dimensionless
  bool logarithmic;      // the axis has a logarithmic scale
} SbStudyAxis;

// What a curve is.
typedef enum {
  SB_STUDY_CURVE,     // the subject, solved
  SB_STUDY_REFERENCE, // closed form, law or literature, for comparison
  SB_STUDY_DOTS       // single values: solved points, measurements
} SbStudyStyle;

// One curve. x increases; a y that is not finite is a gap.
typedef struct {
  char name[40]; // for the legend; curves of one name in several panels show one subject
  SbStudyStyle style;
  int seal;     // 1 + SB_OUTER, 1 + SB_INNER: drawn in the colour of the seal; 0: not of one seal
  size_t count; // number of points
  double x[SB_STUDY_POINTS], y[SB_STUDY_POINTS]; // in the axes' SI units
} SbStudySeries;

// One ordinate with its curves.
typedef struct {
  SbStudyAxis y;
  char empty[64];               // text to display if no curve has a finite y
  double limit_low, limit_high; // limits of the scene on y [SI]; -INFINITY, INFINITY: none
  size_t series_count;          // number of curves
  SbStudySeries series[SB_STUDY_SERIES];
} SbStudyPanel;

// A marked abscissa, a line across all panels ("as designed").
typedef struct {
  double x;      // in the abscissa's SI unit
  char text[40]; // label
} SbStudyMark;

// A column of the table.
typedef struct {
  char name[40];         // heading
  char si[16], unit[16]; // as in SbStudyAxis
  int digits;            // significant digits for display
  bool difference;       // the values are differences: positive ones are shown with a plus
} SbStudyColumn;

// A row of the table.
typedef struct {
  char name[64];                  // text of the first column
  char si[16], unit[16];          // if not "": units of this row, instead of those of the columns
  double value[SB_STUDY_COLUMNS]; // in SI units; NaN: no value
} SbStudyRow;

// A finished study. Plain data without pointers to free, about 90 kB.
typedef struct {
  SbStudyKind kind;
  SbStudyAxis x; // the abscissa of all panels
  size_t panel_count;
  SbStudyPanel panel[SB_STUDY_PANELS];
  size_t mark_count;
  SbStudyMark mark[SB_STUDY_MARKS];
  char row_heading[40]; // heading of the table's first column, the rows' names; "": no table
  size_t column_count, row_count;
  SbStudyColumn column[SB_STUDY_COLUMNS];
  SbStudyRow row[SB_STUDY_ROWS];
  char models[160];       // models used: "ring, disc, lindley"
  char validity[SB_TEXT]; // range of validity
  // Largest error estimate of solved values [1]: of a film relative to itself, of a load or contact
  // width relative to the largest one. 0: closed forms only.
  double error;
  size_t note_count;
  char note[SB_STUDY_NOTES][SB_TEXT]; // explanations, definitions, sources
  SbWarnings warnings;
  size_t solves; // number of solved fits and films
  size_t work;   // solver steps, at most output.work_limit of the scene
  bool complete; // false: gaps because a solver did not converge
  // Where the first of those solvers failed, and why; empty if all converged.
  double gap_at; // abscissa; NaN: at none in particular
  char gap[SB_TEXT];
  // Number from 1 of the first warning that states why points have no value; 0: none.
  size_t missing;
} SbStudy;

// Adds a panel with the ordinate `y`, the text `empty`, no limits and no curves, and returns it,
// borrowed from `out`, which is {0} or a study. The caller must not add more than SB_STUDY_PANELS
// (asserted). Charts that are not studies use this and the next two functions too.
SbStudyPanel *sb_study_panel(SbStudy *out, const SbStudyAxis *y, const char *empty);

// Adds a curve without points to `panel` and returns it, borrowed from `panel`; at most
// SB_STUDY_SERIES (asserted).
SbStudySeries *sb_study_series(SbStudyPanel *panel, SbStudyStyle style, const char *name);

// Appends a point to a curve, in the axes' SI units, with x not below that of the last point; at
// most SB_STUDY_POINTS (asserted).
void sb_study_point(SbStudySeries *series, double x, double y);

// Callbacks of sb_study_view(), called in its thread; each function may be NULL.
typedef struct {
  void (*progress)(void *data, double fraction); // completed fraction, 0 to 1
  bool (*cancelled)(void *data);                 // true ends the study within one solve
  void *data;                                    // argument of both
} SbStudyHooks;

// Rows of a grid for which a study requests figures. Every row solves all of its contacts. The
// study fills it and calls SbStudyGrid.answer(); all pointers are valid during that call. The three
// functions are never NULL.
typedef struct {
  const double *value; // [rows][columns] values of SbStudyGrid.column in SI; NaN: as in the base
  size_t rows;         // number of rows
  size_t work_used;    // SbQuestion.work_used for all rows
  // To be called once for each row, after it is computed, in any thread; several threads may call
  // it simultaneously for different rows. `status` and `report` (not NULL) are those of
  // sb_evaluator_ask() for the row, and `evaluator` is the one that was asked.
  void (*seen)(void *data, size_t row, SbStatus status, const SbReport *report,
               const SbEvaluator *evaluator);
  // To be called in the thread of answer(): `done` of `of` rows are computed.
  void (*progress)(void *data, size_t done, size_t of);
  bool (*cancelled)(void *data); // to be called in the thread of answer(); true: stop
  void *data;                    // argument of the three functions
} SbStudyAsk;

// The grid of assets/studies/NAME.study, and functions of the caller that compute its rows. All
// pointers are borrowed during the call of sb_study_view().
//
// A sample is one row of the grid. The last grid parameter of the file is the abscissa x. A line is
// one combination of values of all other grid parameters, numbered from 0 in the order of the file
// (groups in their order, the parameter before the last one fastest).
typedef struct {
  const SbModel *base;       // the scene under the conditions of the file's `hold` (hold.h)
  const char *const *column; // [columns] keys of parameters and names of variables: those of the
                             // file's [vary] groups in order, then the keys of sb_study_extra()
  size_t columns, samples;
  size_t figures;      // number of figures that answer() computes: the list `figures` of the file
  const double *value; // [samples][columns] SI; NaN: as in the base
  const int *line;     // [samples] number of the sample's line; lines in increasing order
  const double *x;     // [samples] abscissa of the sample, SI
  // Sets row[columns]. line >= 0: to the values of that line at the abscissa `x`, which need not be
  // a sample. line = -1: `row` has values (NaN: as in the base); recomputes only the columns that
  // the file defines by expressions of its variables.
  void (*place)(void *data, double *row, int line, double x);
  // Computes value[ask->rows][figures] in SI, in the order of the file's list `figures`. A row that
  // is refused or fails has NaN for each figure that was not computed; this is no error.
  // SB_ERROR_CANCELLED: ask->cancelled() returned true; SB_ERROR_MEMORY.
  SbStatus (*answer)(void *data, double *value, const SbStudyAsk *ask);
  void *data; // argument of place() and answer()
} SbStudyGrid;

// Returns whether sb_study_view() needs a grid for this study. False outside the enumeration.
bool sb_study_has_grid(SbStudyKind kind);

// Returns the number of parameters whose keys follow those of the file in SbStudyGrid.column, and
// sets *out to the array of them (static; not to be read if the number is 0). The samples have NaN
// in these columns.
size_t sb_study_extra(const SbParamId **out, SbStudyKind kind);

// Raises spread[SB_FIGURE_COUNT], in the SI unit of the figures, to the differences between the
// models that a study compares at the pressure of the scene `model`: load, peak pressure and
// contact width of the outer seal by SB_STUDY_MODELS. Other studies have none.
void sb_study_spread(double spread[SB_FIGURE_COUNT], const SbStudy *study, const SbModel *model);

// Computes the study `kind` of the scene `model`. `grid` is required if sb_study_has_grid(kind),
// else NULL. `hooks` may be NULL. If a solver fails at a point, or the study exhausts its own
// budget of output.work_limit solver steps, the curves have a gap there, a warning states why,
// `complete` is false, and the function returns SB_OK. SB_ERROR_INPUT: `kind` is outside the
// enumeration. SB_ERROR_INFEASIBLE: the scene lacks what the study needs; the report has the input.
// SB_ERROR_RANGE, SB_ERROR_INPUT: the scene's values are inconsistent under the conditions of the
// study; the report has the input. SB_ERROR_CANCELLED. After an error *out is not a complete study.
SbStatus sb_study_view(SbStudy *out, SbStudyKind kind, const SbModel *model,
                       const SbStudyGrid *grid, const SbStudyHooks *hooks, SbReport *report);
