// The valve's motion with inertia: it agrees with the quasi-static cycle where it should, and every
// drive ends with its energy in balance.
#include "engine/sealbench.h"

#include "tests/sanitized.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

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

// ---- ports ----

static const double full = 0.55e6;

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
  sb_params_set(&params, SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC, NULL);
  for (size_t i = 0; i < G_N_ELEMENTS(settings); i++) {
    sb_params_set(&params, (SbParamId)settings[i].id, settings[i].value, NULL);
  }
  SbModel model;
  SbPlan plan;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL), ==, SB_OK);
  sb_plan_make(&plan, &model);
  g_assert_cmpint(sb_run_create(&run, &model, &plan, &report), ==, SB_OK);
  g_assert_cmpint(sb_run_execute(run, NULL, &report), ==, SB_ERROR_INFEASIBLE);
  g_assert_cmpstr(report.parameter, ==, "chamber.flow");
  sb_run_destroy(run);
}

// ---- constrained bodies ----

static void assert_near(double a, double b, double tolerance) {
  g_assert_cmpfloat_with_epsilon(a, b, tolerance);
}

// The thesis cycle by the constrained parts is that of the reduced form; each joint bears what lies
// beyond it: its loads less its inertia.
static void test_bodies(void) {
  SbRun *reduced = run_with(SB_MODEL_MOTION_DYNAMIC, NULL, 0);
  SbRun *full_form = run_with(SB_MODEL_MOTION_BODIES, NULL, 0);
  size_t count;
  size_t other;
  const SbFrame *a = sb_run_frames(reduced, &count);
  const SbFrame *b = sb_run_frames(full_form, &other);
  g_assert_cmpuint(count, ==, other);
  double worst = 0;
  for (size_t i = 0; i < count; i++) {
    worst = fmax(worst, fabs(a[i].displacement - b[i].displacement) / 6.6e-3);
    worst = fmax(worst, fabs(a[i].force - b[i].force) / 35);
  }
  g_test_message("bodies against one coordinate: %.2g", worst);
  g_assert_cmpfloat(worst, <, 1e-9);
  g_assert_null(sb_run_reactions(reduced, 0));
  g_assert_cmpuint(sb_run_summary(reduced)->bodies.joints, ==, 0);

  const SbBodiesSummary *bodies = &sb_run_summary(full_form)->bodies;
  const SbValvePart *part = sb_run_model(full_form)->parts.part;
  g_assert_cmpint(bodies->gruebler, ==, 1);
  g_assert_cmpint(bodies->constraints, ==, 41);
  g_assert_cmpuint(bodies->joints, ==, SB_VALVE_JOINTS);
  g_assert_cmpfloat(bodies->acceleration_error, <, 1e-12);
  assert_near(bodies->moving_mass, 3.73e-3 + 6.46e-6 + 1e-10, 1e-15);
  for (size_t i = 0; i < count; i++) {
    const SbReaction *joint = sb_run_reactions(full_form, i);
    const SbFrame *f = &b[i];
    double inner = f->seal[SB_INNER].friction;
    double outer = f->seal[SB_OUTER].friction;
    // Newton for the whole stem.
    double total = f->force - f->pressure_force - f->spring_force - f->stop_force - inner - outer;
    double acceleration = total / bodies->moving_mass;
    double top = part[SB_VALVE_STEM_TOP].mass * acceleration + f->pressure_force + f->spring_force;
    double seal_in = part[SB_VALVE_INNER_SEAL].mass * acceleration + inner;
    double seal_out = part[SB_VALVE_OUTER_SEAL].mass * acceleration + outer;
    double block = f->force - part[SB_VALVE_BLOCK].mass * acceleration;
    double bottom = block - f->stop_force - part[SB_VALVE_STEM_BOTTOM].mass * acceleration;
    assert_near(joint[SB_VALVE_CENTRE_TOP].force[0], -top, 1e-9);
    assert_near(joint[SB_VALVE_INNER_CENTRE].force[0], seal_in, 1e-9);
    assert_near(joint[SB_VALVE_OUTER_CENTRE].force[0], seal_out, 1e-9);
    assert_near(joint[SB_VALVE_BLOCK_BOTTOM].force[0], -block, 1e-9);
    assert_near(joint[SB_VALVE_BOTTOM_CENTRE].force[0], -bottom, 1e-9);
    // The ground holds the housing against the machine.
    assert_near(joint[SB_VALVE_HOUSING_GROUND].force[0],
                -(f->force - bodies->moving_mass * acceleration), 1e-9);
    for (int k = 0; k < SB_VALVE_JOINTS; k++) {
      assert_near(hypot(joint[k].force[1], joint[k].force[2]), 0, 1e-12);
      assert_near(hypot(joint[k].torque[1], joint[k].torque[2]), 0, 1e-12);
    }
  }
  sb_run_destroy(reduced);
  sb_run_destroy(full_form);
}

