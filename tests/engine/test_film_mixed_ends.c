// Film and asperities in one solve: its ends and supply, starts near a solved film, adhesion,
// sticking and sliding contacts, thin layers, and what is refused.
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

static void test_ends(void) {
  // Either direction with the pressures mirrored is the same contact; at rest the end pressures'
  // flow through the gap is what slow sliding tends to.
  static const double left[] = {5.5e5, 0, 3e5}, right[] = {0, 5.5e5, 5.5e5};
  for (int i = 0; i < 3; i++) {
    for (double speed = 1e-7; speed < 2; speed *= 100) {
      SbFilmProblem problem = rough_seal(speed, SB_ROUGH_GREENWOOD_TRIPP);
      problem.pressure_left = left[i];
      problem.pressure_right = right[i];
      g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
      g_assert_cmpfloat(film.solver.load_error, <, 1e-10);
      problem.pressure_left = right[i];
      problem.pressure_right = left[i];
      problem.speed = -speed;
      g_assert_cmpint(solve(&other, &problem), ==, SB_OK);
      close_to("mirrored film", other.film_min, film.film_min, 1e-9);
      close_to("mirrored place", -other.position_film_min, film.position_film_min, 1e-6);
      g_assert_cmpfloat(film.friction_boundary * other.friction_boundary, <, 0);
      if (speed < 1e-6) {
        problem.speed = 0;
        g_assert_cmpint(solve(&other, &problem), ==, SB_OK);
        close_to("rest", other.film_central, film.film_central, 3e-3);
      }
    }
  }
}

// A starved inlet: the contact passes what the wall brings, and the smooth limit is the film that
// the smooth solver finds with its own meniscus.
static void test_starved(void) {
  SbFilmProblem problem = rough_seal(1e-2, SB_ROUGH_GREENWOOD_TRIPP);
  problem.inlet_film = 1e-8; // of 12.8 nm that the flooded contact takes
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  g_assert_true(film.starved);
  close_to("flux film", film.film_flux, 2 * problem.inlet_film, 1e-9);
  g_assert_cmpfloat(film.solver.load_error, <, 1e-10);
  problem.sigma = 1e-12;
  problem.inlet_film = 2e-9;
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  problem.surface = SB_ROUGH_NONE;
  g_assert_cmpint(solve(&other, &problem), ==, SB_OK);
  close_to("minimum film", film.film_min, other.film_min, 5e-4);
  close_to("central film", film.film_central, other.film_central, 5e-4);
  // More than it takes: flooded.
  problem = rough_seal(1e-2, SB_ROUGH_GREENWOOD_TRIPP);
  problem.inlet_film = 1e-6;
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  g_assert_false(film.starved);
  // Four fifths of what the contact takes beside an outlet under pressure: from the flooded film
  // a first step of a few per cent does not find the meniscus, and Newton's method soon sees it.
  problem = rough_seal(-1.778279e-3, SB_ROUGH_GREENWOOD_TRIPP);
  problem.load = 925.1755319;
  problem.radius = 1.249265362e-3;
  problem.modulus = 7010612.123;
  problem.viscosity = 0.3866857e-3;
  problem.pressure_left = 780306.4895;
  problem.gt_product = 0.1258273433;
  problem.sigma = 0.3752124569e-6;
  problem.sigma_over_beta = 0.02077981423;
  problem.inlet_film = 3.836921577e-9;
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  g_assert_true(film.starved);
  close_to("flux film", film.film_flux, 2 * problem.inlet_film, 1e-9);
  g_assert_cmpint(film.solver.newton_iterations, <, 100);
}

// A closed contact at rest is determined by its pressure: the rounding of the deflections, which is
// larger than the gap, is no error of real area and load, and a small tolerance is met. The kink of
// a real area that reaches the nominal one between two nodes adds no error.
static void test_closed_errors(void) {
  static const SbRoughModel surface[] = {SB_ROUGH_PERSSON, SB_ROUGH_GREENWOOD_TRIPP};
  for (size_t i = 0; i < G_N_ELEMENTS(surface); i++) {
    SbFilmProblem problem = rough_seal(0, surface[i]);
    problem.sigma = 0.2e-6;
    problem.gt_product = i == 0 ? problem.gt_product : 0.3;
    problem.tolerance = 1e-6;
    g_assert_cmpint(solve(&other, &problem), ==, SB_OK);
    problem.tolerance = 0.1;
    g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
    const double estimate = film.solver.error_contact;
    const double area = fabs(film.real_area / other.real_area - 1);
    const double load = fabs(film.asperity_load / other.asperity_load - 1);
    g_test_message("least gap %.3g m, share %.6f, contact %.2g, area %.2g, load %.2g",
                   other.film_min, other.real_area_share, estimate, area, load);
    g_assert_cmpfloat(fmax(area, load), <=, 3 * estimate);
    g_assert_cmpfloat(estimate, <=, fmax(30 * fmax(area, load), 1e-7));
  }
}

