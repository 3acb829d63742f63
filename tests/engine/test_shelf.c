// Loss on the shelf: what it is made of, which way it goes with each of its inputs, and when there
// is no figure.
#include "engine/fluid/fluid.h"
#include "engine/valve/answer/evaluate.h"
#include "engine/valve/figures/figures.h"
#include "tests/engine/models.h"
#include "tests/engine/near.h"

#include <string.h>

static const double BARRER = 3.35e-16, YEAR = 365 * 86400.0, ZERO = 273.15;
enum { R134A = 1, OTHER_PROPELLANT = 2, PERSSON = 1, SETTINGS_MAX = 16 };

// The valve with HFA-134a, 50 barrer and the surface that knows full contact, at 25 degC.
static const Setting usual[] = {{SB_P_FLUID_NAME, R134A},
                                {SB_P_RUBBER_PERMEABILITY, 50 * 3.35e-16},
                                {SB_P_RUBBER_WATER_PERMEABILITY, 900 * 3.35e-16},
                                {SB_P_MODELS_SURFACE, PERSSON},
                                {SB_P_CANISTER_TEMPERATURE, 298.15}};
enum { USUAL = G_N_ELEMENTS(usual) };

static void solve_with(SbSummary *out, const Setting *settings, size_t count) {
  SbModel model;
  compile(&model, settings, count);
  const int figures[] = {sb_figure_find("shelf.loss_kg_per_year"), sb_figure_find("shelf.loss_kg")};
  double value[2];
  SbEvaluator *evaluator;
  g_assert_cmpint(sb_evaluator_create(&evaluator, NULL), ==, SB_OK);
  const SbQuestion question = {.base = &model, .figure = figures, .figure_count = 2};
  g_assert_cmpint(sb_evaluator_ask(value, evaluator, &question, NULL), ==, SB_OK);
  *out = *sb_evaluator_summary(evaluator);
  sb_evaluator_destroy(evaluator);
}

// The summary of the usual valve's shelf with up to three settings changed.
static void solve(SbSummary *out, Setting a, Setting b, Setting c) {
  Setting all[SETTINGS_MAX];
  memcpy(all, usual, sizeof usual);
  all[USUAL] = a;
  all[USUAL + 1] = b;
  all[USUAL + 2] = c;
  solve_with(out, all, USUAL + 3);
}

static const Setting none = {-1, 0};

// The same on a surface that leaks.
static void solve_rough(SbSummary *out, double radial_space, Setting a) {
  Setting all[SETTINGS_MAX];
  const Setting rough[] = {{SB_P_MODELS_FIT, SB_FIT_DISC},
                           {SB_P_SURFACE_SIGMA_OVER_BETA, 1},
                           {SB_P_SURFACE_GT_PRODUCT, 0.05},
                           {SB_P_GLAND_RADIAL_SPACE, radial_space},
                           a};
  memcpy(all, usual, sizeof usual);
  memcpy(all + USUAL, rough, sizeof rough);
  solve_with(out, all, USUAL + G_N_ELEMENTS(rough));
}

static double loss(Setting a, Setting b) {
  static SbSummary summary; // large
  solve(&summary, a, b, none);
  g_assert_false(isnan(summary.shelf.loss_per_year));
  return summary.shelf.loss_per_year;
}

static const char *reason(const SbSummary *summary, const char *path) {
  return sb_figure_reason(summary, sb_figure_find(path));
}

