// Effects of events in dynamics.h. A segment lasts from one event to the next. dynamics_path.c
// finds its motion and its end; this file applies the event at its end.
#include "engine/mechanism/dynamics_internal.h"
#include "engine/numeric/root.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { ACCUMULATED_MAX = 500 };

// Damping of a spring and damper that returns a free mass with restitution e, the impact ending
// when its force does: e = exp(-zeta/s (pi - atan2(2 zeta s, 1 - 2 zeta^2))), s = sqrt(1 - zeta^2).
static double restitution_of(double zeta) {
  double difference = (1.0 - zeta) * (1.0 + zeta), s = sqrt(fabs(difference));
  if (s < 1e-6) {
    return exp(-2.0);
  }
  if (difference > 0.0) {
    return exp(-zeta / s * (M_PI - atan2(2.0 * zeta * s, 1.0 - 2.0 * zeta * zeta)));
  }
  return exp(-2.0 * zeta / s * log(zeta + s));
}

static double too_springy(double zeta, const void *restitution) {
  return restitution_of(zeta) - *(const double *)restitution;
}

static double damping_for(double mass, double stiffness, double restitution) {
  if (restitution >= 1.0 || rigid(stiffness)) {
    return 0.0;
  }
  return 2.0 * sb_bisect(too_springy, &restitution, 0.0, 100.0) * sqrt(stiffness * mass);
}

// Makes the end of the segment the new anchor.
static void anchor(SbDynamics *s) {
  SbDynamicsState z;
  SbDynamicsEnergy energy;
  double tau = s->t_end - s->t;
  s->force_peak = sb_motion_force_peak(s, s->force_peak);
  sb_motion_state_at(s, tau, &z);
  sb_motion_energy_at(s, tau, &z, &energy);
  s->energy = energy;
  s->t = s->now = s->t_end;
  s->at = z;
  s->ready = false;
}

// ---- what an event does ----

static void tell(SbDynamics *s, SbMotionEventKind kind, int index, int sign) {
  if (s->listener != NULL) {
    Point p;
    sb_motion_point(&p, s, s->t, &s->at);
    SbMotionEvent event = {.kind = kind,
                           .index = index,
                           .sign = sign,
                           .time = s->t,
                           .position = s->at.x,
                           .speed = s->at.v,
                           .drive_force = force_of(&p.wall[SB_DYNAMICS_PLATEN], &p)};
    s->listener(&event, s->listener_user);
  }
}

static void update_held(SbDynamics *s) {
  s->held = false;
  for (size_t i = 0; i < s->model->contacts; i++) {
    s->held = s->held || (is_rigid(s->model, i) && s->state[i] == SB_CONTACT_STUCK);
  }
  for (size_t w = 0; w < SB_DYNAMICS_WALLS; w++) {
    s->held = s->held || (s->wall[w].on && rigid(s->wall[w].stiffness));
  }
}

// A contact whose deflection changes instantaneously (no damper): the difference is dissipated by
// friction.
static void jump_deflection(SbDynamics *s, size_t i, double to) {
  double k = s->model->contact[i].stiffness;
  s->energy.friction += 0.5 * k * (s->at.d[i] - to) * (s->at.d[i] + to);
  s->at.d[i] = to;
}

static void load_region(SbDynamics *s) {
  s->loads = (SbDynamicsLoads){.constant = true};
  if (s->model->loads != NULL) {
    s->loads = (SbDynamicsLoads){0};
    s->model->loads(&s->loads, s->at.x, s->region, &s->at.extra, s->model->user);
  }
}

// A contact comes to rest; `fresh`: newly loaded, it sticks up to the sliding level only.
static void rest(SbDynamics *s, size_t i, bool fresh) {
  s->state[i] = SB_CONTACT_STUCK;
  s->since[i] = s->t;
  s->fresh[i] = fresh;
}

// Slips shorter than the first part of the time in which a contact's damper relaxes are chatter; a
// contact that chatters holds by no more than the second part of its level longer.
static const double chatter = 1e-3, margin_most = 1e-3;

