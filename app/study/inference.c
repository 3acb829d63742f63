// Fit and posterior; see the header.
#include "app/study/inference.h"

#include "app/base/number.h"

#include "engine/numeric/sampling.h"

#include <glib.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <string.h>

#define BEND 2.5

// A solved model is rough on the scale of its mesh: smaller steps than this share of a prior's
// deviation find no way down, and each costs a solution. polish() follows.
#define ROUGH_STEP 1e-3

// Least number of independent differences by which their own deviation is known.
#define LEAST_FREE 1.0

typedef struct {
  const SbInferenceAsked *asked;
  SbInference *out;
  double *known_z, *known_residual; // the last place asked for
  bool known, cancelled;
  bool at_fit;                            // derivatives are those of the posterior
  double place[SB_INFERENCE_COORDINATES]; // of the last derivatives, from which steps are tried
} Work;

// ---- The model ----

static bool evaluate(Work *work, double *residual, const double *z) {
  const SbInferenceAsked *asked = work->asked;
  const size_t n = asked->coordinates, m = asked->residuals;
  if (!work->known || memcmp(work->known_z, z, n * sizeof *z) != 0) {
    work->known = asked->evaluate(asked->data, work->known_residual, z);
    work->out->evaluations++;
    work->cancelled |= !work->known;
    memcpy(work->known_z, z, n * sizeof *z);
  }
  memcpy(residual, work->known_residual, m * sizeof *residual);
  return work->known;
}

static bool differentiate(Work *work, double *jacobian, const double *z) {
  const SbInferenceAsked *asked = work->asked;
  const size_t n = asked->coordinates, m = asked->residuals;
  const double step = 1e-3;
  bool (*by)(void *, double *, const double *, const double *) =
      work->at_fit && asked->differentiate_fit != NULL ? asked->differentiate_fit
                                                       : asked->differentiate;
  if (by != NULL) {
    g_autofree double *residual = g_new(double, m);
    const bool good = evaluate(work, residual, z) && by(asked->data, jacobian, z, residual);
    work->cancelled |= !good;
    return good;
  }
  double *side[2] = {g_new(double, m), g_new(double, m)}, *moved = g_memdup2(z, n * sizeof *z);
  bool good = true;
  for (size_t j = 0; j < n && good; j++) {
    for (int s = 0; s < 2 && good; s++) {
      moved[j] = z[j] + (s == 0 ? -step : step);
      good = asked->evaluate(asked->data, side[s], moved);
      work->out->evaluations++;
    }
    moved[j] = z[j];
    for (size_t i = 0; i < m && good; i++) {
      jacobian[i * n + j] = (side[1][i] - side[0][i]) / (2 * step);
    }
  }
  work->cancelled |= !good;
  g_free(side[0]);
  g_free(side[1]);
  g_free(moved);
  return good;
}

// ---- Noise and loss ----

// 1/deviation of a residual.
static double scale_of(const Work *work, size_t i) {
  const uint8_t group = work->asked->group[i];
  const double sigma = group == SB_NOISE_KNOWN ? 1 : work->out->sigma[group];
  return sqrt(work->asked->weight[i]) / sigma;
}

// Deviations of the groups from residuals; from their median first, then by Huber's proposal 2.
static void find_sigma(Work *work, const double *residual, bool first) {
  const SbInferenceAsked *asked = work->asked;
  const double normal = sb_normal_share(BEND), density = exp(-0.5 * BEND * BEND) / sqrt(2 * M_PI);
  const double share = (2 * normal - 1) - 2 * BEND * density + 2 * BEND * BEND * (1 - normal);
  double *value = g_new(double, asked->residuals + 1);
  for (size_t g = 0; g < asked->groups; g++) {
    size_t count = 0;
    for (size_t i = 0; i < asked->residuals; i++) {
      if (asked->group[i] == g) {
        value[count++] = fabs(residual[i]) * sqrt(asked->weight[i]);
      }
    }
    if (count == 0) {
      work->out->sigma[g] = 1;
      continue;
    }
    double sigma = work->out->sigma[g];
    if (first) {
      qsort(value, count, sizeof *value, sb_number_compare);
      sigma = value[count / 2] / 0.6745;
    }
    const double taken =
        (double)asked->coordinates * (double)count / (double)asked->residuals; // by the fit
    const double free = fmax((double)count - taken, 1);
    sigma = fmax(sigma, 1e-12);
    for (int round = 0; round < 20; round++) {
      double sum = 0;
      for (size_t i = 0; i < count; i++) {
        const double x = fmin(value[i] / sigma, BEND);
        sum += x * x;
      }
      sigma = fmax(sigma * sqrt(sum / (free * share)), 1e-12);
    }
    work->out->sigma[g] = sigma;
  }
  g_free(value);
}

