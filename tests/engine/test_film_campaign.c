// Random contacts over the whole admitted box, and a box of M and end pressures: every one is
// solved or refused with a reason, and what is solved holds: mass, load, few Newton steps, the
// estimate against a solve of a thousandth of the tolerance, the mirrored contact.
//
// test-engine-film-campaign [COUNT [SEED]]: COUNT contacts of each kind, 30 in the tests.
#include "tests/engine/films.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static SbFilmSolver *solver;
static SbFilm film, other;
static int count = 30;
static guint32 seed = 1;

typedef struct {
  int solved, refused, failed, most_steps;
} Tally;

static double between(GRand *random, double low, double high) {
  return g_rand_double_range(random, low, high);
}

static double decades(GRand *random, double low, double high) {
  return exp(between(random, log(low), log(high)));
}

static void note(const SbFilmProblem *p, const char *what, double value) {
  g_test_message("%s %g: M %.17g, load %.17g speed %.17g radius %.17g modulus %.17g viscosity "
                 "%.17g left %.17g right %.17g inlet film %.17g",
                 what, value, film.moes_M, p->load, p->speed, p->radius, p->modulus, p->viscosity,
                 p->pressure_left, p->pressure_right, p->inlet_film);
}

static void complain(Tally *tally, const SbFilmProblem *p, const char *what, double value) {
  tally->failed++;
  note(p, what, value);
  g_test_fail();
}

static double hertz_of(const SbFilmProblem *p) {
  double W = p->load / (p->modulus * p->radius);
  return 0.25 * p->modulus * sqrt(8.0 * W / G_PI);
}

// A contact of W = 1e-3 at Moes' M under the viscosity [Pa s]: u = 2 U E' R / eta, U = (W / M)^2
// / 2.
static SbFilmProblem contact(double M, double viscosity) {
  SbFilmProblem p;
  sb_film_problem_init(&p);
  p.modulus = 1e7;
  p.radius = 1e-3;
  p.load = 10.0;
  p.viscosity = viscosity;
  p.speed = (1e-3 / M) * (1e-3 / M) * p.modulus * p.radius / viscosity;
  return p;
}

