// Periodic stick-slip, for dynamics.h: a stiff machine has millions of cycles, which are not
// stepped through.
//
// Equal cycles. If loads and the drive's speed are constant, equal states at two break-aways give
// equal cycles for ever: the same contacts are at rest or slide, with the same stretch of the
// drive's spring, deflections, speed and dwells. A cycle may have several slips, of contacts that
// alternate: break-aways are compared with one that is replaced after 1, 2, 4, ... others (Brent
// 1980). A stem that leaves the platen and is met by it again has all of that in its cycle. Time
// advances by a whole number of periods, the stem by as much as the drive, every energy by the same
// multiple of its gain in one period. Exact.
//
// Cycles that change slowly, of rigid contacts: loads change with the position, the drive's speed
// with time, static friction with the dwell. When the contacts break away the stem is at rest, and
// its position follows from the balance of forces alone, so the motion can be continued at any
// later break-away. In between, every term of energy is the integral of its mean power in a cycle,
// known at both ends of the group and before it: that of the parabola through the three. Groups are
// as long as the break-away force, which is known beforehand, is a parabola to the tolerance
// (envelope following; Petzold 1981, multirevolution methods). The phase of the oscillation behind
// a group differs from that of stepping, which no tolerance would determine after 1e5 cycles
// either.
//
// Neither passes a requested time, an edge, a stop or the drive's next piece. Slow changes with
// elastic contacts: dynamics_envelope.c.
#include "engine/mechanism/dynamics_internal.h"

#include <math.h>
#include <string.h>

// Smallest number of cycles that are passed over: fewer are stepped through, and reported to the
// listener.
static const double worth = 10.0;

// Travel of the stem in a cycle, over the noise of places, above which cycles are compared.
static const double moves_least = 1e6;

// Break-aways after which cycles under constant loads are taken as slowly changing.
static const long patience = 100;

// What the force that breaks the contacts away and the drive's speed may be off their parabolas in
// a group, over themselves: so many times the tolerance of the numerical path, and no more than
// leaves the balance of energies closed.
static const double group_bend = 10.0, group_bend_most = 5e-7;

// Largest relative change of a mean power in a group; smaller powers than the last number times the
// largest do not count. Stick-slip ends where friction no longer falls with the speed, and no group
// may pass over that.
static const double group_moves = 0.05, group_small = 1e-3;

bool sb_motion_undisturbed(const SbDynamics *s, const SbDynamicsBreak *was) {
  const SbDynamicsModel *m = s->model;
  const SbDynamicsBreak *now = &s->broke;
  bool settled = m->extra_rate == NULL || (s->loads.settled && was->at.extra == now->at.extra);
  for (size_t i = 0; i < m->stops; i++) {
    settled = settled && !s->wall[i].on;
  }
  return settled && s->wall[SB_DYNAMICS_PLATEN].on && !sb_motion_by_force(m) &&
         was->event != EVENT_NONE && was->region == now->region && was->others == now->others &&
         was->until == now->until;
}

// A cycle from `was` to now.
static bool comparable(const SbDynamics *s, const SbDynamicsBreak *was) {
  const SbDynamicsBreak *now = &s->broke;
  return sb_motion_undisturbed(s, was) && was->event == now->event && now->t > was->t &&
         now->at.x != was->at.x;
}

static bool close_to(double a, double b, double noise) {
  return fabs(a - b) <= 1e-9 * fabs(b) + noise;
}

// Change of the stretch of the drive's spring with the place of the stem.
static double drift(const SbDynamics *s) {
  return s->model->spring_stiffness / s->wall[SB_DYNAMICS_PLATEN].stiffness;
}

static bool equal(const SbDynamics *s, const SbDynamicsBreak *a, const SbDynamicsBreak *b) {
  double noise = 4e-16 * (fabs(a->at.x) + fabs(sb_motion_drive_at(s, s->t).value));
  // The force of a return spring increases along the motion, and only stretches the drive's spring
  // further.
  const double yield = drift(s) * (a->at.x - b->at.x);
  // Off the platen that force alone acts, another in each cycle.
  const bool pressed = drift(s) == 0.0 || a->platens == b->platens;
  // A cycle in which the stem moves by little more than that noise is not known to be one.
  const bool moves = fabs(a->at.x - b->at.x) > moves_least * noise;
  bool same = pressed && moves && close_to(a->stretch - yield, b->stretch, noise) &&
              close_to(a->at.v, b->at.v, 1e-9 * fabs(s->piece.rate));
  for (size_t i = 0; i < s->model->contacts; i++) {
    const bool rests = a->state[i] == SB_CONTACT_STUCK;
    same = same && a->state[i] == b->state[i] && close_to(a->at.d[i], b->at.d[i], noise) &&
           (!rests || close_to(a->rest[i], b->rest[i], sb_motion_time_noise(s->t)));
  }
  return same;
}

