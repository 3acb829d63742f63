// Film and asperities together: levels of degree, error estimate, results. Equations in
// ehl_rough.h.
//
// A cold solve starts from Hertz's pressure under the dry gap, opened by the film of the layers
// (ehl_layers.c) and by the asperities, on elements of degree 4; degrees 6 and 8 follow from it,
// and the change between two levels estimates the error. Where Newton's method does not take the
// start, the dry rough contact is solved first and the speed is raised from there.
//
// Friction from the solved split, per length of seal: over the real area A_a (share times length)
// tau_0 A_a + m W_a, W_a what the asperities carry (thesis eq. 5.14); over the rest, eta u / h of
// Couette and (h/2) p' of Poiseuille in the full film (eq. 5.16); in the cavity the liquid covers
// the part theta = flux film / h of the length, in full-height streamers that the wall shears:
// theta eta u / h. Validity: mean-gap Reynolds without flow factors (isotropic roughness; factors
// are near 1 above h = 2 sigma), and the ranges of the rough law.
#include "engine/film/ehl_rough.h"

#include "engine/numeric/legendre.h"
#include "engine/surface/van_der_waals.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const int degree[] = {4, 6, 8};
enum { DEGREES = sizeof degree / sizeof degree[0], LEVELS = DEGREES + 1 };

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

SbEhlRoughSolver *sb_ehl_rough_create(void) {
  SbEhlRoughSolver *solver = calloc(1, sizeof *solver);
  if (solver == NULL) {
    return NULL;
  }
  size_t order = SB_EHL_ROUGH_NODES_MAX + 2;
  solver->matrix = malloc(order * order * sizeof(double));
  solver->right = malloc(order * sizeof(double));
  solver->pivot = malloc(order * sizeof(int));
  for (int i = 0; i < 2; i++) {
    solver->mesh[i].kernel = malloc(order * order * sizeof(double));
  }
  if (solver->matrix == NULL || solver->right == NULL || solver->pivot == NULL ||
      solver->mesh[0].kernel == NULL || solver->mesh[1].kernel == NULL) {
    sb_ehl_rough_destroy(solver);
    return NULL;
  }
  return solver;
}

void sb_ehl_rough_destroy(SbEhlRoughSolver *solver) {
  if (solver != NULL) {
    free(solver->matrix);
    free(solver->right);
    free(solver->pivot);
    free(solver->mesh[0].kernel);
    free(solver->mesh[1].kernel);
    free(solver);
  }
}

// ---------------------------------------------------------------- starts

// Flux film of a rough contact: inside, the fluid carries what Hertz's pressure has above p_a(h);
// at the mouth, where the two meet, its slope is the largest that Reynolds allows, (4/27) lambda /
// h^2 (as in Blok's inverse film). Blended with the smooth film. `mouth` is where they meet.
static double flux_guess(double *mouth, const SbEhlRoughCase *c) {
  double smooth = c->lambda > 0 ? sb_ehl_layers_flux(&c->layers) : 0;
  *mouth = 1;
  if (c->law == NULL || !(c->lambda > 0)) {
    return smooth;
  }
  double slope = sb_ehl_layers_inlet_slope(&c->layers);
  SbRoughPoint at;
  sb_rough_law_at(&at, c->law, sb_rough_law_of_pressure(c->law, 0.999999 * c->pressure));
  double low = log(at.gap / c->film), high = low + 40;
  for (int i = 0; i < 50; i++) {
    double middle = 0.5 * (low + high);
    double h = exp(middle);
    sb_rough_law_at(&at, c->law, sb_rough_law_of_gap(c->law, h * c->film));
    double p = fmin(at.pressure / c->pressure, 1);
    if (4.0 / 27 * c->lambda * p > h * h * slope * sqrt(1 - p * p)) {
      low = middle;
    } else {
      high = middle;
    }
  }
  double flux = hypot(exp(low), smooth);
  sb_rough_law_at(&at, c->law, sb_rough_law_of_gap(c->law, flux * c->film));
  double p = fmin(at.pressure / c->pressure, 1);
  *mouth = sqrt(1 - p * p);
  return flux;
}

