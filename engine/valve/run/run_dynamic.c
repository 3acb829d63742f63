// Frames and figures of the motion with inertia: the valve (run_valve.c) given to
// mechanism/dynamics.h, in one pass.
//
// The motion is computed from event to event. A frame is an evaluation at its time, and an
// additional frame is placed at every stage, filled just before the event changes anything. Frames
// are evenly spaced during the drive. A stem that still moves afterwards is followed with steps
// that grow with time, until it is at rest.
//
// If the motion has no closed form (the land's edge under the contact, friction that depends on
// speed, a chamber that fills) it is integrated to output.motion_tolerance, and the same motion at
// ten times that tolerance gives the error: with break-away in the cycle a sum of local errors is
// not meaningful. Radau IIA has order 5 in its step, so errors decrease about in proportion to the
// tolerance (tested: test_run_limits.c).
#include "engine/valve/run/run_private.h"

#include "engine/valve/figures/figures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Instants at which a motion without frames halts: for a cancel, no more.
enum { WITHOUT_FRAMES = 9 };

// Below this tolerance rounding exceeds the error of the steps.
static const double least_tolerance = 1e-12;

// Up to this tolerance a motion's frames are published while they are computed. The energy balance
// of a coarser one may be open by more than is allowed; the motion is then repeated with smaller
// steps.
static const double sure_tolerance = 1e-8;

// A motion and the data recorded during it.
typedef struct {
  SbRun *run;
  SbValve valve;
  SbDynamicsModel model;
  SbDynamics motion;
  SbDynamicsEnergy energy; // at its end
  bool frames;             // record them; a run for the error estimate does not
  size_t count;            // frames written
  SbStage stage;           // last passed
  SbStageMark mark[SB_STAGE_COUNT];
  int direction;                // of the last sliding
  bool stopped;                 // the stem is in contact with the end stop
  double force_peak;            // [N]
  double return_least;          // smallest force that pushed the stem out while it slid back [N]
  double press;                 // force_peak when the stem meets the stop [N]
  double top;                   // largest displacement [m]
  double rested;                // time at which the in-stroke came to rest [s]
  double leak_from, leak_since; // place [m] and time [s] up to which it is known
  double leak_last, leak_last_time; // where the stem was last seen, and when it came there
  double home;                // time at which the stem is back on its rest stop [s], 0: not yet
  double middle, middle_back; // speed at the middle of B-C and of F-A [m/s], 0: not yet
  bool slips;                 // some contact has slid
  double net;      // what the film carried out less what it carried back, at the end [m2]
  SbStatus status; // of the frames' reactions
  SbReport *report;
} Recorder;

// Moves the film dragged along up to a place that the stem passed at the time `until`: the film of
// the present state and of the mean speed since it was last moved.
static void carry(Recorder *r, double end, double until, double pressure) {
  SbRun *run = r->run;
  const double way = end - r->leak_from;
  const int direction = way > 0 ? SB_CYCLE_IN : SB_CYCLE_OUT;
  const SbChamber chamber = sb_valve_solved(&r->valve, direction, pressure).chamber;
  const double speed = until > r->leak_since ? way / (until - r->leak_since) : run->speed;
  if (way != 0) {
    const double carries = sb_model_way(run->model);
    sb_bore_move(&run->bore, carries * r->leak_from, carries * end,
                 sb_run_layer(run, SB_OUTER, chamber, direction, speed));
  }
  r->leak_from = end;
  r->leak_since = until;
}

