// Gland read-outs of the thesis' valve, their tolerance ranges and bands.
#include "engine/contact/gland.h"
#include "tests/engine/near.h"

#include <glib.h>
#include <math.h>
#include <string.h>

static SbGland thesis(void) {
  return (SbGland){.section_diameter = 1.61e-3,
                   .section_diameter_tolerance = 0.02e-3,
                   .inner_diameter = 2.84e-3,
                   .inner_diameter_tolerance = 0.02e-3,
                   .radial_space = 1.36e-3,
                   .radial_space_tolerance = 0.02e-3,
                   .axial_width = 2.0e-3,
                   .axial_width_tolerance = 0.05e-3,
                   .bore_diameter = 6.0e-3,
                   .bore_diameter_tolerance = 0.01e-3,
                   .land_diameter = 5.794e-3,
                   .land_diameter_tolerance = 0.02e-3,
                   .poisson_ratio = 0.49};
}

static void test_thesis_valve(void) {
  const SbGland gland = thesis();
  SbGlandReadout out[SB_GLAND_COUNT];
  g_assert_cmpint(sb_gland_readouts(out, &gland, NULL), ==, SB_OK);
  // docs/thesis.md.
  assert_close(out[SB_GLAND_STRETCH_INNER].nominal, 0.155, 1e-3);
  assert_close(out[SB_GLAND_STRETCH_MEAN].nominal, 0.0427, 1e-3);
  assert_close(out[SB_GLAND_SQUEEZE].nominal, 0.1553, 1e-3);
  assert_close(out[SB_GLAND_SECTION_FITTED].nominal, 1.5763e-3, 3e-5);
  assert_close(out[SB_GLAND_INTERFERENCE].nominal, 0.2163e-3, 3e-4);
  assert_close(out[SB_GLAND_EXTRUSION_GAP].nominal, 0.206e-3, 1e-9);
  assert_close(out[SB_GLAND_FILL].nominal, 0.718, 1e-3);

  // Stretched three times as much as is customary, squeezed as usual, land too loose.
  g_assert_cmpint(out[SB_GLAND_STRETCH_INNER].band, ==, SB_BAND_ABOVE);
  g_assert_cmpint(out[SB_GLAND_SQUEEZE].band, ==, SB_BAND_WITHIN);
  g_assert_cmpint(out[SB_GLAND_INTERFERENCE].band, ==, SB_BAND_WITHIN);
  g_assert_cmpint(out[SB_GLAND_FILL].band, ==, SB_BAND_WITHIN);
  g_assert_cmpint(out[SB_GLAND_EXTRUSION_GAP].band, ==, SB_BAND_ABOVE);
  g_assert_cmpint(out[SB_GLAND_STRETCH_MEAN].band, ==, SB_BAND_NONE);
  // With its tolerances the squeeze may fall below 15 %.
  g_assert_cmpint(out[SB_GLAND_SQUEEZE].band_worst, ==, SB_BAND_BELOW);
  for (int i = 0; i < SB_GLAND_COUNT; i++) {
    g_assert_cmpstr(out[i].name, !=, "");
    g_assert_cmpint(out[i].band != SB_BAND_NONE, ==, out[i].source[0] != '\0');
    g_assert_cmpfloat(out[i].worst_low, <=, out[i].rss_low + 1e-5 * fabs(out[i].nominal));
    g_assert_cmpfloat(out[i].worst_high, >=, out[i].rss_high - 1e-5 * fabs(out[i].nominal));
    g_assert_cmpfloat(out[i].rss_low, <=, out[i].nominal);
  }
  g_assert_cmpstr(sb_band_text(SB_BAND_BELOW), ==, "below");
  g_assert_cmpstr(sb_band_text(SB_BAND_WITHIN), ==, "within");
  g_assert_cmpstr(sb_band_text(SB_BAND_ABOVE), ==, "above");
  g_assert_cmpstr(sb_band_text(SB_BAND_NONE), ==, "");
}

// Ranges by hand: squeeze 1 - g/d at its corners, and its linear RSS.
// An end of a band that a value meets but for rounding belongs to the band: (1.6 - 1.36)/1.6 is
// below the double 0.15.
static void test_on_the_band(void) {
  double squeeze = (1.6e-3 - 1.36e-3) / 1.6e-3;
  g_assert_cmpint(sb_band_of(squeeze, 0.15, 0.25), ==, SB_BAND_WITHIN);
  g_assert_cmpint(sb_band_of(0.25 * (1 + 1e-15), 0.15, 0.25), ==, SB_BAND_WITHIN);
  g_assert_cmpint(sb_band_of(0.1499999, 0.15, 0.25), ==, SB_BAND_BELOW);
  g_assert_cmpint(sb_band_of(0.2500001, 0.15, 0.25), ==, SB_BAND_ABOVE);
  g_assert_cmpint(sb_band_of(-1e-9, 0, INFINITY), ==, SB_BAND_BELOW);
  g_assert_cmpint(sb_band_of(1e9, -INFINITY, INFINITY), ==, SB_BAND_WITHIN);
}

