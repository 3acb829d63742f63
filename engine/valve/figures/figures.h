// Figures (results) of a run by their paths, reasons of missing figures, error estimates, limits
// and the verdict. A figure is NaN until it is computed. Functions with `const SbSummary *` may be
// called concurrently; the table is constant.
#pragma once

#include "engine/valve/figures/summary.h"

// Which direction of a figure is preferable.
typedef enum { SB_BETTER_NONE, SB_BETTER_LESS, SB_BETTER_MORE } SbBetter;

// Source of a figure's error estimate (run/run_errors.c).
typedef enum {
  SB_BY_INPUT,       // inputs and closed forms of them: 0
  SB_BY_RESIDUAL,    // an error estimate or residual itself: no error
  SB_BY_MOTION,      // motions with perturbed states and other steps
  SB_BY_NET_LEAK,    // difference of the volumes that films transport out and back
  SB_BY_LOAD,        // from here to SB_BY_TURN a seal's state; here the load of the fit
  SB_BY_MEAN,        // net load divided by width
  SB_BY_PEAK,        // peak pressure
  SB_BY_WIDTH,       // contact width
  SB_BY_EDGE,        // position of a contact edge relative to the section's centre
  SB_BY_FILM_LEAST,  // minimum film
  SB_BY_FILM,        // central film and quantities proportional to it
  SB_BY_FILM_LAW,    // a power law of the load
  SB_BY_FILM_SOLVED, // a film solved for comparison
  SB_BY_AREA,        // real area while sliding
  SB_BY_REST_AREA,   // real area at rest
  SB_BY_SHARE,       // fraction of the load on asperities
  SB_BY_BOUNDARY,    // friction of asperities
  SB_BY_VISCOUS,     // friction of the film
  SB_BY_FRICTION,    // sum of both
  SB_BY_STATIC,      // static friction at stage B
  SB_BY_COEFFICIENT, // friction divided by load
  SB_BY_SQUEEZE_OUT, // time of the squeeze-out
  SB_BY_LEAK,        // flow through channels at rest
  SB_BY_SLOPE,       // logarithmic derivative of that flow
  SB_BY_SPEED,       // speed of sliding
  SB_BY_TURN,        // rotation of the section
  SB_BY_FILLED,      // times of stages C and F
  SB_BY_KEPT,        // time for which the vent is open
  SB_BY_DOSE,        // both of these
  SB_BY_PRIME,       // leakage at rest of the outer seal
  SB_BY_SAMPLES,     // sampling of the rig's signal
  SB_BY_LIFE_PEAK,   // actuations of a life: forces, with the cycle's errors
  SB_BY_LIFE_BREAKAWAY,
  SB_BY_LIFE_RETURN,
  SB_BY_LIFE_FILM, // actuations of a life: films
  SB_BY_LIFE_NET,
  SB_BY_PERMEATION,     // permeation of the solved ring
  SB_BY_CHANNELS,       // flow along the contact at rest
  SB_BY_LOSS,           // sum of both
  SB_BY_MASS_LEFT,      // remaining mass
  SB_BY_DOSES_LEFT,     // remaining mass in complete doses
  SB_BY_SHELF_PRESSURE, // mean contact pressure at rest
} SbErrorSource;

// X(quantity, SI unit): the quantities of figures.
#define SB_FIGURE_QUANTITY_LIST(X)                                                                 \
  X(NUMBER, "1")                                                                                   \
  X(FRACTION, "1") /* a part of a total, 0 to 1 */                                                 \
  X(LENGTH, "m")                                                                                   \
  X(VOLUME, "m3")                                                                                  \
  X(TIME, "s")                                                                                     \
  X(SPEED, "m/s")                                                                                  \
  X(FLOW, "m3/s")                                                                                  \
  X(ANGLE, "degree")                                                                               \
  X(MASS, "kg")                                                                                    \
  X(MASS_FLOW, "kg/s")                                                                             \
  X(MASS_PER_YEAR, "kg/(365 day)")                                                                 \
  X(FORCE, "N")                                                                                    \
  X(LINE_LOAD, "N/m")                                                                              \
  X(PRESSURE, "Pa")                                                                                \
  X(ENERGY, "J")                                                                                   \
  X(TEMPERATURE, "K")

// Quantity of a figure.
typedef enum {
#define SB_FIGURE_QUANTITY_ENUM(quantity, si) SB_FIGURE_QUANTITY_##quantity,
  SB_FIGURE_QUANTITY_LIST(SB_FIGURE_QUANTITY_ENUM)
#undef SB_FIGURE_QUANTITY_ENUM
} SbFigureQuantity;

// Part of a run that a figure belongs to. The plan computes a part if one of its figures is needed.
typedef enum {
  SB_PART_CYCLE,            // states of the seals and the cycle, to the depth of its seal
  SB_PART_ENERGY,           // energy balance of the cycle
  SB_PART_LAWS,             // films by laws other than the model's own
  SB_PART_SHELF,            // rates on the shelf
  SB_PART_SHELF_TIME,       // sums over the time on the shelf
  SB_PART_ESTIMATE,         // from here on error estimates of a solver; here of the cycle
  SB_PART_ESTIMATE_HISTORY, // of the transient films
  SB_PART_ESTIMATE_SHELF    // of the permeation
} SbFigurePart;

