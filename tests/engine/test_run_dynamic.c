// The valve's motion with inertia: it agrees with the quasi-static cycle where it should, and every
// drive ends with its energy in balance.
#include "engine/sealbench.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>

typedef struct {
  int id;
  double value;
} Setting;

static SbRun *run_with(SbModelMotion motion, const Setting *settings, size_t count) {
  SbParams params;
  sb_params_init(&params);
  SbReport report = {0};
  sb_params_set(&params, SB_P_MODELS_MOTION, motion, &report);
  for (size_t i = 0; i < count; i++) {
    g_assert_cmpint(sb_params_set(&params, (SbParamId)settings[i].id, settings[i].value, &report),
                    ==, SB_OK);
  }
  SbModel model;
  SbProblems problems;
  g_assert_cmpint(sb_model_compile(&model, &params, &problems), ==, SB_OK);
  SbPlan plan;
  sb_plan_make(&plan, &model);
  SbRun *run = NULL;
  g_assert_cmpint(sb_run_create(&run, &model, &plan, &report), ==, SB_OK);
  SbStatus status = sb_run_execute(run, NULL, &report);
  if (status != SB_OK) {
    g_test_message("%s", report.text);
  }
  g_assert_cmpint(status, ==, SB_OK);
  g_assert_cmpfloat(sb_run_summary(run)->energy.closure, <, 1e-6);
  return run;
}

static double force_at(const SbRun *run, double s, bool in) {
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  double best = INFINITY;
  double force = NAN;
  for (size_t i = 0; i < count; i++) {
    double miss = fabs(frames[i].displacement - s);
    if ((frames[i].stage < SB_STAGE_D) == in && miss < best) {
      best = miss;
      force = frames[i].force;
    }
  }
  return force;
}

// Without a static peak the slow stroke is a string of balances. What differs: the stop gives a
// little, and the machine's damper adds c v = 2e-6 of the force.
static void test_against_quasi_static(void) {
  Setting smooth = {SB_P_FRICTION_STATIC_RATIO, 1};
  SbRun *slow = run_with(SB_MODEL_MOTION_QUASI_STATIC, &smooth, 1);
  SbRun *fast = run_with(SB_MODEL_MOTION_DYNAMIC, &smooth, 1);
  for (int in = 0; in < 2; in++) {
    for (double s = 0.5e-3; s < 6.4e-3; s += 0.25e-3) {
      // Beside the edge, where forces change with s and frames do not sit at the same places.
      if (s > 3.2e-3 && s < 4.1e-3) {
        continue;
      }
      double a = force_at(slow, s, in);
      double b = force_at(fast, s, in);
      g_assert_cmpfloat(fabs(a - b), <, 0.04);
    }
  }
  const SbSummary *a = sb_run_summary(slow);
  const SbSummary *b = sb_run_summary(fast);
  for (int stage = SB_STAGE_B; stage < SB_STAGE_COUNT; stage++) {
    g_assert_true(b->stage[stage].reached);
  }
  g_assert_cmpfloat(fabs(a->stage[SB_STAGE_C].displacement - b->stage[SB_STAGE_C].displacement), <,
                    1e-9);
  g_assert_cmpfloat(fabs(a->stage[SB_STAGE_F].displacement - b->stage[SB_STAGE_F].displacement), <,
                    1e-9);
  g_assert_cmpfloat(fabs(a->energy.loop / b->energy.loop - 1), <, 2e-3);
  g_assert_cmpfloat(fabs(a->force_breakaway / b->force_breakaway - 1), <, 1e-3);
  sb_run_destroy(slow);
  sb_run_destroy(fast);
}

// With the static peak the stem of an undamped seal sticks and slips between the same bounds.
static void test_stick_slip(void) {
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, NULL, 0);
  const SbSummary *summary = sb_run_summary(run);
  g_assert_cmpfloat_with_epsilon(summary->force_breakaway, 28.7, 0.05);
  g_assert_true(summary->returns);
  double least = INFINITY;
  double most = 0;
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  for (size_t i = 0; i < count; i++) {
    if (frames[i].stage == SB_STAGE_B && frames[i].displacement < 3e-3 && frames[i].time > 2) {
      least = fmin(least, frames[i].force);
      most = fmax(most, frames[i].force);
    }
  }
  g_assert_cmpfloat(most, <=, summary->force_breakaway * 1.001);
  g_assert_cmpfloat(least, >, 2 * 27.38 - 28.7 - 0.1);
  sb_run_destroy(run);
}

static void test_drives(void) {
  const Setting cases[][3] = {
      {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND}, {SB_P_DRIVE_CYCLES, 2}, {SB_P_OUTPUT_FRAMES, 300}},
      {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_FREE_RETURN},
       {SB_P_OUTPUT_FRAMES, 300},
       {SB_P_DRIVE_CYCLES, 1}},
      {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_SINUSOID},
       {SB_P_DRIVE_CYCLES, 2},
       {SB_P_OUTPUT_FRAMES, 300}},
      {{SB_P_STEM_SPRING_STIFFNESS, 2e3}, {SB_P_STEM_SPRING_PRELOAD, 5}, {SB_P_OUTPUT_FRAMES, 300}},
      {{SB_P_BORE_LAND_EDGE, 0}, {SB_P_OUTPUT_FRAMES, 300}, {SB_P_DRIVE_CYCLES, 1}},
      {{SB_P_FRICTION_STATIC_RATIO, 5},
       {SB_P_OUTPUT_FRAMES, 300},
       {SB_P_DRIVE_REVERSAL_FORCE, 100}},
      {{SB_P_CANISTER_PRESSURE_MAP, 1}, {SB_P_OUTPUT_FRAMES, 300}, {SB_P_DRIVE_CYCLES, 1}},
      {{SB_P_DRIVE_SPEED, 1}, {SB_P_OUTPUT_FRAMES, 300}, {SB_P_DRIVE_CYCLES, 1}},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, cases[i], 3);
    const SbSummary *summary = sb_run_summary(run);
    g_test_message("case %zu: %.3g s, peak %.3g N, returns %d, closure %.2g, %zu steps, %.1f ms", i,
                   summary->duration, summary->force_peak, summary->returns,
                   summary->energy.closure, summary->steps, 1e3 * summary->wall_s);
    g_assert_cmpfloat(summary->duration, >, 0);
    sb_run_destroy(run);
  }
}

static void test_no_return(void) {
  Setting rough = {SB_P_SURFACE_GT_PRODUCT, 1.3 * 0.1289};
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, &rough, 1);
  g_assert_false(sb_run_summary(run)->returns);
  g_assert_cmpfloat(sb_run_summary(run)->force_return_min, <, 0);
  sb_run_destroy(run);
}

// What only inertia can do is refused without it, by name.
static void test_refused(void) {
  SbParams params;
  sb_params_init(&params);
  sb_params_set(&params, SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND, NULL);
  SbModel model;
  SbProblems problems;
  g_assert_cmpint(sb_model_compile(&model, &params, &problems), ==, SB_ERROR_INPUT);
  g_assert_cmpstr(problems.item[0].key, ==, "drive.kind");
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/run-dynamic/against-quasi-static", test_against_quasi_static);
  g_test_add_func("/run-dynamic/stick-slip", test_stick_slip);
  g_test_add_func("/run-dynamic/drives", test_drives);
  g_test_add_func("/run-dynamic/no-return", test_no_return);
  g_test_add_func("/run-dynamic/refused", test_refused);
  return g_test_run();
}
