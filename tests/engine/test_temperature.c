// One temperature through the valve: a named fluid's pressure, viscosity and density, what stays as
// somebody sets it, what is refused; pressures below ambient.
#include "models.h"
#include "near.h"

#include "engine/fluid/fluid.h"
#include "engine/valve/figures.h"

#include <math.h>
#include <string.h>

static const double zero = 273.15;
enum { R134A = 1, R227EA, R152A, R1234ZE, PROPELLANTS = R1234ZE };

// The choices are the fluids, in their order.
static void test_names(void) {
  const SbParam *param = sb_param(SB_P_FLUID_NAME);
  g_assert_cmpint(sb_param_choice_count(param), ==, sb_fluid_count);
  for (int i = 0; i < sb_fluid_count; i++) {
    char name[48];
    sb_param_choice_name(param, i, name, sizeof name);
    g_assert_cmpstr(name, ==, sb_fluids[i].name);
  }
  g_assert_cmpfloat(param->fallback, ==, 0);
}

// What follows from a fluid, from where, and that a given value stays.
static void test_follows(void) {
  static const struct {
    SbParamId id;
    SbFluidPropertyId property;
  } rows[] = {{SB_P_CANISTER_PRESSURE, SB_FLUID_PRESSURE},
              {SB_P_FLUID_VISCOSITY, SB_FLUID_VISCOSITY},
              {SB_P_FLUID_DENSITY, SB_FLUID_LIQUID}};
  const double T = zero + 5, ambient = 84e3;
  for (int fluid = R134A; fluid <= PROPELLANTS; fluid++) {
    SbFluidState state;
    g_assert_cmpint(sb_fluid_state(&state, NULL, &sb_fluids[fluid], T, 0, NULL), ==, SB_OK);
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
      SbParams params;
      SbParamDefault derived;
      sb_params_init(&params);
      g_assert_cmpint(sb_params_set(&params, SB_P_CANISTER_TEMPERATURE, T, NULL), ==, SB_OK);
      g_assert_cmpint(sb_params_set(&params, SB_P_CANISTER_AMBIENT_PRESSURE, ambient, NULL), ==,
                      SB_OK);
      // Without a name the temperature changes none of them.
      g_assert_cmpfloat(sb_params_get(&params, rows[i].id), ==, sb_param(rows[i].id)->fallback);
      g_assert_cmpint(sb_params_set(&params, SB_P_FLUID_NAME, fluid, NULL), ==, SB_OK);
      const double gauge = i == 0 ? ambient : 0;
      sb_params_default(&derived, &params, rows[i].id);
      g_assert_cmpfloat(derived.value, ==, state.figure[rows[i].property].value - gauge);
      g_assert_cmpint(derived.giver, ==, SB_P_FLUID_NAME);
      g_assert_cmpstr(derived.source, ==, state.figure[rows[i].property].source);
      g_assert_cmpstr(derived.tag, ==, "published");
      g_assert_true(sb_param_follows(rows[i].id));
      SbModel model;
      g_assert_cmpint(sb_model_compile(&model, &params, NULL), ==, SB_OK);
      g_assert_cmpfloat(sb_model_value(&model, rows[i].id), ==, derived.value);
      const double own = sb_param(rows[i].id)->fallback;
      g_assert_cmpint(sb_params_set(&params, rows[i].id, own, NULL), ==, SB_OK);
      g_assert_cmpfloat(sb_params_get(&params, rows[i].id), ==, own);
    }
  }
}

static double force_of(int fluid, double celsius) {
  SbModel model;
  const Setting settings[] = {{SB_P_FLUID_NAME, fluid},
                              {SB_P_CANISTER_TEMPERATURE, zero + celsius}};
  compile(&model, settings, G_N_ELEMENTS(settings));
  return model.pressure_force;
}

// Pressure forces on 5.794 mm from the saturation pressures of the table.
static void test_pressure_force(void) {
  static const struct {
    double celsius, force[PROPELLANTS];
  } rows[] = {{0, {5.05, 2.48, 4.29, 3.04}},
              {20, {12.40, 7.59, 10.85, 8.59}},
              {40, {24.13, 15.85, 21.30, 17.54}}};
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    for (int k = 0; k < PROPELLANTS; k++) {
      assert_close(force_of(R134A + k, rows[i].celsius), rows[i].force[k], 3e-3);
    }
  }
  // The thesis' pressure is that of HFA-134a at 24.3 degC.
  assert_close(force_of(R134A, 24.3), M_PI / 4 * 5.794e-3 * 5.794e-3 * 0.55e6, 3e-3);
}

