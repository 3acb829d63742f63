// The sliding-plate rig's signal: force in the thread against time, its peaks, and the levels that
// the coefficients are made of.
#pragma once

#include "app/base/canvas.h"
#include "app/chart/axis.h"
#include "app/chart/data.h"

// Draws the chart into `rect`.
void sb_signal_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                    unsigned flags);

// Nearest frame in time to a point of the picture; false off the plot or without frames.
bool sb_signal_hit(size_t *frame, SbRect rect, const SbChartData *data, unsigned flags, double x,
                   double y);
