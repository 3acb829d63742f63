// Measured rows on the hysteresis chart: dots, the band of several cycles, and below the loop the
// strip of residuals at equal displacement.
#include "app/chart/hysteresis_private.h"
#include "app/chart/measured_loop.h"

#include "app/base/format.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>

void sb_hysteresis_measured_range(const SbComparison *measured, double *x1, double *y0,
                                  double *y1) {
  for (size_t i = 0; i < measured->count; i++) {
    *x1 = fmax(*x1, 1e3 * measured->point[i].displacement);
    *y0 = fmin(*y0, measured->point[i].force);
    *y1 = fmax(*y1, measured->point[i].force);
  }
}

static void draw_legend(SbHysteresisView *v, SbRect in) {
  const SbComparison *m = v->data->measured;
  SbCanvas *c = &v->canvas;
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_INK);
  g_autofree char *text =
      m->measured->last > m->measured->first
          ? g_strdup_printf(ngettext("measured, %zu cycle", "measured, %zu cycles",
                                     m->measured->last - m->measured->first + 1),
                            m->measured->last - m->measured->first + 1)
          : g_strdup(_("measured"));
  const double right = in.x + in.width, y = in.y + (v->flags & SB_CHART_COMPACT ? 34 : 64);
  sb_canvas_text(c, text, &style, right, y, SB_RIGHT);
  sb_measured_loop_dot(c, (SbPoint){right - sb_canvas_text_width(c, text, &style) - 9, y - 4},
                       false);
}

// Measured less model, under the loop.
static void draw_strip(SbHysteresisView *v) {
  const SbComparison *m = v->data->measured;
  const bool compact = v->flags & SB_CHART_COMPACT;
  SbCanvas *c = &v->canvas;
  const SbRect plot = v->at.plot;
  const double top = plot.y + plot.height + 68;
  const SbRect strip = {plot.x, top, plot.width,
                        (compact ? SB_HYSTERESIS_STRIP_COMPACT : SB_HYSTERESIS_STRIP) - 40};
  sb_measured_loop_residuals(c, strip, &v->at, false, m, fmax(m->most, 1e-3), 3);
  const SbTextStyle label = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  const SbTextStyle strong = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_INK);
  char digits[SB_FORMAT_MAX];
  g_autofree char *rms = isfinite(m->rms)
                             ? g_strdup_printf(_("rms %s N"), sb_format_digits(digits, m->rms, 3))
                             : g_strdup(_("no point to compare with the model"));
  sb_canvas_text_fit(c,
                     compact ? _("measured \xe2\x88\x92 model / N")
                             : _("measured \xe2\x88\x92 model / N; filled in-stroke, open return"),
                     &label, strip.x, top - 10, strip.width - 90);
  sb_canvas_text(c, rms, &strong, strip.x + strip.width, top - 10, SB_RIGHT);
}

void sb_hysteresis_measured(SbHysteresisView *v, SbRect in) {
  const SbComparison *m = v->data->measured;
  sb_measured_loop_band(&v->canvas, &v->at, &m->band, SB_ROLE_OCHRE, 0.25);
  sb_measured_loop_points(&v->canvas, &v->at, m);
  draw_legend(v, in);
  draw_strip(v);
}
