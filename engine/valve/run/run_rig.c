// The sliding-plate rig as a run: each sample of the load cell is a frame (valve/run/rig.h).
//
// A frame's displacement and velocity are the plate's, its platen is the wound thread, its force
// the cell's signal. There are no seals: their fields are empty. The coefficients are computed from
// the sampled signal only, as the thesis does from its 1000 Hz record (3.4.3). In addition the run
// gives the coefficient of the valve's own surface model at the rig's load, and the load at which
// that model would give the rig's sliding coefficient: table 7.8 compares a coefficient measured at
// one load with one predicted at another. Not modelled: the lubricant's film, the cell's noise.
#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/valve/figures/figures.h"
#include "engine/valve/run/run_errors.h"
#include "engine/valve/run/run_private.h"

#include <math.h>

static SbSealFrame no_seal(void) {
  return (SbSealFrame){.profile = UINT32_MAX, .shape = UINT32_MAX};
}

// Stores the first slip.
static void note_slip(const SbMotionEvent *event, void *user) {
  SbMotionEvent *slip = user;
  if (event->kind == SB_MOTION_SLIP && slip->time < 0) {
    *slip = *event;
  }
}

// Stage A at the start, B at the first slip; the frame just before it is the frame of the event.
static void mark_stages(SbRun *run, const SbMotionEvent *slip, size_t count) {
  if (count == 0) {
    return;
  }
  sb_run_mark_stage(run, SB_STAGE_A, &run->frames[0], 0);
  if (slip->time < 0) {
    return;
  }
  size_t before = (size_t)fmin(floor(slip->time * run->model->rig.rate), (double)(count - 1));
  run->summary.stage[SB_STAGE_B] =
      (SbStageMark){true, slip->time, slip->position, slip->drive_force, before};
  run->frames[before].on_event = 1;
  for (size_t i = before; i < count; i++) {
    run->frames[i].stage = (uint8_t)SB_STAGE_B;
  }
  run->frames[before].stage = (uint8_t)SB_STAGE_A;
}

static void take_coefficients(SbRun *run, const SbRigSignal *signal) {
  SbRigSummary *out = &run->summary.rig;
  const SbRig *rig = &run->model->rig;
  out->found = sb_rig_coefficients(&out->of, signal, rig, NULL) == SB_OK;
  if (!out->found) {
    sb_warn(&run->summary.warnings, "rig-no-peak", sb_input(SB_P_RIG_DURATION),
            "the force has no peak within %.3g s: the plate did not break away, or slid smoothly",
            rig->duration);
  } else if (!out->of.stick_slip) {
    sb_warn(&run->summary.warnings, "rig-smooth", sb_input(SB_P_RIG_SPEED),
            "the plate slides without sticking again: the dynamic coefficient is the mean force's");
  }
}

// Evaluates the surface model of the valve for the rig.
static void compare_contact(SbRun *run) {
  const SbModel *model = run->model;
  const SbSealModel *ring = &model->seal[SB_OUTER];
  SbRigSummary *out = &run->summary.rig;
  const SbRoughSurface surface = sb_model_surface(model, SB_OUTER, 1);
  double share = sb_rough_area_share(&surface, 0);
  out->contact_coefficient =
      sb_rig_contact_coefficient(model->rig.load, ring->inner_diameter + ring->section_diameter,
                                 ring->radius, ring->reduced_modulus, share, model->shear_strength);
  // It falls as 1/sqrt(W).
  if (model->rig.coefficient > 0) {
    double ratio = out->contact_coefficient / model->rig.coefficient;
    out->contact_load = model->rig.load * ratio * ratio;
  }
}

// Relative error of the largest force: that of the motion's path, and no less than the tolerance of
// the path. The signal's samples have an error of their own (of_rig() in run_errors.c).
static double force_error(const SbRun *run, const SbDynamics *motion) {
  const double peak = run->summary.force_peak;
  const double path = (fabs(motion->at.x) + 1e-3) * motion->counters.local_error;
  return peak > 0 ? fmax(run->model->rig.thread_stiffness * path / peak, 1e-9) : NAN;
}

