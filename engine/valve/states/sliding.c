// Joins fitment, film, surface and friction for one seal; see sliding.h for the equations.
#include "engine/valve/states/sliding_private.h"

#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/contact/rough/persson.h"
#include "engine/valve/states/breakaway.h"

#include <math.h>
#include <stdlib.h>

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
    for (int i = 0; i < memory->stored_count; i++) {
      sb_sliding_slopes_destroy(memory->stored[i].slopes);
      sb_ring_guide_destroy(memory->stored[i].guide);
      sb_ring_tangent_destroy(memory->stored[i].tangent);
      sb_ring_destroy(memory->stored[i].ring);
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

void sb_sliding_memory_store(SbSlidingMemory *memory) {
  memory->stores = true;
}

void sb_sliding_memory_end(SbSlidingMemory *memory) {
  for (int way = 0; way < SB_RUN_MOTIONS; way++) {
    sb_sliding_store(memory, way);
  }
  memory->stores = false;
}

void sb_sliding_memory_start(SbSlidingMemory *memory, const SbSlidingMemory *from, bool tangent,
                             bool drawn) {
  memory->from = from;
  memory->tangent = tangent;
  memory->summed = tangent && !drawn;
}

void sb_sliding_memory_prefetched(SbSlidingMemory *memory, SbSlidingMemory *ahead) {
  memory->prefetched = ahead;
}

void sb_sliding_memory_rings(SbSlidingMemory *memory, SbRingsBeside how) {
  memory->rings = how;
}

void sb_sliding_memory_poll(SbSlidingMemory *memory, bool (*cancelled)(void *), void *data) {
  memory->cancelled = cancelled;
  memory->cancelled_data = data;
}

const SbFit *sb_sliding_fit(const SbSlidingMemory *memory) {
  return &memory->now->fit;
}

const SbRing *sb_sliding_ring(const SbSlidingMemory *memory) {
  return sb_fit_kind(memory->now->fit.model)->section ? memory->now->ring : NULL;
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

// A solver that stopped above the tolerance has the figures of its last solution, with their error.
bool sb_sliding_usable(SbStatus status) {
  return status == SB_OK || status == SB_ERROR_NOT_CONVERGED;
}

// Static friction after the dwell before the first stroke.
static SbStatus set_static(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  SbDwellLaw law;
  SbStatus status = sb_breakaway_law(&law, &out->squeeze_out_time, task->model, task->seal, out,
                                     sb_sliding_rough_law(task), report);
  out->friction_static = status == SB_OK ? sb_dwell_at(&law, task->model->rest) : NAN;
  return status;
}

double sb_sliding_squeeze_error(const SbSealState *state, const SbSlidingTask *task) {
  double error;
  const SbStatus status = sb_breakaway_squeeze_error(&error, task->model, task->seal, state,
                                                     sb_sliding_rough_law(task), NULL);
  return status == SB_OK ? error : NAN;
}

// Warns that the thesis' shear strength was determined with its own real area.
static void strength_warning(const SbSlidingTask *task, double share) {
  const SbModel *model = task->model;
  const bool thesis = model->set == SB_MODEL_SET_THESIS;
  if (model->surface == SB_ROUGH_PERSSON && thesis &&
      !model->params.given[SB_P_FRICTION_SHEAR_STRENGTH]) {
    sb_warn(
        task->warnings, "persson-shear-strength", sb_input(SB_P_FRICTION_SHEAR_STRENGTH),
        "Persson's real contact is %.0f %% here; the default shear strength was set with Greenwood "
        "and Tripp's few per cent",
        100 * share);
  }
}

// Takes the asperities' results from a film. Lengths are divided by the contact width of the
// half-plane, or of the fitted body; forces are those of the fitted circumference.
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

// Solves the dry rough contact of a coupled state at rest. It remains valid as long as the fit
// does.
static SbStatus solve_rest(const SbSlidingTask *task, const SbSealState *out, SbReport *report) {
  SbSlidingMemory *memory = task->memory;
  if (memory->rested && memory->rest_on == memory->now &&
      memory->rest_left == task->pressure.left) {
    return sb_succeed(report);
  }
  SbStatus status = sb_sliding_solve_rough(task, &memory->rest, out->load_net, 0, report);
  if (sb_sliding_usable(status)) {
    memory->rested = status == SB_OK;
    memory->rest_left = task->pressure.left;
    memory->rest_on = memory->now;
  }
  return status;
}

// Sets static_error from the errors of real area at rest, width and load.
static void set_static_error(SbSealState *out) {
  const double area = out->rest_area * (out->rest_error + out->width_error);
  const double level = out->rest_area + out->rest_load;
  out->static_error =
      level > 0 ? out->friction_static * (area + out->rest_load * out->load_error) / level : 0;
}

void sb_sliding_kinetic_errors(SbSealState *out, double borne) {
  const double film = isnan(out->central_error) ? 0 : out->central_error;
  out->boundary_error = out->boundary_area * (out->area_error + out->width_error) +
                        out->boundary_load * (out->load_error + borne);
  out->viscous_error = out->friction_viscous * (film + out->width_error);
  out->friction_error = out->boundary_error + out->viscous_error;
}

// Takes the results of that contact, and static friction.
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
  // Real area is in proportion to the mean pressure of the solid at most.
  out->rest_error = rest->solver.error_contact + out->net_error + out->width_error;
  set_static_error(out);
  out->static_error += rest->solver.error_contact * out->rest_load;
  return status;
}

// Sets the errors of a state whose film has its asperities, from those of its contact and loads.
static void set_coupled_errors(SbSealState *out, const SbSlidingMemory *memory) {
  const SbSlidingSolved *last = memory->last;
  const SbFit *fit = &memory->now->fit;
  const double contact = last->film.solver.error_contact;
  // The surface on which a solid section's film was solved moves that film, and with it the load
  // that the film leaves to the asperities.
  const bool section = last->fitted && sb_fit_kind(fit->model)->section;
  const double surface = section ? sb_sliding_surface_error(out, last, fit) : 0;
  out->share_error = contact + out->net_error + out->width_error + surface;
  out->area_error = contact + out->net_error + out->width_error;
  sb_sliding_kinetic_errors(out, contact);
}

// Film, rough contact and friction from one solution each, sliding and at rest.
static SbStatus solve_coupled(const SbSlidingTask *task, SbSealState *out, SbReport *report) {
  SbSlidingMemory *memory = task->memory;
  const bool slides = sb_sliding_has_film(task), rests = !(slides && memory->rest_waits);
  SbStatus at_rest = rests ? solve_rest(task, out, report) : SB_OK;
  if (!sb_sliding_usable(at_rest)) {
    return at_rest;
  }
  memory->last = &memory->rest;
  SbStatus status = at_rest;
  if (slides) {
    memory->last = &memory->plane;
    status = sb_sliding_solve_rough(task, &memory->plane, out->load_net, task->speed,
                                    at_rest == SB_OK ? report : NULL);
    if (!sb_sliding_usable(status)) {
      return status;
    }
  }
  const SbFilm *film = &memory->last->film;
  sb_warnings_merge(task->warnings, &film->warnings);
  if (sb_sliding_read_film(out, memory->last, status, &memory->now->fit)) {
    take_asperities(out, task->model, film, memory->last->fitted);
  }
  if (rests) {
    SbStatus aged = take_rest(out, task, status == SB_OK && at_rest == SB_OK ? report : NULL);
    if (aged != SB_OK) {
      return aged;
    }
  }
  set_coupled_errors(out, memory);
  return status != SB_OK ? status : at_rest;
}

// Fraction of the area in real contact, sliding and at rest. Greenwood and Tripp's depends on the
// film, Persson's on the net pressure that the solids carry.
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
    const double error = out->net_error + out->width_error;
    if (error > 0) {
      const double other =
          sb_persson_area_share(&spectrum, spectrum.q1, surface.modulus, pressure * (1 + error));
      out->area_error = out->rest_error = fabs(other / out->real_area_share - 1);
    }
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
  if (out->central_error > 0) {
    const double thinner = sb_rough_area_share(&surface, out->lambda * (1 - out->central_error));
    out->area_error = fabs(thinner / out->real_area_share - 1);
  }
  if (isnan(out->real_area_share) && !isnan(out->lambda)) {
    return sb_fail(report, SB_ERROR_RANGE, "no asperity contact of the %s seal at λ = %g",
                   sb_seal_name(task->seal), out->lambda);
  }
  if (out->real_area_share > 0.3) {
    sb_warn(
        task->warnings, "real-area-large", SB_FILM_IN_ASPERITY_PRODUCT,
        "asperities of the %s seal touch on %.0f %% of the area: Greenwood and Tripp's asperities "
        "are no longer independent",
        sb_seal_name(task->seal), 100 * out->real_area_share);
  }
  return SB_OK;
}

