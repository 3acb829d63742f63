// A read-out over a finished chart: a line across the plot, dots where it meets the curves, and the
// values on a plate beside it.
#pragma once

#include "app/base/canvas.h"

// The line stands at pixel x; a dot of NaN is left out. The plate stays within `bounds`.
void sb_cursor_draw(cairo_t *cr, const SbTheme *theme, SbRect plot, SbRect bounds, double x,
                    const double *dot, int dots, const char *text);
