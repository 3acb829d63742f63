// A can on the shelf over time: what is lost by each path, the rate and the temperature, the water
// taken in, the doses left; below, the paths' shares.
#pragma once

#include "app/base/canvas.h"
#include "app/chart/data.h"

// Draws the panels into `rect`, each on a ground of its own; nothing without a history. Figures
// that are typical of a rubber and no measurement are said so at the foot.
void sb_shelf_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data);

// The history as tab-separated lines with a heading. Owned by the caller (g_free).
char *sb_shelf_text(const SbShelf *shelf);