// The thesis' gland with all its sizes times `factor`: squeeze 15.5 %, clearance 0.206 mm times it.
static SbGland scaled(double factor) {
  SbGland out = thesis();
  out.section_diameter *= factor;
  out.inner_diameter *= factor;
  out.radial_space *= factor;
  out.axial_width *= factor;
  out.bore_diameter *= factor;
  out.land_diameter *= factor;
  return out;
}

// Rows of Parker ORD 5700, charts 5-2 (reciprocating) and 4-2 (static), typed apart from the
// program's. 15.5 % is usual for the smallest sections that move, too much for most others.
static void test_sections(void) {
  static const struct {
    double section, low[SB_GLAND_USE_COUNT], high[SB_GLAND_USE_COUNT], gap_low, gap_high;
    SbBand squeeze[SB_GLAND_USE_COUNT];
  } rows[] = {
      {1.78e-3, {0.15, 0.22}, {0.25, 0.32}, 0.05e-3, 0.13e-3, {SB_BAND_WITHIN, SB_BAND_BELOW}},
      {2.62e-3, {0.10, 0.17}, {0.17, 0.24}, 0.05e-3, 0.13e-3, {SB_BAND_WITHIN, SB_BAND_BELOW}},
      {3.53e-3, {0.09, 0.16}, {0.16, 0.23}, 0.08e-3, 0.15e-3, {SB_BAND_WITHIN, SB_BAND_BELOW}},
      {5.33e-3, {0.08, 0.15}, {0.14, 0.21}, 0.08e-3, 0.15e-3, {SB_BAND_ABOVE, SB_BAND_WITHIN}},
      {6.99e-3, {0.11, 0.15}, {0.16, 0.20}, 0.10e-3, 0.18e-3, {SB_BAND_WITHIN, SB_BAND_WITHIN}},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    for (int use = 0; use < SB_GLAND_USE_COUNT; use++) {
      SbGland gland = scaled(rows[i].section / 1.61e-3);
      SbGlandReadout out[SB_GLAND_COUNT];
      gland.use = (SbGlandUse)use;
      gland.land_diameter = gland.bore_diameter - rows[i].gap_high - 1e-6;
      g_assert_cmpint(sb_gland_readouts(out, &gland, NULL), ==, SB_OK);
      const SbGlandReadout *squeeze = &out[SB_GLAND_SQUEEZE], *gap = &out[SB_GLAND_EXTRUSION_GAP];
      g_assert_cmpfloat_with_epsilon(squeeze->band_low, rows[i].low[use], 1e-12);
      g_assert_cmpfloat_with_epsilon(squeeze->band_high, rows[i].high[use], 1e-12);
      g_assert_cmpfloat_with_epsilon(gap->band_low, rows[i].gap_low, 1e-12);
      g_assert_cmpfloat_with_epsilon(gap->band_high, rows[i].gap_high, 1e-12);
      g_assert_cmpint(squeeze->band, ==, rows[i].squeeze[use]);
      g_assert_cmpint(gap->band, ==, SB_BAND_ABOVE);
      g_assert_nonnull(strstr(squeeze->source, use == SB_GLAND_STATIC ? "4-2" : "5-2"));
      g_assert_cmpstr(squeeze->why, ==, "");
    }
  }
}

// Sections that no row is near, and other profiles, are not judged, and the read-out states why.
static void test_not_judged(void) {
  static const double sections[] = {1.0e-3, 2.15e-3, 4.3e-3, 9.0e-3};
  for (size_t i = 0; i <= G_N_ELEMENTS(sections); i++) {
    const bool round = i < G_N_ELEMENTS(sections);
    SbGland gland = scaled(round ? sections[i] / 1.61e-3 : 1);
    SbGlandReadout out[SB_GLAND_COUNT];
    if (!round) {
      gland.profile = (SbSealProfile){SB_SEAL_PROFILE_D, .axial_height = 1.2e-3};
    }
    g_assert_cmpint(sb_gland_readouts(out, &gland, NULL), ==, SB_OK);
    for (int k = 0; k < SB_GLAND_COUNT; k++) {
      const bool by_section = k == SB_GLAND_SQUEEZE || k == SB_GLAND_EXTRUSION_GAP;
      g_assert_cmpint(out[k].why[0] != '\0', ==, by_section);
      if (by_section) {
        g_assert_cmpint(out[k].band, ==, SB_BAND_NONE);
        g_assert_cmpint(out[k].band_worst, ==, SB_BAND_NONE);
        g_assert_cmpstr(out[k].source, ==, "");
        g_assert_true(isfinite(out[k].nominal));
      }
    }
  }
}

