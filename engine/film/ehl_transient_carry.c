// Transport of the heights of the transient film with the fluid, and to another mesh.
//
// The integral of the height over the cells, known at their faces, is interpolated and
// differentiated: mass is conserved exactly.
#include "engine/film/ehl_transient.h"

#include "engine/numeric/legendre.h"
#include "engine/numeric/root.h"

#include <cblas.h>
#include <gsl/gsl_statistics.h>
#include <math.h>
#include <string.h>

enum { SIDE = 3, FACES = 2 * SIDE };

bool sb_transient_front(const double *height, int count, double factor) {
  double least, most;
  gsl_stats_minmax(&least, &most, height, 1, (size_t)count);
  return most > factor * least;
}

static void integrate(SbTransientCells *out, const double *X, const double *height, int from,
                      int to) {
  out->from = from;
  out->to = to;
  out->height = height;
  for (int i = from; i <= to; i++) {
    out->place[i] = 0.5 * (X[i] + X[i + 1]);
    const double width = i > from ? out->place[i] - out->place[i - 1] : 0.0;
    out->integral[i] = i > from ? out->integral[i - 1] + width * height[i] : 0.0;
  }
}

// The integral up to X by a polynomial through the faces about it; a front by Hermite's cubic with
// harmonic means for slopes, which rises throughout.
static double integral_to(const SbTransientCells *cells, double X) {
  const double *place = cells->place, *integral = cells->integral;
  // X is between faces k and k + 1.
  const int start = cells->from + SIDE;
  const int k = start + (int)sb_interval(&place[start], (size_t)(cells->to - SIDE - start + 2), X);
  if (sb_transient_front(cells->height + k - SIDE + 2, FACES - 1, 6.0)) {
    const double *m = cells->height + k;
    const double end[] = {2.0 * m[0] * m[1] / (m[0] + m[1]), 2.0 * m[2] * m[1] / (m[2] + m[1])};
    const double h = place[k + 1] - place[k];
    double slope;
    return sb_hermite(&slope, (X - place[k]) / h, h, &integral[k], end);
  }
  const double *node = &place[k - SIDE + 1];
  double bary[FACES], basis[FACES];
  sb_barycentric_weights(bary, node, FACES);
  sb_barycentric_basis(basis, X, node, bary, FACES);
  return cblas_ddot(FACES, basis, 1, &integral[k - SIDE + 1], 1);
}

void sb_transient_transport(double *out, SbFilmTransient *t, const double *height, double travel) {
  const int n = t->nodes;
  memcpy(out, height, (size_t)n * sizeof *out);
  int first = 0;
  while (first < n && t->face[first].carried == 0.0) {
    first++;
  }
  if (first == n || travel == 0.0) {
    return;
  }
  SbTransientCells *cells = &t->cells;
  integrate(cells, t->X, height, first - FACES, n - 2 - first + FACES);
  double before = cells->integral[first - 1];
  for (int i = first; i <= n - 1 - first; i++) {
    const double value = integral_to(cells, t->face[i].X - t->face[i].carried * travel);
    out[i] = (value - before) / t->volume[i];
    before = value;
  }
}

// Pressure by the cubic through four nodes about X; they only start Newton's method.
static double cubic(const double *X, const double *value, int nodes, double at) {
  double bary[4], basis[4];
  const int k = (int)sb_interval(X, (size_t)nodes, at);
  const int first = k < 1 ? 0 : k + 3 > nodes ? nodes - 4 : k - 1;
  sb_barycentric_weights(bary, &X[first], 4);
  sb_barycentric_basis(basis, at, &X[first], bary, 4);
  return cblas_ddot(4, basis, 1, &value[first], 1);
}

static void remap_state(SbTransientState *s, SbFilmTransient *t, int nodes) {
  static const size_t SIZE = sizeof(double);
  const int n = t->nodes, side = t->side;
  const double *X = t->old_X;
  SbTransientState *old = &t->next;
  *old = *s;
  // The sides stay, with their nodes.
  const size_t right = (size_t)side;
  memcpy(s->P + n - side, old->P + nodes - side, right * SIZE);
  memcpy(s->H + n - side, old->H + nodes - side, right * SIZE);
  memcpy(s->m + n - side, old->m + nodes - side, right * SIZE);
  memcpy(s->cavity + n - side, old->cavity + nodes - side, right * sizeof(bool));
  SbTransientCells *cells = &t->cells;
  integrate(cells, X, old->m, side - 2 - FACES, nodes - side + FACES);
  double before = cells->integral[side - 2];
  for (int i = side - 1; i <= n - side; i++) {
    const bool last = i == n - side;
    const double value = last ? cells->integral[nodes - side] : integral_to(cells, t->face[i].X);
    s->m[i] = (value - before) / t->volume[i];
    before = value;
    const int k = (int)sb_interval(X, (size_t)nodes, t->X[i]);
    const int near = t->X[i] - X[k] < X[k + 1] - t->X[i] ? k : k + 1;
    s->cavity[i] = old->cavity[near];
    s->P[i] = s->cavity[i] ? 0.0 : fmax(cubic(X, old->P, nodes, t->X[i]), 0.0);
    s->H[i] = s->cavity[i] ? fmax(cubic(X, old->H, nodes, t->X[i]), s->m[i]) : s->m[i];
  }
}

void sb_transient_remap(SbFilmTransient *t, int nodes) {
  SbTransientState *const state[] = {&t->now, &t->before, &t->earlier};
  for (int k = 0; k < 3; k++) {
    if (k < t->known_times) {
      remap_state(state[k], t, nodes);
    }
  }
}
