// Elements of rough rows.
//
// Element sizes grow with the distance from the contact's two edges, where the layers of the film
// (lambda^0.4, ehl_layers.c) or the tail of the asperities (sigma^(2/3): the dry gap opens with the
// power 3/2) are, and with the distance from the film's ends between asperities.
#include "engine/film/ehl.h"

#include "engine/numeric/root.h"

#include <math.h>

static double lacking_gap(double X, const void *gap) {
  return *(const double *)gap - sb_film_dry_gap(X);
}

// X > 1 where the dry gap, at least (2 sqrt(2) / 3) (X - 1)^(3/2), reaches `gap`.
static double dry_reach(double gap) {
  return sb_bisect(lacking_gap, &gap, 1, 1.1 + pow(3 / sqrt(8.0) * gap, 2.0 / 3));
}

// Width of what has to be resolved at the edges: of the film's layer, or of the asperities' tail.
static double edge_width(const SbEhlCase *c, double layer) {
  double width = c->layers.lambda > 0 ? layer : 0;
  if (c->rough.law != NULL) {
    double sigma = c->rough.law->surface.sigma / c->rough.film;
    // Where the asperities' pressure at the flux film is a small part q of Hertz's, the film's
    // inlet is q^2/2 inside the edge.
    double tail = 0.5 * fmin(pow(sigma, 2.0 / 3), sqrt(2 * sigma));
    width = fmax(width, c->layers.lambda > 0 ? fmin(tail, 1 - c->rough.inlet) : tail);
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

// Growth of elements with the distance from a feature, and of coarse ones. A singularity there
// bends the polynomials so that two degrees more leave 2 and 5 hundredths of their error
// (Bernstein's ellipse about an element through it).
static const double GROWTH[] = {0.75, 1.5};

// Adds the elements between a feature and X, growing with the distance: the first has about the
// feature's width times the growth.
static void add_half(SbEhlMesh *mesh, const Feature *f, double to, const SbEhlCase *c) {
  const double growth = GROWTH[c->rough.coarse];
  const bool before = to < f->X;
  double distance = fabs(to - f->X);
  double total = log1p(distance / f->width); // ln(1 + d/w) grows evenly
  int n = (int)fmax(1.0, ceil(total / log1p(growth) - 1e-9));
  for (int i = 1; i <= n; i++) {
    int k = before ? n - i : i;
    double d = k == n ? distance : f->width * expm1(total * k / n);
    sb_ehl_mesh_add(mesh, SB_EHL_AFFINE, before ? f->X - d : f->X + d, c->layers.degree);
  }
}

bool sb_ehl_rough_mesh(SbEhlSolution *s) {
  const SbEhlCase *c = &s->c;
  const SbEhlLayers *l = &c->layers;
  double thin = sb_ehl_layers_width(l);
  const double thin_outlet = sb_ehl_layers_outlet_width(l);
  double unit = sqrt(1.44 + 0.52 * c->layers.lambda); // length of the rigid wedge
  bool thick = c->layers.lambda > 0 && thin > 1;

  // Reach: the film's pressure falls like (4/3) lambda / X^3, the asperities' with the gap.
  double tail = 1.5;
  if (c->rough.law != NULL) {
    SbRoughPoint end;
    sb_rough_law_at(&end, c->rough.law,
                    sb_rough_law_of_pressure(c->rough.law, 1e-13 * c->rough.pressure));
    tail = dry_reach(end.gap / c->rough.film);
  }
  double film_reach = fmax(3, sqrt(c->layers.lambda * 4e6));

  // The edges: the flux needs the inlet's layer, the minimum film the outlet's, which is finer.
  const double outlet = c->layers.lambda > 0 ? sb_ehl_layers_outlet(l) : 1;
  Feature feature[3 + SB_EHL_FRONTS] = {
      {thick ? -0.6 * unit : -1, fmin(edge_width(c, thick ? 0.6 * unit : thin), unit)},
      {thick ? 0.7 * unit : outlet,
       fmin(edge_width(c, thick ? 0.3 * unit : 0.35 * thin_outlet), unit)}};
  int features = 2;
  double left = c->layers.lambda > 0 ? fmax(tail, film_reach) : tail;
  // The film breaks where the gap opens to the flux film, which is the inlet's.
  const double opening = fmin(edge_width(c, thick ? 0.3 * unit : 0.35 * thin), unit);
  double right = fmax(tail, feature[1].X + 3 * opening);
  right = thick ? fmax(right, 2 * unit) : right;
  right = c->layers.outlet > 0 ? fmax(right, film_reach) : right;
  if (!(c->layers.lambda > 0) && c->layers.inlet != c->layers.outlet) {
    left = right = fmax(fmax(left, right), 3);
  }
  if (!thick) {
    features = add_feature(feature, features, 0, 0.4, left); // no coarser in the middle
  }
  // The ends of a film between asperities, where it hands the load over.
  for (int i = 0; i < SB_EHL_FRONTS; i++) {
    features = add_feature(feature, features, c->rough.front[i].X, c->rough.front[i].width,
                           0.98 * fmin(left, right));
  }

  // From every feature halfway to its neighbours.
  SbEhlMesh *mesh = &s->mesh;
  sb_ehl_mesh_begin(mesh, -left, l->inlet, l->outlet);
  sb_ehl_steps(mesh->tables, l->degree);
  for (int f = 0; f < features; f++) {
    const Feature *here = &feature[f], *next = here + 1;
    double to = right;
    if (f < features - 1) {
      to = 0.5 * (here->X + next->X + next->width - here->width);
      double margin = 0.05 * (next->X - here->X);
      to = fmin(fmax(to, here->X + margin), next->X - margin);
    }
    add_half(mesh, here, mesh->end, c);
    add_half(mesh, here, to, c);
  }
  return sb_ehl_mesh_build(mesh, true);
}

// Nodes of a film.
typedef struct {
  int count;
  double flow;
  const double *x, *t;
  const bool *cavity;
  const SbEhlSolution *solution; // that they are of, or NULL
} Nodes;

// Where the film ends between node i and the next one, in the cavity.
static double rupture_behind(const Nodes *at, int i) {
  const SbEhlSolution *s = at->solution;
  if (s == NULL) {
    return 0.5 * (at->x[i] + at->x[i + 1]);
  }
  const SbEhlElement *e = &s->mesh.element[s->mesh.owner[i]];
  double weight[SB_EHL_DEGREE_MAX + 1];
  return sb_ehl_position(e, sb_ehl_rough_weights(weight, s, e, i - e->first_dof));
}

// The film's ends: where it passes 3/2 of the flux film, with the largest slope of its pressure;
// the minimum film, with the steepest fall, unless it cavitates; and the ends of its cavity.
static void find_ends(double place[SB_EHL_FRONTS], const SbEhlCase *c, const Nodes *at) {
  static const double DIP = 0.95; // of the flux film; asperities that carry most leave less
  const double steepest = sb_ehl_rough_steepest(c, at->flow / c->layers.lambda);
  double least = DIP * at->flow / c->layers.lambda;
  SbEhlRoughPoint p;
  sb_ehl_rough_point(&p, c, at->t[0]);
  for (int i = 0; i + 1 < at->count; i++) {
    const double here = p.h;
    sb_ehl_rough_point(&p, c, at->t[i + 1]);
    const double X = at->x[i] + (at->x[i + 1] - at->x[i]) * (steepest - here) / (p.h - here);
    if (at->cavity[i + 1] && !at->cavity[i]) {
      place[SB_EHL_FRONT_RUPTURE] = rupture_behind(at, i);
      place[SB_EHL_FRONT_LEAST] = INFINITY;
      least = 0;
    } else if (at->cavity[i] && !at->cavity[i + 1]) {
      place[SB_EHL_FRONT_OUTLET] = 0.5 * (at->x[i] + at->x[i + 1]);
    } else if (!at->cavity[i] && here < steepest && p.h >= steepest) {
      place[SB_EHL_FRONT_OUTLET] = X;
    } else if (here >= steepest && p.h < steepest && !isfinite(place[SB_EHL_FRONT_INLET])) {
      place[SB_EHL_FRONT_INLET] = X;
    }
    if (p.h < least) {
      least = p.h;
      place[SB_EHL_FRONT_LEAST] = at->x[i + 1];
    }
  }
}

// How sharp the ends are: there Reynolds' equation and q = p + p_a(h) leave a layer of length k h^3
// / lambda, k the asperities' stiffness.
static bool take_ends(SbEhlCase *c, const double place[SB_EHL_FRONTS], double flow) {
  static const double EDGE = 1e-6; // so close to an edge its elements serve
  bool follow = false;
  for (int k = 0; k < SB_EHL_FRONTS; k++) {
    const double inside = fabs(1 - fabs(place[k]));
    c->rough.front[k].X = INFINITY;
    if (!(isfinite(place[k]) && inside > EDGE)) {
      continue;
    }
    SbEhlRoughPoint p;
    sb_ehl_rough_point(&p, c, sb_ehl_rough_of_gap(c, flow / c->layers.lambda));
    double layer = -p.solid_t / p.h_t * p.h * p.h * p.h * p.flow / c->layers.lambda;
    bool sharp = layer < 0.5 * inside && p.asperity > 1e-3;
    if (sharp || (k == SB_EHL_FRONT_RUPTURE && p.asperity > 1e-3)) {
      c->rough.front[k].X = place[k];
      const double finest = k == SB_EHL_FRONT_LEAST ? 0.05 : 1e-3; // a minimum film is not a kink
      c->rough.front[k].width = fmin(fmax(layer, finest * inside), 0.5 * inside);
    }
    follow = follow || sharp;
  }
  return follow;
}

static double gap_at(const SbEhlCase *c, const Nodes *at, int i) {
  SbEhlRoughPoint p;
  sb_ehl_rough_point(&p, c, at->t[i]);
  return p.h;
}

// The minimum film of all nodes, and how far from it the film is a quarter thicker.
static void take_least(SbEhlCase *c, const Nodes *at) {
  static const double THICKER = 1.25, FINEST = 1e-3;
  int least = 0;
  for (int i = 1; i < at->count; i++) {
    least = gap_at(c, at, i) < gap_at(c, at, least) ? i : least;
  }
  const double rim = THICKER * gap_at(c, at, least);
  double width = INFINITY;
  for (int i = 0; i < at->count; i++) {
    width = gap_at(c, at, i) > rim ? fmin(width, fabs(at->x[i] - at->x[least])) : width;
  }
  c->rough.front[SB_EHL_FRONT_LEAST].X = at->x[least];
  c->rough.front[SB_EHL_FRONT_LEAST].width = fmax(width, FINEST);
}

static bool find_fronts(SbEhlCase *c, const Nodes *at) {
  double place[SB_EHL_FRONTS] = {INFINITY, INFINITY, INFINITY, INFINITY};
  if (c->rough.law != NULL && at->flow > 0 && c->layers.lambda > 0) {
    find_ends(place, c, at);
  }
  const bool follow = take_ends(c, place, at->flow);
  if (c->rough.least && !isfinite(c->rough.front[SB_EHL_FRONT_LEAST].X)) {
    take_least(c, at);
  }
  return follow;
}

bool sb_ehl_rough_fronts(SbEhlCase *c, const SbEhlSolution *s) {
  return find_fronts(
      c, &(Nodes){s->mesh.dofs, s->state.flow, s->mesh.x, s->state.t, s->state.cavity, s});
}

bool sb_ehl_march_fronts(SbEhlCase *c, const SbEhlMarch *march) {
  return find_fronts(c,
                     &(Nodes){march->count, march->flow, march->x, march->t, march->cavity, NULL});
}
