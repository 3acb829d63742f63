// Force over time as the load cell reads it: played part thick, rest thin. The first peak is the
// static friction's, the mean of those that follow the thesis' dynamic one (3.4.3); the mean force
// stands beside it because peaks lie above it. Levels and peaks appear when the run has ended, for
// a peak is known by what follows it.
#include "app/chart/signal.h"
#include "app/base/format.h"
#include "app/draw/label.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>

typedef struct {
  SbCanvas canvas;
  SbRect plot;
  SbScale x, y; // s, N
  SbTicks x_ticks, y_ticks;
  SbLabels *labels;
  const SbChartData *data;
} View;

static void lay_out(View *v, SbRect rect, unsigned flags) {
  bool compact = flags & SB_CHART_COMPACT;
  double pad = flags & SB_CHART_PANEL ? SB_GRID_PADDING : 0;
  SbRect in = {rect.x + pad, rect.y + pad, rect.width - 2 * pad, rect.height - 2 * pad};
  const SbChartRun *run = &v->data->run;
  const SbModel *m = run->model;
  SbTraceRange range = {0};
  if (run->trace && run->count > 0) {
    range = sb_trace_range(run->trace);
  }
  double lo = fmin(range.force_min, 0), hi = range.force_max;
  double last = fmax(range.time_max, m ? sb_model_rig(m)->duration : 0);
  if (!(hi > lo)) {
    hi = m ? sb_model_rig(m)->load : 1;
  }
  int wanted = in.height > 420 ? 8 : in.height > 240 ? 6 : 4;
  // Room above the highest peak for its label.
  hi += 0.1 * (hi - lo);
  sb_axis_round_out(&lo, &hi, wanted);
  sb_axis_ticks(&v->y_ticks, lo, hi, wanted);
  double left = compact ? 44 : 48, top = compact ? 48 : 95, bottom = 40;
  v->plot = (SbRect){in.x + left, in.y + top, fmax(in.width - left - 12, 40),
                     fmax(in.height - top - bottom, 40)};
  v->x = (SbScale){0, last > 0 ? last : 1, v->plot.x, v->plot.x + v->plot.width, false};
  v->y = (SbScale){lo, hi, v->plot.y + v->plot.height, v->plot.y, false};
  sb_axis_ticks(&v->x_ticks, 0, v->x.hi, v->plot.width > 300 ? 8 : 5);
}

static void draw_axes(View *v, SbRect rect, unsigned flags) {
  SbCanvas *c = &v->canvas;
  bool compact = flags & SB_CHART_COMPACT;
  double pad = flags & SB_CHART_PANEL ? SB_GRID_PADDING : 0;
  SbTextStyle title =
      sb_canvas_style(c, compact ? SB_TYPE_PANEL_WINDOW : SB_TYPE_PANEL, 700, SB_ROLE_INK);
  SbTextStyle label = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  double left = v->plot.x, right = left + v->plot.width, bottom = v->plot.y + v->plot.height;
  sb_canvas_text_fit(c, _("Thread force and time"), &title, rect.x + pad, rect.y + pad + 14,
                     rect.width - 2 * pad);
  const SbModel *m = v->data->run.model;
  if (!compact && m) {
    char load[SB_FORMAT_MAX], speed[SB_FORMAT_MAX], note[160];
    g_snprintf(
        note, sizeof note, _("load %s on %d rings, thread wound up at %s, %.0f samples a second"),
        sb_format_given(load, SB_QUANTITY_FORCE, sb_model_rig(m)->load), SB_RIG_RINGS,
        sb_format_given(speed, SB_QUANTITY_SPEED, sb_model_rig(m)->speed), sb_model_rig(m)->rate);
    sb_canvas_text_fit(c, note, &label, rect.x + pad, rect.y + pad + 34, rect.width - 2 * pad);
  }
  sb_canvas_text(c, _("force in the thread / N"), &label, rect.x + pad,
                 rect.y + pad + (compact ? 34 : 64), SB_LEFT);
  sb_axis_draw(c, v->plot, &v->x, &v->x_ticks, &v->y, &v->y_ticks);
  sb_canvas_hairline(c, left, bottom, right, bottom, sb_canvas_role(c, SB_ROLE_AXIS));
  sb_canvas_text(c, _("time / s"), &label, right, bottom + 36, SB_RIGHT);
}

