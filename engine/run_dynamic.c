// Frames and figures of the motion with inertia: the valve's loads given to motion/dynamics.h.
//
// The same sliding states as in the quasi-static cycle give each seal's Coulomb level, m W + tau_0
// A_a, its static ratio and a viscous coefficient (the viscous force at the reference speed over
// that speed; it is a thousandth of the level, so its weak speed dependence is left out). While the
// edge of the land passes, the inner level follows the part that still touches. The first pass
// finds how long the motion lasts and where its events are, the second records frames; both are the
// same deterministic motion.
#include "engine/leak/stroke.h"
#include "engine/motion/dynamics.h"
#include "engine/run_private.h"

#include <math.h>
#include <string.h>

enum { REST_STOP = 0, END_STOP = 1 };

typedef struct {
  SbRun *run;
  SbChamber chamber;
  SbStage stage;
  int direction;      // of the last sliding
  size_t edge_open;   // index of the edge behind which the chamber opens on the way in
  size_t edge_closed; // and closes on the way out
  double last_event;  // time [s]
  double turn;        // time after which a reverse slip is the return [s]
  double force_peak;
  SbMotionEvent mark[SB_STAGE_COUNT];
  bool marked[SB_STAGE_COUNT];
} Valve;

// The state that stands for a chamber: sliding the way the stem moves in it.
static int direction_of(SbChamber chamber) {
  return chamber == SB_CHAMBER_CLOSED ? SB_CYCLE_OUT : SB_CYCLE_IN;
}

static void valve_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                        void *user) {
  const Valve *valve = user;
  const SbCycle *cycle = &valve->run->cycle;
  int direction = direction_of(valve->chamber);
  loads->force = -valve->run->model.pressure_force;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    const SbSliding *state = &cycle->states.state[seal][valve->chamber][direction];
    double width_share;
    double load_share;
    sb_cycle_land_share(cycle, seal, valve->chamber, direction, x, &width_share, &load_share);
    loads->level[seal] = state->boundary_area * width_share + state->boundary_load * load_share;
  }
  // Only while the edge lies under the inner contact does anything change with x.
  loads->constant = valve->chamber == SB_CHAMBER_OPEN || region == 0;
}

static void valve_cross(size_t edge, int direction, double *extra, void *user) {
  Valve *valve = user;
  if (direction > 0 && edge == valve->edge_open) {
    valve->chamber = SB_CHAMBER_OPEN;
  } else if (direction < 0 && edge == valve->edge_closed && valve->chamber == SB_CHAMBER_OPEN) {
    valve->chamber = SB_CHAMBER_CLOSED;
  }
}

// When the drive has turned: from then on a reverse slip is the return, before it a rebound [s].
static double drive_turn(const SbModel *model, double top) {
  switch (model->drive) {
  case SB_MODEL_DRIVE_MACHINE:
    return top / model->speed;
  case SB_MODEL_DRIVE_HAND:
    return model->rise_time + model->hold_time;
  case SB_MODEL_DRIVE_SINUSOID:
    return 0.25 / model->frequency;
  case SB_MODEL_DRIVE_FREE_RETURN:
    break;
  }
  return 0;
}

static void mark(Valve *valve, SbStage stage, const SbMotionEvent *event) {
  if (!valve->marked[stage]) {
    valve->marked[stage] = true;
    valve->mark[stage] = *event;
    valve->stage = stage;
  }
}

static void valve_event(const SbMotionEvent *event, void *user) {
  Valve *valve = user;
  valve->last_event = event->time;
  valve->force_peak = fmax(valve->force_peak, event->drive_force);
  switch (event->kind) {
  case SB_MOTION_SLIP:
    if (event->sign > 0 && valve->stage == SB_STAGE_A) {
      mark(valve, SB_STAGE_B, event);
    } else if (event->sign < 0 && event->time >= valve->turn) {
      mark(valve, SB_STAGE_E, event);
    }
    valve->direction = event->sign > 0 ? SB_CYCLE_IN : SB_CYCLE_OUT;
    break;
  case SB_MOTION_EDGE:
    if (event->index == 0 && event->sign > 0 && valve->stage == SB_STAGE_B) {
      mark(valve, SB_STAGE_C, event);
    } else if ((size_t)event->index == valve->edge_closed && event->sign < 0 &&
               valve->chamber != SB_CHAMBER_AT_REST) {
      mark(valve, SB_STAGE_F, event);
    }
    break;
  case SB_MOTION_TOUCH_STOP:
    if (event->index == END_STOP) {
      mark(valve, SB_STAGE_D, event);
    }
    break;
  default:
    break;
  }
}

