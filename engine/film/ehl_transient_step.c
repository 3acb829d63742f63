// The implicit step of the transient film; equations in transient.h.
//
// Node values represent cells between the midpoints. Fluid passes a face by quadratic upwind
// interpolation. It has van Albada's limited slope at a front, if a coarse cell is wider than the
// layers, or if the upwind node is in a cavity, so that fronts stay monotonic. No fluid passes
// faces that move with it. The unknown of a node is its pressure in the full film, where the height
// of its fluid is the gap; in a cavity it is the height, at the rupture pressure. If the surfaces
// carry a part, the unknown is the total pressure q = p + p_a(h), and a node in a cavity has both:
// with dh = K dq + dH0 the film's pressure changes by dp = dq - p_a' dh.
#include "engine/film/ehl_transient.h"

#include "engine/numeric/dense.h"

#include <cblas.h>
#include <float.h>
#include <math.h>
#include <string.h>

// Height that the fluid goes through a face with, by van Albada's mean of the slopes between its
// upstream nodes and across it, smooth where both vanish; derivatives into by_m.
static void limited_height(double *height, SbTransientFace *f, const SbFilmTransient *t,
                           const double *m, int i, bool back) {
  const int C = back ? i + 1 : i;
  const int D = back ? i : i + 1;
  const int U = back ? i + 2 : i - 1;
  if (U < 0 || U >= t->nodes) { // what comes in from beyond the mesh
    memset(f->by_m, 0, sizeof f->by_m);
    f->by_m[C - f->first] = 1.0;
    *height = m[C];
    return;
  }
  const double u = t->X[U], c = t->X[C], d = t->X[D];
  const double a = (m[C] - m[U]) / (c - u);
  const double b = (m[D] - m[C]) / (d - c);
  const double e = 1e-3 * m[C] / (d - c);
  const double sum = a * a + b * b + 2.0 * e * e;
  const double slope = ((a * a + e * e) * b + (b * b + e * e) * a) / sum;
  const double by_a = (2.0 * a * b + b * b + e * e - 2.0 * a * slope) / sum;
  const double by_b = (2.0 * a * b + a * a + e * e - 2.0 * b * slope) / sum;
  memset(f->by_m, 0, sizeof f->by_m);
  f->by_m[U - f->first] = -by_a / (c - u) * (f->X - c);
  f->by_m[C - f->first] = 1.0 + (by_a / (c - u) - by_b / (d - c)) * (f->X - c);
  f->by_m[D - f->first] = by_b / (d - c) * (f->X - c);
  *height = m[C] + slope * (f->X - c);
}

// Returns the flow through the face behind node i. Next to a cavity its gap and the slope of the
// pressure are those of the two nodes, elsewhere of a cubic through four.
static void flow_through(SbFilmTransient *t, const SbTransientState *s, int i) {
  SbTransientFace *f = &t->face[i];
  const double velocity = s->speed - t->carried_rate * f->carried;
  const bool back = velocity < 0.0;
  double height;
  if (f->monotonic) {
    limited_height(&height, f, t, s->m, i, back);
  } else {
    memcpy(f->by_m, f->upwind[back], sizeof f->by_m);
    height = cblas_ddot(4, f->by_m, 1, s->m + f->first, 1);
  }
  const bool beside = f->beside_cavity || (i > 0 && f[-1].beside_cavity) || f[1].beside_cavity;
  const int at = i - f->first;
  double two[4] = {0}, rise[4] = {0};
  two[at] = two[at + 1] = 0.5;
  rise[at + 1] = 1.0 / (t->X[i + 1] - t->X[i]);
  rise[at] = -rise[at + 1];
  const double *value = beside ? two : f->value, *slope = beside ? rise : f->slope;
  const double H = cblas_ddot(4, value, 1, s->H + f->first, 1);
  const double P_slope = cblas_ddot(4, slope, 1, s->P + f->first, 1);
  f->flow = velocity * height - t->diffusion * H * H * H * P_slope;
  for (int k = 0; k < 4; k++) {
    f->by_m[k] *= velocity;
    f->by_H[k] = -3.0 * t->diffusion * H * H * P_slope * value[k];
    f->by_P[k] = -t->diffusion * H * H * H * slope[k];
  }
}

