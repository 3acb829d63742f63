// What was measured on the hysteresis chart: its rows as dots, of several cycles the band between
// their least and greatest force, and below the loop a strip of measured less computed at equal
// displacement, filled on the way in, open on the way back, on the band that holds 95 % of the
// noise. No more than some hundred rows are drawn, evenly taken and not smoothed.
#include "app/chart/hysteresis_private.h"

#include "app/base/format.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>

enum { DOTS = 360 };

void sb_hysteresis_measured_range(const SbComparison *measured, double *x1, double *y0,
                                  double *y1) {
  for (size_t i = 0; i < measured->count; i++) {
    *x1 = fmax(*x1, 1e3 * measured->point[i].displacement);
    *y0 = fmin(*y0, measured->point[i].force);
    *y1 = fmax(*y1, measured->point[i].force);
  }
}

// Number `k` of the points that are drawn: by the golden ratio, or even steps would fall on the
// same places of every cycle.
static size_t drawn(const SbComparison *measured, size_t k) {
  const double share = measured->count > DOTS ? fmod((double)(k + 1) * 0.6180339887498949, 1)
                                              : (double)k / (double)measured->count;
  return MIN((size_t)(share * (double)measured->count), measured->count - 1);
}

static void draw_dot(SbCanvas *c, SbPoint at, bool open) {
  sb_canvas_dot(c, at.x, at.y, 1.95, sb_canvas_role(c, open ? SB_ROLE_OCHRE : SB_ROLE_INK));
  sb_canvas_dot(c, at.x, at.y, 1.25, sb_canvas_role(c, open ? SB_ROLE_PANEL : SB_ROLE_OCHRE));
}

static void draw_band(SbHysteresisView *v) {
  const SbComparison *m = v->data->measured;
  SbCanvas *c = &v->canvas;
  SbPoint outline[2 * SB_MEASURED_BAND];
  for (int way = 0; way < 2; way++) {
    size_t count = 0;
    for (int side = 0; side < 2; side++) {
      for (int i = 0; i < SB_MEASURED_BAND; i++) {
        const int bin = side == 0 ? i : SB_MEASURED_BAND - 1 - i;
        const double force = m->band.force[way][bin][side];
        if (isfinite(force)) {
          outline[count++] =
              sb_hysteresis_pixel(&v->at, (bin + 0.5) / SB_MEASURED_BAND * m->band.end, force);
        }
      }
    }
    if (count > 2) {
      cairo_new_path(c->cr);
      sb_canvas_path(c, outline, count);
      cairo_close_path(c->cr);
      sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_OCHRE), 0.25);
      cairo_fill(c->cr);
    }
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
  draw_dot(c, (SbPoint){right - sb_canvas_text_width(c, text, &style) - 9, y - 4}, false);
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
  double most = fmax(m->most, 1e-3);
  double low = -most;
  sb_axis_round_out(&low, &most, 3);
  SbTicks ticks;
  sb_axis_ticks(&ticks, low, most, 3);
  const SbScale y = {low, most, strip.y + strip.height, strip.y, false};
  const SbTicks none = {0};
  sb_axis_draw(c, strip, &v->at.x, &none, &y, &ticks);
  if (isfinite(m->measured->noise)) {
    const double by = fmin(1.96 * m->measured->noise, most);
    cairo_rectangle(c->cr, strip.x, sb_axis_at(&y, by), strip.width,
                    sb_axis_at(&y, -by) - sb_axis_at(&y, by));
    sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_OCHRE), 0.14);
    cairo_fill(c->cr);
  }
  const double zero = sb_axis_at(&y, 0);
  sb_canvas_hairline(c, strip.x, zero, strip.x + strip.width, zero,
                     sb_canvas_role(c, SB_ROLE_AXIS));
  for (size_t k = 0; k < MIN(m->count, DOTS); k++) {
    const size_t i = drawn(m, k);
    if (isfinite(m->residual[i])) {
      const SbPoint at = {sb_axis_at(&v->at.x, 1e3 * m->point[i].displacement),
                          sb_axis_at(&y, m->residual[i])};
      draw_dot(c, at, m->point[i].way == 1);
    }
  }
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
  if (m->band.end > 0) {
    draw_band(v);
  }
  for (size_t k = 0; k < MIN(m->count, DOTS); k++) {
    const size_t i = drawn(m, k);
    draw_dot(&v->canvas, sb_hysteresis_pixel(&v->at, m->point[i].displacement, m->point[i].force),
             false);
  }
  draw_legend(v, in);
  draw_strip(v);
}