double sb_ehl_rough_ends(const SbEhlRoughCase *c, double X) {
  double step = asin(fmin(fmax(X, -1), 1)) / M_PI;
  return c->layers.inlet * (0.5 - step) + c->layers.outlet * (0.5 + step);
}

void sb_ehl_rough_guess(SbEhlRoughSolver *solver, int which, const SbEhlRoughCase *c) {
  const SbEhlRoughMesh *mesh = &solver->mesh[which];
  SbEhlRoughState *state = &solver->state[which];
  const SbEhlRoughRule *rule = sb_ehl_rough_rule(solver, mesh->degree);
  double film =
      fmin(c->flux, isfinite(c->supply) && c->lambda > 0 ? c->supply / c->lambda : c->flux);
  double width = sb_ehl_layers_width(&c->layers);
  double floor = 0.02;
  // A film hardly thickened by asperities has the smooth one's layers.
  bool layered = c->lambda > 0 && width < 0.8 && !isfinite(c->supply) &&
                 film < 1.2 * sb_ehl_layers_flux(&c->layers);
  for (int i = 0; i < mesh->nodes; i++) {
    double X = mesh->x[i];
    double q = sb_ehl_layers_dry_pressure(&c->layers, X);
    double dry = sb_film_dry_gap(X);
    double ambient = sb_ehl_rough_ends(c, X);
    double fluid = film > 0 ? film * (1 + 1.2 * exp(-fabs(X + 1) / width)) : 0;
    if (layered) {
      double h;
      sb_ehl_layers_shape(&q, &h, &c->layers, film, X);
      fluid = fmax(h - dry, 0.5 * film);
    }
    double rough = 0;
    if (c->law != NULL) {
      SbRoughPoint at;
      sb_rough_law_at(&at, c->law,
                      sb_rough_law_of_pressure(c->law, fmax(q - ambient, floor) * c->pressure));
      rough = at.gap / c->film;
    }
    double lift = pow(pow(fluid, 6) + pow(rough, 6), 1 / 6.0);
    state->q[i] = q;
    state->t[i] = fmax(sb_ehl_rough_of_gap(c, lift + dry), -3);
  }
  // Flow: by the film, and by the end pressures through the gap (Poiseuille).
  double resistance = 0;
  for (int i = 1; i < mesh->nodes; i++) {
    SbEhlRoughPoint at;
    sb_ehl_rough_point(&at, c, 0.5 * (state->t[i] + state->t[i - 1]));
    resistance += (mesh->x[i] - mesh->x[i - 1]) / (at.h * at.h * at.h);
  }
  state->kappa = isfinite(c->supply)
                     ? c->supply
                     : c->lambda * film + (c->layers.inlet - c->layers.outlet) / resistance;
  // Film pressure that the guess leaves, for the slopes; H0 follows from the first step.
  double p[SB_EHL_ROUGH_NODES_MAX];
  for (int i = 0; i < mesh->nodes; i++) {
    SbEhlRoughPoint at;
    sb_ehl_rough_point(&at, c, state->t[i]);
    p[i] = state->q[i] - at.solid;
    state->broken[i] = c->sealed || (c->layers.outlet <= 0 && c->lambda > 0 &&
                                     mesh->x[i] > c->mouth && c->lambda * at.h > state->kappa);
  }
  for (int e = 0; e < mesh->elements; e++) {
    double half = 0.5 * (mesh->edge[e + 1] - mesh->edge[e]);
    for (int k = e > 0 ? 1 : 0; k <= rule->degree; k++) {
      double sum = 0;
      for (int j = 0; j <= rule->degree; j++) {
        sum += rule->slope[k][j] * p[e * rule->degree + j];
      }
      state->s[e * rule->degree + k] = c->sealed ? 0 : sum / half;
    }
  }
  state->H0 = 0;
}

