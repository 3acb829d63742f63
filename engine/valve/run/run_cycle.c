// Frames and figures of the quasi-static cycle: evaluations of its segments, none of them a step in
// time.
#include "engine/valve/figures/figures.h"
#include "engine/valve/run/run_errors.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Time at platen position X of a segment: the platen moves at constant speed, up and back.
static double time_of(const SbRun *run, const SbCycleSegment *segment, double X) {
  double top = run->cycle.platen_top;
  return (segment->platen > 0 ? X : 2 * top - X) / run->model->speed;
}

static void fill_frame(SbFrame *out, SbRun *run, const SbCycleSegment *segment, double X,
                       double s) {
  const SbCycle *cycle = &run->cycle;
  const SbChamber chamber = segment->chamber;
  const int direction = segment->direction;
  SbInstant at = {
      .sample = {.time = time_of(run, segment, X),
                 .position = s,
                 .drive_position = X,
                 .drive_force = sb_cycle_force(cycle, X, s),
                 .spring_force = -run->model->spring_preload - run->model->spring_stiffness * s},
      .stage = segment->stage,
      .chamber = chamber,
      .solved = {chamber, direction, direction},
      .moving = segment->mode != SB_CYCLE_STICK,
      .pressure = sb_model_seal_pressure(run->model, SB_OUTER, chamber).left,
  };
  SbDynamicsSample *sample = &at.sample;
  double friction = sb_cycle_balance(cycle, segment, X, s, &sample->stop_force[SB_END_STOP]);
  if (segment->mode == SB_CYCLE_SLIP && segment->platen1 != segment->platen0) {
    sample->speed = segment->platen * run->model->speed * sb_cycle_stem_rate(cycle, segment, s);
  }
  double total = sb_cycle_friction(cycle, chamber, direction, s);
  double sign = direction == SB_CYCLE_IN ? -1 : 1;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    double own = sb_cycle_seal_friction(cycle, seal, chamber, direction, s);
    if (at.moving) {
      sample->friction[seal] = sign * own;
    } else if (total > 0) {
      // A stuck stem's friction is divided between the seals in proportion to their limits.
      sample->friction[seal] = -friction * own / total;
    }
  }
  sb_run_fill_frame(out, run, &at);
}

// Evenly spaced frames, and one at the end of every segment so that corners are sharp.
static SbStatus emit_frames(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  const SbCycle *cycle = &run->cycle;
  const double speed = run->model->speed, duration = 2 * cycle->platen_top / speed;
  size_t total = (size_t)run->plan.frames;
  size_t next = 0;  // evenly spaced frame to come
  size_t count = 0; // frames written
  for (size_t i = 0; i < cycle->count; i++) {
    const SbCycleSegment *segment = &cycle->segment[i];
    double end = time_of(run, segment, segment->platen1);
    for (; next < total && segment->mode != SB_CYCLE_JUMP; next++) {
      double t = duration * (double)next / (double)(total - 1);
      if (t >= end) {
        break;
      }
      double X = segment->platen > 0 ? speed * t : 2 * cycle->platen_top - speed * t;
      X = fmin(fmax(X, fmin(segment->platen0, segment->platen1)),
               fmax(segment->platen0, segment->platen1));
      fill_frame(&run->frames[count++], run, segment, X, sb_cycle_stem(cycle, segment, X));
      if (sb_run_poll(run, hooks, count, (double)next / (double)total, report)) {
        return SB_ERROR_CANCELLED;
      }
    }
    // The corner. An event's figures are those just before it.
    SbFrame *corner = &run->frames[count++];
    fill_frame(corner, run, segment, segment->platen1, segment->stem1);
    if (segment->event >= 0) {
      corner->on_event = 1;
      sb_run_mark_stage(run, (SbStage)segment->event, corner, count - 1);
    }
    sb_run_publish(run, count);
  }
  if (count > 0) {
    sb_run_mark_stage(run, SB_STAGE_A, &run->frames[0], 0);
  }
  run->summary.duration = duration;
  return SB_OK;
}

// Returns the error of the cycle's works that the films' error causes, divided by the largest
// external work.
static double error_work(const SbRun *run) {
  const double peak = run->summary.force_peak;
  // Static friction does work only over the machine's deflection before the stem slips.
  const double yields = fmin(1, peak / (run->model->stiffness * run->model->stroke));
  double error = 0;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    error += run->friction_error[seal] + yields * run->static_error[seal];
  }
  return peak > 0 ? error / peak : 0;
}

