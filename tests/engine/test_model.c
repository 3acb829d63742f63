// The catalogue is sound, and the thesis valve's derived sizes come out as the thesis prints them.
#include "engine/contact/fit.h"
#include "engine/contact/ring/ring_profile.h"
#include "engine/valve/model/model.h"
#include "engine/valve/sealbench.h"

#include <glib.h>
#include <math.h>
#include <string.h>

static void test_catalogue(void) {
  SbParams params;
  sb_params_init(&params);
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParam *param = sb_param((SbParamId)i);
    g_assert_nonnull(param->key);
    g_assert_nonnull(strchr(param->key, '.'));
    g_assert_cmpint(sb_param_find(param->key), ==, i);
    SbReport report = {0};
    g_assert_cmpint(sb_params_set(&params, (SbParamId)i, param->fallback, &report), ==, SB_OK);
    g_assert_true(strlen(param->help) > 0 && strlen(param->source) > 0);
    bool known = strcmp(param->tag, "thesis") == 0 || strcmp(param->tag, "inferred") == 0 ||
                 strcmp(param->tag, "ours") == 0;
    g_assert_true(known);
    g_assert_cmpint(sb_param_group((SbParamId)i), <, SB_PARAMS_GROUP_COUNT);
    g_assert_true((param->seal < SB_SEAL_COUNT) == (param->parent >= 0));
    const int tolerance = sb_param_tolerance((SbParamId)i);
    g_assert_true(tolerance < 0 || sb_param_toleranced((SbParamId)tolerance) == i);
  }
  g_assert_cmpint(sb_param_group(SB_P_SEAL_INNER_MODULUS), ==, SB_PARAMS_SEAL);
  g_assert_cmpint(sb_param(SB_P_SEAL_INNER_MODULUS)->seal, ==, SB_INNER);
  g_assert_cmpint(sb_param_group(SB_P_STORAGE_TEMPERATURE), ==, SB_PARAMS_STORAGE);
  g_assert_cmpint(sb_param_toleranced(SB_P_GLAND_RADIAL_SPACE), ==, -1);
  g_assert_cmpint(sb_param_find("seal.outer.modulus"), >=, 0);
  g_assert_cmpint(sb_param_find("no.such"), ==, -1);
}

// A choice's name leads back to its number, and no name stands twice in a list.
static void test_choices(void) {
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParam *param = sb_param((SbParamId)i);
    int count = sb_param_choice_count(param);
    g_assert_true((count > 0) == (param->choices != NULL));
    for (int k = 0; k < count; k++) {
      char name[64];
      sb_param_choice_name(param, k, name, sizeof name);
      g_assert_cmpint(sb_param_choice(param, name, strlen(name)), ==, k);
    }
    g_assert_cmpint(sb_param_choice(param, "no such", 7), ==, -1);
  }
}

// A life of some actuations is of motions that can repeat, others are refused by its key.
// The choices of the models are the enumerations of the rooms below, which own them.
static void test_model_names(void) {
  SbParams params;
  SbModel model;
  char name[64];
  const SbParam *fit = sb_param(SB_P_MODELS_FIT), *film = sb_param(SB_P_MODELS_FILM);
  const SbParam *surface = sb_param(SB_P_MODELS_SURFACE);
  g_assert_cmpint(sb_param_choice_count(fit), ==, SB_FIT_MODEL_COUNT);
  for (int i = 0; i < SB_FIT_MODEL_COUNT; i++) {
    sb_params_init(&params);
    g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_FIT, i, NULL), ==, SB_OK);
    g_assert_cmpint(
        sb_params_set(&params, SB_P_MODELS_FILM, MIN(i, sb_param_choice_count(film) - 1), NULL), ==,
        SB_OK);
    g_assert_cmpint(
        sb_params_set(&params, SB_P_MODELS_SURFACE, i % sb_param_choice_count(surface), NULL), ==,
        SB_OK);
    g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
    sb_param_choice_name(fit, i, name, sizeof name);
    g_assert_cmpstr(sb_fit_kind(model.fit)->name, ==, name);
    sb_param_choice_name(film, (int)params.value[SB_P_MODELS_FILM], name, sizeof name);
    g_assert_cmpstr(sb_film_kind(model.film)->name, ==, name);
    sb_param_choice_name(surface, (int)params.value[SB_P_MODELS_SURFACE], name, sizeof name);
    g_assert_cmpstr(sb_rough_model_name(model.surface), ==, name);
    // The plan names them so too.
    SbPlan plan;
    sb_plan_make(&plan, &model);
    bool named = false;
    for (size_t k = 0; k < plan.field_count; k++) {
      named = named || strcmp(plan.field[k].model, name) == 0;
    }
    g_assert_true(named);
  }
}