// Contact i has come to rest. If it had only begun to slide it is exactly at its limit: rounding
// cannot decide, so its limit is raised by rounding. More where it chatters: the film's drag, by
// the stem's speed, ends as the patch comes to rest under a stem that still moves, and the contact
// cannot hold without it.
static void set_margin(SbDynamics *s, size_t i) {
  const SbDynamicsContact *c = &s->model->contact[i];
  const double least = fmax(1e-14 * s->slipped[i], chatter * c->damping / c->stiffness);
  const bool moved = s->t > s->slipped[i] + least;
  const double level = s->loads.level[i];
  s->margin[i] = moved ? 0.0 : fmin(fmax(4.0 * s->margin[i], 1e-12 * level), margin_most * level);
}

// Speed of the patch of contact i over the bore [m/s].
static double patch_speed(const SbDynamics *s, size_t i) {
  Point p;
  sb_motion_point(&p, s, s->t, &s->at);
  return p.v - sb_motion_deflection_rate(s, &p, i);
}

// A sliding contact without a damper gets the deflection of its level immediately, if that is not
// larger than the present one (false).
static bool spring_back(SbDynamics *s, size_t i) {
  double level = sb_motion_level(&s->loads, i, s->sign[i]);
  level = sb_motion_sliding_level(s, i, level, fabs(s->at.v));
  double to = s->sign[i] * level / s->model->contact[i].stiffness;
  if (fabs(to) < fabs(s->at.d[i])) {
    jump_deflection(s, i, to);
  }
  return fabs(to) <= fabs(s->at.d[i]);
}

// Loads have changed discontinuously: determines which contacts appear, vanish, stick or slip.
static void reload(SbDynamics *s) {
  const SbDynamicsModel *m = s->model;
  load_region(s);
  for (size_t i = 0; i < m->contacts; i++) {
    const SbDynamicsContact *c = &m->contact[i];
    if (!(s->loads.level[i] > 0.0) && s->loads.constant) {
      if (s->state[i] != SB_CONTACT_OFF && !is_rigid(m, i)) {
        jump_deflection(s, i, 0.0);
      }
      s->state[i] = SB_CONTACT_OFF;
      continue;
    }
    if (s->state[i] == SB_CONTACT_OFF) {
      s->since[i] = s->t;
      s->sign[i] = s->at.v < 0.0 ? -1 : 1;
      s->at.d[i] = 0.0;
      s->fresh[i] = !is_rigid(m, i);
      s->state[i] = is_rigid(m, i) && s->at.v != 0.0 ? SB_CONTACT_SLIP : SB_CONTACT_STUCK;
    } else if (s->state[i] == SB_CONTACT_SLIP && !is_rigid(m, i) && c->damping == 0.0) {
      // A higher level must be built up by travel; a lower one lets the seal spring back.
      if (!spring_back(s, i)) {
        rest(s, i, true);
      }
    } else if (s->state[i] == SB_CONTACT_SLIP && !is_rigid(m, i) &&
               s->sign[i] * patch_speed(s, i) < 0.0) {
      rest(s, i, true);
    }
  }
  update_held(s);
}

static void cross_edge(SbDynamics *s, int direction) {
  const SbDynamicsModel *m = s->model;
  size_t edge = direction > 0 ? s->region : s->region - 1;
  s->at.x = m->edge[edge];
  tell(s, SB_MOTION_EDGE, (int)edge, direction);
  s->region = direction > 0 ? s->region + 1 : s->region - 1;
  if (m->cross != NULL) {
    m->cross(edge, direction, &s->at.extra, m->user);
  }
  reload(s);
}

// Rigid contacts slide, stick or turn after the stem's speed was set.
static void turn_rigid(SbDynamics *s) {
  for (size_t i = 0; i < s->model->contacts; i++) {
    if (!is_rigid(s->model, i) || s->state[i] == SB_CONTACT_OFF) {
      continue;
    }
    if (s->at.v != 0.0) {
      s->state[i] = SB_CONTACT_SLIP;
      s->sign[i] = s->at.v > 0.0 ? 1 : -1;
    } else if (s->state[i] != SB_CONTACT_STUCK) {
      rest(s, i, false);
    }
  }
  update_held(s);
}

