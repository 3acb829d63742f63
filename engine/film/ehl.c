// The coupled film solver: levels of degree, error estimate, results, with or without asperities.
//
// A cold start begins with the shapes of the layers (ehl_layers.c) at the lowest degree. Each level
// uses the previous one as its initial guess. The difference of two levels, reduced by the rate at
// which differences decrease, estimates the error of the finer one. The solver stops when the
// estimate meets the tolerance. Validity: isoviscous half-plane (without options), Hertz half-width
// below the radius.
//
// Friction with asperities, per length of seal: over the real area A_a (fraction times length)
// tau_0 A_a + m W_a, W_a the load of the asperities (thesis eq. 5.14); over the remaining area, eta
// u/h (Couette) and (h/2) p' (Poiseuille) in the full film (eq. 5.16). In the cavity the liquid
// covers the fraction theta = flux film/h of the length, in streamers of full height that the wall
// shears: theta eta u/h. Validity: mean-gap Reynolds equation without flow factors (isotropic
// roughness; factors are near 1 above h = 2 sigma), and the ranges of the rough law.
//
// Long: cold and warm starts, with and without asperities, share the levels and their estimate.
#include "engine/film/ehl.h"

#include <gsl/gsl_sf_legendre.h>
#include <math.h>
#include <string.h>

// Levels of degree 4, 6 and so on, and the degree of the last one; every tolerance uses at least
// the first levels.
enum { LEVELS = 6, DEGREE_FIRST = 4, DEGREE_LAST = 14, DEGREE_LAST_ROUGH = 8 };

// Scaled residual where Newton's method of smooth rows ends, on a level that may be the last and on
// those before.
static const double RESIDUAL = 1e-11;
static const double LEVEL_RESIDUAL[] = {1e-7, 1e-9};

// Relative error of rough rows that finer levels do not reduce: tables of the law and places of the
// film's ends.
static const double ROUGH_LEFT = 3e-9;

// Rounding in the films, relative: deflections of size one against the film.
static double rounding(const SbEhlResults *r, bool rough) {
  return rough ? r->film_rounding + ROUGH_LEFT : 3e-16 / fmin(1.0, r->film_min);
}

static double worst(const SbFilmSolver *solver) {
  return fmax(solver->error[0], solver->error[1]);
}

// Returns whether rough rows' film forms again behind its cavity.
static bool forms_again(const SbEhlSolution *s) {
  bool again = false;
  for (int i = 0; i + 1 < s->mesh.dofs; i++) {
    again = again || (s->state.cavity[i] && !s->state.cavity[i + 1]);
  }
  return again;
}

// Returns the rate at which the changes of a solution decrease with the next two degrees, from its
// own spectrum: root mean square of the two highest Legendre coefficients of the pressure divided
// by that of the two below them, at most 1. Each coefficient is weighted by the length of its
// element, because the deflection is proportional to it. Lobatto quadrature at the nodes gives the
// coefficients of the element's polynomial.
static double spectral_rate(const SbEhlSolution *s) {
  double high = 0.0, low = 0.0;
  for (int i = 0; i < s->mesh.count; i++) {
    const SbEhlElement *e = &s->mesh.element[i];
    const int n = e->degree;
    double sum[SB_EHL_DEGREE_MAX + 1] = {0};
    for (int k = 0; k <= n && e->side == 0; k++) {
      double P[SB_EHL_DEGREE_MAX + 1];
      (void)gsl_sf_legendre_Pl_array(n, e->table->node[k], P);
      for (int m = n - 3; m <= n; m++) {
        sum[m] += s->state.nodal[e->first_dof + k] * P[m] / (P[n] * P[n]);
      }
    }
    const double length = e->side == 0 ? e->x1 - e->x0 : 0.0;
    for (int m = n - 3; m <= n; m++) {
      // (2 m + 1) / 2, of the highest one n / 2, times the weights 2 / (n (n + 1) P_n^2).
      const double of = length * (m < n ? 2.0 * m + 1.0 : n) / (n * (n + 1.0)) * sum[m];
      *(m < n - 1 ? &low : &high) += of * of;
    }
  }
  return low > 0.0 ? fmin(sqrt(high / low), 1.0) : 1.0;
}

