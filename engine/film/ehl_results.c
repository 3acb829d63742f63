// What is read off a solution of the coupled film solver: films, places, friction, and the transfer
// to another mesh. Everything is interpolated at the solver's own order: the pressure
// by its nodal polynomials, the gap through the collocation points and ends of an element.
#include "engine/film/ehl.h"

#include "engine/numeric/root.h"

#include <math.h>
#include <string.h>

// Where an element of the new mesh takes its value at X from in the old one: from the same element,
// moved with the layers, if the two have the same elements, else from its place, not beyond the
// mesh.
static const SbEhlElement *source(double *r, const SbEhlMesh *old, const SbEhlMesh *new, int i,
                                  bool same, double X) {
  const SbEhlElement *e = &old->element[same ? i : sb_ehl_find(old, X)];
  *r = fmin(fmax(sb_ehl_coordinate(same ? &new->element[i] : e, X), -1.0), 1.0);
  return e;
}

// Gap, slope and state of rough rows. Overshoot of the polynomials is limited to the range of the
// adjacent nodes.
static void carry_rough(SbEhlState *new, const SbEhlState *old, int i, const SbEhlElement *e,
                        double r) {
  const int first = e->first_dof;
  const int n = first + (int)sb_interval(e->table->node, (size_t)e->degree + 1, r);
  new->t[i] = sb_ehl_interpolate(e->table, &old->t[first], r);
  new->s[i] = sb_ehl_interpolate(e->table, &old->s[first], r);
  double low = fmin(old->t[n], old->t[n + 1]), high = fmax(old->t[n], old->t[n + 1]);
  double margin = 0.3 * (high - low);
  new->t[i] = fmin(fmax(new->t[i], low - margin), high + margin);
  new->given[i] = sb_ehl_interpolate(e->table, &old->given[first], r);
  new->cavity[i] = old->cavity[n];
}

void sb_ehl_carry(SbEhlSolution *to, const SbEhlSolution *from, double scale) {
  const SbEhlMesh *a = &from->mesh;
  const SbEhlMesh *b = &to->mesh;
  const SbEhlState *old = &from->state;
  SbEhlState *new = &to->state;
  const bool rough = to->c.rough.rows;
  // Towards infinity the gap grows by decades and has no polynomial: its excess over the dry one.
  double *excess = to->solver->gaps;
  for (int i = 0; i < a->targets && !rough; i++) {
    excess[i] = old->gap[i] - sb_ehl_layers_dry_gap(&from->c.layers, a->x[i]);
  }
  // New end pressures change the pressure of the dry contact, unless a cavity separates it from one
  // of them.
  const bool whole = b->film_end + 1 == b->count;
  bool same = !rough && a->count == b->count;
  for (int i = 0; i < b->count; i++) {
    same = same && a->element[i].map == b->element[i].map;
  }
  for (int i = 0; i < b->count; i++) {
    const SbEhlElement *f = &b->element[i];
    for (int k = 0; k <= f->degree; k++) {
      double X = sb_ehl_node(f, k);
      double r;
      const SbEhlElement *e = source(&r, a, b, i, same, X);
      double value = sb_ehl_pressure(NULL, e, old->nodal, r);
      value += whole ? sb_film_dry_pressure(X, b->inlet_pressure, b->outlet_pressure) -
                           sb_film_dry_pressure(X, a->inlet_pressure, a->outlet_pressure)
                     : 0.0;
      new->nodal[f->first_dof + k] = sb_ehl_nodal(f, k, value);
      if (rough) {
        carry_rough(new, old, f->first_dof + k, e, r);
      }
    }
  }
  for (int i = 0; i < b->targets && !rough; i++) {
    double r;
    const SbEhlElement *e = source(&r, a, b, b->owner[i], same, b->x[i]);
    bool infinite = e->side != 0;
    double gap = sb_ehl_gap(e, infinite ? excess : old->gap, r);
    new->gap[i] = scale *gap + (infinite ? sb_ehl_layers_dry_gap(&to->c.layers, b->x[i]) : 0.0);
  }
  new->H0 = old->H0;
  new->shift = old->shift;
  new->flux = scale * old->flux;
  new->flow = old->flow;
}

