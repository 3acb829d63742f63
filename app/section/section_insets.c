// The two insets on one seal: the contact pressure over the bore, to scale axially and radially,
// and the film, whose radial scale is enlarged by a factor that the inset states. Both scales are
// the same over the run. The pressure is the profile's total contact pressure, with the fluid's
// outside of the contact. The film inset omits the roughness and states that. Where the seal is off
// the land or the run stored no profile, the inset states this.
#include "app/base/figure_text.h"
#include "app/chart/data.h"
#include "app/draw/axis.h"
#include "app/section/section_private.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <stdio.h>

enum { CURVE_MAX = 2000 };

typedef struct {
  SbSection *section;
  SbDrawList *list;
  const SbPalette *palette;
  int seal;
  bool gasket;
  SbColor color;       // of the seal
  const SbColor *body; // of the sliding part: housing, or stem below a gasket
  const SbSealFrame *frame;
  const SbContactProfile *profile; // NULL: none
  bool contact;                    // the seal is in contact with the bore
  SbRect rect;
  double right, low;                  // right and lower end of `rect` [px]
  SbScale x;                          // position in the seal's frame [m]
  SbScale y;                          // pressure [Pa] or film [m], 0 at the line of the contact
  double left_contact, right_contact; // ends of the contact [px]
} Inset;

// Positions that both insets show [m]: *range in total, about *centre.
static void range_of(const SbSection *section, double *centre, double *range) {
  const int seal = section->view->inset_seal;
  const double left = section->limits.contact_left[seal];
  const double right = section->limits.contact_right[seal];
  *centre = (left + right) / 2;
  *range = fmax(1.9 * (right - left), 0.75 * sb_model_seal(section->model, seal)->section_diameter);
}

// Returns an inset whose values up to `full` reach from the line of the contact to `top` [px].
static Inset make_inset(SbSection *section, const SbRect *rect, double line, double full,
                        double top) {
  const int seal = section->view->inset_seal;
  const SbPalette *palette = section->palette;
  const SbSealFrame *frame = &section->instant->frame->seal[seal];
  double centre, range;
  range_of(section, &centre, &range);
  Inset inset = {
      .section = section,
      .list = section->list,
      .palette = palette,
      .seal = seal,
      .gasket = section->valve.gasket,
      .color = palette->seal[seal],
      .body = section->valve.gasket ? &palette->stem : &palette->housing,
      .frame = frame,
      .profile = section->instant->profile[seal],
      .contact = frame->land_fraction > 0 && frame->contact_right > frame->contact_left,
      .rect = *rect,
      .right = rect->x + rect->width,
      .low = rect->y + rect->height,
      .x = {centre - range / 2, centre + range / 2, rect->x, rect->x + rect->width, false},
      .y = {0, full, line, top, false}};
  inset.left_contact = sb_axis_at(&inset.x, frame->contact_left);
  inset.right_contact = sb_axis_at(&inset.x, frame->contact_right);
  return inset;
}

// Thins the values of the profile to the pixels of the inset, not below `low`: runs of samples,
// ends kept. Returns the point count. Points are as far apart as makes a curve that rises and falls
// twice fit into CURVE_MAX.
static size_t curve(const Inset *in, const double *value, double low, SbPoint *points) {
  const SbRect *rect = &in->rect;
  const double length = rect->width + 4 * rect->height + 300;
  const double step = fmax(0.6, length / (CURVE_MAX - 2));
  size_t count = 0;
  for (size_t i = 0; i < in->profile->count && count < CURVE_MAX; i++) {
    const double x = sb_axis_at(&in->x, in->profile->x[i]);
    if (x < rect->x - 60 || x > in->right + 60) {
      continue;
    }
    const double y = fmin(sb_axis_at(&in->y, value[i]), low);
    if (count == 0 || i + 1 == in->profile->count ||
        hypot(x - points[count - 1].x, y - points[count - 1].y) >= step) {
      points[count++] = (SbPoint){x, y};
    }
  }
  return count;
}

// Fills a rectangle, from corner to corner.
static void fill(const Inset *in, double x, double y, double right, double low, SbColor color) {
  sb_draw_rect(in->list, x, y, right - x, low - y, color)->feather = false;
}

// Fills what is below `top` with the fluids on the left and right of x = `split`.
static void draw_fluids(const Inset *in, double top, double split) {
  fill(in, in->rect.x, top, split, in->low,
       sb_palette_fluid(in->palette, in->frame->pressure_left));
  fill(in, split, top, in->right, in->low,
       sb_palette_fluid(in->palette, in->frame->pressure_right));
}

