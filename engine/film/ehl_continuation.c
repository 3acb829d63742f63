// Continuation to a first solution of the coupled film problem.
//
// Directly from a guess; by continuation from an easier case, whose end pressures, options, speed
// and supply are moved to those wanted; with a cavity where the flooded outlet's pressure would
// fall below the rupture pressure (the film breaks, the cavity carries the same flux at the rupture
// pressure, and full film forms again where its pressure starts from there: Jakobsson, Floberg and
// Olsson's conditions in steady flow); with a meniscus where less film is supplied than the contact
// would take. Rough rows find cavity and meniscus themselves.
#include "engine/film/ehl.h"

#include <math.h>

// Number of Newton solves after which smooth rows end a flooded start, of all levels together, and
// after which they end a continuation path.
enum { STARTS_MAX = 24, STEPS_MAX = 38 };

// Pressure below the rupture pressure that counts as tension: less is the lowest degree's error in
// the far inlet.
static const double TENSION = -1e-6;

static bool lay_out(SbEhlSolution *s) {
  return s->c.rough.rows ? sb_ehl_rough_mesh(s) : sb_ehl_layers_mesh(s);
}

// Newton's method on the solution's mesh. Of smooth rows a meniscus with its supply, or the place
// where the film forms again, is moved until the film's pressure starts there from the one before
// it, by the pressure's slope.
static SbStatus iterate(SbEhlSolution *s) {
  enum { MOVES_MAX = 40, HALVINGS_MAX = 6 };
  SbFilmSolver *solver = s->solver;
  const SbEhlMesh *mesh = &s->mesh;
  SbEhlLayers *l = &s->c.layers;
  const bool rough = s->c.rough.rows, reform = l->end == SB_EHL_REFORM;
  double *place = reform ? &l->reform : &l->meniscus;
  int halvings = 0;
  for (int i = 0; i < MOVES_MAX; i++) {
    solver->info->continuation_steps++;
    SbStatus status = sb_ehl_newton(s);
    if (status != SB_OK || rough || !(reform || isfinite(s->c.supply))) {
      return status;
    }
    const SbEhlElement *e = &mesh->element[reform ? mesh->film_end + 1 : 0];
    double slope;
    double excess = sb_ehl_pressure(&slope, e, s->state.nodal, -1.0) - (reform ? 0.0 : l->inlet);
    if (fabs(excess) <= sb_ehl_tolerance(s)) {
      return SB_OK;
    }
    // A film cannot form again before it breaks; the inlet changes over its layer.
    double room = reform ? *place - mesh->element[mesh->film_end].x1
                         : fmax(fabs(1.0 + *place), sb_ehl_layers_width(l));
    room *= 0.5;
    double move = fmin(fmax(-excess / slope, -room), room);
    halvings = move <= -room ? halvings + 1 : 0;
    *place += move;
    // A cavity that goes on closing is none: the film of this case stays full.
    if ((reform && halvings > HALVINGS_MAX) || !lay_out(s)) {
      break;
    }
  }
  return SB_ERROR_NOT_CONVERGED;
}

// Cold start.
static SbStatus start_at(SbFilmSolver *solver, const SbEhlCase *c) {
  SbEhlSolution *s = solver->now;
  if (!c->rough.rows && solver->info->continuation_steps > STARTS_MAX) {
    return SB_ERROR_NOT_CONVERGED;
  }
  s->c = *c;
  if (c->layers.end == SB_EHL_REFORM) {
    s->c.layers.reform = sb_ehl_layers_reform(&c->layers);
  }
  if (!lay_out(s)) {
    return SB_ERROR_NOT_CONVERGED;
  }
  if (c->rough.rows) {
    sb_ehl_rough_guess(s);
    return iterate(s);
  }
  sb_ehl_layers_guess(s);
  SbStatus status = iterate(s);
  // The lowest degree has a false solution now and then where M is near 1: a film many times as
  // thick as the layers let expect, lost on finer meshes. Continuation does not meet it.
  if (status == SB_OK && s->state.flux > 8.0 * sb_ehl_layers_flux(&c->layers)) {
    status = SB_ERROR_NOT_CONVERGED;
  }
  return status;
}

