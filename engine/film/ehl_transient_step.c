// The implicit step of the transient film; equations in transient.h.
//
// Node values stand for cells between the midpoints. Fluid goes through a face by quadratic
// upwind interpolation, and with van Albada's limited slope where a
// front stands, a coarse cell is wider than the layers or the upwind node
// lies in a cavity, so that fronts stay monotonic; faces that move with the fluid let none through.
// Unknown of a node is its pressure or its void, whichever is not zero.
#include "engine/film/ehl_transient.h"

#include "engine/numeric/dense.h"
#include "engine/numeric/legendre.h"

#include <cblas.h>
#include <math.h>
#include <string.h>

double sb_transient_height(const SbTransientState *s, int i) {
  return s->H[i] - s->void_[i];
}

// Fluid height at the face between i and i + 1 for a transport to the side of `velocity`; the
// derivatives go to nodes first .. first + 2.
typedef struct {
  double value;
  int first;
  double by[3];
} Face;

static Face face_height(const SbFilmTransient *t, const SbTransientState *s, int i,
                        double velocity) {
  const double at = 0.5 * (t->X[i] + t->X[i + 1]);
  const bool forward = velocity >= 0.0;
  const int C = forward ? i : i + 1;
  const int D = forward ? i + 1 : i;
  const int U = forward ? i - 1 : i + 2;
  Face f = {0};
  if (U < 0 || U >= t->nodes) {
    f.first = forward ? i : i - 1;
    f.by[C - f.first] = 0.5;
    f.by[D - f.first] = 0.5;
    f.value = 0.5 * (sb_transient_height(s, C) + sb_transient_height(s, D));
    return f;
  }
  f.first = forward ? i - 1 : i;
  if (!t->limited[i] && !t->steep[i] && !t->beside_cavity[i]) {
    double bary[3];
    sb_barycentric_weights(bary, &t->X[f.first], 3);
    sb_barycentric_basis(f.by, at, &t->X[f.first], bary, 3);
    for (int k = 0; k < 3; k++) {
      f.value += f.by[k] * sb_transient_height(s, f.first + k);
    }
    return f;
  }
  const double u = t->X[U], c = t->X[C], d = t->X[D];
  const double m_u = sb_transient_height(s, U);
  const double m_c = sb_transient_height(s, C);
  const double m_d = sb_transient_height(s, D);
  // Van Albada's mean of the two slopes, smooth where both vanish.
  const double a = (m_c - m_u) / (c - u);
  const double b = (m_d - m_c) / (d - c);
  const double e = 1e-3 * m_c / (d - c);
  const double sum = a * a + b * b + 2.0 * e * e;
  const double slope = ((a * a + e * e) * b + (b * b + e * e) * a) / sum;
  const double by_a = (2.0 * a * b + b * b + e * e - 2.0 * a * slope) / sum;
  const double by_b = (2.0 * a * b + a * a + e * e - 2.0 * b * slope) / sum;
  f.value = m_c + slope * (at - c);
  f.by[U - f.first] = -by_a / (c - u) * (at - c);
  f.by[C - f.first] = 1.0 + (by_a / (c - u) - by_b / (d - c)) * (at - c);
  f.by[D - f.first] = by_b / (d - c) * (at - c);
  return f;
}

// Gap and pressure gradient at a face from `count` nodes beginning at `first`: the two beside it,
// or four by a cubic in the full film.
typedef struct {
  int first, count;
  double value[4], slope[4];
} Stencil;

static Stencil stencil(const SbFilmTransient *t, int face) {
  Stencil out = {.first = face, .count = 2};
  const double at = 0.5 * (t->X[face] + t->X[face + 1]);
  if (face > 0 && face + 2 < t->nodes && !t->beside_cavity[face - 1] && !t->beside_cavity[face] &&
      !t->beside_cavity[face + 1]) {
    out.first = face - 1;
    out.count = 4;
  }
  double bary[4];
  sb_barycentric_weights(bary, &t->X[out.first], out.count);
  sb_barycentric_basis(out.value, at, &t->X[out.first], bary, out.count);
  sb_barycentric_slope(out.slope, at, &t->X[out.first], bary, out.count);
  return out;
}

double sb_transient_flow(const SbFilmTransient *t, const SbTransientState *s, int i) {
  const Face f = face_height(t, s, i, s->speed);
  const double H = 0.5 * (s->H[i] + s->H[i + 1]);
  return s->speed * f.value -
         t->diffusion * H * H * H * (s->P[i + 1] - s->P[i]) / (t->X[i + 1] - t->X[i]);
}

