// A life against its actuations: forces, film divided by roughness, leakage.
#pragma once

#include "app/chart/data.h"
#include "app/draw/canvas.h"

// Draws the panels of data->run.life into `rect`, each with its own background; nothing without
// actuations.
void sb_life_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data);
