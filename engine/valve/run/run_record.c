// Runs a motion with inertia, the valve (run_valve.h) given to mechanism/dynamics.h, and records it
// in one pass.
//
// The motion is computed from event to event. A frame is an evaluation at its time, and an
// additional frame is placed at every stage, filled just before the event changes anything. Frames
// are evenly spaced during the drive. A stem that still moves afterwards is followed with steps
// that grow with time, until it is at rest.
#include "engine/valve/run/run_record.h"

#include "engine/numeric/root.h"
#include "engine/valve/figures/figures.h"

#include <math.h>
#include <stdlib.h>

// Instants at which a motion without frames halts: for a cancel, no more.
enum { WITHOUT_FRAMES = 9 };

// Instants in an actuation at which its film is followed, at least; without frames the estimate of
// its error has fewer.
enum { FILM_INSTANTS = 600 };

// Moves the film dragged along up to a place that the stem passed at the time `until`: the film of
// the present state and of the mean speed since it was last moved.
static void carry(SbRecorder *r, double end, double until, double pressure) {
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

// Part of a motion between two instants: Hermite's cubic, and a place that the stem passes there.
typedef struct {
  double span, x[2], v[2]; // duration [s]; place and speed at the instants [m], [m/s]
  double place;            // [m]
} Passage;

// Distance beyond the place at a fraction of the duration, > 0 behind it.
static double beyond(double *slope, double fraction, const void *context) {
  const Passage *p = context;
  const double way = p->x[1] > p->x[0] ? 1 : -1;
  const double x = sb_hermite(slope, fraction, p->span, p->x, p->v);
  *slope *= way * p->span;
  return way * (x - p->place);
}

// Film dragged along by a stem that is now at `at`. A contact carries what has entered it over its
// own width, so that sticks and slips shorter than that count as one sliding: the film moves by
// whole widths, up to where the stem turns, and up to the present place if `now`.
static void leak(SbRecorder *r, const SbRecordedPlace *at, double pressure, bool now) {
  const SbSealState *outer = &r->run->cycle.state[SB_OUTER][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
  const double width = outer->contact_right - outer->contact_left;
  const SbRecordedPlace *last = &r->last;
  if ((at->x - last->x) * (last->x - r->leak_from) < 0) {
    carry(r, last->x, r->moved, pressure);
  }
  r->moved = at->x != last->x ? at->time : r->moved; // a dwell at the end is not sliding
  // Between instants that skip cycles of stick-slip, or whose speeds are those of short slips, the
  // stem moves evenly: the cubic is monotone if both speeds are 0 to 3 times the mean (F.N. Fritsch
  // & R.E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238); an even acceleration may exceed that by
  // rounding.
  const double span = at->time - last->time, mean = span > 0 ? (at->x - last->x) / span : 0;
  const double first = last->speed / mean, second = at->speed / mean;
  const bool smooth = r->motion.counters.repeated == r->repeated && first >= 0 && first <= 3.01 &&
                      second >= 0 && second <= 3.01;
  r->repeated = r->motion.counters.repeated;
  while (width > 0 && fabs(at->x - r->leak_from) >= width) {
    const double end = r->leak_from + copysign(width, at->x - r->leak_from);
    const double share =
        at->x != last->x ? fmin(fmax((end - last->x) / (at->x - last->x), 0), 1) : 1;
    const Passage passage = {span, {last->x, at->x}, {last->speed, at->speed}, end};
    const double passed = smooth ? sb_newton_bracketed(beyond, &passage, 0, 1, share) : share;
    carry(r, end, last->time + passed * span, pressure);
  }
  if (now || !(width > 0)) {
    carry(r, at->x, r->moved, pressure);
    r->leak_since = at->time;
  }
  r->last = *at;
}

// As leak(), at an event or a frame.
static void leak_at(SbRecorder *r, const SbDynamicsSample *sample, bool now) {
  const SbRecordedPlace at = {sample->time, sample->position, sample->speed};
  leak(r, &at, sb_valve_chamber_pressure(&r->valve, sample->extra), now);
}

// Adds a frame of the motion as it is now.
static SbFrame *add_frame(SbRecorder *r, bool event) {
  SbRun *run = r->run;
  SbInstant at = {.stage = r->stage, .chamber = r->valve.chamber};
  SbDynamicsSample *sample = &at.sample;
  sb_dynamics_sample(&r->motion, sample, NULL);
  at.pressure = sb_valve_chamber_pressure(&r->valve, sample->extra);
  leak_at(r, sample, event);
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
static void mark(SbRecorder *r, SbStage stage, const SbMotionEvent *event) {
  if (r->mark[stage].reached) {
    return;
  }
  r->mark[stage] = (SbStageMark){true, event->time, event->position, event->drive_force, 0};
  r->dwell = stage == SB_STAGE_E ? event->time - r->rested : r->dwell;
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
static void note_return(SbRecorder *r, const SbDynamicsSample *sample) {
  double force = -sample->loads_force - sample->spring_force;
  bool slides = sample->speed < 0;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    slides = slides && sample->contact[seal] != SB_CONTACT_STUCK;
    force -= sample->friction[seal];
  }
  r->return_least = slides ? fmin(r->return_least, force) : r->return_least;
}

// The stem reaches an edge.
static void meet_edge(SbRecorder *r, const SbMotionEvent *event, const SbDynamicsSample *sample) {
  const SbValve *valve = &r->valve;
  double edge = valve->edge[event->index];
  leak_at(r, sample, edge == valve->edges.open || edge == valve->edges.closed);
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
    // A rebound that passes the edge on the in-stroke is not the return. One that the drive's turn
    // makes the return begins it without a slip or a stop that is left.
    mark(r, SB_STAGE_E, event);
    mark(r, SB_STAGE_F, event);
  }
}

// The stem reaches a stop.
static void meet_stop(SbRecorder *r, const SbMotionEvent *event) {
  if (event->index == SB_END_STOP) {
    r->stopped = true;
    r->rested = event->time;
    if (!r->mark[SB_STAGE_D].reached) {
      r->press = fmax(r->force_peak, r->motion.force_peak);
    }
    mark(r, SB_STAGE_D, event);
  } else if (r->mark[SB_STAGE_E].reached) {
    r->home = r->home == 0 ? event->time : r->home;
  }
}

// Returns whether a stroke begins or ends at an event: dwells at the stops are not part of sliding.
static bool bounds_stroke(const SbRecorder *r, const SbMotionEvent *event) {
  const int direction = event->sign > 0 ? SB_CYCLE_IN : SB_CYCLE_OUT;
  return event->kind == SB_MOTION_TOUCH_STOP || event->kind == SB_MOTION_LEAVE_STOP ||
         (event->kind == SB_MOTION_SLIP && direction != r->direction);
}

static void valve_event(const SbMotionEvent *event, void *user) {
  SbRecorder *r = user;
  const double turn = r->valve.times.turn;
  SbDynamicsSample sample;
  sb_dynamics_sample(&r->motion, &sample, NULL);
  if (r->mark[SB_STAGE_E].reached && event->speed < 0) {
    note_return(r, &sample);
  }
  if (bounds_stroke(r, event)) {
    leak_at(r, &sample, true);
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
    meet_stop(r, event);
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
  SbRecorder *r = data;
  const SbDynamics *motion = &r->motion;
  const SbRecordedPlace at = {motion->t, motion->at.x, motion->at.v};
  leak(r, &at, sb_valve_chamber_pressure(&r->valve, motion->at.extra), false);
  return sb_work_segment(r->run->work);
}

// Advances the motion to `time`, and follows the film at more instants than there are frames.
static SbStatus advance_to(SbRecorder *r, double time, SbReport *report) {
  const SbDriveTimes *times = &r->valve.times;
  const double from = r->motion.now, most = times->duration / (times->cycles * FILM_INSTANTS);
  const int parts = (int)fmin(fmax(ceil((time - from) / most), 1), FILM_INSTANTS);
  SbStatus status = SB_OK;
  for (int i = 1; i < parts && status == SB_OK; i++) {
    SbDynamicsSample sample;
    status = sb_dynamics_advance(&r->motion, from + (time - from) * i / parts, report);
    sb_dynamics_sample(&r->motion, &sample, NULL);
    leak_at(r, &sample, false);
  }
  return status == SB_OK ? sb_dynamics_advance(&r->motion, time, report) : status;
}

// Advances the motion from instant to instant until it ends, and adds the frames. `frames`: as many
// as the plan has; otherwise at WITHOUT_FRAMES instants.
static SbStatus advance(SbRecorder *r, bool frames, const SbRunHooks *hooks, SbReport *report) {
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
    status = frames ? advance_to(r, time, report) : sb_dynamics_advance(&r->motion, time, report);
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

SbStatus sb_run_record(SbRecorder *r, SbRun *run, bool frames, double tolerance,
                       const SbRunHooks *hooks, SbReport *report) {
  SbWarnings *warnings = &run->summary.warnings;
  const size_t told = warnings->count, dropped = warnings->dropped;
  *r = (SbRecorder){.run = run, .frames = frames, .report = report, .return_least = INFINITY};
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
  run->period = r->valve.times.cycles > 1 ? r->valve.times.period : 0;
  r->leak_from = r->last.x = r->model.start_position;
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
  leak_at(r, &end, true);
  run->bore.out /= r->valve.times.cycles;
  run->bore.back /= r->valve.times.cycles;
  r->net = run->bore.out - run->bore.back;
  return status;
}