// ---------------------------------------------------------------------------------------------------
// Set-up

// Where the machine turns: a rigid stop would then bear the reversal force, or a fiftieth more than
// what it takes to hold the stem there if that is greater.
static double platen_top(const SbCycle *cycle) {
  const SbModel *model = cycle->states.model;
  double hold =
      model->pressure_force + model->spring_preload + model->spring_stiffness * model->stroke;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    hold += sb_cycle_static_friction(cycle, seal, SB_CHAMBER_AT_REST, SB_CYCLE_IN, 0);
  }
  return model->stroke + fmax(model->reversal_force, 1.02 * hold) / model->stiffness;
}

static double critical_damping(double stiffness, double mass) {
  return 2 * sqrt(stiffness * mass);
}

static void set_machine(SbDynamicsModel *out, const SbModel *model) {
  out->drive_stiffness = model->stiffness;
  out->drive_damping = model->damping_ratio * critical_damping(model->stiffness, model->stem_mass);
}

static void set_drive(SbDynamicsModel *out, const Valve *valve) {
  const SbModel *model = &valve->run->model;
  SbDrive *drive = &out->drive;
  drive->cycles = model->cycles;
  switch (model->drive) {
  case SB_MODEL_DRIVE_MACHINE:
    drive->kind = SB_DRIVE_CYCLE;
    drive->quantity = SB_DRIVE_OF_POSITION;
    drive->end = platen_top(&valve->run->cycle);
    drive->speed = model->speed;
    drive->reversal_force = INFINITY;
    set_machine(out, model);
    break;
  case SB_MODEL_DRIVE_HAND:
    drive->kind = SB_DRIVE_PRESS;
    drive->quantity = SB_DRIVE_OF_FORCE;
    drive->end = model->peak_force;
    drive->rise = drive->fall = model->rise_time;
    drive->hold = model->hold_time;
    drive->pause = model->rise_time;
    break;
  case SB_MODEL_DRIVE_FREE_RETURN:
    drive->kind = SB_DRIVE_NONE;
    out->start_position = model->stroke;
    break;
  case SB_MODEL_DRIVE_SINUSOID:
    drive->kind = SB_DRIVE_SINE;
    drive->quantity = SB_DRIVE_OF_POSITION;
    drive->start = model->stroke / 2;
    drive->amplitude = model->amplitude;
    drive->frequency = model->frequency;
    set_machine(out, model);
    out->drive_bonded = true;
    out->start_position = model->stroke / 2;
    break;
  }
}

