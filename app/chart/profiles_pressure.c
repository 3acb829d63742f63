// The charts of the contact pressure [MPa] against the axial position [mm], above the lower fluid
// pressure, which both sides share and which is stated in words. Where the run stored a profile its
// points are drawn; elsewhere the shape of Hertz with the frame's peak and width.
#include "app/base/format.h"
#include "app/chart/profiles_private.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>

enum { BEYOND = 1 }; // a position outside of every plot [m]

// The asperities' share of the pressure: a dashed line under the curve, named once.
static void asperity_share(SbProfileChart *s, const SbContactCurve *curve, double left,
                           double right) {
  SbCanvas *c = s->canvas;
  g_autofree SbPoint *p = g_new(SbPoint, curve->count + 1);
  size_t n = 0, top = 0;
  for (size_t i = 0; i < curve->count; i++) {
    if (curve->x[i] >= left && curve->x[i] <= right) {
      p[n] = sb_axes_at(&s->at, curve->x[i] * 1e3, curve->asperity[i] * 1e-6);
      top = p[n].y < p[top].y ? n : top;
      n++;
    }
  }
  if (n > 1) {
    sb_canvas_curve(c, (SbStroke){s->role, SB_LINE_FRAME, &sb_dash_dimension}, p, n);
    sb_labels_avoid(s->labels, p, n, 1);
    const SbTextStyle style = sb_canvas_style(c, SB_TYPE_NOTE, 400, s->role);
    // Low over the axis the curve's foot and the width's figure are in the way: beside it there.
    double bottom = s->at.plot.y + s->at.plot.height;
    bool low = p[top].y > bottom - 24;
    const SbPlace places[] = {{p[n - 1].x + 8, fmin(p[top].y, bottom - 7), SB_LEFT},
                              {p[top].x, p[top].y - 6, SB_MIDDLE},
                              {p[top].x, p[top].y + 14, SB_MIDDLE},
                              {p[n - 1].x + 8, p[top].y, SB_LEFT}};
    sb_labels_put(s->labels, s->canvas, _("asperities"), &style, places + !low, 3);
  }
}

// Ground of the fluid on one side of the contact, up to its pressure.
static void fluid_ground(SbProfileChart *s, double from, double to, double pressure) {
  if (!(pressure > 0)) {
    return;
  }
  SbCanvas *c = s->canvas;
  double x0 =
      CLAMP(sb_axis_at(&s->at.x, from * 1e3), s->at.plot.x, s->at.plot.x + s->at.plot.width);
  double x1 = CLAMP(sb_axis_at(&s->at.x, to * 1e3), s->at.plot.x, s->at.plot.x + s->at.plot.width);
  double y = sb_axis_at(&s->at.y, pressure * 1e-6), bottom = s->at.plot.y + s->at.plot.height;
  sb_canvas_fill(c, (SbRect){x0, y, x1 - x0, bottom - y}, SB_ROLE_FLUID, 0.15);
  sb_canvas_line(c, (SbStroke){SB_ROLE_FLUID, 1.6, NULL}, x0, y, x1, y);
  SbPoint line[2] = {{x0, y}, {x1, y}};
  sb_labels_avoid(s->labels, line, 2, 1);
}

static void fluid_label(SbProfileChart *s, double from, double to, double pressure) {
  if (!(pressure > 0)) {
    return;
  }
  double x0 = fmax(sb_axis_at(&s->at.x, from * 1e3), s->at.plot.x);
  double x1 = fmin(sb_axis_at(&s->at.x, to * 1e3), s->at.plot.x + s->at.plot.width);
  double y = sb_axis_at(&s->at.y, pressure * 1e-6);
  char value[SB_FORMAT_MAX], text[64];
  sb_format_trimmed(value, SB_QUANTITY_PRESSURE, pressure, 3);
  g_snprintf(text, sizeof text, _("fluid %s"), value);
  SbTextStyle style = sb_canvas_style(s->canvas, SB_TYPE_LABEL, 400, SB_ROLE_FLUID);
  if (sb_canvas_text_width(s->canvas, text, &style) + 8 > x1 - x0) {
    g_strlcpy(text, value, sizeof text);
  }
  const SbPlace places[] = {
      {x0 + 4, y - 6, SB_LEFT}, {x1 - 4, y - 6, SB_RIGHT}, {x0 + 4, y + 16, SB_LEFT}};
  sb_labels_put(s->labels, s->canvas, text, &style, places, 3);
}

