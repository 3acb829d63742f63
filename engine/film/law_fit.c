// Least squares of ln H = ln k + a ln U + b ln W by GSL's multifit; see the header.
#include "engine/film/law_fit.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_multifit.h>
#include <math.h>

double sb_film_law(const SbFilmLaw *law, double U, double W) {
  return law->k * pow(U, law->a) * pow(W, law->b);
}

SbStatus sb_film_law_fit(SbFilmLaw *out, const double *U, const double *W, const double *H,
                         size_t count, SbReport *report) {
  double rows[SB_FILM_LAW_POINTS][3], ln_H[SB_FILM_LAW_POINTS], c[3], covariance[3][3], chi2;
  bool sane = count >= 3 && count <= SB_FILM_LAW_POINTS;
  for (size_t i = 0; sane && i < count; i++) {
    rows[i][0] = 1.0;
    rows[i][1] = log(U[i]);
    rows[i][2] = log(W[i]);
    ln_H[i] = log(H[i]);
    sane = isfinite(rows[i][1]) && isfinite(rows[i][2]) && isfinite(ln_H[i]);
  }
  if (!sane) {
    return sb_fail(report, SB_ERROR_RANGE, "film law: 3 to %d films are wanted, all above zero",
                   SB_FILM_LAW_POINTS);
  }
  gsl_matrix_view X = gsl_matrix_view_array(&rows[0][0], count, 3);
  gsl_vector_view y = gsl_vector_view_array(ln_H, count);
  gsl_vector_view coefficients = gsl_vector_view_array(c, 3);
  gsl_matrix_view spread = gsl_matrix_view_array(&covariance[0][0], 3, 3);
  gsl_multifit_linear_workspace *work = gsl_multifit_linear_alloc(count, 3);
  if (work == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "film law: out of memory");
  }
  const int failed =
      gsl_multifit_linear(&X.matrix, &y.vector, &coefficients.vector, &spread.matrix, &chi2, work);
  gsl_multifit_linear_free(work);
  if (failed != 0) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "film law: the regression failed");
  }
  double quantile = count > 3 ? gsl_cdf_tdist_Pinv(0.975, (double)(count - 3)) : 0.0;
  *out = (SbFilmLaw){.k = exp(c[0]),
                     .a = c[1],
                     .b = c[2],
                     .k_confidence = quantile * sqrt(covariance[0][0]),
                     .a_confidence = quantile * sqrt(covariance[1][1]),
                     .b_confidence = quantile * sqrt(covariance[2][2])};
  return sb_succeed(report);
}