// Returns the force on a stem at rest at x, without the forces of rigid contacts and stops.
static double demand_at(const SbDynamics *s, double x) {
  SbDynamicsState z = s->at;
  Point p;
  z.x = x;
  z.v = 0.0;
  sb_motion_point(&p, s, s->t, &z);
  return p.sum.f0 - p.rigid;
}

// A wall is met, or left.
static void wall_event(SbDynamics *s, size_t w) {
  static const SbMotionEventKind kind[2][2] = {{SB_MOTION_TOUCH_STOP, SB_MOTION_LEAVE_STOP},
                                               {SB_MOTION_TOUCH_DRIVE, SB_MOTION_LEAVE_DRIVE}};
  SbDynamicsWall *wall = &s->wall[w];
  bool platen = w == SB_DYNAMICS_PLATEN;
  tell(s, kind[platen][wall->on], platen ? 0 : (int)w, 0);
  if (wall->on) {
    double left = wall->push * sb_motion_deflection(s, w, s->t, s->at.x);
    wall->residual = wall->damping > 0.0 ? fmax(0.0, left) : 0.0;
    wall->since = s->t;
    wall->on = false;
    update_held(s);
    return;
  }
  wall->residual = 0.0;
  if (!rigid(wall->stiffness)) {
    wall->on = true;
    return;
  }
  const SbDynamicsStop *stop = &s->model->stop[w];
  double back = -stop->restitution * s->at.v;
  // A rebound lower than a picometre is none either: bounces would go on below what is resolved.
  double press = -wall->push * demand_at(s, stop->position);
  bool low = press > 0.0 && s->mass * back * back < 2e-12 * press;
  if (fabs(back) < sb_motion_rest_speed(s->model) || low) {
    back = 0.0;
    wall->on = true;
  }
  s->energy.stop += 0.5 * s->mass * (s->at.v - back) * (s->at.v + back);
  s->at.x = stop->position;
  s->at.v = back;
  turn_rigid(s);
}

static void rigid_event(SbDynamics *s, int direction) {
  const SbDynamicsModel *m = s->model;
  if (s->held) {
    // Breaks away; the speed is still zero.
    tell(s, SB_MOTION_SLIP, -1, direction);
    s->direction = direction;
    for (size_t i = 0; i < m->contacts; i++) {
      if (is_rigid(m, i) && s->state[i] == SB_CONTACT_STUCK) {
        s->state[i] = SB_CONTACT_SLIP;
        s->sign[i] = direction;
        s->slipped[i] = s->t;
      }
    }
    update_held(s);
    return;
  }
  // Comes to rest, or reverses if the forces exceed the static limits.
  s->energy.friction += 0.5 * s->mass * s->at.v * s->at.v;
  s->at.v = 0.0;
  tell(s, SB_MOTION_STICK, -1, 0);
  turn_rigid(s);
  Point p;
  double hold = 0.0;
  sb_motion_point(&p, s, s->t, &s->at);
  const int pulled = p.sum.f0 > 0.0 ? 1 : -1;
  for (size_t i = 0; i < m->contacts; i++) {
    if (is_rigid(m, i) && s->state[i] == SB_CONTACT_STUCK) {
      set_margin(s, i);
      hold += sb_motion_holding(s, &p, i, pulled);
    }
  }
  if (fabs(p.sum.f0) > hold) {
    rigid_event(s, pulled);
  }
}