// Film dragged along by a stem that is at x. A contact carries what has entered it over its own
// width, so that sticks and slips shorter than that count as one sliding: the film moves by whole
// widths, up to where the stem turns, and up to x `now`. The stem passes the end of a width between
// two frames or segments, at even speed.
static void leak(Recorder *r, double time, double x, double pressure, bool now) {
  const SbSealState *outer = &r->run->cycle.state[SB_OUTER][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
  const double width = outer->contact_right - outer->contact_left;
  const double last = r->leak_last;
  if ((x - last) * (last - r->leak_from) < 0) {
    carry(r, last, r->leak_last_time, pressure);
  }
  const double way = x - r->leak_from;
  if (now || !(width > 0)) {
    carry(r, x, x != last ? time : r->leak_last_time, pressure);
    r->leak_since = time;
  } else if (fabs(way) >= width) {
    const double end = r->leak_from + copysign(width * floor(fabs(way) / width), way);
    const double share = x != last ? fmin(fmax((end - last) / (x - last), 0), 1) : 1;
    carry(r, end, r->leak_last_time + share * (time - r->leak_last_time), pressure);
  }
  r->leak_last_time = x != last ? time : r->leak_last_time; // a dwell at the end is not sliding
  r->leak_last = x;
}

// Adds a frame of the motion as it is now.
static SbFrame *add_frame(Recorder *r, bool event) {
  SbRun *run = r->run;
  SbInstant at = {.stage = r->stage, .chamber = r->valve.chamber};
  SbDynamicsSample *sample = &at.sample;
  sb_dynamics_sample(&r->motion, sample, NULL);
  at.pressure = sb_valve_chamber_pressure(&r->valve, sample->extra);
  leak(r, sample->time, sample->position, at.pressure, event);
  r->force_peak = fmax(r->force_peak, sample->drive_force);
  r->top = fmax(r->top, sample->position);
  if (!r->frames || r->count == run->capacity) {
    return NULL;
  }
  at.moving = sample->speed != 0;
  int sliding = sample->speed > 0 ? SB_CYCLE_IN : SB_CYCLE_OUT;
  at.solved = sb_valve_solved(&r->valve, at.moving ? sliding : r->direction, at.pressure);
  SbFrame *out = &run->frames[r->count++];
  sb_run_fill_frame(out, run, &at);
  if (run->bodies != NULL && r->status == SB_OK) {
    r->status = sb_run_bodies_frame(run, r->count - 1, sample, r->report);
  }
  return out;
}

// The first time of each stage counts. Its frame shows the state just before the event.
static void mark(Recorder *r, SbStage stage, const SbMotionEvent *event) {
  if (r->mark[stage].reached) {
    return;
  }
  r->mark[stage] = (SbStageMark){true, event->time, event->position, event->drive_force, 0};
  // The dwell before a break-away and that at the stop are not part of sliding.
  const bool now = stage == SB_STAGE_B || stage == SB_STAGE_D || stage == SB_STAGE_E;
  SbFrame *frame = add_frame(r, now);
  if (frame != NULL) {
    frame->on_event = 1;
    frame->velocity = event->speed;
    sb_run_mark_stage(r->run, stage, frame, r->count - 1);
  }
  r->stage = stage;
}

// Notes the least pressure and spring force minus friction of a stem that slides back. Events
// include the largest speeds of a free return: at the land's edge and at the rest stop.
static void note_return(Recorder *r, const SbDynamicsSample *sample) {
  double force = -sample->loads_force - sample->spring_force;
  bool slides = sample->speed < 0;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    slides = slides && sample->contact[seal] != SB_CONTACT_STUCK;
    force -= sample->friction[seal];
  }
  r->return_least = slides ? fmin(r->return_least, force) : r->return_least;
}

// The stem reaches an edge.
static void meet_edge(Recorder *r, const SbMotionEvent *event, const SbDynamicsSample *sample) {
  const SbValve *valve = &r->valve;
  double edge = valve->edge[event->index];
  leak(r, sample->time, sample->position, sb_valve_chamber_pressure(valve, sample->extra),
       edge == valve->edges.open || edge == valve->edges.closed);
  if (edge == valve->middle && event->sign > 0 && r->stage == SB_STAGE_B && r->middle == 0) {
    r->middle = event->speed;
  } else if (edge == valve->middle && event->sign < 0 && r->stage == SB_STAGE_F &&
             r->middle_back == 0) {
    r->middle_back = -event->speed;
  }
  if (valve->touches && edge == r->run->model->land_edge && event->sign > 0 &&
      r->stage == SB_STAGE_B) {
    mark(r, SB_STAGE_C, event);
  } else if (valve->touches && edge == valve->edges.closed && event->sign < 0 &&
             event->time >= valve->times.turn && valve->chamber != SB_CHAMBER_AT_REST) {
    // A rebound that passes the edge on the in-stroke is not the return.
    mark(r, SB_STAGE_F, event);
  }
}

// The stem reaches a stop.
static void meet_stop(Recorder *r, const SbMotionEvent *event, const SbDynamicsSample *sample) {
  if (event->index == SB_END_STOP) {
    r->stopped = true;
    r->rested = event->time;
    if (!r->mark[SB_STAGE_D].reached) {
      r->press = fmax(r->force_peak, r->motion.force_peak);
    }
    mark(r, SB_STAGE_D, event);
  } else if (r->mark[SB_STAGE_E].reached) {
    leak(r, sample->time, sample->position, sb_valve_chamber_pressure(&r->valve, sample->extra),
         true);
    r->home = r->home == 0 ? event->time : r->home;
  }
}

