// One seal's fitment.
#include "engine/valve/states/sliding_private.h"

#include <float.h>
#include <math.h>
#include <string.h>

static bool is_ring(const SbSlidingTask *task) {
  return sb_fit_kind(task->model->fit)->section;
}

// Returns whether friction drags this seal's section: the ring's, while it slides.
bool sb_sliding_drags(const SbSlidingTask *task) {
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

static bool cancelled(void *data) {
  const SbSlidingMemory *memory = data;
  return memory->cancelled != NULL && memory->cancelled(memory->cancelled_data);
}

void sb_sliding_store(SbSlidingMemory *memory, int way) {
  SbSlidingFitment *on = &memory->fitment[way];
  const SbFit *fit = &on->fit;
  const bool apart = fit->ring.state == SB_RING_NO_CONTACT;
  if (!memory->stores || !on->known || on->ring == NULL || !sb_fit_kind(fit->model)->section ||
      (fit->ring.state != SB_RING_SLIDES && !apart) || memory->stored_count == SB_SLIDING_STARTS) {
    return;
  }
  SbSlidingStart *stored = &memory->stored[memory->stored_count];
  *stored = (SbSlidingStart){.start = {.error_load = fit->solver.error_estimate.load,
                                       .error_peak = fit->solver.error_estimate.pressure_peak,
                                       .error_width = fit->solver.error_estimate.contact_width,
                                       .ring = on->ring},
                             .ring = on->ring,
                             .way = way,
                             .strain = on->pressure / on->modulus,
                             .law = on->law,
                             .found = on->found,
                             .guess = on->guess,
                             .pull = on->pull};
  sb_ring_set_data(stored->ring, &stored->law, memory);
  if (apart) { // there is nothing to start from
    stored->ring = NULL;
    stored->start.ring = NULL;
    memory->stored_count++;
    return;
  }
  stored->slopes = sb_sliding_slopes_create();
  if (stored->slopes == NULL || sb_ring_guide_create(&stored->guide, on->ring, NULL) != SB_OK ||
      sb_ring_tangent_create(&stored->tangent, on->ring, &stored->law, NULL) != SB_OK) {
    sb_ring_guide_destroy(stored->guide);
    sb_sliding_slopes_destroy(stored->slopes);
    return;
  }
  stored->start.guide = stored->guide;
  memory->stored_count++;
  on->ring = NULL;
  on->known = false;
}

void sb_sliding_memory_prepare(const SbSlidingMemory *memory, bool (*stop)(void *), void *data) {
  for (int i = 0; i < memory->stored_count && !stop(data); i++) {
    const SbSlidingStart *stored = &memory->stored[i];
    if (stored->guide != NULL && stored->way != SB_WAY_REST) {
      sb_ring_guide_make(stored->guide);
    }
  }
}

int sb_sliding_way(const SbSlidingTask *task) {
  return !sb_sliding_drags(task) ? SB_WAY_REST : task->speed > 0 ? SB_WAY_IN : SB_WAY_OUT;
}

const SbSlidingStart *sb_sliding_start_of(const SbSlidingTask *task) {
  const SbSlidingMemory *from = task->memory->from;
  const double strain =
      (task->pressure.left - task->pressure.right) / task->model->seal[task->seal].modulus;
  const SbSlidingStart *best = NULL;
  for (int i = 0; from != NULL && is_ring(task) && i < from->stored_count; i++) {
    const SbSlidingStart *one = &from->stored[i];
    const bool alike = (one->ring != NULL || task->memory->tangent) &&
                       one->way == sb_sliding_way(task) && (one->strain > 0) == (strain > 0) &&
                       (one->strain < 0) == (strain < 0);
    if (alike && (best == NULL || fabs(one->strain - strain) < fabs(best->strain - strain))) {
      best = one;
    }
  }
  return best;
}

void sb_sliding_fit_problem(SbFitProblem *problem, const SbSlidingTask *task, SbSlidingFitment *on,
                            const SbSlidingLaw *law) {
  SbSlidingMemory *memory = task->memory;
  const SbModel *model = task->model;
  double pressure = task->pressure.left - task->pressure.right;
  sb_model_fit_problem(problem, model, task->seal, pressure);
  problem->cancel = cancelled; // a stored ring polls the memory that uses it then
  problem->cancel_data = memory;
  // A ring at rest has no film, except with coupled asperities.
  const bool film = sb_film_kind(model->film)->coupled && (task->speed != 0 || !is_ring(task));
  problem->surface_wanted = !memory->bare && (film || sb_contact_law(model)->shares);
  problem->kept = &on->ring;
  if (law != NULL) {
    on->law = *law;
    problem->dragged = true;
    problem->drag = (task->speed > 0) == (pressure >= 0) ? 1 : -1;
    problem->shear = sb_sliding_shear;
    problem->law = &on->law;
  }
}

void sb_sliding_forget_fitment(const SbSlidingTask *task) {
  task->memory->fitment[sb_sliding_way(task)].known = false;
  task->memory->rested = false;
}

SbStatus sb_sliding_no_tangent(const SbSlidingTask *task, SbSlidingFitment *on, SbReport *report) {
  on->known = false;
  memset(&on->fit, 0, sizeof on->fit);
  return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                 "no tangent of a ring that rolls or jams at the base");
}

