// Figures of the motion with inertia and their errors, from recorded motions (run_record.h).
//
// If the motion has no closed form (the land's edge under the contact, friction that depends on
// speed, a chamber that fills) it is integrated to output.motion_tolerance, and the same motion at
// ten times that tolerance gives the error: with break-away in the cycle a sum of local errors is
// not meaningful. Radau IIA has order 5 in its step, so errors decrease about in proportion to the
// tolerance (tested: test_run_limits.c).
#include "engine/valve/run/run_errors.h"
#include "engine/valve/run/run_record.h"

#include "engine/valve/figures/figures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Below this tolerance rounding exceeds the error of the steps.
static const double least_tolerance = 1e-12;

// Up to this tolerance a motion's frames are published while they are computed. The energy balance
// of a coarser one may be open by more than is allowed; the motion is then repeated with smaller
// steps.
static const double sure_tolerance = 1e-8;

// Least relative error of the volume that the film carries in a direction, by the times at which
// the stem passes a place between two instants. Volumes with 60 to 1500 frames differ by up to
// 3e-7.
static const double leak_instants = 2e-7;

static double relative(double a, double b, double scale) {
  return scale > 0 ? fabs(a - b) / scale : 0;
}

// Returns the time between the end of an in-stroke and the first reverse slip [s]; without such a
// slip until the drive turns in that actuation.
static double dwell_of(const SbRecorder *r) {
  const SbDriveTimes *times = &r->valve.times;
  const double before = times->period > 0 ? floor(r->rested / times->period) * times->period : 0;
  return r->mark[SB_STAGE_E].reached ? r->dwell : fmax(before + times->turn - r->rested, 0);
}

// Sets a motion's outcome and the figures that follow from it; `out` has its stages.
static SbStatus conclude_motion(SbSummary *out, const SbRecorder *r, SbReport *report) {
  SbRun *run = r->run;
  const SbModel *model = run->model;
  const double start = r->model.start_position;
  SbDynamicsSample last;
  sb_dynamics_sample(&r->motion, &last, NULL);
  SbRunEnd end = {.start = start,
                  .top = fmax(r->top, start),
                  .position = last.position,
                  .speed = last.speed,
                  .force = last.drive_force,
                  .bonded = r->model.drive_bonded,
                  .dwell = start > 0 ? model->rest : dwell_of(r),
                  .press = r->press,
                  // A fast return's viscous friction takes more than that at the films' speed.
                  .sliding_least = r->return_least};
  if (model->stribeck_speed > 0) {
    // Slow sliding has nearly the static friction.
    SbStatus status = sb_cycle_rest(&run->cycle, 0, report);
    if (status != SB_OK) {
      return status;
    }
    end.sliding_least =
        fmin(end.sliding_least, sb_cycle_static_margin(&run->cycle, fmin(end.top, model->stroke)));
  }
  return sb_run_conclude_motion(out, run, &end, report);
}

// Figures of a motion that a motion without frames has as well.
static SbStatus compute_figures(SbSummary *out, const SbRecorder *r, SbReport *report) {
  memset(out->stage, 0, sizeof out->stage);
  sb_figures_clear(out);
  sb_run_fill_motion(out, &r->energy, &r->motion.counters, r->valve.times.cycles);
  out->force_peak = r->force_peak;
  out->duration = 0; // of the frames
  for (int i = 0; i < SB_STAGE_COUNT; i++) {
    if (r->mark[i].reached) {
      out->stage[i] = r->mark[i];
    }
  }
  out->force_breakaway = out->stage[SB_STAGE_B].reached ? out->stage[SB_STAGE_B].force : NAN;
  sb_run_set_user_fractions(out, r->run->model);
  return conclude_motion(out, r, report);
}