// Computes real area and kinetic friction of a sliding contact whose load, width and film are
// known.
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
  }
  sb_sliding_kinetic_errors(out, 0);
  return SB_OK;
}

// Does the same, and computes the values at rest.
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
  status = set_static(out, task, report);
  set_static_error(out);
  return status;
}

// Reduces a law's kinetic friction to what the section carries. Where the pressure limits the shear
// there is no full real contact, and the film's shear is limited in the same proportion; a rolling
// section is not sheared fully.
static void share_kinetic(SbSealState *out) {
  if (!isnan(out->borne_share)) {
    out->real_area_share *= out->area_cut * (out->section == SB_RING_SLIDES ? out->borne_share : 1);
    out->boundary_area *= out->area_cut * out->borne_share;
    // Where the pressure limits the shear, near the contact's ends, the area is proportional to the
    // width.
    out->area_error += out->area_cut < 1 ? out->width_error : 0;
    out->boundary_load *= out->borne_share;
    out->friction_viscous *= out->area_cut * out->borne_share;
    out->boundary_error *= out->borne_share;
    out->viscous_error *= out->area_cut * out->borne_share;
    out->friction_error *= out->borne_share;
  }
}

void sb_sliding_full_friction(SbSealState *state) {
  const double slides = state->section == SB_RING_SLIDES ? state->borne_share : 1;
  if (state->borne_share > 0 && state->area_cut > 0) {
    state->real_area_share /= state->area_cut * slides;
    state->boundary_load /= state->borne_share;
    state->friction_viscous /= state->area_cut * state->borne_share;
  }
}

