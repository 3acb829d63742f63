// State of computing an item of the thesis, shared by the files thesis_*.c. "Reports an issue"
// means: appends it to work->issues, with the group and key that are passed.
#pragma once

#include "app/study/thesis_item.h"

#include "app/base/reader.h"

#include "engine/valve/run/run.h"

// A grid of the study, computed when it is first needed.
typedef struct {
  char *name;
  size_t first, samples; // its samples are first to first + samples - 1 of the study's points
  bool done;             // the members below are computed
  bool *wanted;          // [samples]: requested by rows or curves, else no values; NULL: none
  GArray *figures;       // of int: indices of sb_figure() that expressions use
  double *value;         // [samples][figures] [SI]
  GHashTable *reason;    // sample -> char *: why one failed
  GHashTable *models;    // sample -> SbModel *, created when parameters are requested
} SbThesisGrid;

// The item that is being computed.
typedef struct {
  const char *path; // of the study file
  SbStudyFile *study;
  GPtrArray *entries;            // of SbEntry: lines of the file
  SbPrinted *printed;            // NULL: nothing is printed
  double *point;                 // [samples][vary] [SI]
  GPtrArray *grids;              // of SbThesisGrid *
  SbThesisRuns *runs;            // borrowed
  int jobs;                      // threads
  bool (*cancelled)(void *data); // from any thread; NULL: never
  void *data;
  bool stopped;      // it was cancelled
  GPtrArray *issues; // of SbIssue
} SbThesisWork;

// SbThesisPlace.row without a printed row.
enum { SB_THESIS_NO_ROW = -1 };

// Where an expression is evaluated: the values of names.
typedef struct {
  SbThesisWork *work;
  int row;                                  // printed row, from 0, or SB_THESIS_NO_ROW
  SbThesisGrid *grid;                       // NULL: none
  size_t sample;                            // of the grid, from 0
  double printed, thesis, consistent, ours; // [SI]; NaN: not known
  // For curves over a run; NULL: none.
  const SbFrame *frame;
  const SbContactProfile *profile;
  size_t point; // of the profile
} SbThesisPlace;

// Writes the quantity `name` of the frame or profile point at a place [SI]. Returns false if there
// is no such name.
bool sb_thesis_run_value(double *out, const char *name, const SbThesisPlace *at);

// Returns the value of key `name` in `group`; NULL: absent.
const char *sb_thesis_key(const SbThesisWork *work, const char *group, const char *name);

// Writes the value of the expression `text` at a place [SI]; NaN if it is not finite, because a
// name in it has no value. Returns false and reports an issue if the expression is faulty.
bool sb_thesis_value(double *out, const SbThesisPlace *at, const char *text, const char *group,
                     const char *key);

// Splits "GRID: EXPRESSION": *grid is the grid (NULL: `text` names none), *expression the part of
// `text` after it. Returns false and reports an issue if the grid does not exist.
bool sb_thesis_grid(SbThesisGrid **grid, const char **expression, SbThesisWork *work,
                    const char *text, const char *group, const char *key);

// Returns whether the computation was cancelled; calls `cancelled`.
bool sb_thesis_stopped(SbThesisWork *work);

// Returns `text` with the first [COLUMN] replaced by the text of the row's cell (of row 0 if there
// is no row).
char *sb_thesis_with_cells(const SbThesisPlace *at, const char *text);

// Returns `text` with each {COLUMN}, {COLUMN:FROM:TO} and {= GRID: EXPRESSION, SI DISPLAY} replaced
// by its value, "?" for none.
char *sb_thesis_filled(const SbThesisPlace *at, const char *text, const char *group,
                       const char *key);

// Returns the third part of a step without a leading "within " or "about ", and writes whether it
// had them (both may be NULL). Borrowed from `text`.
const char *sb_thesis_bound(bool *within, bool *about, const char *text);

// Marks the samples of a grid that belong to the rows of a group [rows NAME] in grid->wanted, which
// the caller has allocated.
void sb_thesis_want(SbThesisWork *work, SbThesisGrid *grid, const char *group);

// Computes the figures of all samples that expressions and rows require. Returns false with an
// issue, or if the work was stopped.
bool sb_thesis_answer_grids(SbThesisWork *work);

// Returns the model of a sample, freed by sb_model_destroy(); NULL with an issue.
SbModel *sb_thesis_model(SbThesisWork *work, const SbThesisGrid *grid, size_t sample);

// Returns whether a printed row satisfies "COLUMN = TEXT; COLUMN != TEXT" (NULL: every row does).
bool sb_thesis_is_meant(const SbThesisWork *work, guint row, const char *where);

// Computes the rows of a group [rows NAME], after sb_thesis_answer_grids(), and appends them to the
// item.
void sb_thesis_rows(SbThesisItem *item, SbThesisWork *work, const char *group);

// Computes the chart of the item, after sb_thesis_answer_grids().
void sb_thesis_chart(SbThesisItem *item, SbThesisWork *work);

// Reports an issue on a key of a group, with a formatted sentence.
void sb_thesis_add_issue(SbThesisWork *work, const char *group, const char *key, const char *format,
                         ...) G_GNUC_PRINTF(4, 5);
