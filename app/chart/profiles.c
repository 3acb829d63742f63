// Profiles of one frame. Pressure [MPa] and film [nm to um, logarithmic] against the axial position
// in the seal's frame [mm], canister on the left. Where the run kept a profile its points are drawn
// as they are; where it kept none, the frame's peak, width and central film are drawn as the shape
// of Hertz and labelled schematic. Film of a seal at rest and contact of a seal off the land do not
// exist and are said in words. Leaves out what the solver left out: asperities' share of the
// pressure is drawn only if the profile has one.
#include "app/chart/profiles.h"
#include "app/base/figure_text.h"
#include "app/chart/contact_curve.h"
#include "app/draw/axis.h"
#include "app/draw/label.h"

#include "app/draw/frame.h"
#include "app/draw/legend.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

// One of the four small charts.
typedef struct {
  SbCanvas *canvas;
  SbAxes at;
  SbLabels *labels;
  const SbChartData *data;
  const SbSealFrame *seal; // NULL: no frame at all
  int index;               // SB_OUTER, SB_INNER
  bool *band_named;        // the band below the continuum limit has its label
  SbColor color;
} Small;

// ---------------------------------------------------------------------------------------------------
// Shared scales

static SbTraceRange range_of(const SbChartData *data) {
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
  SbTraceRange r = range_of(data);
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
  double top = fmax(range_of(data).pressure_peak_max,
                    model ? sb_model_value(model, SB_P_CANISTER_PRESSURE) : 0) *
               1e-6;
  // Head-room for the peak's label, at least 26 px.
  const double height = at->plot.height, room = height > 80 ? height / (height - 30) : 1.3;
  at->y.hi = (top > 0 ? top : 1) * room;
  sb_axis_ticks(&at->y_ticks, 0, at->y.hi, height > 200 ? 5 : 3);
}