static void test_life_motions(void) {
  static const struct {
    SbModelMotion motion;
    bool allowed;
  } cases[] = {{SB_MODEL_MOTION_QUASI_STATIC, true},
               {SB_MODEL_MOTION_DYNAMIC, true},
               {SB_MODEL_MOTION_RIG, false},
               {SB_MODEL_MOTION_BODIES, false}};
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    SbParams params;
    sb_params_init(&params);
    g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_MOTION, cases[i].motion, NULL), ==, SB_OK);
    g_assert_cmpint(sb_params_set(&params, SB_P_LIFE_ACTUATIONS, 3, NULL), ==, SB_OK);
    SbModel model;
    SbProblems problems;
    bool good = sb_model_compile(&model, &params, NULL, &problems) == SB_OK;
    g_assert_true(good == cases[i].allowed);
    bool named = false;
    for (size_t k = 0; !good && k < problems.count; k++) {
      named = named || strcmp(problems.item[k].key, "life.actuations") == 0;
    }
    g_assert_true(named == !good);
  }
}

static void test_overrides(void) {
  SbParams params;
  sb_params_init(&params);
  SbReport report = {0};
  g_assert_cmpint(sb_params_set(&params, SB_P_SEAL_MODULUS, 3e6, &report), ==, SB_OK);
  g_assert_cmpfloat(sb_params_get(&params, SB_P_SEAL_OUTER_MODULUS), ==, 3e6);
  g_assert_cmpint(sb_params_set(&params, SB_P_SEAL_OUTER_MODULUS, 4e6, &report), ==, SB_OK);
  g_assert_cmpfloat(sb_params_get(&params, SB_P_SEAL_OUTER_MODULUS), ==, 4e6);
  g_assert_cmpfloat(sb_params_get(&params, SB_P_SEAL_INNER_MODULUS), ==, 3e6);
  g_assert_cmpint(sb_params_set(&params, SB_P_SEAL_MODULUS, NAN, &report), ==, SB_ERROR_INPUT);
  g_assert_cmpint(sb_params_set(&params, SB_P_SEAL_MODULUS, -1, &report), ==, SB_ERROR_RANGE);
  g_assert_cmpstr(sb_input_key(report.input), ==, "seal.modulus");
}