// Returns the relative error of the contact of rough rows: the larger of the errors of real area
// and asperity load, plus the flow's error, on which both depend.
static double contact_error(const SbEhlResults *now, const SbEhlResults *before, double rate,
                            double flow) {
  const double area =
      now->real_area > 0.0 ? fabs(now->real_area - before->real_area) / now->real_area : 0.0;
  const double load = now->asperity_load > 0.0
                          ? fabs(now->asperity_load - before->asperity_load) / now->asperity_load
                          : 0.0;
  return rate * (fmax(area, load) + flow) + now->contact_rounding + ROUGH_LEFT;
}

// Estimates the errors of the last level: its change from the previous level times the rate at
// which changes decrease. The rate is the larger of the last two changes' ratio (from the third
// level on) and the rate of the solution's spectrum. Changes are those of the surroundings of the
// films (sb_ehl_change). The flux depends on the inlet only; the centre has the inlet's error and
// its own; the minimum has both and the outlet's.
static void estimate(SbFilmSolver *solver, double change[LEVELS][3], int levels,
                     const SbEhlResults *results) {
  // Safety factors on the second level, where the spectrum alone gives the rate, and from the third
  // level on: of the minimum, whose neighbourhood at the outlet is a small part of the spectrum, of
  // the centre and of the flux (test_film_reynolds.c, campaign films).
  static const double SURE[] = {2.0, 1.7, 2.0}, SEEN[] = {2.0, 1.35, 1.5};
  // At least half of the best error of a level, whatever the changes are: finally the rounding of
  // the kernel and of Newton's method; of rough rows the error near the rupture.
  static const double FINEST[LEVELS] = {1.0, 2e-8, 1.5e-10, 1e-10, 1e-10, 1e-10};
  // Without asperities the kinks where the film cavitates and re-forms are not rounded, and are
  // anywhere between nodes: determined from films of smooth rows (M from 0.3 to 1e3, end pressures
  // up to p_H).
  static const double KINK = 0.4, BROKEN[] = {5e-7, 1e-7, 1e-7}, FORMED = 1e-5;
  // The minimum film of rough rows is near the rupture, where the slope of the pressure jumps: its
  // changes decrease more slowly than the spectrum of the full contact (campaign estimates).
  static const double ROUGH = 2.0, RUPTURE = 2.5;
  SbFilmSolverInfo *info = solver->info;
  const SbEhlCase *c = &solver->now->c;
  const bool rough = c->rough.rows;
  const bool again = rough && forms_again(solver->now);
  const SbEhlResults *now = &results[levels - 1], *before = &results[levels - 2];
  double noise = rounding(now, rough) + (rough ? 0.0 : info->residual);
  double *last = change[levels - 1];
  const double flow = last[2];
  last[2] = fmax(last[2], 0.05 * last[1]);
  last[1] = fmax(last[1], last[2]);
  last[0] = fmax(last[0], last[1]);
  const double spectrum = spectral_rate(solver->now);
  for (int i = 0; i < 3; i++) {
    const bool sharp = rough && c->rough.law == NULL;
    const double left = sharp ? again ? FORMED : BROKEN[i] : 0.0;
    const double seen = levels > 2 ? last[i] / fmax(change[levels - 2][i], 1e-300) : 0.0;
    double rate = sharp   ? KINK
                  : rough ? (i == 0 ? RUPTURE : 1.0) * ROUGH * spectrum
                          : (levels == 2 ? SURE : SEEN)[i] * fmin(fmax(seen, spectrum), 1.0);
    solver->error[i] = fmax(rate * last[i] + noise + left, FINEST[levels - 1]);
  }
  if (rough) {
    // The minimum film is between nodes.
    static const double BETWEEN[] = {5e-8, 4e-7};
    solver->error[0] += c->layers.degree < DEGREE_LAST_ROUGH ? BETWEEN[c->rough.coarse] : 0.0;
    // Coarse elements at the ends of a dry contact have kinks inside, which the spectrum of the
    // full contact does not show. A film rounds them.
    const bool kinks = c->rough.coarse && solver->problem->speed == 0.0;
    const double seen = fmax(ROUGH * spectrum, kinks ? KINK : 0.0);
    info->error_contact = c->rough.law != NULL ? contact_error(now, before, seen, flow) : noise;
  }
}

