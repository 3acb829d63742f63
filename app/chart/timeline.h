// The cycle in time: stages as strips, displacement as a line, the playhead, bookmarks.
#pragma once

#include "app/base/canvas.h"
#include "app/chart/axis.h"
#include "app/chart/data.h"

// Draws into `rect`; 104 px is the height it is made for.
void sb_timeline_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                      unsigned flags);

// Time scale of the drawing: seconds to pixels.
SbScale sb_timeline_scale(SbRect rect, const SbChartData *data);

// Frame nearest to a pixel; false without frames.
bool sb_timeline_hit(size_t *frame, SbRect rect, const SbChartData *data, double x);

// The bookmark whose flag or name is at a pixel; false where none is.
bool sb_timeline_marker_hit(size_t *index, SbRect rect, const SbChartData *data, double x,
                            double y);
