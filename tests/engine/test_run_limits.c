// The limits of the motion with inertia: hard cases, errors that fall with the tolerance and stay
// below their estimates, and the time a cycle takes.
#include "tests/engine/motion_run.h"

// ---- hard cases ----

// Friction on the way back exactly as strong as the pressure, by the pressure's diameter.
static double balancing_diameter(void) {
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, NULL, 0);
  double friction = sb_run_model(run)->pressure_force - sb_run_summary(run)->force_return_min;
  sb_run_destroy(run);
  return sqrt(friction / 0.55e6 * 4 / M_PI);
}

// All run to their end with finite frames and a closed balance (run_with asserts 1e-6).
static void test_hard(void) {
  enum { SETTINGS = 13 };
  const struct {
    const char *name;
    Setting setting[SETTINGS];
    bool returns;
  } cases[] = {
      {"no friction",
       {{SB_P_FRICTION_SHEAR_STRENGTH, 0}, {SB_P_FRICTION_LOAD_COEFFICIENT, 0}},
       true},
      {"no friction, undamped machine of 4e7 N/m",
       {{SB_P_FRICTION_SHEAR_STRENGTH, 0},
        {SB_P_FRICTION_LOAD_COEFFICIENT, 0},
        {SB_P_DRIVE_STIFFNESS, 4e7},
        {SB_P_DRIVE_DAMPING_RATIO, 0}},
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
      // So stiff and damped that the land's edge takes steps of 1e8 times its relaxation.
      {"damped machine of 3.45e8 N/m on 6 mg",
       {{SB_P_DRIVE_STIFFNESS, 3.45e8},
        {SB_P_DRIVE_DAMPING_RATIO, 2},
        {SB_P_DRIVE_SPEED, 5.62e-5},
        {SB_P_STEM_MASS, 6.47e-6}},
       true},
      // Where friction falls with the speed less damping lets it slip over the edge without end.
      {"machine of 5e9 N/m, critically damped",
       {{SB_P_DRIVE_STIFFNESS, 5e9}, {SB_P_DRIVE_DAMPING_RATIO, 1}},
       true},
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
      // The stem rests at last where the stiff stop has pushed it, the land's edge under its
      // contact: it slows down to the speed of rest in steps of any size.
      {"creeps to rest beside a stop of 1e8 N/m",
       {{SB_P_BORE_DIAMETER, 6.57e-3},
        {SB_P_GLAND_RADIAL_SPACE, 1.8556e-3},
        {SB_P_SEAL_SECTION_DIAMETER, 2.506e-3},
        {SB_P_DRIVE_STROKE, 9.036e-3},
        {SB_P_BORE_LAND_EDGE, 7.603e-3},
        {SB_P_HOUSING_STOP_RESTITUTION, 0.11},
        {SB_P_HOUSING_STOP_STIFFNESS, 1e8}},
       false},
      // Friction that falls with the speed holds the stem on the stop at what it can just hold:
      // steps cannot be as accurate as the rounding of the stop's force.
      {"left by the finger on a stop, at the limit of friction",
       {{SB_P_BORE_DIAMETER, 10.52e-3},
        {SB_P_GLAND_RADIAL_SPACE, 2.298e-3},
        {SB_P_SEAL_SECTION_DIAMETER, 2.901e-3},
        {SB_P_SEAL_INNER_DIAMETER, 5.202e-3},
        {SB_P_STEM_PRESSURE_DIAMETER, 8.373e-3},
        {SB_P_STEM_MASS, 0.714e-3},
        {SB_P_CANISTER_PRESSURE, 0},
        {SB_P_FLUID_VISCOSITY, 1.209e-3},
        {SB_P_SURFACE_GT_PRODUCT, 0.04921},
        {SB_P_FRICTION_SHEAR_STRENGTH, 0.4547e6},
        {SB_P_FRICTION_LOAD_COEFFICIENT, 0.01327},
        {SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
        {SB_P_FRICTION_STRIBECK_SPEED, 1.087e-3}},
       false},
      // A thousand slips in groups, of which a coarse tolerance still closes the energies.
      {"groups of slips to a tolerance of 8e-7",
       {{SB_P_BORE_DIAMETER, 7.173e-3},
        {SB_P_GLAND_RADIAL_SPACE, 1.094e-3},
        {SB_P_STEM_MASS, 12.22e-3},
        {SB_P_SEAL_OUTER_MODULUS, 1.73e6},
        {SB_P_SEAL_INNER_MODULUS, 1.73e6},
        {SB_P_CANISTER_PRESSURE, 0},
        {SB_P_FRICTION_SHEAR_STRENGTH, 0.3631e6},
        {SB_P_FRICTION_STATIC_RATIO, 1.9555},
        {SB_P_FRICTION_STRIBECK_SPEED, 0.09011},
        {SB_P_DRIVE_DAMPING_RATIO, 0.7015},
        {SB_P_OUTPUT_MOTION_TOLERANCE, 7.887e-7},
        {SB_P_MODELS_FIT, SB_FIT_LINDLEY}},
       false},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    Setting setting[1 + SETTINGS] = {{SB_P_OUTPUT_FRAMES, 100}};
    size_t n = 1;
    for (int k = 0; k < SETTINGS && (cases[i].setting[k].id != 0 || cases[i].setting[k].value != 0);
         k++) {
      setting[n++] = cases[i].setting[k];
    }
    SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, setting, n);
    const SbSummary *summary = sb_run_summary(run);
    g_test_message("%s: closure %.1e, %zu steps, %.0f ms", cases[i].name, summary->energy.closure,
                   summary->steps, 1e3 * summary->wall_s);
    g_assert_cmpuint(summary->steps, <, 100000);
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

// Tolerances a decade apart: the errors of peak, stage forces and works against a much finer motion
// fall with the tolerance, and the estimate covers them. The free return crosses the land's edge in
// fewer steps than any other; the sinusoid's peak lies between steps.
static void test_tolerance(void) {
  static const Case cases[] = {
      {"stick-slip over the edge", {{SB_P_OUTPUT_FRAMES, 50}}},
      {"Stribeck",
       {{SB_P_FRICTION_STRIBECK_SPEED, 1e-3}, {SB_P_DRIVE_SPEED, 5e-3}, {SB_P_OUTPUT_FRAMES, 50}}},
      {"hand, elastic seals",
       {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
        {SB_P_FRICTION_TANGENTIAL_STIFFNESS, 3e4},
        {SB_P_OUTPUT_FRAMES, 50}}},
      {"free return", {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_FREE_RETURN}, {SB_P_OUTPUT_FRAMES, 50}}},
      {"sinusoid",
       {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_SINUSOID},
        {SB_P_DRIVE_AMPLITUDE, 2e-3},
        {SB_P_DRIVE_FREQUENCY, 20},
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
      double scale = fmax(a->force_peak, 1);
      double force = fabs(b->force_peak - a->force_peak) / scale;
      for (int stage = SB_STAGE_B; stage < SB_STAGE_COUNT; stage++) {
        force = fmax(force, fabs(b->stage[stage].force - a->stage[stage].force) / scale);
      }
      double work = fmax(fabs(b->energy.loop - a->energy.loop),
                         fabs(b->energy.friction - a->energy.friction)) /
                    a->energy.external_max;
      g_test_message("%-26s 1e-%d: force %.1e (estimate %.1e), work %.1e (estimate %.1e)",
                     cases[i].name, decade, force, b->error_force, work, b->error_energy);
      g_assert_cmpfloat(force, <=, 3 * b->error_force);
      g_assert_cmpfloat(work, <=, 3 * b->error_energy);
      // Where nothing but the motion tells the films' speed it carries that error, too.
      g_assert_cmpfloat(fabs(b->force_return_min - a->force_return_min), <=,
                        3 * scale * b->error_force);
      coarsest = decade == 6 ? fmax(force, work) : coarsest;
      finest = fmax(force, work);
      sb_run_destroy(run);
    }
    // Three decades of tolerance: two at least of error, unless rounding is reached.
    g_assert_cmpfloat(finest, <=, fmax(1e-2 * coarsest, 1e-10));
    sb_run_destroy(fine);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/run-limits/hard", test_hard);
  g_test_add_func("/run-limits/tolerance", test_tolerance);
  return g_test_run();
}
