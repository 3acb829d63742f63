// Shared by the studies (study_*.c).
//
// sb_study_view() creates an SbStudyWork, adds axes, panels and columns of the SbStudyDesign to the
// result, computes the grid's rows if there is a grid, and calls design->make(), which adds curves,
// rows, marks and notes. Values are stored by place: a line (a curve's number, >= 0, or any other
// number that the study chooses) and an abscissa x; sb_study_at() reads them. Without a grid
// design->solve() computes a place when it is first read.
//
// All solver steps count against SbStudyWork.budget; beyond it every question and film fails with
// SB_ERROR_NOT_CONVERGED at its first step, and leaves a gap.
#pragma once

#include "engine/base/label.h"
#include "engine/contact/fit.h"
#include "engine/film/film.h"
#include "engine/film/laws.h"
#include "engine/valve/answer/evaluate.h"
#include "engine/valve/model/model.h"
#include "engine/valve/run/cost.h"
#include "engine/valve/run/run_work.h"
#include "engine/valve/run/study_cost.h"
#include "engine/valve/studies/study.h"

// Capacities: values of one place, stored places, points of a law.
enum { SB_STUDY_VALUES = 20, SB_STUDY_ANSWERS = 1024, SB_STUDY_LAW_POINTS = 400 };

// State of a computation (below).
typedef struct SbStudyWork SbStudyWork;

// A study as data; its make() adds what depends on the scene. Quantities are texts with the display
// unit: "central film [nm]".
typedef struct {
  const char *x, *panel[SB_STUDY_PANELS]; // quantities of the abscissa and the ordinates; NULL: end
  bool x_logarithmic, logarithmic[SB_STUDY_PANELS]; // scales of the axes
  size_t range;            // offset in SbStudyRange of the lowest x; the highest is the next member
  const char *row_heading; // of the table; NULL: none, or make() sets it
  const char *column[SB_STUDY_COLUMNS];                // quantities of the columns; NULL: end
  int digits[SB_STUDY_COLUMNS];                        // significant digits; 0: three
  bool difference[SB_STUDY_COLUMNS];                   // SbStudyColumn.difference
  int line[SB_STUDY_COLUMNS], value[SB_STUDY_COLUMNS]; // cells show this value of this line
  const char *models, *validity;                       // as in SbStudy; NULL: make() sets them
  bool grid;    // it has the grid of assets/studies/NAME.study (SbStudyGrid)
  double share; // fraction of the progress for the grid's samples; 0: all
  // Returns whether all samples of the grid are computed before make(). NULL: always. If false
  // make() requests places by sb_study_more().
  bool (*asks_grid)(const SbModel *scene);
  const SbParamId *extra; // [extras] result of sb_study_extra()
  size_t extras;
  // With a grid: value[] has the figures of the place, in the grid's order; the function adds
  // further values after them, or changes them. NULL: nothing to do.
  void (*derive)(double value[SB_STUDY_VALUES], SbStudyWork *work, int line, double x);
  // With a grid: returns true if the place has no values (they become NaN) in spite of its figures.
  // Values of lines before it can be read. NULL: never.
  bool (*is_no_case)(SbStudyWork *work, int line, double x);
  // With a grid: returns whether make() interpolates over a place of this line that has no values,
  // with an error estimate; a solver that does not converge there leaves no gap. NULL: never.
  bool (*is_bridged)(const SbStudyWork *work, int line);
  bool forces; // SbStudy.error includes that of the forces
  // Without a grid: sets the values of a place, which are NaN before; value p is that of panel p.
  void (*solve)(double value[SB_STUDY_VALUES], SbStudyWork *work, int line, double x);
  void (*make)(SbStudyWork *work); // adds all that depends on the scene to work->out
} SbStudyDesign;

// State of a computation. An error that ends the study remains in `status`; all later questions
// give NaN without computation, so that loops need no check.
struct SbStudyWork {
  SbStudy *out; // the result
  const SbStudyDesign *design;
  const SbModel *scene; // the caller's model
  SbModel base; // base model of questions: SbStudyGrid.base, or SB_HOLD_MACHINE of the scene
  const SbStudyGrid *grid;     // NULL: none
  double lo, hi;               // ends of the abscissa: the scene's range, or the study's own
  double load;                 // net load of films that the study solves at one load [N/m]
  SbEvaluator *evaluator;      // of sb_study_ask()
  SbFilmSolver *solver;        // of sb_study_film()
  SbFilm film;                 // last result of sb_study_film()
  SbStudyHooks hooks;          // {0} if the caller has none
  SbWork budget;               // of all questions and films: output.work_limit of the scene
  SbReport *report;            // the caller's, or one of sb_study_view(); never NULL
  SbStatus status;             // SB_OK, or the error that ends the study
  double spent, total;         // predicted cost of questions so far, and of the study [s]
  double error[2], largest[2]; // largest error and largest value of loads [N] and widths [m]
  double bridged_at;     // abscissa of the first place of which is_bridged() where a solver failed
  char bridged[SB_TEXT]; // why; empty: none
  int line[SB_STUDY_COLUMNS], value[SB_STUDY_COLUMNS]; // of the columns, as in SbStudyDesign
  size_t answers;                                      // number of stored places
  struct {
    int line;
    bool answered; // the grid has computed this place
    double x, value[SB_STUDY_VALUES];
  } answer[SB_STUDY_ANSWERS];
};

#define SB_STUDY_DECLARE(code, function, name, title, help)                                        \
  extern const SbStudyDesign sb_study_##function;
SB_STUDY_LIST(SB_STUDY_DECLARE)
#undef SB_STUDY_DECLARE

