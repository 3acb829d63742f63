// Mesh and elastic kernel of the transient film.
//
// Nodes crowd at both edges of the contact. Between two nodes the pressure is the parabola through
// them and the value at the face, which four nodes give; it is integrated against the logarithm
// exactly, as an element of the steady solver. A fitted body adds its smooth part through the
// moments of the nodes' hats (contact/compliance.h).
#include "engine/film/ehl_transient.h"

#include "engine/numeric/legendre.h"
#include "engine/numeric/root.h"

#include <cblas.h>
#include <math.h>
#include <string.h>

static const double BEND = 2e-3;   // of the height between two nodes
static const double CARRIED = 3.0; // layers
static const double RAMP =
    0.03; // distance over which faces begin to move, at the default tolerance

// Smooth part of a fitted body on the nodes, added to the kernel and the known gap, as in
// ehl_fitted.c. The constant is H0's.
static void add_smooth(SbFilmTransient *t) {
  enum { MODES = SB_COMPLIANCE_MODES };
  const SbSurfaceCompliance *c = t->problem.film.compliance;
  const int n = t->nodes, modes = c->modes;
  const double b = t->scale.half_width, middle = t->scale.middle;
  const SbFilmBody body = {c, 1.0, b, t->scale.film};
  const double tilt = sb_film_window_tilt(&body, t->scale.inlet, t->scale.outlet);
  double *value = t->mode[0][0], *smooth = t->mode[1][0];
  for (int i = 0; i < n; i++) {
    sb_compliance_modes(c, b * (middle + t->X[i]), value + i * MODES, NULL);
    t->known[i] += tilt * t->X[i];
  }
  // p_H b over the film's scale is a quarter of the modulus.
  cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, n, modes, modes - 1, 0.25 * c->modulus,
              value + 1, MODES, c->smooth[1], MODES, 0.0, smooth, MODES);
  double known[MODES] = {0}, by_axis[MODES] = {0};
  sb_film_ambient(known, by_axis, &body, t->scale.inlet, t->scale.outlet, middle + t->X[0],
                  middle + t->X[n - 1]);
  cblas_dgemv(CblasRowMajor, CblasNoTrans, n, modes, 1.0, smooth, MODES, known, 1, 1.0, t->known,
              1);
  // Moments of the nodes' hats inside the window.
  enum { POINTS = 3 };
  double node[POINTS], weight[POINTS], T[MODES];
  sb_legendre_gauss(node, weight, POINTS);
  memset(value, 0, sizeof t->mode[0]);
  for (int j = 0; j + 1 < n; j++) {
    const double x = b * (middle + t->X[j]), h = t->X[j + 1] - t->X[j];
    const double from = fmax((c->left - x) / (b * h), 0.0);
    const double to = fmin((c->right - x) / (b * h), 1.0);
    for (int q = 0; q < POINTS && from < to; q++) {
      const double s = 0.5 * (from + to) + 0.5 * (to - from) * node[q];
      const double part = 0.5 * (to - from) * h * weight[q];
      sb_compliance_modes(c, x + s * b * h, T, NULL);
      cblas_daxpy(modes, part * (1.0 - s), T, 1, value + j * MODES, 1);
      cblas_daxpy(modes, part * s, T, 1, value + (j + 1) * MODES, 1);
    }
  }
  cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasTrans, n, n, modes, 1.0, smooth, MODES, value,
              MODES, 1.0, t->kernel, n);
}

// Adds to `row` the integral over the interval of a face, whose quadratic polynomials through its
// ends and its middle have the integrals `part`.
static void add_interval(double *row, const SbFilmTransient *t, int j, const double *part,
                         double factor) {
  const SbTransientFace *f = &t->face[j];
  row[j] += factor * part[0];
  row[j + 1] += factor * part[2];
  cblas_daxpy(4, factor * part[1], f->value, 1, row + f->first, 1);
}

