// A film between asperities marched over the contact at rest, as a start for Newton's method.
//
// With the total pressure q_r(x) and the gap h_r(x) of a contact, and a local stiffness E of the
// body instead of its full compliance, the film is one-dimensional:
//
//   p = q_r + E (h - h_r) - p_s(h)             p_s pressure of the solids
//   p' = S(h) = (lambda h - kappa)/(h^3 phi_p m)     where the film is full; p = 0 in the cavity
//
// S increases with h below 3/2 of the flux film kappa/lambda (less with a flow factor,
// sb_ehl_rough_steepest()) and decreases above it: below, the
// film depends on the downstream side, above on the upstream side (the splitting of Engquist and
// Osher, Math. Comput. 36 (1981) 321). So a film that the wall transports is marched against the
// flow, implicitly below and explicitly above; a flow that the end pressures drive through gaps
// above everywhere is marched along with it. For a wall at rest S increases with h throughout.
// kappa, of the wall or of the end pressures, is determined by the pressure at the other end.
// Fronts, however sharp, are then at their positions. Once q_r and h_r are those of a contact
// sealed with the film's own pressure, E has no effect: the march over it is a solution except for
// the discretisation.
#include "engine/film/ehl.h"

#include "engine/numeric/root.h"

#include <math.h>

// E, scaled: deflections cos(k X) have k, and inlet pressure must not enlarge gaps next to the
// contact without limit.
static const double STIFFNESS = 50;

// Film pressures beyond these scaled ones are those of a wrong flow.
static const double TENSION = -1, HIGH = 10;

// What a march wants of a sample.
typedef struct {
  const SbEhlCase *c;
  double offset; // q_r - E h_r
  double p;      // film pressure, here or where a step of `width` begins
  double width;  // of an implicit step, along with the flow negative; 0: none
  double kappa;
} Local;

static double mobility(const SbEhlCase *c, double h, double p) {
  double m, m_h, m_p;
  sb_film_mobility(&m, &m_h, &m_p, &c->fluid, h, fmax(p, 0));
  return m;
}

// S(h) at the pressure of the step's begin.
static double slope_at(const Local *l, const SbEhlRoughPoint *at) {
  return (l->c->layers.lambda * at->drag - l->kappa) /
         (at->h * at->h * at->h * at->flow * mobility(l->c, at->h, l->p));
}

static double film_pressure(const Local *l, const SbEhlRoughPoint *at) {
  return l->offset + STIFFNESS * at->h - at->solid;
}

// Parameter of the gap with the wanted pressure, from a guess: Newton's method in a bracket.
static double settle(SbEhlRoughPoint *at, const Local *l, double t) {
  enum { ITERATIONS = 60 };
  static const double CLOSE = 1e-6;
  double low = -INFINITY, high = INFINITY;
  for (int i = 0; i < ITERATIONS; i++) {
    sb_ehl_rough_point(at, l->c, t);
    double lack = film_pressure(l, at) - l->p, rise = STIFFNESS;
    if (l->width != 0) {
      const double S = slope_at(l, at), n = 3 + at->h * at->flow_h / at->flow;
      lack += l->width * S;
      rise += l->width * (l->c->layers.lambda * at->drag_h / (at->h * at->h * at->h * at->flow) -
                          n * S / at->h);
    }
    rise = rise * at->h_t - at->solid_t;
    *(lack > 0 ? &high : &low) = t;
    const double side = lack > 0 ? -1 : 1;
    double next = t + fmax(rise > 0 ? -lack / rise : side, -fmax(1.5, 0.5 * t));
    if (!(next > low && next < high)) {
      next = isfinite(low) && isfinite(high) ? 0.5 * (low + high) : t + side;
    }
    if (fabs(next - t) < CLOSE * (1 + fabs(t))) {
      break;
    }
    t = next;
  }
  return t;
}

static void put(SbEhlMarch *a, int i, double t, double p, bool cavity) {
  a->t[i] = t;
  a->p[i] = p;
  a->cavity[i] = cavity;
}

// Marches along with the flow from the inlet; the outlet's pressure over that found there.
static double march_along(SbEhlMarch *a, const SbEhlCase *c, double kappa) {
  const double most = HIGH * (1 + c->layers.outlet);
  Local l = {c, a->offset[0], c->layers.inlet, 0, kappa};
  SbEhlRoughPoint at;
  double t = a->t[0];
  for (int i = 0; i < a->count && l.p < most; i++) {
    l.offset = a->offset[i];
    l.width = i > 0 ? a->x[i - 1] - a->x[i] : 0;
    t = settle(&at, &l, t);
    l.p = film_pressure(&l, &at);
    put(a, i, t, l.p, false);
  }
  return c->layers.outlet - l.p;
}