SbMotionAhead sb_motion_ahead(const SbDynamics *s, int direction) {
  const SbDynamicsModel *m = s->model;
  SbMotionAhead ahead = {s->piece.until - s->t, INFINITY};
  if (direction > 0 && s->region < m->edges) {
    ahead.way = m->edge[s->region] - s->at.x;
  } else if (direction < 0 && s->region > 0) {
    ahead.way = s->at.x - m->edge[s->region - 1];
  }
  for (size_t i = 0; i < m->stops; i++) {
    if (m->stop[i].side == direction) {
      ahead.way = fmin(ahead.way, m->stop[i].side * (m->stop[i].position - s->at.x));
    }
  }
  ahead.way -= fabs(s->broke.stretch);
  return ahead;
}

void sb_motion_pass(SbDynamics *s, double until, double x, double cycles) {
  const double before = s->t;
  s->t = until;
  s->at.x = x;
  // A stop's fades, and is no part of a cycle.
  for (size_t i = 0; i < s->model->stops; i++) {
    s->energy.stop += sb_motion_relaxed(s, i, before, until);
  }
  for (size_t i = 0; i < s->model->contacts; i++) {
    s->since[i] += until - before;
    s->slipped[i] += until - before;
  }
  s->counters.repeated += (long)fmin(cycles, 1e15);
}

void sb_motion_note(SbDynamics *s, int event) {
  SbDynamicsBreak *b = &s->broke;
  *b = (SbDynamicsBreak){.event = event,
                         .region = s->region,
                         .events = s->counters.events,
                         .platens = s->platens,
                         .others = s->others,
                         .segments = s->counters.segments,
                         .t = s->t,
                         .until = s->piece.until,
                         .stretch = sb_motion_drive_at(s, s->t).value - s->at.x,
                         .at = s->at,
                         .energy = s->energy};
  for (size_t i = 0; i < s->model->contacts; i++) {
    b->state[i] = s->state[i];
    b->rest[i] = s->t - s->since[i];
  }
}

// Goes on by cycles equal to the one from `was` to now; false if they are too few.
static bool pass_equal(SbDynamics *s, const SbDynamicsBreak *was, int event) {
  const double period = s->t - was->t, step = s->at.x - was->at.x;
  const double longer = s->broke.stretch - was->stretch; // by the return spring, in each cycle
  const SbMotionAhead ahead = sb_motion_ahead(s, step > 0.0 ? 1 : -1);
  const double time = fmin(ahead.time, s->asked - s->t);
  double times = fmin(time / period, ahead.way / fabs(step));
  if (drift(s) > 0.0 && step < 0.0 && !s->model->drive_bonded) {
    // No further than the machine surely presses.
    times = fmin(times, 0.5 * s->least_stretch / (drift(s) * -step));
  }
  times = floor(times) - 2.0;
  if (!(times >= worth) || !isfinite(times)) {
    return false;
  }
  const double until = s->t + times * period, y = sb_motion_drive_at(s, s->t).value;
  const double go = sb_motion_drive_at(s, until).value - y, stop = s->energy.stop;
  for (int i = 0; i < SB_DYNAMICS_TERMS; i++) {
    s->energy.term[i] += times * (s->energy.term[i] - was->energy.term[i]);
  }
  if (drift(s) > 0.0) {
    // The machine's force rises from cycle to cycle.
    s->energy.drive += 0.5 * (times + 1.0) * s->wall[SB_DYNAMICS_PLATEN].stiffness * longer * go;
  }
  s->energy.stop = stop;
  sb_motion_pass(s, until, s->at.x + go / (1.0 + drift(s)), times);
  sb_motion_note(s, event);
  return true;
}

double sb_motion_under_parabola(const double x[3], const double y[3], double a, double b) {
  const double first = (y[1] - y[0]) / (x[1] - x[0]);
  const double second = ((y[2] - y[1]) / (x[2] - x[1]) - first) / (x[2] - x[0]);
  // From the middle, so that no digits are lost.
  const double h = 0.5 * (b - a), at = 0.5 * (a + b);
  const double value = y[0] + (at - x[0]) * (first + second * (at - x[1]));
  return 2.0 * h * (value + second * h * h / 3.0);
}

