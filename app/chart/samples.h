// Charts of the samples of a study for one figure: the distribution of its values with its limits,
// and the parameters on which it depends.
#pragma once

#include "app/draw/canvas.h"

#include <stddef.h>

// A histogram; everything is borrowed.
typedef struct {
  const char *title;
  const char *si, *unit; // SI unit and display unit
  const double *value;   // value[i * stride] is the value of sample i [si]; NaN: omitted
  size_t count, stride;  // samples; distance of their values
  double low, high;      // limits on the figure [si]; infinite: open
} SbHistogram;

// Draws the histogram into `rect` [px]; bars beyond the limit are red, and the number of samples in
// them is stated.
void sb_histogram_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbHistogram *of);

// Largest number of bars that are drawn.
enum { SB_TORNADO_MAX = 16 };

// Effects of parameters on a figure; the largest are drawn, from the top.
typedef struct {
  const char *title;
  const char *note; // meaning of the bars; NULL: none
  const char *unit; // of the values; "" without
  size_t count;     // of `bar`, at most 4 SB_TORNADO_MAX
  struct {
    const char *name;
    double value;     // signed; NaN: unknown, omitted
    double low, high; // interval of the value; NaN: none
  } bar[SB_TORNADO_MAX * 4];
} SbTornado;

// Draws the effects into `rect` [px].
void sb_tornado_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbTornado *of);