// The curve leaves out the fluid pressure that both sides share; a label states it.
static void common_label(SbProfileChart *s) {
  const SbSealFrame *seal = s->seal;
  double common = seal ? fmin((double)seal->pressure_left, (double)seal->pressure_right) : 0;
  if (!(common > 0)) {
    return;
  }
  char value[SB_FORMAT_MAX], text[96];
  sb_format_trimmed(value, SB_QUANTITY_PRESSURE, common, 3);
  g_snprintf(text, sizeof text, _("fluid %s on both sides"), value);
  SbTextStyle style = sb_canvas_style(s->canvas, SB_TYPE_NOTE, 400, SB_ROLE_FLUID);
  double left = s->at.plot.x + 4, right = s->at.plot.x + s->at.plot.width - 4;
  sb_labels_put(s->labels, s->canvas, text, &style,
                (SbPlace[]){{left, s->at.plot.y + 12, SB_LEFT},
                            {right, s->at.plot.y + 12, SB_RIGHT},
                            {left, s->at.plot.y + 30, SB_LEFT}},
                3);
}

static void contact_ends(const SbContactCurve *curve, const SbSealFrame *seal, double *left,
                         double *right) {
  *left = seal->contact_left;
  *right = seal->contact_right;
  if (curve->model && seal->land_fraction > 0.999F) {
    sb_contact_curve_extend(curve, seal, left, right);
  }
}

SbPoint *sb_profile_pressure_points(const SbProfileChart *s, const SbContactCurve *curve,
                                    const SbSealFrame *seal, size_t *count) {
  double left, right;
  contact_ends(curve, seal, &left, &right);
  SbPoint *p = g_new(SbPoint, curve->count + 4);
  size_t n = 0;
  p[n++] =
      (SbPoint){sb_axis_at(&s->at.x, left * 1e3),
                sb_axis_at(&s->at.y, sb_contact_curve_at(curve, curve->pressure, left) * 1e-6)};
  for (size_t i = 0; i < curve->count; i++) {
    if (curve->x[i] > left && curve->x[i] < right) {
      p[n++] = sb_axes_at(&s->at, curve->x[i] * 1e3, curve->pressure[i] * 1e-6);
    }
  }
  p[n++] =
      (SbPoint){sb_axis_at(&s->at.x, right * 1e3),
                sb_axis_at(&s->at.y, sb_contact_curve_at(curve, curve->pressure, right) * 1e-6)};
  *count = n;
  return p;
}

// The peak of a curve between the ends of the contact: its dot and its label.
static void peak_label(SbProfileChart *s, const SbContactCurve *curve, double left, double right) {
  double peak = 0, peak_x = 0.5 * (left + right);
  for (size_t i = 0; i < curve->count; i++) {
    if (curve->x[i] > left && curve->x[i] < right && curve->pressure[i] > peak) {
      peak = curve->pressure[i];
      peak_x = curve->x[i];
    }
  }
  if (!(peak > 0)) {
    return;
  }
  const SbPoint p = sb_axes_at(&s->at, peak_x * 1e3, peak * 1e-6);
  const SbTextStyle style = sb_profile_style(s);
  char value[SB_FORMAT_MAX], text[96];
  sb_canvas_dot(s->canvas, p.x, p.y, 2.6, sb_canvas_role(s->canvas, s->role));
  sb_profile_figure(value, s, "pressure_peak_Pa", s->seal->pressure_peak);
  g_snprintf(text, sizeof text, _("peak %s"), value);
  sb_labels_put(s->labels, s->canvas, text, &style,
                (SbPlace[]){{p.x, p.y - 9, SB_MIDDLE},
                            {p.x + 8, p.y - 9, SB_LEFT},
                            {p.x - 8, p.y - 9, SB_RIGHT},
                            {s->at.plot.x + 4, s->at.plot.y + 10, SB_LEFT}},
                4);
}