static void set_model(SbDynamicsModel *out, Valve *valve) {
  const SbModel *model = &valve->run->model;
  const SbCycle *cycle = &valve->run->cycle;
  *out = (SbDynamicsModel){
      .mass = model->stem_mass,
      .spring_preload = model->spring_preload,
      .spring_stiffness = model->spring_stiffness,
      .contacts = SB_SEAL_COUNT,
      .stops = 2,
      .loads = valve_loads,
      .cross = valve_cross,
      .user = valve,
      .start_dwell = model->rest,
  };
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    const SbSliding *state = &cycle->states.state[seal][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
    double level = state->boundary_area + state->boundary_load;
    out->contact[seal] = (SbDynamicsContact){
        .static_ratio = level > 0 ? fmax(state->friction_static / level, 1) : 1,
        .dwell_gain = model->dwell_gain,
        .dwell_time = model->dwell_time,
        .stribeck_speed = model->stribeck_speed,
        .stribeck_exponent = 1,
        .viscous = state->viscous / model->speed,
        .stiffness = INFINITY,
    };
    if (model->tangential_stiffness > 0) {
      out->contact[seal].stiffness = model->tangential_stiffness;
      out->contact[seal].damping =
          model->damping_ratio * critical_damping(model->tangential_stiffness, model->stem_mass);
    }
  }
  out->stop[REST_STOP] = (SbDynamicsStop){0, -1, INFINITY, 0};
  out->stop[END_STOP] =
      (SbDynamicsStop){model->stroke, 1, model->stop_stiffness, model->stop_restitution};

  // Edges: where the contact meets the land's end, where it has left, where it comes back.
  bool touches = cycle->states.state[SB_INNER][SB_CHAMBER_AT_REST][SB_CYCLE_IN].touches;
  valve->chamber = touches ? SB_CHAMBER_AT_REST : SB_CHAMBER_OPEN;
  if (touches) {
    double open = sb_cycle_edge_end(cycle, SB_CHAMBER_AT_REST, SB_CYCLE_IN);
    double closed = sb_cycle_edge_end(cycle, SB_CHAMBER_CLOSED, SB_CYCLE_OUT);
    out->edge[0] = model->land_edge;
    out->edge[1] = fmin(open, closed);
    out->edge[2] = fmax(open, closed);
    out->edges = open != closed ? 3 : 2;
    valve->edge_open = open > closed ? 2 : 1;
    valve->edge_closed = closed > open ? 2 : 1;
  }
  set_drive(out, valve);
  valve->turn = drive_turn(model, platen_top(cycle));
  if (model->drive == SB_MODEL_DRIVE_FREE_RETURN && model->stroke > out->edge[1] && touches) {
    valve->chamber = SB_CHAMBER_OPEN;
  }
}

// Time after which nothing more is driven [s].
static double drive_end(const SbRun *run) {
  const SbModel *model = &run->model;
  switch (model->drive) {
  case SB_MODEL_DRIVE_MACHINE:
    return 2 * model->cycles * (model->stroke + model->reversal_force / model->stiffness) /
           model->speed;
  case SB_MODEL_DRIVE_HAND:
    return model->cycles * (2 * model->rise_time + model->hold_time) +
           (model->cycles - 1) * model->rise_time;
  case SB_MODEL_DRIVE_SINUSOID:
    return model->cycles / model->frequency;
  case SB_MODEL_DRIVE_FREE_RETURN:
    break;
  }
  return 0;
}

// Corner `index` of the drive: where the platen turns or the finger's force bends, so that a frame
// sits on every extreme whatever the frames' spacing. INFINITY behind the last.
static double drive_corner(const SbRun *run, int index) {
  const SbModel *model = &run->model;
  if (model->drive == SB_MODEL_DRIVE_MACHINE && index < model->cycles) {
    return (2 * index + 1) * platen_top(&run->cycle) / model->speed;
  }
  if (model->drive == SB_MODEL_DRIVE_HAND && index < 2 * model->cycles) {
    double period = 3 * model->rise_time + model->hold_time;
    return index / 2 * period + model->rise_time + index % 2 * model->hold_time;
  }
  return INFINITY;
}

// Steps in which the first pass looks whether the motion has ended, and the longest it may last
// [s].
static double first_step(const SbModel *model) {
  switch (model->drive) {
  case SB_MODEL_DRIVE_MACHINE:
    return (model->stroke + model->reversal_force / model->stiffness) / model->speed / 32;
  case SB_MODEL_DRIVE_HAND:
    return model->rise_time / 4;
  case SB_MODEL_DRIVE_SINUSOID:
    return 0.25 / model->frequency;
  case SB_MODEL_DRIVE_FREE_RETURN:
    break;
  }
  return 1e-3;
}