// Computes value[paths] (SI), at most eight figures with the given paths, of work->base with
// override[overrides], and reports progress. If a solver fails or the values are inconsistent, the
// figures are NaN, with a warning in work->out; SbStudy.complete becomes false if a solver failed.
// Warnings of models are not copied, because a study leaves their validity intentionally.
// Afterwards work->evaluator has model and summary of the question.
void sb_study_ask(SbStudyWork *work, double *value, const char *const *path, size_t paths,
                  const SbOverride *override, size_t overrides);

// Notes that a solver failed at abscissa x (NaN: at none in particular), and why, a sentence: the
// study is not complete.
void sb_study_gap(SbStudy *out, double x, const char *why);

// Warns that points have no value: "HEAD: WHY". The code of the warning is "study-gap-WHAT";
// `input` is the number of the input at fault (SbReport.input), 0: none.
void sb_study_miss(SbStudy *out, const char *what, int input, const char *head, const char *why);

// Returns the net load per length of the outer seal of work->base without friction, under its
// pressures [N/m]; NaN if it was not computed.
double sb_study_net_load(SbStudyWork *work);

// Returns value[SB_STUDY_VALUES] of a place. Without a grid design->solve() computes a new place;
// with a grid a place that was not computed has NaN. Borrowed until the next place is stored.
const double *sb_study_at(SbStudyWork *work, int line, double x);

// A place that the grid does not have.
typedef struct {
  int line;
  double x;
  // For a line that the grid does not have: sets elements of row[columns], all NaN before (as in
  // the base), except those that follow from variables. NULL: a line of the grid.
  void (*fill)(double *row, const SbStudyWork *work, int line, double x);
} SbStudyPlace;

// Computes place[count], those that are not stored, by the grid's answer(), for sb_study_at().
// Reports progress from the fraction `from` to `to`.
void sb_study_more(SbStudyWork *work, const SbStudyPlace *place, size_t count, double from,
                   double to);

// Returns value[SB_STUDY_VALUES] of a place, new ones NaN, for the caller to set. Borrowed until
// the next place is stored.
double *sb_study_put(SbStudyWork *work, int line, double x);

// Returns the index of the grid's column with this name, which must exist (asserted).
int sb_study_grid_column(const SbStudyWork *work, const char *name);

// Returns abscissa `index` (from 0) of `count` from work->lo to work->hi, evenly spaced on the
// axis, linear or logarithmic.
double sb_study_place(const SbStudyWork *work, int index, int count);

// Adds a curve of a line to every panel: panel p gets the line's value p at `count` abscissas,
// at[count], or evenly spaced ones if `at` is NULL.
void sb_study_curves(SbStudyWork *work, SbStudyStyle style, const char *name, int line,
                     const double *at, int count);

// Sets the film problem of the scene's outer seal without end pressures, at a net load [N/m] and a
// speed [m/s].
void sb_study_film_problem(SbFilmProblem *out, SbStudyWork *work, double load, double speed);

// Solves a film problem into work->film, starting from the last film, and reports progress. Returns
// the status of sb_film_solve(), SB_ERROR_NOT_CONVERGED if the budget is exhausted, or work->status
// if the study has ended.
SbStatus sb_study_film(SbStudyWork *work, const SbFilmProblem *problem, SbReport *report);

// Computes the grid's rows value[rows][columns], stores their figures at the places line[rows],
// x[rows], and reports progress from the fraction `from` to `to`.
void sb_study_answer_rows(SbStudyWork *work, const double *value, const int *line, const double *x,
                          size_t rows, double from, double to);

// Reports progress, `fraction` 0 to 1, and ends the study if it is cancelled.
void sb_study_step(SbStudyWork *work, double fraction);

// Stores `status` and `report` (NULL only if the status is SB_ERROR_CANCELLED) of work other than
// sb_study_ask(), if it is the first error. Returns whether the study continues: work->status is
// SB_OK.
bool sb_study_goes_on(SbStudyWork *work, SbStatus status, const SbReport *report);

// Adds a table row with a formatted name and values NaN, and returns it, borrowed. Does not fail,
// as sb_study_panel().
SbStudyRow *sb_study_row(SbStudy *out, const char *format, ...) SB_PRINTF(2, 3);

// Adds a formatted note. Does not fail, as sb_study_panel().
void sb_study_note(SbStudy *out, const char *format, ...) SB_PRINTF(2, 3);

// Adds a table column; `quantity` is its name with the display unit, "load [N]", `digits` the
// significant digits (0: three). Its cells show value number `value` of `line`.
void sb_study_column(SbStudyWork *work, const char *quantity, int digits, int line, int value);

// Computes the cells value[columns] of a table row at `x`. `shift` is added to the line of each
// column.
void sb_study_cells(double *value, SbStudyWork *work, double x, int shift);

// Adds a reference curve with the constant value `y` (SI) from work->lo to work->hi.
void sb_study_level(SbStudyWork *work, SbStudyPanel *panel, const char *name, double y);

// Adds a mark at x with a formatted text, if x is inside the abscissa.
void sb_study_mark(SbStudyWork *work, double x, const char *format, ...) SB_PRINTF(3, 4);

// Fits H = k U^a W^b to count (3 to SB_STUDY_LAW_POINTS) films by least squares of the logarithms;
// H = h/R. SB_ERROR_RANGE: other counts, or values <= 0; SB_ERROR_MEMORY; SB_ERROR_NOT_CONVERGED.
SbStatus sb_study_fit_law(SbFilmLaw *out, const double *U, const double *W, const double *H,
                          size_t count, SbReport *report);
