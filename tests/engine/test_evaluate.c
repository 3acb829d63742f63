// Evaluate: the figures of a run to the bit, whatever is asked for with them or was asked before;
// no more computed than wanted; refused overrides; two threads.
#include "engine/contact/fit.h"
#include "engine/valve/answer/evaluate.h"
#include "engine/valve/model/model.h"
#include "engine/valve/sealbench.h"

#include <glib.h>
#include <math.h>
#include <string.h>

enum { CHANGES = 7 };

typedef struct {
  const char *name;
  SbOverride change[CHANGES]; // to the defaults; a choice by its index
  size_t count;
  SbStatus status;
} Case;

static const Case cases[] = {
    {"closed forms", {{0}}, 0, SB_OK},
    {"solved film and disc",
     {{SB_P_MODELS_FIT, SB_FIT_DISC}, {SB_P_MODELS_FILM, SB_FILM_REYNOLDS}},
     2,
     SB_OK},
    {"film with asperities",
     {{SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED}, {SB_P_CANISTER_PRESSURE_MAP, 1}},
     2,
     SB_OK},
    {"a finger, which finds its own speed",
     {{SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC}, {SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND}},
     2,
     SB_OK},
    {"a life",
     {{SB_P_LIFE_ACTUATIONS, 3}, {SB_P_LIFE_SHOWN, 2}, {SB_P_LIFE_ROUGHNESS_NEW, 1.5}},
     3,
     SB_OK},
    {"no contact", {{SB_P_GLAND_RADIAL_SPACE, 1.7e-3}, {SB_P_MODELS_FIT, SB_FIT_DISC}}, 2, SB_OK},
    {"the sliding plate",
     {{SB_P_MODELS_MOTION, SB_MODEL_MOTION_RIG}, {SB_P_RIG_DURATION, 0.2}},
     2,
     SB_OK},
};

static const Case history = {"a film followed in time",
                             {{SB_P_MODELS_FILM, SB_FILM_REYNOLDS}, {SB_P_MODELS_FILM_TIME, 1}},
                             2,
                             SB_OK};

static SbModel base_model(void) {
  SbParams params;
  SbModel model;
  sb_params_init(&params);
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  return model;
}

static SbModel case_model(const Case *of) {
  SbModel model = base_model();
  g_assert_cmpint(sb_model_override(&model, &model, of->change, of->count, NULL), ==, SB_OK);
  return model;
}

static SbEvaluator *evaluator_new(void) {
  SbEvaluator *evaluator;
  g_assert_cmpint(sb_evaluator_create(&evaluator, NULL), ==, SB_OK);
  return evaluator;
}

static bool same_bits(double a, double b) {
  return (isnan(a) && isnan(b)) || memcmp(&a, &b, sizeof a) == 0;
}

static void ask(double *value, SbEvaluator *evaluator, const SbModel *base,
                const SbOverride *change, size_t changes, const int *figure, size_t figures,
                SbStatus wanted) {
  SbReport report;
  SbQuestion question = {.base = base,
                         .override = change,
                         .override_count = changes,
                         .figure = figure,
                         .figure_count = figures};
  SbStatus status = sb_evaluator_ask(value, evaluator, &question, &report);
  if (status != wanted) {
    g_error("%s: %s", sb_status_text(status), report.text);
  }
}

// Every figure, with all others and by what it needs alone, is the run's.
static void check_case(const Case *of) {
  SbModel base = base_model(), model = case_model(of);
  model.views |= SB_VIEW_SHELF; // else a run leaves out its figures
  SbPlan plan;
  SbRun *run;
  sb_plan_make(&plan, &model);
  g_assert_cmpint(sb_run_create(&run, &model, &plan, NULL), ==, SB_OK);
  g_assert_cmpint(sb_run_execute(run, NULL, NULL), ==, of->status);
  const SbSummary *summary = sb_run_summary(run);
  SbEvaluator *evaluator = evaluator_new();
  int all[SB_FIGURE_COUNT];
  double value[SB_FIGURE_COUNT];
  size_t numbers = 0;
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    all[i] = i;
  }
  // Once from nothing, once from what the last question left.
  for (int round = 0; round < 2; round++) {
    ask(value, evaluator, &base, of->change, of->count, all, SB_FIGURE_COUNT, of->status);
    for (int i = 0; i < SB_FIGURE_COUNT; i++) {
      double wanted = sb_figure_value(summary, i);
      numbers += isfinite(wanted);
      if (!same_bits(value[i], wanted)) {
        g_error("%s, round %d: %s is %.17g, not %.17g", of->name, round, sb_figure(i)->path,
                value[i], wanted);
      }
      g_assert_cmpstr(sb_evaluator_reason(evaluator, i), ==, sb_figure_reason(summary, i));
    }
  }
  g_assert_cmpuint(numbers, >=, 6);
  bool whole = false; // asked for one figure of the whole cycle: the others take the same way
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    double own;
    SbPlan least;
    sb_plan_figures(&least, &model, &i, 1, NULL);
    if (least.motion && whole) {
      continue;
    }
    whole = whole || least.motion;
    ask(&own, evaluator, &base, of->change, of->count, &i, 1, of->status);
    if (!same_bits(own, value[i])) {
      g_error("%s: %s alone is %.17g, not %.17g", of->name, sb_figure(i)->path, own, value[i]);
    }
    g_assert_true((sb_evaluator_reason(evaluator, i) != NULL) == isnan(own));
  }
  sb_evaluator_destroy(evaluator);
  sb_run_destroy(run);
}