static SbPoint at(const View *v, double time, double force) {
  return (SbPoint){sb_axis_at(&v->x, time), sb_axis_at(&v->y, force)};
}

static void draw_curve(View *v, bool whole) {
  const SbChartRun *run = &v->data->run;
  SbCanvas *c = &v->canvas;
  size_t n;
  const SbTracePoint *p = sb_trace_points(run->trace, &n);
  if (n == 0) {
    return;
  }
  const SbFrame *now = whole ? NULL : sb_chart_frame(v->data);
  size_t limit = MIN(run->count, sb_trace_frames(run->trace));
  size_t frame = MIN(v->data->playhead, limit - 1);
  size_t split = now ? MIN(sb_trace_find(run->trace, frame), n - 1) : n - 1;
  g_autofree SbPoint *q = g_new(SbPoint, n + 1);
  for (size_t i = 0; i < n; i++) {
    q[i] = at(v, p[i].time, p[i].force);
  }
  SbColor ink = sb_canvas_role(c, SB_ROLE_INK);
  sb_labels_avoid(v->labels, q, n, 1);
  if (now) {
    sb_canvas_pen(c, 1.2, NULL);
    sb_canvas_color(c, ink, SB_OPACITY_FUTURE);
    sb_canvas_polyline(c, q, n);
    q[split + 1] = at(v, now->time, now->force);
  }
  // A saw of many teeth would close up under the thick line.
  sb_canvas_pen(c, v->plot.width > 600 ? 1.8 : 1.4, NULL);
  sb_canvas_color(c, ink, 1);
  sb_canvas_polyline(c, q, now ? split + 2 : n);
}

// A dashed level over the part of the record that it is the mean of.
static void draw_level(View *v, double force, double from, const SbDash *dash, SbColor color) {
  SbCanvas *c = &v->canvas;
  double y = floor(sb_axis_at(&v->y, force)) + 0.5;
  SbPoint line[2] = {{sb_axis_at(&v->x, from), y}, {v->plot.x + v->plot.width, y}};
  sb_canvas_pen(c, 1.6, dash);
  sb_canvas_color(c, color, 1);
  cairo_move_to(c->cr, line[0].x, y);
  cairo_line_to(c->cr, line[1].x, y);
  cairo_stroke(c->cr);
}

static void place(View *v, const char *text, SbColor color, const SbPlace *places, int count) {
  SbTextStyle style = {SB_TYPE_LABEL, 600, color, 1};
  SbPlace chosen;
  if (sb_labels_place(v->labels, &v->canvas, text, &style, places, count, &chosen)) {
    sb_labels_draw(v->labels, &v->canvas, text, &style, &chosen);
  }
}

static void draw_peaks(View *v) {
  const SbChartRun *run = &v->data->run;
  const SbSummary *s = run->summary;
  if (!s || !s->rig.found || !sb_chart_complete(v->data)) {
    return;
  }
  SbCanvas *c = &v->canvas;
  const SbRigCoefficients *of = &s->rig.of;
  SbColor outer = sb_canvas_role(c, SB_ROLE_OUTER), fluid = sb_canvas_role(c, SB_ROLE_FLUID);
  double load = sb_model_rig(run->model)->load;
  draw_level(v, of->mean_coefficient * load, of->first_time, &sb_dash_dimension, fluid);
  if (of->stick_slip) {
    draw_level(v, of->dynamic_coefficient * load, of->first_time, &sb_dash_reference, outer);
  }
  size_t n;
  const SbTracePoint *peak = sb_trace_peaks(run->trace, &n);
  bool dense = (double)n * 9 > v->plot.width;
  for (size_t i = 1; i < n; i++) {
    SbPoint p = at(v, peak[i].time, peak[i].force);
    sb_canvas_dot(c, p.x, p.y, dense ? 1.8 : 3, outer);
  }
  char force[SB_FORMAT_MAX], number[SB_FORMAT_MAX], text[160];
  if (n > 0) {
    SbPoint p = at(v, peak[0].time, peak[0].force);
    sb_canvas_ringed_dot(c, p.x, p.y, sb_canvas_role(c, SB_ROLE_INK));
    sb_labels_block(v->labels, (SbRect){p.x - 5, p.y - 5, 10, 10});
    g_snprintf(text, sizeof text, _("B  first peak %s, static %s"),
               sb_format_text(force, SB_QUANTITY_FORCE, of->first_peak, s->error_force),
               sb_format_digits(number, of->static_coefficient, 3));
    place(v, text, sb_canvas_role(c, SB_ROLE_INK),
          (SbPlace[]){{p.x + 11, p.y + 4, SB_LEFT}, {p.x + 11, p.y - 8, SB_LEFT}}, 2);
  }
  double end = v->plot.x + v->plot.width - 4;
  double low = 0, high = 0;
  if (of->stick_slip) {
    high = sb_axis_at(&v->y, of->dynamic_coefficient * load);
    g_snprintf(
        text, sizeof text, _("mean of %zu peaks %s, dynamic %s"), of->peaks,
        sb_format_text(force, SB_QUANTITY_FORCE, of->dynamic_coefficient * load, s->error_force),
        sb_format_digits(number, of->dynamic_coefficient, 3));
    place(v, text, outer, (SbPlace[]){{end, high - 10, SB_RIGHT}, {end, high - 26, SB_RIGHT}}, 2);
  }
  // Below the teeth of the saw.
  SbTraceRange range = sb_trace_range(run->trace);
  low = sb_axis_at(&v->y, fmin(of->mean_coefficient * load, range.force_max));
  g_snprintf(text, sizeof text, _("mean force %s, over load %s"),
             sb_format_text(force, SB_QUANTITY_FORCE, of->mean_coefficient * load, s->error_force),
             sb_format_digits(number, of->mean_coefficient, 3));
  double below = of->stick_slip ? low + (low - high) : low;
  place(v, text, fluid,
        (SbPlace[]){{end, below + 20, SB_RIGHT},
                    {end, below + 36, SB_RIGHT},
                    {end, below + 52, SB_RIGHT},
                    {end, low + 70, SB_RIGHT}},
        4);
}

