// The live run beside those it is compared with: a table of figures, each pin's with what it
// differs by from the live run, and the measured forces.
#pragma once

#include "app/base/canvas.h"
#include "app/chart/data.h"

// Height that all rows take.
double sb_compare_height(void);

// The first rows are the forces at the playhead's displacement, either way. A pin's percentage is
// left out where the live force is below 0.5 N. Figures that were not computed are a dash.
void sb_compare_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                     unsigned flags);

// The same as text: a line each, columns behind tabs. Owned by the caller.
char *sb_compare_text(const SbChartData *data);
