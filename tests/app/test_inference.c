// Fit and posterior against what is known: a straight line's exact posterior, coverage of the
// intervals and ranks of the truth over repeats (simulation-based calibration, Talts et al. 2018),
// outliers, noise that is correlated.
#include "app/study/inference.h"

#include "engine/numeric/sampling.h"

#include <glib.h>
#include <math.h>
#include <string.h>

enum { ROWS = 120 };

// y = a exp(-b t), or a straight line a + b t: a = 2 + z0 / 2, b = 1 + z1 / 4.
typedef struct {
  bool line;
  double y[ROWS];
} Toy;

static double model(bool line, const double *z, int row) {
  const double t = 3.0 * row / ROWS, a = 2 + 0.5 * z[0], b = 1 + 0.25 * z[1];
  return line ? a + b * t : a * exp(-b * t);
}

static bool evaluate(void *data, double *residual, const double *z) {
  const Toy *toy = data;
  for (int i = 0; i < ROWS; i++) {
    residual[i] = toy->y[i] - model(toy->line, z, i);
  }
  return true;
}

static double normal(uint64_t seed, uint64_t sample, uint32_t dimension) {
  return sb_normal_quantile(sb_random(seed, sample, dimension));
}

static void simulate(Toy *toy, const double *truth, double sigma, uint64_t seed) {
  for (int i = 0; i < ROWS; i++) {
    toy->y[i] = model(toy->line, truth, i) + sigma * normal(seed, (uint64_t)i, 7);
  }
}

static const uint8_t group[ROWS];
static double weight[ROWS];

static SbInferenceAsked asked_of(Toy *toy, size_t samples) {
  return (SbInferenceAsked){.coordinates = 2,
                            .residuals = ROWS,
                            .groups = 1,
                            .group = group,
                            .weight = weight,
                            .evaluate = evaluate,
                            .data = toy,
                            .seed = 3,
                            .samples = samples};
}

static void moments(double *mean, double *deviation, const SbInference *of, size_t column) {
  double sum = 0, square = 0;
  for (size_t i = 0; i < of->samples; i++) {
    sum += of->sample[2 * i + column];
  }
  *mean = sum / (double)of->samples;
  for (size_t i = 0; i < of->samples; i++) {
    square += pow(of->sample[2 * i + column] - *mean, 2);
  }
  *deviation = sqrt(square / (double)of->samples);
}

// Of a line the posterior is normal: (X' X / sigma^2 + 1)^-1 X' y / sigma^2.
static void test_line(void) {
  Toy toy = {.line = true};
  const double truth[2] = {0.7, -1.2};
  simulate(&toy, truth, 0.3, 11);
  SbInference found;
  const SbInferenceAsked asked = asked_of(&toy, 20000);
  g_assert_cmpint(sb_inference(&found, &asked, NULL), ==, SB_OK);
  g_assert_cmpfloat_with_epsilon(found.sigma[0], 0.3, 0.3 * 3 / sqrt(2 * ROWS));
  double a[2][2] = {{1, 0}, {0, 1}}, right[2] = {0};
  for (int i = 0; i < ROWS; i++) {
    const double t = 3.0 * i / ROWS, x[2] = {0.5, 0.25 * t}, y = toy.y[i] - 2 - t;
    for (int j = 0; j < 2; j++) {
      right[j] += x[j] * y / pow(found.sigma[0], 2);
      for (int k = 0; k < 2; k++) {
        a[j][k] += x[j] * x[k] / pow(found.sigma[0], 2);
      }
    }
  }
  const double det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
  const double mean[2] = {(a[1][1] * right[0] - a[0][1] * right[1]) / det,
                          (a[0][0] * right[1] - a[1][0] * right[0]) / det};
  for (size_t j = 0; j < 2; j++) {
    const double deviation = sqrt(a[1 - j][1 - j] / det);
    double sampled, spread;
    moments(&sampled, &spread, &found, j);
    // The bend takes a row or two of those beyond it.
    g_assert_cmpfloat_with_epsilon(found.z[j], mean[j], 0.25 * deviation);
    g_assert_cmpfloat_with_epsilon(sampled, found.z[j], 0.06 * deviation);
    g_assert_cmpfloat_with_epsilon(spread, deviation, 0.05 * deviation);
  }
  // Equal seeds, equal chains.
  SbInference again;
  g_assert_cmpint(sb_inference(&again, &asked, NULL), ==, SB_OK);
  g_assert_cmpmem(again.sample, 40000 * sizeof(double), found.sample, 40000 * sizeof(double));
  sb_inference_release(&again);
  sb_inference_release(&found);
}