static void valve_event(const SbMotionEvent *event, void *user) {
  Recorder *r = user;
  const double turn = r->valve.times.turn;
  SbDynamicsSample sample;
  sb_dynamics_sample(&r->motion, &sample, NULL);
  if (r->mark[SB_STAGE_E].reached && event->speed < 0) {
    note_return(r, &sample);
  }
  r->force_peak = fmax(r->force_peak, event->drive_force);
  r->top = fmax(r->top, event->position);
  switch (event->kind) {
  case SB_MOTION_SLIP:
    r->slips = true;
    if (event->sign > 0 && r->stage == SB_STAGE_A) {
      mark(r, SB_STAGE_B, event);
    } else if (event->sign < 0 && event->time >= turn && !r->stopped) {
      mark(r, SB_STAGE_E, event);
    }
    r->direction = event->sign > 0 ? SB_CYCLE_IN : SB_CYCLE_OUT;
    break;
  case SB_MOTION_EDGE:
    meet_edge(r, event, &sample);
    break;
  case SB_MOTION_TOUCH_STOP:
    meet_stop(r, event, &sample);
    break;
  case SB_MOTION_STICK:
    if (r->direction == SB_CYCLE_IN && !r->mark[SB_STAGE_D].reached) {
      r->rested = event->time;
    }
    break;
  case SB_MOTION_LEAVE_STOP:
    if (event->index == SB_END_STOP) {
      // While the stop unloads it moves the stem back by a micrometre or two; the stem's own return
      // begins here.
      r->stopped = false;
      if (event->time >= turn) {
        mark(r, SB_STAGE_E, event);
      }
    } else if (sample.contact[SB_OUTER] == SB_CONTACT_OFF &&
               sample.contact[SB_INNER] == SB_CONTACT_OFF && r->stage == SB_STAGE_A) {
      // Without friction nothing slips: the stem starts where it leaves its stop.
      mark(r, SB_STAGE_B, event);
    }
    break;
  default:
    break;
  }
}

// Corner `index` of the drive [s]; INFINITY behind the last.
static double corner_at(const SbDriveTimes *times, int index) {
  int each = times->first[1] > 0 ? 2 : 1; // in a period
  int period = index / each;
  return index < times->corners ? period * times->period + times->first[index % each] : INFINITY;
}

// At the start of a segment of the motion: the film follows the stem more finely than the frames,
// since a return may be over between two of them. True: the motion is cancelled.
static bool begin_segment(void *data) {
  Recorder *r = data;
  const SbDynamics *motion = &r->motion;
  leak(r, motion->t, motion->at.x, sb_valve_chamber_pressure(&r->valve, motion->at.extra), false);
  return sb_work_step(r->run->work);
}

// Advances the motion from instant to instant until it ends, and adds the frames. `frames`: as many
// as the plan has; otherwise at WITHOUT_FRAMES instants.
static SbStatus advance(Recorder *r, bool frames, const SbRunHooks *hooks, SbReport *report) {
  SbRun *run = r->run;
  SbStatus status = SB_OK;
  const SbDriveTimes *times = &r->valve.times;
  const double drive = times->duration;
  // After the drive's end the motion is followed for the same time, at least ten seconds.
  const double last = drive + fmax(drive, 10);
  const size_t total = frames ? (size_t)run->plan.frames : WITHOUT_FRAMES;
  const double step = drive / (double)(total - 1);
  int corner = 0;
  size_t next = 1;
  double time = 0;
  while (status == SB_OK &&
         (next < total || (!times->ends_run && time < last && !sb_dynamics_at_rest(&r->motion)))) {
    // The next even instant or a corner of the drive before it; behind the drive, wider and wider.
    double even = next < total ? (next + 1 == total ? drive : (double)next * step)
                               : time + fmax(step, (time - drive) / 32);
    double turn = corner_at(times, corner);
    if (turn < even) {
      corner++;
    } else if (next < total) {
      next++;
    }
    corner += turn == even;
    time = fmin(turn, even);
    status = sb_dynamics_advance(&r->motion, time, report);
    r->report = status == SB_OK ? report : NULL; // the first failure is reported
    add_frame(r, false);
    status = status != SB_OK ? status : r->status;
    if (status != SB_OK) {
      break;
    }
    if (frames ? sb_run_poll(run, hooks, r->count, (double)next / (double)total, report)
               : sb_run_cancelled(hooks, report)) {
      status = SB_ERROR_CANCELLED;
    }
  }
  return status;
}

