// Profiles of one frame. Pressure [MPa] and film [nm to um, logarithmic] against the axial position
// in the seal's frame [mm], canister on the left. Where the run kept a profile its points are drawn
// as they are; where it kept none, the frame's peak, width and central film are drawn as the shape
// of Hertz and labelled schematic. Film of a seal at rest and contact of a seal off the land do not
// exist and are said in words. Leaves out what the solver left out: asperities' share of the
// pressure is drawn only if the profile has one.
#include "app/base/device.h"
#include "app/base/figure_text.h"
#include "app/chart/profiles_private.h"

#include "app/draw/frame.h"
#include "app/draw/legend.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

// ---------------------------------------------------------------------------------------------------
// Shared scales

static SbTraceRange range_of_profiles(const SbChartData *data) {
  SbTraceRange r = {0};
  if (data->run.trace == NULL) {
    return r;
  }
  r = sb_trace_range(data->run.trace);
  for (size_t i = 0; i < data->pin_count; i++) {
    const SbTraceRange pin = sb_trace_range(data->pin[i].run->trace);
    r.contact_left = fmin(r.contact_left, pin.contact_left);
    r.contact_right = fmax(r.contact_right, pin.contact_right);
    r.pressure_peak_max = fmax(r.pressure_peak_max, pin.pressure_peak_max);
    r.film_min = r.film_min > 0 && pin.film_min > 0 ? fmin(r.film_min, pin.film_min)
                                                    : fmax(r.film_min, pin.film_min);
    r.film_max = fmax(r.film_max, pin.film_max);
  }
  for (int i = 0; data->predicted != NULL && i < SB_SEAL_COUNT; i++) {
    const SbSealFrame *seal = &data->predicted->run.frames[0].seal[i];
    if (sb_contact_touches(seal)) {
      r.contact_left = fmin(r.contact_left, seal->contact_left);
      r.contact_right = fmax(r.contact_right, seal->contact_right);
      r.pressure_peak_max = fmax(r.pressure_peak_max, seal->pressure_peak);
    }
  }
  return r;
}

static void position_scale(SbAxes *at, const SbChartData *data) {
  SbTraceRange r = range_of_profiles(data);
  double lo = r.contact_left * 1e3, hi = r.contact_right * 1e3;
  if (!(hi > lo)) {
    lo = -0.5;
    hi = 0.5;
  }
  // Room beside the contact for the fluid's pressure and the film's mouth.
  double room = CLAMP(64 / at->plot.width, 0.20, 0.25);
  double margin = (hi - lo) * room / (1 - 2 * room);
  sb_axes_linear(at, at->plot, lo - margin, hi + margin, 0, 1);
  sb_axes_ticks(at, 3, 0);
}

static void pressure_scale(SbAxes *at, const SbChartData *data) {
  const SbModel *model = data->run.model;
  double top = fmax(range_of_profiles(data).pressure_peak_max,
                    model ? sb_model_value(model, SB_P_CANISTER_PRESSURE) : 0) *
               1e-6;
  // Head-room for the peak's label, at least 26 px.
  const double height = at->plot.height, room = height > 80 ? height / (height - 30) : 1.3;
  at->y.hi = (top > 0 ? top : 1) * room;
  sb_axis_ticks(&at->y_ticks, 0, at->y.hi, height > 200 ? 5 : 3);
}

static void film_scale(SbAxes *at, const SbChartData *data) {
  const SbModel *model = data->run.model;
  SbTraceRange r = range_of_profiles(data);
  double least = r.film_min > 0 ? r.film_min : 1e-9;
  double most = fmax(r.film_max, model ? sb_model_sigma(model) : 1e-6);
  at->y = (SbScale){0.38 * least, 45 * most, at->y.p0, at->y.p1, true};
  SbTicks *ticks = &at->y_ticks;
  sb_axis_log_ticks(ticks, at->y.lo, at->y.hi);
  // Not closer than 18 px.
  int stride = 1;
  while (ticks->count > 1 && at->plot.height * stride / (log10(at->y.hi / at->y.lo)) < 18 &&
         stride < ticks->count) {
    stride++;
  }
  if (stride > 1) {
    int kept = 0;
    for (int i = 0; i < ticks->count; i += stride) {
      ticks->value[kept++] = ticks->value[i];
    }
    ticks->count = kept;
  }
}

