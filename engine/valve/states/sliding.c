// Joins fitment, film, surface and friction for one seal; see sliding.h for the equations.
#include "engine/valve/states/sliding_private.h"

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

SbStatus sb_sliding_set_static(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
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

void sb_sliding_warn_strength(const SbSlidingTask *task, double share) {
  const SbModel *model = task->model;
  const bool thesis = model->set == SB_MODEL_SET_THESIS;
  if (sb_rough_kind(model->surface)->spectrum && thesis &&
      !model->params.given[SB_P_FRICTION_SHEAR_STRENGTH]) {
    sb_warn(
        task->warnings, "persson-shear-strength", sb_input(SB_P_FRICTION_SHEAR_STRENGTH),
        "Persson's real contact is %.0f %% here; the default shear strength was set with Greenwood "
        "and Tripp's few per cent",
        100 * share);
  }
}

void sb_sliding_set_static_error(SbSealState *out) {
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

// Reduces a law's kinetic friction to what the section carries. Where the pressure limits the shear
// there is no full real contact, and the film's shear is limited in the same proportion; a rolling
// section is not sheared fully.
static void share_kinetic(SbSealState *out) {
  if (!isnan(out->borne_share)) {
    // The drag of a section that slides is that of its own film to the tolerance only, and may be
    // larger; area_error has the difference. No more than the whole contact is in real contact.
    const double carried = out->section == SB_RING_SLIDES ? out->borne_share : 1;
    out->real_area_share = fmin(out->real_area_share * (out->area_cut * carried), 1);
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
    return sb_sliding_set_static(out, task, report);
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

SbStatus sb_sliding_opened_by_fluid(SbSealState *out, SbStatus status, const SbReport *own,
                                    int seal, SbWarnings *warnings, SbReport *report) {
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
  const SbContactLaw *law = sb_contact_law(task->model);
  if (law->rest == NULL || !(out->load_net > 0) || out->opened || !sb_sliding_has_film(task)) {
    return SB_OK;
  }
  SbReport own = {0};
  SbStatus status = law->rest(out, task, &own);
  return sb_sliding_opened_by_fluid(out, status, &own, task->seal, task->warnings, report);
}

void sb_sliding_set_film(SbSealState *state, const SbSlidingTask *task, const SbFilm *film,
                         bool fitted, double roughness) {
  const SbContactLaw *law = sb_contact_law(task->model);
  state->film_min = film->film_min;
  state->film_central = film->film_central;
  if (law->take != NULL) {
    law->take(state, task->model, film, fitted);
  }
  (void)sb_sliding_refilm(state, task, roughness, NULL);
}

SbStatus sb_sliding_respeed(SbSealState *state, const SbSlidingTask *task,
                            const SbSlidingBody *body, SbReport *report) {
  return sb_contact_law(task->model)->respeed(state, task, body, report);
}

SbStatus sb_sliding_refilm(SbSealState *state, const SbSlidingTask *task, double roughness,
                           SbReport *report) {
  // The state at rest has no film either, whatever the speed.
  const SbSealState rest = *state;
  SbStatus status = sb_contact_law(task->model)->refilm(state, task, roughness, report);
  state->rest_area_share = rest.rest_area_share;
  state->rest_area = rest.rest_area;
  state->rest_load = rest.rest_load;
  if (status != SB_OK) { // those of the film before are not its own
    state->lambda = state->real_area_share = NAN;
    state->boundary_area = state->boundary_load = state->friction_viscous = NAN;
  }
  share_kinetic(state);
  return status;
}

SbStatus sb_sliding_resurface(SbSealState *state, const SbSlidingTask *task, double roughness,
                              SbReport *report) {
  sb_warn_about(task->warnings, about(task->seal));
  SbStatus status = state->touches
                        ? sb_contact_law(task->model)->resurface(state, task, roughness, report)
                        : SB_OK;
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

SbStatus sb_sliding_update_errors(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  SbSlidingTask quiet = *task;
  quiet.warnings = NULL;
  sb_sliding_net_error(out, task, &task->memory->now->fit);
  return sb_contact_law_of(task->model, out)->update_errors(out, &quiet, report);
}

// Fitment, film and friction; a ring dragged as given, else as it is known.
SbStatus sb_sliding_solve_once(const SbSlidingTask *task, const SbSlidingLaw *law, SbSealState *out,
                               SbReport *report) {
  bool known;
  SbStatus status = sb_sliding_fit_contact(task, law, out, &known, report);
  if (!known) {
    return status;
  }
  // The first failure is reported.
  SbStatus own =
      sb_contact_law_of(task->model, out)->solve(out, task, status == SB_OK ? report : NULL);
  return own != SB_OK ? own : status;
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
