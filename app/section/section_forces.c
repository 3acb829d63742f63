// Arrows and labels of the forces in the valve strip: friction, pressure, spring, drive and stop,
// to scale.
#include "app/section/section_private.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <stdio.h>

void sb_section_draw_friction(SbSection *section) {
  const SbPalette *palette = section->palette;
  const SbFrame *frame = section->instant->frame;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    const SbSealFrame *seal = &frame->seal[i];
    double length = SB_SECTION_PX_PER_NEWTON * seal->friction;
    if (fabs(seal->friction) < 0.05 || seal->land_fraction <= 0) {
      continue;
    }
    // Friction on the stem; the arrow stands just above the contact.
    double middle = sb_section_origin(section, i) +
                    (section->ring[i].contact_left + section->ring[i].contact_right) / 2;
    SbPoint at = sb_section_at(section, middle, section->valve.bore);
    const double up = section->valve.gasket ? -1 : 1; // into the stem, or into the housing
    double y = at.y - up * 14;
    sb_draw_arrow(section->list, at.x - length / 2, y, at.x + length / 2, y, 3, 11, 10,
                  palette->seal[i]);
    sb_section_reserve(section, at.x - fabs(length) / 2, y - 5, fabs(length), 10);
    char text[80], value[SB_SECTION_NUMBER];
    snprintf(text, sizeof text, _("friction %s"), sb_section_force(value, fabs(seal->friction)));
    SbSectionLabel style = sb_section_label_style(palette->seal[i], 600, SB_MIDDLE,
                                                  up > 0 ? &palette->housing : &palette->stem);
    const double near = up > 0 ? y - 10 : y + 18, far = up > 0 ? y - 27 : y + 35;
    const double place_at[7][2] = {{at.x, near},      {at.x + 30, near}, {at.x + 50, near},
                                   {at.x - 50, near}, {at.x, far},       {at.x + 60, far},
                                   {at.x + 76, near}};
    sb_section_place(section, place_at, 7, &style, text);
  }
}

// The forces of canister pressure and spring at the nose of the stem; the pressure at the height y
// [px].
static void draw_nose_forces(SbSection *section, double y) {
  const SbPalette *palette = section->palette;
  SbDrawList *list = section->list;
  const SbFrame *frame = section->instant->frame;
  char text[80], value[SB_SECTION_NUMBER];
  double nose = sb_section_at(section, section->valve.nose - frame->displacement, 0).x;
  double length = SB_SECTION_PX_PER_NEWTON * fabs(frame->pressure_force);
  if (length > 2) {
    // Below ambient it draws the stem in.
    bool pushes = frame->pressure_force > 0;
    double tail = nose - (pushes ? length : 1.5), tip = nose - (pushes ? 1.5 : length);
    sb_draw_arrow(list, tail, y, tip, y, 5, 15, 16, palette->fluid_line);
    snprintf(text, sizeof text, _("pressure %s"), sb_section_force(value, frame->pressure_force));
    SbSectionLabel style = {13, 700, SB_LEFT, palette->fluid_line, &palette->stem};
    sb_section_label(section, nose + 10, y + 5, &style, text);
    sb_section_reserve(section, nose - length, y - 8, length, 16);
  }

  if (frame->spring_force >= 0.05) {
    const double shown = SB_SECTION_PX_PER_NEWTON * frame->spring_force;
    const double line = sb_section_axis(section) - 15;
    sb_draw_arrow(list, nose - shown, line, nose - 1.5, line, 3, 11, 10, palette->second);
    snprintf(text, sizeof text, _("spring %s"), sb_section_force(value, frame->spring_force));
    SbSectionLabel small = sb_section_label_style(palette->second, 600, SB_LEFT, &palette->stem);
    const double behind[1][2] = {{nose + 10, line + 4}};
    sb_section_place(section, behind, 1, &small, text);
    sb_section_reserve(section, nose - shown, line - 5, shown, 10);
  }
}

// The forces of drive and stop at the stem's rod, at the height y [px].
static void draw_rod_forces(SbSection *section, double y) {
  const SbPalette *palette = section->palette;
  SbDrawList *list = section->list;
  const SbFrame *frame = section->instant->frame;
  char text[80], value[SB_SECTION_NUMBER];
  double right = section->strip.x + section->strip.width - 10;
  double force = frame->force;
  if (fabs(force) >= 0.05) {
    double shown = SB_SECTION_PX_PER_NEWTON * fabs(force);
    double tail = force > 0 ? right : right - shown;
    sb_draw_arrow(list, tail, y, tail + (force > 0 ? -shown : shown), y, 7, 20, 22, palette->ink);
    sb_section_reserve(section, right - shown, y - 11, shown, 22);
  }
  snprintf(text, sizeof text, _("drive %s"), sb_section_force(value, force));
  SbSectionLabel style = {14, 700, SB_RIGHT, palette->ink, &palette->stem};
  // Above the arrow; behind its point where that would be off a thin rod, or not at all: the
  // read-outs have it too.
  bool above = y - 34 > (double)sb_section_at(section, 0, section->valve.rod).y;
  double point = fabs(force) >= 0.05 ? right - SB_SECTION_PX_PER_NEWTON * fabs(force) - 8 : right;
  const double at[2][2] = {{right, y - 18}, {point, y + 5}};
  bool written = sb_section_place(section, at + !above, 1 + above, &style, text);

  if (fabs(frame->stop_force) >= 0.05) {
    double shown = SB_SECTION_PX_PER_NEWTON * frame->stop_force;
    double stop_y = sb_section_axis(section) - 15;
    // On a thin rod it has no line of its own: left of the drive's arrow and label.
    if (y + 11 > stop_y - 6) {
      right = point - (written ? sb_text_width(section->text, text, 14, 700) + 10 : 0);
    }
    double from = shown > 0 ? right - shown : right;
    sb_draw_arrow(list, from, stop_y, from + shown, stop_y, 3, 11, 10, palette->second);
    snprintf(text, sizeof text, _("stop %s"), sb_section_force(value, frame->stop_force));
    SbSectionLabel small = sb_section_label_style(palette->second, 600, SB_RIGHT, &palette->stem);
    // In a small picture it gives way: the balance below the section has it too.
    const double behind[1][2] = {{MIN(from, from + shown) - 8, stop_y + 4}};
    sb_section_place(section, behind, 1, &small, text);
  }
}

void sb_section_draw_stem_forces(SbSection *section) {
  const double y = sb_section_axis(section) - fmin(40, 0.45 * section->valve.rod * section->scale);
  draw_nose_forces(section, y);
  draw_rod_forces(section, y);
}