// What is sampled over an element: the pressure (negative), or what the gap grows with, the gap
// itself or the parameter of rough rows.
typedef struct {
  const SbEhlSolution *s;
  const SbEhlElement *e;
  bool pressure;
} Sample;

static double sampled(double r, const void *context) {
  const Sample *of = context;
  const SbEhlState *state = &of->s->state;
  return of->pressure          ? -sb_ehl_pressure(NULL, of->e, state->nodal, r)
         : of->s->c.rough.rows ? sb_ehl_interpolate(of->e->table, &state->t[of->e->first_dof], r)
                               : sb_ehl_gap(of->e, state->gap, r);
}

// Returns the smallest value over the element of a target and its neighbours, and its position.
static double least_about(double *place, const SbEhlSolution *s, int target, bool pressure) {
  enum { SAMPLES = 16 };
  const int around = s->mesh.owner[target];
  double least = INFINITY;
  for (int i = around > 0 ? around - 1 : 0; i <= around + 1 && i < s->mesh.count; i++) {
    const Sample of = {s, &s->mesh.element[i], pressure};
    double begin = of.e->side < 0 ? -0.9 : -1.0;
    double end = of.e->side > 0 ? 0.9 : 1.0;
    double step = (end - begin) / SAMPLES;
    double best = begin;
    for (int k = 1; k <= SAMPLES; k++) {
      best = sampled(begin + step * k, &of) < sampled(best, &of) ? begin + step * k : best;
    }
    double r = sb_minimum(sampled, &of, fmax(begin, best - step), fmin(end, best + step), 1e-8);
    best = sampled(r, &of) < sampled(best, &of) ? r : best;
    if (sampled(best, &of) < least) {
      least = sampled(best, &of);
      *place = sb_ehl_position(of.e, best);
    }
  }
  return least;
}

double sb_ehl_flat_film(const SbEhlCase *c, double flux, double film, double pressure,
                        double slope) {
  for (int i = 0; i < 20; i++) {
    double m, by_film, by_pressure;
    double before = film;
    sb_film_mobility(&m, &by_film, &by_pressure, &c->fluid, film, pressure);
    // Newton's method: end pressures may drive the flux more than the wall does.
    const double driven = film * film * slope / c->layers.lambda;
    film -= (film - flux - driven * film * m) / (1.0 - driven * (3.0 * m + film * by_film));
    if (film == before) {
      break;
    }
  }
  return film;
}

// Returns the film at r of an element. Thin films, which are flat in the contact's middle, depend
// there on small differences of large deflections between the collocation points; Reynolds'
// equation gives them from the slope of the pressure with far less noise.
static double film_at(const SbEhlSolution *s, int element, bool middle, double r) {
  const Sample of = {s, &s->mesh.element[element], false};
  double film = sampled(r, &of);
  if (!middle || s->c.rough.rows || sb_ehl_layers_width(&s->c.layers) >= 0.3) {
    return film;
  }
  double slope;
  double pressure = sb_ehl_pressure(&slope, of.e, s->state.nodal, r);
  return sb_ehl_flat_film(&s->c, s->state.flux, film, pressure, slope);
}

// Root mean square of the film's relative change over an element between two solutions, 0 for an
// infinite one.
static double element_change(const SbEhlSolution *a, const SbEhlSolution *b, int element,
                             bool middle) {
  enum { SAMPLES = 9, MIDDLE = SAMPLES / 2 };
  double sum = 0.0;
  for (int i = 0; i < SAMPLES && a->mesh.element[element].side == 0; i++) {
    double r = 0.24 * (i - MIDDLE);
    double change = film_at(a, element, middle, r) / film_at(b, element, middle, r) - 1.0;
    sum += change * change;
  }
  return sqrt(sum / SAMPLES);
}

