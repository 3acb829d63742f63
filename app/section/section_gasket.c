// Labels of a gasket valve's strip: its gaskets, its rooms and the liquid's way.
#include "app/chart/data.h"
#include "app/section/section_private.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <stdio.h>

static SbSectionLabel style_of(SbColor color, int weight, SbAlign align, const SbColor *plate) {
  return (SbSectionLabel){12, weight, align, color, plate};
}

// Names above the gaskets, in the body.
static void draw_names(SbSection *section) {
  const SbPalette *palette = section->palette;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    const SbPoint above = sb_section_at(section, sb_section_origin(section, i), section->valve.rim);
    const SbSectionLabel style = style_of(palette->seal[i], 600, SB_MIDDLE, &palette->housing);
    const double at[2][2] = {{above.x, above.y - 10}, {above.x, above.y - 27}};
    sb_section_place(section, at, 2, &style, sb_chart_seal_name(section->model, i));
  }
}

// What stands around the body, each named from outside.
static void draw_around_names(SbSection *section) {
  const SbValveOutline *valve = &section->valve;
  const SbSectionLabel style = style_of(section->palette->second, 400, SB_LEFT, NULL);
  const SbPoint side = sb_section_at(section, valve->ferrule, 0.75 * valve->outside);
  const SbPoint over =
      sb_section_at(section, valve->neck_gasket, (valve->outside + valve->flange) / 2);
  const SbPoint can = sb_section_at(section, valve->face, valve->flange);
  const double ferrule[1][2] = {{side.x + 8, side.y}};
  const double gasket[1][2] = {{over.x + 8, over.y + 1}};
  const double neck[1][2] = {{can.x, can.y + 4}};
  if (sb_section_place(section, ferrule, 1, &style, _("ferrule")) &&
      sb_section_place(section, gasket, 1, &style, _("neck gasket"))) {
    sb_section_place(section, neck, 1, &style, _("can"));
  }
}

static void draw_rooms(SbSection *section) {
  const SbPalette *palette = section->palette;
  const SbFrame *frame = section->instant->frame;
  const SbValveOutline *valve = &section->valve;
  const SbRect *strip = &section->strip;
  const double top = (double)strip->y + 22;
  sb_section_name_pressure(section, (double)strip->x + 12, top, _("Canister"),
                           (double)frame->seal[SB_INNER].pressure_left, false);
  const double end = (double)sb_section_at(section, valve->end, 0).x;
  sb_section_name_pressure(section, end + 10, top, _("Ambient"),
                           (double)frame->seal[SB_OUTER].pressure_right, true);
  const SbPoint middle =
      sb_section_at(section, valve->chamber, (valve->chamber_roof + valve->chamber_floor) / 2);
  const SbSectionLabel bold = style_of(palette->ink, 600, SB_MIDDLE, NULL);
  const SbSectionLabel plain = style_of(palette->ink, 400, SB_MIDDLE, NULL);
  const double deep = (valve->chamber_roof - valve->chamber_floor) * section->scale;
  const double name_y = middle.y + (deep > 38 ? -12 : 4); // the liquid's way lies below
  const double at[1][2] = {{middle.x, name_y}};
  char value[SB_SECTION_NUMBER];
  if (deep > 18 && sb_section_place(section, at, 1, &bold, _("Chamber")) && deep > 38) {
    sb_section_megapascal(value, (double)frame->seal[SB_OUTER].pressure_left);
    sb_section_label(section, middle.x, name_y + 17, &plain, value);
  }
  const SbPoint wall = sb_section_at(section, valve->chamber, 1.12 * valve->chamber_roof);
  const SbSectionLabel body = style_of(palette->ink, 600, SB_MIDDLE, &palette->housing);
  const double place[1][2] = {{wall.x, wall.y - 6}};
  sb_section_place(section, place, 1, &body, _("Body"));
}

// An arrow along knots of the housing's frame, and what it says.
static void draw_way(SbSection *section, const SbValvePoint *knot, int knots, const char *text,
                     double text_x, double text_y) {
  SbValvePoint way[SB_SECTION_WAY];
  sb_section_draw_way(section, way, sb_section_curve(way, knot, knots));
  const SbSectionLabel style = style_of(section->palette->fluid_line, 600, SB_MIDDLE, NULL);
  const double at[1][2] = {{text_x, text_y}};
  sb_section_place(section, at, 1, &style, text);
}

// Past the neck into the chamber, or from the chamber through the port to the atomiser.
static void draw_liquid(SbSection *section) {
  const SbFrame *frame = section->instant->frame;
  const SbValveOutline *valve = &section->valve;
  const double s = frame->displacement;
  if (frame->chamber == SB_CHAMBER_OPEN) {
    const double neck = valve->bore - 0.12 * valve->bore;
    const double left = valve->face - 0.25 * valve->size;
    const double right = fmin(valve->shoulder - s, valve->chamber);
    const double middle = valve->bore + 0.2 * (valve->chamber_roof - valve->bore);
    const SbValvePoint way[] = {{left, valve->bore + 0.1 * valve->size},
                                {valve->slot - 0.03 * valve->size, valve->bore},
                                {valve->groove_left[SB_INNER], neck},
                                {valve->groove_right[SB_INNER], neck},
                                {right, (neck + middle) / 2},
                                {right + 0.12 * valve->size, middle}};
    const SbPoint text = sb_section_at(section, left, valve->bore + 0.1 * valve->size);
    draw_way(section, way, 6, _("chamber fills past the neck"), text.x, text.y - 9);
  } else if (frame->chamber == SB_CHAMBER_CLOSED &&
             valve->port_left - s < valve->groove_left[SB_OUTER]) {
    const double port = (valve->port_left + valve->port_right) / 2 - s;
    const double middle = valve->bore + 0.2 * (valve->chamber_roof - valve->bore);
    const double out = 0.5 * valve->channel;
    const SbValvePoint way[] = {{port - 0.22 * valve->size, middle},
                                {port - 0.06 * valve->size, middle},
                                {port, valve->bore},
                                {port, out + 0.1 * valve->bore},
                                {port + 0.08 * valve->size, out},
                                {valve->end + 0.1 * valve->size, out}};
    const SbPoint text = sb_section_at(section, valve->ferrule + 0.13 * valve->size, valve->bore);
    draw_way(section, way, 6, _("to the atomiser"), text.x, text.y - 8);
  }
}

void sb_section_gasket_labels(SbSection *section, bool whole) {
  draw_names(section);
  if (whole) {
    draw_rooms(section);
    draw_around_names(section);
    draw_liquid(section);
  }
}
