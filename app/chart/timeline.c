// Stage strips over time [s] with the stem's displacement. The time axis is the whole cycle's from
// the first frame on: the platen goes to the stop plus the reversal force over the stiffness and
// back at constant speed, so its duration is known before the run has ended. What is not computed
// yet is left blank, what a cancelled run lacks is hatched.
#include "app/chart/timeline.h"
#include "app/base/device.h"
#include "app/base/format.h"
#include "app/draw/label.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>

static double duration_of(const SbChartData *data) {
  const SbChartRun *run = &data->run;
  double known = run->trace ? sb_trace_range(run->trace).time_max : 0;
  const SbModel *m = run->model;
  bool whole = run->state == SB_CHART_DONE && run->summary;
  if (whole && run->summary->duration > 0) {
    return fmax(known, run->summary->duration);
  }
  double expected = sb_device(m)->stem ? 0 : sb_model_rig(m)->duration;
  if (expected == 0 && m) {
    double yields =
        sb_model_value(m, SB_P_DRIVE_REVERSAL_FORCE) / sb_model_value(m, SB_P_DRIVE_STIFFNESS);
    expected =
        2 * (sb_model_value(m, SB_P_DRIVE_STROKE) + yields) / sb_model_value(m, SB_P_DRIVE_SPEED);
  }
  double longest = fmax(known, expected);
  return longest > 0 ? longest : 1;
}

SbScale sb_timeline_scale(SbRect rect, const SbChartData *data) {
  return (SbScale){0, duration_of(data), rect.x, rect.x + rect.width, false};
}

bool sb_timeline_hit(size_t *frame, SbRect rect, const SbChartData *data, double x) {
  const SbChartRun *run = &data->run;
  if (run->count == 0) {
    return false;
  }
  SbScale scale = sb_timeline_scale(rect, data);
  *frame = sb_chart_nearest(run, sb_axis_value(&scale, x));
  return true;
}

typedef struct {
  SbCanvas canvas;
  SbRect rect;
  SbScale x, s; // time, displacement
  double top, bottom;
  SbLabels *labels;
  const SbChartData *data;
  const SbTraceEvent *event; // of all cycles, `events` of them
  int events;
  int now;    // index of the event whose stage is under the playhead, -1 without one
  bool whole; // no playhead
} TimelineView;

// Pixels of the strip that an event begins.
static void strip_of(const TimelineView *v, int event, double *x0, double *x1) {
  double last = sb_trace_range(v->data->run.trace).time_max;
  *x0 = sb_axis_at(&v->x, v->event[event].mark.time);
  *x1 = sb_axis_at(&v->x, event + 1 < v->events ? v->event[event + 1].mark.time : last);
}

// Strips from event to event; the current one in the colour of *now*.
static void draw_strips(TimelineView *v) {
  SbCanvas *c = &v->canvas;
  double last = sb_trace_range(v->data->run.trace).time_max;
  for (int i = 0; i < v->events; i++) {
    double x0, x1;
    strip_of(v, i, &x0, &x1);
    if (i == v->now) {
      sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_NOW), c->theme->dark ? 0.20 : 0.11);
    } else {
      sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_INK),
                      v->event[i].stage % 2 == 0 ? 0.075 : 0.035);
    }
    cairo_rectangle(c->cr, x0, v->top, x1 - x0, v->bottom - v->top);
    cairo_fill(c->cr);
  }
  double done = sb_axis_at(&v->x, last);
  if (v->data->run.state == SB_CHART_PARTIAL || v->data->run.state == SB_CHART_FAILED) {
    const SbRect lacking = {done, v->top, v->rect.x + v->rect.width - done, v->bottom - v->top};
    sb_canvas_hatch(c, lacking, 11, false, SB_ROLE_AXIS, 0.8);
  }
}

static void draw_displacement(TimelineView *v) {
  const SbChartRun *run = &v->data->run;
  SbCanvas *c = &v->canvas;
  size_t n;
  const SbTracePoint *p = sb_trace_points(run->trace, &n);
  // The trace may lag behind the run.
  size_t limit = MIN(run->count, sb_trace_frames(run->trace));
  size_t now = v->whole ? limit - 1 : MIN(v->data->playhead, limit - 1);
  size_t split = MIN(sb_trace_find(run->trace, now), n - 1);
  g_autofree SbPoint *q = g_new(SbPoint, n + 1);
  for (size_t i = 0; i < n; i++) {
    q[i] = (SbPoint){sb_axis_at(&v->x, p[i].time), sb_axis_at(&v->s, p[i].displacement)};
  }
  sb_canvas_curve(c, (SbStroke){SB_ROLE_SECOND, 1.4, NULL}, q, n);
  sb_labels_avoid(v->labels, q, n, 1);
  q[split + 1] = (SbPoint){sb_axis_at(&v->x, run->frames[now].time),
                           sb_axis_at(&v->s, run->frames[now].displacement)};
  sb_canvas_curve(c, (SbStroke){SB_ROLE_INK, 2.4, NULL}, q, split + 2);
}

