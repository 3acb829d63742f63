// Mesh and elastic kernel of the transient film.
//
// Nodes crowd at both edges of the contact. The pressure is a straight line between nodes with the
// bend of its second differences; both are integrated against the logarithm exactly. A fitted body
// adds its smooth part through the moments of the nodes' hats (elastic/compliance.h).
#include <cblas.h>
#include <math.h>
#include <string.h>

#include "engine/film/ehl_layers.h"
#include "engine/film/transient_internal.h"
#include "engine/numeric/legendre.h"

static const double RESOLVED = 4.5e-3; // spacing for the dip of a reversal, 0.02 b wide
static const double CARRIED = 3.0;     // layers

// f'' = ln|y|.
static double second_integral(double y) {
  return y == 0.0 ? 0.0 : 0.5 * y * y * (log(fabs(y)) - 1.5);
}

static double first_integral(double y) {
  return y == 0.0 ? 0.0 : y * (log(fabs(y)) - 1.0);
}

// Integral of the straight line from 1 at `top` to 0 at `foot`, times ln|X - s|.
static double half_hat(double X, double top, double foot, const double *node, const double *weight,
                       int points) {
  const double h = fabs(foot - top);
  const double middle = 0.5 * (foot + top);
  if (fabs(X - middle) > 4.0 * h) {
    double sum = 0.0;
    for (int q = 0; q < points; q++) {
      sum += weight[q] * 0.5 * (1.0 - node[q]) *
             log(fabs(X - (middle + 0.5 * (foot - top) * node[q])));
    }
    return 0.5 * h * sum;
  }
  const double side = foot > top ? 1.0 : -1.0;
  return side * first_integral(X - top) +
         (second_integral(X - foot) - second_integral(X - top)) / h;
}

static double third_integral(double y) {
  return y == 0.0 ? 0.0 : y * y * y / 6.0 * (log(fabs(y)) - 11.0 / 6.0);
}

// Integral of the parabola (s - a)(b - s)/2 times ln|X - s|.
static double bubble(double X, double a, double b, const double *node, const double *weight,
                     int points) {
  const double h = b - a;
  const double middle = 0.5 * (a + b);
  if (fabs(X - middle) > 4.0 * h) {
    double sum = 0.0;
    for (int q = 0; q < points; q++) {
      sum += weight[q] * (1.0 - node[q] * node[q]) * log(fabs(X - middle - 0.5 * h * node[q]));
    }
    return h * h * h / 16.0 * sum;
  }
  return 0.5 * h * (second_integral(X - a) + second_integral(X - b)) - third_integral(X - a) +
         third_integral(X - b);
}

// Second difference of the pressure at node j: factors of j - 1, j, j + 1.
static void second_difference(double out[3], const SbFilmTransient *t, int j) {
  const double left = t->X[j] - t->X[j - 1];
  const double right = t->X[j + 1] - t->X[j];
  out[0] = 2.0 / (left * (left + right));
  out[2] = 2.0 / (right * (left + right));
  out[1] = -out[0] - out[2];
}

static void build_kernel(SbFilmTransient *t) {
  enum { POINTS = 6 };
  double node[POINTS];
  double weight[POINTS];
  sb_legendre_gauss(node, weight, POINTS);
  const int n = t->nodes;
  for (int i = 0; i < n; i++) {
    double *row = t->kernel + (size_t)i * (size_t)n;
    memset(row, 0, (size_t)n * sizeof *row);
    for (int j = 0; j + 1 < n; j++) {
      row[j] -= half_hat(t->X[i], t->X[j], t->X[j + 1], node, weight, POINTS) / M_PI;
      row[j + 1] -= half_hat(t->X[i], t->X[j + 1], t->X[j], node, weight, POINTS) / M_PI;
      // The bend between the nodes: p = line - p'' (s - a)(b - s)/2, p'' the ends' mean.
      const double bend = bubble(t->X[i], t->X[j], t->X[j + 1], node, weight, POINTS) / M_PI;
      for (int k = j; k <= j + 1; k++) {
        if (k > 0 && k + 1 < n) {
          double d[3];
          second_difference(d, t, k);
          for (int m = 0; m < 3; m++) {
            row[k - 1 + m] += 0.5 * bend * d[m];
          }
        }
      }
    }
    t->known[i] = t->inlet / M_PI * first_integral(t->X[i] - t->X[0]) -
                  t->outlet / M_PI * first_integral(t->X[i] - t->X[n - 1]) +
                  (t->inlet - t->outlet) / M_PI * log(2.0) * t->X[i];
  }
}

