// Figures (scalar results of a run) by path or index: values, reasons of missing values, error
// estimates, and the verdict.
//
// The index of a figure is its row in a constant table, 0 to SB_FIGURE_COUNT - 1; get it from
// sb_figure_find(). A figure is NaN until it is computed. Functions with `const SbSummary *` may be
// called concurrently for one summary that no run is writing.
#pragma once

#include "engine/valve/figures/summary.h"

// Which direction of a figure is preferable.
typedef enum { SB_BETTER_NONE, SB_BETTER_LESS, SB_BETTER_MORE } SbBetter; // NONE: neither

// Quantity from whose error a figure's error estimate is computed (run/run_errors.c).
typedef enum {
  SB_BY_INPUT,          // inputs and closed forms of them: 0
  SB_BY_RESIDUAL,       // an error estimate or residual itself: no error
  SB_BY_MOTION,         // motions with perturbed states and other steps
  SB_BY_NET_LEAK,       // difference of the volumes that films transport out and back
  SB_BY_LOAD,           // load of the fit; from here to SB_BY_TURN: quantities of a seal's state
  SB_BY_MEAN,           // net load divided by width
  SB_BY_PEAK,           // peak pressure
  SB_BY_WIDTH,          // contact width
  SB_BY_EDGE,           // position of a contact edge relative to the section's centre
  SB_BY_FILM_LEAST,     // minimum film
  SB_BY_FILM,           // central film and quantities proportional to it
  SB_BY_FILM_LAW,       // a power law of the load
  SB_BY_FILM_SOLVED,    // a film solved for comparison
  SB_BY_AREA,           // real area while sliding
  SB_BY_REST_AREA,      // real area at rest
  SB_BY_SHARE,          // fraction of the load on asperities
  SB_BY_BOUNDARY,       // friction of asperities
  SB_BY_VISCOUS,        // friction of the film
  SB_BY_FRICTION,       // friction of asperities and film
  SB_BY_STATIC,         // static friction at stage B
  SB_BY_COEFFICIENT,    // friction divided by load
  SB_BY_SQUEEZE_OUT,    // time of the squeeze-out
  SB_BY_LEAK,           // flow through channels at rest
  SB_BY_SLOPE,          // logarithmic derivative of the flow through channels
  SB_BY_SPEED,          // speed of sliding
  SB_BY_TURN,           // rotation of the section
  SB_BY_FILLED,         // times of stages C and F
  SB_BY_KEPT,           // time for which the vent is open
  SB_BY_DOSE,           // times of stages C and F, and time for which the vent is open
  SB_BY_PRIME,          // leakage at rest of the outer seal
  SB_BY_SAMPLES,        // sampling of the rig's signal
  SB_BY_LIFE_PEAK,      // peak force of an actuation of a life, with the cycle's relative error
  SB_BY_LIFE_BREAKAWAY, // break-away force of an actuation
  SB_BY_LIFE_RETURN,    // return force of an actuation
  SB_BY_LIFE_FILM,      // film of an actuation
  SB_BY_LIFE_NET,       // net leakage of an actuation
  SB_BY_PERMEATION,     // permeation of the solved ring
  SB_BY_CHANNELS,       // flow along the contact at rest
  SB_BY_LOSS,           // permeation and flow along the contact
  SB_BY_MASS_LEFT,      // remaining mass
  SB_BY_DOSES_LEFT,     // remaining mass in complete doses
  SB_BY_SHELF_PRESSURE, // mean contact pressure at rest
} SbErrorSource;

// X(quantity, SI unit): the quantities of figures.
#define SB_FIGURE_QUANTITY_LIST(X)                                                                 \
  X(NUMBER, "1")                                                                                   \
  X(FRACTION, "1") /* a part of a total, 0 to 1 */                                                 \
  X(LENGTH, "m")                                                                                   \
  X(FILM, "m") /* thickness, displayed in nm or µm */                                             \
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

// Quantity of a figure, SB_FIGURE_QUANTITY_NUMBER, ...; it determines the SI unit.
typedef enum {
#define SB_FIGURE_QUANTITY_ENUM(quantity, si) SB_FIGURE_QUANTITY_##quantity,
  SB_FIGURE_QUANTITY_LIST(SB_FIGURE_QUANTITY_ENUM)
#undef SB_FIGURE_QUANTITY_ENUM
} SbFigureQuantity;

// Part of a run that a figure belongs to. The plan computes a part if one of its figures is needed.
typedef enum {
  SB_PART_CYCLE,            // states of the seals to the depth SbFigure.needs, and the cycle
  SB_PART_ENERGY,           // energy balance of the cycle
  SB_PART_LAWS,             // films by laws other than the model's own
  SB_PART_SHELF,            // rates on the shelf
  SB_PART_SHELF_TIME,       // sums over the time on the shelf
  SB_PART_ESTIMATE,         // error estimates of solvers in the cycle
  SB_PART_ESTIMATE_HISTORY, // error estimates of the transient films
  SB_PART_ESTIMATE_SHELF    // error estimates of the permeation
} SbFigurePart;

// What a figure describes.
typedef enum {
  SB_GROUP_CYCLE,  // the cycle of a valve
  SB_GROUP_STAGE,  // one stage of the cycle
  SB_GROUP_SEAL,   // one seal
  SB_GROUP_PEOPLE, // who can press the valve
  SB_GROUP_DOSE,   // the dose
  SB_GROUP_RIG,    // the sliding plate
  SB_GROUP_LIFE,   // a life of several actuations
  SB_GROUP_SHELF,  // storage
  SB_GROUP_SOLVER  // error estimates of solvers
} SbFigureGroup;

