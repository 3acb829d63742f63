// Runs of the default valve with some settings, for the tests of its motion with inertia.
#pragma once

#include "engine/valve/model/model.h"
#include "engine/valve/sealbench.h"

#include <glib.h>
#include <math.h>

typedef struct {
  int id; // SbParamId
  double value;
} Setting;

// The executed run, whose energies balance to 1e-6; fails the test otherwise. Owned by the caller
// (sb_run_destroy).
static inline SbRun *run_with(SbModelMotion motion, const Setting *settings, size_t count) {
  SbParams params;
  sb_params_init(&params);
  SbReport report = {0};
  g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_MOTION, motion, &report), ==, SB_OK);
  for (size_t i = 0; i < count; i++) {
    g_assert_cmpint(sb_params_set(&params, (SbParamId)settings[i].id, settings[i].value, &report),
                    ==, SB_OK);
  }
  SbModel model;
  SbProblems problems;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, &problems), ==, SB_OK);
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

// Force [N] of the frame on the way in, or back, whose displacement is nearest to s.
static inline double force_at(const SbRun *run, double s, bool in) {
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

static inline void assert_near(double a, double b, double tolerance) {
  g_assert_cmpfloat_with_epsilon(a, b, tolerance);
}
