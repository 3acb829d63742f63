// The page with all views of one frame: section, loop, profiles, timeline, key figures, footer.
#pragma once

#include "app/chart/data.h"
#include "app/draw/canvas.h"

// Draws the section with its insets, legends and scale bars into the rectangle of its panel [px].
// The caller has drawn the panel's background and border. `user` is passed unchanged.
typedef void (*SbSectionDraw)(cairo_t *cr, SbRect rect, const SbTheme *theme,
                              const SbChartData *data, void *user);

// Draws the page into `rect` [px]. It is designed for 1920 x 1080; other sizes scale the full page
// down to 3/4, and below that shrink the panels, so that text stays readable. `section` draws the
// section (NULL: the loop takes its place). `flags` of SB_CHART_PANEL, ... (data.h).
void sb_dashboard_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                       unsigned flags, SbSectionDraw section, void *user);
