// Film and asperities on a fitted body: the half-plane as a special case, the smooth and the dry
// limit on the disc's compliance by other methods, symmetry, and a run's seals.
#include "engine/contact/compliance.h"
#include "engine/valve/states/sliding.h"
#include "tests/engine/rough_cells.h"

#include "tests/engine/parabola.h"

#include <glib.h>
#include <math.h>

static const double RADIUS = 0.805e-3, YOUNG = 2.5e6, NU = 0.49;
static SbFilmSolver *solver;
static SbFilm film, other;
static SbFilmProfile profile[2];

static SbFilmProblem seal(double speed) {
  SbFilmProblem problem = rough_seal(speed, SB_ROUGH_GREENWOOD_TRIPP);
  problem.load = 300;
  problem.radius = RADIUS;
  problem.modulus = 2 * YOUNG / (1 - NU * NU);
  problem.sigma = 1e-7;
  return problem;
}

static SbSurfaceCompliance disc(void) {
  return disc_surface(RADIUS, YOUNG, NU);
}

static void solve(SbFilm *out, const SbFilmProblem *problem) {
  g_assert_cmpint(solve_cold(out, problem, &profile[out == &other], solver), ==, SB_OK);
  g_assert_true(out->solver.converged);
  g_assert_cmpfloat(out->solver.load_error, <, 1e-10);
}

// A parabola without smooth part is the half-plane, at rest and sliding, with pressures beside it.
static void test_half_plane(void) {
  static const struct {
    double speed, left, right;
  } point[] = {{0, 0, 0}, {1e-2, 0, 0}, {-0.3, 0, 0}, {1e-2, 2e5, 0}, {1, 1e5, 3e5}};
  for (size_t i = 0; i < G_N_ELEMENTS(point); i++) {
    SbFilmProblem problem = seal(point[i].speed);
    problem.pressure_left = point[i].left;
    problem.pressure_right = point[i].right;
    solve(&other, &problem);
    // The tilt that unequal pressures take out is the window's, here that of the half-plane's
    // contact.
    const double tilt = problem.pressure_left == problem.pressure_right
                            ? 0.0
                            : 4 / (G_PI * problem.modulus) *
                                  (problem.pressure_left - problem.pressure_right) *
                                  log(0.8 * RADIUS / other.hertz_half_width);
    const SbSurfaceCompliance c = parabola(problem.modulus, RADIUS, 0.8 * RADIUS, tilt);
    problem.compliance = &c;
    solve(&film, &problem);
    close_to("minimum film", film.film_min, other.film_min, 1e-6);
    close_to("central film", film.film_central, other.film_central, 1e-6);
    close_to("asperities' load", film.asperity_load, other.asperity_load, 1e-6);
    close_to("real area", film.real_area, other.real_area, 1e-6);
    close_to("largest pressure", film.pressure_max, other.pressure_max, 1e-6);
  }
}

// Vanishing roughness leaves the disc's smooth film, which another solver finds.
static void test_smooth_limit(void) {
  const SbSurfaceCompliance c = disc();
  static const double speed[] = {1e-2, -1, 10};
  for (size_t i = 0; i < G_N_ELEMENTS(speed); i++) {
    SbFilmProblem problem = seal(speed[i]);
    problem.compliance = &c;
    problem.sigma = 1e-13;
    problem.pressure_left = i == 1 ? 1e5 : 0;
    solve(&film, &problem);
    problem.surface = SB_ROUGH_NONE;
    solve(&other, &problem);
    g_test_message("speed %g: least %.2g, central %.2g, place %.2g", speed[i],
                   film.film_min / other.film_min - 1, film.film_central / other.film_central - 1,
                   film.position_film_min / other.position_film_min - 1);
    close_to("minimum film", film.film_min, other.film_min, 5e-5);
    close_to("central film", film.film_central, other.film_central, 5e-5);
    close_to("largest pressure", film.pressure_max, other.pressure_max, 5e-5);
    close_to("place of the least film", film.position_film_min, other.position_film_min, 5e-5);
    close_to("Couette", film.friction_couette, other.friction_couette, 5e-3);
    g_assert_cmpfloat(film.asperity_share, <, 1e-6);
    // Not the half-plane's.
    problem.compliance = NULL;
    solve(&other, &problem);
    g_assert_cmpfloat(film.film_central / other.film_central, <, 0.97);
  }
}