void sb_ehl_change(double change[3], SbFilmSolver *solver, const SbEhlResults *fine,
                   const SbEhlResults *coarse, bool paired) {
  // A closed gap has no relative error.
  double least = fmax(fine->film_min, SB_EHL_CLOSED);
  double central = fmax(fine->film_central, SB_EHL_CLOSED);
  change[0] = fabs(fine->film_min - coarse->film_min) / least;
  change[1] = fabs(fine->film_central - coarse->film_central) / central;
  change[2] = coarse->film_flux != 0.0 ? fabs(fine->film_flux / coarse->film_flux - 1.0) : 0.0;
  const SbEhlSolution *now = solver->now, *before = sb_ehl_other(solver);
  const SbEhlMesh *mesh = &now->mesh;
  if (!paired || now->c.rough.rows || mesh->count != before->mesh.count) {
    return;
  }
  int thinnest = sb_ehl_find(mesh, fine->position_min - now->state.shift);
  change[0] = fmax(change[0], element_change(now, before, thinnest, false));
  int axis = sb_ehl_find(mesh, now->c.layers.middle - now->state.shift);
  change[1] = element_change(now, before, axis, true);
}

// Weights of rough rows' nodes in integrals over everything and over the full film, by the rule
// from node to node; where the film ends, and the errors that this rule leaves.
static void weigh_steps(SbEhlResults *out, double *whole, double *film, const SbEhlSolution *s) {
  const SbEhlRoughPoint *point = s->solver->point;
  const SbEhlState *state = &s->state;
  for (int i = 0; i + 1 < s->mesh.dofs; i++) {
    const SbEhlElement *e = &s->mesh.element[s->mesh.owner[i]];
    const SbEhlTable *rule = e->table;
    const int first = e->first_dof, j = i - first;
    double wet[SB_EHL_DEGREE_MAX + 1] = {0};
    if (!state->cavity[i]) {
      double end = sb_ehl_rough_weights(wet, s, e, j);
      if (state->cavity[i + 1] && !out->ruptured && s->c.layers.lambda > 0) {
        out->position_rupture = sb_ehl_position(e, end);
        out->ruptured = true;
      }
    }
    double lack = point[i + 1].p - point[i].p; // of the integrated equation
    for (int k = 0; k <= rule->degree; k++) {
      whole[first + k] += e->h * rule->step[j][k];
      film[first + k] += e->h * wet[k];
      lack -= e->h * rule->step[j][k] * state->s[first + k];
    }
    if (!state->cavity[i] && !state->cavity[i + 1]) {
      out->flux_error = fmax(out->flux_error, fabs(lack));
    }
  }
}

// Returns whether the fraction of real area reaches its limit of 1 inside an element.
static bool is_kinked(const SbEhlElement *e, const SbEhlRoughPoint *point) {
  bool full = false, open = false;
  for (int k = e->first_dof; k <= e->first_dof + e->degree; k++) {
    full = full || point[k].share >= 1.0;
    open = open || point[k].share < 1.0;
  }
  return full && open;
}

// Returns the fraction of real contact area at r of an element.
static double share_at(const SbEhlSolution *s, const SbEhlElement *e, double r) {
  SbEhlRoughPoint at;
  sb_ehl_rough_point(&at, &s->c, sb_ehl_interpolate(e->table, &s->state.t[e->first_dof], r));
  return at.share;
}

// Returns 1 where the fraction of real area is at its limit, else -1; for sb_bisect().
static double is_full(double r, const void *context) {
  const Sample *of = context;
  return share_at(of->s, of->e, r) < 1.0 ? -1.0 : 1.0;
}

// Returns the integral of the fraction of real area from a to b of an element, without a kink
// inside.
static double smooth_area(const SbEhlSolution *s, const SbEhlElement *e, double a, double b) {
  const SbEhlTables *rule = s->mesh.tables;
  double sum = 0.0;
  for (int q = 0; q < SB_EHL_QUAD && b > a; q++) {
    const double r = 0.5 * (a + b + (b - a) * rule->fine[q]);
    sum += 0.5 * (b - a) * rule->fine_weight[q] * e->h * share_at(s, e, r);
  }
  return sum;
}

