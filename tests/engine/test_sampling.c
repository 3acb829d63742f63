// Designs and distributions against what they must hold, estimates against closed forms.
#include "engine/numeric/sampling.h"
#include "engine/numeric/statistics.h"

#include "tests/engine/near.h"

#include <math.h>
#include <stdlib.h>

// A sample hangs on its own numbers alone, and numbers of neighbours are independent.
static void test_random(void) {
  enum { N = 100000 };
  double sum = 0, square = 0, product = 0, along = 0;
  for (uint64_t i = 0; i < N; i++) {
    const double u = sb_random(7, i, 0) - 0.5;
    sum += u / N;
    square += u * u / N;
    product += u * (sb_random(7, i, 1) - 0.5) / N;
    along += u * (sb_random(7, i + 1, 0) - 0.5) / N;
  }
  // Five deviations of each mean.
  g_assert_cmpfloat(fabs(sum), <, 5 / sqrt(12.0 * N));
  g_assert_cmpfloat(fabs(square - 1 / 12.0), <, 5 * sqrt(1 / 180.0 / N));
  g_assert_cmpfloat(fabs(product), <, 5 / 12.0 / sqrt(N));
  g_assert_cmpfloat(fabs(along), <, 5 / 12.0 / sqrt(N));
  g_assert_true(sb_random(7, 3, 0) != sb_random(8, 3, 0));
}

static double phi(double z) {
  return exp(-z * z / 2) / sqrt(2 * M_PI);
}

// Quantiles invert the distribution functions; the mean of a cut-off normal one has a closed form.
static void test_distributions(void) {
  const SbDistribution uniform = {.kind = SB_DISTRIBUTION_UNIFORM, .a = 2, .b = 6, .count = 5};
  const SbDistribution decades = {.kind = SB_DISTRIBUTION_LOGUNIFORM, .a = 1e-3, .b = 1e3};
  const double level[] = {1, 10, 100};
  const SbDistribution levels = {.kind = SB_DISTRIBUTION_LEVELS, .level = level, .count = 3};
  assert_close(sb_distribution_quantile(&uniform, 0.25), 3.0, 1e-15);
  assert_close(sb_distribution_grid(&uniform, 3), 5.0, 1e-15);
  assert_close(sb_distribution_quantile(&decades, 0.5), 1.0, 1e-14);
  assert_close(sb_distribution_quantile(&levels, 0.34), 10.0, 0);
  assert_close(sb_distribution_grid(&levels, 2), 100.0, 0);
  static const double cut[][2] = {{-1, 2}, {3, 4}, {-8, -6}, {-INFINITY, 0.5}, {5, INFINITY}};
  for (size_t i = 0; i < sizeof cut / sizeof cut[0]; i++) {
    const double mean = 1.36e-3, deviation = 1e-5, l = cut[i][0], h = cut[i][1];
    const SbDistribution normal = {.kind = SB_DISTRIBUTION_NORMAL,
                                   .a = mean,
                                   .b = deviation,
                                   .low = mean + deviation * l,
                                   .high = mean + deviation * h};
    enum { N = 20000 };
    double sum = 0;
    for (int k = 0; k < N; k++) {
      const double value = sb_distribution_quantile(&normal, (k + 0.5) / N);
      g_assert_true(value >= normal.low && value <= normal.high);
      sum += value / N;
    }
    const double share = l > 0 ? (erfc(l / M_SQRT2) - erfc(h / M_SQRT2)) / 2
                               : (erfc(-h / M_SQRT2) - erfc(-l / M_SQRT2)) / 2;
    const double expected = (phi(l) - phi(h)) / share; // Johnson and Kotz, continuous univariate 13
    assert_close((sum - mean) / deviation, expected, 1e-3);
  }
  const SbDistribution whole = {
      .kind = SB_DISTRIBUTION_NORMAL, .a = 1, .b = 2, .low = -INFINITY, .high = INFINITY};
  assert_close(sb_distribution_at_normal(&whole, -40), -79.0, 0);
}

