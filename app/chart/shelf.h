// A can on the shelf against time: loss by each path, rate and temperature, absorbed water and
// remaining doses; below them a table of the paths' fractions.
#pragma once

#include "app/chart/data.h"
#include "app/draw/canvas.h"

// Draws the panels into `rect` [px], each with its own background; nothing if data->run.summary is
// NULL or its `shelf` has no points.
// Typical values of a rubber, which are not measured, are named at the foot.
void sb_shelf_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data);