void sb_ehl_rough_resample(SbEhlRoughSolver *solver, int from, int to) {
  const SbEhlRoughMesh *a = &solver->mesh[from];
  const SbEhlRoughMesh *b = &solver->mesh[to];
  const SbEhlRoughState *old = &solver->state[from];
  SbEhlRoughState *new = &solver->state[to];
  const SbEhlRoughRule *rule = sb_ehl_rough_rule(solver, a->degree);
  for (int i = 0; i < b->nodes; i++) {
    double X = b->x[i], r;
    int e = sb_ehl_rough_locate(a, X, &r);
    new->q[i] = sb_ehl_rough_value(a, rule, old->q, e, r);
    new->t[i] = sb_ehl_rough_value(a, rule, old->t, e, r);
    new->s[i] = sb_ehl_rough_value(a, rule, old->s, e, r);
    // Overshoot of the polynomials is cut to the range of the nodes beside.
    int k = 0;
    while (k < a->degree - 1 && r > rule->node[k + 1]) {
      k++;
    }
    int n = e * a->degree + k;
    double low = fmin(old->t[n], old->t[n + 1]), high = fmax(old->t[n], old->t[n + 1]);
    double margin = 0.3 * (high - low);
    new->t[i] = fmin(fmax(new->t[i], low - margin), high + margin);
    new->broken[i] = old->broken[n];
  }
  new->H0 = old->H0;
  new->kappa = old->kappa;
}

// ---------------------------------------------------------------- solving

static SbStatus attempt(SbEhlRoughSolver *solver, int which, const SbEhlRoughCase *c,
                        SbFilmSolverInfo *info, const SbFilmProblem *problem) {
  SbEhlRoughTrace trace;
  SbStatus status = sb_ehl_rough_newton(&trace, solver, which, c, problem);
  info->newton_iterations += trace.iterations;
  info->continuation_steps++;
  info->residual = trace.step;
  return status;
}

// Adds `times` the difference of two states to a third: a straight line through them.
static void extrapolate(SbEhlRoughState *out, const SbEhlRoughState *now,
                        const SbEhlRoughState *before, int nodes, double times) {
  *out = *now;
  for (int i = 0; i < nodes; i++) {
    out->q[i] += times * (now->q[i] - before->q[i]);
    out->t[i] += times * (now->t[i] - before->t[i]);
  }
  out->H0 += times * (now->H0 - before->H0);
}

// Lambda from where a cold start succeeded down to that of the case, on the mesh of the case. The
// slopes scale with lambda, the flux film is extrapolated by its logarithm.
static SbStatus descend(SbEhlRoughSolver *solver, const SbEhlRoughCase *c, double from,
                        SbFilmSolverInfo *info, const SbFilmProblem *problem) {
  enum { STEPS_MAX = 60 };
  SbEhlRoughState *state = &solver->state[0];
  SbEhlRoughState *now = &solver->saved[0], *before = &solver->saved[1];
  *now = *state;
  double at = log(from), last = NAN;
  double step = log(4.0);
  for (int i = 0; i < STEPS_MAX && at > log(c->lambda); i++) {
    double next = fmax(at - step, log(c->lambda));
    if (next - log(c->lambda) < 0.1 * step) {
      next = log(c->lambda);
    }
    SbEhlRoughCase part = *c;
    part.lambda = exp(next);
    double ratio = exp(next - at);
    double times = isfinite(last) ? (next - at) / (at - last) : 0;
    extrapolate(state, now, before, solver->mesh[0].nodes, times);
    double grow = isfinite(last) && now->kappa > 0 && before->kappa > 0
                      ? pow(now->kappa / before->kappa * exp(last - at), times)
                      : 1;
    state->kappa = now->kappa * ratio * grow;
    SbStatus status = attempt(solver, 0, &part, info, problem);
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
      if (step < 1e-3) {
        return SB_ERROR_NOT_CONVERGED;
      }
    }
  }
  return at > log(c->lambda) ? SB_ERROR_NOT_CONVERGED : SB_OK;
}