static void film_scale(SbAxes *at, const SbChartData *data) {
  const SbModel *model = data->run.model;
  SbTraceRange r = range_of(data);
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
// Parts of one small chart

static void film_text(char *out, const SbTicks *ticks, double value) {
  sb_format_film_tick(out, value);
}

static bool small_label(Small *s, const char *text, const SbTextStyle *style, const SbPlace *place,
                        int count) {
  return sb_labels_put(s->labels, s->canvas, text, style, place, count);
}

// A figure of the seal at this instant, with the unit, the digits and the error of the figure
// `name` of the run.
static void seal_figure(char *out, const Small *s, const char *name, double value) {
  char path[64];
  g_snprintf(path, sizeof path, "seals.%s.%s", sb_seal_name(s->index), name);
  const int figure = sb_figure_find(path);
  const SbSummary *summary = s->data->run.summary;
  sb_figure_text(out, figure, value, summary != NULL ? sb_figure_error(summary, figure) : NAN);
}

// The asperities' share of the pressure: a dashed line under the curve, named once.
static void asperity_share(Small *s, const SbContactCurve *curve, double left, double right) {
  SbCanvas *c = s->canvas;
  g_autofree SbPoint *p = g_new(SbPoint, curve->count + 1);
  size_t n = 0, top = 0;
  for (size_t i = 0; i < curve->count; i++) {
    if (curve->x[i] >= left && curve->x[i] <= right) {
      p[n] = (SbPoint){sb_axis_at(&s->at.x, curve->x[i] * 1e3),
                       sb_axis_at(&s->at.y, curve->asperity[i] * 1e-6)};
      top = p[n].y < p[top].y ? n : top;
      n++;
    }
  }
  if (n > 1) {
    sb_canvas_pen(c, SB_LINE_FRAME, &sb_dash_dimension);
    sb_canvas_color(c, s->color, 1);
    sb_canvas_polyline(c, p, n);
    sb_labels_avoid(s->labels, p, n, 1);
    SbTextStyle style = {SB_TYPE_NOTE, 400, s->color, 1};
    // Low over the axis the curve's foot and the width's figure are in the way: beside it there.
    double bottom = s->at.plot.y + s->at.plot.height;
    bool low = p[top].y > bottom - 24;
    const SbPlace places[] = {{p[n - 1].x + 8, fmin(p[top].y, bottom - 7), SB_LEFT},
                              {p[top].x, p[top].y - 6, SB_MIDDLE},
                              {p[top].x, p[top].y + 14, SB_MIDDLE},
                              {p[n - 1].x + 8, p[top].y, SB_LEFT}};
    small_label(s, _("asperities"), &style, places + !low, 3);
  }
}

// Ground of the fluid on one side of the contact, up to its pressure.
static void fluid_ground(Small *s, double from, double to, double pressure) {
  if (!(pressure > 0)) {
    return;
  }
  SbCanvas *c = s->canvas;
  SbColor fluid = sb_canvas_role(c, SB_ROLE_FLUID);
  double x0 =
      CLAMP(sb_axis_at(&s->at.x, from * 1e3), s->at.plot.x, s->at.plot.x + s->at.plot.width);
  double x1 = CLAMP(sb_axis_at(&s->at.x, to * 1e3), s->at.plot.x, s->at.plot.x + s->at.plot.width);
  double y = sb_axis_at(&s->at.y, pressure * 1e-6), bottom = s->at.plot.y + s->at.plot.height;
  sb_canvas_color(c, fluid, 0.15);
  cairo_rectangle(c->cr, x0, y, x1 - x0, bottom - y);
  cairo_fill(c->cr);
  sb_canvas_pen(c, 1.6, NULL);
  sb_canvas_color(c, fluid, 1);
  cairo_move_to(c->cr, x0, y);
  cairo_line_to(c->cr, x1, y);
  cairo_stroke(c->cr);
  SbPoint line[2] = {{x0, y}, {x1, y}};
  sb_labels_avoid(s->labels, line, 2, 1);
}

static void fluid_label(Small *s, double from, double to, double pressure) {
  if (!(pressure > 0)) {
    return;
  }
  double x0 = fmax(sb_axis_at(&s->at.x, from * 1e3), s->at.plot.x);
  double x1 = fmin(sb_axis_at(&s->at.x, to * 1e3), s->at.plot.x + s->at.plot.width);
  double y = sb_axis_at(&s->at.y, pressure * 1e-6);
  char value[SB_FORMAT_MAX], text[64];
  sb_format_given(value, SB_QUANTITY_PRESSURE, pressure);
  g_snprintf(text, sizeof text, _("fluid %s"), value);
  SbTextStyle style = sb_canvas_style(s->canvas, SB_TYPE_LABEL, 400, SB_ROLE_FLUID);
  if (sb_canvas_text_width(s->canvas, text, &style) + 8 > x1 - x0) {
    g_strlcpy(text, value, sizeof text);
  }
  const SbPlace places[] = {
      {x0 + 4, y - 6, SB_LEFT}, {x1 - 4, y - 6, SB_RIGHT}, {x0 + 4, y + 16, SB_LEFT}};
  small_label(s, text, &style, places, 3);
}

// What both sides share is not in the curve: it lies on everything, and is told in words.
static void common_label(Small *s) {
  const SbSealFrame *seal = s->seal;
  double common = seal ? fmin((double)seal->pressure_left, (double)seal->pressure_right) : 0;
  if (!(common > 0)) {
    return;
  }
  char value[SB_FORMAT_MAX], text[96];
  sb_format_given(value, SB_QUANTITY_PRESSURE, common);
  g_snprintf(text, sizeof text, _("fluid %s on both sides"), value);
  SbTextStyle style = sb_canvas_style(s->canvas, SB_TYPE_NOTE, 400, SB_ROLE_FLUID);
  double left = s->at.plot.x + 4, right = s->at.plot.x + s->at.plot.width - 4;
  small_label(s, text, &style,
              (SbPlace[]){{left, s->at.plot.y + 12, SB_LEFT},
                          {right, s->at.plot.y + 12, SB_RIGHT},
                          {left, s->at.plot.y + 30, SB_LEFT}},
              3);
}

// The pressure between a contact's ends, which stand on the fluid's pressure. Owned by the caller.
static SbPoint *pressure_points(const Small *s, const SbContactCurve *curve, double left,
                                double right, size_t *count) {
  SbPoint *p = g_new(SbPoint, curve->count + 2);
  size_t n = 0;
  p[n++] =
      (SbPoint){sb_axis_at(&s->at.x, left * 1e3),
                sb_axis_at(&s->at.y, sb_contact_curve_at(curve, curve->pressure, left) * 1e-6)};
  for (size_t i = 0; i < curve->count; i++) {
    if (curve->x[i] > left && curve->x[i] < right) {
      p[n++] = (SbPoint){sb_axis_at(&s->at.x, curve->x[i] * 1e3),
                         sb_axis_at(&s->at.y, curve->pressure[i] * 1e-6)};
    }
  }
  p[n++] =
      (SbPoint){sb_axis_at(&s->at.x, right * 1e3),
                sb_axis_at(&s->at.y, sb_contact_curve_at(curve, curve->pressure, right) * 1e-6)};
  *count = n;
  return p;
}

// The film where there is a contact. Owned by the caller.
static SbPoint *film_points(const Small *s, const SbContactCurve *curve, const SbSealFrame *seal,
                            size_t *count) {
  SbPoint *p = g_new(SbPoint, curve->count + 1);
  size_t n = 0;
  const double from = seal->land_fraction < 0.999F ? seal->contact_left : -1;
  for (size_t i = 0; i < curve->count; i++) {
    if (curve->x[i] >= from && curve->film[i] > 0) {
      p[n++] =
          (SbPoint){sb_axis_at(&s->at.x, curve->x[i] * 1e3), sb_axis_at(&s->at.y, curve->film[i])};
    }
  }
  *count = n;
  return p;
}

static void contact_ends(const SbContactCurve *curve, const SbSealFrame *seal, double *left,
                         double *right) {
  *left = seal->contact_left;
  *right = seal->contact_right;
  if (curve->model && seal->land_fraction > 0.999F) {
    sb_contact_curve_extend(curve, seal, left, right);
  }
}

// The curve of another run's seal, with the pen and colour in force.
static void other_curve(Small *s, const SbChartRun *run, const SbSealFrame *seal, bool film) {
  SbCanvas *c = s->canvas;
  if (!sb_contact_touches(seal) || (film && !(seal->film_central > 0))) {
    return;
  }
  SbContactCurve curve;
  size_t n = 0;
  double left, right;
  sb_contact_curve_init(&curve, run, seal, s->index);
  contact_ends(&curve, seal, &left, &right);
  SbPoint *p =
      film ? film_points(s, &curve, seal, &n) : pressure_points(s, &curve, left, right, &n);
  sb_canvas_clip(c, s->at.plot);
  sb_canvas_polyline(c, p, n);
  cairo_restore(c->cr);
  sb_labels_avoid(s->labels, p, n, 0.7);
  g_free(p);
  sb_contact_curve_finish(&curve);
}

// The pinned runs' curves at the frame that stands where the playhead does.
static void pinned_curves(Small *s, bool film) {
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

static void pressure_chart(Small *s) {
  SbCanvas *c = s->canvas;
  const SbSealFrame *seal = s->seal;
  double bottom = s->at.plot.y + s->at.plot.height;
  const double far = 1;
  if (!sb_contact_touches(seal)) {
    double side = seal ? fmax(sb_seal_step_left(seal), sb_seal_step_right(seal)) : 0;
    fluid_ground(s, -far, far, side);
    fluid_label(s, -far, far, side);
    SbTextStyle note = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_SECOND);
    double x = s->at.plot.x + 0.5 * s->at.plot.width, y = s->at.plot.y + 0.5 * s->at.plot.height;
    small_label(s, seal ? _("no contact") : _("no run yet"), &note,
                (SbPlace[]){{x, y, SB_MIDDLE}, {x, y - 30, SB_MIDDLE}, {x, y + 30, SB_MIDDLE}}, 3);
    common_label(s);
    return;
  }
  double left, right;
  SbContactCurve curve;
  sb_contact_curve_init(&curve, &s->data->run, s->seal, s->index);
  contact_ends(&curve, seal, &left, &right);
  fluid_ground(s, -far, left, sb_seal_step_left(seal));
  fluid_ground(s, right, far, sb_seal_step_right(seal));

  size_t n = 0;
  g_autofree SbPoint *p = pressure_points(s, &curve, left, right, &n);
  double peak = 0, peak_x = 0.5 * (left + right);
  for (size_t i = 0; i < curve.count; i++) {
    if (curve.x[i] > left && curve.x[i] < right && curve.pressure[i] > peak) {
      peak = curve.pressure[i];
      peak_x = curve.x[i];
    }
  }
  cairo_new_path(c->cr);
  sb_canvas_path(c, p, n);
  cairo_line_to(c->cr, p[n - 1].x, bottom);
  cairo_line_to(c->cr, p[0].x, bottom);
  cairo_close_path(c->cr);
  sb_canvas_color(c, s->color, c->theme->curve_fill);
  cairo_fill(c->cr);
  sb_canvas_pen(c, SB_LINE_SEAL, NULL);
  sb_canvas_color(c, s->color, 1);
  sb_canvas_polyline(c, p, n);
  sb_labels_avoid(s->labels, p, n, 1);

  // Peak, width, fluid.
  char value[SB_FORMAT_MAX], text[96];
  if (peak > 0) {
    double x = sb_axis_at(&s->at.x, peak_x * 1e3), y = sb_axis_at(&s->at.y, peak * 1e-6);
    sb_canvas_dot(c, x, y, 2.6, s->color);
    seal_figure(value, s, "pressure_peak_Pa", seal->pressure_peak);
    g_snprintf(text, sizeof text, _("peak %s"), value);
    SbTextStyle style = {SB_TYPE_LABEL, 600, s->color, 1};
    small_label(s, text, &style,
                (SbPlace[]){{x, y - 9, SB_MIDDLE},
                            {x + 8, y - 9, SB_LEFT},
                            {x - 8, y - 9, SB_RIGHT},
                            {s->at.plot.x + 4, s->at.plot.y + 10, SB_LEFT}},
                4);
  }
  // The width is the frame's contact, whatever the curve's feet.
  double wide = seal->contact_right - seal->contact_left;
  double middle = sb_axis_at(&s->at.x, 0.5e3 * (seal->contact_left + seal->contact_right));
  seal_figure(value, s, "contact_width_m", wide);
  SbTextStyle strong = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_INK);
  double width = sb_canvas_text_width(c, value, &strong) + 8;
  double room = sb_axis_at(&s->at.x, wide * 1e3) - sb_axis_at(&s->at.x, 0);
  SbPlace at;
  const SbPlace widths[] = {{middle, bottom - 8, SB_MIDDLE},
                            {sb_axis_at(&s->at.x, right * 1e3) + 8, bottom - 8, SB_LEFT}};
  // Inside if it fits, else beside.
  bool inside = width < room;
  if (sb_labels_place(s->labels, c, value, &strong, inside ? widths : widths + 1, 1, &at)) {
    sb_canvas_text(c, value, &strong, at.x, at.y, at.align);
  }
  fluid_label(s, -far, left, sb_seal_step_left(seal));
  fluid_label(s, right, far, sb_seal_step_right(seal));
  common_label(s);
  if (curve.asperities) {
    asperity_share(s, &curve, left, right);
  }
  if (seal->land_fraction < 0.999F) {
    g_snprintf(text, sizeof text, _("%.0f\xc2\xa0%% on the land"),
               100.0 * (double)seal->land_fraction);
    SbTextStyle note = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
    // The land's edge takes the canister side away: there is room on that side.
    double edge = sb_axis_at(&s->at.x, seal->contact_left * 1e3) - 6;
    small_label(s, text, &note,
                (SbPlace[]){{edge, bottom - 8, SB_RIGHT},
                            {edge, bottom - 26, SB_RIGHT},
                            {middle, bottom - 26, SB_MIDDLE}},
                3);
  }
  sb_contact_curve_finish(&curve);
}

