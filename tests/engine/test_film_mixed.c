// Film and asperities in one solve: the smooth and the dry limit, the Stribeck curve between them,
// near full contact and what an outside program recomputes from the profile.
#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/contact/rough/persson.h"
#include "engine/contact/rough/rough_law.h"
#include "engine/valve/states/sliding.h"
#include "tests/engine/near.h"
#include "tests/engine/rough_cells.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static SbFilmSolver *solver;
static SbFilm film, other;
static SbFilmProfile profile[2];

static SbStatus solve(SbFilm *out, const SbFilmProblem *problem) {
  return solve_cold(out, problem, &profile[out == &other], solver);
}

// ---------------------------------------------------------------- references

// Independent finite volumes with complementarity, Richardson over three grids; printed digits.
static void test_reference(void) {
  static const struct {
    SbRoughModel model;
    double sigma, speed, film_min, share; // least film [nm]
  } point[] = {
      {SB_ROUGH_GREENWOOD_TRIPP, 1e-6, 8, 331.99, 0.0597},
      {SB_ROUGH_GREENWOOD_TRIPP, 1e-6, 0.1, 54.119, 0.3237},
      {SB_ROUGH_GREENWOOD_TRIPP, 1e-6, 1e-4, 4.0700, 0.8729},
      {SB_ROUGH_PERSSON, 2e-7, 0.1, 33.68, 0.1178},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(point); i++) {
    SbFilmProblem problem = rough_seal(point[i].speed, point[i].model);
    problem.sigma = point[i].sigma;
    problem.modulus = 6.5725154e6;
    g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
    g_test_message("reference %zu: least film %.6g nm, asperity share %.6g", i, film.film_min * 1e9,
                   film.asperity_share);
    close_to("minimum film", film.film_min * 1e9, point[i].film_min, 2e-4);
    g_assert_cmpfloat(fabs(film.asperity_share - point[i].share), <, 1e-4);
  }
}

// ---------------------------------------------------------------- limits

// A surface that is smooth because its heights or its asperities vanish has the smooth film, by
// another solver with another discretisation.
static void test_smooth_limit(void) {
  static const struct {
    double sigma, product, speed, left, right, viscosity;
  } point[] = {
      {1e-13, 0.1289, 1e-2, 0, 0, 0.211e-3},
      {1e-13, 0.1289, 1e-4, 0, 0, 0.211e-3},
      {1e-6, 1e-8, 1e-2, 0, 0, 0.211e-3},
      {1e-6, 1e-8, 10, 0, 0, 0.211e-3},
      {1e-12, 0.1289, 1, 0, 0, 0.1},
      {1e-12, 0.1289, 10, 0, 0, 10},
      {1e-13, 0.1289, -1e-2, 3e5, 0, 0.211e-3},
      {1e-13, 0.1289, 1e-2, 3e5, 0, 0.211e-3},
      {1e-13, 0.1289, 1e-2, 2e5, 4e5, 0.211e-3},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(point); i++) {
    SbFilmProblem problem = rough_seal(point[i].speed, SB_ROUGH_GREENWOOD_TRIPP);
    problem.sigma = point[i].sigma;
    problem.gt_product = point[i].product;
    problem.pressure_left = point[i].left;
    problem.pressure_right = point[i].right;
    problem.viscosity = point[i].viscosity;
    g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
    problem.surface = SB_ROUGH_NONE;
    g_assert_cmpint(solve(&other, &problem), ==, SB_OK);
    g_test_message("smooth limit %zu: min %.3g central %.3g flux %.3g", i,
                   film.film_min / other.film_min - 1, film.film_central / other.film_central - 1,
                   film.film_flux / other.film_flux - 1);
    close_to("minimum film", film.film_min, other.film_min, 5e-4);
    close_to("central film", film.film_central, other.film_central, 5e-4);
    close_to("flux film", film.film_flux, other.film_flux, 5e-4);
    close_to("pressure", film.pressure_max, other.pressure_max, 5e-4);
    close_to("Couette", film.friction_couette, other.friction_couette, 5e-3);
    g_assert_cmpfloat(film.asperity_share, <, 1e-6);
    g_assert_cmpfloat(film.solver.load_error, <, 1e-10);
  }
}