// The surface of the disc of a seal that is pressed by 32 %, with its load per length.
static SbSurfaceCompliance pressed_disc(double *load, SbModel *model) {
  static const struct {
    int key;
    double value;
  } setting[] = {
      {SB_P_BORE_DIAMETER, 4.658e-3},
      {SB_P_BORE_LAND_EDGE, 2.175e-3},
      {SB_P_GLAND_RADIAL_SPACE, 0.8843e-3},
      {SB_P_GLAND_AXIAL_WIDTH, 1.991e-3},
      {SB_P_SEAL_SECTION_DIAMETER, 1.254e-3},
      {SB_P_SEAL_INNER_DIAMETER, 2.784e-3},
      {SB_P_SEAL_MODULUS, 1.363e6},
      {SB_P_SEAL_POISSON_RATIO, 0.4999},
      {SB_P_STEM_PRESSURE_DIAMETER, 4.439e-3},
      {SB_P_STEM_SEAL_SPACING, 4.624e-3},
      {SB_P_STEM_ROD_DIAMETER, 2.014e-3},
      {SB_P_DRIVE_STROKE, 5.507e-3},
      {SB_P_MODELS_FIT, SB_FIT_DISC},
      {SB_P_CANISTER_PRESSURE, 0},
  };
  SbParams params;
  sb_params_init(&params);
  for (size_t i = 0; i < G_N_ELEMENTS(setting); i++) {
    g_assert_cmpint(sb_params_set(&params, setting[i].key, setting[i].value, NULL), ==, SB_OK);
  }
  g_assert_cmpint(sb_model_compile(model, &params, NULL, NULL), ==, SB_OK);
  SbSlidingMemory *memory = NULL;
  g_assert_cmpint(sb_sliding_memory_create(&memory, NULL), ==, SB_OK);
  const SbSealPressure pressure = {0};
  SbSealState state;
  SbCounters counts = {0};
  SbWarnings warnings = {0};
  const SbSlidingTask task = {.model = model,
                              .seal = SB_OUTER,
                              .speed = 0.01,
                              .memory = memory,
                              .counts = &counts,
                              .warnings = &warnings};
  g_assert_cmpint(sb_sliding_solve(&state, &task, NULL), ==, SB_OK);
  SbSurfaceCompliance c;
  g_assert_cmpint(sb_sliding_surface(&c, load, sb_sliding_fit(memory), model, SB_OUTER, pressure,
                                     &warnings, NULL),
                  ==, SB_OK);
  sb_sliding_memory_destroy(memory);
  return c;
}

// A fast film of the order of the roughness between asperities that carry almost nothing: Newton's
// method finds it, from the wrong cavity of its first, shortened steps on, and it is nearly the
// smooth film, which another solver finds.
static void test_weak_asperities(void) {
  static const double speed[] = {0.5, -1, 1.8, 3.82, -5};
  SbModel model;
  double load;
  const SbSurfaceCompliance c = pressed_disc(&load, &model);
  for (size_t i = 0; i < G_N_ELEMENTS(speed); i++) {
    SbFilmProblem problem = seal(speed[i]);
    problem.compliance = &c;
    problem.load = load;
    problem.radius = 0.5 * 1.254e-3;
    problem.modulus = model.seal[SB_OUTER].reduced_modulus;
    problem.sigma = 8e-7;
    problem.sigma_over_beta = 0.0174;
    problem.gt_product = 0.061;
    problem.viscosity = 1.2e-3;
    problem.tolerance = 3e-3;
    solve(&film, &problem);
    problem.surface = SB_ROUGH_NONE;
    solve(&other, &problem);
    g_test_message("%g m/s: film %.3g nm, asperities' share %.2g, central %.2g, least %.2g",
                   problem.speed, 1e9 * film.film_central, film.asperity_share,
                   film.film_central / other.film_central - 1, film.film_min / other.film_min - 1);
    // The asperities open the film by the fraction of the load that they carry, times a factor: the
    // inlet determines the film, and the fluid's pressure is lower there than in the middle.
    g_assert_cmpfloat(film.asperity_share, >, 1e-4);
    g_assert_cmpfloat(film.asperity_share, <, 0.02);
    const double opening[] = {film.film_central / other.film_central - 1,
                              film.film_min / other.film_min - 1};
    for (int k = 0; k < 2; k++) {
      g_assert_cmpfloat(opening[k], >, 0);
      g_assert_cmpfloat(opening[k], <, 3 * film.asperity_share);
    }
  }
}

// At rest: the rough disc's contact, by cells on the same compliance.
static void test_dry_contact(void) {
  const SbSurfaceCompliance c = disc();
  SbFilmProblem problem = seal(0);
  problem.compliance = &c;
  problem.sigma = 1e-5;
  solve(&film, &problem);
  SbDryContact dry;
  g_assert_cmpint(sb_dry_contact(&dry, &c, problem.load, 0, 0, NULL), ==, SB_OK);
  check_dry_contact(&film, &problem, dry.right);
}