// Draws the frame with the seal's name and its content, in brief where the frame is too narrow.
static void draw_frame(const Inset *in, const char *content, const char *brief) {
  const SbRect *rect = &in->rect;
  const char *const name = sb_chart_seal_name(in->section->model, in->seal);
  const double width = sb_text_width(in->section->text, name, 13, 700);
  sb_draw_clip(in->list, NULL);
  sb_draw_round_frame(in->list, rect->x + 0.5, rect->y + 0.5, rect->width - 1, rect->height - 1, 4,
                      1.4, in->color);
  sb_draw_text(in->list, rect->x, rect->y - 9, 13, 700, SB_LEFT, in->palette->ink, name);
  if (width + sb_text_width(in->section->text, content, 13, 400) > rect->width) {
    content = brief;
  }
  sb_draw_text(in->list, rect->x + width, rect->y - 9, 13, 400, SB_LEFT, in->palette->ink, content);
}

// Contact pressure --------------------------------------------------------------------------------

// Fluid, then the housing over the seal, then the ring.
static void draw_parts(const Inset *in) {
  SbSection *section = in->section;
  const double line = in->y.p0, scale = in->rect.width / (in->x.hi - in->x.lo);
  const double bore = section->valve.bore;
  draw_fluids(in, in->rect.y,
              CLAMP((in->left_contact + in->right_contact) / 2, in->rect.x, in->right));
  const SbSectionFrameMap map =
      sb_section_frame_map(sb_axis_at(&in->x, -sb_section_origin(section, in->seal)),
                           line + bore * scale, scale, &in->rect);
  sb_section_draw_housing(section, &map);
  if (in->gasket) {
    sb_section_draw_stem(section, &map);
  }
  const SbSectionPlane plane = {
      sb_axis_at(&in->x, 0), scale, 0, line + (bore - section->valve.floor) * scale, 0, -scale};
  sb_section_draw_ring(section, in->seal, &plane);
  if (in->gasket) {
    const double free = sb_model_seal(section->model, in->seal)->inner_diameter / 2;
    const double y = line + (bore - free) * scale;
    const SbSectionLabel style = {11, 400, SB_RIGHT, in->color, in->body};
    sb_draw_line(in->list, in->rect.x, y, in->right, y, 1.2, in->color)->dash = &sb_dash_dimension;
    sb_section_label(section, in->right - 8, y + 14, &style, _("free bore"));
  }
}

// Draws the pressure from the line of the contact into what slides: the housing above rings, the
// stem below gaskets. Writes the left and right end of the drawn part, which includes the contact,
// to end[2] [px]. Where the pressure outside of the contact is the fluid's it is left to
// draw_fluid_pressure(); a film's inlet belongs to the seal.
static void draw_pressure_curve(const Inset *in, double *end) {
  if (in->profile == NULL || in->profile->count < 2) {
    return;
  }
  g_autofree SbPoint *points = g_new(SbPoint, CURVE_MAX + 2);
  const double line = in->y.p0;
  const double near = 0.01 * fabs(sb_axis_at(&in->y, in->section->limits.pressure_max) - line);
  const double left = sb_axis_at(&in->y, in->frame->pressure_left);
  const double right = sb_axis_at(&in->y, in->frame->pressure_right);
  SbPoint *first = points + 1;
  size_t count = curve(in, in->profile->pressure, in->gasket ? in->low : line, first);
  while (count > 1 && first->x < end[0] - 0.3 && fabs(first[1].y - left) < near) {
    first++;
    count--;
  }
  while (count > 1 && first[count - 1].x > end[1] + 0.3 &&
         fabs(first[count - 2].y - right) < near) {
    count--;
  }
  end[0] = fmin(end[0], first[0].x);
  end[1] = fmax(end[1], first[count - 1].x);
  first[-1] = (SbPoint){first[0].x, line};
  first[count] = (SbPoint){first[count - 1].x, line};
  const SbColor pale = {in->color.r, in->color.g, in->color.b, 0.3};
  sb_draw_fill(in->list, first - 1, count + 2, pale)->feather = false;
  sb_draw_stroke(in->list, first, count, 2.4, in->color);
}

