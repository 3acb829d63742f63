// Rigid wedge, tapered film, regimes and attraction against quadrature and printed values.
#include "engine/contact/rough/rough_law.h"
#include "engine/film/film.h"
#include "engine/film/laws.h"
#include "engine/film/wedge.h"

#include <glib.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <math.h>

// The rigid film by the common call; at no end pressures its least film is 1e-7 m.
static SbFilmProblem rigid(void) {
  SbFilmProblem p;
  sb_film_problem_init(&p);
  p.model = SB_FILM_RIGID;
  p.speed = 0.2;
  p.radius = 0.805e-3;
  p.viscosity = 2e-3;
  p.modulus = 1e12;
  p.load = 4.894968 * p.viscosity * 0.5 * p.speed * p.radius / 1e-7;
  return p;
}

static double gap(double x, const SbFilmProblem *p, const SbFilm *film) {
  return film->film_min + x * x / (2 * p->radius);
}

// Reynolds' equation itself, dp/dx = 6 eta U (h - hm)/h^3.
typedef struct {
  const SbFilmProblem *problem;
  const SbFilm *film;
  int what; // 0: gradient, 1: x times gradient, 2: Couette, 3: Poiseuille
} Reynolds;

static double integrand(double x, void *data) {
  const Reynolds *r = data;
  double h = gap(x, r->problem, r->film);
  double gradient =
      6 * r->problem->viscosity * r->problem->speed * (h - r->film->film_flux) / (h * h * h);
  switch (r->what) {
  case 1:
    return x * gradient;
  case 2:
    return r->problem->viscosity * r->problem->speed / h;
  case 3:
    return h / 2 * gradient;
  default:
    return gradient;
  }
}

static double integrate(const SbFilmProblem *p, const SbFilm *film, int what, double from,
                        double to) {
  gsl_integration_workspace *work = gsl_integration_workspace_alloc(1000);
  Reynolds r = {p, film, what};
  gsl_function f = {integrand, &r};
  double unit = sqrt(2 * p->radius * film->film_min);
  double middle = fmax(fmin(to, 3 * unit), -10 * unit);
  double tail = 0;
  double body = 0;
  double error = 0;
  if (isinf(from)) {
    from = -10 * unit;
    middle = to;
    gsl_integration_qagil(&f, from, 0, 1e-12, 1000, work, &tail, &error);
  }
  gsl_integration_qag(&f, from, middle, 0, 1e-13, 1000, GSL_INTEG_GAUSS61, work, &body, &error);
  gsl_integration_workspace_free(work);
  return tail + body;
}

// The four end-pressure cases of thesis section 6.1: the solution satisfies Reynolds' equation, its
// boundary values and its load, all by quadrature.
static void test_pressures(void) {
  static SbFilmProfile profile;
  const double ends[4][2] = {{0, 0}, {0.55e6, 0}, {0, 0.55e6}, {0.55e6, 0.55e6}};
  for (int i = 0; i < 4; i++) {
    SbFilmProblem p = rigid();
    p.pressure_left = ends[i][0];
    p.pressure_right = ends[i][1];
    p.load *= 2;
    p.profile = &profile;
    SbFilm out;
    g_assert_cmpint(sb_film_solve(&out, &p, NULL, NULL), ==, SB_OK);
    double xe = out.position_rupture;
    double unit = sqrt(2 * p.radius * out.film_min);
    double scale = out.pressure_max;
    for (size_t k = 0; k < out.points; k += 13) {
      double x = out.x[k];
      g_assert_cmpfloat(fabs(gap(x, &p, &out) / out.film[k] - 1), <, 1e-12);
      if (x > -3 * unit && x < xe) {
        double exact = p.pressure_left + integrate(&p, &out, 0, -INFINITY, x);
        g_assert_cmpfloat(fabs(out.pressure[k] - exact) / scale, <, 1e-9);
      }
    }
    double end = p.pressure_left + integrate(&p, &out, 0, -INFINITY, xe);
    g_assert_cmpfloat(fabs(end - p.pressure_right) / scale, <, 1e-9);
    g_assert_cmpfloat(fabs(gap(xe, &p, &out) / out.film_flux - 1), <, 1e-12);

    // Net load: by parts the integral of (p - ambient) is minus that of x dp/dx.
    double load = -integrate(&p, &out, 1, -INFINITY, xe);
    g_assert_cmpfloat(fabs(load / p.load - 1), <, 1e-9);
    g_assert_cmpfloat(fabs(integrate(&p, &out, 2, -INFINITY, xe) / out.friction_couette - 1), <,
                      1e-9);
    g_assert_cmpfloat(fabs(integrate(&p, &out, 3, -INFINITY, xe) - out.friction_poiseuille), <,
                      1e-9 * out.friction_couette);
  }
}