// A set of models is a bundle of defaults: what is given wins, and what was not follows when the
// set changes, in a model that is derived too.
static void test_sets(void) {
  static const struct {
    SbParamId id;
    double thesis, consistent;
  } rows[] = {
      {SB_P_MODELS_FIT, SB_FIT_KARASZKIEWICZ, SB_FIT_RING},
      {SB_P_MODELS_SECTION, 0, 1},
      {SB_P_MODELS_FILM, SB_FILM_THESIS, SB_FILM_REYNOLDS},
      {SB_P_MODELS_SURFACE, 0, 1},
      {SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_BESIDE, SB_MODEL_ASPERITIES_COUPLED},
      {SB_P_MODELS_FRICTION, SB_MODEL_FRICTION_THESIS, SB_MODEL_FRICTION_SHEAR},
      {SB_P_MODELS_INLET, 0, 1},
      {SB_P_FRICTION_SHEAR_STRENGTH, 3.5e6, 0.388e6},
      {SB_P_GLAND_FLOOR_FRICTION, 0, 0.3},
      {SB_P_GLAND_WALL_FRICTION, 0, 0.1},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    SbParams params, effective;
    SbParamDefault derived;
    SbModel model;
    sb_params_init(&params);
    g_assert_cmpfloat(sb_params_get(&params, rows[i].id), ==, rows[i].thesis);
    g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_SET, SB_MODEL_SET_CONSISTENT, NULL), ==,
                    SB_OK);
    g_assert_cmpfloat(sb_params_get(&params, rows[i].id), ==, rows[i].consistent);
    sb_params_resolve(&effective, &params);
    g_assert_cmpfloat(effective.value[rows[i].id], ==, rows[i].consistent);
    g_assert_false(effective.given[rows[i].id]);
    sb_params_default(&derived, &params, rows[i].id);
    g_assert_cmpint(derived.giver, ==, SB_P_MODELS_SET);
    g_assert_cmpstr(derived.source, !=, sb_param(rows[i].id)->source);
    g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
    g_assert_cmpfloat(sb_model_value(&model, rows[i].id), ==, rows[i].consistent);
    const SbOverride back = {SB_P_MODELS_SET, SB_MODEL_SET_THESIS};
    g_assert_cmpint(sb_model_override(&model, &model, &back, 1, NULL), ==, SB_OK);
    g_assert_cmpfloat(sb_model_value(&model, rows[i].id), ==, rows[i].thesis);
    // Given, it stays.
    g_assert_cmpint(sb_params_set(&params, rows[i].id, rows[i].thesis, NULL), ==, SB_OK);
    g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
    g_assert_cmpfloat(sb_model_value(&model, rows[i].id), ==, rows[i].thesis);
  }
}

static void test_derived(void) {
  SbParams params;
  sb_params_init(&params);
  SbModel model;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  const SbSealModel *seal = &model.seal[SB_OUTER];
  g_assert_cmpfloat_with_epsilon(seal->squeeze, 0.25 / 1.61, 1e-12);
  g_assert_cmpfloat_with_epsilon(seal->stretch_mean, 0.0427, 5e-5);
  g_assert_cmpfloat_with_epsilon(seal->stretch_inner, 0.155, 1e-3);
  g_assert_cmpfloat_with_epsilon(seal->section_fitted, 1.5763e-3, 1e-7);
  g_assert_cmpfloat_with_epsilon(seal->reduced_modulus, 6.5725e6, 6.5725e2);
  g_assert_cmpfloat_with_epsilon(model.pressure_force, 14.5, 0.005);

  // The drawing's own sizes leave both seals on the land until the inner one reaches its edge.
  const SbValveShape *shape = &model.shape;
  g_assert_cmpfloat(model.land_edge + shape->seal_spacing + model.axial_width, <,
                    shape->vent_position + shape->vent_diameter);
  g_assert_cmpfloat(shape->chamber_length + model.axial_width, <, shape->seal_spacing);
}

static void test_problems(void) {
  SbParams params;
  sb_params_init(&params);
  SbReport report = {0};
  g_assert_cmpint(sb_params_set(&params, SB_P_STEM_PRESSURE_DIAMETER, 7e-3, &report), ==, SB_OK);
  SbModel model;
  SbProblems problems;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, &problems), ==, SB_ERROR_INPUT);
  g_assert_cmpuint(problems.count, ==, 1);
  g_assert_cmpstr(problems.item[0].key, ==, "bore.diameter");
}