// The last group's energies, now that a cycle behind it is known.
static void close_group(SbDynamics *s, double middle, const double *power) {
  const SbDynamicsGroup *g = &s->group;
  const double x[3] = {g->middle[0], g->middle[1], middle};
  for (int k = 0; k < SB_DYNAMICS_TERMS; k++) {
    const double y[3] = {g->power[0][k], g->power[1][k], power[k]};
    s->energy.term[k] += sb_motion_under_parabola(x, y, g->from, g->to) - g->taken[k];
  }
}

// Returns the position of the stem at time t just when its rigid contacts would break away, after a
// dwell that has changed since the last one at the same rate as since the group before.
static double place_at(const SbDynamics *s, double t, int direction) {
  const SbDynamicsGroup *g = &s->group;
  SbDynamics there = *s;
  SbDynamicsState z = s->at;
  const double k = s->wall[SB_DYNAMICS_PLATEN].stiffness + s->model->spring_stiffness;
  for (size_t i = 0; i < s->model->contacts; i++) {
    if (s->state[i] != SB_CONTACT_OFF) {
      there.state[i] = SB_CONTACT_STUCK;
      there.since[i] = t - fmax(0.0, s->broke.rest[i] + g->slower[i] * (t - s->t));
    }
  }
  there.held = true;
  there.banded = false;
  z.v = 0.0;
  z.x += sb_motion_drive_at(s, t).value - sb_motion_drive_at(s, s->t).value;
  for (int step = 0; step < 6; step++) {
    Point p;
    sb_motion_point(&p, &there, t, &z);
    double over = direction * p.sum.f0;
    for (size_t i = 0; i < s->model->contacts; i++) {
      over -=
          there.state[i] == SB_CONTACT_STUCK ? sb_motion_holding(&there, &p, i, direction) : 0.0;
    }
    z.x += direction * over / k;
  }
  return z.x;
}

// Returns how far the stem has moved at time t, at its break-away there: farther than its speed now
// times the time where the drive becomes faster.
static double way_to(const SbDynamics *s, double t, int direction) {
  return direction * (place_at(s, t, direction) - s->at.x);
}

// Parabola through the values at the begin, middle and end of five: how far the others are off it.
static double off_parabola(const double y[5]) {
  const double early = 0.375 * y[0] + 0.75 * y[2] - 0.125 * y[4];
  const double late = -0.125 * y[0] + 0.75 * y[2] + 0.375 * y[4];
  return fmax(fabs(y[1] - early), fabs(y[3] - late)) / fabs(y[2]);
}

// The same for the force that breaks the contacts away from now until a time, and the drive's
// speed.
static double bend(const SbDynamics *s, double until, int direction) {
  double force[5], speed[5];
  for (int i = 0; i < 5; i++) {
    const double t = s->t + 0.25 * i * (until - s->t);
    const Moving drive = sb_motion_drive_at(s, t);
    force[i] = drive.value - place_at(s, t, direction);
    speed[i] = drive.rate;
  }
  return fmax(off_parabola(force), off_parabola(speed));
}

// Returns whether static friction changes slowly only: if it grows with the dwell, a different
// dwell before the first cycle decays from cycle to cycle.
static bool settled(SbDynamics *s) {
  SbDynamicsGroup *g = &s->group;
  const double noise = 8.0 * sb_motion_time_noise(s->t);
  bool still = true;
  for (size_t i = 0; i < s->model->contacts; i++) {
    const double rest = s->broke.rest[i], change = rest - g->rest[i];
    if (s->state[i] == SB_CONTACT_SLIP &&
        (s->model->contact[i].dwell_gain > 0.0 || s->loads.rest[i] != NULL)) {
      still = still && fabs(change - g->longer[i]) <= 1e-7 * rest + noise;
    }
    g->rest[i] = rest;
    g->longer[i] = change;
  }
  return still;
}

// Returns the time in which no mean power changes by more than a group may, at the rate since the
// group before. `power` is that of the cycle around `middle`.
static double power_lasts(const SbDynamicsGroup *g, const double *power, double middle) {
  double largest = 0.0, lasts = INFINITY;
  for (int k = 0; k < SB_DYNAMICS_TERMS; k++) {
    largest = fmax(largest, fabs(power[k]));
  }
  for (int k = 0; k < SB_DYNAMICS_TERMS; k++) {
    const double slope = fabs(power[k] - g->power[1][k]) / (middle - g->middle[1]);
    if (fabs(power[k]) > group_small * largest && slope > 0.0) {
      lasts = fmin(lasts, group_moves * fabs(power[k]) / slope);
    }
  }
  return lasts;
}

