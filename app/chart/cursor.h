// A read-out over a finished chart: a vertical line, dots where it meets the curves, and a plate
// with the values.
#pragma once

#include "app/base/canvas.h"

// Draws the line at pixel x in the rectangle `plot`, dots at the pixels dot[dots] of y (NaN: none),
// and `text` on a plate next to the line, inside of `bounds`.
void sb_cursor_draw(cairo_t *cr, const SbTheme *theme, SbRect plot, SbRect bounds, double x,
                    const double *dot, int dots, const char *text);
