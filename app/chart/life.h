// A life over its actuations: forces, film over roughness, leakage.
#pragma once

#include "app/base/canvas.h"
#include "app/chart/data.h"

// Draws the panels into `rect`, each on a ground of its own.
void sb_life_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data);
