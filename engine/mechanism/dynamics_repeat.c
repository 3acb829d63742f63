// Stick-slip that repeats itself, for dynamics.h.
//
// When rigid contacts break away the stem rests and the drive's spring holds what they bear: where
// loads and drive's speed are constant, equal forces at two break-aways in a row make equal cycles
// for ever. A stiff machine has millions of them. They are not stepped through: time goes on by a
// whole number of periods T, the stem by as much as the drive, every energy by as many times what
// it gained in one period. Exact, and never past a time that was asked for, an edge, a stop or the
// drive's next piece. Where loads change with the place cycles differ, and must be stepped; more of
// them than the limits allow are refused when they begin, not when the limit is reached. Leaves
// out: elastic contacts (their patches take turns).
#include "engine/mechanism/dynamics_internal.h"

#include <math.h>

// Cycles that are worth passing over: fewer are stepped through, and told to the listener.
static const double worth = 10.0;

// Break-aways since `was` that can be told ahead: a slip and a rest of all contacts, nothing else.
static bool comparable(const SbDynamics *s, const SbDynamicsBreak *was) {
  const SbDynamicsModel *m = s->model;
  const SbDynamicsBreak *now = &s->broke;
  if (s->system.n > 2 || !s->wall[SB_DYNAMICS_PLATEN].on || s->piece.curved ||
      sb_motion_by_force(m)) {
    return false;
  }
  for (size_t i = 0; i < m->stops; i++) {
    if (s->wall[i].on) {
      return false;
    }
  }
  return was->direction == now->direction && was->region == now->region &&
         was->events + 2 == now->events && was->piece == now->piece && now->t > was->t &&
         now->direction * (now->x - was->x) > 0.0;
}

// How far the stem can go on in its direction before something else happens [m].
static double way_ahead(const SbDynamics *s) {
  const SbDynamicsModel *m = s->model;
  double way = INFINITY;
  if (s->broke.direction > 0 && s->region < m->edges) {
    way = m->edge[s->region] - s->at.x;
  } else if (s->broke.direction < 0 && s->region > 0) {
    way = s->at.x - m->edge[s->region - 1];
  }
  for (size_t i = 0; i < m->stops; i++) {
    if (m->stop[i].side == s->broke.direction) {
      way = fmin(way, m->stop[i].side * (m->stop[i].position - s->at.x));
    }
  }
  return way;
}

SbStatus sb_motion_repeat(SbDynamics *s, int direction, SbReport *report) {
  const SbDynamicsModel *m = s->model;
  double y, rate;
  sb_motion_drive_at(s, s->t, &y, &rate);
  SbDynamicsBreak was = s->broke;
  s->broke = (SbDynamicsBreak){.direction = direction,
                               .region = s->region,
                               .events = s->counters.events,
                               .segments = s->counters.segments,
                               .t = s->t,
                               .x = s->at.x,
                               .stretch = y - s->at.x,
                               .piece = s->piece.at,
                               .energy = s->energy};
  if (!comparable(s, &was)) {
    return SB_OK;
  }
  double period = s->t - was.t, step = fabs(s->at.x - was.x), way = way_ahead(s);
  double noise = 4e-16 * (fabs(y) + fabs(s->at.x));
  bool same = fabs(s->broke.stretch - was.stretch) <= 1e-9 * fabs(was.stretch) + noise;
  for (size_t i = 0; i < m->contacts; i++) {
    same = same && (s->state[i] == SB_CONTACT_OFF || !sb_motion_speed_dependent(m, i));
  }
  if (same && s->loads.constant) {
    double ahead = fmin((fmin(s->asked, s->piece.until) - s->t) / period, way / step);
    double times = floor(ahead) - 2.0;
    if (!(times >= worth) || !isfinite(times)) {
      return SB_OK;
    }
    double before = s->t, there;
    s->t += times * period;
    sb_motion_drive_at(s, s->t, &there, &rate);
    s->at.x += there - y;
    // A stop's fades, and is no part of a cycle.
    double stop = s->energy.stop;
    for (size_t i = 0; i < m->stops; i++) {
      stop += sb_motion_relaxed(s, i, before, s->t);
    }
    for (int i = 0; i < SB_DYNAMICS_TERMS; i++) {
      s->energy.term[i] += times * (s->energy.term[i] - was.energy.term[i]);
    }
    s->energy.stop = stop;
    for (size_t i = 0; i < m->contacts; i++) {
      s->since[i] += s->t - before;
    }
    s->broke.t = s->t;
    s->broke.x = s->at.x;
    s->broke.energy = s->energy;
    s->counters.repeated += (long)fmin(times, 1e15);
    return SB_OK;
  }
  double cycles = fmin((s->piece.until - s->t) / period, way / step);
  double steps = cycles * (double)(s->counters.segments - was.segments);
  double most = (double)(m->max_events > 0 ? m->max_events : 1000000);
  if (isfinite(cycles) && (2.0 * cycles > most - (double)s->counters.events ||
                           steps > 4.0 * most - (double)s->counters.segments)) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                   "stick-slip at %.9g s: about %.2g slips, one every %.2g s, lie ahead where "
                   "friction changes with the place, too many to step through; a softer or a "
                   "damped machine (drive.stiffness, drive.damping_ratio) slips less often",
                   s->t, cycles, period);
  }
  return SB_OK;
}
