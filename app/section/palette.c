// The section's colours out of the theme, in the form the display list wants, with both maps as
// tables of 256.
#include "app/section/palette.h"

#include "app/chart/theme.h"

#include <glib.h>

static SbDrawColour convert(SbColor color) {
  return (SbDrawColour){(float)color.r, (float)color.g, (float)color.b, 1.0f};
}

static void make_palette(SbPalette *palette, bool dark) {
  const SbTheme *theme = sb_theme(dark);
  const SbColor *role = theme->role;
  *palette = (SbPalette){
      .dark = dark,
      .background = convert(role[SB_ROLE_BACKGROUND]),
      .panel = convert(role[SB_ROLE_PANEL]),
      .hairline = convert(role[SB_ROLE_HAIRLINE]),
      .grid = convert(role[SB_ROLE_GRID]),
      .axis = convert(role[SB_ROLE_AXIS]),
      .ink = convert(role[SB_ROLE_INK]),
      .second = convert(role[SB_ROLE_SECOND]),
      .third = convert(role[SB_ROLE_THIRD]),
      .fluid_line = convert(role[SB_ROLE_FLUID]),
      .now = convert(role[SB_ROLE_NOW]),
      .housing = convert(role[SB_ROLE_HOUSING]),
      .housing_hatch = convert(role[SB_ROLE_HOUSING_HATCH]),
      .stem = convert(role[SB_ROLE_STEM]),
      .stem_hatch = convert(role[SB_ROLE_STEM_HATCH]),
      .outline = convert(role[SB_ROLE_OUTLINE]),
      .warn = convert(role[SB_ROLE_WARN]),
      .error = convert(role[SB_ROLE_ERROR]),
  };
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    palette->seal[i] = convert(sb_theme_seal(theme, i));
  }
  for (int i = 0; i < 256; i++) {
    palette->field.entry[i] = convert(sb_theme_field(theme, i / 255.0));
    palette->diverging.entry[i] = convert(sb_theme_diverging(theme, 2 * i / 255.0 - 1));
    palette->fluid.entry[i] = convert(sb_theme_fluid(theme, SB_PALETTE_FLUID_FULL * i / 255.0));
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

SbDrawColour sb_palette_fluid(const SbPalette *palette, double p) {
  double t = CLAMP(p / SB_PALETTE_FLUID_FULL, 0.0, 1.0);
  return palette->fluid.entry[(int)(255 * t + 0.5)];
}