// Joints that leave too much or too little are refused, with the count and the joint's key.
static void test_joints(void) {
  const struct {
    SbParamId id;
    int kind;
    const char *key, *text;
  } cases[] = {
      {SB_P_JOINT_BLOCK_GROUND, SB_JOINT_FIXED, "joint.block_ground", "over-constrained"},
      {SB_P_JOINT_BLOCK_GROUND, SB_JOINT_REVOLUTE, "joint.block_ground", "does not move along"},
      {SB_P_JOINT_INNER_CENTRE, SB_JOINT_NONE, "joint.inner_centre", "'inner seal' is the freest"},
      {SB_P_JOINT_HOUSING_GROUND, SB_JOINT_NONE, "joint.housing_ground", "'valve housing'"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    SbParams params;
    SbModel model;
    SbProblems problems;
    sb_params_init(&params);
    sb_params_set(&params, cases[i].id, cases[i].kind, NULL);
    // Nobody asks: nothing to refuse.
    g_assert_cmpint(sb_model_compile(&model, &params, &problems), ==, SB_OK);
    sb_params_set(&params, SB_P_MODELS_MOTION, SB_MODEL_MOTION_BODIES, NULL);
    g_assert_cmpint(sb_model_compile(&model, &params, &problems), ==, SB_ERROR_INPUT);
    g_assert_cmpstr(problems.item[0].key, ==, cases[i].key);
    g_test_message("%s", problems.item[0].text);
    g_assert_nonnull(strstr(problems.item[0].text, cases[i].text));
  }
}

// ---- friction's keys ----

// A stem that is stuck has no speed at all; its seals' friction is what balance needs.
static void test_stuck(void) {
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, NULL, 0);
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  for (size_t i = 0; frames[i].stage < SB_STAGE_B; i++) {
    g_assert_true(frames[i].velocity == 0);
    g_assert_true(frames[i].displacement == 0);
  }
  sb_run_destroy(run);
}