// Kernel and weights of the load, interval by interval as an element of `solver`'s meshes.
static void build_kernel(SbFilmTransient *t) {
  enum { QUADRATIC = 2 };
  const int n = t->nodes;
  const SbFilmScale *scale = &t->scale;
  SbFilmSolver *solver = t->solver;
  SbEhlMesh *mesh = &solver->solution[0].mesh;
  SbEhlElement *e = &mesh->element[0];
  for (int j = 0; j + 1 < n; j++) {
    sb_ehl_mesh_begin(mesh, t->X[j], 0.0, 0.0);
    sb_ehl_mesh_add(mesh, SB_EHL_AFFINE, t->X[j + 1], QUADRATIC);
    sb_ehl_kernel_prepare(e, &solver->tables);
    add_interval(t->weight, t, j, e->integral, 1.0);
    for (int i = 0; i < n; i++) {
      double part[SB_EHL_DEGREE_MAX + 2] = {0};
      sb_ehl_kernel_row(part, e, &solver->tables, t->X[i]);
      add_interval(t->kernel + (size_t)i * (size_t)n, t, j, part, -1.0 / M_PI);
    }
  }
  const SbSurfaceCompliance *c = t->problem.film.compliance;
  for (int i = 0; i < n; i++) {
    const double x = scale->middle + t->X[i];
    t->known[i] = sb_ehl_ambient_gap(t->X[i], t->X[0], t->X[n - 1], scale->inlet, scale->outlet);
    t->known[i] +=
        c != NULL ? sb_compliance_gap(c, scale->half_width * x, NULL) / scale->film : 0.5 * x * x;
  }
  if (c != NULL) {
    add_smooth(t);
  }
}

// Returns whether there is room between the layers for faces that move.
static bool thin(const SbFilmTransient *t) {
  return 2.0 * CARRIED * t->layer < 0.7;
}

// Lagrange's polynomials at a face, of four nodes and of three with two upstream of it. At an end
// of the mesh, where these are missing, transport uses the mean of the adjacent nodes.
static void lay_face(SbFilmTransient *t, int i) {
  SbTransientFace *f = &t->face[i];
  const int n = t->nodes;
  double bary[4];
  f->X = 0.5 * (t->X[i] + t->X[i + 1]);
  f->first = i < 1 ? 0 : i + 3 > n - 1 ? n - 4 : i - 1;
  sb_barycentric_weights(bary, &t->X[f->first], 4);
  sb_barycentric_basis(f->value, f->X, &t->X[f->first], bary, 4);
  sb_barycentric_slope(f->slope, f->X, &t->X[f->first], bary, 4);
  for (int back = 0; back < 2; back++) {
    const int from = i - 1 + back;
    if (from < 0 || from + 2 >= n) {
      f->upwind[back][i - f->first] = f->upwind[back][i + 1 - f->first] = 0.5;
      continue;
    }
    sb_barycentric_weights(bary, &t->X[from], 3);
    sb_barycentric_basis(&f->upwind[back][from - f->first], f->X, &t->X[from], bary, 3);
  }
  const double right = t->X[i + 1] - t->X[i];
  f->limited = !t->problem.resolve && right > t->layer && fabs(t->X[i]) < 1.0;
  // From CARRIED layers inside the edges on the faces move, after the ramp with the fluid.
  const double inside = (1.0 - fabs(f->X) - CARRIED * t->layer) / t->ramp;
  const double ramp = fmin(fmax(inside, 0.0), 1.0);
  f->carried = thin(t) ? ramp * ramp * (3.0 - 2.0 * ramp) : 0.0;
}

// Returns the spacing that the layers at the edges require at X: a fraction of the distance to the
// edge.
static double graded(const SbFilmTransient *t, double X) {
  const double at = fabs(X);
  if (at >= 1.0) {
    return t->share * hypot(t->finest, at - 1.0);
  }
  const double step = t->inner_share * hypot(t->finest * t->share / t->inner_share, at - 1.0);
  return step / hypot(1.0, step / t->cell);
}