// As a run of the base the shelf's figures are left out with a reason where no view asks for them,
// and nothing else is.
static void test_as_run(void) {
  const char *const paths[] = {"shelf.loss_kg_per_year", "cycle.force_peak_N"};
  int figure[2];
  double value[2][2];
  SbModel base = base_model();
  SbEvaluator *evaluator = evaluator_new();
  for (int i = 0; i < 2; i++) {
    figure[i] = sb_figure_find(paths[i]);
    g_assert_cmpint(figure[i], >=, 0);
  }
  for (int view = 0; view < 2; view++) {
    base.views |= view == 1 ? SB_VIEW_SHELF : 0;
    const SbQuestion question = {
        .base = &base, .figure = figure, .figure_count = 2, .as_run = true};
    SbPlan plan;
    sb_plan_figures(&plan, &base, figure, 2, &base);
    g_assert_cmpint(plan.shelf, ==, view == 0 ? SB_SHELF_NOTHING : SB_SHELF_RATES);
    g_assert_cmpint(sb_evaluator_ask(value[view], evaluator, &question, NULL), ==, SB_OK);
    const char *why = sb_evaluator_reason(evaluator, figure[0]);
    g_assert_nonnull(why);
    g_assert_true((strstr(why, "not requested: output.views has no shelf") != NULL) == (view == 0));
  }
  g_assert_true(same_bits(value[0][1], value[1][1]));
  sb_evaluator_destroy(evaluator);
}

static void test_bits(void) {
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_test_message("%s", cases[i].name);
    check_case(&cases[i]);
  }
}

static void test_history(void) {
  check_case(&history);
}

// The ring's own film: each seal's figures, the cycle's only once.
static void test_ring(void) {
  const SbOverride change[] = {
      {SB_P_MODELS_FIT, SB_FIT_RING},     {SB_P_MODELS_FILM, SB_FILM_REYNOLDS},
      {SB_P_MODELS_SURFACE, 1},           {SB_P_OUTPUT_TOLERANCE, 1e-2},
      {SB_P_GLAND_FLOOR_FRICTION, 0.3},   {SB_P_GLAND_WALL_FRICTION, 0.1},
      {SB_P_FRICTION_SHEAR_STRENGTH, 8e4}}; // all of Persson's area: slides
  const size_t changes = G_N_ELEMENTS(change);
  Case of = {.name = "ring", .count = changes, .status = SB_OK};
  memcpy(of.change, change, sizeof change);
  static const char *const paths[] = {"seals.inner.load_N", "seals.inner.film_central_m",
                                      "seals.outer.friction_boundary_N",
                                      "seals.outer.leakage_static_m3_per_s"};
  SbModel base = base_model(), model = case_model(&of);
  SbPlan plan;
  SbRun *run;
  sb_plan_make(&plan, &model);
  g_assert_cmpint(sb_run_create(&run, &model, &plan, NULL), ==, SB_OK);
  g_assert_cmpint(sb_run_execute(run, NULL, NULL), ==, SB_OK);
  SbEvaluator *evaluator = evaluator_new();
  for (size_t i = 0; i < G_N_ELEMENTS(paths); i++) {
    int figure = sb_figure_find(paths[i]);
    double value;
    ask(&value, evaluator, &base, change, changes, &figure, 1, SB_OK);
    g_test_message("%s: %.17g, %.17g in the run", paths[i], value,
                   sb_figure_value(sb_run_summary(run), figure));
    g_assert_true(same_bits(value, sb_figure_value(sb_run_summary(run), figure)));
    g_assert_true(isfinite(value));
  }
  sb_evaluator_destroy(evaluator);
  sb_run_destroy(run);
}

