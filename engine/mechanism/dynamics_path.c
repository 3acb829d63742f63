// Motion between two events of dynamics.h, and the time of the next event.
#include "engine/mechanism/dynamics_internal.h"
#include "engine/numeric/root.h"

#include <float.h>
#include <math.h>
#include <string.h>

// Longest segment at rest [s]; a longer rest continues in another segment.
static const double horizon_max = 1e6;

// Force to which the tolerance of the numerical path refers where springs are stiff [N].
static const double force_size = 400.0;

// Smallest position, speed and deflection to which the tolerance refers [m, m/s, m].
static const double place_size = 1e-3, speed_size = 1e-3, deflection_size = 1e-5;

// Stiffness over mass [1/s2] above which rounding exceeds the tolerance in most steps: 1e5 rad/s.
static const double stiff_square = 1e10;

static bool has_closed_form(const SbDynamics *s) {
  // Loads that vary with the position only are constant for a stem at rest.
  bool still = s->held && (s->model->extra_rate == NULL || s->loads.settled);
  if (!(s->loads.constant || still) || s->piece.curved) {
    return false;
  }
  for (size_t i = 0; i < s->model->contacts; i++) {
    if (s->state[i] == SB_CONTACT_SLIP && sb_motion_speed_dependent(s->model, i)) {
      return false;
    }
  }
  return true;
}

// What can end the segment: which of the events is the same throughout, its functions at the
// anchor.
typedef struct {
  size_t count;
  int event[EVENT_COUNT];
  SbEventFunction function[EVENT_COUNT];
} Live;

// If friction decreases faster with the speed than the dampers dissipate, oscillations grow: the
// events' bounds are then valid for the time in which they could grow by a factor of e
// (oscillator.h).
static void closed_path(SbDynamics *s, const Point *p, Live *live) {
  s->motion = (SbOscillator){0};
  if (!s->held) {
    sb_oscillator_init(&s->motion, s->mass, p->sum.c, p->sum.k, p->sum.f0, p->sum.f1, p->v);
  }
  double left = s->piece.until - s->t, horizon = fmin(left, horizon_max);
  if (!s->held && p->sum.c < 0.0) {
    horizon = fmin(horizon, s->mass / -p->sum.c);
  }
  horizon = fmin(horizon, sb_motion_rest_ends(s, p));
  s->t_end = horizon == left ? s->piece.until : s->t + horizon;
  s->event = EVENT_BREAK;
  double a = s->held ? 0.0 : force_of(&p->sum, p) / s->mass;
  // First the bands' ends, which are the nearest as a rule: less is left to search for the others.
  for (size_t i = 0; i < 2 * live->count; i++) {
    const size_t k = i % live->count;
    const int event = live->event[k];
    if ((event == EVENT_SPEED_UP || event == EVENT_SPEED_DOWN) != (i < live->count)) {
      continue;
    }
    SbEventFunction *g = &live->function[k];
    bool found;
    // The time itself is rounded, and with it whatever changes fast. Not so the edges: crossing one
    // puts the stem on it.
    if (event != EVENT_EDGE_UP && event != EVENT_EDGE_DOWN) {
      g->noise += s->t * (fabs(g->rate) + fabs(g->of_x * p->v) + fabs(g->of_v * a) +
                          fabs(g->relax * g->relax_rate));
    }
    double at = sb_event_first(g, &s->motion, horizon, &found);
    if (found && (at < horizon || s->event == EVENT_BREAK)) {
      horizon = at;
      s->t_end = s->t + at;
      s->event = event;
    }
  }
}

// ---- numerical path ----

static void numerical_rates(double *dz, double *power, double t, const double *z, void *user) {
  const SbDynamics *s = user;
  SbDynamicsState at = s->at, rate;
  for (size_t i = 0; i < s->system.n; i++) {
    at.z[s->unknown[i]] = z[i];
  }
  Point p;
  sb_motion_point(&p, s, t, &at);
  rate.x = p.v;
  rate.v = force_of(&p.sum, &p) / s->mass;
  rate.extra = 0.0;
  if (!s->loads.constant && s->model->extra_rate != NULL) {
    s->model->extra_rate(&rate.extra, at.x, p.v, s->region, &at.extra, s->model->user);
  }
  for (size_t i = 0; i < s->model->contacts; i++) {
    rate.d[i] = sb_motion_deflection_rate(s, &p, i);
  }
  for (size_t i = 0; i < s->system.n; i++) {
    dz[i] = rate.z[s->unknown[i]];
  }
  if (power != NULL) {
    Stretch now = {.time = 1.0, .travel = p.v, .square = p.v * p.v};
    for (size_t i = 0; i < s->model->contacts; i++) {
      now.shift[i] = rate.d[i];
      now.fade[i] = rate.d[i] * rate.d[i];
    }
    memset(power, 0, SB_DYNAMICS_TERMS * sizeof *power);
    sb_motion_add_energy(power, s, &p, &now);
  }
}