// By hand: the slab, the fluid's pressure, the molar mass.
static void test_by_hand(void) {
  static SbSummary s;
  SbModel model;
  solve(&s, none, none, none);
  compile(&model, usual, USUAL);
  SbFluidState fluid;
  g_assert_cmpint(sb_fluid_state(&fluid, NULL, &sb_fluids[R134A], 298.15, 0, NULL), ==, SB_OK);
  const double g = model.radial_space, d = model.seal[SB_OUTER].section_fitted;
  const double conductance = 4 * (model.bore_diameter - g) * g * g / (d * d);
  const double q = exp(-10e3 / 8.314462618 * (1 / 298.15 - 1 / 293.15));
  const double rate = 50 * BARRER * q * conductance * fluid.figure[SB_FLUID_PRESSURE].value *
                      fluid.figure[SB_FLUID_MASS].value;
  assert_close(s.shelf.seal[SB_OUTER].conductance, conductance, 1e-9);
  assert_close(s.shelf.permeation, rate, 1e-9);
  assert_close(s.shelf.loss_per_year, YEAR * rate, 1e-9);
  // 60 % of 3.169 kPa of water at 25 degC.
  const double w = exp(-5e3 / 8.314462618 * (1 / 298.15 - 1 / 293.15));
  assert_close(s.shelf.moisture_per_year,
               YEAR * 900 * BARRER * w * conductance * 0.6 * 3169 * 0.018015, 4e-3);
  // At one temperature, without ageing, the sums are straight.
  assert_close(s.shelf.loss, 3 * s.shelf.loss_per_year, 1e-9);
  assert_close(s.shelf.moisture, 3 * s.shelf.moisture_per_year, 1e-9);
  assert_close(s.shelf.mass_left, 10e-6 * model.density - s.shelf.loss, 1e-9);
  g_assert_cmpfloat(s.shelf.doses_left, <, s.doses);
  // What is not computed, or not there, is not 0.
  g_assert_true(isnan(s.shelf.seal[SB_INNER].permeation));
  g_assert_true(isnan(s.shelf.seal[SB_INNER].moisture));
  g_assert_true(isnan(s.shelf.plastic));
  g_assert_nonnull(sb_figure_reason(&s, sb_figure_find("shelf.plastic_kg_per_s")));
  g_assert_nonnull(sb_figure_reason(&s, sb_figure_find("shelf.seals.inner.interface_sensitivity")));
  g_assert_cmpint(s.shelf.seal[SB_OUTER].state, ==, SB_LEAK_CLOSED);
  g_assert_cmpfloat(s.shelf.interface, ==, 0);
}

// Half of the permeability is half of the loss, and so on.
static void test_signs(void) {
  const double base = loss(none, none);
  assert_close(loss((Setting){SB_P_RUBBER_PERMEABILITY, 25 * BARRER}, none), base / 2, 1e-12);
  // Closer glands, thicker cords, looser rings and cold hold more.
  g_assert_cmpfloat(loss((Setting){SB_P_GLAND_RADIAL_SPACE, 1.30e-3}, none), <, 0.97 * base);
  g_assert_cmpfloat(loss((Setting){SB_P_SEAL_SECTION_DIAMETER, 1.66e-3}, none), <, 0.97 * base);
  g_assert_cmpfloat(loss((Setting){SB_P_SEAL_INNER_DIAMETER, 2.60e-3}, none), >, 1.01 * base);
  g_assert_cmpfloat(loss((Setting){SB_P_CANISTER_TEMPERATURE, ZERO + 40}, none), >, 1.5 * base);
  g_assert_cmpfloat(loss((Setting){SB_P_CANISTER_TEMPERATURE, ZERO + 5}, none), <, 0.6 * base);
  // Plastic beside: 1 barrer on 10 m of area over thickness.
  static SbSummary s;
  solve(&s, (Setting){SB_P_HOUSING_PERMEABILITY, BARRER},
        (Setting){SB_P_HOUSING_PERMEATION_LENGTH, 10}, none);
  g_assert_cmpfloat(s.shelf.plastic, >, 0);
  assert_close(s.shelf.loss_per_year, base + YEAR * s.shelf.plastic, 1e-9);
  // Humidity is the moisture's alone.
  solve(&s, (Setting){SB_P_CANISTER_HUMIDITY, 0}, none, none);
  g_assert_cmpfloat(s.shelf.moisture_per_year, ==, 0);
  assert_close(s.shelf.loss_per_year, base, 1e-12);
}

