// The look's promises about colour: contrast, distance under colour blindness, even maps.
#include "app/draw/theme.h"

#include <glib.h>
#include <math.h>

// Every ground on which text of a role stands.
static double to_linear(double c) {
  return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static double to_gamma(double c) {
  c = CLAMP(c, 0, 1);
  return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1.0 / 2.4) - 0.055;
}

// Ottosson's OKLab of a colour: the inverse of sb_color_from_oklab().
static SbOklab to_oklab(SbColor color) {
  double r = to_linear(color.r), g = to_linear(color.g), b = to_linear(color.b);
  double l = cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  double m = cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  double s = cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return (SbOklab){0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
                   1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
                   0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

static double distance_of(SbColor a, SbColor b) {
  SbOklab p = to_oklab(a), q = to_oklab(b);
  return sqrt((p.l - q.l) * (p.l - q.l) + (p.a - q.a) * (p.a - q.a) + (p.b - q.b) * (p.b - q.b));
}

// Protan, deutan and tritan vision: Machado, Oliveira and Fernandes (2009), table 1, severity 1, in
// linear light.
enum { PROTAN, TRITAN = 2 };

static SbColor simulate(SbColor color, int vision) {
  static const double matrix[3][3][3] = {
      {{0.152286, 1.052583, -0.204868},
       {0.114503, 0.786281, 0.099216},
       {-0.003882, -0.048116, 1.051998}},
      {{0.367322, 0.860646, -0.227968},
       {0.280085, 0.672501, 0.047413},
       {-0.011820, 0.042940, 0.968881}},
      {{1.255528, -0.076749, -0.178779},
       {-0.078411, 0.930809, 0.147602},
       {0.004733, 0.691367, 0.303900}},
  };
  double in[3] = {to_linear(color.r), to_linear(color.g), to_linear(color.b)}, out[3];
  for (int i = 0; i < 3; i++) {
    const double *row = matrix[vision][i];
    out[i] = to_gamma(row[0] * in[0] + row[1] * in[1] + row[2] * in[2]);
  }
  return (SbColor){out[0], out[1], out[2], 1};
}

static void test_text_contrast(void) {
  static const struct {
    SbRole text;
    SbRole ground;
  } pairs[] = {
      {SB_ROLE_INK, SB_ROLE_BACKGROUND},     {SB_ROLE_INK, SB_ROLE_PANEL},
      {SB_ROLE_INK, SB_ROLE_HOUSING},        {SB_ROLE_INK, SB_ROLE_STEM},
      {SB_ROLE_SECOND, SB_ROLE_BACKGROUND},  {SB_ROLE_SECOND, SB_ROLE_PANEL},
      {SB_ROLE_SECOND, SB_ROLE_HOUSING},     {SB_ROLE_SECOND, SB_ROLE_STEM},
      {SB_ROLE_THIRD, SB_ROLE_BACKGROUND},   {SB_ROLE_THIRD, SB_ROLE_PANEL},
      {SB_ROLE_INNER, SB_ROLE_PANEL},        {SB_ROLE_INNER, SB_ROLE_HOUSING},
      {SB_ROLE_INNER, SB_ROLE_STEM},         {SB_ROLE_OUTER, SB_ROLE_PANEL},
      {SB_ROLE_OUTER, SB_ROLE_HOUSING},      {SB_ROLE_OUTER, SB_ROLE_STEM},
      {SB_ROLE_FLUID, SB_ROLE_PANEL},        {SB_ROLE_FLUID, SB_ROLE_HOUSING},
      {SB_ROLE_FLUID, SB_ROLE_STEM},         {SB_ROLE_NOW, SB_ROLE_PANEL},
      {SB_ROLE_NOW, SB_ROLE_BACKGROUND},     {SB_ROLE_PASS, SB_ROLE_PANEL},
      {SB_ROLE_WARN, SB_ROLE_BACKGROUND},    {SB_ROLE_WARN, SB_ROLE_PANEL},
      {SB_ROLE_WARN, SB_ROLE_WARN_GROUND},   {SB_ROLE_ERROR, SB_ROLE_PANEL},
      {SB_ROLE_ERROR, SB_ROLE_ERROR_GROUND},
  };
  for (int dark = 0; dark < 2; dark++) {
    const SbTheme *t = sb_theme(dark);
    for (size_t i = 0; i < G_N_ELEMENTS(pairs); i++) {
      double ratio = sb_color_contrast(t->role[pairs[i].text], t->role[pairs[i].ground]);
      if (ratio < 4.5) {
        g_test_message("%s: role %d on %d has %.2f", dark ? "dark" : "light", pairs[i].text,
                       pairs[i].ground, ratio);
        g_test_fail();
      }
    }
    // Ink on the fluid at every pressure; seal labels on their own fill.
    for (int i = 0; i <= 14; i++) {
      SbColor fluid = sb_theme_fluid(t, 0.05e6 * i);
      g_assert_cmpfloat(sb_color_contrast(t->role[SB_ROLE_INK], fluid), >=, 4.5);
      SbColor readable = sb_theme_readable(t, t->role[SB_ROLE_THIRD], fluid);
      g_assert_cmpfloat(sb_color_contrast(readable, fluid), >=, 4.5);
    }
    for (int seal = 0; seal < 2; seal++) {
      SbColor fill = sb_color_mix(t->role[SB_ROLE_PANEL], sb_theme_seal(t, seal), t->curve_fill);
      g_assert_cmpfloat(sb_color_contrast(t->role[SB_ROLE_INK], fill), >=, 4.5);
    }
  }
}

static void test_curve_contrast(void) {
  static const SbRole curves[] = {SB_ROLE_INK,    SB_ROLE_INNER, SB_ROLE_OUTER,
                                  SB_ROLE_FLUID,  SB_ROLE_NOW,   SB_ROLE_PINNED,
                                  SB_ROLE_VIOLET, SB_ROLE_TEAL,  SB_ROLE_OUTLINE};
  for (int dark = 0; dark < 2; dark++) {
    const SbTheme *t = sb_theme(dark);
    for (size_t i = 0; i < G_N_ELEMENTS(curves); i++) {
      double ratio = sb_color_contrast(t->role[curves[i]], t->role[SB_ROLE_PANEL]);
      if (ratio < 3) {
        g_test_message("%s: curve role %d has %.2f", dark ? "dark" : "light", curves[i], ratio);
        g_test_fail();
      }
    }
    SbColor future = sb_color_mix(t->role[SB_ROLE_PANEL], t->role[SB_ROLE_INK], SB_OPACITY_FUTURE);
    g_assert_cmpfloat(sb_color_contrast(future, t->role[SB_ROLE_PANEL]), >=, 3);
  }
}

static void test_colour_blindness(void) {
  for (int dark = 0; dark < 2; dark++) {
    const SbTheme *t = sb_theme(dark);
    for (int v = PROTAN; v <= TRITAN; v++) {
      SbColor a = simulate(t->role[SB_ROLE_INNER], v);
      SbColor b = simulate(t->role[SB_ROLE_OUTER], v);
      double d = distance_of(a, b);
      g_test_message("%s vision %d: inner to outer %.3f", dark ? "dark" : "light", v, d);
      g_assert_cmpfloat(d, >=, 0.20);
    }
  }
}

// Steps in OKLab are even within 2 %, so that equal differences of the field look equal.
static void test_even_maps(void) {
  enum { STEPS = 64 };
  for (int dark = 0; dark < 2; dark++) {
    const SbTheme *t = sb_theme(dark);
    for (int map = 0; map < 2; map++) {
      double least = INFINITY, most = 0, sum = 0;
      for (int i = 0; i < STEPS; i++) {
        double a = i / (double)STEPS, b = (i + 1) / (double)STEPS;
        SbColor p = map ? sb_theme_fluid(t, a * SB_FLUID_FULL) : sb_theme_field(t, a);
        SbColor q = map ? sb_theme_fluid(t, b * SB_FLUID_FULL) : sb_theme_field(t, b);
        double d = distance_of(p, q);
        least = fmin(least, d);
        most = fmax(most, d);
        sum += d / STEPS;
      }
      g_test_message("%s %s: steps %.5f to %.5f", dark ? "dark" : "light", map ? "fluid" : "field",
                     least, most);
      g_assert_cmpfloat(most, <=, 1.02 * sum);
      g_assert_cmpfloat(least, >=, 0.98 * sum);
    }
    // Lightness is linear, whatever the gamut took of the chroma.
    for (int i = 0; i <= STEPS; i++) {
      double u = i / (double)STEPS;
      double l = dark ? 0.300 + 0.625 * u : 0.945 - 0.625 * u;
      g_assert_cmpfloat(fabs(to_oklab(sb_theme_field(t, u)).l - l), <, 2e-3);
    }
    // Low values recede into the panel, and both halves of the diverging map go up alike.
    g_assert_cmpfloat(distance_of(sb_theme_field(t, 0), t->role[SB_ROLE_PANEL]), <,
                      distance_of(sb_theme_field(t, 1), t->role[SB_ROLE_PANEL]));
    for (int i = 0; i <= 10; i++) {
      double a = to_oklab(sb_theme_diverging(t, 0.1 * i)).l;
      double b = to_oklab(sb_theme_diverging(t, -0.1 * i)).l;
      g_assert_cmpfloat(fabs(a - b), <, 2e-3);
    }
  }
  // Not a number gets a colour too.
  SbColor c = sb_theme_field(sb_theme(false), NAN);
  g_assert_true(isfinite(c.r) && isfinite(c.g) && isfinite(c.b));
}

// Fixed points: the target picture's legend, and values from the literature.
static void test_known_values(void) {
  SbColor c = sb_theme_field(sb_theme(false), 0);
  g_assert_cmpfloat(fabs(c.r - 0.9773102), <, 1e-4);
  g_assert_cmpfloat(fabs(c.g - 0.93022848), <, 1e-4);
  g_assert_cmpfloat(fabs(c.b - 0.75171722), <, 1e-4);
  SbColor canister = sb_theme_fluid(sb_theme(false), 0.55e6);
  g_assert_cmpfloat(fabs(canister.r - 0.73261454), <, 1e-4);
  g_assert_cmpfloat(fabs(canister.g - 0.87878507), <, 1e-4);
  g_assert_cmpfloat(fabs(canister.b - 0.95889645), <, 1e-4);
  g_assert_cmpfloat(fabs(sb_color_contrast(sb_color_hex(0), sb_color_hex(0xffffff)) - 21), <, 1e-9);
  SbOklab white = to_oklab(sb_color_hex(0xffffff));
  g_assert_cmpfloat(fabs(white.l - 1), <, 1e-6);
  // There and back.
  for (unsigned rgb = 0; rgb < 0x1000000; rgb += 40507) {
    SbColor a = sb_color_hex(rgb), b = sb_color_from_oklab(to_oklab(a));
    g_assert_cmpfloat(fabs(a.r - b.r) + fabs(a.g - b.g) + fabs(a.b - b.b), <, 1e-5);
  }
  // Out of gamut: fits, and keeps its lightness.
  SbColor clipped = sb_color_oklch(0.7, 0.4, 145);
  g_assert_cmpfloat(fabs(to_oklab(clipped).l - 0.7), <, 1e-3);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/theme/text-contrast", test_text_contrast);
  g_test_add_func("/theme/curve-contrast", test_curve_contrast);
  g_test_add_func("/theme/colour-blindness", test_colour_blindness);
  g_test_add_func("/theme/even-maps", test_even_maps);
  g_test_add_func("/theme/known-values", test_known_values);
  return g_test_run();
}