// Beyond a fluid's range, and ethanol where there is no propellant.
static void test_refused(void) {
  static const struct {
    int fluid;
    double celsius, ethanol;
    const char *key, *says;
  } rows[] = {{R134A, 80.5, 0, "canister.temperature", "-40 to 80"},
              {R134A, -40.5, 0, "canister.temperature", "-40 to 80"},
              {R1234ZE, 110, 0, "canister.temperature", "above its critical temperature"},
              {0, 20, 0.1, "fluid.ethanol", "a propellant by name"},
              {6, 20, 0.1, "fluid.ethanol", "is a cosolvent"},
              {R134A, -40, 0, NULL, NULL},
              {R134A, 80, 0.3, NULL, NULL}};
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    SbParams params;
    SbModel model;
    SbProblems problems;
    sb_params_init(&params);
    const Setting settings[] = {{SB_P_FLUID_NAME, rows[i].fluid},
                                {SB_P_CANISTER_TEMPERATURE, zero + rows[i].celsius},
                                {SB_P_FLUID_ETHANOL, rows[i].ethanol}};
    for (size_t k = 0; k < G_N_ELEMENTS(settings); k++) {
      g_assert_cmpint(sb_params_set(&params, (SbParamId)settings[k].id, settings[k].value, NULL),
                      ==, SB_OK);
    }
    const SbStatus status = sb_model_compile(&model, &params, &problems);
    g_assert_cmpint(status, ==, rows[i].key != NULL ? SB_ERROR_INPUT : SB_OK);
    if (rows[i].key != NULL) {
      g_assert_cmpuint(problems.count, ==, 1);
      g_assert_cmpstr(problems.item[0].key, ==, rows[i].key);
      g_assert_nonnull(strstr(problems.item[0].text, rows[i].says));
    }
  }
}

// Below the boiling point: the force draws the stem in, the outer seal's pressure step and leak
// point inward, nothing returns and nothing is delivered; in every model of fitment and film, with
// and without inertia and ports.
static void test_below_ambient(void) {
  enum { CHOICES = 4, LEAKS = 4 };
  static const Setting none = {-1, 0};
  static const Setting choices[][CHOICES] = {
      {{-1, 0}},
      {{SB_P_MODELS_FIT, SB_FIT_HERTZ}, {SB_P_MODELS_FILM, SB_FILM_KARASZKIEWICZ}},
      {{SB_P_MODELS_FIT, SB_FIT_DISC_THESIS}, {SB_P_MODELS_FILM, SB_FILM_ASYMPTOTIC}},
      {{SB_P_MODELS_FIT, SB_FIT_DISC}, {SB_P_MODELS_FILM, SB_FILM_REYNOLDS}},
      {{SB_P_MODELS_SURFACE, 1},
       {SB_P_MODELS_FIT, SB_FIT_DISC},
       {SB_P_SURFACE_SIGMA_OVER_BETA, 1},
       {SB_P_SURFACE_GT_PRODUCT, 0.05}},
      {{SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC}},
      {{SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC}, {SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND}},
      {{SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC}, {SB_P_CANISTER_PRESSURE_MAP, SB_MAP_PORTS}},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(choices); i++) {
    const Setting settings[] = {{SB_P_FLUID_NAME, R134A},
                                {SB_P_CANISTER_TEMPERATURE, zero - 35},
                                choices[i][0],
                                choices[i][1].id > 0 ? choices[i][1] : none,
                                choices[i][2].id > 0 ? choices[i][2] : none,
                                choices[i][3].id > 0 ? choices[i][3] : none};
    SbModel model;
    compile(&model, settings, G_N_ELEMENTS(settings));
    SbSealPressure outer = sb_model_seal_pressure(&model, SB_OUTER, SB_CHAMBER_CLOSED);
    assert_close(outer.left, 66.14e3 - 101.325e3, 5e-3);
    g_assert_cmpfloat(outer.right, ==, 0);
    assert_close(model.pressure_force, M_PI / 4 * 5.794e-3 * 5.794e-3 * outer.left, 1e-12);
    SbRun *run = run_of(&model, SB_OK, NULL);
    const SbSummary *summary = sb_run_summary(run);
    g_assert_true(warned(&summary->warnings, "pressure-below-ambient"));
    g_assert_cmpfloat(summary->returned, ==, 0);
    g_assert_cmpfloat(summary->force_return_min, <, model.pressure_force);
    g_assert_cmpfloat(summary->dose_mass, ==, 0);
    g_assert_cmpint(summary->verdict[SB_VERDICT_DOSES].ok, ==, SB_ANSWER_NO);
    g_assert_cmpfloat(summary->seal[SB_OUTER].film_central, >, 0);
    g_assert_cmpfloat(summary->energy.closure, <, 1e-6);
    if (i == LEAKS) {
      g_assert_cmpint(summary->seal[SB_OUTER].leak_state, ==, SB_LEAK_PERCOLATING);
      g_assert_cmpfloat(summary->seal[SB_OUTER].leakage_static, <, 0);
    }
    sb_run_destroy(run);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/temperature/names", test_names);
  g_test_add_func("/temperature/follows", test_follows);
  g_test_add_func("/temperature/pressure-force", test_pressure_force);
  g_test_add_func("/temperature/refused", test_refused);
  g_test_add_func("/temperature/below-ambient", test_below_ambient);
  return g_test_run();
}
