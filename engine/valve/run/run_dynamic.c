// Frames and figures of the motion with inertia: the valve (run_valve.c) given to
// motion/dynamics.h, in one pass.
//
// The motion is found from event to event; a frame is an evaluation of it at its time, and one more
// sits on every stage, filled just before the event changes anything. Frames are evenly spaced
// while something drives; what still moves then (a stem that creeps home) is followed with steps
// that grow with the time since, until it rests.
//
// Where the motion has no closed form (the land's edge under the contact, friction that depends on
// speed, a chamber that fills) it is solved step by step to output.motion_tolerance, and the same
// motion at ten times that tolerance tells the error: with break-away in the cycle a sum of local
// errors says little. Radau IIA is of order 5 in its step, so that errors fall about in proportion
// to the tolerance (tested: test_run_limits.c).
#include "engine/valve/run/run_dynamic.h"

#include "engine/film/stroke.h"
#include "engine/valve/figures.h"

#include <math.h>

// Instants at which a motion without frames halts: for a cancel, no more.
enum { WITHOUT_FRAMES = 9 };

typedef struct {
  SbRun *run;
  SbValve *valve;
  const SbDynamics *motion;
  bool frames;   // record them; a run for the error estimate does not
  size_t count;  // frames written
  SbStage stage; // last passed
  bool passed[SB_STAGE_COUNT];
  double force[SB_STAGE_COUNT]; // at the stages
  double time[SB_STAGE_COUNT], place[SB_STAGE_COUNT];
  int direction; // of the last sliding
  bool stopped;  // the stem touches the end stop
  double turn;   // time after which a reverse slip is the return [s]
  double force_peak, leak, leak_from, leak_since;
  double return_least; // least force that pushed the stem out while it slid back [N]
  double carried;      // film dragged along, whichever way
  double home;         // time at which the stem is back on its rest stop, 0: not yet
  bool slips;          // some contact has slid
  SbStatus status;     // of the frames' reactions
  SbReport *report;
} Recorder;

// Film at a speed over that of the states, by the law's exponent about it.
static double film_at(const SbRun *run, double speed) {
  return run->film_exponent > 0 ? pow(fabs(speed) / run->speed, run->film_exponent) : 1;
}

// Film dragged along since the last call, at the film of the present state and of the mean speed.
static void leak(Recorder *r, double time, double x, double pressure) {
  int direction = x > r->leak_from ? SB_CYCLE_IN : SB_CYCLE_OUT;
  const SbSliding *outer = sb_valve_state(r->valve, SB_OUTER, direction, pressure);
  double way = x - r->leak_from;
  double speed = time > r->leak_since ? way / (time - r->leak_since) : r->run->speed;
  double film = outer->film_central * film_at(r->run, speed);
  double volume = sb_leak_stroke(r->run->model.bore_diameter, film, way);
  r->leak += volume;
  r->carried += fabs(volume);
  r->leak_from = x;
  r->leak_since = time;
}