typedef struct {
  double value[EVENT_COUNT], noise[EVENT_COUNT];
} Values;

// Values of the live events at tau of the steps.
static void values_at(const SbDynamics *s, double tau, const Live *live, Values *out) {
  SbDynamicsState z;
  Point p;
  sb_motion_state_at(s, tau, &z);
  sb_motion_point(&p, s, s->t + tau, &z);
  for (size_t i = 0; i < live->count; i++) {
    SbEventFunction g;
    (void)sb_motion_event_function(s, &p, live->event[i], &g);
    out->value[i] = sb_motion_event_value(s, live->event[i], &g, p.v, &out->noise[i]);
  }
}

typedef struct {
  const SbDynamics *s;
  int event;
} Search;

// An event's value, negative, at tau of the steps, and its slope there.
static double fall_at(double *slope, double tau, const void *context) {
  const Search *search = context;
  const SbDynamics *s = search->s;
  double h = s->step[0].h + s->step[1].h, span = fmin(tau, fmax(1e-4 * h, 1e-12 * s->t));
  double value[2];
  for (int i = 0; i < 2; i++) {
    const Live one = {.count = 1, .event = {search->event}};
    Values at;
    values_at(s, tau - i * span, &one, &at);
    value[i] = -at.value[0];
  }
  *slope = (value[0] - value[1]) / span;
  return value[0];
}

// The earliest event in steps over h, found on their dense output, and when; else EVENT_NONE.
static int first_event(const SbDynamics *s, double h, const Live *live, double *at) {
  enum { PARTS = 4 };
  int found = EVENT_NONE;
  Values now;
  for (size_t i = 0; i < live->count; i++) {
    now.value[i] = sb_motion_event_value(s, live->event[i], &live->function[i],
                                         s->held ? 0.0 : s->at.v, &now.noise[i]);
  }
  for (int part = 1; part <= PARTS && found == EVENT_NONE; part++) {
    const Values before = now;
    values_at(s, part * h / PARTS, live, &now);
    for (size_t i = 0; i < live->count; i++) {
      // Armed once it was clearly positive; before that only a clear fall counts.
      bool armed = before.value[i] > before.noise[i];
      if (!(now.value[i] < 0.0) || !(armed || now.value[i] < -now.noise[i])) {
        continue;
      }
      Search search = {s, live->event[i]};
      double low = (part - 1) * h / PARTS, high = part * h / PARTS;
      double root = sb_newton_bracketed(fall_at, &search, low, high, 0.5 * (low + high));
      if (found == EVENT_NONE || root < *at) {
        *at = root;
        found = live->event[i];
      }
    }
  }
  return found;
}

// Steps that end just behind an event differ from those it was found in by no more than this share.
static const double LANDS = 0.25;

// Where in steps over h, made to end just behind an event, it is, by Newton's method.
static double place_of(const SbDynamics *s, int event, double h) {
  double at = h, slope;
  for (int i = 0; i < 3; i++) {
    double value = fall_at(&slope, at, &(Search){s, event});
    at = slope > 0.0 ? fmin(fmax(at - value / slope, (1.0 - LANDS) * h), (1.0 + LANDS) * h) : at;
  }
  return at;
}

// Rate [1/s] at which the stem swings or settles.
static double quickest_rate(const SbDynamics *s, const Point *p) {
  return fmax(sqrt(p->sum.k / s->mass), fabs(p->sum.c) / s->mass);
}

// Adds what is at `place` of the state to what changes in this segment. An error in it is one in
// force, and in energy, by the springs that act.
static void add_unknown(SbDynamics *s, size_t place, double size, double stiffness) {
  size_t n = s->system.n++;
  s->unknown[n] = place;
  s->system.floor[n] = size;
  s->system.ceiling[n] = stiffness > 0.0 ? force_size / stiffness : 0.0;
}

