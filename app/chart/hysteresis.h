// Force on the stem against its displacement: the loop, its stages, what was played of it.
#pragma once

#include "app/base/canvas.h"
#include "app/chart/axis.h"
#include "app/chart/data.h"

// Where the chart puts things in a rectangle.
typedef struct {
  SbRect plot;
  SbScale x, y; // displacement [mm], force [N]
  SbTicks x_ticks, y_ticks;
} SbHysteresisLayout;

// Draws the chart into `rect`.
void sb_hysteresis_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                        unsigned flags);

// The same layout that drawing uses.
void sb_hysteresis_layout(SbHysteresisLayout *out, SbRect rect, const SbChartData *data,
                          unsigned flags);

// Nearest frame to a point of the picture, within `reach` px; false if the curve is further off.
bool sb_hysteresis_hit(size_t *frame, SbRect rect, const SbChartData *data, unsigned flags,
                       double x, double y, double reach);
