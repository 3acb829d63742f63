// Elements and elastic kernel of the mixed-film solver.
//
// Element sizes grow with the distance from the contact's two edges, where the layers of the film
// (lambda^0.4, ehl_layers.h) or the tail of the asperities (sigma^(2/3): the dry gap opens with the
// power 3/2) sit. The gap of a polynomial pressure under the logarithmic kernel is exact: with z
// the target's coordinate in the element, integral of P_k(r) ln|z - r| = 2/(2k+1) (Q_(k+1) -
// Q_(k-1))(z), Legendre functions of the second kind (as ehl_mesh.c; here for all z, by their
// downward recurrence away from the element). Far pressures and their tilt: docs/verification.md as
// in ehl_mesh.c. A fitted body's share of kernel and gap: ehl_fitted.c.
#include "engine/film/ehl_rough.h"

#include "engine/numeric/legendre.h"

#include <math.h>
#include <string.h>

const SbEhlRoughRule *sb_ehl_rough_rule(SbEhlRoughSolver *solver, int degree) {
  SbEhlRoughRule *rule = &solver->rule[degree];
  if (rule->degree == degree) {
    return rule;
  }
  rule->degree = degree;
  sb_legendre_lobatto(rule->node, degree);
  sb_barycentric_weights(rule->bary, rule->node, degree + 1);
  double gauss[SB_EHL_ROUGH_DEGREE_MAX + 1], weight[SB_EHL_ROUGH_DEGREE_MAX + 1];
  int points = degree + 1;
  sb_legendre_gauss(gauss, weight, points);
  memset(rule->project, 0, sizeof rule->project);
  for (int g = 0; g < points; g++) {
    double basis[SB_EHL_ROUGH_DEGREE_MAX + 1], mode[SB_EHL_ROUGH_DEGREE_MAX + 1];
    sb_barycentric_basis(basis, gauss[g], rule->node, rule->bary, degree + 1);
    sb_legendre_values(mode, gauss[g], degree);
    for (int k = 0; k <= degree; k++) {
      for (int j = 0; j <= degree; j++) {
        rule->project[k][j] += 0.5 * (2 * k + 1) * weight[g] * mode[k] * basis[j];
      }
    }
  }
  for (int i = 0; i <= degree; i++) {
    sb_barycentric_slope(rule->slope[i], rule->node[i], rule->node, rule->bary, degree + 1);
  }
  for (int k = 1; k < SB_EHL_ROUGH_DOWN; k++) {
    rule->down[k][0] = (2.0 * k + 1) / k;
    rule->down[k][1] = (k + 1.0) / k;
  }
  for (int j = 0; j < degree; j++) {
    sb_ehl_rough_partial(rule->step[j], rule, j, rule->node[j + 1]);
  }
  return rule;
}

void sb_ehl_rough_partial(double *weight, const SbEhlRoughRule *rule, int j, double r) {
  double gauss[SB_EHL_ROUGH_DEGREE_MAX], w[SB_EHL_ROUGH_DEGREE_MAX];
  int points = rule->degree / 2 + 1;
  sb_legendre_gauss(gauss, w, points);
  double from = rule->node[j];
  memset(weight, 0, (size_t)(rule->degree + 1) * sizeof *weight);
  for (int g = 0; g < points; g++) {
    double basis[SB_EHL_ROUGH_DEGREE_MAX + 1];
    sb_barycentric_basis(basis, from + 0.5 * (r - from) * (1 + gauss[g]), rule->node, rule->bary,
                         rule->degree + 1);
    for (int k = 0; k <= rule->degree; k++) {
      weight[k] += 0.5 * (r - from) * w[g] * basis[k];
    }
  }
}

