// The sliding-plate rig: its figures beside the thesis', and the plate itself.
#pragma once

#include "app/base/canvas.h"
#include "app/chart/data.h"

// The coefficients on one scale, ours and those of thesis table 7.8, and in words why they differ.
void sb_rig_figures_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                         unsigned flags);

// The same in two parts for the window: the scale alone, the words alone.
void sb_rig_scale_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                       unsigned flags);
void sb_rig_reasons_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                         unsigned flags);

// The plate on its rings at the playhead, the thread and its motor; no scale but the
// displacement's.
void sb_rig_plate_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                       unsigned flags);

// The page of figures: signal, scale and reasons.
void sb_rig_page_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                      unsigned flags);

// The reasons as sentences, one a line, with this run's figures. Owned by the caller (g_free).
char *sb_rig_reasons_text(const SbChartRun *run);