static void draw_events(TimelineView *v) {
  SbCanvas *c = &v->canvas;
  SbTextStyle letter = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_INK);
  double taken = -1e9;
  double right = v->rect.x + v->rect.width;
  // Letters keep off the playhead's triangle.
  const SbFrame *frame = v->whole ? NULL : sb_chart_frame(v->data);
  double now = frame ? sb_axis_at(&v->x, frame->time) : -1e9;
  for (int i = 0; i < v->events; i++) {
    const char *name = sb_stage_name(v->event[i].stage);
    double x = sb_axis_at(&v->x, v->event[i].mark.time);
    if (i > 0 && v->event[i].cycle != v->event[i - 1].cycle) {
      // A cycle ends and the next one begins.
      sb_canvas_line(c, (SbStroke){SB_ROLE_INK, 1.6, NULL}, floor(x) + 0.5, v->top - 3,
                     floor(x) + 0.5, v->bottom + 6);
    }
    sb_canvas_hairline(c, x, v->top - 3, x, v->bottom, sb_canvas_role(c, SB_ROLE_AXIS));
    // Letters stand apart by at least 4 px, to the right of their line if they must.
    double width = sb_canvas_text_width(c, name, &letter);
    double left = fmax(x - 0.5 * width, fmax(taken + 4, v->rect.x));
    if (left < now + 8 && left + width > now - 8) {
      left = now + 8;
    }
    if (left + width <= right && left - x < 18) {
      sb_canvas_text(c, name, &letter, left, v->top - 7, SB_LEFT);
      taken = left + width;
    }
  }
  double end = now > right - 20 ? fmin(right, now - 8) : right;
  if (sb_chart_complete(v->data) && sb_device(v->data->run.model)->stem && taken < end - 12) {
    sb_canvas_text(c, "A", &letter, end, v->top - 7, SB_RIGHT);
  }
}

static void time_text(char *out, const SbTicks *ticks, double value) {
  sb_axis_text(out, ticks, value);
  g_strlcat(out, value == 0 ? " s" : "", SB_FORMAT_MAX);
}

static void draw_axis(TimelineView *v) {
  SbAxes at = {.plot = {v->rect.x, v->top, v->rect.width, v->bottom - v->top},
               .x = v->x,
               .x_text = time_text,
               .card = v->rect,
               .minor = 5};
  sb_axes_ticks(&at, v->rect.width > 700 ? 8 : 5, 0);
  sb_axes_draw(&v->canvas, &at, NULL);
}

// Where a bookmark's name stands, above the strips: bare flags where another's name is.
typedef struct {
  const SbChartMarker *marker;
  size_t index; // in the data
  SbRect plate;
  bool named;
} Flag;

static int earlier(const void *a, const void *b) {
  const Flag *one = a, *other = b;
  return (one->marker->time > other->marker->time) - (one->marker->time < other->marker->time);
}

static SbTextStyle flag_style(const SbCanvas *c) {
  SbColor violet = sb_canvas_role(c, SB_ROLE_VIOLET);
  return (SbTextStyle){SB_TYPE_NOTE, 700,
                       sb_theme_readable(c->theme, sb_canvas_role(c, SB_ROLE_PANEL), violet), 1};
}

// All of them in the order of their times; freed by the caller (g_free).
static Flag *place_flags(SbCanvas *c, SbRect rect, const SbScale *scale, const SbChartData *data) {
  enum { BARE = 8, GAP = 2 };
  Flag *flags = g_new0(Flag, data->marker_count + 1);
  SbTextStyle style = flag_style(c);
  for (size_t i = 0; i < data->marker_count; i++) {
    flags[i].marker = &data->marker[i];
    flags[i].index = i;
  }
  qsort(flags, data->marker_count, sizeof *flags, earlier);
  double taken = rect.x - GAP;
  for (size_t i = 0; i < data->marker_count; i++) {
    const double x = floor(sb_axis_at(scale, flags[i].marker->time));
    double width = sb_canvas_text_width(c, flags[i].marker->name, &style) + 6;
    double left = fmin(x, rect.x + rect.width - width);
    flags[i].named = left >= taken + GAP;
    if (!flags[i].named) {
      width = BARE;
      left = x;
    }
    flags[i].plate = (SbRect){left, rect.y + 1, width, 15};
    taken = fmax(taken, left + width);
  }
  return flags;
}

