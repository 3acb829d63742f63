// The signal of the sliding-plate rig: force in the thread against time, its peaks, and the levels
// from which the coefficients are computed.
#pragma once

#include "app/chart/data.h"
#include "app/draw/axis.h"
#include "app/draw/canvas.h"

// Draws the chart of the live run into `rect` [px]; `flags` of SB_CHART_PANEL, ... (data.h).
void sb_signal_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                    unsigned flags);

// Writes the frame whose time is nearest to the pixel (x, y). Returns false outside of the plot or
// without frames.
bool sb_signal_hit(size_t *frame, SbRect rect, const SbChartData *data, unsigned flags, double x,
                   double y);
