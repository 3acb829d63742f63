// Gradients: exact zeros, jumps, what has no derivative, and why; the tangent of a ring;
// cancelling.
#include "engine/contact/fit.h"
#include "tests/engine/gradient_valve.h"

#include <glib.h>
#include <math.h>
#include <string.h>

// What does not enter has the derivative 0, and no error; a seal's own size moves its seal alone.
static void test_zeros(void) {
  static const SbParamId parameter[] = {SB_P_DRIVE_RISE_TIME, SB_P_BORE_ENTRY_LENGTH,
                                        SB_P_SEAL_INNER_MODULUS, SB_P_SEAL_MODULUS,
                                        SB_P_SEAL_OUTER_MODULUS};
  enum { PARAMETERS = G_N_ELEMENTS(parameter) };
  Valve valve;
  set_up(&valve, NULL, 0);
  SbGradient *gradient = gradient_of(&valve, parameter, PARAMETERS);
  for (size_t i = 0; i < FIGURES; i++) {
    const bool outer = strncmp(paths[i], "seals.outer.", 12) == 0;
    for (size_t k = 0; k < 2 + (size_t)outer; k++) {
      g_assert_cmpfloat(sb_gradient_slope(gradient, i, k), ==, 0);
      g_assert_cmpfloat(sb_gradient_error(gradient, i, k), ==, 0);
      g_assert_null(sb_gradient_reason(gradient, i, k));
    }
    // Both seals' modulus moves both.
    const double both = sb_gradient_slope(gradient, i, 3);
    const double sum = sb_gradient_slope(gradient, i, 2) + sb_gradient_slope(gradient, i, 4);
    g_assert_true(fabs(both - sum) <= 1e-6 * fabs(both));
  }
  sb_gradient_destroy(gradient);
  clear(&valve);
}

// Energy that a cycle leaves stored is rounding where the cycle ends where it began: its slopes are
// exactly 0, by parameters that move all of its terms as well. No slope is smaller than its error.
static void test_noise(void) {
  static const SbParamId parameter[] = {SB_P_SEAL_MODULUS, SB_P_SEAL_INNER_DIAMETER,
                                        SB_P_FLUID_VISCOSITY, SB_P_DRIVE_STIFFNESS,
                                        SB_P_GLAND_RADIAL_SPACE};
  enum { PARAMETERS = G_N_ELEMENTS(parameter) };
  Valve valve;
  set_up(&valve, NULL, 0);
  valve.figure[0] = sb_figure_find("cycle.energy.stored_J");
  valve.figure[1] = sb_figure_find("cycle.energy_closure");
  SbGradient *gradient = gradient_of(&valve, parameter, PARAMETERS);
  for (size_t k = 0; k < PARAMETERS; k++) {
    g_assert_cmpfloat(sb_gradient_slope(gradient, 0, k), ==, 0);
    g_assert_cmpfloat(sb_gradient_error(gradient, 0, k), ==, 0);
    for (size_t i = 0; i < FIGURES; i++) {
      const double slope = sb_gradient_slope(gradient, i, k);
      const double error = sb_gradient_error(gradient, i, k);
      g_assert_true((isnan(slope) && isnan(error)) || error <= fabs(slope));
      g_assert_true(isnan(slope) == (sb_gradient_reason(gradient, i, k) != NULL));
    }
  }
  sb_gradient_destroy(gradient);
  clear(&valve);
}

