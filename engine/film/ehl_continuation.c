// Continuation to a first solution of the coupled film problem, on the lowest degree.
//
// Directly from the layers' shapes; by continuation from a case with small end pressures and no
// options; with a cavity where the flooded outlet's pressure would fall below the rupture pressure
// (the film breaks, the cavity carries the same flux at the rupture pressure, and full film forms
// again where its pressure starts from there: Jakobsson, Floberg and Olsson's conditions in steady
// flow); with a meniscus where less film is supplied than the contact would take.
#include "engine/film/ehl.h"

#include <math.h>

// Pressure below the rupture pressure that counts as tension: less is the lowest degree's error in
// the far inlet.
static const double TENSION = -1e-6;

SbStatus sb_ehl_iterate(SbFilmSolver *solver, int which, SbEhlCase *c, bool independent,
                        const SbEhlRun *run) {
  SbEhlTrace trace;
  SbStatus status = c->rough.rows ? sb_ehl_rough_newton(&trace, solver, which, c, run->problem)
                                  : sb_ehl_newton(&trace, solver, which, c, independent,
                                                  run->tolerance, run->problem);
  run->info->newton_iterations += trace.iterations;
  run->info->continuation_steps++;
  run->info->residual = trace.residual;
  return status;
}

static bool has_free_end(const SbEhlCase *c) {
  return c->layers.end == SB_EHL_REFORM || isfinite(c->layers.meniscus);
}

// From a guess of pressure and gap, moving a free end last.
static SbStatus iterate_held(SbFilmSolver *solver, int which, SbEhlCase *c, const SbEhlRun *run) {
  double flux = solver->state[which].flux;
  c->hold = has_free_end(c);
  SbStatus status = sb_ehl_iterate(solver, which, c, true, run);
  if (status == SB_OK && c->hold) {
    c->hold = false;
    if (isfinite(c->layers.meniscus)) {
      solver->state[which].flux = flux; // supplied
    }
    status = sb_ehl_iterate(solver, which, c, false, run);
  }
  c->hold = false;
  return status;
}

// Mesh and first guess.
static SbStatus guess(SbFilmSolver *solver, int which, SbEhlCase *c) {
  SbEhlState *state = &solver->state[which];
  if (!sb_ehl_layers_mesh(&solver->mesh[which], &solver->tables, &c->layers)) {
    return SB_ERROR_NOT_CONVERGED;
  }
  state->H0 = 0.0;
  sb_ehl_layers_guess(state->nodal, state->gap, &state->shift, &state->flux, &solver->mesh[which],
                      &solver->tables, &c->layers);
  return SB_OK;
}

// Cold start on the lowest degree.
static SbStatus cold_start(SbFilmSolver *solver, int which, SbEhlCase *c, const SbEhlRun *run) {
  const SbEhlState *state = &solver->state[which];
  SbStatus status = guess(solver, which, c);
  status = status == SB_OK ? sb_ehl_iterate(solver, which, c, true, run) : status;
  // The lowest degree has a false solution now and then where M is near 1: a film many times as
  // thick as the layers let expect, lost on finer meshes. Continuation does not meet it.
  if (status == SB_OK && state->flux > 8.0 * sb_ehl_layers_flux(&c->layers)) {
    status = SB_ERROR_NOT_CONVERGED;
  }
  return status;
}

// Asks for as many elements as a mesh has.
static void keep_steps(SbEhlLayers *layers, const SbEhlMesh *mesh) {
  layers->steps[0] = mesh->steps[0];
  layers->steps[1] = mesh->steps[1];
}

// Carries a solution to another case: the film scales with the flux that the layers let expect.
static void carry_scaled(SbFilmSolver *solver, int from, int to, const SbEhlCase *old,
                         const SbEhlCase *new) {
  double scale = sb_ehl_layers_flux(&new->layers) / sb_ehl_layers_flux(&old->layers);
  sb_ehl_carry(solver, from, to, &old->layers, &new->layers, scale);
}

// Homotopies to a case: from small end pressures, no options and M = 20 if the film is thick, or
// from no inlet pressure and no options at the same M, or from an outlet pressure that keeps a
// thick film full.
typedef enum { FROM_THIN, FROM_SAME, FROM_FULL, HOMOTOPIES } Homotopy;

