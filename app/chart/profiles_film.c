// The charts of the film thickness [m], logarithmic, against the axial position [mm]. A seal at
// rest has no film; that is stated in words.
#include "app/base/format.h"
#include "app/chart/profiles_private.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>

SbPoint *sb_profile_film_points(const SbProfileChart *s, const SbContactCurve *curve,
                                const SbSealFrame *seal, size_t *count) {
  SbPoint *p = g_new(SbPoint, curve->count + 1);
  size_t n = 0;
  const double from = seal->land_fraction < 0.999F ? seal->contact_left : -1;
  for (size_t i = 0; i < curve->count; i++) {
    if (curve->x[i] >= from && curve->film[i] > 0) {
      p[n++] = sb_axes_at(&s->at, curve->x[i] * 1e3, curve->film[i]);
    }
  }
  *count = n;
  return p;
}

// Central and least film where one line of both is wider than the contact: one under the other, the
// least next to the curve; where that would cross the curve, with the word on a line of its own.
static void narrow_label(SbProfileChart *s, const char *const *value, int count,
                         const SbTextStyle *style, const SbSealFrame *seal, double y) {
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
  if (!sb_labels_put(s->labels, s->canvas, text, style, clear, 4)) {
    // In three lines within the contact, or on the side of it that has more room.
    const double wide = sb_canvas_text_width(s->canvas, value[count - 1], style);
    const bool inside = right - left - 24 >= wide, before = left - s->at.plot.x > right_px - right;
    const SbPlace at = inside   ? (SbPlace){x, y - 9, SB_MIDDLE}
                       : before ? (SbPlace){left, y - 9, SB_RIGHT}
                                : (SbPlace){right, y - 9, SB_LEFT};
    const bool beside = count > 1 &&
                        (inside || fmax(left - s->at.plot.x, right_px - right) >= wide) &&
                        sb_labels_put(s->labels, s->canvas, value[count - 1], style, &at, 1) &&
                        sb_labels_put(s->labels, s->canvas, C_("film", "least"), style,
                                      &(SbPlace){at.x, at.y - line, at.align}, 1);
    s->labels->crossing_max = crossing_max;
    if (!beside) {
      sb_labels_put(s->labels, s->canvas, text, style, clear, 3);
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
    if (!sb_labels_put(s->labels, s->canvas, value[0], style, above, 4)) {
      s->labels->crossing_max = crossing_max;
      sb_labels_put(s->labels, s->canvas, value[0], style, above, 3);
    }
  }
  s->labels->crossing_max = crossing_max;
}

// The dashed line of the roughness; returns its height, or a number outside of the plot.
static double draw_roughness(SbProfileChart *s) {
  const double sigma = s->data->run.model ? sb_model_sigma(s->data->run.model) : 0;
  const double at = sigma > 0 ? sb_axis_at(&s->at.y, sigma) : -1e9;
  const double left = s->at.plot.x, right = left + s->at.plot.width;
  if (at > s->at.plot.y && at < s->at.plot.y + s->at.plot.height) {
    const double y = floor(at) + 0.5;
    sb_canvas_line(s->canvas, (SbStroke){SB_ROLE_SECOND, 1.2, &sb_dash_reference}, left, y, right,
                   y);
    sb_labels_avoid(s->labels, (SbPoint[]){{left, y}, {right, y}}, 2, 1);
  }
  return at;
}

static void roughness_label(SbProfileChart *s, double y) {
  const double left = s->at.plot.x, right = left + s->at.plot.width;
  if (!(y > s->at.plot.y && y < s->at.plot.y + s->at.plot.height)) {
    return;
  }
  char value[SB_FORMAT_MAX], text[128];
  sb_format_trimmed(value, SB_QUANTITY_FILM, sb_model_sigma(s->data->run.model), 3);
  g_snprintf(text, sizeof text, _("roughness \xcf\x83 %s"), value);
  const SbTextStyle style = sb_canvas_style(s->canvas, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  const double x =
      sb_contact_touches(s->seal)
          ? sb_axis_at(&s->at.x, 0.5e3 * (s->seal->contact_left + s->seal->contact_right))
          : left + 0.5 * s->at.plot.width;
  sb_labels_put(s->labels, s->canvas, text, &style,
                (SbPlace[]){{x, y + 15, SB_MIDDLE},
                            {x, y - 6, SB_MIDDLE},
                            {right - 4, y + 15, SB_RIGHT},
                            {left + 4, y + 15, SB_LEFT}},
                4);
}

// Names the band below the continuum limit once, as both charts share the scale; a film well above
// it leaves too narrow a band.
static void continuum_label(SbProfileChart *s) {
  const double left = s->at.plot.x, right = left + s->at.plot.width;
  const double bottom = s->at.plot.y + s->at.plot.height;
  const double top = sb_axis_at(&s->at.y, SB_CONTINUUM_LIMIT);
  if (bottom - top < 8 || *s->band_named) {
    return;
  }
  const SbTextStyle style = sb_canvas_style(s->canvas, SB_TYPE_NOTE, 400, SB_ROLE_WARN);
  const double y = fmin(top + 13, bottom - 5);
  // Over a curve only where the second chart leaves no other place.
  s->labels->crossing_max = s->index == SB_INNER ? 1 : INFINITY;
  *s->band_named = sb_labels_put(s->labels, s->canvas, _("below continuum"), &style,
                                 (SbPlace[]){{right - 6, bottom - 7, SB_RIGHT},
                                             {right - 6, y, SB_RIGHT},
                                             {left + 6, bottom - 7, SB_LEFT},
                                             {left + 6, y, SB_LEFT}},
                                 4);
}

// Central and minimum film above the flat part of the curve.
static void thickness_label(SbProfileChart *s) {
  const SbSealFrame *seal = s->seal;
  const double left = sb_axis_at(&s->at.x, seal->contact_left * 1e3);
  const double right = sb_axis_at(&s->at.x, seal->contact_right * 1e3);
  const SbPoint p =
      sb_axes_at(&s->at, 0.5e3 * (seal->contact_left + seal->contact_right), seal->film_central);
  const bool uniform = seal->film_min >= 0.995 * seal->film_central;
  const SbTextStyle style = sb_profile_style(s);
  char value[SB_FORMAT_MAX], least[SB_FORMAT_MAX], text[128];
  sb_profile_figure(value, s, "film_central_m", seal->film_central);
  sb_profile_figure(least, s, "film_min_m", seal->film_min);
  g_snprintf(text, sizeof text, uniform ? _("%s, uniform") : _("%s, least %s"), value, least);
  if (sb_canvas_text_width(s->canvas, text, &style) + 8 <= right - left) {
    sb_labels_put(s->labels, s->canvas, text, &style,
                  (SbPlace[]){{p.x, p.y - 9, SB_MIDDLE}, {p.x, p.y - 24, SB_MIDDLE}}, 2);
  } else {
    narrow_label(s, (const char *const[]){value, least}, uniform ? 1 : 2, &style, seal, p.y);
  }
}

static void draw_curve(SbProfileChart *s) {
  SbContactCurve curve;
  size_t n = 0;
  sb_contact_curve_init(&curve, &s->data->run, s->seal, s->index);
  g_autofree SbPoint *p = sb_profile_film_points(s, &curve, s->seal, &n);
  sb_canvas_clip(s->canvas, s->at.plot);
  sb_canvas_curve(s->canvas, (SbStroke){s->role, SB_LINE_SEAL, NULL}, p, n);
  cairo_restore(s->canvas->cr);
  sb_labels_avoid(s->labels, p, n, 1);
  sb_contact_curve_finish(&curve);
}

static void no_film(SbProfileChart *s) {
  const SbTextStyle note = sb_canvas_style(s->canvas, SB_TYPE_LABEL, 600, SB_ROLE_SECOND);
  const double x = s->at.plot.x + 0.5 * s->at.plot.width;
  const double y = s->at.plot.y + 0.62 * s->at.plot.height;
  const char *words = !s->seal                                 ? _("no run yet")
                      : !sb_contact_touches(s->seal)           ? _("no contact")
                      : sb_chart_frame(s->data)->velocity != 0 ? _("no liquid: no film")
                                                               : _("at rest: no film");
  sb_labels_put(s->labels, s->canvas, words, &note,
                (SbPlace[]){{x, y, SB_MIDDLE}, {x, y - 20, SB_MIDDLE}}, 2);
}

void sb_profile_film(SbProfileChart *s) {
  const double roughness = draw_roughness(s);
  if (sb_contact_touches(s->seal) && s->seal->film_central > 0) {
    draw_curve(s);
    thickness_label(s);
  } else {
    no_film(s);
  }
  roughness_label(s, roughness);
  continuum_label(s);
}

void sb_profile_continuum(SbProfileChart *s) {
  const double bottom = s->at.plot.y + s->at.plot.height;
  const double y = fmax(sb_axis_at(&s->at.y, SB_CONTINUUM_LIMIT), s->at.plot.y);
  if (y < bottom) {
    sb_canvas_fill(s->canvas, (SbRect){s->at.plot.x, y, s->at.plot.width, bottom - y}, SB_ROLE_WARN,
                   0.13);
  }
}