static SbStatus start(SbEhlRoughSolver *solver, int *which, const SbEhlRoughCase *c,
                      SbFilmSolverInfo *info, const SbFilmProblem *problem) {
  enum { TRIALS = 12 };
  const SbEhlRoughRule *rule = sb_ehl_rough_rule(solver, degree[0]);
  *which = 0;
  if (!sb_ehl_rough_mesh(&solver->mesh[0], rule, c, 1)) {
    return SB_ERROR_NOT_CONVERGED;
  }
  SbEhlRoughCase trial = *c;
  SbStatus status = SB_ERROR_NOT_CONVERGED;
  for (int i = 0; i < TRIALS; i++) {
    sb_ehl_rough_guess(solver, 0, &trial);
    status = attempt(solver, 0, &trial, info, problem);
    if (status != SB_ERROR_NOT_CONVERGED || !(c->lambda > 0)) {
      break;
    }
    trial.lambda *= 8;
    trial.layers.lambda = trial.lambda;
    trial.flux = flux_guess(&trial.mouth, &trial);
  }
  if (status == SB_OK && trial.lambda > c->lambda) {
    status = descend(solver, c, trial.lambda, info, problem);
  }
  return status;
}

// Follows the layers, then raises the degree until the error meets the tolerance. The last change
// times a rate estimates the error left: inside the contact a level's own error is some hundredth
// of its change; the least film, beside the kink that the rupture leaves, improves more slowly.
static SbStatus refine(SbEhlRoughResults *reading, int *levels, int *which,
                       SbEhlRoughSolver *solver, SbEhlRoughCase *c, SbFilmSolverInfo *info,
                       const SbFilmProblem *problem) {
  static const double RATE = 0.02, RATE_LEAST = 0.05, RATE_FLOW = 0.02;
  info->error_film_min = info->error_film_central = info->error_film_flux = 1;
  bool follow = sb_ehl_rough_fronts(c, solver, *which, &reading[0]);
  for (int k = follow ? 0 : 1; k < DEGREES; k++) {
    int to = 1 - *which;
    const SbEhlRoughRule *rule = sb_ehl_rough_rule(solver, degree[k]);
    if (!sb_ehl_rough_mesh(&solver->mesh[to], rule, c, 1)) {
      break;
    }
    sb_ehl_rough_resample(solver, *which, to);
    SbStatus status = attempt(solver, to, c, info, problem);
    if (status != SB_OK) {
      return status;
    }
    *which = to;
    SbEhlRoughResults *now = &reading[*levels];
    const SbEhlRoughResults *before = now - 1;
    sb_ehl_rough_results(now, solver, to, c);
    sb_ehl_rough_fronts(c, solver, to, now);
    ++*levels;
    double rounding = 1e-15 / fmin(now->film_min + SB_EHL_ROUGH_CLOSED, 1) + 3e-9;
    // A closed gap has no relative error; a flow that still moves, moves the films with it.
    double least = fmax(now->film_min, SB_EHL_ROUGH_CLOSED);
    double central = fmax(now->film_central, SB_EHL_ROUGH_CLOSED);
    double flow = before->film_flux != 0 ? fabs(now->film_flux / before->film_flux - 1) : 0;
    double base = rounding + RATE_FLOW * flow;
    info->error_film_min = RATE_LEAST * fabs(now->film_min - before->film_min) / least + base;
    info->error_film_central =
        RATE * fabs(now->film_central - before->film_central) / central + base;
    info->error_film_flux = RATE_LEAST * flow + rounding;
    double worst = fmax(info->error_film_min, info->error_film_central);
    if (degree[k] > degree[0] && worst < 0.1 * problem->tolerance) {
      break;
    }
  }
  return SB_OK;
}

// Less film at the inlet than the contact would take: from the flooded solution by steps of the
// flow, on a mesh laid out for the last of them.
static SbStatus starve(SbEhlRoughSolver *solver, int *which, SbEhlRoughCase *c, double supply,
                       SbFilmSolverInfo *info, const SbFilmProblem *problem) {
  enum { STEPS_MAX = 60 };
  double flow = solver->state[*which].kappa;
  if (supply >= flow) {
    return SB_OK; // flooded after all
  }
  c->layers.starvation = supply / flow;
  int to = 1 - *which;
  if (!sb_ehl_rough_mesh(&solver->mesh[to], sb_ehl_rough_rule(solver, degree[0]), c, 1)) {
    return SB_ERROR_NOT_CONVERGED;
  }
  sb_ehl_rough_resample(solver, *which, to);
  *which = to;
  solver->saved[0] = solver->state[to];
  double step = log(1.3);
  for (int i = 0; i < STEPS_MAX && flow > supply; i++) {
    double next = fmax(flow * exp(-step), supply);
    c->supply = next;
    solver->state[to].kappa = next;
    SbStatus status = attempt(solver, to, c, info, problem);
    if (status == SB_ERROR_CANCELLED) {
      return status;
    }
    if (status == SB_OK) {
      solver->saved[0] = solver->state[to];
      flow = next;
      step *= 1.5;
    } else {
      solver->state[to] = solver->saved[0];
      step *= 0.35;
      if (step < 1e-6) {
        break;
      }
    }
  }
  return flow > supply ? SB_ERROR_NOT_CONVERGED : SB_OK;
}

