// Frames and figures of the quasi-static cycle: evaluations of its segments, none of them a step in
// time.
#include "engine/film/stroke.h"
#include "engine/valve/run/run_private.h"

#include <math.h>

// Time at platen position X of a segment: the platen moves at constant speed, up and back.
static double time_of(const SbRun *run, const SbCycleSegment *segment, double X) {
  double top = run->cycle.platen_top;
  return (segment->platen > 0 ? X : 2 * top - X) / run->model.speed;
}

static void fill_seal(SbSealFrame *out, const SbRun *run, int seal, const SbCycleSegment *segment,
                      double s, double stuck_friction) {
  SbChamber chamber = segment->chamber;
  bool moving = segment->mode != SB_CYCLE_STICK;
  sb_run_fill_contact(out, run, seal, chamber, segment->direction, moving, s);
  if (!moving) {
    out->friction = stuck_friction;
    out->friction_boundary = stuck_friction;
    if (stuck_friction != 0) {
      // A stuck ring keeps the shear of the friction that holds it.
      out->shape = sb_run_shape_index(run, seal, chamber,
                                      stuck_friction > 0 ? SB_CYCLE_IN : SB_CYCLE_OUT, s);
    }
    return;
  }
  double sign = segment->direction == SB_CYCLE_IN ? 1 : -1;
  const SbSliding *state = &run->cycle.states.state[seal][chamber][segment->direction];
  out->friction_viscous = sign * state->viscous * out->land_fraction;
  out->friction = sign * sb_cycle_seal_friction(&run->cycle, seal, chamber, segment->direction, s);
  out->friction_boundary = out->friction - out->friction_viscous;
}

static void fill_frame(SbFrame *out, const SbRun *run, const SbCycleSegment *segment, double X,
                       double s) {
  const SbCycle *cycle = &run->cycle;
  double stop_force;
  double friction = sb_cycle_balance(cycle, segment, X, s, &stop_force);
  *out = (SbFrame){
      .time = time_of(run, segment, X),
      .displacement = s,
      .platen = X,
      .force = sb_cycle_force(cycle, X, s),
      .pressure_force = run->model.pressure_force,
      .stop_force = stop_force,
      .chamber_pressure = sb_model_seal_pressure(&run->model, SB_OUTER, segment->chamber).left,
      .stage = (uint8_t)segment->stage,
      .chamber = (uint8_t)segment->chamber,
  };
  if (segment->mode == SB_CYCLE_SLIP && segment->platen1 != segment->platen0) {
    out->velocity = segment->platen * run->model.speed * sb_cycle_stem_rate(cycle, segment, s);
  }

  // A stuck stem's friction is split between the seals in proportion to what each can bear.
  double total = sb_cycle_friction(cycle, segment->chamber, segment->direction, s);
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    double own = sb_cycle_seal_friction(cycle, seal, segment->chamber, segment->direction, s);
    fill_seal(&out->seal[seal], run, seal, segment, s, total > 0 ? friction * own / total : 0);
  }
}

// Evenly spaced frames, and one at the end of every segment so that corners are sharp.
static SbStatus emit_frames(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  const SbCycle *cycle = &run->cycle;
  SbSummary *summary = &run->summary;
  size_t total = (size_t)run->model.frames;
  size_t next = 0;  // evenly spaced frame to come
  size_t count = 0; // frames written
  double duration = 2 * cycle->platen_top / run->model.speed;
  for (size_t i = 0; i < cycle->count; i++) {
    const SbCycleSegment *segment = &cycle->segment[i];
    double end = time_of(run, segment, segment->platen1);
    for (; next < total && segment->mode != SB_CYCLE_JUMP; next++) {
      double t = duration * (double)next / (double)(total - 1);
      if (t >= end) {
        break;
      }
      double X =
          segment->platen > 0 ? run->model.speed * t : 2 * cycle->platen_top - run->model.speed * t;
      X = fmin(fmax(X, fmin(segment->platen0, segment->platen1)),
               fmax(segment->platen0, segment->platen1));
      fill_frame(&run->frames[count], run, segment, X, sb_cycle_stem(cycle, segment, X));
      count++;
      if (count % 256 == 0) {
        sb_run_publish(run, count);
        if (sb_run_cancelled(hooks, report)) {
          return SB_ERROR_CANCELLED;
        }
        if (count % 4096 == 0) {
          sb_run_progress(run, hooks, (double)next / (double)total, count);
        }
      }
    }
    // The corner. An event's figures are those just before it.
    fill_frame(&run->frames[count], run, segment, segment->platen1, segment->stem1);
    if (count == 0) {
      sb_run_mark_stage(run, SB_STAGE_A, &run->frames[0], 0);
    }
    if (segment->event >= 0) {
      run->frames[count].on_event = 1;
      sb_run_mark_stage(run, (SbStage)segment->event, &run->frames[count], count);
    }
    count++;
    sb_run_publish(run, count);
  }
  if (count > 0 && !summary->stage[SB_STAGE_A].reached) {
    sb_run_mark_stage(run, SB_STAGE_A, &run->frames[0], 0);
  }
  summary->frames = count;
  summary->duration = duration;
  return SB_OK;
}

// Film dragged out under the outer seal on the way in, less what comes back (thesis equation 5.21).
static double cycle_leakage(const SbRun *run) {
  double net = 0;
  for (size_t i = 0; i < run->cycle.count; i++) {
    const SbCycleSegment *segment = &run->cycle.segment[i];
    const SbSliding *outer =
        &run->cycle.states.state[SB_OUTER][segment->chamber][segment->direction];
    net += sb_leak_stroke(run->model.bore_diameter, outer->film_central,
                          segment->stem1 - segment->stem0);
  }
  return net;
}

SbStatus sb_run_quasi_static(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  SbSummary *summary = &run->summary;
  SbStatus status = sb_cycle_build(&run->cycle, report);
  SbStatus frames = emit_frames(run, hooks, status == SB_OK ? report : NULL);
  status = status != SB_OK ? status : frames;
  sb_cycle_energy(&run->cycle, &summary->energy);
  summary->returns = run->cycle.returns;
  summary->force_return_min = run->cycle.force_return_min;
  // Here the stem keeps its film where it stops (motion/cycle.h). Held at the stop for longer it
  // would not.
  if (summary->returns && summary->stage[SB_STAGE_D].reached) {
    double held = sb_cycle_least_return(&run->cycle, run->model.stroke, SB_CHAMBER_OPEN, true);
    if (held < 0) {
      sb_warn(&summary->warnings, "static-hold", "friction.static_ratio",
              "the stem returns because it keeps its film at the stop; after a rest there static "
              "friction would exceed the pressure force by %.3g N (models.motion = dynamic)",
              -held);
    }
  }
  summary->force_peak = 0;
  for (size_t i = 0; i < run->cycle.count; i++) {
    const SbCycleSegment *segment = &run->cycle.segment[i];
    summary->force_peak =
        fmax(summary->force_peak, sb_cycle_force(&run->cycle, segment->platen1, segment->stem1));
  }
  summary->leakage_per_cycle = sb_run_cycle_leakage(summary, cycle_leakage(run), summary->returns);
  summary->steps = run->cycle.count;
  summary->error_force = summary->error_load + sb_run_error_friction(run);
  summary->error_energy =
      fmax(summary->energy.closure, summary->error_load + sb_run_error_work(run));
  return status;
}