// Films near a solved one on its mesh: another speed, load and supply; none that is starved, and
// at rest none of another flow.
static void test_near(void) {
  static const double ends[][2] = {{0, 0}, {5.5e5, 0}, {4e5, 4e5}};
  static const double places[][2] = {{1.1, 1}, {1 / 1.1, 1}, {1, 1.01}, {1.1, 0.99}};
  for (size_t i = 0; i < G_N_ELEMENTS(ends); i++) {
    SbFilmProblem problem = rough_seal(1e-3, SB_ROUGH_PERSSON);
    problem.pressure_left = ends[i][0];
    problem.pressure_right = ends[i][1];
    problem.tolerance = 1e-2;
    SbFilmSolver *own;
    g_assert_cmpint(sb_film_solver_create(&own, NULL), ==, SB_OK);
    g_assert_cmpint(sb_film_solve(&film, &problem, own, NULL), ==, SB_OK);
    const int cold = film.solver.newton_iterations;
    const double flux = film.film_flux, contact = film.solver.error_contact;
    for (size_t k = 0; k < G_N_ELEMENTS(places); k++) {
      SbFilmProblem near = problem;
      near.speed *= places[k][0];
      near.load *= places[k][1];
      near.place = SB_FILM_ALONE;
      near.tolerance = 1e-6;
      g_assert_cmpint(solve(&other, &near), ==, SB_OK);
      near.place = SB_FILM_NEAR;
      near.tolerance = problem.tolerance;
      near.inlet_film = flux; // twice of what it takes
      g_assert_cmpint(sb_film_solve(&film, &near, own, NULL), ==, SB_OK);
      const SbFilmSolverInfo *info = &film.solver;
      close_to("least", film.film_min, other.film_min, 3 * info->error_film_min);
      close_to("centre", film.film_central, other.film_central, 3 * info->error_film_central);
      close_to("area", film.real_area, other.real_area, 3 * info->error_contact);
      g_assert_cmpfloat(info->error_film_central, <, 1e-4);
      g_assert_cmpfloat(info->error_contact, ==, contact);
      g_assert_cmpint(info->newton_iterations, <, cold);
      near.inlet_film = 0.4 * flux;
      g_assert_cmpint(sb_film_solve(&film, &near, own, NULL), ==, SB_ERROR_NOT_CONVERGED);
    }
    sb_film_solver_destroy(own);
  }
}

static void test_adhesion(void) {
  // Across an open rough gap the pull is small and thins the film; the reference's digits.
  SbFilmProblem problem = rough_seal(1e-4, SB_ROUGH_GREENWOOD_TRIPP);
  problem.sigma = 2e-7;
  problem.modulus = 6.5725154e6;
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  problem.hamaker = 1.35e-19;
  g_assert_cmpint(solve(&other, &problem), ==, SB_OK);
  g_assert_false(warned(&other.warnings, "film-snap-in"));
  close_to("film without the pull", film.film_min * 1e9, 2.6209, 5e-5);
  close_to("film with the pull", other.film_min * 1e9, 2.6126, 5e-5);
  // The pull adds to what presses: asperities carry a smaller share of that than of the net load.
  g_test_message("share %.8g, of the net load %.8g", other.asperity_share,
                 other.asperity_load / problem.load);
  g_assert_cmpfloat_with_epsilon(film.asperity_share, film.asperity_load / problem.load, 1e-12);
  g_assert_cmpfloat(other.asperity_share * (1 + 1e-6), <, other.asperity_load / problem.load);
  // Nor is a pressure that hardly rises as the gap closes (by a hundredth of the asperities' own
  // slope at the worst) mistaken for a window: solved, at rest.
  problem = rough_seal(0, SB_ROUGH_GREENWOOD_TRIPP);
  problem.load = 409.0465;
  problem.gt_product = 0.09023;
  problem.hamaker = 1.35e-19;
  g_assert_cmpint(solve(&other, &problem), ==, SB_OK);
  g_assert_false(warned(&other.warnings, "film-snap-in"));
  g_assert_cmpfloat(other.asperity_load, >, 1.05 * problem.load); // adhesion adds to the load
  // Without asperities a film of tens of nanometres feels A/(6 pi h^3) as that much more load.
  problem = rough_seal(0.1, SB_ROUGH_NONE);
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  problem.hamaker = 1.35e-19;
  g_assert_cmpint(solve(&other, &problem), ==, SB_OK);
  g_assert_false(warned(&other.warnings, "film-snap-in"));
  g_assert_cmpfloat(other.film_central, <, film.film_central);
  // The contact's total pressure stays Hertz's; the pull adds to what the film bears there.
  double pull = sb_vdw_attraction(problem.hamaker, other.film_central);
  double thinner = 1 - other.film_central / film.film_central;
  g_test_message("pull %.3g Pa of %.3g, film thinner by %.3g", pull, film.pressure_max, thinner);
  g_assert_cmpfloat(thinner, <, 5 * pull / film.pressure_max);
}

