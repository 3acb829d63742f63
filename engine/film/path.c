// Ways to a first solution of the coupled film problem, on the lowest degree.
//
// Directly from the layers' shapes; by continuation from a case with small end pressures and no
// options; with a cavity where the flooded outlet's pressure would fall below the rupture pressure
// (the film breaks, the cavity carries the same flux at the rupture pressure, and full film forms
// again where its pressure starts from there: Jakobsson, Floberg and Olsson's conditions in steady
// flow); with a meniscus where less film is supplied than the contact would take.
#include "engine/film/reynolds.h"

#include <math.h>

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

// Newton's method with its account.
static SbStatus iterate(SbFilmSolver *solver, int which, SbReynoldsCase *c, bool independent,
                        double tolerance, SbFilmSolverInfo *info, const SbFilmProblem *problem) {
  SbReynoldsTrace trace;
  SbStatus status = sb_reynolds_newton(&trace, solver, which, c, independent, tolerance, problem);
  account(info, &trace);
  return status;
}

static bool has_free_end(const SbReynoldsCase *c) {
  return c->layers.end == SB_LAYERS_REFORM || isfinite(c->layers.meniscus);
}

SbStatus sb_reynolds_refine(SbFilmSolver *solver, int *which, SbReynoldsCase *c, double tolerance,
                            SbFilmSolverInfo *info, const SbFilmProblem *problem) {
  int to = 1 - *which;
  if (!sb_layers_mesh(&solver->mesh[to], &solver->tables, &c->layers)) {
    return SB_ERROR_NOT_CONVERGED;
  }
  sb_reynolds_carry(solver, *which, to);
  *which = to;
  double flux = solver->state[to].flux;
  c->hold = has_free_end(c);
  SbStatus status = iterate(solver, to, c, true, tolerance, info, problem);
  if (status == SB_OK && c->hold) {
    c->hold = false;
    if (isfinite(c->layers.meniscus)) {
      solver->state[to].flux = flux; // supplied
    }
    status = iterate(solver, to, c, false, tolerance, info, problem);
  }
  return status;
}

// Least pressure at the collocation points.
static double least_pressure(SbFilmSolver *solver, int which, const SbReynoldsCase *c) {
  SbReynoldsReading reading;
  sb_reynolds_read(&reading, solver, which, c);
  return reading.pressure_min;
}

// Breaks the film and forms it again: from the solution with an empty outlet at the rupture
// pressure, the outlet's pressure is raised.
static SbStatus open_cavity(SbFilmSolver *solver, int *which, SbReynoldsCase *target,
                            double tolerance, SbFilmSolverInfo *info,
                            const SbFilmProblem *problem) {
  enum { STEPS_MAX = 40 };
  SbReynoldsCase c = *target;
  c.layers.end = SB_LAYERS_RUPTURE;
  c.layers.outlet = 0.0;
  SbStatus status = cold_start(solver, *which, &c, tolerance, info, problem);
  if (status == SB_ERROR_NOT_CONVERGED) {
    status = continuation(solver, which, &c, tolerance, info, problem);
  }
  if (status != SB_OK) {
    return status;
  }
  double flux = solver->state[*which].flux;
  double low = 0.0; // outlet pressure reached
  double step = target->layers.outlet;
  c.layers.end = SB_LAYERS_REFORM;
  for (int i = 0; low < target->layers.outlet; i++) {
    SbReynoldsCase next = c;
    next.layers.outlet = fmin(low + step, target->layers.outlet);
    int to = 1 - *which;
    bool first = low == 0.0;
    next.layers.reform = first ? sb_layers_reform(&next.layers, flux) : c.layers.reform;
    SbStatus tried = SB_ERROR_NOT_CONVERGED;
    if (sb_layers_mesh(&solver->mesh[to], &solver->tables, &next.layers)) {
      if (first) {
        sb_reynolds_resample(solver, *which, to);
        sb_layers_fill_reformed(solver->state[to].nodal, solver->state[to].gap, &solver->mesh[to],
                                &solver->tables, &next.layers, flux);
      } else {
        sb_reynolds_carry(solver, *which, to);
      }
      next.hold = true;
      tried = iterate(solver, to, &next, true, tolerance, info, problem);
      next.hold = false;
      if (tried == SB_OK) {
        tried = iterate(solver, to, &next, false, tolerance, info, problem);
      }
    }
    if (tried == SB_ERROR_CANCELLED) {
      return tried;
    }
    if (tried == SB_OK) {
      *which = to;
      low = next.layers.outlet;
      c = next;
      step *= 2.0;
    } else {
      step *= 0.4;
      if (i > STEPS_MAX || step < 1e-6 * target->layers.outlet) {
        return SB_ERROR_NOT_CONVERGED;
      }
    }
  }
  *target = c;
  return SB_OK;
}

