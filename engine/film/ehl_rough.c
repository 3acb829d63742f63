// Rough rows from a cold start: guess, continuation, levels of degree.
//
// A cold solve starts from Hertz's pressure under the dry gap, opened by the film of the layers
// (ehl_layers.c) and by the asperities, on elements of degree 4; degrees 6 and 8 follow from it,
// and the change between two levels estimates the error. Where Newton's method does not take the
// start, a faster case is solved and the speed lowered from there.
#include "engine/film/ehl.h"

#include <math.h>
#include <string.h>

static const int degree[] = {4, 6, 8};
enum { DEGREES = sizeof degree / sizeof degree[0] };

// ---------------------------------------------------------------- starts

// Flux film of a rough contact: inside, the fluid carries what Hertz's pressure has above p_a(h);
// at the inlet, where the two meet, its slope is the largest that Reynolds allows, (4/27) lambda /
// h^2 (as in Blok's inverse film). Blended with the smooth film. `inlet` is where they meet.
static double flux_guess(double *inlet, const SbEhlCase *c) {
  double smooth = c->layers.lambda > 0 ? sb_ehl_layers_flux(&c->layers) : 0;
  *inlet = 1;
  if (c->rough.law == NULL || !(c->layers.lambda > 0)) {
    return smooth;
  }
  double slope = sb_ehl_layers_inlet_slope(&c->layers);
  SbRoughPoint at;
  sb_rough_law_at(&at, c->rough.law,
                  sb_rough_law_of_pressure(c->rough.law, 0.999999 * c->rough.pressure));
  double low = log(at.gap / c->rough.film), high = low + 40;
  for (int i = 0; i < 50; i++) {
    double middle = 0.5 * (low + high);
    double h = exp(middle);
    sb_rough_law_at(&at, c->rough.law, sb_rough_law_of_gap(c->rough.law, h * c->rough.film));
    double p = fmin(at.pressure / c->rough.pressure, 1);
    if (4.0 / 27 * c->layers.lambda * p > h * h * slope * sqrt(1 - p * p)) {
      low = middle;
    } else {
      high = middle;
    }
  }
  double flux = hypot(exp(low), smooth);
  sb_rough_law_at(&at, c->rough.law, sb_rough_law_of_gap(c->rough.law, flux * c->rough.film));
  double p = fmin(at.pressure / c->rough.pressure, 1);
  *inlet = sqrt(1 - p * p);
  return flux;
}

static void guess(SbFilmSolver *solver, int which, const SbEhlCase *c) {
  const SbEhlMesh *mesh = &solver->mesh[which];
  SbEhlState *state = &solver->state[which];
  const SbEhlTable *rule = sb_ehl_steps(&solver->tables, mesh->element[0].degree);
  double film = fmin(c->rough.flux, isfinite(c->rough.supply) && c->layers.lambda > 0
                                        ? c->rough.supply / c->layers.lambda
                                        : c->rough.flux);
  double width = sb_ehl_layers_width(&c->layers);
  double floor = 0.02;
  // A film hardly thickened by asperities has the smooth one's layers.
  bool layered = c->layers.lambda > 0 && width < 0.8 && !isfinite(c->rough.supply) &&
                 film < 1.2 * sb_ehl_layers_flux(&c->layers);
  for (int i = 0; i < mesh->dofs; i++) {
    double X = mesh->x[i];
    double q = sb_ehl_layers_dry_pressure(&c->layers, X);
    double dry = sb_film_dry_gap(X);
    double ambient = sb_film_ends(X, c->layers.inlet, c->layers.outlet);
    double fluid = film > 0 ? film * (1 + 1.2 * exp(-fabs(X + 1) / width)) : 0;
    if (layered) {
      double h;
      sb_ehl_layers_shape(&q, &h, &c->layers, film, X);
      fluid = fmax(h - dry, 0.5 * film);
    }
    double rough = 0;
    if (c->rough.law != NULL) {
      SbRoughPoint at;
      sb_rough_law_at(
          &at, c->rough.law,
          sb_rough_law_of_pressure(c->rough.law, fmax(q - ambient, floor) * c->rough.pressure));
      rough = at.gap / c->rough.film;
    }
    double lift = pow(pow(fluid, 6) + pow(rough, 6), 1 / 6.0);
    state->nodal[i] = q;
    state->t[i] = fmax(sb_ehl_rough_of_gap(c, lift + dry), -3);
  }
  // Flow: by the film, and by the end pressures through the gap (Poiseuille).
  double resistance = 0;
  for (int i = 1; i < mesh->dofs; i++) {
    SbEhlRoughPoint at;
    sb_ehl_rough_point(&at, c, 0.5 * (state->t[i] + state->t[i - 1]));
    resistance += (mesh->x[i] - mesh->x[i - 1]) / (at.h * at.h * at.h);
  }
  state->flow = isfinite(c->rough.supply)
                    ? c->rough.supply
                    : c->layers.lambda * film + (c->layers.inlet - c->layers.outlet) / resistance;
  // Film pressure that the guess leaves, for the slopes; H0 follows from the first step.
  double p[SB_EHL_DOFS_MAX];
  for (int i = 0; i < mesh->dofs; i++) {
    SbEhlRoughPoint at;
    sb_ehl_rough_point(&at, c, state->t[i]);
    p[i] = state->nodal[i] - at.solid;
    state->cavity[i] =
        c->rough.sealed || (c->layers.outlet <= 0 && c->layers.lambda > 0 &&
                            mesh->x[i] > c->rough.inlet && c->layers.lambda * at.h > state->flow);
  }
  for (int e = 0; e < mesh->count; e++) {
    double half = mesh->element[e].h;
    for (int k = e > 0 ? 1 : 0; k <= rule->degree; k++) {
      double sum = 0;
      for (int j = 0; j <= rule->degree; j++) {
        sum += rule->node_slope[k][j] * p[e * rule->degree + j];
      }
      state->s[e * rule->degree + k] = c->rough.sealed ? 0 : sum / half;
    }
  }
  state->H0 = 0;
  state->shift = c->layers.middle;
}