static void contact_event(SbDynamics *s, size_t i, int direction) {
  const SbDynamicsContact *c = &s->model->contact[i];
  if (s->state[i] == SB_CONTACT_SLIP) {
    tell(s, SB_MOTION_STICK, (int)i, 0);
    if (c->damping > 0.0 && s->brisk[i]) {
      // It still crept a little: the spring takes what the damper carried of it.
      jump_deflection(s, i, s->at.d[i] - c->damping / c->stiffness * patch_speed(s, i));
    }
    rest(s, i, false);
    set_margin(s, i);
    return;
  }
  tell(s, SB_MOTION_SLIP, (int)i, direction);
  s->direction = direction; // should the stem have no speed yet
  s->slipped[i] = s->t;
  s->state[i] = SB_CONTACT_SLIP;
  s->sign[i] = direction;
  s->fresh[i] = false;
  if (c->damping == 0.0) {
    (void)spring_back(s, i);
  }
}

// The stem's speed leaves its band, at rest into that of the other direction.
static void speed_event(SbDynamics *s, int side) {
  s->at.v = s->direction * (side > 0 ? s->band.high : s->band.low);
  s->fell = side < 0;
  s->direction = s->at.v == 0.0 ? -s->direction : s->direction;
}

// Returns whether a contact that rested slides from then on.
static bool apply(SbDynamics *s, int event) {
  const bool rigid_one = event == EVENT_RIGID_UP || event == EVENT_RIGID_DOWN;
  const size_t i =
      event >= EVENT_CONTACT_UP ? (size_t)(event - EVENT_CONTACT_UP) % SB_DYNAMICS_CONTACTS : 0;
  const bool rested =
      rigid_one ? s->held : event >= EVENT_CONTACT_UP && s->state[i] == SB_CONTACT_STUCK;
  const bool counts = event != EVENT_BREAK && event != EVENT_SPEED_UP && event != EVENT_SPEED_DOWN;
  s->counters.events += counts;
  s->platens += event == EVENT_PLATEN;
  s->others += counts && !rigid_one && event != EVENT_PLATEN && event < EVENT_CONTACT_UP;
  s->least_stretch = fmin(s->least_stretch, fabs(sb_motion_drive_at(s, s->t).value - s->at.x));
  if (event >= EVENT_CONTACT_UP) {
    contact_event(s, i, event >= EVENT_CONTACT_DOWN ? -1 : 1);
  } else if (event >= EVENT_STOP) {
    wall_event(s, (size_t)(event - EVENT_STOP));
  } else if (event >= EVENT_SPEED_UP) {
    speed_event(s, event == EVENT_SPEED_UP ? 1 : -1);
  } else if (rigid_one) {
    rigid_event(s, event == EVENT_RIGID_UP ? 1 : -1);
  } else if (event == EVENT_PLATEN) {
    wall_event(s, SB_DYNAMICS_PLATEN);
  } else if (event >= EVENT_EDGE_UP) {
    cross_edge(s, event == EVENT_EDGE_UP ? 1 : -1);
  }
  return rested && (rigid_one ? !s->held : s->state[i] == SB_CONTACT_SLIP);
}

// ---- public ----

