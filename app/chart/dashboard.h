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

// Positions of the parts: a point (x, y) of the page is the pixel (rect.x + scale * x, rect.y +
// scale * y) of the picture.
typedef struct {
  double scale; // of the page
  SbRect page, section, loop, pressure, film, timeline;
} SbDashboardLayout;

// Writes the positions of the parts for `rect` [px] as sb_dashboard_draw() uses them.
// `with_section`: the page has a section; without one out->section has no meaning.
void sb_dashboard_layout(SbDashboardLayout *out, SbRect rect, bool with_section);
