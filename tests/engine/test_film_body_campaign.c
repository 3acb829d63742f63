// Random pressurised valves with the film on the fitted body, up to a fluid pressure of the
// rubber's modulus: every seal that its fitment keeps closed has its film there, sliding in and
// out, smooth and with coupled asperities, in at most 40 continuation steps; where it lies on the
// half-plane instead, a warning says so, which is to be in less than one per cent, failures counted
// with them.
//
// test-engine-film-body-campaign [COUNT [SEED [FIT]]]: 12 discs in the tests.
#include "engine/valve/model/model.h"
#include "engine/valve/states/sliding.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS_MAX = 40 }; // of one film

static int count = 12;
static guint32 seed = 1;
static SbFitModel fit_model = SB_FIT_DISC;

static double between(GRand *random, double low, double high) {
  return g_rand_double_range(random, low, high);
}

static double decades(GRand *random, double low, double high) {
  return exp(between(random, log(low), log(high)));
}

static void set(SbParams *params, SbParamId id, double value) {
  SbReport report = {0};
  SbStatus status = sb_params_set(params, id, value, &report);
  if (status != SB_OK) {
    g_test_message("%s", report.text);
  }
  g_assert_cmpint(status, ==, SB_OK);
}

static void draw(SbParams *params, GRand *random, double *ratio) {
  sb_params_init(params);
  double bore = decades(random, 3e-3, 12e-3);
  double space = bore * between(random, 0.12, 0.3), floor = bore - 2 * space;
  double section = space / (1 - between(random, 0.02, 0.3));
  double inner = floor / (1 + between(random, 0.01, 0.25));
  double volume = G_PI / 4 * section * section * (inner + section) / (space * (bore - space));
  *ratio = between(random, 0, 1);
  double modulus = decades(random, 1e6, fmin(15e6, 2e6 / fmax(*ratio, 0.1)));
  set(params, SB_P_BORE_DIAMETER, bore);
  set(params, SB_P_GLAND_RADIAL_SPACE, space);
  set(params, SB_P_GLAND_AXIAL_WIDTH, volume / between(random, 0.55, 0.85));
  set(params, SB_P_STEM_SEAL_SPACING, 5 * section);
  for (int seal = 0; seal < 2; seal++) {
    bool outer = seal == 0;
    set(params, outer ? SB_P_SEAL_OUTER_SECTION_DIAMETER : SB_P_SEAL_INNER_SECTION_DIAMETER,
        section);
    set(params, outer ? SB_P_SEAL_OUTER_INNER_DIAMETER : SB_P_SEAL_INNER_INNER_DIAMETER, inner);
    set(params, outer ? SB_P_SEAL_OUTER_MODULUS : SB_P_SEAL_INNER_MODULUS, modulus);
    set(params, outer ? SB_P_SEAL_OUTER_POISSON_RATIO : SB_P_SEAL_INNER_POISSON_RATIO,
        between(random, 0.45, 0.4995));
  }
  set(params, SB_P_CANISTER_PRESSURE, *ratio * modulus);
  set(params, SB_P_FLUID_VISCOSITY, decades(random, 0.1e-3, 5e-3));
  set(params, SB_P_SURFACE_SIGMA, decades(random, 0.1e-6, 4e-6));
  set(params, SB_P_SURFACE_SIGMA_OVER_BETA, decades(random, 0.01, 0.3));
  set(params, SB_P_SURFACE_GT_PRODUCT, decades(random, 0.03, 0.2));
  set(params, SB_P_DRIVE_SPEED, decades(random, 5e-5, 0.05));
  set(params, SB_P_MODELS_FIT, fit_model);
  set(params, SB_P_MODELS_FILM, SB_FILM_REYNOLDS);
  set(params, SB_P_MODELS_SURFACE, g_rand_boolean(random));
  set(params, SB_P_MODELS_ASPERITIES,
      g_rand_int_range(random, 0, 3) == 0 ? SB_MODEL_ASPERITIES_COUPLED : 0);
}

static const SbWarning *find(const SbWarnings *warnings, const char *code) {
  for (size_t i = 0; i < warnings->count; i++) {
    if (strcmp(warnings->item[i].code, code) == 0) {
      return &warnings->item[i];
    }
  }
  return NULL;
}