SbStatus sb_dynamics_init(SbDynamics *s, const SbDynamicsModel *m, SbReport *report) {
  SbStatus status = sb_dynamics_check(m, report);
  if (status != SB_OK) {
    return status;
  }
  *s = (SbDynamics){.model = m,
                    .mass = m->mass,
                    .at = {{.x = m->start_position, .v = m->start_speed, .extra = m->extra_start}},
                    .event = EVENT_NONE};
  // An edge exactly under the stem counts as crossed.
  while (s->region < m->edges && m->edge[s->region] <= s->at.x) {
    s->region++;
  }
  for (size_t i = 0; i < m->stops; i++) {
    const SbDynamicsStop *p = &m->stop[i];
    s->wall[i] =
        (SbDynamicsWall){.push = -p->side,
                         .stiffness = p->stiffness,
                         .damping = damping_for(m->mass, p->stiffness, p->restitution),
                         .on = !rigid(p->stiffness) && p->side * (s->at.x - p->position) > 0.0};
  }
  sb_drive_start(&s->drive, &m->drive);
  sb_drive_piece(&s->piece, &s->drive, &m->drive, 0.0);
  if (m->drive.kind != SB_DRIVE_NONE) {
    // A platen that starts in the stem's place is already pressed.
    bool pressed = !sb_motion_by_force(m) && s->piece.value > s->at.x;
    s->wall[SB_DYNAMICS_PLATEN] =
        (SbDynamicsWall){.push = 1,
                         .stiffness = sb_motion_by_force(m) ? 0.0 : m->drive_stiffness,
                         .damping = m->drive_damping,
                         .on = m->drive_bonded || pressed};
  }
  reload(s);
  // A stem pressed onto a rigid stop is at rest on it from the start.
  for (size_t i = 0; i < m->stops; i++) {
    const SbDynamicsStop *p = &m->stop[i];
    bool rests = rigid(p->stiffness) && s->at.x == p->position && s->at.v == 0.0;
    s->wall[i].on = s->wall[i].on || (rests && p->side * demand_at(s, s->at.x) > 0.0);
  }
  update_held(s);
  for (size_t i = 0; i < m->contacts; i++) {
    s->fresh[i] = false;
    s->since[i] = -m->start_dwell;
    s->slipped[i] = -1.0;
  }
  s->kinetic_start = 0.5 * m->mass * s->at.v * s->at.v;
  s->stored_start = sb_motion_stored_energy(s, 0.0, &s->at);
  s->accumulated_at = -1.0;
  s->broke.event = s->mark.event = s->envelope.mark.event = EVENT_NONE;
  return sb_succeed(report);
}

void sb_dynamics_listen(SbDynamics *s, void (*listener)(const SbMotionEvent *event, void *user),
                        void *user) {
  s->listener = listener;
  s->listener_user = user;
}

// Events that follow each other without time passing are a fault of the model.
static bool accumulates(SbDynamics *s) {
  if (s->t > s->accumulated_at) {
    s->accumulated_at = s->t;
    s->accumulated = 0;
  }
  return ++s->accumulated > ACCUMULATED_MAX;
}

SbStatus sb_dynamics_advance(SbDynamics *s, double time, SbReport *report) {
  if (!(time >= s->now)) {
    return sb_fail(report, SB_ERROR_RANGE, "the motion cannot go back from %g s to %g s", s->now,
                   time);
  }
  s->asked = time;
  for (;;) {
    if (!s->ready) {
      if (s->model->poll != NULL && s->model->poll(s->model->poll_data)) {
        s->now = s->t;
        return sb_fail(report, SB_ERROR_CANCELLED, "cancelled");
      }
      sb_drive_piece(&s->piece, &s->drive, &s->model->drive, s->t);
      if (s->wall[SB_DYNAMICS_PLATEN].on && sb_motion_finger_gone(s)) {
        wall_event(s, SB_DYNAMICS_PLATEN);
      }
      SbStatus status = SB_OK;
      if (s->model->mass_at != NULL) {
        status = s->model->mass_at(&s->mass, s->at.x, s->at.v, s->model->user, report);
      }
      status = status != SB_OK ? status : sb_motion_find_path(s, report);
      if (status != SB_OK) {
        s->now = s->t;
        return status;
      }
      s->ready = true;
      s->counters.segments++;
      if (s->counters.segments > SEGMENTS_MAX) {
        return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                       "too many steps at %.9g s (%ld): the motion is too quick for its duration, "
                       "as with a very stiff machine and a slow stroke",
                       s->t, s->counters.segments);
      }
    }
    if (time < s->t_end) {
      s->now = time;
      return sb_succeed(report);
    }
    int event = s->event;
    anchor(s);
    if (!s->loads.constant) {
      // Loads that vary in a region may settle there (a chamber that has emptied).
      load_region(s);
      if (s->loads.constant) {
        reload(s);
      }
    }
    if (event != EVENT_NONE) {
      if (apply(s, event)) {
        sb_motion_repeat(s, event);
        s->now = s->t;
      }
      if (event != EVENT_BREAK && accumulates(s)) {
        return sb_fail(report, SB_ERROR_NOT_CONVERGED, "events accumulate at %.9g s (%ld events)",
                       s->t, s->counters.events);
      }
    }
  }
}
