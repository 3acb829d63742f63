// Mesh and elastic kernel of the transient film.
//
// Nodes crowd at both edges of the contact. The pressure is a straight line between nodes with the
// bend of its second differences; both are integrated against the logarithm exactly. A fitted body
// adds its smooth part through the moments of the nodes' hats (elastic/compliance.h).
#include <cblas.h>
#include <math.h>
#include <string.h>

#include "engine/film/ehl.h"
#include "engine/film/ehl_transient.h"
#include "engine/numeric/legendre.h"

static const double RESOLVED = 4.5e-3; // spacing for the dip of a reversal, 0.02 b wide
static const double CARRIED = 3.0;     // layers

// Second difference of the pressure at node j: factors of j - 1, j, j + 1.
static void second_difference(double out[3], const SbFilmTransient *t, int j) {
  const double left = t->X[j] - t->X[j - 1];
  const double right = t->X[j + 1] - t->X[j];
  out[0] = 2.0 / (left * (left + right));
  out[2] = 2.0 / (right * (left + right));
  out[1] = -out[0] - out[2];
}

// Adds to `row` the integral over the interval after node j, whose quadratic polynomials through
// its ends and its middle have the integrals `part`: there the pressure is the ends' mean less
// p'' h^2 / 8 with the mean p'' of the ends.
static void add_interval(double *row, const SbFilmTransient *t, int j, const double *part,
                         double factor) {
  const double h = t->X[j + 1] - t->X[j];
  row[j] += factor * (part[0] + 0.5 * part[1]);
  row[j + 1] += factor * (part[2] + 0.5 * part[1]);
  for (int k = j; k <= j + 1; k++) {
    if (k > 0 && k + 1 < t->nodes) {
      double d[3];
      second_difference(d, t, k);
      for (int m = 0; m < 3; m++) {
        row[k - 1 + m] -= factor * part[1] * h * h / 16.0 * d[m];
      }
    }
  }
}

// Smooth part of a fitted body on the nodes, added to the kernel and the known gap, as in
// ehl_fitted.c: moments of the nodes' hats inside the window, S, and the polynomials at the nodes.
// The constant is H0's.
static void add_smooth(SbFilmTransient *t) {
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
    const double x = b * (t->middle + t->X[j]);
    const double h = t->X[j + 1] - t->X[j];
    const double from = fmax((c->left - x) / (b * h), 0.0);
    const double to = fmin((c->right - x) / (b * h), 1.0);
    for (int q = 0; q < POINTS && from < to; q++) {
      const double s = 0.5 * (from + to) + 0.5 * (to - from) * node[q];
      sb_compliance_modes(c, x + s * b * h, value, NULL);
      for (int k = 0; k < c->modes; k++) {
        const double part = 0.5 * (to - from) * h * weight[q] * value[k];
        t->moment[k][j] += part * (1.0 - s);
        t->moment[k][j + 1] += part * s;
      }
    }
  }
  double known[MODES] = {0}, by_axis[MODES] = {0};
  const SbFilmBody body = {c, 1.0, b, t->scale.film};
  sb_film_ambient(known, by_axis, &body, t->inlet, t->outlet, t->middle + t->X[0],
                  t->middle + t->X[n - 1]);
  const double tilt = sb_film_window_tilt(&body, t->inlet, t->outlet);
  const double factor = 0.25 * c->modulus; // p_H b over the film's scale
  for (int i = 0; i < n; i++) {
    sb_compliance_modes(c, b * (t->middle + t->X[i]), value, NULL);
    double *row = t->kernel + (size_t)i * (size_t)n;
    t->known[i] += tilt * t->X[i];
    for (int l = 0; l < c->modes; l++) {
      double sum = 0.0;
      for (int k = 1; k < c->modes; k++) {
        sum += factor * value[k] * c->smooth[k][l];
      }
      t->known[i] += sum * known[l];
      cblas_daxpy(n, sum, t->moment[l], 1, row, 1);
    }
  }
}

// Kernel and weights of the load, interval by interval as an element of `solver`'s meshes.
static void build_kernel(SbFilmTransient *t, SbFilmSolver *solver) {
  enum { QUADRATIC = 2 };
  const size_t n = (size_t)t->nodes;
  SbEhlMesh *mesh = &solver->solution[0].mesh;
  SbEhlElement *e = &mesh->element[0];
  memset(t->kernel, 0, n * n * sizeof *t->kernel);
  memset(t->weight, 0, sizeof t->weight);
  for (int j = 0; j + 1 < t->nodes; j++) {
    sb_ehl_mesh_begin(mesh, t->X[j], 0.0, 0.0);
    sb_ehl_mesh_add(mesh, SB_EHL_AFFINE, t->X[j + 1], QUADRATIC);
    sb_ehl_kernel_prepare(e, &solver->tables);
    add_interval(t->weight, t, j, e->integral, 1.0);
    for (size_t i = 0; i < n; i++) {
      double part[SB_EHL_DEGREE_MAX + 2] = {0};
      sb_ehl_kernel_row(part, e, &solver->tables, t->X[i]);
      add_interval(t->kernel + i * n, t, j, part, -1.0 / M_PI);
    }
  }
  for (size_t i = 0; i < n; i++) {
    const double x = t->middle + t->X[i];
    t->known[i] = sb_ehl_ambient_gap(t->X[i], t->X[0], t->X[n - 1], t->inlet, t->outlet);
    t->known[i] +=
        t->compliance.modes > 0
            ? sb_compliance_gap(&t->compliance, t->scale.half_width * x, NULL) / t->scale.film
            : 0.5 * x * x;
  }
  if (t->compliance.modes > 0) {
    add_smooth(t);
  }
}

SbEhlLayers sb_transient_layers(const SbFilmTransient *t) {
  SbEhlLayers layers = {.lambda = t->scale.lambda, .starvation = 1.0};
  memcpy(layers.bow, t->scale.bow, sizeof layers.bow);
  return layers;
}

// Half of the mesh from the middle outward, mirrored: spacing a share of the distance to the edge.
void sb_transient_mesh(SbFilmTransient *t, SbFilmSolver *solver, double rest) {
  const SbEhlLayers layers = sb_transient_layers(t);
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
    t->volume[i] = 0.5 * (left + right);
    t->limited[i] = !t->problem.resolve && right > width && fabs(t->X[i]) < 1.0;
    // From CARRIED layers inside the edges on the faces move, after as many again with the fluid.
    const double inside = (1.0 - fabs(t->X[i] + 0.5 * right)) / (CARRIED * width) - 1.0;
    const double ramp = fmin(fmax(inside, 0.0), 1.0);
    t->carried[i] = 2.0 * CARRIED * width < 0.7 ? ramp * ramp * (3.0 - 2.0 * ramp) : 0.0;
  }
  t->reach = 0.3 * CARRIED * width;
  build_kernel(t, solver);
}

void sb_transient_gap(double *out, const SbFilmTransient *t, const SbTransientState *s) {
  for (int i = 0; i < t->nodes; i++) {
    out[i] = s->H0 + t->known[i];
  }
  cblas_dgemv(CblasRowMajor, CblasNoTrans, t->nodes, t->nodes, 1.0, t->kernel, t->nodes, s->P, 1,
              1.0, out, 1);
}
