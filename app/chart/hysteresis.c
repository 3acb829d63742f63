// The hysteresis chart. Played part thick, rest thin; an earlier run or pinned ones behind; stages
// A to F as ringed dots with the force just before the event; labels placed by the collision rule,
// *now* first (hysteresis_labels.c). Displacement in mm, force in N, both from the frames. Leaves
// out any smoothing: lines join computed frames.
#include "app/base/format.h"
#include "app/chart/hysteresis_private.h"

#include "app/draw/frame.h"
#include "app/draw/legend.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

// Width of "D 22.5 N" beside its dot: inside the plot, and in the margin to its right [px].
#define LABEL_ROOM         56.0
#define LABEL_ROOM_OUTSIDE 12.0

static void include_run(const SbChartRun *run, double *x1, double *y0, double *y1) {
  if (!run || !run->trace || run->count == 0) {
    return;
  }
  SbTraceRange r = sb_trace_range(run->trace);
  *x1 = fmax(*x1, r.displacement_max * 1e3);
  *y0 = fmin(*y0, r.force_min);
  *y1 = fmax(*y1, r.force_max);
}

// Ranges of the full cycle from the first frame on, so that a growing loop does not jump:
// displacements up to *x1 [mm], forces from *y0 to *y1 [N].
static void range_of(const SbChartData *data, double *x1, double *y0, double *y1) {
  const SbModel *model = data->run.model;
  *x1 = model ? sb_model_value(model, SB_P_DRIVE_STROKE) * 1e3 : 1;
  *y0 = 0;
  *y1 = model ? fmax(sb_model_value(model, SB_P_DRIVE_REVERSAL_FORCE),
                     1.2 * sb_model_pressure_force(model))
              : 10;
  include_run(&data->run, x1, y0, y1);
  for (size_t i = 0; i < data->pin_count; i++) {
    include_run(data->pin[i].run, x1, y0, y1);
  }
  const SbChartCurve *loop = data->predicted != NULL ? &data->predicted->loop : NULL;
  for (size_t i = 0; loop != NULL && i < loop->count; i++) {
    *x1 = fmax(*x1, 1e3 * loop->displacement[i]);
    *y0 = fmin(*y0, loop->force[i]);
    *y1 = fmax(*y1, loop->force[i]);
  }
  if (data->measured != NULL) {
    sb_hysteresis_measured_range(data->measured, x1, y0, y1);
  }
  if (data->run.state == SB_CHART_RUNNING) {
    include_run(data->earlier, x1, y0, y1);
  }
}

void sb_hysteresis_layout(SbAxes *out, SbRect rect, const SbChartData *data, unsigned flags) {
  const bool compact = flags & SB_CHART_COMPACT;
  const SbRect in = sb_frame_inner(rect, flags & SB_CHART_PANEL);
  double x1, y0, y1;
  *out = (SbAxes){.x_name = _("stem displacement / mm")};
  range_of(data, &x1, &y0, &y1);
  if (y0 > -1e-3) {
    y0 = 0; // rounding noise below zero is no reason for a negative axis
  }
  int wanted_y = in.height > 420 ? 8 : in.height > 240 ? 6 : 4;
  double y_top = y1;
  sb_axis_round_out(&y0, &y_top, wanted_y);

  sb_axis_ticks(&out->y_ticks, y0, y_top, wanted_y);

  // Room to the left for the numbers, to the right of the stroke for the values of D and E; 18 px
  // left of zero for A.
  size_t longest = 0;
  for (int i = 0; i < out->y_ticks.count; i++) {
    char text[SB_FORMAT_MAX];
    sb_format_fixed(text, out->y_ticks.value[i], out->y_ticks.decimals);
    longest = MAX(longest, (size_t)g_utf8_strlen(text, -1));
  }
  double digits = 18 + 8 * (double)longest;
  const double left = compact ? fmax(digits, 44) : fmax(digits, 34);
  const double right = LABEL_ROOM_OUTSIDE, top = compact ? 48 : 95;
  const double strip = compact ? SB_HYSTERESIS_STRIP_COMPACT : SB_HYSTERESIS_STRIP;
  const double bottom = data->measured != NULL ? 40 + strip : 40;
  const SbRect plot = {in.x + left, in.y + top, fmax(in.width - left - right, 40),
                       fmax(in.height - top - bottom, 40)};
  double room_left = 18, room_right = fmin(LABEL_ROOM, 0.25 * plot.width);
  double per_px = x1 / fmax(plot.width - room_left - room_right, 20);
  sb_axes_linear(out, plot, -room_left * per_px, x1 + room_right * per_px, y0, y_top);
  const int wanted_x = plot.width > 300 ? 8 : 5;
  sb_axis_ticks(&out->x_ticks, 0, out->x.hi, wanted_x);
  if (data->zoom != NULL) {
    const SbChartZoom *zoom = data->zoom;
    sb_axes_linear(out, plot, zoom->x0, zoom->x1, zoom->y0, zoom->y1);
    sb_axes_ticks(out, wanted_x, wanted_y);
  }
}

