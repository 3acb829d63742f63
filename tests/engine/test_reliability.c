// Failure points and weighted samples against probabilities in closed form.
#include "engine/numeric/reliability.h"
#include "engine/numeric/sampling.h"
#include "engine/numeric/statistics.h"

#include "tests/engine/near.h"

#include <stdlib.h>
#include <string.h>

enum { N_MOST = 10 };

typedef struct {
  size_t n;
  double beta, curvature;
  int calls;
} Case;

// beta - sum(u)/sqrt(n): a plane.
static SbStatus plane(double *value, double *gradient, const double *u, void *data) {
  Case *of = data;
  *value = of->beta;
  for (size_t k = 0; k < of->n; k++) {
    gradient[k] = -1 / sqrt((double)of->n);
    *value += gradient[k] * u[k];
  }
  return SB_OK;
}

// beta - u0 - curvature u1^2, scaled: what its size is must not matter.
static SbStatus parabola(double *value, double *gradient, const double *u, void *data) {
  const Case *of = data;
  const double scale = 1e-6;
  *value = scale * (of->beta - u[0] - of->curvature * u[1] * u[1]);
  gradient[0] = -scale;
  gradient[1] = -2 * scale * of->curvature * u[1];
  return SB_OK;
}

// Probability of that, by the trapezoidal rule.
static double under_parabola(double beta, double curvature) {
  double sum = 0;
  const double h = 1e-3;
  for (double y = -9; y < 9; y += h) {
    sum += h * exp(-y * y / 2) / sqrt(2 * M_PI) * sb_normal_share(curvature * y * y - beta);
  }
  return sum;
}

// A uniform variate that reaches 1 at most, against more or less than that.
static SbStatus bounded(double *value, double *gradient, const double *u, void *data) {
  const Case *of = data;
  const SbDistribution uniform = {.kind = SB_DISTRIBUTION_UNIFORM, .a = 0, .b = 1};
  *value = of->beta - sb_distribution_at_normal(&uniform, u[0]);
  gradient[0] = -sb_distribution_slope(&uniform, u[0]);
  gradient[1] = 0;
  return SB_OK;
}

static SbStatus flat(double *value, double *gradient, const double *u, void *data) {
  *value = 1;
  gradient[0] = gradient[1] = 0;
  return SB_OK;
}

static SbStatus kinked(double *value, double *gradient, const double *u, void *data) {
  *value = 3 - fabs(u[0]) - u[1];
  gradient[0] = u[0] == 0 ? (double)NAN : u[0] < 0 ? 1 : -1;
  gradient[1] = -1;
  return SB_OK;
}

static SbStatus refused(double *value, double *gradient, const double *u, void *data) {
  return ++((Case *)data)->calls > 1 ? SB_ERROR_CANCELLED : plane(value, gradient, u, data);
}

static SbFailurePoint search(double *u, SbLimitState state, Case *of) {
  SbFailurePoint out;
  g_assert_cmpint(sb_failure_point(&out, u, of->n, state, of, 1e-6, NULL), ==, SB_OK);
  return out;
}

static void test_search(void) {
  double u[N_MOST];
  Case of = {.n = N_MOST, .beta = 4.7534};
  SbFailurePoint point = search(u, plane, &of);
  g_assert_cmpint(point.end, ==, SB_SEARCH_FOUND);
  assert_close(point.beta, of.beta, 1e-12);
  assert_close(u[3], of.beta / sqrt(N_MOST), 1e-12);
  g_assert_cmpuint(point.evaluations, <=, 3);
  of.beta = -2; // the median fails
  point = search(u, plane, &of);
  assert_close(point.beta, -2.0, 1e-12);
  of = (Case){.n = 2, .beta = 3, .curvature = -0.4};
  point = search(u, parabola, &of);
  g_assert_cmpint(point.end, ==, SB_SEARCH_FOUND);
  assert_close(point.beta, 3.0, 1e-6);
  of.beta = 0.9999;
  point = search(u, bounded, &of);
  g_assert_cmpint(point.end, ==, SB_SEARCH_FOUND);
  assert_close(point.beta, sb_normal_quantile(0.9999), 1e-5);
  of.beta = 1.0001;
  g_assert_cmpint(search(u, bounded, &of).end, ==, SB_SEARCH_FAR);
  g_assert_cmpint(search(u, flat, &of).end, ==, SB_SEARCH_FLAT);
  g_assert_cmpint(search(u, kinked, &of).end, ==, SB_SEARCH_KINK);
  of = (Case){.n = 2, .beta = NAN};
  g_assert_cmpint(search(u, plane, &of).end, ==, SB_SEARCH_NO_VALUE);
  of = (Case){.n = 2, .beta = 3};
  g_assert_cmpint(sb_failure_point(&point, u, 2, refused, &of, 1e-6, NULL), ==, SB_ERROR_CANCELLED);
  g_assert_cmpint(sb_failure_point(&point, u, 0, flat, &of, 1e-6, NULL), ==, SB_ERROR_RANGE);
}

