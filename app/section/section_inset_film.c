// The inset of the film under the contact of one seal; see section_insets.c.
#include "app/section/section_inset_private.h"

#include "app/base/figure_text.h"
#include "app/base/format.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <stdio.h>

// Returns the fraction of the contact's load that asperities carry, or a negative number.
static double asperity_share(const SbContactProfile *profile, const SbSealFrame *frame) {
  // Asperities carry a part of the pressure that the film's own solution has.
  const double *pressure =
      profile->film_pressure != NULL ? profile->film_pressure : profile->pressure;
  double carried = 0, total = 0;
  for (size_t i = 1; i < profile->count; i++) {
    const double x = (profile->x[i] + profile->x[i - 1]) / 2;
    const double dx = profile->x[i] - profile->x[i - 1];
    if (x >= frame->contact_left && x <= frame->contact_right) {
      carried += dx * (profile->asperity_pressure[i] + profile->asperity_pressure[i - 1]) / 2;
      total += dx * (pressure[i] + pressure[i - 1]) / 2;
    }
  }
  return total > 0 ? carried / total : -1;
}

// The fluid changes where the film ends: at the contact's edge, or where a solved film opens.
static double film_end(const SbSectionInset *in) {
  const SbContactProfile *profile = in->profile;
  double end = in->frame->contact_right;
  for (size_t i = profile != NULL ? profile->count : 0; i-- > 0;) {
    if (profile->film[i] > 0 && profile->film[i] < 2 * in->frame->film_central) {
      end = fmax(end, profile->x[i]);
      break;
    }
  }
  return in->contact ? CLAMP(sb_axis_at(&in->x, end), in->rect.x, in->right) : in->right;
}

// Draws the ring's surface under the bore, on a scale that holds over the film, or without a film
// (`film`) the ring from the line of the contact down. Returns the top of its body [px].
static double draw_body(const SbSectionInset *in, bool film, double split) {
  const SbColor body = sb_color_mix(in->palette->panel, in->color, in->palette->dark ? 0.24 : 0.22);
  const double below = in->low + 40;
  if (!film) {
    sb_section_inset_fill(in, in->left_contact, in->y.p0, split, in->low, body);
    return in->y.p0;
  }
  g_autofree SbPoint *points = g_new(SbPoint, SB_SECTION_INSET_CURVE + 2);
  const size_t count = sb_section_inset_curve(in, in->profile->film, below, points);
  if (count < 2) {
    return in->low;
  }
  // A solved film ends where it ruptures; beyond, the gap opens by micrometres: a vertical here.
  const SbPoint last = points[count - 1];
  const bool rupture = last.y < in->low && last.x < in->right;
  points[count] = (SbPoint){last.x, below};
  points[count + 1] = (SbPoint){points[0].x, below};
  sb_draw_fill(in->list, points, count + 2, body)->feather = false;
  sb_draw_stroke(in->list, points, rupture ? count + 1 : count, 2.4, in->color);
  if (rupture) {
    sb_draw_disc(in->list, last.x, last.y, 4.6, in->palette->panel);
    sb_draw_disc(in->list, last.x, last.y, 3.2, in->color);
  }
  return sb_axis_at(&in->y, in->frame->film_central);
}

// The scale of the film, on the right.
static void draw_film_scale(const SbSectionInset *in) {
  const bool micro = in->y.hi >= 2e-6;
  const double unit = micro ? 1e-6 : 1e-9, x = in->right - 14;
  const SbColor ink = in->palette->ink;
  SbTicks ticks;
  sb_axis_ticks(&ticks, 0, in->y.hi / unit, 2);
  for (int i = 0; i < ticks.count; i++) {
    char value[SB_FORMAT_MAX], text[SB_FORMAT_MAX + 8];
    const double y = sb_axis_at(&in->y, ticks.value[i] * unit);
    sb_axis_text(value, &ticks, ticks.value[i]);
    snprintf(text, sizeof text, "%s %s", value, micro ? "\xc2\xb5m" : "nm");
    sb_draw_line(in->list, x - 5, y, x, y, 1.2, ink);
    sb_draw_text(in->list, x - 9, i == 0 ? y + 13 : y + 4, 11, 400, SB_RIGHT, ink, text);
  }
  sb_draw_line(in->list, x, in->y.p0, x, in->y.p1, 1.2, ink);
}

// The motion of the bore in the seal's frame.
static void draw_motion(const SbSectionInset *in) {
  const double velocity = in->section->instant->frame->velocity, left = in->rect.x;
  const double y = (in->rect.y + in->y.p0) / 2;
  const SbSectionLabel small = {11, 400, SB_LEFT, in->palette->ink, &in->palette->housing};
  if (fabs(velocity) > 0) {
    const bool out = (velocity < 0) != in->gasket; // the surface, to the left
    sb_draw_arrow(in->list, left + (out ? 58 : 14), y, left + (out ? 14 : 58), y, 1.4, 8, 7,
                  in->palette->ink);
    sb_section_label(in->section, left + 68, y + 4, &small,
                     in->gasket ? _("stem, relative to the seal")
                                : _("bore, relative to the seal"));
  } else {
    sb_section_label(in->section, left + 14, y + 4, &small,
                     in->gasket ? _("stem, at rest") : _("bore, at rest"));
  }
}

// A line of text about x, moved to be inside of the inset.
static void film_text(const SbSectionInset *in, double x, double y, double size, int weight,
                      SbColor color, const char *text) {
  const double half = sb_text_width(in->section->text, text, size, weight) / 2 + 8;
  x = CLAMP(x, in->rect.x + half, in->right - half);
  sb_draw_text(in->list, x, y, size, weight, SB_MIDDLE, color, text);
}

