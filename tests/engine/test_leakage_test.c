// The simulated leakage test against closed forms of a normal loss: by the second stage alone, by
// the mean alone, by balance noise alone; and its two scales.
#include "engine/numeric/sampling.h"
#include "engine/valve/answer/leakage_test.h"

#include <glib.h>
#include <math.h>

enum { TESTS = 4000, CANS = 36 };

// Cans of a normal loss.
static double *normal_losses(size_t count, double mean, double deviation) {
  double *loss = g_new(double, count);
  for (size_t i = 0; i < count; i++) {
    loss[i] = mean + deviation * sb_normal_quantile(sb_random(7, i, 0));
  }
  return loss;
}

static SbLeakageOdds odds(const SbLeakageTest *test, double mean, double deviation, size_t samples,
                          double fill) {
  SbLeakageOdds out;
  g_autofree double *loss = normal_losses(samples, mean, deviation);
  g_assert_cmpint(sb_leakage_odds(&out, test, loss, samples, fill, TESTS, 3, NULL), ==, SB_OK);
  return out;
}

static void assert_inside(const SbLeakageOdds *value, double exact) {
  g_test_message("%.4f, 95 %% %.4f to %.4f, closed form %.4f, %zu second stages",
                 value->probability, value->interval[0], value->interval[1], exact, value->second);
  g_assert_cmpfloat(exact, >=, value->interval[0]);
  g_assert_cmpfloat(exact, <=, value->interval[1]);
}

// Two stages: q^12 + 12 q^11 p (q^24 + 24 q^23 p), q the share below 750 mg, p that up to 1.1 g.
static double two_stages(double q, double p) {
  return pow(q, 12) + 12 * pow(q, 11) * p * (pow(q, 24) + 24 * pow(q, 23) * p);
}

static void test_stages(void) {
  SbLeakageTest test = SB_LEAKAGE_TEST_INIT;
  const double mean = 400e-6, deviation = 180e-6;
  const double q = sb_normal_share((test.single - mean) / deviation);
  const double p = sb_normal_share((test.most - mean) / deviation) - q;
  test.mean = INFINITY;
  const SbLeakageOdds dealt = odds(&test, mean, deviation, TESTS * CANS, 10e-3);
  g_assert_true(dealt.dealt);
  g_assert_cmpuint(dealt.second, >, TESTS / 20);
  assert_inside(&dealt, two_stages(q, p));
  // Drawn again from few samples: wider, and the closed form is inside.
  const SbLeakageOdds drawn = odds(&test, mean, deviation, 3000, 10e-3);
  g_assert_false(drawn.dealt);
  assert_inside(&drawn, two_stages(q, p));
  g_assert_cmpfloat(drawn.interval[1] - drawn.interval[0], >,
                    dealt.interval[1] - dealt.interval[0]);
}

// By the mean of twelve alone: normal, of deviation s/sqrt 12. Balance noise adds to it.
static void test_mean(void) {
  SbLeakageTest test = SB_LEAKAGE_TEST_INIT;
  test.single = test.most = INFINITY;
  for (int noisy = 0; noisy < 2; noisy++) {
    test.balance = noisy * 0.5e-6;
    const double own = 60e-6, weighing = sqrt(2) * test.balance * 365.0 / 3.0;
    const double deviation = sqrt(own * own + weighing * weighing);
    const SbLeakageOdds value = odds(&test, 515e-6, own, TESTS * CANS, 10e-3);
    assert_inside(&value, sb_normal_share((test.mean - 515e-6) / (deviation / sqrt(12))));
    g_assert_cmpuint(value.second, ==, 0);
  }
}

// From 15 g on shares of the fill count: 3.5 % of 30 g are 1050 mg.
static void test_scales(void) {
  SbLeakageTest test = SB_LEAKAGE_TEST_INIT;
  g_assert_cmpfloat(odds(&test, 600e-6, 1e-9, 100, 10e-3).probability, ==, 0);
  g_assert_cmpfloat(odds(&test, 600e-6, 1e-9, 100, 30e-3).probability, ==, 1);
  g_assert_cmpfloat(odds(&test, 500e-6, 1e-9, 100, 10e-3).probability, ==, 1);
  g_assert_cmpfloat(odds(&test, 1060e-6, 1e-9, 100, 30e-3).probability, ==, 0);
}

// An open can fails any test that it is in.
static void test_open(void) {
  const SbLeakageTest test = SB_LEAKAGE_TEST_INIT;
  double loss[100];
  SbLeakageOdds value;
  for (int i = 0; i < 100; i++) {
    loss[i] = i % 2 == 0 ? INFINITY : 100e-6;
  }
  g_assert_cmpint(sb_leakage_odds(&value, &test, loss, 100, 10e-3, 1000, 1, NULL), ==, SB_OK);
  g_assert_cmpfloat(value.probability, <, 0.52); // parts of one kind of can each
  SbReport report;
  g_assert_cmpint(sb_leakage_odds(&value, &test, loss, 5, 10e-3, 1000, 1, &report), ==,
                  SB_ERROR_RANGE);
  g_assert_cmpint(sb_leakage_odds(&value, &test, loss, 100, 0, 1000, 1, &report), ==,
                  SB_ERROR_RANGE);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/leakage-test/stages", test_stages);
  g_test_add_func("/leakage-test/mean", test_mean);
  g_test_add_func("/leakage-test/scales", test_scales);
  g_test_add_func("/leakage-test/open", test_open);
  return g_test_run();
}