static void resample(SbFilmSolver *solver, int from, int to) {
  const SbEhlMesh *a = &solver->mesh[from];
  const SbEhlMesh *b = &solver->mesh[to];
  const SbEhlState *old = &solver->state[from];
  SbEhlState *new = &solver->state[to];
  for (int i = 0; i < b->dofs; i++) {
    const SbEhlElement *e = &a->element[sb_ehl_find(a, b->x[i])];
    const SbEhlTable *table = sb_ehl_table(&solver->tables, e->degree);
    double r = fmin(fmax(sb_ehl_coordinate(e, b->x[i]), -1), 1);
    new->nodal[i] = sb_ehl_interpolate(table, &old->nodal[e->first_dof], r);
    new->t[i] = sb_ehl_interpolate(table, &old->t[e->first_dof], r);
    new->s[i] = sb_ehl_interpolate(table, &old->s[e->first_dof], r);
    // Overshoot of the polynomials is cut to the range of the nodes beside.
    int n = e->first_dof;
    for (int k = 1; k < e->degree && r > table->node[k]; k++) {
      n++;
    }
    double low = fmin(old->t[n], old->t[n + 1]), high = fmax(old->t[n], old->t[n + 1]);
    double margin = 0.3 * (high - low);
    new->t[i] = fmin(fmax(new->t[i], low - margin), high + margin);
    new->cavity[i] = old->cavity[n];
  }
  new->H0 = old->H0;
  new->shift = old->shift;
  new->flow = old->flow;
}

// ---------------------------------------------------------------- solving

// Adds `times` the difference of two states to a third: a straight line through them.
static void extrapolate(SbEhlState *out, const SbEhlState *now, const SbEhlState *before, int nodes,
                        double times) {
  *out = *now;
  for (int i = 0; i < nodes; i++) {
    out->nodal[i] += times * (now->nodal[i] - before->nodal[i]);
    out->t[i] += times * (now->t[i] - before->t[i]);
  }
  out->H0 += times * (now->H0 - before->H0);
}

