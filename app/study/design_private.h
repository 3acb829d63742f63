// What the design's search (design.c) and its robustness (design_robust.c) share.
#pragma once

#include "app/study/design.h"

#include "app/base/error.h"

enum { SIDES_MAX = 2 * SB_LIMITS_MAX, FIGURES_MAX = SB_LIMITS_MAX + 1 };

// Of a breach, relative to its scale: what a search may end with, by which the bounds are drawn in
// so that a design keeps its limits to the last digit.
#define BREACH_NONE 1e-7

// A side of a limit: c = (bound - figure)/scale or (figure - bound)/scale, at most 0.
typedef struct {
  size_t limit;
  bool upper;
  double bound, scale;
  double shift; // by which the bound is drawn in, SI
  size_t column;
} Side;

typedef struct {
  const SbStudyFile *study;
  size_t n; // [vary]
  SbParamId parameter[SB_VARY_MAX];
  bool fixed[SB_VARY_MAX];
  size_t free, at[SB_VARY_MAX]; // at: place in [vary] of a variable
  size_t figures;               // 0 is the objective
  int figure[FIGURES_MAX];
  size_t sides;
  Side side[SIDES_MAX];
  double sign, scale; // of the objective
  bool (*cancelled)(void *data);
  void *data;
} Problem;

// What one start came to.
typedef struct {
  bool found;   // figures had values at its beginning
  bool stopped; // by its tolerances, not by an error or too many evaluations
  double v[SB_VARY_MAX];
  double objective, breach; // signed so that less is better; the worst side's c
  size_t evaluations;
} Start;

// The present design, where it lies in the bounds, then points of a Sobol sequence.
SbStatus sb_design_lay_starts(Start *start, const Problem *problem, SbReport *report);
// Runs them all; *best becomes the best. SB_ERROR_CANCELLED, _MEMORY.
SbStatus sb_design_run_starts(Start *best, SbDesign *out, const Problem *problem, Start *start,
                              size_t count, int jobs, SbReport *report);
// Writes the best start's values, figures and what is active.
SbStatus sb_design_take_optimum(SbDesign *out, const Problem *problem, const Start *best,
                                SbReport *report);
// Draws the bounds in until the design is as robust as was asked for, and checks it by samples.
SbStatus sb_design_over_tolerances(SbDesign *out, Problem *problem, Start *best, int jobs,
                                   SbReport *report);