// Tips that stick: more real contact and a thinner film, which sums up to the load; nothing where
// the surfaces never touch; told where the film cannot be; the dry contact pressed together anyhow.
static void test_sticking(void) {
  SbFilmProblem problem = rough_seal(1e-2, SB_ROUGH_GREENWOOD_TRIPP);
  problem.sigma = 2e-7;
  double area = 0, least = INFINITY;
  const double works[] = {0, 1e-4, 1e-3, 1e-2};
  for (size_t k = 0; k < G_N_ELEMENTS(works); k++) {
    problem.work_of_adhesion = works[k];
    g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
    g_assert_false(warned(&film.warnings, "film-snap-in"));
    g_assert_cmpfloat(film.real_area, >, area);
    g_assert_cmpfloat(film.film_min, <, least);
    g_assert_cmpfloat(film.solver.load_error, <, 1e-9);
    g_assert_cmpint(film.solver.continuation_steps, <, 5);
    close_to("boundary", film.friction_boundary, 3.5e6 * film.real_area + 0.19 * film.asperity_load,
             1e-12);
    area = film.real_area;
    least = film.film_min;
  }
  g_assert_true(warned(&film.warnings, "adhesion-dense"));
  problem.work_of_adhesion = 0.1315;
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  g_assert_true(warned(&film.warnings, "film-snap-in"));
  problem.speed = 0;
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  g_assert_false(warned(&film.warnings, "film-snap-in"));
  g_assert_cmpfloat(film.asperity_share, ==, 1);
  g_assert_cmpfloat(film.asperity_load, >, 2 * problem.load); // adhesion adds to the load
  problem.speed = 1;
  problem.sigma = 1e-8;
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  g_assert_false(warned(&film.warnings, "film-snap-in"));
  problem.hamaker = 1e-19;
  g_assert_cmpint(sb_film_solve(&film, &problem, NULL, NULL), ==, SB_ERROR_INPUT);
}

// Two films with adhesion and pressure at their outlet, on a rough and soft surface, whose start is
// the contact at rest. Newton's method moves that contact by more than three gaps after eight steps
// (valve 979 of the campaign random-valves, seed 1).
static void test_sealed_start(void) {
  static const double inlets[] = {0, 1182639.04};
  for (size_t i = 0; i < G_N_ELEMENTS(inlets); i++) {
    SbFilmProblem problem = rough_seal(4.45715690e-3, SB_ROUGH_PERSSON);
    problem.load = 239.796822;
    problem.radius = 0.565727767e-3;
    problem.modulus = 6.24601645e6;
    problem.viscosity = 0.66254963e-3;
    problem.pressure_left = inlets[i];
    problem.pressure_right = 1182639.04;
    problem.gt_product = 0.117128708;
    problem.sigma = 3.49254785e-6;
    problem.sigma_over_beta = 0.0227442998;
    problem.hamaker = 2.30976807e-19;
    g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
    g_assert_cmpfloat(film.solver.load_error, <, 1e-9);
    g_assert_cmpfloat(film.solver.error_film_min, <, 1e-3);
    // From the contact at rest there are a few steps; by faster films there would be 10 and more.
    g_assert_cmpint(film.solver.continuation_steps, <, 10);
  }
}

