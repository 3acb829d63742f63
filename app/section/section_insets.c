// The two insets on one seal: contact pressure over the bore, to scale axially and radially, and
// the film, whose radial scale is blown up by a factor that is written on it.
//
// Pressure is the profile's total contact pressure with the fluid's outside the contact; its scale
// is the same over the whole film. The film inset leaves the roughness out and says so. Where the
// seal is off the land or the run kept no profile, the inset says that instead.
#include "app/chart/data.h"
#include "app/section/section_private.h"

#include "app/base/figure_text.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <stdio.h>

enum { CURVE_MAX = 2000 };

typedef struct {
  SbRect rect;
  double centre, scale; // seal's x in the middle [m], px per m
} Inset;

static double inset_x(const Inset *inset, double x) {
  return inset->rect.x + inset->rect.width / 2 + (x - inset->centre) * inset->scale;
}

// Thins a profile to the pixels of an inset: runs of samples, ends kept. Returns the point count.
// Points are as far apart as makes a curve that rises and falls twice fit into CURVE_MAX.
static size_t curve(const Inset *inset, const SbContactProfile *profile, const double *value,
                    double base, double px, double low, SbPoint *points) {
  size_t count = 0;
  double way = (double)inset->rect.width + 4 * (double)inset->rect.height + 300;
  double step = fmax(0.6, way / (CURVE_MAX - 2));
  for (size_t i = 0; i < profile->count; i++) {
    double x = inset_x(inset, profile->x[i]);
    if (x < inset->rect.x - 60 || x > inset->rect.x + inset->rect.width + 60) {
      continue;
    }
    double y = MIN(base - value[i] * px, low);
    if (count > 0 && i + 1 < profile->count) {
      double dx = x - points[count - 1].x, dy = y - points[count - 1].y;
      if (dx * dx + dy * dy < step * step) {
        continue;
      }
    }
    if (count == CURVE_MAX) {
      break;
    }
    points[count++] = (SbPoint){x, y};
  }
  return count;
}

// The seal's name and what is shown of it, in brief where the frame is too narrow for all of it.
static void inset_title(SbSection *section, const Inset *inset, int seal, const char *what,
                        const char *brief) {
  const SbPalette *palette = section->palette;
  const char *const name = sb_chart_seal_name(section->model, seal);
  double y = inset->rect.y - 9;
  sb_draw_text(section->list, inset->rect.x, y, 13, 700, SB_LEFT, palette->ink, name);
  double width = sb_text_width(section->text, name, 13, 700);
  if (width + sb_text_width(section->text, what, 13, 400) > inset->rect.width) {
    what = brief;
  }
  sb_draw_text(section->list, inset->rect.x + width, y, 13, 400, SB_LEFT, palette->ink, what);
}

static void frame_inset(SbSection *section, const Inset *inset, int seal) {
  const SbRect *rect = &inset->rect;
  sb_draw_clip(section->list, NULL);
  sb_draw_round_frame(section->list, rect->x + 0.5, rect->y + 0.5, rect->width - 1,
                      rect->height - 1, 4, 1.4, section->palette->seal[seal]);
}

static void hatch_rect(SbSection *section, double x, double y, double width, double height) {
  SbDrawItem *item = sb_draw_rect(section->list, x, y, width, height, section->palette->housing);
  item->feather = false;
  item->hatch =
      sb_draw_hatch(section->palette->housing_hatch, SB_HATCH_PITCH, SB_HATCH_WIDTH, 1, 0);
}