// Adds a frame of the motion as it is now.
static SbFrame *add_frame(Recorder *r) {
  SbDynamicsSample sample;
  sb_dynamics_sample(r->motion, &sample, NULL);
  double pressure = sb_valve_chamber_pressure(r->valve, sample.extra);
  leak(r, sample.time, sample.position, pressure);
  r->force_peak = fmax(r->force_peak, sample.drive_force);
  if (!r->frames || r->count == r->run->capacity) {
    return NULL;
  }
  SbFrame *out = &r->run->frames[r->count++];
  *out = (SbFrame){
      .time = sample.time,
      .displacement = sample.position,
      .velocity = sample.speed,
      .platen = sample.drive_position,
      .force = sample.drive_force,
      .pressure_force = r->run->model.pressure_force,
      .stop_force = sample.stop_force[SB_END_STOP] - sample.stop_force[SB_REST_STOP],
      .spring_force = -sample.spring_force,
      .chamber_pressure = pressure,
      .stage = (uint8_t)r->stage,
      .chamber = (uint8_t)r->valve->chamber,
  };
  if (r->run->bodies != NULL && r->status == SB_OK) {
    r->status = sb_run_bodies_frame(r->run, r->count - 1, &sample, r->report);
  }
  bool moving = sample.speed != 0;
  int direction = moving ? (sample.speed > 0 ? SB_CYCLE_IN : SB_CYCLE_OUT) : r->direction;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    sb_valve_fill_seal(&out->seal[seal], r->valve, seal, direction, moving, sample.position,
                       pressure);
    double film = film_at(r->run, sample.speed);
    out->seal[seal].film_min *= film;
    out->seal[seal].film_central *= film;
    out->seal[seal].lambda *= film;
    out->seal[seal].friction = -sample.friction[seal];
    out->seal[seal].friction_viscous = -sample.viscous[seal];
    out->seal[seal].friction_boundary = sample.viscous[seal] - sample.friction[seal];
  }
  return out;
}

// The first time of each stage counts. Its frame shows the state just before the event.
static void mark(Recorder *r, SbStage stage, const SbMotionEvent *event) {
  if (r->passed[stage]) {
    return;
  }
  r->passed[stage] = true;
  r->time[stage] = event->time;
  r->place[stage] = event->position;
  r->force[stage] = event->drive_force;
  SbFrame *frame = add_frame(r);
  if (frame != NULL) {
    frame->on_event = 1;
    frame->velocity = event->speed;
    sb_run_mark_stage(r->run, stage, frame, r->count - 1);
  }
  r->stage = stage;
}

// Whether any seal rubs here.
static bool rubs(const Recorder *r) {
  SbDynamicsSample sample;
  sb_dynamics_sample(r->motion, &sample, NULL);
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    if (sample.contact[seal] != SB_CONTACT_OFF) {
      return true;
    }
  }
  return false;
}

// Pressure and spring less friction of a stem that slides back. Events see the greatest speeds of a
// return that nothing holds: at the land's edge and at the rest stop.
static void note_return(Recorder *r) {
  SbDynamicsSample sample;
  sb_dynamics_sample(r->motion, &sample, NULL);
  double force = -sample.loads_force - sample.spring_force;
  bool slides = sample.speed < 0;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    slides = slides && sample.contact[seal] != SB_CONTACT_STUCK;
    force -= sample.friction[seal];
  }
  r->return_least = slides ? fmin(r->return_least, force) : r->return_least;
}

static void valve_event(const SbMotionEvent *event, void *user) {
  Recorder *r = user;
  SbValve *valve = r->valve;
  if (r->passed[SB_STAGE_E] && event->speed < 0) {
    note_return(r);
  }
  r->force_peak = fmax(r->force_peak, event->drive_force);
  switch (event->kind) {
  case SB_MOTION_SLIP:
    r->slips = true;
    if (event->sign > 0 && r->stage == SB_STAGE_A) {
      mark(r, SB_STAGE_B, event);
    } else if (event->sign < 0 && event->time >= r->turn && !r->stopped) {
      mark(r, SB_STAGE_E, event);
    }
    r->direction = event->sign > 0 ? SB_CYCLE_IN : SB_CYCLE_OUT;
    break;
  case SB_MOTION_EDGE: {
    SbDynamicsSample sample;
    sb_dynamics_sample(r->motion, &sample, NULL);
    leak(r, sample.time, sample.position, sb_valve_chamber_pressure(valve, sample.extra));
    double edge = valve->edge[event->index];
    if (valve->touches && edge == r->run->model.land_edge && event->sign > 0 &&
        r->stage == SB_STAGE_B) {
      mark(r, SB_STAGE_C, event);
    } else if (valve->touches && edge == valve->edge_closed && event->sign < 0 &&
               event->time >= r->turn && valve->chamber != SB_CHAMBER_AT_REST) {
      // A rebound that passes the edge on the way in is no return.
      mark(r, SB_STAGE_F, event);
    }
    break;
  }
  case SB_MOTION_TOUCH_STOP:
    if (event->index == SB_END_STOP) {
      r->stopped = true;
      mark(r, SB_STAGE_D, event);
    } else if (r->passed[SB_STAGE_E] && r->home == 0) {
      r->home = event->time;
    }
    break;
  case SB_MOTION_LEAVE_STOP:
    if (event->index == SB_END_STOP) {
      // While the stop unloads it takes the stem back with it by a micrometre or two; the stem's
      // own way back begins here.
      r->stopped = false;
      if (event->time >= r->turn) {
        mark(r, SB_STAGE_E, event);
      }
    } else if (!rubs(r) && r->stage == SB_STAGE_A) {
      // Without friction nothing slips: the stem starts where it leaves its stop.
      mark(r, SB_STAGE_B, event);
    }
    break;
  default:
    break;
  }
}

