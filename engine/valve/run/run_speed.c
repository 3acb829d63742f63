// The sliding speed that a run's films stand for.
//
// The thesis' machine has one speed, and drive.speed is it. A finger, a spring, a sinusoid have
// none: how fast the stem slides follows from the friction, and the friction, weakly, from that
// speed. The sliding states are therefore solved at the stem's mean speed from B to C, found by
// running the motion without frames, again with the states of that speed, until both agree to 1 %.
// A film grows with speed to the power 0.54 to 0.65 and boundary friction hardly at all, so two or
// three rounds do. Solved rings take seconds a round: for them the speed is that of the same valve
// with the thesis' closed forms.
//
// Around that speed a frame's film follows its own speed by the law's exponent (equations 7.5, 7.6;
// 0.6 for solved films, docs/thesis.md, 3), and the viscous force is linear in the speed. Left out:
// that the boundary share, too, falls a little where the stem is faster than there.
#include "engine/valve/run/run_private.h"

#include <math.h>

// Power of the speed in the film's law.
static double exponent(SbFilmModel film) {
  switch (film) {
  case SB_FILM_THESIS:
    return 0.5434;
  case SB_FILM_KARASZKIEWICZ:
    return 0.65;
  default:
    return 0.6;
  }
}

// Speed of the same valve with closed forms, for the run's speed.
static SbStatus proxy_speed(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  SbModel model = run->model;
  model.fit = SB_FIT_KARASZKIEWICZ;
  model.film = SB_FILM_THESIS;
  SbRun *proxy;
  SbStatus status = sb_run_create(&proxy, &model, &run->plan, report);
  if (status != SB_OK) {
    return status;
  }
  SbPlan *plan = &proxy->plan;
  plan->ring = plan->section_fields = plan->profiles = plan->film_history = false;
  status = sb_run_solve_states_at_speed(proxy, hooks, report);
  run->speed = proxy->speed;
  run->film_exponent = proxy->film_exponent > 0 ? exponent(run->model.film) : 0;
  sb_run_destroy(proxy);
  return status == SB_ERROR_CANCELLED ? status : SB_OK;
}

SbStatus sb_run_solve_states_at_speed(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  enum { ROUNDS = 8 };
  const SbModel *model = &run->model;
  SbWarnings *warnings = &run->summary.warnings;
  run->speed = model->speed;
  run->film_exponent = 0;
  bool own = run->plan.motion && model->motion != SB_MODEL_MOTION_QUASI_STATIC &&
             model->drive != SB_MODEL_DRIVE_MACHINE;
  if (own && run->plan.ring) {
    SbStatus status = proxy_speed(run, hooks, report);
    return status != SB_OK ? status : sb_run_solve_states(run, hooks, report);
  }
  SbWarnings before = *warnings;
  SbStatus status = sb_run_solve_states(run, hooks, report);
  for (int round = 0; own && round < ROUNDS; round++) {
    double speed;
    bool slips;
    if ((status != SB_OK && status != SB_ERROR_NOT_CONVERGED) || run->lacks[0] != '\0') {
      return status;
    }
    // What goes wrong with the motion is told by the run itself.
    SbStatus motion = sb_run_dynamic_speed(&speed, &slips, run, hooks, NULL);
    if (motion == SB_ERROR_CANCELLED) {
      return sb_fail(report, motion, "cancelled");
    }
    if (speed == 0 && slips) {
      sb_warn(warnings, "film-speed", "drive.speed",
              "the stem passes no two stages that would tell its speed: films and viscous friction "
              "are those at drive.speed, %.3g mm/s",
              1e3 * run->speed);
    }
    if (!(speed > 0)) {
      break;
    }
    run->film_exponent = exponent(model->film);
    if (fabs(speed - run->speed) <= 0.01 * run->speed) {
      break;
    }
    run->speed = speed;
    *warnings = before;
    status = sb_run_solve_states(run, hooks, report);
  }
  return status;
}
