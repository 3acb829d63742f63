// A read-out on the loop: a line at a displacement, a dot where it crosses either way, and the
// forces there. Drawn over the finished chart, so that a pointer that moves costs little.
#include "app/base/format.h"
#include "app/chart/hysteresis_private.h"
#include "app/draw/cursor.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>

// The straight piece between two points of the trace that crosses it, of each way the longest that
// does: a rebound of a hair's breadth is no way of its own.
void sb_hysteresis_forces(double out[2], const SbChartRun *run, double displacement) {
  size_t count = 0;
  const SbTracePoint *p = run->trace != NULL ? sb_trace_points(run->trace, &count) : NULL;
  double longest[2] = {0, 0};
  out[0] = out[1] = NAN;
  for (size_t i = 1; i < count; i++) {
    const double from = p[i - 1].displacement, to = p[i].displacement;
    const double share = (displacement - from) / (to - from);
    const int way = to < from;
    if (share >= 0 && share <= 1 && fabs(to - from) > longest[way]) {
      longest[way] = fabs(to - from);
      out[way] = p[i - 1].force + share * (p[i].force - p[i - 1].force);
    }
  }
}

char *sb_hysteresis_cursor_text(const SbChartRun *run, double displacement) {
  double force[2];
  char at[SB_FORMAT_MAX], text[2][SB_FORMAT_MAX];
  sb_hysteresis_forces(force, run, displacement);
  sb_format_fixed(at, displacement * 1e3, 2);
  for (int way = 0; way < 2; way++) {
    sb_format_text(text[way], SB_QUANTITY_FORCE, force[way], sb_chart_error_force(run));
  }
  return isnan(force[0]) && isnan(force[1]) ? g_strdup_printf("%s\u00a0mm", at)
         : isnan(force[1])                  ? g_strdup_printf(_("%s\u00a0mm  in %s"), at, text[0])
         : isnan(force[0])                  ? g_strdup_printf(_("%s\u00a0mm  back %s"), at, text[1])
                           : g_strdup_printf(_("%s\u00a0mm  in %s  back %s"), at, text[0], text[1]);
}

bool sb_hysteresis_cursor(double *displacement, SbRect rect, const SbChartData *data,
                          unsigned flags, double x, double y) {
  SbAxes at;
  sb_hysteresis_layout(&at, rect, data, flags);
  *displacement = 1e-3 * sb_axis_value(&at.x, x);
  return data->run.count > 0 && sb_axes_inside(&at, x, y, 0);
}

void sb_hysteresis_cursor_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                               const SbChartData *data, unsigned flags, double displacement) {
  SbAxes at;
  double force[2];
  sb_hysteresis_layout(&at, rect, data, flags);
  sb_hysteresis_forces(force, &data->run, displacement);
  for (int way = 0; way < 2; way++) {
    const double y = sb_axis_at(&at.y, force[way]);
    const bool inside = force[way] >= at.y.lo && force[way] <= at.y.hi;
    force[way] = inside ? y : NAN; // the pixel now
  }
  g_autofree char *text = sb_hysteresis_cursor_text(&data->run, displacement);
  sb_cursor_draw(cr, theme, at.plot, rect, sb_axis_at(&at.x, displacement * 1e3), force, 2, text);
}
