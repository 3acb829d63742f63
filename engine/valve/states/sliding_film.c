// The film of a seal's sliding state: on the fitted body or the half-plane, alone or next to the
// last one, with unlimited liquid or with the layer on the bore; see sliding.h.
//
// If the fit model gives a pressure of its own, the film is solved on that body: its edges, its
// pressure, its compliance; the film on the half-plane is solved in addition. The film's load is
// the net one: the fluid on either side carries its own step, so a contact from l to r under the
// total load W leaves W - p_left (0 - l) - p_right (r - 0) to the film (docs/results.md,
// Definitions). Not modelled: without coupling, asperities do not reduce the load of the film (they
// carry 1 to 14 % of it at the minimum film, docs/thesis.md, 10); the closed forms have no inlet
// starvation.
#include "engine/valve/states/sliding_private.h"

#include <math.h>

// Solves a film once and counts it. If it is not found next to another film, the caller solves it
// alone.
static SbStatus solve_once(const SbSlidingTask *task, SbFilm *film, const SbFilmProblem *problem,
                           SbFilmSolver *solver, SbReport *report) {
  SbStatus status = sb_film_solve(film, problem, solver, report);
  if (sb_film_kind(problem->model)->coupled) {
    const bool found = status == SB_OK || problem->place == SB_FILM_ALONE;
    task->counts->reynolds_solves += found ? 1 : 0;
    task->counts->newton_iterations += (size_t)film->solver.newton_iterations;
  }
  return status;
}

// Returns the speed above which a starved film is that of any higher speed; infinite if there is
// none. If a flooded film would be several times as thick, the supply alone determines the film:
// the flow is given, and the film is twice the layer, except for the flow due to pressure, which
// decreases with speed (2e-4 of it at four times).
static double starved_speed(SbFilm *film, const SbFilmProblem *problem) {
  enum { ROUNDS = 4 };
  static const double TIMES = 4, POWER = 0.6; // of a flooded film over the speed, nearly
  SbFilmProblem law = *problem;
  law.model = SB_FILM_THESIS;
  law.surface = SB_ROUGH_NONE;
  law.compliance = NULL;
  law.profile = NULL;
  law.inlet_film = 0;
  law.speed = fabs(problem->speed);
  for (int round = 0; round < ROUNDS; round++) {
    if (!(problem->inlet_film > 0) || sb_film_solve(film, &law, NULL, NULL) != SB_OK) {
      return INFINITY;
    }
    law.speed *= pow(TIMES * 2 * problem->inlet_film / film->film_central, 1 / POWER);
  }
  return law.speed;
}

// Solves a film; with a limited supply at the sufficient fraction of its speed, or lower if the
// solver fails there. The deviation from twice the layer is added to its error; the constriction at
// the outlet converges to that too, but more slowly: half of its deviation.
static SbStatus solve_supplied(const SbSlidingTask *task, SbSlidingSolved *out,
                               SbFilmProblem *problem, SbFilmSolver *solver, SbReport *report) {
  static const double STEP = 0.5, LEAST = 1e-3;
  SbFilm *film = &out->film;
  const double speed = problem->speed, first = fmin(starved_speed(film, problem) / fabs(speed), 1);
  double share = first;
  problem->speed = share * speed;
  SbStatus status = solve_once(task, film, problem, solver, report);
  if (status == SB_OK && share < 1 && !film->starved) { // the law is far off
    share = 1;
    problem->speed = speed;
    status = solve_once(task, film, problem, solver, report);
  }
  bool flooded = false; // at this speed, and at any lower one
  while (status == SB_ERROR_NOT_CONVERGED && problem->inlet_film > 0 && share > LEAST * first &&
         !flooded) {
    SbReport own = {0};
    share *= STEP;
    problem->speed = share * speed;
    status = solve_once(task, film, problem, solver, &own);
    flooded = status == SB_OK && !film->starved;
    status = flooded ? SB_ERROR_NOT_CONVERGED : status;
  }
  problem->speed = speed;
  out->share = share;
  if (share == 1 || status != SB_OK) {
    return status;
  }
  film->flow /= share;
  film->friction_couette /= share;
  film->friction_cavity /= share;
  const double end = 2 * problem->inlet_film, error = fabs(film->film_central / end - 1);
  film->solver.error_film_min += 0.5 * fabs(film->film_min / end - 1);
  film->solver.error_film_central += error;
  film->solver.error_contact += problem->surface != SB_ROUGH_NONE ? error : 0;
  if (error > task->model->tolerance) {
    sb_warn(&film->warnings, "film-starved", sb_input(SB_P_MODELS_INLET),
            "the bore supplies so little that the film at %.3g mm/s is used for %.3g mm/s",
            1e3 * fabs(share * speed), 1e3 * fabs(speed));
  }
  return sb_succeed(report);
}

