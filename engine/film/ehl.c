// The coupled film solver: levels of degree, error estimate, results, with asperities or without.
//
// A cold solve starts from the layers' shapes (ehl_layers.c) on the lowest degree and climbs: each
// level takes the one below as its guess, and the difference of two levels, reduced by the rate at
// which differences shrink, estimates the error of the finer. It stops when the estimate meets the
// tolerance. Validity: isoviscous half-plane (options aside), Hertz half-width below the radius.
//
// Friction with asperities, per length of seal: over the real area A_a (share times length) tau_0
// A_a + m W_a, W_a what the asperities carry (thesis eq. 5.14); over the rest, eta u / h of Couette
// and (h/2) p' of Poiseuille in the full film (eq. 5.16); in the cavity the liquid covers the part
// theta = flux film / h of the length, in full-height streamers that the wall shears: theta eta u /
// h. Validity: mean-gap Reynolds without flow factors (isotropic roughness; factors are near 1
// above h = 2 sigma), and the ranges of the rough law.
#include "engine/film/ehl.h"

#include <math.h>
#include <string.h>
#include <time.h>

// Degrees of the levels; every tolerance takes at least the first three.
static const int level_degree[SB_EHL_LEVELS_MAX] = {4, 6, 8, 10, 12, 14};
enum { LEVELS = SB_EHL_LEVELS_MAX, LEVELS_LEAST = 3 };

// Scaled residual where Newton's method ends, on a level that may be the last and on those before.
static const double RESIDUAL = 1e-11;
static const double LEVEL_RESIDUAL[LEVELS_LEAST - 1] = {1e-7, 1e-9};

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// Estimate of the errors of the last level: its change from the level below times the rate at which
// changes shrink, which is not believed to be better than what was found over the range of M and
// end pressures. Changes are those of the films' surroundings (sb_ehl_change). The flux hangs
// on the inlet alone; the centre has its error and its own; the minimum both and the outlet's.
static void estimate(SbFilmSolverInfo *info, double change[LEVELS][3], int levels, double noise) {
  static const double SLOWEST[LEVELS] = {1.0, 0.13, 0.06, 0.1, 0.1, 0.1};
  // Half of what a level leaves at its best, whatever the changes say: at last the kernel's and
  // Newton's own digits.
  static const double FINEST[LEVELS] = {1.0, 2e-8, 1.5e-10, 1e-10, 1e-10, 1e-10};
  double *c = change[levels - 1];
  c[2] = fmax(c[2], 0.05 * c[1]);
  c[1] = fmax(c[1], c[2]);
  c[0] = fmax(c[0], c[1]);
  double estimates[3];
  for (int i = 0; i < 3; i++) {
    double last = change[levels - 1][i];
    double rate = levels > 2 ? last / fmax(change[levels - 2][i], 1e-300) : 0.0;
    estimates[i] = fmin(fmax(rate, SLOWEST[levels - 1]), 1.0) * last + noise;
    estimates[i] = fmax(estimates[i], FINEST[levels - 1]);
  }
  info->error_film_min = estimates[0];
  info->error_film_central = estimates[1];
  info->error_film_flux = estimates[2];
}

// Scaled problem in the flow frame.
static SbEhlCase scaled_case(const SbFilmProblem *problem, const SbFilmScale *scale) {
  double outlet = scale->outlet > 1e-9 ? scale->outlet : 0.0;
  SbEhlCase c = {
      .fluid = sb_film_fluid(problem, scale->pressure, scale->film),
      .body = sb_film_body(problem, scale),
      .layers = {.lambda = scale->lambda,
                 .middle = scale->middle,
                 .inlet = scale->inlet,
                 .outlet = outlet,
                 .starvation = 1.0,
                 .meniscus = -INFINITY,
                 .end = outlet > 0.0 ? SB_EHL_FULL : SB_EHL_RUPTURE,
                 .degree = level_degree[0],
                 .steps = {-1, -1}},
  };
  memcpy(c.layers.bow, scale->bow, sizeof c.layers.bow);
  return c;
}