// Runs once without frames; *duration is the time that the frames should cover.
static SbStatus first_pass(Valve *valve, const SbDynamicsModel *model, double *duration,
                           const SbRunHooks *hooks, SbReport *report) {
  SbDynamics dynamics;
  SbStatus status = sb_dynamics_init(&dynamics, model, report);
  if (status != SB_OK) {
    return status;
  }
  sb_dynamics_listen(&dynamics, valve_event, valve);
  double step = first_step(&valve->run->model);
  double time = 0;
  for (int i = 0; i < 100000; i++) {
    double end = drive_end(valve->run);
    bool periodic = valve->run->model.drive == SB_MODEL_DRIVE_SINUSOID;
    if (periodic ? time >= end : sb_dynamics_at_rest(&dynamics) && i > 0 && time >= end) {
      break;
    }
    // A stem that creeps on after the drive has ended is given as long again, ten seconds at least.
    if (time > 2 * end + 10) {
      break;
    }
    if (sb_run_cancelled(hooks, report)) {
      return SB_ERROR_CANCELLED;
    }
    time = periodic ? fmin(time + step, end) : time + step;
    status = sb_dynamics_advance(&dynamics, time, report);
    if (status != SB_OK) {
      return status;
    }
  }
  double end = drive_end(valve->run);
  *duration = fmax(end, valve->last_event * 1.02);
  return SB_OK;
}

// ---------------------------------------------------------------------------------------------------
// Frames

static void fill_frame(SbFrame *out, const Valve *valve, const SbDynamics *dynamics,
                       SbStage stage) {
  const SbRun *run = valve->run;
  SbDynamicsSample sample;
  sb_dynamics_sample(dynamics, &sample, NULL);
  *out = (SbFrame){
      .time = sample.time,
      .displacement = sample.position,
      .velocity = sample.speed,
      .platen = sample.drive_position,
      .force = sample.drive_force,
      .pressure_force = run->model.pressure_force,
      .stop_force = sample.stop_force[END_STOP] - sample.stop_force[REST_STOP],
      .spring_force = -sample.spring_force,
      .stage = (uint8_t)stage,
      .chamber = (uint8_t)valve->chamber,
  };
  bool moving = sample.speed != 0;
  int direction = moving ? (sample.speed > 0 ? SB_CYCLE_IN : SB_CYCLE_OUT) : valve->direction;
  if (valve->chamber != SB_CHAMBER_OPEN) {
    direction = direction_of(valve->chamber);
  }
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    sb_run_fill_contact(&out->seal[seal], run, seal, valve->chamber, direction, moving,
                        sample.position);
    out->seal[seal].friction = -sample.friction[seal];
    out->seal[seal].friction_viscous = -sample.viscous[seal];
    out->seal[seal].friction_boundary = sample.viscous[seal] - sample.friction[seal];
  }
}

// The earliest marked stage not yet shown, or -1.
static int next_mark(const SbMotionEvent *marks, const bool *marked, const bool *shown) {
  int best = -1;
  for (int stage = SB_STAGE_B; stage < SB_STAGE_COUNT; stage++) {
    if (marked[stage] && !shown[stage] && (best < 0 || marks[stage].time < marks[best].time)) {
      best = stage;
    }
  }
  return best;
}