static void draw_pressure(SbSection *section, const Inset *inset, int seal) {
  const SbPalette *palette = section->palette;
  SbDrawList *list = section->list;
  const SbRect *rect = &inset->rect;
  const SbSealFrame *frame = &section->instant->frame->seal[seal];
  const SbContactProfile *profile = section->instant->profile[seal];
  bool contact = frame->land_fraction > 0 && frame->contact_right > frame->contact_left;
  // Pressure rises from the line of the contact into what slides: the housing above rings, the stem
  // below gaskets.
  const bool gasket = section->valve.gasket;
  const double up = gasket ? -1 : 1;
  double bore = rect->y + (gasket ? 0.5 : 0.74) * rect->height;
  char text[96], value[SB_SECTION_NUMBER];
  const SbColor *body = gasket ? &palette->stem : &palette->housing;

  // Fluid, then the housing as it stands over the seal, then the ring.
  sb_draw_clip(list, rect);
  double middle = inset_x(inset, (frame->contact_left + frame->contact_right) / 2);
  middle = CLAMP(middle, rect->x, rect->x + rect->width);
  sb_draw_rect(list, rect->x, rect->y, middle - rect->x, rect->height,
               sb_palette_fluid(palette, frame->pressure_left))
      ->feather = false;
  sb_draw_rect(list, middle, rect->y, rect->x + rect->width - middle, rect->height,
               sb_palette_fluid(palette, frame->pressure_right))
      ->feather = false;
  SbSectionFrameMap map =
      sb_section_frame_map(inset_x(inset, -sb_section_origin(section, seal)),
                           bore + section->valve.bore * inset->scale, inset->scale, rect);
  sb_section_draw_housing(section, &map);
  if (gasket) {
    sb_section_draw_stem(section, &map);
  }
  const double deep = section->valve.bore - section->valve.floor;
  const SbSectionPlane plane = {inset_x(inset, 0), inset->scale, 0, bore + deep * inset->scale, 0,
                                -inset->scale};
  sb_section_draw_ring(section, seal, &plane);
  if (gasket) {
    const double free = sb_model_seal(section->model, seal)->inner_diameter / 2;
    const double line = bore + (section->valve.bore - free) * inset->scale;
    sb_draw_line(list, rect->x, line, rect->x + rect->width, line, 1.2, palette->seal[seal])->dash =
        &sb_dash_dimension;
    SbSectionLabel style = {11, 400, SB_RIGHT, palette->seal[seal], body};
    sb_section_label(section, rect->x + rect->width - 8, line + 14, &style, _("free bore"));
  }

  // Pressure rises from the bore line into the housing.
  const double room = gasket ? rect->y + rect->height - bore : bore - rect->y;
  double px = (room - 34) / fmax(section->limits.pressure_max, 1);
  double left_px = inset_x(inset, frame->contact_left);
  double right_px = inset_x(inset, frame->contact_right);
  if (profile != NULL && profile->count > 1 && contact) {
    g_autofree SbPoint *points = g_new(SbPoint, CURVE_MAX + 2);
    size_t count = curve(inset, profile, profile->pressure, bore, up * px,
                         gasket ? rect->y + rect->height : bore, points + 1);
    // Outside the contact as far as the pressure is the fluid's it is drawn in the fluid's colour;
    // a film's inlet belongs to the seal.
    SbPoint *first = points + 1;
    double near = 0.01 * section->limits.pressure_max * px;
    double left_y = bore - up * (double)frame->pressure_left * px;
    double right_y = bore - up * (double)frame->pressure_right * px;
    size_t begin = 0, end = count;
    while (begin + 1 < count && (double)first[begin].x < left_px - 0.3 &&
           fabs((double)first[begin + 1].y - left_y) < near) {
      begin++;
    }
    while (end > begin + 1 && (double)first[end - 1].x > right_px + 0.3 &&
           fabs((double)first[end - 2].y - right_y) < near) {
      end--;
    }
    SbPoint *from = first + begin;
    size_t inside = end - begin;
    SbPoint before = *(from - 1), after = first[end];
    from[-1] = (SbPoint){from[0].x, bore};
    first[end] = (SbPoint){from[inside - 1].x, bore};
    SbColor fill = palette->seal[seal];
    fill.a = 0.3;
    sb_draw_fill(list, from - 1, inside + 2, fill)->feather = false;
    from[-1] = before;
    first[end] = after;
    sb_draw_stroke(list, from, inside, 2.4, palette->seal[seal]);
    left_px = fmin(left_px, (double)from[0].x);
    right_px = fmax(right_px, (double)from[inside - 1].x);
  }
  const double side[2][3] = {{rect->x, left_px, sb_seal_step_left(frame)},
                             {right_px, rect->x + rect->width, sb_seal_step_right(frame)}};
  for (int i = 0; i < 2 && contact; i++) {
    double height = side[i][2] * px;
    if (height < 1) {
      continue;
    }
    SbColor wash = palette->fluid_line;
    wash.a = 0.16;
    const double top = gasket ? bore : bore - height, line = bore - up * height;
    sb_draw_rect(list, side[i][0], top, side[i][1] - side[i][0], height, wash)->feather = false;
    sb_draw_line(list, side[i][0], line, side[i][1], line, 2, palette->fluid_line);
    snprintf(text, sizeof text, _("fluid %s"), sb_section_megapascal(value, side[i][2]));
    SbSectionLabel style = {11, 600, i == 0 ? SB_LEFT : SB_RIGHT, palette->fluid_line, body};
    double x = i == 0 ? rect->x + 8 : rect->x + rect->width - 8;
    if (sb_text_width(section->text, text, 11, 600) + 14 < side[i][1] - side[i][0]) {
      sb_section_label(section, x, gasket ? line + 16 : line - 7, &style, text);
    }
  }

  // Peak, and the contact's width.
  left_px = inset_x(inset, frame->contact_left);
  right_px = inset_x(inset, frame->contact_right);
  if (contact) {
    double peak_x = (left_px + right_px) / 2;
    const double peak_pressure = frame->pressure_peak;
    if (profile != NULL) {
      double best = 0;
      for (size_t i = 0; i < profile->count; i++) {
        if (profile->pressure[i] > best) {
          best = profile->pressure[i];
          peak_x = inset_x(inset, profile->x[i]);
        }
      }
    }
    const int figure = sb_figure_find(seal == SB_OUTER ? "seals.outer.pressure_peak_Pa"
                                                       : "seals.inner.pressure_peak_Pa");
    SbSectionLabel peak = {13, 700, SB_MIDDLE, palette->seal[seal], body};
    sb_section_label(section, CLAMP(peak_x, rect->x + 50, rect->x + rect->width - 50),
                     bore - up * peak_pressure * px + (gasket ? 18 : -9), &peak,
                     sb_figure_text(value, figure, peak_pressure, NAN));
    double y = bore + up * 17;
    SbColor line = palette->ink;
    snprintf(text, sizeof text, _("contact %s"),
             sb_section_millimetre(value, frame->contact_right - frame->contact_left));
    sb_draw_line(list, left_px, y - 5, left_px, y + 5, 1.2, line);
    sb_draw_line(list, right_px, y - 5, right_px, y + 5, 1.2, line);
    sb_draw_line(list, left_px, y, right_px, y, 1.2, line);
    SbSectionLabel style = {11, 600, SB_MIDDLE, palette->ink, &palette->panel};
    bool inside = right_px - left_px > sb_text_width(section->text, text, 11, 600) + 30;
    sb_section_label(section, (left_px + right_px) / 2,
                     inside   ? y + 4
                     : gasket ? y - 10
                              : fmin(y + 20, (double)(rect->y + rect->height) - 6),
                     &style, text);
  } else {
    SbSectionLabel style = {12, 600, SB_MIDDLE, palette->seal[seal], &palette->panel};
    sb_section_label(section, rect->x + rect->width / 2, rect->y + 24, &style,
                     gasket ? _("around the neck: no contact") : _("off the land: no contact"));
  }
  frame_inset(section, inset, seal);
  inset_title(section, inset, seal,
              gasket ? _(", contact pressure on the stem") : _(", contact pressure on the bore"),
              _(", pressure"));
}