// A variant of another fit model is refused with the names of those that the model has.
static void test_variants(void) {
  const SbOverride over[] = {{SB_P_MODELS_FIT, SB_FIT_HERTZ}, {SB_P_MODELS_FIT_VARIANT, 2}};
  SbParams params;
  SbModel model;
  SbProblems problems;
  sb_params_init(&params);
  for (size_t i = 0; i < G_N_ELEMENTS(over); i++) {
    g_assert_cmpint(sb_params_set(&params, over[i].id, over[i].value, NULL), ==, SB_OK);
  }
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, &problems), ==, SB_ERROR_INPUT);
  g_assert_cmpuint(problems.count, ==, 1);
  g_assert_cmpstr(problems.item[0].key, ==, "models.fit_variant");
  g_assert_nonnull(strstr(problems.item[0].text, ", but default"));
}

// What leaves no rubber, or no random surface, is refused with its own key when the model is made.
static void test_nothing_left(void) {
  static const struct {
    const char *key;
    SbOverride over[3];
  } cases[] = {{"rubber.network_rate",
                {{SB_P_RUBBER_NETWORK_RATE, 6.7e-3},
                 {SB_P_STORAGE_TIME, 7.8e6},
                 {SB_P_RUBBER_NETWORK_REFORM, 0}}},
               {"surface.gt_product",
                {{SB_P_MODELS_SURFACE, 1}, // persson
                 {SB_P_SURFACE_GT_PRODUCT, 0.024},
                 {SB_P_SURFACE_SIGMA, 1e-6}}}};
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    SbParams params;
    SbModel model;
    SbProblems problems;
    sb_params_init(&params);
    for (int k = 0; k < 3; k++) {
      const SbOverride *over = &cases[i].over[k];
      g_assert_cmpint(sb_params_set(&params, over->id, over->value, NULL), ==, SB_OK);
    }
    g_assert_cmpint(sb_model_compile(&model, &params, NULL, &problems), ==, SB_ERROR_INPUT);
    g_assert_cmpuint(problems.count, >, 0);
    g_assert_cmpstr(problems.item[0].key, ==, cases[i].key);
  }
}

// A gasket that is flat radially has a section that the solver meshes; one beyond the meshes'
// proportions is refused with its own key and range when the model is made, not by the run.
static void test_gasket_sizes(void) {
  static const struct {
    double outer, thickness; // [m]; bore 2.65 mm
    bool made;
  } cases[] = {{8e-3, 1e-3, true},
               {8e-3, 0.6e-3, true}, // 4.5 times as high as thick: edges of 0.005 of the height
               {8e-3, 0.5e-3, false},
               {3.3e-3, 2e-3, false}};
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    const SbOverride over[] = {{SB_P_VALVE_KIND, SB_VALVE_GASKET},
                               {SB_P_BORE_DIAMETER, 3.2e-3},
                               {SB_P_GASKET_OUTER_DIAMETER, cases[i].outer},
                               {SB_P_GASKET_THICKNESS, cases[i].thickness}};
    SbParams params;
    SbModel model;
    SbProblems problems;
    SbRingOutline outline;
    SbReport report = {0};
    sb_params_init(&params);
    for (size_t k = 0; k < G_N_ELEMENTS(over); k++) {
      g_assert_cmpint(sb_params_set(&params, over[k].id, over[k].value, NULL), ==, SB_OK);
    }
    const SbStatus status = sb_model_compile(&model, &params, NULL, &problems);
    g_assert_cmpint(status, ==, cases[i].made ? SB_OK : SB_ERROR_INPUT);
    if (!cases[i].made) {
      g_assert_cmpuint(problems.count, ==, 1);
      g_assert_cmpstr(problems.item[0].key, ==, "gasket.thickness");
      g_assert_true(problems.item[0].min > 0 && problems.item[0].max > problems.item[0].min);
      continue;
    }
    const SbSealProfile profile = sb_model_profile(&model, SB_OUTER);
    g_assert_cmpint(sb_ring_outline_of_profile(&outline, &profile,
                                               model.seal[SB_OUTER].section_diameter, &report),
                    ==, SB_OK);
  }
}

