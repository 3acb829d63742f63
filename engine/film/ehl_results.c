// What is read off a solution of the coupled film solver: films, places, friction, and the transfer
// to another mesh. Everything is interpolated at the solver's own order: the pressure
// by its nodal polynomials, the gap through the collocation points and ends of an element.
#include "engine/film/ehl.h"

#include <math.h>
#include <string.h>

// Where a target of the new mesh takes its value from: the same r of the same element if the two
// meshes have the same elements, else its place.
static const SbEhlElement *source(double *r, const SbEhlMesh *from, int element, bool same,
                                  double X) {
  const SbEhlElement *e = &from->element[same ? element : sb_ehl_find(from, X)];
  *r = same ? *r : sb_ehl_coordinate(e, X);
  return e;
}

void sb_ehl_carry(SbFilmSolver *solver, int from, int to, const SbEhlLayers *before,
                  const SbEhlLayers *after, double scale) {
  const SbEhlMesh *a = &solver->mesh[from];
  const SbEhlMesh *b = &solver->mesh[to];
  const SbEhlState *old = &solver->state[from];
  SbEhlState *new = &solver->state[to];
  const bool same = sb_ehl_same_elements(a, b);
  // Towards infinity the gap grows by decades and has no polynomial: its excess over the dry one.
  double *excess = solver->gaps;
  for (int i = 0; i < a->targets; i++) {
    excess[i] = old->gap[i] - sb_ehl_layers_dry_gap(before, a->x[i]);
  }
  // New end pressures change the dry contact's pressure, unless a cavity holds one of them off.
  bool whole = true;
  for (int i = 0; i < b->count; i++) {
    whole = whole && !b->element[i].apart;
  }
  for (int i = 0; i < b->count; i++) {
    const SbEhlElement *f = &b->element[i];
    const SbEhlTable *t = sb_ehl_table(&solver->tables, f->degree);
    bool infinite = sb_ehl_infinite(f);
    for (int k = 0; k <= f->degree; k++) {
      // For the node at infinity a place near it, if there is no such node to take.
      double r = t->node[k];
      bool far = (f->map == SB_EHL_INLET && k == 0) || (f->map == SB_EHL_OUTLET && k == f->degree);
      r = far ? 0.98 * r : r;
      double s = sb_ehl_inverse(f, r);
      double X = sb_ehl_position(f, r);
      const SbEhlElement *e = source(&r, a, i, same, X);
      if (far && e->map == f->map && e->B == f->B) {
        new->nodal[f->first_dof + k] = old->nodal[e->first_dof + (k == 0 ? 0 : e->degree)];
        continue;
      }
      double value = !same && X > a->right_end && e->map != SB_EHL_OUTLET
                         ? 0.0
                         : sb_ehl_pressure(a, &solver->tables, e, old->nodal, r);
      value += whole ? sb_film_dry_pressure(X, b->inlet_pressure, b->outlet_pressure) -
                           sb_film_dry_pressure(X, a->inlet_pressure, a->outlet_pressure)
                     : 0.0;
      bool touching = f->map == SB_EHL_INLET ? k == f->degree : k == 0;
      new->nodal[f->first_dof + k] =
          infinite && !touching ? (value - f->far_pressure) / (s * s * s * s) : value;
    }
  }
  for (int i = 0; i < b->targets; i++) {
    const SbEhlElement *f = &b->element[b->owner[i]];
    double r = fmin(sb_ehl_coordinate(f, b->x[i]), 1.0);
    const SbEhlElement *e = source(&r, a, b->owner[i], same, b->x[i]);
    bool infinite = sb_ehl_infinite(e);
    double gap = sb_ehl_gap(a, &solver->tables, (int)(e - a->element), infinite ? excess : old->gap,
                            fmin(r, 1.1));
    new->gap[i] = scale *gap + (infinite ? sb_ehl_layers_dry_gap(after, b->x[i]) : 0.0);
  }
  new->H0 = old->H0;
  new->shift = old->shift;
  new->flux = scale * old->flux;
}

// Value of the pressure (negative) or of what the gap grows with, at r of an element: the gap
// itself, or the parameter of rough rows.
static double sampled(SbFilmSolver *solver, int which, const SbEhlCase *c, int element,
                      bool pressure, double r) {
  const SbEhlMesh *mesh = &solver->mesh[which];
  const SbEhlState *state = &solver->state[which];
  const SbEhlElement *e = &mesh->element[element];
  if (pressure) {
    return -sb_ehl_pressure(mesh, &solver->tables, e, state->nodal, r);
  }
  return c->rough.rows ? sb_ehl_interpolate(sb_ehl_table(&solver->tables, e->degree),
                                            &state->t[e->first_dof], r)
                       : sb_ehl_gap(mesh, &solver->tables, element, state->gap, r);
}

