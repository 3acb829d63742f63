// Shared by the search for a design (design.c) and its robustness (design_robust.c).
#pragma once

#include "app/study/design.h"

#include "app/base/error.h"

// Largest numbers of sides of limits, and of figures (the objective and those of the limits).
enum { SIDES_MAX = 2 * SB_LIMITS_MAX, FIGURES_MAX = SB_LIMITS_MAX + 1 };

// Relative violation with which a search may end. Limits are tightened by it, so that a design
// meets them to the last digit.
#define BREACH_NONE 1e-7

// One side of a limit, as the constraint c <= 0. Upper side: c = (figure - bound + shift)/scale;
// lower side: c = (bound - figure + shift)/scale; BREACH_NONE is added to both.
typedef struct {
  size_t limit;  // index in study->limits
  bool upper;    // the upper side
  double bound;  // [SI]
  double scale;  // [SI], positive
  double shift;  // by which the bound is tightened [SI]
  size_t column; // of its figure
} Side;

// The problem of a search.
typedef struct {
  const SbStudyFile *study;         // borrowed
  size_t n;                         // number of parameters [vary]
  SbParamId parameter[SB_VARY_MAX]; // [n]
  bool fixed[SB_VARY_MAX];          // [n]: has one value, is not a variable
  size_t free;                      // number of variables
  size_t at[SB_VARY_MAX];           // [free]: index in [vary] of a variable
  size_t figures;                   // columns; column 0 is the objective
  int figure[FIGURES_MAX];          // [figures]: indices of sb_figure()
  size_t sides;
  Side side[SIDES_MAX];
  double sign, scale;            // minimised is sign * objective / scale; sign is 1 or -1
  bool (*cancelled)(void *data); // from any thread; NULL: never
  void *data;
} Problem;

// One start of a search and its result.
typedef struct {
  bool found;            // the figures have values at its beginning
  bool stopped;          // ended by its tolerances, not by an error or too many evaluations
  double v[SB_VARY_MAX]; // [free]: variables, 0 to 1 between the bounds
  double objective;      // as it is minimised
  double breach;         // largest c of all sides
  size_t evaluations;
} Start;

// Sets `v` of start[study->design.starts], whose other members are 0: the present design if it is
// within the bounds, then points of a Sobol sequence (random ones if it has too few dimensions).
SbStatus sb_design_make_starts(Start *start, const Problem *problem, SbReport *report);

// Searches from start[count] on `jobs` threads; each start becomes its result. *best becomes the
// best of them, or without a `found` one the first. Adds to out->evaluations and, if `count` is
// out->starts (set by the caller), sets out->starts_feasible. Returns SB_OK, SB_ERROR_CANCELLED or
// SB_ERROR_MEMORY.
SbStatus sb_design_run_starts(Start *best, SbDesign *out, const Problem *problem, Start *start,
                              size_t count, int jobs, SbReport *report);

// Writes parameters, figures with errors and warnings, active limits and bounds and the optimality
// of *best to *out, whose `value`, `figure`, `error` and `reason` (zeros at first) the caller
// has allocated.
SbStatus sb_design_take_optimum(SbDesign *out, const Problem *problem, const Start *best,
                                SbReport *report);

// Tightens the limits until the design is as robust as required, and checks it by samples. *best
// and *out are a feasible design and become the robust one. The study has tolerances and limits.
SbStatus sb_design_over_tolerances(SbDesign *out, Problem *problem, Start *best, int jobs,
                                   SbReport *report);
