// Scales and ticks of charts: from data to pixels, and the positions of the tick marks.
#pragma once

#include "app/draw/label.h"

// Largest number of ticks.
enum { SB_TICKS_MAX = 12 };

// A linear or logarithmic map from [lo, hi] to pixels [p0, p1]; p1 < p0 for an axis that points up.
// lo < hi, and 0 < lo if it is logarithmic.
typedef struct {
  double lo, hi, p0, p1;
  bool logarithmic;
} SbScale;

// Ticks of one axis.
typedef struct {
  int count;
  int decimals;               // that write every value exactly; 0 if `step` is 0
  double step;                // between ticks; 0: powers of ten, or 1, 2 and 5 times those
  double value[SB_TICKS_MAX]; // [count], increasing, in the unit of the axis
} SbTicks;

// Replaces a range that is empty, reversed, not finite, or as narrow as rounding, by the nearest
// finite increasing one; {0, 1} if there is none.
void sb_axis_repair(double *lo, double *hi);

// Returns the pixel of a value. Values outside of the range are extrapolated up to a thousand
// ranges. On a logarithmic scale, values more than ten ranges below the lower end, values <= 0 and
// NaN are drawn ten ranges below it. On a linear scale the pixel of NaN is NaN.
double sb_axis_at(const SbScale *scale, double value);

// Returns the value of a pixel.
double sb_axis_value(const SbScale *scale, double pixel);

// Writes three to eight ticks in [lo, hi] with a step of 1, 2 or 5 times a power of ten; their
// number is as close to `wanted` as possible. Any range is accepted.
void sb_axis_ticks(SbTicks *out, double lo, double hi, int wanted);

// Writes the ticks of a logarithmic axis: decades, or every second or further decade on a long
// range, or 1, 2 and 5 times powers of ten on a short one; below half a decade those of
// sb_axis_ticks(), with a step. A range that is not positive is repaired.
void sb_axis_log_ticks(SbTicks *out, double lo, double hi);

// Extends [lo, hi] to multiples of the step that sb_axis_ticks() would use.
void sb_axis_round_out(double *lo, double *hi, int wanted);

// Writes the number of the tick `value` to out[SB_FORMAT_MAX].
typedef void (*SbTickText)(char *out, const SbTicks *ticks, double value);

// Writes a tick with the decimals of the axis; with a power of ten where digits alone would be
// many.
void sb_axis_text(char *out, const SbTicks *ticks, double value);

// The axes of a plot. Members that are zero have the stated default.
typedef struct {
  SbRect plot;               // area of the curves [px]
  SbScale x, y;              // from values to pixels
  SbTicks x_ticks, y_ticks;  // without ticks (count 0) an axis is not drawn
  SbTickText x_text, y_text; // write the numbers; NULL: sb_axis_text()
  const char *x_name;        // quantity and unit of x, under the right end; NULL: none
  SbRect card;  // numbers and name of x stay between its left and right end; width 0: no limit
  bool upright; // lines up the plot at the ticks of x in place of its lower end and short lines
  bool bare;    // no numbers of y: they are those of the plot on the left
  int minor;    // parts into which short lines divide each step of x; 0: none
} SbAxes;

// Sets the plot, and linear scales with the values x0 and x1 at its left and right end, y0 and y1
// at its lower and upper end. Other members are not changed: initialise `axes` with {0} before.
void sb_axes_linear(SbAxes *axes, SbRect plot, double x0, double x1, double y0, double y1);

// Sets about `x` ticks of x and `y` ticks of y over the ranges of the scales; 0: none. Of a
// logarithmic scale any other number gives the ticks of sb_axis_log_ticks().
void sb_axes_ticks(SbAxes *axes, int x, int y);

// Returns the pixel of a point.
SbPoint sb_axes_at(const SbAxes *axes, double x, double y);

// Returns whether a pixel is in the plot or at most `margin` px outside of it.
bool sb_axes_inside(const SbAxes *axes, double x, double y, double margin);

// Draws the axes: lines across the plot at the ticks of y, the lower end of the plot, the line y =
// 0 if it is inside, short lines below the plot at the ticks of x, the numbers that do not overlap,
// and the name. `labels` then avoid the lines across; NULL: none.
void sb_axes_draw(SbCanvas *c, const SbAxes *axes, SbLabels *labels);
