// Shared by gradient.c, gradient_slope.c, gradient_rings.c, gradient_values.c and
// gradient_outcome.c.
//
// sb_gradient_create() evaluates the base, then takes one parameter after the other: it computes
// all figures at a level (a step size; several points on both sides of the base) and decides for
// each figure whether the differences determine a slope; figures that stay open are computed at
// further levels. For a parameter that affects solved rings, sb_gradient_ask() linearises them
// about the base, and sb_gradient_check_rings() then adds their errors and compares slopes with
// full solves.
#pragma once

#include "engine/valve/answer/gradient.h"

// Number of reasons, and bytes of each.
enum { SB_GRADIENT_TEXTS = 64, SB_GRADIENT_TEXT = SB_TEXT };

// The derivatives (SbGradient of gradient.h). All arrays are owned.
struct SbGradient {
  size_t figures, parameters;
  int *figure;           // [figures] indices for sb_figure()
  SbParamId *parameter;  // [parameters]
  double *at, *value;    // [parameters] values at the base; [figures] values at the base [SI]
  double *value_error;   // [figures] relative errors of `value`
  double *slope, *error; // [figures][parameters] derivatives and their absolute errors [SI]
  unsigned char *why;    // [figures][parameters] number of the reason from 1; 0: none
  bool *solved;          // [figures][parameters] the slope is a difference of full solves
  bool *fixed;           // [figures][parameters] the model accepts no other value of the parameter
  size_t text_count;     // number of reasons
  char text[SB_GRADIENT_TEXTS][SB_GRADIENT_TEXT];
};

// Creates an object with arrays for the question's figures and parameter[count]; figures and
// parameters are set, all else is 0. NULL: no memory. Free it with sb_gradient_destroy().
SbGradient *sb_gradient_make(const SbQuestion *question, const SbParamId *parameter, size_t count);

// Returns the number (from 1) of the reason `text`, and stores it if it is new. If all
// SB_GRADIENT_TEXTS are used, the last one stands for all further reasons.
unsigned char sb_gradient_text(SbGradient *gradient, const char *text);

// Discrete outcomes of a run, which a step must not change.
typedef struct {
  bool known;                 // there was a summary
  bool stage[SB_STAGE_COUNT]; // the stage is reached
  SbOutcome end;              // SbSummary.outcome
  struct {
    bool touches, opened, film_fitted; // as in SbSealState
    SbLeakState leak;                  // SbSealState.leak_state
    SbRingState in, out;               // state of the ring on the in-stroke and on the return
  } seal[SB_SEAL_COUNT];
} SbGradientOutcome;

// Extracts the outcomes from a summary; NULL: known = false.
void sb_gradient_outcome(SbGradientOutcome *out, const SbSummary *summary);

// Returns whether two outcomes differ, and writes the first difference to text[size]. Returns
// false, and leaves `text`, if there is none, or if one of them is not known.
bool sb_gradient_differ(char *text, size_t size, const SbGradientOutcome *a,
                        const SbGradientOutcome *b);

// Numbers of directions of sliding (0 in-stroke, 1 return), and of sizes of a contact (0 load, 1
// width, 2 peak pressure).
enum { SB_GRADIENT_WAYS = 2, SB_GRADIENT_SIZES = 3 };

// Load [N], width [m] and peak pressure [Pa] of each seal's contact by direction; NaN: not
// computed.
typedef struct {
  double size[SB_SEAL_COUNT][SB_GRADIENT_WAYS][SB_GRADIENT_SIZES];
} SbGradientContacts;

// Extracts the contacts from a summary.
void sb_gradient_contacts(SbGradientContacts *out, const SbSummary *summary);

// Returns the magnitude of the largest term in the sum from which a figure is computed (energy
// balance, leakage of a cycle), else of the figure; the rounding error is a fraction of it.
double sb_gradient_size(const SbSummary *summary, int figure);

// Reason of a slope that is smaller than its error.
#define SB_GRADIENT_UNCERTAIN "uncertain"

// Points of a level, in this order: base + h, base - h, base + h/2, base - h/2. One-sided: base +
// h, base + h/2, base + h/4; the fourth is not used.
enum { SB_GRADIENT_PLUS, SB_GRADIENT_MINUS, SB_GRADIENT_POINTS = 4 };

// Levels: step sizes.
enum {
  SB_GRADIENT_FIRST,       // used first
  SB_GRADIENT_SMALL,       // for figures that are not smooth at the first
  SB_GRADIENT_SMALLEST,    // smaller again
  SB_GRADIENT_LARGE,       // for figures with large rounding errors
  SB_GRADIENT_RINGS,       // for linearised rings, in place of the first
  SB_GRADIENT_RINGS_LARGE, // for linearised rings, if films have large rounding errors
  SB_GRADIENT_LEVELS
};