// At the speed at which the chamber just fills its share bends: no derivative, and why; one beside
// it. A parameter that the models do not take has none either.
static void test_kink(void) {
  static const SbParamId parameter[] = {SB_P_CHAMBER_DISCHARGE_COEFFICIENT, SB_P_DRIVE_SPEED,
                                        SB_P_FRICTION_STRIBECK_SPEED};
  static const char *const needs[] = {"dose.filled_share", "dose.filling_time_s",
                                      "cycle.stages.C.time_s", "cycle.stages.F.time_s"};
  int figure[G_N_ELEMENTS(needs)];
  double value[G_N_ELEMENTS(needs)];
  SbOverride speed = {SB_P_DRIVE_SPEED, 0.3};
  Valve valve;
  set_up(&valve, NULL, 0);
  for (size_t i = 0; i < G_N_ELEMENTS(needs); i++) {
    figure[i] = sb_figure_find(needs[i]);
  }
  valve.question = (SbQuestion){.base = valve.model,
                                .override = &speed,
                                .override_count = 1,
                                .figure = figure,
                                .figure_count = G_N_ELEMENTS(needs)};
  for (int round = 0; round < 30; round++) {
    g_assert_cmpint(sb_evaluator_ask(value, valve.evaluator, &valve.question, NULL), ==, SB_OK);
    speed.value *= (value[3] - value[2]) / value[1];
  }
  g_assert_cmpfloat_with_epsilon(value[0], 1, 1e-9);
  for (int beside = 0; beside < 2; beside++) {
    speed.value *= beside == 1 ? 1.1 : 1;
    SbGradient *gradient = gradient_of(&valve, parameter, G_N_ELEMENTS(parameter));
    const double coefficient = sb_gradient_at(gradient, 0), share = sb_gradient_value(gradient, 0);
    if (beside == 0) {
      g_assert_true(isnan(sb_gradient_slope(gradient, 0, 0)));
      g_assert_true(isnan(sb_gradient_error(gradient, 0, 0)));
      g_assert_nonnull(strstr(sb_gradient_reason(gradient, 0, 0), "bends"));
      g_assert_nonnull(sb_gradient_reason(gradient, 0, 1));
    } else { // in proportion to the coefficient
      g_assert_cmpfloat(share, <, 0.95);
      g_assert_true(fabs(sb_gradient_slope(gradient, 0, 0) * coefficient / share - 1) < 1e-8);
    }
    g_assert_true(fabs(sb_gradient_slope(gradient, 1, 0) * coefficient + value[1]) <
                  1e-8 * value[1]);
    g_assert_nonnull(strstr(sb_gradient_reason(gradient, 0, 2), "needs models.motion = dynamic"));
    g_assert_true(sb_gradient_is_fixed(gradient, 0, 2));
    g_assert_false(sb_gradient_is_fixed(gradient, 0, 0));
    sb_gradient_destroy(gradient);
  }
  clear(&valve);
}

// The derivatives predict the valve with two changed parameters to second order.
static void test_predict(void) {
  static const SbParamId parameter[] = {SB_P_GLAND_RADIAL_SPACE, SB_P_SEAL_MODULUS};
  const SbOverride change[] = {{SB_P_GLAND_RADIAL_SPACE, 1.361e-3}, {SB_P_SEAL_MODULUS, 2.505e6}};
  double value[FIGURES];
  Valve valve;
  set_up(&valve, NULL, 0);
  SbGradient *gradient = gradient_of(&valve, parameter, G_N_ELEMENTS(parameter));
  valve.question.override = change;
  valve.question.override_count = G_N_ELEMENTS(change);
  g_assert_cmpint(sb_evaluator_ask(value, valve.evaluator, &valve.question, NULL), ==, SB_OK);
  for (size_t i = 0; i < FIGURES; i++) {
    const double was = sb_gradient_value(gradient, i);
    double predicted = was;
    for (size_t k = 0; k < G_N_ELEMENTS(change); k++) {
      predicted +=
          sb_gradient_slope(gradient, i, k) * (change[k].value - sb_gradient_at(gradient, k));
    }
    g_assert_true(fabs(predicted - value[i]) <= 2e-2 * fabs(value[i] - was));
  }
  sb_gradient_destroy(gradient);
  clear(&valve);
}

// A ring that the pressure laid on its wall goes with it in a wider groove, whatever its floor
// rubs: beside the base's as laid anew.
static void test_ring_on_wall(void) {
  const SbRingBody body = {.section_diameter = 1.61e-3,
                           .inner_diameter = 2.84e-3,
                           .modulus = 2.5e6,
                           .poisson_ratio = 0.49};
  SbRingLoad load = SB_RING_LOAD_INIT;
  load.bore_radius = 3e-3;
  load.floor_radius = 1.64e-3;
  load.wall_left = -1e-3;
  load.wall_right = 1e-3;
  load.pressure_left = 0.55e6;
  load.friction_bore = 0.2;
  load.friction_floor = 0.3;
  load.friction_wall = 0.1;
  load.bore_slides = 1;
  const SbRingOptions options = {0};
  SbRing *ring, *near;
  SbRingResult is, moved;
  g_assert_cmpint(sb_ring_create(&ring, &body, &load, NULL, NULL), ==, SB_OK);
  sb_ring_result(ring, &is);
  g_assert_cmpfloat(is.wall_right_force, >, 0);
  load.wall_left = -1.05e-3;
  load.wall_right = 1.05e-3;
  g_assert_cmpint(sb_ring_near(&near, ring, NULL, &body, &load, &options, NULL), ==, SB_OK);
  sb_ring_result(near, &moved);
  g_test_message("load %.10g N, %.10g N in the wider groove", is.bore_force, moved.bore_force);
  g_assert_cmpfloat_with_epsilon(moved.bore_force, is.bore_force, 1e-8 * is.bore_force);
  sb_ring_destroy(near);
  sb_ring_destroy(ring);
}

static bool stop(void *data) {
  return ++*(int *)data > 5;
}

