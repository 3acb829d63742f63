// The best design within bounds and limits: NLopt's SLSQP (Kraft 1994) on the figures and their
// gradients, from several starts on threads.
//
// Variables are the free parameters of [vary], each from 0 to 1 between its bounds (in the
// logarithm for loguniform). A start that breaks a limit first lessens the worst breach; where no
// start gets rid of it, nothing feasible was found. A search follows slopes: it finds the best near
// each start, and says nothing of what lies elsewhere.
//
// Robust: each limit is drawn in by a multiple of its figure's scatter over the tolerances, until
// the probability that all limits hold, by the most probable failure of each side (FORM, at least
// the sum of their probabilities), is what was asked for; then samples check it, and correct it
// once where FORM is off.
#pragma once

#include "app/study/shares.h"

typedef struct {
  bool found, feasible, converged;
  double *value;        // [vary], SI
  double *figure;       // [study's figures]
  SbWarnings *warnings; // of validity, of the design's figures; NULL without a design
  double optimality; // least |gradient of the objective + multipliers x those of what is active|,
                     // of the objective's own; multipliers at least 0
  bool limit_active[2 * SB_LIMITS_MAX]; // lower side, upper side of each limit
  int bound_active[SB_VARY_MAX];        // -1 at its lower end, 1 at its upper one
  size_t evaluations;
  double breach; // as of a start
  size_t starts, starts_feasible;
  // Over the tolerances, where there are any and limits.
  bool checked, met;         // met: `holds` is at least the probability that was requested
  double by_form;            // probability that all limits hold, by FORM
  double holds, interval[2]; // by samples
  size_t samples;
} SbDesign;

// Searches; *out is to be released in any case. `cancelled` is called from any thread.
// SB_ERROR_CANCELLED, _MEMORY.
SbStatus sb_design_search(SbDesign *out, const SbStudyFile *study, int jobs,
                          bool (*cancelled)(void *data), void *data, SbReport *report);
void sb_design_release(SbDesign *design);

// The variables that are at an end of their bounds, "gland.radial_space (upper), ..."; NULL without
// any. Owned by the caller: g_free().
char *sb_design_bounds(const SbDesign *design, const SbStudyFile *study);

// How far a figure is within its limit, negative beyond it; NaN: no value.
double sb_design_margin(const SbDesign *design, const SbStudyFile *study, size_t limit);
