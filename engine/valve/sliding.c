// Joins fitment, film, surface and friction for one seal; see sliding.h for the equations.
//
// With a fitment model that gives a pressure of its own the solved film lies on this body: its
// edges, its pressure, its compliance; the half-plane's film stands beside it. The film's load is
// the net one: the fluid on either side carries its own step, so a contact from l to r under the
// total load W leaves W - p_left (0 - l) - p_right (r - 0) to the film (README, Definitions). What
// it leaves out: beside the film, asperities do not take load off it (they carry 1 to 14 % of it at
// its least, docs/thesis.md, 10; coupled they share it); the closed forms know no inlet starvation.
#include "engine/valve/sliding_private.h"

#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/contact/rough/persson.h"
#include "engine/valve/breakaway.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double sb_sliding_friction(const SbSealState *state) {
  return state->boundary_area + state->boundary_load + state->friction_viscous;
}

SbStatus sb_sliding_memory_create(SbSlidingMemory **out, SbReport *report) {
  *out = calloc(1, sizeof **out);
  if (*out == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a seal's workspace");
  }
  (*out)->last = &(*out)->plane;
  (*out)->now = (*out)->fitment;
  return sb_succeed(report);
}

void sb_sliding_memory_destroy(SbSlidingMemory *memory) {
  if (memory != NULL) {
    sb_film_solver_destroy(memory->solver);
    sb_film_solver_destroy(memory->rest_solver);
    for (int i = 0; i < SB_RUN_MOTIONS; i++) {
      sb_ring_destroy(memory->fitment[i].ring);
    }
    for (int i = 0; i < memory->kept_count; i++) {
      sb_sliding_beside_destroy(memory->kept[i].beside);
      sb_ring_guide_destroy(memory->kept[i].guide);
      sb_ring_tangent_destroy(memory->kept[i].tangent);
      sb_ring_destroy(memory->kept[i].ring);
    }
    free(memory);
  }
}

void sb_sliding_memory_forget(SbSlidingMemory *memory) {
  memory->rested = false;
  for (int i = 0; i < SB_RUN_MOTIONS; i++) {
    memory->fitment[i].known = false;
    (void)sb_succeed(&memory->fitment[i].why);
  }
  memory->last = &memory->plane;
  memory->base.known = false;
  if (memory->solver != NULL) {
    sb_film_solver_forget(memory->solver);
  }
}

void sb_sliding_memory_keep(SbSlidingMemory *memory) {
  memory->keeps = true;
}

void sb_sliding_memory_end(SbSlidingMemory *memory) {
  for (int way = 0; way < SB_RUN_MOTIONS; way++) {
    sb_sliding_keep(memory, way);
  }
  memory->keeps = false;
}

void sb_sliding_memory_start(SbSlidingMemory *memory, const SbSlidingMemory *from, bool tangent,
                             bool drawn) {
  memory->from = from;
  memory->tangent = tangent;
  memory->summed = tangent && !drawn;
}

void sb_sliding_memory_ahead(SbSlidingMemory *memory, SbSlidingMemory *ahead) {
  memory->ahead = ahead;
}

void sb_sliding_memory_beside(SbSlidingMemory *memory, SbRingsBeside how) {
  memory->beside = how;
}

void sb_sliding_memory_poll(SbSlidingMemory *memory, bool (*cancelled)(void *), void *data) {
  memory->cancelled = cancelled;
  memory->cancelled_data = data;
}

const SbFit *sb_sliding_fit(const SbSlidingMemory *memory) {
  return &memory->now->fit;
}

const SbRing *sb_sliding_ring(const SbSlidingMemory *memory) {
  return memory->now->fit.model == SB_FIT_RING ? memory->now->ring : NULL;
}

const SbFilm *sb_sliding_film(const SbSlidingMemory *memory) {
  return &memory->last->film;
}

double sb_sliding_film_share(const SbSlidingMemory *memory) {
  return memory->last->share;
}

const SbSlidingBody *sb_sliding_body(const SbSlidingMemory *memory) {
  return memory->last->fitted ? &memory->body : NULL;
}

// One solve of a film, counted; one that is not found beside another is solved alone then.
static SbStatus solve_once(const SbSlidingTask *task, SbFilm *film, const SbFilmProblem *problem,
                           SbFilmSolver *solver, SbReport *report) {
  SbStatus status = sb_film_solve(film, problem, solver, report);
  if (problem->model == SB_FILM_REYNOLDS) {
    const bool found = status == SB_OK || problem->place == SB_FILM_ALONE;
    task->counts->reynolds_solves += found ? 1 : 0;
    task->counts->newton_iterations += (size_t)film->solver.newton_iterations;
  }
  return status;
}

