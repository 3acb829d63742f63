// Labels, dimensions and force arrows of the valve strip. Forces are to scale, 3.4 px per newton;
// labels on hatch get a plate in the body's colour, and one that would cover another moves or gives
// way.
#include "app/section/section_private.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <stdio.h>

double sb_section_axis(const SbSection *section) {
  return fmin((double)section->strip.y + (double)section->strip.height, section->y0);
}

SbSectionLabel sb_section_label_style(SbColor color, int weight, SbAlign align,
                                      const SbColor *plate) {
  return (SbSectionLabel){12, weight, align, color, plate};
}

// First of the candidate places (pairs x, y) where the label fits; false: none did.
bool sb_section_place(SbSection *section, const double (*at)[2], size_t count,
                      const SbSectionLabel *style, const char *string) {
  for (size_t i = 0; i < count; i++) {
    if (sb_section_label_fits(section, at[i][0], at[i][1], style, string, &section->strip)) {
      sb_section_label(section, at[i][0], at[i][1], style, string);
      return true;
    }
  }
  return false;
}

// "Canister 0.55 MPa" and its likes: a bold name, the value behind it or below. Gives way.
void sb_section_name_pressure(SbSection *section, double x, double y, const char *name,
                              double pressure, bool below) {
  const SbPalette *palette = section->palette;
  char value[SB_SECTION_NUMBER];
  SbSectionLabel bold = sb_section_label_style(palette->ink, 600, SB_LEFT, NULL);
  SbSectionLabel plain = sb_section_label_style(palette->ink, 400, SB_LEFT, NULL);
  sb_section_megapascal(value, pressure);
  const double at[1][2] = {{x, y}};
  if (!sb_section_place(section, at, 1, &bold, name)) {
    return;
  }
  double width = sb_text_width(section->text, name, bold.size, bold.weight);
  const double behind[1][2] = {{below ? x : x + width + 6, below ? y + 17 : y}};
  if (below || sb_section_label_fits(section, x + width + 10, y, &plain, value, NULL)) {
    sb_section_label(section, behind[0][0], behind[0][1], &plain, value);
  }
}

static void draw_regions(SbSection *section) {
  const SbPalette *palette = section->palette;
  const SbFrame *frame = section->instant->frame;
  const SbValveOutline *valve = &section->valve;
  const SbRect *strip = &section->strip;
  double top = (double)strip->y + 22;
  sb_section_name_pressure(section, (double)strip->x + 12, top, _("Canister"),
                           (double)frame->seal[SB_INNER].pressure_left, false);
  double end = (double)sb_section_at(section, valve->end, 0).x;
  sb_section_name_pressure(section, end + 10, top, _("Ambient"),
                           (double)frame->seal[SB_OUTER].pressure_right, true);

  bool has_vent = valve->vent_right > valve->vent_left;
  double vent = (double)sb_section_at(section, valve->vent_left, 0).x;
  double vent_end = (double)sb_section_at(section, valve->vent_right, 0).x;
  SbSectionLabel style = sb_section_label_style(palette->ink, 600, SB_RIGHT, &palette->housing);
  const double housing[1][2] = {{has_vent ? vent - 12 : end - 50, top}};
  sb_section_place(section, housing, 1, &style, _("Housing"));
  SbSectionLabel small = sb_section_label_style(palette->second, 400, SB_LEFT, &palette->housing);
  double room = end - vent_end - 16;
  if (has_vent && sb_text_width(section->text, _("vent"), 12, 400) < room) {
    const double at[1][2] = {{vent_end + 10, top}};
    sb_section_place(section, at, 1, &small, _("vent"));
  }

  // The chamber, in the fluid between the stem's lands.
  SbPoint chamber = sb_section_at(section, valve->chamber - sb_section_displacement(section),
                                  (valve->chamber_floor + valve->land) / 2);
  // Where the recess is shallow under a wide annulus the names stand in the middle of both.
  double floor = (double)sb_section_at(section, 0, valve->chamber_floor).y;
  if ((double)chamber.y + 21 > floor) {
    chamber.y = ((floor + (double)sb_section_at(section, 0, valve->bore).y) / 2 - 5);
  }
  char value[SB_SECTION_NUMBER];
  sb_section_megapascal(value, frame->seal[SB_INNER].pressure_right);
  double depth = (valve->bore - valve->chamber_floor) * section->scale;
  SbSectionLabel bold = sb_section_label_style(palette->ink, 600, SB_MIDDLE, NULL);
  SbSectionLabel plain = sb_section_label_style(palette->ink, 400, SB_MIDDLE, NULL);
  double length = sb_model_shape(section->model)->chamber_length * section->scale;
  if (length > 1.3 * sb_text_width(section->text, _("Chamber"), 12, 600)) {
    const double high[1][2] = {{(double)chamber.x, (double)chamber.y + 1}};
    const double middle[1][2] = {{(double)chamber.x, (double)chamber.y + 6}};
    if (depth > 38 && sb_section_place(section, high, 1, &bold, _("Chamber"))) {
      sb_section_label(section, (double)chamber.x, (double)chamber.y + 17, &plain, value);
    } else if (depth > 18) {
      sb_section_place(section, middle, 1, &bold, _("Chamber"));
    }
  }
}