// friction.tangential_stiffness: between the lifting off the rest stop and B the slope A-B is
// machine and both seals in series. friction.dwell_gain: the peak grows with the logarithm of
// drive.rest. friction.stribeck_speed: sliding at that speed has lost all but 1/e of the peak.
static void test_friction_keys(void) {
  const double kt = 2e4;
  const Setting elastic[] = {{SB_P_FRICTION_TANGENTIAL_STIFFNESS, kt}, {SB_P_OUTPUT_FRAMES, 20000}};
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, elastic, 2);
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  const SbFrame *from = NULL;
  const SbFrame *to = NULL;
  for (size_t i = 0; i < count && frames[i].stage == SB_STAGE_A; i++) {
    from = frames[i].force < 15 ? &frames[i] : from;
    to = frames[i].force < 19 ? &frames[i] : to;
  }
  double slope = (to->force - from->force) / (to->platen - from->platen);
  assert_near(slope, 1 / (1 / 1e5 + 1 / (2 * kt)), 2e-3 * slope);
  sb_run_destroy(run);

  run = run_with(SB_MODEL_MOTION_DYNAMIC, NULL, 0);
  double peak = sb_run_summary(run)->force_breakaway;
  double level = 0;
  frames = sb_run_frames(run, &count);
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    level += frames[sb_run_summary(run)->stage[SB_STAGE_C].frame].seal[seal].friction;
  }
  sb_run_destroy(run);
  const double rest = 604800;
  const Setting dwell[] = {
      {SB_P_FRICTION_DWELL_GAIN, 0.02}, {SB_P_FRICTION_DWELL_TIME, 1}, {SB_P_DRIVE_REST, rest}};
  run = run_with(SB_MODEL_MOTION_DYNAMIC, dwell, 3);
  // The rest lasts until break-away; friction in C is that of sliding, or of rest between slips.
  double grown = sb_run_summary(run)->force_breakaway - peak;
  g_assert_cmpfloat_with_epsilon(grown / (0.02 * log1p(rest) * level), 1, 0.1);
  sb_run_destroy(run);

  // The curve at its own speed and at twice that, in a stroke without stick-slip.
  double force[2];
  double ratio = 0;
  for (int i = 0; i < 2; i++) {
    const Setting law[] = {{SB_P_FRICTION_STRIBECK_SPEED, 0.1 / (i + 1)},
                           {SB_P_DRIVE_SPEED, 0.1},
                           {SB_P_DRIVE_DAMPING_RATIO, 1},
                           {SB_P_FRICTION_STATIC_RATIO, 1.1}};
    run = run_with(SB_MODEL_MOTION_DYNAMIC, law, 4);
    frames = sb_run_frames(run, &count);
    const SbFrame *late = &frames[sb_run_summary(run)->stage[SB_STAGE_D].frame];
    assert_near(late->velocity, 0.1, 1e-3);
    force[i] = late->seal[SB_OUTER].friction_boundary;
    const SbSealSummary *outer = &sb_run_summary(run)->seal[SB_OUTER];
    ratio = outer->friction_static / outer->friction_boundary;
    sb_run_destroy(run);
  }
  // L (1 + (r - 1) exp(-1)) against L (1 + (r - 1) exp(-2)); r exceeds 1.1, for at rest the film
  // has gone too.
  assert_near(force[0] / force[1], (1 + (ratio - 1) * exp(-1)) / (1 + (ratio - 1) * exp(-2)), 1e-3);
}

// ---- hard cases ----

// Friction on the way back exactly as strong as the pressure, by the pressure's diameter.
static double balancing_diameter(void) {
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, NULL, 0);
  double friction = sb_run_model(run)->pressure_force - sb_run_summary(run)->force_return_min;
  sb_run_destroy(run);
  return sqrt(friction / full * 4 / M_PI);
}