static void test_ring(void) {
  static SbSummary slab, ring, tight;
  solve(&slab, none, none, none);
  solve(&ring, (Setting){SB_P_MODELS_FIT, SB_FIT_RING}, none, none);
  solve(&tight, (Setting){SB_P_MODELS_FIT, SB_FIT_RING},
        (Setting){SB_P_GLAND_RADIAL_SPACE, 1.30e-3}, none);
  g_test_message("slab %.4g mm, ring %.4g mm, error %.1e", 1e3 * slab.shelf.seal[0].conductance,
                 1e3 * ring.shelf.seal[0].conductance, ring.shelf.error);
  g_assert_true(warned(&slab.warnings, "shelf-slab"));
  g_assert_false(warned(&ring.warnings, "shelf-slab"));
  g_assert_cmpfloat(ring.shelf.error, <, 2e-3);
  assert_close(ring.shelf.loss_per_year, slab.shelf.loss_per_year, 0.25);
  g_assert_cmpfloat(tight.shelf.loss_per_year, <, 0.97 * ring.shelf.loss_per_year);
}

// Nothing known is nothing told: null with its reason, never 0.
static void test_unknown(void) {
  static SbSummary s;
  solve(&s, (Setting){SB_P_RUBBER_PERMEABILITY, 0}, (Setting){SB_P_RUBBER_WATER_PERMEABILITY, 0},
        none);
  g_assert_true(isnan(s.shelf.loss_per_year) && isnan(s.shelf.loss) && isnan(s.shelf.doses_left));
  g_assert_nonnull(strstr(reason(&s, "shelf.loss_kg_per_year"), "rubber.permeability"));
  g_assert_nonnull(strstr(reason(&s, "shelf.moisture_kg_per_year"), "rubber.water_permeability"));
  g_assert_nonnull(strstr(reason(&s, "shelf.mass_left_kg"), "rubber.permeability"));
  g_assert_cmpfloat(s.shelf.interface, ==, 0);
  solve(&s, (Setting){SB_P_MODELS_SURFACE, 0}, none, none);
  g_assert_true(isnan(s.shelf.loss_per_year) && s.shelf.permeation > 0);
  g_assert_nonnull(strstr(reason(&s, "shelf.interface_kg_per_s"), "models.surface"));
  solve(&s, (Setting){SB_P_FLUID_NAME, 0}, none, none);
  g_assert_nonnull(strstr(reason(&s, "shelf.loss_kg_per_year"), "custom"));
  // A ring that does not touch is open, and no number.
  solve(&s, (Setting){SB_P_GLAND_RADIAL_SPACE, 1.75e-3}, (Setting){SB_P_MODELS_FIT, SB_FIT_DISC},
        none);
  g_assert_cmpint(s.shelf.seal[SB_OUTER].state, ==, SB_LEAK_OPEN);
  g_assert_true(isnan(s.shelf.loss_per_year) && isnan(s.shelf.moisture_per_year));
  g_assert_nonnull(strstr(reason(&s, "shelf.loss_kg_per_year"), "open"));
}

// A rough and hard contact leaks along itself: liquid more than vapour, less the harder it is
// pressed, and nothing of what does not wet.
static void test_contact(void) {
  static SbSummary liquid, vapour, tight, held;
  solve_rough(&liquid, 1.5e-3, none);
  g_test_message("state %d, %.3g kg/s, sensitivity %.3g", (int)liquid.shelf.seal[0].state,
                 liquid.shelf.interface, liquid.shelf.seal[0].sensitivity);
  g_assert_cmpint(liquid.shelf.seal[SB_OUTER].state, ==, SB_LEAK_PERCOLATING);
  g_assert_cmpfloat(liquid.shelf.interface, >, 0);
  g_assert_cmpfloat(liquid.shelf.seal[SB_OUTER].sensitivity, <, -1);
  assert_close(liquid.shelf.loss_per_year,
               YEAR * (liquid.shelf.permeation + liquid.shelf.interface), 1e-12);
  solve_rough(&vapour, 1.5e-3, (Setting){SB_P_SHELF_PHASE, 1});
  g_assert_cmpfloat(vapour.shelf.interface, <, liquid.shelf.interface);
  solve_rough(&tight, 1.49e-3, none);
  g_assert_cmpfloat(tight.shelf.interface, <, liquid.shelf.interface);
  solve_rough(&held, 1.5e-3, (Setting){SB_P_FLUID_CONTACT_ANGLE, M_PI});
  g_assert_cmpfloat(held.shelf.interface, <, liquid.shelf.interface);
}

