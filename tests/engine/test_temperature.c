// One temperature through the valve: a named fluid's pressure, viscosity and density, what stays as
// somebody sets it, what is refused; pressures below ambient; expansion; what each part makes of
// the least return force.
#include "app/study/view.h"
#include "models.h"
#include "near.h"

#include "engine/fluid/fluid.h"
#include "engine/valve/figures/figures.h"
#include "engine/valve/studies/study.h"

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
      g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
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
    const SbStatus status = sb_model_compile(&model, &params, NULL, &problems);
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
  enum { CHOICES = 4, LEAKS = 5 };
  static const Setting none = {-1, 0};
  static const Setting choices[][CHOICES] = {
      {{-1, 0}},
      {{SB_P_MODELS_FIT, SB_FIT_HERTZ}, {SB_P_MODELS_FILM, SB_FILM_KARASZKIEWICZ}},
      {{SB_P_MODELS_FIT, SB_FIT_DISC_THESIS}, {SB_P_MODELS_FILM, SB_FILM_ASYMPTOTIC}},
      {{SB_P_MODELS_FIT, SB_FIT_LINDLEY}},
      {{SB_P_MODELS_FIT, SB_FIT_DISC}, {SB_P_MODELS_FILM, SB_FILM_REYNOLDS}},
      {{SB_P_MODELS_SURFACE, 1},
       {SB_P_MODELS_FIT, SB_FIT_DISC},
       {SB_P_SURFACE_SIGMA_OVER_BETA, 1},
       {SB_P_SURFACE_GT_PRODUCT, 0.05}},
      {{SB_P_MODELS_FIT, SB_FIT_DISC},
       {SB_P_MODELS_FILM, SB_FILM_REYNOLDS},
       {SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED},
       {SB_P_MODELS_SURFACE, 1}},
      // The pressure draws the stem in by itself; past the land's edge; with solved rings too.
      {{SB_P_FRICTION_LOAD_COEFFICIENT, 0.01}, {SB_P_FRICTION_SHEAR_STRENGTH, 5e4}},
      {{SB_P_FRICTION_LOAD_COEFFICIENT, 0.06}, {SB_P_FRICTION_SHEAR_STRENGTH, 1e5}},
      {{SB_P_FRICTION_LOAD_COEFFICIENT, 0.02},
       {SB_P_FRICTION_SHEAR_STRENGTH, 1e5},
       {SB_P_MODELS_FIT, SB_FIT_RING},
       {SB_P_OUTPUT_TOLERANCE, 1e-2}},
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
    // A fit that knows no pressure takes none, and says so; the others take it with its sign.
    g_assert_true(warned(&summary->warnings, "pressure-ignored") ==
                  (model.fit == SB_FIT_HERTZ || model.fit == SB_FIT_LINDLEY));
    g_assert_cmpfloat(summary->returned, ==, 0);
    g_assert_cmpfloat(summary->force_return_margin, <, model.pressure_force);
    g_assert_false(summary->dose_mass > 0);
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

// Sizes at the temperature of use: ring, radial space and bore expand, the diameter of the pressure
// does not, and what a drawing is checked by stays. Storage has a temperature of its own.
static void test_expansion(void) {
  SbModel cold, warm;
  compile(&cold, NULL, 0);
  const Setting settings[] = {{SB_P_CANISTER_TEMPERATURE, zero + 45},
                              {SB_P_RUBBER_THERMAL_EXPANSION, 200e-6},
                              {SB_P_HOUSING_THERMAL_EXPANSION, 100e-6}};
  compile(&warm, settings, G_N_ELEMENTS(settings));
  const SbSealModel *from = &cold.seal[SB_INNER], *to = &warm.seal[SB_INNER];
  assert_close(to->section_diameter, from->section_diameter * 1.005, 1e-12);
  assert_close(to->inner_diameter, from->inner_diameter * 1.005, 1e-12);
  assert_close(warm.radial_space, cold.radial_space * 1.0025, 1e-12);
  assert_close(warm.bore_diameter, cold.bore_diameter * 1.0025, 1e-12);
  assert_close(to->squeeze, 1 - 1.36 / 1.61 * 1.0025 / 1.005, 1e-12);
  g_assert_cmpfloat(to->modulus, ==, 2.5e6); // inferred: constant
  g_assert_cmpfloat(warm.stem_diameter, ==, cold.stem_diameter);
  g_assert_cmpfloat(warm.pressure_force, ==, cold.pressure_force);
  SbGland glands[2];
  sb_model_gland(&glands[0], &cold, SB_INNER);
  sb_model_gland(&glands[1], &warm, SB_INNER);
  // The sizes are doubles in a row, without padding between them.
  const size_t sizes = offsetof(SbGland, section_diameter);
  g_assert_cmpmem((char *)&glands[0] + sizes, sizeof glands[0] - sizes, (char *)&glands[1] + sizes,
                  sizeof glands[1] - sizes);

  for (int given = 0; given < 2; given++) {
    const Setting stored[] = {{SB_P_STORAGE_TEMPERATURE, zero - 20},
                              {given ? (int)SB_P_CANISTER_TEMPERATURE : -1, zero + 20}};
    SbModel model;
    SbWarnings warnings = {0};
    SbProblems remarks;
    compile(&model, stored, G_N_ELEMENTS(stored));
    g_assert_cmpfloat(model.seal[SB_OUTER].modulus, ==, 2.5e6);
    g_assert_cmpfloat(model.seal[SB_OUTER].section_diameter, ==, 1.61e-3);
    sb_model_warn(&model, &warnings);
    sb_model_remarks(&model, &remarks);
    g_assert_true(warned(&warnings, "storage-only") == !given);
    g_assert_cmpuint(remarks.count, ==, !given);
  }
}

// The modulus over the temperature: constant and tagged "inferred" without a measurement, with a
// warning more than 20 K from 20 degC; by a slope that is given; by entropy elasticity on request.
static void test_modulus(void) {
  static const struct {
    Setting setting;
    double factor; // at 60 degC
    const char *tag;
  } rows[] = {{{-1, 0}, 1, "inferred"},
              {{SB_P_RUBBER_MODULUS_SLOPE, -1.6e-3}, 1 - 40 * 1.6e-3, "given"},
              {{SB_P_RUBBER_ENTROPIC, 1}, 333.15 / 293.15, "entropy elasticity"}};
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    static const double celsius[] = {-1, 0, 20, 40, 41, 60};
    for (size_t k = 0; k < G_N_ELEMENTS(celsius); k++) {
      const Setting settings[] = {rows[i].setting, {SB_P_CANISTER_TEMPERATURE, zero + celsius[k]}};
      SbModel model;
      SbWarnings warnings = {0};
      SbModulusChange change;
      compile(&model, settings, G_N_ELEMENTS(settings));
      sb_model_warn(&model, &warnings);
      const bool far = fabs(celsius[k] - 20) > 20;
      g_assert_cmpint(warned(&warnings, "modulus-temperature"), ==, i == 0 && far);
      g_assert_cmpint(warned(&warnings, "modulus-entropic"), ==, i == 2 && far);
      sb_model_modulus(&change, &model, zero + 60);
      g_assert_cmpfloat_with_epsilon(change.factor, rows[i].factor, 1e-12);
      g_assert_cmpstr(change.tag, ==, rows[i].tag);
      sb_model_modulus(&change, &model, model.temperature);
      assert_close(model.seal[SB_OUTER].modulus, 2.5e6 * change.factor, 1e-12);
    }
  }
}

