// Motion between two events of dynamics.h, and where the next one is.
#include "engine/mechanism/dynamics_internal.h"
#include "engine/numeric/root.h"

#include <float.h>
#include <math.h>

// A rest of this length [s] is looked at again; it costs one segment.
static const double horizon_max = 1e6;

// Force to which the tolerance of the numerical path refers where springs are stiff [N].
static const double force_size = 400.0;

// Speed to which it refers at least [m/s].
static const double speed_size = 1e-3;

// Stiffness over mass [1/s2] above which rounding outdoes the tolerance: 1e5 rad/s.
static const double stiff_square = 1e10;

static bool has_closed_form(const SbDynamics *s) {
  // Loads that vary with the place only do not vary for a stem held at rest.
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

static void closed_path(SbDynamics *s, const Point *p) {
  s->motion = (SbOscillator){0};
  if (!s->held) {
    sb_oscillator_init(&s->motion, s->mass, p->sum.c, p->sum.k, p->sum.f0, p->sum.f1, p->v);
  }
  double horizon = fmin(s->piece.until - s->t, horizon_max);
  s->t_end = isfinite(s->piece.until) && horizon < horizon_max ? s->piece.until : s->t + horizon;
  s->event = EVENT_BREAK;
  double a = s->held ? 0.0 : force_of(&p->sum, p) / s->mass;
  for (int event = 0; event < EVENT_COUNT; event++) {
    SbEventFunction function;
    bool found;
    if (!sb_motion_event_function(s, p, event, &function)) {
      continue;
    }
    // The time itself is rounded, and with it whatever changes fast. Not so the edges: crossing one
    // puts the stem on it.
    if (event != EVENT_EDGE_UP && event != EVENT_EDGE_DOWN) {
      function.noise +=
          s->t * (fabs(function.rate) + fabs(function.of_x * p->v) + fabs(function.of_v * a) +
                  fabs(function.relax * function.relax_rate));
    }
    double at = sb_event_first(&function, &s->motion, horizon, &found);
    if (found && (at < horizon || s->event == EVENT_BREAK)) {
      horizon = at;
      s->t_end = s->t + at;
      s->event = event;
    }
  }
}

// ---- numerical path ----

typedef struct {
  double value[EVENT_COUNT], noise[EVENT_COUNT];
  bool live[EVENT_COUNT];
} Values;

// Values of the events from `first` to `last` at tau of the steps.
static void values_at(const SbDynamics *s, double tau, int first, int last, Values *out) {
  SbDynamicsState z;
  Point p;
  sb_motion_state_at(s, tau, &z);
  sb_motion_point(&p, s, s->t + tau, &z);
  for (int event = first; event <= last; event++) {
    out->live[event] = sb_motion_event_value(s, &p, event, &out->value[event], &out->noise[event]);
  }
  // What slows down to the speed of rest is at rest, whatever the tolerance leaves of its speed.
  for (size_t i = 0; i < s->model->contacts; i++) {
    size_t own = is_rigid(s->model, i) ? EVENT_RIGID_UP : EVENT_CONTACT_UP + i;
    if (s->brisk[i] && s->state[i] == SB_CONTACT_SLIP) {
      out->noise[own] = fmin(out->noise[own], 0.1 * sb_motion_rest_speed(s->model));
    }
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
    Values at = {0};
    values_at(s, tau - i * span, search->event, search->event, &at);
    value[i] = at.live[search->event] ? -at.value[search->event] : -1.0;
  }
  *slope = (value[0] - value[1]) / span;
  return value[0];
}

// The earliest event in steps over h, found on their dense output, and when; else EVENT_NONE.
static int first_event(const SbDynamics *s, double h, double *at) {
  enum { PARTS = 4 };
  Values before = {0}, after = {0};
  int found = EVENT_NONE;
  values_at(s, 0.0, 0, EVENT_COUNT - 1, &before);
  for (int part = 1; part <= PARTS && found == EVENT_NONE; part++) {
    values_at(s, part * h / PARTS, 0, EVENT_COUNT - 1, &after);
    for (int event = 0; event < EVENT_COUNT; event++) {
      // Armed once it was clearly positive; before that only a clear fall counts.
      bool armed = before.live[event] && before.value[event] > before.noise[event];
      if (!after.live[event] || !(after.value[event] < 0.0) ||
          !(armed || after.value[event] < -after.noise[event])) {
        continue;
      }
      Search search = {s, event};
      double low = (part - 1) * h / PARTS, high = part * h / PARTS;
      double root = sb_newton_bracketed(fall_at, &search, low, high, 0.5 * (low + high));
      if (found == EVENT_NONE || root < *at) {
        *at = root;
        found = event;
      }
    }
    before = after;
  }
  return found;
}

// Where in steps over h, made to end near an event, or just behind them it is, by Newton's method.
static double place_of(const SbDynamics *s, int event, double h) {
  double at = h, slope;
  for (int i = 0; i < 3; i++) {
    double value = fall_at(&slope, at, &(Search){s, event});
    at = slope > 0.0 ? fmin(fmax(at - value / slope, 0.75 * h), 1.25 * h) : at;
  }
  return at;
}

// Rate [1/s] at which the stem swings or settles.
static double quickest_rate(const SbDynamics *s, const Point *p) {
  return fmax(sqrt(p->sum.k / s->mass), p->sum.c / s->mass);
}

// Sizes to which the tolerance refers, and the rounding of acceleration [m/s2] and speed [m/s]: a
// very stiff drive turns that of its own place into them, and less cannot be asked for.
static void set_scales(SbDynamics *s, const Point *p, double *noise, double *speed) {
  const SbDynamicsModel *m = s->model;
  // An error in place is one in force, and in energy, by the springs that act.
  s->system.ceiling[0] = p->sum.k > 0.0 ? force_size / p->sum.k : 0.0;
  for (size_t i = 0; i < m->contacts; i++) {
    const size_t d = offsetof(SbDynamicsState, d) / sizeof(double);
    s->system.ceiling[d + i] = is_rigid(m, i) ? 0.0 : force_size / m->contact[i].stiffness;
  }
  double square = p->sum.k / s->mass;
  *noise = 0.0;
  if (square > stiff_square && s->wall[SB_DYNAMICS_PLATEN].on && !sb_motion_by_force(m)) {
    double place, rate;
    sb_motion_drive_at(s, s->t, &place, &rate);
    *noise = DBL_EPSILON * (fabs(place) + fabs(rate * s->t)) * square;
  }
  *speed = *noise / sqrt(fmax(square, 1.0));
  s->system.floor[1] = fmax(speed_size, 10.0 * *speed / s->system.tolerance);
}

// Steps that end as near as this share of them to an event are not taken again: at their end dense
// output has the solution's slope, so that its error grows with the square of the way from there.
static const double near_end = 1e-4;

// Steps with error control; one that an event ends is taken again so that it ends there: the event
// is then as accurate as the solution, not as its dense output, and the step's error that of the
// way to the event (loads may have a corner behind it).
static SbStatus numerical_path(SbDynamics *s, const Point *p, SbReport *report) {
  double noise, speed;
  set_scales(s, p, &noise, &speed);
  s->system.user = s;
  double quickest = quickest_rate(s, p), first = quickest > 0.0 ? 0.2 / quickest : 1e-5;
  double left = fmin(s->piece.until - s->t, horizon_max), h = s->h > 0.0 ? s->h : first;
  if (s->piece.curved) {
    h = fmin(h, s->piece.step);
  }
  int landing = EVENT_NONE, landings = 0;
  for (int attempt = 0; attempt < 80; attempt++) {
    double error, local[SB_RADAU_MAX];
    h = fmin(h, left);
    if (s->t + h <= s->t) {
      break;
    }
    // A step that is long against the relaxation damps that rounding, too.
    double damped = fmax(1.0, h * quickest);
    s->system.noise[0] = 8.0 * speed / damped;
    s->system.noise[1] = 8.0 * noise / damped;
    bool solved = sb_radau_pair(s->step, &error, local, &s->system, s->t, s->at.z, h,
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
      // A step that had to be shortened is not lengthened at once.
      s->h = h * (attempt > 0 ? fmin(factor, 1.0) : factor);
      landing = first_event(s, h, &at);
      landings = 0;
    } else {
      at = place_of(s, landing, h);
    }
    if (landing != EVENT_NONE && (s->t + at <= s->t || at < 1e-14 * h)) {
      at = s->step[0].h = s->step[1].h = 0.0; // at once
    } else if (fabs(at - h) > near_end * h && landings < 6) {
      h = at;
      landings++;
      continue;
    }
    bool last = at >= left && isfinite(s->piece.until);
    s->t_end = last ? s->piece.until : s->t + at;
    s->event = landing == EVENT_NONE ? EVENT_BREAK : landing;
    s->counters.steps++;
    s->counters.local_error += local[0] / (fabs(s->at.x) + s->system.floor[0]);
    if (landing != EVENT_NONE) {
      // What follows may be much quicker.
      s->h = fmin(s->h, first);
    }
    return SB_OK;
  }
  return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                 "no step of the motion converges at %.9g s (step %.3g s)", s->t, h);
}