// Scaled problem in the flow frame.
static SbEhlCase scaled_case(const SbFilmProblem *problem, const SbFilmScale *scale) {
  double outlet = scale->outlet > 1e-9 ? scale->outlet : 0.0;
  SbEhlCase c = {
      .fluid = sb_film_fluid(problem, scale->pressure, scale->film),
      .body = {.compliance = problem->compliance,
               .side = problem->speed >= 0.0 ? 1.0 : -1.0,
               .half_width = scale->half_width,
               .film = scale->film},
      .supply = INFINITY,
      .layers = {.lambda = scale->lambda,
                 .middle = scale->middle,
                 .inlet = scale->inlet,
                 .outlet = outlet,
                 .starvation = 1.0,
                 .meniscus = -INFINITY,
                 .end = outlet > 0.0 ? SB_EHL_FULL : SB_EHL_RUPTURE,
                 .degree = DEGREE_FIRST},
  };
  memcpy(c.layers.bow, scale->bow, sizeof c.layers.bow);
  return c;
}

// Results in SI.
static void fill(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                 const SbEhlCase *c, const SbEhlResults *r) {
  out->film_min = r->film_min * scale->film;
  out->film_central = r->film_central * scale->film;
  out->film_flux = r->film_flux * scale->film;
  out->pressure_max = (r->pressure_max + c->fluid.rupture) * scale->pressure;
  out->position_film_min = r->position_min * scale->half_width;
  out->position_rupture = r->position_rupture * scale->half_width;
  out->ruptured = r->ruptured;
  double shear = problem->viscosity * fabs(problem->speed) * scale->half_width / scale->film;
  out->friction_couette = shear * r->couette;
  out->friction_cavity = shear * r->cavity;
  out->friction_poiseuille = r->poiseuille * scale->film * scale->pressure;
  out->asperity_load = r->asperity_load * scale->half_width * scale->pressure;
  out->asperity_share = sb_ehl_asperity_share(
      out->asperity_load, r->solid_load * scale->half_width * scale->pressure, problem->load);
  out->real_area = r->real_area * scale->half_width;
  out->real_area_share = r->central_share;
  out->film_ratio = c->rough.law != NULL ? out->film_central / problem->sigma : NAN;
  out->friction_boundary =
      problem->shear_strength * out->real_area + problem->load_coefficient * out->asperity_load;
  out->solver.load_error = r->load_error;
  out->solver.flux_error = r->flux_error;
  out->starved = isfinite(c->supply);
  if (c->rough.rows) {
    if (sb_rough_kind(problem->surface)->asperities && out->real_area_share > 0.3) {
      out->valid = false;
      sb_warn(&out->warnings, "real-area-large", SB_FILM_IN_ASPERITY_PRODUCT,
              "asperities touch on %.0f %% of the area: Greenwood and Tripp's asperities are no "
              "longer independent; compare Persson's",
              100 * out->real_area_share);
    }
    if (problem->speed != 0 && problem->surface != SB_ROUGH_NONE && out->film_ratio < 0.5 &&
        out->asperity_share < 0.99 && !(problem->percolation_threshold > 0)) {
      sb_warn(&out->warnings, "film-flow-factors", SB_FILM_IN_SIGMA,
              "the mean gap is %.2g of the roughness: the flow between touching asperities is "
              "computed without flow factors or percolation",
              out->film_ratio);
    }
    return;
  }
  if (c->layers.end == SB_EHL_REFORM) {
    sb_warn(&out->warnings, "film-cavity", SB_FILM_IN_PRESSURE,
            "the film breaks before the flooded outlet and forms again behind a cavity");
  }
}

static void give_errors(SbFilm *out, const SbFilmSolver *solver, bool converged) {
  out->solver.error_film_min = solver->error[0];
  out->solver.error_film_central = solver->error[1];
  out->solver.error_film_flux = solver->error[2];
  out->solver.converged = converged;
}