// Least round number (1, 2, 3, 4, 5, 6, 8 times a power of ten) that is not below v.
static double nice_above(double v) {
  static const double round[] = {1, 2, 3, 4, 5, 6, 8};
  double unit = pow(10, floor(log10(v)));
  for (size_t i = 0; i < G_N_ELEMENTS(round); i++) {
    if (v <= round[i] * unit * (1 + 1e-12)) {
      return round[i] * unit;
    }
  }
  return 10 * unit;
}

// Share of the contact's load that asperities carry, or a negative number.
static double asperity_share(const SbContactProfile *profile, const SbSealFrame *frame) {
  // Asperities carry a part of the pressure that the film's own solution has.
  const double *pressure =
      profile->film_pressure != NULL ? profile->film_pressure : profile->pressure;
  double carried = 0, total = 0;
  for (size_t i = 1; i < profile->count; i++) {
    double x = (profile->x[i] + profile->x[i - 1]) / 2;
    if (x < frame->contact_left || x > frame->contact_right) {
      continue;
    }
    double dx = profile->x[i] - profile->x[i - 1];
    carried += dx * (profile->asperity_pressure[i] + profile->asperity_pressure[i - 1]) / 2;
    total += dx * (pressure[i] + pressure[i - 1]) / 2;
  }
  return total > 0 ? carried / total : -1;
}