// All levels from a cold start.
static SbStatus climb(SbEhlRoughResults *reading, int *levels, int *which, SbEhlRoughSolver *solver,
                      SbEhlRoughCase *c, SbFilmSolverInfo *info, const SbFilmProblem *problem) {
  *levels = 0;
  c->front[0].X = c->front[1].X = INFINITY;
  double supply = c->supply;
  bool starving = isfinite(supply) && !c->sealed;
  c->supply = starving ? INFINITY : supply;
  SbStatus status = start(solver, which, c, info, problem);
  if (status == SB_OK && starving) {
    status = starve(solver, which, c, supply, info, problem);
  }
  if (status != SB_OK) {
    return status;
  }
  sb_ehl_rough_results(&reading[0], solver, *which, c);
  *levels = 1;
  return refine(reading, levels, which, solver, c, info, problem);
}

// Where the models behind the solution end.
static void warn(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale) {
  if (problem->compliance == NULL && scale->half_width > problem->radius) {
    out->valid = false;
    sb_warn(&out->warnings, "film-contact-wide", "seal.modulus",
            "the contact's half-width is %.2g of the radius: no parabola on a half-plane",
            scale->half_width / problem->radius);
  }
  if (problem->surface == SB_ROUGH_GREENWOOD_TRIPP && out->real_area_share > 0.3) {
    out->valid = false;
    sb_warn(&out->warnings, "real-area-large", "surface.gt_product",
            "asperities touch on %.0f %% of the area: Greenwood and Tripp's asperities are no "
            "longer independent; compare Persson's",
            100 * out->real_area_share);
  }
  if (problem->speed != 0 && problem->surface != SB_ROUGH_NONE && out->film_ratio < 0.5 &&
      out->asperity_share < 0.99) {
    sb_warn(&out->warnings, "film-flow-factors", "surface.sigma",
            "the mean gap is %.2g of the roughness: the flow between touching asperities is taken "
            "without flow factors or percolation",
            out->film_ratio);
  }
}