// Speed from which on a given film stands for that at any higher one; infinite where none does.
// Once a flooded film would be several times as thick, nothing but the supply shapes it: what
// passes is given, and the film is twice the layer, but for what pressure moves, which is less the
// faster it goes (2e-4 of it at four times).
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

// Solves a film; where it is given, at the share of its speed that is enough, or lower where the
// solver fails there. How far it then is from twice the layer is added to its error; the
// constriction at the outlet goes on towards that as well, but slowly: it is half way.
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
    sb_warn(&film->warnings, "film-starved", "models.inlet",
            "the bore brings so little that the film at %.3g mm/s stands for that at %.3g mm/s",
            1e3 * fabs(share * speed), 1e3 * fabs(speed));
  }
  return sb_succeed(report);
}

// Whether a film is near enough to what the solver solved last: it is then solved on that one's
// mesh in a tenth of the time, with that one's error.
static bool is_near(const SbSlidingMemory *memory, const SbSlidingSolved *out,
                    const SbFilmProblem *problem) {
  static const double SPEED = 1.25, LOAD = 1.03;
  const SbSlidingBase *base = &memory->base;
  const bool same = base->known && base->fitted == (problem->compliance != NULL);
  return memory->near && same && out != &memory->rest && base->left == problem->pressure_left &&
         base->right == problem->pressure_right && problem->speed / base->speed > 1 / SPEED &&
         problem->speed / base->speed < SPEED && problem->load / base->load > 1 / LOAD &&
         problem->load / base->load < LOAD;
}

SbStatus sb_sliding_solve_on(const SbSlidingTask *task, SbSlidingSolved *out,
                             const SbFilmProblem *problem, SbReport *report) {
  SbSlidingMemory *memory = task->memory;
  bool solved = problem->model == SB_FILM_REYNOLDS;
  out->speed = problem->speed;
  out->fresh = true;
  if (sb_sliding_film_summed(memory, out, problem->compliance != NULL)) {
    sb_sliding_take_film(out, memory);
    return sb_succeed(report);
  }
  SbFilmSolver **const usual = out == &memory->rest ? &memory->rest_solver : &memory->solver;
  SbFilmSolver **solver = out->own != NULL && !out->beside ? out->own : usual;
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
  // What adhesion closes, or a supply starves, takes several solves.
  const bool plain = !(lent.hamaker > 0 || lent.work_of_adhesion > 0);
  const bool next = out->beside && *out->own != NULL && !(lent.inlet_film > 0);
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
    memory->base = (SbSlidingBase){.known = stands,
                                   .fitted = problem->compliance != NULL,
                                   .left = problem->pressure_left,
                                   .right = problem->pressure_right,
                                   .speed = problem->speed,
                                   .load = problem->load};
  }
  return status;
}

static void lay_on(SbFilmProblem *problem, const SbSlidingBody *body) {
  problem->compliance = &body->compliance;
  problem->load = body->load;
  problem->modulus = body->compliance.modulus;
}

// Whether a film that the solver has just left above the tolerance is nearer than the half-plane's
// all the same; its error is told.
static bool misses_by_little(const SbSlidingTask *task, const SbSlidingSolved *solved) {
  static const double NEARER = 0.05, SOLVED = 1e-6; // of error and residual
  const SbFilm *film = &solved->film;
  const double error = fmax(film->solver.error_film_min, film->solver.error_film_central);
  if (!(film->film_central > 0) || !(error > 0 && error < NEARER) ||
      !(film->solver.residual < SOLVED) || solved->share != 1) {
    return false;
  }
  sb_warn(task->warnings, "film-tolerance", "output.tolerance",
          "the film on the fitted %s seal is known to %.2g only, not to %.2g",
          sb_seal_name(task->seal), error, task->model->tolerance);
  return true;
}

// The film on the fitted body in place of the half-plane's; false where there is none or it fails,
// then with a reason in `why`, of a body that has one.
static bool solve_fitted(const SbSlidingTask *task, SbSlidingSolved *out,
                         const SbFilmProblem *plane, SbReport *why) {
  *why = (SbReport){0};
  const SbFit *fit = &task->memory->now->fit;
  if (fit->model != SB_FIT_DISC && fit->model != SB_FIT_RING) {
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
    status = status == SB_ERROR_NOT_CONVERGED && misses_by_little(task, out) ? SB_OK : status;
  }
  return status == SB_OK;
}

