// The read-out of the contacts' panels (profiles.h).
#include "app/base/format.h"
#include "app/chart/profiles.h"
#include "app/draw/cursor.h"

#include <glib.h>

char *sb_profiles_cursor_text(const SbProfileReading *reading, const SbChartData *data, bool film) {
  char position[SB_FORMAT_MAX], value[SB_FORMAT_MAX];
  const double error = film ? sb_chart_error_film(&data->run) : sb_chart_error_load(&data->run);
  sb_format_fixed(position, 1e3 * reading->position, 3);
  sb_format_text(value, film ? SB_QUANTITY_FILM : SB_QUANTITY_PRESSURE, reading->value, error);
  return g_strdup_printf("%s\u00a0mm  %s", position, value);
}

void sb_profiles_cursor_draw(cairo_t *cr, const SbTheme *theme, const SbChartData *data,
                             const SbProfileReading *reading, bool film) {
  g_autofree char *text = sb_profiles_cursor_text(reading, data, film);
  const SbRect plot = reading->plot;
  const SbRect bounds = {plot.x - 30, plot.y, plot.width + 40, plot.height};
  sb_cursor_draw(cr, theme, plot, bounds, reading->at.x, &reading->at.y, 1, text);
}