SbStatus sb_ehl_rough_solve(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                            SbEhlRoughSolver *solver, SbReport *report) {
  double begin = seconds();
  SbFilmSolverInfo *info = &out->solver;
  SbEhlRoughCase c = {
      .lambda = scale->lambda,
      .supply = problem->inlet_film > 0 && problem->speed != 0
                    ? scale->lambda * 2 * problem->inlet_film / scale->film
                    : INFINITY,
      .fluid = sb_film_fluid(problem, scale->pressure, scale->film),
      .film = scale->film,
      .pressure = scale->pressure,
      .hamaker = problem->hamaker / (6 * M_PI * scale->pressure * pow(scale->film, 3)),
      .cutoff = SB_VDW_CUTOFF / scale->film,
      .body = sb_film_body(problem, scale),
      .layers = {.lambda = scale->lambda,
                 .inlet = scale->inlet,
                 .outlet = fmax(scale->outlet, 0),
                 .middle = scale->middle,
                 .starvation = 1,
                 .meniscus = -INFINITY,
                 .end = scale->outlet > 0 ? SB_EHL_FULL : SB_EHL_RUPTURE},
  };
  memcpy(c.layers.bow, scale->bow, sizeof c.layers.bow);
  if (problem->surface != SB_ROUGH_NONE) {
    SbRoughSurface surface = {.model = problem->surface,
                              .product = problem->gt_product,
                              .sigma = problem->sigma,
                              .sigma_over_beta = problem->sigma_over_beta,
                              .modulus = problem->modulus};
    if (!solver->law_ready || memcmp(&solver->law.surface, &surface, sizeof surface) != 0) {
      solver->law_ready = false;
      SbStatus made = sb_rough_law_init(&solver->law, &surface, report);
      if (made != SB_OK) {
        return made;
      }
      solver->law_ready = true;
    }
    c.law = &solver->law;
  }
  c.smooth_gap = 0.01 * sb_ehl_layers_flux(&c.layers);
  if (!(c.lambda > 0) && c.layers.inlet == c.layers.outlet) {
    c.sealed = true; // no flow at all
    c.supply = 0;
  }
  c.flux = flux_guess(&c.mouth, &c);

  if (c.layers.inlet < 0) {
    return sb_fail(report, SB_ERROR_INFEASIBLE,
                   "film: the inlet's pressure is below the rupture pressure: no liquid there");
  }

  SbEhlRoughResults reading[LEVELS];
  int which, levels;
  SbStatus status = climb(reading, &levels, &which, solver, &c, info, problem);
  if (status == SB_ERROR_NOT_CONVERGED && !(c.lambda > 0) && !c.sealed) {
    // Closed beyond what the flow at rest can be told from.
    c.sealed = true;
    c.supply = 0;
    status = climb(reading, &levels, &which, solver, &c, info, problem);
    sb_warn(
        &out->warnings, "film-rest-sealed", "surface.sigma",
        "at rest the gap is closed: no flow passes, and the fluid's pressure between the ends is "
        "taken as in the smooth dry contact");
  }
  if (status == SB_ERROR_CANCELLED) {
    return sb_fail(report, status, "film: cancelled");
  }
  if (levels == 0) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                   "film: Newton's method stopped at a step of %.2g", info->residual);
  }
  const SbEhlRoughResults *r = &reading[levels - 1];
  double sign = problem->speed >= 0 ? 1 : -1;
  out->film_min = r->film_min * scale->film;
  out->film_central = r->film_central * scale->film;
  out->film_flux = r->film_flux * scale->film;
  out->flow = 0.5 * problem->speed * out->film_flux;
  out->pressure_max = (r->pressure_max + c.fluid.rupture) * scale->pressure;
  out->position_film_min = sign * (r->position_min + scale->middle) * scale->half_width;
  out->position_rupture = sign * (r->position_rupture + scale->middle) * scale->half_width;
  out->ruptured = r->ruptured;
  out->starved = isfinite(c.supply) && !c.sealed;
  double shear = problem->viscosity * problem->speed * scale->half_width / scale->film;
  out->friction_couette = shear * r->couette;
  out->friction_cavity = shear * r->cavity;
  out->friction_poiseuille = sign * r->poiseuille * scale->film * scale->pressure;
  out->asperity_load = r->asperity_load * scale->half_width * scale->pressure;
  out->asperity_share = out->asperity_load / problem->load;
  out->real_area = r->real_area * scale->half_width;
  out->real_area_share = r->central_share;
  out->film_ratio = c.law != NULL ? out->film_central / problem->sigma : 0;
  out->friction_boundary = sign * (problem->shear_strength * out->real_area +
                                   problem->load_coefficient * out->asperity_load);
  info->load_error = r->load_error;
  info->flux_error = r->flux_error;
  info->unknowns = (size_t)solver->mesh[which].nodes + 2;
  if (status == SB_OK &&
      !(fmax(info->error_film_min, info->error_film_central) <= problem->tolerance)) {
    status = sb_fail(report, SB_ERROR_NOT_CONVERGED,
                     "film: estimated error %.2g, above the tolerance, on the finest mesh",
                     fmax(info->error_film_min, info->error_film_central));
  } else if (status != SB_OK) {
    sb_fail(report, status, "film: Newton's method stopped at a step of %.2g", info->residual);
  }
  info->converged = status == SB_OK;
  warn(out, problem, scale);
  info->wall_s = seconds() - begin;
  sb_ehl_rough_profile(out, solver, which, &c, scale, problem->speed >= 0);
  return status == SB_OK ? sb_succeed(report) : status;
}