bool sb_hysteresis_zoom(SbChartZoom *out, SbRect rect, const SbChartData *data, unsigned flags,
                        double factor, double x, double y) {
  SbChartData all = *data;
  SbAxes at, whole;
  all.zoom = NULL;
  sb_hysteresis_layout(&at, rect, data, flags);
  sb_hysteresis_layout(&whole, rect, &all, flags);
  // The point stays where it is; nothing beyond the whole plot is shown.
  const double px = sb_axis_value(&at.x, x), py = sb_axis_value(&at.y, y);
  const double width = fmin((at.x.hi - at.x.lo) / factor, whole.x.hi - whole.x.lo);
  const double height = fmin((at.y.hi - at.y.lo) / factor, whole.y.hi - whole.y.lo);
  const double least = 1.0 / SB_HYSTERESIS_ZOOM_MAX;
  if (width < least * (whole.x.hi - whole.x.lo) || height < least * (whole.y.hi - whole.y.lo)) {
    return data->zoom != NULL;
  }
  out->x0 = px - (px - at.x.lo) / (at.x.hi - at.x.lo) * width;
  out->y0 = py - (py - at.y.lo) / (at.y.hi - at.y.lo) * height;
  out->x0 = fmin(fmax(out->x0, whole.x.lo), whole.x.hi - width);
  out->y0 = fmin(fmax(out->y0, whole.y.lo), whole.y.hi - height);
  out->x1 = out->x0 + width;
  out->y1 = out->y0 + height;
  return width < (1 - 1e-9) * (whole.x.hi - whole.x.lo) ||
         height < (1 - 1e-9) * (whole.y.hi - whole.y.lo);
}

// Frames that may be drawn: the trace may lag behind the run, and no line is drawn over a gap.
static size_t drawable(const SbChartRun *run) {
  return run->trace ? MIN(run->count, sb_trace_frames(run->trace)) : 0;
}

SbPoint sb_hysteresis_pixel(const SbAxes *at, double displacement, double force) {
  return sb_axes_at(at, displacement * 1e3, force);
}

// Pixels of the trace's points from frame `first` to `last`, with the exact frames at both ends.
// Owned by the caller.
static SbPoint *trace_pixels(const SbAxes *at, const SbChartRun *run, size_t first, size_t last,
                             size_t *count) {
  size_t n = 0, total = 0;
  *count = 0;
  size_t limit = drawable(run);
  if (limit == 0 || first > last || first >= limit) {
    return NULL;
  }
  const SbTracePoint *p = sb_trace_points(run->trace, &total);
  last = MIN(last, limit - 1);
  SbPoint *out = g_new(SbPoint, total + 2);
  out[n++] = sb_hysteresis_pixel(at, run->frames[first].displacement, run->frames[first].force);
  for (size_t i = sb_trace_find(run->trace, first); i < total && p[i].frame < last; i++) {
    if (p[i].frame > first) {
      out[n++] = sb_hysteresis_pixel(at, p[i].displacement, p[i].force);
    }
  }
  if (last > first) {
    out[n++] = sb_hysteresis_pixel(at, run->frames[last].displacement, run->frames[last].force);
  }
  *count = n;
  return out;
}