// Rings started from a base's: the same to the bit whoever asks and whatever was asked before, in
// three fifths of the iterations of cold ones, most of which are on coarser meshes, and within the
// errors told of what those are.
static void test_start(void) {
  const SbOverride change[] = {{SB_P_MODELS_FIT, SB_FIT_RING},
                               {SB_P_GLAND_FLOOR_FRICTION, 0.3},
                               {SB_P_GLAND_WALL_FRICTION, 0.1},
                               {SB_P_FRICTION_SHEAR_STRENGTH, 2e6}};
  enum { CHANGED = G_N_ELEMENTS(change) };
  static const SbOverride beside[] = {{SB_P_CANISTER_PRESSURE, 0.56e6},
                                      {SB_P_GLAND_RADIAL_SPACE, 1.358e-3},
                                      {SB_P_SEAL_MODULUS, 2.52e6},
                                      {SB_P_SURFACE_GT_PRODUCT, 0.142}};
  const int figure[] = {sb_figure_find("seals.outer.load_N"), sb_figure_find("seals.inner.load_N")};
  SbModel base = base_model(), model;
  g_assert_cmpint(sb_model_override(&model, &base, change, CHANGED, NULL), ==, SB_OK);
  SbEvaluator *start = evaluator_new(), *evaluator = evaluator_new(), *other = evaluator_new();
  double value[2], warm[2], again[2];
  SbQuestion question = {.base = &model, .figure = figure, .figure_count = 2, .keep = true};
  g_assert_cmpint(sb_evaluator_ask(value, start, &question, NULL), ==, SB_OK);
  question.keep = false;
  for (size_t i = 0; i < G_N_ELEMENTS(beside); i++) {
    question.override = &beside[i];
    question.override_count = 1;
    question.start = start;
    g_assert_cmpint(sb_evaluator_ask(warm, evaluator, &question, NULL), ==, SB_OK);
    const size_t few = sb_evaluator_summary(evaluator)->counters.newton_iterations;
    // Friction is foreseen as closed forms change it: each ring is solved once.
    g_assert_cmpuint(sb_evaluator_summary(evaluator)->counters.ring_solves, ==, 2);
    question.start = NULL;
    g_assert_cmpint(sb_evaluator_ask(value, other, &question, NULL), ==, SB_OK);
    const SbSummary *cold = sb_evaluator_summary(other);
    g_assert_cmpuint(5 * few, <=, 3 * cold->counters.newton_iterations);
    for (int k = 0; k < 2; k++) {
      g_test_message("%s: %.6g N from the base's, %.6g N from the free ring",
                     sb_figure(figure[k])->path, warm[k], value[k]);
      g_assert_cmpfloat(fabs(warm[k] / value[k] - 1), <=, cold->error_load);
    }
    question.start = start;
    g_assert_cmpint(sb_evaluator_ask(again, other, &question, NULL), ==, SB_OK);
    g_assert_true(same_bits(again[0], warm[0]) && same_bits(again[1], warm[1]));
  }
  sb_evaluator_destroy(other);
  sb_evaluator_destroy(evaluator);
  sb_evaluator_destroy(start);
}

// Whether a parameter enters the contacts of the base model: some of each stage do.
static bool enters(const char *key) {
  static const char *const keys[] = {
      "gland.radial_space", "seal.section_diameter",   "seal.inner_diameter",   "seal.modulus",
      "canister.pressure",  "housing.modulus",         "fluid.viscosity",       "drive.speed",
      "surface.sigma",      "friction.shear_strength", "friction.static_ratio", "output.tolerance"};
  for (size_t i = 0; i < G_N_ELEMENTS(keys); i++) {
    if (g_str_equal(keys[i], key)) {
      return true;
    }
  }
  return false;
}

