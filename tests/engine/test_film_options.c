// Options and hard cases of the coupled film solver: cavities before a flooded outlet, starved
// inlets, Barus and Eyring, rupture pressure, warm starts, refusals, and recomputation from the
// profile.
#include "tests/engine/films.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>

static SbFilmSolver *solver;
static SbFilm film, other;
static SbFilmProfile profile[2];

// A contact of given M, W = 1e-3; pressures in units of p_H.
static const double RADIUS = 1e-3, MODULUS = 1e7, NUMBER_W = 1e-3;

static double hertz(void) {
  return 0.25 * MODULUS * sqrt(8.0 * NUMBER_W / G_PI);
}

static SbFilmProblem contact(double M, double left, double right) {
  SbFilmProblem problem;
  sb_film_problem_init(&problem);
  problem.modulus = MODULUS;
  problem.radius = RADIUS;
  problem.load = NUMBER_W * MODULUS * RADIUS;
  double U = 0.5 * (NUMBER_W / M) * (NUMBER_W / M);
  problem.viscosity = 1e-3;
  problem.speed = 2.0 * U * MODULUS * RADIUS / problem.viscosity;
  problem.pressure_left = left * hertz();
  problem.pressure_right = right * hertz();
  return problem;
}

static SbStatus solve(SbFilm *out, const SbFilmProblem *problem) {
  return solve_cold(out, problem, &profile[out == &other], solver);
}

// Slope of y over x at profile point i by the parabola through its neighbours.
static double slope(const double *x, const double *y, size_t i) {
  double a = x[i] - x[i - 1], b = x[i + 1] - x[i];
  return ((y[i + 1] - y[i]) * a / b + (y[i] - y[i - 1]) * b / a) / (a + b);
}

// Flux h - h^3 m p' / (6 eta speed) along the profile against film_flux, wherever the pressure is
// above a fiftieth of its peak and the film below five times the flux film. Returns the largest
// relative deviation.
static double flux_deviation(const SbFilm *f, const SbFilmProblem *problem) {
  double worst = 0.0;
  for (size_t i = 1; i + 1 < f->points; i++) {
    if (f->film[i] > 5.0 * f->film_flux || f->pressure[i] < 0.02 * f->pressure_max ||
        f->pressure[i - 1] <= 0.0 || f->pressure[i + 1] <= 0.0) {
      continue;
    }
    double eta = problem->viscosity * exp(problem->pressure_viscosity * f->pressure[i]);
    double mobility = 1.0 / eta;
    if (problem->eyring_stress > 0.0) {
      mobility *= hypot(1.0, eta * problem->speed / (problem->eyring_stress * f->film[i]));
    }
    double h = f->film[i];
    double flux = h - h * h * h * mobility * slope(f->x, f->pressure, i) / (6.0 * problem->speed);
    worst = fmax(worst, fabs(flux / f->film_flux - 1.0));
  }
  return worst;
}

// Deflection of the profile's pressure, piecewise linear, integrated exactly at x.
static double deflection(const SbFilm *f, double x) {
  double sum = 0.0;
  for (size_t i = 0; i + 1 < f->points; i++) {
    double a = f->x[i] - x, b = f->x[i + 1] - x;
    double la = a != 0.0 ? log(fabs(a)) : 0.0, lb = b != 0.0 ? log(fabs(b)) : 0.0;
    double rise = (f->pressure[i + 1] - f->pressure[i]) / (b - a);
    double constant = f->pressure[i] - rise * a;
    sum += constant * (b * (lb - 1.0) - a * (la - 1.0));
    sum += rise * (b * b * (0.5 * lb - 0.25) - a * a * (0.5 * la - 0.25));
  }
  return -4.0 / (G_PI * MODULUS) * sum;
}

// The same for the constant pressures beyond the profile, with the tilt of docs/verification.md:
// far from the contact h' is 4 (p_left - p_right) / (pi E') ln(2 |x| / b), so that the dry contact
// stays |x| < b.
static double far_deflection(const SbFilm *f, const SbFilmProblem *problem, double x) {
  double b = f->hertz_half_width;
  double l = x - f->x[0];
  double r = x - f->x[f->points - 1];
  double sum = problem->pressure_left * (l != 0.0 ? l * (log(fabs(l) / b) - 1.0) : 0.0) -
               problem->pressure_right * (r != 0.0 ? r * (log(fabs(r) / b) - 1.0) : 0.0) +
               (problem->pressure_left - problem->pressure_right) * log(2.0) * x;
  return 4.0 / (G_PI * MODULUS) * sum;
}