// How far behind the drive's end the motion is followed: as long again, ten seconds at least.
static double patience(double drive) {
  return drive + fmax(drive, 10);
}

// Runs the motion to its end. The recorder's valve and model are freshly made by the caller.
static SbStatus run_motion(Recorder *r, SbDynamics *motion, const SbDynamicsModel *model,
                           const SbRunHooks *hooks, SbReport *report) {
  SbRun *run = r->run;
  SbStatus status = sb_dynamics_init(motion, model, report);
  if (status != SB_OK) {
    return status;
  }
  r->motion = motion;
  r->report = report;
  r->leak_from = model->start_position;
  r->return_least = INFINITY;
  const SbDriveTimes times = sb_drive_times(run);
  r->turn = times.turn;
  sb_dynamics_listen(motion, valve_event, r);
  double drive = times.duration;
  size_t total = (size_t)run->model.frames;
  if (!r->frames) {
    total = WITHOUT_FRAMES;
  }
  double step = drive / (double)(total - 1);
  int corner = 0;
  size_t next = 1;
  double time = 0;
  SbFrame *first = add_frame(r);
  if (first != NULL) {
    sb_run_mark_stage(run, SB_STAGE_A, first, 0);
  }
  while (status == SB_OK) {
    if (next == total &&
        (times.ends_run || sb_dynamics_at_rest(motion) || time >= patience(drive))) {
      break;
    }
    // The next even instant or a corner of the drive before it; behind the drive, wider and wider.
    double even = next < total ? (next + 1 == total ? drive : (double)next * step)
                               : time + fmax(step, (time - drive) / 32);
    double turn = sb_drive_corner(&times, corner);
    if (turn < even) {
      corner++;
    } else if (next < total) {
      next++;
    }
    corner += turn == even;
    time = fmin(turn, even);
    status = sb_dynamics_advance(motion, time, report);
    add_frame(r);
    status = status != SB_OK ? status : r->status;
    if (r->count % 64 == 0 || !r->frames) {
      if (r->frames) {
        sb_run_publish(run, r->count);
      }
      if (sb_run_cancelled(hooks, report)) {
        return SB_ERROR_CANCELLED;
      }
      if (r->count % 4096 == 0 && r->frames) {
        sb_run_progress(run, hooks, (double)next / (double)total, r->count);
      }
    }
  }
  r->force_peak = fmax(r->force_peak, motion->force_peak);
  return status;
}

static double relative(double a, double b, double scale) {
  return scale > 0 ? fabs(a - b) / scale : 0;
}

// Sets a motion up whose warnings are told elsewhere.
static SbStatus set_up_again(SbDynamicsModel *model, SbValve *valve, SbRun *run, SbReport *report) {
  SbWarnings *warnings = &run->summary.warnings;
  size_t count = warnings->count, dropped = warnings->dropped;
  SbStatus status = sb_valve_set_up(model, valve, run, report);
  warnings->count = count;
  warnings->dropped = dropped;
  return status;
}