// Returns the correction of the real area in elements in which its fraction reaches the limit of 1.
// The law is smooth up to the limit, so that the parameter t is a polynomial; the limited fraction
// is not, and the rule from node to node does not integrate it. It is integrated on both sides of
// the limit.
static double kinked_area(const SbEhlSolution *s, const SbEhlRoughPoint *point) {
  double more = 0.0;
  for (int i = 0; i < s->mesh.count; i++) {
    const SbEhlElement *e = &s->mesh.element[i];
    const double *node = e->table->node;
    if (!is_kinked(e, point)) {
      continue;
    }
    // Shared nodes have the weights of both elements; those of this element are its steps.
    for (int k = 0; k <= e->degree; k++) {
      double own = 0.0;
      for (int j = 0; j < e->degree; j++) {
        own += e->h * e->table->step[j][k];
      }
      more -= own * point[e->first_dof + k].share;
    }
    const Sample of = {.s = s, .e = e};
    for (int j = 0; j < e->degree; j++) {
      const double a = node[j], b = node[j + 1];
      const double from = is_full(a, &of), to = is_full(b, &of);
      const double kink =
          from == to ? b : sb_bisect(is_full, &of, from > to ? a : b, from > to ? b : a);
      more += smooth_area(s, e, a, kink) + smooth_area(s, e, kink, b);
    }
  }
  return more;
}

// Sets the relative changes of the films, the real area and the asperity load of rough rows that
// the rounding of the deflections causes. The gap at a node is the sum of H0, the dry gap and the
// deflection. If this sum is wrong by e, Newton's method changes the node's parameter t by
// e/(h_t + K |p_t|): h_t is the slope of the gap, p_t that of the asperities' pressure, and K the
// deflection of the node's interval under its own pressure, about the interval's length (half-plane
// without its logarithmic factor above 1). The pressure thus determines a closed gap, not the
// difference of large deflections. The changes are added at their worst.
static void find_rounding(SbEhlResults *out, const SbEhlRoughPoint *point, const double *weight,
                          int count) {
  static const double DEFLECTION = 1e-15;
  double area = 0.0, load = 0.0;
  for (int i = 0; i < count; i++) {
    const SbEhlRoughPoint *at = &point[i];
    const double dt = DEFLECTION / (at->h_t + fabs(weight[i] * at->solid_t));
    out->film_rounding = fmax(out->film_rounding, at->h_t * dt / (at->h + SB_EHL_CLOSED));
    area += fabs(weight[i] * at->share_t) * dt;
    load += fabs(weight[i] * at->solid_t) * dt;
  }
  out->contact_rounding = (out->real_area > 0.0 ? area / out->real_area : 0.0) +
                          (out->asperity_load > 0.0 ? load / out->asperity_load : 0.0);
}

// Computes the points of rough rows, the film's flux and end, and the rows' weights in integrals
// over everything and over the full film, which are added to `whole` and `film`.
static void begin_rough(SbEhlResults *out, double *whole, double *film, const SbEhlSolution *s) {
  SbEhlRoughPoint *point = s->solver->point;
  const double lambda = s->c.layers.lambda;
  for (int i = 0; i < s->mesh.dofs; i++) {
    sb_ehl_rough_point(&point[i], &s->c, s->state.t[i]);
    point[i].p = s->state.nodal[i] - point[i].solid;
  }
  out->film_flux = lambda > 0 ? s->state.flow / lambda : 0;
  out->position_rupture = s->mesh.right_end;
  weigh_steps(out, whole, film, s);
}

// Computes the point of a smooth row and the error of its flux. Returns the slope of the pressure.
static double smooth_row(SbEhlResults *out, SbEhlRoughPoint *point, const SbEhlSolution *s, int i) {
  const SbEhlMesh *mesh = &s->mesh;
  double slope, m, by_film, by_pressure;
  const double p =
      sb_ehl_sum(&slope, &mesh->local[i], &mesh->element[mesh->owner[i]], s->state.nodal);
  const double H = s->state.gap[i];
  *point = (SbEhlRoughPoint){.h = H, .p = p};
  sb_film_mobility(&m, &by_film, &by_pressure, &s->c.fluid, H, p);
  const double flux = H - H * H * H * m / s->c.layers.lambda * slope;
  out->flux_error = fmax(out->flux_error, fabs(flux - s->state.flux) / fmax(H, s->state.flux));
  return slope;
}