// Pressurised contacts recomputed from the profile: film, flux and net load. Equal shifts of both
// pressures leave a full film as it is.
static void test_pressurised_profile(void) {
  static const double ends[][2] = {{0.5, 0.0}, {0.3, 0.6}, {0.9, 0.9}};
  for (size_t k = 0; k < G_N_ELEMENTS(ends); k++) {
    SbFilmProblem problem = contact(25.0, ends[k][0], ends[k][1]);
    problem.tolerance = 1e-6;
    g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
    double load = 0.0;
    for (size_t i = 1; i < film.points; i++) {
      double middle = 0.5 * (film.x[i] + film.x[i - 1]);
      double ambient = middle < 0.0 ? problem.pressure_left : problem.pressure_right;
      load +=
          (film.x[i] - film.x[i - 1]) * (0.5 * (film.pressure[i] + film.pressure[i - 1]) - ambient);
    }
    close_to("net load", load, problem.load, 1e-3); // the step falls inside a piece
    g_assert_cmpfloat(flux_deviation(&film, &problem), <, 1e-4);
    double unit = film.hertz_half_width * film.hertz_half_width / RADIUS;
    double level = NAN;
    for (size_t i = 20; i < film.points; i += 37) {
      double x = film.x[i];
      if (fabs(x) > 3.0 * film.hertz_half_width) {
        continue;
      }
      double rest = film.film[i] - 0.5 * x * x / RADIUS - deflection(&film, x) -
                    far_deflection(&film, &problem, x);
      level = isnan(level) ? rest : level;
      g_assert_cmpfloat(fabs(rest - level), <, 1e-4 * film.film[i] + 3e-5 * unit);
    }
    if (ends[k][1] > 0.0) {
      problem.pressure_left += hertz();
      problem.pressure_right += hertz();
      g_assert_cmpint(solve(&other, &problem), ==, SB_OK);
      close_to("shifted", other.film_min, film.film_min, 1e-6);
    }
  }
}

// Film equation, flux, load and the integral by parts from nothing but the profile.
static void test_profile(void) {
  for (double M = 1.0; M < 150.0; M *= 5.0) {
    SbFilmProblem problem = contact(M, 0.0, 0.0);
    problem.tolerance = 1e-6;
    g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
    g_assert_cmpuint(film.points, >=, 400);
    double load = 0.0, work = 0.0, counter = 0.0;
    for (size_t i = 1; i < film.points; i++) {
      g_assert_cmpfloat(film.x[i], >, film.x[i - 1]);
      double dp = film.pressure[i] - film.pressure[i - 1];
      double dh = film.film[i] - film.film[i - 1];
      load += 0.5 * (film.x[i] - film.x[i - 1]) * (film.pressure[i] + film.pressure[i - 1]);
      work += 0.5 * (film.film[i] + film.film[i - 1]) * dp;
      counter += 0.5 * (film.pressure[i] + film.pressure[i - 1]) * dh;
    }
    close_to("load", load, problem.load, 1e-4);
    // At the ends p = 0, but for the far inlet's remainder.
    double ends = -film.film[0] * film.pressure[0];
    close_to("by parts", work, ends - counter, 1e-6);
    // Before the profile's first point h p' is 6 eta U / h, h nearly x^2 / 2R.
    double tail = -12.0 * problem.viscosity * problem.speed * RADIUS / film.x[0];
    close_to("Poiseuille friction", film.friction_poiseuille, 0.5 * (work + tail), 1e-3);
    g_assert_cmpfloat(flux_deviation(&film, &problem), <, 1e-4);
    // The film less parabola and deflection is the same everywhere.
    size_t middle = film.points / 2;
    double x0 = film.x[middle];
    double level = film.film[middle] - 0.5 * x0 * x0 / RADIUS - deflection(&film, x0);
    for (size_t i = 0; i < film.points; i += 37) {
      double x = film.x[i];
      double h = level + 0.5 * x * x / RADIUS + deflection(&film, x);
      if (fabs(x) < 2.0 * film.hertz_half_width) {
        // Relative to the film, allowing for the linear pieces' own error in the deflection.
        double unit = film.hertz_half_width * film.hertz_half_width / RADIUS;
        double allowed = 1e-4 * film.film[i] + 1e-5 * unit;
        g_assert_cmpfloat(fabs(h - film.film[i]), <, allowed);
      }
    }
  }
}