// Every film with adhesion is solved, or told to snap in and then the film without: from rest to
// the full film, rough to smooth, at thirty times the usual pull.
static void test_snap_in(void) {
  static const double sigmas[] = {2e-7, 1e-7, 5e-8, 2e-8, 0};
  static const double speeds[] = {0, 1e-6, 1e-4, 1e-3, 1e-2, 0.1};
  int snapped = 0, pulled = 0;
  for (size_t k = 0; k < G_N_ELEMENTS(sigmas) * G_N_ELEMENTS(speeds) * 4; k++) {
    double sigma = sigmas[k % G_N_ELEMENTS(sigmas)];
    double speed = speeds[k / G_N_ELEMENTS(sigmas) % G_N_ELEMENTS(speeds)];
    int rest = (int)(k / G_N_ELEMENTS(sigmas) / G_N_ELEMENTS(speeds)); // model and pull
    SbRoughModel model = sigma == 0 ? SB_ROUGH_NONE : (SbRoughModel)(1 + rest % 2);
    if (!g_test_slow() && k % 3 != 0) {
      continue;
    }
    SbFilmProblem problem = rough_seal(speed, model);
    problem.sigma = sigma;
    g_assert_cmpint(solve(&other, &problem), ==, SB_OK);
    problem.hamaker = rest / 2 == 0 ? 1.35e-19 : 4e-18;
    SbStatus status = solve(&film, &problem);
    g_test_message("sigma %g, %g m/s, model %d, pull %g: %s, %.4g nm of %.4g", sigma, speed,
                   (int)model, problem.hamaker,
                   warned(&film.warnings, "film-snap-in") ? "snaps in" : "solved",
                   1e9 * film.film_min, 1e9 * other.film_min);
    g_assert_cmpint(status, ==, SB_OK);
    g_assert_true(film.solver.converged);
    if (warned(&film.warnings, "film-snap-in")) {
      snapped++;
      g_assert_cmpfloat(film.film_min, ==, other.film_min);
      g_assert_cmpstr(film.regime, ==, "boundary");
      g_assert_false(film.valid);
    } else {
      pulled++;
      g_assert_cmpfloat(film.film_min, !=, other.film_min);
    }
  }
  g_assert_cmpint(snapped, >=, 8);
  g_assert_cmpint(pulled, >=, 8);
}