// What the film of a case is expected to scale with; behind a cavity the outlet's pressure has no
// effect.
static double expected(const SbEhlCase *c) {
  SbEhlLayers layers = c->layers;
  layers.outlet = layers.end == SB_EHL_REFORM ? 0.0 : layers.outlet;
  bool starved = isfinite(c->supply) && c->supply > 0.0;
  return !(layers.lambda > 0.0) ? 1.0 : starved ? c->supply : sb_ehl_layers_flux(&layers);
}

// Continues from the last solution to a case near it; after a failure that solution remains.
static SbStatus take(SbFilmSolver *solver, const SbEhlCase *c) {
  const SbEhlSolution *from = solver->now;
  SbEhlSolution *to = sb_ehl_other(solver);
  to->c = *c;
  to->c.layers.reform = from->c.layers.reform;
  if (!lay_out(to)) {
    return c->rough.rows ? SB_ERROR_RANGE : SB_ERROR_NOT_CONVERGED; // no room for it
  }
  sb_ehl_carry(to, from, expected(c) / expected(&from->c));
  SbStatus status = iterate(to);
  if (status == SB_OK) {
    solver->now = to;
  }
  return status;
}

// Returns the case at the fraction t between a and b.
static SbEhlCase between(const SbEhlCase *a, const SbEhlCase *b, double t) {
  SbEhlCase c = *b;
  if (t >= 1.0) {
    return c;
  }
  c.fluid.barus = a->fluid.barus + t * (b->fluid.barus - a->fluid.barus);
  c.fluid.eyring = a->fluid.eyring + t * (b->fluid.eyring - a->fluid.eyring);
  c.layers.inlet = a->layers.inlet + t * (b->layers.inlet - a->layers.inlet);
  c.layers.outlet = a->layers.outlet + t * (b->layers.outlet - a->layers.outlet);
  if (a->layers.lambda != b->layers.lambda) {
    c.layers.lambda = a->layers.lambda * pow(b->layers.lambda / a->layers.lambda, t);
  }
  if (isfinite(b->supply) && a->supply != b->supply) {
    c.supply = a->supply * pow(b->supply / a->supply, t);
    c.layers.starvation =
        a->layers.starvation * pow(b->layers.starvation / a->layers.starvation, t);
  }
  return c;
}

// Continues from the last solution, which is that of `start`, to `target`, first by the fraction
// `step`; a successful step is followed by a longer one.
static SbStatus follow_path(SbFilmSolver *solver, const SbEhlCase *start, const SbEhlCase *target,
                            double step) {
  enum { EASY = 8 }; // Newton steps
  static const double GROWTH = 1.8, QUICK = 4.0;
  const double least = 1e-3 * step;
  double done = 0.0;
  for (int i = 0; done < 1.0; i++) {
    double t = fmin(1.0, done + step);
    SbEhlCase next = between(start, target, t);
    if (next.rough.rows && start->layers.lambda != target->layers.lambda) {
      sb_ehl_rough_flux(&next);
    }
    const int before = solver->info->newton_iterations;
    SbStatus status = take(solver, &next);
    if (status == SB_ERROR_CANCELLED) {
      return status;
    }
    done = status == SB_OK ? t : done;
    const bool easy = start->rough.rows && solver->info->newton_iterations - before <= EASY;
    step *= status != SB_OK ? 0.4 : easy ? QUICK : GROWTH;
    const bool spent =
        !start->rough.rows && solver->info->continuation_steps > STARTS_MAX && done < 1.0;
    if (step < least || i > STEPS_MAX || spent) {
      return SB_ERROR_NOT_CONVERGED;
    }
  }
  return SB_OK;
}