// Central and least film where one line of both is wider than the contact: one under the other, the
// least next to the curve; where that would cross the curve, with the word on a line of its own.
static void narrow_label(Small *s, const char *const *value, int count, const SbTextStyle *style,
                         const SbSealFrame *seal, double y) {
  const double right_px = s->at.plot.x + s->at.plot.width;
  const double left = sb_axis_at(&s->at.x, seal->contact_left * 1e3) - 8;
  const double right = sb_axis_at(&s->at.x, seal->contact_right * 1e3) + 8;
  const double x = 0.5 * (left + right), line = 17;
  char text[SB_FORMAT_MAX + 24];
  g_snprintf(text, sizeof text, count > 1 ? C_("film", "least %s") : "%s", value[count - 1]);
  const double crossing_max = s->labels->crossing_max;
  s->labels->crossing_max = 1;
  const SbPlace clear[] = {{x, y - 9, SB_MIDDLE},
                           {right_px - 4, y - 9, SB_RIGHT},
                           {left, y - 9, SB_RIGHT},
                           {right, y - 9, SB_LEFT}};
  double next = y - 26;
  if (!small_label(s, text, style, clear, 4)) {
    // In three lines within the contact, or on the side of it that has more room.
    const double wide = sb_canvas_text_width(s->canvas, value[count - 1], style);
    const bool inside = right - left - 24 >= wide, before = left - s->at.plot.x > right_px - right;
    const SbPlace at = inside   ? (SbPlace){x, y - 9, SB_MIDDLE}
                       : before ? (SbPlace){left, y - 9, SB_RIGHT}
                                : (SbPlace){right, y - 9, SB_LEFT};
    const bool beside =
        count > 1 && (inside || fmax(left - s->at.plot.x, right_px - right) >= wide) &&
        small_label(s, value[count - 1], style, &at, 1) &&
        small_label(s, C_("film", "least"), style, &(SbPlace){at.x, at.y - line, at.align}, 1);
    s->labels->crossing_max = crossing_max;
    if (!beside) {
      small_label(s, text, style, clear, 3);
    } else {
      next = at.y - 2 * line;
    }
  }
  s->labels->crossing_max = 1;
  if (count > 1) {
    const SbPlace above[] = {{x, next, SB_MIDDLE},
                             {right_px - 4, next, SB_RIGHT},
                             {left, next, SB_RIGHT},
                             {right, next, SB_LEFT}};
    if (!small_label(s, value[0], style, above, 4)) {
      s->labels->crossing_max = crossing_max;
      small_label(s, value[0], style, above, 3);
    }
  }
  s->labels->crossing_max = crossing_max;
}