static void draw_film(SbSection *section, const Inset *inset, int seal) {
  const SbPalette *palette = section->palette;
  SbDrawList *list = section->list;
  const SbRect *rect = &inset->rect;
  const SbFrame *whole = section->instant->frame;
  const SbSealFrame *frame = &whole->seal[seal];
  const SbContactProfile *profile = section->instant->profile[seal];
  bool contact = frame->land_fraction > 0 && frame->contact_right > frame->contact_left;
  double bore = rect->y + MIN(32, 0.2 * rect->height);
  double low = rect->y + rect->height;
  double right = rect->x + rect->width;
  char text[192], value[SB_SECTION_NUMBER];

  sb_draw_clip(list, rect);
  // The fluid changes where the film ends: at the contact's edge, or where a solved film opens.
  double film_end = frame->contact_right;
  for (size_t i = profile != NULL ? profile->count : 0; i-- > 0;) {
    if (profile->film[i] > 0 && profile->film[i] < 2 * frame->film_central) {
      film_end = fmax(film_end, profile->x[i]);
      break;
    }
  }
  double split = contact ? CLAMP(inset_x(inset, film_end), (double)rect->x, right) : right;
  sb_draw_rect(list, rect->x, bore, split - rect->x, low - bore,
               sb_palette_fluid(palette, frame->pressure_left))
      ->feather = false;
  sb_draw_rect(list, split, bore, right - split, low - bore,
               sb_palette_fluid(palette, frame->pressure_right))
      ->feather = false;
  hatch_rect(section, rect->x, rect->y, rect->width, bore - rect->y);

  // The ring's surface under the bore, on a scale that holds over the film.
  double full = nice_above(fmax(1.35 * section->limits.film_max, 1e-12));
  double px = 0.82 * (low - bore) / full;
  bool film = contact && profile != NULL && profile->count > 1 && frame->film_central > 0;
  double body_top = low;
  if (film) {
    g_autofree SbPoint *points = g_new(SbPoint, CURVE_MAX + 2);
    size_t count = curve(inset, profile, profile->film, bore, -px, low + 40, points);
    if (count > 1) {
      // A solved film ends where it ruptures; beyond, the gap opens by micrometres: a vertical
      // here.
      SbPoint last = points[count - 1];
      bool rupture = (double)last.y < low && last.x < right;
      points[count] = (SbPoint){last.x, (low + 40)};
      points[count + 1] = (SbPoint){points[0].x, (low + 40)};
      sb_draw_fill(list, points, count + 2,
                   sb_color_mix(palette->panel, palette->seal[seal], palette->dark ? 0.24 : 0.22))
          ->feather = false;
      sb_draw_stroke(list, points, rupture ? count + 1 : count, 2.4, palette->seal[seal]);
      if (rupture) {
        sb_draw_disc(list, last.x, last.y, 4.6, palette->panel);
        sb_draw_disc(list, last.x, last.y, 3.2, palette->seal[seal]);
      }
      body_top = bore + frame->film_central * px;
    }
  } else if (contact) {
    double left_px = inset_x(inset, frame->contact_left);
    sb_draw_rect(list, left_px, bore, split - left_px, low - bore,
                 sb_color_mix(palette->panel, palette->seal[seal], palette->dark ? 0.24 : 0.22))
        ->feather = false;
    body_top = bore;
  }
  sb_draw_line(list, rect->x, bore, right, bore, 1.8, palette->outline);

  // The scale of the film, right.
  bool micro = full >= 2e-6;
  for (int i = 0; i <= 2 && film; i++) {
    double y = bore + full / 2 * i * px;
    sb_draw_line(list, right - 19, y, right - 14, y, 1.2, palette->ink);
    double shown = full / 2 * i * (micro ? 1e6 : 1e9);
    sb_section_significant(value, shown);
    snprintf(text, sizeof text, "%s %s", value, micro ? "\xc2\xb5m" : "nm");
    sb_draw_text(list, right - 23, i == 0 ? y + 13 : y + 4, 11, 400, SB_RIGHT, palette->ink, text);
  }
  if (film) {
    sb_draw_line(list, right - 14, bore, right - 14, bore + full * px, 1.2, palette->ink);
  }

  // What the bore does in the seal's frame.
  double ground = rect->y + (bore - rect->y) / 2;
  SbSectionLabel small = {11, 400, SB_LEFT, palette->ink, &palette->housing};
  if (fabs(whole->velocity) > 0) {
    bool out = (whole->velocity < 0) != section->valve.gasket; // the surface, to the left
    sb_draw_arrow(list, rect->x + (out ? 58 : 14), ground, rect->x + (out ? 14 : 58), ground, 1.4,
                  8, 7, palette->ink);
    sb_section_label(section, rect->x + 68, ground + 4, &small,
                     section->valve.gasket ? _("stem, relative to the seal")
                                           : _("bore, relative to the seal"));
  } else {
    sb_section_label(section, rect->x + 14, ground + 4, &small,
                     section->valve.gasket ? _("stem, at rest") : _("bore, at rest"));
  }

  // The figures: inside the ring's body, or in the film where that is thicker.
  double left_edge = contact ? MAX(inset_x(inset, frame->contact_left), rect->x) : rect->x;
  double x = contact ? (left_edge + split) / 2 : rect->x + rect->width / 2;
  bool in_body = low - body_top > 66 || low - body_top > body_top - bore;
  double y = in_body ? MAX(body_top, bore) + 24 : bore + 22;
  double floor = in_body ? low : body_top;
  SbAlign centre = SB_MIDDLE;
  if (!contact) {
    sb_draw_text(list, x, (bore + low) / 2, 12, 600, centre, palette->seal[seal],
                 section->valve.gasket ? _("around the neck: no film")
                                       : _("off the land: no film"));
  } else if (!film) {
    // In a narrow inset in the middle, and its first words only.
    bool rest = frame->film_central <= 0, dry = rest && fabs(whole->velocity) > 0;
    const char *why = dry    ? _("no liquid at the inlet: no film")
                      : rest ? _("at rest: no film, the surfaces touch")
                             : _("no film profile in this run");
    if (sb_text_width(section->text, why, 12, 600) > rect->width - 16) {
      why = dry ? _("no liquid: no film") : rest ? _("at rest: no film") : _("no film profile");
    }
    double half = sb_text_width(section->text, why, 12, 600) / 2 + 8;
    x = CLAMP(x, rect->x + half, rect->x + rect->width - half);
    sb_draw_text(list, x, (bore + low) / 2, 12, 600, centre, palette->ink, why);
    if (rest) {
      snprintf(text, sizeof text, _("asperities carry the load, \xcf\x83 %s %s"),
               sb_section_significant(value, sb_model_sigma(section->model) * 1e6), "\xc2\xb5m");
      half = sb_text_width(section->text, text, 11, 400) / 2 + 8;
      if (2 * half < rect->width) {
        x = CLAMP(x, rect->x + half, rect->x + rect->width - half);
        sb_draw_text(list, x, (bore + low) / 2 + 18, 11, 400, centre, palette->second, text);
      }
    }
  } else {
    char least[SB_SECTION_NUMBER];
    sb_section_film(value, frame->film_central);
    sb_section_film(least, frame->film_min);
    snprintf(text, sizeof text, _("centre %s, least %s"), value, least);
    bool narrow = sb_text_width(section->text, text, 12, 600) > split - left_edge - 12;
    if (narrow) {
      snprintf(text, sizeof text, _("centre %s"), value);
      sb_draw_text(list, x, y, 12, 600, centre, palette->ink, text);
      y += 17;
      snprintf(text, sizeof text, C_("film", "least %s"), least);
    }
    sb_draw_text(list, x, y, 12, 600, centre, palette->ink, text);
    sb_section_two_digits(value, px / inset->scale);
    if (narrow) {
      sb_draw_text(list, x, y + 18, 12, 400, centre, palette->ink, _("radial scale"));
      y += 17;
      snprintf(text, sizeof text, _("\xc3\x97 %s of axial"), value);
    } else {
      snprintf(text, sizeof text, _("radial scale \xc3\x97 %s of axial"), value);
    }
    sb_draw_text(list, x, y + 18, 12, 400, centre, palette->ink, text);
    char sigma[SB_SECTION_NUMBER];
    snprintf(text, sizeof text, _("roughness \xcf\x83 %s %s is not drawn"),
             sb_section_significant(sigma, sb_model_sigma(section->model) * 1e6), "\xc2\xb5m");
    if (y + 40 < floor && !narrow) {
      sb_draw_text(list, x, y + 35, 11, 400, centre, palette->second, text);
    }
    double share = asperity_share(profile, frame);
    if (share > 0 && y + 58 < floor && !narrow) {
      snprintf(text, sizeof text, _("asperities carry %s %% of the load"),
               sb_section_fixed(value, 100 * share, share > 0.1 ? 0 : 1));
      sb_draw_text(list, x, y + 52, 11, 400, centre, palette->second, text);
    }
  }
  frame_inset(section, inset, seal);
  inset_title(section, inset, seal, _(", film under the contact"), _(", film"));
}

