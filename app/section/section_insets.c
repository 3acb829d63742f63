// The two insets on one seal: the contact pressure over the bore, to scale axially and radially,
// and the film, whose radial scale is enlarged by a factor that the inset states. Both scales are
// the same over the run. The pressure is the profile's total contact pressure, with the fluid's
// outside of the contact. The film inset omits the roughness and states that. Where the seal is off
// the land or the run stored no profile, the inset states this.
#include "app/base/figure_text.h"

#include "app/chart/data.h"
#include "app/section/section_inset_private.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <stdio.h>

// Positions that both insets show [m]: *range in total, about *centre.
static void range_of(const SbSection *section, double *centre, double *range) {
  const int seal = section->view->inset_seal;
  const double left = section->limits.contact_left[seal];
  const double right = section->limits.contact_right[seal];
  *centre = (left + right) / 2;
  *range = fmax(1.9 * (right - left), 0.75 * sb_model_seal(section->model, seal)->section_diameter);
}

SbSectionInset sb_section_inset(SbSection *section, const SbRect *rect, double line, double full,
                                double top) {
  const int seal = section->view->inset_seal;
  const SbPalette *palette = section->palette;
  const SbSealFrame *frame = &section->instant->frame->seal[seal];
  double centre, range;
  range_of(section, &centre, &range);
  SbSectionInset inset = {
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

size_t sb_section_inset_curve(const SbSectionInset *in, const double *value, double low,
                              SbPoint *points) {
  const SbRect *rect = &in->rect;
  // A curve that rises and falls twice fits into the array.
  const double length = rect->width + 4 * rect->height + 300;
  const double step = fmax(0.6, length / (SB_SECTION_INSET_CURVE - 2));
  size_t count = 0;
  for (size_t i = 0; i < in->profile->count && count < SB_SECTION_INSET_CURVE; i++) {
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

void sb_section_inset_fill(const SbSectionInset *in, double x, double y, double right, double low,
                           SbColor color) {
  sb_draw_rect(in->list, x, y, right - x, low - y, color)->feather = false;
}

void sb_section_inset_fluids(const SbSectionInset *in, double top, double split) {
  sb_section_inset_fill(in, in->rect.x, top, split, in->low,
                        sb_palette_fluid(in->palette, in->frame->pressure_left));
  sb_section_inset_fill(in, split, top, in->right, in->low,
                        sb_palette_fluid(in->palette, in->frame->pressure_right));
}

void sb_section_inset_frame(const SbSectionInset *in, const char *content, const char *brief) {
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

// Fluid, then the housing over the seal, then the ring.
static void draw_parts(const SbSectionInset *in) {
  SbSection *section = in->section;
  const double line = in->y.p0, scale = in->rect.width / (in->x.hi - in->x.lo);
  const double bore = section->valve.bore;
  sb_section_inset_fluids(in, in->rect.y,
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
static void draw_pressure_curve(const SbSectionInset *in, double *end) {
  if (in->profile == NULL || in->profile->count < 2) {
    return;
  }
  g_autofree SbPoint *points = g_new(SbPoint, SB_SECTION_INSET_CURVE + 2);
  const double line = in->y.p0;
  const double near = 0.01 * fabs(sb_axis_at(&in->y, in->section->limits.pressure_max) - line);
  const double left = sb_axis_at(&in->y, in->frame->pressure_left);
  const double right = sb_axis_at(&in->y, in->frame->pressure_right);
  SbPoint *first = points + 1;
  size_t count =
      sb_section_inset_curve(in, in->profile->pressure, in->gasket ? in->low : line, first);
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
static void draw_fluid_pressure(const SbSectionInset *in, const double *end) {
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
    sb_section_inset_fill(in, from[i], fmin(y, line), to[i], fmax(y, line),
                          (SbColor){color.r, color.g, color.b, 0.16});
    sb_draw_line(in->list, from[i], y, to[i], y, 2, color);
    snprintf(text, sizeof text, _("fluid %s"), sb_section_megapascal(value, step[i]));
    if (sb_text_width(in->section->text, text, 11, 600) + 14 < to[i] - from[i]) {
      sb_section_label(in->section, i == 0 ? from[i] + 8 : to[i] - 8, in->gasket ? y + 16 : y - 7,
                       &style, text);
    }
  }
}

static void label_peak(const SbSectionInset *in) {
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
  const SbSectionLabel style = {13, 700, SB_MIDDLE, in->color, in->body};
  sb_section_label(in->section, CLAMP(x, in->rect.x + 50, in->right - 50),
                   sb_axis_at(&in->y, pressure) + (in->gasket ? 18 : -9), &style,
                   sb_seal_figure_text(value, in->section->instant->summary, in->seal,
                                       "pressure_peak_Pa", pressure));
}

// The width of the contact, as a dimension.
static void label_contact(const SbSectionInset *in) {
  const double left = in->left_contact, right = in->right_contact;
  const double y = in->y.p0 + (in->gasket ? -17 : 17);
  const SbColor ink = in->palette->ink;
  char text[96], value[SB_SECTION_NUMBER];
  snprintf(text, sizeof text, _("contact %s"),
           sb_seal_figure_text(value, in->section->instant->summary, in->seal, "contact_width_m",
                               in->frame->contact_right - in->frame->contact_left));
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
  const SbSectionInset inset =
      sb_section_inset(section, rect, line, fmax(section->limits.pressure_max, 1),
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
  sb_section_inset_frame(
      &inset, gasket ? _(", contact pressure on the stem") : _(", contact pressure on the bore"),
      _(", pressure"));
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
  sb_section_draw_film(section, film);
}