static void test_tolerances(void) {
  SbGland gland = thesis();
  SbGlandReadout out[SB_GLAND_COUNT];
  g_assert_cmpint(sb_gland_readouts(out, &gland, NULL), ==, SB_OK);
  assert_close(out[SB_GLAND_SQUEEZE].worst_low, 1.0 - 1.38 / 1.59, 1e-12);
  assert_close(out[SB_GLAND_SQUEEZE].worst_high, 1.0 - 1.34 / 1.63, 1e-12);
  const double half = hypot(0.02 / 1.61, 1.36 * 0.02 / (1.61 * 1.61));
  assert_close(out[SB_GLAND_SQUEEZE].rss_high - out[SB_GLAND_SQUEEZE].nominal, half, 1e-3);
  assert_close(out[SB_GLAND_EXTRUSION_GAP].worst_high, 0.236e-3, 1e-9);
  assert_close(out[SB_GLAND_EXTRUSION_GAP].rss_high, 0.206e-3 + hypot(0.01e-3, 0.02e-3), 1e-9);
  assert_close(out[SB_GLAND_FILL].worst_high,
               0.25 * M_PI * 1.63 * 1.63 * (2.86 + 1.63) / (1.34 * (5.99 - 1.34) * 1.95), 1e-12);

  // Swell fills the groove.
  gland.volume_swell = 0.151;
  g_assert_cmpint(sb_gland_readouts(out, &gland, NULL), ==, SB_OK);
  assert_close(out[SB_GLAND_FILL_SWOLLEN].nominal, 1.151 * out[SB_GLAND_FILL].nominal, 1e-12);
  g_assert_cmpint(out[SB_GLAND_SWELL].band, ==, SB_BAND_WITHIN);
  const double growth = cbrt(1.151);
  assert_close(out[SB_GLAND_SQUEEZE_SWOLLEN].nominal, 1.0 - 1.36 / (1.61 * growth), 1e-12);
  assert_close(out[SB_GLAND_SECTION_SWOLLEN].nominal,
               1.61e-3 * growth * (1.0 - 0.49 * (4.64 / (4.45 * growth) - 1.0)), 1e-12);
  gland.volume_swell = 0.35;
  g_assert_cmpint(sb_gland_readouts(out, &gland, NULL), ==, SB_OK);
  g_assert_cmpint(out[SB_GLAND_SWELL].band, ==, SB_BAND_ABOVE);
  g_assert_cmpint(out[SB_GLAND_FILL_SWOLLEN].band, ==, SB_BAND_ABOVE);

  // No tolerances: no range.
  gland.section_diameter_tolerance = gland.inner_diameter_tolerance = 0.0;
  gland.radial_space_tolerance = gland.axial_width_tolerance = 0.0;
  gland.bore_diameter_tolerance = gland.land_diameter_tolerance = 0.0;
  g_assert_cmpint(sb_gland_readouts(out, &gland, NULL), ==, SB_OK);
  for (int i = 0; i < SB_GLAND_COUNT; i++) {
    g_assert_cmpfloat(out[i].worst_low, ==, out[i].worst_high);
    g_assert_cmpfloat(out[i].rss_low, ==, out[i].rss_high);
    g_assert_cmpint(out[i].band, ==, out[i].band_worst);
  }
}

static void test_refusals(void) {
  SbGlandReadout out[SB_GLAND_COUNT];
  SbReport report = {0};
  SbGland gland = thesis();
  gland.inner_diameter = 0.0;
  g_assert_cmpint(sb_gland_readouts(out, &gland, &report), ==, SB_ERROR_RANGE);
  g_assert_cmpstr(sb_input_key(report.input), ==, "seal.inner_diameter");
  gland = thesis();
  gland.axial_width_tolerance = 2.0e-3;
  g_assert_cmpint(sb_gland_readouts(out, &gland, &report), ==, SB_ERROR_RANGE);
  g_assert_cmpstr(sb_input_key(report.input), ==, "gland.axial_width");
  gland = thesis();
  gland.volume_swell = NAN;
  g_assert_cmpint(sb_gland_readouts(out, &gland, &report), ==, SB_ERROR_RANGE);
  gland = thesis();
  gland.bore_diameter = 2.75e-3;
  g_assert_cmpint(sb_gland_readouts(out, &gland, &report), ==, SB_ERROR_INFEASIBLE);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/gland/thesis-valve", test_thesis_valve);
  g_test_add_func("/gland/on-the-band", test_on_the_band);
  g_test_add_func("/gland/sections", test_sections);
  g_test_add_func("/gland/not-judged", test_not_judged);
  g_test_add_func("/gland/tolerances", test_tolerances);
  g_test_add_func("/gland/refusals", test_refusals);
  return g_test_run();
}
