// Slowly changing cycles of stick-slip with elastic contacts, for dynamics.h.
//
// Elastic contacts whose friction decreases with the speed vibrate. On a stiff machine the
// amplitude is below a nanometre and a period is below a microsecond, while the loads change with
// the position over tenths of a millimetre. A cycle may have a hundred slips. A cycle ends at the
// break-away whose state is nearly equal to the state at the break-away that began it. From cycle
// to cycle this state moves slowly, and all other motion decays. Such cycles are passed over by
// groups (envelope following; Petzold 1981, multirevolution methods). In a group the stretch of the
// drive's spring, the speed, the deflections and the dwells at the break-away change at the rates
// of the last cycle, with the slope of these rates since the group before. Behind the group the
// motion is stepped through until its cycles are steady again.
//
// Every term of energy is the integral of its mean power in a cycle, which is known at both ends of
// a group and before it: the integral of the parabola through the three. Two estimates limit the
// length of groups: the difference between that integral and the extrapolated one, and the error of
// the balance of energies between the ends of the group. The balance is exact for every cycle, so
// its error also contains that of the extrapolated state, and it remains in the closure of the
// motion.
//
// Groups begin only where the cycles up to the next edge, stop or piece of the drive are too many
// to be stepped through. Motions with fewer cycles are stepped through.
#include "engine/mechanism/dynamics_internal.h"

#include <math.h>
#include <string.h>

// Segments up to the next edge, stop or piece of the drive that are too many.
static const double too_many = 1e6;

// First value of the smallest number of segments of a cycle: shorter cycles are taken together,
// because the rounding errors of their rates are larger.
enum { WINDOW = 1000 };

// Largest relative difference between the states at both ends of a cycle. Other slips of a cycle
// differ by 0.5 % and more in speed or dwell.
static const double near = 1e-3;

// Smallest number of cycles of a group; largest relative change in a group of the speed, the
// stretch and the dwells at the break-away; largest change of a deflection's rate divided by the
// speed of the stem. The energies have estimates of their own.
static const double worth = 10.0, moves = 5e-2, bends = 1e-2;

// Largest error of a group's energies divided by all work so far: this multiple of the tolerance of
// the numerical path, and not more than the second number; largest error of its balance.
static const double energy_error = 100.0, energy_error_most = 1e-5, balance_error = 2e-8;

// Fraction of the error of the balance that cycles may cause that have not settled.
static const double unsettled = 0.05;

// Largest number of cycles after a group until they are steady; cycles that are stepped through
// after a group with too large an error.
enum { WAITS = 10, PAUSE = 10 };

// Writes the quantities of SbDynamicsRates at a break-away.
static void values_of(double *out, const SbDynamicsBreak *b) {
  memcpy(out, b->energy.term, sizeof b->energy.term);
  out[SB_DYNAMICS_OF_STRETCH] = b->stretch;
  out[SB_DYNAMICS_OF_SPEED] = b->at.v;
  memcpy(out + SB_DYNAMICS_OF_DEFLECTION, b->at.d, sizeof b->at.d);
  memcpy(out + SB_DYNAMICS_OF_REST, b->rest, sizeof b->rest);
}

// Writes the rates of the cycle from `mark` to the break-away `b`.
static void rates_of(SbDynamicsRates *out, const SbDynamicsBreak *mark, const SbDynamicsBreak *b) {
  double before[SB_DYNAMICS_RATES], now[SB_DYNAMICS_RATES];
  values_of(before, mark);
  values_of(now, b);
  out->middle = 0.5 * (mark->t + b->t);
  for (int k = 0; k < SB_DYNAMICS_RATES; k++) {
    out->rate[k] = (now[k] - before[k]) / (b->t - mark->t);
  }
}

static bool close_to(double a, double b, double size, double noise) {
  return fabs(a - b) <= near * fabs(size) + noise;
}

// Returns whether the last break-away ends a cycle that began at `mark`.
static bool returns(const SbDynamics *s, const SbDynamicsBreak *mark) {
  const SbDynamicsBreak *now = &s->broke;
  const double rate = fabs(sb_motion_drive_at(s, s->t).rate), noise = sb_motion_time_noise(s->t);
  bool same = now->event == mark->event && now->t > mark->t && now->at.x != mark->at.x &&
              close_to(now->stretch, mark->stretch, mark->stretch, 0.0) &&
              close_to(now->at.v, mark->at.v, fabs(mark->at.v) + rate, 0.0);
  double deflection = 0.0; // the largest: that of a contact that ends is small
  for (size_t i = 0; i < s->model->contacts; i++) {
    deflection = fmax(deflection, fabs(mark->at.d[i]));
  }
  for (size_t i = 0; i < s->model->contacts; i++) {
    same = same && now->state[i] == mark->state[i] &&
           (now->state[i] == SB_CONTACT_OFF ||
            (close_to(now->at.d[i], mark->at.d[i], deflection, 0.0) &&
             close_to(now->rest[i], mark->rest[i], mark->rest[i], noise)));
  }
  return same;
}