// Half of the mesh from the middle outward, mirrored: spacing a share of the distance to the edge.
void sb_transient_mesh(SbFilmTransient *t, double rest) {
  SbEhlLayers layers = {.lambda = t->scale.lambda, .starvation = 1.0};
  memcpy(layers.bow, t->scale.bow, sizeof layers.bow);
  const double width = fmin(sb_ehl_layers_width(&layers), 2.0);
  const double fine =
      t->coarseness * cbrt(fmin(fmax(t->problem.film.tolerance, 1e-4), 1e-2) / 1e-3);
  const double share = 0.15 * fine;
  const double inner = t->problem.resolve ? 0.10 * fine : share;
  const double finest = 0.5 * width;
  const double reach = fmax(fmax(4.0, 60.0 * width), 6.0 * sqrt(2.0 * rest));
  double X[SB_TRANSIENT_NODES_MAX / 2];
  int n = 0;
  t->cell = (t->problem.resolve ? RESOLVED : 0.03) * fine;
  X[n++] = 0.0;
  while (X[n - 1] < 1.0 + reach && n < SB_TRANSIENT_NODES_MAX / 2 - 1) {
    double step = 0.0;
    for (int pass = 0; pass < 3; pass++) {
      const double at = X[n - 1] + 0.5 * step;
      const double d = hypot(at < 1.0 ? finest * share / inner : finest, at - 1.0);
      step = at < 1.0 ? inner * d / hypot(1.0, inner * d / t->cell) : share * d;
    }
    X[n] = X[n - 1] + step;
    n++;
  }
  t->nodes = 2 * n - 1;
  t->layer = width;
  for (int i = 0; i < n; i++) {
    t->X[n - 1 + i] = X[i];
    t->X[n - 1 - i] = -X[i];
  }
  for (int i = 0; i < t->nodes; i++) {
    const double left = i > 0 ? t->X[i] - t->X[i - 1] : 0.0;
    const double right = i + 1 < t->nodes ? t->X[i + 1] - t->X[i] : 0.0;
    t->volume[i] = t->weight[i] = 0.5 * (left + right);
    t->limited[i] = !t->problem.resolve && right > width && fabs(t->X[i]) < 1.0;
    // From CARRIED layers inside the edges on the faces move, after as many again with the fluid.
    const double inside = (1.0 - fabs(t->X[i] + 0.5 * right)) / (CARRIED * width) - 1.0;
    const double ramp = fmin(fmax(inside, 0.0), 1.0);
    t->carried[i] = 2.0 * CARRIED * width < 0.7 ? ramp * ramp * (3.0 - 2.0 * ramp) : 0.0;
  }
  for (int j = 0; j + 1 < t->nodes; j++) {
    const double h = t->X[j + 1] - t->X[j];
    for (int k = j; k <= j + 1; k++) {
      if (k > 0 && k + 1 < t->nodes) {
        double d[3];
        second_difference(d, t, k);
        for (int m = 0; m < 3; m++) {
          t->weight[k - 1 + m] -= 0.5 * h * h * h / 12.0 * d[m];
        }
      }
    }
  }
  t->reach = 0.3 * CARRIED * width;
  build_kernel(t);
}