// Solves and checks one contact; `thorough` compares with a finer solve and the mirror image.
static void one(Tally *tally, const SbFilmProblem *p, bool thorough) {
  SbReport report;
  sb_film_solver_forget(solver);
  SbStatus status = sb_film_solve(&film, p, solver, &report);
  if (status == SB_ERROR_RANGE || status == SB_ERROR_INFEASIBLE) {
    tally->refused++;
    g_assert_cmpint((int)strlen(report.text), >, 20);
    return;
  }
  if (status != SB_OK) {
    g_test_message("%s", report.text);
    complain(tally, p, "status", (double)status);
    return;
  }
  tally->solved++;
  const SbFilmSolverInfo *info = &film.solver;
  if (p->speed == 0.0) {
    g_assert_cmpfloat(film.film_min, ==, 0.0);
    return;
  }
  // Never wrong: mass and load to rounding, positive films, each continuation step short.
  double rounding = fmax(1e-10, 10.0 * 2.3e-16 / fmin(1.0, pow(film.lambda, 0.6)));
  // End pressures bend and thin the film: deflections are larger against it.
  double ends = (p->pressure_left + p->pressure_right) / film.hertz_pressure;
  rounding *= 1.0 + 2.0 * ends;
  if (film.starved) {
    rounding *= 100.0; // a film of a hundredth
  }
  // Where rounding stops Newton's method early the error told holds what is left.
  if (!(info->flux_error <= fmax(rounding, (1.0 + 1e-6) * info->residual))) {
    complain(tally, p, "flux error", info->flux_error);
  }
  if (!(info->load_error <= 1e-10)) {
    complain(tally, p, "load error", info->load_error);
  }
  if (!(film.film_min > 0.0 && film.film_min <= film.film_central * (1.0 + 1e-9) &&
        film.film_flux > 0.0 && isfinite(film.friction_couette) &&
        isfinite(film.friction_poiseuille))) {
    complain(tally, p, "films", film.film_min);
  }
  if (info->newton_iterations > 10 * info->continuation_steps) {
    complain(tally, p, "Newton steps", info->newton_iterations);
  }
  tally->most_steps = MAX(tally->most_steps, info->newton_iterations);
  bool below = false;
  for (int i = 0; i < (int)film.warnings.count; i++) {
    below = below || strcmp(film.warnings.item[i].code, "film-below-continuum") == 0;
  }
  if (film.film_min < 1e-10 && !below) {
    complain(tally, p, "unflagged film", film.film_min);
  }
  if (!thorough) {
    return;
  }
  SbFilmProblem fine = *p;
  fine.tolerance = 1e-6; // at 1e-5 the finer one may be as far off as the other
  sb_film_solver_forget(solver);
  if (sb_film_solve(&other, &fine, solver, &report) == SB_OK) {
    double error = fabs(film.film_min / other.film_min - 1.0);
    if (error > 3.0 * info->error_film_min + other.solver.error_film_min) {
      complain(tally, p, "error of the minimum over its estimate", error / info->error_film_min);
    }
    error = fabs(film.film_central / other.film_central - 1.0);
    if (error > 3.0 * info->error_film_central + other.solver.error_film_central) {
      complain(tally, p, "error of the centre over its estimate", error / info->error_film_central);
    }
  }
  SbFilmProblem mirror = *p;
  mirror.speed = -p->speed;
  mirror.pressure_left = p->pressure_right;
  mirror.pressure_right = p->pressure_left;
  sb_film_solver_forget(solver);
  status = sb_film_solve(&other, &mirror, solver, &report);
  if (status != SB_OK || fabs(other.film_min / film.film_min - 1.0) > 1e-12) {
    complain(tally, p, "mirror", other.film_min / film.film_min);
  }
}

static void finish(const Tally *tally) {
  g_test_message("%d solved, %d refused, %d complaints, at most %d Newton steps in a solve",
                 tally->solved, tally->refused, tally->failed, tally->most_steps);
}

// M from 0.1 to 1e6 with pressure on none, left, right, both, up to two Hertz pressures.
static void test_box_of_M(void) {
  GRand *random = g_rand_new_with_seed(seed);
  Tally tally = {0};
  for (int i = 0; i < count; i++) {
    double M = decades(random, 0.1, 1e6);
    SbFilmProblem p = contact(M, decades(random, 1e-6, 10.0));
    p.speed = g_rand_boolean(random) ? p.speed : -p.speed;
    double left = between(random, 0.0, 2.0), right = between(random, 0.0, 2.0);
    int ends = i % 4;
    p.pressure_left = ends & 1 ? left * hertz_of(&p) : 0.0;
    p.pressure_right =
        ends == 3  ? p.pressure_left + between(random, -1.0, 1.0) * fmin(left, right) * hertz_of(&p)
        : ends & 2 ? right * hertz_of(&p)
                   : 0.0;
    if (fabs(p.speed) > 1e4) {
      p.viscosity *= fabs(p.speed) / 1e4;
      p.speed = copysign(1e4, p.speed);
    }
    one(&tally, &p, i % 3 == 0);
  }
  finish(&tally);
  g_rand_free(random);
}

