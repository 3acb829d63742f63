// A measured surface drawn: its heights as a map with their scale, or a profile's as a line.
#pragma once

#include "app/base/canvas.h"
#include "engine/contact/rough/heights.h"

// Draws into `rect` on a ground of its own; `sq` is the standard deviation of the heights [m],
// three of which fill the scale to either side. Pure.
void sb_surface_map_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbHeights *heights,
                         double sq);
