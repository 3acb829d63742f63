// The coupled film solver: levels of degree, error estimate, results.
//
// A cold solve starts from the layers' shapes (layers.c) on the lowest degree and climbs: each
// level takes the one below as its guess, and the difference of two levels, reduced by the rate at
// which differences shrink, estimates the error of the finer. It stops when the estimate meets the
// tolerance. Validity: isoviscous half-plane (options aside), Hertz half-width below the radius.
#include "engine/film/reynolds.h"

#include <math.h>
#include <string.h>
#include <time.h>

// Degrees of the levels; every tolerance takes at least the first three.
static const int level_degree[] = {4, 6, 8, 10, 12, 14};
enum { LEVELS = sizeof level_degree / sizeof level_degree[0], LEVELS_LEAST = 3 };

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// Relative change of the films from one level to the next: minimum, centre, flux.
static void differences(double out[3], const SbReynoldsReading *fine,
                        const SbReynoldsReading *coarse) {
  out[0] = fabs(fine->film_min - coarse->film_min) / fine->film_min;
  out[1] = fabs(fine->film_central - coarse->film_central) / fine->film_central;
  out[2] = fabs(fine->film_flux - coarse->film_flux) / fine->film_flux;
}

// Estimate of the errors of the last level: its change from the level below times the rate at which
// changes shrink. Centre and flux film go together and the minimum follows the outlet layer; a
// single film may agree by chance, so none is trusted far below its companion.
static void estimate(SbFilmSolverInfo *info, const SbReynoldsReading *reading, int levels,
                     double noise) {
  double last[3], before[3] = {0};
  differences(last, &reading[levels - 1], &reading[levels - 2]);
  if (levels > 2) {
    differences(before, &reading[levels - 2], &reading[levels - 3]);
  }
  double middle = fmax(fmax(last[1], last[2]), 0.03 * last[0]);
  double largest[3] = {fmax(last[0], middle), middle, middle};
  double middle_before = fmax(before[1], before[2]);
  double previous[3] = {fmax(before[0], middle_before), middle_before, middle_before};
  double estimates[3];
  for (int i = 0; i < 3; i++) {
    double rate = levels > 2 ? largest[i] / fmax(previous[i], 1e-300) : 0.4;
    rate = fmin(fmax(rate, 0.25), 1.0);
    estimates[i] = rate * largest[i] + noise;
  }
  info->error_film_min = estimates[0];
  info->error_film_central = estimates[1];
  info->error_film_flux = estimates[2];
}

SbStatus sb_reynolds_solve(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                           SbFilmSolver *solver, SbReport *report) {
  double begin = seconds();
  SbReynoldsCase c = {
      .rupture = problem->rupture_pressure / scale->pressure,
      .barus = problem->pressure_viscosity * scale->pressure,
      .eyring = problem->eyring_stress > 0.0 ? problem->viscosity * fabs(problem->speed) /
                                                   (problem->eyring_stress * scale->film)
                                             : 0.0,
      .layers = {.lambda = scale->lambda,
                 .inlet = scale->inlet,
                 .outlet = scale->outlet > 0.0 && scale->outlet <= 1e-9 ? 0.0 : scale->outlet,
                 .starvation = 1.0,
                 .meniscus = -INFINITY,
                 .end = scale->outlet > 1e-9 ? SB_LAYERS_FULL : SB_LAYERS_RUPTURE},
  };
  if (c.layers.inlet < 0.0) {
    return sb_fail(report, SB_ERROR_INFEASIBLE,
                   "film: the inlet's pressure is below the rupture pressure: no liquid there");
  }
  if (c.layers.outlet < 0.0) {
    c.layers.outlet = 0.0;
    sb_warn(&out->warnings, "film-outlet-vapour", "",
            "the outlet's pressure is below the rupture pressure: it is taken to stay at that "
            "pressure behind the contact");
  }
  // A supplied layer moves with the wall at the full speed, the flux film with half of it.
  double supply = problem->inlet_film > 0.0 ? 2.0 * problem->inlet_film / scale->film : INFINITY;
  bool flooded = true;
  SbFilmSolverInfo *info = &out->solver;

  // Rounding of the gap, of size one, against the film: no residual can be smaller.
  double noise = 2.0 * 2.2e-16 / fmin(1.0, pow(scale->lambda, 0.6));
  double tolerance = fmax(1e-11, noise);
  SbReynoldsReading reading[LEVELS];
  int which = 0;
  int levels = 0;
  for (int level = 0; level < LEVELS; level++) {
    SbStatus status;
    c.layers.degree = level_degree[level];
    if (level == 0) {
      status = sb_reynolds_start(&flooded, solver, &which, &c, supply, tolerance, info, problem);
    } else {
      status = sb_reynolds_refine(solver, &which, &c, tolerance, info, problem);
    }
    info->unknowns = (size_t)solver->mesh[which].dofs + 3;
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
    sb_reynolds_read(&reading[level], solver, which, &c);
    levels = level + 1;
    if (levels >= LEVELS_LEAST) {
      estimate(info, reading, levels, noise + info->residual);
      double worst = fmax(info->error_film_min, info->error_film_central);
      if (worst <= 0.1 * problem->tolerance) {
        break;
      }
    }
  }
  const SbReynoldsReading *r = &reading[levels - 1];
  bool forward = problem->speed >= 0.0;
  double sign = forward ? 1.0 : -1.0;
  out->film_min = r->film_min * scale->film;
  out->film_central = r->film_central * scale->film;
  out->film_flux = r->film_flux * scale->film;
  out->flow = 0.5 * problem->speed * out->film_flux;
  out->pressure_max = (r->pressure_max + c.rupture) * scale->pressure;
  out->position_film_min = sign * r->position_min * scale->half_width;
  out->position_rupture = sign * r->position_rupture * scale->half_width;
  out->ruptured = c.layers.end != SB_LAYERS_FULL;
  out->starved = !flooded;
  out->friction_couette =
      problem->viscosity * problem->speed * r->couette * scale->half_width / scale->film;
  out->friction_poiseuille = sign * r->poiseuille * scale->film * scale->pressure;
  if (r->pressure_min < -1e-3) {
    out->valid = false;
    sb_warn(&out->warnings, "film-cavity-inside", "canister.pressure",
            "the pressure falls %.3g Pa below the rupture pressure inside the film",
            -r->pressure_min * scale->pressure);
  }
  info->load_error = r->load_error;
  info->flux_error = r->flux_error;
  info->converged = true;
  info->wall_s = seconds() - begin;
  sb_reynolds_profile(out, solver, which, &c, scale, forward);
  return sb_succeed(report);
}
