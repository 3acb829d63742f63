// The sliding-plate rig: its coefficients compared with the thesis, and the plate itself. All
// functions draw the live run of `data` into `rect` [px]; `flags` of SB_CHART_PANEL, ... (data.h).
#pragma once

#include "app/chart/data.h"
#include "app/draw/canvas.h"

// Draws the coefficients on one scale, those of the run and those of thesis table 7.8, and the
// reasons for the differences.
void sb_rig_figures_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                         unsigned flags);

// Draws only the scale.
void sb_rig_scale_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                       unsigned flags);

// Draws only the reasons.
void sb_rig_reasons_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                         unsigned flags);

// Draws the plate on its rings at the playhead, the thread and its motor; only the displacement is
// to scale.
void sb_rig_plate_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                       unsigned flags);

// Draws the page: signal, scale and reasons.
void sb_rig_page_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                      unsigned flags);

// Returns the reasons as sentences, one a line, with the figures of this run.
char *sb_rig_reasons_text(const SbChartRun *run);
