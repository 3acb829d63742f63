// Polynomials of a surface compliance: values, integrals; the linear disc's. See the header.
//
// Chebyshev's polynomials over the window, by their recurrences. What a contact on such a surface
// does: dry_contact.c.
#include "engine/contact/compliance.h"

#include <math.h>
#include <string.h>

#include "engine/contact/disc/disc_kernel.h"
#include "engine/numeric/legendre.h"

double sb_compliance_half_plane(const SbSurfaceCompliance *c) {
  return 4.0 / (M_PI * c->modulus);
}

// At n places side by side, T_k at x[i] in value[k n + i]: a constant n is a loop without branches.
static inline void find_modes(const SbSurfaceCompliance *c, int n, const double *x, double *value,
                              double *slope) {
  const double half = 0.5 * (c->right - c->left), middle = 0.5 * (c->left + c->right);
  double t[SB_COMPLIANCE_TOGETHER], factor[SB_COMPLIANCE_TOGETHER], u[SB_COMPLIANCE_TOGETHER],
      before[SB_COMPLIANCE_TOGETHER];
  for (int i = 0; i < n; i++) {
    const double z = (x[i] - middle) / half;
    t[i] = fmin(fmax(z, -1.0), 1.0);
    factor[i] = fabs(z - t[i]) < 1e-12 ? 1.0 / half : 0.0;
    value[i] = 1.0;
    u[i] = 1.0; // U_{k-1}
    before[i] = 0.0;
    if (slope != NULL) {
      slope[i] = 0.0;
    }
  }
  for (int k = 1; k < c->modes; k++) {
    double *now = value + k * n;
    for (int i = 0; i < n; i++) {
      now[i] = k == 1 ? t[i] : 2.0 * t[i] * now[i - n] - now[i - 2 * n];
    }
    for (int i = 0; i < n && slope != NULL; i++) {
      slope[k * n + i] = factor[i] * k * u[i];
      const double next = 2.0 * t[i] * u[i] - before[i];
      before[i] = u[i];
      u[i] = next;
    }
  }
}

void sb_compliance_modes(const SbSurfaceCompliance *c, double x, double *value, double *slope) {
  find_modes(c, 1, &x, value, slope);
}

void sb_compliance_modes_together(const SbSurfaceCompliance *c, const double *x,
                                  double (*value)[SB_COMPLIANCE_TOGETHER],
                                  double (*slope)[SB_COMPLIANCE_TOGETHER]) {
  find_modes(c, SB_COMPLIANCE_TOGETHER, x, value[0], slope[0]);
}

void sb_compliance_integrals(const SbSurfaceCompliance *c, double from, double to, double *out) {
  const double half = 0.5 * (c->right - c->left), middle = 0.5 * (c->left + c->right);
  double before[SB_COMPLIANCE_MODES];
  sb_chebyshev_integrals(before, fmin(fmax((from - middle) / half, -1.0), 1.0), c->modes);
  sb_chebyshev_integrals(out, fmin(fmax((to - middle) / half, -1.0), 1.0), c->modes);
  for (int k = 0; k < c->modes; k++) {
    out[k] = half * (out[k] - before[k]);
  }
}

// The sum of coefficients times polynomials at x, and its slope.
static double sum_at(const SbSurfaceCompliance *c, const double *coefficient, double x,
                     double *slope) {
  double value[SB_COMPLIANCE_MODES];
  double derivative[SB_COMPLIANCE_MODES];
  sb_compliance_modes(c, x, value, derivative);
  double sum = 0.0;
  *slope = 0.0;
  for (int k = 0; k < c->modes; k++) {
    sum += coefficient[k] * value[k];
    *slope += coefficient[k] * derivative[k];
  }
  return sum;
}

double sb_compliance_gap(const SbSurfaceCompliance *c, double x, double *slope) {
  const double inside = fmin(fmax(x, c->left), c->right), rest = x - inside;
  double here;
  double sum = sum_at(c, c->gap, inside, &here);
  if (rest != 0.0) {
    const double start = c->beyond[rest > 0.0 ? 1 : 0];
    const double bend = start / (inside - 0.5 * (c->left + c->right));
    sum += rest * (start + 0.5 * bend * rest);
    here = start + bend * rest;
  }
  if (slope != NULL) {
    *slope = here;
  }
  return sum;
}

double sb_compliance_smooth(const SbSurfaceCompliance *c, double x, const double *moment,
                            double *slope) {
  double coefficient[SB_COMPLIANCE_MODES], here;
  for (int k = 0; k < c->modes; k++) {
    coefficient[k] = 0.0;
    for (int l = 0; l < c->modes; l++) {
      coefficient[k] += c->smooth[k][l] * moment[l];
    }
  }
  const double sum = sum_at(c, coefficient, x, &here);
  if (slope != NULL) {
    *slope = here;
  }
  return sum;
}

// The disc's surface compliance minus the half-plane's logarithm, S(x, x') for |x|, |x'| < R. It is
// smooth. The terms are in units of the compliance 2 (1 - nu^2)/(pi E) (disc_kernel.h).
static double smooth_rest(double radius, double x, double x_prime) {
  const SbDiscPoint to = sb_disc_point_at(x / radius);
  const SbDiscPoint from = sb_disc_point_at(x_prime / radius);
  // 2 ln cos((theta + phi)/2) = ln((1 + cos(theta + phi))/2).
  return log(1.0 + to.cos * from.cos - to.sin * from.sin) - to.cos * from.cos;
}

SbStatus sb_compliance_disc(SbSurfaceCompliance *out, double radius, double modulus,
                            double poisson_ratio, double reach, SbReport *report) {
  memset(out, 0, sizeof *out);
  if (!(reach > 0.0 && reach < 0.95 * radius) || !(modulus > 0.0)) {
    return sb_fail(report, SB_ERROR_RANGE, "compliance: a window of +-%g m on a disc of radius %g",
                   reach, radius);
  }
  enum { N = SB_COMPLIANCE_MODES };
  const double factor = sb_disc_compliance(modulus, poisson_ratio);
  double x[N], gap[N], answer[N][N];
  for (int i = 0; i < N; i++) {
    x[i] = -reach * cos(M_PI * (i + 0.5) / N);
    const double s = x[i] / radius;
    gap[i] = x[i] * s / (1.0 + sqrt((1.0 - s) * (1.0 + s)));
  }
  *out = (SbSurfaceCompliance){
      .modes = N, .left = -reach, .right = reach, .modulus = 4.0 / (M_PI * factor)};
  sb_chebyshev_coefficients(out->gap, gap, N);
  // The smooth part over both places: by one, then by the other.
  for (int i = 0; i < N; i++) {
    double row[N];
    for (int j = 0; j < N; j++) {
      row[j] = factor * (smooth_rest(radius, x[i], x[j]) + log(radius));
    }
    sb_chebyshev_coefficients(answer[i], row, N);
  }
  for (int l = 0; l < N; l++) {
    double column[N];
    for (int i = 0; i < N; i++) {
      column[i] = answer[i][l];
    }
    sb_chebyshev_coefficients(out->smooth[l], column, N); // symmetric
  }
  sb_compliance_gap(out, -reach, &out->beyond[0]);
  sb_compliance_gap(out, reach, &out->beyond[1]);
  return sb_succeed(report);
}
