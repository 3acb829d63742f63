// Tables and figures of the thesis, recomputed. Each is a study file in assets/thesis, whose grids
// state what is computed, with the printed values and the reasons for differences:
//
//   [printed]      file = table_7_5.csv, next to the study file; a line for each printed row
//   [rows NAME]    compares a column of it with our figures, one row each:
//     at = KEY = EXPRESSION; ...      which sample of a grid belongs to a printed row
//     where = COLUMN = TEXT           the printed rows that are compared (default all)
//     label = Film at {speed} m/s, {pressure:Pa:MPa} MPa     COLUMN:FROM:TO converts
//     unit = m nm                     SI unit, and display unit
//     printed = EXPRESSION of columns
//     thesis = GRID: EXPRESSION       our value by the thesis' model
//     consistent = GRID: EXPRESSION   our value by the consistent set; "none TEXT" if there is none
//     reason.1 = TEXT | COMMAND or TEST | GRID: EXPRESSION
//                                     first step from our value by the thesis' model to the printed
//                                     one: the value after it; "within GRID: EXPRESSION": a value
//                                     between ours and that; "about GRID: EXPRESSION": a difference
//                                     of at most that size in either direction
//     model.1 = as reason.1           steps from there to the consistent set; the last one explains
//                                     the remaining difference
//     remains = 2 %                   largest remaining difference, relative to the printed value;
//                                     `unknown`: no reason is known for the remaining difference
//   [chart]        x = QUANTITY | SI unit | display unit, y.1 and so on likewise; log = x, y.1
//   [series NAME]  a curve of panel = 1: x, y = GRID: EXPRESSION over the samples of the grid;
//                  EXPRESSION over printed rows (where); with run = GRID over the frames of its
//                  first sample's run (part = in or back); with profile = GRID SEAL over its
//                  contact in the middle of B-C. style = curve, reference or dots; within = A .. B
//                  of x; name
//   [notes]        note.1 = TEXT
//
// Names in expressions: a column of the printed row, a figure of the sample, a parameter in force
// there, a variable of the grid, `pi`, `printed`, `thesis`, `consistent`, and `ours`, the value
// from which a step starts. COLUMN.rounding is half of the unit of the last printed digit. [COLUMN]
// (at most one in a text) is the text of a cell. In labels, reasons and notes {COLUMN},
// {COLUMN:FROM:TO} and {= GRID: EXPRESSION, SI DISPLAY} are replaced by values.
#pragma once

#include "app/document/study_file.h"
#include "app/study/printed.h"

#include "engine/valve/studies/study.h"

// A step of a comparison. Values are [SI of the row].
typedef struct {
  char *text;      // the reason
  char *shown_by;  // command or test that shows it
  double becomes;  // our value after the step; NaN: not computed
  double explains; // the part of the difference that it explains
  double bound;    // largest part that it can explain, if only a bound is known; NaN: `explains`
} SbThesisPart;

// Result of a comparison.
typedef enum {
  SB_THESIS_AGREES,       // equal within the printed digits
  SB_THESIS_EXPLAINED,    // the remaining difference is within `remains`
  SB_THESIS_BOUNDED,      // the same, with a step of which only a bound is known
  SB_THESIS_PARTLY,       // `remains = unknown`: no reason is known for the remaining difference
  SB_THESIS_NOT_PRINTED,  // nothing is printed
  SB_THESIS_NOT_COMPUTED, // nothing is computed, as the row states
  SB_THESIS_FAILS         // a difference without a reason or beyond `remains`, or a missing value
} SbThesisVerdict;

// Returns "agrees", "explained", "within bounds", "partly explained", "not printed", "not computed"
// or "fails".
const char *sb_thesis_verdict_name(SbThesisVerdict verdict);

// A row. Values are [si].
typedef struct {
  char *label;
  char si[16], shown[16];          // SI unit and display unit
  double printed;                  // NaN: nothing is printed
  double rounding;                 // half of the unit of the last printed digit; 0: not known
  double thesis, consistent;       // our values; NaN: none
  char *no_thesis, *no_consistent; // why there is none; NULL: there is one
  double difference;               // thesis (if NaN, consistent) minus printed
  double remains;                  // of the difference, after all steps
  GArray *reasons, *models;        // of SbThesisPart: the steps, in their order
  SbThesisVerdict verdict;
  char *fault; // why it fails; NULL: it does not
} SbThesisRow;

// A table or figure. Freed by sb_thesis_item_free().
typedef struct {
  char *name; // "table-7.5"
  char *title;
  char *source;     // where the printed values are from; NULL: nothing is printed
  GPtrArray *rows;  // of SbThesisRow
  GPtrArray *notes; // of char *
  SbStudy *chart;   // NULL: a table
  size_t fails;     // rows with SB_THESIS_FAILS
} SbThesisItem;

// Returns name and title of each shipped item in turn, in the order of the thesis, ends with NULL.
// NULL if the folder is missing. Freed by g_strfreev().
char **sb_thesis_items(void);

// Runs that items share: the first item that needs one computes it.
typedef struct SbThesisRuns SbThesisRuns;

// Returns an empty set of runs. Freed by sb_thesis_runs_free().
SbThesisRuns *sb_thesis_runs_new(void);

// Frees the runs.
void sb_thesis_runs_free(SbThesisRuns *runs);

// Computes the shipped item `name` on `jobs` threads. `runs` (NULL: none) is extended. `cancelled`
// (may be NULL) is called from any thread. Returns NULL with issues, or without one if it was
// cancelled.
SbThesisItem *sb_thesis_compute(const char *name, int jobs, SbThesisRuns *runs,
                                bool (*cancelled)(void *data), void *data, GPtrArray *issues);

// As sb_thesis_compute(), for the study file `path`.
SbThesisItem *sb_thesis_compute_file(const char *path, int jobs, SbThesisRuns *runs,
                                     bool (*cancelled)(void *data), void *data, GPtrArray *issues);

// Frees an item.
void sb_thesis_item_free(SbThesisItem *item);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbThesisItem, sb_thesis_item_free)