// Returns the growth of a cell's content, except for the flows through its faces.
static double residual(const SbFilmTransient *t, const SbTransientState *s, int i) {
  return t->volume[i] * (t->c0 * s->m[i] + t->old[i]) + t->face[i].flow - t->face[i - 1].flow;
}

// Load above the ambient step less its target pi/2.
static double load_excess(const SbFilmTransient *t, const SbTransientState *s) {
  const double left = t->scale.middle + t->X[0], right = t->scale.middle + t->X[t->nodes - 1];
  return cblas_ddot(t->nodes, t->weight, 1, s->Q, 1) + t->scale.inlet * left -
         t->scale.outlet * right - 0.5 * M_PI;
}

enum { BAND = 5, MIDDLE = 2 }; // derivatives of a row go to nodes i - 2 .. i + 2

// Fills the row of a node's mass balance; see assemble().
static inline void mass_row(SbFilmTransient *t, const SbTransientState *s, const double *elastic,
                            bool whole, int i) {
  const int n = t->nodes;
  const size_t order = (size_t)t->order;
  double by_m[BAND] = {0}, by_H[BAND] = {0}, by_P[BAND] = {0};
  by_m[MIDDLE] = t->volume[i] * t->c0;
  for (int side = 0; side < 2; side++) {
    const SbTransientFace *f = &t->face[i - side];
    for (int k = 0; k < 4; k++) {
      const int place = f->first + k - i + MIDDLE;
      by_m[place] += side == 0 ? f->by_m[k] : -f->by_m[k];
      by_H[place] += side == 0 ? f->by_H[k] : -f->by_H[k];
      by_P[place] += side == 0 ? f->by_P[k] : -f->by_P[k];
    }
  }
  double right = residual(t, s, i);
  double by_H0 = 0.0;
  double *out = t->matrix + (size_t)(i - 1) * order;
  if (whole) {
    memset(out, 0, order * sizeof *out);
  }
  const int first = i < MIDDLE ? 0 : i - MIDDLE, last = i + MIDDLE < n ? i + MIDDLE : n - 1;
  for (int j = first; j <= last; j++) {
    const int k = j - i + MIDDLE;
    // Where the film is full its gap is the fluid's height.
    const double by_gap = by_H[k] + (s->cavity[j] ? 0.0 : by_m[k] - by_P[k] * t->solid_H[j]);
    right += by_gap * (elastic[j] - s->H[j]);
    by_H0 += by_gap;
    if (whole && by_gap != 0.0) {
      cblas_daxpy(n - 2, by_gap, t->kernel + (size_t)j * (size_t)n + 1, 1, out, 1);
    }
  }
  t->right[i - 1] = right;
  if (!whole) {
    return;
  }
  for (int j = 1; j + 1 < n; j++) {
    const bool near = j >= first && j <= last;
    const double own = !near ? 0.0 : s->cavity[j] ? by_m[j - i + MIDDLE] : by_P[j - i + MIDDLE];
    if (t->extra[j] > 0) {
      out[t->extra[j]] = out[j - 1];
    }
    out[j - 1] = s->cavity[j] ? own : out[j - 1] + own;
  }
  out[order - 1] = by_H0;
}

// Fills the row of the total pressure of a cavitated node between surfaces in contact.
static inline void cavity_row(SbFilmTransient *t, const SbTransientState *s, const double *elastic,
                              bool whole, int i) {
  const int n = t->nodes;
  const size_t order = (size_t)t->order;
  const double slope = t->solid_H[i];
  t->right[t->extra[i]] = s->Q[i] - t->solid[i] - slope * (elastic[i] - s->H[i]);
  if (whole) {
    double *out = t->matrix + (size_t)t->extra[i] * order;
    for (int j = 1; j + 1 < n; j++) {
      const double by = -slope * t->kernel[(size_t)i * (size_t)n + (size_t)j];
      out[j - 1] = s->cavity[j] ? 0.0 : by;
      if (t->extra[j] > 0) {
        out[t->extra[j]] = by;
      }
    }
    out[t->extra[i]] += 1.0;
    out[order - 1] = -slope;
  }
}

