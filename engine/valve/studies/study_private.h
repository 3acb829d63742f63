// What the studies share: what a study is as data, whom they ask, and building blocks that stay
// inside the bounds of SbStudy.
#pragma once

#include "engine/contact/fit.h"
#include "engine/film/film.h"
#include "engine/film/laws.h"
#include "engine/valve/answer/evaluate.h"
#include "engine/valve/model/model.h"
#include "engine/valve/run/cost.h"
#include "engine/valve/studies/study.h"

enum { SB_STUDY_VALUES = 20, SB_STUDY_ANSWERS = 1024, SB_STUDY_LAW_POINTS = 400 };

typedef struct SbStudyWork SbStudyWork;

// How many solves a study takes, for its predicted time (cost.h).
typedef struct {
  int rings, discs; // fitments
  int fits, films;  // by the scene's own models
  int reynolds;     // films on the half-plane
  int cycles;       // quasi-static
  int runs;         // of the scene as it is
  int speeds;       // films of its states at other speeds
} SbStudySolves;

// A study as data. What depends on the scene its make() adds. Quantities are texts with the unit
// that people read: "central film [nm]".
typedef struct {
  const char *x, *panel[SB_STUDY_PANELS];
  bool x_logarithmic, logarithmic[SB_STUDY_PANELS];
  size_t range;            // place in SbStudyRange of the least x; the largest stands behind it
  const char *row_heading; // of the table; NULL: there is none, or make() gives it
  const char *column[SB_STUDY_COLUMNS];
  int digits[SB_STUDY_COLUMNS];                        // 0: three
  int line[SB_STUDY_COLUMNS], value[SB_STUDY_COLUMNS]; // of each column, for sb_study_cells()
  const char *models, *validity;                       // NULL: make() gives it
  // A view of the grid of assets/studies/NAME.study: a line's values are its figures, then what
  // derive() (may be NULL) adds to them. `share`: of the progress that the grid is, 0: all.
  bool grid;
  double share;
  bool (*asks_grid)(const SbModel *scene); // NULL: always; else make() asks for what it wants
  const SbParamId *extra;                  // [extras]: columns behind the file's
  size_t extras;
  void (*derive)(double value[SB_STUDY_VALUES], SbStudyWork *work, int line, double x);
  // Whether a place of a line is left without values, whatever was answered. Lines before it are
  // there.
  bool (*is_no_case)(SbStudyWork *work, int line, double x);
  bool forces; // its error is that of the forces, too
  SbStudySolves solves;
  // Without a grid: values of one line of the study at x, those of the panels first; NaN until it
  // sets them.
  void (*solve)(double value[SB_STUDY_VALUES], SbStudyWork *work, int line, double x);
  void (*make)(SbStudyWork *work);
} SbStudyDesign;

// A study at work. A failure that ends it stays in `status`: whoever asks on gets NaN at no cost,
// so that loops need not look.
struct SbStudyWork {
  SbStudy *out;
  const SbStudyDesign *design;
  const SbModel *scene;
  SbModel base;            // what is asked: the scene, but for what the study holds
  const SbStudyGrid *grid; // NULL: it has none
  double lo, hi;           // ends of the abscissa: the scene's range, or the study's own
  double load;             // net, of films that the study solves at one load [N/m]
  SbEvaluator *evaluator;
  const SbEvaluator *start; // from whose rings those of the grid start; NULL: cold
  SbFilmSolver *solver;     // of the films that are solved beside questions
  SbFilm film;              // the last of them
  SbStudyHooks hooks;
  SbReport *report;
  SbStatus status;
  double spent, total;         // [s] what questions have cost, and what the study will
  double error[2], largest[2]; // of loads [N] and contact widths [m]: largest errors and values
  int line[SB_STUDY_COLUMNS], value[SB_STUDY_COLUMNS]; // of the table's columns
  size_t answers;
  struct {
    int line;
    bool answered;                    // by the grid
    double x, value[SB_STUDY_VALUES]; // of it there
  } answer[SB_STUDY_ANSWERS];
};

