// Tables and figures of the thesis, computed anew: each is a study file in assets/thesis, whose
// grids say what is computed, with what it is compared with.
//
//   [printed]      file = table_7_5.csv, beside the study file; a row a printed one
//   [rows NAME]    compares a column of it with our figures, a row each:
//     at = KEY = EXPRESSION; ...      which sample of a grid belongs to a printed row
//     where = COLUMN = TEXT           printed rows that are meant (default all)
//     label = Film at {speed} m/s, {pressure:Pa:MPa} MPa     COLUMN:FROM:TO converts
//     unit = m nm                     SI unit, and the one that people read
//     printed = EXPRESSION of columns
//     thesis = GRID: EXPRESSION       by the thesis' model
//     consistent = GRID: EXPRESSION   by the consistent set; "none TEXT" where there is none
//     reason.1 = TEXT | COMMAND or TEST | GRID: EXPRESSION   the first step from our value by the
//                                     thesis' model to the printed one: what ours becomes with it;
//                                     "within GRID: EXPRESSION": it may be anything from ours to
//                                     that, "about GRID: EXPRESSION": as far as that either way
//     model.1 = the same, the steps from there to the consistent set; the last takes the rest
//     remains = 2 %                   most that the steps may leave of the printed value; `unknown`
//                                     where no reason is found for the rest, which is told
//   [chart]        x = QUANTITY | SI unit | unit, y.1 and so on the same; log = x, y.1
//   [series NAME]  a curve of panel = 1: x, y = GRID: EXPRESSION over the grid's samples,
//   EXPRESSION
//                  over printed rows (where), or with run = GRID over the frames of its first
//                  sample's run (part = in or back), with profile = GRID SEAL over its contact in
//                  the middle of B-C; style = curve, reference or dots; within = A .. B of x; name
//   [notes]        note.1 = TEXT
//
// In expressions a name is a column of the printed row, a figure of the sample, a parameter in
// force there, a variable of the grid, `pi`, `printed`, `thesis`, `consistent`, or `ours`, which is
// the value that a step starts from; COLUMN.rounding is half of the last printed digit's unit. A
// cell in brackets, [COLUMN], stands for its text. In labels, reasons and notes {COLUMN},
// {COLUMN:FROM:TO} and {= GRID: EXPRESSION, SI shown} stand for values.
#pragma once

#include "app/document/study_file.h"
#include "app/study/printed.h"

#include "engine/valve/studies/study.h"

typedef struct {
  char *text, *shown_by; // what it is; the command or test that shows it
  double becomes;        // our value with it; NaN: not computed
  double explains;       // what that is of the difference [SI of the row]
  double bound;          // what it may be at most, where that is all that is known; NaN: it is that
} SbThesisPart;

// How a row stands: to the printed digits; within what the reasons may leave; so with a step that
// is a bound alone; beyond it, where `remains = unknown` says that no reason is found for the rest;
// nothing printed, or, as its row says, nothing computed; a difference without a reason or beyond
// what the reasons may leave, or no value where there should be one.
typedef enum {
  SB_THESIS_AGREES,
  SB_THESIS_EXPLAINED,
  SB_THESIS_BOUNDED,
  SB_THESIS_PARTLY,
  SB_THESIS_NOT_PRINTED,
  SB_THESIS_NOT_COMPUTED,
  SB_THESIS_FAILS
} SbThesisVerdict;

// "agrees", "explained", "within bounds", "partly explained", "not printed", "not computed",
// "fails"; borrowed.
const char *sb_thesis_verdict_name(SbThesisVerdict verdict);

typedef struct {
  char *label;
  char si[16], shown[16];
  double printed, rounding;        // NaN: nothing printed; half of the last digit's unit
  double thesis, consistent;       // NaN: see the reasons
  char *no_thesis, *no_consistent; // owned, NULL for a number
  double difference;               // thesis (without, consistent) less printed
  double remains;                  // of it behind all steps
  GArray *reasons, *models;        // of SbThesisPart
  SbThesisVerdict verdict;
  char *fault; // why it fails; NULL
} SbThesisRow;

typedef struct {
  char *name, *title; // "table-7.5"
  char *source;       // where the printed values are from; NULL: nothing is printed
  GPtrArray *rows;    // of SbThesisRow *
  GPtrArray *notes;   // of char *
  SbStudy *chart;     // NULL: a table
  size_t fails;
} SbThesisItem;

// Names and titles of all that ship, in the order of the thesis: pairs, owned by the caller. NULL
// where the folder is missing.
char **sb_thesis_items(void);

// Runs that items share, whichever comes first to one computes it.
typedef struct SbThesisRuns SbThesisRuns;
SbThesisRuns *sb_thesis_runs_new(void);
void sb_thesis_runs_free(SbThesisRuns *runs); // takes NULL

// Computes one on `jobs` threads; `runs` may be NULL. NULL with issues, or with none where it was
// cancelled. Owned by the caller.
SbThesisItem *sb_thesis_compute(const char *name, int jobs, SbThesisRuns *runs,
                                bool (*cancelled)(void *data), void *data, GPtrArray *issues);

// The same of a study file anywhere.
SbThesisItem *sb_thesis_compute_file(const char *path, int jobs, SbThesisRuns *runs,
                                     bool (*cancelled)(void *data), void *data, GPtrArray *issues);

// Takes NULL.
void sb_thesis_item_free(SbThesisItem *item);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbThesisItem, sb_thesis_item_free)