// Sets the unknowns of this segment, and the rounding errors of acceleration [m/s2] and speed
// [m/s]: a very stiff drive or stop converts the rounding of its position into them, and no smaller
// tolerance is possible.
static void set_system(SbDynamics *s, const Point *p, double *noise, double *speed) {
  enum { X, V, EXTRA, D };
  const SbDynamicsModel *m = s->model;
  double square = p->sum.k / s->mass;
  *noise = 0.0;
  for (size_t w = 0; w < SB_DYNAMICS_WALLS; w++) {
    if (s->wall[w].on && p->wall[w].k > 0.0) {
      const Moving at = sb_motion_wall_at(s, w, s->t);
      *noise += DBL_EPSILON * (fabs(at.value) + fabs(at.rate * s->t)) * p->wall[w].k / s->mass;
    }
  }
  *speed = *noise / sqrt(fmax(square, 1.0));
  s->system = (SbRadauSystem){.powers = SB_DYNAMICS_TERMS,
                              .rates = numerical_rates,
                              .user = s,
                              .tolerance = m->tolerance > 0.0 ? m->tolerance : 1e-9,
                              .noisy = square > stiff_square};
  s->speed_size =
      s->system.noisy ? fmax(speed_size, 10.0 * *speed / s->system.tolerance) : speed_size;
  if (!s->held) {
    add_unknown(s, X, place_size, p->sum.k);
    add_unknown(s, V, s->speed_size, 0.0);
  }
  if (m->extra_rate != NULL) {
    add_unknown(s, EXTRA, m->extra_scale, 0.0);
  }
  for (size_t i = 0; i < m->contacts; i++) {
    if (!is_rigid(m, i) && s->state[i] != SB_CONTACT_OFF) {
      add_unknown(s, D + i, deflection_size, m->contact[i].stiffness);
    }
  }
}

// Steps that end behind an event by at most this fraction of their length are not repeated: at
// their end dense output has the solution's slope, so its error grows with the square of the
// distance from there. Steps are made slightly too long, so that the event is inside them.
static const double near_end = 1e-4, overshoot = 1e-5;

// Rate [1/s] at which the stem's speed grows by friction that decreases with it, and more than the
// dampers dissipate; 0: it does not grow. The slope is that of the bands and of Stribeck's law
// (dynamics.h): L (static_ratio - 1) d/dv exp(-(v/stribeck_speed)^stribeck_exponent).
static double growth_rate(const SbDynamics *s, const Point *p) {
  double c = p->sum.c;
  for (size_t i = 0; i < s->model->contacts; i++) {
    if (s->state[i] == SB_CONTACT_SLIP && sb_motion_speed_dependent(s->model, i)) {
      const SbDynamicsContact *law = &s->model->contact[i];
      double speed = fmax(s->sign[i] * p->v, sb_motion_rest_speed(s->model));
      double ratio = speed / law->stribeck_speed;
      double level = sb_motion_level(&p->loads, i, s->sign[i]);
      double above = sb_motion_sliding_level(s, i, level, speed) - level;
      c -= above * law->stribeck_exponent * pow(ratio, law->stribeck_exponent) / speed;
    }
  }
  return fmax(0.0, -c / s->mass);
}

// Returns the length of the next step [s]. `first`: of a step after which nothing is known.
static double first_length(const SbDynamics *s, const Point *p, double first) {
  double h = s->h > 0.0 ? s->h : first;
  if (s->piece.curved) {
    h = fmin(h, s->piece.step);
  }
  // A half step in which the speed would grow by far more than e^2 damps it instead (L-stability),
  // to a solution that is none: Radau IIA's factor is 7.5 for e^2 = 7.4, and has a pole at e^3.6.
  double growth = s->held ? 0.0 : growth_rate(s, p);
  h = growth > 0.0 ? fmin(h, 4.0 / growth) : h;
  return fmax(h, 8.0 * DBL_EPSILON * s->t); // the time resolves no less
}

// Returns where a step of the length h that lands on the event *landing meets it [s]. Past an edge
// the loads have a corner, and the longer step's dense output was off: there may be no such event
// as yet, or another one before it. Then changes *landing, and resets *landings.
static double land(SbDynamics *s, double h, const Live *live, int *landing, int *landings) {
  const double at = place_of(s, *landing, h);
  double before;
  const int other = first_event(s, h, live, &before);
  if (other == EVENT_NONE && at >= (1.0 + LANDS) * h) {
    *landing = EVENT_NONE;
    return h;
  }
  if (other != EVENT_NONE && other != *landing && before < (1.0 - near_end) * fmin(at, h)) {
    *landing = other;
    *landings = 0;
    return before;
  }
  return at;
}

