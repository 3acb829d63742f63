// Motion between two events of dynamics.h, and where the next one is.
#include "engine/mechanism/dynamics_internal.h"

#include <float.h>
#include <math.h>
#include <string.h>

// A rest of this length [s] is looked at again; it costs one segment.
static const double horizon_max = 1e6;

// Force to which the tolerance of the numerical path refers where springs are stiff [N].
static const double force_size = 400.0;

// Speed to which it refers at least [m/s].
static const double speed_size = 1e-3;

// Way beyond an edge of the loads that a step may look at [m].
static const double overshoot_max = 1e-6;

// Stiffness over mass [1/s2] above which rounding outdoes the tolerance: 1e5 rad/s.
static const double stiff_square = 1e10;

static bool has_closed_form(const SbDynamics *s) {
  // Loads that vary with the place only do not vary for a stem held at rest.
  bool still = s->held && (s->model->extras == 0 || s->loads.settled);
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

static void closed_path(SbDynamics *s) {
  Linear l;
  sb_motion_linear_forces(s, &l);
  if (s->held) {
    sb_oscillator_hold(&s->motion, s->x);
  } else {
    sb_oscillator_init(&s->motion, s->parts.mass, l.c, l.k, l.f0, l.f1, s->x, s->v);
  }
  double horizon = fmin(s->piece.until - s->t, horizon_max);
  s->t_end = isfinite(s->piece.until) && horizon < horizon_max ? s->piece.until : s->t + horizon;
  s->event = EVENT_BREAK;
  for (int event = 0; event < EVENT_COUNT; event++) {
    SbEventFunction function;
    bool found;
    if (!sb_motion_event_function(s, event, &l, &function)) {
      continue;
    }
    // The time itself is rounded, and with it whatever changes fast. Not so the edges: crossing one
    // puts the stem on it.
    double v = s->held ? 0.0 : s->v, a = s->held ? 0.0 : (l.f0 - l.c * v) / s->parts.mass;
    if (event != EVENT_EDGE_UP && event != EVENT_EDGE_DOWN) {
      function.noise +=
          s->t * (fabs(function.rate) + fabs(function.of_x * v) + fabs(function.of_v * a) +
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

static void values_at(const SbDynamics *s, double t, const double *z, Values *out) {
  SbDynamics at;
  Linear linear;
  sb_motion_anchor_at(&at, &linear, s, t, z);
  for (int event = 0; event < EVENT_COUNT; event++) {
    out->live[event] =
        sb_motion_event_value(&at, event, &linear, &out->value[event], &out->noise[event]);
  }
}

static double one_value(const SbDynamics *s, int event, double t, const double *z) {
  SbDynamics at;
  double value = 0.0, noise;
  Linear linear;
  sb_motion_anchor_at(&at, &linear, s, t, z);
  return sb_motion_event_value(&at, event, &linear, &value, &noise) ? value : 1.0;
}

// Where `event` turns negative between two fractions of a step, on its dense output.
//
// Regula falsi (Illinois), every third time bisection, so that the bracket always shrinks.
static double dense_root(const SbDynamics *s, const SbRadauStep *step, int event, double low,
                         double high, double value_low, double value_high) {
  double z[SB_RADAU_MAX];
  int side = 0;
  for (int i = 0; i < 60 && high - low > 1e-14; i++) {
    double share = i % 3 == 2 || !(value_low > 0.0) ? 0.5 : value_low / (value_low - value_high);
    double theta = low + (high - low) * fmin(fmax(share, 1e-9), 1.0 - 1e-9);
    sb_radau_dense(step, &s->system, theta, z, NULL);
    double value = one_value(s, event, step->t + theta * step->h, z);
    if (value < 0.0) {
      high = theta;
      value_high = value;
      value_low *= side < 0 ? 0.5 : 1.0;
      side = -1;
    } else {
      low = theta;
      value_low = value;
      value_high *= side > 0 ? 0.5 : 1.0;
      side = 1;
    }
  }
  return high;
}

// Shortens a step so that it ends on the event, by stepping again: the event is then as accurate as
// the solution, not as its dense output.
//
// Where Newton's iteration fails on the way, the step ends earlier, without the event (*reached).
static bool end_on_event(SbDynamics *s, SbRadauStep *step, int event, double theta, bool *reached) {
  SbRadauStep first = *step, trial = *step;
  double z[SB_RADAU_MAX], h = theta * first.h;
  *reached = true;
  for (int i = 0; i < 6; i++) {
    if (h < 1e-14 * first.h) {
      // At once: a step of no length.
      trial = first;
      trial.h = 0.0;
      break;
    }
    if (!sb_radau_step(&trial, &s->system, first.t, first.z0, h, &s->radau)) {
      *reached = false;
      for (int half = 0; half < 40; half++) {
        h *= 0.5;
        if (sb_radau_step(step, &s->system, first.t, first.z0, h, &s->radau)) {
          s->h = h;
          return true;
        }
      }
      return false;
    }
    double value = one_value(s, event, first.t + h, trial.z1);
    // Slope from the dense output of the whole step.
    double span = fmax(1e-4 * first.h, 1e-12 * fabs(first.t));
    double a, b;
    sb_radau_dense(&first, &s->system, (h - span) / first.h, z, NULL);
    a = one_value(s, event, first.t + h - span, z);
    sb_radau_dense(&first, &s->system, (h + span) / first.h, z, NULL);
    b = one_value(s, event, first.t + h + span, z);
    double slope = 0.5 * (b - a) / span;
    double change = slope < 0.0 ? -value / slope : 0.0;
    change = fmin(fmax(change, -0.25 * first.h), 0.25 * first.h);
    if (fabs(change) <= 1e-13 * fmax(first.h, 0.0) || h + change <= 0.0) {
      break;
    }
    h = fmin(h + change, 1.25 * first.h);
  }
  *step = trial;
  return true;
}

// Looks for the earliest event in the two steps; cuts them there.
static bool cut_at_event(SbDynamics *s, SbReport *report) {
  enum { PARTS = 2 };
  Values before, after;
  double z[SB_RADAU_MAX];
  values_at(s, s->step[0].t, s->step[0].z0, &before);
  for (int half = 0; half < 2; half++) {
    SbRadauStep *step = &s->step[half];
    for (int part = 1; part <= PARTS; part++) {
      double low = (part - 1) / (double)PARTS, high = part / (double)PARTS, best = 2.0;
      int found = EVENT_NONE;
      sb_radau_dense(step, &s->system, high, z, NULL);
      values_at(s, step->t + high * step->h, z, &after);
      for (int event = 0; event < EVENT_COUNT; event++) {
        // Armed once it was clearly positive; before that only a clear fall counts.
        bool armed = before.live[event] && before.value[event] > before.noise[event];
        if (!after.live[event] || !(after.value[event] < 0.0) ||
            !(armed || after.value[event] < -after.noise[event])) {
          continue;
        }
        double at = dense_root(s, step, event, low, high,
                               before.live[event] ? before.value[event] : 0.0, after.value[event]);
        if (at < best) {
          best = at;
          found = event;
        }
      }
      if (found != EVENT_NONE) {
        bool reached;
        if (!end_on_event(s, step, found, best, &reached)) {
          (void)sb_fail(report, SB_ERROR_NOT_CONVERGED, "no step to the event at %.9g s", step->t);
          return false;
        }
        if (half == 0) {
          s->step[1].h = 0.0;
          s->step[1].t = step->t + step->h;
        }
        s->t_end = step->t + step->h;
        s->event = reached ? found : EVENT_BREAK;
        return true;
      }
      before = after;
    }
  }
  return true;
}

// Rate [1/s] at which the stem swings or settles.
static double quickest_rate(const SbDynamics *s) {
  Linear l;
  sb_motion_linear_forces(s, &l);
  return fmax(sqrt(l.k / s->parts.mass), l.c / s->parts.mass);
}

static double first_step(const SbDynamics *s) {
  double rate = quickest_rate(s);
  return rate > 0.0 ? 0.05 / rate : 1e-5;
}

static SbStatus numerical_path(SbDynamics *s, SbReport *report) {
  const SbDynamicsModel *m = s->model;
  double z[SB_RADAU_MAX] = {s->x, s->v};
  size_t patches = sb_motion_patches(m);
  memcpy(z + 2, s->d, patches * sizeof *z);
  memcpy(z + 2 + patches, s->extra, m->extras * sizeof *z);
  // An error in place is one in force, and in energy, by the springs that act.
  Linear acting;
  sb_motion_linear_forces(s, &acting);
  s->system.ceiling[0] = acting.k > 0.0 ? force_size / acting.k : 0.0;
  // A very stiff drive turns the rounding of its own place into acceleration and speed: less than
  // that cannot be asked for.
  double square = acting.k / s->parts.mass, noise = 0.0;
  if (square > stiff_square && s->push.on && m->drive.quantity == SB_DRIVE_OF_POSITION) {
    double place, rate;
    sb_motion_drive_at(s, s->t, &place, &rate);
    noise = DBL_EPSILON * (fabs(place) + fabs(rate * s->t)) * square;
  }
  double speed = noise / sqrt(fmax(square, 1.0));
  double quickest = quickest_rate(s);
  s->system.floor[1] = fmax(speed_size, 10.0 * speed / s->system.tolerance);
  for (size_t i = 0; i < patches; i++) {
    s->system.ceiling[2 + i] = is_rigid(m, i) ? 0.0 : force_size / m->contact[i].stiffness;
  }
  double left = fmin(s->piece.until - s->t, horizon_max);
  double h = s->h > 0.0 ? s->h : first_step(s);
  if (s->piece.curved) {
    h = fmin(h, s->piece.step);
  }
  s->system.user = s;
  bool again = false;
  for (int attempt = 0; attempt < 80; attempt++) {
    double error, local[SB_RADAU_MAX];
    bool last = h >= left;
    h = last ? left : h;
    if (s->t + h <= s->t) {
      break;
    }
    // A step that is long against the relaxation damps that rounding, too.
    double damped = fmax(1.0, h * quickest);
    s->system.noise[0] = 8.0 * speed / damped;
    s->system.noise[1] = 8.0 * noise / damped;
    if (!sb_radau_pair(s->step, &error, local, &s->system, s->t, z, h, &s->radau)) {
      h *= 0.25;
      s->counters.rejected++;
      continue;
    }
    double factor = error > 0.0 ? fmin(4.0, fmax(0.2, 0.85 * pow(error, -1.0 / 6.0))) : 4.0;
    if (error > 1.0) {
      h *= fmin(factor, 0.7);
      s->counters.rejected++;
      continue;
    }
    // A step that had to be shortened is not lengthened at once.
    s->h = h * (attempt > 0 ? fmin(factor, 1.0) : factor);
    s->middle = s->step[0].t + s->step[0].h;
    s->t_end = last ? s->t + left : s->t + h;
    s->event = EVENT_BREAK;
    if (last && isfinite(s->piece.until)) {
      s->t_end = s->piece.until;
    }
    double far = s->step[1].z1[0];
    if (!cut_at_event(s, report)) {
      return SB_ERROR_NOT_CONVERGED;
    }
    // Loads have a corner on an edge. A step that reaches far over one has seen mostly what lies
    // behind, and its error says nothing of the way to it: again, no longer than that way.
    double way = s->t_end - s->t;
    bool edge = s->event == EVENT_EDGE_UP || s->event == EVENT_EDGE_DOWN;
    if (edge && !again && way < 0.9 * h &&
        fabs(far - m->edge[s->region - (s->event == EVENT_EDGE_DOWN)]) > overshoot_max) {
      again = true;
      h = 1.02 * way;
      s->counters.rejected++;
      continue;
    }
    s->counters.steps++;
    s->counters.local_error += local[0] / (fabs(s->x) + s->system.floor[0]);
    s->middle = s->step[0].t + s->step[0].h;
    if (s->event != EVENT_BREAK) {
      // What follows may be much quicker.
      s->h = fmin(s->h, first_step(s));
    }
    return SB_OK;
  }
  return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                 "no step of the motion converges at %.9g s (step %.3g s)", s->t, h);
}

SbStatus sb_motion_find_path(SbDynamics *s, SbReport *report) {
  s->linear = has_closed_form(s);
  for (size_t i = 0; i < s->model->contacts; i++) {
    // One that was brisk stays so while it slows down to the speed of rest, in however many steps.
    double slip = fabs(sb_motion_patch_speed(s, i)), rest = sb_motion_rest_speed(s->model);
    s->brisk[i] = s->state[i] == SB_CONTACT_SLIP && slip > (s->brisk[i] ? rest : 2.0 * rest);
  }
  if (s->linear) {
    closed_path(s);
    return SB_OK;
  }
  return numerical_path(s, report);
}

// Force of the drive at time t of the segment.
static double push_at(const SbDynamics *s, double t) {
  double x, v, d[SB_DYNAMICS_CONTACTS], extra[SB_DYNAMICS_EXTRAS];
  sb_motion_state_at(s, t, &x, &v, d, extra);
  return sb_motion_drive_force(s, t, x, v);
}

// Largest force inside a step, no less than `peak`: its place is the vertex of the parabola through
// three points of the dense output, and again about it; its value is found by stepping there, as
// accurate as the solution. Steps are short against whatever swings.
static double step_peak(const SbDynamics *s, const SbRadauStep *step, double peak) {
  double t = step->t, theta = 0.5, span = 0.5;
  for (int i = 0; i < 3; i++) {
    double low = push_at(s, t + (theta - span) * step->h), f = push_at(s, t + theta * step->h),
           high = push_at(s, t + (theta + span) * step->h);
    double bend = low - 2.0 * f + high, slope = 0.5 * (high - low);
    if (!(bend < 0.0 && fabs(slope) < -bend) ||
        f - 0.5 * slope * slope / bend - 0.1 * bend < peak) {
      return peak; // greatest at an end, or too low
    }
    theta += slope / -bend * span;
    span = 0.25 * fmin(span, fmin(theta, 1.0 - theta));
  }
  SbRadauStep there;
  SbRadauCounters counters = {0};
  double h = theta * step->h;
  return sb_radau_step(&there, &s->system, t, step->z0, h, &counters)
             ? fmax(peak, sb_motion_drive_force(s, t + h, there.z1[0], there.z1[1]))
             : peak;
}

double sb_motion_force_peak(const SbDynamics *s, double known) {
  const SbDynamicsModel *m = s->model;
  if (m->drive.kind == SB_DRIVE_NONE || !s->push.on || !s->ready) {
    return known;
  }
  double first = sb_motion_drive_force(s, s->t, s->x, s->v);
  double peak = fmax(known, fmax(first, push_at(s, s->t_end)));
  if (!s->linear) {
    peak = fmax(peak, push_at(s, s->middle));
    for (int i = 0; i < 2; i++) {
      peak = s->step[i].h > 0.0 ? step_peak(s, &s->step[i], peak) : peak;
    }
    return peak;
  }
  if (s->held || m->drive.quantity == SB_DRIVE_OF_FORCE) {
    return peak; // straight in time, or given
  }
  // The first time at which the force stops rising; later swings of a stem that rings are lower,
  // or the end of the segment is higher. Nothing to gain far below the peak: the force can rise by
  // no more than its swing.
  double y, rate, k = m->drive_stiffness, c = m->drive_damping;
  sb_motion_drive_at(s, s->t, &y, &rate);
  Linear l;
  sb_motion_linear_forces(s, &l);
  double a = (l.f0 - l.c * s->v) / s->parts.mass;
  double slope = k * (rate - s->v) - c * a;
  double swing = k * hypot(s->motion.z0, s->motion.w0 / fmax(s->motion.omega0, 1e-300));
  if (!(slope > 0.0) || first + 2.0 * swing + k * fabs(s->motion.trend1 - rate) < peak) {
    return peak;
  }
  SbEventFunction rising = {.constant = k * rate - c * l.f0 / s->parts.mass,
                            .rate = -c * l.f1 / s->parts.mass,
                            .of_x = c * l.k / s->parts.mass,
                            .of_v = c * l.c / s->parts.mass - k};
  bool found;
  double at = sb_event_first(&rising, &s->motion, s->t_end - s->t, &found);
  return found ? fmax(peak, push_at(s, fmin(s->t + at, s->t_end))) : peak;
}
