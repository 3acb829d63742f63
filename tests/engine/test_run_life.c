// A life as a run: each actuation is what a scene with that roughness gives by itself.
#include "engine/valve/model/model.h"
#include "engine/valve/sealbench.h"

#include "tests/engine/near.h"
#include "tests/executed.h"

#include <glib.h>
#include <math.h>

typedef struct {
  SbParamId id;
  double value;
} Change;

static SbRun *run_with(const Change *changes, int count) {
  SbParams params;
  sb_params_init(&params);
  for (int i = 0; i < count; i++) {
    g_assert_cmpint(sb_params_set(&params, changes[i].id, changes[i].value, NULL), ==, SB_OK);
  }
  SbModel model;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  return executed_run(&model);
}

// Actuation n of a life against one cycle at its roughness, given through surface.* alone.
static void compare(int motion, int n) {
  const Change life[] = {{SB_P_MODELS_MOTION, motion}, {SB_P_LIFE_ACTUATIONS, 7},
                         {SB_P_LIFE_ROUGHNESS_NEW, 1}, {SB_P_LIFE_ROUGHNESS_RUN_IN, 0.7},
                         {SB_P_LIFE_RUNNING_IN, 3},    {SB_P_OUTPUT_FRAMES, 200},
                         {SB_P_LIFE_SHOWN, n}};
  SbRun *run = run_with(life, G_N_ELEMENTS(life));
  size_t count;
  const SbLifeActuation *each = sb_run_life(run, &count);
  g_assert_cmpuint(count, ==, 7);
  double r = 0.7 + 0.3 * exp(-(n - 1) / 3.0);
  ASSERT_NEAR(each[n - 1].roughness, r, 1e-14);
  const Change one[] = {{SB_P_MODELS_MOTION, motion},
                        {SB_P_OUTPUT_FRAMES, 200},
                        {SB_P_SURFACE_GT_PRODUCT, 0.1289 * r},
                        {SB_P_SURFACE_SIGMA, 1e-6 * r},
                        {SB_P_SURFACE_SIGMA_OVER_BETA, 0.1 * r}};
  SbRun *alone = run_with(one, G_N_ELEMENTS(one));
  const SbSummary *s = sb_run_summary(alone);
  ASSERT_NEAR(each[n - 1].force_breakaway, s->force_breakaway, 1e-9);
  ASSERT_NEAR(each[n - 1].force_return, s->force_return_min, 1e-9);
  ASSERT_NEAR(each[n - 1].force_peak, s->force_peak, 1e-9);
  ASSERT_NEAR(each[n - 1].lambda, s->seal[SB_OUTER].lambda, 1e-12);
  g_assert_cmpint(each[n - 1].returned > 0, ==, s->returns);
  // Its frames follow those of the first.
  size_t total, own;
  const SbFrame *frame = sb_run_frames(run, &total), *single = sb_run_frames(alone, &own);
  size_t first = n > 1 ? total - own : 0;
  double start = n > 1 ? frame[first - 1].time : 0;
  for (size_t i = 0; i < own; i++) {
    // The dynamic path is stepped to a tolerance: rounding in the roughness moves its steps.
    ASSERT_NEAR(frame[first + i].force, single[i].force,
                motion == SB_MODEL_MOTION_DYNAMIC ? 1e-6 : 1e-9);
    ASSERT_NEAR(frame[first + i].displacement, single[i].displacement, 1e-12);
    ASSERT_NEAR(frame[first + i].time, start + single[i].time, 1e-9);
    g_assert_true(first + i == 0 || frame[first + i].time >= frame[first + i - 1].time);
  }
  g_assert_cmpfloat(sb_run_summary(run)->energy.closure, <, 1e-6);
  sb_run_destroy(alone);
  sb_run_destroy(run);
}

static void test_actuations(void) {
  compare(SB_MODEL_MOTION_QUASI_STATIC, 1);
  compare(SB_MODEL_MOTION_QUASI_STATIC, 4);
  compare(SB_MODEL_MOTION_DYNAMIC, 7);
}