// All run to their end with finite frames and a closed balance (run_with asserts 1e-6).
static void test_hard(void) {
  const struct {
    const char *name;
    Setting setting[4];
    bool returns;
  } cases[] = {
      {"no friction",
       {{SB_P_FRICTION_SHEAR_STRENGTH, 0}, {SB_P_FRICTION_LOAD_COEFFICIENT, 0}},
       true},
      {"static 5 x kinetic",
       {{SB_P_FRICTION_STATIC_RATIO, 5}, {SB_P_DRIVE_REVERSAL_FORCE, 100}},
       false},
      {"stop 1e9 N/m", {{SB_P_HOUSING_STOP_STIFFNESS, 1e9}}, true},
      {"mass 1e-10 kg",
       {{SB_P_STEM_MASS, 1e-10},
        {SB_P_DRIVE_SPEED, 0.1},
        {SB_P_PART_INNER_SEAL_MASS, 1e-13},
        {SB_P_PART_OUTER_SEAL_MASS, 1e-13}},
       true},
      {"1 um/s", {{SB_P_DRIVE_SPEED, 1e-6}}, true},
      {"10 m/s", {{SB_P_DRIVE_SPEED, 10}}, true},
      {"reversal every millisecond",
       {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_SINUSOID},
        {SB_P_DRIVE_FREQUENCY, 500},
        {SB_P_DRIVE_AMPLITUDE, 0.5e-3},
        {SB_P_DRIVE_CYCLES, 20}},
       false},
      {"undamped machine of 2e9 N/m",
       {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_SINUSOID},
        {SB_P_DRIVE_STIFFNESS, 2e9},
        {SB_P_DRIVE_DAMPING_RATIO, 0},
        {SB_P_DRIVE_FREQUENCY, 200}},
       false},
      {"machine of 5e9 N/m", {{SB_P_DRIVE_STIFFNESS, 5e9}}, true},
      {"presses of a millisecond",
       {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
        {SB_P_DRIVE_RISE_TIME, 1e-3},
        {SB_P_DRIVE_HOLD_TIME, 0},
        {SB_P_DRIVE_CYCLES, 50}},
       true},
      {"friction balances pressure", {{SB_P_STEM_PRESSURE_DIAMETER, balancing_diameter()}}, false},
      {"on the land's edge at rest", {{SB_P_BORE_LAND_EDGE, 0}}, true},
      {"vented in one step",
       {{SB_P_CANISTER_PRESSURE_MAP, SB_MAP_PORTS},
        {SB_P_BORE_VENT_POSITION, 9e-3},
        {SB_P_CHAMBER_FLOW, 1}},
       true},
      {"no pressure", {{SB_P_CANISTER_PRESSURE, 0}}, false},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    Setting setting[5] = {{SB_P_OUTPUT_FRAMES, 100}};
    size_t n = 1;
    for (int k = 0; k < 4 && (cases[i].setting[k].id != 0 || cases[i].setting[k].value != 0); k++) {
      setting[n++] = cases[i].setting[k];
    }
    SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, setting, n);
    const SbSummary *summary = sb_run_summary(run);
    g_test_message("%s: closure %.1e, %zu steps, %.0f ms", cases[i].name, summary->energy.closure,
                   summary->steps, 1e3 * summary->wall_s);
    size_t count;
    const SbFrame *frames = sb_run_frames(run, &count);
    for (size_t k = 0; k < count; k++) {
      g_assert_true(isfinite(frames[k].displacement) && isfinite(frames[k].velocity));
      g_assert_true(isfinite(frames[k].force) && isfinite(frames[k].stop_force));
      g_assert_cmpfloat(frames[k].displacement, >=, -1e-12);
    }
    g_assert_cmpint(summary->returns, ==, cases[i].returns);
    sb_run_destroy(run);
  }
}

// ---- accuracy and time ----

typedef struct {
  const char *name;
  Setting setting[4];
} Case;

// Tolerances a decade apart: the errors of peak, break-away and loop against a much finer motion
// fall with the tolerance, and the estimate covers them.
static void test_tolerance(void) {
  static const Case cases[] = {
      {"stick-slip over the edge", {{SB_P_OUTPUT_FRAMES, 50}}},
      {"Stribeck",
       {{SB_P_FRICTION_STRIBECK_SPEED, 1e-3}, {SB_P_DRIVE_SPEED, 5e-3}, {SB_P_OUTPUT_FRAMES, 50}}},
      {"hand, elastic seals",
       {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
        {SB_P_FRICTION_TANGENTIAL_STIFFNESS, 3e4},
        {SB_P_OUTPUT_FRAMES, 50}}},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    Setting setting[5];
    size_t n = 0;
    while (n < 4 && cases[i].setting[n].id != 0) {
      setting[n] = cases[i].setting[n];
      n++;
    }
    setting[n] = (Setting){SB_P_OUTPUT_MOTION_TOLERANCE, 1e-11};
    SbRun *fine = run_with(SB_MODEL_MOTION_DYNAMIC, setting, n + 1);
    const SbSummary *a = sb_run_summary(fine);
    double coarsest = 0;
    double finest = 0;
    for (int decade = 6; decade <= 9; decade++) {
      setting[n].value = pow(10, -decade);
      SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, setting, n + 1);
      const SbSummary *b = sb_run_summary(run);
      double force = fabs(b->force_peak - a->force_peak) / a->force_peak;
      for (int stage = SB_STAGE_B; stage < SB_STAGE_COUNT; stage++) {
        force = fmax(force, fabs(b->stage[stage].force - a->stage[stage].force) / a->force_peak);
      }
      double loop = fabs(b->energy.loop / a->energy.loop - 1);
      g_test_message("%-26s 1e-%d: force %.1e (estimate %.1e), loop %.1e (estimate %.1e)",
                     cases[i].name, decade, force, b->error_force, loop, b->error_energy);
      g_assert_cmpfloat(force, <=, 3 * b->error_force);
      g_assert_cmpfloat(loop, <=, 3 * b->error_energy);
      g_assert_cmpfloat(b->force_return_min, ==, a->force_return_min);
      coarsest = decade == 6 ? fmax(force, loop) : coarsest;
      finest = fmax(force, loop);
      sb_run_destroy(run);
    }
    // Three decades of tolerance: two at least of error, unless rounding is reached.
    g_assert_cmpfloat(finest, <=, fmax(1e-2 * coarsest, 1e-10));
    sb_run_destroy(fine);
  }
}

