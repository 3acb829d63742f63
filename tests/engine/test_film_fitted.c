// Film on a fitted body: the half-plane as a special case, the disc's compliance against another
// discretisation of the same equations, symmetry, the limit of thin films.
#include "tests/engine/films.h"
#include "tests/engine/parabola.h"

#include <glib.h>
#include <math.h>

#include "engine/contact/compliance.h"
#include "engine/film/ehl_transient.h"
#include "engine/valve/states/sliding.h"

static const double RADIUS = 0.75e-3, YOUNG = 2.5e6, NU = 0.49;

static SbFilmProblem seal(double M, double load) {
  SbFilmProblem p;
  sb_film_problem_init(&p);
  p.radius = RADIUS;
  p.modulus = 2.0 * YOUNG / (1.0 - NU * NU);
  p.viscosity = 0.211e-3;
  p.load = load;
  const double ER = p.modulus * p.radius;
  p.speed = load * load / (ER * M * M) / p.viscosity;
  if (p.speed > 100.0) {
    p.viscosity *= p.speed / 100.0;
    p.speed = 100.0;
  }
  return p;
}

static void solve(SbFilm *out, const SbFilmProblem *p) {
  static SbFilmProfile profile; // of the last film
  g_assert_cmpint(solve_cold(out, p, &profile, NULL), ==, SB_OK);
  g_assert_true(out->solver.converged);
}

// A parabola without smooth part gives the half-plane's film to rounding, as fast.
static void test_half_plane(void) {
  const double M[] = {2.0, 20.0, 1000.0, 44000.0};
  SbFilm *plain = g_new(SbFilm, 1);
  SbFilm *fitted = g_new(SbFilm, 1);
  for (int i = 0; i < 4; i++) {
    SbFilmProblem p = seal(M[i], 200.0);
    solve(plain, &p);
    const SbSurfaceCompliance c = parabola(p.modulus, RADIUS, 0.8 * RADIUS, 0.0);
    p.compliance = &c;
    solve(fitted, &p);
    g_assert_cmpfloat_with_epsilon(fitted->film_min / plain->film_min, 1.0, 1e-8);
    g_assert_cmpfloat_with_epsilon(fitted->film_central / plain->film_central, 1.0, 1e-8);
    g_assert_cmpfloat_with_epsilon(fitted->friction_couette / plain->friction_couette, 1.0, 1e-8);
    g_assert_cmpint(fitted->solver.newton_iterations, <=, plain->solver.newton_iterations);
    g_assert_cmpfloat(fitted->solver.load_error, <, 1e-10);
  }
  g_free(plain);
  g_free(fitted);
}

// The disc's film by spectral elements with a free rupture, and by finite volumes with
// complementarity and a dense kernel.
static void test_disc(void) {
  const double M[] = {20.0, 1000.0, 44000.0, 44000.0, 1000.0};
  SbFilm *film = g_new(SbFilm, 1);
  SbFilm *other = g_new(SbFilm, 1);
  const SbSurfaceCompliance c = disc_surface(RADIUS, YOUNG, NU);
  for (int i = 0; i < 5; i++) {
    SbFilmTransientProblem t = {.film = seal(M[i], 300.0)};
    t.film.compliance = &c;
    t.film.pressure_left = i == 3 ? 0.1e6 : 0.0;
    t.film.pressure_right = i == 4 ? 0.1e6 : 0.0;
    t.film.tolerance = 3e-4;
    t.speed_scale = t.film.speed;
    solve(film, &t.film);
    SbFilmTransient *transient = NULL;
    g_assert_cmpint(sb_film_transient_create(&transient, &t, NULL), ==, SB_OK);
    const SbFilmTransientResult result = sb_film_transient_result(transient);
    g_assert_cmpfloat_with_epsilon(result.film_min / film->film_min, 1.0, 1e-3);
    g_assert_cmpfloat_with_epsilon(result.film_central / film->film_central, 1.0, 2e-4);
    double peak = 0.0;
    for (int k = 0; k < transient->nodes; k++) {
      peak = fmax(peak, transient->now.P[k] * transient->scale.pressure);
    }
    g_assert_cmpfloat_with_epsilon(peak / film->pressure_max, 1.0, 1e-4);
    g_assert_cmpfloat(film->solver.load_error, <, 1e-10);
    // The film presses on the contact of the dry disc.
    SbDryContact dry;
    g_assert_cmpint(
        sb_dry_contact(&dry, &c, t.film.load, t.film.pressure_left, t.film.pressure_right, NULL),
        ==, SB_OK);
    if (i >= 2) {
      g_assert_cmpfloat_with_epsilon(film->pressure_max / dry.peak, 1.0, 2e-3);
    }
    // A disc's compliance takes some 10 % off the half-plane's film at this load.
    t.film.compliance = NULL;
    solve(other, &t.film);
    g_assert_cmpfloat(film->film_central / other->film_central, <, 0.95);
    sb_film_transient_destroy(transient);
  }
  g_free(film);
  g_free(other);
}