// What is to be known of the run that is drawn; `several`: buffer of its text.
static const char *note_of(const SbChartData *data, unsigned flags, char *several, size_t size) {
  const SbModel *m = data->run.model;
  several[0] = '\0';
  if (m && sb_model_number(m, SB_P_LIFE_ACTUATIONS) > 1) {
    g_snprintf(several, size, _("actuations 1 and %d of %d, stages of the first"),
               sb_model_shown_actuation(m), sb_model_number(m, SB_P_LIFE_ACTUATIONS));
  } else if (m && sb_model_number(m, SB_P_DRIVE_CYCLES) > 1) {
    const int cycles = sb_model_number(m, SB_P_DRIVE_CYCLES);
    g_snprintf(several, size,
               ngettext("%d cycle, stages of the first", "%d cycles, stages of the first",
                        (unsigned long)cycles),
               cycles);
  }
  switch (data->run.state) {
  case SB_CHART_RUNNING:
    return data->earlier ? _("being computed; faint: the earlier run") : _("being computed");
  case SB_CHART_PARTIAL:
    return _("partial: the run was cancelled");
  case SB_CHART_FAILED:
    return _("up to the last good state");
  case SB_CHART_DONE:
    return several[0]               ? several
           : flags & SB_CHART_WHOLE ? _("one actuation, A to F")
                                    : _("thick line: played so far");
  default:
    return "";
  }
}

// Another run behind: in its look when it is a pin, faint when earlier (`pin` NULL).
static void draw_other(SbHysteresisView *v, const SbChartRun *run, const SbChartPin *pin) {
  size_t n;
  SbPoint *p = run && drawable(run) > 0 ? trace_pixels(&v->at, run, 0, run->count - 1, &n) : NULL;
  if (!p) {
    return;
  }
  SbCanvas *c = &v->canvas;
  if (pin != NULL) {
    sb_canvas_stroke(c, sb_chart_pin_stroke(pin->look));
  } else {
    sb_canvas_pen(c, SB_LINE_FUTURE, NULL);
    sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_INK), SB_OPACITY_EARLIER);
  }
  sb_canvas_polyline(c, p, n);
  sb_labels_avoid(v->labels, p, n, pin != NULL ? 0.7 : 0.4);
  g_free(p);
}

// The predicted loop of the present values, dashed, over the paler one of the former values.
static void draw_predicted(SbHysteresisView *v) {
  const SbChartCurve *curve = &v->data->predicted->loop;
  g_autofree SbPoint *p = g_new(SbPoint, curve->count);
  for (size_t i = 0; i < curve->count; i++) {
    p[i] = sb_hysteresis_pixel(&v->at, curve->displacement[i], curve->force[i]);
  }
  sb_canvas_curve(&v->canvas, (SbStroke){SB_ROLE_INK, SB_LINE_SEAL, &sb_dash_predicted}, p,
                  curve->count);
}

// The run itself: interior, future, played part.
static void draw_hysteresis_loop(SbHysteresisView *v) {
  const SbChartRun *run = &v->data->run;
  SbCanvas *c = &v->canvas;
  size_t n,
      now = v->flags & SB_CHART_WHOLE ? run->count - 1 : MIN(v->data->playhead, run->count - 1);
  SbPoint *all = trace_pixels(&v->at, run, 0, run->count - 1, &n);
  if (!all) {
    return;
  }
  if (sb_chart_complete(v->data)) {
    sb_canvas_area(c, all, n, SB_ROLE_INK, c->theme->loop_fill);
  }
  sb_labels_avoid(v->labels, all, n, 1);

  for (size_t i = 0; i < v->data->pin_count; i++) {
    draw_other(v, v->data->pin[i].run, &v->data->pin[i]);
  }

  size_t future;
  g_autofree SbPoint *rest = trace_pixels(&v->at, run, now, run->count - 1, &future);
  if (rest && future > 1) {
    sb_canvas_pen(c, SB_LINE_FUTURE, NULL);
    sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_INK), SB_OPACITY_FUTURE);
    sb_canvas_polyline(c, rest, future);
  }
  size_t played;
  g_autofree SbPoint *past = trace_pixels(&v->at, run, 0, now, &played);
  if (past && played > 1) {
    sb_canvas_curve(c, (SbStroke){SB_ROLE_INK, SB_LINE_ACTIVE, NULL}, past, played);
  }
  g_free(all);
}