// Land edge, inner contact and the way between them.
static void draw_land_edge(SbSection *section) {
  const SbPalette *palette = section->palette;
  SbDrawList *list = section->list;
  const SbFrame *frame = section->instant->frame;
  const SbSealFrame *inner = &frame->seal[SB_INNER];
  double bore = section->valve.bore;
  SbPoint edge = sb_section_at(section, 0, bore);
  double way = sb_model_value(section->model, SB_P_BORE_LAND_EDGE) - frame->displacement;
  double y = section->strip.y + 22;
  char text[128], length[SB_SECTION_NUMBER];
  sb_section_millimetre(length, fabs(way));
  bool ahead = way > 0;
  if (ahead && frame->velocity >= 0) {
    snprintf(text, sizeof text, _("land edge: inner seal leaves in %s"), length);
  } else if (ahead) {
    snprintf(text, sizeof text, _("land edge: passed, %s ago"), length);
  } else {
    snprintf(text, sizeof text, _("land edge"));
  }
  double low = y + 11, bottom = edge.y - 4;
  if (bottom < low + 8) {
    return;
  }
  // As many of its words as there is room for; lines without a name would say nothing.
  SbSectionLabel letter = sb_section_label_style(palette->ink, 700, SB_LEFT, &palette->housing);
  SbSectionLabel plain = sb_section_label_style(palette->ink, 400, SB_LEFT, &palette->housing);
  const char *const words[3] = {text, _("land edge"), ""};
  char whole[140];
  size_t chosen = 0;
  while (chosen < G_N_ELEMENTS(words)) {
    snprintf(whole, sizeof whole, "C  %s", words[chosen]);
    if (sb_section_label_fits(section, edge.x + 1, y, &plain, whole, &section->strip)) {
      break;
    }
    chosen++;
  }
  if (chosen == G_N_ELEMENTS(words)) {
    return;
  }
  double width = sb_section_label(section, edge.x + 1, y, &letter, "C");
  if (words[chosen][0] != '\0') {
    sb_section_label(section, edge.x + 1 + width + 7, y, &plain, words[chosen]);
  }
  sb_draw_line(list, edge.x, bottom, edge.x, low, 1, palette->second)->dash = &sb_dash_dimension;
  if (ahead && inner->land_fraction > 0) {
    double contact = sb_section_at(section, way, bore).x;
    sb_draw_line(list, contact, bottom, contact, low, 1, palette->second)->dash =
        &sb_dash_dimension;
    if (contact - edge.x > 12) {
      sb_draw_arrow(list, contact, low + 8, edge.x + 1, low + 8, 1.2, 8, 6, palette->second);
    }
  }
}

// A solved ring off the land that the chamfer beside it still presses.
static bool on_chamfer(const SbSealShape *shape) {
  return shape != NULL && shape->contact_right > shape->contact_left;
}