// A warehouse about a mean loses more than that mean all the time, as the rate is convex; a rubber
// that relaxes and one that swells change it.
static void test_history(void) {
  static SbSummary steady, warehouse, swelling;
  solve(&steady, none, none, none);
  solve(&warehouse, (Setting){SB_P_SHELF_HISTORY, SB_SHELF_WAREHOUSE}, none, none);
  g_assert_cmpfloat(warehouse.shelf.loss, >, 1.01 * steady.shelf.loss);
  g_assert_cmpfloat(warehouse.shelf.loss, <, 1.10 * steady.shelf.loss);
  assert_close(warehouse.shelf.loss_per_year, steady.shelf.loss_per_year, 1e-12);
  double mean = 0;
  for (int i = 1; i < SB_SHELF_POINTS; i++) {
    mean += warehouse.shelf.point[i].temperature / (SB_SHELF_POINTS - 1);
  }
  assert_close(mean, 298.15, 1e-3);
  solve(&swelling, (Setting){SB_P_RUBBER_SWELL_MASS, 0.17}, none, none);
  g_assert_cmpfloat(swelling.shelf.loss, <, 0.98 * steady.shelf.loss);
  assert_close(swelling.shelf.loss_per_year, steady.shelf.loss_per_year, 1e-12);
}

// Nobody asks: nothing is computed, and the reason says so.
static void test_not_asked(void) {
  SbModel model;
  compile(&model, usual, USUAL);
  SbRun *run = run_of(&model, SB_OK, NULL);
  g_assert_true(isnan(sb_run_summary(run)->shelf.loss_per_year));
  g_assert_nonnull(strstr(reason(sb_run_summary(run), "shelf.loss_kg_per_year"), "not requested"));
  sb_run_destroy(run);
  model.views |= SB_VIEW_SHELF;
  run = run_of(&model, SB_OK, NULL);
  g_assert_cmpfloat(sb_run_summary(run)->shelf.loss_per_year, >, 0);
  sb_run_destroy(run);
}