// A level.
typedef struct {
  bool asked;     // this level is evaluated for the present parameter
  bool one_sided; // on one side of the base only, at an end of the parameter's range
  bool pair;      // only at full steps on both sides, without half steps
  double h;       // step [SI]; one-sided: with the sign of the side
  // SbSummary.ring_fault of each seal divided by the step, mean of both sides; the last element is
  // the larger of both seals [1/SI].
  double fault[SB_SEAL_COUNT + 1];
} SbGradientLevel;

// Work memory of sb_gradient_create(), which sets all fields before it calls the functions below.
typedef struct {
  SbGradient *out;        // the result
  SbEvaluator *evaluator; // the caller's; has the contacts of the base, solved or linearised
  SbEvaluator *other;     // owned; answers questions whose contacts differ from the base's
  SbQuestion question;    // the caller's with one more override, the last: the varied parameter
  SbOverride *override;   // [question.override_count], owned; question.override
  double *own_value;      // [figures] at the base, by `evaluator`
  double *base_value;     // [figures] at the base while this parameter varies
  double *size;           // [figures] magnitude of the figure's terms, for rounding errors
  double *value;          // [SB_GRADIENT_LEVELS][SB_GRADIENT_POINTS][figures]
  SbGradientLevel level[SB_GRADIENT_LEVELS];
  bool *open;                   // [figures] the derivative is not yet decided
  bool *follows;                // [figures] the figure depends on rings that this parameter affects
  SbGradientOutcome outcome;    // at the base
  double *ring_value;           // [figures] at the base, with linearised rings
  const SbEvaluator *own_start; // `start` of `evaluator`; NULL: it has solved its own rings
  const SbEvaluator *start;     // solved rings of the base; NULL: none
  SbEvaluator *own_rings;       // `start` if it is owned, else NULL
  bool rings;                   // this parameter affects rings
  bool refused;                 // the last question was refused because of its parameters
  double fault[SB_SEAL_COUNT];  // of the rings of the last answer (SbSummary.ring_fault)
  // Contacts at the base with linearised rings; of the last answer; at the base plus a step.
  SbGradientContacts contacts, moved, up;
  double tolerance;               // output.tolerance, of solved films
  double order;                   // SbSummary.ring_order at the base
  char changed[SB_GRADIENT_TEXT]; // how the outcome at a smallest step differs; or ""
  SbReport report;                // of the last question that was refused or failed
} SbGradientWork;

// Returns the array [figures] of values at a point of a level, in work->value.
double *sb_gradient_values(const SbGradientWork *work, int level, int point);

// Steps of the levels, divided by the parameter's scale: its magnitude; if that is 0, that of its
// default, or its range.
extern const double sb_gradient_parts[SB_GRADIENT_LEVELS];

// Whether differences determine a slope: they do, they do not, or there are none.
typedef enum { SB_GRADIENT_SMOOTH, SB_GRADIENT_ROUGH, SB_GRADIENT_MISSING } SbGradientKind;

// The slope of a figure from the differences of a level.
typedef struct {
  SbGradientKind kind;
  double slope, error; // [figure/SI]
  // Difference of the slopes towards both sides at h/2; one-sided: of those at h/2 and h/4; of a
  // pair: at h [figure/SI].
  double apart;
  double before; // the same difference at twice the step; of a pair INFINITY (accepted) or 0
  double step;   // h/2; one-sided h/4; of a pair h; > 0
  bool hidden;   // more than half of the error is due to rounding
} SbGradientEstimate;

// Estimates the slope of figure number `figure` from the values of the level `at`, which must have
// been evaluated.
void sb_gradient_estimate(SbGradientEstimate *out, const SbGradientWork *work, int at,
                          size_t figure);

// Decides the derivative of a figure by a parameter: sets slope and error.
void sb_gradient_set(SbGradientWork *work, size_t parameter, size_t figure, double slope,
                     double error);

// Decides that a derivative is not known, for a formatted reason.
void SB_PRINTF(4, 5) sb_gradient_refuse(SbGradientWork *work, size_t parameter, size_t figure,
                                        const char *format, ...);

// Decides with the best result of all levels a figure that no level determines well.
void sb_gradient_settle(SbGradientWork *work, size_t parameter, size_t figure);

// Returns whether an error ends the computation: SB_ERROR_CANCELLED or SB_ERROR_MEMORY.
bool sb_gradient_ends(SbStatus status);

// Computes value[figures] with the varied parameter at `x` [SI]; NaN where not available. Also sets
// fault, moved and refused of `work`. `note`: if the outcome differs from the base's, the
// difference is written to work->changed. Returns the status of sb_evaluator_ask(), which is no
// error of the gradient unless sb_gradient_ends().
SbStatus sb_gradient_ask(SbGradientWork *work, double *value, double x, bool note);

// Adds the errors of linearised rings to the slopes of parameter number `parameter`, compares them
// with differences of full solves, and replaces those that disagree. Call it after the slopes of
// all figures were decided from the levels RINGS and RINGS_LARGE. `x` is the parameter's value at
// the base, `scale` > 0 its magnitude [SI], to which steps are relative. Errors that
// sb_gradient_ends() names.
SbStatus sb_gradient_check_rings(SbGradientWork *work, size_t parameter, double x, double scale);