// Without running-in every actuation is the first, and leakage is a product.
static void test_no_running_in(void) {
  const Change life[] = {{SB_P_LIFE_ACTUATIONS, 50},
                         {SB_P_LIFE_ROUGHNESS_RUN_IN, 1},
                         {SB_P_MODELS_FILM, SB_FILM_REYNOLDS}};
  SbRun *run = run_with(life, G_N_ELEMENTS(life));
  const SbSummary *s = sb_run_summary(run);
  size_t count;
  const SbLifeActuation *each = sb_run_life(run, &count);
  for (size_t i = 1; i < count; i++) {
    ASSERT_NEAR(each[i].force_return, each[0].force_return, 1e-12);
  }
  ASSERT_NEAR(s->life.leakage / s->leakage_per_cycle, 50, 1e-9);
  ASSERT_NEAR(s->life.carried / s->seal[SB_OUTER].leakage_per_stroke, 50, 1e-9);
  g_assert_cmpfloat(s->leakage_per_cycle, >, 0);
  // Two states of each seal solve a film, whatever the number of actuations, and those over the
  // speed.
  g_assert_cmpuint(s->counters.reynolds_solves, ==, 4 + s->counters.speed_nodes);
  g_assert_cmpuint(s->counters.speed_nodes, <=, 16);
  sb_run_destroy(run);
}

// Films know no roughness: what a later actuation asks for at its speeds is solved once.
static void test_running_in(void) {
  const Change life[] = {{SB_P_LIFE_ACTUATIONS, 60},
                         {SB_P_LIFE_ROUGHNESS_RUN_IN, 0.7},
                         {SB_P_MODELS_FILM, SB_FILM_REYNOLDS}};
  SbRun *run = run_with(life, G_N_ELEMENTS(life));
  const SbCounters *counters = &sb_run_summary(run)->counters;
  g_test_message("%zu films, %zu over the speed", counters->reynolds_solves, counters->speed_nodes);
  g_assert_cmpuint(counters->reynolds_solves, ==, 4 + counters->speed_nodes);
  g_assert_cmpuint(counters->speed_nodes, <=, 40);
  sb_run_destroy(run);
}

// A valve that roughens until its stem stays in: the life ends there, and tells the number.
static void test_failures(void) {
  const Change life[] = {{SB_P_LIFE_ACTUATIONS, 60},
                         {SB_P_LIFE_ROUGHNESS_NEW, 0.9},
                         {SB_P_LIFE_ROUGHNESS_RUN_IN, 1.5},
                         {SB_P_LIFE_RUNNING_IN, 20}};
  SbRun *run = run_with(life, G_N_ELEMENTS(life));
  const SbSummary *s = sb_run_summary(run);
  size_t count;
  const SbLifeActuation *each = sb_run_life(run, &count);
  g_assert_cmpuint(count, >, 1);
  g_assert_cmpuint(count, <, 60);
  for (size_t i = 0; i < count; i++) {
    g_assert_true(each[i].returned == (i + 1 < count ? 1 : 0));
    g_assert_true(i == 0 || each[i].force_return < each[i - 1].force_return);
    // What a stem that stays in carried one way is no loss.
    g_assert_true(isnan(each[i].leakage) == (each[i].returned == 0));
  }
  g_assert_cmpint(s->life.failure, ==, (long)count);
  g_assert_true(isnan(s->life.leakage) && isnan(s->life.last.force_peak));
  g_assert_cmpint(s->status, ==, SB_OK);
  bool told = false;
  for (size_t i = 0; i < s->warnings.count; i++) {
    told = told || g_str_equal(s->warnings.item[i].code, "life-no-return");
  }
  g_assert_true(told);
  sb_run_destroy(run);
}

#define COUPLED_TOLERANCE 1e-2