// ---------------------------------------------------------------------------------------------------
// Parts of one chart

void sb_profile_figure(char *out, const SbProfileChart *s, const char *name, double value) {
  char path[64];
  g_snprintf(path, sizeof path, "seals.%s.%s", sb_seal_name(s->index), name);
  const int figure = sb_figure_find(path);
  const SbSummary *summary = s->data->run.summary;
  sb_figure_text(out, figure, value, summary != NULL ? sb_figure_error(summary, figure) : NAN);
}

SbTextStyle sb_profile_style(const SbProfileChart *s) {
  return sb_canvas_style(s->canvas, SB_TYPE_LABEL, 600, s->role);
}

static void film_text(char *out, const SbTicks *ticks, double value) {
  sb_format_film_tick(out, value);
}

// The curve of another run's seal, with the pen and colour in force.
static void other_curve(SbProfileChart *s, const SbChartRun *run, const SbSealFrame *seal,
                        bool film) {
  SbCanvas *c = s->canvas;
  if (!sb_contact_touches(seal) || (film && !(seal->film_central > 0))) {
    return;
  }
  SbContactCurve curve;
  size_t n = 0;
  sb_contact_curve_init(&curve, run, seal, s->index);
  SbPoint *p = (film ? sb_profile_film_points : sb_profile_pressure_points)(s, &curve, seal, &n);
  sb_canvas_clip(c, s->at.plot);
  sb_canvas_polyline(c, p, n);
  cairo_restore(c->cr);
  sb_labels_avoid(s->labels, p, n, 0.7);
  g_free(p);
  sb_contact_curve_finish(&curve);
}

// The pinned runs' curves at the frame that stands where the playhead does.
static void pinned_curves(SbProfileChart *s, bool film) {
  for (size_t i = 0; i < s->data->pin_count; i++) {
    const SbChartPin *pin = &s->data->pin[i];
    sb_canvas_stroke(s->canvas, sb_chart_pin_stroke(pin->look));
    other_curve(s, pin->run, &pin->run->frames[pin->frame].seal[s->index], film);
  }
}

// A seal's contact as it is predicted of the present values; NULL: not known, or there is none to
// draw.
static const SbSealFrame *predicted_seal(const SbChartData *data, int index, bool film) {
  if (data->predicted == NULL) {
    return NULL;
  }
  const SbChartRun *run = &data->predicted->run;
  const SbSealFrame *seal = &run->frames[0].seal[index];
  const bool known = run->profile(run->source, seal->profile) != NULL;
  return known && sb_contact_touches(seal) && (!film || seal->film_central > 0) ? seal : NULL;
}

// ---------------------------------------------------------------------------------------------------
// Panels

// What made the curves, for the title line: one model for both seals or "schematic".
static const char *curve_model(const SbChartData *data, const SbFrame *frame, bool film) {
  const char *model = NULL;
  bool any = false;
  for (int i = 0; frame && i < SB_SEAL_COUNT; i++) {
    if (sb_contact_touches(&frame->seal[i]) && (!film || frame->seal[i].film_central > 0)) {
      const SbContactProfile *kept =
          data->run.profile ? data->run.profile(data->run.source, frame->seal[i].profile) : NULL;
      any = true;
      model = kept && kept->count > 1 ? (film ? kept->film_model : kept->model) : NULL;
    }
  }
  return any ? (model ? model : _("schematic, shape of Hertz")) : NULL;
}

