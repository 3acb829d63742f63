// What the samples of a study say of one figure: how its values are spread against its limits, and
// which parameters they hang on.
#pragma once

#include "app/base/canvas.h"

#include <stddef.h>

// Values of a figure [SI]; NaN ones are left out. Borrowed.
typedef struct {
  const char *title;
  const char *si, *unit;
  const double *value; // [count], `stride` apart
  size_t count, stride;
  double low, high; // the limit on it; infinite: open
} SbHistogram;

// Bars of the values' shares; those beyond the limit are red, and the share of them is said.
void sb_histogram_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbHistogram *of);

enum { SB_TORNADO_MAX = 16 };

// What a figure changes by with each parameter; the greatest are drawn, from the top.
typedef struct {
  const char *title, *note; // note: what the bars are; NULL: none
  const char *unit;         // of the values; "" without
  size_t count;
  struct {
    const char *name;
    double value;     // signed; NaN: not known, left out
    double low, high; // its interval; NaN: none
  } bar[SB_TORNADO_MAX * 4];
} SbTornado;

void sb_tornado_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbTornado *of);