// Direction of sliding that a figure is about.
typedef enum {
  SB_DIRECTION_NONE, // not of one stroke
  SB_DIRECTION_IN,   // in-stroke
  SB_DIRECTION_OUT   // return
} SbDirection;

// One row of figures.def (for each seal if it is a seal's). Strings are static.
typedef struct {
  const char *path;  // "seals.outer.load_N"
  size_t offset;     // of its value in SbSummary
  const char *where; // "outer seal", "stage B": distinguishes figures with the same label; or ""
  int seal;          // SB_OUTER, SB_INNER; SB_SEAL_COUNT: not of one seal
  SbDirection direction;
  SbFigureQuantity quantity;
  const char *si, *shown; // SI unit; display unit
  int digits;             // significant digits in tables; 0: yes or no (1 or 0)
  SbBetter better;
  SbErrorSource error; // source of its error estimate
  SbSealDepth needs;   // depth that its seal needs; of the outer one for a figure of no seal
  SbFigurePart part;
  SbVerdictKind verdict; // criterion that a limit on it decides
  bool brief;            // listed in short tables
  const char *label, *help;
} SbFigure;

// Returns the row of figure `index`, 0 to SB_FIGURE_COUNT - 1; static.
const SbFigure *sb_figure(int index);

// Returns whether a figure is an error estimate of a solver.
static inline bool sb_figure_is_estimate(const SbFigure *figure) {
  return figure->part >= SB_PART_ESTIMATE;
}

// Returns the index of a path ("seals.outer.load_N"), or -1.
int sb_figure_find(const char *path);

// Returns the value of figure `index` in SI; NaN: not computed.
double sb_figure_value(const SbSummary *summary, int index);

// Returns why figure `index` was not computed; NULL if it has a value.
const char *sb_figure_reason(const SbSummary *summary, int index);

// Relative error above which a warning is given.
#define SB_ERROR_LARGE 0.3

// Relative error of a solved figure above which a run has not converged.
#define SB_ERROR_USELESS 1.0

// Returns the estimated absolute error of figure `index` in its SI unit; NaN: not known, or not
// computed.
double sb_figure_error_absolute(const SbSummary *summary, int index);

// Returns the estimated error of figure `index` relative to its magnitude: 0 for an exact value,
// INFINITY for an error of a value 0; NaN: not known, or not computed.
double sb_figure_error(const SbSummary *summary, int index);

// Returns the absolute error of b - a, one figure of two designs with the relative errors `error_a`
// and `error_b`; NaN if one of them is not known. Runs of the same methods share the smaller
// relative error, which acts on the difference only; the remainder acts on the value v with the
// larger error:
//   min(e_a, e_b) |b - a| + |e_a - e_b| |v|.
// Runs of other methods share nothing: e_a |a| + e_b |b|.
double sb_figure_difference_error(double a, double error_a, double b, double error_b,
                                  bool same_methods);

// Returns why figure `index` has no relative error to report; NULL if it has one. Static, or
// borrowed from the summary.
const char *sb_figure_error_reason(const SbSummary *summary, int index);

// Returns "none", "less" or "more"; static.
const char *sb_better_name(SbBetter better);

// Sets all figures and errors to NaN, and removes all reasons.
void sb_figures_clear(SbSummary *summary);

// Sets the figures that follow from the model alone (sizes of rings, glands and chamber).
void sb_figures_of_model(SbSummary *summary, const SbModel *model);

// Sets a formatted reason for the figures of `pattern`, a path or a beginning of paths followed by
// '*', for the case that they are not computed. A figure keeps its first reason.
void sb_reason(SbSummary *summary, const char *pattern, const char *format, ...) SB_PRINTF(3, 4);

// Does the same for a seal's figures; `name` is the pattern after "seals.outer." or "seals.inner.".
void sb_seal_reason(SbSummary *summary, int seal, const char *name, const char *format, ...)
    SB_PRINTF(4, 5);

// Returns "never-moved", "stuck", "returned" or "held"; NULL for SB_OUTCOME_UNKNOWN. Static.
const char *sb_outcome_name(SbOutcome outcome);

// Returns "seals", "presses", "returns", "doses", "leak" or "fits"; static.
const char *sb_verdict_name(SbVerdictKind kind);

// Replaces *worst by *next if that is worse, and returns whether it did. No is worse than unknown,
// unknown worse than yes; of two yes the one nearer to its limit is worse, of two no the one
// further beyond it.
bool sb_verdict_take_worse(SbVerdict *worst, const SbVerdict *next);

// Sets the verdict of a complete summary by the model's limits.
void sb_verdict_fill(SbSummary *summary, const SbModel *model);