// Fills the row of the load.
static void load_row(SbFilmTransient *t, const SbTransientState *s, bool whole) {
  const size_t order = (size_t)t->order;
  t->right[order - 1] = load_excess(t, s);
  if (whole) {
    double *out = t->matrix + (order - 1) * order;
    for (int j = 1; j + 1 < t->nodes; j++) {
      out[j - 1] = s->cavity[j] ? 0.0 : t->weight[j];
      if (t->extra[j] > 0) {
        out[t->extra[j]] = t->weight[j];
      }
    }
    out[order - 1] = 0.0;
  }
}

// Fills the right-hand side and, if `whole`, the matrix for the present active set; H is linearised
// about.
static void assemble(SbFilmTransient *t, const SbTransientState *s, const double *elastic,
                     bool whole) {
  for (int i = 1; i + 1 < t->nodes; i++) {
    mass_row(t, s, elastic, whole, i);
  }
  for (int i = 1; i + 1 < t->nodes; i++) {
    if (t->extra[i] > 0) {
      cavity_row(t, s, elastic, whole, i);
    }
  }
  load_row(t, s, whole);
}

// Numbers the unknowns: of the nodes, total pressures of cavities between surfaces in contact, H0.
// *lifted: some surfaces are no longer in contact. False if there are too many.
static bool number(bool *lifted, SbFilmTransient *t, SbTransientState *s) {
  int next = t->nodes - 2;
  for (int i = 0; i < t->nodes; i++) {
    const bool touches = s->cavity[i] && t->solid[i] != 0.0;
    t->extra[i] = touches ? next++ : 0;
    if (s->cavity[i] && !touches && s->Q[i] != 0.0) {
      s->Q[i] = 0.0;
      *lifted = true;
    }
  }
  t->order = next + 1;
  return t->order <= SB_TRANSIENT_ORDER_MAX;
}

// Returns whether the last factors may serve again: the same unknowns and nearly the same step.
static bool factors_serve(const SbFilmTransient *t, const SbTransientState *s) {
  return fabs(log(t->c0 / t->factored_c0)) < 0.3 &&
         memcmp(t->factored_cavity, s->cavity, (size_t)t->nodes * sizeof(bool)) == 0 &&
         memcmp(t->factored_extra, t->extra, (size_t)t->nodes * sizeof(int)) == 0;
}

// Stores the unknowns and the step that factors_serve() compares with.
static void note_factors(SbFilmTransient *t, const SbTransientState *s) {
  t->factored_c0 = t->c0;
  memcpy(t->factored_cavity, s->cavity, (size_t)t->nodes * sizeof(bool));
  memcpy(t->factored_extra, t->extra, (size_t)t->nodes * sizeof(int));
}

// Returns the largest error of the mass balance between the contact's left edge and any node up to
// its right one, divided by the larger of the flow's scale and the present flows. The surroundings
// contain so much more liquid that rounding hides their error.
static double mass_error(const SbFilmTransient *t, const SbTransientState *s) {
  double sum = 0.0;
  double largest = 0.0;
  double flow = t->flow;
  for (int i = 1; i + 1 < t->nodes; i++) {
    if (fabs(t->X[i]) < 1.0 + t->layer) {
      sum += residual(t, s, i);
      largest = fmax(largest, fabs(sum));
      flow = fmax(flow, fabs(t->face[i].flow));
    }
  }
  return largest / flow;
}

