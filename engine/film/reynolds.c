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

// Adds what a call of Newton's method did to the totals.
static void account(SbFilmSolverInfo *info, const SbReynoldsTrace *trace) {
  info->newton_iterations += trace->iterations;
  info->continuation_steps++;
  info->residual = trace->residual;
}

// Cold start on the lowest degree.
static SbStatus cold_start(SbFilmSolver *solver, int which, SbReynoldsCase *c, double tolerance,
                           SbFilmSolverInfo *info, const SbFilmProblem *problem) {
  SbReynoldsState *state = &solver->state[which];
  if (!sb_layers_mesh(&solver->mesh[which], &solver->tables, &c->layers)) {
    return SB_ERROR_NOT_CONVERGED;
  }
  state->H0 = 0.0;
  sb_layers_guess(state->nodal, state->gap, &state->shift, &state->flux, &solver->mesh[which],
                  &solver->tables, &c->layers);
  SbReynoldsTrace trace;
  SbStatus status = sb_reynolds_newton(&trace, solver, which, c, true, tolerance, problem);
  account(info, &trace);
  return status;
}

// True when both meshes have the same elements up to their places and degrees.
static bool same_elements(const SbHpMesh *a, const SbHpMesh *b) {
  if (a->count != b->count) {
    return false;
  }
  for (int i = 0; i < a->count; i++) {
    if (a->element[i].map != b->element[i].map || a->element[i].apart != b->element[i].apart) {
      return false;
    }
  }
  return true;
}

// The case a fraction t of the way from an easy one: small end pressures, no options, M = 20 if
// thick.
static SbReynoldsCase between(const SbReynoldsCase *target, double t) {
  SbReynoldsCase c = *target;
  static const double EASY_LAMBDA = 0.0093; // M = 20
  static const double EASY_PRESSURE = 0.3;
  if (c.layers.lambda > EASY_LAMBDA) {
    c.layers.lambda = EASY_LAMBDA * pow(c.layers.lambda / EASY_LAMBDA, t);
  }
  double inlet = fmin(c.layers.inlet, EASY_PRESSURE);
  double outlet = fmin(c.layers.outlet, EASY_PRESSURE);
  c.layers.inlet = inlet + t * (c.layers.inlet - inlet);
  c.layers.outlet = outlet + t * (c.layers.outlet - outlet);
  c.barus *= t;
  c.eyring *= t;
  return c;
}

// Reaches the case on the lowest degree by continuation; the layers carry the last solution along.
// Ends in mesh/state *which.
static SbStatus continuation(SbFilmSolver *solver, int *which, const SbReynoldsCase *target,
                             double tolerance, SbFilmSolverInfo *info,
                             const SbFilmProblem *problem) {
  enum { STEPS_MAX = 60 };
  SbReynoldsCase c = between(target, 0.0);
  SbStatus status = cold_start(solver, *which, &c, tolerance, info, problem);
  double done = 0.0;
  double step = 0.25;
  for (int i = 0; status == SB_OK && done < 1.0; i++) {
    double t = fmin(1.0, done + step);
    SbReynoldsCase next = between(target, t);
    int to = 1 - *which;
    SbStatus tried = SB_ERROR_NOT_CONVERGED;
    if (sb_layers_mesh(&solver->mesh[to], &solver->tables, &next.layers)) {
      if (same_elements(&solver->mesh[*which], &solver->mesh[to])) {
        sb_reynolds_carry(solver, *which, to);
        double scale = sb_layers_flux(&next.layers) / sb_layers_flux(&c.layers);
        SbReynoldsState *state = &solver->state[to];
        state->flux *= scale;
        for (int k = 0; k < solver->mesh[to].targets; k++) {
          state->gap[k] *= scale;
        }
      } else {
        sb_reynolds_resample(solver, *which, to);
      }
      SbReynoldsTrace trace;
      tried = sb_reynolds_newton(&trace, solver, to, &next, true, tolerance, problem);
      account(info, &trace);
    }
    if (tried == SB_ERROR_CANCELLED) {
      return tried;
    }
    if (tried == SB_OK) {
      *which = to;
      done = t;
      c = next;
      step *= 1.5;
    } else {
      step *= 0.4;
      if (step < 0.004 || i > STEPS_MAX) {
        return SB_ERROR_NOT_CONVERGED;
      }
    }
  }
  return status;
}

SbStatus sb_reynolds_solve(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                           SbFilmSolver *solver, SbReport *report) {
  double begin = seconds();
  SbReynoldsCase c = {0};
  c.layers = (SbLayers){.lambda = scale->lambda,
                        .inlet = scale->inlet,
                        .outlet = scale->outlet,
                        .starvation = 1.0,
                        .meniscus = -INFINITY,
                        .end = scale->outlet > 0.0 ? SB_LAYERS_FULL : SB_LAYERS_RUPTURE};
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
      status = cold_start(solver, which, &c, tolerance, info, problem);
      if (status == SB_ERROR_NOT_CONVERGED) {
        status = continuation(solver, &which, &c, tolerance, info, problem);
      }
    } else {
      int to = 1 - which;
      if (!sb_layers_mesh(&solver->mesh[to], &solver->tables, &c.layers)) {
        break;
      }
      sb_reynolds_carry(solver, which, to);
      which = to;
      SbReynoldsTrace trace;
      status = sb_reynolds_newton(&trace, solver, which, &c, true, tolerance, problem);
      account(info, &trace);
    }
    info->unknowns = (size_t)solver->mesh[which].dofs + 3;
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
  out->pressure_max = r->pressure_max * scale->pressure;
  out->position_film_min = sign * r->position_min * scale->half_width;
  out->position_rupture = sign * r->position_rupture * scale->half_width;
  out->ruptured = c.layers.end != SB_LAYERS_FULL;
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
  sb_reynolds_profile(out, solver, which, &c, scale, forward, 0.0);
  return sb_succeed(report);
}
