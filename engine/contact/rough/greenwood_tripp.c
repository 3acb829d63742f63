// The integrals F_2 and F_5/2 without a polynomial fit.
//
// With t = s - lambda, F_n = phi(lambda) I_n and I_n = integral_0^inf t^n exp(-lambda t - t^2/2)
// dt. The substitution t = e^u turns the integrand into e^((n+1)u) exp(-lambda e^u - e^(2u)/2),
// analytic in the strip |Im u| < pi/4 and decaying at both ends, so that the trapezoidal rule
// converges exponentially: the error is about exp(-(2 pi/h)^2/(2 lambda^2)) for lambda = -10, below
// 1e-30 at h = 1/20. All terms are positive, so nothing cancels; factors are kept in the exponent
// so that nothing underflows early. The area alone takes the closed form F_2 = (1 + lambda^2) Q -
// lambda phi, a hundred times as quick, where that cancels by three digits at most.
#include "engine/contact/rough/greenwood_tripp.h"

#include <math.h>

void sb_gt_log_integrals(double out[4], double lambda) {
  const double h = 1.0 / 20;
  const double log_root_two_pi = 0.91893853320467274178;

  // t^(n+1) exp(-lambda t - t^2/2) peaks where n + 1 - lambda t - t^2 = 0; the peak of n = 9/4 sets
  // the scale.
  double peak = (-lambda + sqrt(lambda * lambda + 13)) / 2;
  double top = 3.25 * log(peak) - lambda * peak - peak * peak / 2;

  // Downwards the terms fall as t^2 at least: e^-36 of the peak after 18 units of u. Upwards they
  // fall faster than exp(-t): stop when negligible.
  double u_peak = log(peak);
  double sum[4] = {0};
  for (int i = -360; i < 200; i++) {
    double u = u_peak + i * h;
    double t = exp(u), root = sqrt(t);
    double term = exp(-lambda * t - t * t / 2 - top + 2 * u);
    sum[0] += term;
    sum[1] += term * root;
    sum[2] += term * t;
    sum[3] += term * t * root;
    if (i > 0 && term * t * root < 1e-20 * sum[3]) {
      break;
    }
  }
  for (int k = 0; k < 4; k++) {
    out[k] = log(h * sum[k]) + top - lambda * lambda / 2 - log_root_two_pi;
  }
}

SbStatus sb_gt_integrals(SbGtIntegrals *out, double lambda, SbReport *report) {
  *out = (SbGtIntegrals){.lambda = lambda};
  if (!isfinite(lambda)) {
    return sb_fail(report, SB_ERROR_INPUT, "lambda is not a finite number");
  }
  if (lambda < SB_GT_LAMBDA_MIN) {
    return sb_fail(report, SB_ERROR_RANGE, "lambda %g is below %g: the surfaces would overlap",
                   lambda, SB_GT_LAMBDA_MIN);
  }
  if (lambda > SB_GT_LAMBDA_MAX) {
    out->underflow = true;
    return sb_succeed(report);
  }
  double log_F[4];
  sb_gt_log_integrals(log_F, lambda);
  out->F2 = exp(log_F[2]);
  out->F5_2 = exp(log_F[3]);
  return sb_succeed(report);
}

double sb_gt_area_share(double product, double lambda) {
  SbGtIntegrals F;
  if (lambda >= 0 && lambda < 4) {
    const double phi = exp(-lambda * lambda / 2) / sqrt(2 * M_PI);
    F.F2 = (1 + lambda * lambda) * erfc(lambda / M_SQRT2) / 2 - lambda * phi;
  } else if (sb_gt_integrals(&F, lambda, NULL) != SB_OK) {
    return NAN;
  }
  return fmin(1, M_PI * M_PI * product * product * F.F2);
}

double sb_gt_pressure(double product, double sigma_over_beta, double modulus, double lambda) {
  SbGtIntegrals F;
  return sb_gt_integrals(&F, lambda, NULL) == SB_OK ? 8 * M_SQRT2 / 15 * M_PI * product * product *
                                                          sqrt(sigma_over_beta) * modulus * F.F5_2
                                                    : NAN;
}