static void draw_now(View *v, bool line) {
  const SbFrame *frame = sb_chart_frame(v->data);
  SbCanvas *c = &v->canvas;
  SbPoint p = at(v, frame->time, frame->force);
  SbColor now = sb_canvas_role(c, SB_ROLE_NOW);
  if (line) {
    sb_canvas_pen(c, 1, &sb_dash_now);
    sb_canvas_color(c, now, 1);
    cairo_move_to(c->cr, p.x, p.y);
    cairo_line_to(c->cr, p.x, v->plot.y + v->plot.height);
    cairo_stroke(c->cr);
    return;
  }
  sb_canvas_dot(c, p.x, p.y, 8, sb_canvas_role(c, SB_ROLE_PANEL));
  sb_canvas_dot(c, p.x, p.y, 6, now);
}

void sb_signal_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                    unsigned flags) {
  View v = {.data = data};
  SbCanvas *c = &v.canvas;
  sb_canvas_init(c, cr, theme);
  lay_out(&v, rect, flags);
  if (flags & SB_CHART_PANEL) {
    sb_canvas_panel(c, rect);
  }
  draw_axes(&v, rect, flags);
  const SbChartRun *run = &data->run;
  if (run->count > 0 && run->trace && sb_trace_frames(run->trace) > 0) {
    v.labels = g_new(SbLabels, 1);
    sb_labels_init(v.labels, (SbRect){v.plot.x, v.plot.y - 12, v.plot.width, v.plot.height + 12});
    bool whole = flags & SB_CHART_WHOLE || !sb_chart_frame(data);
    if (!whole) {
      draw_now(&v, true);
    }
    draw_curve(&v, whole);
    draw_peaks(&v);
    if (!whole) {
      draw_now(&v, false);
    }
    g_free(v.labels);
  } else {
    SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
    sb_canvas_text_halo(
        c, run->state == SB_CHART_RUNNING ? _("The run has begun.") : _("No run yet."), &style,
        v.plot.x + 0.5 * v.plot.width, v.plot.y + 0.5 * v.plot.height, SB_MIDDLE);
  }
  sb_canvas_finish(c);
}

bool sb_signal_hit(size_t *frame, SbRect rect, const SbChartData *data, unsigned flags, double x,
                   double y) {
  View v = {.data = data};
  lay_out(&v, rect, flags);
  const SbChartRun *run = &data->run;
  bool inside = x >= v.plot.x - 8 && x <= v.plot.x + v.plot.width + 8 && y >= v.plot.y - 8 &&
                y <= v.plot.y + v.plot.height + 8;
  if (run->count == 0 || !inside) {
    return false;
  }
  *frame = sb_chart_nearest(run, sb_axis_value(&v.x, x));
  return true;
}
