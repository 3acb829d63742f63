// The coupled film solver against independent figures (docs/verification.md), exact limits,
// symmetry, conservation, its own error estimate, and a recomputation from nothing but the profile.
#include "engine/film/film.h"

#include <glib.h>
#include <math.h>

static SbFilmSolver *solver;
static SbFilm film, other;

// A contact of given M, W = 1e-3, with end pressures in units of p_H.
static SbFilmProblem contact(double M, double left, double right) {
  SbFilmProblem problem;
  sb_film_problem_init(&problem);
  double W = 1e-3;
  problem.modulus = 1e7;
  problem.radius = 1e-3;
  problem.load = W * problem.modulus * problem.radius;
  double U = 0.5 * (W / M) * (W / M);
  // eta u / 2 = U E' R with u near 1 m/s keeps every input inside its range.
  problem.speed = 1.0;
  problem.viscosity = 2.0 * U * problem.modulus * problem.radius / problem.speed;
  if (problem.viscosity < 1e-6) {
    problem.speed = problem.viscosity / 1e-6;
    problem.viscosity = 1e-6;
  }
  double hertz = 0.25 * problem.modulus * sqrt(8.0 * W / G_PI);
  problem.pressure_left = left * hertz;
  problem.pressure_right = right * hertz;
  return problem;
}

static SbFilmProblem inhaler(double speed) {
  SbFilmProblem problem;
  sb_film_problem_init(&problem);
  problem.load = 850.2;
  problem.speed = speed;
  problem.radius = 0.805e-3;
  problem.modulus = 6.5725e6;
  problem.viscosity = 0.211e-3;
  return problem;
}

static void solve(SbFilm *out, const SbFilmProblem *problem) {
  SbReport report;
  sb_film_solver_forget(solver);
  SbStatus status = sb_film_solve(out, problem, solver, &report);
  if (status != SB_OK) {
    g_test_message("M %g: %s", out->moes_M, report.text);
  }
  g_assert_cmpint(status, ==, SB_OK);
  g_assert_true(out->solver.converged);
}

static void close_to(const char *what, double got, double want, double relative) {
  if (!(fabs(got - want) <= relative * fabs(want))) {
    g_test_message("%s: got %.9g, want %.9g within %g", what, got, want, relative);
    g_test_fail();
  }
}

// H* = h / (R sqrt(2 U)).
static double moes(double h) {
  return h / (1e-3 * sqrt(2.0 * film.moes_U));
}

static const double reference[][6] = {
    {1, 3.06313643, 3.27656797, 3.79061479, 0.565241637, 1.15461239},
    {5, 1.59060139, 2.03650729, 2.01593519, 0.931421432, 1.04173932},
    {20, 1.12468687, 1.42051119, 1.41937373, 0.989922143, 1.01990872},
    {100, 0.796100592, 1.00142813, 1.00138870, 0.999066135, 1.00644197},
    {1000, 0.498582133, 0.626358505, 0.626358192, 0.999972665, 1.00108669},
    {10000, 0.314215466, 0.394658764, 0.394658762, 0.999999267, 1.00017428},
};

static void test_reference(void) {
  static const double tolerances[] = {1e-3, 1e-4, 1e-6};
  for (size_t t = 0; t < G_N_ELEMENTS(tolerances); t++) {
    for (size_t i = 0; i < G_N_ELEMENTS(reference); i++) {
      const double *want = reference[i];
      SbFilmProblem problem = contact(want[0], 0.0, 0.0);
      problem.tolerance = tolerances[t];
      solve(&film, &problem);
      close_to("minimum", moes(film.film_min), want[1], tolerances[t]);
      close_to("central", moes(film.film_central), want[2], tolerances[t]);
      close_to("flux", moes(film.film_flux), want[3], tolerances[t]);
      close_to("peak", film.pressure_max / film.hertz_pressure, want[4], tolerances[t]);
      close_to("rupture", film.position_rupture / film.hertz_half_width, want[5], tolerances[t]);
      g_assert_cmpfloat(film.solver.error_film_min, <=, tolerances[t]);
      g_assert_cmpint(film.solver.newton_iterations, <=, 10 * film.solver.continuation_steps);
    }
  }
}