// Marches with a flow; how much the inlet's pressure comes out too high (or the outlet's too low),
// negative where more must flow in.
static double march(SbEhlMarch *a, const SbEhlCase *c, double kappa) {
  const double lambda = c->layers.lambda;
  const bool moves = lambda > 0;
  const double steepest = moves && kappa > 0 ? sb_ehl_rough_steepest(c, kappa / lambda) : INFINITY;
  const double most = HIGH * (1 + c->layers.outlet);
  int i = a->count - 1;
  Local l = {c, a->offset[i], c->layers.outlet, 0, kappa};
  SbEhlRoughPoint at, edge = {0};
  bool thin = false, broken = false, again = false;
  double p = l.p;
  if (kappa > 0) {
    const double t_edge = moves ? sb_ehl_rough_of_gap(c, steepest) : INFINITY;
    if (moves) {
      sb_ehl_rough_point(&edge, c, t_edge);
    }
    double t = settle(&at, &l, a->t[i]);
    put(a, i, t, p, false);
    while (--i >= 0 && p > TENSION && p < most) {
      const double width = a->x[i + 1] - a->x[i];
      l.p = p;
      l.width = 0;
      double S = moves ? slope_at(&l, at.h > steepest ? &at : &edge) : 0;
      l.offset = a->offset[i];
      // An implicit step while that stays below the steepest.
      const bool below = !moves || (at.h < steepest && film_pressure(&l, &edge) + width * S > p);
      thin = thin || !moves || at.h < steepest;
      if (below) {
        l.width = width;
        t = settle(&at, &l, fmin(t, t_edge));
        p = film_pressure(&l, &at);
      } else {
        p -= width * S;
      }
      const bool cavity = p < 0 && !again;
      again = !cavity && broken;
      broken = broken || cavity;
      p = cavity ? 0 : p;
      if (!below || cavity) {
        l.width = 0;
        l.p = p;
        t = settle(&at, &l, t);
      }
      put(a, i, t, p, cavity);
    }
  }
  if (!thin || !(p > TENSION && p < most)) {
    return thin ? p : march_along(a, c, kappa);
  }
  return broken && !again ? TENSION : p - c->layers.inlet;
}

// Samples of a contact, with its own parameter for a guess.
static void sample(SbEhlMarch *a, const SbEhlSolution *s) {
  const SbEhlMesh *mesh = &s->mesh;
  a->count = 0;
  for (int i = 0; i < mesh->dofs; i++) {
    const SbEhlElement *e = &mesh->element[mesh->owner[i > 0 ? i - 1 : 0]];
    for (int k = i > 0 ? 1 : SB_EHL_PARTS; k <= SB_EHL_PARTS; k++) {
      const double last = mesh->x[i > 0 ? i - 1 : 0];
      const double X = last + (mesh->x[i] - last) * k / SB_EHL_PARTS;
      const double r = sb_ehl_coordinate(e, X);
      SbEhlRoughPoint at;
      a->x[a->count] = X;
      a->t[a->count] = sb_ehl_interpolate(e->table, &s->state.t[e->first_dof], r);
      sb_ehl_rough_point(&at, &s->c, a->t[a->count]);
      a->offset[a->count++] = sb_ehl_pressure(NULL, e, s->state.nodal, r) - STIFFNESS * at.h;
    }
  }
}

bool sb_ehl_march(const SbEhlSolution *s) {
  enum { DOUBLINGS = 12, DECADES = 20, HALVINGS = 60 };
  static const double CLOSE = 1e-9;
  SbEhlMarch *a = &s->solver->march;
  const SbEhlCase *c = &s->c;
  sample(a, s);
  // A bracket: above the flux film expected, to what the end pressures may drive, below it, or
  // against the wall.
  SbEhlRoughPoint at;
  sb_ehl_rough_point(&at, c, a->t[a->count / 2]);
  const bool moves = c->layers.lambda > 0;
  double high = moves ? c->layers.lambda * c->rough.flux : pow(at.h, 3), low = high;
  bool more = march(a, c, high) < 0;
  for (int i = 0; more && i < DOUBLINGS + DECADES; i++) {
    low = high;
    high *= i < DOUBLINGS ? 2 : 10;
    more = march(a, c, high) < 0;
  }
  bool less = low == high;
  for (int i = 0; less && i < DECADES; i++) {
    high = low;
    low = i < DECADES / 4 ? 0.3 * low : i == DECADES / 4 ? -low : 10 * low;
    less = march(a, c, low) >= 0;
  }
  if (more || less) {
    return false;
  }
  for (int i = 0; i < HALVINGS && high - low > CLOSE * fmax(fabs(high), fabs(low)); i++) {
    const double middle = low * high > 0 ? copysign(sqrt(low * high), high) : 0.5 * (low + high);
    *(march(a, c, middle) < 0 ? &low : &high) = middle;
  }
  a->flow = high;
  return march(a, c, high) < INFINITY;
}

void sb_ehl_march_state(SbEhlSolution *s, bool sealed) {
  const SbEhlMarch *a = &s->solver->march;
  const SbEhlCase *c = &s->c;
  SbEhlState *state = &s->state;
  const Local l = {.c = c, .kappa = a->flow};
  for (int i = 0; i < s->mesh.dofs; i++) {
    const double X = s->mesh.x[i];
    const size_t k = sb_interval(a->x, (size_t)a->count, X);
    const double f = fmin(fmax((X - a->x[k]) / (a->x[k + 1] - a->x[k]), 0), 1);
    const double p = a->p[k] + f * (a->p[k + 1] - a->p[k]);
    SbEhlRoughPoint at;
    state->t[i] = a->t[k] + f * (a->t[k + 1] - a->t[k]);
    sb_ehl_rough_point(&at, c, state->t[i]);
    state->nodal[i] = p + at.solid;
    state->given[i] = p;
    state->cavity[i] = sealed || a->cavity[f < 0.5 ? k : k + 1];
    state->s[i] = sealed ? 0 : slope_at(&l, &at);
  }
  state->flow = sealed ? 0 : a->flow;
  state->H0 = 0;
}