// Entropy elasticity in place of a known slope, as that of nitrile, warns at each temperature at
// which it changes the modulus.
static void test_entropic(void) {
  for (int i = 0; i < 2; i++) {
    const Setting settings[] = {{SB_P_RUBBER_MODULUS_SLOPE, -1.6e-3},
                                {SB_P_RUBBER_ENTROPIC, 1},
                                {SB_P_CANISTER_TEMPERATURE, i == 0 ? 293.15 : 298.15}};
    SbModel model;
    SbWarnings warnings = {0};
    compile(&model, settings, G_N_ELEMENTS(settings));
    sb_model_warn(&model, &warnings);
    g_assert_cmpint(warned(&warnings, "modulus-entropic"), ==, i);
    g_assert_true(i == 0 || strstr(warnings.item[0].text, "-0.16 % per kelvin") != NULL);
  }
}

static const SbStudyRow *row_of(const SbStudy *study, const char *label, double celsius) {
  g_autofree char *name = g_strdup_printf("%s, %.0f °C", label, celsius);
  for (size_t i = 0; i < study->row_count; i++) {
    if (strcmp(study->row[i].name, name) == 0) {
      return &study->row[i];
    }
  }
  g_error("no row %s", name);
}

// From 50 to -10 degC each propellant's return margin falls; each of what the temperature changes
// has its own sign, and the parts alone make up the total but for what they do together. Static
// friction is that of the contact from which the film has gone, so that the film has no part.
static void test_parts(void) {
  enum { FORCE, BREAKAWAY, RETURN, DOSE, CHANGE, PRESSURE, FILM, RUBBER, EXPANSION };
  static const double celsius[] = {-10, 0, 20, 40, 50};
  SbModel model;
  const Setting settings[] = {{SB_P_CANISTER_TEMPERATURE, zero + 3}, // the scene's own is nothing
                              {SB_P_RUBBER_MODULUS_SLOPE, -1.6e-3}};
  compile(&model, settings, G_N_ELEMENTS(settings));
  SbStudy *study = g_new0(SbStudy, 1);
  g_assert_cmpint(sb_study_make(study, SB_STUDY_PROPELLANTS, &model, NULL, NULL), ==, SB_OK);
  g_assert_true(study->complete);
  for (int fluid = R134A; fluid <= PROPELLANTS; fluid++) {
    const char *label = sb_fluids[fluid].label;
    double before = -INFINITY;
    for (size_t i = 0; i < G_N_ELEMENTS(celsius); i++) {
      const double *value = row_of(study, label, celsius[i])->value;
      assert_close(value[FORCE], force_of(fluid, celsius[i]), 1e-12);
      g_assert_cmpfloat(value[RETURN], >, before);
      before = value[RETURN];
      const double sign = celsius[i] > 20 ? 1 : -1;
      if (celsius[i] == 20) {
        g_assert_cmpfloat(value[CHANGE], ==, 0);
        continue;
      }
      // A warmer canister pushes more; a stiffer rubber and a thicker ring have more friction.
      g_assert_cmpfloat(sign * value[PRESSURE], >, 0);
      g_assert_cmpfloat(fabs(value[FILM]), <, 1e-9);
      g_assert_cmpfloat(sign * value[RUBBER], >, 0);
      g_assert_cmpfloat(sign * value[EXPANSION], <, 0);
      const double sum = value[PRESSURE] + value[FILM] + value[RUBBER] + value[EXPANSION];
      assert_close(sum, value[CHANGE], 0.02);
    }
    const SbStudySeries *curve = &study->panel[2].series[fluid - 1];
    g_assert_cmpstr(curve->name, ==, label);
    for (size_t i = 1; i < curve->count; i++) {
      g_assert_cmpfloat(curve->y[i], >, curve->y[i - 1]);
    }
  }
  g_free(study);
}