// Where a panel puts the chart of a seal.
static void layout(SbProfileChart *s, SbRect in, unsigned flags, bool film) {
  const double numbers = film ? 54 : 34, gap = in.width > 500 ? 44 : 20;
  const double top = in.y + (flags & SB_CHART_COMPACT ? 42 : 48), bottom = in.y + in.height - 22;
  const double each = 0.5 * (in.width - numbers - gap - 10);
  const int place = s->index == SB_INNER ? 0 : 1; // numbers at the left one only
  s->at.plot = (SbRect){in.x + numbers + place * (each + gap), top, each, fmax(bottom - top, 30)};
  s->at.bare = place > 0;
  s->at.y_text = film ? film_text : NULL;
  position_scale(&s->at, s->data);
  (film ? film_scale : pressure_scale)(&s->at, s->data);
}

static SbRect inner_rect(SbRect rect, unsigned flags) {
  const bool panel = flags & SB_CHART_PANEL;
  const double pad = panel ? SB_GRID_PADDING : 0;
  return (SbRect){rect.x + pad, rect.y + (panel ? 14 : 0), rect.width - 2 * pad,
                  rect.height - (panel ? 14 + 9 : 0)};
}

bool sb_profiles_read(SbProfileReading *out, SbRect rect, const SbChartData *data, unsigned flags,
                      bool film, double x, double y) {
  const SbFrame *frame = sb_chart_frame(data);
  for (int index = 0; frame != NULL && index < SB_SEAL_COUNT; index++) {
    SbProfileChart s = {.data = data, .index = index, .seal = &frame->seal[index]};
    layout(&s, inner_rect(rect, flags), flags, film);
    const double position = 1e-3 * sb_axis_value(&s.at.x, x);
    if (!sb_axes_inside(&s.at, x, y, 0) || !sb_contact_touches(s.seal) ||
        (film && !(s.seal->film_central > 0))) {
      continue;
    }
    SbContactCurve curve;
    sb_contact_curve_init(&curve, &data->run, s.seal, index);
    // Beyond the curve there is nothing that was computed.
    const bool known =
        curve.count > 1 && position >= curve.x[0] && position <= curve.x[curve.count - 1];
    const double value =
        known ? sb_contact_curve_at(&curve, film ? curve.film : curve.pressure, position) : 0;
    sb_contact_curve_finish(&curve);
    if (known && (value > 0 || !film)) {
      *out = (SbProfileReading){.seal = index,
                                .position = position,
                                .value = value,
                                .plot = s.at.plot,
                                .at = {x, sb_axis_at(&s.at.y, film ? value : 1e-6 * value)}};
      return true;
    }
  }
  return false;
}

// The line after the title: scales, direction of motion, what made the curves.
static void panel_note(char *out, size_t size, const SbChartData *data, bool compact, bool film) {
  const SbFrame *frame = sb_chart_frame(data);
  if (film) {
    const char *bore = !frame || frame->velocity == 0
                           ? _("at rest")
                           : _(sb_device(data->run.model)->moves[frame->velocity < 0]);
    g_snprintf(out, size, "%s%s",
               compact ? _("log scale, position / mm, ")
                       : _("log scale against axial position / mm, "),
               bore);
  } else {
    g_strlcpy(out,
              compact
                  ? _("MPa above the lower fluid, position / mm")
                  : _("MPa above the lower fluid pressure, position / mm, canister on the left"),
              size);
  }
  const char *model = curve_model(data, frame, film);
  if (model && !compact) {
    g_strlcat(out, "  \xc2\xb7  ", size);
    g_strlcat(out, model, size);
  }
}

