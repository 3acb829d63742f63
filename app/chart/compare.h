// Table that compares the live run with the pinned runs (figures and their differences from the
// live run) and with measured forces.
#pragma once

#include "app/chart/data.h"
#include "app/draw/canvas.h"

// Draws the table into `rect` [px]. The first rows are the forces at the playhead's displacement on
// the in-stroke and on the return; a pin's percentage is omitted if the live force is below 0.5 N.
// A figure that was not computed is a dash. `flags` of SB_CHART_PANEL, ... (data.h).
void sb_compare_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                     unsigned flags);

// Returns the table as lines with tab-separated columns.
char *sb_compare_text(const SbChartData *data);