// What the land edge's dimension takes, so that labels keep off it.
static void reserve_land_edge(SbSection *section) {
  const SbFrame *frame = section->instant->frame;
  double bore = section->valve.bore,
         way = sb_model_value(section->model, SB_P_BORE_LAND_EDGE) - frame->displacement;
  SbPoint edge = sb_section_at(section, 0, bore);
  double low = (double)section->strip.y + 33, height = (double)edge.y - 4 - low;
  if (height < 8) {
    return;
  }
  sb_section_reserve(section, (double)edge.x - 2, low, 4, height);
  if (way > 0 && frame->seal[SB_INNER].land_fraction > 0) {
    double contact = (double)sb_section_at(section, way, bore).x;
    sb_section_reserve(section, contact - 2, low, 4, height);
    sb_section_reserve(section, (double)edge.x, low + 4, fmax(contact - (double)edge.x, 0), 8);
  }
}

// The names under the rings, and "no contact" where the engine says so.
static void draw_seal_names(SbSection *section) {
  const SbPalette *palette = section->palette;
  static const char *const name[SB_SEAL_COUNT] = {
      [SB_OUTER] = N_("Outer seal"), [SB_INNER] = N_("Inner seal")};
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    const SbSealFrame *seal = &section->instant->frame->seal[i];
    char text[64];
    snprintf(text, sizeof text, "%s%s", _(name[i]),
             seal->land_fraction > 0                 ? ""
             : on_chamfer(section->instant->ring[i]) ? _(", on the chamfer only")
                                                     : _(", no contact"));
    SbPoint below = sb_section_at(section, sb_section_origin(section, i), section->valve.floor);
    SbSectionLabel style = sb_section_label_style(palette->seal[i], 600, SB_MIDDLE, &palette->stem);
    // In both halves there is room over the lower ring too.
    double mirrored = 2 * section->y0 - (double)below.y - 12;
    const double at[3][2] = {{below.x, below.y + 21}, {below.x, below.y + 38}, {below.x, mirrored}};
    sb_section_place(section, at, section->view->full ? 3 : 2, &style, text);
  }
}

// "Stem" and its speed.
static void draw_section_motion(SbSection *section) {
  const SbPalette *palette = section->palette;
  const SbFrame *frame = section->instant->frame;
  double axis = sb_section_axis(section);
  const SbValveOutline *valve = &section->valve;
  const double named = valve->gasket ? (valve->shoulder + valve->port_left) / 2 : valve->chamber;
  double middle = sb_section_at(section, named - frame->displacement, 0).x;
  SbSectionLabel bold = sb_section_label_style(palette->ink, 600, SB_MIDDLE, &palette->stem);
  // Below the chamber, or beside it where it is deep.
  double beside = middle + sb_model_shape(section->model)->chamber_length / 2 * section->scale + 30;
  bool deep = axis - 52 < (double)sb_section_at(section, 0, section->valve.chamber_floor).y + 16;
  const double at[2][2] = {{deep ? beside : middle, axis - 52}, {middle + 60, axis - 52}};
  if (axis - 52 > (double)sb_section_at(section, 0, section->valve.floor).y + 16) {
    sb_section_place(section, at, deep ? 1 : 2, &bold, _("Stem"));
  }
  double speed = fabs(frame->velocity) * 1e3;
  if (speed < 1e-9) {
    return;
  }
  char text[80], value[SB_SECTION_NUMBER];
  sb_section_fixed(value, speed, speed >= 100 ? 0 : speed >= 10 ? 1 : speed >= 1 ? 2 : 3);
  snprintf(text, sizeof text, "%s mm/s", value);
  SbSectionLabel plain = sb_section_label_style(palette->second, 400, SB_LEFT, &palette->stem);
  double from = middle - 34, to = middle + 34;
  const double left[1][2] = {{to + 10, axis - 15}};
  if (sb_section_place(section, left, 1, &plain, text)) {
    bool in = frame->velocity > 0;
    sb_draw_arrow(section->list, in ? to : from, axis - 19, in ? from : to, axis - 19, 1.4, 8, 7,
                  palette->second);
  }
}

