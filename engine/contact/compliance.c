// Polynomials of a surface compliance: values, integrals, fits; the linear disc's. See the header.
//
// Chebyshev's polynomials over the window, by their recurrences; least squares by normal equations,
// which are well conditioned for them. What a contact on such a surface does: dry_contact.c.
#include "engine/contact/compliance.h"

#include <math.h>
#include <string.h>

#include "engine/contact/disc/disc_kernel.h"
#include "engine/numeric/dense.h"

double sb_compliance_half_plane(const SbSurfaceCompliance *c) {
  return 4.0 / (M_PI * c->modulus);
}

void sb_compliance_modes(const SbSurfaceCompliance *c, double x, double *value, double *slope) {
  const double half = 0.5 * (c->right - c->left);
  const double z = (x - 0.5 * (c->left + c->right)) / half;
  const double t = fmin(fmax(z, -1.0), 1.0);
  const double factor = fabs(z - t) < 1e-12 ? 1.0 / half : 0.0;
  value[0] = 1.0;
  double u = 1.0; // U_{k-1}
  double u_before = 0.0;
  if (slope != NULL) {
    slope[0] = 0.0;
  }
  for (int k = 1; k < c->modes; k++) {
    value[k] = k == 1 ? t : 2.0 * t * value[k - 1] - value[k - 2];
    if (slope != NULL) {
      slope[k] = factor * k * u;
    }
    const double next = 2.0 * t * u - u_before;
    u_before = u;
    u = next;
  }
}

// int T_0 = z, int T_1 = z^2/2, int T_k = T_{k+1}/(2 (k + 1)) - T_{k-1}/(2 (k - 1)).
static void antiderivatives(double *out, int modes, double z) {
  double t[SB_COMPLIANCE_MODES + 1] = {1.0, z};
  for (int k = 2; k <= modes; k++) {
    t[k] = 2.0 * z * t[k - 1] - t[k - 2];
  }
  for (int k = 0; k < modes; k++) {
    out[k] = k == 0 ? z : k == 1 ? 0.5 * z * z : 0.5 * (t[k + 1] / (k + 1) - t[k - 1] / (k - 1));
  }
}

void sb_compliance_integrals(const SbSurfaceCompliance *c, double from, double to, double *out) {
  const double half = 0.5 * (c->right - c->left);
  const double middle = 0.5 * (c->left + c->right);
  double before[SB_COMPLIANCE_MODES];
  double after[SB_COMPLIANCE_MODES];
  antiderivatives(before, c->modes, fmin(fmax((from - middle) / half, -1.0), 1.0));
  antiderivatives(after, c->modes, fmin(fmax((to - middle) / half, -1.0), 1.0));
  for (int k = 0; k < c->modes; k++) {
    out[k] = half * (after[k] - before[k]);
  }
}

double sb_compliance_gap(const SbSurfaceCompliance *c, double x, double *slope) {
  double value[SB_COMPLIANCE_MODES];
  double derivative[SB_COMPLIANCE_MODES];
  const double inside = fmin(fmax(x, c->left), c->right);
  sb_compliance_modes(c, inside, value, derivative);
  double sum = 0.0;
  double sum_slope = 0.0;
  for (int k = 0; k < c->modes; k++) {
    sum += c->gap[k] * value[k];
    sum_slope += c->gap[k] * derivative[k];
  }
  const double rest = x - inside;
  if (rest != 0.0) {
    const double start = c->beyond[rest > 0.0 ? 1 : 0];
    const double bend = start / (inside - 0.5 * (c->left + c->right));
    sum += rest * (start + 0.5 * bend * rest);
    sum_slope = start + bend * rest;
  }
  if (slope != NULL) {
    *slope = sum_slope;
  }
  return sum;
}

double sb_compliance_smooth(const SbSurfaceCompliance *c, double x, const double *moment,
                            double *slope) {
  double value[SB_COMPLIANCE_MODES];
  double derivative[SB_COMPLIANCE_MODES];
  sb_compliance_modes(c, x, value, derivative);
  double sum = 0.0;
  double sum_slope = 0.0;
  for (int k = 0; k < c->modes; k++) {
    double row = 0.0;
    for (int l = 0; l < c->modes; l++) {
      row += c->smooth[k][l] * moment[l];
    }
    sum += value[k] * row;
    sum_slope += derivative[k] * row;
  }
  if (slope != NULL) {
    *slope = sum_slope;
  }
  return sum;
}