SbStatus sb_motion_find_path(SbDynamics *s, SbReport *report) {
  Point p;
  s->linear = has_closed_form(s);
  sb_motion_point(&p, s, s->t, &s->at);
  for (size_t i = 0; i < s->model->contacts; i++) {
    // One that was brisk stays so while it slows down to the speed of rest, in however many steps.
    double slip = fabs(p.v - sb_motion_deflection_rate(s, &p, i));
    double rest = sb_motion_rest_speed(s->model);
    s->brisk[i] = s->state[i] == SB_CONTACT_SLIP && slip > (s->brisk[i] ? rest : 2.0 * rest);
  }
  if (s->linear) {
    closed_path(s, &p);
    return SB_OK;
  }
  return numerical_path(s, &p, report);
}

// ---- the drive's greatest force ----

// Force of the drive at tau of the segment.
static double push_at(const SbDynamics *s, double tau) {
  SbDynamicsState z;
  sb_motion_state_at(s, tau, &z);
  Force force;
  sb_motion_wall_force(&force, s, SB_DYNAMICS_PLATEN, s->t + tau, z.x);
  return force.f0 - force.c * z.v;
}

static double push_slope(double tau, const void *context) {
  const SbDynamics *s = context;
  double h = s->step[0].h + s->step[1].h;
  double low = fmax(tau - 1e-4 * h, 0.0), high = fmin(tau + 1e-4 * h, h);
  return (push_at(s, high) - push_at(s, low)) / (high - low);
}

