// Critical constriction; see percolation.h.
#include "engine/contact/rough/percolation.h"

#include <math.h>

// Where erf(x) = 0.42.
static double threshold_argument(void) {
  double low = 0;
  double high = 1;
  for (int i = 0; i < 100; i++) {
    double x = (low + high) / 2;
    if (erf(x) < SB_PERCOLATION_THRESHOLD) {
      low = x;
    } else {
      high = x;
    }
  }
  return (low + high) / 2;
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
  double low = log(s->q0);
  double high = log(s->q1);
  for (int i = 0; i < 100; i++) {
    double middle = (low + high) / 2;
    if (sb_spectrum_slope2(s, exp(middle)) < critical * critical) {
      low = middle;
    } else {
      high = middle;
    }
  }
  out->constriction_q = exp((low + high) / 2);
  out->constriction_size = 2 * M_PI / out->constriction_q;
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
  out->closing_pressure = threshold_argument() * p->modulus / 2 * s->slope / M_SQRT2;
  constriction(out, p, p->contact_pressure);
  if (out->percolates && out->leak_rate > 0 && p->contact_pressure > 0) {
    SbPercolation less = *out;
    double step = 1e-3;
    constriction(&less, p, p->contact_pressure * (1 - step));
    out->sensitivity = (log(out->leak_rate) - log(less.leak_rate)) / -log(1 - step);
  }
  return sb_succeed(report);
}
