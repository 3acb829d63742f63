// The dose chamber's pressure by the ports that the stem uncovers: both readings of the thesis, and
// a flow through.
#include "tests/engine/motion_run.h"
#include "tests/engine/near.h"

#include "engine/valve/answer/evaluate.h"

#include <string.h>

static const double full = 0.55e6; // the canister's pressure [Pa]

// Pressure differences over both seals at a frame, in shares of the canister's.
static void assert_differences(const SbFrame *frame, double inner, double outer) {
  const SbSealFrame *seal = frame->seal;
  double of_inner = (double)(seal[SB_INNER].pressure_left - seal[SB_INNER].pressure_right);
  double of_outer = (double)(seal[SB_OUTER].pressure_left - seal[SB_OUTER].pressure_right);
  g_assert_cmpfloat_with_epsilon(of_inner / full, inner, 1e-6);
  g_assert_cmpfloat_with_epsilon(of_outer / full, outer, 1e-6);
}

// The last frame on the way out above s.
static const SbFrame *returning_above(const SbRun *run, double s) {
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  const SbFrame *best = NULL;
  for (size_t i = 0; i < count; i++) {
    if (frames[i].stage >= SB_STAGE_E && frames[i].displacement > s) {
      best = &frames[i];
    }
  }
  g_assert_nonnull(best);
  return best;
}

// Both readings of the thesis (its table of pressure differences) from where the ports lie, by jets
// and in one step. Reading 1: a plain hole that the outer seal clears 0.25 mm + 0.5 mm from rest.
// Reading 2: a hole that opens on the return only, left behind near rest, where a by-pass refills.
static void test_readings(void) {
  const Setting readings[2][5] = {
      {{SB_P_BORE_VENT_POSITION, 9e-3}, {SB_P_CANISTER_PRESSURE_MAP, SB_MAP_PORTS}},
      {{SB_P_BORE_VENT_POSITION, 3.9e-3},
       {SB_P_CANISTER_PRESSURE_MAP, SB_MAP_PORTS},
       {SB_P_STEM_SEAL_SPACING, 4.2e-3},
       {SB_P_BORE_VENT_WAY, 1},
       {SB_P_BORE_REFILL_TRAVEL, 0.1e-3}}};
  for (int reading = 0; reading < 2; reading++) {
    for (int at_once = 0; at_once < 2; at_once++) {
      Setting settings[7];
      size_t count = reading == 0 ? 2 : 5;
      memcpy(settings, readings[reading], sizeof readings[reading]);
      settings[count++] = (Setting){SB_P_CHAMBER_FLOW, at_once};
      settings[count++] = (Setting){SB_P_FRICTION_STATIC_RATIO, 1};
      SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, settings, count);
      const SbSummary *summary = sb_run_summary(run);
      const SbFrame *frames = sb_run_frames(run, &count);
      bool filled = reading == 1;
      for (int stage = SB_STAGE_A; stage < SB_STAGE_COUNT; stage++) {
        g_assert_true(summary->stage[stage].reached);
      }
      // A to C.
      assert_differences(&frames[summary->stage[SB_STAGE_A].frame], !filled, filled);
      assert_differences(&frames[summary->stage[SB_STAGE_C].frame], !filled, filled);
      // C to F; the inner seal is out.
      assert_differences(&frames[summary->stage[SB_STAGE_D].frame], 0, 1);
      assert_differences(&frames[summary->stage[SB_STAGE_F].frame], 0, 1);
      // F to release, and after it.
      assert_differences(returning_above(run, 4.0e-3), 0, 1);
      g_assert_cmpfloat(frames[summary->stage[SB_STAGE_D].frame].seal[SB_INNER].load, ==, 0);
      double vented = INFINITY;
      for (size_t i = summary->stage[SB_STAGE_F].frame; i < count; i++) {
        vented = fmin(vented, frames[i].chamber_pressure);
      }
      g_assert_cmpfloat(vented, <, 1e-6 * full);
      assert_differences(&frames[count - 1], !filled, filled);
      g_assert_true(summary->returns);
      // The map that says so gives the same forces where the chamber is what it says (friction at
      // rest still lies 0.1 N above that of sliding: the film is gone).
      Setting same[] = {
          {SB_P_CANISTER_PRESSURE_MAP, filled ? SB_MAP_CHAMBER_FILLED : SB_MAP_CHAMBER_VENTED},
          {SB_P_FRICTION_STATIC_RATIO, 1}};
      SbRun *map = run_with(SB_MODEL_MOTION_DYNAMIC, same, 2);
      g_assert_cmpfloat_with_epsilon(summary->force_breakaway, sb_run_summary(map)->force_breakaway,
                                     0.01);
      g_assert_cmpfloat_with_epsilon(force_at(run, 5.5e-3, true), force_at(map, 5.5e-3, true), 0.1);
      sb_run_destroy(map);
      sb_run_destroy(run);
    }
  }
}