// Properties of a film that decide whether another one may be solved next to it.
static SbSlidingBase base_of(const SbFilmProblem *problem) {
  const bool right = problem->speed > 0; // the bore moves to the right, and the fluid with it
  return (SbSlidingBase){.known = true,
                         .fitted = problem->compliance != NULL,
                         .inlet = right ? problem->pressure_left : problem->pressure_right,
                         .outlet = right ? problem->pressure_right : problem->pressure_left,
                         .speed = fabs(problem->speed),
                         .load = problem->load};
}

static bool is_within(double a, double b, double times) {
  return a < times * b && b < times * a;
}

// Returns whether a film is close to the one that the solver solved last. It is then solved on that
// film's mesh in a tenth of the time, with that film's error. A film in the opposite direction on
// the mirror image of a body is equivalent.
static bool is_near(const SbSlidingMemory *memory, const SbSlidingSolved *out,
                    const SbFilmProblem *problem) {
  static const double SPEED = 1.25, LOAD = 1.03;
  const SbSlidingBase *base = &memory->base, is = base_of(problem);
  return memory->near && base->known && out != &memory->rest && is.fitted == base->fitted &&
         is.inlet == base->inlet && is.outlet == base->outlet &&
         is_within(is.speed, base->speed, SPEED) && is_within(is.load, base->load, LOAD);
}

SbStatus sb_sliding_solve_on(const SbSlidingTask *task, SbSlidingSolved *out,
                             const SbFilmProblem *problem, SbReport *report) {
  SbSlidingMemory *memory = task->memory;
  bool solved = sb_film_kind(problem->model)->coupled;
  out->speed = problem->speed;
  out->fresh = true;
  if (sb_sliding_film_summed(memory, out, problem->compliance != NULL)) {
    sb_sliding_copy_film(out, memory);
    return sb_succeed(report);
  }
  SbFilmSolver **const usual = out == &memory->rest ? &memory->rest_solver : &memory->solver;
  SbFilmSolver **solver = out->own != NULL && !out->on_base ? out->own : usual;
  if (solved && *solver == NULL) {
    SbStatus status = sb_film_solver_create(solver, report);
    if (status != SB_OK) {
      return status;
    }
  }
  SbFilmProblem lent = *problem;
  lent.profile = &out->profile;
  lent.cancelled = memory->cancelled;
  lent.cancelled_data = memory->cancelled_data;
  out->fitted = problem->compliance != NULL;
  // Films with adhesion or a limited supply take several solves.
  const bool plain = !(lent.hamaker > 0 || lent.work_of_adhesion > 0);
  const bool next = out->on_base && *out->own != NULL && !(lent.inlet_film > 0);
  const bool near = out->own == NULL && is_near(memory, out, problem);
  if (solved && plain && (next || near)) {
    SbFilmProblem beside = lent;
    beside.place = next ? SB_FILM_BESIDE : SB_FILM_NEAR;
    beside.profile = near ? lent.profile : NULL;
    SbStatus status =
        solve_once(task, &out->film, &beside, next ? *out->own : memory->solver, report);
    if (status != SB_ERROR_NOT_CONVERGED) {
      out->share = 1;
      return status;
    }
  }
  SbStatus status = solve_supplied(task, out, &lent, *solver, report);
  if (solved && solver == &memory->solver) {
    const bool stands = status == SB_OK && plain && !out->film.starved && out->share == 1;
    memory->base = base_of(problem);
    memory->base.known = stands;
  }
  return status;
}