static void test_refused(void) {
  static const SbParamId number = SB_P_OUTPUT_FRAMES, real = SB_P_SEAL_MODULUS;
  SbGradient *gradient;
  SbReport report;
  Valve valve;
  set_up(&valve, NULL, 0);
  g_assert_cmpint(
      sb_gradient_create(&gradient, valve.evaluator, &valve.question, &number, 1, NULL, &report),
      ==, SB_ERROR_INPUT);
  g_assert_null(gradient);
  g_assert_cmpstr(sb_input_key(report.input), ==, "output.frames");
  int asked = 0;
  valve.question.cancelled = stop;
  valve.question.data = &asked;
  g_assert_cmpint(
      sb_gradient_create(&gradient, valve.evaluator, &valve.question, &real, 1, NULL, &report), ==,
      SB_ERROR_CANCELLED);
  g_assert_null(gradient);
  clear(&valve);
}

// A base whose rings use up the work limit reports that, not that no tangent is there.
static void test_work_limit(void) {
  static const SbParamId modulus = SB_P_SEAL_MODULUS;
  const SbOverride change[] = {{SB_P_MODELS_SET, SB_MODEL_SET_CONSISTENT},
                               {SB_P_OUTPUT_WORK_LIMIT, 100}};
  SbGradient *gradient;
  SbReport report;
  Valve valve;
  set_up(&valve, change, G_N_ELEMENTS(change));
  g_assert_cmpint(
      sb_gradient_create(&gradient, valve.evaluator, &valve.question, &modulus, 1, NULL, &report),
      ==, SB_ERROR_NOT_CONVERGED);
  g_assert_cmpstr(sb_input_key(report.input), ==, "output.work_limit");
  sb_gradient_destroy(gradient);
  clear(&valve);
}

// A ring near another is the one that the solver steps to on the same mesh, and scales as bodies
// do.
static void test_ring_near(void) {
  const SbRingBody body = {.section_diameter = 1.61e-3,
                           .inner_diameter = 2.84e-3,
                           .modulus = 2.5e6,
                           .poisson_ratio = 0.49};
  SbRingLoad load = SB_RING_LOAD_INIT;
  load.bore_radius = 3e-3;
  load.floor_radius = 1.64e-3;
  const SbRingOptions options = {0};
  SbRing *ring, *near;
  SbRingResult is, moved, stepped;
  g_assert_cmpint(sb_ring_create(&ring, &body, &load, NULL, NULL), ==, SB_OK);
  sb_ring_result(ring, &is);
  const double more = 1e-5;
  // Stiffer: the load with it. Larger: with the square.
  SbRingBody other = body;
  other.modulus *= 1 + more;
  g_assert_cmpint(sb_ring_near(&near, ring, NULL, &other, &load, &options, NULL), ==, SB_OK);
  sb_ring_result(near, &moved);
  g_assert_true(fabs(moved.bore_force / is.bore_force - 1 - more) < 1e-9);
  sb_ring_destroy(near);
  SbRingLoad larger = load;
  other = body;
  other.section_diameter *= 1 + more;
  other.inner_diameter *= 1 + more;
  larger.bore_radius *= 1 + more;
  larger.floor_radius *= 1 + more;
  g_assert_cmpint(sb_ring_near(&near, ring, NULL, &other, &larger, &options, NULL), ==, SB_OK);
  sb_ring_result(near, &moved);
  g_assert_true(fabs(moved.bore_force / is.bore_force - (1 + more) * (1 + more)) < 1e-9);
  sb_ring_destroy(near);
  // A wider bore: the slope is that of the solver's own step.
  SbRingLoad wider = load;
  wider.bore_radius += 1e-8;
  g_assert_cmpint(sb_ring_near(&near, ring, NULL, &body, &wider, &options, NULL), ==, SB_OK);
  sb_ring_result(near, &moved);
  g_assert_cmpint(sb_ring_step(ring, &wider, NULL), ==, SB_OK);
  sb_ring_result(ring, &stepped);
  const double slope = moved.bore_force - is.bore_force;
  g_test_message("load %.10g N, slopes %.8g and %.8g", is.bore_force, slope,
                 stepped.bore_force - is.bore_force);
  g_assert_cmpfloat(slope, <, 0);
  g_assert_true(fabs((stepped.bore_force - is.bore_force) / slope - 1) < 1e-4);
  sb_ring_destroy(near);
  sb_ring_destroy(ring);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/gradient/zeros", test_zeros);
  g_test_add_func("/gradient/noise", test_noise);
  g_test_add_func("/gradient/kink", test_kink);
  g_test_add_func("/gradient/predict", test_predict);
  g_test_add_func("/gradient/refused", test_refused);
  g_test_add_func("/gradient/work-limit", test_work_limit);
  g_test_add_func("/gradient/ring-near", test_ring_near);
  g_test_add_func("/gradient/ring-on-wall", test_ring_on_wall);
  return g_test_run();
}
