// The balance of forces on the stem, as a row of bars below the section.
#pragma once

#include "app/chart/data.h"
#include "app/draw/canvas.h"

// Height for which the row is designed [px].
#define SB_FORCE_BALANCE_HEIGHT 44.0

// Draws "Drive 22.5 N = pressure 14.5 N + outer 8.0 N" as bars with one scale into `rect` [px], for
// the frame at the playhead; nothing without a frame. `rect` has the height
// SB_FORCE_BALANCE_HEIGHT; in a higher one the row is centred, a lower one clips it.
void sb_force_balance_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data);