// The chart of one seal; what is predicted is dashed, over the paler curve of the former run.
static void draw_seal(SbProfileChart *s, bool film) {
  SbCanvas *c = s->canvas;
  const SbChartData *data = s->data;
  const SbRect plot = s->at.plot;
  sb_labels_init(s->labels, (SbRect){plot.x - 2, plot.y - 12, plot.width + 4, plot.height + 12});
  if (film) {
    sb_profile_continuum(s);
  }
  sb_axes_draw(c, &s->at, s->labels);
  pinned_curves(s, film);
  if (data->predicted != NULL) {
    cairo_push_group(c->cr);
  }
  (film ? sb_profile_film : sb_profile_pressure)(s);
  if (data->predicted != NULL) {
    cairo_pop_group_to_source(c->cr);
    cairo_paint_with_alpha(c->cr, SB_OPACITY_EARLIER);
  }
  const SbSealFrame *coming = predicted_seal(data, s->index, film);
  if (coming != NULL) {
    sb_canvas_stroke(c, (SbStroke){s->role, SB_LINE_SEAL, &sb_dash_predicted});
    other_curve(s, &data->predicted->run, coming, film);
  }
}

static void draw_panel(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                       unsigned flags, bool film) {
  static const struct {
    int seal;
    SbRole role;
  } order[] = {{SB_INNER, SB_ROLE_INNER}, {SB_OUTER, SB_ROLE_OUTER}};
  SbCanvas canvas, *c = &canvas;
  sb_canvas_init(c, cr, theme);
  const bool compact = flags & SB_CHART_COMPACT;
  const SbFrame *frame = sb_chart_frame(data);
  const SbRect in = inner_rect(rect, flags);
  char note[160];
  if (flags & SB_CHART_PANEL) {
    sb_canvas_panel(c, rect);
  }
  panel_note(note, sizeof note, data, compact, film);
  const bool predicted =
      predicted_seal(data, SB_INNER, film) != NULL || predicted_seal(data, SB_OUTER, film) != NULL;
  const double key = predicted ? sb_legend_predicted(c, in.x + in.width, in.y + 14) + 12 : 0;
  sb_frame_title(c, (SbRect){in.x, in.y, in.width - key, in.height},
                 compact ? SB_TYPE_PANEL_WINDOW : SB_TYPE_PANEL,
                 film ? _("Film thickness") : _("Contact pressure"), note);
  SbLabels *labels = g_new(SbLabels, 1);
  bool band_named = false;
  for (size_t k = 0; k < G_N_ELEMENTS(order); k++) {
    SbProfileChart s = {.canvas = c,
                        .labels = labels,
                        .data = data,
                        .seal = frame ? &frame->seal[order[k].seal] : NULL,
                        .index = order[k].seal,
                        .band_named = &band_named,
                        .role = order[k].role};
    layout(&s, in, flags, film);
    const SbTextStyle name = sb_profile_style(&s);
    sb_canvas_text(c, sb_chart_seal_name(data->run.model, s.index), &name, s.at.plot.x,
                   in.y + (compact ? 34 : 40), SB_LEFT);
    draw_seal(&s, film);
  }
  g_free(labels);
  sb_canvas_finish(c);
}

void sb_profiles_pressure_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                               const SbChartData *data, unsigned flags) {
  draw_panel(cr, rect, theme, data, flags, false);
}

void sb_profiles_film_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                           unsigned flags) {
  draw_panel(cr, rect, theme, data, flags, true);
}

void sb_profiles_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                      unsigned flags) {
  SbRect first = rect, second = rect;
  if (rect.width > 1.6 * rect.height && rect.width > 700) {
    first.width = floor(0.5 * (rect.width - SB_GRID_GUTTER));
    second.x = rect.x + first.width + SB_GRID_GUTTER;
    second.width = rect.x + rect.width - second.x;
  } else {
    first.height = floor(0.5 * (rect.height - 16));
    second.y = rect.y + first.height + 16;
    second.height = rect.y + rect.height - second.y;
  }
  sb_profiles_pressure_draw(cr, first, theme, data, flags);
  sb_profiles_film_draw(cr, second, theme, data, flags);
}