void sb_transient_carry(double *out, const SbFilmTransient *t, const double *height, double way) {
  enum { SIDE = 3, FACES = 2 * SIDE };
  const int n = t->nodes;
  memcpy(out, height, (size_t)n * sizeof *out);
  int first = 0;
  while (first < n && t->carried[first] == 0.0) {
    first++;
  }
  if (first == n || way == 0.0) {
    return;
  }
  // Integral up to face i, i + 1 from a little before the first that moves: the surroundings hold
  // so much more liquid that the contact's would be lost in rounding.
  const int from = first - 2 * SIDE, to = n - 2 - from;
  double place[SB_TRANSIENT_NODES_MAX], integral[SB_TRANSIENT_NODES_MAX];
  for (int i = from; i <= to; i++) {
    place[i] = 0.5 * (t->X[i] + t->X[i + 1]);
    integral[i] = i > from ? integral[i - 1] + t->volume[i] * height[i] : 0.0;
  }
  double before = integral[first - 1];
  for (int i = first; i <= n - 1 - first; i++) {
    const double at = place[i] - t->carried[i] * way;
    int k = i; // at lies between faces k and k + 1
    while (k > from + SIDE && place[k] > at) {
      k--;
    }
    while (k < to - SIDE && place[k + 1] < at) {
      k++;
    }
    double least = INFINITY;
    double most = 0.0;
    for (int j = k - SIDE + 2; j <= k + SIDE; j++) {
      least = fmin(least, height[j]);
      most = fmax(most, height[j]);
    }
    double value = 0.0;
    if (most > 6.0 * least) {
      // A front: Hermite's cubic with harmonic means for slopes rises throughout.
      const double *m = height + k;
      const double h = t->volume[k + 1];
      const double s = (at - place[k]) / h;
      const double left = 2.0 * m[0] * m[1] / (m[0] + m[1]);
      const double right = 2.0 * m[2] * m[1] / (m[2] + m[1]);
      value =
          integral[k] +
          h * s * (left + s * (3.0 * m[1] - 2.0 * left - right + s * (left + right - 2.0 * m[1])));
    } else {
      const double *node = &place[k - SIDE + 1];
      double bary[FACES], basis[FACES];
      sb_barycentric_weights(bary, node, FACES);
      sb_barycentric_basis(basis, at, node, bary, FACES);
      for (int j = 0; j < FACES; j++) {
        value += basis[j] * integral[k - SIDE + 1 + j];
      }
    }
    out[i] = (value - before) / t->volume[i];
    before = value;
  }
}

enum { BAND = 5 }; // derivatives of a row go to nodes i - 2 .. i + 2

// A node's equation: residual and its derivatives to fluid heights, gaps and pressures.
typedef struct {
  double residual;
  double by_m[BAND], by_H[BAND], by_P[BAND];
} Row;

static void add_face(Row *row, const SbFilmTransient *t, const SbTransientState *s,
                     const SbTransientStep *step, int i, int face, double sign) {
  const double velocity = s->speed - step->carried_rate * t->carried[face];
  const Face f = face_height(t, s, face, velocity);
  row->residual += sign * velocity * f.value;
  for (int k = 0; k < 3; k++) {
    const int place = f.first + k - i + 2;
    if (f.by[k] != 0.0) {
      row->by_m[place] += sign * velocity * f.by[k];
    }
  }
  const Stencil local = stencil(t, face);
  const double g = t->diffusion;
  double H = 0.0;
  double slope = 0.0;
  for (int k = 0; k < local.count; k++) {
    H += local.value[k] * s->H[local.first + k];
    slope += local.slope[k] * s->P[local.first + k];
  }
  row->residual -= sign * g * H * H * H * slope;
  for (int k = 0; k < local.count; k++) {
    const int place = local.first + k - i + 2;
    row->by_H[place] -= sign * 3.0 * g * H * H * slope * local.value[k];
    row->by_P[place] -= sign * g * H * H * H * local.slope[k];
  }
}

static Row equation(const SbFilmTransient *t, const SbTransientState *s,
                    const SbTransientStep *step, int i) {
  Row row = {0};
  row.residual = t->volume[i] * step->c0 * sb_transient_height(s, i);
  if (step->old != NULL) {
    row.residual += t->volume[i] * step->old[i];
  }
  row.by_m[2] += t->volume[i] * step->c0;
  add_face(&row, t, s, step, i, i, 1.0);
  add_face(&row, t, s, step, i, i - 1, -1.0);
  return row;
}

// Load above the ambient step less its target pi/2.
static double load_excess(const SbFilmTransient *t, const SbTransientState *s) {
  double sum = 0.0;
  for (int i = 0; i < t->nodes; i++) {
    sum += t->weight[i] * s->P[i];
  }
  const double left = t->middle + t->X[0], right = t->middle + t->X[t->nodes - 1];
  return sum + t->inlet * left - t->outlet * right - 0.5 * M_PI;
}

