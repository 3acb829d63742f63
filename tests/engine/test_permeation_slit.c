// Gas through a slit: free flight against Clausing's integral equation solved here, Poiseuille's
// flow against its closed form, and between them the linearised Boltzmann equation's values.
#include "engine/numeric/dense.h"
#include "engine/permeation/slit.h"
#include "tests/engine/near.h"

static const double GAS = 8.314462618;

// Share of the molecules that a wall's place sends to the other wall within s along it.
static double reach(double s) {
  return 0.5 * s / sqrt(1.0 + s * s);
}

// Clausing's equation for plates at distance 1 (Ann. Phys. 404 (1932) 961): w(x), the share of what
// leaves the wall at x that gets out at l, constant on cells that are small at both ends.
static double clausing_on(double l, int cells) {
  double *e = g_new(double, cells + 1), *a = g_new(double, cells *cells), *w = g_new(double, cells);
  int *pivot = g_new(int, cells);
  for (int i = 0; i <= cells; i++) {
    e[i] = l * 0.5 * (1.0 - cos(M_PI * i / cells));
  }
  for (int i = 0; i < cells; i++) {
    const double x = 0.5 * (e[i] + e[i + 1]);
    w[i] = 0.5 - reach(l - x);
    for (int j = 0; j < cells; j++) {
      a[i * cells + j] = (i == j ? 1.0 : 0.0) - (reach(e[j + 1] - x) - reach(e[j] - x));
    }
  }
  g_assert_true(sb_factor_solve(a, pivot, w, cells, true));
  double sum = sqrt(1.0 + l * l) - l;
  for (int i = 0; i < cells; i++) { // two walls
    sum += w[i] * ((e[i + 1] - sqrt(1.0 + e[i + 1] * e[i + 1])) - (e[i] - sqrt(1.0 + e[i] * e[i])));
  }
  g_free(e);
  g_free(a);
  g_free(w);
  g_free(pivot);
  return sum;
}

// Of second order: what halving the cells changes, and a third of it more.
static double clausing(double l) {
  const double fine = clausing_on(l, 500), coarse = clausing_on(l, 250);
  return fine + (fine - coarse) / 3.0;
}

static void test_transmission(void) {
  const double l[] = {0.1, 1.0, 3.0, 8.0, 10.0, 20.0, 40.0, 100.0};
  for (size_t i = 0; i < G_N_ELEMENTS(l); i++) {
    const double exact = clausing(l[i]), value = sb_slit_transmission(l[i]);
    g_test_message("L/h %g: %.6f, Clausing %.6f (%.1e)", l[i], value, exact, value / exact - 1.0);
    assert_close(value, exact, 3e-4);
  }
  assert_close(sb_slit_transmission(1e4), sb_slit_transmission(1e4 * (1 + 1e-9)), 1e-3);
  g_assert_cmpfloat(sb_slit_transmission(0.0), ==, 1.0);
}

static void test_limits(void) {
  const SbSlit s = {50e-9, 1e-6, 298.15, 0.102, 11.7e-6};
  // Free flight at a thousandth of a pascal, by what enters: p/sqrt(2 pi R T/M).
  const double flight =
      s.height * clausing(20.0) * 1e-3 / sqrt(2.0 * M_PI * GAS * s.temperature / s.molar_mass);
  assert_close(sb_slit_mass_flow(&s, 1e-3, 0.0), flight, 1e-3);
  // Poiseuille's between plates 1 mm apart: h^3 M (p1^2 - p2^2)/(24 eta R T L).
  const SbSlit wide = {1e-3, 0.1, 298.15, 0.102, 11.7e-6};
  const double viscous = 1e-9 * s.molar_mass * (4e10 - 1e10) /
                         (24.0 * s.viscosity * GAS * s.temperature * wide.length);
  assert_close(sb_slit_mass_flow(&wide, 2e5, 1e5), viscous, 1e-3);
}

// Fukui and Kaneko's fit of the linearised Boltzmann equation between plates without end.
static double boltzmann(double d) {
  return d >= 5.0    ? d / 6.0 + 1.0162 + 1.0653 / d - 2.1354 / (d * d)
         : d >= 0.15 ? 0.13852 * d + 1.25087 + 0.15653 / d - 0.00969 / (d * d)
                     : -2.22919 * d + 2.10673 + 0.01653 / d - 0.0000694 / (d * d);
}

static void test_between(void) {
  double least = HUGE_VAL, place = 0.0, off = 0.0;
  for (double d = 0.01; d < 100.0; d *= 1.1) {
    const double value = sb_slit_rate(d, 1e12);
    off = fmax(off, fabs(value / boltzmann(d) - 1.0));
    place = value < least ? d : place;
    least = fmin(least, value);
  }
  g_test_message("least %.4g at %.3g; %.2g off", least, place, off);
  g_assert_cmpfloat(off, <, 0.025);
  // Knudsen's minimum: 1.53 at 1.1 by the same equation.
  g_assert_cmpfloat(place, >, 0.7);
  g_assert_cmpfloat(place, <, 1.5);
  assert_close(least, 1.53, 0.025);
  // A slit of a hundred heights has it still, one of three has not; both grow at the end.
  g_assert_cmpfloat(sb_slit_rate(0.5, 100.0), <, sb_slit_rate(0.0, 100.0));
  g_assert_cmpfloat(sb_slit_rate(0.5, 3.0), >, sb_slit_rate(0.0, 3.0));
  g_assert_cmpfloat(sb_slit_rate(50.0, 100.0), >, sb_slit_rate(1.0, 100.0));
}

// 20 nm, 8 mN/m: 0.8 MPa. A liquid that wets is drawn, one that does not is held; a plug of the
// first holds a gas.
static void test_capillary(void) {
  assert_close(sb_slit_liquid_drive(0.5e6, 8e-3, 0.0, 20e-9), 1.3e6, 1e-12);
  g_assert_cmpfloat(sb_slit_liquid_drive(0.5e6, 8e-3, M_PI, 20e-9), ==, 0.0);
  assert_close(sb_slit_liquid_drive(0.5e6, 8e-3, 0.5 * M_PI, 20e-9), 0.5e6, 1e-9);
  g_assert_true(sb_slit_plugged(0.5e6, 8e-3, 0.0, 20e-9));
  g_assert_false(sb_slit_plugged(0.5e6, 8e-3, 0.0, 50e-9));
  g_assert_false(sb_slit_plugged(0.5e6, 8e-3, M_PI, 20e-9));
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/permeation-slit/transmission", test_transmission);
  g_test_add_func("/permeation-slit/limits", test_limits);
  g_test_add_func("/permeation-slit/between", test_between);
  g_test_add_func("/permeation-slit/capillary", test_capillary);
  return g_test_run();
}