// Sliding the other way under mirrored pressures mirrors the film.
static void test_mirror(void) {
  const SbSurfaceCompliance c = disc_surface(RADIUS, YOUNG, NU);
  SbFilm *one = g_new(SbFilm, 1);
  SbFilm *two = g_new(SbFilm, 1);
  SbFilmProblem p = seal(5000.0, 250.0);
  p.compliance = &c;
  p.pressure_left = 0.08e6;
  solve(one, &p);
  p.speed = -p.speed;
  p.pressure_right = p.pressure_left;
  p.pressure_left = 0.0;
  solve(two, &p);
  g_assert_cmpfloat_with_epsilon(two->film_min / one->film_min, 1.0, 1e-7);
  g_assert_cmpfloat_with_epsilon(two->position_film_min / one->position_film_min, -1.0, 1e-7);
  g_assert_cmpfloat_with_epsilon(two->friction_couette / one->friction_couette, -1.0, 1e-7);
  g_free(one);
  g_free(two);
}

// Thin films hang on the edges and their slopes only: a gap matched to the dry pressure gives the
// same film without the smooth part; thick films do not forgive that.
static void test_matched(void) {
  const SbSurfaceCompliance c = disc_surface(RADIUS, YOUNG, NU);
  SbFilm *film = g_new(SbFilm, 1);
  SbFilm *other = g_new(SbFilm, 1);
  const double M[] = {20.0, 44000.0};
  double distance[2];
  for (int i = 0; i < 2; i++) {
    SbFilmProblem p = seal(M[i], 300.0);
    p.compliance = &c;
    solve(film, &p);
    SbDryContact dry;
    g_assert_cmpint(sb_dry_contact(&dry, &c, p.load, 0.0, 0.0, NULL), ==, SB_OK);
    double x[201], pressure[201];
    for (int k = 0; k < 201; k++) {
      x[k] = dry.left + 0.5 * (dry.right - dry.left) * (1.0 - cos(G_PI * k / 200));
      pressure[k] = sb_dry_contact_pressure(&dry, x[k]);
    }
    SbSurfaceCompliance matched = c;
    for (int k = 0; k < c.modes; k++) {
      for (int l = 0; l < c.modes; l++) {
        matched.smooth[k][l] = 0.0;
      }
    }
    g_assert_cmpint(sb_compliance_match(&matched, 8, 201, x, pressure, 0.0, 0.0, NULL), ==, SB_OK);
    p.compliance = &matched;
    solve(other, &p);
    distance[i] = fabs(other->film_central / film->film_central - 1.0);
  }
  g_assert_cmpfloat(distance[1], <, 1e-3);
  g_assert_cmpfloat(distance[0], >, distance[1]);
  g_free(film);
  g_free(other);
}

