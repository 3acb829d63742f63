// Persson's theory for one self-affine spectrum; sources and equations in persson.h.
//
// The outer integral over wave number is a midpoint rule of 240 panels in a variable that removes
// the singular start (second order). The inner one over pressure depends on one number only, a = w
// p / E*, and is tabled by Simpson's rule: G(a) = integral_a^inf [gamma + 3 (1 - gamma) erf(x)^2]
// exp(-x^2)/x dx.
#include "engine/contact/rough/persson.h"

#include "engine/contact/inputs.h"
#include "engine/numeric/root.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

static const double HURST = 0.8, GAMMA = 0.45;

// integral of q^n C q dq 2 pi between a and b for C = q^(-2(H+1)): the power is n - 2H.
static double moment(double hurst, double n, double a, double b) {
  double power = n - 2 * hurst;
  return 2 * M_PI * (pow(b, power) - pow(a, power)) / power;
}

// Returns the difference of Nayak's breadth from the wanted one, for a spectrum with the exponent
// HURST from 1 to exp(x).
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
    return sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_ASPERITY_PRODUCT,
                         "no random surface has an asperity product of %g; it must exceed 0.025",
                         product);
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

// Returns h'(q)^2, the mean-square slope of the components up to the wave number q [1/m], which is
// limited to the range from q0 to q1.
static double slope_square(const SbSpectrum *s, double q) {
  q = fmin(fmax(q, s->q0), s->q1);
  return s->amplitude * moment(s->hurst, 2, s->q0, q);
}

double sb_spectrum_wave(const SbSpectrum *s, double part) {
  // The mean-square slope grows as q^(2 - 2H), from nothing at q0.
  const double power = 2 - 2 * s->hurst;
  return pow((1 - part) * pow(s->q0, power) + part * pow(s->q1, power), 1 / power);
}

double sb_spectrum_height_beyond(const SbSpectrum *s, double q) {
  return sqrt(s->amplitude * moment(s->hurst, 0, fmin(fmax(q, s->q0), s->q1), s->q1));
}

double sb_persson_area_share(const SbSpectrum *s, double q, double modulus, double pressure) {
  double slope2 = slope_square(s, q);
  if (slope2 <= 0) {
    return 1;
  }
  return erf(M_SQRT2 * pressure / (modulus / 2 * sqrt(slope2)));
}

double sb_persson_pressure(const SbSpectrum *s, double q, double modulus, double share) {
  // erf(x) is the probability of a standard normal between -x sqrt 2 and x sqrt 2.
  double argument = -gsl_cdf_ugaussian_Pinv(0.5 * (1 - share)) / M_SQRT2;
  return share < 1 ? argument * modulus / 2 * sqrt(slope_square(s, q)) / M_SQRT2 : INFINITY;
}

static double inner_integrand(double a) {
  double e = erf(a);
  return (GAMMA + 3 * (1 - GAMMA) * e * e) * exp(-a * a); // times d ln a
}

void sb_persson_gap_init(SbPerssonGap *gap, const SbSpectrum *s, double q) {
  // The inner integral, summed downwards from a = 6.2, where it is 1e-18.
  enum { INNER = SB_PERSSON_INNER, SUB = 4 };
  gap->begin = log(1e-4);
  gap->step = (log(6.2) - gap->begin) / (INNER - 1);
  double G = inner_integrand(6.2) / (2 * 6.2 * 6.2);
  double h = gap->step / SUB;
  for (int i = INNER - 1; i >= 0; i--) {
    double x = gap->begin + gap->step * i;
    for (int k = 0; k < SUB && i < INNER - 1; k += 2) {
      G += h / 3 *
           (inner_integrand(exp(x + h * k)) + 4 * inner_integrand(exp(x + h * (k + 1))) +
            inner_integrand(exp(x + h * (k + 2))));
    }
    gap->value[i] = log(G);
    gap->slope[i] = -inner_integrand(exp(x)) / G;
  }
  sb_persson_gap_move(gap, s, q);
}

void sb_persson_gap_move(SbPerssonGap *gap, const SbSpectrum *s, double q) {
  enum { PANELS = SB_PERSSON_PANELS };
  // u = sqrt(pi) int q^2 C w G dq with w = (pi int_q k^3 C)^(-1/2) = (slope2/2)^(-1/2). The start
  // is an integrable singularity of w, removed by integrating over v^2.
  q = fmin(fmax(q, s->q0), s->q1);
  double base = slope_square(s, q), length = log(s->q1 / q);
  for (int i = 0; i < PANELS; i++) {
    double v = (i + 0.5) / PANELS;
    double k = q * exp(length * v * v);
    double w = sqrt(2 / fmax(slope_square(s, k) - base, 1e-300));
    double spectrum = s->amplitude * pow(k, -2 * (s->hurst + 1));
    gap->log_w[i] = log(w);
    gap->weight[i] =
        length > 0 ? sqrt(M_PI) * k * k * k * spectrum * w * 2 * v * length / PANELS : 0;
  }
}

// G at ln a, and dG/d ln a.
static double inner(double *slope, const SbPerssonGap *gap, double log_a) {
  enum { LAST = SB_PERSSON_INNER - 1 };
  double f = (log_a - gap->begin) / gap->step;
  if (f <= 0) {
    // The exponential integral and a constant remainder: the integrand is gamma below.
    *slope = -GAMMA;
    return exp(gap->value[0]) + GAMMA * (gap->begin - log_a);
  }
  // Beyond the end it is steeper than any power; a straight line suffices at 1e-18.
  int i = (int)fmin(f, LAST - 1);
  double log_G = sb_hermite(slope, fmin(f - i, 1), gap->step, &gap->value[i], &gap->slope[i]);
  double G = exp(log_G + fmax(f - LAST, 0) * gap->step * *slope);
  *slope *= G;
  return G;
}

double sb_persson_gap_at(double *slope, const SbPerssonGap *gap, double log_p) {
  double sum = 0;
  *slope = 0;
  for (int i = 0; i < SB_PERSSON_PANELS; i++) {
    double by;
    sum += gap->weight[i] * inner(&by, gap, gap->log_w[i] + log_p);
    *slope += gap->weight[i] * by;
  }
  return sum;
}

double sb_persson_separation(const SbSpectrum *s, double q, double modulus, double pressure) {
  SbPerssonGap gap;
  sb_persson_gap_init(&gap, s, q);
  double share = fmax(sb_persson_area_share(s, q, modulus, pressure), 1e-300), slope;
  // Without pressure the surfaces part without bound.
  return sb_persson_gap_at(&slope, &gap, log(fmax(2 * pressure / modulus / share, 1e-140)));
}