size_t sb_section_curve(SbValvePoint *out, const SbValvePoint *knot, int knots) {
  enum { STEPS = (SB_SECTION_WAY - 1) / (SB_SECTION_KNOTS - 1) };
  size_t count = 0;
  for (int i = 0; i < knots - 1; i++) {
    const SbValvePoint a = knot[MAX(i - 1, 0)], b = knot[i], c = knot[i + 1];
    const SbValvePoint d = knot[MIN(i + 2, knots - 1)];
    for (int j = 0; j < STEPS + (i == knots - 2); j++) {
      const double t = (double)j / STEPS;
      const double wa = -t * (1 - t) * (1 - t) / 2, wb = 1 - 2.5 * t * t + 1.5 * t * t * t;
      const double wc = t * (1 + t * (4 - 3 * t)) / 2, wd = -t * t * (1 - t) / 2;
      out[count++] = (SbValvePoint){wa * a.x + wb * b.x + wc * c.x + wd * d.x,
                                    wa * a.y + wb * b.y + wc * c.y + wd * d.y};
    }
  }
  return count;
}

void sb_section_draw_way(SbSection *section, const SbValvePoint *way, size_t count) {
  SbPoint curve[SB_SECTION_WAY];
  for (size_t i = 0; i < count; i++) {
    curve[i] = sb_section_at(section, way[i].x, way[i].y);
  }
  const SbColor color = section->palette->fluid_line;
  sb_draw_clip(section->list, &section->strip);
  sb_draw_stroke(section->list, curve, count - 3, 2.2, color)->dash = &sb_dash_dose;
  sb_draw_arrow(section->list, curve[count - 4].x, curve[count - 4].y, curve[count - 1].x,
                curve[count - 1].y, 2.2, 11, 9, color);
  sb_draw_clip(section->list, NULL);
}

// The way of the dose once the chamber is open: from the canister over the freed ring.
// Smooths a path over the inner ring, whose middle is at x = `ring`, and keeps it clear of ring and
// housing, by at most `clearance`. Returns the smallest distance between these two [m].
static double clear_path(const SbValveOutline *valve, SbValvePoint *path, size_t count, double ring,
                         double radius, double clearance) {
  double least = HUGE_VAL;
  for (int round = 0; round < 6; round++) {
    double before = path[0].y;
    for (size_t i = 1; i + 1 < count; i++) {
      const double smooth = (before + 2 * path[i].y + path[i + 1].y) / 4;
      const double off = (path[i].x - ring) / radius;
      const double low =
          fabs(off) < 1 ? valve->floor + radius * (1 + sqrt(1 - off * off)) : -HUGE_VAL;
      const double high = sb_valve_outline_bore(valve, path[i].x);
      const double clear = fmin(clearance, (high - low) / 2);
      before = path[i].y;
      least = fmin(least, high - low);
      path[i].y = fmin(fmax(smooth, low + clear), high - clear);
    }
  }
  return least;
}