// Any 2^m first points of a Sobol sequence have one in each of 2^m equal intervals of every
// coordinate, whatever the shift.
static void test_sobol(void) {
  enum { N = 256, D = 9 };
  static double point[N * D];
  g_assert_cmpint(sb_sample_sobol(point, N - 1, D, 5, NULL), ==, SB_OK);
  for (int k = 0; k < D; k++) {
    bool taken[N] = {false};
    for (int i = 0; i < N - 1; i++) { // GSL leaves out the first point, the origin
      const int at = (int)(point[i * D + k] * N);
      g_assert_true(at >= 0 && at < N && !taken[at]);
      taken[at] = true;
    }
  }
  SbReport report = {0};
  g_assert_cmpint(sb_sample_sobol(point, 1, SB_SOBOL_DIMENSIONS + 1, 5, &report), ==,
                  SB_ERROR_RANGE);
  g_assert_cmpstr(report.text, ==, "a Sobol sequence has 1 to 40 parameters, not 41");
}

// Ishigami and Homma's function (1990), whose indices are known.
static void test_ishigami(void) {
  enum { BASE = 4096, D = 3, ROWS = BASE * (D + 2) };
  static double point[ROWS * D], value[ROWS];
  SbIndex first[D], total[D];
  g_assert_cmpint(sb_sample_saltelli(point, BASE, D, 1, NULL), ==, SB_OK);
  for (int i = 0; i < ROWS; i++) {
    double x[D];
    for (int k = 0; k < D; k++) {
      x[k] = M_PI * (2 * point[i * D + k] - 1);
    }
    value[i] = sin(x[0]) + 7 * sin(x[1]) * sin(x[1]) + 0.1 * pow(x[2], 4) * sin(x[0]);
  }
  g_assert_cmpint(sb_sobol_indices(first, total, value, BASE, D, 1, NULL), ==, SB_OK);
  static const double alone[] = {0.313905, 0.442411, 0}, all[] = {0.557589, 0.442411, 0.243684};
  for (int k = 0; k < D; k++) {
    g_assert_cmpfloat(fabs(first[k].value - alone[k]), <, 0.01);
    g_assert_cmpfloat(fabs(total[k].value - all[k]), <, 0.01);
    g_assert_true(first[k].low <= alone[k] && alone[k] <= first[k].high);
    g_assert_true(total[k].low <= all[k] && all[k] <= total[k].high);
    g_assert_cmpfloat(total[k].high - total[k].low, <, 0.1);
  }
  // A constant has no variance to share, not even that of its rounding.
  for (int i = 0; i < ROWS; i++) {
    value[i] = i % 3 == 0 ? 28.698835679546786 : 28.69883567954679;
  }
  g_assert_cmpint(sb_sobol_indices(first, total, value, BASE, D, 1, NULL), ==, SB_OK);
  for (int k = 0; k < D; k++) {
    g_assert_cmpfloat(first[k].value, ==, 0);
    g_assert_cmpfloat(first[k].low, ==, 0);
    g_assert_cmpfloat(total[k].value, ==, 0);
    g_assert_cmpfloat(total[k].high, ==, 0);
  }
  // One part in 1e9 is a variation.
  for (int i = 0; i < ROWS; i++) {
    value[i] = 28.7 * (1 + 1e-9 * point[i * D]);
  }
  g_assert_cmpint(sb_sobol_indices(first, total, value, BASE, D, 1, NULL), ==, SB_OK);
  g_assert_cmpfloat(fabs(total[0].value - 1), <, 0.02);
}