// The case a fraction t of a homotopy.
static SbEhlCase between(const SbEhlCase *target, Homotopy homotopy, double t) {
  static const double EASY_LAMBDA = 0.0093; // M = 20
  static const double EASY_PRESSURE = 0.3;
  SbEhlCase c = *target;
  c.fluid.barus *= t;
  c.fluid.eyring *= t;
  if (homotopy == FROM_SAME) {
    c.layers.inlet *= t;
    return c;
  }
  if (homotopy == FROM_FULL) {
    c.layers.outlet += (1.0 - t) * fmax(2.2 + c.layers.inlet - c.layers.outlet, 0.0);
    return c;
  }
  if (c.layers.lambda > EASY_LAMBDA) {
    c.layers.lambda = EASY_LAMBDA * pow(c.layers.lambda / EASY_LAMBDA, t);
  }
  double inlet = fmin(c.layers.inlet, EASY_PRESSURE);
  double outlet = fmin(c.layers.outlet, EASY_PRESSURE);
  c.layers.inlet = inlet + t * (c.layers.inlet - inlet);
  c.layers.outlet = outlet + t * (c.layers.outlet - outlet);
  return c;
}

// Reaches the case on the lowest degree by continuation; the layers carry the last solution along.
// Ends in mesh/state *which.
static SbStatus follow_homotopy(SbFilmSolver *solver, int *which, const SbEhlCase *target,
                                Homotopy homotopy, const SbEhlRun *run) {
  enum { STEPS_MAX = 60 };
  SbEhlCase c = between(target, homotopy, 0.0);
  SbStatus status = cold_start(solver, *which, &c, run);
  double done = 0.0;
  double step = 0.25;
  for (int i = 0; status == SB_OK && done < 1.0; i++) {
    double t = fmin(1.0, done + step);
    SbEhlCase next = between(target, homotopy, t);
    int to = 1 - *which;
    SbStatus tried = SB_ERROR_NOT_CONVERGED;
    // As many elements as before, if they fit, so that the layers carry the solution along.
    keep_steps(&next.layers, &solver->mesh[*which]);
    bool fits = sb_ehl_layers_mesh(&solver->mesh[to], &solver->tables, &next.layers);
    if (!fits) {
      next.layers.steps[0] = next.layers.steps[1] = -1;
      fits = sb_ehl_layers_mesh(&solver->mesh[to], &solver->tables, &next.layers);
    }
    if (fits) {
      carry_scaled(solver, *which, to, &c, &next);
      tried = sb_ehl_iterate(solver, to, &next, true, run);
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

static SbStatus continuation(SbFilmSolver *solver, int *which, const SbEhlCase *target,
                             const SbEhlRun *run) {
  SbStatus status = SB_ERROR_NOT_CONVERGED;
  for (int homotopy = 0; homotopy < HOMOTOPIES && status == SB_ERROR_NOT_CONVERGED; homotopy++) {
    if (homotopy == FROM_FULL && target->layers.end != SB_EHL_FULL) {
      break;
    }
    status = follow_homotopy(solver, which, target, (Homotopy)homotopy, run);
  }
  return status;
}

// Least pressure at the collocation points.
static double least_pressure(SbFilmSolver *solver, int which, const SbEhlCase *c) {
  SbEhlResults results;
  sb_ehl_results(&results, solver, which, c);
  return results.pressure_min;
}

SbStatus sb_ehl_refine(SbFilmSolver *solver, int *which, SbEhlCase *c, int degree,
                       const SbEhlRun *run) {
  SbEhlCase next = *c;
  next.layers.degree = degree;
  int to = 1 - *which;
  // The elements that the solution has, which a continuation may have brought from another case.
  keep_steps(&next.layers, &solver->mesh[*which]);
  if (!sb_ehl_layers_mesh(&solver->mesh[to], &solver->tables, &next.layers) ||
      !sb_ehl_same_elements(&solver->mesh[*which], &solver->mesh[to])) {
    return SB_ERROR_NOT_CONVERGED;
  }
  sb_ehl_carry(solver, *which, to, &c->layers, &next.layers, 1.0);
  SbStatus status = iterate_held(solver, to, &next, run);
  if (status == SB_OK) {
    *which = to;
    *c = next;
  }
  return status;
}

SbStatus sb_ehl_follow(SbFilmSolver *solver, int *which, const SbEhlCase *old, const SbEhlCase *c,
                       const SbEhlRun *run) {
  // Far from the old case a cold start is as good.
  if (old->body.compliance != NULL || c->body.compliance != NULL || has_free_end(old) ||
      has_free_end(c) || old->layers.end != c->layers.end ||
      fabs(log(c->layers.lambda / old->layers.lambda)) > 1.5 ||
      fabs(c->layers.inlet - old->layers.inlet) > 0.2 ||
      fabs(c->layers.outlet - old->layers.outlet) > 0.2) {
    return SB_ERROR_NOT_CONVERGED;
  }
  int to = 1 - *which;
  // The old number of elements, so that the layers carry the solution along.
  SbEhlCase next = *c;
  keep_steps(&next.layers, &solver->mesh[*which]);
  if (!sb_ehl_layers_mesh(&solver->mesh[to], &solver->tables, &next.layers)) {
    return SB_ERROR_NOT_CONVERGED;
  }
  carry_scaled(solver, *which, to, old, c);
  SbStatus status = sb_ehl_iterate(solver, to, &next, true, run);
  if (status == SB_OK && c->layers.end == SB_EHL_FULL && least_pressure(solver, to, c) < TENSION) {
    status = SB_ERROR_NOT_CONVERGED; // a cavity opens: start anew
  }
  if (status == SB_OK) {
    *which = to;
  }
  return status;
}

// Breaks the film and forms it again: from the solution with an empty outlet at the rupture
// pressure, the outlet's pressure is raised.
static SbStatus open_cavity(SbFilmSolver *solver, int *which, SbEhlCase *target,
                            const SbEhlRun *run) {
  enum { STEPS_MAX = 40 };
  SbEhlCase c = *target;
  c.layers.end = SB_EHL_REFORM;
  if (sb_ehl_layers_wedge(&c.layers) > 0.0) {
    c.layers.reform = sb_ehl_layers_reform(&c.layers, 0.0);
    SbStatus status = guess(solver, *which, &c);
    status = status == SB_OK ? iterate_held(solver, *which, &c, run) : status;
    if (status != SB_ERROR_NOT_CONVERGED) {
      *target = status == SB_OK ? c : *target;
      return status;
    }
  }
  c.layers.end = SB_EHL_RUPTURE;
  c.layers.outlet = 0.0;
  SbStatus status = cold_start(solver, *which, &c, run);
  if (status == SB_ERROR_NOT_CONVERGED) {
    status = continuation(solver, which, &c, run);
  }
  if (status != SB_OK) {
    return status;
  }
  double flux = solver->state[*which].flux;
  double low = 0.0; // outlet pressure reached
  double step = target->layers.outlet;
  c.layers.end = SB_EHL_REFORM;
  for (int i = 0; low < target->layers.outlet; i++) {
    SbEhlCase next = c;
    next.layers.outlet = fmin(low + step, target->layers.outlet);
    int to = 1 - *which;
    bool first = low == 0.0;
    next.layers.reform = first ? sb_ehl_layers_reform(&next.layers, flux) : c.layers.reform;
    SbStatus tried = SB_ERROR_NOT_CONVERGED;
    if (sb_ehl_layers_mesh(&solver->mesh[to], &solver->tables, &next.layers)) {
      sb_ehl_carry(solver, *which, to, &c.layers, &next.layers, 1.0);
      if (first) {
        sb_ehl_layers_fill_reformed(solver->state[to].nodal, solver->state[to].gap,
                                    &solver->mesh[to], &solver->tables, &next.layers, flux);
      }
      tried = iterate_held(solver, to, &next, run);
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

// One solution with the meniscus held `distance` flooded layer widths before the edge; the mesh is
// laid out for the flux `expected`. Ends in mesh/state *which.
static SbStatus hold_meniscus(SbFilmSolver *solver, int *which, SbEhlCase *c,
                              const SbEhlCase *flooded, double distance, double ratio,
                              const SbEhlRun *run) {
  SbEhlCase next = *flooded;
  next.hold = true;
  next.layers.meniscus = -1.0 - distance * sb_ehl_layers_width(&flooded->layers);
  next.layers.starvation = fmin(ratio, 1.0);
  int to = 1 - *which;
  if (!sb_ehl_layers_mesh(&solver->mesh[to], &solver->tables, &next.layers)) {
    return SB_ERROR_NOT_CONVERGED;
  }
  sb_ehl_carry(solver, *which, to, &c->layers, &next.layers, 1.0);
  SbStatus status = sb_ehl_iterate(solver, to, &next, true, run);
  if (status == SB_OK) {
    *which = to;
    *c = next;
  }
  return status;
}

// Draws the meniscus in until the contact takes no more than `flux`: by steps of its distance d to
// the edge until the supply is bracketed, then by secants of ln flux over ln d; last, the supply is
// given and the meniscus free.
static SbStatus starve(bool *flooded, SbFilmSolver *solver, int *which, SbEhlCase *target,
                       double flux, const SbEhlRun *run) {
  enum { STEPS_MAX = 80 };
  // So close to the flooded flux the meniscus is lost far away; the solve adds what it leaves to
  // its error.
  static const double NEARLY = 5e-5;
  double full = solver->state[*which].flux;
  *flooded = flux >= (1.0 - NEARLY) * full;
  if (*flooded) {
    return SB_OK;
  }
  double close = 0.03 * (1.0 - flux / full) + 1e-5;
  double far_d = INFINITY, far_flux = full; // flux above the supply
  double near_d = 0.0, near_flux = 0.0;     // flux below it
  double d = 30.0;
  double growth = 0.6;
  double ratio = 1.0; // for which the mesh is laid out
  bool settled = false;
  SbEhlCase c = *target;
  for (int i = 0;; i++) {
    if (i >= STEPS_MAX) {
      return SB_ERROR_NOT_CONVERGED;
    }
    SbStatus status = hold_meniscus(solver, which, &c, target, d, ratio, run);
    if (status == SB_ERROR_CANCELLED) {
      return status;
    }
    if (status == SB_OK) {
      double reached = solver->state[*which].flux;
      if (!settled && reached <= 1.2 * flux) {
        // Near the supply the mesh is laid out for it, once, and the bracket starts anew.
        settled = true;
        ratio = flux / full;
        far_d = INFINITY;
        near_d = 0.0;
        continue;
      }
      if (settled && fabs(reached / flux - 1.0) < close) {
        break;
      }
      ratio = settled ? ratio : reached / full;
      if (reached > flux) {
        far_d = d;
        far_flux = reached;
      } else {
        near_d = d;
        near_flux = reached;
      }
    } else {
      growth = sqrt(growth);
      if (growth > 0.995) {
        return status;
      }
    }
    if (isfinite(far_d) && near_d > 0.0 && status == SB_OK) {
      // Secant kept inside the middle of the bracket.
      double t = log(flux / near_flux) / log(far_flux / near_flux);
      d = near_d * pow(far_d / near_d, fmin(fmax(t, 0.1), 0.9));
    } else if (isfinite(far_d)) {
      d = fmax(far_d * growth, near_d > 0.0 ? sqrt(far_d * near_d) : 0.0);
    } else {
      d *= near_d > 0.0 ? 1.3 : 3.0;
      if (d > 1e5) {
        *flooded = true; // the supply is the flooded flux but for rounding
        return SB_OK;
      }
    }
  }
  c.hold = false;
  solver->state[*which].flux = flux;
  SbStatus status = sb_ehl_iterate(solver, *which, &c, false, run);
  *target = c;
  return status;
}

SbStatus sb_ehl_start(bool *flooded, SbFilmSolver *solver, int *which, SbEhlCase *c, double flux,
                      const SbEhlRun *run) {
  *flooded = true;
  SbStatus status = cold_start(solver, *which, c, run);
  if (status == SB_ERROR_NOT_CONVERGED) {
    status = continuation(solver, which, c, run);
  }
  if (status == SB_ERROR_CANCELLED) {
    return status;
  }
  // A flooded outlet that would tear the liquid gets a cavity.
  if (c->layers.end == SB_EHL_FULL &&
      (status != SB_OK || least_pressure(solver, *which, c) < TENSION)) {
    status = open_cavity(solver, which, c, run);
  }
  if (status == SB_OK && isfinite(flux)) {
    status = c->layers.end == SB_EHL_REFORM ? SB_ERROR_INFEASIBLE
                                            : starve(flooded, solver, which, c, flux, run);
  }
  return status;
}