// Makes the valve's mechanism and runs it to its end, to the model's tolerance or one other than 0.
// A motion without frames leaves its warnings to the one that has them.
static SbStatus run_motion(Recorder *r, SbRun *run, bool frames, double tolerance,
                           const SbRunHooks *hooks, SbReport *report) {
  SbWarnings *warnings = &run->summary.warnings;
  const size_t told = warnings->count, dropped = warnings->dropped;
  *r = (Recorder){.run = run, .frames = frames, .report = report, .return_least = INFINITY};
  SbStatus status = sb_valve_set_up(&r->model, &r->valve, run, report);
  if (!frames) {
    warnings->count = told;
    warnings->dropped = dropped;
  }
  r->model.poll = begin_segment;
  r->model.poll_data = r;
  r->model.tolerance = tolerance > 0 ? tolerance : r->model.tolerance;
  status = status == SB_OK ? sb_dynamics_init(&r->motion, &r->model, report) : status;
  if (status != SB_OK) {
    return status;
  }
  r->leak_from = r->leak_last = r->model.start_position;
  sb_bore_start(&run->bore, r->leak_from);
  sb_dynamics_listen(&r->motion, valve_event, r);
  SbFrame *first = add_frame(r, true);
  if (first != NULL) {
    sb_run_mark_stage(run, SB_STAGE_A, first, 0);
  }
  status = advance(r, frames, hooks, report);
  status = sb_work_status(run->work, status, report);
  r->force_peak = fmax(r->force_peak, r->motion.force_peak);
  SbDynamicsSample end;
  sb_dynamics_sample(&r->motion, &end, &r->energy);
  leak(r, end.time, end.position, sb_valve_chamber_pressure(&r->valve, end.extra), true);
  r->net = run->bore.out - run->bore.back;
  return status;
}

static double relative(double a, double b, double scale) {
  return scale > 0 ? fabs(a - b) / scale : 0;
}

// Sets a motion's outcome and the figures that follow from it; `out` has its stages.
static SbStatus conclude_motion(SbSummary *out, const Recorder *r, SbReport *report) {
  SbRun *run = r->run;
  const SbModel *model = run->model;
  const double start = r->model.start_position;
  SbDynamicsSample last;
  sb_dynamics_sample(&r->motion, &last, NULL);
  const double leaves =
      r->mark[SB_STAGE_E].reached ? r->mark[SB_STAGE_E].time : fmax(r->valve.times.turn, r->rested);
  SbRunEnd end = {.start = start,
                  .top = fmax(r->top, start),
                  .position = last.position,
                  .speed = last.speed,
                  .force = last.drive_force,
                  .bonded = r->model.drive_bonded,
                  .dwell = start > 0 ? model->rest : fmax(leaves - r->rested, 0),
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
        fmin(end.sliding_least, sb_cycle_return_margin(&run->cycle, fmin(end.top, model->stroke)));
  }
  return sb_run_conclude_motion(out, run, &end, report);
}