// The k-th case from which to come to `target`: itself, then such as are easier; false if there is
// none.
static bool easier(SbEhlCase *c, const SbEhlCase *target, int k) {
  static const double EASY_LAMBDA = 0.0093; // M = 20
  static const double EASY_PRESSURE = 0.3;
  enum { FASTER = 4 };
  *c = *target;
  if (k == 0) {
    return true;
  }
  if (target->rough.rows || target->body.compliance != NULL) {
    // Faster ones: other end pressures would move a fitted body's contact.
    c->layers.lambda *= pow(8.0, k);
    if (target->rough.rows) {
      sb_ehl_rough_flux(c);
    }
    return k < FASTER && target->layers.lambda > 0.0;
  }
  const bool reform = target->layers.end == SB_EHL_REFORM;
  if (reform) { // its own easier case first: at another speed there may be no cavity
    static const int ORDER[] = {0, 3, 1, 2, 4, 5};
    k = ORDER[k];
  }
  c->fluid.barus = c->fluid.eyring = 0.0;
  if (k == 1) { // small end pressures, no options and M = 20 if the film is thick
    c->layers.lambda = fmin(c->layers.lambda, EASY_LAMBDA);
    c->layers.inlet = fmin(c->layers.inlet, EASY_PRESSURE);
    c->layers.outlet = fmin(c->layers.outlet, EASY_PRESSURE);
  } else if (k == 2) { // no inlet pressure and no options at the same M, a longer cavity
    c->layers.inlet = 0.0;
    c->layers.outlet *= reform ? 0.25 : 1.0;
  } else if (reform) { // a small outlet pressure at the inlet's own
    c->layers.outlet *= k == 3 ? 0.25 : 0.05;
  } else { // an outlet pressure at which a thick film does not cavitate
    c->layers.outlet = fmax(2.2 + c->layers.inlet, c->layers.outlet);
  }
  return k < 3 + (target->layers.end == SB_EHL_FULL) + 2 * reform;
}

// The last solution, of rough rows, with elements at its film's ends if these are sharp.
static SbStatus follow_fronts(SbFilmSolver *solver) {
  SbEhlCase next = solver->now->c;
  if (!sb_ehl_rough_fronts(&next, solver->now)) {
    return SB_OK;
  }
  SbStatus status = take(solver, &next);
  return status == SB_ERROR_RANGE ? SB_OK : status; // no room for them
}

// Builds a mesh for a case whose film may have such sharp ends that no mesh has space for all of
// them: then fewer elements for each, and the change to the next level gives the error.
static bool lay_out_wider(SbEhlSolution *s, SbEhlCase *c) {
  enum { WIDENINGS = 6 };
  for (int i = 0; i <= WIDENINGS; i++) {
    s->c = *c;
    if (lay_out(s)) {
      return true;
    }
    for (int k = 0; k < SB_EHL_FRONTS; k++) {
      c->rough.front[k].width *= 3.0;
    }
  }
  return false;
}

// Rough rows from the contact at rest: in turns the film is marched over it, and the contact is
// sealed with that film's pressure, until Newton's method converges from a march, on elements at
// the ends of the film.
static SbStatus start_marched(SbFilmSolver *solver, const SbEhlCase *target) {
  enum { ROUNDS = 12, RESTS = 4 }; // at rest a contact may be closed beyond any flow
  const int rounds = target->layers.lambda > 0.0 ? ROUNDS : RESTS;
  SbEhlCase sealed = *target;
  sealed.rough.sealed = true;
  SbStatus status = start_at(solver, &sealed);
  for (int k = 0; k < rounds && status == SB_OK && sb_ehl_march(solver->now); k++) {
    if (!sb_ehl_march_fronts(&sealed, &solver->march) || k > 0) {
      SbEhlSolution *s = solver->now;
      sb_ehl_march_state(s, false);
      s->c.rough.sealed = false;
      status = iterate(s);
      status = status == SB_OK ? follow_fronts(solver) : status;
      if (status != SB_ERROR_NOT_CONVERGED) {
        return status;
      }
    }
    SbEhlSolution *next = sb_ehl_other(solver);
    next->state.shift = solver->now->state.shift;
    if (!lay_out_wider(next, &sealed)) {
      break;
    }
    sb_ehl_march_state(next, true);
    status = iterate(next);
    solver->now = next;
  }
  return status == SB_OK ? SB_ERROR_NOT_CONVERGED : status;
}