static void film_chart(Small *s) {
  SbCanvas *c = s->canvas;
  cairo_t *cr = c->cr;
  const SbSealFrame *seal = s->seal;
  double left_px = s->at.plot.x, right_px = left_px + s->at.plot.width;
  double bottom = s->at.plot.y + s->at.plot.height;
  char value[SB_FORMAT_MAX], least[SB_FORMAT_MAX], text[128];

  // Roughness, dashed, and its label.
  double sigma = s->data->run.model ? sb_model_sigma(s->data->run.model) : 0;
  double sigma_y = sigma > 0 ? sb_axis_at(&s->at.y, sigma) : -1e9;
  if (sigma_y > s->at.plot.y && sigma_y < bottom) {
    double y = floor(sigma_y) + 0.5;
    sb_canvas_line(c, (SbStroke){SB_ROLE_SECOND, 1.2, &sb_dash_reference}, left_px, y, right_px, y);
    sb_labels_avoid(s->labels, (SbPoint[]){{left_px, y}, {right_px, y}}, 2, 1);
  }
  bool slides = sb_contact_touches(seal) && seal->film_central > 0;
  SbContactCurve curve = {0};
  if (slides) {
    sb_contact_curve_init(&curve, &s->data->run, s->seal, s->index);
    size_t n = 0;
    g_autofree SbPoint *p = film_points(s, &curve, seal, &n);
    sb_canvas_clip(c, (SbRect){left_px, s->at.plot.y, s->at.plot.width, s->at.plot.height});
    sb_canvas_pen(c, SB_LINE_SEAL, NULL);
    sb_canvas_color(c, s->color, 1);
    sb_canvas_polyline(c, p, n);
    cairo_restore(cr);
    sb_labels_avoid(s->labels, p, n, 1);

    // Central and least film above the flat.
    double x = sb_axis_at(&s->at.x, 0.5e3 * (seal->contact_left + seal->contact_right));
    double y = sb_axis_at(&s->at.y, seal->film_central);
    seal_figure(value, s, "film_central_m", seal->film_central);
    seal_figure(least, s, "film_min_m", seal->film_min);
    bool uniform = seal->film_min >= 0.995 * seal->film_central;
    SbTextStyle style = {SB_TYPE_LABEL, 600, s->color, 1};
    g_snprintf(text, sizeof text, uniform ? _("%s, uniform") : _("%s, least %s"), value, least);
    double room = sb_axis_at(&s->at.x, seal->contact_right * 1e3) -
                  sb_axis_at(&s->at.x, seal->contact_left * 1e3);
    if (sb_canvas_text_width(c, text, &style) + 8 <= room) {
      small_label(s, text, &style, (SbPlace[]){{x, y - 9, SB_MIDDLE}, {x, y - 24, SB_MIDDLE}}, 2);
    } else {
      const char *const lines[] = {value, least};
      narrow_label(s, lines, uniform ? 1 : 2, &style, seal, y);
    }
  } else {
    SbTextStyle note = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_SECOND);
    double x = left_px + 0.5 * s->at.plot.width, y = s->at.plot.y + 0.62 * s->at.plot.height;
    const char *words = !seal                                    ? _("no run yet")
                        : !sb_contact_touches(seal)              ? _("no contact")
                        : sb_chart_frame(s->data)->velocity != 0 ? _("no liquid: no film")
                                                                 : _("at rest: no film");
    small_label(s, words, &note, (SbPlace[]){{x, y, SB_MIDDLE}, {x, y - 20, SB_MIDDLE}}, 2);
  }

  if (sigma_y > s->at.plot.y && sigma_y < bottom) {
    sb_format_given(value, SB_QUANTITY_FILM, sigma);
    g_snprintf(text, sizeof text, _("roughness \xcf\x83 %s"), value);
    SbTextStyle style = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
    double x = sb_contact_touches(seal)
                   ? sb_axis_at(&s->at.x, 0.5e3 * (seal->contact_left + seal->contact_right))
                   : left_px + 0.5 * s->at.plot.width;
    small_label(s, text, &style,
                (SbPlace[]){{x, sigma_y + 15, SB_MIDDLE},
                            {x, sigma_y - 6, SB_MIDDLE},
                            {right_px - 4, sigma_y + 15, SB_RIGHT},
                            {left_px + 4, sigma_y + 15, SB_LEFT}},
                4);
  }
  // A name needs a band that can be seen: a film well above it leaves a sliver at the bottom.
  double band = bottom - sb_axis_at(&s->at.y, SB_CONTINUUM_LIMIT);
  if (band >= 8 && !*s->band_named) {
    SbTextStyle style = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_WARN);
    double y = fmin(sb_axis_at(&s->at.y, SB_CONTINUUM_LIMIT) + 13, bottom - 5);
    // Once is enough: both charts share the scale. Over a curve only if there is no other way.
    s->labels->crossing_max = s->index == SB_INNER ? 1 : INFINITY;
    *s->band_named = small_label(s, _("below continuum"), &style,
                                 (SbPlace[]){{right_px - 6, bottom - 7, SB_RIGHT},
                                             {right_px - 6, y, SB_RIGHT},
                                             {left_px + 6, bottom - 7, SB_LEFT},
                                             {left_px + 6, y, SB_LEFT}},
                                 4);
  }
  sb_contact_curve_finish(&curve);
}

