// Measured surfaces: random ones with known moments, form, filters, missing points.
#include "engine/contact/rough/height_figures.h"
#include "engine/contact/rough/height_spectrum.h"
#include "engine/contact/rough/persson.h"
#include "tests/engine/near.h"
#include "tests/engine/random_surface.h"

#include <string.h>

// Level up to 16 waves a side, then self-affine to waves of 12 points.
static const RandomSurface usual = {512, 0.5e-6, 1e-6, 16, 512 / 12.0, 0.8, 1};

static SbHeightsReport prepare(SbHeights *h, SbHeightsChoices choices) {
  SbHeightsReport told;
  SbReport report = {0};
  if (sb_heights_prepare(&told, h, &choices, &report) != SB_OK) {
    g_error("%s", report.text);
  }
  return told;
}

static SbHeightFigures figures_of(const SbHeights *h) {
  SbHeightFigures out;
  g_assert_cmpint(sb_height_figures(&out, h, NULL), ==, SB_OK);
  return out;
}

// m0, m2, m4 within 2 % and summits within 5 % of what is known, over spectra and seeds.
static void test_random(void) {
  static const double hurst[] = {0.3, 0.8, -1}; // the last: white up to its end
  static const double points[] = {9, 12, 20};   // of the shortest wave
  for (guint64 seed = 1; seed <= 2; seed++) {
    for (size_t i = 0; i < G_N_ELEMENTS(hurst); i++) {
      for (size_t k = 0; k < G_N_ELEMENTS(points); k++) {
        const RandomSurface s = {768, 0.5e-6, 1e-6, 8, 768 / points[k], hurst[i], seed};
        double known[3], spectral[3];
        SbHeights h = random_surface(known, &s);
        prepare(&h, (SbHeightsChoices){.form = SB_FORM_PLANE});
        const SbHeightFigures f = figures_of(&h);
        SbHeightSpectrum spectrum;
        g_assert_cmpint(sb_height_spectrum(&spectrum, &h, NULL), ==, SB_OK);
        sb_height_spectrum_moments(spectral, &spectrum, 0, 0);
        const SbAsperityFigures nayak = sb_asperities_of_moments(known, true);
        g_test_message("H %g, %g points: m2 %.4f %.4f, m4 %.4f %.4f, zeta %.4f beta %.4f sigma_s "
                       "%.4f of %zu summits",
                       hurst[i], points[k], f.moment[1] / known[1], spectral[1] / known[1],
                       f.moment[2] / known[2], spectral[2] / known[2],
                       f.neighbours.density / nayak.density, f.neighbours.radius / nayak.radius,
                       f.neighbours.sigma / nayak.sigma, f.summits);
        for (int m = 0; m < 3; m++) {
          assert_close(f.moment[m], known[m], 0.02);
          assert_close(spectrum.moment[m], spectral[m], 1e-12);
        }
        // Hann's window sees a quarter of the surface: some 600 waves where there are fewest,
        // whose mean power has a deviation of 4 %.
        assert_close(spectral[1], known[1], 0.1);
        assert_close(spectral[2], known[2], 0.1);
        assert_close(f.neighbours.density, nayak.density, 0.05);
        assert_close(f.neighbours.radius, nayak.radius, 0.05);
        assert_close(f.neighbours.sigma, nayak.sigma, 0.05);
        assert_close(f.moments.density, nayak.density, 0.03);
        assert_close(f.sdq * f.sdq, 2 * known[1], 0.02);
        // Gaussian.
        g_assert_cmpfloat(fabs(f.ssk), <, 0.25);
        g_assert_cmpfloat(fabs(f.sku - 3), <, 0.35);
        sb_height_spectrum_finish(&spectrum);
        g_free(h.z);
      }
    }
  }
}

// The three figures that a scene takes give the surface's moments back (persson.h).
static void test_scene(void) {
  double known[3];
  SbHeights h = random_surface(known, &usual);
  const SbHeightFigures f = figures_of(&h);
  const SbAsperityFigures a = sb_asperities_of_moments(f.moment, false);
  SbSpectrum spectrum;
  g_assert_cmpint(
      sb_spectrum_from_asperities(&spectrum, a.sigma, a.sigma_over_beta, a.product, NULL), ==,
      SB_OK);
  assert_close(spectrum.sigma, f.sq, 1e-9);
  assert_close(spectrum.slope, f.sdq, 1e-6);
  g_free(h.z);
}