// Returns whether a cavity of rough rows fills again although the outlet's pressure is that of the
// cavity: a diverging gap that is wider than the flux film lets the pressure only rise, so no such
// film meets the outlet's pressure, but a coarse mesh has a false solution now and then.
static bool refills(const SbEhlSolution *s) {
  bool found = false;
  for (int i = 0; i + 1 < s->mesh.dofs && !(s->c.layers.outlet > 0); i++) {
    found = found || (s->state.cavity[i] && !s->state.cavity[i + 1]);
  }
  return found;
}

static SbStatus start_flooded(SbFilmSolver *solver, const SbEhlCase *target) {
  SbEhlCase start;
  SbStatus status = start_at(solver, target);
  if (target->rough.rows) {
    status = status == SB_OK && refills(solver->now) ? SB_ERROR_NOT_CONVERGED : status;
    status = status == SB_OK ? follow_fronts(solver) : status;
    if (status == SB_ERROR_NOT_CONVERGED && !target->rough.sealed && target->rough.law != NULL) {
      status = start_marched(solver, target);
    }
  }
  // If end pressures nearly open the outlet, the position of its minimum film is only known to a
  // width of its layer, which is more than the error that a start may have.
  static const double MOVED[] = {0.4, -0.4, 0.9, -0.9, 1.5}, FAR_APART = 2.2;
  const int moves = sizeof MOVED / sizeof MOVED[0];
  const bool apart = !target->rough.rows && target->layers.end == SB_EHL_FULL &&
                     target->layers.outlet - target->layers.inlet > FAR_APART;
  for (int k = 0; k < moves && apart && status == SB_ERROR_NOT_CONVERGED; k++) {
    start = *target;
    start.layers.moved = MOVED[k];
    status = start_at(solver, &start);
  }
  for (int k = 1; status == SB_ERROR_NOT_CONVERGED && easier(&start, target, k); k++) {
    status = start_at(solver, &start);
    if (status == SB_OK) {
      status = follow_path(solver, &start, target, 0.25);
    }
  }
  if (status == SB_ERROR_NOT_CONVERGED && target->rough.rows && !target->rough.sealed) {
    // Where asperities carry little of the load, the cavity of the first steps may be wrong in the
    // whole film, from which Newton's method does not return.
    start = *target;
    start.rough.cautious = true;
    status = start_at(solver, &start);
    status = status == SB_OK ? follow_fronts(solver) : status;
  }
  return status;
}

// Returns whether the liquid of a flooded outlet would tear.
static bool torn(const SbEhlSolution *s) {
  if (s->c.layers.end != SB_EHL_FULL || s->c.rough.rows) {
    return false;
  }
  SbEhlResults results;
  sb_ehl_results(&results, s);
  return results.pressure_min < TENSION;
}

// Draws the meniscus in from a flooded inlet until the contact takes no more than `supply`: by
// secants of the flux over the logarithm of its distance to the edge; last, the supply is given.
static SbStatus draw_meniscus(SbFilmSolver *solver, double supply, double full) {
  enum { MOVES_MAX = 80 };
  static const double FIRST = 30.0, FARTHEST = 1e5; // flooded layer widths
  const double close = 0.03 * (1.0 - supply / full) + 1e-5;
  const double width = sb_ehl_layers_width(&solver->now->c.layers);
  SbEhlCase c = solver->now->c;
  double x = log(FIRST), step = 0.0;
  double done = NAN, before = NAN; // the last place, and ln of the flux over the supply there
  for (int i = 0; i < MOVES_MAX && x < log(FARTHEST); i++) {
    c.layers.meniscus = -1.0 - exp(x) * width;
    SbStatus status = take(solver, &c);
    if (status == SB_ERROR_NOT_CONVERGED && fabs(step) > 0.005) {
      step *= 0.5;
      x = done + step;
      continue;
    }
    if (status != SB_OK) {
      return status;
    }
    SbEhlSolution *s = solver->now;
    double excess = log(s->state.flux / supply);
    bool settled = c.layers.starvation == supply / full; // near it the mesh is to stay
    if (settled && fabs(excess) < close) {
      s->c.supply = supply;
      return iterate(s);
    }
    c.layers.starvation =
        settled || excess < 0.18 ? supply / full : fmin(s->state.flux / full, 1.0);
    double rise = (excess - before) / (x - done);
    step = rise > 0.0 ? fmin(fmax(-excess / rise, -0.5), 1.1) : excess > 0.0 ? -0.5 : 1.1;
    before = excess;
    done = x;
    x += step;
  }
  // Farther away the supply is the flooded flux but for rounding.
  return x < log(FARTHEST) ? SB_ERROR_NOT_CONVERGED : SB_OK;
}

