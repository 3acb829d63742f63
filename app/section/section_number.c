// Numbers and labels of the section: formatting without locale, places that do not collide.
#include "app/section/section_private.h"

#include "app/base/format.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

_Static_assert(SB_SECTION_NUMBER >= SB_FORMAT_MAX + 8, "room for a number and its unit");

const char *sb_section_fixed(char *buffer, double value, int decimals) {
  return sb_format_fixed(buffer, value, decimals);
}

const char *sb_section_two_digits(char *buffer, double value) {
  if (!isfinite(value) || value == 0) {
    return sb_section_fixed(buffer, value, 0);
  }
  double unit = pow(10, floor(log10(fabs(value))) - 1);
  double rounded = round(value / unit) * unit;
  return sb_section_fixed(buffer, rounded, unit >= 1 ? 0 : (int)-floor(log10(unit) + 0.5));
}

const char *sb_section_significant(char *buffer, double value) {
  for (int decimals = 0; decimals < 6; decimals++) {
    double unit = pow(10, decimals);
    double rounded = round(value * unit) / unit;
    if (fabs(rounded - value) <= 0.005 * fabs(value)) {
      return sb_section_fixed(buffer, value, decimals);
    }
  }
  return sb_section_fixed(buffer, value, 6);
}

static const char *with_unit(char *buffer, const char *unit) {
  g_strlcat(buffer, unit, SB_SECTION_NUMBER);
  return buffer;
}

const char *sb_section_force(char *buffer, double newtons) {
  sb_section_fixed(buffer, newtons, fabs(newtons) >= 100 ? 0 : 1);
  return with_unit(buffer, " N");
}

const char *sb_section_megapascal(char *buffer, double pascals) {
  double value = pascals * 1e-6;
  sb_section_fixed(buffer, value, fabs(value) >= 100 ? 0 : fabs(value) >= 10 ? 1 : 2);
  return with_unit(buffer, " MPa");
}

const char *sb_section_millimetre(char *buffer, double metres) {
  double value = metres * 1e3;
  sb_section_fixed(buffer, value, fabs(value) >= 100 ? 0 : fabs(value) >= 10 ? 1 : 2);
  return with_unit(buffer, " mm");
}

static SbRect label_rect(SbSection *section, double x, double y, const SbSectionLabel *style,
                         const char *string) {
  double width = sb_text_width(section->text, string, style->size, style->weight);
  double left = style->align == SB_LEFT ? x : style->align == SB_MIDDLE ? x - width / 2 : x - width;
  return (SbRect){(left - 3), (y - style->size * 0.92 - 1), (width + 6), (style->size * 1.22 + 2)};
}

static bool overlap(const SbRect *a, const SbRect *b) {
  return a->x < b->x + b->width && b->x < a->x + a->width && a->y < b->y + b->height &&
         b->y < a->y + a->height;
}

void sb_section_reserve(SbSection *section, double x, double y, double width, double height) {
  if (section->placed_count < SB_SECTION_PLACED_MAX) {
    section->placed[section->placed_count++] = (SbRect){x, y, width, height};
  }
}

bool sb_section_label_fits(SbSection *section, double x, double y, const SbSectionLabel *style,
                           const char *string, const SbRect *within) {
  SbRect rect = label_rect(section, x, y, style, string);
  if (within != NULL && (rect.x < within->x || rect.y < within->y ||
                         rect.x + rect.width > within->x + within->width ||
                         rect.y + rect.height > within->y + within->height)) {
    return false;
  }
  for (size_t i = 0; i < section->placed_count; i++) {
    if (overlap(&rect, &section->placed[i])) {
      return false;
    }
  }
  return true;
}

double sb_section_label(SbSection *section, double x, double y, const SbSectionLabel *style,
                        const char *string) {
  SbRect rect = label_rect(section, x, y, style, string);
  if (style->plate != NULL) {
    sb_draw_round_rect(section->list, rect.x, rect.y, rect.width, rect.height, 2, *style->plate);
  }
  sb_section_reserve(section, rect.x, rect.y, rect.width, rect.height);
  sb_draw_text(section->list, x, y, style->size, style->weight, style->align, style->color, string);
  return rect.width - 6;
}