// Begins a cycle at the last break-away.
static void begin_cycle(SbDynamics *s) {
  s->envelope.mark = s->broke;
  s->envelope.since = 0;
}

// Returns the energy that is stored by the work of all terms.
static double balance(const double *term) {
  double sum = term[0] + term[1]; // drive and pressure
  for (int k = 2; k < SB_DYNAMICS_TERMS; k++) {
    sum -= term[k];
  }
  return sum;
}

// Returns the work [J] to which errors of energies refer.
static double work_of(const SbDynamics *s) {
  return fmax(s->energy.largest, s->energy.largest_stored);
}

// Returns the energy in the springs and the stem [J].
static double stored(const SbDynamics *s) {
  return sb_motion_stored_energy(s, s->t, &s->at) + 0.5 * s->mass * s->at.v * s->at.v;
}

// Sets the energies of the last group now that a cycle behind it is known, and the span of the next
// one by their error.
static void close_group(SbDynamics *s, const SbDynamicsRates *now) {
  SbDynamicsEnvelope *g = &s->envelope;
  const double x[3] = {g->known[0].middle, g->known[1].middle, now->middle};
  double term[SB_DYNAMICS_TERMS], error = 0.0;
  for (int k = 0; k < SB_DYNAMICS_TERMS; k++) {
    const double y[3] = {g->known[0].rate[k], g->known[1].rate[k], now->rate[k]};
    term[k] = sb_motion_under_parabola(x, y, g->from, g->to);
    error = fmax(error, fabs(term[k] - g->taken[k]));
    s->energy.term[k] += term[k] - g->taken[k];
  }
  const double tolerance = s->model->tolerance > 0.0 ? s->model->tolerance : 1e-9;
  const double open = fabs(g->stored - balance(term));
  error = fmax(error / fmin(energy_error * tolerance, energy_error_most), open / balance_error);
  error /= work_of(s);
  g->span *= fmin(4.0, 0.8 / cbrt(fmax(error, 1e-3)));
  const double least = 2.0 * worth * (s->t - g->mark.t);
  if (g->span < least) {
    g->span = least;
    g->waited = -PAUSE;
  }
  s->broke.energy = s->energy;
  g->open = false;
}

// Returns how the rate k changes with the time, from the cycle before the last group to `now`.
static double slope_of(const SbDynamics *s, const SbDynamicsRates *now, int k) {
  const SbDynamicsRates *from = &s->envelope.known[1];
  return (now->rate[k] - from->rate[k]) / (now->middle - from->middle);
}

// Returns the largest number of cycles of a group that their slow change allows; *settled receives
// the number that the remaining fast change of the deflections allows. `now` are the rates of the
// last cycle.
static double length_of(double *settled, const SbDynamics *s, const SbDynamicsRates *now,
                        double period) {
  const SbDynamicsEnvelope *g = &s->envelope;
  const SbDynamicsRates *last = g->known;
  const bool early = g->to == 0.0; // before the first group the last cycles are known
  const double open = unsettled * balance_error * work_of(s);
  const double speed = fabs(s->broke.at.x - g->mark.at.x) / period;
  double value[SB_DYNAMICS_RATES], times = INFINITY;
  *settled = early && last[0].middle == 0.0 ? 0.0 : INFINITY;
  values_of(value, &s->broke);
  for (int k = SB_DYNAMICS_TERMS; k < SB_DYNAMICS_RATES; k++) {
    const bool deflection = k >= SB_DYNAMICS_OF_DEFLECTION && k < SB_DYNAMICS_OF_REST;
    const double change = now->rate[k] - g->cycle.rate[k];
    const double slow = early ? last[1].rate[k] - last[0].rate[k] : slope_of(s, now, k) * period;
    if (deflection) {
      const size_t i = (size_t)(k - SB_DYNAMICS_OF_DEFLECTION);
      const double force = s->model->contact[i].stiffness * fabs(value[k]);
      *settled = fmin(*settled, open / fabs((change - slow) * period * force));
      times = fmin(times, bends * speed / fabs(change));
    } else if (now->rate[k] != 1.0) { // a contact that does not come to rest
      times = fmin(times, moves * fabs(value[k]) / fabs(now->rate[k] * period));
    }
  }
  return times;
}