// Less film at the inlet than the contact would take. Rough rows find their meniscus themselves
// while the supply is lowered from the flooded one.
static SbStatus starve(SbFilmSolver *solver, double supply) {
  // So close to the flooded flux the meniscus is lost far away; the solve adds what it leaves to
  // its error.
  static const double NEARLY = 5e-5;
  SbEhlCase start = solver->now->c;
  if (!start.rough.rows) {
    double full = solver->now->state.flux;
    return supply >= (1.0 - NEARLY) * full ? SB_OK : draw_meniscus(solver, supply, full);
  }
  start.supply = solver->now->state.flow / start.layers.lambda;
  SbEhlCase end = start;
  end.supply = supply;
  end.layers.starvation = supply / start.supply;
  return supply >= (1.0 - NEARLY) * start.supply
             ? SB_OK
             : follow_path(solver, &start, &end, log(1.3) / -log(end.layers.starvation));
}

SbStatus sb_ehl_start(SbFilmSolver *solver, const SbEhlCase *c, double supply) {
  solver->now = &solver->solution[0];
  SbStatus status = start_flooded(solver, c);
  if (status == SB_ERROR_CANCELLED) {
    return status;
  }
  // A flooded outlet that would tear the liquid gets a cavity.
  bool full = c->layers.end == SB_EHL_FULL && !c->rough.rows;
  if (full && (status != SB_OK || torn(solver->now))) {
    SbEhlCase broken = *c;
    broken.layers.end = SB_EHL_REFORM;
    status = start_flooded(solver, &broken);
  }
  if (status == SB_OK && isfinite(supply)) {
    status =
        solver->now->c.layers.end == SB_EHL_REFORM ? SB_ERROR_INFEASIBLE : starve(solver, supply);
  }
  return status;
}

SbStatus sb_ehl_refine(SbFilmSolver *solver, int degree) {
  enum { WIDENINGS = 6 };
  SbEhlCase next = solver->now->c;
  next.layers.degree = degree;
  SbStatus status = take(solver, &next);
  // Ends so sharp that no mesh has space for all of them: fewer elements for each, and the change
  // gives the error.
  for (int i = 0; i < WIDENINGS && status == SB_ERROR_RANGE; i++) {
    for (int k = 0; k < SB_EHL_FRONTS; k++) {
      next.rough.front[k].width *= 3.0;
    }
    status = take(solver, &next);
  }
  return status;
}

SbStatus sb_ehl_follow(SbFilmSolver *solver, const SbEhlCase *c) {
  const SbEhlCase *old = &solver->now->c;
  // Far from the old case a cold start is as good.
  if (old->body.compliance != NULL || c->body.compliance != NULL ||
      isfinite(old->layers.meniscus) || old->layers.end != c->layers.end ||
      fabs(log(c->layers.lambda / old->layers.lambda)) > 1.5 ||
      fabs(c->layers.inlet - old->layers.inlet) > 0.2 ||
      fabs(c->layers.outlet - old->layers.outlet) > 0.2) {
    return SB_ERROR_NOT_CONVERGED;
  }
  SbEhlCase next = *c;
  next.layers.degree = old->layers.degree;
  SbStatus status = take(solver, &next);
  return status == SB_OK && torn(solver->now) ? SB_ERROR_NOT_CONVERGED : status;
}