// An arrow at `fraction` of the way along the curve between two frames.
static void draw_arrow(SbHysteresisView *v, size_t first, size_t last, double fraction,
                       bool played) {
  size_t n;
  SbPoint *p = trace_pixels(&v->at, &v->data->run, first, last, &n);
  double length = 0, walked = 0;
  for (size_t i = 1; p && i < n; i++) {
    length += hypot(p[i].x - p[i - 1].x, p[i].y - p[i - 1].y);
  }
  if (length > 44) {
    for (size_t i = 1; i < n; i++) {
      double d = hypot(p[i].x - p[i - 1].x, p[i].y - p[i - 1].y);
      if (walked + d >= fraction * length && d > 0) {
        double t = (fraction * length - walked) / d;
        SbPoint tip = {p[i - 1].x + t * (p[i].x - p[i - 1].x),
                       p[i - 1].y + t * (p[i].y - p[i - 1].y)};
        // Direction over the arrow's own length, not of one short piece.
        size_t back = i - 1;
        while (back > 0 && hypot(tip.x - p[back].x, tip.y - p[back].y) < 11) {
          back--;
        }
        sb_canvas_color(&v->canvas, sb_canvas_role(&v->canvas, SB_ROLE_INK), played ? 1 : 0.6);
        sb_canvas_arrowhead(&v->canvas, tip.x, tip.y, tip.x - p[back].x, tip.y - p[back].y, 1);
        break;
      }
      walked += d;
    }
  }
  g_free(p);
}

// First frame of the upward stroke on the stop is D; its top is the frame of largest platen force
// between D and E.
static size_t top_of_stop(const SbChartRun *run, size_t d, size_t e) {
  size_t n, best = d;
  const SbTracePoint *p = sb_trace_points(run->trace, &n);
  double force = -INFINITY;
  for (size_t i = sb_trace_find(run->trace, d); i < n && p[i].frame <= e; i++) {
    if (p[i].force > force) {
      force = p[i].force;
      best = p[i].frame;
    }
  }
  return best;
}

static void draw_arrows(SbHysteresisView *v) {
  const SbChartRun *run = &v->data->run;
  const SbStageMark *mark = sb_trace_marks(run->trace);
  for (int s = 0; s < SB_STAGE_COUNT; s++) {
    if (!mark[s].reached) {
      continue;
    }
    size_t first = mark[s].frame;
    size_t last = sb_trace_stage_end(run->trace, (SbStage)s, 0, run->count);
    if (s == SB_STAGE_D) {
      last = top_of_stop(run, first, last);
    }
    if (last < first) {
      continue; // stages out of order
    }
    double fraction = s == SB_STAGE_B ? 0.4 : s == SB_STAGE_A ? 0.55 : 0.5;
    size_t middle = first + (size_t)(fraction * (double)(last - first));
    draw_arrow(v, first, last, fraction, v->flags & SB_CHART_WHOLE || middle <= v->data->playhead);
  }
}

static void draw_empty(SbHysteresisView *v) {
  SbCanvas *c = &v->canvas;
  SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  const char *text =
      v->data->run.state == SB_CHART_RUNNING ? _("The run has begun.") : _("No run yet.");
  sb_canvas_text_halo(c, text, &style, v->at.plot.x + 0.5 * v->at.plot.width,
                      v->at.plot.y + 0.5 * v->at.plot.height, SB_MIDDLE);
}

// The pressure force, which the loop straddles.
static void draw_pressure_force(SbHysteresisView *v) {
  const SbModel *model = v->data->run.model;
  const double force = model ? sb_model_pressure_force(model) : 0;
  if (!(force > 0 && force >= v->at.y.lo && force <= v->at.y.hi)) {
    return;
  }
  const SbRect plot = v->at.plot;
  const double y = floor(sb_axis_at(&v->at.y, force)) + 0.5;
  const double left = fmax(sb_axis_at(&v->at.x, 0), plot.x), right = plot.x + plot.width;
  sb_canvas_line(&v->canvas, (SbStroke){SB_ROLE_FLUID, 1.2, &sb_dash_reference}, left, y, right, y);
  sb_labels_avoid(v->labels, (SbPoint[]){{left, y}, {right, y}}, 2, 1);
}