// Returns the duration of the next group, no longer than `lasts`, of cycles with the `period` in
// which the stem moves at the mean `speed`; less than `worth` periods: there is none.
static double span_of(const SbDynamics *s, double period, double speed, int direction,
                      double lasts) {
  const double tolerance = s->model->tolerance > 0.0 ? s->model->tolerance : 1e-9;
  const double bound = fmin(group_bend * tolerance, group_bend_most);
  const SbMotionAhead ahead = sb_motion_ahead(s, direction);
  const double time = fmin(ahead.time, s->asked - s->t);
  double span = fmax(4.0 * s->group.span, 2.0 * worth * period);
  span = fmin(span, fmin(time, ahead.way / speed) - worth * period); // time to close it
  span = fmin(span, lasts);
  const double room = ahead.way - worth * period * speed;
  while (span >= worth * period &&
         (way_to(s, s->t + span, direction) > room || bend(s, s->t + span, direction) > bound)) {
    span *= 0.5;
  }
  return span;
}

// Goes on by a group of cycles that are like the one from `was` to now.
static void pass_group(SbDynamics *s, const SbDynamicsBreak *was, int event) {
  SbDynamicsGroup *g = &s->group;
  const int direction = event == EVENT_RIGID_UP ? 1 : -1;
  const double period = s->t - was->t, middle = s->t - 0.5 * period;
  const double speed = direction * (s->at.x - was->at.x) / period;
  double power[SB_DYNAMICS_TERMS];
  for (int k = 0; k < SB_DYNAMICS_TERMS; k++) {
    power[k] = (s->energy.term[k] - was->energy.term[k]) / period;
  }
  if (!settled(s)) {
    return;
  }
  if (g->open) {
    close_group(s, middle, power);
    s->broke.energy = s->energy;
    g->open = false;
  }
  // The first cycle has another past, and is not one of those a group's powers follow from.
  const bool first = g->middle[1] == 0.0, early = g->middle[0] == 0.0;
  for (size_t i = 0; i < s->model->contacts && !first; i++) {
    g->slower[i] = (s->broke.rest[i] - g->rested[i]) / (middle - g->middle[1]);
  }
  const double lasts = early ? INFINITY : power_lasts(g, power, middle);
  const double span = span_of(s, period, speed, direction, lasts);
  const double until = s->t + span;
  const bool goes = !early && speed > 0.0 && span >= worth * period && isfinite(span);
  const double x = goes ? place_at(s, until, direction) : s->at.x;
  if (!early && !(direction * (x - s->at.x) > 0.0)) {
    return;
  }
  // Straight on from the last two cycles that are known.
  for (int k = 0; k < SB_DYNAMICS_TERMS; k++) {
    const double slope = (power[k] - g->power[1][k]) / (middle - g->middle[1]);
    g->taken[k] = goes ? span * (power[k] + 0.5 * slope * (span + period)) : 0.0;
    s->energy.term[k] += g->taken[k];
    g->power[0][k] = g->power[1][k];
    g->power[1][k] = power[k];
  }
  memcpy(g->rested, s->broke.rest, sizeof g->rested);
  g->middle[0] = g->middle[1];
  g->middle[1] = middle;
  if (goes) {
    g->from = s->t;
    g->to = until;
    g->span = span;
    g->open = true;
    s->counters.grouped += (long)fmin(span / period, 1e15);
    sb_motion_pass(s, until, x, span / period);
    sb_motion_note(s, event);
  }
}

void sb_motion_repeat(SbDynamics *s, int event) {
  const SbDynamicsModel *m = s->model;
  const SbDynamicsBreak was = s->broke;
  sb_motion_note(s, event);
  bool rigid_ones = event < EVENT_CONTACT_UP;
  const bool steady = s->loads.constant && !s->piece.curved;
  if (steady && comparable(s, &s->mark) && equal(s, &s->broke, &s->mark)) {
    const SbDynamicsBreak mark = s->mark;
    if (pass_equal(s, &mark, event)) {
      s->mark = s->broke;
      s->least_stretch = INFINITY;
    }
    return;
  }
  if (!sb_motion_undisturbed(s, &was)) {
    s->mark_after = 0;
    s->group = (SbDynamicsGroup){0};
  }
  if (s->since_mark++ >= s->mark_after) {
    s->mark = s->broke;
    s->mark_after = s->mark_after > 0 ? 2 * s->mark_after : 1;
    s->since_mark = 0;
    s->least_stretch = INFINITY;
  }
  for (size_t i = 0; i < m->contacts; i++) {
    rigid_ones = rigid_ones && is_rigid(m, i);
  }
  const bool patient = steady && s->mark_after < patience;
  const long slips = s->broke.events - was.events - (s->broke.platens - was.platens);
  if (rigid_ones && !patient && comparable(s, &was) && slips == 2) {
    pass_group(s, &was, event);
  } else if (!rigid_ones && !steady) {
    sb_motion_envelope(s);
  }
}