// Returns the speed [m/s] of the in-stroke at its middle; of a stem that does not pass there the
// mean speed of the in-stroke, else that of the return. 0: the motion has none of them.
static double speed_of(const SbRecorder *r) {
  static const struct {
    SbStage from, to;
  } ways[] = {{SB_STAGE_B, SB_STAGE_D}, {SB_STAGE_E, SB_STAGE_F}};
  double speed = r->middle;
  for (int i = 0; i < 2 && speed == 0; i++) {
    const SbStageMark *from = &r->mark[ways[i].from], *to = &r->mark[ways[i].to];
    if (from->reached && to->reached && to->time > from->time) {
      speed = fabs(to->displacement - from->displacement) / (to->time - from->time);
    }
  }
  const SbStageMark *back = &r->mark[SB_STAGE_E];
  return speed == 0 && r->home > back->time ? back->displacement / (r->home - back->time) : speed;
}

// Relative; NaN for speeds so far apart that the coarser motion has taken another course.
static double speed_error(double one, double other) {
  const double apart = one > 0 ? fabs(other / one - 1) : 0;
  return apart < 0.5 ? apart : NAN;
}

// Adds a share of what two motions differ by to the errors of the run's figures.
static void add_errors(SbRun *run, const SbRecorder *one, const SbSummary *of_one,
                       const SbRecorder *other, const SbSummary *of_other, double share) {
  sb_run_add_errors(run, of_one, of_other, share);
  run->leak_error += share * run->model->bore_circumference * fabs(one->net - other->net);
  if (sb_run_finds_speed(run)) {
    const double in = speed_error(speed_of(one), speed_of(other));
    run->speed_error[SB_CYCLE_IN] += share * in;
    run->speed_error[SB_CYCLE_OUT] +=
        share * (one->middle_back > 0 ? speed_error(one->middle_back, other->middle_back) : in);
  }
}

// Adds a share of what a motion of other steps differs by.
static SbStatus compare_motions(SbRun *run, const SbRecorder *one, const SbRecorder *other,
                                double share, SbReport *report) {
  SbSummary *figures = calloc(2, sizeof *figures);
  if (figures == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the motion's errors");
  }
  SbStatus status = compute_figures(&figures[0], one, report);
  status = status == SB_OK ? compute_figures(&figures[1], other, report) : status;
  if (status == SB_OK) {
    add_errors(run, one, &figures[0], other, &figures[1], share);
  }
  free(figures);
  return status;
}

// The motion is valid, but a second one for its error estimate failed.
static void lose_errors(SbRun *run, const SbReport *why) {
  SbSummary *summary = &run->summary;
  sb_run_lose_errors(run);
  sb_reason(summary, "solver.error_estimate.*",
            "a second motion, which measures the error, failed: %s", why->text);
  sb_warn(&summary->warnings, "motion-error-unknown", sb_input(SB_P_OUTPUT_MOTION_TOLERANCE),
          "the motion's error is not known: %s", why->text);
}

// Returns the tolerance of the motions that only measure an error.
static double coarse_of(double tolerance) {
  return fmax(tolerance, fmin(10 * tolerance, 1e-5));
}

// Computes the errors of the motion that the states' errors cause: the motion is repeated with each
// kind of them, at the coarse tolerance, and compared with `same`, the motion without them at that
// tolerance, so that the steps' error is not part of the difference.
static SbStatus find_state_errors(SbRun *run, const SbRecorder *same, double tolerance,
                                  const SbRunHooks *hooks, SbReport *report) {
  struct {
    SbCycle cycle;
    SbSummary same, other;
  } *own = calloc(1, sizeof *own);
  if (own == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the motion's errors");
  }
  SbReport why = {0};
  SbStatus status = compute_figures(&own->same, same, &why);
  own->cycle = run->cycle;
  bool known = true;
  for (int i = 0; i < SB_RUN_PERTURBATIONS && status == SB_OK && known; i++) {
    run->cycle = own->cycle;
    if (!sb_run_perturb(run, i)) {
      continue;
    }
    SbRecorder other;
    status = sb_run_record(&other, run, false, coarse_of(tolerance), hooks, &why);
    status = status == SB_OK ? compute_figures(&own->other, &other, &why) : status;
    if (status == SB_OK) {
      add_errors(run, same, &own->same, &other, &own->other, 1);
    } else if (status == SB_ERROR_NOT_CONVERGED) {
      lose_errors(run, &why);
      known = false;
      status = SB_OK;
    }
  }
  run->cycle = own->cycle;
  free(own);
  if (status != SB_OK && report != NULL) {
    *report = why;
  }
  return status;
}

