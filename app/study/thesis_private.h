// Inside of the thesis' items: what is read, and values of expressions.
#pragma once

#include "app/study/thesis_item.h"

#include "app/base/reader.h"

#include "engine/valve/run/run.h"

// A grid of the study, computed when first asked for.
typedef struct {
  char *name;
  size_t first, samples; // among the study's points
  bool done;
  bool *wanted;       // [samples], those that rows and curves ask for; others have no value
  GArray *figures;    // of int, what expressions name of it
  double *value;      // [samples][figures]
  GHashTable *reason; // sample -> char *, why one failed
  GHashTable *models; // sample -> SbModel *, whose parameters were asked for
} SbThesisGrid;

typedef struct {
  const char *path;
  SbStudyFile *study;
  GPtrArray *entries; // of SbEntry
  SbPrinted *printed; // NULL: none
  double *point;      // [samples][vary]
  GPtrArray *grids;   // of SbThesisGrid *
  SbThesisRuns *runs; // borrowed
  int jobs;
  bool (*cancelled)(void *data);
  void *data;
  bool stopped;
  GPtrArray *issues;
} SbThesisWork;

enum { SB_THESIS_NO_ROW = -1 };

// Where an expression is evaluated.
typedef struct {
  SbThesisWork *work;
  int row;            // printed row, SB_THESIS_NO_ROW
  SbThesisGrid *grid; // NULL: none
  size_t sample;      // of the grid
  double printed, thesis, consistent, ours;
  // Of a run: names are those of a frame, or of a point of a profile.
  const SbFrame *frame;
  const SbContactProfile *profile;
  size_t point;
} SbThesisPlace;

// The value of a frame's or a profile's quantity; false: there is none of the name.
bool sb_thesis_run_value(double *out, const char *name, const SbThesisPlace *at);

// The value of a key in a group, NULL: it has none. Borrowed.
const char *sb_thesis_key(const SbThesisWork *work, const char *group, const char *name);

// Value of "EXPRESSION" at a place; false, told with the group and key, where it has none.
bool sb_thesis_value(double *out, const SbThesisPlace *at, const char *text, const char *group,
                     const char *key);

// The grid of "GRID: EXPRESSION", NULL without; *expression is what is behind it. False, told, for
// an unknown one.
bool sb_thesis_grid(SbThesisGrid **grid, const char **expression, SbThesisWork *work,
                    const char *text, const char *group, const char *key);

// Whether it was cancelled.
bool sb_thesis_stopped(SbThesisWork *work);

// Answers all figures of all grids that expressions of rows and series name.
bool sb_thesis_answer(SbThesisWork *work);

// A text with [COLUMN] replaced by the row's cell. Owned by the caller.
char *sb_thesis_with_cells(const SbThesisPlace *at, const char *text);

// A text with the values of {COLUMN}, {COLUMN:FROM:TO} and {= GRID: EXPRESSION, SI shown} in it.
// Owned by the caller.
char *sb_thesis_filled(const SbThesisPlace *at, const char *text, const char *group,
                       const char *key);

// What is behind "within " and "about " of a step's third part, and which of them it has (NULL: not
// asked).
const char *sb_thesis_bound(bool *within, bool *about, const char *text);

// Marks the samples of a grid that belong to the rows of a group [rows NAME].
void sb_thesis_want(SbThesisWork *work, SbThesisGrid *grid, const char *group);

// The model of a sample; owned by the caller, NULL with an issue.
SbModel *sb_thesis_model(SbThesisWork *work, const SbThesisGrid *grid, size_t sample);

// Whether a printed row is meant by "COLUMN = TEXT; COLUMN != TEXT" (NULL: each is).
bool sb_thesis_is_meant(const SbThesisWork *work, guint row, const char *where);

// The rows of one group, added to the item; the chart.
void sb_thesis_rows(SbThesisItem *item, SbThesisWork *work, const char *group);
void sb_thesis_chart(SbThesisItem *item, SbThesisWork *work);

void sb_thesis_complain(SbThesisWork *work, const char *group, const char *key, const char *format,
                        ...) G_GNUC_PRINTF(4, 5);
