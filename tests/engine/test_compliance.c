// Surface compliance: dry contacts against Hertz, the disc's own solver, and a dense solve by
// another method.
#include "engine/contact/compliance.h"

#include "tests/engine/parabola.h"

#include <glib.h>
#include <math.h>

#include "tests/engine/seals.h"

static SbFitProblem disc_problem(double diameter, double squeeze, double pressure,
                                 double tolerance) {
  SbFitProblem problem = unstretched(diameter, squeeze, pressure);
  problem.tolerance = tolerance;
  return problem;
}

// A parabola without smooth part is Hertz's contact, with end pressures the transition of
// docs/verification.md.
static void test_hertz(void) {
  const double radius = 0.8e-3, modulus = 6.5e6, load = 400.0;
  const double reach = 1.2e-3;
  const SbSurfaceCompliance c = parabola(modulus, radius, reach, 0.0);
  SbDryContact d;
  g_assert_cmpint(sb_dry_contact(&d, &c, load, 0.0, 0.0, NULL), ==, SB_OK);
  const double b = sqrt(8.0 * load * radius / (G_PI * modulus));
  const double peak = 2.0 * load / (G_PI * b);
  g_assert_cmpfloat_with_epsilon(d.left / b, -1.0, 1e-9);
  g_assert_cmpfloat_with_epsilon(d.right / b, 1.0, 1e-9);
  g_assert_cmpfloat_with_epsilon(d.peak / peak, 1.0, 1e-9);
  g_assert_cmpfloat_with_epsilon(sb_dry_contact_pressure(&d, 0.6 * b) / peak, 0.8, 1e-9);
  const double wanted = 0.5 * (1.5 * sqrt(1.25) - log(1.5 + sqrt(1.25))) * b * b / radius;
  g_assert_cmpfloat_with_epsilon(sb_dry_contact_gap(&d, &c, 1.5 * b) / wanted, 1.0, 1e-7);
  g_assert_cmpfloat_with_epsilon(sb_dry_contact_gap(&d, &c, -1.5 * b) / wanted, 1.0, 1e-7);
}

// With S = 0 and unequal pressures the edges stay but for the window's tilt: a parabola moves.
static void test_pressures(void) {
  const double radius = 0.8e-3, modulus = 6.5e6, load = 400.0, p = 0.2e6;
  const double reach = 1.2e-3;
  const SbSurfaceCompliance c = parabola(modulus, radius, reach, 0.0);
  SbDryContact d;
  g_assert_cmpint(sb_dry_contact(&d, &c, load, p, 0.0, NULL), ==, SB_OK);
  // Closed form: slope x/R + C p ln(a/window) - C pi a_0 z = 0, so that the middle moves by -R C p
  // ln(a/window) and the half-width is Hertz's for the load pi a a_0/2.
  const double C = 4.0 / (G_PI * modulus);
  const double half = 0.5 * (d.right - d.left);
  const double middle = 0.5 * (d.right + d.left);
  g_assert_cmpfloat_with_epsilon(middle / (-radius * C * p * log(half / reach)), 1.0, 1e-9);
  const double own = 0.5 * G_PI * half * d.a[0];
  g_assert_cmpfloat_with_epsilon(half / sqrt(8.0 * own * radius / (G_PI * modulus)), 1.0, 1e-9);
  g_assert_cmpfloat_with_epsilon((own + p * middle) / load, 1.0, 1e-9);
  g_assert_cmpfloat_with_epsilon(sb_dry_contact_pressure(&d, middle), d.a[0] + 0.5 * p, 1e-3);
}

// The disc: edges, peak and load of the engine's own solver, which is another discretisation.
static void test_disc(void) {
  const double diameter = 1.61e-3, modulus = 2.5e6, nu = 0.49;
  const double squeeze[] = {0.04, 0.1, 0.1553};
  for (int i = 0; i < 3; i++) {
    const SbFitProblem problem = disc_problem(diameter, squeeze[i], 0.0, 1e-6);
    SbFit disc;
    g_assert_cmpint(sb_fit_solve(&disc, &problem, NULL), ==, SB_OK);
    SbSurfaceCompliance c;
    g_assert_cmpint(sb_compliance_disc(&c, 0.5 * diameter, modulus, nu, 0.7 * 0.5 * diameter, NULL),
                    ==, SB_OK);
    SbDryContact d;
    g_assert_cmpint(sb_dry_contact(&d, &c, disc.load_per_length, 0.0, 0.0, NULL), ==, SB_OK);
    g_assert_cmpfloat_with_epsilon((d.right - d.left) / disc.contact_width, 1.0, 1e-5);
    g_assert_cmpfloat_with_epsilon(d.peak / disc.pressure_peak, 1.0, 1e-5);
    for (size_t k = 20; k < disc.profile_count - 20; k++) {
      g_assert_cmpfloat_with_epsilon(sb_dry_contact_pressure(&d, disc.profile_x[k]) /
                                         disc.pressure_peak,
                                     disc.profile_p[k] / disc.pressure_peak, 1e-5);
    }
  }
}

// A gap matched to a pressure gives this pressure back, with and without smooth part.
static void test_match(void) {
  const double diameter = 1.5e-3, modulus = 2.5e6, nu = 0.49;
  const SbFitProblem problem = disc_problem(diameter, 0.12, 0.3e6, 1e-5);
  SbFit disc;
  g_assert_cmpint(sb_fit_solve(&disc, &problem, NULL), ==, SB_OK);
  const size_t N = disc.profile_count;
  const double *x = disc.profile_x, *p = disc.profile_p;
  double load = 0.0;
  for (size_t i = 1; i < N; i++) {
    load += 0.5 * (p[i] + p[i - 1]) * (x[i] - x[i - 1]);
  }
  load -= 0.3e6 * (0.0 - x[0]);
  for (int smooth = 0; smooth < 2; smooth++) {
    SbSurfaceCompliance c;
    g_assert_cmpint(sb_compliance_disc(&c, 0.5 * diameter, modulus, nu, 0.7 * 0.5 * diameter, NULL),
                    ==, SB_OK);
    for (int k = 0; smooth == 0 && k < c.modes; k++) {
      for (int l = 0; l < c.modes; l++) {
        c.smooth[k][l] = 0.0;
      }
    }
    g_assert_cmpint(sb_compliance_match(&c, 8, N, x, p, 0.3e6, 0.0, NULL), ==, SB_OK);
    SbDryContact d;
    g_assert_cmpint(sb_dry_contact(&d, &c, load, 0.3e6, 0.0, NULL), ==, SB_OK);
    g_assert_cmpfloat_with_epsilon(d.left / x[0], 1.0, 1e-3);
    g_assert_cmpfloat_with_epsilon(d.right / x[N - 1], 1.0, 1e-3);
    g_assert_cmpfloat_with_epsilon(d.peak / disc.pressure_peak, 1.0, 1e-3);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/compliance/hertz", test_hertz);
  g_test_add_func("/compliance/pressures", test_pressures);
  g_test_add_func("/compliance/disc", test_disc);
  g_test_add_func("/compliance/match", test_match);
  return g_test_run();
}