// The same motion at ten times the tolerance. With errors in proportion to the power 5/6 of the
// tolerance (order 5 in the step, order 6 locally) the difference is 5.8 times the error of the
// fine motion; a half of it is told, three times as much as that, and never less than the
// tolerance: the coarse motion may be right by chance.
static SbStatus estimate_error(SbRun *run, const Recorder *fine, const SbDynamicsEnergy *energy,
                               double *force, double *work, const SbRunHooks *hooks,
                               SbReport *report) {
  SbDynamics motion;
  SbDynamicsModel model;
  SbValve valve;
  Recorder coarse = {.run = run, .valve = &valve};
  SbStatus status = set_up_again(&model, &valve, run, report);
  if (status != SB_OK) {
    return status;
  }
  model.tolerance = fmin(10 * model.tolerance, 1e-5);
  status = run_motion(&coarse, &motion, &model, hooks, report);
  if (status != SB_OK) {
    return status;
  }
  SbDynamicsEnergy other;
  sb_dynamics_sample(&motion, NULL, &other);
  double share = 0.5 * fmax(1, run->model.motion_tolerance * 10 / model.tolerance);
  *force = relative(fine->force_peak, coarse.force_peak, fine->force_peak);
  for (int stage = 0; stage < SB_STAGE_COUNT; stage++) {
    *force = fmax(*force, relative(fine->force[stage], coarse.force[stage], fine->force_peak));
  }
  if (isfinite(fine->return_least) && isfinite(coarse.return_least)) {
    *force = fmax(*force, relative(fine->return_least, coarse.return_least,
                                   fmax(fine->force_peak, run->model.pressure_force)));
  }
  *force = fmax(share * *force, run->model.motion_tolerance);
  *work = fmax(run->model.motion_tolerance,
               share * fmax(relative(energy->drive, other.drive, energy->largest),
                            relative(energy->friction, other.friction, energy->largest)));
  return SB_OK;
}

void sb_run_fill_motion(SbSummary *summary, const SbDynamicsEnergy *energy,
                        const SbDynamicsCounters *counters) {
  summary->energy = (SbEnergy){
      .external = energy->drive + energy->pressure,
      .external_max = energy->largest,
      .friction = energy->friction + energy->viscous,
      .stored = energy->stored,
      .seal = energy->seal + energy->machine,
      .kinetic = energy->kinetic,
      .stop = energy->stop,
      .loop = energy->drive - energy->machine,
      .closure = energy->closure,
  };
  summary->steps = (size_t)(counters->segments + counters->steps);
  summary->rejected_steps = (size_t)counters->rejected;
}

SbStatus sb_run_dynamic_speed(double *speed, bool *slips, SbRun *run, const SbRunHooks *hooks,
                              SbReport *report) {
  static const struct {
    SbStage from, to;
  } way[] = {{SB_STAGE_B, SB_STAGE_C}, {SB_STAGE_B, SB_STAGE_D}, {SB_STAGE_E, SB_STAGE_F}};
  SbDynamics motion;
  SbDynamicsModel model;
  SbValve valve;
  Recorder recorder = {.run = run, .valve = &valve};
  *speed = 0;
  SbStatus status = set_up_again(&model, &valve, run, report);
  if (status == SB_OK) {
    status = run_motion(&recorder, &motion, &model, hooks, report);
  }
  *slips = recorder.slips;
  for (int i = 0; i < 3 && *speed == 0; i++) {
    double time = recorder.time[way[i].to] - recorder.time[way[i].from];
    if (recorder.passed[way[i].from] && recorder.passed[way[i].to] && time > 0) {
      *speed = fabs(recorder.place[way[i].to] - recorder.place[way[i].from]) / time;
    }
  }
  if (*speed == 0 && recorder.home > recorder.time[SB_STAGE_E]) {
    *speed = recorder.place[SB_STAGE_E] / (recorder.home - recorder.time[SB_STAGE_E]);
  }
  if (*speed == 0 && *slips && run->model.drive == SB_MODEL_DRIVE_SINUSOID) {
    *speed = 4 * run->model.amplitude * run->model.frequency;
  }
  return status;
}

