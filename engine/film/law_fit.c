// Least squares of ln H = ln k + a ln U + b ln W by GSL's multifit over a grid of coupled solutions
// (thesis eq. 7.2-7.4). One solver follows the grid along U, so that most solves are warm.
#include "engine/film/law_fit.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_multifit.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// A contact with these numbers; R and E' drop out of h / R.
static SbFilmProblem contact(double U, double W, double tolerance) {
  SbFilmProblem problem;
  sb_film_problem_init(&problem);
  problem.radius = 1e-3;
  problem.modulus = 1e7;
  problem.tolerance = tolerance;
  double unit = problem.modulus * problem.radius;
  problem.load = W * unit;
  // eta u / 2 = U E' R at 1 m/s, unless the viscosity left its range.
  problem.viscosity = fmin(fmax(2.0 * U * unit, 1e-8), 1e5);
  problem.speed = 2.0 * U * unit / problem.viscosity;
  return problem;
}

static SbStatus check(const SbFilmLawRange *range, SbReport *report) {
  bool sane = range->U_min > 0.0 && range->U_max > range->U_min && isfinite(range->U_max) &&
              range->W_min > 0.0 && range->W_max > range->W_min && isfinite(range->W_max);
  if (!sane || range->U_count < 2 || range->W_count < 2 || range->U_count > SB_FILM_LAW_POINTS ||
      range->W_count > SB_FILM_LAW_POINTS / range->U_count) {
    return sb_fail(
        report, SB_ERROR_RANGE,
        "film law: the ranges of U and W must be positive and rising, with 2 points each "
        "and %d in all at most",
        SB_FILM_LAW_POINTS);
  }
  return SB_OK;
}

// Fills the points of the law.
static SbStatus solve_grid(SbFilmLaw *out, const SbFilmLawRange *range, SbReport *report) {
  SbFilmSolver *solver = NULL;
  SbFilm *film = malloc(sizeof *film);
  SbStatus status = film != NULL ? sb_film_solver_create(&solver, report)
                                 : sb_fail(report, SB_ERROR_MEMORY, "film law: out of memory");
  for (size_t j = 0; status == SB_OK && j < range->W_count; j++) {
    double v = (double)j / (double)(range->W_count - 1);
    double W = range->W_min * pow(range->W_max / range->W_min, v);
    for (size_t i = 0; status == SB_OK && i < range->U_count; i++) {
      double u = (double)i / (double)(range->U_count - 1);
      double U = range->U_min * pow(range->U_max / range->U_min, u);
      SbFilmProblem problem = contact(U, W, range->tolerance);
      problem.cancelled = range->cancelled;
      problem.cancelled_data = range->data;
      status = sb_film_solve(film, &problem, solver, report);
      double h = range->film == SB_FILM_LAW_MIN       ? film->film_min
                 : range->film == SB_FILM_LAW_CENTRAL ? film->film_central
                                                      : film->film_flux;
      out->U[out->count] = U;
      out->W[out->count] = W;
      out->H[out->count] = h / problem.radius;
      const SbFilmSolverInfo *info = &film->solver;
      out->error = fmax(out->error, range->film == SB_FILM_LAW_MIN       ? info->error_film_min
                                    : range->film == SB_FILM_LAW_CENTRAL ? info->error_film_central
                                                                         : info->error_film_flux);
      out->count += status == SB_OK ? 1 : 0;
      if (range->progress != NULL) {
        range->progress(range->data,
                        (double)out->count / (double)(range->U_count * range->W_count));
      }
    }
  }
  free(film);
  sb_film_solver_destroy(solver);
  return status;
}

// The regression itself.
static SbStatus regress(SbFilmLaw *out, SbReport *report) {
  const size_t n = out->count;
  double rows[SB_FILM_LAW_POINTS][3], ln_H[SB_FILM_LAW_POINTS], c[3], covariance[3][3];
  for (size_t i = 0; i < n; i++) {
    rows[i][0] = 1.0;
    rows[i][1] = log(out->U[i]);
    rows[i][2] = log(out->W[i]);
    ln_H[i] = log(out->H[i]);
  }
  gsl_matrix_view X = gsl_matrix_view_array(&rows[0][0], n, 3);
  gsl_vector_view y = gsl_vector_view_array(ln_H, n);
  gsl_vector_view coefficients = gsl_vector_view_array(c, 3);
  gsl_matrix_view spread = gsl_matrix_view_array(&covariance[0][0], 3, 3);
  gsl_multifit_linear_workspace *work = gsl_multifit_linear_alloc(n, 3);
  if (work == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "film law: out of memory");
  }
  double chi2;
  const int failed =
      gsl_multifit_linear(&X.matrix, &y.vector, &coefficients.vector, &spread.matrix, &chi2, work);
  gsl_multifit_linear_free(work);
  if (failed != 0) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "film law: the regression failed");
  }
  out->k = exp(c[0]);
  out->a = c[1];
  out->b = c[2];
  double quantile = n > 3 ? gsl_cdf_tdist_Pinv(0.975, (double)(n - 3)) : 0.0;
  out->k_confidence = quantile * sqrt(covariance[0][0]);
  out->a_confidence = quantile * sqrt(covariance[1][1]);
  out->b_confidence = quantile * sqrt(covariance[2][2]);
  double sum = 0.0;
  for (size_t i = 0; i < n; i++) {
    double law = out->k * pow(out->U[i], out->a) * pow(out->W[i], out->b);
    out->residual[i] = out->H[i] / law - 1.0;
    sum += out->residual[i] * out->residual[i];
    out->largest_residual = fmax(out->largest_residual, fabs(out->residual[i]));
  }
  out->rms_residual = sqrt(sum / (double)n);
  return SB_OK;
}

SbStatus sb_film_law_fit(SbFilmLaw *out, const SbFilmLawRange *range, SbReport *report) {
  memset(out, 0, sizeof *out);
  SbStatus status = check(range, report);
  if (status == SB_OK) {
    status = solve_grid(out, range, report);
  }
  if (status == SB_OK) {
    status = regress(out, report);
  }
  return status == SB_OK ? sb_succeed(report) : status;
}