bool sb_timeline_marker_hit(size_t *index, SbRect rect, const SbChartData *data, double x,
                            double y) {
  enum { NEAR = 3 };
  if (data->marker_count == 0 || data->run.count == 0) {
    return false;
  }
  cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
  cairo_t *cr = cairo_create(surface);
  SbCanvas canvas;
  sb_canvas_init(&canvas, cr, sb_theme(false));
  SbScale scale = sb_timeline_scale(rect, data);
  Flag *flags = place_flags(&canvas, rect, &scale, data);
  bool hit = false;
  // The later one is drawn over the earlier.
  for (size_t i = data->marker_count; i-- > 0 && !hit;) {
    const SbRect *plate = &flags[i].plate;
    hit = x >= plate->x - NEAR && x <= plate->x + plate->width + NEAR && y >= plate->y - NEAR &&
          y <= plate->y + plate->height;
    *index = hit ? flags[i].index : *index;
  }
  g_free(flags);
  sb_canvas_finish(&canvas);
  cairo_destroy(cr);
  cairo_surface_destroy(surface);
  return hit;
}

static void draw_markers(TimelineView *v) {
  SbCanvas *c = &v->canvas;
  SbTextStyle style = flag_style(c);
  Flag *flags = place_flags(c, v->rect, &v->x, v->data);
  for (size_t i = 0; i < v->data->marker_count; i++) {
    const SbRect *plate = &flags[i].plate;
    double x = floor(sb_axis_at(&v->x, flags[i].marker->time)) + 0.5;
    sb_canvas_line(c, (SbStroke){SB_ROLE_VIOLET, 1.4, &sb_dash_dimension}, x, v->top, x, v->bottom);
    sb_canvas_fill(c, *plate, SB_ROLE_VIOLET, 1);
    if (flags[i].named) {
      sb_canvas_text(c, flags[i].marker->name, &style, plate->x + 3, v->top - 5.5, SB_LEFT);
    }
  }
  g_free(flags);
}

// Which of several cycles begins here, in the first of its strips that has room.
static void draw_cycles(TimelineView *v) {
  SbCanvas *c = &v->canvas;
  SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_INK);
  int named = -1;
  for (int i = 0; i < v->events; i++) {
    char text[SB_FORMAT_MAX];
    double x0, x1;
    SbPlace at;
    strip_of(v, i, &x0, &x1);
    if (v->event[i].cycle == named ||
        sb_chart_cycle_name(text, &v->data->run, v->event[i].cycle)[0] == '\0' ||
        sb_canvas_text_width(c, text, &style) + 12 > x1 - x0) {
      continue;
    }
    const SbPlace places[] = {{x0 + 8, v->top + 16, SB_LEFT},
                              {x0 + 8, v->bottom - 9, SB_LEFT},
                              {x1 - 6, v->top + 16, SB_RIGHT},
                              {x1 - 6, v->bottom - 9, SB_RIGHT}};
    if (sb_labels_place(v->labels, c, text, &style, places, G_N_ELEMENTS(places), &at)) {
      sb_canvas_text(c, text, &style, at.x, at.y, at.align);
      named = v->event[i].cycle;
    }
  }
}