// Convergence in the unknowns is spectral: from 1e-2 to 1e-6 the error of the minimum falls faster
// than the tenth power of their number, while the Newton steps per level stay few.
static void test_order(void) {
  for (size_t i = 3; i < G_N_ELEMENTS(reference); i++) {
    double unknowns[2], errors[2], steps[2];
    static const double tolerances[] = {1e-2, 1e-6};
    for (int k = 0; k < 2; k++) {
      SbFilmProblem problem = contact(reference[i][0], 0.0, 0.0);
      problem.tolerance = tolerances[k];
      solve(&film, &problem);
      unknowns[k] = (double)film.solver.unknowns;
      errors[k] = fabs(moes(film.film_min) / reference[i][1] - 1.0);
      steps[k] = (double)film.solver.newton_iterations / film.solver.continuation_steps;
    }
    double order = log(errors[0] / errors[1]) / log(unknowns[1] / unknowns[0]);
    g_test_message("M %g: %g to %g unknowns, error %.2g to %.2g, order %.1f, steps %.1f, %.1f",
                   reference[i][0], unknowns[0], unknowns[1], errors[0], errors[1], order, steps[0],
                   steps[1]);
    g_assert_cmpfloat(order, >, 10.0);
    g_assert_cmpfloat(steps[1], <=, steps[0] + 1.0);
  }
}

// Limits of docs/verification.md: the rigid wedge as M -> 0, the exact power laws as M -> infinity.
static void test_limits(void) {
  SbFilmProblem problem = contact(1e-3, 0.0, 0.0);
  solve(&film, &problem);
  close_to("rigid minimum", film.film_min / problem.radius, 4.894968 * film.moes_U / film.moes_W,
           2e-4);
  close_to("rigid flux", film.film_flux / film.film_min, 1.225748, 2e-4);
  close_to("rigid rupture", film.position_rupture,
           0.475130 * sqrt(2.0 * problem.radius * film.film_min), 2e-4);
  problem = contact(1e6, 0.0, 0.0);
  solve(&film, &problem);
  double unit = problem.radius * pow(film.moes_U, 0.6) * pow(film.moes_W, -0.2);
  close_to("elastic minimum", film.film_min, 3.00434 * unit, 1e-4);
  close_to("elastic flux", film.film_flux, 3.77334 * unit, 1e-4);
  close_to("elastic friction",
           film.friction_couette / problem.load * problem.radius / film.hertz_half_width,
           0.475975 * pow(film.lambda, 0.4), 2e-3);
}

// Any speed, any direction: the estimate meets the tolerance and the film follows the power law.
static void test_speeds(void) {
  for (double speed = 8.0; speed > 0.9e-6; speed /= 2.0) {
    SbFilmProblem problem = inhaler(speed);
    solve(&film, &problem);
    g_assert_cmpfloat(film.solver.error_film_min, <=, 1e-3);
    g_assert_cmpfloat(film.solver.error_film_central, <=, 1e-3);
    double unit = problem.radius * pow(film.moes_U, 0.6) * pow(film.moes_W, -0.2);
    close_to("flux", film.film_flux, 3.77334 * unit, 0.01);
    problem.speed = -speed;
    solve(&other, &problem);
    close_to("minimum", other.film_min, film.film_min, 1e-12);
    close_to("place", other.position_film_min, -film.position_film_min, 1e-12);
    close_to("friction", other.friction_couette, -film.friction_couette, 1e-12);
    close_to("friction", other.friction_poiseuille, -film.friction_poiseuille, 1e-12);
  }
  SbFilmProblem problem = inhaler(1e-3 / 3.0);
  solve(&film, &problem);
  close_to("central at the test speed", film.film_central, 0.861e-9, 1e-3);
  close_to("minimum at the test speed", film.film_min, 0.685e-9, 1e-3);
  g_assert_true(film.warnings.count > 0);
  g_assert_cmpstr(film.warnings.item[0].code, ==, "film-below-continuum");
}

// Conservation as the issue asks it, over the whole range of M.
static void test_conservation(void) {
  for (double M = 0.1; M < 2e6; M *= 10.0) {
    SbFilmProblem problem = contact(M, 0.0, 0.0);
    solve(&film, &problem);
    double bound = fmax(1e-10, 10.0 * 2.3e-16 / pow(film.lambda, 0.6));
    g_assert_cmpfloat(film.solver.flux_error, <=, bound);
    g_assert_cmpfloat(film.solver.load_error, <=, 1e-10);
  }
}

// End pressures: thin films follow kappa^-0.8, equal pressures leave the flux alone, and pressure
// from the other side with reversed speed is the mirror image.
static void test_pressures(void) {
  static const double ends[][2] = {{0.5, 0.0}, {0.0, 0.5}, {0.5, 0.5}, {0.2, 0.6}, {1.2, 0.0}};
  for (size_t i = 0; i < G_N_ELEMENTS(ends); i++) {
    SbFilmProblem problem = contact(1e5, ends[i][0], ends[i][1]);
    solve(&film, &problem);
    double kappa = 1.0 - (ends[i][0] - ends[i][1]) / G_PI;
    double unit = problem.radius * pow(film.moes_U, 0.6) * pow(film.moes_W, -0.2);
    close_to("flux", film.film_flux, 3.77334 * unit * pow(kappa, -0.8), 1e-3);
    g_assert_cmpint(film.ruptured, ==, ends[i][1] == 0.0);
    problem.speed = -problem.speed;
    double swap = problem.pressure_left;
    problem.pressure_left = problem.pressure_right;
    problem.pressure_right = swap;
    solve(&other, &problem);
    close_to("mirrored minimum", other.film_min, film.film_min, 1e-12);
    close_to("mirrored peak", other.pressure_max, film.pressure_max, 1e-12);
  }
}