// Printed: rupture 25.41 degrees, load 4.894968 eta u_m R/h0, film ratio 1.225748, 0.475130 sqrt(2
// R h0).
static void test_classical(void) {
  const SbFilmProblem p = rigid();
  SbFilm out;
  g_assert_cmpint(sb_film_solve(&out, &p, NULL, NULL), ==, SB_OK);
  g_assert_cmpfloat_with_epsilon(out.film_min / 1e-7, 1, 2e-7);
  g_assert_cmpfloat_with_epsilon(out.film_flux / out.film_min, 1.225748, 1e-6);
  double place = out.position_rupture / sqrt(2 * p.radius * out.film_min);
  g_assert_cmpfloat_with_epsilon(place, 0.475130, 1e-6);
  g_assert_cmpfloat_with_epsilon(atan(place) * 180 / M_PI, 25.41, 0.005);
}

// Every load down to where the parabola ends, under a pressure at the inlet; none where the
// outlet's drives the film back.
static void test_load(void) {
  SbFilm out;
  SbFilmProblem p = rigid();
  p.pressure_left = 0.2e6;
  for (p.load = 1; p.load < 1e6; p.load *= 7) {
    g_assert_cmpint(sb_film_solve(&out, &p, NULL, NULL), ==, SB_OK);
    double te = atan(out.position_rupture / sqrt(2 * p.radius * out.film_min));
    double load = 3 * p.viscosity * p.speed * p.radius * pow(cos(te), 2) / out.film_min;
    g_assert_cmpfloat(fabs(load / p.load - 1), <, 1e-9);
    double end = p.pressure_left + integrate(&p, &out, 0, -INFINITY, out.position_rupture);
    g_assert_cmpfloat(fabs(end) / out.pressure_max, <, 1e-8);
  }
  p = rigid();
  p.pressure_right = 1e7;
  g_assert_cmpint(sb_film_solve(&out, &p, NULL, NULL), ==, SB_ERROR_INFEASIBLE);
}

// Drag of a plane taper by quadrature: Couette plus Poiseuille of Reynolds' equation on h = 1 + e
// (1 - x).
static void test_taper(void) {
  const double ratios[] = {1, 1 + 5e-4, 1 + 2e-3, 1.1, 1.5, 2, 5, 20};
  for (size_t i = 0; i < G_N_ELEMENTS(ratios); i++) {
    double e = ratios[i] - 1;
    double hm = 2 * ratios[i] / (1 + ratios[i]);
    double drag = 0;
    int n = 200000;
    for (int k = 0; k < n; k++) {
      double h = 1 + e * (1 - (k + 0.5) / n);
      drag += (1 / h + 3 * (h - hm) / (h * h)) / n;
    }
    double factor = sb_taper_factor(ratios[i]);
    g_assert_cmpfloat(fabs(factor - drag), <, 1e-8);
  }
}

// Audit section 1: g_E 6.6e3, g_V 49 at 0.03 m/s; the misprinted alpha changes the regime.
static void test_chart(void) {
  double modulus = 6.5725e6;
  double R = 0.805e-3;
  double load = 0.16071 * modulus * R;
  SbChartPoint point = sb_regime_chart(load, 0.015, R, modulus, 2.09e-4, 2.8e-9);
  g_assert_cmpfloat_with_epsilon(point.g_E, 6.6e3, 50);
  g_assert_cmpfloat_with_epsilon(point.g_V, 49, 1);
  g_assert_cmpstr(point.regime, ==, "isoviscous-elastic");
  point = sb_regime_chart(load, 0.015, R, modulus, 2.09e-4, 2.8e-7);
  g_assert_cmpfloat_with_epsilon(point.g_V, 4.9e3, 50);
  g_assert_cmpstr(sb_regime_chart(1e-3, 1, R, 1e11, 1e-2, 0).regime, ==, "isoviscous-rigid");
  g_assert_cmpstr(sb_regime_of_lambda(0.001), ==, "boundary");
  g_assert_cmpstr(sb_regime_of_lambda(2), ==, "mixed");
  g_assert_cmpstr(sb_regime_of_lambda(3), ==, "full film");
}