static void test_spectrum(void) {
  const RandomSurface s = {1024, 0.5e-6, 1e-6, 12, 256, 0.7, 3};
  double known[3];
  SbHeights h = random_surface(known, &s);
  SbHeightSpectrum spectrum;
  g_assert_cmpint(sb_height_spectrum(&spectrum, &h, NULL), ==, SB_OK);
  const double unit = 2 * M_PI / (1024 * s.step);
  g_test_message("H %g, roll-off at %g waves, cut-off at %g", spectrum.hurst,
                 spectrum.roll_off / unit, spectrum.cut_off / unit);
  ASSERT_NEAR(spectrum.hurst, 0.7, 0.03);
  assert_close(spectrum.roll_off, 12 * unit, 0.12);
  assert_close(spectrum.cut_off, 256 * unit, 0.26); // two bins
  // The sum of C over the plane is m0; C itself lies on its line.
  double sum = 0;
  for (double x = -256; x <= 256; x++) {
    for (double y = -256; y <= 256; y++) {
      sum += random_surface_power(&s, hypot(x, y));
    }
  }
  for (size_t i = 0; i < spectrum.count; i++) {
    const double waves = spectrum.q[i] / unit;
    if (waves > 20 && waves < 240) {
      assert_close(spectrum.c[i], random_surface_power(&s, waves) / sum * known[0] / (unit * unit),
                   0.15);
    }
  }
  sb_height_spectrum_finish(&spectrum);
  g_free(h.z);

  // One that has no power law says so.
  h = random_surface(known, &(RandomSurface){512, 0.5e-6, 1e-6, 8, 60, -1, 4});
  g_assert_cmpint(sb_height_spectrum(&spectrum, &h, NULL), ==, SB_OK);
  g_assert_true(isnan(spectrum.hurst) && isnan(spectrum.roll_off));
  g_assert_nonnull(spectrum.reason);
  sb_height_spectrum_finish(&spectrum);
  g_free(h.z);
}

// What filters leave has the moments that the spectrum foretells.
static void test_cutoffs(void) {
  double known[3], foretold[3];
  for (int filter = 0; filter < 3; filter++) {
    SbHeights h = random_surface(known, &(RandomSurface){1024, 0.5e-6, 1e-6, 40, 100, 0.8, 5});
    const double cutoff_short = filter != 1 ? 10e-6 : 0, cutoff_long = filter != 0 ? 25e-6 : 0;
    SbHeightSpectrum spectrum;
    g_assert_cmpint(sb_height_spectrum(&spectrum, &h, NULL), ==, SB_OK);
    sb_height_spectrum_moments(foretold, &spectrum, cutoff_short, cutoff_long);
    prepare(&h, (SbHeightsChoices){.cutoff_short = cutoff_short, .cutoff_long = cutoff_long});
    const SbHeightFigures f = figures_of(&h);
    for (int m = 0; m < 3; m++) {
      g_test_message("filter %d: m%d %g, foretold %g of %g", filter, 2 * m, f.moment[m],
                     foretold[m], known[m]);
      assert_close(f.moment[m], foretold[m], 0.04);
    }
    sb_height_spectrum_finish(&spectrum);
    g_free(h.z);
  }
}

// The Gaussian passes exp(-ln 2 (L/wave)^2) of a wave, half at its cut-off; a constant whole, with
// points missing too.
static void test_filter(void) {
  enum { N = 900, M = 40 };
  static double z[N * M];
  for (double wave = 15; wave <= 240; wave *= 2) {
    for (size_t k = 0; k < N * M; k++) {
      z[k] = sin(2 * M_PI * (double)(k % N) / wave);
    }
    for (int rows = 1; rows <= M; rows += M - 1) {
      double copy[N * M];
      memcpy(copy, z, sizeof copy);
      SbHeights h = {N, (size_t)rows, N, 1e-6, 1e-6, copy};
      g_assert_cmpint(sb_heights_filter(&h, 60e-6, true, NULL), ==, SB_OK);
      const double passed = exp(-M_LN2 * pow(60 / wave, 2));
      for (size_t k = 100; k < 800; k++) {
        ASSERT_NEAR(copy[k], passed * z[k], 1e-5);
      }
    }
  }
  for (size_t k = 0; k < N * M; k++) {
    z[k] = k % 7 == 0 ? NAN : 3;
  }
  SbHeights h = {N, M, N, 1e-6, 1e-6, z};
  g_assert_cmpint(sb_heights_filter(&h, 20e-6, true, NULL), ==, SB_OK);
  for (size_t k = 0; k < N * M; k++) {
    g_assert_true(k % 7 == 0 ? isnan(z[k]) : fabs(z[k] - 3) < 1e-12);
  }
}

