// The sliding-plate rig as a run: its frames are the samples, and its coefficients those of the
// signal that they hold, taken here by another way.
#include "engine/valve/model/model.h"
#include "engine/valve/sealbench.h"

#include "tests/engine/near.h"
#include "tests/executed.h"

#include <glib.h>
#include <math.h>

static SbRun *pull(const double changes[][2], int count) {
  SbParams params;
  sb_params_init(&params);
  const double base[][2] = {
      {SB_P_MODELS_MOTION, SB_MODEL_MOTION_RIG}, {SB_P_DRIVE_REST, 60},
      {SB_P_DRIVE_DAMPING_RATIO, 0.025},         {SB_P_FRICTION_STATIC_RATIO, 1},
      {SB_P_FRICTION_DWELL_GAIN, 0.04},          {SB_P_FRICTION_DWELL_TIME, 0.01},
      {SB_P_FRICTION_TANGENTIAL_STIFFNESS, 5e3}};
  for (size_t i = 0; i < G_N_ELEMENTS(base); i++) {
    g_assert_cmpint(sb_params_set(&params, (SbParamId)base[i][0], base[i][1], NULL), ==, SB_OK);
  }
  for (int i = 0; i < count; i++) {
    g_assert_cmpint(sb_params_set(&params, (SbParamId)changes[i][0], changes[i][1], NULL), ==,
                    SB_OK);
  }
  SbModel model;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  return executed_run(&model);
}

static void test_coefficients(void) {
  SbRun *run = pull(NULL, 0);
  const SbSummary *s = sb_run_summary(run);
  size_t n;
  const SbFrame *frame = sb_run_frames(run, &n);
  g_assert_cmpuint(n, ==, 5001);
  g_assert_true(isnan(s->metered_volume) && isnan(s->doses)); // the plate gives no dose
  ASSERT_NEAR(frame[n - 1].time, 5, 1e-12);
  g_assert_cmpfloat(s->energy.closure, <, 1e-9);
  // Peaks by local comparison: higher than every sample within 30 ms on either side.
  const size_t reach = 30;
  double first = 0, sum = 0;
  size_t found = 0;
  for (size_t i = reach; i + reach < n; i++) {
    bool highest = true;
    for (size_t k = i - reach; k <= i + reach; k++) {
      highest = highest && (k == i || frame[k].force < frame[i].force);
    }
    g_assert_cmpint(frame[i].peak, ==, highest ? (found == 0 ? 1 : 2) : 0);
    if (highest && found == 0) {
      first = frame[i].force;
    } else if (highest) {
      sum += frame[i].force;
    }
    found += highest;
  }
  g_assert_cmpuint(s->rig.of.peaks, ==, found - 1);
  ASSERT_NEAR(s->rig.of.static_coefficient, first / 2, 1e-14);
  ASSERT_NEAR(s->rig.of.dynamic_coefficient, sum / (double)(found - 1) / 2, 1e-12);
  // Peaks lie above the mean, and the mean above nothing but the sliding friction's rest.
  g_assert_cmpfloat(s->rig.of.static_coefficient, >, s->rig.of.dynamic_coefficient);
  g_assert_cmpfloat(s->rig.of.dynamic_coefficient, >, s->rig.of.mean_coefficient);
  g_test_message("static %.4f dynamic %.4f mean %.4f, %zu peaks, error %.1e",
                 s->rig.of.static_coefficient, s->rig.of.dynamic_coefficient,
                 s->rig.of.mean_coefficient, s->rig.of.peaks, s->error_force);
  // B is the first slip: both strengths after a minute's rest, 0.4 (1 + 0.04 ln(1 + 60/0.01)).
  ASSERT_NEAR(s->stage[SB_STAGE_B].force, 2 * 0.4 * (1 + 0.04 * log(1 + 60.6 / 0.01)), 2e-3);
  g_assert_false(s->stage[SB_STAGE_C].reached);
  g_assert_true(isnan(s->seal[SB_OUTER].load));
  sb_run_destroy(run);
}

// Sampled ten times as fast the first peak stays within its error estimate. The largest force is
// that of the motion: it does not depend on the rate, and its estimate is none of the sampling.
static void test_sampling(void) {
  const double fast[][2] = {{SB_P_RIG_RATE, 1e5}, {SB_P_RIG_DURATION, 1}};
  const double slow[][2] = {{SB_P_RIG_RATE, 200}, {SB_P_RIG_DURATION, 1}};
  const double usual[][2] = {{SB_P_RIG_DURATION, 1}};
  SbRun *exact = pull(fast, 2);
  double peak = sb_run_summary(exact)->rig.of.first_peak;
  SbRun *coarse[2] = {pull(usual, 1), pull(slow, 2)};
  for (int i = 0; i < 2; i++) {
    const SbSummary *s = sb_run_summary(coarse[i]);
    double error = fabs(s->rig.of.first_peak / peak - 1);
    double estimate = sb_figure_error(s, sb_figure_find("rig.first_peak_N"));
    g_test_message("true %.2e, estimated %.2e", error, estimate);
    g_assert_cmpfloat(error, <=, 3 * estimate);
    double largest = sb_run_summary(exact)->force_peak;
    g_test_message("largest force %.9g, exactly %.9g, estimated %.1e", s->force_peak, largest,
                   s->error_force);
    g_assert_cmpfloat(fabs(s->force_peak / largest - 1), <=, 3 * s->error_force);
    g_assert_cmpfloat(s->error_force, <, 1e-3);
    sb_run_destroy(coarse[i]);
  }
  sb_run_destroy(exact);
}

