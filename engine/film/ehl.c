// The coupled film solver: levels of degree, error estimate, results.
//
// A cold solve starts from the layers' shapes (ehl_layers.c) on the lowest degree and climbs: each
// level takes the one below as its guess, and the difference of two levels, reduced by the rate at
// which differences shrink, estimates the error of the finer. It stops when the estimate meets the
// tolerance. Validity: isoviscous half-plane (options aside), Hertz half-width below the radius.
#include "engine/film/ehl.h"

#include <math.h>
#include <string.h>
#include <time.h>

// Degrees of the levels; every tolerance takes at least the first three.
static const int level_degree[] = {4, 6, 8, 10, 12, 14};
enum { LEVELS = sizeof level_degree / sizeof level_degree[0], LEVELS_LEAST = 3 };

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
  out->ruptured = c->layers.end != SB_EHL_FULL;
  out->starved = isfinite(c->layers.meniscus);
  out->friction_couette =
      problem->viscosity * problem->speed * r->couette * scale->half_width / scale->film;
  out->friction_poiseuille = sign * r->poiseuille * scale->film * scale->pressure;
  out->solver.load_error = r->load_error;
  out->solver.flux_error = r->flux_error;
  if (out->ruptured && c->layers.end == SB_EHL_REFORM) {
    sb_warn(&out->warnings, "film-cavity", "canister.pressure",
            "the film breaks before the flooded outlet and forms again behind a cavity");
  }
}

// Rounding in the films, relative: deflections of size one against the film.
static double rounding(const SbEhlResults *r) {
  return 3e-16 / fmin(1.0, r->film_min);
}

// Climbs the levels from a cold start. *levels is 0 when nothing was found.
static SbStatus climb(SbEhlResults *reading, int *levels, int *which, SbFilmSolver *solver,
                      SbEhlCase *c, double supply, SbFilmSolverInfo *info,
                      const SbFilmProblem *problem, SbReport *report) {
  const SbEhlCase cold = *c;
  double change[LEVELS][3] = {{0}};
  *which = 0;
  *levels = 0;
  int least = problem->tolerance >= 5e-3 ? LEVELS_LEAST - 1 : LEVELS_LEAST;
  for (int level = 0; level < LEVELS; level++) {
    bool flooded = true;
    double residual = level + 1 < least ? LEVEL_RESIDUAL[level] : RESIDUAL;
    SbStatus status =
        level == 0 ? sb_ehl_start(&flooded, solver, which, c, supply, residual, info, problem)
                   : sb_ehl_refine(solver, which, c, level_degree[level], residual, info, problem);
    bool anew = level > 0 && status == SB_ERROR_NOT_CONVERGED;
    if (anew) {
      // The level below may be too coarse a guess: this one from nothing.
      *c = cold;
      c->layers.degree = level_degree[level];
      status = sb_ehl_start(&flooded, solver, which, c, supply, residual, info, problem);
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
    sb_ehl_results(&reading[level], solver, *which, c);
    *levels = level + 1;
    if (*levels >= 2) {
      sb_ehl_change(change[level], solver, *which, c, &reading[level], &reading[level - 1], !anew);
      estimate(info, change, *levels, rounding(&reading[level]) + info->residual);
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

SbStatus sb_ehl_solve(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                      SbFilmSolver *solver, SbReport *report) {
  double begin = seconds();
  SbEhlCase c = scaled_case(problem, scale);
  SbFilmSolverInfo *info = &out->solver;
  // Refusals: no liquid at the inlet, or a film below what double precision resolves.
  if (c.layers.inlet < 0.0) {
    return sb_fail(report, SB_ERROR_INFEASIBLE,
                   "film: the inlet's pressure is below the rupture pressure: no liquid there");
  }
  if (sb_ehl_layers_flux(&c.layers) < 1e-11) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "film: M = %.3g: the film is below 1e-11 of b^2/R and lost in rounding; use the "
                   "asymptotic model",
                   scale->M);
  }
  if (scale->M < 0.1 && fabs(rigid_step(&c.layers)) > 4.0) {
    return sb_fail_parameter(report, SB_ERROR_INFEASIBLE, "canister.pressure",
                             "film: M = %.3g: end pressures that differ by %.3g times what a "
                             "rigid wedge bears drive the fluid through so thick a film",
                             scale->M, fabs(rigid_step(&c.layers)) / (M_PI / 16.0));
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
  // A supplied layer moves with the wall at the full speed, the flux film with half of it.
  double supply = problem->inlet_film > 0.0 ? 2.0 * problem->inlet_film / scale->film : INFINITY;

  if (isfinite(supply)) {
    SbEhlLayers starved = c.layers;
    starved.starvation = fmin(1.0, supply / sb_ehl_layers_flux(&c.layers));
    if (sb_ehl_layers_width(&starved) < 1e-7) {
      return sb_fail(report, SB_ERROR_RANGE,
                     "film: M = %.3g: so little film is supplied that its inlet layer is %.2g of "
                     "the half-width and lost in rounding",
                     scale->M, sb_ehl_layers_width(&starved));
    }
  }

  SbEhlResults reading[LEVELS];
  int levels = 0;
  int which = 0;
  SbStatus status = SB_ERROR_NOT_CONVERGED;
  bool warm =
      solver->last.ready && solver->last.tolerance <= problem->tolerance && !isfinite(supply);
  solver->last.ready = false;
  if (warm) {
    // The layers follow the case, so the error of the discretisation stays what it was.
    which = solver->last.which;
    c.layers.degree = solver->last.problem.layers.degree;
    status = sb_ehl_follow(solver, &which, &solver->last.problem, &c, 1e-11, info, problem);
    if (status == SB_ERROR_CANCELLED) {
      return sb_fail(report, status, "film: cancelled");
    }
    if (status == SB_OK) {
      sb_ehl_results(&reading[0], solver, which, &c);
      levels = 1;
      double noise = rounding(&reading[0]) + info->residual;
      info->error_film_min = solver->last.error[0] + noise;
      info->error_film_central = solver->last.error[1] + noise;
      info->error_film_flux = solver->last.error[2] + noise;
    }
    c.layers.degree = status == SB_OK ? c.layers.degree : level_degree[0];
  }
  if (levels == 0) {
    status = climb(reading, &levels, &which, solver, &c, supply, info, problem, report);
    if (levels == 0) {
      return status;
    }
    if (levels == 1) {
      info->error_film_min = info->error_film_central = info->error_film_flux = 1.0;
    }
  }

  // The tolerance decides, whether or not the last level was reached.
  const SbEhlResults *r = &reading[levels - 1];
  fill(out, problem, scale, &c, r);
  if (isfinite(supply) && !out->starved) {
    // Flooded but for a trifle, see starve() in ehl_continuation.c.
    double excess = fmax(1.0 - supply / r->film_flux, 0.0);
    info->error_film_min += excess;
    info->error_film_central += excess;
    info->error_film_flux += excess;
  }
  info->unknowns = (size_t)solver->mesh[which].dofs + 3;
  info->converged = fmax(info->error_film_min, info->error_film_central) <= problem->tolerance;
  if (info->converged) {
    solver->last.ready = true;
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