// Solves one level: the first one from a cold start, the others from the level below, or from a
// cold start if that is too coarse a guess. *cold: it was a second level or a later one from a cold
// start.
static SbStatus solve_level(bool *cold, SbFilmSolver *solver, const SbEhlCase *c, int level,
                            double supply) {
  const SbStatus status =
      level == 0 ? sb_ehl_start(solver, c, supply) : sb_ehl_refine(solver, c->layers.degree);
  *cold = level > 0 && status == SB_ERROR_NOT_CONVERGED && !c->rough.rows;
  return *cold ? sb_ehl_start(solver, c, supply) : status;
}

// Computes the results of the last level and, from the second level on, its errors. `paired`: the
// level below was its initial guess.
static void add_level(SbEhlResults *results, double change[LEVELS][3], int *levels,
                      SbFilmSolver *solver, double supply, bool paired) {
  const bool rough = solver->now->c.rough.rows;
  SbEhlResults *now = &results[*levels];
  sb_ehl_results(now, solver->now);
  solver->error[0] = solver->error[1] = solver->error[2] = 1.0;
  if (++*levels >= 2) {
    double *last = change[*levels - 1];
    sb_ehl_change(last, solver, now, now - 1, paired);
    if (isfinite(supply) && !rough) {
      // The supply determines the centre of a starved film: two levels agree there by chance.
      last[1] = fmax(last[1], 0.05 * last[0]);
    }
    estimate(solver, change, *levels, results);
  }
  if (rough) { // the next mesh follows the film's ends
    (void)sb_ehl_rough_fronts(&solver->now->c, solver->now);
  }
}

// Increases the errors of a level whose finer one did not converge: its rate of convergence is not
// known.
static void distrust(SbFilmSolver *solver) {
  static const double UNSEEN = 5;
  for (int i = 0; i < 3; i++) {
    solver->error[i] *= UNSEEN;
  }
  solver->info->error_contact *= UNSEEN;
}

// How a case climbs its levels from a cold start.
typedef struct {
  bool rough;  // rows
  bool saves;  // may begin with large elements
  bool coarse; // has large elements
  bool again;  // has climbed a second time, refine()
  int last;    // degree of the finest mesh
  int degree;  // of the present one
} Climb;

// After a level that failed with `status`, above *levels others: begins again on meshes of other
// degrees or elements. Returns false if there are none left, and changes nothing.
static bool begin_again(Climb *at, int *levels, SbStatus status) {
  const bool lost = status == SB_ERROR_NOT_CONVERGED;
  const bool thin = status == SB_ERROR_RANGE && at->rough && !at->coarse;
  if (lost && !at->rough && *levels <= 1 && at->degree < at->last) {
    // So coarse a mesh may hide the load in its own errors: on a finer one from nothing.
    at->degree += 2;
  } else if (*levels < 2 && ((lost && at->saves) || thin)) {
    // Elements so large that a meniscus has no node near it, or layers so thin that their elements
    // leave no room for a second level.
    at->saves = at->saves && thin;
    at->coarse = thin;
    at->degree = DEGREE_FIRST;
  } else if (lost && at->rough && *levels < 2 && at->degree < at->last) {
    // By chance a front meets a node where it cannot pass: with other nodes from nothing.
    at->degree += *levels == 0 ? 1 : -1;
  } else {
    return false;
  }
  *levels = 0;
  return true;
}

// After the finest level of rough rows whose error is above the tolerance: climbs on from there,
// once, with small elements everywhere and about the minimum film, which may be far from the edges,
// for example where a leak at rest has its narrowest gap. Returns false if that is not to be done.
static bool refine(Climb *at, SbFilmSolver *solver, int levels) {
  SbEhlCase *c = &solver->now->c;
  if (!at->rough || at->again || at->degree <= at->last || levels < 2 ||
      worst(solver) <= solver->problem->tolerance) {
    return false;
  }
  at->again = true;
  at->coarse = c->rough.coarse = false;
  c->rough.least = true;
  (void)sb_ehl_rough_fronts(c, solver->now);
  at->degree = DEGREE_FIRST + 2;
  return true;
}

