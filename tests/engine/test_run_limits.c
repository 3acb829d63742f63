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
        {SB_P_STEM_PRESSURE_DIAMETER, 5.794e-3},
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
        {SB_P_STEM_PRESSURE_DIAMETER, 5.794e-3},
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

// Drawn at random, once with balances of energies open by 4e-4, 2e-3 and 1.5e-6: a stem that a
// stiff machine drives without friction, whose works are 1e6 times their sum; a long step over the
// land's edge, behind which another event seemed to come first; and a motion to a tolerance that is
// coarse.
static void test_closes(void) {
  static const char *const valves[] = {
      "bore.diameter=0.0097895169842848028 gland.radial_space=0.0021754236231215345 "
      "seal.section_diameter=0.0021837136097922144 seal.inner_diameter=0.0052200215570387849 "
      "gland.axial_width=0.0023584446238905012 stem.pressure_diameter=0.0082097147860471925 "
      "stem.seal_spacing=0.0089288148881372133 stem.mass=0.0090627258344759595 "
      "drive.stroke=0.0086355311132017554 bore.land_edge=0.0079606188661788362 "
      "seal.modulus=4952703.3320215717 seal.poisson_ratio=0.48853455885759495 "
      "canister.pressure=148606.53061847138 fluid.viscosity=0.00025829026161084605 "
      "fluid.density=900.17810525142659 surface.sigma=1.4281765942183983e-06 "
      "surface.sigma_over_beta=0.011429966168363392 surface.gt_product=0.1506461756339246 "
      "friction.shear_strength=1480353.2075009847 "
      "friction.load_coefficient=0.020912707744086712 friction.static_ratio=1.4661598533521905 "
      "drive.speed=0.0010736215935738134 drive.stiffness=8782993633.5119152 "
      "drive.reversal_force=65.790623992550437 models.fit=5 models.film=1 models.surface=0 "
      "models.asperities=1 models.motion=1 canister.pressure_map=0 "
      "drive.rest=3.2565543033235564 models.adhesion=1 "
      "surface.hamaker_constant=1.0097452243058541e-19 friction.dwell_gain=0.098274003604478438 "
      "friction.dwell_time=0.77161111917827607 drive.kind=0 "
      "housing.stop_restitution=0.17478361500865927 housing.stop_stiffness=223434.58229856184 "
      "drive.damping_ratio=0.050000000000000003 output.motion_tolerance=1e-08 ",
      "bore.diameter=0.005234437381452961 gland.radial_space=0.0010177454767060726 "
      "seal.section_diameter=0.0011251815999109005 seal.inner_diameter=0.0031664928462228083 "
      "gland.axial_width=0.0011877838841623102 stem.pressure_diameter=0.0048368554929233308 "
      "stem.seal_spacing=0.004689038437254915 stem.mass=0.0013356504960101885 "
      "drive.stroke=0.0058394419140046115 bore.land_edge=0.0018663454803362874 "
      "seal.modulus=1623784.6777015345 seal.poisson_ratio=0.4967632286992768 "
      "canister.pressure=0 fluid.viscosity=0.00077946898611223577 "
      "fluid.density=1151.8126658149863 surface.sigma=6.9313048505215862e-07 "
      "surface.sigma_over_beta=0.073971123615835355 surface.gt_product=0.11290632413500487 "
      "friction.shear_strength=2117153.4964198195 "
      "friction.load_coefficient=0.020768031149162303 friction.static_ratio=1.0656698099866586 "
      "drive.speed=5.6297873471112632e-05 drive.stiffness=280328795.46228755 "
      "drive.reversal_force=8.3286753374314646 models.fit=2 models.film=3 models.surface=0 "
      "models.asperities=0 models.motion=1 canister.pressure_map=0 drive.rest=0 "
      "models.friction=1 seal.mooney_share=0.49983445755342693 life.actuations=3 "
      "life.running_in=5.0050025933964015 drive.kind=0 "
      "housing.stop_restitution=0.23809510970553491 housing.stop_stiffness=36611049.686360948 "
      "drive.damping_ratio=0.050000000000000003 output.motion_tolerance=8.9200566460584286e-09 "
      "stem.spring_stiffness=168.46051423898447 stem.spring_preload=15.028520638356856 "
      "friction.stribeck_speed=0.0066672679803629134 "
      "friction.tangential_stiffness=194194.75695903311 ",
      "bore.diameter=0.011088904188175663 gland.radial_space=0.003325723240521666 "
      "seal.section_diameter=0.0035171011400992329 seal.inner_diameter=0.0041159959662217648 "
      "gland.axial_width=0.0043425565874673083 stem.pressure_diameter=0.0080555127850654388 "
      "stem.seal_spacing=0.0149390026459867 stem.mass=6.8739654723074432e-06 "
      "drive.stroke=0.0083392097257431828 bore.land_edge=0.0042518469515846081 "
      "seal.modulus=10559547.190688327 seal.poisson_ratio=0.49186493551740401 "
      "canister.pressure=570589.14185460622 fluid.viscosity=0.00015830915358699049 "
      "fluid.density=877.8722346505657 surface.sigma=6.2550989075229492e-07 "
      "surface.sigma_over_beta=0.014950985265098023 surface.gt_product=0.1312143590270024 "
      "friction.shear_strength=1962489.0248173564 friction.load_coefficient=0.2845723163449857 "
      "friction.static_ratio=1.2673706541280618 drive.speed=6.4248322615659433e-05 "
      "drive.stiffness=379703.76958418073 drive.reversal_force=8.5667512525079079 models.fit=4 "
      "models.film=3 models.surface=1 models.asperities=0 models.motion=1 "
      "canister.pressure_map=0 drive.rest=0 output.tolerance=0.0048823065735838162 drive.kind=3 "
      "drive.amplitude=0.0011670511657824109 drive.frequency=6.9148249649247751 drive.cycles=3 "
      "housing.stop_restitution=0.33762266261865814 housing.stop_stiffness=1374447.1235628056 "
      "drive.damping_ratio=0.41161332922250793 output.motion_tolerance=4.4356312081821666e-08 "
      "stem.spring_stiffness=1765.5098168564787 stem.spring_preload=3.8654059174056798 "
      "friction.stribeck_speed=0.00026483718575931903 "
      "friction.tangential_stiffness=849268.26925118593 "};
  for (size_t i = 0; i < G_N_ELEMENTS(valves); i++) {
    g_auto(GStrv) pairs = g_strsplit(valves[i], " ", -1);
    Setting setting[64];
    size_t n = 0;
    for (; pairs[n] != NULL && *pairs[n] != 0; n++) {
      char *value = strchr(pairs[n], '=');
      *value++ = '\0';
      setting[n] = (Setting){(SbParamId)sb_param_find(pairs[n]), g_ascii_strtod(value, NULL)};
    }
    SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, setting, n);
    g_test_message("closure %.1e", sb_run_summary(run)->energy.closure);
    g_assert_cmpfloat(sb_run_summary(run)->energy.closure, <, 1e-6);
    sb_run_destroy(run);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/run-limits/hard", test_hard);
  g_test_add_func("/run-limits/tolerance", test_tolerance);
  g_test_add_func("/run-limits/closes", test_closes);
  return g_test_run();
}
