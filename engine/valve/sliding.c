// Joins fitment, film, surface and friction for one seal; see sliding.h for the equations.
//
// With a fitment model that gives a pressure of its own the solved film lies on this body: its
// edges, its pressure, its compliance; the half-plane's film stands beside it. The film's load is
// the net one: the fluid on either side carries its own step, so a contact from l to r under the
// total load W leaves W - p_left (0 - l) - p_right (r - 0) to the film (README, Definitions). What
// it leaves out: beside the film, asperities do not take load off it (they carry 1 to 14 % of it at
// its least, docs/thesis.md, 10; coupled they share it); the closed forms know no inlet starvation.
#include "engine/valve/sliding.h"

#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/contact/rough/persson.h"
#include "engine/valve/breakaway.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// A film with what is drawn of it.
typedef struct {
  SbFilm film;
  SbFilmProfile profile;
  bool fitted;  // on the fitted body, not on the half-plane
  double speed; // [m/s]
} Solved;

enum { IN, OUT, REST }; // ways of sliding

// A fitment with its ring, where it is one, for one way of sliding.
typedef struct {
  SbFit fit;
  SbRing *ring; // owned, NULL for other models
  bool known;
  double pressure; // difference for which it stands
  int seal;
  SbSlidingLaw law; // of the friction that drags it
} Fitment;

struct SbSlidingMemory {
  Fitment fitment[SB_RUN_MOTIONS]; // by way of sliding where friction drags the seal, else at rest
  Fitment *now;                    // of the last evaluation
  Solved plane, fitted;            // on the half-plane (or of a law), and on the fitted body
  Solved rest;                     // dry rough contact, coupled asperities only
  const Solved *last;              // which of them the last evaluation gave
  bool rested;                     // it stands for the fit, with
  double rest_left;                // this pressure on the left
  const Fitment *rest_on;
  SbSlidingBody body;        // of the last film on one
  SbFilmSolver *solver;      // NULL until a film is solved: laws need none
  SbWarnings warnings;       // of one round of a ring's friction
  bool (*cancelled)(void *); // NULL: nobody asks to stop
  void *cancelled_data;
};

typedef SbSlidingTask Task;

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
    for (int i = 0; i < SB_RUN_MOTIONS; i++) {
      sb_ring_destroy(memory->fitment[i].ring);
    }
    free(memory);
  }
}

