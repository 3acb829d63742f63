// Critical constriction; see percolation.h.
#include "engine/contact/rough/percolation.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

// Where erf(x) is the threshold.
static double threshold_argument(void) {
  return gsl_cdf_ugaussian_Pinv(0.5 * (1 + SB_PERCOLATION_THRESHOLD)) / M_SQRT2;
}

double sb_percolation_closing_pressure(const SbSpectrum *s, double modulus) {
  return threshold_argument() * modulus / 2 * s->slope / M_SQRT2;
}

// Gap u_1 where surfaces just lose contact at wave number q: u + (du/dq) A/(dA/dq) with u the mean
// separation (Yang & Persson, equation for u_1).
static double local_gap(const SbPercolationProblem *p, double q, double pressure) {
  double step = 1e-3;
  double a = q * exp(-step);
  double b = q * exp(step);
  double u = sb_persson_separation(p->spectrum, q, p->modulus, pressure);
  double du = sb_persson_separation(p->spectrum, b, p->modulus, pressure) -
              sb_persson_separation(p->spectrum, a, p->modulus, pressure);
  double A = sb_persson_area_share(p->spectrum, q, p->modulus, pressure);
  double dA = sb_persson_area_share(p->spectrum, b, p->modulus, pressure) -
              sb_persson_area_share(p->spectrum, a, p->modulus, pressure);
  return fmax(u + du * A / dA, 0);
}

static void constriction(SbPercolation *out, const SbPercolationProblem *p, double pressure) {
  const SbSpectrum *s = p->spectrum;
  double critical = M_SQRT2 * pressure / (p->modulus / 2 * threshold_argument());
  out->percolates = critical < s->slope;
  out->leak_rate = 0;
  if (!out->percolates) {
    return;
  }
  out->constriction_q = sb_spectrum_wave(s, pow(critical / s->slope, 2));
  out->constriction_gap = local_gap(p, out->constriction_q, pressure);
  out->leak_rate = pow(out->constriction_gap, 3) / (12 * p->viscosity) * p->pressure_drop *
                   p->circumference / p->width;
}

SbStatus sb_percolation_solve(SbPercolation *out, const SbPercolationProblem *p, SbReport *report) {
  *out = (SbPercolation){0};
  if (!(p->modulus > 0 && p->viscosity > 0 && p->width > 0 && p->contact_pressure >= 0)) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "modulus, viscosity, width and pressure must be positive");
  }
  const SbSpectrum *s = p->spectrum;
  out->real_share = sb_persson_area_share(s, s->q1, p->modulus, p->contact_pressure);
  out->closing_pressure = sb_percolation_closing_pressure(s, p->modulus);
  constriction(out, p, p->contact_pressure);
  if (out->percolates && out->leak_rate > 0 && p->contact_pressure > 0) {
    SbPercolation less = *out;
    double step = 1e-3;
    constriction(&less, p, p->contact_pressure * (1 - step));
    out->sensitivity = (log(out->leak_rate) - log(less.leak_rate)) / -log(1 - step);
  }
  return sb_succeed(report);
}