// A thread that is wound up between two samples by several times the friction: the run converges,
// the largest force is that of the motion, and what the samples alone give has no estimate.
static void test_coarse(void) {
  const double coarse[][2] = {{SB_P_RIG_THREAD_STIFFNESS, 185431},
                              {SB_P_RIG_SPEED, 0.0295},
                              {SB_P_RIG_RATE, 151.55},
                              {SB_P_RIG_DURATION, 0.436}};
  const double fine[][2] = {{SB_P_RIG_THREAD_STIFFNESS, 185431},
                            {SB_P_RIG_SPEED, 0.0295},
                            {SB_P_RIG_RATE, 1e5},
                            {SB_P_RIG_DURATION, 0.436}};
  SbRun *run = pull(coarse, 4), *exact = pull(fine, 4);
  const SbSummary *s = sb_run_summary(run);
  double error = fabs(s->force_peak / sb_run_summary(exact)->force_peak - 1);
  g_test_message("true %.2e, estimated %.2e", error, s->error_force);
  g_assert_cmpfloat(error, <=, 3 * s->error_force);
  g_assert_cmpfloat(s->error_force, <, SB_ERROR_LARGE);
  sb_run_destroy(run);
  sb_run_destroy(exact);
}

// The surface model's coefficient by hand; it falls as 1/sqrt(W).
static void test_contact_model(void) {
  SbRun *light = pull(NULL, 0);
  const double more[][2] = {{SB_P_RIG_LOAD, 8}};
  SbRun *heavy = pull(more, 1);
  const SbRigSummary *a = &sb_run_summary(light)->rig, *b = &sb_run_summary(heavy)->rig;
  ASSERT_NEAR(a->contact_coefficient / b->contact_coefficient, 2, 1e-12);
  double modulus = 2 / ((1 - 0.49 * 0.49) / 2.5e6 + (1 - 0.35 * 0.35) / 2.6e9);
  double length = G_PI * 4.45e-3;
  double width = 2 * sqrt(8 * (0.5 / length) * 0.805e-3 / (G_PI * modulus));
  double share = G_PI * G_PI * 0.1289 * 0.1289 * 0.5;
  ASSERT_NEAR(a->contact_coefficient, 3.5e6 * share * length * width / 0.5, 1e-9);
  // Under the load it names, the model gives the sliding coefficient.
  const double named[][2] = {{SB_P_RIG_LOAD, a->contact_load}};
  SbRun *there = pull(named, 1);
  ASSERT_NEAR(sb_run_summary(there)->rig.contact_coefficient, 0.4, 1e-9);
  sb_run_destroy(light);
  sb_run_destroy(heavy);
  sb_run_destroy(there);
}

// Too strong to break away, and sliding without sticking: said, not invented.
static void test_no_peak(void) {
  const double held[][2] = {{SB_P_RIG_COEFFICIENT, 5}, {SB_P_RIG_DURATION, 1}};
  SbRun *run = pull(held, 2);
  g_assert_false(sb_run_summary(run)->rig.found);
  g_assert_false(sb_run_summary(run)->stage[SB_STAGE_B].reached);
  g_assert_cmpuint(sb_run_summary(run)->warnings.count, ==, 1);
  g_assert_cmpstr(sb_run_summary(run)->warnings.item[0].code, ==, "rig-no-peak");
  sb_run_destroy(run);
}

// Too many samples are refused by name.
static void test_range(void) {
  SbParams params;
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_MOTION, SB_MODEL_MOTION_RIG, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_RIG_RATE, 1e6, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_RIG_DURATION, 1e4, NULL), ==, SB_OK);
  SbModel model;
  SbProblems problems;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, &problems), ==, SB_ERROR_INPUT);
  g_assert_cmpstr(problems.item[0].key, ==, "rig.duration");
  ASSERT_NEAR(problems.item[0].max, 20, 1e-9);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/rig/coefficients", test_coefficients);
  g_test_add_func("/rig/sampling", test_sampling);
  g_test_add_func("/rig/contact-model", test_contact_model);
  g_test_add_func("/rig/coarse", test_coarse);
  g_test_add_func("/rig/no-peak", test_no_peak);
  g_test_add_func("/rig/range", test_range);
  return g_test_run();
}