// Results in SI and in the seal's frame.
static void fill(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                 const SbEhlCase *c, const SbEhlResults *r) {
  double sign = problem->speed >= 0.0 ? 1.0 : -1.0;
  out->film_min = r->film_min * scale->film;
  out->film_central = r->film_central * scale->film;
  out->film_flux = r->film_flux * scale->film;
  out->flow = 0.5 * problem->speed * out->film_flux;
  out->pressure_max = (r->pressure_max + c->fluid.rupture) * scale->pressure;
  out->position_film_min = sign * r->position_min * scale->half_width;
  out->position_rupture = sign * r->position_rupture * scale->half_width;
  out->ruptured = r->ruptured;
  double shear = problem->viscosity * problem->speed * scale->half_width / scale->film;
  out->friction_couette = shear * r->couette;
  out->friction_cavity = shear * r->cavity;
  out->friction_poiseuille = sign * r->poiseuille * scale->film * scale->pressure;
  out->asperity_load = r->asperity_load * scale->half_width * scale->pressure;
  out->asperity_share = out->asperity_load / problem->load;
  out->real_area = r->real_area * scale->half_width;
  out->real_area_share = r->central_share;
  out->film_ratio = c->rough.law != NULL ? out->film_central / problem->sigma : NAN;
  out->friction_boundary = sign * (problem->shear_strength * out->real_area +
                                   problem->load_coefficient * out->asperity_load);
  out->solver.load_error = r->load_error;
  out->solver.flux_error = r->flux_error;
  if (c->rough.rows) {
    out->starved = isfinite(c->rough.supply) && !c->rough.sealed;
    if (problem->surface == SB_ROUGH_GREENWOOD_TRIPP && out->real_area_share > 0.3) {
      out->valid = false;
      sb_warn(&out->warnings, "real-area-large", "surface.gt_product",
              "asperities touch on %.0f %% of the area: Greenwood and Tripp's asperities are no "
              "longer independent; compare Persson's",
              100 * out->real_area_share);
    }
    if (problem->speed != 0 && problem->surface != SB_ROUGH_NONE && out->film_ratio < 0.5 &&
        out->asperity_share < 0.99) {
      sb_warn(
          &out->warnings, "film-flow-factors", "surface.sigma",
          "the mean gap is %.2g of the roughness: the flow between touching asperities is taken "
          "without flow factors or percolation",
          out->film_ratio);
    }
    return;
  }
  out->starved = isfinite(c->layers.meniscus);
  if (c->layers.end == SB_EHL_REFORM) {
    sb_warn(&out->warnings, "film-cavity", "canister.pressure",
            "the film breaks before the flooded outlet and forms again behind a cavity");
  }
}

// Rounding in the films, relative: deflections of size one against the film.
static double rounding(const SbEhlResults *r) {
  return 3e-16 / fmin(1.0, r->film_min);
}