static void lay_on(SbFilmProblem *problem, const SbSlidingBody *body) {
  problem->compliance = &body->compliance;
  problem->load = body->load;
  problem->modulus = body->compliance.modulus;
}

// Error below which a film on the fitted body is still more accurate than the half-plane's, and
// that of a figure that is unknown (docs/results.md, Error estimates).
static const double NEARER = 0.05, UNKNOWN = 1;

// Accepts a film that stopped above the tolerance if its error is known to be below `most`: then it
// is a result, whose error is reported with every figure that it feeds.
static SbStatus accept(const SbSlidingTask *task, const SbSlidingSolved *solved, SbStatus status,
                       double most, SbReport *report) {
  static const double SOLVED = 1e-6; // of the residual
  const SbFilm *film = &solved->film;
  const SbFilmSolverInfo *info = &film->solver;
  const double error = fmax(info->error_film_min, info->error_film_central);
  if (status != SB_ERROR_NOT_CONVERGED || !(film->film_central > 0) ||
      !(error > 0 && fmax(error, info->error_contact) < most) || !(info->residual < SOLVED) ||
      solved->share != 1) {
    return status;
  }
  sb_warn(task->warnings, "film-tolerance", sb_input(SB_P_OUTPUT_TOLERANCE),
          "the film %s %s seal is known to %.2g only, not to %.2g",
          solved->fitted ? "on the fitted" : "of the", sb_seal_name(task->seal), error,
          task->model->tolerance);
  return sb_succeed(report);
}

// The film on the fitted body in place of the half-plane's; false where there is none or it fails,
// then with a reason in `why`, of a body that has one.
static bool solve_fitted(const SbSlidingTask *task, SbSlidingSolved *out,
                         const SbFilmProblem *plane, SbReport *why) {
  *why = (SbReport){0};
  const SbFit *fit = &task->memory->now->fit;
  if (!sb_fit_kind(fit->model)->body) {
    return false;
  }
  SbSlidingBody *body = &task->memory->body;
  SbFilmProblem problem = *plane;
  SbStatus status = SB_OK;
  if (sb_sliding_film_summed(task->memory, out, true)) {
    *body = task->memory->sum.body;
  } else if (sb_sliding_film_summed(task->memory, out, false)) {
    return false;
  } else {
    status = sb_sliding_surface(&body->compliance, &body->load, fit, task->model, task->seal,
                                task->pressure, task->warnings, why);
  }
  if (status == SB_OK) {
    lay_on(&problem, body);
    status = sb_sliding_solve_on(task, out, &problem, why);
    status = accept(task, out, status, NEARER, why);
  }
  return status == SB_OK;
}

// Reports that a film is that of the half-plane, and why; not if the fluid opens the contact.
static void tell_half_plane(const SbSlidingTask *task, SbStatus status, const SbReport *why) {
  if (sb_sliding_usable(status) && why->text[0] != '\0') {
    sb_warn(task->warnings, "film-half-plane", sb_input(SB_P_MODELS_FIT),
            "no film on the fitted %s seal (%s): it is the half-plane's", sb_seal_name(task->seal),
            why->text);
  }
}

