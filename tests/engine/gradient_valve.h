// The default valve with some changes and its gradient, for tests of gradients.
#pragma once

#include "engine/valve/answer/gradient.h"
#include "engine/valve/sealbench.h"

#include <glib.h>

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
enum { FIGURES = G_N_ELEMENTS(paths), LOAD = 4, WIDTH = 5, OVERRIDES_MAX = 8 };

// A valve with its evaluator, and the question for the figures of `paths`.
typedef struct {
  SbModel *model;
  SbEvaluator *evaluator;
  int figure[FIGURES];
  SbQuestion question;
} Valve;

// Sets up the default valve with `changes` parameters changed. To be freed by clear().
static inline void set_up(Valve *valve, const SbOverride *change, size_t changes) {
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

static inline void clear(Valve *valve) {
  sb_evaluator_destroy(valve->evaluator);
  sb_model_destroy(valve->model);
}

// Returns the gradient of the question by `count` parameters; fails the test otherwise. Owned by
// the caller (sb_gradient_destroy).
static inline SbGradient *gradient_of(Valve *valve, const SbParamId *parameter, size_t count) {
  SbGradient *gradient;
  SbReport report;
  SbStatus status = sb_gradient_create(&gradient, valve->evaluator, &valve->question, parameter,
                                       count, NULL, &report);
  if (status != SB_OK) {
    g_error("%s: %s", sb_status_text(status), report.text);
  }
  return gradient;
}