static void draw_dose_path(SbSection *section) {
  const SbPalette *palette = section->palette;
  const SbFrame *frame = section->instant->frame;
  const SbValveOutline *valve = &section->valve;
  if (frame->chamber != SB_CHAMBER_OPEN || frame->seal[SB_INNER].land_fraction > 0 ||
      on_chamfer(section->instant->ring[SB_INNER])) {
    return;
  }
  double g = sb_model_value(section->model, SB_P_GLAND_RADIAL_SPACE);
  double s = frame->displacement;
  double ring = sb_section_origin(section, SB_INNER);
  double radius = sqrt(valve->section_area[SB_INNER] / M_PI);
  double top = valve->floor + 2 * radius;
  double mouth = sb_valve_outline_bore(valve, ring);
  double over = isfinite(mouth) ? (fmax(top, valve->land) + mouth) / 2 : top + 0.17 * g;
  // Down along the ring between it and the housing, then over the stem's land.
  double beside = ring + 0.72 * radius;
  double shoulder = valve->floor + radius * (1 + 0.694);
  double above = fmin(sb_valve_outline_bore(valve, beside), top + 0.1 * g);
  double behind = ring + 1.25 * radius;
  double roof = fmin(sb_valve_outline_bore(valve, behind), top + 0.1 * g);
  double mouth_left = valve->chamber_left - s;
  double depth = valve->land - valve->chamber_floor;
  enum { KNOTS = 7 };
  // Knots of the way, from left to right.
  const SbValvePoint knot[KNOTS] = {
      {fmin(valve->face, ring) - 1.75 * g, valve->bore + 0.62 * g},
      {fmin(valve->face, ring) - 0.45 * g, valve->mouth - 0.02 * g},
      {ring, over},
      {beside, fmin((shoulder + above) / 2, above)},
      {behind, (valve->land + roof) / 2},
      {fmax(mouth_left + 0.1 * g, behind + 0.15 * g), valve->land + 0.02 * g},
      {fmax(mouth_left, behind) + 0.46 * g, valve->land - 0.4 * depth},
  };
  SbValvePoint way[SB_SECTION_WAY];
  const size_t count = sb_section_curve(way, knot, KNOTS);
  // A free ring of schematic shape may still stand in the land edge's way: no path to draw there.
  if (clear_path(valve, way, count, ring, radius, 0.06 * g) * section->scale < 4) {
    return;
  }
  sb_section_draw_way(section, way, count);
  const SbPoint start = sb_section_at(section, way[0].x, way[0].y);
  SbSectionLabel style = sb_section_label_style(palette->fluid_line, 600, SB_LEFT, NULL);
  const double at[3][2] = {
      {start.x, start.y - 9}, {start.x, start.y + 20}, {section->strip.x + 12, start.y + 20}};
  sb_section_place(section, at, 3, &style, _("dose path open"));
}

// Below the strip: what the picture is, and its scales.
static void draw_scales(SbSection *section) {
  const SbPalette *palette = section->palette;
  SbDrawList *list = section->list;
  double y = section->strip.y + section->strip.height + 22;
  double right = section->strip.x + section->strip.width;
  // A bar of 1, 2 or 5 times a power of ten, about a tenth of the width.
  double target = 0.12 * section->strip.width / section->scale * 1e3;
  double unit = pow(10, floor(log10(target)));
  double length = unit * (target / unit >= 5 ? 5 : target / unit >= 2 ? 2 : 1);
  double bar = length * 1e-3 * section->scale;
  sb_draw_line(list, right - bar, y - 4, right - bar, y + 4, 1.4, palette->ink);
  sb_draw_line(list, right - 0.7, y - 4, right - 0.7, y + 4, 1.4, palette->ink);
  sb_draw_line(list, right - bar, y, right, y, 1.4, palette->ink);
  char text[80], value[SB_SECTION_NUMBER];
  snprintf(text, sizeof text, "%s mm",
           sb_section_fixed(value, length, length >= 1 ? 0 : (int)ceil(-log10(unit))));
  sb_draw_text(list, right - bar - 8, y + 4, 11, 400, SB_RIGHT, palette->second, text);
  double x = right - bar - 8 - sb_text_width(section->text, text, 11, 400) - 24;
  if (!section->view->hide_forces && section->view->zoom == SB_SECTION_WHOLE) {
    sb_draw_arrow(list, x, y, x - 10 * SB_SECTION_PX_PER_NEWTON, y, 3, 9, 9, palette->ink);
    sb_draw_text(list, x - 10 * SB_SECTION_PX_PER_NEWTON - 8, y + 4, 11, 400, SB_RIGHT,
                 palette->second, "10 N");
    x -= 10 * SB_SECTION_PX_PER_NEWTON + 44;
  }
  bool schematic =
      section->instant->ring[SB_OUTER] == NULL || section->instant->ring[SB_INNER] == NULL;
  const char *const whole = section->view->zoom == SB_SECTION_WHOLE ? _("axis of the valve; ") : "";
  char caption[240];
  snprintf(caption, sizeof caption, _("%sto scale in both directions%s%s"), whole,
           schematic ? _("; rings: schematic shape, contact width and area true") : "",
           section->view->undeformed ? _("; dashed: rings before fitting") : "");
  if (section->strip.x + sb_text_width(section->text, caption, 11, 400) + 12 < x) {
    sb_draw_text(list, section->strip.x, y + 4, 11, 400, SB_LEFT, palette->second, caption);
  } else if (schematic) {
    sb_draw_text(list, section->strip.x, y + 4, 11, 400, SB_LEFT, palette->second,
                 _("rings: schematic shape"));
  }
}

