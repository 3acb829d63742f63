// The films' history in runs: each frame's film, lambda, real area and friction are of one state,
// that of its own transient film, with asperities in it or beside.
#include "engine/valve/run/run_private.h"
#include "tests/engine/models.h"

#include <glib.h>
#include <math.h>

#define TRANSIENT                                                                                  \
  {SB_P_MODELS_FILM, SB_FILM_REYNOLDS}, {SB_P_MODELS_FILM_TIME, 1}, {                              \
    SB_P_OUTPUT_FRAMES, 50                                                                         \
  }

// Frames of a press by hand in which a seal slides on its whole contact.
static void assert_frames(const SbRun *run, bool coupled) {
  const SbModel *model = run->model;
  size_t sliding = 0, apart = 0;
  for (size_t i = 0; i < run->count; i++) {
    const SbFrame *frame = &run->frames[i];
    for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
      const SbSealFrame *s = &frame->seal[seal];
      if (s->land_fraction < 0.999F || !(fabs(s->friction_viscous) > 0)) {
        continue;
      }
      const double area = (s->contact_right - s->contact_left) * model->bore_circumference;
      const double boundary = model->shear_strength * s->real_area_share * area +
                              (coupled ? 0 : model->load_coefficient * s->load);
      g_assert_cmpfloat(fabs(fabs(s->friction_boundary) / boundary - 1), <, 1e-9);
      g_assert_cmpfloat(s->friction, ==, s->friction_boundary + s->friction_viscous);
      g_assert_cmpfloat(fabs(s->film_central / (model->sigma * s->lambda) - 1), <, 1e-12);
      // Couette's shear: beside, of the film at the middle; coupled, no more than of the least
      // film.
      const double shear = model->viscosity * fabs(frame->velocity) * area;
      const double viscous = fabs(s->friction_viscous);
      if (coupled) {
        g_assert_cmpfloat(viscous, <, 1.1 * shear / s->film_min);
      } else {
        const double middle = (1 - s->real_area_share) * shear / s->film_central;
        g_assert_cmpfloat(fabs(viscous / middle - 1), <, 1e-9);
      }
      const int way = frame->velocity < 0 ? SB_CYCLE_OUT : SB_CYCLE_IN;
      SbSealState steady;
      sb_run_state_at(&steady, (SbRun *)run, seal, frame->chamber, way, frame->velocity);
      sliding++;
      apart += fabs(s->film_central / steady.film_central - 1) > 0.05;
    }
  }
  g_test_message("%zu frames slide, %zu far from steady", sliding, apart);
  g_assert_cmpuint(sliding, >, 3);
  g_assert_cmpuint(apart, >, 1);
}