// The hard box: E, viscosity, load, speed and pressures over all their decades.
static void test_box_of_sizes(void) {
  GRand *random = g_rand_new_with_seed(seed + 1);
  Tally tally = {0};
  for (int i = 0; i < count; i++) {
    SbFilmProblem p;
    sb_film_problem_init(&p);
    p.modulus = decades(random, 1e5, 1e10);
    p.viscosity = decades(random, 1e-6, 10.0);
    p.load = decades(random, 1e-3, 1e6);
    p.radius = decades(random, 1e-4, 1e-2);
    p.speed = i % 10 == 0 ? 0.0 : decades(random, 1e-6, 10.0);
    p.speed *= g_rand_boolean(random) ? 1.0 : -1.0;
    double most = fmin(2e6, 1.5 * hertz_of(&p));
    p.pressure_left = i % 3 == 1 ? between(random, 0.0, most) : 0.0;
    p.pressure_right = i % 5 == 1 ? p.pressure_left : i % 4 == 1 ? between(random, 0.0, most) : 0.0;
    one(&tally, &p, i % 3 == 0);
  }
  finish(&tally);
  g_rand_free(random);
}

// Starved to between a hundredth and the whole of the flooded flux.
static void test_starved(void) {
  GRand *random = g_rand_new_with_seed(seed + 2);
  Tally tally = {0};
  for (int i = 0; i < count / 2; i++) {
    SbFilmProblem p = contact(decades(random, 3.0, 1e6), 1e-3);
    p.speed = i % 2 ? p.speed : -p.speed;
    sb_film_solver_forget(solver);
    g_assert_cmpint(sb_film_solve(&film, &p, solver, NULL), ==, SB_OK);
    p.inlet_film = 0.5 * film.film_flux * decades(random, 0.01, 1.0);
    one(&tally, &p, i % 6 == 0);
    if (film.starved && fabs(film.film_flux / (2.0 * p.inlet_film) - 1.0) > 1e-6) {
      complain(&tally, &p, "supply", film.film_flux / (2.0 * p.inlet_film));
    }
  }
  finish(&tally);
  g_rand_free(random);
}

// So little film is supplied that its layer, 6e-8 of the half-width, is lost in rounding: refused,
// where a supply four times as large is solved.
static void test_starved_to_rounding(void) {
  SbFilmProblem p = contact(1.0, 1e-3);
  p.speed = 1.4321658003391277e-11; // M = 8.4e5
  p.inlet_film = 1.45e-15;
  SbReport report;
  sb_film_solver_forget(solver);
  g_assert_cmpint(sb_film_solve(&film, &p, solver, &report), ==, SB_ERROR_RANGE);
  g_assert_nonnull(strstr(report.text, "rounding"));
  p.inlet_film *= 4.0;
  g_assert_cmpint(sb_film_solve(&film, &p, solver, &report), ==, SB_OK);
  g_assert_true(film.starved);
}

// A contact that continuation reaches over meshes of other numbers of elements: few steps suffice,
// and what the solver did before does not show.
static void test_kept_elements(void) {
  SbFilmProblem p = contact(1.0, 3.4907142162813742);
  p.speed = 3.1699421633600248e-10; // M = 3.0e3
  p.pressure_right = 251131.46527606199;
  double first = 0.0;
  for (int i = 0; i < 3; i++) {
    p.tolerance = i == 1 ? 1e-5 : 1e-3;
    sb_film_solver_forget(solver);
    g_assert_cmpint(sb_film_solve(&film, &p, solver, NULL), ==, SB_OK);
    g_assert_cmpint(film.solver.newton_iterations, <=, 60);
    g_assert_cmpint(film.solver.newton_iterations, <=, 10 * film.solver.continuation_steps);
    first = i == 0 ? film.film_min : first;
  }
  g_assert_cmpfloat(film.film_min, ==, first);
}

// Thick films that break before a weakly pressed outlet and form again: at M = 20 they would stay
// full. Solved by smooth rows, in few steps.
static void test_closing_cavity(void) {
  enum { STEPS_MAX = 40 };
  static const double M[] = {2.0925416820920941, 1.8, 2.4};
  static const double left[] = {0.17122, 0.15, 0.2}, right[] = {0.26848, 0.24, 0.3};
  Tally tally = {0};
  for (size_t i = 0; i < G_N_ELEMENTS(M); i++) {
    SbFilmProblem p = contact(M[i], 3.6e-4);
    p.pressure_left = left[i] * hertz_of(&p);
    p.pressure_right = right[i] * hertz_of(&p);
    one(&tally, &p, true);
    p.tolerance = 1e-7; // rough rows leave more
    sb_film_solver_forget(solver);
    g_assert_cmpint(sb_film_solve(&film, &p, solver, NULL), ==, SB_OK);
    g_assert_cmpint(film.solver.continuation_steps, <=, STEPS_MAX);
    g_assert_true(film.ruptured);
  }
  finish(&tally);
}