static SbStatus second_pass(Valve *valve, const SbDynamicsModel *model, double duration,
                            const SbMotionEvent *marks, const bool *marked,
                            SbDynamicsEnergy *energy, SbDynamicsCounters *counters,
                            const SbRunHooks *hooks, SbReport *report) {
  SbRun *run = valve->run;
  SbDynamics dynamics;
  SbStatus status = sb_dynamics_init(&dynamics, model, report);
  if (status != SB_OK) {
    return status;
  }
  sb_dynamics_listen(&dynamics, valve_event, valve);
  size_t total = (size_t)run->model.frames;
  size_t count = 0;
  bool shown[SB_STAGE_COUNT] = {0};
  SbStage passed = SB_STAGE_A;
  int corner = 0;
  for (size_t next = 0; next < total && status == SB_OK;) {
    // The next even instant, or a marked event or a corner of the drive before it.
    double time = duration * (double)next / (double)(total - 1);
    int stage = next_mark(marks, marked, shown);
    bool event = stage >= 0 && marks[stage].time <= time;
    if (event) {
      time = marks[stage].time;
    }
    bool turn = drive_corner(run, corner) < time;
    if (turn) {
      time = drive_corner(run, corner++);
      event = false;
    }
    status = sb_dynamics_advance(&dynamics, time, report);
    SbFrame *frame = &run->frames[count];
    fill_frame(frame, valve, &dynamics, passed);
    if (event) {
      // The event's figures are those just before it.
      frame->on_event = 1;
      frame->force = marks[stage].drive_force;
      frame->displacement = marks[stage].position;
      frame->velocity = marks[stage].speed;
      sb_run_mark_stage(run, (SbStage)stage, frame, count);
      shown[stage] = true;
      passed = (SbStage)stage;
    } else if (!turn) {
      next++;
    }
    run->summary.force_peak = fmax(run->summary.force_peak, frame->force);
    if (count == 0) {
      sb_run_mark_stage(run, SB_STAGE_A, frame, 0);
    }
    count++;
    if (count % 64 == 0) {
      sb_run_publish(run, count);
      if (sb_run_cancelled(hooks, report)) {
        return SB_ERROR_CANCELLED;
      }
      if (count % 4096 == 0) {
        sb_run_progress(run, hooks, (double)next / (double)total, count);
      }
    }
  }
  sb_run_publish(run, count);
  sb_dynamics_sample(&dynamics, &(SbDynamicsSample){0}, energy);
  *counters = sb_dynamics_counters(&dynamics);
  return status;
}

static double frame_leakage(const SbRun *run) {
  size_t count = atomic_load_explicit(&run->published, memory_order_relaxed);
  double net = 0;
  for (size_t i = 1; i < count; i++) {
    net += sb_leak_stroke(run->model.bore_diameter, run->frames[i].seal[SB_OUTER].film_central,
                          run->frames[i].displacement - run->frames[i - 1].displacement);
  }
  return net;
}

SbStatus sb_run_dynamic(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  SbSummary *summary = &run->summary;
  Valve valve = {.run = run};
  SbDynamicsModel model;
  set_model(&model, &valve);
  SbChamber chamber = valve.chamber;
  summary->force_return_min =
      sb_cycle_least_return(&run->cycle, run->model.stroke, SB_CHAMBER_OPEN) +
      run->model.spring_preload;
  double duration = 0;
  SbStatus status = first_pass(&valve, &model, &duration, hooks, report);
  if (status != SB_OK) {
    return status;
  }

  // The same motion again, recorded.
  SbMotionEvent marks[SB_STAGE_COUNT];
  bool marked[SB_STAGE_COUNT];
  memcpy(marks, valve.mark, sizeof marks);
  memcpy(marked, valve.marked, sizeof marked);
  valve = (Valve){.run = run,
                  .chamber = chamber,
                  .turn = valve.turn,
                  .edge_open = valve.edge_open,
                  .edge_closed = valve.edge_closed};
  SbDynamicsEnergy energy = {0};
  SbDynamicsCounters counters = {0};
  status = second_pass(&valve, &model, duration, marks, marked, &energy, &counters, hooks, report);
  size_t count = atomic_load_explicit(&run->published, memory_order_relaxed);
  summary->duration = duration;
  summary->force_peak = fmax(summary->force_peak, valve.force_peak);
  summary->returns =
      count > 0 && fabs(run->frames[count - 1].displacement) < 1e-6 * run->model.stroke;
  summary->leakage_per_cycle = frame_leakage(run);
  summary->energy = (SbEnergy){
      .external = energy.drive + energy.pressure,
      .external_max = energy.largest,
      .friction = energy.friction + energy.viscous,
      .stored = energy.stored,
      .seal = energy.seal + energy.machine,
      .kinetic = energy.kinetic,
      .stop = energy.stop,
      .loop = energy.drive - energy.machine,
      .closure = energy.closure,
  };
  summary->steps = (size_t)(counters.segments + counters.steps);
  summary->rejected_steps = (size_t)counters.rejected;
  summary->newton_iterations += (size_t)counters.newton_iterations;
  summary->error_force = fmax(summary->error_load, counters.local_error);
  summary->error_energy = fmax(summary->error_force, energy.closure);
  return status;
}