// Stroke that a figure describes.
typedef enum {
  SB_DIRECTION_NONE, // not one stroke
  SB_DIRECTION_IN,   // in-stroke
  SB_DIRECTION_OUT   // return
} SbDirection;

// One row of the table. Rows of seals and contacts in figures.def give one row here for each seal
// and way. Strings are static.
typedef struct {
  const char *path;    // "seals.outer.load_N"
  size_t offset;       // byte offset of its value, a double, in SbSummary
  const char *where;   // "outer seal", "stage B": distinguishes figures with the same label; or ""
  SbFigureGroup group; // what it describes
  int seal;            // SB_OUTER, SB_INNER; SB_SEAL_COUNT: not one seal
  SbDirection direction;     // stroke that it describes
  SbFigureQuantity quantity; // its physical quantity
  const char *si, *shown;    // SI unit; display unit
  int digits;                // significant digits in tables; 0: yes or no (1 or 0)
  SbBetter better;           // preferable direction
  SbErrorSource error;       // source of its error estimate
  SbSealDepth needs;     // depth to which its seal must be solved; without a seal: the outer seal
  SbFigurePart part;     // part of the run that computes it
  SbVerdictKind verdict; // criterion that a limit on it decides
  bool brief;            // it is listed in short tables
  const char *label;     // "Peak force"
  const char *help;      // one sentence
} SbFigure;

// Returns the row of figure `index`, 0 to SB_FIGURE_COUNT - 1; static.
const SbFigure *sb_figure(int index);

// Returns whether a figure is an error estimate of a solver.
static inline bool sb_figure_is_estimate(const SbFigure *figure) {
  return figure->group == SB_GROUP_SOLVER;
}

// Returns the index of the figure with this path ("seals.outer.load_N"); -1 if there is none.
int sb_figure_find(const char *path);

// Returns the value of figure `index` in the unit SbFigure.si (angles in degrees and losses in kg
// per 365 days, all others in SI); NaN: not computed.
double sb_figure_value(const SbSummary *summary, int index);

// Returns why figure `index` was not computed; NULL if it has a finite value. Static, or borrowed
// from the summary.
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

// Returns the absolute error of the difference b - a, where a and b are the values of one figure in
// two designs with the relative errors error_a and error_b (e_a, e_b below). NaN if an error is
// NaN. `same_methods`: sb_model_methods() of both models are equal. Then both values have the
// smaller relative error in common, so it acts on the difference only; the rest of the larger error
// acts on the value v that has it:
//   min(e_a, e_b) |b - a| + |e_a - e_b| |v|
// Otherwise the result is e_a |a| + e_b |b|.
double sb_figure_difference_error(double a, double error_a, double b, double error_b,
                                  bool same_methods);

// Returns why no relative error should be reported for figure `index` (no value, itself an error,
// not known, or too uncertain); NULL if sb_figure_error() is to be reported. Static, or borrowed
// from the summary.
const char *sb_figure_error_reason(const SbSummary *summary, int index);

// Returns "none", "less" or "more"; static.
const char *sb_better_name(SbBetter better);

// Sets all figures and errors of the summary to NaN and removes all reasons; other members are
// unchanged.
void sb_figures_clear(SbSummary *summary);

// Sets the figures that follow from the model alone (sizes of rings, glands and chamber).
void sb_figures_of_model(SbSummary *summary, const SbModel *model);

// Sets a formatted reason for all figures that match `pattern`: a full path, or the beginning of
// paths followed by '*' ("cycle.*"). A figure that has a reason keeps it. sb_figure_reason()
// returns the reason only while the figure has no value, so it may be set in advance.
void sb_reason(SbSummary *summary, const char *pattern, const char *format, ...) SB_PRINTF(3, 4);

// Does the same as sb_reason() for the figures of `seal` (SB_OUTER, SB_INNER); `name` is the part
// of the pattern after "seals.outer." or "seals.inner." ("leak*").
void sb_seal_reason(SbSummary *summary, int seal, const char *name, const char *format, ...)
    SB_PRINTF(4, 5);

// Returns "never-moved", "stuck", "returned" or "held"; NULL for SB_OUTCOME_UNKNOWN. Static.
const char *sb_outcome_name(SbOutcome outcome);

// Returns "seals", "presses", "returns", "doses", "leak" or "fits"; static.
const char *sb_verdict_name(SbVerdictKind kind);

// Replaces *worst by *next if *next is worse, or if worst->figure is -1; returns whether it did. NO
// is worse than UNKNOWN, UNKNOWN worse than YES. Of two YES the one relatively closer to its limit
// is worse, of two NO the one further beyond its limit. If both have the same answer and figure and
// no limit, and more of this figure is better, the smaller value is worse. Otherwise *worst
// remains.
bool sb_verdict_take_worse(SbVerdict *worst, const SbVerdict *next);

// Writes the verdict on a run from the model's limits. spread[SB_FIGURE_COUNT] has the differences
// between models that were computed in addition to the run, in the SI unit of the figures, 0 where
// there are none (NULL: none at all): a margin below them is uncertain. Does not read
// summary->verdict.
void sb_verdict_judge(SbVerdict verdict[SB_VERDICT_COUNT], const SbSummary *summary,
                      const SbModel *model, const double *spread);

// Sets summary->verdict from the model's limits. All other members that the run computes, with
// errors and reasons, must be set before.
void sb_verdict_fill(SbSummary *summary, const SbModel *model);
