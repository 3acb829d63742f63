// A read-out over a finished chart: a vertical line, dots where it meets the curves, and a plate
// with the values.
#pragma once

#include "app/draw/canvas.h"

// Draws the dashed line from the mark of the present instant down to y = `bottom`, both in pixels
// of the canvas.
void sb_cursor_drop(SbCanvas *c, SbPoint now, double bottom);

// Draws the dot of the present instant, in pixels of the canvas.
void sb_cursor_now(SbCanvas *c, SbPoint now);

// Draws the line at pixel x in the rectangle `plot` of the curves, dots on it at the pixels
// dot[dots] of y (NaN: none), and the one line `text` on a plate next to the line, inside of
// `bounds`, the rectangle of the chart. All in pixels of the picture.
void sb_cursor_draw(cairo_t *cr, const SbTheme *theme, SbRect plot, SbRect bounds, double x,
                    const double *dot, int dots, const char *text);
