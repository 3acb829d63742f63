// Persson's contact and the static leak: limits, moments, monotony, convergence.
#include "engine/contact/rough/percolation.h"
#include "engine/contact/rough/persson.h"
#include "engine/contact/rough/rough_law.h"

#include <glib.h>
#include <math.h>

static const double modulus = 6.5725e6;

static SbSpectrum thesis_surface(void) {
  SbSpectrum s;
  SbReport report = {0};
  g_assert_cmpint(sb_spectrum_from_asperities(&s, 1e-6, 0.1, 0.1289, &report), ==, SB_OK);
  return s;
}

// The spectrum has the moments that give back sigma, beta and zeta (McCool).
static void test_moments(void) {
  SbSpectrum s = thesis_surface();
  double m0 = 0;
  double m2 = 0;
  double m4 = 0;
  int n = 200000;
  double h = log(s.q1 / s.q0) / n;
  for (int i = 0; i < n; i++) {
    double q = s.q0 * exp((i + 0.5) * h);
    double c = 2 * M_PI * q * q * s.amplitude * pow(q, -2 * (s.hurst + 1)) * h;
    m0 += c;
    m2 += c * q * q / 2;
    m4 += c * pow(q, 4) * 3 / 8;
  }
  double beta = 3.0 / 8 * sqrt(M_PI / m4);
  double zeta = m4 / (6 * M_PI * sqrt(3) * m2);
  g_assert_cmpfloat_with_epsilon(sqrt(m0) / 1e-6, 1, 1e-6);
  g_assert_cmpfloat_with_epsilon(1e-6 / beta, 0.1, 1e-6);
  g_assert_cmpfloat_with_epsilon(zeta * beta * 1e-6, 0.1289, 1e-6);
  g_assert_cmpfloat_with_epsilon(s.slope, sqrt(2 * m2), 1e-6);
}

// Light load: A/A0 = sqrt(8/pi) p/(E* h'); heavy load: full contact.
static void test_area(void) {
  SbSpectrum s = thesis_surface();
  double E = modulus / 2;
  double p = 1e-4 * E * s.slope;
  double share = sb_persson_area_share(&s, s.q1, modulus, p);
  g_assert_cmpfloat(fabs(share / (sqrt(8 / M_PI) * 1e-4) - 1), <, 1e-6);
  g_assert_cmpfloat(sb_persson_area_share(&s, s.q1, modulus, 5 * E * s.slope), ==, 1);
  double before = 0;
  for (double q = 0; q < 6; q += 0.01) {
    double now = sb_persson_area_share(&s, s.q1, modulus, q * E * s.slope);
    g_assert_cmpfloat(now, >=, before);
    before = now;
  }
}

// p ~ exp(-u/u0) at light load with u0 near 0.5 sigma (Yang & Persson 2008, figure 4), u -> 0 at
// full contact.
static void test_separation(void) {
  SbSpectrum s = thesis_surface();
  double u1 = sb_persson_separation(&s, s.q0, modulus, 1e2);
  double u2 = sb_persson_separation(&s, s.q0, modulus, 1e3);
  double u3 = sb_persson_separation(&s, s.q0, modulus, 1e4);
  double u0 = (u1 - u2) / log(10);
  g_test_message("u0/sigma = %.3f, then %.3f", u0 / s.sigma, (u2 - u3) / log(10) / s.sigma);
  g_assert_cmpfloat_with_epsilon(u0 / s.sigma, 0.45, 0.1);
  g_assert_cmpfloat(fabs((u2 - u3) / (u1 - u2) - 1), <, 0.15);
  g_assert_cmpfloat(sb_persson_separation(&s, s.q0, modulus, 1e8), <, 1e-12);
}

// Work of closing the gap, integral of p |du| from apart to closed, over the elastic energy at full
// contact, (pi/2) E* integral of q^2 C dq: 1, as both area and separation follow from one
// probability of contact. By the direct integral (its inner Simpson rule: 1e-4) and by the film
// solver's table.
static void test_energy(void) {
  static const double figures[][3] = {{1e-6, 0.1, 0.1289}, {2e-7, 0.02, 0.06}, {4e-6, 0.3, 0.5}};
  for (size_t k = 0; k < G_N_ELEMENTS(figures); k++) {
    const double *f = figures[k];
    SbSpectrum s;
    g_assert_cmpint(sb_spectrum_from_asperities(&s, f[0], f[1], f[2], NULL), ==, SB_OK);
    double power = 1 - 2 * s.hurst;
    double full =
        M_PI / 2 * modulus / 2 * s.amplitude * (pow(s.q1, power) - pow(s.q0, power)) / power;
    SbRoughSurface surface = {SB_ROUGH_PERSSON, f[2], f[0], f[1], modulus, 0, 0};
    SbRoughLaw law;
    g_assert_cmpint(sb_rough_law_init(&law, &surface, NULL), ==, SB_OK);
    // Trapezoids over ln p, from 1e-7 of the pressure that closes the shortest waves.
    enum { STEPS = 600 };
    double work[2] = {0, 0}, before[2] = {0, 0}, p_before = 0;
    for (int i = 0; i <= STEPS; i++) {
      double p = 1e-7 * modulus * s.slope * exp(18.0 * i / STEPS);
      SbRoughPoint at;
      sb_rough_law_at(&at, &law, sb_rough_law_of_pressure(&law, p));
      double u[2] = {sb_persson_separation(&s, s.q0, modulus, p), at.gap};
      for (int m = 0; m < 2; m++) {
        work[m] += i > 0 ? 0.5 * (p + p_before) * (before[m] - u[m]) : 0;
        before[m] = u[m];
      }
      p_before = p;
    }
    g_test_message("work over energy: %.6f directly, %.6f by the table", work[0] / full,
                   work[1] / full);
    g_assert_cmpfloat_with_epsilon(work[0] / full, 1, 2e-4);
    g_assert_cmpfloat_with_epsilon(work[1] / full, 1, 2e-4);
  }
}