// A solver that stopped above the tolerance has the figures of its last solution, with their error.
bool sb_sliding_usable(SbStatus status) {
  return status == SB_OK || status == SB_ERROR_NOT_CONVERGED;
}

// Tells that a film is the half-plane's, and why; one that the fluid opens is nobody's.
static void tell_half_plane(const SbSlidingTask *task, SbStatus status, const SbReport *why) {
  if (sb_sliding_usable(status) && why->text[0] != '\0') {
    sb_warn(task->warnings, "film-half-plane", "models.fit",
            "no film on the fitted %s seal (%s): it is the half-plane's", sb_seal_name(task->seal),
            why->text);
  }
}

// A seal's film figures are those of `solved`; NaN stays where the solver stopped before its first
// solution (false).
static bool take_film(SbSealState *out, const SbSlidingSolved *solved, SbStatus status,
                      const SbFit *fit) {
  const SbFilm *film = &solved->film;
  if (status != SB_OK && !(film->film_central > 0)) {
    return false;
  }
  out->film_fitted = solved->fitted;
  out->layer = film->flow > 0 || film->flow < 0 ? fabs(film->flow / solved->speed) : 0;
  out->film_min = film->film_min;
  out->film_central = film->film_central;
  double ring = 0;
  if (solved->fitted && fit->model == SB_FIT_RING) {
    // A thin film goes with the power -0.8 of the strength of the pressure's root at its inlet,
    // which goes with peak over root of width but hangs on few nodes of the ring's mesh: measured,
    // it is out by up to five times their relative errors.
    ring =
        0.8 * 5 *
        (fit->solver.error_estimate.pressure_peak + 0.5 * fit->solver.error_estimate.contact_width);
    // A dragged one's scatters by up to 7 % between the meshes and path tolerances tried.
    static const double DRAGGED = 0.07;
    ring = fit->ring.drag != 0 ? fmax(ring, DRAGGED) : ring;
  }
  out->central_error = film->solver.error_film_central + ring;
  out->film_error = fmax(film->solver.error_film_min + ring, out->central_error);
  return true;
}

// Whether there is a film: something moves, and the inlet finds liquid.
static bool has_film(const SbSlidingTask *task) {
  return task->speed != 0 && !(task->supply.limited && !(task->supply.layer > 0));
}

// What a run's options cannot reach, told once.
static void option_warnings(const SbSlidingTask *task, const SbFilmProblem *problem) {
  const SbModel *model = task->model;
  bool coupled = model->asperities == SB_MODEL_ASPERITIES_COUPLED;
  bool asked =
      model->pressure_viscosity > 0 || model->eyring_stress > 0 || model->rupture_pressure != 0;
  if (asked && problem->model != SB_FILM_REYNOLDS) {
    sb_warn(task->warnings, "film-options", "models.film",
            "pressure viscosity, Eyring stress and rupture pressure act on the solved film only "
            "(models.film = reynolds), not on a power law");
  } else if (problem->rupture_pressure < model->rupture_pressure) {
    sb_warn(task->warnings, "rupture-ambient", "fluid.rupture_pressure",
            "the film of the %s seal breaks at the %.3g MPa around it: the rupture pressure of "
            "%.3g MPa is higher",
            sb_seal_name(task->seal), 1e-6 * problem->rupture_pressure,
            1e-6 * model->rupture_pressure);
  }
  if (model->hamaker > 0 && !coupled) {
    sb_warn(task->warnings, "adhesion-beside", "models.adhesion",
            "adhesion acts in the solve of film and asperities together only (models.asperities = "
            "coupled): left out here");
  }
}

// A law's film carries half of itself along (thesis eq. 5.20), and no more than the supply.
static void limit_law(SbSealState *out, const SbSlidingTask *task) {
  out->layer = out->film_central / 2;
  if (task->supply.limited && task->supply.layer < out->layer) {
    out->layer = task->supply.layer;
    out->film_central = 2 * out->layer;
    out->film_min = fmin(out->film_min, out->film_central);
  }
}