// One actuation of a life with coupled asperities as a run of its own.
static SbRun *coupled_run(double shear, double roughness) {
  const Change one[] = {{SB_P_MODELS_FILM, SB_FILM_REYNOLDS},
                        {SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED},
                        {SB_P_FRICTION_LOAD_COEFFICIENT, 0},
                        {SB_P_FRICTION_SHEAR_STRENGTH, shear},
                        {SB_P_OUTPUT_FRAMES, 200},
                        {SB_P_OUTPUT_TOLERANCE, COUPLED_TOLERANCE},
                        {SB_P_SURFACE_GT_PRODUCT, 0.1289 * roughness},
                        {SB_P_SURFACE_SIGMA, 1e-6 * roughness},
                        {SB_P_SURFACE_SIGMA_OVER_BETA, 0.1 * roughness}};
  return run_with(one, G_N_ELEMENTS(one));
}

static SbRun *coupled_life(double shear, double from, double to, int actuations, int shown) {
  const Change life[] = {{SB_P_MODELS_FILM, SB_FILM_REYNOLDS},
                         {SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED},
                         {SB_P_FRICTION_LOAD_COEFFICIENT, 0},
                         {SB_P_FRICTION_SHEAR_STRENGTH, shear},
                         {SB_P_OUTPUT_FRAMES, 200},
                         {SB_P_LIFE_ACTUATIONS, actuations},
                         {SB_P_LIFE_ROUGHNESS_NEW, from},
                         {SB_P_LIFE_ROUGHNESS_RUN_IN, to},
                         {SB_P_LIFE_RUNNING_IN, 20},
                         {SB_P_OUTPUT_TOLERANCE, COUPLED_TOLERANCE},
                         {SB_P_LIFE_SHOWN, shown}};
  return run_with(life, G_N_ELEMENTS(life));
}

// Coupled asperities hang on the roughness with their film: every actuation is that of its own run
// to the tolerance, though few are solved, and the one that is shown exactly.
static void test_coupled(void) {
  SbRun *run = coupled_life(0.2e6, 1, 0.7, 60, 25);
  size_t count;
  const SbLifeActuation *each = sb_run_life(run, &count);
  g_assert_cmpuint(count, ==, 60);
  const SbSummary *s = sb_run_summary(run);
  double leakage = 0;
  for (size_t i = 0; i < count; i++) {
    leakage += each[i].leakage;
    ASSERT_NEAR(each[i].dose / s->dose_mass, 1, 1e-12);
  }
  ASSERT_NEAR(s->life.leakage / leakage, 1, 1e-12);
  static const int compared[] = {1, 4, 9, 25, 40, 60};
  size_t solves = 0;
  for (size_t k = 0; k < G_N_ELEMENTS(compared); k++) {
    const SbLifeActuation *at = &each[compared[k] - 1];
    const double r = 0.7 + 0.3 * exp(-(compared[k] - 1) / 20.0);
    SbRun *alone = coupled_run(0.2e6, r);
    const SbSummary *one = sb_run_summary(alone);
    const bool shown = compared[k] == 25, exact = shown || compared[k] == 1 || compared[k] == 60;
    const double near = exact ? 1e-9 : COUPLED_TOLERANCE;
    g_test_message("%d: leakage %.3g of it off, λ %.2g", compared[k],
                   at->leakage / one->leakage_per_cycle - 1,
                   at->lambda / one->seal[SB_OUTER].lambda - 1);
    ASSERT_NEAR(at->force_breakaway / one->force_breakaway, 1, near);
    ASSERT_NEAR(at->force_return / one->force_breakaway,
                one->force_return_min / one->force_breakaway, near);
    ASSERT_NEAR(at->lambda / one->seal[SB_OUTER].lambda, 1, near);
    ASSERT_NEAR(at->leakage / at->carried, one->leakage_per_cycle / at->carried, near);
    solves = one->counters.reynolds_solves;
    if (shown) {
      size_t total, own;
      const SbFrame *frame = sb_run_frames(run, &total), *single = sb_run_frames(alone, &own);
      for (size_t i = 0; i < own; i++) {
        ASSERT_NEAR(frame[total - own + i].force, single[i].force, 1e-9);
      }
    }
    sb_run_destroy(alone);
  }
  g_test_message("%zu films, %zu in one run", s->counters.reynolds_solves, solves);
  g_assert_cmpuint(s->counters.reynolds_solves, <, 15 * solves);
  sb_run_destroy(run);
}