// Contacts that a parameter does not enter stand from the question before: whatever is moved, the
// answer is that of an evaluator that was asked nothing else.
static void test_stands(void) {
  const SbOverride change[] = {{SB_P_SURFACE_SIGMA, 0.9e-6},
                               {SB_P_RUBBER_RELAXATION_SHARE_1, 0.2},
                               {SB_P_STORAGE_TIME, 3e6},
                               {SB_P_RUBBER_SWELL_MASS, 0.1}};
  enum { CHANGED = G_N_ELEMENTS(change) };
  SbModel base = base_model();
  SbOverride all[CHANGED + 1];
  int figure[SB_FIGURE_COUNT];
  size_t stood = 0, entered = 0;
  memcpy(all, change, sizeof change);
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    figure[i] = i;
  }
  SbEvaluator *evaluator = evaluator_new(), *other = evaluator_new();
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    const SbParam *param = sb_param((SbParamId)id);
    double value[SB_FIGURE_COUNT], alone[SB_FIGURE_COUNT];
    const double is = sb_model_value(&base, (SbParamId)id);
    all[CHANGED] = (SbOverride){(SbParamId)id, is != 0 ? 1.001 * is : 1e-4 * param->max};
    const SbQuestion first = {.base = &base,
                              .override = change,
                              .override_count = CHANGED,
                              .figure = figure,
                              .figure_count = SB_FIGURE_COUNT};
    const SbQuestion question = {.base = &base,
                                 .override = all,
                                 .override_count = CHANGED + 1,
                                 .figure = figure,
                                 .figure_count = SB_FIGURE_COUNT};
    sb_evaluator_forget(other);
    if (param->kind != SB_PARAM_REAL || sb_evaluator_ask(alone, other, &question, NULL) != SB_OK) {
      continue;
    }
    g_assert_cmpint(sb_evaluator_ask(value, evaluator, &first, NULL), ==, SB_OK);
    const bool stands = sb_evaluator_has_solved(evaluator, &question);
    stood += stands;
    entered += enters(param->key);
    // One of a later stage leaves the contacts; those of earlier stages do not, unless the model
    // has switched them off.
    if (param->stage > SB_ENTERS_FRICTION ? !stands : stands && enters(param->key)) {
      g_error("%s: the contacts %s", param->key, stands ? "stand" : "are solved again");
    }
    g_assert_cmpint(sb_evaluator_ask(value, evaluator, &question, NULL), ==, SB_OK);
    for (int i = 0; i < SB_FIGURE_COUNT; i++) {
      if (!same_bits(value[i], alone[i])) {
        g_error("%s by %s: %.17g, %.17g alone", sb_figure(i)->path, param->key, value[i], alone[i]);
      }
    }
  }
  g_test_message("the contacts stand for %zu parameters", stood);
  g_assert_cmpuint(stood, >, 80);
  g_assert_cmpuint(entered, ==, 12); // each key of enters() was asked
  sb_evaluator_destroy(other);
  sb_evaluator_destroy(evaluator);
}

// Sizes need no solve, a load one fitment, a film one film; the cycle all of them.
static void test_least(void) {
  const SbOverride change[] = {{SB_P_MODELS_FIT, SB_FIT_DISC},
                               {SB_P_MODELS_FILM, SB_FILM_REYNOLDS}};
  static const struct {
    const char *path;
    size_t fits, films;
  } needs[] = {{"seals.outer.squeeze", 0, 0},
               {"dose.metered_volume_m3", 0, 0},
               {"seals.outer.load_N", 1, 0},
               {"seals.inner.pressure_peak_Pa", 1, 0},
               {"seals.outer.film_central_m", 1, 2}, // on the half-plane and on the disc
               {"seals.outer.leakage_per_stroke_m3", 1, 2}};
  SbModel base = base_model();
  SbEvaluator *evaluator = evaluator_new();
  for (size_t i = 0; i < G_N_ELEMENTS(needs); i++) {
    int figure = sb_figure_find(needs[i].path);
    double value;
    ask(&value, evaluator, &base, change, 2, &figure, 1, SB_OK);
    const SbCounters *counters = &sb_evaluator_summary(evaluator)->counters;
    g_assert_true(isfinite(value));
    g_assert_cmpuint(counters->fit_solves, ==, needs[i].fits);
    g_assert_cmpuint(counters->reynolds_solves, ==, needs[i].films);
  }
  int force = sb_figure_find("cycle.force_peak_N");
  double value;
  ask(&value, evaluator, &base, change, 2, &force, 1, SB_OK);
  // Two of each of four states; more for what frames at other speeds leave in the error.
  g_assert_cmpuint(sb_evaluator_summary(evaluator)->counters.reynolds_solves, ==, 8);
  int error = sb_figure_find("solver.error_estimate.film");
  ask(&value, evaluator, &base, change, 2, &error, 1, SB_OK);
  g_assert_cmpuint(sb_evaluator_summary(evaluator)->counters.reynolds_solves, >, 10);
  // By the other laws only where they are asked for.
  int law = sb_figure_find("seals.outer.film_by_model.thesis");
  ask(&value, evaluator, &base, change, 2, &law, 1, SB_OK);
  g_assert_true(isfinite(value));
  sb_evaluator_destroy(evaluator);
}