// A flooded outlet at low pressure: the film breaks and forms again, the pressure stays positive,
// the cavity closes as the pressure rises, and the flux passes smoothly from one state to the
// other.
static void test_cavity(void) {
  double before = 0.0, before_cavity = INFINITY;
  bool full_seen = false;
  SbFilmProblem problem = contact(20.0, 0.0, 0.0);
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  double ruptured = film.film_flux;
  for (int k = 0; k <= 16; k++) {
    double outlet = 1e-4 + 0.02 * k;
    problem = contact(20.0, 0.0, outlet);
    g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
    if (k == 0) {
      close_to("no pressure, no effect", film.film_flux, ruptured, 1e-3);
    } else {
      g_assert_cmpfloat(film.film_flux, <, before); // a step down of dozens of per mille at most
      close_to("smooth", film.film_flux, before, 0.02);
    }
    before = film.film_flux;
    double begin = 0.0, cavity = 0.0;
    for (size_t i = 0; i < film.points; i++) {
      g_assert_cmpfloat(film.pressure[i], >=, -2e-3 * film.hertz_pressure);
      if (i > 0 && film.x[i - 1] > 0.0 && film.x[i] - film.x[i - 1] > cavity &&
          fabs(film.pressure[i]) < 1e-6 * hertz() && fabs(film.pressure[i - 1]) < 1e-6 * hertz()) {
        begin = film.x[i - 1];
        cavity = film.x[i] - begin;
      }
    }
    if (film.ruptured) {
      g_assert_false(full_seen);
      g_assert_cmpfloat(cavity, >, 0.0);
      g_assert_cmpfloat(cavity, <, before_cavity);
      close_to("cavity begins at the rupture", begin, film.position_rupture, 1e-9);
      before_cavity = cavity;
    } else {
      full_seen = true;
    }
    close_to("end", film.pressure[film.points - 1], problem.pressure_right, 0.05);
    g_assert_cmpfloat(film.solver.flux_error, <=, 1e-10);
  }
  g_assert_true(full_seen);
}

// Starved inlets, to one hundredth of the flooded film.
static void test_starved(void) {
  for (double M = 3.0; M < 4e4; M *= 20.0) {
    SbFilmProblem problem = contact(M, 0.0, 0.0);
    g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
    double flooded = film.film_flux;
    double ratio = 0.0;
    static const double supply[] = {2.0, 0.99, 0.7, 0.3, 0.1, 0.03, 0.01};
    for (size_t i = 0; i < G_N_ELEMENTS(supply); i++) {
      problem.inlet_film = 0.5 * supply[i] * flooded;
      g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
      g_assert_cmpint(film.starved, ==, supply[i] < 1.0);
      close_to("flux", film.film_flux, fmin(supply[i], 1.0) * flooded, 1e-6);
      // The constriction fades as the film starves.
      g_assert_cmpfloat(film.film_min / film.film_flux, >, ratio * (1.0 - 1e-6));
      ratio = film.film_min / film.film_flux;
      g_assert_cmpfloat(film.solver.load_error, <=, 1e-10);
    }
    close_to("thin film is flat", film.film_min, film.film_flux, 5e-3);
    close_to("its friction", film.friction_couette,
             2.0 * film.hertz_half_width * problem.viscosity * problem.speed / film.film_flux,
             0.01);
    close_to("its peak", film.pressure_max, film.hertz_pressure, 1e-3);
  }
  // Between the rigid and the elastic regime the film breaks before the outlet layer's last steps.
  for (double M = 0.9; M < 3.0; M += 0.23) {
    SbFilmProblem problem = contact(M, 0.0, 0.0);
    g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
    double flooded = film.film_flux;
    static const double supply[] = {0.9, 0.5, 0.02};
    for (size_t i = 0; i < G_N_ELEMENTS(supply); i++) {
      problem.inlet_film = 0.5 * supply[i] * flooded;
      g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
      close_to("flux", film.film_flux, supply[i] * flooded, 1e-6);
      g_assert_cmpfloat(film.solver.load_error, <=, 1e-10);
    }
  }
}