// Smooth part of a fitted body on the nodes, added to `present` and its known gap: moments of the
// nodes' hats, S, and the polynomials at the nodes. Beyond the window the pressure counts as far as
// it differs from the ambient one. The constant is H0's.
static void add_smooth(SbFilmTransient *t, double half, double middle) {
  enum { POINTS = 3, MODES = SB_COMPLIANCE_MODES };
  const SbSurfaceCompliance *c = &t->compliance;
  const int n = t->nodes;
  const double b = t->scale.half_width;
  double node[POINTS];
  double weight[POINTS];
  sb_legendre_gauss(node, weight, POINTS);
  memset(t->moment, 0, sizeof t->moment);
  double value[MODES];
  for (int j = 0; j + 1 < n; j++) {
    const double h = t->X[j + 1] - t->X[j];
    for (int q = 0; q < POINTS; q++) {
      const double s = 0.5 * (1.0 + node[q]);
      sb_compliance_modes(c, b * (middle + half * (t->X[j] + s * h)), value, NULL);
      for (int k = 0; k < c->modes; k++) {
        t->moment[k][j] += half * 0.5 * h * weight[q] * (1.0 - s) * value[k];
        t->moment[k][j + 1] += half * 0.5 * h * weight[q] * s * value[k];
      }
    }
  }
  const double left = b * (middle + half * t->X[0]);
  const double right = b * (middle + half * t->X[n - 1]);
  double before[MODES], after[MODES], whole[MODES], at_left[MODES], at_right[MODES];
  sb_compliance_integrals(c, fmin(c->left, left), left, before);
  sb_compliance_integrals(c, right, fmax(c->right, right), after);
  sb_compliance_integrals(c, c->left, c->right, whole);
  sb_compliance_modes(c, c->left, at_left, NULL);
  sb_compliance_modes(c, c->right, at_right, NULL);
  double known[MODES];
  for (int k = 0; k < c->modes; k++) {
    known[k] = (t->inlet * (before[k] - fmax(c->left - left, 0.0) * at_left[k]) +
                t->outlet * (after[k] - fmax(right - c->right, 0.0) * at_right[k]) -
                fmin(t->inlet, t->outlet) * whole[k]) /
               b;
  }
  const double factor = 0.25 * c->modulus; // p_H b over the film's scale
  const double window = 0.5 * (c->right - c->left) / (half * b);
  const double tilt = -(t->inlet - t->outlet) / M_PI * log(window) * half;
  for (int i = 0; i < n; i++) {
    sb_compliance_modes(c, b * (middle + half * t->X[i]), value, NULL);
    double *row = t->present + (size_t)i * (size_t)n;
    t->present_known[i] += tilt * t->X[i];
    for (int l = 0; l < c->modes; l++) {
      double sum = 0.0;
      for (int k = 1; k < c->modes; k++) {
        sum += factor * value[k] * c->smooth[k][l];
      }
      t->present_known[i] += sum * known[l];
      cblas_daxpy(n, sum, t->moment[l], 1, row, 1);
    }
  }
}

void sb_transient_present(SbFilmTransient *t, double half, double middle) {
  if (half == t->present_half && middle == t->present_middle) {
    return;
  }
  const size_t n = (size_t)t->nodes;
  t->present_half = half;
  t->present_middle = middle;
  for (size_t i = 0; i < n * n; i++) {
    t->present[i] = half * t->kernel[i];
  }
  for (size_t i = 0; i < n; i++) {
    const double x = middle + half * t->X[i];
    t->present_known[i] = half * t->known[i];
    t->present_known[i] +=
        t->compliance.modes > 0
            ? sb_compliance_gap(&t->compliance, t->scale.half_width * x, NULL) / t->scale.film
            : 0.5 * x * x;
  }
  if (t->compliance.modes > 0) {
    add_smooth(t, half, middle);
  }
}

void sb_transient_gap(double *out, const SbFilmTransient *t, const SbTransientState *s) {
  for (int i = 0; i < t->nodes; i++) {
    out[i] = s->H0 + t->present_known[i];
  }
  cblas_dgemv(CblasRowMajor, CblasNoTrans, t->nodes, t->nodes, 1.0, t->present, t->nodes, s->P, 1,
              1.0, out, 1);
}

SbStatus sb_transient_place(double *half, double *middle, const SbFilmTransient *t, double load,
                            SbReport *report) {
  *half = sqrt(load / (0.5 * M_PI));
  *middle = 0.0;
  if (t->compliance.modes == 0) {
    return sb_succeed(report);
  }
  SbDryContact dry;
  const SbFilmProblem *p = &t->problem.film;
  const SbStatus status = sb_dry_contact(&dry, &t->compliance, load / (0.5 * M_PI) * p->load,
                                         p->pressure_left, p->pressure_right, report);
  *half = 0.5 * (dry.right - dry.left) / t->scale.half_width;
  *middle = 0.5 * (dry.right + dry.left) / t->scale.half_width;
  return status;
}
