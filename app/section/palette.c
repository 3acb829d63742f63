// The section's colours out of the theme, in the form the display list wants, with both maps as
// tables of 256.
#include "app/section/palette.h"

#include <glib.h>

// A body's surface from its shadow over its own colour at two thirds to its highlight.
static void make_shade(SbDrawMap *map, SbColor body, bool dark) {
  const SbColor black = {0.03, 0.04, 0.06, 1.0}, white = {1.0, 1.0, 1.0, 1.0};
  SbColor shadow = sb_color_mix(body, black, dark ? 0.62 : 0.58);
  SbColor light = sb_color_mix(body, white, dark ? 0.36 : 0.75);
  for (int i = 0; i < 256; i++) {
    double t = i / 255.0;
    map->entry[i] =
        t < 2.0 / 3 ? sb_color_mix(shadow, body, 1.5 * t) : sb_color_mix(body, light, 3 * t - 2);
  }
}

static void make_palette(SbPalette *palette, bool dark) {
  const SbTheme *theme = sb_theme(dark);
  const SbColor *role = theme->role;
  palette->dark = dark;
  palette->panel = role[SB_ROLE_PANEL];
  palette->axis = role[SB_ROLE_AXIS];
  palette->ink = role[SB_ROLE_INK];
  palette->second = role[SB_ROLE_SECOND];
  palette->fluid_line = role[SB_ROLE_FLUID];
  palette->now = role[SB_ROLE_NOW];
  palette->housing = role[SB_ROLE_HOUSING];
  palette->housing_hatch = role[SB_ROLE_HOUSING_HATCH];
  palette->stem = role[SB_ROLE_STEM];
  palette->stem_hatch = role[SB_ROLE_STEM_HATCH];
  palette->outline = role[SB_ROLE_OUTLINE];
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    palette->seal[i] = sb_theme_seal(theme, i);
    make_shade(&palette->seal_shade[i],
               sb_color_mix(palette->panel, palette->seal[i], dark ? 0.62 : 0.66), dark);
  }
  // Darker than the cut faces, which stand out so.
  make_shade(&palette->housing_shade,
             sb_color_mix(palette->housing, palette->outline, dark ? 0.16 : 0.20), dark);
  make_shade(&palette->stem_shade,
             sb_color_mix(palette->stem, palette->outline, dark ? 0.22 : 0.24), dark);
  for (int i = 0; i < 256; i++) {
    palette->field.entry[i] = sb_theme_field(theme, i / 255.0);
    palette->diverging.entry[i] = sb_theme_diverging(theme, 2 * i / 255.0 - 1);
    palette->fluid.entry[i] = sb_theme_fluid(theme, SB_PALETTE_FLUID_FULL * i / 255.0);
  }
}

const SbPalette *sb_palette(bool dark) {
  static gsize made;
  static SbPalette palette[SB_PALETTE_COUNT];
  if (g_once_init_enter(&made)) {
    make_palette(&palette[SB_PALETTE_LIGHT], false);
    make_palette(&palette[SB_PALETTE_DARK], true);
    g_once_init_leave(&made, 1);
  }
  return &palette[dark ? SB_PALETTE_DARK : SB_PALETTE_LIGHT];
}

SbColor sb_palette_fluid(const SbPalette *palette, double p) {
  double t = CLAMP(p / SB_PALETTE_FLUID_FULL, 0.0, 1.0);
  return palette->fluid.entry[(int)(255 * t + 0.5)];
}
