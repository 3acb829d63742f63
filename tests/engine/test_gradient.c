// Gradients: against differences of whole runs by another stencil; exact zeros; kinks, jumps and
// ends of ranges; what a choice would give; cancelling.
#include "engine/contact/fit.h"
#include "engine/valve/gradient.h"
#include "engine/valve/sealbench.h"

#include <glib.h>
#include <math.h>
#include <string.h>

static const char *const paths[] = {"cycle.force_peak_N",
                                    "cycle.force_breakaway_N",
                                    "cycle.force_return_min_N",
                                    "cycle.energy_loss_J",
                                    "seals.outer.load_N",
                                    "seals.inner.contact_width_m",
                                    "seals.outer.film_central_m",
                                    "seals.inner.lambda",
                                    "seals.outer.friction_static_N",
                                    "seals.outer.leakage_per_stroke_m3"};
enum { FIGURES = G_N_ELEMENTS(paths), OVERRIDES_MAX = 8 };

typedef struct {
  SbModel *model;
  SbEvaluator *evaluator;
  int figure[FIGURES];
  SbQuestion question;
} Valve;

static void set_up(Valve *valve, const SbOverride *change, size_t changes) {
  SbParams params;
  sb_params_init(&params);
  for (size_t i = 0; i < changes; i++) {
    g_assert_cmpint(sb_params_set(&params, change[i].id, change[i].value, NULL), ==, SB_OK);
  }
  g_assert_cmpint(sb_model_create(&valve->model, &params, NULL, NULL, NULL), ==, SB_OK);
  g_assert_cmpint(sb_evaluator_create(&valve->evaluator, NULL), ==, SB_OK);
  for (size_t i = 0; i < FIGURES; i++) {
    valve->figure[i] = sb_figure_find(paths[i]);
    g_assert_cmpint(valve->figure[i], >=, 0);
  }
  valve->question =
      (SbQuestion){.base = valve->model, .figure = valve->figure, .figure_count = FIGURES};
}

static void clear(Valve *valve) {
  sb_evaluator_destroy(valve->evaluator);
  sb_model_destroy(valve->model);
}

static SbGradient *gradient_of(Valve *valve, const SbParamId *parameter, size_t count) {
  SbGradient *gradient;
  SbReport report;
  SbStatus status = sb_gradient_create(&gradient, valve->evaluator, &valve->question, parameter,
                                       count, NULL, &report);
  if (status != SB_OK) {
    g_error("%s: %s", sb_status_text(status), report.text);
  }
  return gradient;
}

// Figures of a whole run with one parameter elsewhere; false: no such valve.
static bool run_at(double *value, const Valve *valve, SbParamId id, double x) {
  const SbOverride override = {id, x};
  SbModel *model;
  SbPlan plan;
  SbRun *run;
  if (sb_model_derive(&model, valve->model, &override, 1, NULL) != SB_OK) {
    return false;
  }
  sb_plan_figures(&plan, model, valve->figure, FIGURES);
  g_assert_cmpint(sb_run_create(&run, model, &plan, NULL), ==, SB_OK);
  bool done = sb_run_execute(run, &(SbRunHooks){.alone = true}, NULL) == SB_OK;
  for (size_t i = 0; i < FIGURES; i++) {
    value[i] = sb_figure_value(sb_run_summary(run), valve->figure[i]);
  }
  sb_run_destroy(run);
  sb_model_destroy(model);
  return done;
}

// Slopes by five points, fourth order; false where a point is not to be had.
static bool five_points(double *slope, const Valve *valve, SbParamId id, double x, double h) {
  double value[4][FIGURES];
  static const double place[] = {-1, 1, -2, 2};
  for (size_t k = 0; k < G_N_ELEMENTS(place); k++) {
    const double at = x + place[k] * h;
    if (at < sb_param(id)->min || at > sb_param(id)->max || !run_at(value[k], valve, id, at)) {
      return false;
    }
  }
  for (size_t i = 0; i < FIGURES; i++) {
    slope[i] = (8 * (value[1][i] - value[0][i]) - (value[3][i] - value[2][i])) / (12 * h);
  }
  return true;
}

// Leaves out groups of which few parameters or none enter these figures, so that draws are no
// waste.
static bool may_enter(SbParamId id) {
  static const char *const groups[] = {"part.", "study.", "output.", "rig.", "life.", "rubber."};
  for (size_t i = 0; i < G_N_ELEMENTS(groups); i++) {
    if (g_str_has_prefix(sb_param(id)->key, groups[i])) {
      return false;
    }
  }
  return true;
}

// Holds the gradient to the stencil for `count` parameters drawn from those that move anything;
// within `close` of the slope, of what the figure is over the parameter in rounding.
static void compare(const SbOverride *change, size_t changes, size_t count, guint32 seed,
                    double close) {
  Valve valve;
  SbParamId parameter[SB_PARAM_COUNT];
  size_t compared = 0, moved = 0;
  set_up(&valve, change, changes);
  // By a hash of their keys, so that another parameter in the catalogue takes the place of one at
  // most.
  guint least = 0;
  for (size_t i = 0; i < count; i++) {
    guint next = G_MAXUINT;
    for (int id = 0; id < SB_PARAM_COUNT; id++) {
      const guint hash = (g_str_hash(sb_param((SbParamId)id)->key) ^ seed) * 2654435761u;
      if (hash > least && hash < next && sb_gradient_wants((SbParamId)id) &&
          sb_model_value(valve.model, (SbParamId)id) != 0 && may_enter((SbParamId)id)) {
        next = hash;
        parameter[i] = (SbParamId)id;
      }
    }
    least = next;
  }
  SbGradient *gradient = gradient_of(&valve, parameter, count);
  for (size_t k = 0; k < count; k++) {
    const double x = sb_gradient_at(gradient, k);
    double slope[FIGURES];
    if (!five_points(slope, &valve, parameter[k], x,
                     1e-4 * fabs(x))) { // meshes change by jumps, seldom
      continue;
    }
    for (size_t i = 0; i < FIGURES; i++) {
      const double is = sb_gradient_slope(gradient, i, k), off = fabs(is - slope[i]);
      const double rounding = 1e-8 * fabs(sb_gradient_value(gradient, i) / x);
      if (!isfinite(is) || off > close * fabs(slope[i]) + rounding) {
        g_error("%s by %s: %.10g with an error of %.2g, %.10g by five points; %s", paths[i],
                sb_param(parameter[k])->key, is, sb_gradient_error(gradient, i, k), slope[i],
                isfinite(is) ? "" : sb_gradient_reason(gradient, i, k));
      }
      compared++;
      moved += slope[i] != 0;
    }
  }
  g_test_message("%zu compared, %zu not zero", compared, moved);
  g_assert_cmpuint(compared, >, count * FIGURES / 3);
  g_assert_cmpuint(moved, >, compared / 20);
  sb_gradient_destroy(gradient);
  clear(&valve);
}

static void test_closed_forms(void) {
  compare(NULL, 0, 50, 17, 1e-6);
}

static void test_disc(void) {
  const SbOverride change[] = {{SB_P_MODELS_FIT, SB_FIT_DISC}};
  compare(change, 1, 12, 18, 1e-6);
}

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

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/gradient/closed-forms", test_closed_forms);
  g_test_add_func("/gradient/disc", test_disc);
  g_test_add_func("/gradient/zeros", test_zeros);
  return g_test_run();
}