// A refused override names key and range; the evaluator goes on.
static void test_refused(void) {
  static const struct {
    SbOverride change;
    SbStatus status;
    const char *key, *says;
  } bad[] = {
      {{SB_P_GLAND_RADIAL_SPACE, 1}, SB_ERROR_RANGE, "gland.radial_space", "0.0001 to 0.02 (m)"},
      {{SB_P_SEAL_MODULUS, NAN}, SB_ERROR_INPUT, "seal.modulus", "seal.modulus: not a finite"},
      {{SB_P_OUTPUT_FRAMES, 10.5}, SB_ERROR_INPUT, "output.frames", "whole number"},
      {{SB_P_STEM_PRESSURE_DIAMETER, 7e-3}, SB_ERROR_INPUT, "bore.diameter", "at least 0.007 m"},
      {{SB_P_DRIVE_CYCLES, 2}, SB_ERROR_INPUT, "drive.cycles", "needs models.motion"},
      {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_MEASURED}, SB_ERROR_INPUT, "drive.kind", "series"},
  };
  SbModel base = base_model();
  SbEvaluator *evaluator = evaluator_new();
  const int figure[] = {sb_figure_find("seals.outer.squeeze"),
                        sb_figure_find("seals.outer.load_N")};
  double value[2];
  for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
    SbReport report;
    SbQuestion question = {.base = &base,
                           .override = &bad[i].change,
                           .override_count = 1,
                           .figure = figure,
                           .figure_count = 2};
    g_assert_cmpint(sb_evaluator_ask(value, evaluator, &question, &report), ==, bad[i].status);
    g_assert_cmpint(report.status, ==, bad[i].status);
    g_assert_cmpstr(sb_input_key(report.input), ==, bad[i].key);
    g_assert_nonnull(strstr(report.text, bad[i].key));
    g_assert_nonnull(strstr(report.text, bad[i].says));
    g_assert_true(isnan(value[0]) && isnan(value[1]));
    g_assert_cmpstr(sb_evaluator_reason(evaluator, figure[0]), ==, report.text);
    g_assert_null(sb_evaluator_model(evaluator));
  }
  // The last override of a parameter counts; what somebody wrote into the base is not asked.
  base.radial_space = 1;
  const SbOverride twice[] = {{SB_P_GLAND_RADIAL_SPACE, 1.3e-3}, {SB_P_GLAND_RADIAL_SPACE, 1.4e-3}};
  ask(value, evaluator, &base, twice, 2, figure, 1, SB_OK);
  g_assert_cmpfloat(fabs(value[0] - (1 - 1.4 / 1.61)), <, 1e-12);
  sb_evaluator_destroy(evaluator);
}

static bool after(void *data) {
  int *left = data;
  return --*left < 0;
}

// Ends where it is told to, within a solve too; then answers as ever.
static void test_cancel(void) {
  const SbOverride change[] = {{SB_P_MODELS_FIT, SB_FIT_RING},
                               {SB_P_GLAND_FLOOR_FRICTION, 0.3},
                               {SB_P_GLAND_WALL_FRICTION, 0.1},
                               {SB_P_FRICTION_SHEAR_STRENGTH, 1e6}};
  const size_t changes = G_N_ELEMENTS(change);
  SbModel base = base_model();
  SbEvaluator *evaluator = evaluator_new();
  int figure = sb_figure_find("seals.outer.load_N");
  double value, first;
  ask(&first, evaluator, &base, change, changes, &figure, 1, SB_OK);
  int polls = 0;
  for (int limit = 0; limit < 10; limit += 4) {
    int left = limit;
    sb_evaluator_forget(evaluator); // else what it has solved stands
    SbReport report;
    SbQuestion question = {.base = &base,
                           .override = change,
                           .override_count = changes,
                           .figure = &figure,
                           .figure_count = 1,
                           .cancelled = after,
                           .data = &left};
    SbStatus status = sb_evaluator_ask(&value, evaluator, &question, &report);
    g_assert_cmpint(status, ==, SB_ERROR_CANCELLED);
    g_assert_true(isnan(value));
    g_assert_nonnull(sb_evaluator_reason(evaluator, figure));
    polls = limit;
  }
  g_assert_cmpint(polls, >, 4); // one fitment alone asks more often than that
  ask(&value, evaluator, &base, change, changes, &figure, 1, SB_OK);
  g_assert_true(same_bits(value, first));
  sb_evaluator_destroy(evaluator);
}