// Spacing with which the fluid's height at a node bends by the wanted share of it from node to
// node.
static double bending_spacing(const SbFilmTransient *t, int i) {
  const double *X = &t->X[i], *m = &t->now.m[i];
  const double rise = (m[1] - m[0]) / (X[1] - X[0]) - (m[0] - m[-1]) / (X[0] - X[-1]);
  const double second = 2.0 * rise / (X[1] - X[-1]);
  return fmax(sqrt(8.0 * t->bend * fabs(m[0] / second)), t->share * t->finest);
}

enum { SAMPLES = SB_TRANSIENT_SAMPLES };

static double sample_index(const SbFilmTransient *t, double X) {
  return acos(fmin(fmax(-X / t->core, -1.0), 1.0)) * (SAMPLES - 1) / M_PI;
}

// By the layers and the height's bend (unless there is none yet), from where that is to where it
// will be when the fluid has moved on by `ahead`; growing gently.
static void want_spacing(SbFilmTransient *t, bool bends, double ahead) {
  enum { MARGIN = 4 };
  static const double GROWTH = 0.1;
  SbTransientSpacing *out = &t->spacing;
  double *X = out->X, *spacing = out->spacing;
  for (int k = 0; k < SAMPLES; k++) {
    X[k] = -t->core * cos(M_PI * k / (SAMPLES - 1));
    spacing[k] = graded(t, X[k]);
  }
  for (int i = t->side - 1; i <= t->nodes - t->side && bends; i++) {
    const double need = bending_spacing(t, i);
    const double low = t->X[i] - MARGIN * need + fmin(ahead, 0.0);
    const double high = t->X[i] + MARGIN * need + fmax(ahead, 0.0);
    const int last = (int)ceil(sample_index(t, high));
    for (int k = (int)floor(sample_index(t, low)); k <= last; k++) {
      spacing[k] = fmin(spacing[k], need);
    }
  }
  for (int k = 1; k < SAMPLES; k++) {
    spacing[k] = fmin(spacing[k], spacing[k - 1] + GROWTH * (X[k] - X[k - 1]));
  }
  for (int k = SAMPLES - 2; k >= 0; k--) {
    spacing[k] = fmin(spacing[k], spacing[k + 1] + GROWTH * (X[k + 1] - X[k]));
  }
  out->nodes[0] = 0.0;
  for (int k = 1; k < SAMPLES; k++) {
    const double density = 0.5 * (1.0 / spacing[k - 1] + 1.0 / spacing[k]);
    out->nodes[k] = out->nodes[k - 1] + density * (X[k] - X[k - 1]);
  }
}

// Nodes of the core by that spacing between the sides' nodes, which stay.
static void lay_nodes(SbFilmTransient *t) {
  const SbTransientSpacing *want = &t->spacing;
  const double all = want->nodes[SAMPLES - 1];
  const int most = SB_TRANSIENT_NODES_MAX - 2 * t->side + 1;
  const int steps = (int)fmin(ceil(all), most);
  const int first = t->side - 1;
  memmove(t->X + first + steps, t->X + t->nodes - t->side, (size_t)t->side * sizeof *t->X);
  for (int i = 1; i < steps; i++) {
    const double at = all * i / steps;
    const size_t k = sb_interval(want->nodes, SAMPLES, at);
    const double share = (at - want->nodes[k]) / (want->nodes[k + 1] - want->nodes[k]);
    t->X[first + i] = want->X[k] + share * (want->X[k + 1] - want->X[k]);
  }
  t->nodes = 2 * t->side + steps - 1;
}