// Canister and vent at once have no pressure in one step; a jet has one, between the two.
static void test_through_flow(void) {
  Setting settings[] = {{SB_P_CANISTER_PRESSURE_MAP, SB_MAP_PORTS},
                        {SB_P_BORE_VENT_POSITION, 9e-3},
                        {SB_P_BORE_REFILL_TRAVEL, 0.1e-3},
                        {SB_P_BORE_REFILL_AREA, M_PI / 4 * 0.25e-6},
                        {SB_P_CHAMBER_FLOW, 0}};
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, settings, G_N_ELEMENTS(settings));
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  g_assert_cmpfloat_with_epsilon(frames[0].chamber_pressure, full / 2, 1e-6 * full);
  g_assert_cmpfloat_with_epsilon(frames[count - 1].chamber_pressure, full / 2, 1e-3 * full);
  sb_run_destroy(run);

  SbParams params;
  sb_params_init(&params);
  SbReport report = {0};
  settings[4].value = 1;
  g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC, NULL), ==,
                  SB_OK);
  for (size_t i = 0; i < G_N_ELEMENTS(settings); i++) {
    g_assert_cmpint(sb_params_set(&params, (SbParamId)settings[i].id, settings[i].value, NULL), ==,
                    SB_OK);
  }
  SbModel model;
  SbPlan plan;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  sb_plan_make(&plan, &model);
  g_assert_cmpint(sb_run_create(&run, &model, &plan, &report), ==, SB_OK);
  g_assert_cmpint(sb_run_execute(run, NULL, &report), ==, SB_ERROR_INFEASIBLE);
  g_assert_cmpstr(sb_input_key(report.input), ==, "chamber.flow");
  sb_run_destroy(run);
}

// Dose through a vent that opens on the way back and is left behind near rest: with time enough all
// but the vapour at ambient pressure, through narrow holes in proportion to their area; as an
// evaluator says.
static void test_dose(void) {
  double vented[3], kept[3];
  static const double hole[] = {0.5e-3, 10e-6, 5e-6};
  SbEvaluator *evaluator;
  g_assert_cmpint(sb_evaluator_create(&evaluator, NULL), ==, SB_OK);
  for (int i = 0; i < 3; i++) {
    const Setting settings[] = {{SB_P_FLUID_NAME, 1},
                                {SB_P_CANISTER_TEMPERATURE, 313.15},
                                {SB_P_BORE_VENT_POSITION, 3.9e-3},
                                {SB_P_BORE_VENT_DIAMETER, hole[i]},
                                {SB_P_CANISTER_PRESSURE_MAP, SB_MAP_PORTS},
                                {SB_P_STEM_SEAL_SPACING, 4.2e-3},
                                {SB_P_BORE_VENT_WAY, 1},
                                {SB_P_BORE_REFILL_TRAVEL, 0.1e-3}};
    SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, settings, G_N_ELEMENTS(settings));
    const SbSummary *summary = sb_run_summary(run);
    const double metered =
        summary->metered_volume * sb_model_value(sb_run_model(run), SB_P_FLUID_DENSITY);
    vented[i] = summary->dose_mass / metered;
    kept[i] = summary->kept_mass / summary->metered_volume;
    double value;
    const int figure = sb_figure_find("cycle.dose_mass_kg");
    const SbQuestion question = {.base = sb_run_model(run), .figure = &figure, .figure_count = 1};
    g_assert_cmpint(sb_evaluator_ask(&value, evaluator, &question, NULL), ==, SB_OK);
    g_assert_cmpfloat(value, ==, summary->dose_mass);
    sb_run_destroy(run);
  }
  sb_evaluator_destroy(evaluator);
  assert_close(kept[0], 4.03974, 1e-5); // test_fluid.c
  assert_close(vented[0], 1 - 4.03974 / 1146.74, 1e-5);
  g_assert_cmpfloat(vented[1], <, 0.9);
  g_assert_cmpfloat(vented[2], >, 0.01);
  assert_close(vented[1] / vented[2], 4.0, 0.01);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/run-ports/readings", test_readings);
  g_test_add_func("/run-ports/through-flow", test_through_flow);
  g_test_add_func("/run-ports/dose", test_dose);
  return g_test_run();
}
