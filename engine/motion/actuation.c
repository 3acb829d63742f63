// See actuation.h.
#include "engine/motion/actuation.h"
#include "engine/motion/dynamics_internal.h"

#include <math.h>

enum { A, B, C, D, E, F };

typedef struct {
  SbActuation *out;
  const SbActuationOptions *options;
  const SbDynamics *motion;
} Recorder;

static void reach(Recorder *r, int stage, const SbMotionEvent *event) {
  SbActuationStage *s = &r->out->stage[stage];
  if (!s->passed) {
    *s = (SbActuationStage){true, event->time, event->position, event->drive_force};
  }
}

// Whether, after this slip, nothing holds the stem any more.
static bool all_slip(const SbDynamics *s, const SbMotionEvent *event) {
  for (size_t i = 0; i < s->model->contacts; i++) {
    bool rigid = s->model->contact[i].stiffness > 1e300;
    bool this_one = event->index == (int)i || (event->index < 0 && rigid);
    if (!this_one && s->state[i] == SB_CONTACT_STUCK) {
      return false;
    }
    if (!this_one && s->state[i] == SB_CONTACT_SLIP && s->sign[i] != event->sign) {
      return false;
    }
  }
  return true;
}

static void record(const SbMotionEvent *event, void *user) {
  Recorder *r = user;
  SbActuation *out = r->out;
  if (!out->stage[D].passed) {
    out->force_peak = fmax(out->force_peak, event->drive_force);
  }
  switch (event->kind) {
  case SB_MOTION_SLIP:
    if (event->sign > 0 && all_slip(r->motion, event)) {
      reach(r, B, event);
    } else if (event->sign < 0 && out->stage[D].passed && all_slip(r->motion, event)) {
      reach(r, E, event);
    }
    break;
  case SB_MOTION_EDGE:
    if (event->index == r->options->land_edge && event->sign > 0) {
      reach(r, C, event);
    } else if (event->index == r->options->land_edge && out->stage[C].passed) {
      reach(r, F, event);
    }
    break;
  case SB_MOTION_TOUCH_STOP:
    if (event->index == r->options->end_stop) {
      reach(r, D, event);
    }
    break;
  default:
    break;
  }
}

// What drives the stem outwards less what rubs on it when it slides, whatever the drive does.
static double outward(const SbDynamics *motion, const SbDynamicsSample *s) {
  SbDynamicsLoads loads;
  sb_motion_loads_at(motion, s->position, s->extra, &loads);
  double force = -loads.force - s->spring_force, speed = fabs(s->speed);
  for (size_t i = 0; i < motion->model->contacts; i++) {
    force -= sb_motion_sliding_level(motion, i, loads.level[i], speed) +
             motion->model->contact[i].viscous * speed;
  }
  return force;
}

static SbStatus run_once(SbActuation *out, SbDynamicsSample *samples, SbDynamicsEnergy *energies,
                         size_t *done, const SbDynamicsModel *model,
                         const SbActuationOptions *options, SbReport *report) {
  SbDynamics motion;
  Recorder recorder = {out, options, &motion};
  *out = (SbActuation){.force_return_min = INFINITY};
  *done = 0;
  SbStatus status = sb_dynamics_init(&motion, model, report);
  if (status != SB_OK) {
    return status;
  }
  sb_dynamics_listen(&motion, record, &recorder);
  SbDynamicsSample sample;
  sb_dynamics_sample(&motion, &sample, &out->energy);
  out->stage[A] = (SbActuationStage){true, 0.0, sample.position, sample.drive_force};
  for (size_t i = 1; i <= options->frames && status == SB_OK; i++) {
    if (options->cancelled != NULL && options->cancelled(options->user)) {
      status = sb_fail(report, SB_ERROR_CANCELLED, "cancelled at %.6g s", sample.time);
      break;
    }
    double time = options->until * (double)i / (double)options->frames;
    status = sb_dynamics_advance(&motion, time, report);
    sb_dynamics_sample(&motion, &sample, &out->energy);
    if (!out->stage[D].passed) {
      out->force_peak = fmax(out->force_peak, sample.drive_force);
    }
    // From the end stop back to rest.
    bool pressed = options->end_stop >= 0 && sample.stop_force[options->end_stop] > 0.0;
    if (out->stage[D].passed && !pressed) {
      out->left_stop = true;
      out->force_return_min = fmin(out->force_return_min, outward(&motion, &sample));
    }
    if (samples != NULL) {
      samples[i - 1] = sample;
    }
    if (energies != NULL) {
      energies[i - 1] = out->energy;
    }
    *done = status == SB_OK ? i : *done;
  }
  if (!out->left_stop) {
    out->force_return_min = outward(&motion, &sample);
  }
  out->force_breakaway = out->stage[B].passed ? out->stage[B].force : 0.0;
  out->counters = sb_dynamics_counters(&motion);
  out->end_time = sample.time;
  out->end_position = sample.position;
  int rest = options->rest_stop;
  bool home = rest >= 0 ? sample.stop_force[rest] > 0.0
                        : fabs(sample.position - model->start_position) < 1e-6;
  out->returns = home && fabs(sample.speed) < 1e-6 && sample.drive_force <= 0.0;
  return status;
}