// Barus and Eyring: Reynolds' equation with their viscosity holds along the profile, both fade in
// from the isoviscous film, and they act in the expected direction.
static void test_rheology(void) {
  SbFilmProblem problem = contact(10.0, 0.0, 0.0);
  g_assert_cmpint(solve(&other, &problem), ==, SB_OK);
  problem.pressure_viscosity = 1e-4 / hertz();
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  close_to("Barus fades", film.film_flux, other.film_flux, 1e-4);
  problem.pressure_viscosity = 0.8 / hertz();
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  g_assert_cmpfloat(film.film_flux, >, 1.1 * other.film_flux);
  g_assert_cmpfloat(flux_deviation(&film, &problem), <, 1e-4);
  problem.pressure_viscosity = 0.0;
  problem.eyring_stress = problem.viscosity * problem.speed / other.film_flux * 100.0;
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  close_to("Eyring fades", film.film_flux, other.film_flux, 1e-3);
  problem.eyring_stress /= 200.0;
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  g_assert_cmpfloat(film.film_flux, <, 0.9 * other.film_flux);
  g_assert_cmpfloat(film.friction_couette, <, other.friction_couette);
  g_assert_cmpfloat(flux_deviation(&film, &problem), <, 1e-4);
}

// Only pressures above the rupture pressure count: shifting all three changes nothing.
static void test_rupture_pressure(void) {
  SbFilmProblem problem = contact(50.0, 0.4, 0.0);
  g_assert_cmpint(solve(&other, &problem), ==, SB_OK);
  problem = contact(50.0, 0.7, 0.3);
  problem.rupture_pressure = 0.3 * hertz();
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  close_to("minimum", film.film_min, other.film_min, 1e-9);
  close_to("peak", film.pressure_max, other.pressure_max + 0.3 * hertz(), 1e-9);
  close_to("rupture at the vapour pressure", film.pressure[film.points - 1],
           problem.rupture_pressure, 1e-6);
  problem.pressure_left = 0.1 * hertz();
  g_assert_cmpint(solve(&film, &problem), ==, SB_ERROR_INFEASIBLE);
}

// Warm starts give the cold answer within the estimates, in fewer steps.
static void test_warm(void) {
  sb_film_solver_forget(solver);
  for (double M = 500.0; M < 5000.0; M *= 1.2) {
    SbFilmProblem problem = contact(M, 0.02 * log(M), 0.0);
    g_assert_cmpint(sb_film_solve(&film, &problem, solver, NULL), ==, SB_OK);
    g_assert_cmpint(sb_film_solve(&other, &problem, NULL, NULL), ==, SB_OK);
    double allowed = 3.0 * (film.solver.error_film_min + other.solver.error_film_min);
    close_to("minimum", film.film_min, other.film_min, allowed);
    if (M > 600.0) {
      g_assert_cmpint(film.solver.newton_iterations, <, other.solver.newton_iterations);
    }
  }
}