// Rough rows, which a trace of van der Waals' pull takes, tell what the rupture's kink leaves.
static void test_kink(void) {
  static const double M[] = {0.532, 9.41, 231.0, 2.0925416820920941};
  static const double left[] = {0.0, 0.82, 0.3, 0.17122}, right[] = {0.0, 0.0, 0.0, 0.26848};
  for (size_t i = 0; i < G_N_ELEMENTS(M); i++) {
    SbFilmProblem p = contact(M[i], 1e-3);
    p.pressure_left = left[i] * hertz_of(&p);
    p.pressure_right = right[i] * hertz_of(&p);
    p.tolerance = 1e-7;
    sb_film_solver_forget(solver);
    g_assert_cmpint(sb_film_solve(&film, &p, solver, NULL), ==, SB_OK);
    p.hamaker = 1e-35;
    for (int k = 0; k < 2; k++) {
      p.tolerance = k == 0 ? 1e-3 : 2e-5;
      sb_film_solver_forget(solver);
      g_assert_cmpint(sb_film_solve(&other, &p, solver, NULL), ==, SB_OK);
      const SbFilmSolverInfo *info = &other.solver;
      const double least = fabs(other.film_min / film.film_min - 1.0);
      const double central = fabs(other.film_central / film.film_central - 1.0);
      g_test_message("M %.3g: %.2g of %.2g, %.2g of %.2g", M[i], least, info->error_film_min,
                     central, info->error_film_central);
      g_assert_cmpfloat(least, <=, 3.0 * info->error_film_min);
      g_assert_cmpfloat(central, <=, 3.0 * info->error_film_central);
    }
  }
}

// Outlet pressure that pushes the film far out of the dry contact, near to where it opens it.
static void test_pressed(void) {
  static const double M[] = {1.4, 2.27, 5.14, 30.0, 267.0, 1e4, 3e5};
  static const double step[] = {1.96, 2.3, 2.6};
  Tally tally = {0};
  for (size_t i = 0; i < G_N_ELEMENTS(M); i++) {
    for (size_t k = 0; k < G_N_ELEMENTS(step); k++) {
      SbFilmProblem p = contact(M[i], 1e-3);
      p.pressure_right = step[k] * hertz_of(&p);
      one(&tally, &p, true);
    }
  }
  // The same of the inlet, which opens its edge: rounding stops the descent early there, and the
  // error told holds it.
  SbFilmProblem inlet = contact(4.13e4, 1e-3);
  inlet.pressure_left = 3.06 * hertz_of(&inlet);
  sb_film_solver_forget(solver);
  g_assert_cmpint(sb_film_solve(&film, &inlet, solver, NULL), ==, SB_OK);
  g_assert_cmpfloat(film.solver.flux_error, <=, (1.0 + 1e-6) * film.solver.residual); // the same
  g_assert_cmpfloat(film.solver.residual, <=, 0.01 * inlet.tolerance);
  g_assert_cmpfloat(film.solver.error_film_min, >=, film.solver.residual);
  // It also drives the film, more than the wall does: its central film is read off all the same.
  static const double driven[][2] = {{886.22, 2.90776}, {1939.47, 2.887}};
  for (size_t i = 0; i < G_N_ELEMENTS(driven); i++) {
    inlet = contact(driven[i][0], 1e-3);
    inlet.pressure_left = driven[i][1] * hertz_of(&inlet);
    one(&tally, &inlet, true);
  }
  finish(&tally);
  g_assert_cmpint(tally.solved, ==,
                  (int)(G_N_ELEMENTS(M) * G_N_ELEMENTS(step) + G_N_ELEMENTS(driven)));
}

