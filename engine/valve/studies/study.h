// Studies: charts and tables that look at a scene's neighbourhood instead of at its cycle.
//
// A study varies something about a model (the squeeze, the speed, the storage time, the choice of
// model ...) and tells what follows: curves over one abscissa in a few panels, and a table. Each is
// a pure function of SbModel, so that the command line, the window and tests get the same numbers.
// Whoever wants one asks for it by name; nothing else computes it.
#pragma once

#include "engine/base/status.h"
#include "engine/valve/answer/evaluate.h"
#include "engine/valve/model/valve.h"

// enumerator, function's suffix, name, title, help
#define SB_STUDY_LIST(X)                                                                           \
  X(SB_STUDY_SQUEEZE, squeeze, "squeeze", "Load over squeeze",                                     \
    "load, peak and width of every fitment model over the squeeze, compared with the solved ring") \
  X(SB_STUDY_MODELS, models, "models", "Fitment models side by side",                              \
    "thesis, linear disc and finite-strain ring: loads, peaks, widths, sensitivities, friction")   \
  X(SB_STUDY_FILM_LAW, film_law, "film-law", "Film law from our own solutions",                    \
    "h/R = k U^b W^a regressed over a range, with residuals, compared with eq. 7.5, 7.6 and the "  \
    "limit")                                                                                       \
  X(SB_STUDY_STORAGE, storage, "storage", "Storage time",                                          \
    "load, friction, squeeze and modulus against storage time: relaxation, set, swell")            \
  X(SB_STUDY_LEAK, leak, "leak", "Leak over squeeze",                                              \
    "leak at rest and leakage per stroke over the squeeze: where too little squeeze leaks")        \
  X(SB_STUDY_STRIBECK, stribeck, "stribeck", "Stribeck curve",                                     \
    "friction, real contact and film of both seals over the speed, as the cycle takes them")       \
  X(SB_STUDY_TOLERANCE, tolerance, "tolerance", "Tolerances",                                      \
    "loads, break-away and return force over the tolerances of the sizes: worst case and RSS")     \
  X(SB_STUDY_PROPELLANTS, propellants, "propellants", "Propellants over the temperature",          \
    "pressure force, break-away, least return and dose of each propellant in this valve")

typedef enum {
#define SB_STUDY_ENUM(code, function, name, title, help) code,
  SB_STUDY_LIST(SB_STUDY_ENUM)
#undef SB_STUDY_ENUM
      SB_STUDY_COUNT
} SbStudyKind;

enum {
  SB_STUDY_PANELS = 4,
  SB_STUDY_SERIES = 10,
  SB_STUDY_POINTS = 128,
  SB_STUDY_MARKS = 4,
  SB_STUDY_COLUMNS = 12,
  SB_STUDY_ROWS = 24,
  SB_STUDY_NOTES = 8
};

// A quantity and its unit: values are in the SI unit `si`, people read `unit`.
typedef struct {
  char quantity[48];
  char si[16], unit[16]; // "1" and "" without unit
  bool logarithmic;
} SbStudyAxis;

typedef enum {
  SB_STUDY_CURVE,     // the subject, solved
  SB_STUDY_REFERENCE, // closed form, law or literature to set beside it
  SB_STUDY_DOTS       // single values: solved points, measurements
} SbStudyStyle;

// One curve. x rises; a y that is not finite is a gap: the model has no answer there.
typedef struct {
  char name[40]; // equal names in several panels are the same thing
  SbStudyStyle style;
  size_t count;
  double x[SB_STUDY_POINTS], y[SB_STUDY_POINTS]; // in the axes' SI units
} SbStudySeries;

typedef struct {
  SbStudyAxis y;
  char empty[64];               // what it means if no curve has a value
  double limit_low, limit_high; // of the scene on this figure [SI]; infinite: none
  size_t series_count;
  SbStudySeries series[SB_STUDY_SERIES];
} SbStudyPanel;

// A place on the abscissa worth a line across all panels: "as designed".
typedef struct {
  double x; // in the abscissa's SI unit
  char text[40];
} SbStudyMark;

typedef struct {
  char name[40];
  char si[16], unit[16];
  int digits; // significant ones shown, 0 for a count
} SbStudyColumn;

// A row's own unit, if it has one, stands for those of the columns.
typedef struct {
  char name[64];
  char si[16], unit[16];
  double value[SB_STUDY_COLUMNS]; // in SI units; NaN: no value
} SbStudyRow;