// Sliding the other way under mirrored pressures mirrors a mixed film.
static void test_mirror(void) {
  const SbSurfaceCompliance c = disc();
  SbFilmProblem problem = seal(2e-2);
  problem.compliance = &c;
  problem.pressure_left = 0.08e6;
  solve(&film, &problem);
  g_assert_cmpfloat(film.asperity_share, >, 0.05);
  g_assert_cmpfloat(film.asperity_share, <, 0.95);
  problem.speed = -problem.speed;
  problem.pressure_right = problem.pressure_left;
  problem.pressure_left = 0;
  solve(&other, &problem);
  close_to("minimum film", other.film_min, film.film_min, 1e-7);
  close_to("its place", other.position_film_min, -film.position_film_min, 1e-7);
  close_to("asperities' load", other.asperity_load, film.asperity_load, 1e-7);
  close_to("boundary friction", other.friction_boundary, -film.friction_boundary, 1e-7);
  close_to("first point", other.x[0], -film.x[film.points - 1], 1e-12);
}

// A run with coupled asperities and a solved fitment has its film on the fitted body, at every
// pressure: the total pressure there is the fitment's but for the roughness.
static void run_seal(int fit_model) {
  SbParams params;
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED, NULL),
                  ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_FIT, fit_model, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_SURFACE_SIGMA, 2e-7, NULL), ==, SB_OK);
  // A ring without friction on floor and walls rolls; what rolls is no harder to start than to
  // move.
  g_assert_cmpint(sb_params_set(&params, SB_P_GLAND_FLOOR_FRICTION, 0.3, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_GLAND_WALL_FRICTION, 0.1, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_FRICTION_SHEAR_STRENGTH, 1e6, NULL), ==, SB_OK);
  SbModel model;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  SbSlidingMemory *memory = NULL;
  g_assert_cmpint(sb_sliding_memory_create(&memory, NULL), ==, SB_OK);
  for (int seal_side = 0; seal_side < SB_SEAL_COUNT; seal_side++) {
    const SbSealPressure pressure = sb_model_seal_pressure(&model, seal_side, SB_CHAMBER_AT_REST);
    SbSealState state;
    SbCounters counts = {0};
    SbWarnings warnings = {0};
    g_assert_cmpint(
        sb_sliding_solve(
            &state,
            &(SbSlidingTask){&model, seal_side, pressure, -1e-2, memory, &counts, &warnings, {0}},
            NULL),
        ==, SB_OK);
    g_assert_true(state.film_fitted);
    // Sliding, with a dragged ring once for each friction that drags it, and at rest.
    const size_t rounds = fit_model == SB_FIT_RING ? counts.ring_solves : 1;
    g_assert_cmpuint(counts.reynolds_solves, ==, rounds + 1);
    const SbFilm *solved = sb_sliding_film(memory);
    const SbFit *fit = sb_sliding_fit(memory);
    const double low = fmin(pressure.left, pressure.right);
    close_to("largest pressure", solved->pressure_max - low, fit->pressure_peak, 0.02);
    g_assert_cmpfloat(state.asperity_share, >, 0.05);
    g_assert_cmpfloat(state.asperity_share, <, 1);
    g_assert_cmpfloat(state.real_area_share, <, 1);
    g_assert_cmpfloat(state.friction_static, >, sb_sliding_friction(&state));
    // The half-plane's film is another, but of the same size.
    SbFilmProblem plane;
    sb_sliding_film_problem(&plane, &model, seal_side, pressure, state.load_net, -1e-2);
    plane.surface = SB_ROUGH_GREENWOOD_TRIPP;
    plane.gt_product = model.gt_product;
    plane.sigma = model.sigma;
    plane.sigma_over_beta = model.sigma_over_beta;
    solve(&other, &plane);
    const double ratio = state.film_central / other.film_central;
    g_test_message("%s seal: %.4g nm, on the half-plane %.4g nm", sb_seal_name(seal_side),
                   1e9 * state.film_central, 1e9 * other.film_central);
    g_assert_cmpfloat(fabs(ratio - 1), >, 1e-4); // the inner ring's: 6e-4
    g_assert_cmpfloat(fabs(ratio - 1), <, 0.3);
  }
  sb_sliding_memory_destroy(memory);
}

static void test_run_disc(void) {
  run_seal(SB_FIT_DISC);
}

static void test_run_ring(void) {
  run_seal(SB_FIT_RING);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_assert_cmpint(sb_film_solver_create(&solver, NULL), ==, SB_OK);
  g_test_add_func("/film/mixed-fitted/half-plane", test_half_plane);
  g_test_add_func("/film/mixed-fitted/smooth-limit", test_smooth_limit);
  g_test_add_func("/film/mixed-fitted/weak-asperities", test_weak_asperities);
  g_test_add_func("/film/mixed-fitted/dry-contact", test_dry_contact);
  g_test_add_func("/film/mixed-fitted/mirror", test_mirror);
  g_test_add_func("/film/mixed-fitted/run-disc", test_run_disc);
  g_test_add_func("/film/mixed-fitted/run-ring", test_run_ring);
  int failed = g_test_run();
  sb_film_solver_destroy(solver);
  return failed;
}