// Forms are taken away as they were put on; the cylinder's radius comes out.
static void test_form(void) {
  enum { N = 200, M = 150 };
  static double z[N * M];
  for (int angle = 0; angle < 180; angle += 30) {
    const double a = angle * M_PI / 180, radius = angle % 60 == 0 ? 0.8e-3 : -0.8e-3;
    for (size_t i = 0; i < M; i++) {
      for (size_t j = 0; j < N; j++) {
        const double x = ((double)j - 90) * 2e-6, y = ((double)i - 80) * 2e-6;
        const double w = x * cos(a) + y * sin(a) - 20e-6, v = y * cos(a) - x * sin(a);
        z[i * N + j] = 5e-3 + 0.02 * v + copysign(sqrt(radius * radius - w * w), radius) +
                       1e-8 * ((i + j) % 2 == 0 ? 1 : -1);
      }
    }
    z[777] = NAN;
    SbHeights h = {N, M, N, 2e-6, 2e-6, z};
    double found;
    g_assert_cmpint(sb_heights_level(&found, &h, SB_FORM_CYLINDER, NULL), ==, SB_OK);
    assert_close(found, radius, 1e-4);
    const SbHeightFigures f = figures_of(&h);
    assert_close(f.sq, 1e-8, 1e-3);
  }
  // Order 2, on a grid with other distances, and in a profile.
  for (int rows = 1; rows <= M; rows += M - 1) {
    for (size_t i = 0; i < (size_t)rows; i++) {
      for (size_t j = 0; j < N; j++) {
        const double x = (double)j * 2e-6, y = (double)i * 3e-6;
        z[i * N + j] = 1 + 2 * x + (rows > 1 ? 0.3 * y + 40 * x * y - 100 * y * y : 0) +
                       300 * x * x + 1e-8 * ((i + j) % 2 == 0 ? 1 : -1);
      }
    }
    SbHeights h = {N, (size_t)rows, N, 2e-6, 3e-6, z};
    const SbHeightsReport told = prepare(&h, (SbHeightsChoices){.form = SB_FORM_QUADRATIC});
    assert_close(figures_of(&h).sq, 1e-8, 1e-3);
    g_assert_cmpfloat(told.form_share, >, 0.999);
    g_assert_cmpfloat(told.curved_share, >, 0.999);
    g_assert_true(isnan(told.form_radius));
  }
}

static void test_missing(void) {
  double known[3];
  SbHeights h = random_surface(known, &usual);
  const size_t points = h.columns * h.rows;
  size_t gone = 0, spikes = 0;
  for (size_t k = 0; k < points; k++) {
    if (sb_random(9, k, 0) < 0.01) {
      h.z[k] = NAN;
      gone++;
    } else if (sb_random(9, k, 1) < 2e-4) {
      h.z[k] = 50e-6;
      spikes++;
    }
  }
  double *raw = g_memdup2(h.z, points * sizeof *raw);
  SbHeightsReport told = prepare(&h, (SbHeightsChoices){.form = SB_FORM_PLANE});
  g_assert_cmpuint(told.missing, ==, gone);
  g_assert_cmpuint(told.suspicious, ==, spikes);
  g_assert_cmpuint(told.outliers, ==, 0);
  g_assert_cmpfloat(figures_of(&h).sq, >, 1.1e-6);

  memcpy(h.z, raw, points * sizeof *raw);
  told = prepare(&h, (SbHeightsChoices){.form = SB_FORM_PLANE, .outliers = 6});
  g_assert_cmpuint(told.outliers, ==, spikes);
  SbHeightFigures f = figures_of(&h);
  assert_close(f.moment[0], known[0], 0.02);
  assert_close(f.moment[1], known[1], 0.02);
  assert_close(f.moment[2], known[2], 0.02);
  assert_close(f.neighbours.density, sb_asperities_of_moments(known, true).density, 0.07);

  memcpy(h.z, raw, points * sizeof *raw);
  told = prepare(&h, (SbHeightsChoices){.form = SB_FORM_PLANE, .outliers = 6, .fill = true});
  g_assert_cmpuint(told.filled, ==, spikes + gone);
  f = figures_of(&h);
  assert_close(f.moment[0], known[0], 0.02);
  for (size_t k = 0; k < points; k++) {
    g_assert_true(isfinite(h.z[k]));
  }
  g_free(raw);
  g_free(h.z);
}