// Integrated autocorrelation 1 + 2 sum rho_k of a series, up to the first lag whose correlation is
// within two standard errors; 1 where that of the first lag is within three. `first`: the sum of a
// series whose lags fall off as the powers of the first.
static double integrated(const double *x, size_t count, bool first) {
  double square = 0, sum = 0;
  for (size_t i = 0; i < count; i++) {
    square += x[i] * x[i];
  }
  for (size_t lag = 1; lag < count && square > 0; lag++) {
    double product = 0;
    for (size_t i = lag; i < count; i++) {
      product += x[i] * x[i - lag];
    }
    const double rho = product / square;
    if (rho <= (lag == 1 ? 3 : 2) / sqrt((double)count)) {
      break;
    }
    if (first) {
      return (1 + fmin(rho, 0.99)) / (1 - fmin(rho, 0.99));
    }
    sum += rho;
  }
  return 1 + 2 * sum;
}

// Finds by how much the rows of each group count for less; see the header. `first`: by the first
// lag alone, on the path to the fit.
static void find_spread(Work *work, const double *residual, bool first) {
  const SbInferenceAsked *asked = work->asked;
  g_autofree double *x = g_new(double, asked->residuals + 1);
  for (size_t g = 0; g < asked->groups; g++) {
    size_t count = 0;
    for (size_t i = 0; i < asked->residuals; i++) {
      if (asked->group[i] == g) {
        x[count++] = fmax(fmin(residual[i] * scale_of(work, i), BEND), -BEND);
      }
    }
    const double rows = integrated(x, count, first);
    const double independent = (double)count / rows;
    const double taken = (double)asked->coordinates * (double)count / (double)asked->residuals;
    work->out->spread[g] =
        first || rows <= 1 ? rows : rows * independent / fmax(independent - taken - 2, LEAST_FREE);
  }
}

static double spread_of(const Work *work, size_t i) {
  const uint8_t group = work->asked->group[i];
  return group == SB_NOISE_KNOWN ? 1 : work->out->spread[group];
}

// Logarithm of the posterior's density, but for a constant.
static double log_density(const Work *work, const double *residual, const double *z) {
  double sum = 0;
  for (size_t i = 0; i < work->asked->residuals; i++) {
    const double x = fabs(residual[i] * scale_of(work, i));
    sum += (x < BEND ? 0.5 * x * x : BEND * (x - 0.5 * BEND)) / spread_of(work, i);
  }
  for (size_t j = 0; j < work->asked->coordinates; j++) {
    sum += 0.5 * z[j] * z[j];
  }
  return -sum;
}

// ---- The fit ----

// Whether a step of a solved model is too small to be worth a solution.
static bool is_rough(const Work *work, const double *z) {
  double step = 0;
  for (size_t j = 0; j < work->asked->coordinates; j++) {
    step = fmax(step, fabs(z[j] - work->place[j]));
  }
  return work->asked->linear && step > 0 && step < ROUGH_STEP;
}

// GSL's rows: residuals, then the coordinates themselves, which are the prior's.
static int gsl_f(const gsl_vector *x, void *data, gsl_vector *f) {
  Work *work = data;
  const size_t m = work->asked->residuals, n = work->asked->coordinates;
  if (is_rough(work, x->data)) {
    return GSL_ENOPROG; // GSL would halve the step up to fifteen times
  }
  for (size_t j = 0; j < n; j++) {
    gsl_vector_set(f, m + j, gsl_vector_get(x, j));
  }
  return evaluate(work, f->data, x->data) ? GSL_SUCCESS : GSL_EFAILED;
}

static int gsl_df(const gsl_vector *x, void *data, gsl_matrix *jacobian) {
  Work *work = data;
  const size_t m = work->asked->residuals, n = work->asked->coordinates;
  gsl_matrix_set_zero(jacobian);
  memcpy(work->place, x->data, n * sizeof(double));
  for (size_t j = 0; j < n; j++) {
    gsl_matrix_set(jacobian, m + j, j, 1);
  }
  return differentiate(work, jacobian->data, x->data) ? GSL_SUCCESS : GSL_EFAILED;
}

