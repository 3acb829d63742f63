// Persson's theory for one self-affine spectrum; sources and equations in persson.h.
//
// The outer integral over wave number is a midpoint rule of 240 panels in a variable that removes
// the singular start (second order), the inner one over pressure an exponential integral plus
// Simpson's rule.
#include "engine/contact/rough/persson.h"

#include "engine/numeric/root.h"

#include <gsl/gsl_sf_erf.h>
#include <gsl/gsl_sf_expint.h>
#include <math.h>

static const double HURST = 0.8;

// integral of q^n C q dq 2 pi between a and b for C = q^(-2(H+1)): the power is n - 2H.
static double moment(double hurst, double n, double a, double b) {
  double power = n - 2 * hurst;
  return 2 * M_PI * (pow(b, power) - pow(a, power)) / power;
}

// What a spectrum of hurst exponent HURST from 1 to exp(x) lacks of Nayak's breadth wanted.
static double missing_breadth(double x, const void *wanted) {
  double ratio = exp(x);
  return *(const double *)wanted - 1.5 * moment(HURST, 4, 1, ratio) * moment(HURST, 0, 1, ratio) /
                                       pow(moment(HURST, 2, 1, ratio), 2);
}

SbStatus sb_spectrum_from_asperities(SbSpectrum *out, double sigma, double sigma_over_beta,
                                     double product, SbReport *report) {
  *out = (SbSpectrum){0};
  if (!(sigma > 0 && sigma_over_beta > 0 && product > 0)) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "sigma, sigma/beta and the asperity product must be positive");
  }

  // Nayak's breadth alpha = m0 m4/m2^2 follows from zeta beta sigma = sqrt(alpha)/(16 sqrt(3 pi)).
  double root_alpha = product * 16 * sqrt(3 * M_PI);
  double alpha = root_alpha * root_alpha;
  if (alpha <= 1.5 * 1.0001) {
    return sb_fail_parameter(
        report, SB_ERROR_INFEASIBLE, "surface.gt_product",
        "no random surface has an asperity product of %g; it must exceed 0.025", product);
  }
  double m0 = sigma * sigma;
  double curvature = 3.0 / 8 * sigma_over_beta / sigma;
  double m4 = M_PI * curvature * curvature;
  double m2 = sqrt(m0 * m4) / root_alpha;

  // q1/q0 from alpha = (3/2) <q^4> <1>/<q^2>^2, which grows with the ratio.
  const double H = HURST;
  double ratio = exp(sb_bisect(missing_breadth, &alpha, 1e-6, 30));

  // q0 from <q^2> = 2 m2, amplitude from <1> = m0.
  double q0 = sqrt(2 * m2 / m0 * moment(H, 0, 1, ratio) / moment(H, 2, 1, ratio));
  out->sigma = sigma;
  out->slope = sqrt(2 * m2);
  out->hurst = H;
  out->q0 = q0;
  out->q1 = q0 * ratio;
  out->amplitude = m0 / moment(H, 0, out->q0, out->q1);
  return sb_succeed(report);
}

double sb_spectrum_slope2(const SbSpectrum *s, double q) {
  q = fmin(fmax(q, s->q0), s->q1);
  return s->amplitude * moment(s->hurst, 2, s->q0, q);
}

double sb_persson_area_share(const SbSpectrum *s, double q, double modulus, double pressure) {
  double slope2 = sb_spectrum_slope2(s, q);
  if (slope2 <= 0) {
    return 1;
  }
  return erf(M_SQRT2 * pressure / (modulus / 2 * sqrt(slope2)));
}

// Inner integral over p' from p to infinity of [gamma + 3 (1 - gamma) erf(w p'/E*)^2] exp(-(w
// p'/E*)^2)/p'. With t = (w p'/E*)^2 the first part is E1(t)/2; the second is small where the first
// is not and is summed over ln t by Simpson's rule, 48 intervals to where exp(-t) is nothing.
static double inner_integral(double a) {
  const double gamma = 0.45;
  // Without pressure the surfaces part without bound; GSL's integral must not be asked for that.
  double t0 = fmax(a * a, 1e-280);
  if (t0 > 600) {
    return 0;
  }
  double first = gamma * gsl_sf_expint_E1(t0) / 2;
  double u0 = log(fmax(t0, 1e-12));
  double u1 = log(t0 + 40);
  enum { N = 48 };
  double h = (u1 - u0) / N;
  double sum = 0;
  for (int i = 0; i <= N; i++) {
    double t = exp(u0 + i * h);
    double P = gsl_sf_erf(sqrt(t));
    double weight = i == 0 || i == N ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * P * P * exp(-t);
  }
  return first + 3 * (1 - gamma) * sum * h / 3 / 2;
}

double sb_persson_separation(const SbSpectrum *s, double q, double modulus, double pressure) {
  q = fmin(fmax(q, s->q0), s->q1);
  double E = modulus / 2;
  double p = pressure / fmax(sb_persson_area_share(s, q, modulus, pressure), 1e-300);
  double base = sb_spectrum_slope2(s, q);

  // u = sqrt(pi) int q^2 C w (inner) dq with w = (pi int_q k^3 C)^(-1/2) = (slope2/2)^(-1/2). The
  // start is an integrable singularity of w, removed by integrating over v^2.
  enum { PANELS = 240 };
  double length = log(s->q1 / q);
  double sum = 0;
  for (int i = 0; i < PANELS; i++) {
    double v = (i + 0.5) / PANELS;
    double k = q * exp(length * v * v);
    double slope2 = sb_spectrum_slope2(s, k) - base;
    if (slope2 <= 0) {
      continue;
    }
    double w = sqrt(2 / slope2);
    double spectrum = s->amplitude * pow(k, -2 * (s->hurst + 1));
    sum += k * k * k * spectrum * w * inner_integral(w * p / E) * 2 * v * length / PANELS;
  }
  return sqrt(M_PI) * sum;
}