static SbStatus solve_film(const SbSlidingTask *task, SbSealState *out, SbReport *report) {
  SbSlidingMemory *memory = task->memory;
  SbFilmProblem problem;
  sb_sliding_film_problem(&problem, task->model, task->seal, task->pressure, out->load_net,
                          task->speed);
  problem.model = task->model->film;
  option_warnings(task, &problem);
  bool solved = problem.model == SB_FILM_REYNOLDS;
  problem.inlet_film = task->supply.limited && solved ? task->supply.layer : 0;
  SbStatus status = sb_sliding_solve_on(task, &memory->plane, &problem, report);
  memory->last = &memory->plane;
  if (status == SB_ERROR_CANCELLED || (!solved && !sb_sliding_usable(status))) {
    return status;
  }
  if (sb_sliding_usable(status)) {
    take_film(out, &memory->plane, status, &memory->now->fit);
  }
  if (solved) {
    out->film_reynolds = out->film_central;
  } else {
    out->film_error = out->central_error = NAN;
    limit_law(out, task);
  }
  // The half-plane may be opened or lost by end pressures that the fitted body bears.
  SbReport why = {0};
  if (solved && solve_fitted(task, &memory->fitted, &problem, &why)) {
    take_film(out, &memory->fitted, SB_OK, &memory->now->fit);
    memory->last = &memory->fitted;
    status = sb_succeed(report);
  } else {
    tell_half_plane(task, status, &why);
  }
  if (!sb_sliding_usable(status)) {
    return status;
  }
  sb_warnings_merge(task->warnings, &memory->last->film.warnings);
  return status;
}

static void add_asperities(SbFilmProblem *problem, const SbModel *model) {
  problem->surface = model->surface;
  problem->gt_product = model->gt_product;
  problem->sigma = model->sigma;
  problem->sigma_over_beta = model->sigma_over_beta;
  problem->hamaker = model->hamaker;
  problem->work_of_adhesion = model->work_of_adhesion;
  problem->shear_strength = model->shear_strength;
  problem->load_coefficient = model->load_coefficient;
}

// The film with asperities in it: on the fitted body, or on the half-plane where that cannot be.
static SbStatus solve_rough(const SbSlidingTask *task, SbSlidingSolved *out, double load_net,
                            double speed, SbReport *report) {
  const SbModel *model = task->model;
  SbFilmProblem problem;
  sb_sliding_film_problem(&problem, model, task->seal, task->pressure, load_net, speed);
  add_asperities(&problem, model);
  if (speed != 0) {
    problem.inlet_film = task->supply.limited ? task->supply.layer : 0;
    option_warnings(task, &problem);
  }
  SbReport why;
  if (solve_fitted(task, out, &problem, &why)) {
    return SB_OK;
  }
  SbStatus status = sb_sliding_solve_on(task, out, &problem, report);
  tell_half_plane(task, status, &why);
  return status;
}

// Break-away after the rest before the first stroke.
static SbStatus set_static(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  SbDwellLaw law;
  SbStatus status =
      sb_breakaway_law(&law, &out->squeeze_out_time, task->model, task->seal, out, report);
  out->friction_static = status == SB_OK ? sb_dwell_at(&law, task->model->rest) : NAN;
  return status;
}

// The thesis' shear strength goes with its own real area.
static void strength_warning(const SbSlidingTask *task, double share) {
  const SbModel *model = task->model;
  const bool thesis = model->set == SB_MODEL_SET_THESIS;
  if (model->surface == SB_ROUGH_PERSSON && thesis &&
      !model->params.given[SB_P_FRICTION_SHEAR_STRENGTH]) {
    sb_warn(
        task->warnings, "persson-shear-strength", "friction.shear_strength",
        "Persson's real contact is %.0f %% here; the default shear strength was set with Greenwood "
        "and Tripp's few per cent",
        100 * share);
  }
}

// What a film says of the asperities in it. Lengths of the half-plane's contact are over that, of a
// fitted body's over the fitted one; forces over the fitted circumference.
static void take_asperities(SbSealState *out, const SbModel *model, const SbFilm *film,
                            bool fitted) {
  const double fit_width = out->contact_right - out->contact_left;
  const double width = fitted ? fit_width : 2 * film->hertz_half_width;
  const double area = fit_width * model->bore_circumference;
  out->lambda = film->film_ratio;
  out->real_area_share = fmin(film->real_area / width, 1);
  out->asperity_share = film->asperity_share;
  out->boundary_area = model->shear_strength * out->real_area_share * area;
  out->boundary_load =
      model->load_coefficient * film->asperity_load * out->load / out->load_per_length;
  out->friction_viscous = fabs(film->friction_couette + film->friction_cavity) / width * area;
}

