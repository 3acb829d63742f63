// A ring's film with its asperities in it (models.asperities = coupled): both carry the load
// together. A row of contact_law.c; equations in sliding.h and film/ehl.h.
#include "engine/valve/states/sliding_private.h"

#include <math.h>

// Lengths are divided by the contact width of the half-plane, or of the fitted body; forces are
// those of the fitted circumference.
void sb_coupled_take(SbSealState *out, const SbModel *model, const SbFilm *film, bool fitted) {
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

// Takes the results of that contact, and static friction.
static SbStatus take_rest(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  const SbSlidingMemory *memory = task->memory;
  const SbFilm *rest = &memory->rest.film;
  if (memory->rested || rest->film_central > 0) {
    SbSealState dry = *out;
    sb_coupled_take(&dry, task->model, rest, memory->rest.fitted);
    out->rest_area_share = dry.real_area_share;
    out->rest_area = dry.boundary_area;
    out->rest_load = dry.boundary_load;
    sb_sliding_warn_strength(task, out->rest_area_share);
  }
  SbStatus status = sb_sliding_set_static(out, task, report);
  // Real area is in proportion to the mean pressure of the solid at most.
  out->rest_error = rest->solver.error_contact + out->net_error + out->width_error;
  sb_sliding_set_static_error(out);
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
static SbStatus solve(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
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
    sb_coupled_take(out, task->model, film, memory->last->fitted);
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

SbStatus sb_coupled_solve(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  SbReport own = {0};
  SbStatus status = solve(out, task, &own);
  return sb_sliding_opened_by_fluid(out, status, &own, task->seal, task->warnings, report);
}

SbStatus sb_coupled_rest(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  SbStatus at_rest = solve_rest(task, out, report);
  SbStatus status =
      sb_sliding_usable(at_rest) ? take_rest(out, task, at_rest == SB_OK ? report : NULL) : at_rest;
  return status == SB_OK ? at_rest : status;
}

SbStatus sb_coupled_refilm(SbSealState *state, const SbSlidingTask *task, double roughness,
                           SbReport *report) {
  const SbModel *model = task->model;
  (void)roughness; // the asperities of the film's own solution
  state->lambda = state->film_central / model->sigma;
  state->boundary_area = model->shear_strength * state->real_area_share *
                         (state->contact_right - state->contact_left) * model->bore_circumference;
  return sb_succeed(report);
}

SbStatus sb_coupled_update_errors(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  const SbSlidingMemory *memory = task->memory;
  (void)report;
  if (out->film_central > 0) {
    sb_sliding_film_errors(out, memory->last, &memory->now->fit);
  }
  set_coupled_errors(out, memory);
  return SB_OK;
}
