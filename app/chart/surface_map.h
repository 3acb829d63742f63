// The picture of a measured surface: its heights as a map with a scale, or of a profile as a line.
#pragma once

#include "app/draw/canvas.h"
#include "engine/contact/rough/heights.h"

// Draws `heights` into `rect` [px] with its own background: a line if it has one row. `sq` is the
// standard deviation of the heights [m], > 0; the map's colours are for -3 sq to 3 sq, the line's
// axis is -3.5 sq to 3.5 sq.
void sb_surface_map_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbHeights *heights,
                         double sq);