// A film as thick as the roughness starts from the smooth one's layers: directly and in a few
// steps, whichever end has pressure. (Without them: 22 steps of continuation and 204 of Newton's
// method.)
static void test_direct_start(void) {
  static const double ends[][2] = {{0, 0}, {0.55e6, 0}, {0, 0.55e6}, {0.55e6, 0.55e6}};
  for (size_t i = 0; i < G_N_ELEMENTS(ends); i++) {
    SbFilmProblem problem = rough_seal(1, SB_ROUGH_GREENWOOD_TRIPP);
    problem.sigma = 1e-7;
    problem.pressure_left = ends[i][0];
    problem.pressure_right = ends[i][1];
    g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
    g_assert_cmpfloat(film.film_ratio, <, 2);
    g_assert_cmpint(film.solver.continuation_steps, <=, 4); // the start and three levels
    g_assert_cmpint(film.solver.newton_iterations, <=, 25);
  }
}

static void test_dry_contact(void) {
  static const struct {
    double sigma, product, ratio;
  } surface[] = {{1e-5, 0.1289, 0.1}, {4e-6, 0.3, 0.1}, {2e-5, 0.1289, 1}};
  for (size_t i = 0; i < G_N_ELEMENTS(surface); i++) {
    SbFilmProblem problem = rough_seal(0, SB_ROUGH_GREENWOOD_TRIPP);
    problem.sigma = surface[i].sigma;
    problem.gt_product = surface[i].product;
    problem.sigma_over_beta = surface[i].ratio;
    g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
    g_assert_cmpfloat(film.solver.load_error, <, 1e-10);
    check_dry_contact(&film, &problem, film.hertz_half_width);
    // At rest means no friction of a film, and boundary friction by its law.
    g_assert_cmpfloat(film.friction_couette, ==, 0);
    close_to("boundary friction", film.friction_boundary,
             problem.shear_strength * film.real_area + problem.load_coefficient * problem.load,
             1e-9);
  }
}

// A point of a Stribeck curve.
typedef struct {
  double speed, film_central, film_ratio, asperity_share, coefficient;
} Point;

static Point point_at(SbFilmProblem *problem, double speed) {
  problem->speed = speed;
  g_assert_cmpint(solve(&film, problem), ==, SB_OK);
  g_assert_cmpfloat(film.solver.load_error, <, 1e-10);
  double friction = film.friction_boundary + film.friction_couette + film.friction_cavity;
  return (Point){speed, film.film_central, film.film_ratio, film.asperity_share,
                 friction / problem->load};
}

// From rest to the full film nothing jumps, and every point carries its load.
static void test_stribeck(void) {
  enum { POINTS = 97 };
  static Point curve[POINTS];
  int models = g_test_slow() ? SB_ROUGH_PERSSON : SB_ROUGH_GREENWOOD_TRIPP;
  for (int model = SB_ROUGH_GREENWOOD_TRIPP; model <= models; model++) {
    SbFilmProblem problem = rough_seal(0, (SbRoughModel)model);
    problem.sigma = 1e-7;
    problem.viscosity = 0.01;
    double step[2];
    for (int pass = 0; pass < 2; pass++) {
      int points = g_test_slow() ? (pass == 0 ? 49 : 97) : (pass == 0 ? 25 : 49);
      step[pass] = 0;
      for (int i = 0; i < points; i++) {
        curve[i] = point_at(&problem, 1e-8 * pow(30 / 1e-8, i / (points - 1.0)));
      }
      g_assert_cmpfloat(curve[0].film_ratio, <, 0.01);
      g_assert_cmpfloat(curve[points - 1].film_ratio, >, 10);
      for (int i = 1; i < points; i++) {
        // The film grows, nowhere faster than the speed to the power 0.8 (a smooth one: 0.6).
        double times = log(curve[i].speed / curve[i - 1].speed);
        double film_step = log(curve[i].film_ratio / curve[i - 1].film_ratio);
        g_assert_cmpfloat(film_step, >=, 0);
        g_assert_cmpfloat(film_step, <, 0.8 * times);
        g_assert_cmpfloat(curve[i].asperity_share, <=, curve[i - 1].asperity_share + 1e-9);
        step[pass] = fmax(step[pass], fabs(log(curve[i].coefficient / curve[i - 1].coefficient)));
      }
    }
    // The steepest part, where the last asperities part, is steep but no jump: half the spacing
    // halves the largest step.
    g_test_message("model %d: largest steps %.3g, %.3g", model, step[0], step[1]);
    g_assert_cmpfloat(step[1], <, 0.62 * step[0]);
    g_assert_cmpfloat(step[1], <, 1.5);
    // The slow end is the dry contact, the fast end the smooth film.
    problem.speed = 0;
    g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
    g_assert_cmpfloat(curve[0].asperity_share, >, 0.4);
    problem.speed = 30;
    problem.surface = SB_ROUGH_NONE;
    g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
    close_to("film, fast and smooth", curve[g_test_slow() ? 96 : 48].film_central,
             film.film_central, 0.02);
  }
}