static void draw_content(SbHysteresisView *v, SbRect in) {
  const SbChartData *data = v->data;
  const SbFrame *now = v->flags & SB_CHART_WHOLE ? NULL : sb_chart_frame(data);
  if (drawable(&data->run) == 0) {
    draw_empty(v);
    return;
  }
  if (now) {
    sb_hysteresis_now(v, true);
  }
  draw_hysteresis_loop(v);
  if (data->measured != NULL) {
    sb_hysteresis_measured(v, in);
  }
  draw_arrows(v);
  if (now) {
    sb_hysteresis_label_now(v);
  }
  sb_hysteresis_marks(v);
  if (now) {
    sb_hysteresis_now(v, false);
  }
  sb_hysteresis_notes(v);
}

void sb_hysteresis_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                        unsigned flags) {
  SbHysteresisView v = {.data = data, .flags = flags};
  SbCanvas *c = &v.canvas;
  sb_canvas_init(c, cr, theme);
  sb_hysteresis_layout(&v.at, rect, data, flags);
  const SbRect in = sb_frame_begin(c, rect, flags & SB_CHART_PANEL), plot = v.at.plot;
  char several[96];
  const double head =
      sb_frame_head(c, in, flags & SB_CHART_COMPACT, _("Force and displacement"),
                    note_of(data, flags, several, sizeof several), _("force on the stem / N"));
  v.labels = g_new(SbLabels, 1);
  // Labels may use the whole panel below its title, but stay above the axis.
  sb_labels_init(v.labels, (SbRect){plot.x - 8, plot.y - 14, plot.width + 8 + LABEL_ROOM_OUTSIDE,
                                    plot.height + 14});
  sb_axes_draw(c, &v.at, v.labels);
  draw_pressure_force(&v);
  // An enlarged part ends with the plot, where no strip of differences lies below.
  cairo_save(cr);
  if (data->zoom != NULL) {
    const double bottom = data->measured != NULL ? in.y + in.height : plot.y + plot.height;
    cairo_rectangle(cr, plot.x, plot.y - 14, plot.width + LABEL_ROOM_OUTSIDE, bottom - plot.y + 14);
    cairo_clip(cr);
  }
  if (data->run.state == SB_CHART_RUNNING) {
    draw_other(&v, data->earlier, NULL);
  }
  const double zero = sb_axis_at(&v.at.y, 0);
  sb_labels_avoid(v.labels, (SbPoint[]){{plot.x, zero}, {plot.x + plot.width, zero}}, 2, 0.3);
  if (data->predicted != NULL) {
    cairo_push_group(cr);
  }
  draw_content(&v, in);
  if (data->predicted != NULL) {
    cairo_pop_group_to_source(cr);
    cairo_paint_with_alpha(cr, SB_OPACITY_EARLIER);
    draw_predicted(&v);
    // Named on the line of the axis' name, where nothing else is.
    sb_legend_predicted(c, in.x + in.width, head);
  }
  cairo_restore(cr);
  g_free(v.labels);
  sb_canvas_finish(c);
}

bool sb_hysteresis_hit(size_t *frame, SbRect rect, const SbChartData *data, unsigned flags,
                       double x, double y, double reach) {
  SbAxes at;
  const SbChartRun *run = &data->run;
  sb_hysteresis_layout(&at, rect, data, flags);
  size_t n = 0;
  const SbTracePoint *p = run->trace ? sb_trace_points(run->trace, &n) : NULL;
  double best = INFINITY;
  size_t nearest = 0;
  for (size_t i = 0; i < n; i++) {
    SbPoint q = sb_hysteresis_pixel(&at, p[i].displacement, p[i].force);
    // Distance to the piece up to the next point, so that long straight pieces are found too.
    double dx = 0, dy = 0, t = 0;
    if (i + 1 < n) {
      SbPoint r = sb_hysteresis_pixel(&at, p[i + 1].displacement, p[i + 1].force);
      dx = r.x - q.x;
      dy = r.y - q.y;
      double l2 = dx * dx + dy * dy;
      t = l2 > 0 ? CLAMP(((x - q.x) * dx + (y - q.y) * dy) / l2, 0, 1) : 0;
    }
    double d = hypot(x - q.x - t * dx, y - q.y - t * dy);
    if (d < best) {
      best = d;
      size_t next = i + 1 < n ? p[i + 1].frame : p[i].frame;
      nearest = p[i].frame + (size_t)lround(t * (double)(next - p[i].frame));
    }
  }
  if (!(best <= reach)) {
    return false;
  }
  *frame = MIN(nearest, run->count - 1);
  return true;
}
