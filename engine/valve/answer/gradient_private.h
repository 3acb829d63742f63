// Shared by gradient.c, gradient_rings.c, gradient_values.c and gradient_outcome.c. Private to
// these.
#pragma once

#include "engine/valve/answer/gradient.h"

// Number of reasons, and bytes of each.
enum { SB_GRADIENT_TEXTS = 64, SB_GRADIENT_TEXT = SB_TEXT };

// The derivatives (SbGradient of gradient.h).
struct SbGradient {
  size_t figures, parameters;
  int *figure;           // [figures]
  SbParamId *parameter;  // [parameters]
  double *at, *value;    // [parameters]; [figures]
  double *slope, *error; // [figures][parameters]
  unsigned char *why;    // [figures][parameters] number of the reason from 1; 0: none
  bool *solved;          // [figures][parameters] the slope is a difference of full solves
  size_t text_count;
  char text[SB_GRADIENT_TEXTS][SB_GRADIENT_TEXT];
};

// Returns an object with arrays for the question's figures and `count` parameters; NULL: no memory.
// Free it with sb_gradient_destroy().
SbGradient *sb_gradient_make(const SbQuestion *question, const SbParamId *parameter, size_t count);

// Returns the number (from 1) of a reason, which is stored if it is new. The last number is used
// for all that exceed the capacity.
unsigned char sb_gradient_text(SbGradient *gradient, const char *text);

// Discrete outcomes of a run, which a step must not change.
typedef struct {
  bool known, stage[SB_STAGE_COUNT]; // stage reached
  SbOutcome end;
  struct {
    bool touches, opened, film_fitted;
    SbLeakState leak;
    SbRingState in, out;
  } seal[SB_SEAL_COUNT];
} SbGradientOutcome;

// Extracts the outcomes from a summary.
void sb_gradient_outcome(SbGradientOutcome *out, const SbSummary *summary);

// Returns whether two outcomes differ, and writes how to text[size].
bool sb_gradient_differ(char *text, size_t size, const SbGradientOutcome *a,
                        const SbGradientOutcome *b);

// Directions of sliding, and sizes of a contact (load, width, peak).
enum { SB_GRADIENT_WAYS = 2, SB_GRADIENT_SIZES = 3 };

// Load, width and peak of each seal's contact by direction; NaN: not computed.
typedef struct {
  double size[SB_SEAL_COUNT][SB_GRADIENT_WAYS][SB_GRADIENT_SIZES];
} SbGradientContacts;

// Extracts the contacts from a summary.
void sb_gradient_contacts(SbGradientContacts *out, const SbSummary *summary);

// Returns the magnitude of the terms whose sum is the figure (energy balance, leakage of a cycle),
// for rounding errors.
double sb_gradient_size(const SbSummary *summary, int figure);

// Reason of a slope that is smaller than its error.
#define SB_GRADIENT_UNCERTAIN "uncertain"

// Points of a level: above and below the base at full and half steps; one-sided: h, h/2, h/4.
enum { SB_GRADIENT_PLUS, SB_GRADIENT_MINUS, SB_GRADIENT_POINTS = 4 };

// Levels (steps): the first, two smaller ones for functions that are not smooth, a larger one
// against rounding; one for linearised rings, and a larger one against rounding of films.
enum {
  SB_GRADIENT_FIRST,
  SB_GRADIENT_SMALL,
  SB_GRADIENT_SMALLEST,
  SB_GRADIENT_LARGE,
  SB_GRADIENT_RINGS,
  SB_GRADIENT_RINGS_LARGE,
  SB_GRADIENT_LEVELS
};

// A level.
typedef struct {
  bool asked, one_sided; // evaluated; on one side of the base only
  bool pair;             // without half steps
  double h;              // step [SI]; one-sided: with the sign of the side
  // Violation of the active sets of each seal's rings divided by the step, mean of both sides; last
  // the larger one [1/SI].
  double fault[SB_SEAL_COUNT + 1];
} SbGradientLevel;

// Work memory of sb_gradient_create().
typedef struct {
  SbGradient *out;
  SbEvaluator *evaluator; // has the contacts of the base, solved or to first order
  SbEvaluator *other;     // owned; answers questions whose contacts differ from the base's
  SbQuestion question;    // has one more override than asked, that of the parameter
  SbOverride *override;
  double *own_value;  // [figures] by `evaluator`
  double *base_value; // [figures] at the base while this parameter varies
  double *size;       // [figures] magnitude of the figure's terms, for rounding errors
  double *value;      // [SB_GRADIENT_LEVELS][SB_GRADIENT_POINTS][figures]
  SbGradientLevel level[SB_GRADIENT_LEVELS];
  bool *open;    // [figures] whose derivative is not yet decided
  bool *follows; // [figures] that depend on rings which this parameter affects
  SbGradientOutcome outcome;
  double *ring_value;           // [figures] with the base's rings to first order
  const SbEvaluator *own_start; // of `evaluator`; NULL: it has solved its own rings
  const SbEvaluator *start;     // solved rings of the base; NULL: none
  SbEvaluator *own_rings;       // `start` if it is owned, else NULL
  bool rings;                   // this parameter affects rings
  bool refused;                 // the last question was refused because of its parameters
  double fault[SB_SEAL_COUNT];  // of the rings of the last answer (SbSummary.ring_fault)
  // Of the base's rings to first order; of the last answer; at a step up.
  SbGradientContacts contacts, moved, up;
  double tolerance;               // of solved films
  double order;                   // of the rings' recovered pressures (SbSummary.ring_order)
  char changed[SB_GRADIENT_TEXT]; // how the outcome at a smallest step differs; or ""
  SbReport report;                // of the last question that was refused or failed
} SbGradientWork;

// Returns the array [figures] of values at a point of a level.
double *sb_gradient_values(const SbGradientWork *work, int level, int point);

// Returns whether an error ends the computation.
bool sb_gradient_ends(SbStatus status);

// Computes value[figures] with the parameter at x; NaN where not available. With `tell` an outcome
// that differs from the base's is written to work->changed.
SbStatus sb_gradient_ask(SbGradientWork *work, double *value, double x, bool tell);

// Adds the errors of linearised rings to the slopes of `parameter`, and compares the slopes with a
// full solve. `x`, `scale`: value and magnitude of the parameter [SI].
SbStatus sb_gradient_check_rings(SbGradientWork *work, size_t parameter, double x, double scale);