// Reduces a law's friction to what the section carries (bear()).
SbStatus sb_sliding_share_out(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  if (isnan(out->borne_share)) {
    return SB_OK;
  }
  out->rest_area_share *= out->area_cut;
  out->rest_error += out->area_cut < 1 ? out->width_error : 0;
  out->rest_area *= out->area_cut; // the pressure limits it as well
  share_kinetic(out);
  if (out->section == SB_RING_SLIDES) {
    return set_static(out, task, report);
  }
  out->rest_area = out->boundary_area;
  out->rest_load = out->boundary_load;
  out->friction_static = sb_sliding_friction(out);
  out->static_error = out->friction_error;
  return SB_OK;
}

static const char *about(int seal) {
  return seal == SB_OUTER ? "outer seal" : "inner seal";
}

// A film that cannot be, because the fluid opens the contact, is a result, not a failure. Otherwise
// passes on the report.
static SbStatus opened_by_fluid(SbSealState *out, SbStatus status, const SbReport *own, int seal,
                                SbWarnings *warnings, SbReport *report) {
  if (status == SB_OK || own->cause != SB_CAUSE_FLUID_OPENS) {
    if (status != SB_OK && report != NULL) {
      *report = *own;
    }
    return status;
  }
  out->opened = true;
  sb_warn(warnings, "film-opened", sb_input(SB_P_CANISTER_PRESSURE),
          "the fluid's pressure opens the contact of the %s seal: there is no film in it",
          sb_seal_name(seal));
  return SB_OK;
}

SbStatus sb_sliding_rest(const SbSlidingTask *task, SbSealState *out, SbReport *report) {
  if (task->model->asperities != SB_MODEL_ASPERITIES_COUPLED || !(out->load_net > 0) ||
      task->model->kind == SB_VALVE_GASKET || out->opened || !sb_sliding_has_film(task)) {
    return SB_OK;
  }
  SbReport own = {0};
  SbStatus at_rest = solve_rest(task, out, &own);
  SbStatus status =
      sb_sliding_usable(at_rest) ? take_rest(out, task, at_rest == SB_OK ? &own : NULL) : at_rest;
  status = status == SB_OK ? at_rest : status;
  return opened_by_fluid(out, status, &own, task->seal, task->warnings, report);
}

void sb_sliding_set_film(SbSealState *state, const SbSlidingTask *task, const SbFilm *film,
                         bool fitted, double roughness) {
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
  if (model->kind == SB_VALVE_GASKET) {
    memory->last = &memory->plane;
    sb_sliding_edge_film(state, task);
    return sb_sliding_refilm(state, task, 1, report);
  }
  SbFilmProblem problem;
  sb_sliding_film_of(&problem, state, task, body);
  const bool solved = sb_film_kind(problem.model)->coupled;
  SbSlidingSolved *on = body != NULL ? &memory->fitted : &memory->plane;
  memory->last = on;
  memory->near = true;
  SbStatus status = sb_sliding_solve_on(task, on, &problem, report);
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
  if (coupled) {
    take_asperities(state, model, &on->film, on->fitted);
  }
  SbStatus rubbed = sb_sliding_refilm(state, task, 1, report);
  return rubbed != SB_OK ? rubbed : status;
}