// Everything that follows from the nodes.
static void lay_mesh(SbFilmTransient *t) {
  const size_t n = (size_t)t->nodes;
  memset(t->volume, 0, sizeof t->volume);
  memset(t->weight, 0, sizeof t->weight);
  memset(t->face, 0, sizeof t->face);
  memset(t->kernel, 0, n * n * sizeof *t->kernel);
  for (int i = 0; i + 1 < t->nodes; i++) {
    lay_face(t, i);
    t->volume[i] += t->face[i].X - t->X[i];
    t->volume[i + 1] += t->X[i + 1] - t->face[i].X;
  }
  build_kernel(t);
  t->factored_c0 = 0.0;
}

void sb_transient_mesh(SbFilmTransient *t, double rest, double least) {
  const double width = fmin(sb_ehl_layers_width(&t->layers), 2.0);
  const double fine =
      t->coarseness * cbrt(fmin(fmax(t->problem.film.tolerance, 1e-4), 1e-2) / 1e-3);
  t->share = 0.15 * fine;
  t->inner_share = t->problem.resolve ? 0.10 * fine : t->share;
  // A film trapped at rest may be much thinner than those of the speeds: its neck is where the dry
  // gap, about (X - 1)^(3/2), equals it.
  t->finest = 0.5 * width;
  if (least > 0.0) {
    t->finest = fmin(t->finest, 0.3 * pow(least, 2.0 / 3.0));
  }
  t->cell = 0.03 * fine;
  t->ramp = fmax(CARRIED * width, t->problem.resolve ? RAMP * fine : 0.0);
  t->bend = BEND * fine * fine;
  t->layer = width;
  t->reach = 0.3 * t->ramp;
  t->core = t->problem.resolve && thin(t) ? 1.0 - CARRIED * width : 0.0;
  const double reach = fmax(fmax(4.0, 60.0 * width), 6.0 * sqrt(2.0 * rest));
  double X[SB_TRANSIENT_NODES_MAX / 2];
  int n = 0;
  X[n++] = t->core;
  while (X[n - 1] < 1.0 + reach && n < SB_TRANSIENT_NODES_MAX / 2) {
    double step = 0.0;
    for (int pass = 0; pass < 3; pass++) {
      step = graded(t, X[n - 1] + 0.5 * step);
    }
    X[n] = X[n - 1] + step;
    n++;
  }
  t->side = n;
  t->nodes = t->core > 0.0 ? 2 * n : 2 * n - 1;
  for (int i = 0; i < n; i++) {
    t->X[n - 1 - i] = -X[i];
    t->X[t->nodes - n + i] = X[i];
  }
  if (t->core > 0.0) {
    want_spacing(t, false, 0.0);
    lay_nodes(t);
  }
  lay_mesh(t);
}

bool sb_transient_adapt(SbFilmTransient *t, double ahead) {
  static const double LACKING = 1.3, SPARE = 1.6;
  if (!(t->core > 0.0)) {
    return false;
  }
  bool lacking = false;
  for (int i = t->side; i < t->nodes - t->side && !lacking; i++) {
    const double spacing = fmax(t->X[i + 1] - t->X[i], t->X[i] - t->X[i - 1]);
    lacking = spacing > LACKING * fmin(bending_spacing(t, i), graded(t, t->X[i]));
  }
  want_spacing(t, true, ahead);
  if (!lacking && t->nodes - 2 * t->side < SPARE * t->spacing.nodes[SAMPLES - 1]) {
    return false;
  }
  const int nodes = t->nodes;
  memcpy(t->old_X, t->X, sizeof t->X);
  lay_nodes(t);
  lay_mesh(t);
  sb_transient_remap(t, nodes);
  return true;
}

void sb_transient_gap(double *out, const SbFilmTransient *t, const SbTransientState *s) {
  for (int i = 0; i < t->nodes; i++) {
    out[i] = s->H0 + t->known[i];
  }
  cblas_dgemv(CblasRowMajor, CblasNoTrans, t->nodes, t->nodes, 1.0, t->kernel, t->nodes, s->Q, 1,
              1.0, out, 1);
}