// Events, energies and the largest force are those of the motion.
static void rig_errors(SbRun *run) {
  const SbSummary *summary = &run->summary;
  sb_run_begin_errors(run);
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    if (sb_figure(i)->part == SB_PART_ENERGY) {
      run->motion_error[i] = summary->error_energy * summary->energy.external_max;
    } else if (i == sb_figure_find("cycle.force_peak_N")) {
      run->motion_error[i] = summary->error_force * summary->force_peak;
    }
  }
}

// Adds to the report of a motion that ended early where it did.
static SbStatus name_end(const SbRun *run, const SbDynamics *motion, size_t count, SbStatus status,
                         SbReport *report) {
  if (status != SB_ERROR_NOT_CONVERGED || report == NULL) {
    return status;
  }
  const SbReport cause = *report;
  const SbStage stage = count > 0 ? (SbStage)run->frames[count - 1].stage : SB_STAGE_A;
  const SbRunPlace place = {"motion (rig)", "plate",     stage,
                            motion->at.x,   motion->now, "the samples before"};
  return sb_run_fail_at(report, status, &place, &cause);
}

SbStatus sb_run_rig(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  SbSummary *summary = &run->summary;
  const SbRig *rig = &run->model->rig;
  run->before_frames = 1; // all frames are published together: peaks follow from later samples
  SbDynamics motion;
  SbDynamicsModel model;
  SbRigSignal signal = {.prominence = run->model->rig_prominence};
  SbMotionEvent slip = {.time = -1};
  SbDynamicsEnergy energy = {0};
  SbStatus status = sb_rig_start(&motion, &model, rig, report);
  if (status != SB_OK) {
    return status;
  }
  model.poll = sb_work_segment;
  model.poll_data = run->work;
  sb_dynamics_listen(&motion, note_slip, &slip);
  size_t samples = sb_rig_samples(rig), count = 0, peak;
  while (count < samples && status == SB_OK) {
    SbDynamicsSample sample;
    status = sb_dynamics_advance(&motion, (double)count / rig->rate, report);
    if (status != SB_OK) {
      break;
    }
    sb_dynamics_sample(&motion, &sample, NULL);
    run->frames[count] = (SbFrame){.time = sample.time,
                                   .displacement = sample.position,
                                   .velocity = sample.speed,
                                   .platen = sample.drive_position,
                                   .force = sample.drive_force,
                                   .seal = {no_seal(), no_seal()}};
    if (sb_rig_signal_add(&signal, sample.drive_force, &peak)) {
      run->frames[peak].peak = signal.peaks == 1 ? 1 : 2;
    }
    if (count++ % 256 == 0) {
      sb_run_progress(run, hooks, (double)count / (double)samples, 0);
      status = sb_run_cancelled(hooks, report) ? SB_ERROR_CANCELLED : SB_OK;
    }
  }
  status = sb_work_status(run->work, status, report);
  sb_dynamics_sample(&motion, NULL, &energy);
  mark_stages(run, &slip, count);
  status = name_end(run, &motion, count, status, report);
  if (status == SB_OK) {
    take_coefficients(run, &signal);
    compare_contact(run);
  }
  sb_run_publish(run, count);

  if (summary->stage[SB_STAGE_B].reached) {
    summary->force_breakaway = summary->stage[SB_STAGE_B].force;
  }
  // Slips, and what the plate's inertia adds to their force, are between two samples.
  summary->force_peak = sb_dynamics_force_peak(&motion);
  summary->duration = rig->duration;
  sb_run_fill_motion(summary, &energy, &motion.counters, 1);
  summary->error_force = force_error(run, &motion);
  summary->error_energy = fmax(motion.counters.local_error, energy.closure);
  rig_errors(run);
  return status;
}