// Thick films between pools of the same pressure. Above 0.75 p_H the film is full everywhere: in
// the limit its least thickness is (lambda^2/24)^(1/3) b^2/R and its pressure goes 0.75 p_H over
// that of the pools (wedge.h), with corrections that go with lambda^(-1/3). Below it breaks and
// forms again.
static void test_rigid_in_pools(void) {
  static const double M[] = {1e-6, 1e-4, 1e-2, 0.1};
  static const double ends[] = {0.02, 0.5, 0.7, 0.9, 1.8};
  Tally tally = {0};
  for (size_t i = 0; i < G_N_ELEMENTS(M); i++) {
    for (size_t k = 0; k < G_N_ELEMENTS(ends); k++) {
      SbFilmProblem p = contact(M[i], 1.0);
      p.modulus = 1e9;
      p.radius = 1e-2;
      p.load = 1e-3;
      double eta_u = pow(p.load / M[i], 2.0) / (p.modulus * p.radius);
      p.viscosity = fmax(eta_u, 1e-6);
      p.speed = eta_u / p.viscosity;
      p.pressure_left = p.pressure_right = ends[k] * hertz_of(&p);
      one(&tally, &p, true);
      double deflection = 1.0 / cbrt(film.lambda);
      double unit = film.hertz_half_width * film.hertz_half_width / p.radius;
      if (ends[k] > 0.75 + deflection) {
        double limit = cbrt(film.lambda * film.lambda / 24.0) * unit;
        double peak = (film.pressure_max - p.pressure_left) / film.hertz_pressure;
        g_assert_cmpfloat(fabs(film.film_min / limit - 1.0), <, 3.0 * deflection + 1e-5);
        g_assert_cmpfloat(fabs(peak / 0.75 - 1.0), <, 3.0 * deflection + 1e-5);
        g_assert_false(film.ruptured);
      } else if (ends[k] < 0.75 - 3.0 * deflection) {
        g_assert_true(film.ruptured);
      }
    }
  }
  finish(&tally);
  g_assert_cmpint(tally.solved, ==, (int)(G_N_ELEMENTS(M) * G_N_ELEMENTS(ends)));
}