// The reason why a contact has no film.
static void draw_no_film(const SbSectionInset *in, double x, double y) {
  const bool rest = in->frame->film_central <= 0;
  const bool dry = rest && fabs(in->section->instant->frame->velocity) > 0;
  const char *why = dry    ? _("no liquid at the inlet: no film")
                    : rest ? _("at rest: no film, the surfaces touch")
                           : _("no film profile in this run");
  char text[192], value[SB_SECTION_NUMBER];
  if (sb_text_width(in->section->text, why, 12, 600) > in->rect.width - 16) {
    why = dry ? _("no liquid: no film") : rest ? _("at rest: no film") : _("no film profile");
  }
  film_text(in, x, y, 12, 600, in->palette->ink, why);
  snprintf(text, sizeof text, _("asperities carry the load, \xcf\x83 %s %s"),
           sb_section_significant(value, sb_model_sigma(in->section->model) * 1e6), "\xc2\xb5m");
  if (rest && sb_text_width(in->section->text, text, 11, 400) + 16 < in->rect.width) {
    film_text(in, x, y + 18, 11, 400, in->palette->second, text);
  }
}

// The figures in `width` px about x, from y to `bottom`; roughness and asperities where there is
// room.
static void draw_figures(const SbSectionInset *in, double x, double y, double bottom,
                         double width) {
  const SbColor ink = in->palette->ink, second = in->palette->second;
  char text[192], value[SB_SECTION_NUMBER], least[SB_SECTION_NUMBER], ratio[SB_SECTION_NUMBER];
  const SbSummary *summary = in->section->instant->summary;
  sb_seal_figure_text(value, summary, in->seal, "film_central_m", in->frame->film_central);
  sb_seal_figure_text(least, summary, in->seal, "film_min_m", in->frame->film_min);
  const double across = in->rect.width / (in->x.hi - in->x.lo);
  sb_section_two_digits(ratio, (in->y.p1 - in->y.p0) / (in->y.hi * across));
  snprintf(text, sizeof text, _("centre %s, least %s"), value, least);
  if (sb_text_width(in->section->text, text, 12, 600) > width - 12) {
    snprintf(text, sizeof text, _("centre %s"), value);
    film_text(in, x, y, 12, 600, ink, text);
    snprintf(text, sizeof text, C_("film", "least %s"), least);
    film_text(in, x, y + 17, 12, 600, ink, text);
    film_text(in, x, y + 35, 12, 400, ink, _("radial scale"));
    snprintf(text, sizeof text, _("\xc3\x97 %s of axial"), ratio);
    film_text(in, x, y + 52, 12, 400, ink, text);
    return;
  }
  film_text(in, x, y, 12, 600, ink, text);
  snprintf(text, sizeof text, _("radial scale \xc3\x97 %s of axial"), ratio);
  film_text(in, x, y + 18, 12, 400, ink, text);
  if (y + 40 < bottom) {
    snprintf(text, sizeof text, _("roughness \xcf\x83 %s %s is not drawn"),
             sb_section_significant(value, sb_model_sigma(in->section->model) * 1e6), "\xc2\xb5m");
    film_text(in, x, y + 35, 11, 400, second, text);
  }
  const double share = asperity_share(in->profile, in->frame);
  if (share > 0 && y + 58 < bottom) {
    snprintf(text, sizeof text, _("asperities carry %s %% of the load"),
             sb_section_fixed(value, 100 * share, share > 0.1 ? 0 : 1));
    film_text(in, x, y + 52, 11, 400, second, text);
  }
}

// The texts: inside the ring's body, or in the film where that is thicker.
static void draw_film_texts(const SbSectionInset *in, bool film, double split, double top) {
  const double bore = in->y.p0, low = in->low;
  const double left = in->contact ? fmax(in->left_contact, in->rect.x) : in->rect.x;
  const double x = (left + split) / 2;
  if (!in->contact) {
    film_text(in, x, (bore + low) / 2, 12, 600, in->color,
              in->gasket ? _("around the neck: no film") : _("off the land: no film"));
  } else if (!film) {
    draw_no_film(in, x, (bore + low) / 2);
  } else if (low - top > 66 || low - top > top - bore) {
    draw_figures(in, x, fmax(top, bore) + 24, low, split - left);
  } else {
    draw_figures(in, x, bore + 22, top, split - left);
  }
}

void sb_section_draw_film(SbSection *section, const SbRect *rect) {
  const SbPalette *palette = section->palette;
  const double bore = rect->y + fmin(32, 0.2 * rect->height);
  // The thickest film fills half of the scale, so that the texts fit below it.
  double least = 0, full = fmax(2 * section->limits.film_max, 1e-12);
  sb_axis_round_out(&least, &full, 2);
  const SbSectionInset inset =
      sb_section_inset(section, rect, bore, full, bore + 0.82 * (rect->y + rect->height - bore));
  const bool film = inset.contact && inset.profile != NULL && inset.profile->count > 1 &&
                    inset.frame->film_central > 0;
  const double split = film_end(&inset);
  sb_draw_clip(section->list, rect);
  sb_section_inset_fluids(&inset, bore, split);
  SbDrawItem *ground =
      sb_draw_rect(section->list, rect->x, rect->y, rect->width, bore - rect->y, palette->housing);
  ground->feather = false;
  ground->hatch = sb_draw_hatch(palette->housing_hatch, SB_HATCH_PITCH, SB_HATCH_WIDTH, 1, 0);
  const double top = inset.contact ? draw_body(&inset, film, split) : inset.low;
  sb_draw_line(section->list, rect->x, bore, inset.right, bore, 1.8, palette->outline);
  if (film) {
    draw_film_scale(&inset);
  }
  draw_motion(&inset);
  draw_film_texts(&inset, film, split, top);
  sb_section_inset_frame(&inset, _(", film under the contact"), _(", film"));
}