// Whether a size follows another one in a valve of this kind.
static bool follows(SbParamId id, SbParamId giver, int kind) {
  bool found = false;
  for (int i = 0; i < SB_KEEPS_COUNT; i++) {
    SbParamId kept, of;
    double sign;
    found = found || (sb_params_keeps(&kept, &of, &sign, i, kind) && kept == id && of == giver);
  }
  return found;
}

// Sizes that a drawing changes together keep their difference until they are given.
static void test_kept(void) {
  static const struct {
    SbValveKind kind;
    SbParamId giver, id;
    double given, kept;
  } rows[] = {
      {SB_VALVE_PISTON, SB_P_BORE_DIAMETER, SB_P_STEM_PRESSURE_DIAMETER, 6.0e-3, 5.794e-3},
      {SB_VALVE_PISTON, SB_P_BORE_DIAMETER, SB_P_STEM_PRESSURE_DIAMETER, 6.2e-3, 5.994e-3},
      {SB_VALVE_PISTON, SB_P_BORE_DIAMETER, SB_P_BORE_ENTRY_DIAMETER, 6.2e-3, 7.2e-3},
      {SB_VALVE_PISTON, SB_P_STEM_SEAL_SPACING, SB_P_STEM_CHAMBER_LENGTH, 7e-3, 3.7e-3},
      {SB_VALVE_PISTON, SB_P_GLAND_AXIAL_WIDTH, SB_P_STEM_CHAMBER_LENGTH, 2.5e-3, 2.4e-3},
      {SB_VALVE_GASKET, SB_P_STEM_SEAL_SPACING, SB_P_STEM_CHAMBER_LENGTH, 7e-3, 2.6e-3},
      {SB_VALVE_GASKET, SB_P_STEM_PRESSURE_DIAMETER, SB_P_GASKET_BORE_DIAMETER, 2.8e-3, 2.65e-3},
      {SB_VALVE_GASKET, SB_P_STEM_PRESSURE_DIAMETER, SB_P_GASKET_BORE_DIAMETER, 3.1e-3, 2.95e-3},
      // The stem of a gasket valve does not slide in the chamber.
      {SB_VALVE_GASKET, SB_P_BORE_DIAMETER, SB_P_STEM_PRESSURE_DIAMETER, 6.2e-3, 2.8e-3},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    SbParams params;
    SbParamDefault derived;
    sb_params_init(&params);
    g_assert_cmpint(sb_params_set(&params, SB_P_VALVE_KIND, rows[i].kind, NULL), ==, SB_OK);
    g_assert_cmpint(sb_params_set(&params, rows[i].giver, rows[i].given, NULL), ==, SB_OK);
    g_assert_cmpfloat(sb_params_get(&params, rows[i].id), ==, rows[i].kept);
    sb_params_default(&derived, &params, rows[i].id);
    g_assert_true(sb_param_follows(rows[i].id));
    g_assert_true((derived.giver == (int)rows[i].giver) ==
                  follows(rows[i].id, rows[i].giver, rows[i].kind));
    // A value of its own stays.
    g_assert_cmpint(sb_params_set(&params, rows[i].id, 4e-3, NULL), ==, SB_OK);
    g_assert_cmpfloat(sb_params_get(&params, rows[i].id), ==, 4e-3);
  }
}

