// Studies: charts and tables of how results of a scene depend on something.
//
// A study varies something of a model (squeeze, speed, storage time, choice of model ...). Its
// result is curves over one abscissa in a few panels, and a table. A study that has a grid
// (assets/studies/NAME.study) gets the rows of that grid from the caller (SbStudyGrid); all others
// depend on the SbModel only. Studies have no state: different ones may be computed concurrently.
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
  char si[16], unit[16]; // "1" and "" without unit
  bool logarithmic;
} SbStudyAxis;

// What a curve is.
typedef enum {
  SB_STUDY_CURVE,     // the subject, solved
  SB_STUDY_REFERENCE, // closed form, law or literature, for comparison
  SB_STUDY_DOTS       // single values: solved points, measurements
} SbStudyStyle;

// One curve. x increases; a y that is not finite is a gap.
typedef struct {
  char name[40]; // equal names in several panels: the same subject
  SbStudyStyle style;
  size_t count;
  double x[SB_STUDY_POINTS], y[SB_STUDY_POINTS]; // in the axes' SI units
} SbStudySeries;

// One ordinate with its curves.
typedef struct {
  SbStudyAxis y;
  char empty[64];               // text if no curve has a value
  double limit_low, limit_high; // of the scene on this figure [SI]; infinite: none
  size_t series_count;
  SbStudySeries series[SB_STUDY_SERIES];
} SbStudyPanel;

// A marked abscissa, a line across all panels ("as designed").
typedef struct {
  double x; // in the abscissa's SI unit
  char text[40];
} SbStudyMark;

// A column of the table.
typedef struct {
  char name[40];
  char si[16], unit[16];
  int digits; // significant digits for display
} SbStudyColumn;

// A row of the table. If `unit` is not "", the row's own units replace those of the columns.
typedef struct {
  char name[64];
  char si[16], unit[16];
  double value[SB_STUDY_COLUMNS]; // in SI units; NaN: no value
} SbStudyRow;

// A finished study. Plain data without pointers to free, about 90 kB.
typedef struct {
  SbStudyKind kind;
  SbStudyAxis x;
  size_t panel_count;
  SbStudyPanel panel[SB_STUDY_PANELS];
  size_t mark_count;
  SbStudyMark mark[SB_STUDY_MARKS];
  char row_heading[40]; // of the table's first column; "" without table
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
  bool complete; // false: gaps because a solver did not converge
} SbStudy;

// Adds a panel without limits and returns it, borrowed from `out`. Does not fail: a caller must not
// add more than SbStudy can store. Charts that are not studies use this and the next two functions
// too.
SbStudyPanel *sb_study_panel(SbStudy *out, const SbStudyAxis *y, const char *empty);

// Adds a curve without points and returns it, borrowed; does not fail, as above.
SbStudySeries *sb_study_series(SbStudyPanel *panel, SbStudyStyle style, const char *name);

// Adds a point to a curve, in SI units; does not fail, as above.
void sb_study_point(SbStudySeries *series, double x, double y);

// Callbacks, called in the calling thread; both functions may be NULL.
typedef struct {
  void (*progress)(void *data, double fraction); // completed fraction, 0 to 1
  bool (*cancelled)(void *data);                 // true ends the study within one solve
  void *data;
} SbStudyHooks;

// Rows for which a study needs figures.
typedef struct {
  const double *value; // [rows][columns]
  size_t rows;
  const SbEvaluator *start; // rings start from its states; NULL: cold start
  // Called for each row in the thread that computed it, for several at the same time. `evaluator`
  // has the row's model and summary.
  void (*seen)(void *data, size_t row, SbStatus status, const SbReport *report,
               const SbEvaluator *evaluator);
  void (*progress)(void *data, size_t done, size_t of);
  bool (*cancelled)(void *data);
  void *data; // of the three functions
} SbStudyAsk;

// The grid of a study's file, and functions that compute it. A "line" is a combination of all grid
// parameters except the last one, counted from 0; x is that last parameter. All pointers are
// borrowed during the call.
typedef struct {
  const SbModel *base;       // the scene with what the study keeps constant
  const char *const *column; // [columns] keys of parameters, and names of variables
  size_t columns, samples, figures;
  const double *value; // [samples][columns] SI; NaN: as in the base
  const int *line;     // [samples]
  const double *x;     // [samples] SI
  // Sets row[columns] for a line at another x; line -1: computes only what follows from the
  // variables that the row has.
  void (*place)(void *data, double *row, int line, double x);
  // Computes value[ask->rows][figures]. SB_ERROR_CANCELLED, SB_ERROR_MEMORY.
  SbStatus (*answer)(void *data, double *value, const SbStudyAsk *ask);
  void *data;
} SbStudyGrid;

// Returns whether sb_study_view() needs a grid for this study.
bool sb_study_has_grid(SbStudyKind kind);

// Returns the number of parameters that the grid's columns have after those of the file, and writes
// the array of them to *out (static). `kind` must be inside the enumeration.
size_t sb_study_extra(const SbParamId **out, SbStudyKind kind);

// Computes a study of `model`, from its grid (NULL if it has none). `hooks` may be NULL. A point
// that a solver cannot reach is a gap with a warning, and complete = false; that is no error.
// SB_ERROR_INPUT: no such study; SB_ERROR_INFEASIBLE: the scene lacks what the study needs, with
// the key; SB_ERROR_CANCELLED, SB_ERROR_MEMORY; errors of sb_model_hold(). *out is not a complete
// study after an error.
SbStatus sb_study_view(SbStudy *out, SbStudyKind kind, const SbModel *model,
                       const SbStudyGrid *grid, const SbStudyHooks *hooks, SbReport *report);