// Least value over an element by sampling and golden section.
static double minimum(double *place, SbFilmSolver *solver, int which, const SbEhlCase *problem,
                      int element, bool pressure) {
  enum { SAMPLES = 16 };
  const SbEhlElement *e = &solver->mesh[which].element[element];
  double begin = e->map == SB_EHL_INLET ? -0.9 : -1.0;
  double end = e->map == SB_EHL_OUTLET ? 0.9 : 1.0;
  double step = (end - begin) / SAMPLES;
  double best = begin;
  double least = INFINITY;
  for (int i = 0; i <= SAMPLES; i++) {
    double r = begin + step * i;
    double value = sampled(solver, which, problem, element, pressure, r);
    if (value < least) {
      least = value;
      best = r;
    }
  }
  static const double RATIO = 0.6180339887498949;
  double a = fmax(begin, best - step);
  double b = fmin(end, best + step);
  double c = b - RATIO * (b - a);
  double d = a + RATIO * (b - a);
  double at_c = sampled(solver, which, problem, element, pressure, c);
  double at_d = sampled(solver, which, problem, element, pressure, d);
  for (int i = 0; i < 36; i++) {
    if (at_c < at_d) {
      b = d;
      d = c;
      at_d = at_c;
      c = b - RATIO * (b - a);
      at_c = sampled(solver, which, problem, element, pressure, c);
    } else {
      a = c;
      c = d;
      at_c = at_d;
      d = a + RATIO * (b - a);
      at_d = sampled(solver, which, problem, element, pressure, d);
    }
  }
  double r = 0.5 * (a + b);
  double value = sampled(solver, which, problem, element, pressure, r);
  if (value < least) {
    least = value;
    best = r;
  }
  *place = sb_ehl_position(e, best);
  return least;
}

// Thin enough that the film in the contact's middle is flat.
static bool flat_film(const SbEhlCase *problem) {
  return sb_ehl_layers_width(&problem->layers) < 0.3;
}

double sb_ehl_flat_film(const SbEhlCase *c, double flux, double film, double pressure,
                        double slope) {
  for (int i = 0; i < 20; i++) {
    double m, by_film, by_pressure;
    double before = film;
    sb_film_mobility(&m, &by_film, &by_pressure, &c->fluid, film, pressure);
    film = flux + film * film * film * m * slope / c->layers.lambda;
    if (film == before) {
      break;
    }
  }
  return film;
}

// The film at r of an element by the pressure's slope there.
static double reynolds_film(SbFilmSolver *solver, int which, const SbEhlCase *problem, int element,
                            double r, double film) {
  const SbEhlMesh *mesh = &solver->mesh[which];
  const SbEhlState *state = &solver->state[which];
  const SbEhlElement *e = &mesh->element[element];
  double step = fmin(1e-3, 0.5 * (1.0 - fabs(r)) + 1e-6);
  double before = fmax(-1.0, r - step);
  double after = fmin(1.0, r + step);
  double slope = (sb_ehl_pressure(mesh, &solver->tables, e, state->nodal, after) -
                  sb_ehl_pressure(mesh, &solver->tables, e, state->nodal, before)) /
                 (sb_ehl_position(e, after) - sb_ehl_position(e, before));
  double pressure = sb_ehl_pressure(mesh, &solver->tables, e, state->nodal, r);
  return sb_ehl_flat_film(problem, state->flux, film, pressure, slope);
}

// Root mean square of the film's relative change over an element, from the other mesh to `which`;
// 0 for an infinite one. Flat films go by Reynolds' equation, as the central film does.
static double element_change(SbFilmSolver *solver, int which, const SbEhlCase *problem, int element,
                             bool flat) {
  enum { SAMPLES = 9, MIDDLE = SAMPLES / 2 };
  const SbEhlElement *e = &solver->mesh[which].element[element];
  if (sb_ehl_infinite(e)) {
    return 0.0;
  }
  double sum = 0.0;
  for (int i = 0; i < SAMPLES; i++) {
    double r = 0.24 * (i - MIDDLE);
    double film[2];
    for (int k = 0; k < 2; k++) {
      int mesh = k == 0 ? which : 1 - which;
      film[k] = sampled(solver, mesh, problem, element, false, r);
      film[k] = flat ? reynolds_film(solver, mesh, problem, element, r, film[k]) : film[k];
    }
    sum += (film[0] / film[1] - 1.0) * (film[0] / film[1] - 1.0);
  }
  return sqrt(sum / SAMPLES);
}