// No pressure at all: far apart, but a number.
static void test_no_pressure(void) {
  SbSpectrum s = thesis_surface();
  g_assert_true(isfinite(sb_persson_separation(&s, s.q0, modulus, 0)));
  g_assert_cmpfloat(sb_persson_area_share(&s, s.q1, modulus, 0), ==, 0);
}

// The leak falls with the contact pressure and reaches zero at the closing pressure, ever more
// steeply.
// The critical constriction by other means: Persson's u_1 = d(u A)/dA, taken here between contacts
// seen at wave numbers further apart; and the flow through one square of that gap.
static void check_constriction(const SbPercolation *out, const SbPercolationProblem *p) {
  double product[2], area[2];
  for (int i = 0; i < 2; i++) {
    double q = out->constriction_q * exp(i == 0 ? -0.005 : 0.005);
    area[i] = sb_persson_area_share(p->spectrum, q, p->modulus, p->contact_pressure);
    product[i] = area[i] * sb_persson_separation(p->spectrum, q, p->modulus, p->contact_pressure);
  }
  double gap = (product[1] - product[0]) / (area[1] - area[0]);
  g_assert_cmpfloat(fabs(out->constriction_gap / gap - 1), <, 1e-3);
  double flow = gap * gap * gap / 12 / p->viscosity * p->pressure_drop / p->width;
  g_assert_cmpfloat(fabs(out->leak_rate / (flow * p->circumference) - 1), <, 3e-3);
}

static void test_leak(void) {
  SbSpectrum s = thesis_surface();
  SbPercolationProblem p = {.spectrum = &s,
                            .modulus = modulus,
                            .viscosity = 0.211e-3,
                            .pressure_drop = 0.55e6,
                            .width = 0.9567e-3,
                            .circumference = M_PI * 6e-3};
  double before = INFINITY;
  SbPercolation out;
  SbReport report = {0};
  p.contact_pressure = 1;
  g_assert_cmpint(sb_percolation_solve(&out, &p, &report), ==, SB_OK);
  double closing = out.closing_pressure;
  for (double share = 0.02; share < 1; share += 0.02) {
    p.contact_pressure = share * closing;
    g_assert_cmpint(sb_percolation_solve(&out, &p, &report), ==, SB_OK);
    g_assert_true(out.percolates);
    // Not at the ends: the spectrum begins with a kink, and the last gap is a small difference.
    if (share > 0.1 && share < 0.9) {
      check_constriction(&out, &p);
    }
    g_assert_cmpfloat(out.leak_rate, <, before);
    g_assert_cmpfloat(out.sensitivity, <, 0);
    before = out.leak_rate;
  }
  p.contact_pressure = 1.001 * closing;
  g_assert_cmpint(sb_percolation_solve(&out, &p, &report), ==, SB_OK);
  g_assert_false(out.percolates);
  g_assert_cmpfloat(out.leak_rate, ==, 0);
  g_assert_cmpfloat(out.real_share, >, SB_PERCOLATION_THRESHOLD);
  p.viscosity = 0;
  g_assert_cmpint(sb_percolation_solve(&out, &p, &report), ==, SB_ERROR_RANGE);
}

static void test_refused(void) {
  SbSpectrum s;
  SbReport report = {0};
  g_assert_cmpint(sb_spectrum_from_asperities(&s, 1e-6, 0.1, 0.01, &report), ==,
                  SB_ERROR_INFEASIBLE);
  g_assert_cmpint(sb_spectrum_from_asperities(&s, 0, 0.1, 0.1, &report), ==, SB_ERROR_RANGE);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/persson/moments", test_moments);
  g_test_add_func("/persson/area", test_area);
  g_test_add_func("/persson/separation", test_separation);
  g_test_add_func("/persson/energy", test_energy);
  g_test_add_func("/persson/no-pressure", test_no_pressure);
  g_test_add_func("/persson/leak", test_leak);
  g_test_add_func("/persson/refused", test_refused);
  return g_test_run();
}