// The width of the frame's contact, whatever the curve's feet: inside if it fits, else to the
// right.
static void width_label(SbProfileChart *s, double right) {
  const SbSealFrame *seal = s->seal;
  const double wide = seal->contact_right - seal->contact_left;
  const double bottom = s->at.plot.y + s->at.plot.height;
  const SbTextStyle strong = sb_canvas_style(s->canvas, SB_TYPE_LABEL, 600, SB_ROLE_INK);
  char value[SB_FORMAT_MAX];
  sb_profile_figure(value, s, "contact_width_m", wide);
  const double room = sb_axis_at(&s->at.x, wide * 1e3) - sb_axis_at(&s->at.x, 0);
  const bool inside = sb_canvas_text_width(s->canvas, value, &strong) + 8 < room;
  const double middle = sb_axis_at(&s->at.x, 0.5e3 * (seal->contact_left + seal->contact_right));
  SbPlace at = inside ? (SbPlace){middle, bottom - 8, SB_MIDDLE}
                      : (SbPlace){sb_axis_at(&s->at.x, right * 1e3) + 8, bottom - 8, SB_LEFT};
  if (sb_labels_place(s->labels, s->canvas, value, &strong, &at, 1, &at)) {
    sb_canvas_text(s->canvas, value, &strong, at.x, at.y, at.align);
  }
}

// How much of the seal is on the land: its edge takes the canister side away, where there is room.
static void land_label(SbProfileChart *s) {
  const SbSealFrame *seal = s->seal;
  if (!(seal->land_fraction < 0.999F)) {
    return;
  }
  char text[96];
  g_snprintf(text, sizeof text, _("%.0f\xc2\xa0%% on the land"),
             100.0 * (double)seal->land_fraction);
  const SbTextStyle note = sb_canvas_style(s->canvas, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  const double bottom = s->at.plot.y + s->at.plot.height;
  const double edge = sb_axis_at(&s->at.x, seal->contact_left * 1e3) - 6;
  const double middle = sb_axis_at(&s->at.x, 0.5e3 * (seal->contact_left + seal->contact_right));
  sb_labels_put(s->labels, s->canvas, text, &note,
                (SbPlace[]){{edge, bottom - 8, SB_RIGHT},
                            {edge, bottom - 26, SB_RIGHT},
                            {middle, bottom - 26, SB_MIDDLE}},
                3);
}

static void no_contact(SbProfileChart *s) {
  const double side = s->seal ? fmax(sb_seal_step_left(s->seal), sb_seal_step_right(s->seal)) : 0;
  fluid_ground(s, -BEYOND, BEYOND, side);
  fluid_label(s, -BEYOND, BEYOND, side);
  const SbTextStyle note = sb_canvas_style(s->canvas, SB_TYPE_LABEL, 600, SB_ROLE_SECOND);
  const double x = s->at.plot.x + 0.5 * s->at.plot.width;
  const double y = s->at.plot.y + 0.5 * s->at.plot.height;
  sb_labels_put(s->labels, s->canvas, s->seal ? _("no contact") : _("no run yet"), &note,
                (SbPlace[]){{x, y, SB_MIDDLE}, {x, y - 30, SB_MIDDLE}, {x, y + 30, SB_MIDDLE}}, 3);
  common_label(s);
}

void sb_profile_pressure(SbProfileChart *s) {
  SbCanvas *c = s->canvas;
  const SbSealFrame *seal = s->seal;
  if (!sb_contact_touches(seal)) {
    no_contact(s);
    return;
  }
  double left, right;
  SbContactCurve curve;
  sb_contact_curve_init(&curve, &s->data->run, seal, s->index);
  contact_ends(&curve, seal, &left, &right);
  fluid_ground(s, -BEYOND, left, sb_seal_step_left(seal));
  fluid_ground(s, right, BEYOND, sb_seal_step_right(seal));

  size_t n = 0;
  g_autofree SbPoint *p = sb_profile_pressure_points(s, &curve, seal, &n);
  const double bottom = s->at.plot.y + s->at.plot.height;
  p[n] = (SbPoint){p[n - 1].x, bottom};
  p[n + 1] = (SbPoint){p[0].x, bottom};
  sb_canvas_area(c, p, n + 2, s->role, c->theme->curve_fill);
  sb_canvas_curve(c, (SbStroke){s->role, SB_LINE_SEAL, NULL}, p, n);
  sb_labels_avoid(s->labels, p, n, 1);

  peak_label(s, &curve, left, right);
  width_label(s, right);
  fluid_label(s, -BEYOND, left, sb_seal_step_left(seal));
  fluid_label(s, right, BEYOND, sb_seal_step_right(seal));
  common_label(s);
  if (curve.asperities) {
    asperity_share(s, &curve, left, right);
  }
  land_label(s);
  sb_contact_curve_finish(&curve);
}