// Takes a ring that was solved ahead for this law.
static bool take_ahead(const SbSlidingTask *task, SbSlidingFitment *now, const SbSlidingLaw *law) {
  SbSlidingMemory *memory = task->memory;
  SbSlidingFitment *from =
      memory->prefetched != NULL ? &memory->prefetched->fitment[sb_sliding_way(task)] : NULL;
  if (from == NULL || !from->known || from->seal != now->seal || from->pressure != now->pressure ||
      (law != NULL &&
       (law->coefficient != from->law.coefficient || law->shear != from->law.shear))) {
    return false;
  }
  sb_ring_destroy(now->ring);
  now->ring = from->ring;
  from->ring = NULL;
  from->known = false;
  now->fit = from->fit;
  if (law != NULL) {
    now->law = *law;
  }
  sb_ring_set_data(now->ring, law != NULL ? &now->law : NULL, memory);
  now->why = (SbReport){0};
  now->known = true;
  task->counts->fit_solves++;
  task->counts->ring_solves++;
  task->counts->newton_iterations += now->fit.solver.newton_iterations;
  return true;
}

// Solves the task's fit, unless it is the last one at these pressures and no friction `law` is
// given to drag it.
static SbStatus solve_fit(const SbSlidingTask *task, const SbSlidingLaw *law, SbReport *report) {
  SbSlidingMemory *memory = task->memory;
  double pressure = task->pressure.left - task->pressure.right;
  SbSlidingFitment *now = &memory->fitment[sb_sliding_way(task)];
  memory->now = now;
  const bool same = now->pressure == pressure && now->seal == task->seal;
  const bool known = now->known && same;
  if (law == NULL && same && now->why.status == SB_ERROR_NOT_CONVERGED) {
    if (report != NULL) {
      *report = now->why;
    }
    return now->why.status;
  }
  if (law == NULL && known) {
    return SB_OK;
  }
  if (!known) {
    sb_sliding_store(memory, sb_sliding_way(task));
  }
  const SbSlidingStart *start = sb_sliding_start_of(task);
  SbFitProblem problem;
  sb_sliding_fit_problem(&problem, task, now, law);
  SbFitStart from = start != NULL ? start->start : (SbFitStart){0};
  from.tangent = memory->tangent && start != NULL ? start->tangent : NULL;
  from.beside = memory->rings == SB_RINGS_SOLVED;
  problem.start = from.ring != NULL ? &from : NULL;
  memory->rested = false;
  if (memory->tangent && is_ring(task) && start == NULL) {
    return sb_sliding_no_tangent(task, now, report);
  }
  now->pressure = pressure;
  now->modulus = task->model->seal[task->seal].modulus;
  now->seal = task->seal;
  if (memory->sums != SB_SUM_NOTHING) {
    now->fit = memory->sum.fit;
    now->known = true;
    (void)sb_succeed(&now->why);
    return sb_succeed(report);
  }
  if (!known && take_ahead(task, now, law)) {
    return sb_succeed(report);
  }
  bool near = law != NULL && known && now->fit.ring.state == SB_RING_SLIDES && !memory->tangent;
  SbReport own = {0};
  SbStatus status = near ? sb_fit_again(&now->fit, &problem, &own) : SB_ERROR_NOT_CONVERGED;
  status =
      near && status != SB_ERROR_NOT_CONVERGED ? status : sb_fit_solve(&now->fit, &problem, &own);
  if (report != NULL) {
    *report = own;
  }
  now->why = law == NULL ? own : (SbReport){0};
  task->counts->fit_solves++;
  const SbFitKind *kind = sb_fit_kind(problem.model);
  task->counts->disc_solves += kind->points && !kind->section;
  task->counts->ring_solves += kind->section;
  task->counts->newton_iterations += now->fit.solver.newton_iterations;
  now->known = status == SB_OK;
  return status;
}

// Returns the fluid's part of a load per length under pressure.
static double fluid_of(const SbSlidingTask *task, const SbFit *fit) {
  return fabs(task->pressure.left - task->pressure.right) * fit->contact_width / 2;
}

void sb_sliding_net_error(SbSealState *out, const SbSlidingTask *task, const SbFit *fit) {
  // A difference: the errors of its terms add up.
  out->net_error =
      (fit->load_per_length * out->load_error + fluid_of(task, fit) * out->width_error) /
      fmax(fabs(out->load_net), 1e-300);
}

