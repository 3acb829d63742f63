// Legendre polynomials: Gauss and Lobatto points by Newton from Chebyshev's, Lagrange bases in
// barycentric form (Berrut and Trefethen, SIAM Review 46, 2004). Meant for degrees below about 60.
#include "engine/numeric/legendre.h"

#include <assert.h>
#include <gsl/gsl_sf_legendre.h>
#include <math.h>
#include <stdbool.h>

// Newton's method from r for a root of P_n, or of its derivative where `extremum`, by Legendre's
// equation for the second one; *slope is that of P_n there.
static double refine(double *slope, double r, int n, bool extremum) {
  enum { DEGREE_MAX = 128 };
  double value[DEGREE_MAX + 1], rise[DEGREE_MAX + 1], step = 1.0;
  assert(n <= DEGREE_MAX);
  for (int pass = 0; pass < 12 && fabs(step) >= 1e-16; pass++) {
    (void)gsl_sf_legendre_Pl_deriv_array(n, r, value, rise);
    const double bend = (2.0 * r * rise[n] - n * (n + 1.0) * value[n]) / ((1.0 - r) * (1.0 + r));
    step = extremum ? rise[n] / bend : value[n] / rise[n];
    r -= step;
  }
  *slope = rise[n];
  return r;
}

void sb_legendre_gauss(double *node, double *weight, int n) {
  for (int i = 0; i < n; i++) {
    double slope;
    const double r = node[i] = refine(&slope, -cos(M_PI * (i + 0.75) / (n + 0.5)), n, false);
    weight[i] = 2.0 / ((1.0 - r) * (1.0 + r) * slope * slope);
  }
}

void sb_legendre_lobatto(double *node, int n) {
  node[0] = -1.0;
  node[n] = 1.0;
  for (int i = 1; i < n; i++) {
    double slope;
    node[i] = refine(&slope, -cos(M_PI * i / n), n, true);
  }
}

void sb_chebyshev_coefficients(double *out, const double *value, int n) {
  for (int k = 0; k < n; k++) {
    out[k] = 0.0;
    for (int i = 0; i < n; i++) {
      out[k] += (k == 0 ? 1.0 : 2.0) / n * value[i] * cos(k * (M_PI - M_PI * (i + 0.5) / n));
    }
  }
}

// int T_1 = z^2/2, int T_k = T_{k+1}/(2 (k + 1)) - T_{k-1}/(2 (k - 1)).
void sb_chebyshev_integrals(double *out, double z, int n) {
  out[0] = z;
  double before = 1.0, now = z; // T_{k-1}, T_k
  for (int k = 1; k < n; k++) {
    const double next = 2.0 * z * now - before;
    out[k] = k == 1 ? 0.5 * z * z : 0.5 * (next / (k + 1) - before / (k - 1));
    before = now;
    now = next;
  }
}

void sb_barycentric_weights(double *weight, const double *node, int count) {
  for (int i = 0; i < count; i++) {
    double product = 1.0;
    for (int j = 0; j < count; j++) {
      if (j != i) {
        product *= 2.0 * (node[i] - node[j]);
      }
    }
    weight[i] = 1.0 / product;
  }
}

void sb_barycentric_basis(double *basis, double r, const double *node, const double *weight,
                          int count) {
  double sum = 0.0;
  for (int i = 0; i < count; i++) {
    double distance = r - node[i];
    if (distance == 0.0) {
      for (int j = 0; j < count; j++) {
        basis[j] = j == i ? 1.0 : 0.0;
      }
      return;
    }
    basis[i] = weight[i] / distance;
    sum += basis[i];
  }
  for (int i = 0; i < count; i++) {
    basis[i] /= sum;
  }
}

void sb_barycentric_slope(double *slope, double r, const double *node, const double *weight,
                          int count) {
  // l_i = w_i product of 2 (r - x_j) over j != i, the weights' scale; logarithmic derivatives, with
  // the factor of the nearest node m, which may vanish, taken out.
  int m = 0;
  for (int i = 1; i < count; i++) {
    m = fabs(r - node[i]) < fabs(r - node[m]) ? i : m;
  }
  double product = 1.0, sum = 0.0; // over j != m, of 1 / (r - x_j)
  for (int j = 0; j < count; j++) {
    product *= j != m ? 2.0 * (r - node[j]) : 1.0;
    sum += j != m ? 1.0 / (r - node[j]) : 0.0;
  }
  for (int i = 0; i < count; i++) {
    double inverse = 1.0 / (r - node[i]);
    double rest = (1.0 + (r - node[m]) * (sum - inverse)) * inverse;
    slope[i] = weight[i] * product * (i == m ? sum : rest);
  }
}