// Climbs the levels from a cold start. *levels is 0 when nothing was found.
static SbStatus climb(SbEhlResults *results, int *levels, SbFilmSolver *solver,
                      const SbEhlCase *cold, double supply) {
  double change[LEVELS][3] = {{0}};
  const bool rough = cold->rough.rows;
  const double wanted = solver->problem->tolerance;
  const int least = rough || wanted >= 5e-3 ? 2 : 3;
  // Coarse elements leave 1e-8 to 5e-6 of a film, fine ones a hundredth of that.
  static const double ENOUGH = 5e-3;
  const bool saves = rough && wanted >= ENOUGH;
  Climb at = {.rough = rough,
              .saves = saves,
              .coarse = saves,
              .last = rough ? DEGREE_LAST_ROUGH : DEGREE_LAST,
              .degree = DEGREE_FIRST};
  *levels = 0;
  while (at.degree <= at.last || refine(&at, solver, *levels)) {
    SbEhlCase c = *cold;
    c.layers.degree = at.degree;
    c.rough.coarse = at.coarse;
    solver->tolerance = *levels + 1 < least ? LEVEL_RESIDUAL[*levels] : RESIDUAL;
    bool again;
    const SbStatus status = solve_level(&again, solver, &c, *levels, supply);
    if (begin_again(&at, levels, status)) {
      continue;
    }
    if (status == SB_ERROR_RANGE) {
      if (*levels == 0) {
        return SB_ERROR_NOT_CONVERGED;
      }
      break; // no room for a finer mesh: the error so far decides
    }
    if (status == SB_ERROR_NOT_CONVERGED && rough && *levels >= 2) {
      distrust(solver);
      break;
    }
    if (status != SB_OK) {
      return status;
    }
    add_level(results, change, levels, solver, supply, !again);
    if (*levels >= least && at.degree > DEGREE_FIRST && worst(solver) <= 0.1 * wanted) {
      break;
    }
    at.degree += 2;
  }
  // A single level has no error estimate; rough rows may be better than one level of smooth ones.
  return *levels > 1 || rough ? SB_OK : SB_ERROR_NOT_CONVERGED;
}

// Outlet's pressure over the inlet's in the units of the rigid wedge, h_min^2 p / (6 U eta
// sqrt(2 R h_min)): beyond pi/16 it drives the film back (wedge.h).
static double rigid_step(const SbEhlLayers *layers) {
  double film = 4.894968 * layers->lambda / (6.0 * M_PI);
  return pow(film, 1.5) / (sqrt(2.0) * layers->lambda) * (layers->outlet - layers->inlet);
}

// What smooth rows do not resolve: SB_OK, or the refusal. `supply` is the flux film supplied.
static SbStatus refuse_smooth(const SbEhlCase *c, const SbFilmScale *scale, double supply,
                              SbReport *report) {
  if (sb_ehl_layers_flux(&c->layers) < 1e-11) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "M = %.3g: the film is below 1e-11 of b^2/R and lost in rounding; use the "
                   "asymptotic model",
                   scale->M);
  }
  if (scale->M < 0.1 && fabs(rigid_step(&c->layers)) > 4.0) {
    const SbStatus status =
        sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_FILM_IN_PRESSURE,
                      "M = %.3g: end pressures that differ by %.3g times the limit of a rigid "
                      "wedge drive the fluid through so thick a film",
                      scale->M, fabs(rigid_step(&c->layers)) / (M_PI / 16.0));
    return sb_fail_because(report, status, SB_CAUSE_FLUID_OPENS);
  }
  SbEhlLayers starved = c->layers;
  starved.starvation = fmin(1.0, supply / sb_ehl_layers_flux(&c->layers));
  if (isfinite(supply) && sb_ehl_layers_width(&starved) < 1e-7) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "M = %.3g: so little film is supplied that its inlet layer is %.2g of "
                   "the half-width and lost in rounding",
                   scale->M, sb_ehl_layers_width(&starved));
  }
  return SB_OK;
}