// Returns the rounding error of that balance between surfaces that carry load: the film's pressure
// is the difference of the total and the solids' pressure, which may both be far larger, and the
// flow uses its slope.
static double mass_rounding(const SbFilmTransient *t, const SbTransientState *s) {
  static const double SUM = 4.0; // of the faces' and the nodes' roundings against the largest
  double largest = 0.0;
  for (int i = 1; i + 1 < t->nodes && t->rough; i++) {
    const SbTransientFace *f = &t->face[i];
    double sum = 0.0;
    for (int k = 0; k < 4; k++) {
      const int j = f->first + k;
      const double by_gap = fabs(t->solid_H[j]) * s->H[j];
      sum += fabs(f->by_P[k]) * (fabs(s->Q[j]) + fabs(t->solid[j]) + by_gap);
    }
    largest = fabs(t->X[i]) < 1.0 + t->layer ? fmax(largest, sum) : largest;
  }
  return SUM * DBL_EPSILON * largest / t->flow;
}

// Switches nodes with a negative pressure, or with more fluid than the gap can contain; returns
// their number.
static int switch_nodes(const SbFilmTransient *t, SbTransientState *s) {
  int count = 0;
  for (int i = 1; i + 1 < t->nodes; i++) {
    if (s->cavity[i] ? s->m[i] > s->H[i] : s->P[i] < 0.0) {
      s->cavity[i] = !s->cavity[i];
      s->m[i] = s->H[i];
      s->P[i] = 0.0;
      s->Q[i] = t->solid[i];
      count++;
    }
  }
  return count;
}

// What a front or a cavity makes of the scheme at a face. Quadratic interpolation would undershoot,
// down to no film at all, a front steeper than the gap of a dry contact or of the parabola on this
// mesh.
static void choose_scheme(SbFilmTransient *t, const SbTransientState *s, int i) {
  SbTransientFace *f = &t->face[i];
  const bool steep = sb_transient_front(s->m + f->first, 4, t->problem.resolve ? 6.0 : 2.5);
  f->beside_cavity = s->cavity[i] || s->cavity[i + 1];
  f->monotonic = f->limited || f->beside_cavity || steep;
}

// Computes the flows through all faces; with `choose`, the schemes for the present state first.
static void find_flows(SbFilmTransient *t, const SbTransientState *s, bool choose) {
  for (int i = 0; choose && i + 1 < t->nodes; i++) {
    choose_scheme(t, s, i);
  }
  for (int i = 0; i + 1 < t->nodes; i++) {
    flow_through(t, s, i);
  }
}

// Takes the step in t->right; no film may decrease below a fifth in one step. *factor is the
// fraction taken. Returns the largest relative change of the fluid's height, NaN if there is no
// step.
static double take_step(double *factor, SbFilmTransient *t, SbTransientState *s,
                        const double *elastic) {
  const int n = t->nodes;
  const double rise = -t->right[t->order - 1];
  double *change = t->work[0], *wanted = t->work[1];
  change[0] = change[n - 1] = 0.0;
  for (int i = 0; i < n; i++) {
    wanted[i] = elastic[i] + rise;
    if (i > 0 && i + 1 < n) {
      const int place = s->cavity[i] ? t->extra[i] : i - 1;
      change[i] = !s->cavity[i] || place > 0 ? -t->right[place] : 0.0;
    }
  }
  // New gap by the linear elastic relation.
  cblas_dgemv(CblasRowMajor, CblasNoTrans, n, n, 1.0, t->kernel, n, change, 1, 1.0, wanted, 1);
  *factor = 1.0;
  for (int i = 0; i < n; i++) {
    if (!isfinite(wanted[i])) {
      return NAN;
    }
    if (wanted[i] < 0.2 * s->H[i]) {
      *factor = fmin(*factor, 0.8 * s->H[i] / (s->H[i] - wanted[i]));
    }
  }
  double largest = 0.0;
  for (int i = 0; i < n; i++) {
    const double before = s->m[i];
    s->H[i] += *factor * (wanted[i] - s->H[i]);
    s->Q[i] += *factor * change[i];
    const double step = i > 0 && i + 1 < n ? t->right[i - 1] : 0.0; // what the ends have is given
    s->m[i] = s->cavity[i] ? before - *factor * step : s->H[i];
    largest = fmax(largest, fabs(s->m[i] - before) / fmax(fabs(s->m[i]), 1e-300));
  }
  s->H0 += *factor * rise;
  return largest;
}

