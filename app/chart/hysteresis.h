// The loop: force on the stem against its displacement, with stages and the part that was played.
// Rectangles and points are in pixels of the picture; `flags` of SB_CHART_PANEL, ... (data.h). For
// the picture of sb_hysteresis_draw() the other functions take the same `rect`, `data` and `flags`.
#pragma once

#include "app/chart/data.h"
#include "app/draw/axis.h"
#include "app/draw/canvas.h"

// Draws the chart into `rect`.
void sb_hysteresis_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                        unsigned flags);

// Writes the axes with which sb_hysteresis_draw() draws: displacement [mm] and force [N].
void sb_hysteresis_layout(SbAxes *out, SbRect rect, const SbChartData *data, unsigned flags);

// Largest enlargement.
enum { SB_HYSTERESIS_ZOOM_MAX = 200 };

// Writes the range of the plot after enlarging that of `data` by `factor` (> 0; below 1: reducing)
// about the pixel (x, y). Returns whether the plot is enlarged; if not, it shows the full loop and
// *out has no meaning. Beyond SB_HYSTERESIS_ZOOM_MAX it does not change *out and returns whether
// data->zoom is set: initialise *out with that range.
bool sb_hysteresis_zoom(SbChartZoom *out, SbRect rect, const SbChartData *data, unsigned flags,
                        double factor, double x, double y);

// Writes the index of the frame of the live run that is nearest to the pixel (x, y). Returns false,
// with *frame not changed, if the curve is more than `reach` px away or there are no frames.
bool sb_hysteresis_hit(size_t *frame, SbRect rect, const SbChartData *data, unsigned flags,
                       double x, double y, double reach);

// Writes the forces of the loop at a displacement [m], out[0] on the in-stroke and out[1] on the
// return [N]; NaN: it does not reach the displacement. If the loop passes it several times in a
// direction, the longest straight piece of the trace is used.
void sb_hysteresis_forces(double out[2], const SbChartRun *run, double displacement);

// Returns the forces of sb_hysteresis_forces() as text: "2.00 mm  in 25.0 N  back 4.0 N".
char *sb_hysteresis_cursor_text(const SbChartRun *run, double displacement);

// Writes the displacement [m] at the pixel (x, y). Returns false if that is outside of the plot.
bool sb_hysteresis_cursor(double *displacement, SbRect rect, const SbChartData *data,
                          unsigned flags, double x, double y);

// Draws a line at a displacement [m] with its forces over the finished chart.
void sb_hysteresis_cursor_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                               const SbChartData *data, unsigned flags, double displacement);
