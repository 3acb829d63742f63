// What drives the valve in a run with inertia: the catalogue's drive.* as motion/drive.h.
#include "engine/valve/run/run_dynamic.h"

#include <math.h>

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

static void set_machine(SbDynamicsModel *out, const SbModel *model) {
  out->drive_stiffness = model->stiffness;
  out->drive_damping = model->damping_ratio * 2 * sqrt(model->stiffness * out->mass);
}

void sb_valve_set_drive(SbDynamicsModel *out, const SbRun *run) {
  const SbModel *model = &run->model;
  SbDrive *drive = &out->drive;
  const SbModelSeries *measured = sb_model_measured(model);
  drive->cycles = model->cycles;
  switch (model->drive) {
  case SB_MODEL_DRIVE_MACHINE:
    drive->kind = SB_DRIVE_PRESS;
    drive->quantity = SB_DRIVE_OF_POSITION;
    drive->end = platen_top(&run->cycle);
    drive->rise = drive->fall = drive->end / model->speed;
    set_machine(out, model);
    break;
  case SB_MODEL_DRIVE_HAND:
    drive->kind = SB_DRIVE_PRESS;
    drive->quantity = SB_DRIVE_OF_FORCE;
    drive->end = model->peak_force;
    drive->rise = drive->fall = model->rise_time;
    drive->hold = model->hold_time;
    drive->pause = model->rise_time;
    out->drive_damping = model->finger_damping;
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
  case SB_MODEL_DRIVE_RAMP:
    drive->kind = SB_DRIVE_PRESS;
    drive->quantity = SB_DRIVE_OF_FORCE;
    drive->end = model->peak_force;
    drive->rise = drive->fall = model->rise_time;
    drive->hold = INFINITY;
    out->drive_damping = model->finger_damping;
    break;
  case SB_MODEL_DRIVE_MEASURED:
    // A displacement moves the machine's platen, a force pushes the stem itself.
    drive->kind = SB_DRIVE_TABLE;
    if (measured != NULL) {
      drive->quantity = measured->quantity;
      drive->time = measured->time;
      drive->value = measured->value;
      drive->count = measured->count;
    }
    if (drive->quantity == SB_DRIVE_OF_POSITION) {
      set_machine(out, model);
    }
    break;
  }
}

// Row of the greatest value of a measured series.
static size_t highest_row(const SbModelSeries *series) {
  size_t best = 0;
  for (size_t i = 1; i < series->count; i++) {
    best = series->value[i] > series->value[best] ? i : best;
  }
  return best;
}

// A stem that pressure and spring alone push back: the time of the whole way under the least net
// force, and half as long again.
static double free_return_time(const SbRun *run) {
  const SbModel *model = &run->model;
  double least = sb_cycle_least_return(&run->cycle, model->stroke, SB_CHAMBER_OPEN, true) +
                 model->spring_preload;
  double force = fmax(least, 1e-3 * (model->pressure_force + 1e-3));
  return 1.5 * sqrt(2 * model->stroke * model->moving_mass / force);
}

SbDriveTimes sb_drive_times(const SbRun *run) {
  const SbModel *model = &run->model;
  const SbModelSeries *measured = sb_model_measured(model);
  double rise = model->rise_time, hold = model->hold_time, once;
  switch (model->drive) {
  case SB_MODEL_DRIVE_MACHINE:
    once = platen_top(&run->cycle) / model->speed;
    return (SbDriveTimes){.duration = 2 * model->cycles * once,
                          .turn = once,
                          .corners = model->cycles,
                          .period = 2 * once,
                          .first = {once}};
  case SB_MODEL_DRIVE_HAND:
    return (SbDriveTimes){.duration =
                              model->cycles * (2 * rise + hold) + (model->cycles - 1) * rise,
                          .turn = rise + hold,
                          .corners = 2 * model->cycles,
                          .period = 3 * rise + hold,
                          .first = {rise, rise + hold}};
  case SB_MODEL_DRIVE_SINUSOID:
    return (SbDriveTimes){.duration = model->cycles / model->frequency,
                          .turn = 0.25 / model->frequency,
                          .ends_run = true};
  case SB_MODEL_DRIVE_RAMP:
    return (SbDriveTimes){.duration = rise + hold,
                          .turn = rise + hold,
                          .ends_run = true,
                          .corners = 1,
                          .first = {rise}};
  case SB_MODEL_DRIVE_MEASURED:
    once = measured != NULL ? measured->time[highest_row(measured)] : 0;
    return (SbDriveTimes){.duration = measured != NULL ? measured->time[measured->count - 1] : 0,
                          .turn = once,
                          .ends_run = true,
                          .corners = 1,
                          .first = {once}};
  case SB_MODEL_DRIVE_FREE_RETURN:
    break;
  }
  return (SbDriveTimes){.duration = free_return_time(run)};
}

double sb_drive_corner(const SbDriveTimes *times, int index) {
  int each = times->first[1] > 0 ? 2 : 1; // in a period
  int period = index / each;
  return index < times->corners ? period * times->period + times->first[index % each] : INFINITY;
}