// End pressures up to four Hertz pressures on either side: smooth from rigid to thin films, in
// pools of one pressure, between asperities, and these at rest. No path takes more than 40 steps;
// what stays above its tolerance lies in a contact that the end pressures nearly open, and is less
// than one per cent of all.
static void test_ends(void) {
  enum { SMOOTH, RIGID, GREENWOOD_TRIPP, PERSSON, SLOW, KINDS, STEPS_MAX = 40 };
  static const double NEARLY_OPEN = 2.6; // of pi, in Hertz pressures; found above: from 2.67 on
  GRand *random = g_rand_new_with_seed(seed + 3);
  Tally tally = {0};
  int lost = 0, steps = 0;
  for (int kind = SMOOTH; kind < KINDS; kind++) {
    for (int i = 0; i < MAX(count / 3, 1); i++) {
      SbFilmProblem p = contact(kind == RIGID    ? decades(random, 1e-3, 2.0)
                                : kind == SMOOTH ? decades(random, 0.1, 1e6)
                                                 : decades(random, 1.0, 1e5),
                                1e-3);
      p.viscosity *= fmax(p.speed / 1e3, 1.0);
      p.speed = fmin(p.speed, 1e3);
      const double hertz = hertz_of(&p), unit = 8.0 * 1e-3 / G_PI * p.radius;
      p.pressure_left = i % 4 == 1 ? 0.0 : between(random, 0.0, 4.0) * hertz;
      p.pressure_right = i % 4 == 0                   ? 0.0
                         : kind == RIGID && i % 4 > 1 ? p.pressure_left
                                                      : between(random, 0.0, 4.0) * hertz;
      p.speed *= g_rand_boolean(random) ? -1.0 : 1.0;
      if (kind >= GREENWOOD_TRIPP) {
        p.surface = kind == PERSSON ? SB_ROUGH_PERSSON : SB_ROUGH_GREENWOOD_TRIPP;
        p.sigma = unit * decades(random, 1e-5, 3e-2);
        p.gt_product = decades(random, 0.03, 0.2);
        p.sigma_over_beta = decades(random, 0.01, 0.3);
        p.speed *= kind < SLOW ? 1.0 : i % 3 == 0 ? 0.0 : 1e-3;
      }
      SbReport report;
      sb_film_solver_forget(solver);
      const SbStatus status = sb_film_solve(&film, &p, solver, &report);
      if (status == SB_ERROR_RANGE || status == SB_ERROR_INFEASIBLE) {
        tally.refused++;
        continue;
      }
      steps = MAX(steps, film.solver.continuation_steps);
      if (status != SB_OK && fabs(p.pressure_left - p.pressure_right) > NEARLY_OPEN * hertz) {
        lost++;
        note(&p, "lost, steps", film.solver.continuation_steps);
      } else if (status != SB_OK || film.solver.continuation_steps > STEPS_MAX) {
        g_test_message("kind %d, sigma %.17g product %.17g sigma/beta %.17g: %s", kind, p.sigma,
                       p.gt_product, p.sigma_over_beta, report.text);
        complain(&tally, &p, "steps", film.solver.continuation_steps);
      } else {
        tally.solved++;
      }
    }
  }
  finish(&tally);
  g_test_message("%d lost, at most %d steps", lost, steps);
  g_assert_cmpint(lost, <=, MAX(tally.solved / 100, 1));
  g_rand_free(random);
}

// A flooded outlet whose pressure nearly opens the contact: straight from a start on its layers, to
// a tenth of the tolerance.
static void test_nearly_open(void) {
  enum { STEPS_MAX = 10 };
  static const double M[] = {40.0, 100.0, 350.0, 1300.0, 4200.0}, apart[] = {2.7, 2.9, 3.0, 3.05};
  for (size_t i = 0; i < G_N_ELEMENTS(M) * G_N_ELEMENTS(apart); i++) {
    SbFilmProblem p = contact(M[i / G_N_ELEMENTS(apart)], 1e-3);
    p.pressure_right = apart[i % G_N_ELEMENTS(apart)] * hertz_of(&p);
    sb_film_solver_forget(solver);
    g_assert_cmpint(sb_film_solve(&film, &p, solver, NULL), ==, SB_OK);
    g_assert_cmpint(film.solver.continuation_steps, <=, STEPS_MAX);
    g_assert_cmpfloat(film.solver.error_film_min, <, 1e-4);
  }
}

// A flow between asperities that the end pressures drive, with the wall against it or at rest: that
// at rest is the limit of slow ones, and not sealed.
static void test_driven(void) {
  for (int kind = 0; kind < 2; kind++) {
    SbFilmProblem p;
    sb_film_problem_init(&p);
    p.load = 583.65958386491729;
    p.speed = 7.3826806994070195e-05;
    p.radius = 0.0014194404911960377;
    p.modulus = 2861150.0222142646;
    p.viscosity = 0.0006136857021787612;
    p.pressure_left = 1176606.992984721;
    p.surface = kind == 0 ? SB_ROUGH_GREENWOOD_TRIPP : SB_ROUGH_PERSSON;
    p.gt_product = 0.13853079239094307;
    p.sigma = 2.4318861962243412e-06;
    p.sigma_over_beta = 0.1984221580366029;
    sb_film_solver_forget(solver);
    g_assert_cmpint(sb_film_solve(&film, &p, solver, NULL), ==, SB_OK);
    p.speed *= 1e-6;
    g_assert_cmpint(sb_film_solve(&film, &p, solver, NULL), ==, SB_OK);
    p.speed = 0.0;
    g_assert_cmpint(sb_film_solve(&other, &p, solver, NULL), ==, SB_OK);
    for (size_t i = 0; i < other.warnings.count; i++) {
      g_assert_cmpstr(other.warnings.item[i].code, !=, "film-rest-sealed");
    }
    g_test_message("%g nm, at rest %g nm", 1e9 * film.film_min, 1e9 * other.film_min);
    g_assert_cmpfloat(fabs(film.film_min / other.film_min - 1.0), <, 2e-3);
    g_assert_cmpfloat(fabs(film.film_central / other.film_central - 1.0), <, 2e-3);
  }
}