// At 99 % real contact, cold, either model, from rest to where the film begins to lift.
static void test_full_contact(void) {
  for (int model = SB_ROUGH_GREENWOOD_TRIPP; model <= SB_ROUGH_PERSSON; model++) {
    for (double speed = 0; speed < 2e-5; speed = speed == 0 ? 1e-7 : speed * 10) {
      SbFilmProblem problem = rough_seal(speed, (SbRoughModel)model);
      problem.load = 2000;
      problem.gt_product = model == SB_ROUGH_PERSSON ? 0.1289 : 0.2;
      problem.sigma_over_beta = model == SB_ROUGH_PERSSON ? 0.05 : 0.01;
      g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
      if (speed < 1e-7) {
        g_assert_cmpfloat(film.real_area_share, >, 0.99);
      }
      g_assert_cmpfloat(film.solver.load_error, <, 1e-10);
      g_assert_cmpfloat(film.film_min, >, 0);
    }
  }
}

// ---------------------------------------------------------------- outside recomputation

// Deflection of the profile's total pressure, piecewise linear, integrated exactly at x.
static double deflection(const SbFilm *f, const double *p, double x, double modulus) {
  double sum = 0;
  for (size_t i = 0; i + 1 < f->points; i++) {
    double a = f->x[i] - x, b = f->x[i + 1] - x;
    double slope = (p[i + 1] - p[i]) / (b - a);
    double base = p[i] - slope * a;
    double la = a != 0 ? log(fabs(a)) : 0, lb = b != 0 ? log(fabs(b)) : 0;
    sum += base * (b * (lb - 1) - a * (la - 1)) +
           slope * (b * b * (0.5 * lb - 0.25) - a * a * (0.5 * la - 0.25));
  }
  return -4 / (G_PI * modulus) * sum;
}

static void test_profile(void) {
  static const double speeds[] = {1e-4, -1e-2, 1};
  for (size_t k = 0; k < G_N_ELEMENTS(speeds); k++) {
    for (int model = SB_ROUGH_GREENWOOD_TRIPP; model <= SB_ROUGH_PERSSON; model++) {
      SbFilmProblem problem = rough_seal(speeds[k], (SbRoughModel)model);
      problem.sigma = 3e-7;
      g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
      g_assert_cmpuint(film.points, >=, 400);
      // Load and the asperities' part of it, by trapezoids.
      double load = 0, asperities = 0;
      for (size_t i = 0; i + 1 < film.points; i++) {
        double dx = film.x[i + 1] - film.x[i];
        g_assert_cmpfloat(dx, >, 0);
        load += 0.5 * dx * (film.pressure[i] + film.pressure[i + 1]);
        asperities += 0.5 * dx * (film.asperity_pressure[i] + film.asperity_pressure[i + 1]);
      }
      close_to("load", load, problem.load, 1e-4);
      close_to("asperities' load", asperities, film.asperity_load, 1e-3);
      // Film equation: gap less parabola less deflection is constant over the contact.
      double shift = 0;
      double worst = 0;
      double b = film.hertz_half_width;
      for (size_t i = 0; i < film.points; i += 7) {
        double x = film.x[i];
        if (fabs(x) > 1.5 * b) {
          continue;
        }
        double rest = film.film[i] - x * x / (2 * problem.radius) -
                      deflection(&film, film.pressure, x, problem.modulus);
        shift = shift == 0 ? rest : shift;
        worst = fmax(worst, fabs(rest - shift));
      }
      g_assert_cmpfloat(worst, <, 1e-5 * b * b / problem.radius);
      // Reynolds' flux from the film pressure = total - asperities, where the film is full.
      double off = 0;
      for (size_t i = 2; i + 2 < film.points; i++) {
        double p[3], x[3];
        for (int j = 0; j < 3; j++) {
          p[j] = film.pressure[i + (size_t)j - 1] - film.asperity_pressure[i + (size_t)j - 1];
          x[j] = film.x[i + (size_t)j - 1];
        }
        double a = x[1] - x[0], c = x[2] - x[1];
        double h = film.film[i];
        bool beyond =
            problem.speed > 0 ? x[2] > film.position_rupture : x[0] < film.position_rupture;
        if (beyond || p[1] < 0.05 * film.pressure_max || h > 3 * film.film_flux ||
            fabs(a / c - 1) > 1e-6) {
          continue;
        }
        double slope = (p[2] - p[0]) / (a + c);
        double flux = h - h * h * h * slope / (6 * problem.viscosity * problem.speed);
        off = fmax(off, fabs(flux / film.film_flux - 1));
      }
      g_test_message("speed %g model %d: flux off by %.2g, film equation by %.2g", speeds[k], model,
                     off, worst / (b * b / problem.radius));
      g_assert_cmpfloat(off, <, 2e-3);
      // The asperities' pressure is the law's at the film shown.
      SbRoughSurface surface = {(SbRoughModel)model,
                                problem.gt_product,
                                problem.sigma,
                                problem.sigma_over_beta,
                                problem.modulus,
                                0,
                                0};
      SbRoughLaw law;
      g_assert_cmpint(sb_rough_law_init(&law, &surface, NULL), ==, SB_OK);
      for (size_t i = 0; i < film.points; i += 50) {
        SbRoughPoint at;
        sb_rough_law_at(&at, &law, sb_rough_law_of_gap(&law, film.film[i]));
        if (at.pressure > 1e-6 * film.pressure_max) {
          close_to("law", film.asperity_pressure[i], at.pressure, 1e-6);
        }
      }
    }
  }
}