// Thesis: 0.40 MPa at 2.61 nm, 7.2 MPa at 1 nm, 364 MPa at 0.27 nm; held below the cut-off.
static void test_attraction(void) {
  double A = 1.35e-19;
  g_assert_cmpfloat_with_epsilon(sb_vdw_attraction(A, 2.61e-9), 0.40e6, 0.005e6);
  g_assert_cmpfloat_with_epsilon(sb_vdw_attraction(A, 1e-9), 7.2e6, 0.05e6);
  g_assert_cmpfloat_with_epsilon(sb_vdw_attraction(A, 0.27e-9), 364e6, 1e6);
  g_assert_cmpfloat(sb_vdw_attraction(A, 0), ==, sb_vdw_attraction(A, SB_VDW_CUTOFF));
}

// Ends of the wedge by name: loads by quadrature and for a far inlet those of Martin, the pressure
// at both ends, and of a wedge so short that its gap hardly differs, whose end lies half way.
static void test_ends(void) {
  const double reaches[] = {0.01, 0.5, 3, 1e6};
  for (size_t i = 0; i < G_N_ELEMENTS(reaches); i++) {
    double last = atan(reaches[i]);
    for (int ends = SB_WEDGE_FULL_SOMMERFELD; ends <= SB_WEDGE_REYNOLDS; ends++) {
      enum { STEPS = 200000 };
      double load = 0, most = 0, step = 2 * last / STEPS;
      for (int k = 0; k < STEPS; k++) {
        double t = -last + (k + 0.5) * step;
        double p = sb_wedge_pressure((SbWedgeEnds)ends, t, reaches[i]);
        load += 24 * p / (cos(t) * cos(t)) * step;
        most = fmax(most, p / (cos(t) * cos(t)));
      }
      g_assert_cmpfloat(fabs(sb_wedge_load((SbWedgeEnds)ends, reaches[i]) - load), <,
                        1e-3 * 24 * most * last);
      g_assert_cmpfloat(fabs(sb_wedge_pressure((SbWedgeEnds)ends, -last + 1e-9, reaches[i])), <,
                        1e-8);
    }
  }
  g_assert_cmpfloat(sb_wedge_load(SB_WEDGE_FULL_SOMMERFELD, 1e6), ==, 0);
  g_assert_cmpfloat_with_epsilon(sb_wedge_load(SB_WEDGE_HALF_SOMMERFELD, 1e6), 4, 1e-9);
  g_assert_cmpfloat_with_epsilon(sb_wedge_load(SB_WEDGE_REYNOLDS, 1e6), 4.894968, 1e-6);
  g_assert_cmpfloat_with_epsilon(sb_wedge_end(0.01) / atan(0.01), 0.5, 1e-3);
}

// The chart's borders are where its regimes change.
static void test_borders(void) {
  for (double g_E = 1e-2; g_E < 1e6; g_E *= 10) {
    for (double g_V = 1e-2; g_V < 1e6; g_V *= 10) {
      // W, U and alpha of these, with radius, modulus and viscosity 1.
      double U = 1e-6, W = g_E * sqrt(U), alpha = g_V * sqrt(U) / pow(W, 1.5);
      SbChartPoint point = sb_regime_chart(W, U, 1, 1, 1, alpha);
      g_assert_cmpint(g_str_has_prefix(point.regime, "piezo"), ==,
                      g_V > sb_regime_viscous_border(g_E));
      g_assert_cmpint(g_str_has_suffix(point.regime, "elastic"), ==,
                      g_E > sb_regime_elastic_border(g_V));
    }
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  // An integral near zero cannot meet a relative tolerance; the assertions judge the values.
  gsl_set_error_handler_off();
  g_test_add_func("/closed-films/pressures", test_pressures);
  g_test_add_func("/closed-films/classical", test_classical);
  g_test_add_func("/closed-films/load", test_load);
  g_test_add_func("/closed-films/taper", test_taper);
  g_test_add_func("/closed-films/chart", test_chart);
  g_test_add_func("/closed-films/attraction", test_attraction);
  g_test_add_func("/closed-films/ends", test_ends);
  g_test_add_func("/closed-films/borders", test_borders);
  return g_test_run();
}