void sb_ehl_change(double change[3], SbFilmSolver *solver, int which, const SbEhlCase *problem,
                   const SbEhlResults *fine, const SbEhlResults *coarse, bool paired) {
  change[0] = fabs(fine->film_min / coarse->film_min - 1.0);
  change[1] = fabs(fine->film_central / coarse->film_central - 1.0);
  change[2] = fabs(fine->film_flux / coarse->film_flux - 1.0);
  const SbEhlMesh *mesh = &solver->mesh[which];
  if (!paired || mesh->count != solver->mesh[1 - which].count) {
    return;
  }
  double shift = solver->state[which].shift;
  int thinnest = sb_ehl_find(mesh, fine->position_min - shift);
  change[0] = 0.0;
  for (int i = thinnest > 0 ? thinnest - 1 : 0; i <= thinnest + 1 && i < mesh->count; i++) {
    change[0] = fmax(change[0], element_change(solver, which, problem, i, false));
  }
  change[1] = element_change(solver, which, problem,
                             sb_ehl_find(mesh, problem->layers.middle - shift), flat_film(problem));
}

// Film at the middle of the dry contact, friction and flux of smooth rows; the collocation points
// of the least film and of the largest pressure.
static void add_smooth(SbEhlResults *out, int *thinnest, int *highest, SbFilmSolver *solver,
                       int which, const SbEhlCase *problem, int axis, double at_axis) {
  const SbEhlMesh *mesh = &solver->mesh[which];
  const SbEhlState *state = &solver->state[which];
  out->film_flux = state->flux;
  out->film_central = sb_ehl_gap(mesh, &solver->tables, axis, state->gap, at_axis);
  if (flat_film(problem)) {
    // Flat films there hang on small differences of large deflections between the collocation
    // points; Reynolds' equation gives them from the slope of the pressure, with far less noise.
    out->film_central = reynolds_film(solver, which, problem, axis, at_axis, out->film_central);
  }
  double peak = -INFINITY;
  for (int i = 0; i < mesh->rows; i++) {
    double P_slope;
    double P = sb_ehl_local(&P_slope, mesh, state->nodal, i);
    double H = state->gap[i];
    out->pressure_min = fmin(out->pressure_min, P);
    *thinnest = H < state->gap[*thinnest] ? i : *thinnest;
    if (P > peak) {
      peak = P;
      *highest = i;
    }
    // Friction and flux by the rule of the collocation points.
    out->couette += mesh->weight[i] * sb_film_shear(&problem->fluid, H, P);
    out->poiseuille += mesh->weight[i] * 0.5 * H * P_slope;
    double m, by_film, by_pressure;
    sb_film_mobility(&m, &by_film, &by_pressure, &problem->fluid, H, P);
    double flux = H - H * H * H * m / problem->layers.lambda * P_slope;
    out->flux_error = fmax(out->flux_error, fabs(flux - state->flux) / fmax(H, state->flux));
  }
  // End of the film: the rupture, or the end of the contact.
  out->ruptured = problem->layers.end != SB_EHL_FULL;
  out->position_rupture = 1.0 + problem->layers.middle - state->shift;
  for (int i = 0; i < mesh->count && out->ruptured; i++) {
    if (i + 1 == mesh->count || mesh->element[i + 1].apart) {
      out->position_rupture = mesh->element[i].x1;
      break;
    }
  }
}