// Figures of a motion that a motion without frames has as well.
static SbStatus compute_figures(SbSummary *out, const Recorder *r, SbReport *report) {
  memset(out->stage, 0, sizeof out->stage);
  sb_figures_clear(out);
  sb_run_fill_motion(out, &r->energy, &r->motion.counters);
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

// Relative; NaN for speeds so far apart that the coarser motion has taken another course.
static double speed_error(double one, double other) {
  const double apart = one > 0 ? fabs(other / one - 1) : 0;
  return apart < 0.5 ? apart : NAN;
}

// Adds a share of what two motions differ by to the errors of the run's figures.
static void add_errors(SbRun *run, const Recorder *one, const SbSummary *of_one,
                       const Recorder *other, const SbSummary *of_other, double share) {
  sb_run_add_errors(run, of_one, of_other, share);
  run->leak_error += share * run->model->bore_circumference * fabs(one->net - other->net);
  run->speed_error[SB_CYCLE_IN] += share * speed_error(one->middle, other->middle);
  run->speed_error[SB_CYCLE_OUT] += share * speed_error(one->middle_back, other->middle_back);
}

// Adds a share of what a motion of other steps differs by.
static SbStatus compare_motions(SbRun *run, const Recorder *one, const Recorder *other,
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
static SbStatus find_state_errors(SbRun *run, const Recorder *same, double tolerance,
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
    Recorder other;
    status = run_motion(&other, run, false, coarse_of(tolerance), hooks, &why);
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
// *coarse is the motion at the coarse tolerance.
static SbStatus estimate_error(Recorder *coarse, const Recorder *fine, double tolerance,
                               double *force, double *work, const SbRunHooks *hooks,
                               SbReport *report) {
  SbRun *run = fine->run;
  Recorder finer;
  const Recorder *other = coarse;
  const double peak = fine->force_peak;
  SbStatus status = run_motion(coarse, run, false, coarse_of(tolerance), hooks, report);
  double share = 0.5 * fmax(1, tolerance * 10 / coarse_of(tolerance));
  if (status == SB_OK && coarse->motion.counters.steps >= fine->motion.counters.steps &&
      tolerance > 10 * least_tolerance) {
    status = run_motion(&finer, run, false, 0.1 * tolerance, hooks, report);
    other = &finer;
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
  } ways[] = {{SB_STAGE_B, SB_STAGE_D}, {SB_STAGE_E, SB_STAGE_F}};
  Recorder r;
  SbStatus status = run_motion(&r, run, false, 0, hooks, report);
  *speed = r.middle;
  run->back_speed = r.middle_back;
  *slips = r.slips;
  for (int i = 0; i < 2 && *speed == 0; i++) {
    const SbStageMark *from = &r.mark[ways[i].from], *to = &r.mark[ways[i].to];
    if (from->reached && to->reached && to->time > from->time) {
      *speed = fabs(to->displacement - from->displacement) / (to->time - from->time);
    }
  }
  const SbStageMark *back = &r.mark[SB_STAGE_E];
  if (*speed == 0 && r.home > back->time) {
    *speed = back->displacement / (r.home - back->time);
  }
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
static bool does_work(const Recorder *r) {
  const SbModel *model = r->run->model;
  const double pushed = fmax(r->force_peak, fabs(sb_model_push(model, 0)));
  const double work = fmax(r->energy.largest, r->energy.largest_stored);
  return !(work < 1e-12 * pushed * model->stroke);
}

// By how much a motion's balance of energies is open.
static double closure_of(const Recorder *r) {
  return does_work(r) ? r->energy.closure : 0;
}

// Writes the energies of a motion. Those of a stem that does not move are 0. Where a spring alone
// returns the stem, no external work is the scale of the other terms: it is not a figure.
static void fill_energy(SbSummary *summary, const Recorder *r, const SbDynamicsCounters *counters) {
  sb_run_fill_motion(summary, &r->energy, counters);
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
static SbStatus follow(Recorder *r, double *tolerance, SbRun *run, const SbRunHooks *hooks,
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
    status = run_motion(r, run, true, *tolerance, hooks, report);
    again = status == SB_OK && *tolerance > sure_tolerance && closure_of(r) > SB_RUN_CLOSURE;
    *tolerance *= again ? 0.1 : 1;
  }
  run->hold = held;
  return status;
}

// Finds the errors of a motion with status SB_OK: of its steps, relative to the largest force and
// to the largest work (NaN: not known), and of the states.
static SbStatus find_errors(double *force, double *work, const Recorder *r, double tolerance,
                            const SbRunHooks *hooks, SbReport *report) {
  SbRun *run = r->run;
  SbStatus status = SB_OK;
  Recorder coarse;
  const Recorder *same = r; // a closed form does not depend on the tolerance
  if (r->motion.counters.steps > 0) {
    SbReport own = {0};
    SbWork part, *whole = begin_part(run, &part);
    SbStatus estimate = estimate_error(&coarse, r, tolerance, force, work, hooks, &own);
    end_part(run, whole, &part);
    if (estimate == SB_ERROR_NOT_CONVERGED) {
      // The motion itself is valid.
      *force = *work = NAN;
      lose_errors(run, &own);
    } else if (estimate != SB_OK) {
      status = sb_fail(report, estimate, "%s", own.text);
    } else {
      same = &coarse;
    }
  }
  if (status == SB_OK) {
    SbWork part, *whole = begin_part(run, &part);
    status = find_state_errors(run, same, tolerance, hooks, report);
    end_part(run, whole, &part);
  }
  return status;
}

// Sets the errors of forces and energies from those of the states and of the motion.
static void fill_errors(SbRun *run, const Recorder *r, double force, double work) {
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
  Recorder r = {0};
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
  const bool back = fabs(last->displacement - run->frames[0].displacement) < 1e-6 * model->stroke;
  sb_run_leakage(summary, model, &run->bore, back);
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