enum { SAMPLES = 2000 };

static SbWeightedShare draw(SbLimitState state, Case *of, const double *centre, size_t centres,
                            uint64_t seed) {
  static double u[SAMPLES * N_MOST], weight[SAMPLES];
  static uint8_t trial[SAMPLES];
  double gradient[N_MOST], value;
  sb_sample_importance(u, SAMPLES, of->n, centre, centres, seed);
  for (size_t i = 0; i < SAMPLES; i++) {
    weight[i] = sb_importance_weight(u + i * of->n, of->n, centre, centres);
    g_assert_cmpint(state(&value, gradient, u + i * of->n, of), ==, SB_OK);
    trial[i] = value < 0 ? SB_TRIAL_FAILS : SB_TRIAL_HOLDS;
  }
  SbWeightedShare share;
  sb_weighted_share(&share, centres > 0 ? weight : NULL, trial, SAMPLES);
  return share;
}

// Of a hundred intervals 95 hold the truth, give or take three deviations, and they are narrow.
static void assert_covered(SbLimitState state, Case *of, const double *centre, size_t centres,
                           double truth, double widest) {
  int inside = 0;
  for (uint64_t seed = 1; seed <= 100; seed++) {
    const SbWeightedShare share = draw(state, of, centre, centres, seed);
    inside += share.interval[0] <= truth && truth <= share.interval[1];
    g_assert_cmpfloat(share.interval[1] / share.interval[0], <, widest);
  }
  g_assert_cmpint(inside, >=, 88);
}

static SbStatus both_sides(double *value, double *gradient, const double *u, void *data) {
  *value = ((Case *)data)->beta - fabs(u[0]);
  return SB_OK;
}

static void test_importance(void) {
  double u[2 * N_MOST];
  Case of = {.n = N_MOST, .beta = -sb_normal_quantile(1e-6)};
  g_assert_cmpint(search(u, plane, &of).end, ==, SB_SEARCH_FOUND);
  assert_covered(plane, &of, u, 1, 1e-6, 1.5);
  // FORM alone is too little here.
  of = (Case){.n = 2, .beta = 4, .curvature = 0.05};
  g_assert_cmpint(search(u, parabola, &of).end, ==, SB_SEARCH_FOUND);
  const double truth = under_parabola(of.beta, of.curvature);
  g_assert_cmpfloat(truth, >, 1.2 * sb_normal_share(-4));
  assert_covered(parabola, &of, u, 1, truth, 3);
  // Two failures, each with its point.
  of = (Case){.n = 1, .beta = 4.5};
  const double points[] = {4.5, -4.5};
  assert_covered(both_sides, &of, points, 2, 2 * sb_normal_share(-4.5), 1.5);
}