// Energies, forces and outcome of the cycle; `out` has its stages.
static SbStatus take_figures(SbSummary *out, SbRun *run, SbReport *report) {
  const SbCycle *cycle = &run->cycle;
  double press = 0;
  sb_cycle_energy(cycle, &out->energy);
  out->force_peak = 0;
  for (const SbCycleSegment *at = cycle->segment; at < cycle->segment + cycle->count; at++) {
    const double force = sb_cycle_force(cycle, at->platen1, at->stem1);
    out->force_peak = fmax(out->force_peak, force);
    press = at->stage < SB_STAGE_D ? fmax(press, force) : press;
  }
  const SbRunEnd end = {.top = cycle->stem_top,
                        .position = cycle->stem_end,
                        .dwell = cycle->dwell,
                        .press = press,
                        .sliding_least = INFINITY};
  return sb_run_conclude_motion(out, run, &end, report);
}

// All figures of the cycle without frames.
static SbStatus compute_figures(SbSummary *out, SbRun *run, SbReport *report) {
  const SbCycle *cycle = &run->cycle;
  memset(out->stage, 0, sizeof out->stage);
  sb_figures_clear(out);
  for (const SbCycleSegment *at = cycle->segment; at < cycle->segment + cycle->count; at++) {
    SbStageMark *mark = at->event >= 0 ? &out->stage[at->event] : NULL;
    if (mark != NULL && !mark->reached) {
      const double force = sb_cycle_force(cycle, at->platen1, at->stem1);
      *mark = (SbStageMark){true, time_of(run, at, at->platen1), at->stem1, force, 0};
    }
  }
  out->duration = 2 * cycle->platen_top / run->model->speed;
  out->force_breakaway = out->stage[SB_STAGE_B].reached ? out->stage[SB_STAGE_B].force : NAN;
  SbStatus status = take_figures(out, run, report);
  sb_run_set_user_fractions(out, run->model);
  return status;
}

// Computes the errors of the cycle's figures that the states' errors cause: the cycle is built
// again with each of them. The cycle is unchanged afterwards.
static SbStatus find_errors(SbRun *run, SbReport *report) {
  struct {
    SbCycle cycle;
    SbSummary right, other;
  } *own = calloc(1, sizeof *own);
  if (own == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the cycle's errors");
  }
  own->cycle = run->cycle;
  SbStatus status = compute_figures(&own->right, run, report);
  for (int i = 0; i < SB_RUN_PERTURBATIONS && status == SB_OK; i++) {
    if (sb_run_perturb(run, i)) {
      if (sb_cycle_build(&run->cycle, NULL) == SB_OK &&
          compute_figures(&own->other, run, NULL) == SB_OK) {
        sb_run_add_errors(run, &own->right, &own->other, 1);
      } else {
        sb_run_lose_errors(run);
      }
    }
    run->cycle = own->cycle;
  }
  free(own);
  sb_run_leak_error(run);
  return status;
}

SbStatus sb_run_quasi_static(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  SbSummary *summary = &run->summary;
  const SbCycle *cycle = &run->cycle;
  SbStatus status = sb_cycle_build(&run->cycle, report);
  SbStatus frames = emit_frames(run, hooks, status == SB_OK ? report : NULL);
  status = status != SB_OK ? status : frames;
  // Film transported out under the outer seal on the in-stroke, minus what comes back (thesis
  // equation 5.21).
  const double carries = sb_model_way(run->model); // the direction that leaves a layer outside
  sb_bore_start(&run->bore, carries * cycle->segment[0].stem0);
  for (const SbCycleSegment *at = cycle->segment; at < cycle->segment + cycle->count; at++) {
    sb_bore_move(&run->bore, carries * at->stem0, carries * at->stem1,
                 sb_run_layer(run, SB_OUTER, at->chamber, at->direction, run->speed));
  }
  SbStatus ended = take_figures(summary, run, status == SB_OK ? report : NULL);
  status = status != SB_OK ? status : ended;
  sb_run_leakage(summary, run->model, &run->bore);
  summary->steps = cycle->count;
  SbStatus speeds = sb_run_close_speeds(run, status == SB_OK ? report : NULL);
  status = status != SB_OK ? status : speeds;
  if (status == SB_OK && !run->follows) {
    status = find_errors(run, report);
  }
  summary->error_force = summary->error_load + sb_run_error_friction(run);
  summary->error_energy = fmax(summary->energy.closure, summary->error_load + error_work(run));
  return status;
}
