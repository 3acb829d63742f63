// Shared by the studies: a study as data, questions, and functions that respect the capacities of
// SbStudy. Private to engine/valve/studies.
#pragma once

#include "engine/contact/fit.h"
#include "engine/film/film.h"
#include "engine/film/laws.h"
#include "engine/valve/answer/evaluate.h"
#include "engine/valve/model/model.h"
#include "engine/valve/run/cost.h"
#include "engine/valve/studies/study.h"

// Capacities: values of a line at one x, stored answers, points of a law.
enum { SB_STUDY_VALUES = 20, SB_STUDY_ANSWERS = 1024, SB_STUDY_LAW_POINTS = 400 };

// State of a computation (below).
typedef struct SbStudyWork SbStudyWork;

// A study as data; its make() adds what depends on the scene. Quantities are texts with the display
// unit: "central film [nm]".
typedef struct {
  const char *x, *panel[SB_STUDY_PANELS];
  bool x_logarithmic, logarithmic[SB_STUDY_PANELS];
  size_t range;            // offset in SbStudyRange of the lowest x; the highest follows it
  const char *row_heading; // of the table; NULL: none, or make() sets it
  const char *column[SB_STUDY_COLUMNS];
  int digits[SB_STUDY_COLUMNS];                        // 0: three
  int line[SB_STUDY_COLUMNS], value[SB_STUDY_COLUMNS]; // of each column, for sb_study_cells()
  const char *models, *validity;                       // NULL: make() sets it
  // Whether it has the grid of assets/studies/NAME.study. The values of a line are its figures,
  // followed by what derive() (may be NULL) adds. `share`: fraction of the progress for the grid,
  // 0: all.
  bool grid;
  double share;
  bool (*asks_grid)(const SbModel *scene); // NULL: always; false: make() requests single places
  const SbParamId *extra;                  // [extras] columns after those of the file
  size_t extras;
  void (*derive)(double value[SB_STUDY_VALUES], SbStudyWork *work, int line, double x);
  // Returns whether a place of a line has no values, whatever was answered. Earlier lines are known
  // then.
  bool (*is_no_case)(SbStudyWork *work, int line, double x);
  bool forces; // its error includes that of the forces
  // Without a grid: sets the values of a line at x, those of the panels first; they are NaN before.
  void (*solve)(double value[SB_STUDY_VALUES], SbStudyWork *work, int line, double x);
  void (*make)(SbStudyWork *work);
} SbStudyDesign;

// State of a computation. An error that ends the study remains in `status`; all later questions
// give NaN without computation, so that loops need no check.
struct SbStudyWork {
  SbStudy *out;
  const SbStudyDesign *design;
  const SbModel *scene;
  SbModel base;            // for questions: the scene with what the study keeps constant
  const SbStudyGrid *grid; // NULL: none
  double lo, hi;           // ends of the abscissa: the scene's range, or the study's own
  double load;             // net, of films that the study solves at one load [N/m]
  SbEvaluator *evaluator;
  const SbEvaluator *start; // rings of the grid start from its states; NULL: cold start
  SbFilmSolver *solver;     // of films that are solved apart from questions
  SbFilm film;              // the last of them
  SbStudyHooks hooks;
  SbReport *report;
  SbStatus status;
  double spent, total;         // predicted cost of questions so far, and of the study [s]
  double error[2], largest[2]; // of loads [N] and contact widths [m]: largest errors and values
  int line[SB_STUDY_COLUMNS], value[SB_STUDY_COLUMNS]; // of the table's columns
  size_t answers;
  struct {
    int line;
    bool answered; // by the grid
    double x, value[SB_STUDY_VALUES];
  } answer[SB_STUDY_ANSWERS];
};

#define SB_STUDY_DECLARE(code, function, name, title, help)                                        \
  extern const SbStudyDesign sb_study_##function;
SB_STUDY_LIST(SB_STUDY_DECLARE)
#undef SB_STUDY_DECLARE