// The same while its surface becomes smoother until static friction holds the stem: the dry
// contact's real area grows. The number is that of the first run that does not return.
static void test_coupled_failure(void) {
  const double shear = 0.525e6;
  SbRun *run = coupled_life(shear, 1, 0.7, 60, 0);
  const SbSummary *s = sb_run_summary(run);
  const long failure = s->life.failure;
  g_test_message("ends at %ld", failure);
  g_assert_cmpint(s->status, ==, SB_OK);
  g_assert_cmpint(failure, >, 2);
  g_assert_cmpint(failure, <, 60);
  g_assert_cmpint(s->life.done, ==, failure);
  g_assert_true(isnan(s->life.leakage));
  for (int k = 0; k < 2; k++) {
    SbRun *alone = coupled_run(shear, 0.7 + 0.3 * exp(-(double)(failure - 2 + k) / 20));
    g_assert_cmpint(sb_run_summary(alone)->returns, ==, k == 0);
    sb_run_destroy(alone);
  }
  sb_run_destroy(run);
  // One whose first stem stays in has nothing else to solve.
  run = coupled_life(2e6, 1, 0.7, 60, 0);
  g_assert_cmpint(sb_run_summary(run)->life.failure, ==, 1);
  g_assert_cmpint(sb_run_summary(run)->status, ==, SB_OK);
  sb_run_destroy(run);
}

// A cancel keeps what was done.
static bool after_a_while(void *data) {
  int *asked = data;
  return ++*asked > 400;
}

static void test_cancel(void) {
  SbParams params;
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_LIFE_ACTUATIONS, 100000, NULL), ==, SB_OK);
  SbModel model;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  SbPlan plan;
  sb_plan_make(&plan, &model);
  SbRun *run = NULL;
  SbReport report = {0};
  int asked = 0;
  SbRunHooks hooks = {.cancelled = after_a_while, .data = &asked};
  g_assert_cmpint(sb_run_create(&run, &model, &plan, &report), ==, SB_OK);
  g_assert_cmpint(sb_run_execute(run, &hooks, &report), ==, SB_ERROR_CANCELLED);
  size_t count;
  sb_run_life(run, &count);
  g_assert_cmpuint(count, >, 10);
  g_assert_cmpuint(count, <, 400);
  sb_run_destroy(run);
}

// Stick-slip between frames does not hide the film that a stroke drags. In a machine of ten times
// the stiffness: as friction changes on the way the spring of a soft one lets the stem go a percent
// faster in, and slower back, than the platen, and the net leak is a quarter of what goes out.
static void test_leakage_of_motion(void) {
  const Change settings[] = {{SB_P_MODELS_FILM, SB_FILM_REYNOLDS},
                             {SB_P_DRIVE_STIFFNESS, 1e6},
                             {SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC}};
  SbRun *slow = run_with(settings, 2), *fast = run_with(settings, 3);
  double a = sb_run_summary(slow)->leakage_per_cycle, b = sb_run_summary(fast)->leakage_per_cycle;
  g_test_message("quasi-static %.4g m3, with inertia %.4g m3", a, b);
  ASSERT_NEAR(b / a, 1, 0.02);
  sb_run_destroy(slow);
  sb_run_destroy(fast);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/life/actuations", test_actuations);
  g_test_add_func("/life/no-running-in", test_no_running_in);
  g_test_add_func("/life/running-in", test_running_in);
  g_test_add_func("/life/failures", test_failures);
  g_test_add_func("/life/coupled", test_coupled);
  g_test_add_func("/life/coupled-failure", test_coupled_failure);
  g_test_add_func("/life/cancel", test_cancel);
  g_test_add_func("/life/leakage-of-motion", test_leakage_of_motion);
  return g_test_run();
}