// Sets contact and loads of a seal with contact.
static void take_contact(SbSealState *out, const SbSlidingTask *task, const SbFit *fit) {
  SbSealPressure pressure = task->pressure;
  out->contact_left = fit->contact_left;
  out->contact_right = fit->contact_right;
  out->load = fit->load;
  out->load_per_length = fit->load_per_length;
  out->pressure_peak = fit->pressure_peak;
  const double fluid = sb_fit_kind(fit->model)->fluid ? fluid_of(task, fit) : 0;
  out->load_net = fit->load_per_length - fluid;
  out->load_error = fit->solver.error_estimate.load;
  out->width_error = fit->solver.error_estimate.contact_width;
  out->peak_error = fit->solver.error_estimate.pressure_peak;
  sb_sliding_net_error(out, task, fit);
  if (sb_fit_kind(fit->model)->section) {
    double way = task->speed < 0 ? -1 : 1;
    out->rotation = way * (pressure.left < pressure.right ? -1 : 1) * fit->ring.turn * 180 / M_PI;
    out->section = fit->ring.state;
  }
}

// Fit: contact and loads. *known: there is a contact.
SbStatus sb_sliding_fit_contact(const SbSlidingTask *task, const SbSlidingLaw *law,
                                SbSealState *out, bool *known, SbReport *report) {
  (void)sb_succeed(report);
  sb_sliding_clear(out);
  *known = false;
  // The fit takes the difference; the common part only shifts the fluid's level.
  SbReport own = {0};
  SbStatus status = solve_fit(task, law, &own);
  const bool passed = status != SB_OK && own.cause == SB_CAUSE_FLUID_PASSES;
  if (passed) { // a result: the gasket is open
    sb_warn(task->warnings, "gasket-passed", own.input, "%s", own.text);
    memset(&task->memory->now->fit, 0, sizeof task->memory->now->fit);
    task->memory->now->known = false;
    status = SB_OK;
  } else if (status != SB_OK && report != NULL) {
    *report = own;
  }
  if (!sb_sliding_usable(status)) {
    return status;
  }
  const SbFit *fit = &task->memory->now->fit;
  if (!sb_sliding_drags(task) || fit->ring.state == SB_RING_SLIDES ||
      fit->ring.state == SB_RING_NO_CONTACT) {
    sb_warnings_merge(task->warnings, &fit->warnings); // else sb_sliding_drag() warns
  }
  // A fit that stopped above the tolerance counts, with its error; a larger error means that it is
  // that of another load.
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

const SbRing *sb_sliding_ring_of(const SbSlidingTask *task) {
  const SbSlidingFitment *on = &task->memory->fitment[sb_sliding_way(task)];
  const bool same = on->known && on->seal == task->seal &&
                    on->pressure == task->pressure.left - task->pressure.right;
  return same && sb_fit_kind(on->fit.model)->section ? on->ring : NULL;
}

void sb_sliding_guess(SbSlidingLaw *law, const SbSlidingTask *task, SbSlidingFitment *on) {
  SbFitProblem fit;
  SbFilmProblem film;
  SbSealState state;
  SbSlidingTask quiet = *task;
  quiet.warnings = NULL;
  *law = (SbSlidingLaw){0};
  sb_model_fit_problem(&fit, task->model, task->seal, task->pressure.left - task->pressure.right);
  fit.model = SB_FIT_KARASZKIEWICZ;
  fit.fitted_section = false; // the formula's own range
  sb_sliding_clear(&state);
  if (sb_fit_solve(&on->fit, &fit, NULL) != SB_OK || !on->fit.touches) {
    return;
  }
  take_contact(&state, task, &on->fit);
  sb_sliding_film_problem(&film, task->model, task->seal, task->pressure, state.load_net,
                          task->speed);
  film.model = SB_FILM_THESIS;
  if (sb_sliding_solve_on(&quiet, &task->memory->plane, &film, NULL) == SB_OK) {
    state.film_central = task->memory->plane.film.film_central;
    SbSlidingLaw found;
    if (sb_sliding_rough_contact(&state, &quiet, 1, NULL) == SB_OK) {
      sb_sliding_law(&found, task->model, &state);
      *law = isfinite(found.shear) ? found : *law;
    }
  }
}

static double ratio(double now, double then) {
  const double is = now / then;
  return isfinite(is) && is > 0 ? is : 1;
}

SbSlidingLaw sb_sliding_first_law(const SbSlidingTask *task, SbSlidingFitment *on,
                                  const SbSlidingStart *start) {
  sb_sliding_guess(&on->guess, task, on);
  if (start == NULL) {
    return on->guess;
  }
  return (SbSlidingLaw){.coefficient = start->law.coefficient *
                                       ratio(on->guess.coefficient, start->guess.coefficient),
                        .shear = start->law.shear * ratio(on->guess.shear, start->guess.shear)};
}

void sb_sliding_prefetch(const SbSlidingTask *task, const SbSlidingMemory *like) {
  SbSlidingMemory *memory = task->memory;
  const bool drags = sb_sliding_drags(task);
  // Without fluid it may be the mirror image of a ring that slides in the opposite direction.
  if (!is_ring(task) || like->tangent || (drags && task->pressure.left == task->pressure.right)) {
    return;
  }
  memory->from = like->from;
  const SbSlidingStart *start = sb_sliding_start_of(task);
  SbSlidingLaw law;
  if (drags) {
    law = sb_sliding_first_law(task, &memory->fitment[sb_sliding_way(task)], start);
  }
  (void)solve_fit(task, drags ? &law : NULL, NULL);
}