// Computes value[paths] (SI) of figures of the base with overrides, and reports progress. If a
// solver fails or values are inconsistent, the figures are NaN with a warning; `complete` is
// cleared in the first case. Warnings of models are not copied, because a study leaves their
// validity intentionally. The evaluator has the model and the summary afterwards.
void sb_study_ask(SbStudyWork *work, double *value, const char *const *path, size_t paths,
                  const SbOverride *override, size_t overrides);

// Returns the net load per length of the scene's outer seal at rest under its pressures [N/m]; NaN:
// none.
double sb_study_net_load(SbStudyWork *work);

// Returns value[SB_STUDY_VALUES] of a line at x; the design's solve() is called once for each
// place. Borrowed until the next answer.
const double *sb_study_at(SbStudyWork *work, int line, double x);

// A place that the grid does not have.
typedef struct {
  int line;
  double x;
  // Sets row[columns] of a line that the grid does not have, except what follows from its
  // variables; NULL: a line of the grid.
  void (*fill)(double *row, const SbStudyWork *work, int line, double x);
} SbStudyPlace;

// Computes place[count], if not known, for sb_study_at(). Reports progress from `from` to `to`.
void sb_study_more(SbStudyWork *work, const SbStudyPlace *place, size_t count, double from,
                   double to);

// Returns value[SB_STUDY_VALUES] of a line at x, for the caller to set.
double *sb_study_put(SbStudyWork *work, int line, double x);

// Returns the index of a grid column by its name, which must exist.
int sb_study_grid_column(const SbStudyWork *work, const char *name);

// Returns abscissa `index` of `count` from lo to hi, evenly spaced on its axis.
double sb_study_place(const SbStudyWork *work, int index, int count);

// Adds a curve of a line to every panel: panel p gets the line's value p at `count` abscissas,
// at[count], or evenly spaced ones if `at` is NULL.
void sb_study_curves(SbStudyWork *work, SbStudyStyle style, const char *name, int line,
                     const double *at, int count);

// Sets the film problem of the scene's outer seal without end pressures, at a net load [N/m] and a
// speed [m/s].
void sb_study_film_problem(SbFilmProblem *out, const SbStudyWork *work, double load, double speed);

// Solves a film problem into work->film, starting from the last film, and reports progress.
SbStatus sb_study_film(SbStudyWork *work, const SbFilmProblem *problem, SbReport *report);

// Stores the status of work that is not a question. Returns whether the study continues.
bool sb_study_goes_on(SbStudyWork *work, SbStatus status, const SbReport *report);

// Adds a table row with a formatted name and values NaN, and returns it, borrowed. Does not fail,
// as sb_study_panel().
SbStudyRow *sb_study_row(SbStudy *out, const char *format, ...) SB_PRINTF(2, 3);

// Adds a formatted note. Does not fail, as sb_study_panel().
void sb_study_note(SbStudy *out, const char *format, ...) SB_PRINTF(2, 3);

// Adds a table column; its cells show value number `value` of `line`.
void sb_study_column(SbStudyWork *work, const char *quantity, int digits, int line, int value);

// Computes value[columns] at x, of lines whose number is larger by `shift` than the columns' own.
void sb_study_cells(double *value, SbStudyWork *work, double x, int shift);

// Adds a reference curve with one value over the whole abscissa.
void sb_study_level(SbStudyWork *work, SbStudyPanel *panel, const char *name, double y);

// Adds a mark at x with a formatted text, if x is inside the abscissa.
void sb_study_mark(SbStudyWork *work, double x, const char *format, ...) SB_PRINTF(3, 4);

// Fits H = k U^a W^b to count (3 to SB_STUDY_LAW_POINTS) films by least squares of the logarithms;
// H = h/R. SB_ERROR_RANGE: other counts, or values <= 0; SB_ERROR_MEMORY; SB_ERROR_NOT_CONVERGED.
SbStatus sb_study_fit_law(SbFilmLaw *out, const double *U, const double *W, const double *H,
                          size_t count, SbReport *report);