// The error estimate against a solution at a much finer tolerance.
static void test_estimate(void) {
  double ratio[64];
  int count = 0;
  for (double speed = 1e-7; speed < 20; speed *= g_test_slow() ? 6 : 36) {
    for (int model = SB_ROUGH_GREENWOOD_TRIPP; model <= SB_ROUGH_PERSSON; model++) {
      SbFilmProblem problem = rough_seal(speed, (SbRoughModel)model);
      g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
      g_assert_cmpint(film.solver.newton_iterations, <=, 10 * film.solver.continuation_steps);
      problem.tolerance = 1e-8;
      SbStatus status = solve(&other, &problem);
      g_assert_true(status == SB_OK || status == SB_ERROR_NOT_CONVERGED);
      double off[2] = {fabs(film.film_min / other.film_min - 1),
                       fabs(film.film_central / other.film_central - 1)};
      double estimate[2] = {film.solver.error_film_min, film.solver.error_film_central};
      for (int k = 0; k < 2; k++) {
        g_test_message("speed %.2g model %d %s: estimate %.2g, true %.2g", speed, model,
                       k == 0 ? "least" : "central", estimate[k], off[k]);
        g_assert_cmpfloat(off[k], <=, 3 * estimate[k]);
        // Not the same mesh, and known better than that.
        if (off[k] > 2 * (k == 0 ? other.solver.error_film_min : other.solver.error_film_central)) {
          ratio[count++] = estimate[k] / off[k];
        }
      }
    }
  }
  g_assert_cmpint(count, >, 0);
  for (int i = 0; i < count; i++) { // the median
    int below = 0;
    for (int j = 0; j < count; j++) {
      below += ratio[j] < ratio[i] || (ratio[j] == ratio[i] && j < i);
    }
    if (below == count / 2) {
      g_test_message("median of estimate over true: %.3g", ratio[i]);
      g_assert_cmpfloat(ratio[i], <=, 10);
    }
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_assert_cmpint(sb_film_solver_create(&solver, NULL), ==, SB_OK);
  g_test_add_func("/film/mixed/direct-start", test_direct_start);
  g_test_add_func("/film/mixed/reference", test_reference);
  g_test_add_func("/film/mixed/smooth-limit", test_smooth_limit);
  g_test_add_func("/film/mixed/dry-contact", test_dry_contact);
  g_test_add_func("/film/mixed/stribeck", test_stribeck);
  g_test_add_func("/film/mixed/full-contact", test_full_contact);
  g_test_add_func("/film/mixed/profile", test_profile);
  g_test_add_func("/film/mixed/estimate", test_estimate);
  int failed = g_test_run();
  sb_film_solver_destroy(solver);
  return failed;
}