// Fills the right-hand side and, if `whole`, the matrix for the present active set; H is linearised
// about. Rows are divided by the scale that they had with the matrix.
static void assemble(SbFilmTransient *t, const SbTransientState *s, const SbTransientStep *step,
                     const double *elastic, bool whole) {
  const int n = t->nodes;
  const size_t order = (size_t)n - 1;
  for (int i = 1; i + 1 < n; i++) {
    Row row = equation(t, s, step, i);
    double right = row.residual;
    double by_H0 = 0.0;
    double scale = 0.0;
    double *out = t->matrix + (size_t)(i - 1) * order;
    if (whole) {
      memset(out, 0, order * sizeof *out);
    }
    for (int k = 0; k < BAND; k++) {
      const int j = i + k - 2;
      if (j < 0 || j >= n) {
        continue;
      }
      const double by_gap = row.by_m[k] + row.by_H[k];
      right += by_gap * (elastic[j] - s->H[j]);
      by_H0 += by_gap;
      scale = fmax(scale, fmax(fabs(by_gap), fabs(row.by_P[k])));
      if (whole && by_gap != 0.0) {
        cblas_daxpy(n - 2, by_gap, t->kernel + (size_t)j * (size_t)n + 1, 1, out, 1);
      }
    }
    if (!whole) {
      t->right[i - 1] = right / t->row_scale[i];
      continue;
    }
    for (int k = 0; k < BAND; k++) {
      const int j = i + k - 2;
      if (j >= 1 && j + 1 < n) {
        out[j - 1] += row.by_P[k];
      }
    }
    // A node in a cavity has its void for an unknown.
    for (int j = 1; j + 1 < n; j++) {
      if (s->cavity[j]) {
        const int k = j - i + 2;
        out[j - 1] = k >= 0 && k < BAND ? -row.by_m[k] : 0.0;
      }
    }
    out[order - 1] = by_H0;
    for (size_t j = 0; j < order; j++) {
      out[j] /= scale;
    }
    t->right[i - 1] = right / scale;
    t->row_scale[i] = scale;
  }
  t->right[order - 1] = load_excess(t, s);
  if (whole) {
    double *out = t->matrix + (order - 1) * order;
    for (int j = 1; j + 1 < n; j++) {
      out[j - 1] = s->cavity[j] ? 0.0 : t->weight[j];
    }
    out[order - 1] = 0.0;
  }
}

// Whether the last factors may serve again: the same cavity and nearly the same step.
static bool factors_serve(const SbFilmTransient *t, const SbTransientState *s,
                          const SbTransientStep *step) {
  return t->factored && step->c0 > 0.0 && fabs(log(step->c0 / t->factored_c0)) < 0.3 &&
         memcmp(t->factored_cavity, s->cavity, (size_t)t->nodes * sizeof(bool)) == 0;
}

// Largest error of the balance of mass between the contact's left edge and any node up to its right
// one, over the larger of the flow's scale and the present flows. The surroundings hold so much
// more liquid that rounding hides theirs.
static double mass_error(const SbFilmTransient *t, const SbTransientState *s,
                         const SbTransientStep *step) {
  double sum = 0.0;
  double largest = 0.0;
  double flow = t->flow;
  for (int i = 1; i + 1 < t->nodes; i++) {
    if (fabs(t->X[i]) < 1.0 + t->layer) {
      sum += equation(t, s, step, i).residual;
      largest = fmax(largest, fabs(sum));
      flow = fmax(flow, fabs(sb_transient_flow(t, s, i)));
    }
  }
  return largest / flow;
}

// Switches nodes whose pressure or void has the wrong sign; returns their number.
static int switch_nodes(const SbFilmTransient *t, SbTransientState *s) {
  int count = 0;
  for (int i = 1; i + 1 < t->nodes; i++) {
    if (s->cavity[i] && s->void_[i] < 0.0) {
      s->cavity[i] = false;
      s->void_[i] = 0.0;
      count++;
    } else if (!s->cavity[i] && s->P[i] < 0.0) {
      s->cavity[i] = true;
      s->P[i] = 0.0;
      count++;
    }
  }
  return count;
}

// A front that quadratic interpolation would undershoot, down to no film at all: steeper than the
// gap of a dry contact or of the parabola on this mesh.
static bool is_steep(const SbFilmTransient *t, const SbTransientState *s, int face) {
  if (face < 1 || face + 2 >= t->nodes) {
    return false;
  }
  double least = INFINITY;
  double most = 0.0;
  for (int i = face - 1; i <= face + 2; i++) {
    least = fmin(least, sb_transient_height(s, i));
    most = fmax(most, sb_transient_height(s, i));
  }
  return most > (t->problem.resolve ? 6.0 : 2.5) * least;
}