// At rest the dry contact comes out; another modulus than the surface's is refused.
static void test_edges(void) {
  const SbSurfaceCompliance c = disc_surface(RADIUS, YOUNG, NU);
  SbFilm *film = g_new(SbFilm, 1);
  SbFilmProblem p = seal(1000.0, 250.0);
  p.compliance = &c;
  p.speed = 0.0;
  solve(film, &p);
  double load = 0.0;
  for (size_t i = 1; i < film->points; i++) {
    load += 0.5 * (film->pressure[i] + film->pressure[i - 1]) * (film->x[i] - film->x[i - 1]);
    g_assert_cmpfloat(film->film[i], >=, 0.0);
  }
  g_assert_cmpfloat_with_epsilon(load / p.load, 1.0, 1e-3);
  g_assert_cmpfloat(film->film_min, ==, 0.0);
  p = seal(1000.0, 250.0);
  p.compliance = &c;
  p.modulus *= 1.01;
  g_assert_cmpint(sb_film_solve(film, &p, NULL, NULL), ==, SB_ERROR_INPUT);
  p = seal(1000.0, 3000.0); // wider than the window
  p.compliance = &c;
  g_assert_cmpint(sb_film_solve(film, &p, NULL, NULL), !=, SB_OK);
  g_assert_false(film->solver.converged);
  g_free(film);
}

// In a run the film lies on the fitted disc: its dry contact is the fitment's, and the half-plane's
// film stays beside it for comparison.
static void test_run(void) {
  SbParams params;
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_FIT, SB_FIT_DISC, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_FILM, SB_FILM_REYNOLDS, NULL), ==, SB_OK);
  SbModel model;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  SbSlidingMemory *memory = NULL;
  g_assert_cmpint(sb_sliding_memory_create(&memory, NULL), ==, SB_OK);
  for (int chamber = 0; chamber < 3; chamber++) {
    const SbSealPressure pressure = sb_model_seal_pressure(&model, SB_OUTER, (SbChamber)chamber);
    SbSealState state;
    SbCounters counts = {0};
    SbWarnings warnings = {0};
    g_assert_cmpint(
        sb_sliding_solve(
            &state,
            &(SbSlidingTask){
                &model, SB_OUTER, pressure, model.speed, memory, &counts, &warnings, {0}},
            NULL),
        ==, SB_OK);
    g_assert_true(state.film_fitted);
    g_assert_cmpuint(counts.reynolds_solves, ==, 2);
    g_assert_cmpfloat(fabs(state.film_central / state.film_reynolds - 1.0), >, 0.01);
    g_assert_cmpfloat(fabs(state.film_central / state.film_reynolds - 1.0), <, 0.3);
    const SbFit *fit = sb_sliding_fit(memory);
    SbSurfaceCompliance c;
    double load;
    g_assert_cmpint(sb_sliding_surface(&c, &load, fit, &model, SB_OUTER, pressure, NULL, NULL), ==,
                    SB_OK);
    SbDryContact dry;
    g_assert_cmpint(sb_dry_contact(&dry, &c, load, pressure.left, pressure.right, NULL), ==, SB_OK);
    g_assert_cmpfloat_with_epsilon(dry.left / fit->contact_left, 1.0, 1e-3);
    g_assert_cmpfloat_with_epsilon(dry.right / fit->contact_right, 1.0, 1e-3);
    const double low = fmin(pressure.left, pressure.right);
    g_assert_cmpfloat_with_epsilon((dry.peak - low) / fit->pressure_peak, 1.0, 1e-3);
    // The film's own pressure is the fitment's but for the layers.
    g_assert_cmpfloat_with_epsilon(
        (sb_sliding_film(memory)->pressure_max - low) / fit->pressure_peak, 1.0, 2e-3);
  }
  sb_sliding_memory_destroy(memory);
}

