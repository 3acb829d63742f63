// Options of the film that a scene can ask for, seen through a sliding seal: each off changes
// nothing, each on moves the film the way its equation says, and where it cannot act it is told.
#include "engine/valve/sealbench.h"
#include "engine/valve/states/sliding.h"
#include "tests/engine/near.h"

#include <glib.h>
#include <math.h>
#include <string.h>

typedef struct {
  SbParamId id;
  double value;
} Setting;

static SbModel model_with(const Setting *setting, size_t count) {
  SbParams params;
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_FILM, SB_FILM_REYNOLDS, NULL), ==, SB_OK);
  for (size_t i = 0; i < count; i++) {
    g_assert_cmpint(sb_params_set(&params, setting[i].id, setting[i].value, NULL), ==, SB_OK);
  }
  SbModel model;
  SbProblems problems;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, &problems), ==, SB_OK);
  return model;
}

static SbSealState state; // of the last solve
static SbSupply supply;

// The outer seal between `pressure`s at `speed`; its film in *film.
static void solve(SbFilm *film, const SbModel *model, SbSealPressure pressure, double speed,
                  SbWarnings *warnings) {
  SbSlidingMemory *memory = NULL;
  SbCounters counts = {0};
  *warnings = (SbWarnings){0};
  g_assert_cmpint(sb_sliding_memory_create(&memory, NULL), ==, SB_OK);
  g_assert_cmpint(sb_sliding_solve(&state,
                                   &(SbSlidingTask){model, SB_OUTER, pressure, speed, memory,
                                                    &counts, warnings, supply},
                                   NULL),
                  ==, SB_OK);
  *film = *sb_sliding_film(memory);
  sb_sliding_memory_destroy(memory);
}

static const SbSealPressure PRESSED = {.left = 0.55e6, .right = 0}, BOTH = {0.55e6, 0.55e6};
static SbFilm plain, changed;
static SbWarnings warnings;

// Barus: the coefficient alone does nothing, the choice does; the film of a soft contact follows
// the inlet's viscosity, so alpha p of 0.2 lifts it by less than exp(0.2)^0.6.
static void test_barus(void) {
  const Setting off[] = {{SB_P_FLUID_PRESSURE_VISCOSITY, 3.6e-7}};
  const Setting on[] = {{SB_P_FLUID_PRESSURE_VISCOSITY, 3.6e-7}, {SB_P_MODELS_VISCOSITY, 1}};
  SbModel model = model_with(NULL, 0);
  solve(&plain, &model, PRESSED, model.speed, &warnings);
  model = model_with(off, G_N_ELEMENTS(off));
  solve(&changed, &model, PRESSED, model.speed, &warnings);
  g_assert_cmpfloat(changed.film_central, ==, plain.film_central);
  model = model_with(on, G_N_ELEMENTS(on));
  solve(&changed, &model, PRESSED, model.speed, &warnings);
  double rise = changed.film_flux / plain.film_flux;
  g_assert_cmpfloat(rise, >, 1.05);
  g_assert_cmpfloat(rise, <, exp(0.6 * 3.6e-7 * 1.41e6));
}

// Eyring: where the stress of the film is far below the limit nothing moves, near it drag falls.
static void test_eyring(void) {
  const Setting high[] = {{SB_P_FLUID_EYRING_STRESS, 1e9}};
  const Setting low[] = {{SB_P_FLUID_EYRING_STRESS, 20}};
  SbModel model = model_with(NULL, 0);
  solve(&plain, &model, PRESSED, model.speed, &warnings);
  model = model_with(high, 1);
  solve(&changed, &model, PRESSED, model.speed, &warnings);
  g_assert_cmpfloat(fabs(changed.friction_couette / plain.friction_couette - 1), <, 1e-6);
  model = model_with(low, 1);
  solve(&changed, &model, PRESSED, model.speed, &warnings);
  g_assert_cmpfloat(changed.friction_couette, <, 0.95 * plain.friction_couette);
}