// Computes the same motion at ten times the tolerance. With errors proportional to the power 5/6 of
// the tolerance (order 5 in the step, order 6 locally) the difference is 5.8 times the error of the
// fine motion. Half of the difference is reported, three times that error, and at least the
// tolerance: the coarse motion may be accurate by chance. If it takes as many steps its errors are
// those of the fine one, and a motion at a tenth of the tolerance gives them: twice the difference.
// others[0] is the motion at the coarse tolerance; others[1] is work memory.
static SbStatus estimate_error(SbRecorder others[2], const SbRecorder *fine, double tolerance,
                               double *force, double *work, const SbRunHooks *hooks,
                               SbReport *report) {
  SbRun *run = fine->run;
  SbRecorder *coarse = &others[0], *finer = &others[1];
  const SbRecorder *other = coarse;
  const double peak = fine->force_peak;
  SbStatus status = sb_run_record(coarse, run, false, coarse_of(tolerance), hooks, report);
  double share = 0.5 * fmax(1, tolerance * 10 / coarse_of(tolerance));
  if (status == SB_OK && coarse->motion.counters.steps >= fine->motion.counters.steps &&
      tolerance > 10 * least_tolerance) {
    status = sb_run_record(finer, run, false, 0.1 * tolerance, hooks, report);
    other = finer;
    share = 2;
  }
  if (status != SB_OK) {
    return status;
  }
  *force = relative(peak, other->force_peak, peak);
  for (int stage = 0; stage < SB_STAGE_COUNT; stage++) {
    *force = fmax(*force, relative(fine->mark[stage].force, other->mark[stage].force, peak));
  }
  if (isfinite(fine->return_least) && isfinite(other->return_least)) {
    *force = fmax(*force, relative(fine->return_least, other->return_least,
                                   fmax(peak, fabs(run->model->pressure_force))));
  }
  *force = fmax(share * *force, tolerance);
  status = compare_motions(run, fine, other, share, report);
  if (status != SB_OK) {
    return status;
  }
  const SbDynamicsEnergy *one = &fine->energy, *two = &other->energy;
  *work = fmax(tolerance, share * fmax(relative(one->drive, two->drive, one->largest),
                                       relative(one->friction, two->friction, one->largest)));
  return SB_OK;
}

void sb_run_fill_motion(SbSummary *summary, const SbDynamicsEnergy *energy,
                        const SbDynamicsCounters *counters, int cycles) {
  const double external = (energy->drive + energy->pressure) / cycles;
  summary->energy = (SbEnergy){
      .external = external,
      // The work of the cycles before adds to that of the last one.
      .external_max = energy->largest - (cycles - 1) * fabs(external),
      .friction = (energy->friction + energy->viscous) / cycles,
      .stored = energy->stored / cycles,
      .seal = (energy->seal + energy->machine) / cycles,
      .kinetic = energy->kinetic / cycles,
      .stop = energy->stop / cycles,
      .loop = (energy->drive - energy->machine) / cycles,
      .closure = sb_cycle_closure(energy->closure),
  };
  summary->steps = (size_t)(counters->segments + counters->steps);
  summary->rejected_steps = (size_t)counters->rejected;
}

SbStatus sb_run_dynamic_speed(double *speed, bool *slips, SbRun *run, const SbRunHooks *hooks,
                              SbReport *report) {
  SbRecorder r;
  SbStatus status = sb_run_record(&r, run, false, 0, hooks, report);
  *speed = speed_of(&r);
  run->back_speed = r.middle_back;
  *slips = r.slips;
  if (*speed == 0 && *slips && run->model->drive == SB_MODEL_DRIVE_SINUSOID) {
    *speed = 4 * run->model->amplitude * run->model->frequency;
  }
  return status;
}