// A whole cycle with closed-form seals, its error estimate included. Time of the processor, so that
// a busy machine does not count.
static void test_time(void) {
  double least = INFINITY;
  // The least of many, for what shares the machine slows some of them.
  for (int i = 0; i < 60 && (i < 5 || least > 0.018); i++) {
    clock_t start = clock();
    SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, NULL, 0);
    least = fmin(least, (double)(clock() - start) / CLOCKS_PER_SEC);
    sb_run_destroy(run);
  }
  g_test_message("a dynamic cycle takes %.1f ms", 1e3 * least);
  g_assert_cmpfloat(least, <, SB_SANITIZED ? 0.4 : 0.020);
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

static bool warned(const SbRun *run, const char *code) {
  const SbWarnings *list = &sb_run_summary(run)->warnings;
  for (size_t i = 0; i < list->count; i++) {
    if (g_str_equal(list->item[i].code, code)) {
      return true;
    }
  }
  return false;
}

// Without friction the stem slips where it leaves its stops, at the pressure's force; a finger that
// cannot move it says so.
static void test_first_slip(void) {
  Setting smooth[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
                      {SB_P_FRICTION_SHEAR_STRENGTH, 0},
                      {SB_P_FRICTION_LOAD_COEFFICIENT, 0}};
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, smooth, 3);
  const SbSummary *summary = sb_run_summary(run);
  for (int stage = SB_STAGE_A; stage < SB_STAGE_COUNT; stage++) {
    g_assert_true(summary->stage[stage].reached);
  }
  double pressure = sb_run_model(run)->pressure_force;
  g_assert_cmpfloat(fabs(summary->stage[SB_STAGE_B].force / pressure - 1), <, 1e-9);
  g_assert_cmpfloat(fabs(summary->stage[SB_STAGE_E].force / pressure - 1), <, 1e-6);
  g_assert_false(warned(run, "no-slip"));
  sb_run_destroy(run);
  Setting weak[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND}, {SB_P_DRIVE_PEAK_FORCE, 28}};
  run = run_with(SB_MODEL_MOTION_DYNAMIC, weak, 2);
  g_assert_false(sb_run_summary(run)->stage[SB_STAGE_B].reached);
  g_assert_true(warned(run, "no-slip"));
  sb_run_destroy(run);
}

// A finger that gives way moves the stem at the speed at which its force, the pressure's and the
// seals' balance, after the 37 us that mass over damping take: c v = F(t) - F_p - f.
static void test_finger(void) {
  const double damping = 100;
  Setting settings[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
                        {SB_P_DRIVE_FINGER_DAMPING, damping},
                        {SB_P_OUTPUT_FRAMES, 4000}};
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, settings, G_N_ELEMENTS(settings));
  const SbModel *model = sb_run_model(run);
  size_t count, seen = 0;
  const SbFrame *frames = sb_run_frames(run, &count);
  double slip = sb_run_summary(run)->stage[SB_STAGE_B].time;
  for (size_t i = 0; i < count; i++) {
    const SbFrame *f = &frames[i];
    if (f->stage != SB_STAGE_B || f->time < slip + 1e-3 || f->on_event) {
      continue;
    }
    double finger = model->peak_force * f->time / model->rise_time;
    double rubs = f->seal[SB_INNER].friction + f->seal[SB_OUTER].friction;
    double speed = (finger - model->pressure_force - rubs) / damping;
    // Ramp and mass: v lags by m/c of its rate, 1.1 m/s2.
    g_assert_cmpfloat(fabs(f->velocity - speed), <, 2e-3 * speed + 5e-5);
    g_assert_cmpfloat(fabs(f->force - (finger - damping * f->velocity)), <, 1e-9 * finger);
    seen++;
  }
  g_assert_cmpuint(seen, >, 50);
  g_assert_true(sb_run_summary(run)->returns);
  sb_run_destroy(run);
}