SbStatus sb_compliance_fit(SbSurfaceCompliance *out, int modes, double left, double right,
                           double modulus, size_t n, const double *x, const double *gap,
                           const double *smooth, SbReport *report) {
  memset(out, 0, sizeof *out);
  if (modes < 1 || modes > SB_COMPLIANCE_MODES || (size_t)modes > n || !(left < right) ||
      !(modulus > 0.0)) {
    return sb_fail(report, SB_ERROR_INPUT, "compliance: %d polynomials for %zu nodes", modes, n);
  }
  SbSurfaceCompliance *c = out;
  c->modes = modes;
  c->left = left;
  c->right = right;
  c->modulus = modulus;
  // Normal equations for every right-hand side: first the gap, then half the matrix, V+ S.
  const size_t m = (size_t)modes;
  double normal[SB_COMPLIANCE_MODES * SB_COMPLIANCE_MODES] = {0};
  double value[SB_COMPLIANCE_MODES];
  for (size_t i = 0; i < n; i++) {
    sb_compliance_modes(c, x[i], value, NULL);
    for (size_t k = 0; k < m; k++) {
      for (size_t l = 0; l < m; l++) {
        normal[l * m + k] += value[k] * value[l];
      }
    }
  }
  // The inverse, column by column: these systems are small.
  double inverse[SB_COMPLIANCE_MODES][SB_COMPLIANCE_MODES];
  double both[SB_COMPLIANCE_MODES][SB_COMPLIANCE_MODES]; // at first a copy to eliminate
  for (size_t k = 0; k < m; k++) {
    memcpy(both, normal, sizeof both);
    memset(inverse[k], 0, sizeof inverse[k]);
    inverse[k][k] = 1.0;
    if (!sb_eliminate(&both[0][0], inverse[k], m)) {
      memset(out, 0, sizeof *out);
      return sb_fail(report, SB_ERROR_INPUT, "compliance: the nodes do not fix the polynomials");
    }
  }
  double moment[SB_COMPLIANCE_MODES] = {0};
  memset(both, 0, sizeof both); // now V^T S V
  for (size_t i = 0; i < n; i++) {
    sb_compliance_modes(c, x[i], value, NULL);
    double row[SB_COMPLIANCE_MODES] = {0}; // of S V
    for (size_t j = 0; smooth != NULL && j < n; j++) {
      double other[SB_COMPLIANCE_MODES];
      sb_compliance_modes(c, x[j], other, NULL);
      for (size_t l = 0; l < m; l++) {
        row[l] += smooth[i * n + j] * other[l];
      }
    }
    for (size_t k = 0; k < m; k++) {
      moment[k] += gap != NULL ? gap[i] * value[k] : 0.0;
      for (size_t l = 0; l < m; l++) {
        both[k][l] += value[k] * row[l];
      }
    }
  }
  for (size_t k = 0; k < m; k++) {
    for (size_t a = 0; a < m; a++) {
      c->gap[k] += inverse[k][a] * moment[a];
      for (size_t l = 0; l < m; l++) {
        for (size_t b = 0; b < m; b++) {
          const double term = 0.5 * inverse[k][a] * both[a][b] * inverse[l][b];
          c->smooth[k][l] += term;
          c->smooth[l][k] += term;
        }
      }
    }
  }
  sb_compliance_gap(c, left, &c->beyond[0]);
  sb_compliance_gap(c, right, &c->beyond[1]);
  return sb_succeed(report);
}

// What the disc's surface has beside the half-plane's logarithm, S(x, x') for |x|, |x'| < R:
// smooth, in parts of the compliance 2 (1 - nu^2)/(pi E) (disc_kernel.h).
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
  double x[N];
  double gap[N];
  double smooth[N * N];
  for (int i = 0; i < N; i++) {
    x[i] = -reach * cos(M_PI * (i + 0.5) / N);
    const double s = x[i] / radius;
    gap[i] = x[i] * s / (1.0 + sqrt((1.0 - s) * (1.0 + s)));
  }
  for (int i = 0; i < N; i++) {
    for (int j = 0; j < N; j++) {
      smooth[i * N + j] = factor * (smooth_rest(radius, x[i], x[j]) + log(radius));
    }
  }
  return sb_compliance_fit(out, N, -reach, reach, 4.0 / (M_PI * factor), N, x, gap, smooth, report);
}