SbStatus sb_run_dynamic(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  SbSummary *summary = &run->summary;
  SbDynamicsModel model;
  SbValve valve;
  sb_run_bodies_destroy(run->bodies);
  run->bodies = NULL;
  SbStatus status = run->plan.bodies ? sb_run_bodies_create(run, report) : SB_OK;
  status = status != SB_OK ? status : sb_valve_set_up(&model, &valve, run, report);
  if (status != SB_OK) {
    return status;
  }
  summary->force_return_min =
      sb_cycle_least_return(&run->cycle, run->model.stroke, SB_CHAMBER_OPEN, true) +
      run->model.spring_preload;
  if (run->model.stribeck_speed > 0) {
    // Slow sliding rubs nearly as rest does, on both seals.
    summary->force_return_min = fmin(
        summary->force_return_min,
        sb_cycle_least_return(&run->cycle, 0, SB_CHAMBER_CLOSED, true) + run->model.spring_preload);
  }
  SbDynamics motion = {0};
  Recorder recorder = {.run = run, .valve = &valve, .frames = true};
  status = run_motion(&recorder, &motion, &model, hooks, report);
  sb_run_publish(run, recorder.count);
  if (recorder.count == 0) {
    return status;
  }
  SbDynamicsEnergy energy;
  sb_dynamics_sample(&motion, NULL, &energy);
  SbDynamicsCounters counters = motion.counters;
  const SbFrame *last = &run->frames[recorder.count - 1];
  summary->duration = last->time;
  summary->force_peak = recorder.force_peak;
  // What a fast return's viscous friction takes, beyond that at the films' speed.
  summary->force_return_min = fmin(summary->force_return_min, recorder.return_least);
  summary->returns = status == SB_OK && fabs(last->displacement) < 1e-6 * run->model.stroke;
  // Films alike on both ways leave nothing but rounding.
  double net = fabs(recorder.leak) <= 1e-12 * recorder.carried ? 0 : recorder.leak;
  bool back = fabs(last->displacement - run->frames[0].displacement) < 1e-6 * run->model.stroke;
  summary->leakage_per_cycle = sb_run_cycle_leakage(summary, net, back);
  sb_run_fill_motion(summary, &energy, &counters);
  // Work over less than the rounding of places is none: a stem that is pushed and does not move.
  double pushed = fmax(recorder.force_peak, run->model.pressure_force + run->model.spring_preload);
  if (energy.largest < 1e-12 * pushed * run->model.stroke) {
    summary->energy.closure = 0;
  }
  summary->counters.newton_iterations += (size_t)counters.newton_iterations;
  // Closed form throughout: rounding only.
  double force = 1e-12;
  double work = 1e-12;
  if (status == SB_OK && counters.steps > 0 && !run->follows) {
    SbReport own = {0};
    SbStatus estimate = estimate_error(run, &recorder, &energy, &force, &work, hooks, &own);
    if (estimate == SB_ERROR_NOT_CONVERGED) {
      // The motion itself stands.
      force = work = NAN;
      sb_reason(summary, "solver.error_estimate.*", "the coarser motion failed: %s", own.text);
      sb_warn(&summary->warnings, "motion-error-unknown", "output.motion_tolerance",
              "the motion's error is not known: %s", own.text);
    } else if (estimate != SB_OK) {
      status = sb_fail(report, estimate, "%s", own.text);
    }
  }
  double states = summary->error_load + sb_run_error_friction(run);
  summary->error_force = isnan(force) ? NAN : fmax(states, force);
  summary->error_energy = isnan(work) ? NAN : fmax(fmax(states, work), summary->energy.closure);
  return status;
}
