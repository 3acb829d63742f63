// What the parts of a gradient share. Internal to gradient.c, gradient_rings.c, gradient_values.c
// and gradient_outcome.c.
#pragma once

#include "engine/valve/gradient.h"

enum { SB_GRADIENT_TEXTS = 64, SB_GRADIENT_TEXT = SB_TEXT };

struct SbGradient {
  size_t figures, parameters;
  int *figure;
  SbParamId *parameter;
  double *at, *value;    // of each parameter, of each figure
  double *slope, *error; // [figures][parameters]
  unsigned char *why;    // text number from 1 of those without, 0: none
  bool *solved;          // [figures][parameters]: the slope is a difference of full solves
  size_t text_count;
  char text[SB_GRADIENT_TEXTS][SB_GRADIENT_TEXT];
};

// Room for the question's figures by parameters; NULL: no memory.
SbGradient *sb_gradient_make(const SbQuestion *question, const SbParamId *parameter, size_t count);

// Number of a text, from 1. The last place takes what no longer fits.
unsigned char sb_gradient_text(SbGradient *gradient, const char *text);

// What happened, beside the figures: of it a step keeps all, or the reason of a jump is told.
typedef struct {
  bool known, stage[SB_STAGE_COUNT];
  SbOutcome end;
  struct {
    bool touches, opened, film_fitted;
    SbLeakState leak;
    SbRingState in, out;
  } seal[SB_SEAL_COUNT];
} SbGradientOutcome;

void sb_gradient_outcome(SbGradientOutcome *out, const SbSummary *summary);

// Says in what two outcomes differ (true), or nothing.
bool sb_gradient_differ(char *text, size_t size, const SbGradientOutcome *a,
                        const SbGradientOutcome *b);

// Load, width and peak of a seal's contact, to and fro; NaN: not computed.
enum { SB_GRADIENT_WAYS = 2, SB_GRADIENT_SIZES = 3 };
typedef struct {
  double size[SB_SEAL_COUNT][SB_GRADIENT_WAYS][SB_GRADIENT_SIZES];
} SbGradientContacts;

void sb_gradient_contacts(SbGradientContacts *out, const SbSummary *summary);

// Of what a figure is the sum: of terms that nearly cancel in the balance of energies, and in what
// a cycle leaks.
double sb_gradient_size(const SbSummary *summary, int figure);

// Reason of a slope that is smaller than its error.
#define SB_GRADIENT_UNCERTAIN "uncertain"

// Points of a level: above and below its base at whole and half steps; where only one side is there
// (h has its sign) h, h/2, h/4 in their places.
enum { SB_GRADIENT_PLUS, SB_GRADIENT_MINUS, SB_GRADIENT_POINTS = 4 };

// Steps: the first, two smaller ones for what is not smooth, a larger one for what rounding hides.
// Steps of rings to first order, whose mesh shows in the figures' curvature soon: one, and a larger
// one for what the films' rounding hides.
enum {
  SB_GRADIENT_FIRST,
  SB_GRADIENT_SMALL,
  SB_GRADIENT_SMALLEST,
  SB_GRADIENT_LARGE,
  SB_GRADIENT_RINGS,
  SB_GRADIENT_RINGS_LARGE,
  SB_GRADIENT_LEVELS
};

typedef struct {
  bool asked, one_sided;
  bool pair; // no half steps were asked: the outer ones are enough
  double h;  // [SI]; one-sided: of the side's sign
  // Of each seal's rings' active sets over the step, the mean of both sides, last the larger
  // [1/SI].
  double fault[SB_SEAL_COUNT + 1];
} SbGradientLevel;

typedef struct {
  SbGradient *out;
  SbEvaluator *evaluator; // keeps the base's contacts, or those to first order
  SbEvaluator *other;     // answers where they are others, owned
  SbQuestion question;    // with one more override than asked, that of the parameter
  SbOverride *override;
  double *own_value;  // of the figures by `evaluator` [figures]
  double *base_value; // of the figures while this parameter is moved [figures]
  double *size;       // of what each figure is the sum of, to which rounding goes [figures]
  double *value;      // [SB_GRADIENT_LEVELS][SB_GRADIENT_POINTS][figures]
  SbGradientLevel level[SB_GRADIENT_LEVELS];
  bool *open;    // figures whose derivative is still sought [figures]
  bool *follows; // figures that depend on the rings which this parameter moves [figures]
  SbGradientOutcome outcome;
  double *ring_value;           // of the figures with the base's rings to first order [figures]
  const SbEvaluator *own_start; // of `evaluator`; NULL: it has solved its own
  const SbEvaluator *start;     // solved rings of the base; NULL: there are none
  SbEvaluator *own_rings;       // `start` where it is owned, else NULL
  bool rings;                   // this parameter enters rings
  bool refused;                 // the last question, by the parameters alone
  double fault[SB_SEAL_COUNT];  // of the last answer's rings
  SbGradientContacts contacts, moved, up; // of the base's rings to first order, of the last
                                          // answer's, at a step up
  double tolerance;                       // that films are solved to
  double order;                   // of the rings' recovered pressures (SbSummary.ring_order)
  char changed[SB_GRADIENT_TEXT]; // what another outcome at a smallest step was, or empty
  SbReport report;                // of the last question that was refused or failed
} SbGradientWork;

// Values of the figures at a point of a level, [figures].
double *sb_gradient_values(const SbGradientWork *work, int level, int point);

// Whether an error ends the work.
bool sb_gradient_ends(SbStatus status);

// Figures with the parameter at x; NaN where there are none. `tell`: another outcome than the
// base's is written to `changed`.
SbStatus sb_gradient_ask(SbGradientWork *work, double *value, double x, bool tell);

// Adds to the errors of slopes through rings what is not in their differences, and compares these
// slopes with a full solve. `x`, `scale`: the parameter's value and size [SI].
SbStatus sb_gradient_check_rings(SbGradientWork *work, size_t parameter, double x, double scale);
