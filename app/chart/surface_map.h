// The picture of a measured surface: its heights as a map with a scale, or of a profile as a line.
#pragma once

#include "app/draw/canvas.h"
#include "engine/contact/rough/heights.h"

// Draws `heights` into `rect` [px] with its own background. `sq` is the standard deviation of the
// heights [m]; the scale is -3 sq to 3 sq.
void sb_surface_map_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbHeights *heights,
                         double sq);