double sb_sliding_surface_error(const SbSealState *state, const SbSlidingSolved *solved,
                                const SbFit *fit) {
  if (!solved->fitted) { // on the half-plane: that of its load
    return SB_FILM_LAW_LOAD_POWER * state->net_error;
  }
  const double inlet = state->peak_error + 0.5 * state->width_error;
  if (!sb_fit_kind(fit->model)->section) {
    // A thin film is proportional to the power -0.8 of the coefficient of the pressure's root at
    // its inlet, which is proportional to peak/sqrt(width). That of a disc, whose pressure is
    // tabulated, has an error of up to 20 times their relative errors (campaign estimates).
    return 0.8 * 10 * inlet;
  }
  // A thin film is proportional to the power -0.8 of the coefficient of the pressure's root at
  // its inlet, which is proportional to peak/sqrt(width) but depends on few nodes of the ring's
  // mesh: its error is up to five times their relative errors. An estimate is a third of that.
  const double ring = 0.8 * 5 / 3 * inlet;
  // A dragged one's scatters by up to 7 % between the meshes and path tolerances tried (by 0.3 to
  // 0.8 % rms over the radial space of piston.scene): a third of that.
  static const double DRAGGED = 0.0233;
  return fit->ring.drag != 0 ? fmax(ring, DRAGGED) : ring;
}

void sb_sliding_film_errors(SbSealState *out, const SbSlidingSolved *solved, const SbFit *fit) {
  const SbFilmSolverInfo *solver = &solved->film.solver;
  const double surface = sb_sliding_surface_error(out, solved, fit);
  out->central_error = solver->error_film_central + surface;
  out->film_error = fmax(solver->error_film_min + surface, out->central_error);
}

// A seal's film figures are those of `solved`; NaN stays where the solver stopped before its first
// solution (false).
bool sb_sliding_read_film(SbSealState *out, const SbSlidingSolved *solved, SbStatus status,
                          const SbFit *fit) {
  const SbFilm *film = &solved->film;
  if (status != SB_OK && !(film->film_central > 0)) {
    return false;
  }
  out->film_fitted = solved->fitted;
  out->layer = film->flow > 0 || film->flow < 0 ? fabs(film->flow / solved->speed) : 0;
  out->film_min = film->film_min;
  out->film_central = film->film_central;
  sb_sliding_film_errors(out, solved, fit);
  return true;
}

// Returns whether there is a film: something moves, and the inlet finds liquid.
bool sb_sliding_has_film(const SbSlidingTask *task) {
  return task->speed != 0 && !(task->supply.limited && !(task->supply.layer > 0));
}

// Warns of options that have no effect with this model.
static void option_warnings(const SbSlidingTask *task, const SbFilmProblem *problem) {
  const SbModel *model = task->model;
  bool asked =
      model->pressure_viscosity > 0 || model->eyring_stress > 0 || model->rupture_pressure != 0;
  if (asked && !sb_film_kind(problem->model)->coupled) {
    sb_warn(task->warnings, "film-options", sb_input(SB_P_MODELS_FILM),
            "pressure viscosity, Eyring stress and rupture pressure act on the solved film only "
            "(models.film = reynolds), not on a power law");
  } else if (problem->rupture_pressure < model->rupture_pressure) {
    sb_warn(task->warnings, "rupture-ambient", sb_input(SB_P_FLUID_RUPTURE_PRESSURE),
            "the film of the %s seal breaks at the %.3g MPa around it: the rupture pressure of "
            "%.3g MPa is higher",
            sb_seal_name(task->seal), 1e-6 * problem->rupture_pressure,
            1e-6 * model->rupture_pressure);
  }
  if (model->hamaker > 0 && !sb_contact_law(model)->shares) {
    sb_warn(task->warnings, "adhesion-beside", sb_input(SB_P_MODELS_ADHESION),
            "adhesion acts in the solve of film and asperities together only (models.asperities = "
            "coupled): left out here");
  }
}

void sb_sliding_law_errors(SbSealState *out) {
  out->film_error = out->central_error =
      out->net_error > 0 ? SB_FILM_LAW_LOAD_POWER * out->net_error : NAN;
}

// A law's film carries half of itself along (thesis eq. 5.20), and no more than the supply.
void sb_sliding_limit_law(SbSealState *out, const SbSlidingTask *task) {
  out->layer = out->film_central / 2;
  if (task->supply.limited && task->supply.layer < out->layer) {
    out->layer = task->supply.layer;
    out->film_central = 2 * out->layer;
    out->film_min = fmin(out->film_min, out->film_central);
  }
}