// A band where a film is thinner than a few molecules.
static void continuum_band(Small *s) {
  double y = sb_axis_at(&s->at.y, SB_CONTINUUM_LIMIT), bottom = s->at.plot.y + s->at.plot.height;
  if (y < bottom) {
    y = fmax(y, s->at.plot.y);
    sb_canvas_fill(s->canvas, (SbRect){s->at.plot.x, y, s->at.plot.width, bottom - y}, SB_ROLE_WARN,
                   0.13);
  }
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
static void layout(Small *s, SbRect in, unsigned flags, bool film) {
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
    Small s = {.data = data, .index = index, .seal = &frame->seal[index]};
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

static void draw_panel(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                       unsigned flags, bool film) {
  SbCanvas canvas;
  SbCanvas *c = &canvas;
  sb_canvas_init(c, cr, theme);
  bool compact = flags & SB_CHART_COMPACT, panel = flags & SB_CHART_PANEL;
  const SbFrame *frame = sb_chart_frame(data);
  if (panel) {
    sb_canvas_panel(c, rect);
  }
  const SbRect in = inner_rect(rect, flags);

  char note[160];
  if (film) {
    const bool gasket = sb_model_is_gasket(data->run.model);
    const char *bore = !frame || frame->velocity == 0  ? _("at rest")
                       : gasket && frame->velocity > 0 ? _("stem moves left")
                       : gasket                        ? _("stem moves right")
                       : frame->velocity > 0           ? _("bore moves right")
                                                       : _("bore moves left");
    g_snprintf(note, sizeof note, "%s%s",
               compact ? _("log scale, position / mm, ")
                       : _("log scale against axial position / mm, "),
               bore);
  } else {
    g_strlcpy(note,
              compact
                  ? _("MPa above the lower fluid, position / mm")
                  : _("MPa above the lower fluid pressure, position / mm, canister on the left"),
              sizeof note);
  }
  const char *model = curve_model(data, frame, film);
  if (model && !compact) {
    g_strlcat(note, "  \xc2\xb7  ", sizeof note);
    g_strlcat(note, model, sizeof note);
  }
  const bool predicted =
      predicted_seal(data, SB_INNER, film) != NULL || predicted_seal(data, SB_OUTER, film) != NULL;
  const double key = predicted ? sb_legend_predicted(c, in.x + in.width, in.y + 14) + 12 : 0;
  sb_frame_title(c, (SbRect){in.x, in.y, in.width - key, in.height},
                 compact ? SB_TYPE_PANEL_WINDOW : SB_TYPE_PANEL,
                 film ? _("Film thickness") : _("Contact pressure"), note);

  static const int order[2] = {SB_INNER, SB_OUTER};
  SbLabels *labels = g_new(SbLabels, 1);
  bool band_named = false;
  for (int k = 0; k < 2; k++) {
    Small s = {
        .canvas = c, .labels = labels, .data = data, .index = order[k], .band_named = &band_named};
    s.color = sb_theme_seal(theme, s.index);
    s.seal = frame ? &frame->seal[s.index] : NULL;
    layout(&s, in, flags, film);
    sb_labels_init(labels, (SbRect){s.at.plot.x - 2, s.at.plot.y - 12, s.at.plot.width + 4,
                                    s.at.plot.height + 12});
    SbTextStyle name = {SB_TYPE_LABEL, 600, s.color, 1};
    sb_canvas_text(c, sb_chart_seal_name(data->run.model, s.index), &name, s.at.plot.x,
                   in.y + (compact ? 34 : 40), SB_LEFT);
    if (film) {
      continuum_band(&s);
    }
    sb_axes_draw(c, &s.at, labels);
    pinned_curves(&s, film);
    // What is predicted is dashed, over the paler curve of the former run.
    const SbSealFrame *coming = predicted_seal(data, s.index, film);
    if (data->predicted != NULL) {
      cairo_push_group(cr);
    }
    (film ? film_chart : pressure_chart)(&s);
    if (data->predicted != NULL) {
      cairo_pop_group_to_source(cr);
      cairo_paint_with_alpha(cr, SB_OPACITY_EARLIER);
    }
    if (coming != NULL) {
      sb_canvas_pen(c, SB_LINE_SEAL, &sb_dash_predicted);
      sb_canvas_color(c, s.color, 1);
      other_curve(&s, &data->predicted->run, coming, film);
    }
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