// A figure of another fluid is used with a warning only: stated by fluid.figures, left as it was
// when an override changes the propellant, or known from the rubber to be another one's.
static void test_other_fluid(void) {
  const double own = 47 * 3.35e-16;
  SbRubberSheet sheet = {.name = "sheet", .count = 1};
  sheet.figure[0].id = SB_P_RUBBER_PERMEABILITY;
  sheet.figure[0].fluid = R134A;
  sheet.figure[0].value = own;
  static const struct {
    double stated, given;
    bool sheet, warns;
    double used;                                     // over the sheet's
  } rows[] = {{0, 0, true, false, 0},                // the rubber has none for this propellant
              {R134A, 0, true, true, 1},             // stated to be another one's
              {OTHER_PROPELLANT, 0, true, false, 0}, //
              {0, 1, true, true, 1},                 // given, but the sheet has it for another one
              {0, 2, true, false, 2},                // given
              {0, 1, false, false, 1},               // given, nothing else is known
              {R134A, 1, false, true, 1}};
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    SbParams params;
    SbModel model;
    SbWarnings warnings = {0};
    sb_params_init(&params);
    params.rubber = rows[i].sheet ? &sheet : NULL;
    g_assert_cmpint(sb_params_set(&params, SB_P_FLUID_NAME, OTHER_PROPELLANT, NULL), ==, SB_OK);
    if (rows[i].stated > 0) {
      g_assert_cmpint(sb_params_set(&params, SB_P_FLUID_FIGURES, rows[i].stated, NULL), ==, SB_OK);
    }
    if (rows[i].given > 0) {
      g_assert_cmpint(sb_params_set(&params, SB_P_RUBBER_PERMEABILITY, rows[i].given * own, NULL),
                      ==, SB_OK);
    }
    g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
    sb_model_warn(&model, &warnings);
    g_assert_cmpint(warned(&warnings, "fluid-property"), ==, rows[i].warns);
    g_assert_cmpfloat_with_epsilon(model.permeability / own, rows[i].used, 1e-12);
  }
  // An override of the propellant, alone and with its own figure.
  const Setting base[] = {{SB_P_FLUID_NAME, R134A}, {SB_P_RUBBER_PERMEABILITY, own}};
  const SbOverride swap[] = {{SB_P_FLUID_NAME, OTHER_PROPELLANT},
                             {SB_P_RUBBER_PERMEABILITY, 2 * own}};
  for (size_t count = 0; count <= 2; count++) {
    SbModel model;
    SbWarnings warnings = {0};
    compile(&model, base, G_N_ELEMENTS(base));
    g_assert_cmpint(sb_model_override(&model, &model, swap, count, NULL), ==, SB_OK);
    sb_model_warn(&model, &warnings);
    g_assert_cmpint(warned(&warnings, "fluid-property"), ==, count == 1);
  }
}

// Values that the catalogue infers for HFA-134a have a warning with each other fluid, where a run
// uses them: the diffusivity for the time lag.
static void test_catalogue_fluid(void) {
  static const struct {
    SbParamId id;
    double other; // a value of another fluid
  } rows[] = {{SB_P_RUBBER_DIFFUSION, 6e-12},
              {SB_P_FLUID_PRESSURE_VISCOSITY, 3e-9},
              {SB_P_FLUID_VAPOUR_VISCOSITY, 10e-6}};
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    for (int fluid = 0; fluid <= OTHER_PROPELLANT; fluid++) {
      const bool foreign = fluid != 0 && fluid != R134A;
      SbParams params;
      sb_params_init(&params);
      g_assert_cmpint(sb_params_set(&params, SB_P_FLUID_NAME, fluid, NULL), ==, SB_OK);
      g_assert_cmpint(sb_params_other_fluid(&params, rows[i].id), ==, foreign ? R134A : -1);
      const double same = sb_params_get(&params, rows[i].id);
      g_assert_cmpint(sb_params_set(&params, rows[i].id, same, NULL), ==, SB_OK);
      g_assert_cmpint(sb_params_other_fluid(&params, rows[i].id), ==, foreign ? R134A : -1);
      // A change of the fluid does not make the rubber's other figures those of HFA-134a.
      SbParams swapped = params;
      g_assert_cmpint(sb_params_set(&swapped, SB_P_FLUID_NAME, OTHER_PROPELLANT, NULL), ==, SB_OK);
      sb_params_keep_fluid(&swapped, &params);
      g_assert_false(swapped.given[SB_P_FLUID_FIGURES]);
      g_assert_cmpint(sb_params_set(&params, rows[i].id, rows[i].other, NULL), ==, SB_OK);
      g_assert_cmpint(sb_params_other_fluid(&params, rows[i].id), ==, -1);
    }
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/shelf/by-hand", test_by_hand);
  g_test_add_func("/shelf/catalogue-fluid", test_catalogue_fluid);
  g_test_add_func("/shelf/signs", test_signs);
  g_test_add_func("/shelf/ring", test_ring);
  g_test_add_func("/shelf/unknown", test_unknown);
  g_test_add_func("/shelf/contact", test_contact);
  g_test_add_func("/shelf/history", test_history);
  g_test_add_func("/shelf/not-asked", test_not_asked);
  g_test_add_func("/shelf/other-fluid", test_other_fluid);
  return g_test_run();
}
