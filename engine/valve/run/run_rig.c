// The sliding-plate rig as a run: each sample of the load cell is a frame (motion/rig.h).
//
// A frame's displacement and velocity are the plate's, its platen the thread wound up, its force
// the cell's signal. There are no seals in it: their places stay empty. The coefficients come from
// the sampled signal alone, as the thesis takes them from its 1000 Hz record (3.4.3). Beside them
// stands what the valve's own surface model gives under the rig's load, and the load under which it
// would give the rig's sliding coefficient: table 7.8 compares a coefficient measured under one
// with one predicted under the other. Leaves out: the lubricant's film, the cell's noise.
#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <stdlib.h>

typedef struct {
  SbRun *run;
  const SbRunHooks *hooks;
  double *force;
  size_t count;
  bool cancelled;
} Record;

static SbSealFrame no_seal(void) {
  return (SbSealFrame){.profile = UINT32_MAX, .shape = UINT32_MAX};
}

static bool record(size_t index, const SbDynamicsSample *sample, void *user) {
  Record *r = user;
  r->force[index] = sample->drive_force;
  r->run->frames[index] = (SbFrame){.time = sample->time,
                                    .displacement = sample->position,
                                    .velocity = sample->speed,
                                    .platen = sample->drive_position,
                                    .force = sample->drive_force,
                                    .seal = {no_seal(), no_seal()}};
  r->count = index + 1;
  if (index % 256 == 0) {
    r->cancelled = sb_run_cancelled(r->hooks, NULL);
    sb_run_progress(r->run, r->hooks, (double)index / (double)r->run->capacity, 0);
  }
  return !r->cancelled;
}

// Stage A at the start, B at the first slip; the frame just before it sits on the event.
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

// Marks the peaks of the signal and takes the coefficients from them.
static SbStatus find_peaks(SbRun *run, const double *force, size_t count, SbReport *report) {
  SbRigSummary *out = &run->summary.rig;
  const SbRig *rig = &run->model->rig;
  size_t most = count / 2 + 1;
  size_t *peak = malloc(most * sizeof *peak);
  if (peak == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the peaks");
  }
  SbStatus status = sb_rig_coefficients(&out->of, force, count, rig->rate, rig->load,
                                        run->model->rig_prominence, peak, most, NULL);
  out->found = status == SB_OK;
  size_t marked = out->found ? out->of.peaks + 1 : 0;
  for (size_t i = 0; i < marked; i++) {
    run->frames[peak[i]].peak = i == 0 ? 1 : 2;
  }
  free(peak);
  if (!out->found) {
    sb_warn(&run->summary.warnings, "rig-no-peak", "rig.duration",
            "the force has no peak within %.3g s: the plate did not break away, or slid smoothly",
            rig->duration);
  } else if (!out->of.stick_slip) {
    sb_warn(&run->summary.warnings, "rig-smooth", "rig.speed",
            "the plate slides without sticking again: the dynamic coefficient is the mean force's");
  }
  return sb_succeed(report);
}

// What the surface model of the valve says of the rig.
static void compare_contact(SbRun *run) {
  const SbModel *model = run->model;
  const SbSealModel *ring = &model->seal[SB_OUTER];
  SbRigSummary *out = &run->summary.rig;
  double share = sb_gt_area_share(model->gt_product, 0);
  out->contact_coefficient =
      sb_rig_contact_coefficient(model->rig.load, ring->inner_diameter + ring->section_diameter,
                                 ring->radius, ring->reduced_modulus, share, model->shear_strength);
  // It falls as 1/sqrt(W).
  if (model->rig.coefficient > 0) {
    double ratio = out->contact_coefficient / model->rig.coefficient;
    out->contact_load = model->rig.load * ratio * ratio;
  }
}

SbStatus sb_run_rig(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  SbSummary *summary = &run->summary;
  const SbRig *rig = &run->model->rig;
  run->before_frames = 1; // all frames appear at once
  Record r = {.run = run, .hooks = hooks, .force = malloc(run->capacity * sizeof(double))};
  if (r.force == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the force");
  }
  SbMotionEvent slip = {.time = -1};
  SbDynamicsEnergy energy = {0};
  SbDynamicsCounters counters = {0};
  SbStatus status = sb_rig_run(rig, record, &r, &slip, &energy, &counters, report);

  // The signal is whole (or cut short) before anybody sees it: peaks are known by what follows.
  mark_stages(run, &slip, r.count);
  if (status == SB_OK) {
    status = find_peaks(run, r.force, r.count, report);
    compare_contact(run);
  }
  for (size_t i = 0; i < r.count; i++) {
    summary->force_peak = fmax(summary->force_peak, r.force[i]);
  }
  free(r.force);
  sb_run_publish(run, r.count);

  if (summary->stage[SB_STAGE_B].reached) {
    summary->force_breakaway = summary->stage[SB_STAGE_B].force;
  }
  summary->duration = rig->duration;
  sb_run_fill_motion(summary, &energy, &counters);
  // Between two samples the thread is wound up by speed / rate: the highest sample misses the peak
  // by less than that times the stiffness, on average by half of it.
  summary->error_force = summary->force_peak > 0 ? 0.5 * rig->thread_stiffness * rig->speed /
                                                       rig->rate / summary->force_peak
                                                 : NAN;
  summary->error_energy = fmax(counters.local_error, energy.closure);
  return status;
}
