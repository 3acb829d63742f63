// The cycle against time: stages as strips, displacement as a line, the playhead, bookmarks.
// Rectangles and points are in pixels of the picture. The functions take the same `rect` and `data`
// as sb_timeline_draw().
#pragma once

#include "app/chart/data.h"
#include "app/draw/axis.h"
#include "app/draw/canvas.h"

// Draws the live run into `rect`. It is designed for a height of 104 px; in another one the strips
// grow or shrink (below 62 px they exceed `rect`), texts do not. `flags`: 0 or SB_CHART_WHOLE of
// data.h (no playhead); other bits have no effect.
void sb_timeline_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                      unsigned flags);

// Returns the time scale of the drawing, seconds to pixels of x. Before the run has ended it
// extends to the expected duration.
SbScale sb_timeline_scale(SbRect rect, const SbChartData *data);

// Writes the index of the frame whose time is nearest to pixel x. Returns false without frames.
bool sb_timeline_hit(size_t *frame, SbRect rect, const SbChartData *data, double x);

// Writes the index in data->marker of the bookmark whose flag or name is at the pixel (x, y).
// Returns false if there is none.
bool sb_timeline_marker_hit(size_t *index, SbRect rect, const SbChartData *data, double x,
                            double y);
