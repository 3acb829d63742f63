// The drive of the valve in a run with inertia: the catalogue's drive.* as mechanism/drive.h.
#include "engine/valve/run/run_valve.h"

#include <math.h>

// Returns the position where the machine turns: a rigid stop would then carry the reversal force,
// or the force that holds the stem there plus 2 % if that is larger.
static double platen_top(const SbCycle *cycle) {
  const SbModel *model = cycle->model;
  double hold = sb_model_push(model, model->stroke);
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    hold += sb_valve_type(model)->stop_friction(cycle, seal);
  }
  return model->stroke + fmax(model->reversal_force, 1.02 * hold) / model->stiffness;
}

// Returns 1.5 times the time of the full return under the smallest net force, for a stem that only
// pressure and spring push back.
static double free_return_time(const SbRun *run) {
  const SbModel *model = run->model;
  double least = sb_cycle_sliding_margin(&run->cycle, model->stroke);
  double force = fmax(least, 1e-3 * (fabs(model->pressure_force) + 1e-3));
  return 1.5 * sqrt(2 * model->stroke * model->moving_mass / force);
}

static void set_machine(SbDynamicsModel *out, SbDriveTimes *times, const SbRun *run) {
  const SbModel *model = run->model;
  const double top = platen_top(&run->cycle), once = top / model->speed;
  out->drive = (SbDrive){.kind = SB_DRIVE_PRESS, .end = top, .rise = once, .fall = once};
  *times = (SbDriveTimes){.duration = 2 * model->cycles * once,
                          .turn = once,
                          .corners = model->cycles,
                          .period = 2 * once,
                          .first = {once}};
}

static void set_hand(SbDynamicsModel *out, SbDriveTimes *times, const SbRun *run) {
  const double rise = run->model->rise_time, hold = run->model->hold_time;
  const int cycles = run->model->cycles;
  out->drive = (SbDrive){.kind = SB_DRIVE_PRESS,
                         .quantity = SB_DRIVE_OF_FORCE,
                         .end = run->model->peak_force,
                         .rise = rise,
                         .hold = hold,
                         .fall = rise,
                         .pause = rise};
  *times = (SbDriveTimes){.duration = cycles * (2 * rise + hold) + (cycles - 1) * rise,
                          .turn = rise + hold,
                          .corners = 2 * cycles,
                          .period = 3 * rise + hold,
                          .first = {rise, rise + hold}};
  out->drive_damping = run->model->finger_damping;
}

static void set_free_return(SbDynamicsModel *out, SbDriveTimes *times, const SbRun *run) {
  out->drive.kind = SB_DRIVE_NONE;
  out->start_position = run->model->stroke;
  times->duration = free_return_time(run);
}

static void set_sinusoid(SbDynamicsModel *out, SbDriveTimes *times, const SbRun *run) {
  const SbModel *model = run->model;
  out->drive = (SbDrive){.kind = SB_DRIVE_SINE,
                         .start = model->stroke / 2,
                         .amplitude = model->amplitude,
                         .frequency = model->frequency};
  *times = (SbDriveTimes){.duration = model->cycles / model->frequency,
                          .period = 1 / model->frequency,
                          .turn = 0.25 / model->frequency,
                          .ends_run = true};
  out->drive_bonded = true;
  out->start_position = model->stroke / 2;
}

static void set_ramp(SbDynamicsModel *out, SbDriveTimes *times, const SbRun *run) {
  const double rise = run->model->rise_time, hold = run->model->hold_time;
  out->drive = (SbDrive){.kind = SB_DRIVE_PRESS,
                         .quantity = SB_DRIVE_OF_FORCE,
                         .end = run->model->peak_force,
                         .rise = rise,
                         .hold = INFINITY,
                         .fall = rise};
  *times = (SbDriveTimes){.duration = rise + hold,
                          .turn = rise + hold,
                          .ends_run = true,
                          .corners = 1,
                          .first = {rise}};
  out->drive_damping = run->model->finger_damping;
}

// A displacement moves the machine's platen, a force pushes the stem itself.
static void set_measured(SbDynamicsModel *out, SbDriveTimes *times, const SbRun *run) {
  const SbModelSeries *measured = sb_model_measured(run->model);
  size_t highest = 0;
  for (size_t i = 1; i < measured->count; i++) {
    highest = measured->value[i] > measured->value[highest] ? i : highest;
  }
  out->drive = (SbDrive){.kind = SB_DRIVE_TABLE,
                         .quantity = measured->quantity,
                         .time = measured->time,
                         .value = measured->value,
                         .count = measured->count};
  *times = (SbDriveTimes){.duration = measured->time[measured->count - 1],
                          .turn = measured->time[highest],
                          .ends_run = true,
                          .corners = 1,
                          .first = {measured->time[highest]}};
}

void sb_valve_set_drive(SbDynamicsModel *out, SbDriveTimes *times, const SbRun *run) {
  static void (*const set[])(SbDynamicsModel *, SbDriveTimes *, const SbRun *) = {
      [SB_MODEL_DRIVE_MACHINE] = set_machine,   [SB_MODEL_DRIVE_HAND] = set_hand,
      [SB_MODEL_DRIVE_SINUSOID] = set_sinusoid, [SB_MODEL_DRIVE_FREE_RETURN] = set_free_return,
      [SB_MODEL_DRIVE_RAMP] = set_ramp,         [SB_MODEL_DRIVE_MEASURED] = set_measured,
  };
  const SbModel *model = run->model;
  SbDrive *drive = &out->drive;
  set[model->drive](out, times, run);
  drive->cycles = model->cycles;
  times->cycles = times->period > 0 ? model->cycles : 1;
  if (drive->kind != SB_DRIVE_NONE && drive->quantity == SB_DRIVE_OF_POSITION) {
    out->drive_stiffness = model->stiffness;
    out->drive_damping = model->damping_ratio * 2 * sqrt(model->stiffness * out->mass);
  }
}