// One fit with the weights that the loss has at the present residuals.
static bool fit_once(Work *work, gsl_multifit_nlinear_workspace *w, gsl_multifit_nlinear_fdf *fdf,
                     gsl_vector *weight) {
  const size_t m = work->asked->residuals, n = work->asked->coordinates;
  for (size_t i = 0; i < m; i++) {
    const double scale = scale_of(work, i), x = fabs(work->out->residual[i] * scale);
    gsl_vector_set(weight, i, scale * scale * (x > BEND ? BEND / x : 1) / spread_of(work, i));
  }
  for (size_t j = 0; j < n; j++) {
    gsl_vector_set(weight, m + j, 1);
  }
  memcpy(work->place, work->out->z, n * sizeof(double));
  const gsl_vector_const_view start = gsl_vector_const_view_array(work->out->z, n);
  if (gsl_multifit_nlinear_winit(&start.vector, weight, fdf, w) != GSL_SUCCESS) {
    return false;
  }
  int info = 0;
  const double step = work->asked->linear ? ROUGH_STEP : 1e-7;
  (void)gsl_multifit_nlinear_driver(40, step, 1e-10, 1e-10, NULL, NULL, &info, w);
  const gsl_vector *at = gsl_multifit_nlinear_position(w);
  memcpy(work->out->z, at->data, n * sizeof(double));
  // Steps that did not end go on in the next round; whether the rounds end is judged by the
  // density.
  return !work->cancelled && evaluate(work, work->out->residual, work->out->z);
}

// Covariance of z by the tangent: (J' W J + 1)^-1.
static bool find_covariance(Work *work) {
  SbInference *out = work->out;
  const size_t m = work->asked->residuals, n = work->asked->coordinates;
  if (!differentiate(work, out->jacobian, out->z)) {
    return false;
  }
  memset(out->covariance, 0, n * n * sizeof(double));
  for (size_t j = 0; j < n; j++) {
    out->covariance[j * n + j] = 1;
  }
  for (size_t i = 0; i < m; i++) {
    const double scale = scale_of(work, i), x = fabs(out->residual[i] * scale);
    const double weight = scale * scale * (x > BEND ? BEND / x : 1) / spread_of(work, i);
    const double *row = out->jacobian + i * n;
    for (size_t j = 0; j < n; j++) {
      for (size_t k = 0; k < n; k++) {
        out->covariance[j * n + k] += weight * row[j] * row[k];
      }
    }
  }
  gsl_matrix_view matrix = gsl_matrix_view_array(out->covariance, n, n);
  return gsl_linalg_cholesky_decomp1(&matrix.matrix) == GSL_SUCCESS &&
         gsl_linalg_cholesky_invert(&matrix.matrix) == GSL_SUCCESS;
}

// Gauss and Newton's own steps from the fit while they gain: a trust region that a model's rough
// places have made small ends before the slope is nothing.
static bool polish(Work *work) {
  enum { STEPS = 5 };
  SbInference *out = work->out;
  const size_t m = work->asked->residuals, n = work->asked->coordinates;
  double *residual = g_new(double, m), gradient[SB_INFERENCE_COORDINATES];
  double z[SB_INFERENCE_COORDINATES];
  bool good = find_covariance(work);
  for (int step = 0; step < STEPS && good; step++) {
    memcpy(gradient, out->z, n * sizeof *gradient);
    for (size_t i = 0; i < m; i++) {
      const double scale = scale_of(work, i), x = fabs(out->residual[i] * scale);
      const double weight = scale * scale * (x > BEND ? BEND / x : 1) / spread_of(work, i);
      for (size_t j = 0; j < n; j++) {
        gradient[j] += weight * out->jacobian[i * n + j] * out->residual[i];
      }
    }
    double gain = 0;
    for (size_t j = 0; j < n; j++) {
      z[j] = out->z[j];
      for (size_t k = 0; k < n; k++) {
        z[j] -= out->covariance[j * n + k] * gradient[k];
        gain += 0.5 * gradient[j] * out->covariance[j * n + k] * gradient[k];
      }
    }
    if (gain < 1e-4) {
      break; // of the density's logarithm: a hundredth of a deviation
    }
    good = evaluate(work, residual, z);
    if (!good || log_density(work, residual, z) <= log_density(work, out->residual, out->z)) {
      break;
    }
    memcpy(out->z, z, n * sizeof *z);
    memcpy(out->residual, residual, m * sizeof *residual);
    good = find_covariance(work);
  }
  g_free(residual);
  return good;
}

