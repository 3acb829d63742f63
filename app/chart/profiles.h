// Contact pressure and film thickness over each seal's contact at one frame, as small multiples
// with shared scales that hold for the whole run.
#pragma once

#include "app/base/canvas.h"
#include "app/chart/data.h"

// Both panels: side by side in a wide rectangle, one above the other in a tall one.
void sb_profiles_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                      unsigned flags);

// Each panel alone.
void sb_profiles_pressure_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                               const SbChartData *data, unsigned flags);
void sb_profiles_film_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                           unsigned flags);

// Film thinner than this is a formal result: a few molecules [m].
#define SB_CONTINUUM_LIMIT 2e-9
