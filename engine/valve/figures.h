// Figures of a run by their paths, the reasons of those that were not computed, limits on them and
// the verdict. A figure is NaN until something computes it; then it needs no reason.
#pragma once

#include "engine/valve/run/run.h"

typedef enum { SB_BETTER_NONE, SB_BETTER_LESS, SB_BETTER_MORE } SbBetter;

// What the error of a figure follows from (run/run_errors.c).
typedef enum {
  SB_BY_INPUT,       // inputs and closed forms of them: 0
  SB_BY_RESIDUAL,    // an error estimate or a residual: it has no error of its own
  SB_BY_MOTION,      // the motion with other states, and with other steps
  SB_BY_NET_LEAK,    // what the films carry out and back, a difference
  SB_BY_LOAD,        // a seal's state from here to SB_BY_TURN: the fit
  SB_BY_MEAN,        // net load over width
  SB_BY_PEAK,        // largest pressure
  SB_BY_WIDTH,       // contact width
  SB_BY_EDGE,        // end of a contact, from the section's centre
  SB_BY_FILM_LEAST,  // least film
  SB_BY_FILM,        // central film, and what is in proportion to it
  SB_BY_FILM_LAW,    // a power law of the load
  SB_BY_FILM_SOLVED, // a film solved for comparison
  SB_BY_AREA,        // real area while sliding
  SB_BY_REST_AREA,   // real area at rest
  SB_BY_SHARE,       // the asperities' share of the load
  SB_BY_BOUNDARY,    // friction of the asperities
  SB_BY_VISCOUS,     // friction of the film
  SB_BY_FRICTION,    // both
  SB_BY_STATIC,      // friction at stage B
  SB_BY_COEFFICIENT, // friction over load
  SB_BY_SQUEEZE_OUT, // time of the squeeze-out
  SB_BY_LEAK,        // flow through the channels at rest
  SB_BY_SLOPE,       // logarithmic derivative of that flow
  SB_BY_SPEED,       // speed of sliding
  SB_BY_TURN,        // turn of the section
  SB_BY_FILLED,      // times of stages C and F
  SB_BY_KEPT,        // time for which the vent is open
  SB_BY_DOSE,        // both
  SB_BY_PRIME,       // leak at rest of the outer seal
  SB_BY_SAMPLES,     // the rig's sampling
  SB_BY_LIFE_PEAK,   // actuations of a life: forces of the cycle's errors
  SB_BY_LIFE_BREAKAWAY,
  SB_BY_LIFE_RETURN,
  SB_BY_LIFE_FILM, // and films
  SB_BY_LIFE_NET,
  SB_BY_PERMEATION,     // the solved ring's permeation
  SB_BY_CHANNELS,       // flow along the contact at rest
  SB_BY_LOSS,           // both
  SB_BY_MASS_LEFT,      // what they leave
  SB_BY_DOSES_LEFT,     // in whole doses
  SB_BY_SHELF_PRESSURE, // mean pressure at rest
} SbErrorSource;

// One row of figures.def, a seal's for each seal; strings are static.
typedef struct {
  const char *path;
  size_t offset;          // of its value in SbSummary
  const char *where;      // "outer seal", "stage B": what tells it from others of its label; or ""
  int seal;               // that it is of; SB_SEAL_COUNT: of none, or of the valve through one
  bool back;              // it is of the seal's return, else of the in-stroke
  const char *si, *shown; // unit, and that which people read
  int digits;             // significant ones in tables; 0: a yes or no, 1 or 0
  SbBetter better;
  SbErrorSource error;   // what its error follows from
  SbSealDepth needs;     // of its seal; of the outer one for a figure of no seal
  SbVerdictKind verdict; // what a limit on it decides
  bool brief;            // a short table lists it
  const char *label, *help;
} SbFigure;

// Figure `index` < SB_FIGURE_COUNT; borrowed.
const SbFigure *sb_figure(int index);

// Index of a path ("seals.outer.load_N"), or -1.
int sb_figure_find(const char *path);

// SI value of figure `index`; NaN: not computed.
double sb_figure_value(const SbSummary *summary, int index);

// Why it was not computed; NULL for a number. Borrowed.
const char *sb_figure_reason(const SbSummary *summary, int index);

// Above the first a reported error has a warning, above the second the run has not converged.
#define SB_ERROR_LARGE   0.3
#define SB_ERROR_USELESS 1.0

// Estimate of its error: absolute in its SI unit, and relative to its magnitude (0 for an error of
// 0, infinite for another error of the value 0). NaN: not known, or not computed.
double sb_figure_error_absolute(const SbSummary *summary, int index);
double sb_figure_error(const SbSummary *summary, int index);

// Returns the absolute error of b - a, one figure of two designs with the relative errors
// `error_a` and `error_b`; NaN if one of them is not known. Runs of the same methods share the
// smaller of the two relative errors, which is proportional to the value and therefore acts on the
// difference only; the remainder acts on the full value of the run that has it:
//   min(e_a, e_b) |b - a| + |e_a - e_b| |v|, v the value with the larger error.
// Runs of other methods share nothing: e_a |a| + e_b |b|.
double sb_figure_difference_error(double a, double error_a, double b, double error_b,
                                  bool same_methods);

// Why it has no relative error to report; NULL where it has one. Static text, or the reason of the
// figure that was not computed, borrowed.
const char *sb_figure_error_reason(const SbSummary *summary, int index);

// "none", "less", "more"; borrowed.
const char *sb_better_name(SbBetter better);

// Makes every figure NaN, with no reason.
void sb_figures_clear(SbSummary *summary);

// Fills those that follow from the model alone: what the rings' and the chamber's sizes give.
void sb_figures_of_model(SbSummary *summary, const SbModel *model);

// Why the figures of `pattern` are missing, should they be: a path, or a beginning of paths with a
// '*'. The first reason given stays.
void sb_reason(SbSummary *summary, const char *pattern, const char *format, ...) SB_PRINTF(3, 4);

// The same for a seal's figures; `name` is what follows "seals.outer." in the pattern.
void sb_seal_reason(SbSummary *summary, int seal, const char *name, const char *format, ...)
    SB_PRINTF(4, 5);

// "never-moved", "stuck", "returned" or "held"; NULL for SB_OUTCOME_UNKNOWN. Static.
const char *sb_outcome_name(SbOutcome outcome);

// "seals", "presses", ...; borrowed.
const char *sb_verdict_name(SbVerdictKind kind);

// Takes `next` in place of *worst where it is worse (true): a no before what is unknown before a
// yes; of two yeses the one nearer to its limit, of two noes the one further beyond it.
bool sb_verdict_take_worse(SbVerdict *worst, const SbVerdict *next);

// What the summary says of the valve, against the model's limits. The summary must be complete.
void sb_verdict_fill(SbSummary *summary, const SbModel *model);