// Lambda from where a cold start succeeded, or the flow supplied from the flooded one, down to that
// of the case, on the mesh of the case. The slopes scale with lambda, the flux film is extrapolated
// by its logarithm.
static SbStatus lower(SbFilmSolver *solver, int which, const SbEhlCase *c, double from,
                      bool starving, const SbEhlRun *run) {
  enum { STEPS_MAX = 60 };
  SbEhlState *state = &solver->state[which];
  SbEhlState *now = &solver->saved[0], *before = &solver->saved[1];
  *now = *state;
  double wanted = starving ? c->rough.supply : c->layers.lambda;
  double end = log(wanted), at = log(from), last = NAN;
  double step = starving ? log(1.3) : log(4.0);
  double least = starving ? 1e-6 : 1e-3;
  for (int i = 0; i < STEPS_MAX && at > end && step >= least; i++) {
    double next = at - step < end + 0.1 * step ? end : at - step;
    double value = next > end ? exp(next) : wanted;
    SbEhlCase part = *c;
    if (starving) {
      part.rough.supply = state->flow = value;
    } else {
      part.layers.lambda = value;
      double times = isfinite(last) ? (next - at) / (at - last) : 0;
      extrapolate(state, now, before, solver->mesh[which].dofs, times);
      double grow = isfinite(last) && now->flow > 0 && before->flow > 0
                        ? pow(now->flow / before->flow * exp(last - at), times)
                        : 1;
      state->flow = now->flow * exp(next - at) * grow;
    }
    SbStatus status = sb_ehl_iterate(solver, which, &part, false, run);
    if (status == SB_ERROR_CANCELLED) {
      return status;
    }
    if (status == SB_OK) {
      *before = *now;
      *now = *state;
      last = at;
      at = next;
      step = fmin(1.5 * step, log(30.0));
    } else {
      *state = *now;
      step *= 0.35;
    }
  }
  return at > end ? SB_ERROR_NOT_CONVERGED : SB_OK;
}

static SbStatus start(SbFilmSolver *solver, int which, const SbEhlCase *c, const SbEhlRun *run) {
  enum { TRIALS = 12 };
  if (!sb_ehl_rough_mesh(solver, which, c, degree[0])) {
    return SB_ERROR_NOT_CONVERGED;
  }
  SbEhlCase trial = *c;
  SbStatus status = SB_ERROR_NOT_CONVERGED;
  for (int i = 0; i < TRIALS; i++) {
    guess(solver, which, &trial);
    status = sb_ehl_iterate(solver, which, &trial, false, run);
    if (status != SB_ERROR_NOT_CONVERGED || !(c->layers.lambda > 0)) {
      break;
    }
    trial.layers.lambda *= 8;
    trial.rough.flux = flux_guess(&trial.rough.inlet, &trial);
  }
  if (status == SB_OK && trial.layers.lambda > c->layers.lambda) {
    status = lower(solver, which, c, trial.layers.lambda, false, run);
  }
  return status;
}

// Less film at the inlet than the contact would take: from the flooded solution by steps of the
// flow, on a mesh laid out for the last of them.
static SbStatus starve(SbFilmSolver *solver, int *which, SbEhlCase *c, double supply,
                       const SbEhlRun *run) {
  double flow = solver->state[*which].flow;
  if (supply >= flow) {
    return SB_OK; // flooded after all
  }
  c->layers.starvation = supply / flow;
  int to = 1 - *which;
  if (!sb_ehl_rough_mesh(solver, to, c, degree[0])) {
    return SB_ERROR_NOT_CONVERGED;
  }
  resample(solver, *which, to);
  *which = to;
  c->rough.supply = supply;
  return lower(solver, to, c, flow, true, run);
}

// The last change times a rate estimates the error left: inside the contact a level's own error is
// some hundredth of its change; the least film, beside the kink that the rupture leaves, improves
// more slowly. One change alone may vanish by coincidence: below the last level some 1e-7 is left
// beside the rupture.
static void estimate(SbFilmSolverInfo *info, const SbEhlResults *now, const SbEhlResults *before,
                     bool rough, bool last) {
  static const double RATE = 0.02, RATE_LEAST = 0.05, RATE_FLOW = 0.02;
  double rounding = 1e-15 / fmin(now->film_min + SB_EHL_CLOSED, 1) + 3e-9;
  // A closed gap has no relative error; a flow that still moves, moves the films with it.
  double least = fmax(now->film_min, SB_EHL_CLOSED);
  double central = fmax(now->film_central, SB_EHL_CLOSED);
  double flow = before->film_flux != 0 ? fabs(now->film_flux / before->film_flux - 1) : 0;
  double base = rounding + RATE_FLOW * flow;
  info->error_film_min =
      RATE_LEAST * fabs(now->film_min - before->film_min) / least + base + (last ? 0 : 5e-8);
  info->error_film_central = RATE * fabs(now->film_central - before->film_central) / central + base;
  info->error_film_flux = RATE_LEAST * flow + rounding;
  info->error_contact = base;
  if (rough) {
    double area = RATE_LEAST * fabs(now->real_area - before->real_area) + now->area_error;
    double load = RATE_LEAST * fabs(now->asperity_load - before->asperity_load);
    info->error_contact += area / now->real_area + load / now->asperity_load;
  }
}