// From the last solution, if that meets the tolerance: the layers follow the case, so the error of
// the discretisation stays what it was.
static SbStatus solve_warm(SbEhlResults *results, SbFilmSolver *solver, const SbEhlCase *c) {
  solver->tolerance = RESIDUAL;
  SbStatus status = sb_ehl_follow(solver, c);
  if (status == SB_OK) {
    sb_ehl_results(results, solver->now);
    for (int i = 0; i < 3; i++) {
      solver->error[i] += rounding(results, false) + solver->info->residual;
    }
  }
  return status;
}

// All levels, from a cold start.
static SbStatus solve_cold(SbEhlResults *results, int *levels, SbFilmSolver *solver, SbEhlCase *c,
                           double supply, SbWarnings *warnings) {
  const bool rest = !(c->layers.lambda > 0.0);
  const bool flows = c->rough.rows && rest && !c->rough.sealed;
  c->rough.sealed = c->rough.sealed || (flows && sb_ehl_rough_closed(c));
  SbStatus status = climb(results, levels, solver, c, rest ? INFINITY : supply);
  if (c->rough.rows) {
    if (status == SB_ERROR_NOT_CONVERGED && flows && !c->rough.sealed) {
      // Closed so far that the flow at rest cannot be determined.
      c->rough.sealed = true;
      status = climb(results, levels, solver, c, INFINITY);
    }
    if (flows && c->rough.sealed) {
      sb_warn(warnings, "film-rest-sealed", SB_FILM_IN_SIGMA,
              "at rest the gap is closed: no flow passes, and the fluid's pressure between the "
              "ends is assumed to be that of the smooth dry contact");
    }
  } else if (*levels > 0 && isfinite(supply) && !isfinite(solver->now->c.supply)) {
    // Flooded but for a trifle, see starve() in ehl_continuation.c.
    for (int i = 0; i < 3; i++) {
      solver->error[i] += fmax(1.0 - supply / results[*levels - 1].film_flux, 0.0);
    }
  }
  return status;
}

// Warns of what the film's model does not cover.
static void warn_of_case(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale) {
  if (scale->outlet < 0.0) {
    sb_warn(
        &out->warnings, "film-outlet-vapour", 0,
        "the outlet's pressure is below the rupture pressure, which is assumed after the contact");
  }
  if (problem->compliance == NULL && scale->half_width > problem->radius) {
    out->valid = false;
    sb_warn(&out->warnings, "film-contact-wide", SB_FILM_IN_MODULUS,
            "the contact's half-width is %.2g of the radius: no parabola on a half-plane",
            scale->half_width / problem->radius);
  }
}

// Fills `out` from the solver's last solution and its results.
static void give(SbFilm *out, const SbFilmScale *scale, const SbFilmSolver *solver,
                 const SbEhlResults *results, bool rough, bool converged) {
  const SbEhlSolution *found = solver->now;
  fill(out, solver->problem, scale, &found->c, results);
  out->solver.unknowns = (size_t)found->mesh.dofs + (rough ? 2 : 3);
  give_errors(out, solver, converged);
}

// Solves a case close to the base, from its factors (SbFilmProblem.place). `supply`: flux film
// supplied.
static SbStatus solve_near(SbFilm *out, const SbFilmScale *scale, SbFilmSolver *solver,
                           const SbEhlCase *c, double supply, SbReport *report) {
  SbEhlResults results;
  solver->tolerance = RESIDUAL;
  SbStatus status = solver->base.solved ? sb_ehl_from_base(solver, c, solver->problem->place)
                                        : SB_ERROR_NOT_CONVERGED;
  if (status == SB_OK) {
    sb_ehl_results(&results, solver->now);
    status = results.film_flux > supply ? SB_ERROR_NOT_CONVERGED : SB_OK; // it is starved
  }
  if (status != SB_OK) {
    return sb_fail(report, status, "none next to the last one");
  }
  give(out, scale, solver, &results, c->rough.rows, true);
  out->solver.error_contact = solver->base.error_contact;
  return sb_succeed(report);
}