// Friction and loads of rough rows from node j to the next of element e, by the rule of the nodes.
static void add_step(SbEhlResults *out, const SbEhlRoughPoint *point, const SbEhlState *state,
                     const SbEhlCase *c, const SbEhlTable *rule, const SbEhlElement *e, int j) {
  int i = e->first_dof + j;
  const double *full = rule->step[j];
  double film[SB_EHL_DEGREE_MAX + 1] = {0};
  if (!state->cavity[i]) {
    memcpy(film, full, sizeof film);
    if (state->cavity[i + 1]) {
      double end = sb_ehl_rough_film_end(rule, &state->s[e->first_dof], j);
      sb_ehl_partial(film, rule, j, end);
      if (!out->ruptured && c->layers.lambda > 0) {
        out->position_rupture = sb_ehl_position(e, end);
        out->ruptured = true;
      }
    }
  }
  // The kink's error, measured: below 0.03 of the rectangle that it crosses.
  double here = point[i].share, next = point[i + 1].share;
  if ((here < 1) != (next < 1)) {
    out->area_error += 0.05 * e->h * (rule->node[j + 1] - rule->node[j]) * fabs(next - here);
  }
  double integral = 0; // of the slope
  for (int k = 0; k <= rule->degree; k++) {
    int n = e->first_dof + k;
    const SbEhlRoughPoint *at = &point[n];
    double w = e->h * full[k], wet = e->h * film[k];
    double open = 1 - at->share;
    double shear = sb_film_shear(&c->fluid, at->h, state->nodal[n] - at->solid);
    out->couette += wet * open * shear;
    out->poiseuille += wet * open * 0.5 * at->h * state->s[n];
    if (c->layers.lambda > 0) {
      double theta = fmin(state->flow / c->layers.lambda / at->h, 1);
      out->cavity += (w - wet) * open * fmax(theta, 0) * shear;
    }
    out->real_area += w * at->share;
    out->asperity_load += w * at->asperity;
    integral += w * state->s[n];
  }
  // The flux that the profile carries, by the integrated equation.
  if (!state->cavity[i] && !state->cavity[i + 1]) {
    double rise = state->nodal[i + 1] - point[i + 1].solid - (state->nodal[i] - point[i].solid);
    out->flux_error = fmax(out->flux_error, fabs(rise - integral));
  }
}

// The same for rough rows; the nodes of the least film and of the largest pressure.
static void add_rough(SbEhlResults *out, int *thinnest, int *highest, SbFilmSolver *solver,
                      int which, const SbEhlCase *c, int axis, double at_axis) {
  const SbEhlMesh *mesh = &solver->mesh[which];
  const SbEhlState *state = &solver->state[which];
  for (int i = 0; i < mesh->dofs; i++) {
    sb_ehl_rough_point(&solver->point[i], c, state->t[i]);
    *thinnest = state->t[i] < state->t[*thinnest] ? i : *thinnest;
    *highest = state->nodal[i] > state->nodal[*highest] ? i : *highest;
  }
  out->film_flux = c->layers.lambda > 0 ? state->flow / c->layers.lambda : 0;
  SbEhlRoughPoint at;
  sb_ehl_rough_point(&at, c, sampled(solver, which, c, axis, false, at_axis));
  out->film_central = at.h;
  out->central_share = at.share;
  out->position_rupture = mesh->right_end;
  for (int i = 0; i < mesh->count; i++) {
    const SbEhlElement *e = &mesh->element[i];
    const SbEhlTable *rule = sb_ehl_steps(&solver->tables, e->degree);
    for (int j = 0; j < e->degree; j++) {
      add_step(out, solver->point, state, c, rule, e, j);
    }
  }
}

void sb_ehl_results(SbEhlResults *out, SbFilmSolver *solver, int which, const SbEhlCase *problem) {
  const SbEhlMesh *mesh = &solver->mesh[which];
  const SbEhlState *state = &solver->state[which];
  bool rough = problem->rough.rows;
  *out = (SbEhlResults){.film_min = INFINITY, .pressure_max = -INFINITY};
  out->load_error = fabs(sb_ehl_load(mesh, state)) / (0.5 * M_PI);
  // At the axis, or in the middle of a fitted body's dry contact.
  double middle = problem->layers.middle - state->shift;
  int axis = sb_ehl_find(mesh, middle);
  double at_axis = sb_ehl_coordinate(&mesh->element[axis], middle);
  int thinnest = 0, highest = 0;
  (rough ? add_rough : add_smooth)(out, &thinnest, &highest, solver, which, problem, axis, at_axis);
  out->position_rupture += state->shift;

  // Least film and largest pressure: search around the best points.
  int around = mesh->owner[thinnest];
  for (int i = around > 0 ? around - 1 : 0; i <= around + 1 && i < mesh->count; i++) {
    double place;
    double value = minimum(&place, solver, which, problem, i, false);
    if (rough) {
      SbEhlRoughPoint at;
      sb_ehl_rough_point(&at, problem, value);
      value = at.h;
    }
    if (value < out->film_min) {
      out->film_min = value;
      out->position_min = place + state->shift;
    }
  }
  around = mesh->owner[highest];
  for (int i = around > 0 ? around - 1 : 0; i <= around + 1 && i < mesh->count; i++) {
    double place;
    out->pressure_max = fmax(out->pressure_max, -minimum(&place, solver, which, problem, i, true));
  }
}