#define SB_STUDY_DECLARE(code, function, name, title, help)                                        \
  extern const SbStudyDesign sb_study_##function;
SB_STUDY_LIST(SB_STUDY_DECLARE)
#undef SB_STUDY_DECLARE

// Asks for figures of the base with overrides and tells the progress. Where a solver gives up or
// the values do not go together what it would have given is NaN, with a warning, and `complete` is
// cleared in the first case. Warnings of models are not merged: a study runs outside validity on
// purpose and says where. The evaluator has the model and the summary.
void sb_study_ask(SbStudyWork *work, double *value, const char *const *path, size_t paths,
                  const SbOverride *override, size_t overrides);

// Net load per length of the scene's outer seal at rest under its pressures [N/m]; NaN: none.
double sb_study_net_load(SbStudyWork *work);

// Values of a line at x by the design's solve(), which is called once for each place.
const double *sb_study_at(SbStudyWork *work, int line, double x);

// A place that the grid has not: of one of its lines, or of another one whose row fill() lays out
// by columns, what follows from its variables aside.
typedef struct {
  int line;
  double x;
  void (*fill)(double *row, const SbStudyWork *work, int line,
               double x); // NULL: a line of the grid
} SbStudyPlace;

// Has places answered that the study does not know yet, for sb_study_at() to find. Tells the
// progress from `from` to `to`.
void sb_study_more(SbStudyWork *work, const SbStudyPlace *place, size_t count, double from,
                   double to);

// Values of a line at x that a view sets itself.
double *sb_study_put(SbStudyWork *work, int line, double x);

// A column of the grid by its name.
int sb_study_grid_column(const SbStudyWork *work, const char *name);

// Place `index` of `count` from lo to hi, even on the abscissa.
double sb_study_place(const SbStudyWork *work, int index, int count);

// Curves of a line in every panel, one of which shows each of its first values, at `count` places:
// at[], or evenly over the abscissa if that is NULL.
void sb_study_curves(SbStudyWork *work, SbStudyStyle style, const char *name, int line,
                     const double *at, int count);

// A film of the scene's outer seal without end pressures, whatever is fixed; the problem is the
// caller's to change, then to solve into work->film, warm from the last one, with the progress
// told.
void sb_study_film_problem(SbFilmProblem *out, const SbStudyWork *work, double load, double speed);
SbStatus sb_study_film(SbStudyWork *work, const SbFilmProblem *problem, SbReport *report);

// Passes on how the work on something else than a question ended; true: well.
bool sb_study_goes_on(SbStudyWork *work, SbStatus status, const SbReport *report);

// Adds a table's row (all values NaN), a note; borrowed from `out`. They never fail, like
// those of study.h.
SbStudyRow *sb_study_row(SbStudy *out, const char *format, ...) SB_PRINTF(2, 3);
void sb_study_note(SbStudy *out, const char *format, ...) SB_PRINTF(2, 3);

// Adds a column of the table with the value of a line that stands in its cells.
void sb_study_column(SbStudyWork *work, const char *quantity, int digits, int line, int value);

// Values of all columns at x, of lines `shift` behind the columns' own.
void sb_study_cells(double *value, SbStudyWork *work, double x, int shift);

// A reference of one value over the whole abscissa.
void sb_study_level(SbStudyWork *work, SbStudyPanel *panel, const char *name, double y);

// Marks a value of the scene, if the abscissa has it.
void sb_study_mark(SbStudyWork *work, double x, const char *format, ...) SB_PRINTF(3, 4);

// Fits the law to films H = h/R, all > 0, 3 to SB_STUDY_LAW_POINTS of them, by least squares of the
// logarithms. SB_ERROR_RANGE otherwise, SB_ERROR_MEMORY.
SbStatus sb_study_fit_law(SbFilmLaw *out, const double *U, const double *W, const double *H,
                          size_t count, SbReport *report);