// A zoomed strip: contact width over the land, the fluid's pressure on either side.
static void draw_zoom(SbSection *section) {
  const SbPalette *palette = section->palette;
  SbDrawList *list = section->list;
  int i = section->view->zoom == SB_SECTION_ZOOM_INNER ? SB_INNER : SB_OUTER;
  const SbSealFrame *seal = &section->instant->frame->seal[i];
  const SbValveOutline *valve = &section->valve;
  double origin = sb_section_origin(section, i);
  char text[96], value[SB_SECTION_NUMBER];
  if (seal->land_fraction > 0) {
    SbPoint a = sb_section_at(section, origin + section->ring[i].contact_left, valve->bore);
    SbPoint b = sb_section_at(section, origin + section->ring[i].contact_right, valve->bore);
    double y = (double)a.y + (valve->gasket ? -17 : 17);
    sb_draw_line(list, a.x, y - 5, a.x, y + 5, 1.2, palette->ink);
    sb_draw_line(list, b.x, y - 5, b.x, y + 5, 1.2, palette->ink);
    sb_draw_line(list, a.x, y, b.x, y, 1.2, palette->ink);
    snprintf(text, sizeof text, _("contact %s"),
             sb_section_millimetre(value, seal->contact_right - seal->contact_left));
    SbSectionLabel style = sb_section_label_style(palette->ink, 600, SB_MIDDLE, &palette->panel);
    bool inside = sb_text_width(section->text, text, 12, 600) + 30 < (double)(b.x - a.x);
    sb_section_label(section, (double)(a.x + b.x) / 2, inside ? y + 4 : y + 22, &style, text);
  }
  // In the groove's corners, beside the ring.
  double s = valve->gasket ? 0 : section->instant->frame->displacement;
  double y = sb_section_at(section, 0, valve->floor).y + (valve->gasket ? 30 : -14);
  const double wall[2] = {sb_section_at(section, valve->groove_left[i] - s, 0).x + 8,
                          sb_section_at(section, valve->groove_right[i] - s, 0).x - 8};
  const double pressure[2] = {seal->pressure_left, seal->pressure_right};
  for (int side = 0; side < 2; side++) {
    // Beyond the wall, on the stem, pointing into the corner.
    SbSectionLabel style = sb_section_label_style(palette->fluid_line, 600,
                                                  side == 0 ? SB_RIGHT : SB_LEFT, &palette->stem);
    snprintf(text, sizeof text, _("fluid %s"), sb_section_megapascal(value, pressure[side]));
    double x = wall[side] + (side == 0 ? -20 : 20);
    sb_section_label(section, x, y, &style, text);
  }
}

void sb_section_draw_strip_labels(SbSection *section) {
  bool whole = section->view->zoom == SB_SECTION_WHOLE;
  bool labels = !section->view->hide_labels, forces = !section->view->hide_forces;
  // In the order of their right to stay.
  if (forces && whole) {
    sb_section_draw_stem_forces(section);
  }
  if (labels && whole && !section->valve.gasket) {
    reserve_land_edge(section);
  }
  if (forces) {
    sb_section_draw_friction(section);
  }
  if (labels && section->valve.gasket) {
    sb_section_gasket_labels(section, whole);
  } else if (labels) {
    draw_seal_names(section);
  }
  if (labels && whole && section->valve.gasket) {
    draw_section_motion(section);
  } else if (labels && whole) {
    draw_regions(section);
    draw_land_edge(section);
    draw_dose_path(section);
    draw_section_motion(section);
  } else if (labels) {
    draw_zoom(section);
  }
  draw_scales(section);
}