// Draws the meniscus in until the contact takes no more than `flux`: the meniscus is held at a
// distance z (in layer widths), the flux it lets through is a rising function of -z.
static SbStatus starve(bool *flooded, SbFilmSolver *solver, int *which, SbReynoldsCase *target,
                       double flux, double tolerance, SbFilmSolverInfo *info,
                       const SbFilmProblem *problem) {
  enum { STEPS_MAX = 60 };
  static const double FAR = -30.0;
  double full = solver->state[*which].flux;
  *flooded = flux >= full;
  if (*flooded) {
    return SB_OK;
  }
  SbReynoldsCase c = *target;
  c.hold = true;
  double z = FAR;
  double step = 0.5;
  double reached = full;
  bool first = true;
  double z_above = FAR, z_below = INFINITY; // brackets by flux above and below the supply
  for (int i = 0; i < STEPS_MAX; i++) {
    SbReynoldsCase next = c;
    next.layers.starvation = fmin(1.0, fmax(reached, flux) / full);
    next.layers.meniscus = -1.0 + z * sb_layers_width(&next.layers);
    int to = 1 - *which;
    SbStatus tried = SB_ERROR_NOT_CONVERGED;
    if (sb_layers_mesh(&solver->mesh[to], &solver->tables, &next.layers)) {
      if (first || !same_elements(&solver->mesh[*which], &solver->mesh[to])) {
        sb_reynolds_resample(solver, *which, to);
      } else {
        sb_reynolds_carry(solver, *which, to);
      }
      tried = iterate(solver, to, &next, true, tolerance, info, problem);
    }
    if (tried == SB_ERROR_CANCELLED) {
      return tried;
    }
    if (tried == SB_OK) {
      *which = to;
      c = next;
      first = false;
      reached = solver->state[to].flux;
      if (reached > flux) {
        z_above = z;
      } else {
        z_below = z;
      }
      if (fabs(reached / flux - 1.0) < 0.05) {
        break;
      }
    } else {
      step *= 0.5;
      if (step < 1e-3) {
        return SB_ERROR_NOT_CONVERGED;
      }
    }
    // Next distance: nearer by a factor until bracketed, then halved.
    z = isfinite(z_below) ? 0.5 * (z_above + z_below)
                          : (z_above < -0.5 ? z_above * (1.0 - step) : z_above + 0.5 * step);
  }
  // Now the supply is given and the meniscus free.
  c.hold = false;
  solver->state[*which].flux = flux;
  SbStatus status = iterate(solver, *which, &c, false, tolerance, info, problem);
  *target = c;
  return status;
}

SbStatus sb_reynolds_start(bool *flooded, SbFilmSolver *solver, int *which, SbReynoldsCase *c,
                           double flux, double tolerance, SbFilmSolverInfo *info,
                           const SbFilmProblem *problem) {
  *flooded = true;
  SbStatus status = cold_start(solver, *which, c, tolerance, info, problem);
  if (status == SB_ERROR_NOT_CONVERGED) {
    status = continuation(solver, which, c, tolerance, info, problem);
  }
  if (status == SB_ERROR_CANCELLED) {
    return status;
  }
  // A flooded outlet that would tear the liquid gets a cavity.
  if (c->layers.end == SB_LAYERS_FULL &&
      (status != SB_OK || least_pressure(solver, *which, c) < -1e-9)) {
    status = open_cavity(solver, which, c, tolerance, info, problem);
  }
  if (status == SB_OK && isfinite(flux)) {
    status = c->layers.end == SB_LAYERS_REFORM
                 ? SB_ERROR_INFEASIBLE
                 : starve(flooded, solver, which, c, flux, tolerance, info, problem);
  }
  return status;
}
