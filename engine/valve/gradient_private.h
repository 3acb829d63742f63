// What the parts of a gradient share. Internal to gradient.c, gradient_values.c and
// gradient_outcome.c.
#pragma once

#include "engine/valve/gradient.h"

enum { SB_GRADIENT_TEXTS = 64, SB_GRADIENT_TEXT = 160 };

struct SbGradient {
  size_t figures, parameters;
  int *figure;
  SbParamId *parameter;
  double *at, *value;    // of each parameter, of each figure
  double *slope, *error; // [figures][parameters]
  unsigned char *why;    // text number from 1 of those without, 0: none
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