// The dry rough contact of a coupled state at rest, which stands as long as the fit does.
static SbStatus solve_rest(const SbSlidingTask *task, const SbSealState *out, SbReport *report) {
  SbSlidingMemory *memory = task->memory;
  if (memory->rested && memory->rest_on == memory->now &&
      memory->rest_left == task->pressure.left) {
    return sb_succeed(report);
  }
  SbStatus status = solve_rough(task, &memory->rest, out->load_net, 0, report);
  if (sb_sliding_usable(status)) {
    memory->rested = status == SB_OK;
    memory->rest_left = task->pressure.left;
    memory->rest_on = memory->now;
  }
  return status;
}

// What that says of a state, and of its break-away.
static SbStatus take_rest(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  const SbSlidingMemory *memory = task->memory;
  const SbFilm *rest = &memory->rest.film;
  if (memory->rested || rest->film_central > 0) {
    SbSealState dry = *out;
    take_asperities(&dry, task->model, rest, memory->rest.fitted);
    out->rest_area_share = dry.real_area_share;
    out->rest_area = dry.boundary_area;
    out->rest_load = dry.boundary_load;
    strength_warning(task, out->rest_area_share);
  }
  SbStatus status = set_static(out, task, report);
  out->static_error = rest->solver.error_contact * out->friction_static;
  return status;
}

// Film, rough contact and friction from one solution each, sliding and at rest.
static SbStatus solve_coupled(const SbSlidingTask *task, SbSealState *out, SbReport *report) {
  SbSlidingMemory *memory = task->memory;
  const bool slides = has_film(task), rests = !(slides && memory->rest_waits);
  SbStatus at_rest = rests ? solve_rest(task, out, report) : SB_OK;
  if (!sb_sliding_usable(at_rest)) {
    return at_rest;
  }
  memory->last = &memory->rest;
  SbStatus status = at_rest;
  if (slides) {
    memory->last = &memory->plane;
    status = solve_rough(task, &memory->plane, out->load_net, task->speed,
                         at_rest == SB_OK ? report : NULL);
    if (!sb_sliding_usable(status)) {
      return status;
    }
  }
  const SbFilm *film = &memory->last->film;
  sb_warnings_merge(task->warnings, &film->warnings);
  if (take_film(out, memory->last, status, &memory->now->fit)) {
    take_asperities(out, task->model, film, memory->last->fitted);
  }
  if (rests) {
    SbStatus aged = take_rest(out, task, status == SB_OK && at_rest == SB_OK ? report : NULL);
    if (aged != SB_OK) {
      return aged;
    }
  }
  out->friction_error = film->solver.error_contact * (out->boundary_area + out->boundary_load) +
                        out->central_error * out->friction_viscous;
  return status != SB_OK ? status : at_rest;
}

// Share of the area in real contact, sliding and at rest. Greenwood and Tripp's depends on the
// film, Persson's on the net pressure that the solids must carry.
static SbStatus real_area(SbSealState *out, const SbSlidingTask *task, double roughness,
                          SbReport *report) {
  const SbModel *model = task->model;
  const SbRoughSurface surface = sb_model_surface(model, task->seal, roughness);
  if (model->surface == SB_ROUGH_PERSSON) {
    SbSpectrum spectrum;
    SbStatus status = sb_spectrum_from_asperities(&spectrum, surface.sigma, surface.sigma_over_beta,
                                                  surface.product, report);
    if (status != SB_OK) {
      return status;
    }
    double pressure = fmax(out->load_net, 0) / (out->contact_right - out->contact_left);
    out->real_area_share = out->rest_area_share =
        sb_persson_area_share(&spectrum, spectrum.q1, surface.modulus, pressure);
    strength_warning(task, out->real_area_share);
    return SB_OK;
  }
  if (surface.work > 0) {
    const SbAsperity tip = sb_rough_tip(&surface);
    sb_asperity_warn(task->warnings, &tip);
  }
  out->rest_area_share = sb_rough_area_share(&surface, 0);
  // Without a film there is no real contact under it either.
  out->real_area_share = sb_rough_area_share(&surface, out->lambda);
  if (isnan(out->real_area_share) && !isnan(out->lambda)) {
    return sb_fail(report, SB_ERROR_RANGE, "no asperity contact of the %s seal at λ = %g",
                   sb_seal_name(task->seal), out->lambda);
  }
  if (out->real_area_share > 0.3) {
    sb_warn(
        task->warnings, "real-area-large", "surface.gt_product",
        "asperities of the %s seal touch on %.0f %% of the area: Greenwood and Tripp's asperities "
        "are no longer independent",
        sb_seal_name(task->seal), 100 * out->real_area_share);
  }
  return SB_OK;
}