SbStatus sb_actuation_run(SbActuation *out, SbDynamicsSample *samples, SbDynamicsEnergy *energies,
                          size_t *done, const SbDynamicsModel *model,
                          const SbActuationOptions *options, SbReport *report) {
  size_t count = 0;
  if (!(options->until > 0.0) || !isfinite(options->until) || options->frames < 1 ||
      options->land_edge >= (int)model->edges || options->end_stop >= (int)model->stops ||
      options->rest_stop >= (int)model->stops) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "an actuation needs a duration, frames, and edges and stops that exist");
  }
  SbStatus status = run_once(out, samples, energies, &count, model, options, report);
  if (done != NULL) {
    *done = count;
  }
  // Closed form throughout: only rounding.
  out->error_position = 1e-13 * (fabs(out->end_position) + 1e-3);
  out->error_force = 1e-12 * out->force_peak;
  out->error_energy = 1e-12 * out->energy.largest;
  if (status != SB_OK || !options->estimate || out->counters.steps == 0) {
    return status;
  }
  SbDynamicsModel loose = *model;
  loose.tolerance = 10.0 * (model->tolerance > 0.0 ? model->tolerance : 1e-9);
  if (loose.tolerance > 1e-5) {
    return sb_fail(report, SB_ERROR_RANGE, "an error estimate needs a tolerance of 1e-6 or less");
  }
  // The second run keeps no frames; its positions are compared as they pass.
  SbDynamics motion;
  SbActuation other = {0};
  Recorder recorder = {&other, options, &motion};
  SbActuationOptions quiet = *options;
  quiet.estimate = false;
  recorder.options = &quiet;
  if (samples == NULL) {
    size_t unused;
    status = run_once(&other, NULL, NULL, &unused, &loose, &quiet, report);
    out->error_position += 1.5 * fabs(other.end_position - out->end_position);
  } else {
    status = sb_dynamics_init(&motion, &loose, report);
    sb_dynamics_listen(&motion, record, &recorder);
    for (size_t i = 0; i < count && status == SB_OK; i++) {
      SbDynamicsSample sample;
      if (options->cancelled != NULL && options->cancelled(options->user)) {
        return sb_fail(report, SB_ERROR_CANCELLED, "cancelled during the error estimate");
      }
      status = sb_dynamics_advance(&motion, samples[i].time, report);
      sb_dynamics_sample(&motion, &sample, &other.energy);
      if (!other.stage[D].passed) {
        other.force_peak = fmax(other.force_peak, sample.drive_force);
      }
      double difference = 1.5 * fabs(sample.position - samples[i].position);
      out->error_position = fmax(out->error_position, difference);
    }
  }
  // Where a patch comes to rest is blurred by the speed below which it counts as resting, too.
  out->error_position += 0.1 * sb_motion_rest_speed(model);
  out->error_force += 1.5 * fabs(other.force_peak - out->force_peak);
  out->error_energy += 1.5 * fabs(other.energy.friction - out->energy.friction);
  return status;
}