// Returns the error of the linear friction in the bands of speed, divided by the largest force.
static double straight_force(const SbRun *run) {
  double most = 0;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    double level = 0; // without a film
    for (int i = 0; i < SB_CYCLE_CHAMBERS * SB_RUN_REST; i++) {
      const SbSealState *state = &run->cycle.state[seal][i / SB_RUN_REST][i % SB_RUN_REST];
      level = fmax(level, state->touches ? state->rest_area + state->rest_load : 0);
    }
    most += level;
  }
  const double peak = run->summary.force_peak;
  return peak > 0 ? run->straight_error * most / peak : 0;
}

// Returns whether a motion does work. Work over less than the rounding of places is none: a stem
// that is pushed and does not move.
static bool does_work(const SbRecorder *r) {
  const SbModel *model = r->run->model;
  const double pushed = fmax(r->force_peak, fabs(sb_model_push(model, 0)));
  const double work = fmax(r->energy.largest, r->energy.largest_stored);
  return !(work < 1e-12 * pushed * model->stroke);
}

// By how much a motion's balance of energies is open.
static double closure_of(const SbRecorder *r) {
  return does_work(r) ? r->energy.closure : 0;
}

// Writes the energies of a motion. Those of a stem that does not move are 0. Where a spring alone
// returns the stem, no external work is the scale of the other terms: it is not a figure.
static void fill_energy(SbSummary *summary, const SbRecorder *r,
                        const SbDynamicsCounters *counters) {
  sb_run_fill_motion(summary, &r->energy, counters, r->valve.times.cycles);
  if (!does_work(r)) {
    summary->energy = (SbEnergy){0};
  } else if (!(r->energy.largest > 0)) {
    summary->energy.external = summary->energy.external_max = NAN;
    sb_reason(summary, "cycle.energy.external*",
              "neither drive nor pressure does work: the stored energies alone move the stem");
  }
}

// Gives the motions of the error estimates half of the steps that are left: their end leaves the
// motion itself converged, its errors unknown. `part` is the run's budget until end_part().
static SbWork *begin_part(SbRun *run, SbWork *part) {
  SbWork *whole = run->work;
  *part = sb_work_part(whole, 2);
  part->cancelled = whole->cancelled;
  part->data = whole->data;
  run->work = part;
  return whole;
}

static void end_part(SbRun *run, SbWork *whole, const SbWork *part) {
  whole->done += part->done;
  run->work = whole;
}

// The motion with its frames, to the model's tolerance or, where its energies do not balance, to as
// much smaller a one as they need. *tolerance is that of the last.
static SbStatus follow(SbRecorder *r, double *tolerance, SbRun *run, const SbRunHooks *hooks,
                       SbReport *report) {
  SbWarnings *warnings = &run->summary.warnings;
  const size_t told = warnings->count, dropped = warnings->dropped;
  const bool held = run->hold;
  SbStageMark unmarked[SB_STAGE_COUNT];
  memcpy(unmarked, run->summary.stage, sizeof unmarked);
  bool again = true;
  SbStatus status = SB_OK;
  run->hold = held || *tolerance > sure_tolerance;
  while (again) {
    warnings->count = told;
    warnings->dropped = dropped;
    memcpy(run->summary.stage, unmarked, sizeof unmarked);
    sb_run_bodies_destroy(run->bodies);
    run->bodies = NULL;
    status = run->plan.bodies ? sb_run_bodies_create(run, report) : SB_OK;
    if (status != SB_OK) {
      r->count = 0;
      break;
    }
    status = sb_run_record(r, run, true, *tolerance, hooks, report);
    again = status == SB_OK && *tolerance > sure_tolerance && closure_of(r) > SB_RUN_CLOSURE;
    *tolerance *= again ? 0.1 : 1;
  }
  run->hold = held;
  return status;
}