// Advances by a group of the duration `span`. `now` are the rates of the last cycle.
static void pass_group(SbDynamics *s, const SbDynamicsRates *now, double period, double span) {
  SbDynamicsEnvelope *g = &s->envelope;
  const int event = s->broke.event;
  double value[SB_DYNAMICS_RATES];
  values_of(value, &s->broke);
  for (int k = 0; k < SB_DYNAMICS_RATES; k++) {
    value[k] += span * (now->rate[k] + 0.5 * slope_of(s, now, k) * (span + period));
  }
  const double until = s->t + span, before = stored(s);
  for (int k = 0; k < SB_DYNAMICS_TERMS; k++) {
    g->taken[k] = value[k] - s->energy.term[k];
    s->energy.term[k] = value[k];
  }
  g->known[0] = g->known[1];
  g->known[1] = *now;
  g->from = s->t;
  g->to = until;
  g->span = span;
  s->counters.grouped += (long)fmin(span / period * (double)g->slips, 1e15);
  sb_motion_pass(s, until, sb_motion_drive_at(s, until).value - value[SB_DYNAMICS_OF_STRETCH],
                 span / period);
  s->at.v = value[SB_DYNAMICS_OF_SPEED];
  for (size_t i = 0; i < s->model->contacts; i++) {
    s->at.d[i] = value[SB_DYNAMICS_OF_DEFLECTION + i];
    s->since[i] = until - value[SB_DYNAMICS_OF_REST + i];
  }
  g->stored = stored(s) - before;
  g->open = true;
  g->waited = 0;
  sb_motion_note(s, event);
}

// Advances by a group if the last two cycles, which have the same number of slips, are steady.
// Returns whether it did.
static bool try_group(SbDynamics *s, const SbDynamicsRates *now) {
  SbDynamicsEnvelope *g = &s->envelope;
  const double period = s->t - g->mark.t, travel = s->broke.at.x - g->mark.at.x;
  const double segments = (double)(s->broke.segments - g->mark.segments);
  const SbMotionAhead ahead = sb_motion_ahead(s, travel > 0.0 ? 1 : -1);
  const double left = fmin(ahead.time, ahead.way * period / fabs(travel));
  g->on = g->on || left / period * segments > too_many;
  if (!g->on) {
    return false;
  }
  if (g->waited < 0) {
    g->waited++;
    return false;
  }
  double settled;
  const double times = length_of(&settled, s, now, period);
  if (settled < fmax(fmin(times, g->span / period), worth) && g->waited++ < WAITS) {
    return false;
  }
  if (settled < worth) { // rounding errors of the rates
    g->window *= 2;
    g->waited = 0;
    return false;
  }
  if (g->open) {
    close_group(s, now);
  }
  if (g->to == 0.0) {
    g->span = 2.0 * worth * period;
  }
  double span = fmin(fmin(times, settled) * period, g->span);
  span = fmin(span, fmin(left, s->asked - s->t) - worth * period); // time to close it
  // The drive's speed may change.
  const double place = sb_motion_drive_at(s, s->t).value,
               room = ahead.way - 0.5 * worth * fabs(travel);
  while (span >= worth * period &&
         !(copysign(1.0, travel) * (sb_motion_drive_at(s, s->t + span).value - place) < room)) {
    span *= 0.5;
  }
  const bool goes = span >= worth * period && isfinite(span);
  if (goes) {
    pass_group(s, now, period, span);
  }
  return goes;
}

void sb_motion_envelope(SbDynamics *s) {
  SbDynamicsEnvelope *g = &s->envelope;
  if (!sb_motion_undisturbed(s, &g->mark)) {
    *g = (SbDynamicsEnvelope){.after = 1, .window = WINDOW};
    begin_cycle(s);
    return;
  }
  g->since++;
  if (!returns(s, &g->mark)) {
    if (g->since >= g->after) {
      g->after *= 2;
      g->cycle.middle = 0.0;
      begin_cycle(s);
    }
    return;
  }
  g->after = 2 * g->since;
  if (s->broke.segments - g->mark.segments < g->window) {
    return;
  }
  SbDynamicsRates now;
  rates_of(&now, &g->mark, &s->broke);
  const bool again = g->cycle.middle > 0.0 && g->slips == g->since;
  const bool passed = again && try_group(s, &now);
  if (g->to == 0.0) {
    g->known[0] = again ? g->known[1] : (SbDynamicsRates){0};
    g->known[1] = now;
  }
  g->slips = g->since;
  g->cycle = passed ? (SbDynamicsRates){0} : now;
  begin_cycle(s);
}