static void test_frames(void) {
  for (int coupled = 0; coupled < 2; coupled++) {
    const Setting settings[] = {TRANSIENT,
                                {SB_P_MODELS_ASPERITIES, coupled},
                                {SB_P_SURFACE_SIGMA, 0.2e-6},
                                {SB_P_FRICTION_LOAD_COEFFICIENT, coupled ? 0 : 0.19},
                                {SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC},
                                {SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
                                {SB_P_DRIVE_PEAK_FORCE, coupled ? 150 : 45},
                                {SB_P_DRIVE_HOLD_TIME, 0.05},
                                {SB_P_DRIVE_FINGER_DAMPING, 100}};
    SbModel model;
    compile(&model, settings, G_N_ELEMENTS(settings));
    SbRun *run = run_of(&model, SB_OK, NULL);
    const SbSummary *summary = sb_run_summary(run);
    g_assert_cmpuint(summary->counters.film_steps, >, 0);
    assert_frames(run, coupled);
    sb_run_destroy(run);
  }
}

// A stem of micrograms is thrown at hundreds of metres a second, then slides slowly and rests:
// films a thousand times thinner than those of its begin are followed to the end. Random valve 257
// of seed 11.
static void test_thinned(void) {
  const Setting settings[] = {TRANSIENT,
                              {SB_P_BORE_DIAMETER, 0.004090419962691194},
                              {SB_P_GLAND_RADIAL_SPACE, 0.0006300691169661397},
                              {SB_P_SEAL_SECTION_DIAMETER, 0.0006739427157190502},
                              {SB_P_SEAL_INNER_DIAMETER, 0.0023286315221035052},
                              {SB_P_GLAND_AXIAL_WIDTH, 0.0006558071110326834},
                              {SB_P_STEM_PRESSURE_DIAMETER, 0.003817088886950178},
                              {SB_P_STEM_SEAL_SPACING, 0.003312040115370711},
                              {SB_P_STEM_MASS, 4.2972087365957416e-09},
                              {SB_P_DRIVE_STROKE, 0.006007023149350856},
                              {SB_P_BORE_LAND_EDGE, 0.003649356671096554},
                              {SB_P_SEAL_MODULUS, 8523268.313323833},
                              {SB_P_SEAL_POISSON_RATIO, 0.47914252634742566},
                              {SB_P_CANISTER_PRESSURE, 429800.9814937085},
                              {SB_P_FLUID_VISCOSITY, 0.0016439257825161333},
                              {SB_P_FLUID_DENSITY, 1177.9814288165128},
                              {SB_P_SURFACE_SIGMA, 4.712877114973624e-07},
                              {SB_P_SURFACE_SIGMA_OVER_BETA, 0.033803759496733754},
                              {SB_P_SURFACE_GT_PRODUCT, 0.19316287775073185},
                              {SB_P_FRICTION_SHEAR_STRENGTH, 4472694.165921702},
                              {SB_P_FRICTION_LOAD_COEFFICIENT, 0.3741003105915728},
                              {SB_P_FRICTION_STATIC_RATIO, 1.4621012102754043},
                              {SB_P_DRIVE_SPEED, 0.011130287126173626},
                              {SB_P_DRIVE_STIFFNESS, 2736.3313518713503},
                              {SB_P_DRIVE_REVERSAL_FORCE, 16.77886717018816},
                              {SB_P_MODELS_FIT, 3},
                              {SB_P_MODELS_SURFACE, 0},
                              {SB_P_MODELS_MOTION, 1},
                              {SB_P_CANISTER_PRESSURE_MAP, 2},
                              {SB_P_MODELS_FRICTION, 1},
                              {SB_P_FLUID_REST_FILM, 1.7140410775000043e-08},
                              {SB_P_FRICTION_BREAKAWAY, 1},
                              {SB_P_FRICTION_AGEING, 0.06197192697568295},
                              {SB_P_FRICTION_AGEING_TIME, 0.02979619398925637},
                              {SB_P_DRIVE_KIND, 0},
                              {SB_P_HOUSING_STOP_RESTITUTION, 0.9560355937214372},
                              {SB_P_HOUSING_STOP_STIFFNESS, 38071013.00512833},
                              {SB_P_DRIVE_DAMPING_RATIO, 0.5878188863497084},
                              {SB_P_CHAMBER_FLOW, 0},
                              {SB_P_BORE_VENT_WAY, 1},
                              {SB_P_BORE_VENT_POSITION, 0.007595152678913605},
                              {SB_P_BORE_REFILL_TRAVEL, 0},
                              {SB_P_CHAMBER_STIFFNESS, 3096733.7607635492},
                              {SB_P_FRICTION_TANGENTIAL_STIFFNESS, 21313.243330015222}};
  SbModel model;
  compile(&model, settings, G_N_ELEMENTS(settings));
  SbRun *run = run_of(&model, SB_OK, NULL);
  g_assert_cmpuint(sb_run_summary(run)->counters.film_steps, >, 0);
  sb_run_destroy(run);
}

// A film of which a coarse mesh knows nothing is followed on finer ones, up to an estimate below
// the film itself. Random valve 13 of seed 301.
static void test_sharpened(void) {
  const Setting settings[] = {TRANSIENT,
                              {SB_P_BORE_DIAMETER, 0.006988196008796185},
                              {SB_P_BORE_LAND_EDGE, 0.008813353420338217},
                              {SB_P_GLAND_RADIAL_SPACE, 0.002048665388207955},
                              {SB_P_GLAND_AXIAL_WIDTH, 0.002558743570296603},
                              {SB_P_SEAL_SECTION_DIAMETER, 0.0021850838048834637},
                              {SB_P_SEAL_INNER_DIAMETER, 0.0024884403752437867},
                              {SB_P_SEAL_MODULUS, 1892399.01626823},
                              {SB_P_SEAL_POISSON_RATIO, 0.4930298215137967},
                              {SB_P_STEM_PRESSURE_DIAMETER, 0.00551090565729799},
                              {SB_P_STEM_SEAL_SPACING, 0.009176405448650731},
                              {SB_P_STEM_MASS, 2.688656107604628e-09},
                              {SB_P_DRIVE_STROKE, 0.007459562098867579},
                              {SB_P_DRIVE_SPEED, 0.0019930806682515417},
                              {SB_P_DRIVE_STIFFNESS, 15846.048352121665},
                              {SB_P_DRIVE_REVERSAL_FORCE, 37.016217143293524},
                              {SB_P_DRIVE_REST, 0},
                              {SB_P_DRIVE_KIND, 0},
                              {SB_P_DRIVE_PEAK_FORCE, 11.554307505279953},
                              {SB_P_DRIVE_RISE_TIME, 1.781461469162045},
                              {SB_P_DRIVE_HOLD_TIME, 0.01110351594654368},
                              {SB_P_DRIVE_FINGER_DAMPING, 0},
                              {SB_P_DRIVE_AMPLITUDE, 0.0028632781161434602},
                              {SB_P_DRIVE_FREQUENCY, 9.243666547644013},
                              {SB_P_DRIVE_CYCLES, 1},
                              {SB_P_DRIVE_DAMPING_RATIO, 0.05},
                              {SB_P_CANISTER_PRESSURE, 948278.2486777485},
                              {SB_P_CANISTER_PRESSURE_MAP, 0},
                              {SB_P_CANISTER_AMBIENT_PRESSURE, 73569.55705914643},
                              {SB_P_FLUID_VISCOSITY, 0.004730006624618561},
                              {SB_P_FLUID_DENSITY, 1394.4291862069376},
                              {SB_P_FLUID_REST_FILM, 3.010207964761744e-09},
                              {SB_P_SURFACE_SIGMA, 1.8349015120591805e-08},
                              {SB_P_SURFACE_SIGMA_OVER_BETA, 0.038748844735228424},
                              {SB_P_SURFACE_GT_PRODUCT, 0.04896357435183731},
                              {SB_P_FRICTION_SHEAR_STRENGTH, 1723914.427712517},
                              {SB_P_FRICTION_LOAD_COEFFICIENT, 0.08077993961506232},
                              {SB_P_FRICTION_STATIC_RATIO, 1.5080120488586228},
                              {SB_P_OUTPUT_MOTION_TOLERANCE, 3.4567777677176337e-09},
                              {SB_P_MODELS_FIT, 0},
                              {SB_P_MODELS_SURFACE, 0},
                              {SB_P_MODELS_ASPERITIES, 0},
                              {SB_P_MODELS_MOTION, 1},
                              {SB_P_STORAGE_TIME, 11305.726797421938},
                              {SB_P_STORAGE_TEMPERATURE, 319.07141414709736},
                              {SB_P_RUBBER_RELAXATION_SHARE_1, 0.1617217835825214},
                              {SB_P_RUBBER_RELAXATION_SHARE_2, 0.19368459607544247},
                              {SB_P_RUBBER_SHIFT, 0},
                              {SB_P_RUBBER_ENTROPIC, 1},
                              {SB_P_RUBBER_NETWORK_RATE, 1.1283995316604083e-09},
                              {SB_P_RUBBER_SWELL_MASS, 0.06497477203179428},
                              {SB_P_HOUSING_STOP_RESTITUTION, 0.7199422509838584},
                              {SB_P_HOUSING_STOP_STIFFNESS, 130677.2870944353}};
  SbModel model;
  compile(&model, settings, G_N_ELEMENTS(settings));
  SbRun *run = run_of(&model, SB_OK, NULL);
  g_assert_cmpfloat(sb_run_summary(run)->error_film_history, <, 1);
  sb_run_destroy(run);
}

// A steady film between asperities that has no solution on the first mesh, where a front meets a
// node, and one on the next. Random valve 26 of seed 301.
static void test_other_mesh(void) {
  const Setting settings[] = {{SB_P_OUTPUT_FRAMES, 50},
                              {SB_P_BORE_DIAMETER, 0.008342418460048115},
                              {SB_P_BORE_LAND_EDGE, 0.008848305564618944},
                              {SB_P_GLAND_RADIAL_SPACE, 0.001337911841592757},
                              {SB_P_GLAND_AXIAL_WIDTH, 0.0032011751567438034},
                              {SB_P_SEAL_SECTION_DIAMETER, 0.0018686545315845556},
                              {SB_P_SEAL_INNER_DIAMETER, 0.004741791187051871},
                              {SB_P_SEAL_MODULUS, 5810188.9754753085},
                              {SB_P_SEAL_POISSON_RATIO, 0.4826837896527088},
                              {SB_P_STEM_PRESSURE_DIAMETER, 0.00823203713514696},
                              {SB_P_STEM_SEAL_SPACING, 0.007875590636897193},
                              {SB_P_STEM_MASS, 0.0008267477085268499},
                              {SB_P_DRIVE_STROKE, 0.009088285036052426},
                              {SB_P_DRIVE_SPEED, 6.78477367800049e-05},
                              {SB_P_DRIVE_STIFFNESS, 1534.865639501514},
                              {SB_P_DRIVE_REVERSAL_FORCE, 23.310824728279997},
                              {SB_P_DRIVE_REST, 5.128450753416541},
                              {SB_P_CANISTER_PRESSURE, 795259.5045538165},
                              {SB_P_CANISTER_PRESSURE_MAP, 0},
                              {SB_P_FLUID_VISCOSITY, 0.00020409176471338094},
                              {SB_P_FLUID_DENSITY, 846.468266044204},
                              {SB_P_SURFACE_SIGMA, 3.067383167657721e-08},
                              {SB_P_SURFACE_SIGMA_OVER_BETA, 0.04011620259853719},
                              {SB_P_SURFACE_GT_PRODUCT, 0.0469639033099018},
                              {SB_P_FRICTION_SHEAR_STRENGTH, 1115447.9238595548},
                              {SB_P_FRICTION_LOAD_COEFFICIENT, 0.08812128571240381},
                              {SB_P_FRICTION_STATIC_RATIO, 1.2607318683878046},
                              {SB_P_MODELS_FIT, 0},
                              {SB_P_MODELS_FILM, 3},
                              {SB_P_MODELS_SURFACE, 0},
                              {SB_P_MODELS_ASPERITIES, 1},
                              {SB_P_MODELS_MOTION, 0},
                              {SB_P_MODELS_VISCOSITY, 0}};
  SbModel model;
  compile(&model, settings, G_N_ELEMENTS(settings));
  SbRun *run = run_of(&model, SB_OK, NULL);
  g_assert_true(sb_run_summary(run)->converged);
  sb_run_destroy(run);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/run-film/frames", test_frames);
  g_test_add_func("/run-film/thinned", test_thinned);
  g_test_add_func("/run-film/sharpened", test_sharpened);
  g_test_add_func("/run-film/other-mesh", test_other_mesh);
  return g_test_run();
}