SbStatus sb_sliding_solve_film(const SbSlidingTask *task, SbSealState *out, SbReport *report) {
  SbSlidingMemory *memory = task->memory;
  SbFilmProblem problem;
  sb_sliding_film_problem(&problem, task->model, task->seal, task->pressure, out->load_net,
                          task->speed);
  problem.model = task->model->film;
  option_warnings(task, &problem);
  bool solved = sb_film_kind(problem.model)->coupled;
  problem.inlet_film = task->supply.limited && solved ? task->supply.layer : 0;
  SbStatus status = sb_sliding_solve_on(task, &memory->plane, &problem, report);
  memory->last = &memory->plane;
  if (status == SB_ERROR_CANCELLED || (!solved && !sb_sliding_usable(status))) {
    return status;
  }
  if (sb_sliding_usable(status)) {
    sb_sliding_read_film(out, &memory->plane, status, &memory->now->fit);
  }
  if (solved) {
    out->film_reynolds = out->film_central;
  } else {
    sb_sliding_law_errors(out);
    sb_sliding_limit_law(out, task);
  }
  // End pressures that the fitted body carries may open the half-plane's contact or prevent its
  // solution.
  SbReport why = {0};
  if (solved && solve_fitted(task, &memory->fitted, &problem, &why)) {
    sb_sliding_read_film(out, &memory->fitted, SB_OK, &memory->now->fit);
    memory->last = &memory->fitted;
    status = sb_succeed(report);
  } else {
    status = accept(task, &memory->plane, status, UNKNOWN, report);
    tell_half_plane(task, status, &why);
  }
  if (!sb_sliding_usable(status)) {
    return status;
  }
  sb_warnings_merge(task->warnings, &memory->last->film.warnings);
  return status;
}

const SbRoughLaw *sb_sliding_rough_law(const SbSlidingTask *task) {
  const SbModel *model = task->model;
  SbSlidingMemory *memory = task->memory;
  const SbRoughSurface surface = sb_model_surface(model, task->seal, 1);
  if (!sb_contact_law(model)->shares || surface.model == SB_ROUGH_NONE ||
      surface.work > 0) { // tips that stick have their own
    return NULL;
  }
  SbRoughLaw *law = &memory->law;
  if (law->count > 0 && sb_rough_same_surface(&law->surface, &surface)) {
    return law;
  }
  const SbRoughLaw *known = law->count == 0 && memory->from != NULL ? &memory->from->law : law;
  return sb_rough_law_like(law, &surface, known, NULL) == SB_OK ? law : NULL;
}

static void add_asperities(SbFilmProblem *problem, const SbSlidingTask *task) {
  const SbModel *model = task->model;
  problem->surface = model->surface;
  problem->gt_product = model->gt_product;
  problem->sigma = model->sigma;
  problem->sigma_over_beta = model->sigma_over_beta;
  problem->hamaker = model->hamaker;
  problem->work_of_adhesion = model->work_of_adhesion;
  problem->shear_strength = model->shear_strength;
  problem->load_coefficient = model->load_coefficient;
  problem->law = sb_sliding_rough_law(task);
}

// The film with asperities in it: on the fitted body, or on the half-plane where that cannot be.
SbStatus sb_sliding_solve_rough(const SbSlidingTask *task, SbSlidingSolved *out, double load_net,
                                double speed, SbReport *report) {
  const SbModel *model = task->model;
  SbFilmProblem problem;
  sb_sliding_film_problem(&problem, model, task->seal, task->pressure, load_net, speed);
  add_asperities(&problem, task);
  if (speed != 0) {
    problem.inlet_film = task->supply.limited ? task->supply.layer : 0;
    option_warnings(task, &problem);
  }
  SbReport why;
  if (solve_fitted(task, out, &problem, &why)) {
    return SB_OK;
  }
  SbStatus status = sb_sliding_solve_on(task, out, &problem, report);
  status = accept(task, out, status, UNKNOWN, report);
  tell_half_plane(task, status, &why);
  return status;
}

