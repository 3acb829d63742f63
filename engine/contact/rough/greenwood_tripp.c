// The integrals F_2 and F_5/2 without a polynomial fit.
//
// With t = s - lambda, F_n = phi(lambda) I_n and I_n = integral_0^inf t^n exp(-lambda t - t^2/2)
// dt. The substitution t = e^u turns the integrand into e^((n+1)u) exp(-lambda e^u - e^(2u)/2),
// analytic in the strip |Im u| < pi/4 and decaying at both ends, so that the trapezoidal rule
// converges exponentially: the error is about exp(-(2 pi/h)^2/(2 lambda^2)) for lambda = -10, below
// 1e-30 at h = 1/20. All terms are positive, so nothing cancels; factors are kept in the exponent
// so that nothing underflows early. The closed form F_2 = (1 + lambda^2) Q - lambda phi is not
// used: it cancels for lambda > 1.
#include "engine/contact/rough/greenwood_tripp.h"

#include <math.h>

// Trapezoidal sums of both orders in one pass. The peak of the exponent sets the scale.
static void integrate(double lambda, double *F2, double *F5_2) {
  const double h = 1.0 / 20;
  const double log_root_two_pi = 0.91893853320467274178;

  // The integrand t^n exp(-lambda t - t^2/2) (in u: t^(n+1)) peaks where n + 1 - lambda t - t^2 =
  // 0.
  double peak = (-lambda + sqrt(lambda * lambda + 13)) / 2;
  double top = 3.25 * log(peak) - lambda * peak - peak * peak / 2;

  // Downwards the terms fall as t^3 at least: e^-42 of the peak after 14 units of u. Upwards they
  // fall faster than exp(-t): stop when negligible.
  double u_peak = log(peak);
  double sum2 = 0;
  double sum5_2 = 0;
  for (int i = -280; i < 200; i++) {
    double u = u_peak + i * h;
    double t = exp(u);
    double exponent = -lambda * t - t * t / 2 - top;
    double term2 = exp(exponent + 3 * u);
    sum2 += term2;
    sum5_2 += term2 * sqrt(t);
    if (i > 0 && term2 < 1e-20 * sum2) {
      break;
    }
  }
  double scale = top - lambda * lambda / 2 - log_root_two_pi;
  *F2 = h * sum2 * exp(scale);
  *F5_2 = h * sum5_2 * exp(scale);
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
  integrate(lambda, &out->F2, &out->F5_2);
  return sb_succeed(report);
}

double sb_gt_area_share(double product, double F2) {
  return fmin(1, M_PI * M_PI * product * product * F2);
}

double sb_gt_pressure(double product, double sigma_over_beta, double modulus, double F5_2) {
  return 8 * M_SQRT2 / 15 * M_PI * product * product * sqrt(sigma_over_beta) * modulus * F5_2;
}