static void draw_names(TimelineView *v) {
  SbCanvas *c = &v->canvas;
  const SbChartRun *run = &v->data->run;
  const SbStageMark *mark = sb_trace_marks(run->trace);
  SbTextStyle plain = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  SbTextStyle now = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_NOW);
  double last = sb_trace_range(run->trace).time_max;
  SbPlace at;
  for (int i = 0; i < v->events; i++) {
    double x0, x1;
    strip_of(v, i, &x0, &x1);
    const char *text = sb_chart_phase(run, v->event[i].stage);
    const SbTextStyle *style = i == v->now ? &now : &plain;
    double width = sb_canvas_text_width(c, text, style);
    if (width + 16 > x1 - x0) {
      continue; // does not fit its own strip
    }
    double middle = 0.5 * (x0 + x1 - width);
    const SbPlace places[] = {{x0 + 10, v->bottom - 9, SB_LEFT}, {x0 + 10, v->top + 16, SB_LEFT},
                              {middle, v->top + 16, SB_LEFT},    {middle, v->bottom - 9, SB_LEFT},
                              {x1 - 8, v->top + 16, SB_RIGHT},   {x1 - 8, v->bottom - 9, SB_RIGHT}};
    if (sb_labels_place(v->labels, c, text, style, places, G_N_ELEMENTS(places), &at)) {
      sb_canvas_text(c, text, style, at.x, at.y, at.align);
    }
  }
  if (mark[SB_STAGE_D].reached) {
    double x = sb_axis_at(&v->x, mark[SB_STAGE_D].time) - 8;
    char value[SB_FORMAT_MAX], text[64];
    sb_format_text(value, SB_QUANTITY_LENGTH, mark[SB_STAGE_D].displacement, 0);
    g_snprintf(text, sizeof text, _("stroke %s"), value);
    // Only where there is room left for it.
    v->labels->crossing_max = 1;
    if (sb_labels_place(v->labels, c, text, &plain, (SbPlace[]){{x, v->bottom - 9, SB_RIGHT}}, 1,
                        &at)) {
      sb_canvas_text(c, text, &plain, at.x, at.y, at.align);
    }
  }
  if (run->state == SB_CHART_PARTIAL || run->state == SB_CHART_FAILED) {
    double x0 = sb_axis_at(&v->x, last), x1 = v->rect.x + v->rect.width;
    if (x1 - x0 > 60) {
      SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_WARN);
      sb_canvas_text_plate(c, run->state == SB_CHART_PARTIAL ? _("partial") : _("not computed"),
                           &style, 0.5 * (x0 + x1), 0.5 * (v->top + v->bottom) + 4, SB_MIDDLE,
                           sb_canvas_role(c, SB_ROLE_WARN_GROUND));
    }
  }
}

static void draw_playhead(TimelineView *v) {
  SbCanvas *c = &v->canvas;
  const SbFrame *frame = sb_chart_frame(v->data);
  double x = sb_axis_at(&v->x, frame->time), y = sb_axis_at(&v->s, frame->displacement);
  SbColor now = sb_canvas_role(c, SB_ROLE_NOW);
  sb_canvas_line(c, (SbStroke){SB_ROLE_NOW, 2, NULL}, x, v->top - 14, x, v->bottom + 6);
  cairo_move_to(c->cr, x - 6, v->top - 18);
  cairo_line_to(c->cr, x + 6, v->top - 18);
  cairo_line_to(c->cr, x, v->top - 8);
  cairo_close_path(c->cr);
  cairo_fill(c->cr);
  sb_canvas_dot(c, x, y, 5.6, sb_canvas_role(c, SB_ROLE_PANEL));
  sb_canvas_dot(c, x, y, 4, now);
}

void sb_timeline_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                      unsigned flags) {
  TimelineView v = {.rect = rect, .data = data, .now = -1, .whole = flags & SB_CHART_WHOLE};
  sb_canvas_init(&v.canvas, cr, theme);
  v.top = rect.y + 18;
  v.bottom = rect.y + fmax(rect.height - 22, 40);
  v.x = sb_timeline_scale(rect, data);
  const SbFrame *frame = v.whole ? NULL : sb_chart_frame(data);
  bool any = data->run.count > 0 && data->run.trace && sb_trace_frames(data->run.trace) > 0;
  draw_axis(&v);
  if (any) {
    double stroke = sb_trace_range(data->run.trace).displacement_max;
    if (data->run.model && sb_device(data->run.model)->stem) {
      stroke = fmax(stroke, sb_model_value(data->run.model, SB_P_DRIVE_STROKE));
    }
    v.s = (SbScale){0, stroke > 0 ? stroke : 1, v.bottom - 4, v.top + 6, false};
    size_t events = 0;
    v.event = sb_trace_events(data->run.trace, &events);
    v.events = (int)events;
    v.now = frame ? sb_trace_event_of(data->run.trace, data->run.frames,
                                      (size_t)(frame - data->run.frames))
                  : -1;
    v.labels = g_new(SbLabels, 1);
    sb_labels_init(v.labels, (SbRect){rect.x, v.top, rect.width, v.bottom - v.top});
    if (frame) {
      // Names keep off the playhead.
      double x = sb_axis_at(&v.x, frame->time);
      sb_labels_block(v.labels, (SbRect){x - 4, v.top, 8, v.bottom - v.top});
    }
    draw_strips(&v);
    draw_displacement(&v);
    draw_events(&v);
    draw_markers(&v);
    draw_cycles(&v);
    draw_names(&v);
    if (frame) {
      draw_playhead(&v);
    }
    g_free(v.labels);
  }
  sb_canvas_finish(&v.canvas);
}