SbStatus sb_sliding_refilm(SbSealState *state, const SbSlidingTask *task, double roughness,
                           SbReport *report) {
  const SbModel *model = task->model;
  // The state at rest has no film either, whatever the speed.
  const SbSealState rest = *state;
  if (model->kind == SB_VALVE_GASKET) {
    SbStatus edges = sb_sliding_edge_contact(state, task, roughness, report);
    state->rest_area_share = rest.rest_area_share;
    state->rest_area = rest.rest_area;
    state->rest_load = rest.rest_load;
    share_kinetic(state);
    return edges;
  }
  if (model->asperities == SB_MODEL_ASPERITIES_COUPLED) {
    state->lambda = state->film_central / model->sigma;
    state->boundary_area = model->shear_strength * state->real_area_share *
                           (state->contact_right - state->contact_left) * model->bore_circumference;
    share_kinetic(state);
    return sb_succeed(report);
  }
  SbStatus status = rub(state, task, roughness, report);
  state->rest_area_share = rest.rest_area_share;
  share_kinetic(state);
  return status;
}

SbStatus sb_sliding_resurface(SbSealState *state, const SbSlidingTask *task, double roughness,
                              SbReport *report) {
  sb_warn_about(task->warnings, about(task->seal));
  SbStatus status = SB_OK;
  if (state->touches && task->model->kind == SB_VALVE_GASKET) {
    status = sb_sliding_edge_contact(state, task, roughness, report);
    status = status == SB_OK ? set_static(state, task, report) : status;
    set_static_error(state);
  } else if (state->touches) {
    status = sb_sliding_rough_contact(state, task, roughness, report);
  }
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
#include "engine/valve/figures/figures.def"
}

// Film and rough contact of a gasket.
static SbStatus solve_edges(const SbSlidingTask *task, SbSealState *out, SbReport *report) {
  sb_sliding_edge_film(out, task);
  SbStatus status = sb_sliding_edge_contact(out, task, 1, report);
  status = status == SB_OK ? set_static(out, task, report) : status;
  set_static_error(out);
  return status;
}

SbStatus sb_sliding_update_errors(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  SbSlidingTask quiet = *task;
  quiet.warnings = NULL;
  const SbModel *model = task->model;
  const SbSlidingMemory *memory = task->memory;
  const bool coupled = model->asperities == SB_MODEL_ASPERITIES_COUPLED && out->load_net > 0;
  sb_sliding_net_error(out, task, &memory->now->fit);
  if (model->kind == SB_VALVE_GASKET && out->load_net > 0) {
    return solve_edges(&quiet, out, report);
  }
  if (out->film_central > 0 && (coupled || sb_film_kind(model->film)->coupled)) {
    sb_sliding_film_errors(out, memory->last, &memory->now->fit);
  } else if (out->film_central > 0) {
    sb_sliding_law_errors(out);
  }
  if (coupled) {
    set_coupled_errors(out, memory);
    return SB_OK;
  }
  return sb_sliding_rough_contact(out, &quiet, 1, report);
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
  SbReport *first = status == SB_OK ? report : NULL; // the first failure is reported
  if (task->model->kind == SB_VALVE_GASKET && out->load_net > 0) {
    sb_sliding_set_edges(out, &task->memory->now->fit);
    task->memory->last = &task->memory->plane; // which has none
    SbStatus edges = solve_edges(task, out, first);
    return edges != SB_OK ? edges : status;
  }
  if (task->model->asperities == SB_MODEL_ASPERITIES_COUPLED && out->load_net > 0) {
    SbStatus coupled = solve_coupled(task, out, &own);
    coupled = opened_by_fluid(out, coupled, &own, seal, warnings, first);
    return coupled != SB_OK ? coupled : status;
  }

  // Film, only when sliding on a liquid.
  if (!sb_sliding_has_film(task)) {
    out->film_min = out->film_central = out->layer = 0;
  } else if (out->load_net <= 0) {
    out->opened = true;
    sb_warn(warnings, "film-no-net-load", sb_input(SB_P_CANISTER_PRESSURE),
            "the fluid alone carries the %s seal: no film law applies", sb_seal_name(seal));
  } else {
    SbStatus film = sb_sliding_solve_film(task, out, &own);
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
    sb_warn(warnings, "boundary-regime", sb_input(SB_P_SURFACE_SIGMA),
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
    SbStatus status = sb_sliding_sum(task, known || law != NULL ? &by : NULL, start->slopes);
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