// Every trajectory moves each coordinate once; the effects of a plane are its slopes.
static void test_morris(void) {
  enum { D = 4, TRAJECTORIES = 25, ROWS = TRAJECTORIES * (D + 1) };
  double point[ROWS * D], value[ROWS];
  SbElementaryEffects effect[D];
  sb_sample_morris(point, ROWS, D, 3);
  for (int i = 0; i < ROWS; i++) {
    const double *x = point + i * D;
    value[i] = 1 + 2 * x[0] - 5 * x[1] + x[2] * x[3];
    int moved = 0;
    for (int k = 0; k < D && (i + 1) % (D + 1) != 0; k++) {
      g_assert_true(x[k] > 0 && x[k] < 1);
      moved += x[k + D] != x[k];
    }
    g_assert_cmpint(moved, ==, (i + 1) % (D + 1) != 0);
  }
  sb_morris_effects(effect, value, point, ROWS, D);
  for (int k = 0; k < D; k++) {
    g_assert_cmpint((int)effect[k].count, ==, TRAJECTORIES);
  }
  assert_close(effect[0].mean, 2.0, 1e-12);
  assert_close(effect[1].mean, -5.0, 1e-12);
  assert_close(effect[1].magnitude, 5.0, 1e-12);
  g_assert_cmpfloat(effect[0].deviation, <, 1e-12);
  g_assert_cmpfloat(effect[2].deviation, >, 0.1);
  for (int i = 0; i < ROWS; i++) {
    value[i] = i % 2 == 0 ? 1 : nextafter(1, 2);
  }
  sb_morris_effects(effect, value, point, ROWS, D);
  g_assert_cmpfloat(effect[0].magnitude, ==, 0);
  g_assert_cmpfloat(effect[3].deviation, ==, 0);
}

static void test_summary(void) {
  enum { N = 20001 };
  static double value[N];
  SbSummaryOfSamples of;
  for (int i = 0; i < N; i++) {
    value[(i * 7919) % N] = i; // 0 .. N - 1 in some order
  }
  g_assert_cmpint(sb_samples_summary(&of, value, N, 1, NULL), ==, SB_OK);
  assert_close(of.mean, (N - 1) / 2.0, 1e-14);
  assert_close(of.deviation, sqrt(N * (N + 1.0) / 12), 1e-12);
  for (int q = 0; q < SB_QUANTILES; q++) {
    assert_close(of.quantile[q], sb_quantile_shares[q] * (N - 1), 1e-12);
  }
  g_assert_true(of.varies);
  // Constants: their sum rounds, their mean does not leave them, and they have no deviation.
  static double constant[300];
  for (int i = 0; i < 300; i++) {
    constant[i] = 34.999999999999964;
  }
  for (int bit = 0; bit < 2; bit++) {
    g_assert_cmpint(sb_samples_summary(&of, constant, 300, 1, NULL), ==, SB_OK);
    g_assert_false(of.varies);
    g_assert_cmpfloat(of.deviation, ==, 0);
    g_assert_true(of.min <= of.mean && of.mean <= of.max);
    constant[7] = nextafter(constant[7], 40);
  }
  constant[7] = 35 * (1 + 1e-9);
  g_assert_cmpint(sb_samples_summary(&of, constant, 300, 1, NULL), ==, SB_OK);
  g_assert_true(of.varies && of.deviation > 0);
  value[4] = NAN;
  g_assert_cmpint(sb_samples_summary(&of, value, N, 1, NULL), ==, SB_OK);
  g_assert_cmpint((int)of.count, ==, N - 1);
  g_assert_cmpint(sb_samples_summary(&of, value + 4, 1, 1, NULL), ==, SB_OK);
  g_assert_true(isnan(of.mean) && isnan(of.quantile[2]));
  // The interval's ends have the tails that define it.
  double interval[2];
  sb_probability_interval(interval, 0, 1000);
  assert_close(interval[0], 0.0, 0);
  assert_close(interval[1], 1 - pow(0.025, 1 / 1000.0), 1e-9);
  sb_probability_interval(interval, 3, 10); // Clopper and Pearson's table
  assert_close(interval[0], 0.06673951, 1e-6);
  assert_close(interval[1], 0.6524529, 1e-6);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/sampling/random", test_random);
  g_test_add_func("/sampling/distributions", test_distributions);
  g_test_add_func("/sampling/sobol", test_sobol);
  g_test_add_func("/sampling/ishigami", test_ishigami);
  g_test_add_func("/sampling/morris", test_morris);
  g_test_add_func("/sampling/summary", test_summary);
  return g_test_run();
}
