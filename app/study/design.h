// The best design within bounds and limits: NLopt's SLSQP (Kraft 1994) on the figures and their
// gradients, from several starts on threads.
//
// Variables are the free parameters of [vary], each scaled to 0 .. 1 between its bounds
// (logarithmically for loguniform). A start that violates a limit first minimises the worst
// violation; if no start removes it, no feasible design was found. The search is local: it finds
// the best design near each start.
//
// Robust design: each limit is tightened by a multiple of its figure's scatter over the tolerances,
// until the probability that all limits are met is the required one. It is 1 minus the sum of the
// probabilities that each limit is violated, each by its most probable failure (FORM). Samples then
// check it, and correct it once if FORM is inaccurate.
#pragma once

#include "app/study/shares.h"

// The result. Freed by sb_design_release().
typedef struct {
  bool found;     // there is a design; else `value`, `figure`, `error` and `warnings` have no value
  bool feasible;  // it meets all limits
  bool converged; // `optimality` <= 1e-3; if not feasible: the tolerances ended the search
  double *value;  // [vary]: parameters, in the order of study->vary [SI]
  double *figure; // [figures]: in the order of study->figures [SI]
  double *error;  // [figures]: relative errors of `figure`, as sb_figure_error()
  char **reason;  // [figures]: why `figure` has no value at the design (without a design: at the
                  // first start); NULL: it has one
  size_t figures; // number of elements of `figure`
  SbWarnings *warnings; // limits of validity of the figures; NULL: no design
  // min |gradient of the objective + multipliers x gradients of the active limits and bounds|
  // divided by |gradient of the objective|, with multipliers >= 0; 0 at an optimum; NaN: not
  // feasible.
  double optimality;
  bool limit_active[2 * SB_LIMITS_MAX]; // [2 i]: lower side of limit i, [2 i + 1]: upper side
  int bound_active[SB_VARY_MAX];        // [vary]: -1 at the lower bound, 1 at the upper one, else 0
  size_t evaluations;                   // of all starts
  double breach; // largest violation of a limit, relative to the limit or the scene's figure,
                 // whichever is larger (at most 1e-7: feasible)
  size_t starts, starts_feasible; // starts; those that ended with a feasible design
  // Robustness, if there are tolerances and limits:
  bool checked;       // the members below are set
  bool met;           // `holds` is at least the required probability
  double by_form;     // probability that all limits are met, by FORM
  double holds;       // the same by samples
  double interval[2]; // 95 % interval of `holds`
  size_t samples;
} SbDesign;

// Searches the best design of `study`, which must have a group [design], on `jobs` threads.
// `cancelled` (may be NULL) is called from any thread. Returns SB_OK (also if no feasible design
// was found), SB_ERROR_CANCELLED or SB_ERROR_MEMORY. Call sb_design_release() in any case.
SbStatus sb_design_search(SbDesign *out, const SbStudyFile *study, int jobs,
                          bool (*cancelled)(void *data), void *data, SbReport *report);

// Frees what the result owns.
void sb_design_release(SbDesign *design);

// Returns the variables that are at a bound, "gland.radial_space (upper), ..."; NULL: none. This
// and the next function need a design that was found.
char *sb_design_bounds(const SbDesign *design, const SbStudyFile *study);

// Returns the distance of a figure from the nearer end of limit number `limit` of study->limits
// [SI of the figure], negative if the limit is violated; NaN: the figure has no value.
double sb_design_margin(const SbDesign *design, const SbStudyFile *study, size_t limit);