// Steps with error control. A step that an event ends is repeated so that it ends there: the event
// is then as accurate as the solution, not as its dense output, and the error of the step is that
// up to the event (loads may have a kink behind it).
static SbStatus numerical_path(SbDynamics *s, const Point *p, const Live *live, SbReport *report) {
  double noise, speed;
  set_system(s, p, &noise, &speed);
  double quickest = quickest_rate(s, p), first = quickest > 0.0 ? 0.05 / quickest : 1e-5;
  double left = fmin(s->piece.until - s->t, horizon_max), h = first_length(s, p, first);
  double z[SB_RADAU_MAX];
  for (size_t i = 0; i < s->system.n; i++) {
    z[i] = s->at.z[s->unknown[i]];
  }
  int landing = EVENT_NONE, landings = 0;
  for (int attempt = 0; attempt < 80; attempt++) {
    double error, local[SB_RADAU_MAX];
    h = fmin(h, left);
    if (s->t + h <= s->t) {
      break;
    }
    // A step that is long against the relaxation damps that rounding, too.
    double damped = fmax(1.0, 0.1 * h * quickest);
    if (!s->held) {
      s->system.noise[0] = 8.0 * speed / damped;
      s->system.noise[1] = 8.0 * noise / damped;
    }
    bool solved = sb_radau_pair(s->step, &error, local, &s->system, s->t, z, h,
                                &s->counters.newton_iterations);
    double factor = error > 0.0 ? fmin(4.0, fmax(0.2, 0.85 * pow(error, -1.0 / 6.0))) : 4.0;
    if (!solved || error > 1.0) {
      h *= solved ? fmin(factor, 0.7) : 0.25;
      landing = EVENT_NONE;
      s->counters.rejected++;
      continue;
    }
    double at = h;
    if (landing == EVENT_NONE) {
      // A step that had to be shortened is not lengthened immediately.
      s->h = h * (attempt > 0 ? fmin(factor, 1.0) : factor);
      landing = first_event(s, h, live, &at);
      landings = 0;
    } else {
      at = land(s, h, live, &landing, &landings);
    }
    if (landing != EVENT_NONE && (s->t + at <= s->t || at < 1e-14 * h)) {
      at = s->step[0].h = s->step[1].h = 0.0; // immediately
    } else if ((at > h || h - at > near_end * h) && landings < 6) {
      h = (1.0 + overshoot) * at;
      landings++;
      continue;
    }
    s->t_end = at >= left && isfinite(s->piece.until) ? s->piece.until : s->t + at;
    s->event = landing == EVENT_NONE ? EVENT_BREAK : landing;
    s->counters.steps++;
    s->counters.local_error += s->held ? 0.0 : local[0] / (fabs(s->at.x) + place_size);
    if (landing != EVENT_NONE && landing != EVENT_SPEED_UP && landing != EVENT_SPEED_DOWN) {
      // What follows may be much quicker; friction bends little from one band to the next.
      s->h = fmin(s->h, first);
    }
    return SB_OK;
  }
  return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                 "no step of the motion converges at %.9g s (step %.3g s)", s->t, h);
}

// The band of the stem's speed from the anchor on, if a contact slides.
static void find_band(SbDynamics *s) {
  const SbDynamicsModel *m = s->model;
  s->banded = false;
  for (size_t i = 0; i < m->contacts && m->band != NULL && !s->held; i++) {
    s->banded = s->banded || s->state[i] == SB_CONTACT_SLIP;
  }
  if (!s->banded) {
    return;
  }
  double speed = fabs(s->at.v);
  if (speed > 0.0) {
    s->direction = s->at.v > 0.0 ? 1 : -1;
    // On the boundary the band below it, not the one that begins there.
    speed *= s->fell ? 1.0 - 1e-12 : 1.0;
  }
  s->fell = false;
  s->band = (SbDynamicsBand){0};
  m->band(&s->band, s->at.x, s->region, s->direction, speed, &s->at.extra, m->user);
}

SbStatus sb_motion_find_path(SbDynamics *s, SbReport *report) {
  Point p;
  find_band(s);
  s->linear = has_closed_form(s);
  sb_motion_point(&p, s, s->t, &s->at);
  for (size_t i = 0; i < s->model->contacts; i++) {
    // A contact that began fast counts as fast while it decelerates to the speed of rest, in any
    // number of steps; one that chatters does not: what it crept would be taken back at each rest.
    double slip = fabs(p.v - sb_motion_deflection_rate(s, &p, i));
    double rest = sb_motion_rest_speed(s->model);
    s->brisk[i] = s->state[i] == SB_CONTACT_SLIP && s->margin[i] == 0.0 &&
                  slip > (s->brisk[i] ? rest : 2.0 * rest);
  }
  Live live;
  live.count = 0;
  for (int event = 0; event < EVENT_COUNT; event++) {
    if (sb_motion_event_function(s, &p, event, &live.function[live.count])) {
      live.event[live.count++] = event;
    }
  }
  if (s->linear) {
    closed_path(s, &p, &live);
    return SB_OK;
  }
  return numerical_path(s, &p, &live, report);
}