static void test_bodies(void) {
  GRand *random = g_rand_new_with_seed(seed);
  SbSlidingMemory *memory = NULL;
  int films = 0, open = 0, fell = 0, failed = 0, unfitted = 0, refused = 0, steps = 0;
  g_assert_cmpint(sb_sliding_memory_create(&memory, NULL), ==, SB_OK);
  for (int i = 0; i < count;) {
    SbParams params;
    SbModel model;
    double ratio;
    draw(&params, random, &ratio);
    SbProblems problems = {0};
    if (sb_model_compile(&model, &params, NULL, &problems) != SB_OK) {
      refused++;
      continue;
    }
    i++;
    sb_sliding_memory_forget(memory);
    for (int k = 0; k < 2; k++) {
      const SbSealPressure pressure = sb_model_seal_pressure(&model, SB_OUTER, SB_CHAMBER_AT_REST);
      const double speed = k == 0 ? model.speed : -model.speed;
      SbSealState state;
      SbCounters counts = {0};
      SbWarnings warnings = {0};
      SbReport report = {0};
      SbStatus status = sb_sliding_solve(
          &state,
          &(SbSlidingTask){&model, SB_OUTER, pressure, speed, memory, &counts, &warnings, {0}},
          &report);
      const SbWarning *plane = find(&warnings, "film-half-plane");
      if (find(&warnings, "film-tolerance") != NULL) { // on the body, with its error or at rest
        g_assert_true(state.film_fitted || plane != NULL);
        g_assert_true(!(state.film_error <= model.tolerance) ||
                      model.asperities == SB_MODEL_ASPERITIES_COUPLED);
        g_assert_false(state.film_error >= 0.06);
      }
      if (status != SB_OK || plane != NULL) {
        g_test_message("%d %s p/E %.3f squeeze %.3f nu %.4f speed %.3g coupled %d: status %d %s%s; "
                       "%s",
                       i, k == 0 ? "in" : "out", ratio, model.seal[0].squeeze,
                       model.seal[0].poisson_ratio, speed, (int)model.asperities, (int)status,
                       plane != NULL ? plane->text : "", state.opened ? " opened" : "",
                       report.text);
      }
      if (status != SB_OK && isnan(state.load)) {
        unfitted++;
      } else if (plane == NULL && (!state.touches || state.opened)) {
        open++;
      } else {
        films++;
        failed += status != SB_OK;
        fell += status == SB_OK && plane != NULL;
        g_assert_true(status != SB_OK || state.film_fitted || plane != NULL);
        steps = MAX(steps, sb_sliding_film(memory)->solver.continuation_steps);
      }
    }
  }
  g_test_message("%d films, %d on the half-plane, %d failed, at most %d steps; %d open, %d without "
                 "a fitment, %d valves refused",
                 films, fell, failed, steps, open, unfitted, refused);
  g_assert_cmpint(100 * (fell + failed), <, MAX(films, 100));
  g_assert_cmpint(steps, <=, STEPS_MAX);
  sb_sliding_memory_destroy(memory);
  g_rand_free(random);
}

// Chosen discs of a seed, sliding out: on the fitted body, in few steps.
static void films_of(guint32 of_seed, const int *discs, size_t discs_count) {
  GRand *random = g_rand_new_with_seed(of_seed);
  SbSlidingMemory *memory = NULL;
  g_assert_cmpint(sb_sliding_memory_create(&memory, NULL), ==, SB_OK);
  size_t next = 0;
  for (int i = 1; next < discs_count;) {
    SbParams params;
    SbModel model;
    double ratio;
    draw(&params, random, &ratio);
    if (sb_model_compile(&model, &params, NULL, NULL) != SB_OK || i++ != discs[next]) {
      continue;
    }
    next++;
    SbSealState state;
    SbCounters counts = {0};
    SbWarnings warnings = {0};
    sb_sliding_memory_forget(memory);
    const SbSealPressure pressure = sb_model_seal_pressure(&model, SB_OUTER, SB_CHAMBER_AT_REST);
    g_assert_cmpint(
        sb_sliding_solve(
            &state,
            &(SbSlidingTask){
                &model, SB_OUTER, pressure, -model.speed, memory, &counts, &warnings, {0}},
            NULL),
        ==, SB_OK);
    const SbFilm *film = sb_sliding_film(memory);
    g_test_message("disc %d: %d steps, least film %.3g nm", discs[next - 1],
                   film->solver.continuation_steps, 1e9 * film->film_min);
    g_assert_true(state.film_fitted);
    g_assert_cmpfloat(film->film_min, >, 0);
    g_assert_cmpint(film->solver.continuation_steps, <=, STEPS_MAX);
  }
  sb_sliding_memory_destroy(memory);
  g_rand_free(random);
}

// Films that end sharply between coupled asperities before an outlet under pressure, those of seed
// 2 so sharply that a finer mesh has no room for all the ends, or whose outlet drives fluid back
// through them, and smooth ones (50, 252) that smooth rows do not find.
static void test_fronts(void) {
  static const int first[] = {16, 50, 68, 72, 129, 171, 183, 252, 262}, second[] = {65, 103, 221};
  films_of(1, first, G_N_ELEMENTS(first));
  films_of(2, second, G_N_ELEMENTS(second));
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  count = argc > 1 ? atoi(argv[1]) : count;
  seed = argc > 2 ? (guint32)atoi(argv[2]) : seed;
  fit_model = argc > 3 && strcmp(argv[3], "ring") == 0 ? SB_FIT_RING : fit_model;
  g_test_add_func("/film-body-campaign/pressed", test_bodies);
  if (argc == 1) {
    g_test_add_func("/film-body-campaign/fronts", test_fronts);
  }
  return g_test_run();
}