// Rupture: between two fluids at the canister's pressure nothing breaks above gauge 0. With a
// vapour pressure as high as theirs the film is that of a seal without pressure, which breaks. A
// vapour pressure above the surroundings is cut there and told.
static void test_rupture(void) {
  const Setting vapour[] = {{SB_P_FLUID_RUPTURE_PRESSURE, 0.55e6}};
  SbModel model = model_with(NULL, 0);
  solve(&plain, &model, BOTH, model.speed, &warnings);
  g_assert_false(plain.ruptured);
  SbFilm ambient;
  const SbSealPressure none = {0, 0};
  solve(&ambient, &model, none, model.speed, &warnings);
  g_assert_true(ambient.ruptured);
  model = model_with(vapour, 1);
  solve(&changed, &model, BOTH, model.speed, &warnings);
  g_assert_false(warned(&warnings, "rupture-ambient"));
  g_assert_true(changed.ruptured);
  g_assert_cmpfloat(fabs(changed.film_min / ambient.film_min - 1), <, 2e-3);
  g_assert_cmpfloat(fabs(changed.position_rupture / ambient.position_rupture - 1), <, 1e-3);
  g_assert_cmpfloat(fabs(plain.film_min / ambient.film_min - 1), >, 1e-2);
  model = model_with(NULL, 0);
  solve(&ambient, &model, PRESSED, model.speed, &warnings);
  model = model_with(vapour, 1);
  solve(&changed, &model, PRESSED, model.speed, &warnings);
  g_assert_true(warned(&warnings, "rupture-ambient"));
  g_assert_cmpfloat(changed.film_min, ==, ambient.film_min);
}

// Carried: a return ten times as fast asks for 10^0.6 of the layer that the in-stroke left; it runs
// starved, and carries back just that layer: solved films, rough ones, and laws alike. At the
// in-stroke's own speed the layer suffices. An inlet that finds nothing leaves no film.
static void test_carried(void) {
  const Setting kinds[][2] = {{{SB_P_MODELS_FIT, SB_FIT_KARASZKIEWICZ}, {SB_P_MODELS_SURFACE, 0}},
                              {{SB_P_MODELS_FIT, SB_FIT_DISC}, {SB_P_MODELS_SURFACE, 0}},
                              {{SB_P_MODELS_ASPERITIES, 1}, {SB_P_SURFACE_SIGMA, 2e-7}},
                              {{SB_P_MODELS_ASPERITIES, 1}, {SB_P_MODELS_FIT, SB_FIT_DISC}},
                              {{SB_P_MODELS_FILM, SB_FILM_THESIS}, {SB_P_MODELS_SURFACE, 0}}};
  const SbSealPressure none = {0, 0};
  for (size_t i = 0; i < G_N_ELEMENTS(kinds); i++) {
    SbModel model = model_with(kinds[i], 2);
    supply = (SbSupply){0};
    solve(&plain, &model, none, model.speed, &warnings);
    const SbSealState in = state;
    if (plain.flow > 0) {
      g_assert_cmpfloat(fabs(plain.flow / model.speed / in.layer - 1), <, 1e-12);
    } else {
      g_assert_cmpfloat(in.layer, ==, in.film_central / 2);
    }
    solve(&plain, &model, none, -10 * model.speed, &warnings);
    const SbSealState flooded = state;
    g_assert_cmpfloat(flooded.layer, >, 1.2 * in.layer);
    supply = (SbSupply){true, in.layer};
    solve(&changed, &model, none, -10 * model.speed, &warnings);
    g_assert_cmpfloat(fabs(state.layer / in.layer - 1), <, 1e-6);
    g_assert_cmpfloat(state.film_central, <, flooded.film_central);
    g_assert_cmpfloat(fabs(state.load / flooded.load - 1), <, 1e-12);
    // As long as the film is no rough gap its flow says how thick it is.
    if (model.asperities == SB_MODEL_ASPERITIES_BESIDE) {
      g_assert_cmpfloat(fabs(state.film_central / (2 * in.layer) - 1), <, 2e-3);
    }
    solve(&changed, &model, none, -model.speed, &warnings);
    g_assert_cmpfloat(fabs(state.film_central / in.film_central - 1), <, 2e-3);
    supply.layer = 0;
    solve(&changed, &model, none, -model.speed, &warnings);
    g_assert_cmpfloat(state.layer, ==, 0);
    g_assert_cmpfloat(state.friction_viscous, ==, 0);
    g_assert_cmpfloat(
        fabs(sb_sliding_friction(&state) * model.static_ratio / state.friction_static - 1), <,
        1e-9);
  }
  supply = (SbSupply){0};
}