// A profile of a surface has its moments.
static void test_profile(void) {
  double known[3], sum[3] = {0};
  SbHeights h = random_surface(known, &usual);
  enum { EVERY = 16 };
  for (size_t i = 0; i < h.rows; i += EVERY) {
    SbHeights profile = {h.columns, 1, h.columns, h.dx, NAN, h.z + i * h.stride};
    const SbHeightFigures f = figures_of(&profile);
    for (int m = 0; m < 3; m++) {
      sum[m] += f.moment[m] * EVERY / (double)h.rows;
    }
    g_assert_true(isnan(f.neighbours.density) && f.summits == 0);
    SbHeightSpectrum spectrum;
    g_assert_cmpint(sb_height_spectrum(&spectrum, &profile, NULL), ==, SB_OK);
    g_assert_cmpfloat(spectrum.moment[1] / f.moment[1], >, 0.5);
    g_assert_cmpfloat(spectrum.moment[1] / f.moment[1], <, 2);
    sb_height_spectrum_finish(&spectrum);
  }
  for (int m = 0; m < 3; m++) {
    assert_close(sum[m], known[m], 0.12);
  }
  g_free(h.z);
}

// The parts make the whole.
static void test_parts(void) {
  double known[3], points = 0, summits = 0;
  SbHeights h = random_surface(known, &usual);
  for (size_t i = 0; i < 3; i++) {
    for (size_t j = 0; j < 3; j++) {
      const SbHeights part = sb_heights_part(&h, i, 3, j, 3);
      points += (double)(part.columns * part.rows);
      const SbHeightFigures f = figures_of(&part);
      summits += f.neighbours.density / 9;
      assert_close(f.neighbours.density, sb_asperities_of_moments(known, true).density, 0.2);
    }
  }
  g_assert_cmpfloat(points, ==, (double)(h.columns * h.rows));
  assert_close(summits, figures_of(&h).neighbours.density, 0.03);
  g_free(h.z);
}

static void test_refused(void) {
  enum { N = 40 };
  double z[N * N], wavy[N * N];
  for (size_t k = 0; k < N * N; k++) {
    z[k] = 1e-6;
    wavy[k] = 1e-6 * sin((double)k);
  }
  SbHeightsReport told;
  SbReport report;
  const SbHeightsChoices plain = {.form = SB_FORM_PLANE};
  SbHeights h = {N, N, N, 1e-6, 1e-6, z};
  g_assert_cmpint(sb_heights_prepare(&told, &h, &plain, &report), ==, SB_ERROR_INFEASIBLE);
  h.z = wavy;
  h.dx = 0;
  g_assert_cmpint(sb_heights_prepare(&told, &h, &plain, &report), ==, SB_ERROR_RANGE);
  h.dx = 1e-6;
  h.rows = 15;
  g_assert_cmpint(sb_heights_prepare(&told, &h, &plain, &report), ==, SB_ERROR_RANGE);
  h.rows = N;
  const SbHeightsChoices reversed = {.cutoff_short = 2e-6, .cutoff_long = 1e-6};
  g_assert_cmpint(sb_heights_prepare(&told, &h, &reversed, &report), ==, SB_ERROR_RANGE);
  wavy[3] = INFINITY;
  g_assert_cmpint(sb_heights_prepare(&told, &h, &plain, &report), ==, SB_ERROR_RANGE);
  for (size_t k = 0; k < 3 * N * N / 4 + 1; k++) {
    wavy[k] = NAN;
  }
  g_assert_cmpint(sb_heights_prepare(&told, &h, &plain, &report), ==, SB_ERROR_INFEASIBLE);
  g_assert_true(strstr(report.text, "measured") != NULL);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/heights/random", test_random);
  g_test_add_func("/heights/scene", test_scene);
  g_test_add_func("/heights/spectrum", test_spectrum);
  g_test_add_func("/heights/cutoffs", test_cutoffs);
  g_test_add_func("/heights/filter", test_filter);
  g_test_add_func("/heights/form", test_form);
  g_test_add_func("/heights/missing", test_missing);
  g_test_add_func("/heights/profile", test_profile);
  g_test_add_func("/heights/parts", test_parts);
  g_test_add_func("/heights/refused", test_refused);
  return g_test_run();
}