// What the surfaces make of a contact that slides, whose load, width and film are known: real area,
// kinetic friction.
static SbStatus rub(SbSealState *out, const SbSlidingTask *task, double roughness,
                    SbReport *report) {
  const SbModel *model = task->model;
  double area = (out->contact_right - out->contact_left) * model->bore_circumference;
  out->lambda = out->film_central / (roughness * model->sigma);
  SbStatus status = real_area(out, task, roughness, report);
  if (status != SB_OK) {
    return status;
  }
  out->boundary_area = model->shear_strength * out->real_area_share * area;
  out->boundary_load = model->load_coefficient * out->load;
  out->friction_viscous = 0;
  if (task->speed != 0 && out->film_central != 0) {
    // fmin() would take a film that was not computed for the greatest shear.
    double shear = model->viscosity * fabs(task->speed) / out->film_central;
    shear = shear > model->shear_strength ? model->shear_strength : shear;
    out->friction_viscous = shear * (1 - out->real_area_share) * area;
    if (out->central_error > 0) {
      const SbRoughSurface surface = sb_model_surface(model, task->seal, roughness);
      double thinner = sb_rough_area_share(&surface, out->lambda * (1 - out->central_error));
      bool persson = model->surface == SB_ROUGH_PERSSON;
      out->friction_error =
          out->central_error * out->friction_viscous +
          (persson ? 0 : model->shear_strength * fabs(thinner - out->real_area_share) * area);
    }
  }
  return SB_OK;
}

// The same, and of what stands.
SbStatus sb_sliding_rough_contact(SbSealState *out, const SbSlidingTask *task, double roughness,
                                  SbReport *report) {
  const SbModel *model = task->model;
  SbStatus status = rub(out, task, roughness, report);
  if (status != SB_OK) {
    return status;
  }
  out->rest_area = model->shear_strength * out->rest_area_share *
                   (out->contact_right - out->contact_left) * model->bore_circumference;
  out->rest_load = out->boundary_load;
  return set_static(out, task, report);
}

// Leaves of a law's kinetic friction what the section bears. What the pressure cannot shear is no
// real contact; one that rolls is not sheared to the full.
static void share_kinetic(SbSealState *out) {
  if (!isnan(out->borne_share)) {
    out->real_area_share *= out->area_cut * (out->section == SB_RING_SLIDES ? out->borne_share : 1);
    out->boundary_area *= out->area_cut * out->borne_share;
    out->boundary_load *= out->borne_share;
    out->friction_viscous *= out->borne_share;
    out->friction_error *= out->borne_share;
  }
}

void sb_sliding_whole(SbSealState *state) {
  const double slides = state->section == SB_RING_SLIDES ? state->borne_share : 1;
  if (state->borne_share > 0 && state->area_cut > 0) {
    state->real_area_share /= state->area_cut * slides;
    state->boundary_load /= state->borne_share;
    state->friction_viscous /= state->borne_share;
  }
}

// Leaves of a law's friction what the section bears (bear()).
SbStatus sb_sliding_share_out(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  if (isnan(out->borne_share)) {
    return SB_OK;
  }
  out->rest_area_share *= out->area_cut;
  out->rest_area *= out->area_cut; // the pressure limits it as well
  share_kinetic(out);
  if (out->section == SB_RING_SLIDES) {
    return set_static(out, task, report);
  }
  out->rest_area = out->boundary_area;
  out->rest_load = out->boundary_load;
  out->friction_static = sb_sliding_friction(out);
  return SB_OK;
}

static const char *about(int seal) {
  return seal == SB_OUTER ? "outer seal" : "inner seal";
}

// A film that cannot be, because the fluid opens the contact, is a result, not a failure. Otherwise
// passes on the report.
static SbStatus opened_by_fluid(SbSealState *out, SbStatus status, const SbReport *own, int seal,
                                SbWarnings *warnings, SbReport *report) {
  if (status != SB_ERROR_INFEASIBLE || strcmp(own->parameter, "canister.pressure") != 0) {
    if (status != SB_OK && report != NULL) {
      *report = *own;
    }
    return status;
  }
  out->opened = true;
  sb_warn(warnings, "film-opened", "canister.pressure",
          "the fluid's pressure opens the contact of the %s seal: no film lies in it",
          sb_seal_name(seal));
  return SB_OK;
}