// A seal's sliding state with the asperities coupled: its friction is that of the solved split.
static void test_sliding(void) {
  SbParams params;
  sb_params_init(&params);
  SbModel model;
  g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED, NULL),
                  ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_SURFACE_SIGMA, 2e-7, NULL), ==, SB_OK);
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  SbSlidingMemory *memory = NULL;
  SbCounters counts = {0};
  SbWarnings warnings = {0};
  SbSealState state;
  g_assert_cmpint(sb_sliding_memory_create(&memory, NULL), ==, SB_OK);
  SbSealPressure pressure = {5.5e5, 0};
  g_assert_cmpint(
      sb_sliding_solve(
          &state,
          &(SbSlidingTask){&model, SB_OUTER, pressure, 1e-2, memory, &counts, &warnings, {0}},
          NULL),
      ==, SB_OK);
  const SbFilm *solved = sb_sliding_film(memory);
  g_assert_cmpfloat(solved->asperity_share, >, 0.05);
  g_assert_cmpfloat(solved->asperity_share, <, 0.95);
  double area = (state.contact_right - state.contact_left) * model.bore_circumference;
  double share = solved->real_area / (2 * solved->hertz_half_width);
  close_to("real area", state.boundary_area, model.shear_strength * share * area, 1e-12);
  close_to("asperities' load", state.boundary_load,
           model.load_coefficient * solved->asperity_share * state.load_net * state.load /
               state.load_per_length,
           1e-9);
  // Breaking away takes the dry contact, so more than sliding over the film.
  g_assert_cmpfloat(state.friction_static, >, sb_sliding_friction(&state));
  // Faster: more film, less friction at the boundary.
  SbSealState faster;
  g_assert_cmpint(
      sb_sliding_solve(
          &faster, &(SbSlidingTask){&model, SB_OUTER, pressure, 1, memory, &counts, &warnings, {0}},
          NULL),
      ==, SB_OK);
  g_assert_cmpfloat(faster.film_central, >, state.film_central);
  g_assert_cmpfloat(faster.boundary_area, <, state.boundary_area);
  close_to("the same break-away", faster.friction_static, state.friction_static, 1e-12);
  // Adhesion reaches the run where it is asked for.
  g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_ADHESION, 1, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_SURFACE_HAMAKER_CONSTANT, 1e-18, NULL), ==, SB_OK);
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  SbSealState pulled;
  g_assert_cmpint(
      sb_sliding_solve(
          &pulled,
          &(SbSlidingTask){&model, SB_OUTER, pressure, 1e-2, memory, &counts, &warnings, {0}},
          NULL),
      ==, SB_OK);
  g_assert_cmpfloat(pulled.film_central, <, state.film_central);
  // So do tips that stick: more real contact sliding and at rest, beside the film as well.
  g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_ADHESION, SB_MODEL_ADHESION_ASPERITIES, NULL),
                  ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_SURFACE_WORK_OF_ADHESION, 1e-2, NULL), ==, SB_OK);
  for (int coupled = 1; coupled >= 0; coupled--) {
    g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_ASPERITIES, coupled, NULL), ==, SB_OK);
    SbSealState stuck[2];
    for (int k = 0; k < 2; k++) {
      g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_ADHESION,
                                    k == 0 ? SB_MODEL_ADHESION_OFF : SB_MODEL_ADHESION_ASPERITIES,
                                    NULL),
                      ==, SB_OK);
      g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
      sb_sliding_memory_forget(memory);
      g_assert_cmpint(
          sb_sliding_solve(
              &stuck[k],
              &(SbSlidingTask){&model, SB_OUTER, pressure, 1e-2, memory, &counts, &warnings, {0}},
              NULL),
          ==, SB_OK);
    }
    g_assert_cmpfloat(stuck[1].boundary_area, >, 1.1 * stuck[0].boundary_area);
    g_assert_cmpfloat(stuck[1].rest_area_share, >=, stuck[0].rest_area_share);
    g_assert_cmpfloat(stuck[1].friction_static, >, 1.01 * stuck[0].friction_static);
  }
  sb_sliding_memory_destroy(memory);
}

// Layers of 1e-7 half-widths ask for more elements than there is room for at a second level: those
// that grow faster find what the first level of the others does (printed digits, degree 4).
static void test_thin_layers(void) {
  SbFilmProblem problem = rough_seal(-0.131651543721857e-3, SB_ROUGH_GREENWOOD_TRIPP);
  problem.load = 1897.1630285865974;
  problem.radius = 1.1667586497040262e-3;
  problem.modulus = 7.5444657942491286e6;
  problem.viscosity = 0.10757475861116382e-3;
  problem.pressure_left = 273867.96543215145;
  problem.inlet_film = 0.22236703164586231e-9;
  problem.gt_product = 0.028805769993294653;
  problem.sigma = 93.509277851655424e-9;
  problem.sigma_over_beta = 0.011469785252250184;
  problem.shear_strength = 3150612.309566604;
  g_assert_cmpint(solve(&film, &problem), ==, SB_OK);
  g_test_message("films %.6g and %.6g nm, asperity share %.6g", film.film_min * 1e9,
                 film.film_central * 1e9, film.asperity_share);
  close_to("minimum film", film.film_min * 1e9, 0.318010, 1e-3);
  close_to("central film", film.film_central * 1e9, 0.400186, 1e-3);
  g_assert_cmpfloat(film.solver.error_film_min, <, 1e-3);
}

// Checks that a problem meets its tolerance, and that its films differ from those of a hundredth of
// it by no more than three times their estimated errors.
static void check_estimates(const SbFilmProblem *problem) {
  SbFilmProblem finer = *problem;
  finer.tolerance = 0.01 * problem->tolerance;
  g_assert_cmpint(solve(&film, problem), ==, SB_OK);
  g_assert_cmpint(solve(&other, &finer), ==, SB_OK);
  g_test_message("minimum film %.6g nm, error %.2g, central film %.6g nm, error %.2g",
                 film.film_min * 1e9, film.solver.error_film_min, film.film_central * 1e9,
                 film.solver.error_film_central);
  g_assert_cmpfloat(film.solver.error_film_min, <=, problem->tolerance);
  close_to("minimum film", film.film_min, other.film_min, 3 * film.solver.error_film_min);
  close_to("central film", film.film_central, other.film_central,
           3 * film.solver.error_film_central);
}

