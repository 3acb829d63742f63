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

// What a panel shows under a point of it.
typedef struct {
  int seal;        // SB_OUTER, SB_INNER
  double position; // in the seal's frame [m]
  double value;    // pressure above the lower fluid's [Pa], or film thickness [m]
  SbRect plot;     // of that seal
  SbPoint at;      // the pixel of the value
} SbProfileReading;

// Reads the panel of the films (`film`) or of the pressures at a pixel; false where there is no
// curve.
bool sb_profiles_read(SbProfileReading *out, SbRect rect, const SbChartData *data, unsigned flags,
                      bool film, double x, double y);

// "0.210 mm  1.18 MPa". Owned by the caller.
char *sb_profiles_cursor_text(const SbProfileReading *reading, const SbChartData *data, bool film);

// Draws a reading over the finished panel.
void sb_profiles_cursor_draw(cairo_t *cr, const SbTheme *theme, const SbChartData *data,
                             const SbProfileReading *reading, bool film);

// Film thinner than this is a formal result: a few molecules [m].
#define SB_CONTINUUM_LIMIT 2e-9