// All levels: follows the layers, then raises the degree until the error meets the tolerance.
static SbStatus climb(SbEhlResults *results, int *levels, int *which, SbFilmSolver *solver,
                      SbEhlCase *c, const SbEhlRun *run) {
  SbFilmSolverInfo *info = run->info;
  *levels = *which = 0;
  c->rough.front[0].X = c->rough.front[1].X = INFINITY;
  double supply = c->rough.supply;
  bool starving = isfinite(supply) && !c->rough.sealed;
  c->rough.supply = starving ? INFINITY : supply;
  SbStatus status = start(solver, *which, c, run);
  if (status == SB_OK && starving) {
    status = starve(solver, which, c, supply, run);
  }
  if (status != SB_OK) {
    return status;
  }
  sb_ehl_results(&results[0], solver, *which, c);
  *levels = 1;
  info->error_film_min = info->error_film_central = info->error_film_flux = 1;
  bool follow = sb_ehl_rough_fronts(c, solver, *which, &results[0]);
  for (int k = follow ? 0 : 1; k < DEGREES; k++) {
    int to = 1 - *which;
    if (!sb_ehl_rough_mesh(solver, to, c, degree[k])) {
      break;
    }
    resample(solver, *which, to);
    status = sb_ehl_iterate(solver, to, c, false, run);
    if (status != SB_OK) {
      return status;
    }
    *which = to;
    sb_ehl_results(&results[*levels], solver, to, c);
    sb_ehl_rough_fronts(c, solver, to, &results[*levels]);
    estimate(info, &results[*levels], &results[*levels - 1], c->rough.law != NULL,
             k + 1 == DEGREES);
    ++*levels;
    double worst = fmax(info->error_film_min, info->error_film_central);
    if (degree[k] > degree[0] && worst < 0.1 * run->problem->tolerance) {
      break;
    }
  }
  return SB_OK;
}

SbStatus sb_ehl_rough_climb(SbEhlResults *results, int *levels, int *which, SbFilmSolver *solver,
                            SbEhlCase *c, const SbEhlRun *run) {
  SbStatus status = climb(results, levels, which, solver, c, run);
  if (status == SB_ERROR_NOT_CONVERGED && !(c->layers.lambda > 0) && !c->rough.sealed) {
    // Closed beyond what the flow at rest can be told from.
    c->rough.sealed = true;
    c->rough.supply = 0;
    status = climb(results, levels, which, solver, c, run);
  }
  return status;
}

static bool same_surface(const SbRoughSurface *a, const SbRoughSurface *b) {
  return a->model == b->model && a->product == b->product && a->sigma == b->sigma &&
         a->sigma_over_beta == b->sigma_over_beta && a->modulus == b->modulus;
}

SbStatus sb_ehl_rough_law(const SbRoughLaw **law, SbFilmSolver *solver,
                          const SbFilmProblem *problem, SbReport *report) {
  const SbRoughSurface surface = {.model = problem->surface,
                                  .product = problem->gt_product,
                                  .sigma = problem->sigma,
                                  .sigma_over_beta = problem->sigma_over_beta,
                                  .modulus = problem->modulus};
  *law = &solver->law;
  if (solver->law_ready && same_surface(&solver->law.surface, &surface)) {
    return SB_OK;
  }
  SbStatus status = sb_rough_law_init(&solver->law, &surface, report);
  solver->law_ready = status == SB_OK;
  return status;
}

SbStatus sb_ehl_rough_case(SbEhlCase *c, SbFilmSolver *solver, const SbFilmProblem *problem,
                           const SbFilmScale *scale, SbReport *report) {
  bool starved = problem->inlet_film > 0 && problem->speed != 0;
  c->rough = (SbEhlRough){
      .rows = true,
      .supply = starved ? scale->lambda * 2 * problem->inlet_film / scale->film : INFINITY,
      .film = scale->film,
      .pressure = scale->pressure,
      .hamaker = problem->hamaker,
      .smooth_gap = 0.01 * sb_ehl_layers_flux(&c->layers),
  };
  if (problem->surface != SB_ROUGH_NONE) {
    SbStatus made = sb_ehl_rough_law(&c->rough.law, solver, problem, report);
    if (made != SB_OK) {
      return made;
    }
  }
  if (!(scale->lambda > 0) && c->layers.inlet == c->layers.outlet) {
    c->rough.sealed = true; // no flow at all
    c->rough.supply = 0;
  }
  c->rough.flux = flux_guess(&c->rough.inlet, c);
  return SB_OK;
}