// Climbs the levels from a cold start. *levels is 0 when nothing was found.
static SbStatus climb(SbEhlResults *results, int *levels, int *which, SbFilmSolver *solver,
                      SbEhlCase *c, double supply, SbFilmSolverInfo *info,
                      const SbFilmProblem *problem, SbReport *report) {
  const SbEhlCase cold = *c;
  double change[LEVELS][3] = {{0}};
  *which = 0;
  *levels = 0;
  int least = problem->tolerance >= 5e-3 ? LEVELS_LEAST - 1 : LEVELS_LEAST;
  for (int level = 0; level < LEVELS; level++) {
    bool flooded = true;
    const int at = *levels;
    const SbEhlRun run = {at + 1 < least ? LEVEL_RESIDUAL[at] : RESIDUAL, info, problem};
    c->layers.degree = at == 0 ? level_degree[level] : c->layers.degree;
    SbStatus status = at == 0 ? sb_ehl_start(&flooded, solver, which, c, supply, &run)
                              : sb_ehl_refine(solver, which, c, level_degree[level], &run);
    bool anew = at > 0 && status == SB_ERROR_NOT_CONVERGED;
    if (anew) {
      // The level below may be too coarse a guess: this one from nothing.
      *c = cold;
      c->layers.degree = level_degree[level];
      status = sb_ehl_start(&flooded, solver, which, c, supply, &run);
    }
    if (status == SB_ERROR_NOT_CONVERGED && at <= 1 && level + 1 < LEVELS) {
      // So coarse a mesh may hide the load in its own errors: on a finer one from nothing.
      *c = cold;
      *levels = 0;
      continue;
    }
    if (status == SB_ERROR_INFEASIBLE) {
      return sb_fail(report, status,
                     "film: a starved inlet together with a cavity before a flooded outlet");
    }
    if (status == SB_ERROR_CANCELLED) {
      return sb_fail(report, status, "film: cancelled");
    }
    if (status != SB_OK) {
      status = sb_fail(report, status, "film: Newton's method stopped at residual %.2g, degree %d",
                       info->residual, level_degree[level]);
      if (report != NULL) {
        report->residual = info->residual;
        report->iteration = info->newton_iterations;
      }
      return status;
    }
    sb_ehl_results(&results[at], solver, *which, c);
    *levels = at + 1;
    if (at > 0) {
      sb_ehl_change(change[at], solver, *which, c, &results[at], &results[at - 1], !anew);
      if (isfinite(c->layers.meniscus)) {
        // The supply holds the centre of a starved film: two levels agree there by chance.
        change[at][1] = fmax(change[at][1], 0.05 * change[at][0]);
      }
      estimate(info, change, *levels, rounding(&results[at]) + info->residual);
    }
    double worst = fmax(info->error_film_min, info->error_film_central);
    if (*levels >= least && worst <= 0.1 * problem->tolerance) {
      break;
    }
  }
  return SB_OK;
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
                   "film: M = %.3g: the film is below 1e-11 of b^2/R and lost in rounding; use the "
                   "asymptotic model",
                   scale->M);
  }
  if (scale->M < 0.1 && fabs(rigid_step(&c->layers)) > 4.0) {
    return sb_fail_parameter(report, SB_ERROR_INFEASIBLE, "canister.pressure",
                             "film: M = %.3g: end pressures that differ by %.3g times what a "
                             "rigid wedge bears drive the fluid through so thick a film",
                             scale->M, fabs(rigid_step(&c->layers)) / (M_PI / 16.0));
  }
  SbEhlLayers starved = c->layers;
  starved.starvation = fmin(1.0, supply / sb_ehl_layers_flux(&c->layers));
  if (isfinite(supply) && sb_ehl_layers_width(&starved) < 1e-7) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "film: M = %.3g: so little film is supplied that its inlet layer is %.2g of "
                   "the half-width and lost in rounding",
                   scale->M, sb_ehl_layers_width(&starved));
  }
  return SB_OK;
}

// All levels of smooth rows: from the last solution if that meets the tolerance, or cold.
static SbStatus solve_smooth(SbEhlResults *results, int *levels, int *which, SbFilmSolver *solver,
                             SbEhlCase *c, double supply, bool warm, SbFilmSolverInfo *info,
                             const SbFilmProblem *problem, SbReport *report) {
  if (warm) {
    // The layers follow the case, so the error of the discretisation stays what it was.
    *which = solver->last.which;
    c->layers.degree = solver->last.problem.layers.degree;
    const SbEhlRun run = {RESIDUAL, info, problem};
    SbStatus status = sb_ehl_follow(solver, which, &solver->last.problem, c, &run);
    if (status == SB_ERROR_CANCELLED) {
      return sb_fail(report, status, "film: cancelled");
    }
    if (status == SB_OK) {
      sb_ehl_results(&results[0], solver, *which, c);
      *levels = 1;
      double noise = rounding(&results[0]) + info->residual;
      info->error_film_min = solver->last.error[0] + noise;
      info->error_film_central = solver->last.error[1] + noise;
      info->error_film_flux = solver->last.error[2] + noise;
      return SB_OK;
    }
    c->layers.degree = level_degree[0];
  }
  SbStatus status = climb(results, levels, which, solver, c, supply, info, problem, report);
  if (*levels == 1) {
    info->error_film_min = info->error_film_central = info->error_film_flux = 1.0;
  }
  if (*levels > 0 && isfinite(supply) && !isfinite(c->layers.meniscus)) {
    // Flooded but for a trifle, see starve() in ehl_continuation.c.
    double excess = fmax(1.0 - supply / results[*levels - 1].film_flux, 0.0);
    info->error_film_min += excess;
    info->error_film_central += excess;
    info->error_film_flux += excess;
  }
  return status;
}