// The fluid's pressure on the left and right of end[2].
static void draw_fluid_pressure(const Inset *in, const double *end) {
  const double step[2] = {sb_seal_step_left(in->frame), sb_seal_step_right(in->frame)};
  const double from[2] = {in->rect.x, end[1]}, to[2] = {end[0], in->right};
  const SbColor color = in->palette->fluid_line;
  for (int i = 0; i < 2; i++) {
    const double line = in->y.p0, y = sb_axis_at(&in->y, step[i]);
    if (fabs(y - line) < 1) {
      continue;
    }
    char text[96], value[SB_SECTION_NUMBER];
    const SbSectionLabel style = {11, 600, i == 0 ? SB_LEFT : SB_RIGHT, color, in->body};
    fill(in, from[i], fmin(y, line), to[i], fmax(y, line),
         (SbColor){color.r, color.g, color.b, 0.16});
    sb_draw_line(in->list, from[i], y, to[i], y, 2, color);
    snprintf(text, sizeof text, _("fluid %s"), sb_section_megapascal(value, step[i]));
    if (sb_text_width(in->section->text, text, 11, 600) + 14 < to[i] - from[i]) {
      sb_section_label(in->section, i == 0 ? from[i] + 8 : to[i] - 8, in->gasket ? y + 16 : y - 7,
                       &style, text);
    }
  }
}

static void label_peak(const Inset *in) {
  const SbContactProfile *profile = in->profile;
  const double pressure = in->frame->pressure_peak;
  double x = (in->left_contact + in->right_contact) / 2, greatest = 0;
  for (size_t i = 0; profile != NULL && i < profile->count; i++) {
    if (profile->pressure[i] > greatest) {
      greatest = profile->pressure[i];
      x = sb_axis_at(&in->x, profile->x[i]);
    }
  }
  char value[SB_SECTION_NUMBER];
  const int figure = sb_figure_find(in->seal == SB_OUTER ? "seals.outer.pressure_peak_Pa"
                                                         : "seals.inner.pressure_peak_Pa");
  const SbSectionLabel style = {13, 700, SB_MIDDLE, in->color, in->body};
  sb_section_label(in->section, CLAMP(x, in->rect.x + 50, in->right - 50),
                   sb_axis_at(&in->y, pressure) + (in->gasket ? 18 : -9), &style,
                   sb_figure_text(value, figure, pressure, NAN));
}

// The width of the contact, as a dimension.
static void label_contact(const Inset *in) {
  const double left = in->left_contact, right = in->right_contact;
  const double y = in->y.p0 + (in->gasket ? -17 : 17);
  const SbColor ink = in->palette->ink;
  char text[96], value[SB_SECTION_NUMBER];
  snprintf(text, sizeof text, _("contact %s"),
           sb_section_millimetre(value, in->frame->contact_right - in->frame->contact_left));
  sb_draw_line(in->list, left, y - 5, left, y + 5, 1.2, ink);
  sb_draw_line(in->list, right, y - 5, right, y + 5, 1.2, ink);
  sb_draw_line(in->list, left, y, right, y, 1.2, ink);
  const SbSectionLabel style = {11, 600, SB_MIDDLE, ink, &in->palette->panel};
  const bool inside = right - left > sb_text_width(in->section->text, text, 11, 600) + 30;
  sb_section_label(in->section, (left + right) / 2,
                   inside       ? y + 4
                   : in->gasket ? y - 10
                                : fmin(y + 20, in->low - 6),
                   &style, text);
}

static void draw_pressure(SbSection *section, const SbRect *rect) {
  const bool gasket = section->valve.gasket;
  const double line = rect->y + (gasket ? 0.5 : 0.74) * rect->height;
  const Inset inset = make_inset(section, rect, line, fmax(section->limits.pressure_max, 1),
                                 gasket ? rect->y + rect->height - 34 : rect->y + 34);
  sb_draw_clip(section->list, rect);
  draw_parts(&inset);
  if (inset.contact) {
    double end[2] = {inset.left_contact, inset.right_contact};
    draw_pressure_curve(&inset, end);
    draw_fluid_pressure(&inset, end);
    label_peak(&inset);
    label_contact(&inset);
  } else {
    const SbSectionLabel style = {12, 600, SB_MIDDLE, inset.color, &inset.palette->panel};
    sb_section_label(section, rect->x + rect->width / 2, rect->y + 24, &style,
                     gasket ? _("around the neck: no contact") : _("off the land: no contact"));
  }
  draw_frame(&inset,
             gasket ? _(", contact pressure on the stem") : _(", contact pressure on the bore"),
             _(", pressure"));
}

