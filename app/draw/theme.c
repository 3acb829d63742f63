// The table of colour roles, and the colour maps by formulas in OKLCh. Both themes are filled from
// the hexadecimal codes at the first use (pthread_once) and are constant afterwards.
#include "app/draw/theme.h"

#include <math.h>
#include <pthread.h>

const SbDash sb_dash_pinned = {2, {7, 3}};
const SbDash sb_dash_predicted = {2, {6, 3}};
const SbDash sb_dash_reference = {2, {5, 4}};
const SbDash sb_dash_dimension = {2, {3, 3}};
const SbDash sb_dash_centre = {4, {14, 3, 2, 3}};
const SbDash sb_dash_dose = {2, {8, 4}};
const SbDash sb_dash_now = {2, {2, 3}};

// Role, light, dark.
static const struct {
  SbRole role;
  unsigned code[2];
} codes[SB_ROLE_COUNT] = {
    {SB_ROLE_BACKGROUND, {0xF5F5F3, 0x17191C}},  {SB_ROLE_PANEL, {0xFFFFFF, 0x1F2226}},
    {SB_ROLE_HAIRLINE, {0xDDDDD8, 0x363A40}},    {SB_ROLE_GRID, {0xECECE8, 0x2B2F34}},
    {SB_ROLE_AXIS, {0x8A9199, 0x7F868E}},        {SB_ROLE_INK, {0x1D2126, 0xECEDEE}},
    {SB_ROLE_SECOND, {0x555C64, 0xA9B0B8}},      {SB_ROLE_THIRD, {0x696F77, 0x8E959D}},
    {SB_ROLE_INNER, {0x1959A0, 0x68B2EF}},       {SB_ROLE_OUTER, {0xA34409, 0xEE985A}},
    {SB_ROLE_FLUID, {0x1E5D80, 0x86C7ED}},       {SB_ROLE_NOW, {0xC2026B, 0xFA6BAA}},
    {SB_ROLE_PINNED, {0x8D949B, 0x6F767E}},      {SB_ROLE_VIOLET, {0x4D2472, 0x9565C7}},
    {SB_ROLE_TEAL, {0x249B86, 0x85E2CE}},        {SB_ROLE_OCHRE, {0xBF9932, 0xF4DE8C}},
    {SB_ROLE_HOUSING, {0xE7E9EB, 0x2C3035}},     {SB_ROLE_HOUSING_HATCH, {0xCACED3, 0x41464D}},
    {SB_ROLE_STEM, {0xD9DDE2, 0x383D43}},        {SB_ROLE_STEM_HATCH, {0xBFC5CC, 0x4C525A}},
    {SB_ROLE_OUTLINE, {0x363C43, 0xC3C9D0}},     {SB_ROLE_PASS, {0x21763C, 0x76CF8A}},
    {SB_ROLE_WARN, {0x955E00, 0xEEBB5E}},        {SB_ROLE_ERROR, {0xBE2323, 0xF67972}},
    {SB_ROLE_WARN_GROUND, {0xFBF1DC, 0x3A311C}}, {SB_ROLE_ERROR_GROUND, {0xFCE8E6, 0x3F2422}},
};

static SbTheme themes[2];
static pthread_once_t themes_once = PTHREAD_ONCE_INIT;

static void fill_themes(void) {
  for (int dark = 0; dark < 2; dark++) {
    SbTheme *t = &themes[dark];
    t->dark = dark;
    t->loop_fill = dark ? 0.06 : 0.035;
    t->curve_fill = 0.16;
    for (int i = 0; i < SB_ROLE_COUNT; i++) {
      t->role[codes[i].role] = sb_color_hex(codes[i].code[dark]);
    }
  }
}

const SbTheme *sb_theme(bool dark) {
  pthread_once(&themes_once, fill_themes);
  return &themes[dark];
}

SbColor sb_theme_seal(const SbTheme *theme, int seal) {
  return theme->role[seal == 0 ? SB_ROLE_OUTER : SB_ROLE_INNER];
}

static double clamp(double v, double lo, double hi) {
  return v >= lo ? (v <= hi ? v : hi) : lo; // NaN becomes lo
}

SbColor sb_theme_field(const SbTheme *theme, double t) {
  t = clamp(t, 0, 1);
  if (theme->dark) {
    return sb_color_oklch(0.300 + 0.625 * t, 0.035 + 0.125 * sin(M_PI * (0.14 + 0.78 * t)),
                          -30 + 125 * t);
  }
  return sb_color_oklch(0.945 - 0.625 * t, 0.035 + 0.135 * sin(M_PI * (0.06 + 0.80 * t)),
                        95 - 125 * t);
}

SbColor sb_theme_fluid(const SbTheme *theme, double pressure) {
  double t = clamp(pressure / SB_FLUID_FULL, 0, 1);
  if (theme->dark) {
    return sb_color_oklch(0.245 + 0.135 * t, 0.008 + 0.050 * t, 240);
  }
  return sb_color_oklch(0.985 - 0.125 * t, 0.005 + 0.055 * t, 232);
}

SbColor sb_theme_diverging(const SbTheme *theme, double t) {
  t = clamp(t, -1, 1);
  double a = fabs(t);
  double lightness = theme->dark ? 0.28 + 0.46 * a : 0.965 - 0.42 * a;
  return sb_color_oklch(lightness, 0.005 + 0.135 * a, t < 0 ? 250 : 50);
}

SbColor sb_theme_readable(const SbTheme *theme, SbColor wanted, SbColor ground) {
  if (sb_color_contrast(wanted, ground) >= 4.5) {
    return wanted;
  }
  SbColor ink = theme->role[SB_ROLE_INK], paper = theme->role[SB_ROLE_PANEL];
  return sb_color_contrast(ink, ground) >= sb_color_contrast(paper, ground) ? ink : paper;
}
