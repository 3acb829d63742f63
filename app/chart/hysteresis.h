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

// Whether a pixel is in the plot.
bool sb_hysteresis_in_plot(const SbHysteresisLayout *at, SbPoint p);

// What is shown when the plot is enlarged by `factor` about a point of the picture, from what
// `data` shows; a factor of 1 keeps it. False: all of it.
enum { SB_HYSTERESIS_ZOOM_MAX = 200 };
bool sb_hysteresis_zoom(SbChartZoom *out, SbRect rect, const SbChartData *data, unsigned flags,
                        double factor, double x, double y);

// Nearest frame to a point of the picture, within `reach` px; false if the curve is further off.
bool sb_hysteresis_hit(size_t *frame, SbRect rect, const SbChartData *data, unsigned flags,
                       double x, double y, double reach);

// Forces of the loop at a displacement [m], on the way in and on the way back [N]; NaN where it
// does not pass.
void sb_hysteresis_forces(double out[2], const SbChartRun *run, double displacement);

// "2.00 mm  in 25.0 N  back 4.0 N". Owned by the caller.
char *sb_hysteresis_cursor_text(const SbChartRun *run, double displacement);

// The displacement under a point of the picture; false where that is not in the plot.
bool sb_hysteresis_cursor(double *displacement, SbRect rect, const SbChartData *data,
                          unsigned flags, double x, double y);

// Draws a line there with the forces, over the finished chart.
void sb_hysteresis_cursor_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                               const SbChartData *data, unsigned flags, double displacement);