// A film beside a solved one is that of a solve of its own; the base stays, and there is none
// beside nothing or too far away.
static void test_beside(void) {
  static const size_t place[] = {offsetof(SbFilmProblem, load),
                                 offsetof(SbFilmProblem, speed),
                                 offsetof(SbFilmProblem, radius),
                                 offsetof(SbFilmProblem, viscosity),
                                 offsetof(SbFilmProblem, pressure_left),
                                 offsetof(SbFilmProblem, pressure_right),
                                 offsetof(SbFilmProblem, eyring_stress),
                                 offsetof(SbFilmProblem, pressure_viscosity),
                                 offsetof(SbFilmProblem, rupture_pressure)};
  static const double M[] = {40, 900};
  SbFilmSolver *own;
  for (size_t i = 0; i < G_N_ELEMENTS(M); i++) {
    SbFilmProblem problem = contact(M[i], 0.3, 0.2);
    problem.tolerance = 1e-6;
    problem.eyring_stress = 2e5;
    problem.pressure_viscosity = 1e-9;
    problem.rupture_pressure = 1e3;
    g_assert_cmpint(sb_film_solver_create(&own, NULL), ==, SB_OK);
    SbFilmProblem beside = problem;
    beside.place = SB_FILM_BESIDE;
    g_assert_cmpint(sb_film_solve(&film, &beside, own, NULL), ==, SB_ERROR_NOT_CONVERGED);
    g_assert_cmpint(sb_film_solve(&other, &problem, own, NULL), ==, SB_OK);
    const double base = other.film_min;
    for (size_t k = 0; k < G_N_ELEMENTS(place); k++) {
      double *number = (double *)(void *)((char *)&beside + place[k]);
      const double was = *number;
      *number *= 1 + 1e-3;
      g_assert_cmpint(sb_film_solve(&film, &beside, own, NULL), ==, SB_OK);
      SbFilmProblem alone = beside;
      alone.place = SB_FILM_ALONE;
      g_assert_cmpint(sb_film_solve(&other, &alone, NULL, NULL), ==, SB_OK);
      close_to("minimum", film.film_min, other.film_min, 1e-6);
      close_to("centre", film.film_central, other.film_central, 1e-6);
      close_to("shear", film.friction_couette, other.friction_couette, 1e-6);
      *number = was;
    }
    g_assert_cmpint(sb_film_solve(&film, &beside, own, NULL), ==, SB_OK);
    close_to("base", film.film_min, base, 1e-9);
    beside.load *= 30;
    g_assert_cmpint(sb_film_solve(&film, &beside, own, NULL), ==, SB_ERROR_NOT_CONVERGED);
    sb_film_solver_destroy(own);
  }
}

static bool stop(void *data) {
  int *polls = data;
  return ++*polls > 3;
}

// The corners of the admitted ranges are solved, or refused with a reason.
static void test_hard(void) {
  size_t solved = 0, refused = 0;
  for (double E = 1e5; E < 2e10; E *= 100.0) {
    for (double eta = 1e-6; eta < 20.0; eta *= 100.0) {
      for (double load = 1e-3; load < 2e6; load *= 1000.0) {
        for (double speed = 1e-6; speed < 2.0; speed *= 1000.0) {
          SbFilmProblem problem;
          sb_film_problem_init(&problem);
          problem.load = load;
          problem.radius = 0.805e-3;
          problem.modulus = E;
          problem.viscosity = eta;
          problem.speed = speed;
          SbStatus status = solve(&film, &problem);
          problem.model = SB_FILM_MOES;
          g_assert_cmpint(sb_film_solve(&other, &problem, solver, NULL), ==, SB_OK);
          if (status == SB_OK) {
            solved++;
            close_to("blend, flux", other.film_flux, film.film_flux, 0.02);
            close_to("blend, minimum", other.film_min, film.film_min, 0.02);
            close_to("blend, centre", other.film_central, film.film_central, 0.05);
          } else {
            refused++;
            g_assert_cmpint(status, ==, SB_ERROR_RANGE);
            g_assert_cmpfloat(film.moes_M, >, 1e9);
          }
        }
      }
    }
  }
  g_test_message("%zu solved, %zu refused", solved, refused);
  g_assert_cmpuint(solved, >, 20 * refused);
  // The film of a tenth of a nanometre is solved and flagged.
  SbFilmProblem problem = contact(1e6, 0.0, 0.0);
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  g_assert_cmpfloat(film.film_min, <, 1e-10);
  g_assert_cmpstr(film.warnings.item[0].code, ==, "film-below-continuum");
  int polls = 0;
  problem.cancelled = stop;
  problem.cancelled_data = &polls;
  g_assert_cmpint(solve(&film, &problem), ==, SB_ERROR_CANCELLED);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_assert_cmpint(sb_film_solver_create(&solver, NULL), ==, SB_OK);
  g_test_add_func("/film/options/profile", test_profile);
  g_test_add_func("/film/options/pressurised", test_pressurised_profile);
  g_test_add_func("/film/options/cavity", test_cavity);
  g_test_add_func("/film/options/starved", test_starved);
  g_test_add_func("/film/options/rheology", test_rheology);
  g_test_add_func("/film/options/rupture", test_rupture_pressure);
  g_test_add_func("/film/options/warm", test_warm);
  g_test_add_func("/film/options/beside", test_beside);
  g_test_add_func("/film/options/hard", test_hard);
  int failed = g_test_run();
  sb_film_solver_destroy(solver);
  return failed;
}