// The estimate against the true error (a solution of tolerance 1e-8 standing for the truth): never
// more than three times too small, and in the median not more than ten times too large.
static int by_value(gconstpointer a, gconstpointer b) {
  double x = *(const double *)a, y = *(const double *)b;
  return x < y ? -1 : x > y ? 1 : 0;
}

typedef struct {
  const char *name;
  double left, right; // most end pressures over the Hertz pressure
} Ends;

// Of minimum, centre and flux film each.
static double ratio[3][400];
static size_t ratios;

// Ratios of all kinds of ends, after their tests.
static void check_ratios(void) {
  static const char *name[] = {"minimum", "centre", "flux"};
  if (ratios == 0) {
    g_test_skip("no film was solved");
    return;
  }
  for (int i = 0; i < 3; i++) {
    qsort(ratio[i], ratios, sizeof ratio[i][0], by_value);
    g_test_message("%s, %zu points: estimate/true from %.2g, median %.2g, to %.2g", name[i], ratios,
                   ratio[i][0], ratio[i][ratios / 2], ratio[i][ratios - 1]);
    g_assert_cmpfloat(ratio[i][ratios / 2], <=, 10.0);
  }
}

static void test_honest(gconstpointer data) {
  const Ends *ends = data;
  unsigned turn = 0;
  for (double M = 0.13; M < 1.5e6; M *= 2.6, turn++) {
    // Pressures that change with M out of step.
    SbFilmProblem problem = contact(M, 0.0, 0.0);
    double unit = sqrt(problem.load * problem.modulus / (2.0 * M_PI * problem.radius));
    problem.pressure_left = ends->left * unit * fmod(0.21 + 0.382 * turn, 1.0);
    problem.pressure_right = ends->right * unit * fmod(0.87 + 0.618 * turn, 1.0);
    problem.tolerance = 1e-8;
    // Where so little is not reached, what is left counts below.
    SbStatus reached = sb_film_solve(&other, &problem, NULL, NULL);
    g_assert_true(reached == SB_OK || reached == SB_ERROR_NOT_CONVERGED);
    static const double tolerances[] = {1e-2, 1e-3, 1e-4};
    for (size_t t = 0; t < G_N_ELEMENTS(tolerances); t++) {
      problem.tolerance = tolerances[t];
      solve(&film, &problem);
      double truth[] = {fabs(film.film_min / other.film_min - 1.0),
                        fabs(film.film_central / other.film_central - 1.0),
                        fabs(film.film_flux / other.film_flux - 1.0)};
      double said[] = {film.solver.error_film_min, film.solver.error_film_central,
                       film.solver.error_film_flux};
      double left[] = {other.solver.error_film_min, other.solver.error_film_central,
                       other.solver.error_film_flux};
      g_assert_cmpuint(ratios, <, G_N_ELEMENTS(ratio[0]));
      for (int i = 0; i < 3; i++) {
        if (truth[i] > 3.0 * said[i] + left[i]) {
          g_test_message(
              "M %g, left %g, right %g, tolerance %g: true %.2g, estimate %.2g of the %s", M,
              problem.pressure_left / unit, problem.pressure_right / unit, tolerances[t], truth[i],
              said[i],
              i == 0   ? "minimum"
              : i == 1 ? "centre"
                       : "flux film");
          g_test_fail();
        }
        ratio[i][ratios] = said[i] / fmax(truth[i], 1e-12);
      }
      ratios++;
    }
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_assert_cmpint(sb_film_solver_create(&solver, NULL), ==, SB_OK);
  g_test_add_func("/film/reynolds/reference", test_reference);
  g_test_add_func("/film/reynolds/order", test_order);
  g_test_add_func("/film/reynolds/limits", test_limits);
  g_test_add_func("/film/reynolds/speeds", test_speeds);
  g_test_add_func("/film/reynolds/conservation", test_conservation);
  g_test_add_func("/film/reynolds/pressures", test_pressures);
  static const Ends ends[] = {
      {"none", 0.0, 0.0}, {"left", 1.5, 0.0}, {"right", 0.0, 1.5}, {"both", 1.5, 1.5}};
  for (size_t i = 0; i < G_N_ELEMENTS(ends); i++) {
    char *path = g_strdup_printf("/film/reynolds/honest/%s", ends[i].name);
    g_test_add_data_func(path, &ends[i], test_honest);
    g_free(path);
  }
  g_test_add_func("/film/reynolds/honest/medians", check_ratios);
  int failed = g_test_run();
  sb_film_solver_destroy(solver);
  return failed;
}
