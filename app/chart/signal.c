// Force over time as the load cell reads it: played part thick, rest thin. The first peak is the
// static friction's, the mean of those that follow the thesis' dynamic one (3.4.3); the mean force
// stands beside it because peaks lie above it. Levels and peaks appear when the run has ended, for
// a peak is known by what follows it.
#include "app/chart/signal.h"
#include "app/base/format.h"
#include "app/draw/label.h"

#include "app/draw/cursor.h"
#include "app/draw/frame.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>

typedef struct {
  SbCanvas canvas;
  SbAxes at; // s, N
  SbLabels *labels;
  const SbChartData *data;
} View;

static void lay_signal_out(View *v, SbRect rect, unsigned flags) {
  bool compact = flags & SB_CHART_COMPACT;
  const SbRect in = sb_frame_inner(rect, flags & SB_CHART_PANEL);
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
  const double left = compact ? 44 : 48, top = compact ? 48 : 95, bottom = 40;
  const SbRect plot = {in.x + left, in.y + top, fmax(in.width - left - 12, 40),
                       fmax(in.height - top - bottom, 40)};
  v->at = (SbAxes){.x_name = _("time / s")};
  sb_axes_linear(&v->at, plot, 0, last > 0 ? last : 1, lo, hi);
  sb_axes_ticks(&v->at, plot.width > 300 ? 8 : 5, wanted);
}

static void draw_signal_head(View *v, SbRect in, bool compact) {
  char load[SB_FORMAT_MAX], speed[SB_FORMAT_MAX], note[160] = "";
  const SbModel *m = v->data->run.model;
  if (m) {
    g_snprintf(
        note, sizeof note, _("load %s on %d rings, thread wound up at %s, %.0f samples a second"),
        sb_format_given(load, SB_QUANTITY_FORCE, sb_model_rig(m)->load), SB_RIG_RINGS,
        sb_format_given(speed, SB_QUANTITY_SPEED, sb_model_rig(m)->speed), sb_model_rig(m)->rate);
  }
  sb_frame_head(&v->canvas, in, compact, _("Thread force and time"), note,
                _("force in the thread / N"));
}

static SbPoint at(const View *v, double time, double force) {
  return sb_axes_at(&v->at, time, force);
}

static void draw_signal_curve(View *v, bool whole) {
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
  sb_canvas_pen(c, v->at.plot.width > 600 ? 1.8 : 1.4, NULL);
  sb_canvas_color(c, ink, 1);
  sb_canvas_polyline(c, q, now ? split + 2 : n);
}

// A dashed level over the part of the record that it is the mean of.
static void draw_signal_level(View *v, double force, double from, const SbDash *dash, SbRole role) {
  const double y = floor(sb_axis_at(&v->at.y, force)) + 0.5;
  sb_canvas_line(&v->canvas, (SbStroke){role, 1.6, dash}, sb_axis_at(&v->at.x, from), y,
                 v->at.plot.x + v->at.plot.width, y);
}

static void place(View *v, const char *text, SbColor color, const SbPlace *places, int count) {
  const SbTextStyle style = {SB_TYPE_LABEL, 600, color, 1};
  sb_labels_put(v->labels, &v->canvas, text, &style, places, count);
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
  draw_signal_level(v, of->mean_coefficient * load, of->first_time, &sb_dash_dimension,
                    SB_ROLE_FLUID);
  if (of->stick_slip) {
    draw_signal_level(v, of->dynamic_coefficient * load, of->first_time, &sb_dash_reference,
                      SB_ROLE_OUTER);
  }
  size_t n;
  const SbTracePoint *peak = sb_trace_peaks(run->trace, &n);
  bool dense = (double)n * 9 > v->at.plot.width;
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
  double end = v->at.plot.x + v->at.plot.width - 4;
  double low = 0, high = 0;
  if (of->stick_slip) {
    high = sb_axis_at(&v->at.y, of->dynamic_coefficient * load);
    g_snprintf(
        text, sizeof text, _("mean of %zu peaks %s, dynamic %s"), of->peaks,
        sb_format_text(force, SB_QUANTITY_FORCE, of->dynamic_coefficient * load, s->error_force),
        sb_format_digits(number, of->dynamic_coefficient, 3));
    place(v, text, outer, (SbPlace[]){{end, high - 10, SB_RIGHT}, {end, high - 26, SB_RIGHT}}, 2);
  }
  // Below the teeth of the saw.
  SbTraceRange range = sb_trace_range(run->trace);
  low = sb_axis_at(&v->at.y, fmin(of->mean_coefficient * load, range.force_max));
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

void sb_signal_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                    unsigned flags) {
  View v = {.data = data};
  SbCanvas *c = &v.canvas;
  sb_canvas_init(c, cr, theme);
  lay_signal_out(&v, rect, flags);
  draw_signal_head(&v, sb_frame_begin(c, rect, flags & SB_CHART_PANEL), flags & SB_CHART_COMPACT);
  sb_axes_draw(c, &v.at, NULL);
  const SbChartRun *run = &data->run;
  if (run->count > 0 && run->trace && sb_trace_frames(run->trace) > 0) {
    v.labels = g_new(SbLabels, 1);
    sb_labels_init(v.labels,
                   (SbRect){v.at.plot.x, v.at.plot.y - 12, v.at.plot.width, v.at.plot.height + 12});
    bool whole = flags & SB_CHART_WHOLE || !sb_chart_frame(data);
    const SbFrame *frame = sb_chart_frame(data);
    const SbPoint now = frame != NULL ? at(&v, frame->time, frame->force) : (SbPoint){0, 0};
    if (!whole) {
      sb_cursor_drop(c, now, v.at.plot.y + v.at.plot.height);
    }
    draw_signal_curve(&v, whole);
    draw_peaks(&v);
    if (!whole) {
      sb_cursor_now(c, now);
    }
    g_free(v.labels);
  } else {
    SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
    sb_canvas_text_halo(
        c, run->state == SB_CHART_RUNNING ? _("The run has begun.") : _("No run yet."), &style,
        v.at.plot.x + 0.5 * v.at.plot.width, v.at.plot.y + 0.5 * v.at.plot.height, SB_MIDDLE);
  }
  sb_canvas_finish(c);
}

bool sb_signal_hit(size_t *frame, SbRect rect, const SbChartData *data, unsigned flags, double x,
                   double y) {
  View v = {.data = data};
  lay_signal_out(&v, rect, flags);
  const SbChartRun *run = &data->run;
  if (run->count == 0 || !sb_axes_inside(&v.at, x, y, 8)) {
    return false;
  }
  *frame = sb_chart_nearest(run, sb_axis_value(&v.at.x, x));
  return true;
}