// Sizes that cannot be built together have a warning each: a chamber between its grooves, and a
// size that would follow another one out of its range.
static void test_size_checks(void) {
  static const struct {
    SbValveKind kind;
    double spacing, length, width; // NaN: not given
    const char *code;              // of the only warning of this kind; NULL: none
  } rows[] = {
      {SB_VALVE_PISTON, NAN, NAN, NAN, NULL},
      {SB_VALVE_PISTON, 3e-3, NAN, NAN, "size-limited"},
      {SB_VALVE_PISTON, 3e-3, 2.9e-3, NAN, "size-overlap"},
      {SB_VALVE_PISTON, NAN, 6e-3, NAN, "size-overlap"},
      {SB_VALVE_PISTON, NAN, NAN, 3.5e-3, NULL},
      {SB_VALVE_PISTON, NAN, NAN, 5.2e-3, "size-limited"},
      {SB_VALVE_PISTON, NAN, 2.9e-3, 3.5e-3, "size-overlap"},
      {SB_VALVE_PISTON, NAN, 4.2e-3, NAN, NULL},
      {SB_VALVE_GASKET, NAN, 6e-3, NAN, NULL},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    const struct {
      SbParamId id;
      double value;
    } given[] = {{SB_P_VALVE_KIND, rows[i].kind},
                 {SB_P_STEM_SEAL_SPACING, rows[i].spacing},
                 {SB_P_STEM_CHAMBER_LENGTH, rows[i].length},
                 {SB_P_GLAND_AXIAL_WIDTH, rows[i].width}};
    SbParams params;
    sb_params_init(&params);
    for (size_t k = 0; k < G_N_ELEMENTS(given); k++) {
      g_assert_true(isnan(given[k].value) ||
                    sb_params_set(&params, given[k].id, given[k].value, NULL) == SB_OK);
    }
    const char *found = NULL;
    for (int k = 0; k < SB_SIZE_CHECKS; k++) {
      SbParamId id;
      char text[SB_TEXT];
      const char *code = sb_params_size_check(text, &id, &params, k);
      g_assert_true(code == NULL || (found == NULL && id == SB_P_STEM_CHAMBER_LENGTH));
      found = code != NULL ? code : found;
    }
    g_assert_cmpstr(found, ==, rows[i].code);
  }
}

static void test_pressure_maps(void) {
  SbParams params;
  sb_params_init(&params);
  SbModel model;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  SbSealPressure outer = sb_model_seal_pressure(&model, SB_OUTER, SB_CHAMBER_AT_REST);
  SbSealPressure inner = sb_model_seal_pressure(&model, SB_INNER, SB_CHAMBER_AT_REST);
  g_assert_cmpfloat(outer.left - outer.right, ==, 0.55e6);
  g_assert_cmpfloat(inner.left - inner.right, ==, 0);
  model.pressure_map = SB_MAP_CHAMBER_VENTED;
  outer = sb_model_seal_pressure(&model, SB_OUTER, SB_CHAMBER_AT_REST);
  inner = sb_model_seal_pressure(&model, SB_INNER, SB_CHAMBER_AT_REST);
  g_assert_cmpfloat(outer.left - outer.right, ==, 0);
  g_assert_cmpfloat(inner.left - inner.right, ==, 0.55e6);
}

static void set(SbParams *params, const char *key, double value) {
  SbReport report = {0};
  g_assert_cmpint(sb_params_set(params, (SbParamId)sb_param_find(key), value, &report), ==, SB_OK);
}