static void solve_ring(SbSealState *out, SbDryContact *dry, double *modulus, double tolerance,
                       int chamber, double speed) {
  SbParams params;
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_FIT, SB_FIT_RING, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_FILM, SB_FILM_REYNOLDS, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_TOLERANCE, tolerance, NULL), ==, SB_OK);
  // The drag of the default strength would roll the ring.
  g_assert_cmpint(sb_params_set(&params, SB_P_GLAND_FLOOR_FRICTION, 0.3, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_GLAND_WALL_FRICTION, 0.1, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_FRICTION_SHEAR_STRENGTH, 1e6, NULL), ==, SB_OK);
  SbModel model;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  SbSlidingMemory *memory = NULL;
  g_assert_cmpint(sb_sliding_memory_create(&memory, NULL), ==, SB_OK);
  const int seal = chamber == 0 ? SB_OUTER : SB_INNER;
  const SbSealPressure pressure = sb_model_seal_pressure(&model, seal, SB_CHAMBER_AT_REST);
  SbCounters counts = {0};
  SbWarnings warnings = {0};
  g_assert_cmpint(
      sb_sliding_solve(
          out, &(SbSlidingTask){&model, seal, pressure, speed, memory, &counts, &warnings, {0}},
          NULL),
      ==, SB_OK);
  for (size_t i = 0; i < warnings.count; i++) {
    g_assert_cmpstr(warnings.item[i].code, !=, "film-disc-surface");
    g_assert_cmpstr(warnings.item[i].code, !=, "film-half-plane");
  }
  // The surface is the ring's, not the disc's.
  const SbFit *fit = sb_sliding_fit(memory);
  g_assert_cmpint(fit->surface.modes, >, 0);
  SbSurfaceCompliance c;
  double load;
  g_assert_cmpint(sb_sliding_surface(&c, &load, fit, &model, seal, pressure, NULL, NULL), ==,
                  SB_OK);
  *modulus = c.modulus;
  g_assert_cmpfloat(c.modulus, >, 1.01 * model.seal[seal].reduced_modulus);
  g_assert_cmpint(sb_dry_contact(dry, &c, load, pressure.left, pressure.right, NULL), ==, SB_OK);
  sb_sliding_memory_destroy(memory);
}

// In a run with solved rings the film lies on the ring's own surface. A thin film hangs on nothing
// but the strength K of the pressure's root at its inlet, p ~ K sqrt(distance), and on the modulus:
// a Hertz contact on a half-plane with the same two carries the same flux; and another mesh of the
// ring gives the same film within the error told.
static void test_ring(void) {
  SbFilm *plane = g_new(SbFilm, 1);
  static const double SPEED[] = {20e-3 / 60.0, -20e-3 / 60.0};
  for (int k = 0; k < 4; k++) {
    const int chamber = k / 2;
    const double speed = SPEED[k % 2];
    SbSealState coarse, fine;
    SbDryContact dry;
    double modulus;
    solve_ring(&fine, &dry, &modulus, 3e-4, chamber, speed);
    solve_ring(&coarse, &dry, &modulus, 1e-3, chamber, speed);
    g_assert_true(coarse.film_fitted && fine.film_fitted);
    const double truth = fabs(coarse.film_central / fine.film_central - 1.0);
    g_test_message("film %.4g, on the finer ring %.4g nm (%.2g, estimate %.2g), half-plane %.4g nm",
                   1e9 * coarse.film_central, 1e9 * fine.film_central, truth, coarse.film_error,
                   1e9 * coarse.film_reynolds);
    g_assert_cmpfloat(truth, <=, coarse.film_error);
    g_assert_cmpfloat(coarse.film_error, <, 0.08);

    const double half = 0.5 * (dry.right - dry.left);
    const double K = (speed > 0.0 ? dry.edge_left : dry.edge_right) * sqrt(2.0 / half);
    SbFilmProblem p;
    sb_film_problem_init(&p);
    p.modulus = modulus;
    p.viscosity = 0.211e-3;
    p.speed = fabs(speed);
    if (chamber == 1) {
      p.pressure_left = dry.pressure_left;
      p.pressure_right = dry.pressure_right;
    }
    p.radius = modulus * sqrt(2.0 * half) / (4.0 * K);
    p.load = G_PI * modulus * half * half / (8.0 * p.radius);
    solve(plane, &p);
    g_test_message("Hertz contact of the same root: %.4g nm", 1e9 * plane->film_central);
    g_assert_cmpfloat(fabs(plane->film_central / coarse.film_central - 1.0), <, 0.01);
    // The least film hangs on the outlet's root too, which friction makes another.
  }
  g_free(plane);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/film-fitted/half-plane", test_half_plane);
  g_test_add_func("/film-fitted/disc", test_disc);
  g_test_add_func("/film-fitted/mirror", test_mirror);
  g_test_add_func("/film-fitted/matched", test_matched);
  g_test_add_func("/film-fitted/edges", test_edges);
  g_test_add_func("/film-fitted/run", test_run);
  g_test_add_func("/film-fitted/ring", test_ring);
  return g_test_run();
}