static SbStatus fit(Work *work) {
  SbInference *out = work->out;
  const size_t m = work->asked->residuals, n = work->asked->coordinates;
  gsl_multifit_nlinear_parameters parameters = gsl_multifit_nlinear_default_parameters();
  parameters.scale = gsl_multifit_nlinear_scale_levenberg;
  gsl_multifit_nlinear_workspace *w =
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, m + n, n);
  gsl_vector *weight = gsl_vector_alloc(m + n);
  gsl_multifit_nlinear_fdf fdf = {.f = gsl_f, .df = gsl_df, .n = m + n, .p = n, .params = work};
  // What the model cannot follow is what remains at the fit: its correlation is found there, once,
  // and the fit goes on with it. Before, that of the first lag lets steps pass the kinks of the
  // loss.
  enum { ROUNDS = 18, SPREAD_ROUND = 11 };
  bool spread = false;
  bool good = w != NULL && weight != NULL && evaluate(work, out->residual, out->z);
  g_autofree double *before = g_new(double, n), *residual = g_new(double, m);
  if (good) {
    find_sigma(work, out->residual, true);
  }
  for (int round = 0; round < ROUNDS && good && !out->converged; round++) {
    memcpy(before, out->z, n * sizeof *before);
    memcpy(residual, out->residual, m * sizeof *residual);
    good = fit_once(work, w, &fdf, weight);
    if (good) {
      find_sigma(work, out->residual, round == 0);
      // A hundredth of a deviation in the density's logarithm is an end.
      const double gain =
          log_density(work, out->residual, out->z) - log_density(work, residual, before);
      const bool ended = round > 0 && fabs(gain) < 1e-4;
      out->converged = ended && spread;
      if (!spread) {
        // The trust region may end at a kink, from which Gauss and Newton's steps go on.
        bool rests = ended;
        if (ended) {
          memcpy(before, out->z, n * sizeof *before);
          good = polish(work);
          find_sigma(work, out->residual, false);
          rests = memcmp(before, out->z, n * sizeof *before) == 0;
        }
        spread = rests || round == SPREAD_ROUND;
        find_spread(work, out->residual, !spread);
      }
    }
  }
  gsl_multifit_nlinear_free(w);
  gsl_vector_free(weight);
  good = !work->cancelled && polish(work) && good;
  return work->cancelled               ? SB_ERROR_CANCELLED
         : w == NULL || weight == NULL ? SB_ERROR_MEMORY
         : good && out->converged      ? SB_OK
                                       : SB_ERROR_NOT_CONVERGED;
}

// ---- The chain ----

// Numbers of a proposal: dimensions of the random numbers that decide and make it.
enum { CHI_SQUARES = 5, DECIDE = 200 };

static bool residual_at(Work *work, double *residual, const double *z) {
  const size_t m = work->asked->residuals, n = work->asked->coordinates;
  if (!work->asked->linear) {
    return evaluate(work, residual, z);
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

static bool sample_posterior(Work *work) {
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
  double density = log_density(work, out->residual, z), scale = 2.38 / sqrt((double)n);
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
    const double other = log_density(work, residual, tried);
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

SbStatus sb_inference(SbInference *out, const SbInferenceAsked *asked, SbReport *report) {
  const size_t n = asked->coordinates, m = asked->residuals;
  *out = (SbInference){.z = g_new0(double, n),
                       .residual = g_new0(double, m),
                       .jacobian = g_try_new0(double, m *n),
                       .covariance = g_new0(double, n *n),
                       .sample = g_try_new0(double, asked->samples *n + 1)};
  Work work = {.asked = asked,
               .out = out,
               .known_z = g_new0(double, n),
               .known_residual = g_new0(double, m)};
  for (size_t g = 0; g < G_N_ELEMENTS(out->sigma); g++) {
    out->sigma[g] = out->spread[g] = 1;
  }
  SbStatus status = SB_ERROR_MEMORY;
  if (out->jacobian != NULL && out->sample != NULL) {
    if (asked->start != NULL) {
      memcpy(out->z, asked->start, n * sizeof(double));
    }
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    status = fit(&work);
    work.at_fit = true;
    if ((status == SB_OK || status == SB_ERROR_NOT_CONVERGED) && asked->differentiate_fit != NULL &&
        !find_covariance(&work)) {
      status = work.cancelled ? SB_ERROR_CANCELLED : SB_ERROR_NOT_CONVERGED;
    }
    if ((status == SB_OK || status == SB_ERROR_NOT_CONVERGED) && asked->samples > 0 &&
        !sample_posterior(&work)) {
      status = work.cancelled ? SB_ERROR_CANCELLED : SB_ERROR_NOT_CONVERGED;
    }
    gsl_set_error_handler(handler);
  }
  g_free(work.known_z);
  g_free(work.known_residual);
  return status;
}

void sb_inference_release(SbInference *inference) {
  g_free(inference->z);
  g_free(inference->residual);
  g_free(inference->jacobian);
  g_free(inference->covariance);
  g_free(inference->sample);
  *inference = (SbInference){0};
}
