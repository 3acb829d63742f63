// The budget of a run's work, output.work_limit: where it ends the run, what it names, what is
// kept, and that threads have no influence on it.
#include "tests/engine/models.h"

#include "engine/valve/sealbench.h"

#include <string.h>

typedef struct {
  SbStatus status;
  SbReport report;
  SbRun *run; // owned
} Outcome;

static SbModel *model_of(const SbOverride *over, size_t count, int limit) {
  SbParams params;
  SbProblems problems;
  SbModel *model;
  sb_params_init(&params);
  for (size_t i = 0; i < count; i++) {
    g_assert_cmpint(sb_params_set(&params, over[i].id, over[i].value, NULL), ==, SB_OK);
  }
  g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_FRAMES, 50, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_WORK_LIMIT, limit, NULL), ==, SB_OK);
  g_assert_cmpint(sb_model_create(&model, &params, NULL, NULL, &problems), ==, SB_OK);
  return model;
}

static Outcome execute(const SbOverride *over, size_t count, int limit, bool alone) {
  Outcome out = {0};
  SbPlan plan;
  SbModel *model = model_of(over, count, limit);
  const SbRunHooks hooks = {.alone = alone};
  sb_plan_make(&plan, model);
  g_assert_cmpint(sb_run_create(&out.run, model, &plan, NULL), ==, SB_OK);
  sb_model_destroy(model);
  out.status = sb_run_execute(out.run, &hooks, &out.report);
  return out;
}

static const SbOverride RINGS[] = {{SB_P_MODELS_SET, SB_MODEL_SET_CONSISTENT},
                                   {SB_P_OUTPUT_TOLERANCE, 1e-2}};
static const SbOverride FILMS[] = {{SB_P_MODELS_FILM, SB_FILM_REYNOLDS}};
static const SbOverride MOTION[] = {{SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC},
                                    {SB_P_FRICTION_STRIBECK_SPEED, 1e-3}};
static const SbOverride RIG[] = {{SB_P_MODELS_MOTION, SB_MODEL_MOTION_RIG}};

// The solver that comes first ends, and its name, seal, stage and place are in the report. No more
// than the limit is computed, and the figures that are missing have a reason.
static void ends(void) {
  static const struct {
    const SbOverride *over;
    size_t count;
    const char *solver;
  } cases[] = {{RINGS, 2, "fitment (ring), outer seal"},
               {FILMS, 1, "film (reynolds), outer seal"},
               {MOTION, 2, "motion (dynamic), both seals"}};
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    Outcome whole = execute(cases[i].over, cases[i].count, 1000000, false);
    const size_t work = sb_run_summary(whole.run)->work;
    g_assert_cmpint(whole.status, ==, SB_OK);
    g_assert_cmpuint(work, >, 20);
    sb_run_destroy(whole.run);
    for (int limit = 1; limit < (int)work; limit = 30 * limit + 3) {
      Outcome cut = execute(cases[i].over, cases[i].count, limit, false);
      const SbSummary *summary = sb_run_summary(cut.run);
      g_assert_cmpint(cut.status, ==, SB_ERROR_NOT_CONVERGED);
      g_assert_false(summary->converged);
      g_assert_cmpuint(summary->work, <=, (size_t)limit);
      g_assert_cmpstr(sb_input_key(cut.report.input), ==, "output.work_limit");
      g_assert_nonnull(strstr(cut.report.text, "work limit"));
      g_assert_nonnull(strstr(cut.report.text, "larger output.tolerance"));
      g_assert_null(strstr(cut.report.text, "nan"));
      if (limit == 1) {
        g_assert_nonnull(strstr(cut.report.text, cases[i].solver));
        g_assert_true(strstr(cut.report.text, " mm") || strstr(cut.report.text, " MPa"));
        g_assert_nonnull(strstr(cut.report.text, "stage"));
        g_assert_nonnull(strstr(cut.report.text, "available: "));
      }
      for (int figure = 0; figure < SB_FIGURE_COUNT; figure++) {
        const char *reason = sb_figure_reason(summary, figure);
        g_assert_true(reason == NULL || reason[0] != '\0');
      }
      sb_run_destroy(cut.run);
    }
  }
}

// Films whose speed is the stem's own are solved before and after the motion that finds it. Where
// that motion uses up the budget, the report names it and not the films.
static void own_speed(void) {
  static const SbOverride over[] = {{SB_P_MODELS_FILM, SB_FILM_REYNOLDS},
                                    {SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC},
                                    {SB_P_DRIVE_KIND, SB_MODEL_DRIVE_RAMP}};
  Outcome films = execute(over, 1, 1000000, false);
  const int limit = (int)sb_run_summary(films.run)->work + 1;
  Outcome cut = execute(over, 3, limit, false);
  g_assert_cmpint(cut.status, ==, SB_ERROR_NOT_CONVERGED);
  g_assert_cmpstr(sb_input_key(cut.report.input), ==, "output.work_limit");
  g_assert_true(g_str_has_prefix(cut.report.text, "motion (for the speed of the films)"));
  g_assert_null(strstr(cut.report.text, "film (reynolds)"));
  sb_run_destroy(films.run);
  sb_run_destroy(cut.run);
}

// Rings of both seals on threads of their own end as they do one after the other; both are at work
// at this limit. That whole runs count equal work is a test of run-ring.
static void threads(void) {
  Outcome one = execute(RINGS, 2, 60, true);
  Outcome both = execute(RINGS, 2, 60, false);
  g_assert_cmpint(one.status, ==, SB_ERROR_NOT_CONVERGED);
  g_assert_cmpint(one.status, ==, both.status);
  g_assert_cmpstr(one.report.text, ==, both.report.text);
  g_assert_cmpuint(sb_run_summary(one.run)->work, ==, sb_run_summary(both.run)->work);
  sb_run_destroy(one.run);
  sb_run_destroy(both.run);
}

// The rig's samples up to the limit stand.
static void rig(void) {
  Outcome cut = execute(RIG, 1, 1, false);
  size_t count;
  (void)sb_run_frames(cut.run, &count);
  g_assert_cmpint(cut.status, ==, SB_ERROR_NOT_CONVERGED);
  g_assert_cmpuint(count, >, 1);
  g_assert_cmpuint(sb_run_summary(cut.run)->work, ==, 1);
  g_assert_nonnull(strstr(cut.report.text, "motion (rig), stage"));
  g_assert_nonnull(strstr(cut.report.text, " s: "));
  sb_run_destroy(cut.run);
}

// A run after one that was cut is not cut: the budget is one execution's.
static void renewed(void) {
  SbPlan plan;
  Outcome cut = execute(FILMS, 1, 10, false);
  SbModel *model = model_of(FILMS, 1, 100000);
  sb_plan_make(&plan, model);
  g_assert_cmpint(sb_run_renew(cut.run, model, &plan, NULL), ==, SB_OK);
  g_assert_cmpint(sb_run_execute(cut.run, NULL, NULL), ==, SB_OK);
  sb_run_destroy(cut.run);
  sb_model_destroy(model);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/run-work/ends", ends);
  g_test_add_func("/run-work/own-speed", own_speed);
  g_test_add_func("/run-work/threads", threads);
  g_test_add_func("/run-work/rig", rig);
  g_test_add_func("/run-work/renewed", renewed);
  return g_test_run();
}
