// Fit and posterior; see the header.
#include "app/study/inference.h"

#include "app/base/number.h"
#include "app/study/inference_private.h"
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

// ---- The model ----

bool sb_inference_evaluate(SbInferenceWork *work, double *residual, const double *z) {
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

static bool differentiate(SbInferenceWork *work, double *jacobian, const double *z) {
  const SbInferenceAsked *asked = work->asked;
  const size_t n = asked->coordinates, m = asked->residuals;
  const double step = 1e-3;
  bool (*by)(void *, double *, const double *, const double *) =
      work->at_fit && asked->differentiate_fit != NULL ? asked->differentiate_fit
                                                       : asked->differentiate;
  if (by != NULL) {
    g_autofree double *residual = g_new(double, m);
    const bool good =
        sb_inference_evaluate(work, residual, z) && by(asked->data, jacobian, z, residual);
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
static double scale_of(const SbInferenceWork *work, size_t i) {
  const uint8_t group = work->asked->group[i];
  const double sigma = group == SB_NOISE_KNOWN ? 1 : work->out->sigma[group];
  return sqrt(work->asked->weight[i]) / sigma;
}

// Deviations of the groups from residuals; from their median first, then by Huber's proposal 2.
static void find_sigma(SbInferenceWork *work, const double *residual, bool first) {
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
static void find_spread(SbInferenceWork *work, const double *residual, bool first) {
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

static double spread_of(const SbInferenceWork *work, size_t i) {
  const uint8_t group = work->asked->group[i];
  return group == SB_NOISE_KNOWN ? 1 : work->out->spread[group];
}

double sb_inference_log_density(const SbInferenceWork *work, const double *residual,
                                const double *z) {
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
static bool is_rough(const SbInferenceWork *work, const double *z) {
  double step = 0;
  for (size_t j = 0; j < work->asked->coordinates; j++) {
    step = fmax(step, fabs(z[j] - work->place[j]));
  }
  return work->asked->linear && step > 0 && step < ROUGH_STEP;
}

// GSL's rows: residuals, then the coordinates themselves, which are the prior's.
static int gsl_f(const gsl_vector *x, void *data, gsl_vector *f) {
  SbInferenceWork *work = data;
  const size_t m = work->asked->residuals, n = work->asked->coordinates;
  if (is_rough(work, x->data)) {
    return GSL_ENOPROG; // GSL would halve the step up to fifteen times
  }
  for (size_t j = 0; j < n; j++) {
    gsl_vector_set(f, m + j, gsl_vector_get(x, j));
  }
  return sb_inference_evaluate(work, f->data, x->data) ? GSL_SUCCESS : GSL_EFAILED;
}

static int gsl_df(const gsl_vector *x, void *data, gsl_matrix *jacobian) {
  SbInferenceWork *work = data;
  const size_t m = work->asked->residuals, n = work->asked->coordinates;
  gsl_matrix_set_zero(jacobian);
  memcpy(work->place, x->data, n * sizeof(double));
  for (size_t j = 0; j < n; j++) {
    gsl_matrix_set(jacobian, m + j, j, 1);
  }
  return differentiate(work, jacobian->data, x->data) ? GSL_SUCCESS : GSL_EFAILED;
}

// One fit with the weights that the loss has at the present residuals.
static bool fit_once(SbInferenceWork *work, gsl_multifit_nlinear_workspace *w,
                     gsl_multifit_nlinear_fdf *fdf, gsl_vector *weight) {
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
  return !work->cancelled && sb_inference_evaluate(work, work->out->residual, work->out->z);
}

// Covariance of z by the tangent: (J' W J + 1)^-1.
static bool find_covariance(SbInferenceWork *work) {
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
static bool polish(SbInferenceWork *work) {
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
    good = sb_inference_evaluate(work, residual, z);
    if (!good || sb_inference_log_density(work, residual, z) <=
                     sb_inference_log_density(work, out->residual, out->z)) {
      break;
    }
    memcpy(out->z, z, n * sizeof *z);
    memcpy(out->residual, residual, m * sizeof *residual);
    good = find_covariance(work);
  }
  g_free(residual);
  return good;
}

static SbStatus fit(SbInferenceWork *work) {
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
  bool good = w != NULL && weight != NULL && sb_inference_evaluate(work, out->residual, out->z);
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
      const double gain = sb_inference_log_density(work, out->residual, out->z) -
                          sb_inference_log_density(work, residual, before);
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

SbStatus sb_inference(SbInference *out, const SbInferenceAsked *asked, SbReport *report) {
  const size_t n = asked->coordinates, m = asked->residuals;
  *out = (SbInference){.z = g_new0(double, n),
                       .residual = g_new0(double, m),
                       .jacobian = g_try_new0(double, m *n),
                       .covariance = g_new0(double, n *n),
                       .sample = g_try_new0(double, asked->samples *n + 1)};
  SbInferenceWork work = {.asked = asked,
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
        !sb_inference_sample(&work)) {
      status = work.cancelled ? SB_ERROR_CANCELLED : SB_ERROR_NOT_CONVERGED;
    }
    gsl_set_error_handler(handler);
  }
  g_free(work.known_z);
  g_free(work.known_residual);
  return status == SB_ERROR_NOT_CONVERGED
             ? sb_fail(report, status, "the fit of the parameters has not converged")
             : status;
}

void sb_inference_release(SbInference *inference) {
  g_free(inference->z);
  g_free(inference->residual);
  g_free(inference->jacobian);
  g_free(inference->covariance);
  g_free(inference->sample);
  *inference = (SbInference){0};
}
