// What the studies share: what a study is as data, whom they ask, and building blocks that stay
// inside the bounds of SbStudy.
#pragma once

#include "engine/contact/fit.h"
#include "engine/film/film.h"
#include "engine/film/laws.h"
#include "engine/valve/cost.h"
#include "engine/valve/evaluate.h"
#include "engine/valve/model.h"
#include "engine/valve/studies/study.h"

enum { SB_STUDY_VALUES = 8, SB_STUDY_ANSWERS = 512, SB_STUDY_LAW_POINTS = 400 };

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
  // Beside the cycle of the test machine, quasi-static, whatever drives the scene, all questions
  // have fixed: the outer ring as the scene's storage left it, from now on without any, the inner
  // one like it, so that no gland suits but one of them, and the chamber filled.
  bool outer;
  bool smooth; // a film in closed form that leaves the fitment its own tolerance
  SbStudySolves solves;
  // Values of one line of the study (a model, a seal, a size) at x, those of the panels first; NaN
  // until it sets them.
  void (*solve)(double value[SB_STUDY_VALUES], SbStudyWork *work, int line, double x);
  void (*make)(SbStudyWork *work);
} SbStudyDesign;

// A study at work. A failure that ends it stays in `status`: whoever asks on gets NaN at no cost,
// so that loops need not look.
struct SbStudyWork {
  SbStudy *out;
  const SbStudyDesign *design;
  const SbModel *scene;
  SbModel base;  // what is asked: the scene, but for what the study holds fixed
  double lo, hi; // ends of the abscissa: the scene's range, or the study's own
  double load;   // net, of films that the study solves at one load [N/m]
  SbEvaluator *evaluator;
  SbEvaluator *start;   // from whose rings those of the others start, owned; NULL: cold
  bool keeps;           // what is asked goes there
  SbFilmSolver *solver; // of the films that are solved beside questions
  SbFilm film;          // the last of them
  SbStudyHooks hooks;
  SbReport *report;
  SbStatus status;
  double spent, total;         // [s] what questions have cost, and what the study will
  double error[2], largest[2]; // of loads [N] and contact widths [m]: largest errors and values
  int line[SB_STUDY_COLUMNS], value[SB_STUDY_COLUMNS]; // of the table's columns
  size_t answers;
  struct {
    int line;
    double x, value[SB_STUDY_VALUES]; // of it there
  } answer[SB_STUDY_ANSWERS];
};

#define SB_STUDY_DECLARE(code, function, name, title, help)                                        \
  extern const SbStudyDesign sb_study_##function;
SB_STUDY_LIST(SB_STUDY_DECLARE)
#undef SB_STUDY_DECLARE

// Values that give the outer ring a squeeze: the bore moves and the groove floor stays, D = D_floor
// + 2 g with g = d (1 - s), so that the stretch on the floor stays as it is. The stem's land keeps
// its share of the gap. For a study of the outer ring.
enum { SB_STUDY_SQUEEZED = 3 };
void sb_study_squeezed(SbOverride out[SB_STUDY_SQUEEZED], const SbStudyWork *work, double squeeze);

// Asks for figures of the base with overrides and tells the progress. Where a solver gives up or
// the values do not go together what it would have given is NaN, with a warning, and `complete` is
// cleared in the first case. Warnings of models are not merged: a study runs outside validity on
// purpose and says where. The evaluator has the model and the summary.
void sb_study_ask(SbStudyWork *work, double *value, const char *const *path, size_t paths,
                  const SbOverride *override, size_t overrides);

// The outer seal's load [N], peak pressure [Pa] and contact width [m] by overrides of the base,
// without friction: as fitted, whatever drags it in the scene.
enum { SB_STUDY_CONTACT = 3 };
void sb_study_contact(double value[SB_STUDY_CONTACT], SbStudyWork *work, const SbOverride *override,
                      size_t overrides);

// Net load per length of the scene's outer seal at rest under its pressures [N/m]; NaN: none.
double sb_study_net_load(SbStudyWork *work);

// Values of a line at x by the design's solve(), which is called once for each place.
const double *sb_study_at(SbStudyWork *work, int line, double x);

// Places of lines solved side by side, for sb_study_at() to find; what comes out does not depend on
// how many threads there are. Tells the progress from `from` to `to`. For a solve() that asks
// questions alone, without the study's film solver.
typedef struct {
  int line;
  double x;
} SbStudyPlace;

void sb_study_solve(SbStudyWork *work, const SbStudyPlace *place, size_t count, double from,
                    double to);

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
