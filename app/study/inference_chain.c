// The Markov chain that samples the posterior; see inference.h.
#include "app/study/inference_private.h"

#include "engine/numeric/sampling.h"

#include <glib.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

// Numbers of a proposal: dimensions of the random numbers that decide and make it.
enum { CHI_SQUARES = 5, DECIDE = 200 };

static bool residual_at(SbInferenceWork *work, double *residual, const double *z) {
  const size_t m = work->asked->residuals, n = work->asked->coordinates;
  if (!work->asked->linear) {
    return sb_inference_evaluate(work, residual, z);
  }
  for (size_t i = 0; i < m; i++) {
    residual[i] = work->out->residual[i];
    for (size_t j = 0; j < n; j++) {
      residual[i] += work->out->jacobian[i * n + j] * (z[j] - work->out->z[j]);
    }
  }
  return true;
}

// Lower root of a covariance.
static bool root_of(double *root, const double *covariance, size_t n) {
  memcpy(root, covariance, n * n * sizeof *root);
  gsl_matrix_view matrix = gsl_matrix_view_array(root, n, n);
  return gsl_linalg_cholesky_decomp1(&matrix.matrix) == GSL_SUCCESS;
}

// out = centre + scale root variates
static void step_from(double *out, const double *centre, double scale, const double *root,
                      const double *variate, size_t n) {
  for (size_t j = 0; j < n; j++) {
    out[j] = centre[j];
    for (size_t k = 0; k <= j; k++) {
      out[j] += scale * root[j * n + k] * variate[k];
    }
  }
}

// Logarithm of the t density of the independent proposals, but for a constant.
static double log_t(const double *z, const double *centre, const double *root, size_t n) {
  double solved[SB_INFERENCE_COORDINATES], square = 0;
  for (size_t j = 0; j < n; j++) {
    solved[j] = z[j] - centre[j];
    for (size_t k = 0; k < j; k++) {
      solved[j] -= root[j * n + k] * solved[k];
    }
    solved[j] /= root[j * n + j];
    square += solved[j] * solved[j];
  }
  return -0.5 * (CHI_SQUARES + (double)n) * log1p(square / CHI_SQUARES);
}

// Covariance of samples, drawn in by a tenth of what it was before.
static void adapt(double *covariance, const double *sample, size_t count, size_t n) {
  double mean[SB_INFERENCE_COORDINATES] = {0};
  for (size_t i = 0; i < count; i++) {
    for (size_t j = 0; j < n; j++) {
      mean[j] += sample[i * n + j] / (double)count;
    }
  }
  for (size_t j = 0; j < n; j++) {
    for (size_t k = 0; k < n; k++) {
      double sum = 0;
      for (size_t i = 0; i < count; i++) {
        sum += (sample[i * n + j] - mean[j]) * (sample[i * n + k] - mean[k]);
      }
      covariance[j * n + k] = 0.1 * covariance[j * n + k] + 0.9 * sum / (double)count;
    }
  }
}

// Returns a random number of the chi-square distribution with CHI_SQUARES degrees of freedom, for
// step `i`.
static double chi_square(uint64_t seed, size_t i) {
  double chi = 0;
  for (uint32_t k = 0; k < CHI_SQUARES; k++) {
    chi += pow(sb_normal_quantile(sb_random(seed, i, DECIDE + 1 + k)), 2);
  }
  return chi;
}

// Replaces the root that steps are drawn by with that of the points' covariance; with `root` if it
// has none.
static void adapt_root(double *step_root, double *covariance, const double *root,
                       const double *point, size_t count, size_t n) {
  adapt(covariance, point, count, n);
  if (!root_of(step_root, covariance, n)) {
    memcpy(step_root, root, n * n * sizeof *step_root);
  }
}

bool sb_inference_sample(SbInferenceWork *work) {
  SbInference *out = work->out;
  const SbInferenceAsked *asked = work->asked;
  const size_t n = asked->coordinates, warm = MAX(asked->samples / 4, 200);
  const size_t all = warm + asked->samples;
  double *root = g_new(double, n *n), *step_root = g_new(double, n *n);
  double *covariance = g_memdup2(out->covariance, n * n * sizeof(double));
  double *residual = g_new(double, asked->residuals), *warmed = g_new(double, warm *n);
  double z[SB_INFERENCE_COORDINATES], tried[SB_INFERENCE_COORDINATES];
  double variate[SB_INFERENCE_COORDINATES];
  memcpy(z, out->z, n * sizeof *z);
  double density = sb_inference_log_density(work, out->residual, z), scale = 2.38 / sqrt((double)n);
  bool good = root_of(root, out->covariance, n) && root_of(step_root, covariance, n);
  size_t taken = 0;
  for (size_t i = 0; i < all && good; i++) {
    for (size_t j = 0; j < n; j++) {
      variate[j] = sb_normal_quantile(sb_random(asked->seed, i, (uint32_t)j));
    }
    const bool alone = i % 2 == 1;
    double ratio = 0;
    if (alone) {
      const double chi = chi_square(asked->seed, i);
      step_from(tried, out->z, sqrt(CHI_SQUARES / chi), root, variate, n);
      ratio = log_t(z, out->z, root, n) - log_t(tried, out->z, root, n);
    } else {
      step_from(tried, z, scale, step_root, variate, n);
    }
    if (!(good = residual_at(work, residual, tried))) {
      break;
    }
    const double other = sb_inference_log_density(work, residual, tried);
    const double share = fmin(exp(other - density + ratio), 1);
    const bool takes = sb_random(asked->seed, i, DECIDE) < share;
    if (takes) {
      memcpy(z, tried, n * sizeof *z);
      density = other;
    }
    if (i < warm) {
      memcpy(warmed + i * n, z, n * sizeof *z);
      scale *= alone ? 1 : exp(((share > 0 ? share : 0) - 0.3) / sqrt(1 + 0.1 * (double)i));
      scale = fmin(fmax(scale, 1e-3), 10);
      if (i + 1 == warm) {
        adapt_root(step_root, covariance, root, warmed + warm / 2 * n, warm - warm / 2, n);
      }
    } else {
      memcpy(out->sample + (i - warm) * n, z, n * sizeof *z);
      taken += takes;
      out->samples++;
    }
  }
  out->accepted = out->samples > 0 ? (double)taken / (double)out->samples : NAN;
  g_free(root);
  g_free(step_root);
  g_free(covariance);
  g_free(residual);
  g_free(warmed);
  return good;
}