// An inlet pressure of three times Hertz's nearly opens the inlet and leaves the outlet a slope of
// twice the dry contact's: its layer is a fortieth as wide as the inlet's.
static void test_narrow_outlet(void) {
  SbFilmProblem problem = rough_seal(0.033146011539677035, SB_ROUGH_PERSSON);
  problem.load = 567.69217227216359;
  problem.radius = 1.5094577889344987e-3;
  problem.modulus = 6802194.2169347461;
  problem.viscosity = 0.1893621092170973e-3;
  problem.pressure_left = 1933511.1933057755;
  problem.gt_product = 0.059289361019427923;
  problem.sigma = 24.989878396204189e-9;
  problem.sigma_over_beta = 0.01800003762783357;
  problem.tolerance = 1e-2;
  check_estimates(&problem);
  // The asperities carry five millionths of the load: the film is that of smooth rows but for 0.3
  // %.
  problem.surface = SB_ROUGH_NONE;
  g_assert_cmpint(solve(&other, &problem), ==, SB_OK);
  close_to("smooth minimum film", film.film_min, other.film_min, 5e-3);
  close_to("smooth central film", film.film_central, other.film_central, 1e-3);
}

// A leak at rest has its narrowest gap inside the contact, where no layer is: 0.856 of its half
// width from the middle.
static void test_leak_at_rest(void) {
  SbFilmProblem problem = rough_seal(0, SB_ROUGH_GREENWOOD_TRIPP);
  problem.load = 18.487625369147224;
  problem.radius = 0.51319371821516508e-3;
  problem.modulus = 21543928.077542115;
  problem.viscosity = 0.27613426261082245e-3;
  problem.pressure_left = 663319.91080293618;
  problem.rupture_pressure = -91457.56911760087;
  problem.gt_product = 0.036985733444449574;
  problem.sigma = 2.034043132098433e-6;
  problem.sigma_over_beta = 0.07958883817562791;
  problem.tolerance = 1.3139188015403401e-4;
  check_estimates(&problem);
  close_to("place", film.position_film_min / film.hertz_half_width, 0.856, 1e-3);
  problem.tolerance = 1e-2; // begins with large elements
  check_estimates(&problem);
}

static void test_refusals(void) {
  SbReport report;
  SbFilmProblem problem = rough_seal(1e-3, SB_ROUGH_PERSSON);
  problem.gt_product = 0.01;
  g_assert_cmpint(sb_film_solve(&film, &problem, NULL, &report), ==, SB_ERROR_INFEASIBLE);
  g_assert_cmpstr(sb_input_key(report.input), ==, "surface.gt_product");
  problem = rough_seal(1e-3, SB_ROUGH_GREENWOOD_TRIPP);
  problem.sigma = 0;
  g_assert_cmpint(sb_film_solve(&film, &problem, NULL, &report), ==, SB_ERROR_RANGE);
  problem = rough_seal(1e-3, SB_ROUGH_GREENWOOD_TRIPP);
  problem.model = SB_FILM_THESIS;
  g_assert_cmpint(sb_film_solve(&film, &problem, NULL, &report), ==, SB_ERROR_INPUT);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_assert_cmpint(sb_film_solver_create(&solver, NULL), ==, SB_OK);
  g_test_add_func("/film/mixed/ends", test_ends);
  g_test_add_func("/film/mixed/starved", test_starved);
  g_test_add_func("/film/mixed/near", test_near);
  g_test_add_func("/film/mixed/closed-errors", test_closed_errors);
  g_test_add_func("/film/mixed/adhesion", test_adhesion);
  g_test_add_func("/film/mixed/sticking", test_sticking);
  g_test_add_func("/film/mixed/sealed-start", test_sealed_start);
  g_test_add_func("/film/mixed/snap-in", test_snap_in);
  g_test_add_func("/film/mixed/sliding", test_sliding);
  g_test_add_func("/film/mixed/thin-layers", test_thin_layers);
  g_test_add_func("/film/mixed/narrow-outlet", test_narrow_outlet);
  g_test_add_func("/film/mixed/leak-at-rest", test_leak_at_rest);
  g_test_add_func("/film/mixed/refusals", test_refusals);
  int failed = g_test_run();
  sb_film_solver_destroy(solver);
  return failed;
}
