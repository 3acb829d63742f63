// A life against its actuations: forces, film divided by roughness, leakage.
#pragma once

#include "app/base/canvas.h"
#include "app/chart/data.h"

// Draws the panels of data->run.life into `rect`, each with its own background; nothing without
// actuations.
void sb_life_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data);
