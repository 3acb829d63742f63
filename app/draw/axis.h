// Scales and ticks of charts: from data to pixels, and the positions of the tick marks.
#pragma once

#include "app/draw/canvas.h"

// Largest number of ticks.
enum { SB_TICKS_MAX = 12 };

// A linear or logarithmic map from [lo, hi] to pixels [p0, p1]; p1 < p0 for an axis that points up.
typedef struct {
  double lo, hi, p0, p1;
  bool logarithmic;
} SbScale;

// Ticks of one axis.
typedef struct {
  int count;
  int decimals;               // number of decimals that writes every value exactly
  double step;                // between ticks; 0: a logarithmic axis
  double value[SB_TICKS_MAX]; // [count], increasing, in the unit of the axis
} SbTicks;

// Replaces a range that is empty, reversed, not finite, or as narrow as rounding, by the nearest
// finite increasing one; {0, 1} if there is none.
void sb_axis_repair(double *lo, double *hi);

// Returns the pixel of a value. Values outside of the range are extrapolated linearly, up to a
// thousand ranges. On a logarithmic scale values <= 0 are far below the lower end. Never NaN.
double sb_axis_at(const SbScale *scale, double value);

// Returns the value of a pixel.
double sb_axis_value(const SbScale *scale, double pixel);

// Writes three to eight ticks in [lo, hi] with a step of 1, 2 or 5 times a power of ten; their
// number is as close to `wanted` as possible. Any range is accepted.
void sb_axis_ticks(SbTicks *out, double lo, double hi, int wanted);

// Writes the ticks of a logarithmic axis: decades, or every second or further decade on a long
// range, or 1, 2 and 5 times powers of ten on a short one. A range that is not positive is
// repaired.
void sb_axis_log_ticks(SbTicks *out, double lo, double hi);

// Extends [lo, hi] to multiples of the step that sb_axis_ticks() would use.
void sb_axis_round_out(double *lo, double *hi, int wanted);

// Draws lines across the rectangle `plot` [px] at the ticks of y, short lines below it at the ticks
// of x, and their numbers.
void sb_axis_draw(SbCanvas *c, SbRect plot, const SbScale *x, const SbTicks *x_ticks,
                  const SbScale *y, const SbTicks *y_ticks);