// The return's starved film against an estimate that no solver enters. Reynolds' equation, h^3 p' =
// 6 eta u (h - h*), gives the film where pressure has its peak: h = h*, flow = u h*/2. The flow is
// what the in-stroke left, u_in h*_in/2 over u_in, so that h = h*_in at whatever speed of the
// return; and h*_in is that of the thin limit under Hertz' pressure, 3.77334 R U^0.6 W^-0.2
// (film.h).
static void test_inverse_hydrodynamics(void) {
  const SbSealPressure none = {0, 0};
  for (int i = 0; i < 3; i++) {
    const double faster = (double[]){3, 10, 40}[i];
    SbModel model = model_with(NULL, 0);
    supply = (SbSupply){0};
    solve(&plain, &model, none, model.speed, &warnings);
    const SbSealModel *ring = &model.seal[SB_OUTER];
    const double U = model.viscosity * model.speed / 2 / (ring->reduced_modulus * ring->radius);
    const double W = state.load_net / (ring->reduced_modulus * ring->radius);
    const double carried = 3.77334 * ring->radius * pow(U, 0.6) * pow(W, -0.2);
    const double flooded = carried * pow(faster, 0.6);
    supply = (SbSupply){true, state.layer};
    solve(&changed, &model, none, -faster * model.speed, &warnings);
    const double starved = state.film_central;
    supply = (SbSupply){0};
    solve(&changed, &model, none, -faster * model.speed, &warnings);
    g_assert_cmpfloat(fabs(starved / carried - 1), <, 0.05);
    g_assert_cmpfloat(fabs(starved / state.film_central * flooded / carried - 1), <, 0.05);
  }
}

// A tolerance that no mesh meets: the film is a result with its own error, and the run says so.
static void test_above_tolerance(void) {
  enum { persson = 1 };
  const Setting sharp[] = {{SB_P_MODELS_FIT, SB_FIT_GREEN_ENGLISH},
                           {SB_P_MODELS_SURFACE, persson},
                           {SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED},
                           {SB_P_OUTPUT_TOLERANCE, 1e-8}};
  SbModel model = model_with(sharp, G_N_ELEMENTS(sharp));
  solve(&plain, &model, PRESSED, 0.01, &warnings);
  g_assert_true(warned(&warnings, "film-tolerance"));
  g_assert_false(plain.solver.converged);
  g_assert_cmpfloat(state.film_error, >=, plain.solver.error_film_min);
  g_assert_cmpfloat(state.film_error, >, 1e-8);
  g_assert_cmpfloat(state.film_error, <, 1e-7);
  const double film = state.film_min, error = state.film_error;
  model = model_with(sharp, G_N_ELEMENTS(sharp) - 1);
  solve(&changed, &model, PRESSED, 0.01, &warnings);
  g_assert_false(warned(&warnings, "film-tolerance"));
  g_assert_cmpfloat(fabs(state.film_min / film - 1), <=, 3 * (state.film_error + error));
}

// A power law has none of this: the run says so.
static void test_told(void) {
  const Setting on[] = {{SB_P_MODELS_FILM, SB_FILM_THESIS}, {SB_P_MODELS_VISCOSITY, 1}};
  SbModel model = model_with(on, G_N_ELEMENTS(on));
  solve(&plain, &model, PRESSED, model.speed, &warnings);
  g_assert_true(warned(&warnings, "film-options"));
  model = model_with(on, 1);
  solve(&plain, &model, PRESSED, model.speed, &warnings);
  g_assert_false(warned(&warnings, "film-options"));
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/film-run-options/barus", test_barus);
  g_test_add_func("/film-run-options/eyring", test_eyring);
  g_test_add_func("/film-run-options/rupture", test_rupture);
  g_test_add_func("/film-run-options/carried", test_carried);
  g_test_add_func("/film-run-options/inverse-hydrodynamics", test_inverse_hydrodynamics);
  g_test_add_func("/film-run-options/above-tolerance", test_above_tolerance);
  g_test_add_func("/film-run-options/told", test_told);
  return g_test_run();
}