void sb_sliding_film_of(SbFilmProblem *out, const SbSealState *state, const SbSlidingTask *task,
                        const SbSlidingBody *body) {
  const SbModel *model = task->model;
  const bool coupled = sb_contact_law(model)->shares;
  sb_sliding_film_problem(out, model, task->seal, task->pressure, state->load_net, task->speed);
  out->model = coupled ? SB_FILM_REYNOLDS : model->film;
  const bool solved = sb_film_kind(out->model)->coupled;
  out->inlet_film = task->supply.limited && solved ? task->supply.layer : 0;
  if (coupled) {
    add_asperities(out, task);
  }
  if (body != NULL) {
    lay_on(out, body);
  }
}

SbStatus sb_ring_respeed(SbSealState *state, const SbSlidingTask *task, const SbSlidingBody *body,
                         SbReport *report) {
  const SbContactLaw *law = sb_contact_law(task->model);
  SbSlidingMemory *memory = task->memory;
  SbFilmProblem problem;
  sb_sliding_film_of(&problem, state, task, body);
  const bool solved = sb_film_kind(problem.model)->coupled;
  SbSlidingSolved *on = body != NULL ? &memory->fitted : &memory->plane;
  memory->last = on;
  memory->near = true;
  SbStatus status = sb_sliding_solve_on(task, on, &problem, report);
  status = accept(task, on, status, UNKNOWN, report);
  memory->near = false;
  if (!sb_sliding_usable(status) || !(on->film.film_central > 0)) {
    return status != SB_OK ? status : sb_fail(report, SB_ERROR_NOT_CONVERGED, "no film");
  }
  const double error = state->film_error, central = state->central_error;
  sb_sliding_read_film(state, on, status, &memory->now->fit);
  state->film_error = error;
  state->central_error = central;
  if (!solved) {
    sb_sliding_limit_law(state, task);
  }
  if (law->take != NULL) {
    law->take(state, task->model, &on->film, on->fitted);
  }
  SbStatus rubbed = sb_sliding_refilm(state, task, 1, report);
  return rubbed != SB_OK ? rubbed : status;
}

// Does the same for a film in which asperities carry most of the load, which no law describes: from
// solved flooded films.
static double starved_rough(const SbSlidingTask *task, const SbFilmProblem *problem) {
  enum { ROUNDS = 6 };
  static const double TIMES = 4, POWER = 0.6, NEAR = 0.05, FASTEST = 1e3; // m/s
  SbSlidingMemory *memory = task->memory;
  SbFilm *film = &memory->plane.film;
  SbFilmProblem flooded = *problem;
  flooded.hamaker = flooded.work_of_adhesion = flooded.inlet_film = 0;
  flooded.compliance = NULL;
  flooded.cancelled = memory->cancelled;
  flooded.cancelled_data = memory->cancelled_data;
  flooded.speed = fabs(problem->speed);
  memory->base.known = false;
  if (!(problem->inlet_film > 0) ||
      (memory->solver == NULL && sb_film_solver_create(&memory->solver, NULL) != SB_OK)) {
    return INFINITY;
  }
  for (int round = 0; round < ROUNDS && flooded.speed < FASTEST; round++) {
    if (solve_once(task, film, &flooded, memory->solver, NULL) != SB_OK) {
      return INFINITY;
    }
    const double thicker = TIMES * 2 * problem->inlet_film / film->film_central;
    if (fabs(log(thicker)) < NEAR) {
      return flooded.speed;
    }
    flooded.speed *= pow(thicker, 1 / POWER);
  }
  return INFINITY;
}

double sb_sliding_starved_speed(const SbSealState *state, const SbSlidingTask *task,
                                const SbSlidingBody *body) {
  SbFilmProblem problem;
  sb_sliding_film_of(&problem, state, task, body);
  return problem.surface != SB_ROUGH_NONE ? starved_rough(task, &problem)
                                          : starved_speed(&task->memory->plane.film, &problem);
}