// Adds a row to the friction, the real area and the loads: its point, the slope of its pressure,
// and its weights `w` in integrals over everything and `wet` over the full film.
static void add_row(SbEhlResults *out, const SbEhlSolution *s, const SbEhlRoughPoint *at,
                    double slope, double w, double wet) {
  const double open = 1.0 - at->share;
  const double shear = sb_film_shear(&s->c.fluid, at->h, at->p);
  out->couette += wet * open * shear;
  out->poiseuille += wet * open * 0.5 * at->h * slope;
  if (s->c.rough.rows && s->c.layers.lambda > 0.0) { // in streamers
    double theta = fmin(out->film_flux / at->h, 1.0);
    out->cavity += (w - wet) * open * fmax(theta, 0.0) * shear;
  }
  out->real_area += w * at->share;
  out->asperity_load += w * at->asperity;
  out->solid_load += w * at->solid;
  out->pressure_min = fmin(out->pressure_min, at->p);
}

// Finds the minimum and the central film, and the largest pressure. `thinnest` and `highest`: rows
// of the smallest gap and of the largest pressure.
static void find_extremes(SbEhlResults *out, const SbEhlSolution *s, int thinnest, int highest) {
  double place;
  out->film_min = least_about(&place, s, thinnest, false);
  out->position_min = place + s->state.shift;
  out->pressure_max = -least_about(&place, s, highest, true);
  // At the axis, or in the middle of a fitted body's dry contact.
  double middle = s->c.layers.middle - s->state.shift;
  int axis = sb_ehl_find(&s->mesh, middle);
  out->film_central = film_at(s, axis, true, sb_ehl_coordinate(&s->mesh.element[axis], middle));
  if (s->c.rough.rows) {
    SbEhlRoughPoint at;
    sb_ehl_rough_point(&at, &s->c, out->film_min);
    out->film_min = at.h;
    sb_ehl_rough_point(&at, &s->c, out->film_central);
    out->film_central = at.h;
    out->central_share = at.share;
  }
}

void sb_ehl_results(SbEhlResults *out, const SbEhlSolution *s) {
  const SbEhlMesh *mesh = &s->mesh;
  const SbEhlState *state = &s->state;
  const bool rough = s->c.rough.rows;
  SbEhlRoughPoint *point = s->solver->point; // of all rows
  double whole[SB_EHL_DOFS_MAX] = {0}, film[SB_EHL_DOFS_MAX] = {0};
  *out = (SbEhlResults){.load_error = fabs(sb_ehl_load(s)) / (0.5 * M_PI)};
  if (rough) {
    begin_rough(out, whole, film, s);
  } else {
    out->film_flux = state->flux;
    out->ruptured = s->c.layers.end != SB_EHL_FULL;
    // The rupture, or the end of the contact.
    out->position_rupture =
        out->ruptured ? mesh->element[mesh->film_end].x1 : 1.0 + s->c.layers.middle - state->shift;
  }
  out->position_rupture += state->shift;

  int thinnest = 0, highest = 0;
  double peak = -INFINITY;
  for (int i = 0; i < mesh->rows; i++) {
    const SbEhlRoughPoint *at = &point[i];
    const double slope = rough ? state->s[i] : smooth_row(out, &point[i], s, i);
    add_row(out, s, at, slope, rough ? whole[i] : mesh->weight[i],
            rough ? film[i] : mesh->weight[i]);
    thinnest = at->h < point[thinnest].h ? i : thinnest;
    highest = at->p + at->solid > peak ? i : highest;
    peak = fmax(peak, at->p + at->solid);
  }
  out->real_area += rough ? kinked_area(s, point) : 0.0;
  find_extremes(out, s, thinnest, highest);
  if (rough) {
    find_rounding(out, point, whole, mesh->rows);
  }
}