// Solves a case from the last solution or from a cold start; a smooth film that is not found so, as
// a rough one. *rough: the last attempt has rough rows.
static SbStatus solve_alone(SbEhlResults *results, int *levels, bool *rough, SbFilmSolver *solver,
                            SbEhlCase *c, const SbFilmScale *scale, double supply,
                            SbWarnings *warnings, SbReport *report) {
  const bool warm = solver->last.ready && solver->last.tolerance <= solver->problem->tolerance &&
                    !isfinite(supply) && !*rough;
  solver->base.solved = solver->base.held = solver->base.ready = false;
  solver->last.ready = false;
  *levels = 1;
  SbStatus status = warm ? solve_warm(results, solver, c) : SB_ERROR_NOT_CONVERGED;
  if (status == SB_ERROR_NOT_CONVERGED) {
    status = solve_cold(results, levels, solver, c, supply, warnings);
    if (status == SB_ERROR_NOT_CONVERGED && !*rough && !isfinite(supply)) {
      // Rough rows take a smooth film as well, and find its cavity themselves.
      *rough = true;
      status = sb_ehl_rough_case(c, solver, scale, report);
      status = status == SB_OK ? solve_cold(results, levels, solver, c, supply, warnings) : status;
    }
  }
  return status;
}

// Reports why a case has no solution, or why its levels ended.
static SbStatus report_failure(const SbFilmSolver *solver, SbStatus status, SbReport *report) {
  if (status == SB_ERROR_CANCELLED) {
    return sb_fail(report, status, "cancelled");
  }
  if (status == SB_ERROR_INFEASIBLE) {
    return sb_fail_input(report, status, SB_FILM_IN_INLET,
                         "no film has a starved inlet together with a cavity before a flooded "
                         "outlet; a flooded inlet has one");
  }
  (void)sb_fail(report, status, "Newton's method stopped at residual %.2g, degree %d",
                solver->info->residual, solver->now->c.layers.degree);
  if (report != NULL) {
    report->residual = solver->info->residual;
    report->iteration = solver->info->newton_iterations;
  }
  return status;
}

SbStatus sb_ehl_solve(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                      SbFilmSolver *solver, SbReport *report) {
  bool rough = sb_film_rough(problem);
  SbFilmSolverInfo *info = &out->solver;
  SbEhlCase c = scaled_case(problem, scale);
  solver->problem = problem;
  solver->info = info;
  // A supplied layer moves with the wall at the full speed, the flux film with half of it.
  double supply = problem->inlet_film > 0.0 ? 2.0 * problem->inlet_film / scale->film : INFINITY;
  if (c.layers.inlet < 0.0) {
    return sb_fail(report, SB_ERROR_INFEASIBLE,
                   "the inlet's pressure is below the rupture pressure: no liquid there");
  }
  SbStatus status = rough ? sb_ehl_rough_case(&c, solver, scale, report)
                          : refuse_smooth(&c, scale, supply, report);
  if (status != SB_OK) {
    return status;
  }
  warn_of_case(out, problem, scale);
  if (problem->place != SB_FILM_ALONE) {
    return solve_near(out, scale, solver, &c, supply, report);
  }

  SbEhlResults results[LEVELS];
  int levels;
  status = solve_alone(results, &levels, &rough, solver, &c, scale, supply, &out->warnings, report);
  if (status != SB_OK) {
    status = report_failure(solver, status, report);
  }
  if (levels == 0 || status == SB_ERROR_CANCELLED || status == SB_ERROR_INFEASIBLE) {
    return status;
  }

  // The tolerance decides, whether or not the last level was reached; rough rows must end.
  give(out, scale, solver, &results[levels - 1], rough,
       worst(solver) <= problem->tolerance && !(rough && status != SB_OK));
  solver->base.solved = info->converged;
  solver->base.error_contact = info->error_contact;
  if (info->converged) {
    solver->last.ready = !rough;
    solver->last.tolerance = problem->tolerance;
    status = sb_succeed(report);
  } else if (status == SB_OK) {
    status =
        sb_fail(report, SB_ERROR_NOT_CONVERGED,
                "estimated error %.2g, above the tolerance, on the finest mesh", worst(solver));
  }
  return status;
}