// Returns the pressure at an end of the mesh, and the height of fluid there: the gap, or at a
// starved end what the wall brings, or takes away from the adjacent node.
static void set_end(const SbFilmTransient *t, SbTransientState *s, int i, int beside) {
  const double supply = t->supply[i > 0];
  s->P[i] = i > 0 ? t->scale.outlet : t->scale.inlet;
  s->cavity[i] = isfinite(supply);
  if (s->cavity[i]) {
    s->m[i] = s->speed * (beside - i) < 0.0 ? s->m[beside] : supply;
  }
}

// Returns whether the mass balance is closed: to the tolerance, to rounding, or to where it no
// longer decreases. `before_mass`: its error before the last step; `before_largest`: the last
// step's largest relative change.
static bool is_balanced(const SbFilmTransient *t, const SbTransientState *s, double mass,
                        double before_mass, double before_largest) {
  return mass < fmax(1e-11, mass_rounding(t, s)) || (mass < 1e-10 && mass > 0.1 * before_mass) ||
         before_largest < 1e-13;
}

SbStatus sb_transient_newton(SbFilmTransient *t, SbTransientState *s) {
  enum { ITERATIONS_MAX = 30 };
  const int n = t->nodes;
  double elastic[SB_TRANSIENT_NODES_MAX];
  SbFilmTransientResult *result = &t->result;
  set_end(t, s, 0, 1);
  set_end(t, s, n - 1, n - 2);
  sb_transient_solids(t, s, false);
  bool fresh = false;
  bool settled = false;
  // H is the gap of P: a full step makes it so and shorter ones preserve it. It then has more
  // digits of a thin film than deflections of size one.
  bool elastic_H = false;
  double before_largest = INFINITY;
  double before_mass = INFINITY;
  for (int iteration = 0; iteration < ITERATIONS_MAX; iteration++) {
    bool lifted = false;
    if (!number(&lifted, t, s)) {
      break;
    }
    elastic_H = elastic_H && !lifted;
    fresh = fresh || !factors_serve(t, s);
    // The scheme follows the cavity at first only: with the active set it could go in circles.
    find_flows(t, s, iteration < 3);
    if (elastic_H) {
      memcpy(elastic, s->H, (size_t)n * sizeof *elastic);
    } else {
      sb_transient_gap(elastic, t, s);
    }
    if (settled) {
      const double mass = mass_error(t, s);
      if (is_balanced(t, s, mass, before_mass, before_largest)) {
        result->mass_error = fmax(result->mass_error, mass);
        result->load_error = fmax(result->load_error, fabs(load_excess(t, s)) / (0.5 * M_PI));
        return SB_OK;
      }
      before_mass = mass;
    }
    assemble(t, s, elastic, fresh);
    if (fresh) {
      note_factors(t, s);
    }
    result->newton_iterations++;
    double factor, largest = NAN;
    if (sb_factor_solve(t->matrix, t->pivot, t->right, t->order, fresh)) {
      largest = take_step(&factor, t, s, elastic);
    }
    if (isnan(largest)) {
      break;
    }
    sb_transient_solids(t, s, true);
    const int switched = switch_nodes(t, s);
    elastic_H = (elastic_H || factor == 1.0) && switched == 0;
    settled = factor == 1.0 && switched == 0 && largest < 1e-4;
    fresh = switched > 0 || factor < 1.0 || largest > 0.1 * before_largest || largest > 0.05;
    before_largest = largest;
  }
  t->factored_c0 = 0.0;
  return SB_ERROR_NOT_CONVERGED;
}