SbStatus sb_transient_newton(SbTransientTrace *trace, SbFilmTransient *t, SbTransientState *s,
                             const SbTransientStep *step) {
  enum { ITERATIONS_MAX = 30 };
  const int n = t->nodes;
  const int order = n - 1;
  double *elastic = t->newton[0], *change = t->newton[1];
  *trace = (SbTransientTrace){.mass_error = INFINITY, .load_error = INFINITY};
  s->P[0] = t->inlet;
  s->P[n - 1] = t->outlet;
  bool done = false;
  bool fresh = !factors_serve(t, s, step);
  bool settled = false;
  double before_largest = INFINITY;
  double before_mass = INFINITY;
  for (int iteration = 0; iteration < ITERATIONS_MAX && !done; iteration++) {
    // The scheme follows the cavity at first only: with the active set it could go in circles.
    for (int i = 0; iteration < 3 && i + 1 < n; i++) {
      t->beside_cavity[i] = s->cavity[i] || s->cavity[i + 1];
      t->steep[i] = is_steep(t, s, i);
    }
    // The gap of the pressure, unless the two agree to the rounding of deflections of size one: H
    // itself then carries more digits of a thin film.
    sb_transient_gap(elastic, t, s);
    double apart = 0.0;
    double deepest = 1.0;
    for (int i = 0; i < n; i++) {
      apart = fmax(apart, fabs(elastic[i] - s->H[i]));
      deepest = fmax(deepest, fabs(s->H[i]));
    }
    const bool agree = apart < 1e-13 * deepest;
    if (agree) {
      memcpy(elastic, s->H, (size_t)n * sizeof *elastic);
    }
    if (settled && agree) {
      const double mass = mass_error(t, s, step);
      done = mass < 1e-11 || (mass < 1e-10 && mass > 0.1 * before_mass) || before_largest < 1e-13;
      if (done) {
        break;
      }
      before_mass = mass;
    }
    assemble(t, s, step, elastic, fresh);
    t->factored = sb_factor_solve(t->matrix, t->pivot, t->right, order, fresh);
    if (!t->factored) {
      return SB_ERROR_NOT_CONVERGED;
    }
    if (fresh) {
      t->factored_c0 = step->c0;
      memcpy(t->factored_cavity, s->cavity, (size_t)n * sizeof(bool));
    }
    trace->iterations++;
    // New gap by the linear elastic relation; no film may shrink below a fifth at once.
    const double old_H0 = s->H0;
    double *wanted = elastic; // reused
    change[0] = change[n - 1] = 0.0;
    for (int i = 1; i + 1 < n; i++) {
      change[i] = s->cavity[i] ? 0.0 : -t->right[i - 1];
    }
    cblas_dgemv(CblasRowMajor, CblasNoTrans, n, n, 1.0, t->kernel, n, change, 1, 1.0, wanted, 1);
    double factor = 1.0;
    for (int i = 0; i < n; i++) {
      wanted[i] -= t->right[order - 1];
      if (!isfinite(wanted[i])) {
        return SB_ERROR_NOT_CONVERGED;
      }
      if (wanted[i] < 0.2 * s->H[i]) {
        factor = fmin(factor, 0.8 * s->H[i] / (s->H[i] - wanted[i]));
      }
    }
    double largest = 0.0;
    for (int i = 0; i < n; i++) {
      const double before = sb_transient_height(s, i);
      s->H[i] += factor * (wanted[i] - s->H[i]);
      s->P[i] += factor * change[i];
      if (i > 0 && i + 1 < n && s->cavity[i]) {
        s->void_[i] -= factor * t->right[i - 1];
      }
      const double after = sb_transient_height(s, i);
      largest = fmax(largest, fabs(after - before) / fmax(fabs(after), 1e-300));
    }
    s->H0 = old_H0 - factor * t->right[order - 1];
    const int switched = switch_nodes(t, s);
    settled = factor == 1.0 && switched == 0 && largest < 1e-4;
    fresh = switched > 0 || factor < 1.0 || largest > 0.1 * before_largest || largest > 0.05;
    before_largest = largest;
  }
  if (!done) {
    t->factored = false;
    return SB_ERROR_NOT_CONVERGED;
  }
  trace->mass_error = mass_error(t, s, step);
  for (int i = 0; i < n; i++) {
    if (!(s->H[i] > 0.0)) {
      return SB_ERROR_NOT_CONVERGED;
    }
  }
  trace->load_error = fabs(load_excess(t, s)) / (0.5 * M_PI);
  return SB_OK;
}