// Storage is off by default; swell and relaxation change sizes and modulus, and speak up beyond
// what is known.
static void test_storage(void) {
  SbParams params;
  sb_params_init(&params);
  SbModel fresh;
  g_assert_cmpint(sb_model_compile(&fresh, &params, NULL, NULL), ==, SB_OK);
  g_assert_cmpfloat(fresh.seal[SB_OUTER].section_diameter, ==, 1.61e-3);
  g_assert_cmpfloat(fresh.seal[SB_OUTER].modulus, ==, 2.5e6);

  set(&params, "storage.time", 30 * 86400.0);
  set(&params, "rubber.swell_mass", 0.17);
  set(&params, "rubber.relaxation_share_1", 0.2);
  SbModel stored;
  g_assert_cmpint(sb_model_compile(&stored, &params, NULL, NULL), ==, SB_OK);
  const SbSealModel *seal = &stored.seal[SB_INNER];
  const double growth = cbrt(1 + 0.17 * 1090 / 1226);
  g_assert_cmpfloat_with_epsilon(seal->section_diameter, 1.61e-3 * growth, 1e-8);
  g_assert_cmpfloat_with_epsilon(seal->inner_diameter, 2.84e-3 * growth, 1e-8);
  g_assert_cmpfloat_with_epsilon(seal->modulus, 2.5e6 * 0.8 / growth, 10);
  g_assert_cmpfloat_with_epsilon(seal->radius, seal->section_diameter / 2, 1e-15);
  g_assert_cmpfloat(seal->gland_fill, >, fresh.seal[SB_INNER].gland_fill);
  g_assert_cmpfloat(seal->stored.section_diameter, ==, 1.61e-3);

  // 30 days are far beyond the one hour that is known to relax.
  SbWarnings warnings = {0};
  sb_model_warn(&stored, &warnings);
  g_assert_cmpuint(warnings.count, ==, 1);
  g_assert_cmpstr(warnings.item[0].code, ==, "relaxation-extrapolated");
  warnings = (SbWarnings){0};
  sb_model_warn(&fresh, &warnings);
  g_assert_cmpuint(warnings.count, ==, 0);

  // Constants that make no sense together are a problem with its key.
  set(&params, "rubber.relaxation_share_2", 0.9);
  SbProblems problems;
  g_assert_cmpint(sb_model_compile(&stored, &params, NULL, &problems), ==, SB_ERROR_INPUT);
  g_assert_cmpuint(problems.count, >=, 1);
  g_assert_cmpstr(problems.item[0].key, ==, "rubber.relaxation_share_1");
}

static void test_gland(void) {
  SbParams params;
  sb_params_init(&params);
  SbModel model;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  SbGland gland;
  sb_model_gland(&gland, &model, SB_OUTER);
  SbGlandReadout out[SB_GLAND_COUNT];
  g_assert_cmpint(sb_gland_readouts(out, &gland, NULL), ==, SB_OK);
  g_assert_cmpfloat_with_epsilon(out[SB_GLAND_SQUEEZE].nominal, model.seal[SB_OUTER].squeeze,
                                 1e-12);
  g_assert_cmpfloat_with_epsilon(out[SB_GLAND_FILL].nominal, model.seal[SB_OUTER].gland_fill,
                                 1e-12);
  g_assert_cmpint(out[SB_GLAND_STRETCH_INNER].band, ==, SB_BAND_ABOVE);
  // The tolerance of one seal is its own.
  set(&params, "seal.outer.section_diameter_tolerance", 0);
  set(&params, "gland.radial_space_tolerance", 0);
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  sb_model_gland(&gland, &model, SB_OUTER);
  g_assert_cmpint(sb_gland_readouts(out, &gland, NULL), ==, SB_OK);
  g_assert_cmpfloat(out[SB_GLAND_SQUEEZE].worst_low, ==, out[SB_GLAND_SQUEEZE].worst_high);
  sb_model_gland(&gland, &model, SB_INNER);
  g_assert_cmpint(sb_gland_readouts(out, &gland, NULL), ==, SB_OK);
  g_assert_cmpfloat(out[SB_GLAND_SQUEEZE].worst_low, <, out[SB_GLAND_SQUEEZE].worst_high);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/model/model-names", test_model_names);
  g_test_add_func("/model/catalogue", test_catalogue);
  g_test_add_func("/model/choices", test_choices);
  g_test_add_func("/model/life-motions", test_life_motions);
  g_test_add_func("/model/overrides", test_overrides);
  g_test_add_func("/model/sets", test_sets);
  g_test_add_func("/model/derived", test_derived);
  g_test_add_func("/model/problems", test_problems);
  g_test_add_func("/model/variants", test_variants);
  g_test_add_func("/model/nothing-left", test_nothing_left);
  g_test_add_func("/model/gasket-sizes", test_gasket_sizes);
  g_test_add_func("/model/kept", test_kept);
  g_test_add_func("/model/size-checks", test_size_checks);
  g_test_add_func("/model/pressure-maps", test_pressure_maps);
  g_test_add_func("/model/storage", test_storage);
  g_test_add_func("/model/gland", test_gland);
  return g_test_run();
}