// Greatest force between `from` and `to` in a numerical step, no less than `peak`: where that of
// the dense output stops rising, taken by stepping there. Steps are short against whatever swings.
static double step_peak(const SbDynamics *s, double from, double to, double peak) {
  double slope = push_slope(from, s);
  if (!(slope > 0.0) || push_at(s, from) + 2.0 * slope * (to - from) < peak ||
      !(push_slope(to, s) < 0.0)) {
    return peak;
  }
  double at = sb_bisect(push_slope, s, from, to), error, local[SB_RADAU_MAX];
  long iterations = 0;
  SbDynamics there = *s;
  return push_at(s, at) > (1.0 - 1e-3) * peak &&
                 sb_radau_pair(there.step, &error, local, &s->system, s->t, s->at.z, at,
                               &iterations)
             ? fmax(peak, push_at(&there, at))
             : peak;
}

double sb_motion_force_peak(const SbDynamics *s, double known) {
  const SbDynamicsModel *m = s->model;
  if (!s->wall[SB_DYNAMICS_PLATEN].on || !s->ready) {
    return known;
  }
  Point p;
  sb_motion_point(&p, s, s->t, &s->at);
  double first = force_of(&p.wall[SB_DYNAMICS_PLATEN], &p), lasts = s->t_end - s->t;
  double peak = fmax(known, fmax(first, push_at(s, lasts)));
  if (!s->linear) {
    double middle = s->step[0].h;
    peak = fmax(peak, push_at(s, middle));
    return lasts > 0.0 ? step_peak(s, middle, lasts, step_peak(s, 0.0, middle, peak)) : peak;
  }
  if (s->held || sb_motion_by_force(m)) {
    return peak; // straight in time, or given
  }
  // The first time at which the force stops rising; later swings of a stem that rings are lower,
  // or the end of the segment is higher. Nothing to gain far below the peak: the force can rise by
  // no more than its trend and swing.
  const Force *f = &p.wall[SB_DYNAMICS_PLATEN], *all = &p.sum;
  SbEventFunction rising = {.constant = f->f1 - f->c * all->f0 / s->mass,
                            .rate = -f->c * all->f1 / s->mass,
                            .of_x = f->c * all->k / s->mass,
                            .of_v = f->c * all->c / s->mass - f->k};
  const SbOscillator *o = &s->motion;
  double swing =
      (f->k + f->c * o->omega) * hypot(o->trend0, (o->v0 - o->trend1) / fmax(o->omega, 1e-300));
  double trend = fmax(0.0, f->f1 - f->k * o->trend1) * lasts;
  if (!(rising.constant + rising.of_v * p.v > 0.0) || first + 2.0 * swing + trend < peak) {
    return peak;
  }
  bool found;
  double at = sb_event_first(&rising, o, lasts, &found);
  return found ? fmax(peak, push_at(s, fmin(at, lasts))) : peak;
}