// At 1e-2 the same as plain sampling, whose interval is Clopper and Pearson's.
static void test_plain(void) {
  double u[2];
  Case of = {.n = 2, .beta = 2.4, .curvature = 0.1};
  const double truth = under_parabola(of.beta, of.curvature);
  g_assert_cmpint(search(u, parabola, &of).end, ==, SB_SEARCH_FOUND);
  const SbWeightedShare about = draw(parabola, &of, u, 1, 3),
                        plain = draw(parabola, &of, NULL, 0, 3);
  double interval[2];
  sb_probability_interval(interval, plain.failed, SAMPLES);
  g_assert_cmpfloat(plain.interval[0], ==, interval[0]);
  g_assert_cmpfloat(plain.interval[1], ==, interval[1]);
  g_assert_cmpfloat(fabs(about.probability - truth), <, interval[1] - interval[0]);
  g_assert_cmpfloat(about.interval[1] - about.interval[0], <, (interval[1] - interval[0]) / 2);
  g_assert_true(plain.interval[0] < truth && truth < plain.interval[1]);
}

// None failed, and none known: no 0 without an interval, no number from nothing.
static void test_none(void) {
  Case of = {.n = 2, .beta = 40};
  const double centre[] = {3, 3};
  const SbWeightedShare share = draw(plane, &of, centre, 1, 1);
  g_assert_cmpfloat(share.probability, ==, 0);
  g_assert_cmpfloat(share.interval[1], >, 3.0 / SAMPLES);
  uint8_t trial[] = {SB_TRIAL_UNKNOWN, SB_TRIAL_FAILS, SB_TRIAL_HOLDS, SB_TRIAL_HOLDS,
                     SB_TRIAL_LEFT_OUT};
  SbWeightedShare some;
  double interval[2];
  sb_weighted_share(&some, NULL, trial, 5);
  sb_probability_interval(interval, 1, 3);
  assert_close(some.probability, 1 / 3.0, 1e-12);
  assert_close(some.interval[0], interval[0], 1e-12);
  assert_close(some.interval[1], fmin(interval[1] + 0.25, 1), 1e-12);
  const double weight[] = {1, 2, 0.5, 0.5, 1};
  sb_weighted_share(&some, weight, trial, 5);
  assert_close(some.probability, 2 / 3.0, 1e-12);
  memset(trial, SB_TRIAL_UNKNOWN, sizeof trial);
  sb_weighted_share(&some, NULL, trial, 5);
  g_assert_true(isnan(some.probability));
}

// Slopes against differences, and values far out against series of the tails.
static void test_distributions(void) {
  const SbDistribution of[] = {
      {.kind = SB_DISTRIBUTION_UNIFORM, .a = 2, .b = 6},
      {.kind = SB_DISTRIBUTION_LOGUNIFORM, .a = 1e-3, .b = 1e3},
      {.kind = SB_DISTRIBUTION_NORMAL, .a = 5, .b = 2, .low = -INFINITY, .high = INFINITY},
      {.kind = SB_DISTRIBUTION_NORMAL, .a = 5, .b = 2, .low = 4, .high = 11},
      {.kind = SB_DISTRIBUTION_NORMAL, .a = 5, .b = 2, .low = 7, .high = INFINITY}};
  for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
    for (double z = -4; z <= 4; z += 0.5) {
      const double h = 1e-4;
      const double difference =
          (sb_distribution_at_normal(&of[i], z + h) - sb_distribution_at_normal(&of[i], z - h)) /
          (2 * h);
      assert_close(sb_distribution_slope(&of[i], z), difference, 1e-5);
    }
  }
  assert_close(6 - sb_distribution_at_normal(&of[0], 7), 4 * sb_normal_share(-7), 1e-3);
  assert_close(sb_distribution_at_normal(&of[0], -7) - 2, 4 * sb_normal_share(-7), 1e-3);
  g_assert_cmpfloat(sb_distribution_at_normal(&of[3], 7.9), <=, 11);
  // Of what lies beyond 7 the share P(-7) of the upper end: beyond one deviation P(-1) of it.
  assert_close(sb_normal_share((5 - sb_distribution_at_normal(&of[4], 5)) / 2),
               sb_normal_share(-1) * sb_normal_share(-5), 1e-9);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/reliability/search", test_search);
  g_test_add_func("/reliability/importance", test_importance);
  g_test_add_func("/reliability/plain", test_plain);
  g_test_add_func("/reliability/none", test_none);
  g_test_add_func("/reliability/distributions", test_distributions);
  return g_test_run();
}
