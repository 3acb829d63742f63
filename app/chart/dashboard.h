// Everything about one frame on one page: section, loop, profiles, timeline, key figures, footer.
#pragma once

#include "app/base/canvas.h"
#include "app/chart/data.h"

// Draws the section (with its insets, legends and scale bars) into its panel's rectangle, ground
// and hairline included by the caller of this function.
typedef void (*SbSectionDraw)(cairo_t *cr, SbRect rect, const SbTheme *theme,
                              const SbChartData *data, void *user);

// Made for 1920 x 1080; other sizes scale the whole page, down to 3/4, and below that shrink the
// panels instead so that text stays readable. `section` may be NULL: then the loop takes its place.
void sb_dashboard_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                       unsigned flags, SbSectionDraw section, void *user);

// Where the page puts its parts, in pixels of `rect` divided by `scale`.
typedef struct {
  double scale;
  SbRect page, section, loop, pressure, film, timeline;
} SbDashboardLayout;

void sb_dashboard_layout(SbDashboardLayout *out, SbRect rect, bool with_section);