// Film --------------------------------------------------------------------------------------------

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
static double film_end(const Inset *in) {
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
static double draw_body(const Inset *in, bool film, double split) {
  const SbColor body = sb_color_mix(in->palette->panel, in->color, in->palette->dark ? 0.24 : 0.22);
  const double below = in->low + 40;
  if (!film) {
    fill(in, in->left_contact, in->y.p0, split, in->low, body);
    return in->y.p0;
  }
  g_autofree SbPoint *points = g_new(SbPoint, CURVE_MAX + 2);
  const size_t count = curve(in, in->profile->film, below, points);
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
static void draw_film_scale(const Inset *in) {
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
static void draw_motion(const Inset *in) {
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
static void film_text(const Inset *in, double x, double y, double size, int weight, SbColor color,
                      const char *text) {
  const double half = sb_text_width(in->section->text, text, size, weight) / 2 + 8;
  x = CLAMP(x, in->rect.x + half, in->right - half);
  sb_draw_text(in->list, x, y, size, weight, SB_MIDDLE, color, text);
}

// The reason why a contact has no film.
static void draw_no_film(const Inset *in, double x, double y) {
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
static void draw_figures(const Inset *in, double x, double y, double bottom, double width) {
  const SbColor ink = in->palette->ink, second = in->palette->second;
  char text[192], value[SB_SECTION_NUMBER], least[SB_SECTION_NUMBER], ratio[SB_SECTION_NUMBER];
  sb_section_film(value, in->frame->film_central);
  sb_section_film(least, in->frame->film_min);
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
static void draw_film_texts(const Inset *in, bool film, double split, double top) {
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

static void draw_film(SbSection *section, const SbRect *rect) {
  const SbPalette *palette = section->palette;
  const double bore = rect->y + fmin(32, 0.2 * rect->height);
  // The thickest film fills half of the scale, so that the texts fit below it.
  double least = 0, full = fmax(2 * section->limits.film_max, 1e-12);
  sb_axis_round_out(&least, &full, 2);
  const Inset inset =
      make_inset(section, rect, bore, full, bore + 0.82 * (rect->y + rect->height - bore));
  const bool film = inset.contact && inset.profile != NULL && inset.profile->count > 1 &&
                    inset.frame->film_central > 0;
  const double split = film_end(&inset);
  sb_draw_clip(section->list, rect);
  draw_fluids(&inset, bore, split);
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
  draw_frame(&inset, _(", film under the contact"), _(", film"));
}

// From both insets to a box round the contact in the strip.
void sb_section_draw_leader(SbSection *section, const SbRect *pressure, const SbRect *film) {
  const SbColor color = section->palette->seal[section->view->inset_seal];
  double centre, range;
  range_of(section, &centre, &range);
  const double origin = sb_section_origin(section, section->view->inset_seal);
  const SbPoint middle = sb_section_at(section, origin + centre, section->valve.bore);
  const double width = range * section->scale;
  const double height = 0.26 * pressure->height / pressure->width * width;
  const double above = fmin(8, 0.5 * height), strip_right = section->strip.x + section->strip.width;
  const double left = CLAMP(middle.x - width / 2, section->strip.x, strip_right - width);
  const double top = middle.y - above, bottom = film->y + film->height, drop = left + 7;
  const double elbow = (bottom + section->strip.y) / 2 + 1;
  const double from = pressure->x + pressure->width / 2, to = film->x + film->width / 2;
  const bool stacked = film->y > pressure->y;
  const double nearest = stacked || drop > to ? to : from; // of the bracket
  const SbPoint bracket[4] = {{from, bottom}, {from, elbow}, {to, elbow}, {to, bottom}};
  sb_draw_round_frame(section->list, left, top, width, height + above, 3, 1.4, color);
  sb_draw_stroke(section->list, bracket + (stacked ? 2 : 0), stacked ? 2 : 4, 1.2, color);
  if (stacked || drop < from || drop > to) {
    sb_draw_line(section->list, nearest, elbow, drop, elbow, 1.2, color);
  }
  sb_draw_line(section->list, drop, elbow, drop, top, 1.2, color);
  sb_section_reserve(section, drop - 2, elbow, 4, top - elbow);
}

void sb_section_draw_insets(SbSection *section, const SbRect *pressure, const SbRect *film) {
  draw_pressure(section, pressure);
  draw_film(section, film);
}
