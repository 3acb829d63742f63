// Films near a solved one, on its mesh and with its factors.
//
// Newton's method with the matrix of the base's solution instead of each step's own. The error
// decreases by the relative difference of the cases in every step, so two or three steps are enough
// for a case that differs by a thousandth, each with a residual and a back-substitution only. The
// mesh is fixed in the scaled frame, which moves with the case: the discretisation error remains
// that of the base. Not available: changes of the mesh itself (a meniscus, a film that re-forms),
// and cases whose film ends differently.
#include "engine/film/ehl.h"

#include <math.h>
#include <string.h>

// Stores the last solution.
static void hold(SbFilmSolver *solver) {
  const SbEhlSolution *s = solver->now;
  solver->base.c = s->c;
  solver->base.state = s->state;
  solver->base.load_known = s->mesh.load_known;
  memcpy(solver->base.gap_known, s->mesh.gap_known, sizeof solver->base.gap_known);
  solver->base.held = true;
}

// Sets the solution back to the base.
static void take_back(SbFilmSolver *solver) {
  SbEhlSolution *s = solver->now;
  s->state = solver->base.state;
  s->mesh.load_known = solver->base.load_known;
  memcpy(s->mesh.gap_known, solver->base.gap_known, sizeof s->mesh.gap_known);
  s->mesh.inlet_pressure = solver->base.c.layers.inlet;
  s->mesh.outlet_pressure = solver->base.c.layers.outlet;
}

// Stores it with its factors, for a body with the compliance of `c`.
static SbStatus ready(SbFilmSolver *solver, const SbEhlCase *c) {
  SbEhlSolution *s = solver->now;
  if (solver->base.held) {
    take_back(solver);
    s->c = solver->base.c;
  } else {
    hold(solver);
  }
  if (s->c.body.compliance != NULL && c->body.compliance != NULL) {
    s->c.body.compliance = c->body.compliance; // the base's own was borrowed
  }
  SbStatus status = sb_ehl_factor(s);
  solver->base.ready = solver->base.solved = status == SB_OK;
  return status;
}

SbStatus sb_ehl_from_base(SbFilmSolver *solver, const SbEhlCase *c, SbFilmPlace place) {
  SbEhlSolution *s = solver->now;
  // Between asperities nodes of a film merely near change into the cavity, or out of it.
  const bool anew = place == SB_FILM_NEAR && c->rough.rows;
  SbStatus status = SB_OK;
  if (anew) {
    if (!solver->base.held) {
      hold(solver);
    }
  } else if (!solver->base.ready) {
    status = ready(solver, c);
  }
  const SbEhlCase *base = &solver->base.c;
  const bool moves = isfinite(base->supply) || isfinite(base->layers.meniscus) ||
                     base->layers.end == SB_EHL_REFORM || isfinite(c->supply);
  if (status != SB_OK || moves || c->layers.end != base->layers.end ||
      c->rough.rows != base->rough.rows ||
      (c->body.compliance == NULL) != (base->body.compliance == NULL)) {
    return SB_ERROR_NOT_CONVERGED;
  }
  // From the base, whatever was solved near it last.
  const SbEhlRough meshed = base->rough;
  take_back(solver);
  s->c = *c;
  s->c.layers.degree = base->layers.degree;
  s->c.rough.sealed = meshed.sealed;
  s->c.rough.coarse = meshed.coarse;
  memcpy(s->c.rough.front, meshed.front, sizeof meshed.front);
  sb_ehl_mesh_ends(&s->mesh, c->layers.inlet, c->layers.outlet);
  solver->base.in_use = !anew;
  solver->base.ready = solver->base.ready && !anew;
  status = sb_ehl_newton(s);
  solver->base.in_use = false;
  return status;
}