// A finished study. Plain data without pointers, about 90 kB.
typedef struct {
  SbStudyKind kind;
  SbStudyAxis x;
  size_t panel_count;
  SbStudyPanel panel[SB_STUDY_PANELS];
  size_t mark_count;
  SbStudyMark mark[SB_STUDY_MARKS];
  char row_heading[40]; // of the table's first column; empty without table
  size_t column_count, row_count;
  SbStudyColumn column[SB_STUDY_COLUMNS];
  SbStudyRow row[SB_STUDY_ROWS];
  char models[160];       // what made it: "ring, disc, lindley"
  char validity[SB_TEXT]; // where it holds
  // Largest error estimate of what was solved [1]: of a film relative to itself, of a load or a
  // contact width relative to the largest one, because a ring that barely touches has none to speak
  // of. 0: closed forms alone.
  double error;
  size_t note_count;
  char note[SB_STUDY_NOTES][SB_TEXT]; // what the numbers say, definitions, sources
  SbWarnings warnings;
  size_t solves; // fitments and films solved for it, closed forms not counted
  bool complete; // false: some points are gaps because a solver did not converge
} SbStudy;

// Adds a panel, a series, a point; borrowed from `out`. They never fail: nobody asks for more than
// SbStudy holds. Charts that are no study are drawn from an SbStudy filled by these, too.
SbStudyPanel *sb_study_panel(SbStudy *out, const SbStudyAxis *y, const char *empty);
SbStudySeries *sb_study_series(SbStudyPanel *panel, SbStudyStyle style, const char *name);
void sb_study_point(SbStudySeries *series, double x, double y);

// Both functions may be NULL. `progress` is told the fraction done; a true answer of `cancelled`
// ends the study within one solve.
typedef struct {
  void (*progress)(void *data, double fraction);
  bool (*cancelled)(void *data);
  void *data;
} SbStudyHooks;

// Name on the command line and in files ("squeeze"), title, one line of help; borrowed, NULL
// outside the enumeration.
const char *sb_study_name(SbStudyKind kind);
const char *sb_study_title(SbStudyKind kind);
const char *sb_study_help(SbStudyKind kind);

// Finds a study by name; false (and nothing written) if there is none.
SB_CHECKED bool sb_study_from_name(SbStudyKind *out, const char *name);

// Predicted seconds on one core, for the plan.
double sb_study_cost(SbStudyKind kind, const SbModel *model);

// Rows that a study wants answered.
typedef struct {
  const double *value; // [rows][columns]
  size_t rows;
  const SbEvaluator *start; // from whose rings theirs start; NULL: cold
  // Told each row where it was computed, several at the same time.
  void (*seen)(void *data, size_t row, SbStatus status, const SbReport *report,
               const SbEvaluator *evaluator);
  void (*progress)(void *data, size_t done, size_t of);
  bool (*cancelled)(void *data);
  void *data; // of the three
} SbStudyAsk;

// A study's grid as its file lays it out, and who answers it. Lines are the combinations of all but
// the last parameter of the file's grids, counted from 0; x is that last one.
typedef struct {
  const SbModel *base;       // the scene with what the study holds
  const char *const *column; // [columns]: keys, and names of variables
  size_t columns, samples, figures;
  const double *value; // [samples][columns]; NaN: as in the base
  const int *line;     // [samples]
  const double *x;     // [samples]
  // A row of a line at another x; of no line (-1): what follows from the variables that the row
  // has.
  void (*place)(void *data, double *row, int line, double x);
  // Figures [rows][figures]. SB_ERROR_CANCELLED, SB_ERROR_MEMORY.
  SbStatus (*answer)(void *data, double *value, const SbStudyAsk *ask);
  void *data;
} SbStudyGrid;

// Whether a study is a view of a grid, which sb_study_view() needs. Parameters that its columns
// have behind those of the file: how many, *out borrowed.
bool sb_study_has_grid(SbStudyKind kind);
size_t sb_study_extra(const SbParamId **out, SbStudyKind kind);

// Makes a study of `model` from its grid (NULL for one that has none). `hooks` and `report` may be
// NULL. A point that a solver cannot reach is a gap with a warning and complete = false, not a
// failure. SB_ERROR_CANCELLED, SB_ERROR_MEMORY, SB_ERROR_RANGE with the key at fault; *out then
// says nothing.
SbStatus sb_study_view(SbStudy *out, SbStudyKind kind, const SbModel *model,
                       const SbStudyGrid *grid, const SbStudyHooks *hooks, SbReport *report);