enum { THREADS = 2, QUESTIONS = 6 }; // every pair of models once

typedef struct {
  const SbModel *base;
  int offset; // each thread begins elsewhere
  double value[QUESTIONS][2];
} Worker;

static gpointer work(gpointer data) {
  Worker *worker = data;
  SbEvaluator *evaluator = evaluator_new();
  const int figure[] = {sb_figure_find("cycle.force_breakaway_N"),
                        sb_figure_find("seals.inner.film_central_m")};
  for (int i = 0; i < QUESTIONS; i++) {
    int n = (i + worker->offset) % QUESTIONS;
    const SbOverride change[] = {{SB_P_GLAND_RADIAL_SPACE, 1.3e-3 + 16e-6 * n},
                                 {SB_P_MODELS_FIT, n % 3 == 0 ? SB_FIT_DISC : 0},
                                 {SB_P_MODELS_FILM, n % 2 == 0 ? SB_FILM_REYNOLDS : 0}};
    ask(worker->value[n], evaluator, worker->base, change, 3, figure, 2, SB_OK);
  }
  sb_evaluator_destroy(evaluator);
  return NULL;
}

// Two threads on one base, in different orders, say the same.
static void test_threads(void) {
  SbModel base = base_model();
  Worker worker[THREADS];
  GThread *thread[THREADS];
  for (int i = 0; i < THREADS; i++) {
    worker[i] = (Worker){.base = &base, .offset = i * 3};
    thread[i] = g_thread_new("evaluate", work, &worker[i]);
  }
  for (int i = 0; i < THREADS; i++) {
    g_thread_join(thread[i]);
  }
  for (int n = 0; n < QUESTIONS; n++) {
    g_assert_true(isfinite(worker[0].value[n][0]) && isfinite(worker[0].value[n][1]));
    g_assert_cmpmem(worker[0].value[n], sizeof worker[0].value[n], worker[1].value[n],
                    sizeof worker[1].value[n]);
  }
}

// The model that answered is that of its parameters, whatever the plan spares; a valve that is only
// looked at keeps its own, too.
static void test_model(void) {
  static const SbOverride hand[] = {{SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC},
                                    {SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND}};
  SbModel base = base_model();
  SbModel *derived;
  SbEvaluator *evaluator = evaluator_new();
  const int peak = sb_figure_find("cycle.force_peak_N");
  double value;
  ask(&value, evaluator, &base, NULL, 0, &peak, 1, SB_OK);
  g_assert_true(sb_model_same(sb_evaluator_model(evaluator), &base));
  g_assert_cmpint(sb_model_derive(&derived, &base, hand, G_N_ELEMENTS(hand), NULL), ==, SB_OK);
  SbPlan plan;
  SbRun *run;
  size_t count;
  sb_plan_wished(&plan, derived, &(SbPlanWishes){.resting = true});
  g_assert_cmpint(sb_run_create(&run, derived, &plan, NULL), ==, SB_OK);
  g_assert_cmpint(sb_run_execute(run, NULL, NULL), ==, SB_OK);
  g_assert_true(sb_model_same(sb_run_model(run), derived));
  const SbFrame *frame = sb_run_frames(run, &count);
  g_assert_cmpuint(count, <, 20);
  g_assert_cmpfloat(frame[0].displacement, ==, 0);
  sb_run_destroy(run);
  sb_model_destroy(derived);
  sb_evaluator_destroy(evaluator);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/evaluate/as-run", test_as_run);
  g_test_add_func("/evaluate/bits", test_bits);
  g_test_add_func("/evaluate/ring", test_ring);
  g_test_add_func("/evaluate/start", test_start);
  g_test_add_func("/evaluate/stands", test_stands);
  g_test_add_func("/evaluate/least", test_least);
  g_test_add_func("/evaluate/model", test_model);
  g_test_add_func("/evaluate/refused", test_refused);
  g_test_add_func("/evaluate/cancel", test_cancel);
  g_test_add_func("/evaluate/threads", test_threads);
  if (g_test_slow()) {
    g_test_add_func("/evaluate/history", test_history);
  }
  return g_test_run();
}