static SbStatus solve_rough(SbEhlResults *results, int *levels, int *which, SbFilmSolver *solver,
                            SbEhlCase *c, SbFilm *out, const SbFilmProblem *problem,
                            SbReport *report) {
  bool sealed = c->rough.sealed;
  const SbEhlRun run = {0.0, &out->solver, problem};
  SbStatus status = sb_ehl_rough_climb(results, levels, which, solver, c, &run);
  if (c->rough.sealed && !sealed) {
    sb_warn(&out->warnings, "film-rest-sealed", "surface.sigma",
            "at rest the gap is closed: no flow passes, and the fluid's pressure between the ends "
            "is taken as in the smooth dry contact");
  }
  if (status == SB_ERROR_CANCELLED) {
    return sb_fail(report, status, "film: cancelled");
  }
  return status == SB_OK
             ? SB_OK
             : sb_fail(report, status, "film: Newton's method stopped at a step of %.2g",
                       out->solver.residual);
}

SbStatus sb_ehl_solve(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                      SbFilmSolver *solver, SbReport *report) {
  double begin = seconds();
  const bool rough = sb_film_rough(problem);
  SbEhlCase c = scaled_case(problem, scale);
  SbFilmSolverInfo *info = &out->solver;
  // A supplied layer moves with the wall at the full speed, the flux film with half of it.
  double supply = problem->inlet_film > 0.0 ? 2.0 * problem->inlet_film / scale->film : INFINITY;
  SbStatus status = SB_OK;
  if (c.layers.inlet < 0.0) {
    return sb_fail(report, SB_ERROR_INFEASIBLE,
                   "film: the inlet's pressure is below the rupture pressure: no liquid there");
  }
  status = rough ? sb_ehl_rough_case(&c, solver, problem, scale, report)
                 : refuse_smooth(&c, scale, supply, report);
  if (status != SB_OK) {
    return status;
  }
  if (scale->outlet < 0.0) {
    sb_warn(&out->warnings, "film-outlet-vapour", "",
            "the outlet's pressure is below the rupture pressure: it is taken to stay at that "
            "pressure behind the contact");
  }
  if (problem->compliance == NULL && scale->half_width > problem->radius) {
    out->valid = false;
    sb_warn(&out->warnings, "film-contact-wide", "seal.modulus",
            "the contact's half-width is %.2g of the radius: no parabola on a half-plane",
            scale->half_width / problem->radius);
  }

  SbEhlResults results[SB_EHL_LEVELS_MAX];
  int levels = 0;
  int which = 0;
  bool warm =
      solver->last.ready && solver->last.tolerance <= problem->tolerance && !isfinite(supply);
  solver->last.ready = false;
  status = rough ? solve_rough(results, &levels, &which, solver, &c, out, problem, report)
                 : solve_smooth(results, &levels, &which, solver, &c, supply, warm, info, problem,
                                report);
  if (levels == 0 || status == SB_ERROR_CANCELLED) {
    return status;
  }

  // The tolerance decides, whether or not the last level was reached; rough rows must end.
  fill(out, problem, scale, &c, &results[levels - 1]);
  info->unknowns = (size_t)solver->mesh[which].dofs + (rough ? 2 : 3);
  info->converged = fmax(info->error_film_min, info->error_film_central) <= problem->tolerance &&
                    !(rough && status != SB_OK);
  if (info->converged) {
    solver->last.ready = !rough;
    solver->last.which = which;
    solver->last.problem = c;
    solver->last.tolerance = problem->tolerance;
    solver->last.error[0] = info->error_film_min;
    solver->last.error[1] = info->error_film_central;
    solver->last.error[2] = info->error_film_flux;
    status = sb_succeed(report);
  } else if (status == SB_OK) {
    status = sb_fail(report, SB_ERROR_NOT_CONVERGED,
                     "film: estimated error %.2g, above the tolerance, on the finest mesh",
                     fmax(info->error_film_min, info->error_film_central));
  }
  info->wall_s = seconds() - begin;
  sb_ehl_profile(out, solver, which, &c, scale, problem);
  return status;
}