// Thick layers whose flooded outlet leaves no room for elements between the layers.
static void test_thick_layers(void) {
  static const double M[] = {2.39, 2.59, 2.87, 3.6};
  static const double left[] = {0.71, 2.0, 1.29, 1.22}, right[] = {0.92, 2.0, 1.45, 1.95};
  Tally tally = {0};
  for (size_t i = 0; i < G_N_ELEMENTS(M); i++) {
    SbFilmProblem p = contact(M[i], 1e-3);
    p.speed *= i < 2 ? 1.0 : -1.0;
    p.pressure_left = left[i] * hertz_of(&p);
    p.pressure_right = right[i] * hertz_of(&p);
    one(&tally, &p, true);
  }
  finish(&tally);
  g_assert_cmpint(tally.solved, ==, (int)G_N_ELEMENTS(M));
}

// A supply of just what the contact takes floods it; a little less is told by the error estimate.
static void test_just_flooded(void) {
  static const double share[] = {1.0, 1.0 - 1e-6, 1.0 - 1e-5};
  SbFilmProblem p = outer_seal(1e-2);
  sb_film_solver_forget(solver);
  g_assert_cmpint(sb_film_solve(&other, &p, solver, NULL), ==, SB_OK);
  for (size_t i = 0; i < G_N_ELEMENTS(share); i++) {
    p.inlet_film = 0.5 * share[i] * other.film_flux;
    sb_film_solver_forget(solver);
    g_assert_cmpint(sb_film_solve(&film, &p, solver, NULL), ==, SB_OK);
    double error = fabs(film.film_flux / (share[i] * other.film_flux) - 1.0);
    g_assert_cmpfloat(error, <=, 2.0 * film.solver.error_film_flux);
    g_assert_cmpfloat(film.solver.error_film_min, <, 2e-5);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  if (argc > 1) {
    count = atoi(argv[1]);
  }
  if (argc > 2) {
    seed = (guint32)atoi(argv[2]);
  }
  g_assert_cmpint(sb_film_solver_create(&solver, NULL), ==, SB_OK);
  g_test_add_func("/film/campaign/M", test_box_of_M);
  g_test_add_func("/film/campaign/sizes", test_box_of_sizes);
  g_test_add_func("/film/campaign/starved", test_starved);
  g_test_add_func("/film/campaign/starved-to-rounding", test_starved_to_rounding);
  g_test_add_func("/film/campaign/kept-elements", test_kept_elements);
  g_test_add_func("/film/campaign/closing-cavity", test_closing_cavity);
  g_test_add_func("/film/campaign/kink", test_kink);
  g_test_add_func("/film/campaign/pressed", test_pressed);
  g_test_add_func("/film/campaign/rigid-in-pools", test_rigid_in_pools);
  g_test_add_func("/film/campaign/ends", test_ends);
  g_test_add_func("/film/campaign/nearly-open", test_nearly_open);
  g_test_add_func("/film/campaign/driven", test_driven);
  g_test_add_func("/film/campaign/thick-layers", test_thick_layers);
  g_test_add_func("/film/campaign/just-flooded", test_just_flooded);
  int failed = g_test_run();
  sb_film_solver_destroy(solver);
  return failed;
}