SbStatus sb_sliding_rest(const SbSlidingTask *task, SbSealState *out, SbReport *report) {
  if (task->model->asperities != SB_MODEL_ASPERITIES_COUPLED || !(out->load_net > 0) ||
      out->opened || !has_film(task)) {
    return SB_OK;
  }
  SbReport own = {0};
  SbStatus at_rest = solve_rest(task, out, &own);
  SbStatus status =
      sb_sliding_usable(at_rest) ? take_rest(out, task, at_rest == SB_OK ? &own : NULL) : at_rest;
  status = status == SB_OK ? at_rest : status;
  return opened_by_fluid(out, status, &own, task->seal, task->warnings, report);
}

void sb_sliding_film_of(SbFilmProblem *out, const SbSealState *state, const SbSlidingTask *task,
                        const SbSlidingBody *body) {
  const SbModel *model = task->model;
  const bool coupled = model->asperities == SB_MODEL_ASPERITIES_COUPLED;
  sb_sliding_film_problem(out, model, task->seal, task->pressure, state->load_net, task->speed);
  out->model = coupled ? SB_FILM_REYNOLDS : model->film;
  const bool solved = out->model == SB_FILM_REYNOLDS;
  out->inlet_film = task->supply.limited && solved ? task->supply.layer : 0;
  if (coupled) {
    add_asperities(out, model);
  }
  if (body != NULL) {
    lay_on(out, body);
  }
}

void sb_sliding_take(SbSealState *state, const SbSlidingTask *task, const SbFilm *film, bool fitted,
                     double roughness) {
  state->film_min = film->film_min;
  state->film_central = film->film_central;
  if (task->model->asperities == SB_MODEL_ASPERITIES_COUPLED) {
    take_asperities(state, task->model, film, fitted);
  }
  (void)sb_sliding_refilm(state, task, roughness, NULL);
}

// The same of a film in which asperities carry most of the load, of which no law knows: from solved
// flooded films.
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

SbStatus sb_sliding_respeed(SbSealState *state, const SbSlidingTask *task,
                            const SbSlidingBody *body, SbReport *report) {
  const SbModel *model = task->model;
  SbSlidingMemory *memory = task->memory;
  const bool coupled = model->asperities == SB_MODEL_ASPERITIES_COUPLED;
  SbFilmProblem problem;
  sb_sliding_film_of(&problem, state, task, body);
  const bool solved = problem.model == SB_FILM_REYNOLDS;
  SbSlidingSolved *on = body != NULL ? &memory->fitted : &memory->plane;
  memory->last = on;
  memory->near = true;
  SbStatus status = sb_sliding_solve_on(task, on, &problem, report);
  memory->near = false;
  if (!sb_sliding_usable(status) || !(on->film.film_central > 0)) {
    return status != SB_OK ? status : sb_fail(report, SB_ERROR_NOT_CONVERGED, "no film");
  }
  const double error = state->film_error, central = state->central_error;
  take_film(state, on, status, &memory->now->fit);
  state->film_error = error;
  state->central_error = central;
  if (!solved) {
    limit_law(state, task);
  }
  if (coupled) {
    take_asperities(state, model, &on->film, on->fitted);
  }
  SbStatus rubbed = sb_sliding_refilm(state, task, 1, report);
  return rubbed != SB_OK ? rubbed : status;
}

SbStatus sb_sliding_refilm(SbSealState *state, const SbSlidingTask *task, double roughness,
                           SbReport *report) {
  const SbModel *model = task->model;
  if (model->asperities == SB_MODEL_ASPERITIES_COUPLED) {
    state->lambda = state->film_central / model->sigma;
    state->boundary_area = model->shear_strength * state->real_area_share *
                           (state->contact_right - state->contact_left) * model->bore_circumference;
    share_kinetic(state);
    return sb_succeed(report);
  }
  // Without a film what stands has none either, whatever the speed.
  const double rest_share = state->rest_area_share;
  SbStatus status = rub(state, task, roughness, report);
  state->rest_area_share = rest_share;
  share_kinetic(state);
  return status;
}

SbStatus sb_sliding_resurface(SbSealState *state, const SbSlidingTask *task, double roughness,
                              SbReport *report) {
  sb_warn_about(task->warnings, about(task->seal));
  SbStatus status = state->touches ? sb_sliding_rough_contact(state, task, roughness, report)
                                   : sb_succeed(report);
  status = status == SB_OK ? sb_sliding_share_out(state, task, report) : status;
  sb_warn_about(task->warnings, NULL);
  return status;
}

