// The cycle against time: stages as strips, displacement as a line, the playhead, bookmarks.
// Rectangles and points are in pixels of the picture.
#pragma once

#include "app/base/canvas.h"
#include "app/chart/axis.h"
#include "app/chart/data.h"

// Draws the live run into `rect`, which is designed for a height of 104 px; `flags` of
// SB_CHART_PANEL, ... (data.h).
void sb_timeline_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                      unsigned flags);

// Returns the time scale of the drawing, seconds to pixels.
SbScale sb_timeline_scale(SbRect rect, const SbChartData *data);

// Writes the frame that is nearest to pixel x. Returns false without frames.
bool sb_timeline_hit(size_t *frame, SbRect rect, const SbChartData *data, double x);

// Writes the index of the bookmark whose flag or name is at the pixel (x, y). Returns false if
// there is none.
bool sb_timeline_marker_hit(size_t *index, SbRect rect, const SbChartData *data, double x,
                            double y);