// Finds the errors of a motion with status SB_OK: of its steps, relative to the largest force and
// to the largest work (NaN: not known), and of the states.
static SbStatus find_errors(double *force, double *work, const SbRecorder *r, double tolerance,
                            const SbRunHooks *hooks, SbReport *report) {
  SbRun *run = r->run;
  SbStatus status = SB_OK;
  SbRecorder *others = malloc(2 * sizeof *others);
  if (others == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "out of memory for the motions of the error estimates");
  }
  const SbRecorder *same = r; // a closed form does not depend on the tolerance
  if (r->motion.counters.steps > 0) {
    SbReport own = {0};
    SbWork part, *whole = begin_part(run, &part);
    SbStatus estimate = estimate_error(others, r, tolerance, force, work, hooks, &own);
    end_part(run, whole, &part);
    if (estimate == SB_ERROR_NOT_CONVERGED) {
      // The motion itself is valid.
      *force = *work = NAN;
      lose_errors(run, &own);
    } else if (estimate != SB_OK) {
      status = sb_fail(report, estimate, "%s", own.text);
    } else {
      same = &others[0];
    }
  }
  if (status == SB_OK) {
    SbWork part, *whole = begin_part(run, &part);
    status = find_state_errors(run, same, tolerance, hooks, report);
    end_part(run, whole, &part);
  }
  free(others);
  return status;
}

// Sets the errors of forces and energies from those of the states and of the motion.
static void fill_errors(SbRun *run, const SbRecorder *r, double force, double work) {
  SbSummary *summary = &run->summary;
  double states = summary->error_load + sb_run_error_friction(run);
  summary->error_force = isnan(force) ? NAN : fmax(states, force) + straight_force(run);
  const SbEnergy *energy = &summary->energy;
  double straight = energy->external_max > 0
                        ? run->straight_error * fabs(energy->friction) / energy->external_max
                        : 0;
  const double worst = fmax(fmax(states, work), energy->closure) + straight;
  summary->error_energy = isnan(work) ? NAN : does_work(r) ? worst : 0;
}

SbStatus sb_run_dynamic(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  const SbModel *model = run->model;
  SbSummary *summary = &run->summary;
  SbRecorder r = {0};
  double tolerance = model->motion_tolerance;
  SbStatus status = follow(&r, &tolerance, run, hooks, report);
  sb_run_publish(run, r.count);
  if (r.count == 0) {
    return status;
  }
  const SbDynamicsCounters counters = r.motion.counters;
  const SbFrame *last = &run->frames[r.count - 1];
  summary->duration = last->time;
  summary->force_peak = r.force_peak;
  if (status == SB_OK) {
    status = conclude_motion(summary, &r, report);
  }
  sb_run_leakage(summary, model, &run->bore);
  fill_energy(summary, &r, &counters);
  summary->counters.newton_iterations += (size_t)counters.newton_iterations;
  if (counters.grouped > 0) {
    sb_warn(
        &summary->warnings, "stick-slip-groups", sb_input(SB_P_DRIVE_STIFFNESS),
        "%.2g slips that change slowly were followed by groups of them: forces and energies are "
        "theirs, but where in its slip a frame meets the stem is arbitrary",
        (double)counters.grouped);
  }
  sb_run_leak_error(run);
  run->leak_error += leak_instants * model->bore_circumference * (run->bore.out + run->bore.back);
  if (status == SB_OK && !run->follows && r.count > 1 && !r.valve.times.ends_run) {
    // Rest of the stem is detected at a frame.
    run->motion_error[sb_figure_find("cycle.duration_s")] =
        last->time - run->frames[r.count - 2].time;
  }
  // Closed form throughout: rounding only.
  double force = 1e-12;
  double work = 1e-12;
  if (status == SB_OK && !run->follows) {
    status = find_errors(&force, &work, &r, tolerance, hooks, report);
  }
  SbStatus speeds = sb_run_close_speeds(run, status == SB_OK ? report : NULL);
  status = status != SB_OK ? status : speeds;
  fill_errors(run, &r, force, work);
  return status;
}