// A finger has no speed of its own: the films are those at which the stem slides, whatever
// drive.speed says, each frame's at its own speed, and the work of friction follows.
static void test_own_speed(void) {
  Setting slow[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND}, {SB_P_DRIVE_SPEED, 1e-6}};
  Setting quick[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND}, {SB_P_DRIVE_SPEED, 1}};
  SbRun *a = run_with(SB_MODEL_MOTION_DYNAMIC, slow, 2);
  SbRun *b = run_with(SB_MODEL_MOTION_DYNAMIC, quick, 2);
  const SbSummary *summary = sb_run_summary(a);
  const SbStageMark *B = &summary->stage[SB_STAGE_B], *C = &summary->stage[SB_STAGE_C];
  double speed = (C->displacement - B->displacement) / (C->time - B->time);
  g_assert_cmpfloat(speed, >, 0.1);
  const SbModel *model = sb_run_model(a);
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    const SbSealSummary *own = &summary->seal[seal];
    const SbSealModel *ring = &model->seal[seal];
    // Thesis equation 7.5 at half the sliding speed, and the net load: the fluid's share, pressure
    // difference times half the width, is off.
    double fluid = seal == SB_OUTER ? 0.55e6 * own->contact_width / 2 : 0;
    double U = model->viscosity * speed / 2 / (ring->reduced_modulus * ring->radius);
    double W = (own->load_per_length - fluid) / (ring->reduced_modulus * ring->radius);
    double film = 1.492 * pow(U, 0.5434) * pow(W, -0.2893) * ring->radius;
    g_assert_cmpfloat(fabs(own->film_central / film - 1), <, 0.01);
    g_assert_cmpfloat(fabs(own->film_central / sb_run_summary(b)->seal[seal].film_central - 1), <,
                      0.02);
    size_t count;
    const SbFrame *frames = sb_run_frames(a, &count);
    size_t seen = 0;
    for (size_t i = 0; i < count; i++) {
      const SbSealFrame *at = &frames[i].seal[seal];
      if (at->film_central > 0 && frames[i].stage == SB_STAGE_B) {
        double expected = film * pow(fabs(frames[i].velocity) / speed, 0.5434);
        g_assert_cmpfloat(fabs(at->film_central / expected - 1), <, 0.01);
        g_assert_cmpfloat(fabs(at->lambda / (at->film_central / model->sigma) - 1), <, 1e-9);
        seen++;
      }
    }
    g_assert_cmpuint(seen, >, 0);
  }
  g_assert_cmpfloat(fabs(summary->energy.friction / sb_run_summary(b)->energy.friction - 1), <,
                    0.01);
  sb_run_destroy(a);
  sb_run_destroy(b);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/run-dynamic/against-quasi-static", test_against_quasi_static);
  g_test_add_func("/run-dynamic/stick-slip", test_stick_slip);
  g_test_add_func("/run-dynamic/drives", test_drives);
  g_test_add_func("/run-dynamic/no-return", test_no_return);
  g_test_add_func("/run-dynamic/readings", test_readings);
  g_test_add_func("/run-dynamic/through-flow", test_through_flow);
  g_test_add_func("/run-dynamic/bodies", test_bodies);
  g_test_add_func("/run-dynamic/joints", test_joints);
  g_test_add_func("/run-dynamic/stuck", test_stuck);
  g_test_add_func("/run-dynamic/friction-keys", test_friction_keys);
  g_test_add_func("/run-dynamic/hard", test_hard);
  g_test_add_func("/run-dynamic/tolerance", test_tolerance);
  g_test_add_func("/run-dynamic/own-speed", test_own_speed);
  g_test_add_func("/run-dynamic/first-slip", test_first_slip);
  g_test_add_func("/run-dynamic/finger", test_finger);
  if (g_test_slow()) {
    // Alone on the machine: where others keep it busy a time says nothing.
    g_test_add_func("/run-dynamic/time", test_time);
  }
  g_test_add_func("/run-dynamic/refused", test_refused);
  return g_test_run();
}