// The doses of a life: an empty chamber is primed first, vapour takes the place of what is drawn,
// the last dose falls short; a chamber that is open too shortly is not filled; a leak takes the
// prime.
static void test_doses(void) {
  enum { LIFE = 6 };
  for (int fluid = 0; fluid <= R134A; fluid++) {
    const Setting settings[] = {
        {SB_P_FLUID_NAME, fluid},     {SB_P_CANISTER_TEMPERATURE, zero + 40},
        {SB_P_CANISTER_FILL, 200e-9}, {SB_P_LIFE_ACTUATIONS, LIFE},
        {SB_P_LIFE_CHAMBER, 1},       {SB_P_FRICTION_LOAD_COEFFICIENT, 0.05}};
    SbModel model;
    compile(&model, settings, G_N_ELEMENTS(settings));
    const double dose = model.supply.volume * model.density;
    const double vapour = fluid > 0 ? 50.085 / 1146.74 : 0; // fluids.csv
    // The emptied chamber keeps vapour at ambient pressure: 4.03974 kg/m3, as in test_fluid.c.
    const double kept = fluid > 0 ? 4.03974 / model.density : 0;
    SbRun *run = run_of(&model, SB_OK, NULL);
    size_t count;
    const SbLifeActuation *each = sb_run_life(run, &count);
    g_assert_cmpuint(count, ==, LIFE);
    const double last = 200e-9 / model.supply.volume * (1 - vapour) - 3;
    const double expected[LIFE] = {0, 1, 1, 1, last, 0};
    g_assert_cmpfloat(last, >, 0.05);
    g_assert_cmpfloat(last, <, 0.95);
    for (int n = 0; n < LIFE; n++) {
      const double delivered = fmax(expected[n] - kept, 0) * dose;
      g_assert_cmpfloat(fabs(each[n].dose - delivered), <=, 1e-5 * dose);
    }
    g_assert_cmpfloat(sb_run_summary(run)->doses, ==, 3);
    assert_close(sb_run_summary(run)->dose_mass, (1 - kept) * dose, 1e-7);
    g_assert_true(fluid > 0 || (sb_run_summary(run)->dose_mass == dose &&
                                isnan(sb_run_summary(run)->kept_mass)));
    g_assert_cmpfloat(sb_run_summary(run)->filled_share, ==, 1);
    sb_run_destroy(run);
  }
  const Setting fast[] = {{SB_P_DRIVE_SPEED, 10}, {SB_P_CHAMBER_DISCHARGE_COEFFICIENT, 0.05}};
  SbModel model;
  compile(&model, fast, G_N_ELEMENTS(fast));
  SbRun *run = run_of(&model, SB_OK, NULL);
  const SbSummary *summary = sb_run_summary(run);
  const double gap = M_PI / 4 * (6e-3 * 6e-3 - 5.794e-3 * 5.794e-3);
  assert_close(summary->filling_time, model.supply.volume / (0.05 * gap * sqrt(2 * 0.55e6 / 1226)),
               1e-9);
  assert_close(summary->filled_share,
               (summary->stage[SB_STAGE_F].time - summary->stage[SB_STAGE_C].time) /
                   summary->filling_time,
               1e-12);
  g_assert_cmpfloat(summary->filled_share, <, 0.5);
  g_assert_true(warned(&summary->warnings, "chamber-not-filled"));
  assert_close(summary->dose_mass, summary->filled_share * model.supply.volume * 1226, 1e-12);
  sb_run_destroy(run);
  const Setting leaks[] = {{SB_P_MODELS_SURFACE, 1},
                           {SB_P_MODELS_FIT, SB_FIT_DISC},
                           {SB_P_SURFACE_SIGMA_OVER_BETA, 1},
                           {SB_P_SURFACE_GT_PRODUCT, 0.05},
                           {SB_P_GLAND_RADIAL_SPACE, 1.5e-3}};
  compile(&model, leaks, G_N_ELEMENTS(leaks));
  run = run_of(&model, SB_OK, NULL);
  summary = sb_run_summary(run);
  g_assert_cmpfloat(summary->seal[SB_OUTER].leakage_static, >, 0);
  assert_close(summary->prime_loss,
               86400 * summary->seal[SB_OUTER].leakage_static / model.supply.volume, 1e-12);
  const double leak = summary->seal[SB_OUTER].leakage_static;
  sb_run_destroy(run);
  // 100 barrer of HFA-134a at 40 degC through a slab of the ring's area beside: 2.6 % of a dose a
  // day.
  const Setting permeates[] = {leaks[0],
                               leaks[1],
                               leaks[2],
                               leaks[3],
                               leaks[4],
                               {SB_P_FLUID_NAME, R134A},
                               {SB_P_CANISTER_TEMPERATURE, zero + 40},
                               {SB_P_RUBBER_THERMAL_EXPANSION, 0},
                               {SB_P_HOUSING_THERMAL_EXPANSION, 0},
                               {SB_P_RUBBER_PERMEABILITY, 100 * 3.35e-16}};
  for (size_t without = 0; without < 2; without++) {
    compile(&model, permeates, G_N_ELEMENTS(permeates) - without);
    run = run_of(&model, SB_OK, NULL);
    summary = sb_run_summary(run);
    // The section that stretch has thinned.
    const double height = 1.5e-3, section = model.seal[SB_OUTER].section_fitted;
    const double width = M_PI / 4 * section * section / height;
    const double flow =
        33.5e-15 * 0.102032 * 1016.59e3 * M_PI * (6e-3 - height) * height / width / 1146.74;
    assert_close(model.supply.volume / 86400 * summary->prime_loss,
                 summary->seal[SB_OUTER].leakage_static + (without ? 0 : flow), 1e-5);
    sb_run_destroy(run);
  }
  g_assert_cmpfloat(leak, >, 0);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/temperature/names", test_names);
  g_test_add_func("/temperature/follows", test_follows);
  g_test_add_func("/temperature/pressure-force", test_pressure_force);
  g_test_add_func("/temperature/refused", test_refused);
  g_test_add_func("/temperature/below-ambient", test_below_ambient);
  g_test_add_func("/temperature/expansion", test_expansion);
  g_test_add_func("/temperature/modulus", test_modulus);
  g_test_add_func("/temperature/entropic", test_entropic);
  g_test_add_func("/temperature/parts", test_parts);
  g_test_add_func("/temperature/doses", test_doses);
  return g_test_run();
}