// out[k] = integral over [-1, 1] of P_k(r) ln|z - r|, k = 0 .. n.
static void moments(double *out, const SbEhlRoughRule *rule, double z, int n) {
  double plus = log(fmax(fabs(z + 1), 1e-40));
  double minus = log(fmax(fabs(z - 1), 1e-40));
  out[0] = (z + 1) * plus - (z - 1) * minus - 2;
  double Q[SB_EHL_ROUGH_DOWN];
  Q[0] = 0.5 * (plus - minus);
  if (fabs(z) < 1.2) {
    Q[1] = z * Q[0] - 1;
    for (int k = 1; k <= n; k++) {
      Q[k + 1] = ((2 * k + 1) * z * Q[k] - k * Q[k - 1]) / (k + 1);
    }
  } else {
    // Downwards from far enough that the start is forgotten (rho^-2 each step), then scaled; Q_0
    // by its series where the logarithms cancel.
    double a = fabs(z);
    double rho = a + sqrt(a * a - 1);
    int extra = (int)(18 / log(rho)) + 2;
    int top = n + 1 + (extra < 40 ? extra : 40);
    Q[top + 1] = 0;
    Q[top] = 1e-200;
    for (int k = top; k >= 1; k--) {
      Q[k - 1] = rule->down[k][0] * z * Q[k] - rule->down[k][1] * Q[k + 1];
    }
    double zero = a > 30 ? (1 + (1 / 3.0 + (0.2 + 1 / (7 * z * z)) / (z * z)) / (z * z)) / z
                         : 0.5 * (plus - minus);
    double scale = zero / Q[0];
    for (int k = 0; k <= n + 1; k++) {
      Q[k] *= scale;
    }
  }
  for (int k = 1; k <= n; k++) {
    out[k] = 2.0 / (2 * k + 1) * (Q[k + 1] - Q[k - 1]);
  }
}

// x (ln|x| - 1): the gap of a constant pressure on a half-line, up to tilt and constant.
static double half_line(double x) {
  return x == 0 ? 0 : x * (log(fabs(x)) - 1);
}

static void build_kernel(SbEhlRoughMesh *mesh, const SbEhlRoughRule *rule) {
  int degree = rule->degree;
  int nodes = mesh->nodes;
  memset(mesh->load, 0, (size_t)nodes * sizeof(double));
  for (int e = 0; e < mesh->elements; e++) {
    double half = 0.5 * (mesh->edge[e + 1] - mesh->edge[e]);
    for (int j = 0; j <= degree; j++) {
      mesh->load[e * degree + j] += 2 * half * rule->project[0][j];
    }
  }
  double in = mesh->inlet / M_PI, out = mesh->outlet / M_PI;
  for (int i = 0; i < nodes; i++) {
    double *row = mesh->kernel + (size_t)i * (size_t)nodes;
    double X = mesh->x[i];
    memset(row, 0, (size_t)nodes * sizeof *row);
    for (int e = 0; e < mesh->elements; e++) {
      double half = 0.5 * (mesh->edge[e + 1] - mesh->edge[e]);
      double z = (X - 0.5 * (mesh->edge[e] + mesh->edge[e + 1])) / half;
      double moment[SB_EHL_ROUGH_DEGREE_MAX + 1];
      moments(moment, rule, z, degree);
      moment[0] += 2 * log(half);
      for (int j = 0; j <= degree; j++) {
        double sum = 0;
        for (int k = 0; k <= degree; k++) {
          sum += moment[k] * rule->project[k][j];
        }
        row[e * degree + j] -= half * sum / M_PI;
      }
    }
    mesh->known[i] = in * half_line(X - mesh->edge[0]) -
                     out * half_line(X - mesh->edge[mesh->elements]) + (in - out) * M_LN2 * X;
  }
}

double sb_ehl_rough_load(const SbEhlRoughMesh *mesh, const double *q) {
  double sum = -0.5 * M_PI + mesh->inlet * (mesh->edge[0] + mesh->shift) -
               mesh->outlet * (mesh->edge[mesh->elements] + mesh->shift);
  for (int i = 0; i < mesh->nodes; i++) {
    sum += mesh->load[i] * q[i];
  }
  return sum;
}