void sb_sliding_clear(SbSealState *out) {
  *out = (SbSealState){.layer = NAN,
                       .load_net = NAN,
                       .film_error = NAN,
                       .central_error = NAN,
                       .boundary_area = NAN,
                       .boundary_load = NAN,
                       .rest_area = NAN,
                       .rest_load = NAN,
                       .area_cut = NAN,
                       .borne_share = NAN,
                       .rotation = NAN};
#define SB_SEAL_FIGURE(path, member, ...) out->member = NAN;
#include "engine/valve/figures.def"
}

// Fitment, film and friction; a ring dragged as given, else as it is known.
SbStatus sb_sliding_solve_once(const SbSlidingTask *task, const SbSlidingLaw *law, SbSealState *out,
                               SbReport *report) {
  SbWarnings *warnings = task->warnings;
  int seal = task->seal;
  bool known;
  SbStatus status = sb_sliding_fit_contact(task, law, out, &known, report);
  if (!known) {
    return status;
  }
  SbReport own = {0};
  SbReport *first = status == SB_OK ? report : NULL; // the first failure is told
  if (task->model->asperities == SB_MODEL_ASPERITIES_COUPLED && out->load_net > 0) {
    SbStatus coupled = solve_coupled(task, out, &own);
    coupled = opened_by_fluid(out, coupled, &own, seal, warnings, first);
    return coupled != SB_OK ? coupled : status;
  }

  // Film, only when sliding on a liquid.
  if (!has_film(task)) {
    out->film_min = out->film_central = out->layer = 0;
  } else if (out->load_net <= 0) {
    out->opened = true;
    sb_warn(warnings, "film-no-net-load", "canister.pressure",
            "the fluid alone carries the %s seal: no film law applies", sb_seal_name(seal));
  } else {
    SbStatus film = solve_film(task, out, &own);
    film = opened_by_fluid(out, film, &own, seal, warnings, first);
    if (!sb_sliding_usable(film)) {
      return film;
    }
    status = film != SB_OK ? film : status;
  }

  SbStatus area_status = sb_sliding_rough_contact(out, task, 1, status == SB_OK ? report : NULL);
  if (area_status != SB_OK) {
    return area_status;
  }

  // Regime and validity.
  if (task->speed != 0 && out->film_central > 0 && out->lambda < 1) {
    sb_warn(warnings, "boundary-regime", "surface.sigma",
            "λ = %.2g at the %s seal: boundary regime, the film is thinner than the roughness",
            out->lambda, sb_seal_name(seal));
  }
  return status;
}

SbStatus sb_sliding_solve_with(const SbSlidingTask *task, const SbSlidingLaw *law, SbSealState *out,
                               SbReport *report) {
  SbSlidingMemory *memory = task->memory;
  const SbSlidingStart *start = memory->summed ? sb_sliding_start_of(task) : NULL;
  if (start != NULL && start->ring != NULL) {
    const bool known = law == NULL && sb_sliding_drags(task);
    const SbSlidingLaw by = known         ? memory->fitment[task->speed > 0 ? 0 : 1].law
                            : law != NULL ? *law
                                          : (SbSlidingLaw){0};
    SbStatus status = sb_sliding_sum(task, known || law != NULL ? &by : NULL, start->beside);
    if (status != SB_OK) {
      sb_sliding_sum_end(memory);
      sb_sliding_clear(out);
      return sb_fail(report, status, "no state of the %s seal", sb_seal_name(task->seal));
    }
  }
  SbStatus status = sb_sliding_solve_once(task, law, out, report);
  sb_sliding_sum_end(memory);
  return status;
}

static SbStatus solve(const SbSlidingTask *task, SbSealState *out, SbReport *report) {
  return sb_sliding_drags(task) ? sb_sliding_drag(task, out, report)
                                : sb_sliding_solve_with(task, NULL, out, report);
}

SbStatus sb_sliding_solve(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  sb_warn_about(task->warnings, about(task->seal));
  SbStatus status = solve(task, out, report);
  sb_warn_about(task->warnings, NULL);
  return status;
}

SbStatus sb_sliding_fitment(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  bool known;
  sb_warn_about(task->warnings, about(task->seal));
  SbStatus status = sb_sliding_fit_contact(task, NULL, out, &known, report);
  sb_warn_about(task->warnings, NULL);
  return status;
}