// Truths from the prior: their ranks among the samples are even, 95 % intervals cover so many.
static void test_ranks(void) {
  enum { REPEATS = 400, BINS = 10, THIN = 10, KEPT = 99 };
  double ranks[2][BINS] = {{0}}, covered = 0;
  for (int r = 0; r < REPEATS; r++) {
    Toy toy = {0};
    const double truth[2] = {normal(5, (uint64_t)r, 0), normal(5, (uint64_t)r, 1)};
    simulate(&toy, truth, 0.4, 1000 + (uint64_t)r);
    SbInference found;
    SbInferenceAsked asked = asked_of(&toy, KEPT * THIN);
    asked.seed = (uint64_t)r;
    g_assert_cmpint(sb_inference(&found, &asked, NULL), ==, SB_OK);
    for (size_t j = 0; j < 2; j++) {
      int below = 0;
      for (size_t i = 0; i < KEPT; i++) {
        below += found.sample[2 * i * THIN + j] < truth[j];
      }
      ranks[j][below * BINS / (KEPT + 1)]++;
      covered += below >= 2 && below <= KEPT - 2;
    }
    sb_inference_release(&found);
  }
  for (size_t j = 0; j < 2; j++) {
    double chi = 0;
    for (int b = 0; b < BINS; b++) {
      const double even = (double)REPEATS / BINS;
      chi += pow(ranks[j][b] - even, 2) / even;
    }
    g_test_message("chi2 of the ranks of parameter %zu: %.1f", j, chi);
    g_assert_cmpfloat(chi, <, 21.7); // 99 % of nine degrees of freedom
  }
  // 96 of 100 places count as inside.
  const double share = covered / (2 * REPEATS);
  g_test_message("covered %.3f", share);
  g_assert_cmpfloat(share, >, 0.93);
  g_assert_cmpfloat(share, <, 0.985);
}

// One row in fifteen is far off: the fit stays where it was.
static void test_outliers(void) {
  Toy toy = {0};
  const double truth[2] = {0.5, 0.5};
  simulate(&toy, truth, 0.05, 4);
  for (int i = 0; i < ROWS; i += 15) {
    toy.y[i] += 3;
  }
  SbInference found;
  const SbInferenceAsked asked = asked_of(&toy, 0);
  g_assert_cmpint(sb_inference(&found, &asked, NULL), ==, SB_OK);
  for (size_t j = 0; j < 2; j++) {
    g_assert_cmpfloat_with_epsilon(found.z[j], truth[j], 3 * sqrt(found.covariance[3 * j]));
  }
  g_assert_cmpfloat(found.sigma[0], <, 0.12);
  sb_inference_release(&found);
}

// Rows that repeat their neighbours' noise tell less: the interval widens with them.
static void test_correlated(void) {
  Toy toy = {0};
  const double truth[2] = {0.5, 0.5};
  double width[2];
  for (int together = 0; together < 2; together++) {
    double noise = 0;
    for (int i = 0; i < ROWS; i++) {
      const double rho = together ? 0.8 : 0;
      noise = rho * noise + sqrt(1 - rho * rho) * normal(8, (uint64_t)i, 1);
      toy.y[i] = model(false, truth, i) + 0.1 * noise;
    }
    SbInference found;
    const SbInferenceAsked asked = asked_of(&toy, 0);
    g_assert_cmpint(sb_inference(&found, &asked, NULL), ==, SB_OK);
    width[together] = sqrt(found.covariance[0]) / found.sigma[0];
    g_assert_true(together ? found.spread[0] > 3 : found.spread[0] == 1);
    sb_inference_release(&found);
  }
  g_assert_cmpfloat(width[1] / width[0], >, 1.5);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  for (int i = 0; i < ROWS; i++) {
    weight[i] = 1;
  }
  g_test_add_func("/inference/line", test_line);
  g_test_add_func("/inference/ranks", test_ranks);
  g_test_add_func("/inference/outliers", test_outliers);
  g_test_add_func("/inference/correlated", test_correlated);
  return g_test_run();
}
