// The speed of the steady states of a run.
//
// The thesis' machine has one speed, and drive.speed is it. A finger, a spring, a sinusoid have
// none: how fast the stem slides follows from the friction, which is known over the speed
// (run_speeds.c). Profiles and figures are those of the stem's speed at the middle of B-C, found by
// running the motion without frames. Solved rings take seconds: their profiles are those of that
// speed in the same valve with the thesis' closed forms, and only the figures of its own; where the
// section is no circle, which closed forms do not know, they are those of drive.speed.
#include "engine/valve/figures/figures.h"
#include "engine/valve/run/run_private.h"

#include <string.h>

// Speed of the same valve with closed forms, for a run of solved rings.
static SbStatus proxy_speed(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  static const SbOverride closed[] = {{SB_P_MODELS_FIT, SB_FIT_KARASZKIEWICZ},
                                      {SB_P_MODELS_FILM, SB_FILM_THESIS}};
  SbModel *model;
  SbRun *proxy = NULL;
  SbStatus status = sb_model_derive(&model, run->model, closed, 2, report);
  status = status == SB_OK ? sb_run_create(&proxy, model, &run->plan, report) : status;
  sb_model_destroy(model);
  if (status != SB_OK) {
    return status;
  }
  proxy->work = run->work;
  SbPlan *plan = &proxy->plan;
  plan->ring = plan->section_fields = plan->profiles = plan->film_history = false;
  status = sb_run_solve_states(proxy, hooks, report);
  run->speed = proxy->speed;
  sb_run_destroy(proxy);
  return status == SB_ERROR_CANCELLED ? status : SB_OK;
}

bool sb_run_finds_speed(const SbRun *run) {
  return run->plan.motion && run->plan.inertia && run->model->drive != SB_MODEL_DRIVE_MACHINE;
}

SbStatus sb_run_solve_states(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  const SbModel *model = run->model;
  SbWarnings *warnings = &run->summary.warnings;
  SbStatus status = SB_OK;
  run->speed = model->speed;
  const bool own = sb_run_finds_speed(run);
  if (own && run->plan.ring && model->profile == SB_SEAL_PROFILE_CIRCLE) {
    status = proxy_speed(run, hooks, report);
  }
  // The states only append warnings (sb_warnings_merge()).
  const size_t before = warnings->count, dropped = warnings->dropped;
  status = status == SB_OK ? sb_run_solve_all(run, hooks, report) : status;
  run->mid_speed = run->back_speed = run->speed;
  if (!own || (status != SB_OK && status != SB_ERROR_NOT_CONVERGED) || run->lacks.status != SB_OK) {
    return status;
  }
  double speed;
  bool slips;
  SbReport cause;
  SbStatus motion = sb_run_dynamic_speed(&speed, &slips, run, hooks, &cause);
  if (motion == SB_ERROR_CANCELLED) {
    return sb_fail(report, motion, "cancelled");
  }
  if (motion != SB_OK && run->work->spent) { // other errors are reported by the run's own motion
    return sb_fail_input(
        report, motion, cause.input,
        "motion (for the speed of the films), both seals: %s; available: the seals "
        "at drive.speed, %.3g mm/s",
        cause.text, 1e3 * run->speed);
  }
  if (speed == 0 && slips) {
    sb_warn(warnings, "film-speed", sb_input(SB_P_DRIVE_SPEED),
            "the stem does not pass two stages, so its speed is not defined: the seals' figures "
            "are those "
            "at drive.speed, %.3g mm/s",
            1e3 * run->speed);
  }
  run->back_speed = run->back_speed > 0 ? run->back_speed : run->speed;
  run->mid_speed = speed > 0 ? speed : run->speed;
  if (!run->plan.ring && run->mid_speed != run->speed) {
    run->speed = run->mid_speed;
    warnings->count = before;
    warnings->dropped = dropped;
    status = sb_run_solve_all(run, hooks, report);
  }
  return status;
}

// A life changes them, and a stem that finds its own speed has them at another.
void sb_run_store_states(SbRun *run, SbStatus status) {
  const SbPlan *plan = &run->plan;
  const bool own = plan->inertia && run->model->drive != SB_MODEL_DRIVE_MACHINE;
  SbRunSolved *out = &run->solved;
  const SbSummary *summary = &run->summary;
  out->solved = status == SB_OK && !own && !plan->life && !plan->profiles && !plan->film_history;
  if (out->solved) {
    out->cycle = run->cycle;
    memcpy(out->friction_error, run->friction_error, sizeof out->friction_error);
    memcpy(out->static_error, run->static_error, sizeof out->static_error);
    out->error_film = summary->error_film;
    out->error_load = summary->error_load;
    out->error_width = summary->error_width;
    out->lacks = run->lacks;
    out->counters = summary->counters;
    out->warnings = summary->warnings;
  }
}

void sb_run_restore_states(SbRun *run) {
  const SbRunSolved *from = &run->solved;
  SbSummary *summary = &run->summary;
  run->cycle = from->cycle;
  run->cycle.model = run->model;
  memcpy(run->friction_error, from->friction_error, sizeof run->friction_error);
  memcpy(run->static_error, from->static_error, sizeof run->static_error);
  summary->error_film = from->error_film;
  summary->error_load = from->error_load;
  summary->error_width = from->error_width;
  run->lacks = from->lacks;
  summary->counters = from->counters;
  summary->warnings = from->warnings;
  SbSpeedStates *const *table = &run->speeds[0][0][0];
  for (size_t i = 0; i < sizeof run->speeds / sizeof *table; i++) {
    if (table[i] != NULL) {
      table[i]->task.model = run->model;
    }
  }
}
