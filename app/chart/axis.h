// Scales and ticks: from data to pixels, and where to put the marks.
#pragma once

#include "app/base/canvas.h"

enum { SB_TICKS_MAX = 12 };

// A linear or logarithmic map from [lo, hi] to pixels [p0, p1]; p1 < p0 for an axis that points up.
typedef struct {
  double lo, hi, p0, p1;
  bool logarithmic;
} SbScale;

// Marks of one axis. `step` is 0 on a logarithmic axis; `decimals` writes every value exactly.
typedef struct {
  int count;
  int decimals;
  double step;
  double value[SB_TICKS_MAX];
} SbTicks;

// Makes a range usable: finite, increasing, not narrower than rounding allows. An empty, reversed,
// degenerate or not finite range becomes the nearest sensible one; {0, 1} if there is none.
void sb_axis_repair(double *lo, double *hi);

// Pixel of a value; values beyond the ends go on linearly, up to a thousand ranges away. A
// logarithmic scale sends values <= 0 far below its lower end (never NaN).
double sb_axis_at(const SbScale *scale, double value);

// Value of a pixel.
double sb_axis_value(const SbScale *scale, double pixel);

// Three to eight marks at 1, 2 or 5 times a power of ten inside [lo, hi], as near to `wanted` marks
// as that allows. Any input is safe.
void sb_axis_ticks(SbTicks *out, double lo, double hi, int wanted);

// Marks of a logarithmic axis: decades, every second or further decade on a long range, 1-2-5
// inside a decade on a short one. lo and hi > 0, else repaired.
void sb_axis_log_ticks(SbTicks *out, double lo, double hi);

// Widens [lo, hi] outwards to whole steps of the 1-2-5 division that sb_axis_ticks() would use.
void sb_axis_round_out(double *lo, double *hi, int wanted);

// Lines across a plot at the marks of y, short ones below it at those of x, and their numbers.
void sb_axis_draw(SbCanvas *c, SbRect plot, const SbScale *x, const SbTicks *x_ticks,
                  const SbScale *y, const SbTicks *y_ticks);