// The part of a seal that both insets show.
static Inset inset_of(const SbSection *section, const SbRect *rect) {
  int seal = section->view->inset_seal;
  const SbSectionLimits *limits = &section->limits;
  double left = limits->contact_left[seal], right = limits->contact_right[seal];
  double range =
      fmax(1.9 * (right - left), 0.75 * sb_model_seal(section->model, seal)->section_diameter);
  return (Inset){*rect, (left + right) / 2, (double)rect->width / range};
}

// From both insets to a box round the contact in the strip.
void sb_section_draw_leader(SbSection *section, const SbRect *pressure, const SbRect *film) {
  int seal = section->view->inset_seal;
  Inset inset = inset_of(section, pressure);
  SbColor color = section->palette->seal[seal];
  double origin = sb_section_origin(section, seal);
  double half = (double)pressure->width / 2 / inset.scale;
  SbPoint middle = sb_section_at(section, origin + inset.centre, section->valve.bore);
  double width = 2 * half * section->scale;
  double height = 0.26 * (double)pressure->height / inset.scale * section->scale;
  double above = MIN(8, 0.5 * height);
  double strip_right = (double)(section->strip.x + section->strip.width);
  double box_left =
      CLAMP((double)middle.x - width / 2, (double)section->strip.x, strip_right - width);
  double box_top = (double)middle.y - above;
  sb_draw_round_frame(section->list, box_left, box_top, width, height + above, 3, 1.4, color);
  bool stacked = film->y > pressure->y;
  double bottom = (double)(film->y + film->height);
  double elbow = (bottom + (double)section->strip.y) / 2 + 1;
  double from = (double)(pressure->x + pressure->width / 2);
  double to = (double)(film->x + film->width / 2);
  double drop = box_left + 7;
  const SbPoint bracket[4] = {{from, bottom}, {from, elbow}, {to, elbow}, {to, bottom}};
  if (stacked) {
    from = to;
    sb_draw_stroke(section->list, bracket + 2, 2, 1.2, color);
  } else {
    sb_draw_stroke(section->list, bracket, 4, 1.2, color);
  }
  if (drop < from || drop > to) {
    sb_draw_line(section->list, drop < from ? from : to, elbow, drop, elbow, 1.2, color);
  }
  sb_draw_line(section->list, drop, elbow, drop, box_top, 1.2, color);
  sb_section_reserve(section, drop - 2, elbow, 4, box_top - elbow);
}

void sb_section_draw_insets(SbSection *section, const SbRect *pressure, const SbRect *film) {
  int seal = section->view->inset_seal;
  Inset inset = inset_of(section, pressure);
  draw_pressure(section, &inset, seal);
  inset = inset_of(section, film);
  draw_film(section, &inset, seal);
}