void sb_sliding_memory_forget(SbSlidingMemory *memory) {
  memory->rested = false;
  for (int i = 0; i < SB_RUN_MOTIONS; i++) {
    memory->fitment[i].known = false;
  }
  memory->last = &memory->plane;
  if (memory->solver != NULL) {
    sb_film_solver_forget(memory->solver);
  }
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

const SbSlidingBody *sb_sliding_body(const SbSlidingMemory *memory) {
  return memory->last->fitted ? &memory->body : NULL;
}

static bool is_ring(const Task *task) {
  return task->model->fit == SB_FIT_RING;
}

// Whether friction drags this seal's section: the ring's, while it slides.
static bool drags(const Task *task) {
  return is_ring(task) && task->speed != 0;
}

void sb_sliding_law(SbSlidingLaw *out, const SbModel *model, const SbSealState *state) {
  double share = isnan(state->asperity_share) ? 1 : state->asperity_share;
  double width = state->contact_right - state->contact_left;
  double viscous = state->friction_viscous / (width * model->bore_circumference);
  *out = (SbSlidingLaw){.coefficient = model->load_coefficient * share,
                        .shear = model->shear_strength * state->real_area_share + viscous};
}

double sb_sliding_shear(double pressure, double *slope, const void *data) {
  const SbSlidingLaw *law = data;
  bool limited = pressure < law->shear;
  *slope = law->coefficient + (limited ? 1 : 0);
  return law->coefficient * pressure + (limited ? pressure : law->shear);
}

// A law's friction on a fitment's contact [N].
static double law_force(const SbSlidingLaw *law, const SbFit *fit) {
  double sum = 0, before = 0, slope;
  for (size_t i = 0; i < fit->profile_count; i++) {
    double now = sb_sliding_shear(fit->profile_p[i], &slope, law);
    sum += i > 0 ? 0.5 * (before + now) * (fit->profile_x[i] - fit->profile_x[i - 1]) : 0;
    before = now;
  }
  return sum * fit->circumference;
}

static bool cancelled(void *data) {
  const SbSlidingMemory *memory = data;
  return memory->cancelled != NULL && memory->cancelled(memory->cancelled_data);
}

// The problem of a task's fitment, dragged by a law where one is given.
static void fit_problem(SbFitProblem *problem, const Task *task, Fitment *on,
                        const SbSlidingLaw *law) {
  SbSlidingMemory *memory = task->memory;
  const SbModel *model = task->model;
  double pressure = task->pressure.left - task->pressure.right;
  sb_model_fit_problem(problem, model, task->seal, pressure);
  problem->cancel = cancelled; // a kept ring asks whoever waits then
  problem->cancel_data = memory;
  // No film lies on a ring at rest, but that of coupled asperities.
  const bool film = model->film == SB_FILM_REYNOLDS && (task->speed != 0 || !is_ring(task));
  problem->surface_wanted = film || model->asperities == SB_MODEL_ASPERITIES_COUPLED;
  problem->kept = &on->ring;
  if (law != NULL) {
    on->law = *law;
    problem->dragged = true;
    problem->drag = (task->speed > 0) == (pressure >= 0) ? 1 : -1;
    problem->shear = sb_sliding_shear;
    problem->law = &on->law;
  }
}

// The task's fitment, anew if it is not the last one of these pressures or a `law` of friction is
// given to drag it.
static SbStatus solve_fit(const Task *task, const SbSlidingLaw *law, SbReport *report) {
  SbSlidingMemory *memory = task->memory;
  double pressure = task->pressure.left - task->pressure.right;
  Fitment *now = &memory->fitment[!drags(task) ? REST : task->speed > 0 ? IN : OUT];
  memory->now = now;
  const bool known = now->known && now->pressure == pressure && now->seal == task->seal;
  if (law == NULL && known) {
    return SB_OK;
  }
  SbFitProblem problem;
  fit_problem(&problem, task, now, law);
  memory->rested = false;
  bool near = law != NULL && known && now->fit.ring.state == SB_RING_SLIDES;
  SbStatus status = near ? sb_fit_again(&now->fit, &problem, report) : SB_ERROR_NOT_CONVERGED;
  status =
      near && status != SB_ERROR_NOT_CONVERGED ? status : sb_fit_solve(&now->fit, &problem, report);
  task->counts->fit_solves++;
  task->counts->disc_solves += problem.model == SB_FIT_DISC || problem.model == SB_FIT_DISC_THESIS;
  task->counts->ring_solves += problem.model == SB_FIT_RING;
  task->counts->newton_iterations += now->fit.solver.newton_iterations;
  now->known = status == SB_OK;
  now->pressure = pressure;
  now->seal = task->seal;
  return status;
}

// One solve of a film, counted.
static SbStatus solve_once(const Task *task, SbFilm *film, const SbFilmProblem *problem,
                           SbReport *report) {
  SbStatus status = sb_film_solve(film, problem, task->memory->solver, report);
  if (problem->model == SB_FILM_REYNOLDS) {
    task->counts->reynolds_solves++;
    task->counts->newton_iterations += (size_t)film->solver.newton_iterations;
  }
  return status;
}

// Share of its speed at which a given film stands for that at the whole of it, 1 where none does.
// Once a flooded film would be several times as thick, nothing but the supply shapes it: what
// passes is given, and the film is twice the layer, but for what pressure moves, which is less the
// faster it goes (2e-4 of it at four times).
static double starved_share(Solved *out, const SbFilmProblem *problem) {
  static const double TIMES = 4, POWER = 0.6; // of a flooded film over the speed
  SbFilmProblem law = *problem;
  law.model = SB_FILM_THESIS;
  law.surface = SB_ROUGH_NONE;
  law.compliance = NULL;
  law.profile = NULL;
  law.inlet_film = 0;
  if (!(problem->inlet_film > 0) || sb_film_solve(&out->film, &law, NULL, NULL) != SB_OK) {
    return 1;
  }
  return fmin(pow(TIMES * 2 * problem->inlet_film / out->film.film_central, 1 / POWER), 1);
}

// Solves a film; where it is given, at the share of its speed that is enough, or lower where the
// solver fails there. How far it then is from twice the layer is added to its error; the
// constriction at the outlet goes on towards that as well, but slowly: it is half way.
static SbStatus solve_supplied(const Task *task, Solved *out, SbFilmProblem *problem,
                               SbReport *report) {
  static const double STEP = 1.0 / 3, LEAST = 1e-3;
  SbFilm *film = &out->film;
  const double speed = problem->speed, first = starved_share(out, problem);
  double share = first;
  problem->speed = share * speed;
  SbStatus status = solve_once(task, film, problem, report);
  if (status == SB_OK && share < 1 && !film->starved) { // the law is far off
    share = 1;
    problem->speed = speed;
    status = solve_once(task, film, problem, report);
  }
  while (status == SB_ERROR_NOT_CONVERGED && problem->inlet_film > 0 && share > LEAST * first) {
    SbReport own = {0};
    share *= STEP;
    problem->speed = share * speed;
    status = solve_once(task, film, problem, &own);
    status = status == SB_OK && !film->starved ? SB_ERROR_NOT_CONVERGED : status;
  }
  problem->speed = speed;
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

static SbStatus solve_on(const Task *task, Solved *out, const SbFilmProblem *problem,
                         SbReport *report) {
  SbSlidingMemory *memory = task->memory;
  bool solved = problem->model == SB_FILM_REYNOLDS;
  if (solved && memory->solver == NULL) {
    SbStatus status = sb_film_solver_create(&memory->solver, report);
    if (status != SB_OK) {
      return status;
    }
  }
  SbFilmProblem lent = *problem;
  lent.profile = &out->profile;
  lent.cancelled = memory->cancelled;
  lent.cancelled_data = memory->cancelled_data;
  out->fitted = problem->compliance != NULL;
  out->speed = problem->speed;
  return solve_supplied(task, out, &lent, report);
}

static void lay_on(SbFilmProblem *problem, const SbSlidingBody *body) {
  problem->compliance = &body->compliance;
  problem->load = body->load;
  problem->modulus = body->compliance.modulus;
}

// The film on the fitted body in place of the half-plane's; false where there is none or it fails.
static bool solve_fitted(const Task *task, Solved *out, const SbFilmProblem *plane) {
  const SbFit *fit = &task->memory->now->fit;
  if (fit->model != SB_FIT_DISC && fit->model != SB_FIT_RING) {
    return false;
  }
  SbReport report = {0};
  SbSlidingBody *body = &task->memory->body;
  SbFilmProblem problem = *plane;
  SbStatus status = sb_sliding_surface(&body->compliance, &body->load, fit, task->model, task->seal,
                                       task->pressure, task->warnings, &report);
  if (status == SB_OK) {
    lay_on(&problem, body);
    status = solve_on(task, out, &problem, &report);
  }
  if (status != SB_OK) {
    sb_warn(task->warnings, "film-half-plane", "models.fit",
            "no film on the fitted %s seal (%s): it is the half-plane's", sb_seal_name(task->seal),
            report.text);
  }
  return status == SB_OK;
}

// A solver that stopped above the tolerance has the figures of its last solution, with their error.
static bool usable(SbStatus status) {
  return status == SB_OK || status == SB_ERROR_NOT_CONVERGED;
}

// A seal's film figures are those of `solved`; NaN stays where the solver stopped before its first
// solution (false).
static bool take_film(SbSealState *out, const Solved *solved, SbStatus status, const SbFit *fit) {
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
static bool has_film(const Task *task) {
  return task->speed != 0 && !(task->supply.limited && !(task->supply.layer > 0));
}

// What a run's options cannot reach, told once.
static void option_warnings(const Task *task, const SbFilmProblem *problem) {
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
static void limit_law(SbSealState *out, const Task *task) {
  out->layer = out->film_central / 2;
  if (task->supply.limited && task->supply.layer < out->layer) {
    out->layer = task->supply.layer;
    out->film_central = 2 * out->layer;
    out->film_min = fmin(out->film_min, out->film_central);
  }
}

static SbStatus solve_film(const Task *task, SbSealState *out, SbReport *report) {
  SbSlidingMemory *memory = task->memory;
  SbFilmProblem problem;
  sb_sliding_film_problem(&problem, task->model, task->seal, task->pressure, out->load_net,
                          task->speed);
  problem.model = task->model->film;
  option_warnings(task, &problem);
  bool solved = problem.model == SB_FILM_REYNOLDS;
  problem.inlet_film = task->supply.limited && solved ? task->supply.layer : 0;
  SbStatus status = solve_on(task, &memory->plane, &problem, report);
  memory->last = &memory->plane;
  if (status == SB_ERROR_CANCELLED || (!solved && !usable(status))) {
    return status;
  }
  if (usable(status)) {
    take_film(out, &memory->plane, status, &memory->now->fit);
  }
  if (solved) {
    out->film_reynolds = out->film_central;
  } else {
    out->film_error = out->central_error = NAN;
    limit_law(out, task);
  }
  // The half-plane may be opened or lost by end pressures that the fitted body bears.
  if (solved && solve_fitted(task, &memory->fitted, &problem)) {
    take_film(out, &memory->fitted, SB_OK, &memory->now->fit);
    memory->last = &memory->fitted;
    status = sb_succeed(report);
  }
  if (!usable(status)) {
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
static SbStatus solve_rough(const Task *task, Solved *out, double load_net, double speed,
                            SbReport *report) {
  const SbModel *model = task->model;
  SbFilmProblem problem;
  sb_sliding_film_problem(&problem, model, task->seal, task->pressure, load_net, speed);
  add_asperities(&problem, model);
  if (speed != 0) {
    problem.inlet_film = task->supply.limited ? task->supply.layer : 0;
    option_warnings(task, &problem);
  }
  return solve_fitted(task, out, &problem) ? SB_OK : solve_on(task, out, &problem, report);
}

// Break-away after the rest before the first stroke.
static SbStatus set_static(SbSealState *out, const Task *task, SbReport *report) {
  SbDwellLaw law;
  SbStatus status =
      sb_breakaway_law(&law, &out->squeeze_out_time, task->model, task->seal, out, report);
  out->friction_static = status == SB_OK ? sb_dwell_at(&law, task->model->rest) : NAN;
  return status;
}

// The thesis' shear strength goes with its own real area.
static void strength_warning(const Task *task, double share) {
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

// Film, rough contact and friction from one solution each, sliding and at rest.
static SbStatus solve_coupled(const Task *task, SbSealState *out, SbReport *report) {
  const SbModel *model = task->model;
  SbSlidingMemory *memory = task->memory;
  SbStatus at_rest = SB_OK;
  if (!memory->rested || memory->rest_on != memory->now ||
      memory->rest_left != task->pressure.left) {
    at_rest = solve_rough(task, &memory->rest, out->load_net, 0, report);
    if (!usable(at_rest)) {
      return at_rest;
    }
    memory->rested = at_rest == SB_OK;
    memory->rest_left = task->pressure.left;
    memory->rest_on = memory->now;
  }
  memory->last = &memory->rest;
  SbStatus status = at_rest;
  if (has_film(task)) {
    memory->last = &memory->plane;
    status = solve_rough(task, &memory->plane, out->load_net, task->speed,
                         at_rest == SB_OK ? report : NULL);
    if (!usable(status)) {
      return status;
    }
  }
  const SbFilm *film = &memory->last->film, *rest = &memory->rest.film;
  sb_warnings_merge(task->warnings, &film->warnings);
  if (take_film(out, memory->last, status, &memory->now->fit)) {
    take_asperities(out, model, &memory->last->film, memory->last->fitted);
  }
  if (memory->rested || rest->film_central > 0) {
    SbSealState dry = *out;
    take_asperities(&dry, model, &memory->rest.film, memory->rest.fitted);
    out->rest_area_share = dry.real_area_share;
    out->rest_area = dry.boundary_area;
    out->rest_load = dry.boundary_load;
    strength_warning(task, out->rest_area_share);
  }
  SbStatus aged = set_static(out, task, status == SB_OK && at_rest == SB_OK ? report : NULL);
  if (aged != SB_OK) {
    return aged;
  }
  out->friction_error = film->solver.error_contact * (out->boundary_area + out->boundary_load) +
                        out->central_error * out->friction_viscous;
  out->static_error = rest->solver.error_contact * out->friction_static;
  return status != SB_OK ? status : at_rest;
}

// Share of the area in real contact, sliding and at rest. Greenwood and Tripp's depends on the
// film, Persson's on the net pressure that the solids must carry.
static SbStatus real_area(SbSealState *out, const Task *task, double roughness, SbReport *report) {
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
static SbStatus rub(SbSealState *out, const Task *task, double roughness, SbReport *report) {
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
static SbStatus rough_contact(SbSealState *out, const Task *task, double roughness,
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

// Leaves of a law's friction what the section bears (bear()).
static SbStatus share_out(SbSealState *out, const Task *task, SbReport *report) {
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

SbStatus sb_sliding_respeed(SbSealState *state, const SbSlidingTask *task,
                            const SbSlidingBody *body, SbReport *report) {
  const SbModel *model = task->model;
  SbSlidingMemory *memory = task->memory;
  const bool coupled = model->asperities == SB_MODEL_ASPERITIES_COUPLED;
  SbFilmProblem problem;
  sb_sliding_film_of(&problem, state, task, body);
  const bool solved = problem.model == SB_FILM_REYNOLDS;
  Solved *on = body != NULL ? &memory->fitted : &memory->plane;
  memory->last = on;
  SbStatus status = solve_on(task, on, &problem, report);
  if (!usable(status) || !(on->film.film_central > 0)) {
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
  SbStatus status =
      state->touches ? rough_contact(state, task, roughness, report) : sb_succeed(report);
  status = status == SB_OK ? share_out(state, task, report) : status;
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

// Contact and loads of a seal that touches.
static void take_contact(SbSealState *out, const Task *task, const SbFit *fit) {
  SbSealPressure pressure = task->pressure;
  out->contact_left = fit->contact_left;
  out->contact_right = fit->contact_right;
  out->load = fit->load;
  out->load_per_length = fit->load_per_length;
  out->pressure_peak = fit->pressure_peak;
  // Closed forms that know no pressure give the rubber's share alone: nothing to take off.
  bool holds_fluid = fit->model != SB_FIT_HERTZ && fit->model != SB_FIT_LINDLEY &&
                     fit->model != SB_FIT_GREEN_ENGLISH;
  double fluid = fabs(pressure.left - pressure.right) * fit->contact_width / 2;
  out->load_net = fit->load_per_length - (holds_fluid ? fluid : 0);
  if (fit->model == SB_FIT_RING) {
    double way = task->speed < 0 ? -1 : 1;
    out->rotation = way * (pressure.left < pressure.right ? -1 : 1) * fit->ring.turn * 180 / M_PI;
    out->section = fit->ring.state;
  }
}

// Fitment: contact and loads. *known tells whether there is a contact to go on with.
static SbStatus fit_contact(const Task *task, const SbSlidingLaw *law, SbSealState *out,
                            bool *known, SbReport *report) {
  (void)sb_succeed(report);
  sb_sliding_clear(out);
  *known = false;
  // The fit takes the difference; the common part only shifts the fluid's level.
  SbStatus status = solve_fit(task, law, report);
  if (!usable(status)) {
    return status;
  }
  const SbFit *fit = &task->memory->now->fit;
  if (!drags(task) || fit->ring.state == SB_RING_SLIDES || fit->ring.state == SB_RING_NO_CONTACT) {
    sb_warnings_merge(task->warnings, &fit->warnings); // else solve_dragged() tells
  }
  // One that stopped above the tolerance counts, with its error; else it holds another load's.
  bool close = fit->solver.error_estimate.load > 0 && fit->solver.error_estimate.load < 1;
  out->touches = fit->touches || status != SB_OK;
  if (status != SB_OK && !(fit->touches && close)) {
    return status;
  }
  if (!fit->touches) {
    out->section = SB_RING_NO_CONTACT;
    out->contact_left = out->contact_right = 0;
    out->load = out->load_per_length = out->load_net = out->pressure_peak = 0;
    out->boundary_area = out->boundary_load = out->friction_viscous = out->friction_static = 0;
    out->rest_area = out->rest_load = 0;
    return status;
  }
  take_contact(out, task, fit);
  *known = true;
  return status;
}

// Fitment, film and friction; a ring dragged as given, else as it is known.
static SbStatus solve_with(const Task *task, const SbSlidingLaw *law, SbSealState *out,
                           SbReport *report) {
  SbWarnings *warnings = task->warnings;
  int seal = task->seal;
  bool known;
  SbStatus status = fit_contact(task, law, out, &known, report);
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
    if (!usable(film)) {
      return film;
    }
    status = film != SB_OK ? film : status;
  }

  SbStatus area_status = rough_contact(out, task, 1, status == SB_OK ? report : NULL);
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

// The friction of a contact by closed forms, near that of a ring; none where they have none.
static void guess(SbSlidingLaw *law, const Task *task, Fitment *on) {
  SbFitProblem fit;
  SbFilmProblem film;
  SbSealState state;
  Task quiet = *task;
  quiet.warnings = NULL;
  *law = (SbSlidingLaw){0};
  sb_model_fit_problem(&fit, task->model, task->seal, task->pressure.left - task->pressure.right);
  fit.model = SB_FIT_KARASZKIEWICZ;
  sb_sliding_clear(&state);
  if (sb_fit_solve(&on->fit, &fit, NULL) != SB_OK || !on->fit.touches) {
    return;
  }
  take_contact(&state, task, &on->fit);
  sb_sliding_film_problem(&film, task->model, task->seal, task->pressure, state.load_net,
                          task->speed);
  film.model = SB_FILM_THESIS;
  if (solve_on(&quiet, &task->memory->plane, &film, NULL) == SB_OK) {
    state.film_central = task->memory->plane.film.film_central;
    SbSlidingLaw found;
    if (rough_contact(&state, &quiet, 1, NULL) == SB_OK) {
      sb_sliding_law(&found, task->model, &state);
      *law = isfinite(found.shear) ? found : *law;
    }
  }
}

// What the dragged section bears of the law's friction: all of it while it slides, each part alike
// at the greatest drag of one that rolls or jams, which no rest makes greater.
static SbStatus bear(SbSealState *out, const Task *task, const Fitment *on, double asked,
                     SbReport *report) {
  const SbFit *fit = &on->fit;
  double area = asked - out->boundary_load - out->friction_viscous;
  out->area_cut = out->boundary_area > 0 ? area / out->boundary_area : 1;
  out->borne_share = fabs(fit->ring.drag) / asked;
  return share_out(out, task, report);
}

// Without fluid a ring that slides one way is the mirror image of one that slides the other way.
// False where that is not known.
static bool mirror(const Task *task, Fitment *on) {
  const Fitment *other = &task->memory->fitment[task->speed > 0 ? OUT : IN];
  if (task->pressure.left != task->pressure.right || !other->known || other->pressure != 0 ||
      other->seal != task->seal) {
    return false;
  }
  SbFitProblem problem;
  fit_problem(&problem, task, on, &other->law);
  on->known = sb_fit_mirror(&on->fit, &problem, &other->fit, other->ring, NULL) == SB_OK;
  on->pressure = 0;
  on->seal = task->seal;
  return on->known;
}

// A ring's states: friction drags it, and hangs on the film that lies on the dragged ring. Solved
// in turns until the friction that drags it is that of its own film. A ring whose greatest drag is
// less than its friction rolls or jams; the film is then that of this last state.
static SbStatus solve_dragged(const Task *task, SbSealState *out, SbReport *report) {
  enum { ROUNDS = 6 };
  const double close = 0.5 * task->model->tolerance;
  const double pressure = task->pressure.left - task->pressure.right;
  SbSlidingMemory *memory = task->memory;
  Fitment *on = &memory->fitment[task->speed > 0 ? IN : OUT];
  bool known =
      (on->known && on->pressure == pressure && on->seal == task->seal) || mirror(task, on);
  SbSlidingLaw law;
  if (!known) {
    guess(&law, task, on);
  }
  SbWarnings *own = &memory->warnings;
  SbStatus status = SB_OK;
  for (int round = 0;; round++) {
    Task like = *task;
    memset(own, 0, sizeof *own); // of the last round
    own->subject = task->warnings != NULL ? task->warnings->subject : NULL;
    like.warnings = own;
    status = solve_with(&like, known && round == 0 ? NULL : &law, out, report);
    if (!usable(status) || !(out->load > 0)) {
      break;
    }
    sb_sliding_law(&law, task->model, out);
    double asked = law_force(&law, &on->fit), before = law_force(&on->law, &on->fit);
    if (!isfinite(asked)) {
      break;
    }
    bool slides = on->fit.ring.state == SB_RING_SLIDES;
    bool agree = slides ? fabs(asked - before) <= close * asked
                        : asked >= (1 - close) * fabs(on->fit.ring.drag);
    if (!agree && round + 1 < ROUNDS) {
      continue;
    }
    SbStatus borne = bear(out, &like, on, asked, status == SB_OK ? report : NULL);
    status = borne != SB_OK ? borne : status;
    if (!agree) {
      status = sb_fail(report, SB_ERROR_NOT_CONVERGED,
                       "fitment and friction of the %s seal do not agree: %.5g N and %.5g N",
                       sb_seal_name(task->seal), before, asked);
    } else if (!slides) {
      bool rolls = on->fit.ring.state == SB_RING_ROLLS;
      sb_warn(own, rolls ? "ring-rolls" : "ring-jams", "gland.floor_friction",
              "the %s ring %s %s: its section bears %.0f %% of its friction, turned by %.0f°",
              sb_seal_name(task->seal), rolls ? "rolls" : "jams",
              task->speed > 0 ? "on the in-stroke" : "on the return", 100 * out->borne_share,
              out->rotation);
    }
    break;
  }
  sb_warnings_merge(task->warnings, own);
  return status;
}

static SbStatus solve(const Task *task, SbSealState *out, SbReport *report) {
  return drags(task) ? solve_dragged(task, out, report) : solve_with(task, NULL, out, report);
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
  SbStatus status = fit_contact(task, NULL, out, &known, report);
  sb_warn_about(task->warnings, NULL);
  return status;
}
