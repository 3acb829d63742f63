// Contact pressure and film thickness of each seal's contact at the playhead, in panels with common
// scales that are constant over the run. Rectangles and points are in pixels of the picture;
// `flags` of SB_CHART_PANEL, ... (data.h).
#pragma once

#include "app/chart/data.h"
#include "app/draw/canvas.h"

// Draws both panels: next to each other in a wide rectangle, one above the other in a tall one.
void sb_profiles_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                      unsigned flags);

// Draws the panel of the contact pressures.
void sb_profiles_pressure_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                               const SbChartData *data, unsigned flags);

// Draws the panel of the films.
void sb_profiles_film_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                           unsigned flags);

// What a panel shows at a pixel.
typedef struct {
  int seal;        // SB_OUTER, SB_INNER
  double position; // in the seal's frame [m]
  double value;    // pressure above the lower fluid's [Pa], or film thickness [m]
  SbRect plot;     // of that seal
  SbPoint at;      // the pixel of the value
} SbProfileReading;

// Reads the panel of the films (`film`: sb_profiles_film_draw()) or of the pressures
// (sb_profiles_pressure_draw()), drawn with the same `rect`, `data` and `flags`, at the pixel
// (x, y). Returns false outside of the plots and where there is no curve.
bool sb_profiles_read(SbProfileReading *out, SbRect rect, const SbChartData *data, unsigned flags,
                      bool film, double x, double y);

// Returns a reading as text: "0.210 mm  1.18 MPa".
char *sb_profiles_cursor_text(const SbProfileReading *reading, const SbChartData *data, bool film);

// Draws a reading over the finished panel.
void sb_profiles_cursor_draw(cairo_t *cr, const SbTheme *theme, const SbChartData *data,
                             const SbProfileReading *reading, bool film);

// Below this thickness, a few molecules, a film is only a formal result [m].
#define SB_CONTINUUM_LIMIT 2e-9