// X > 1 where the dry gap reaches `gap`.
static double dry_reach(double gap) {
  double low = 1, high = 2;
  while (sb_film_dry_gap(high) < gap) {
    high *= 2;
  }
  for (int i = 0; i < 60; i++) {
    double middle = 0.5 * (low + high);
    if (sb_film_dry_gap(middle) < gap) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return high;
}

// Width of what has to be resolved at the edges: of the film's layer, or of the asperities' tail.
static double edge_width(const SbEhlRoughCase *c, double layer) {
  double width = c->lambda > 0 ? layer : 0;
  if (c->law != NULL) {
    double sigma = c->law->surface.sigma / c->film;
    // Where the asperities' pressure at the flux film is a small part q of Hertz's, the mouth of
    // the film lies q^2/2 inside the edge.
    double tail = 0.5 * fmin(pow(sigma, 2.0 / 3), sqrt(2 * sigma));
    width = fmax(width, c->lambda > 0 ? fmin(tail, 1 - c->mouth) : tail);
  }
  return width;
}

// A place about which elements shrink to `width`.
typedef struct {
  double X, width;
} Feature;

// Adds a feature unless those before resolve it, in order of X.
static int add_feature(Feature *feature, int count, double X, double width, double reach) {
  if (!(fabs(X) < reach)) {
    return count;
  }
  int at = 0;
  for (int i = 0; i < count; i++) {
    if (fabs(X - feature[i].X) < 0.1 * width) {
      feature[i].width = fmin(feature[i].width, width);
      return count;
    }
    at += feature[i].X < X;
  }
  for (int i = count; i > at; i--) {
    feature[i] = feature[i - 1];
  }
  feature[at] = (Feature){X, width};
  return count + 1;
}

// Places of element ends from feature `f` to X, growing with the distance. Returns how many.
static int march(double *edge, int room, const Feature *f, double to, double grow) {
  double distance = fabs(to - f->X);
  // ln(1 + d/w) grows evenly: the first element has about w times `grow`.
  double total = log1p(distance / f->width);
  int n = (int)ceil(total / log1p(grow) - 1e-9);
  n = n < 1 ? 1 : n;
  for (int i = 1; i <= n && i <= room; i++) {
    double d = i == n ? distance : f->width * expm1(total * i / n);
    edge[i - 1] = to > f->X ? f->X + d : f->X - d;
  }
  return n;
}

bool sb_ehl_rough_mesh(SbEhlRoughMesh *mesh, const SbEhlRoughRule *rule, const SbEhlRoughCase *c,
                       double fineness) {
  static const double GROWTH = 0.75;
  const SbEhlLayers *l = &c->layers;
  double thin = sb_ehl_layers_width(l);
  double unit = sqrt(1.44 + 0.52 * c->lambda); // length of the rigid wedge
  bool thick = c->lambda > 0 && thin > 1;

  // Reach: the film's pressure falls like (4/3) lambda / X^3, the asperities' with the gap.
  double tail = 1.5;
  if (c->law != NULL) {
    SbRoughPoint end;
    sb_rough_law_at(&end, c->law, sb_rough_law_of_pressure(c->law, 1e-13 * c->pressure));
    tail = dry_reach(end.gap / c->film);
  }
  double film_reach = fmax(3, sqrt(c->lambda * 4e6));

  // The edges: the flux needs the inlet's layer, the least film the outlet's, which is finer.
  Feature feature[6] = {
      {thick ? -0.6 * unit : -1, fmin(edge_width(c, thick ? 0.6 * unit : thin), unit)},
      {thick ? 0.7 * unit : 1, fmin(edge_width(c, thick ? 0.3 * unit : 0.35 * thin), unit)}};
  int features = 2;
  double left = c->lambda > 0 ? fmax(tail, film_reach) : tail;
  double right = fmax(tail, feature[1].X + 3 * feature[1].width);
  right = thick ? fmax(right, 2 * unit) : right;
  right = c->layers.outlet > 0 ? fmax(right, film_reach) : right;
  if (!(c->lambda > 0) && c->layers.inlet != c->layers.outlet) {
    left = right = fmax(fmax(left, right), 3);
  }
  if (!thick) {
    features = add_feature(feature, features, 0, 0.4, left); // no coarser in the middle
  }
  // The mouths of a film between asperities, where it hands the load over.
  for (int i = 0; i < 2; i++) {
    features = add_feature(feature, features, c->front[i].X, c->front[i].width, 0.98 * left);
  }

  // From every feature halfway to its neighbours.
  double grow = GROWTH / fineness;
  int n = 0;
  double piece[SB_EHL_ROUGH_ELEMENTS_MAX];
  mesh->edge[n++] = -left;
  for (int f = 0; f < features; f++) {
    const Feature *here = &feature[f];
    double from = mesh->edge[n - 1];
    int count = march(piece, SB_EHL_ROUGH_ELEMENTS_MAX, here, from, grow);
    if (n + count >= SB_EHL_ROUGH_ELEMENTS_MAX) {
      return false;
    }
    for (int i = count - 2; i >= 0; i--) {
      mesh->edge[n++] = piece[i];
    }
    mesh->edge[n++] = here->X;
    double to = right;
    if (f < features - 1) {
      const Feature *next = &feature[f + 1];
      to = 0.5 * (here->X + next->X + next->width - here->width);
      double margin = 0.05 * (next->X - here->X);
      to = fmin(fmax(to, here->X + margin), next->X - margin);
    }
    count = march(&mesh->edge[n], SB_EHL_ROUGH_ELEMENTS_MAX - n, here, to, grow);
    n += count;
    if (n > SB_EHL_ROUGH_ELEMENTS_MAX) {
      return false;
    }
  }
  int elements = n - 1;
  int nodes = elements * rule->degree + 1;
  if (nodes > SB_EHL_ROUGH_NODES_MAX) {
    return false;
  }
  mesh->nodes = nodes;
  mesh->elements = elements;
  mesh->degree = rule->degree;
  mesh->inlet = c->layers.inlet;
  mesh->outlet = c->layers.outlet;
  for (int e = 0; e < elements; e++) {
    double a = mesh->edge[e], b = mesh->edge[e + 1];
    for (int k = 0; k <= rule->degree; k++) {
      mesh->x[e * rule->degree + k] = 0.5 * (a + b) + 0.5 * (b - a) * rule->node[k];
    }
  }
  mesh->shift = l->middle;
  build_kernel(mesh, rule);
  if (c->body.compliance != NULL) {
    sb_ehl_rough_fitted(mesh, rule, c);
  } else {
    for (int i = 0; i < nodes; i++) {
      mesh->known[i] += 0.5 * mesh->x[i] * mesh->x[i];
    }
  }
  return true;
}

int sb_ehl_rough_locate(const SbEhlRoughMesh *mesh, double X, double *r) {
  int low = 0, high = mesh->elements;
  while (high - low > 1) {
    int middle = (low + high) / 2;
    if (X >= mesh->edge[middle]) {
      low = middle;
    } else {
      high = middle;
    }
  }
  double a = mesh->edge[low], b = mesh->edge[low + 1];
  *r = fmin(fmax((2 * X - a - b) / (b - a), -1), 1);
  return low;
}

double sb_ehl_rough_value(const SbEhlRoughMesh *mesh, const SbEhlRoughRule *rule,
                          const double *field, int e, double r) {
  double basis[SB_EHL_ROUGH_DEGREE_MAX + 1];
  sb_barycentric_basis(basis, r, rule->node, rule->bary, rule->degree + 1);
  double sum = 0;
  for (int k = 0; k <= rule->degree; k++) {
    sum += basis[k] * field[e * mesh->degree + k];
  }
  return sum;
}
