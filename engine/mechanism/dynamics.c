// What events do in dynamics.h. A segment lasts from one event to the next; dynamics_path.c
// finds its motion and its end, this file says what the end does.
#include "engine/mechanism/dynamics_internal.h"
#include "engine/numeric/root.h"

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
  if (restitution >= 1.0 || stiffness > 1e300) {
    return 0.0;
  }
  return 2.0 * sb_bisect(too_springy, &restitution, 0.0, 100.0) * sqrt(stiffness * mass);
}

// Makes the state at t the new anchor.
static void anchor(SbDynamics *s, double t) {
  double x, v, d[SB_DYNAMICS_CONTACTS], extra[SB_DYNAMICS_EXTRAS];
  SbDynamicsEnergy energy;
  s->force_peak = sb_motion_force_peak(s, s->force_peak);
  sb_motion_state_at(s, t, &x, &v, d, extra);
  sb_motion_energy_at(s, t, x, v, d, &energy);
  s->energy = energy;
  s->t = t;
  s->x = x;
  s->v = v;
  memcpy(s->d, d, sizeof d);
  memcpy(s->extra, extra, sizeof extra);
  s->ready = false;
}

// ---- what an event does ----

static void tell(SbDynamics *s, SbMotionEventKind kind, int index, int sign) {
  if (s->listener != NULL) {
    SbMotionEvent event = {.kind = kind,
                           .index = index,
                           .sign = sign,
                           .time = s->t,
                           .position = s->x,
                           .speed = s->v,
                           .drive_force = sb_motion_drive_force(s, s->t, s->x, s->v)};
    s->listener(&event, s->listener_user);
  }
}

static void update_held(SbDynamics *s) {
  s->held = false;
  for (size_t i = 0; i < s->model->contacts; i++) {
    s->held = s->held || (is_rigid(s->model, i) && s->state[i] == SB_CONTACT_STUCK);
  }
  for (size_t i = 0; i < s->model->stops; i++) {
    s->held = s->held || (s->touch[i].on && s->model->stop[i].stiffness > 1e300);
  }
}

// A contact whose deflection changes at once (no damper): the difference is rubbed away.
static void jump_deflection(SbDynamics *s, size_t i, double to) {
  double k = s->model->contact[i].stiffness;
  s->energy.friction += 0.5 * k * (s->d[i] - to) * (s->d[i] + to);
  s->d[i] = to;
}

static void load_region(SbDynamics *s) {
  s->loads = (SbDynamicsLoads){.constant = true};
  if (s->model->loads != NULL) {
    s->loads = (SbDynamicsLoads){0};
    s->model->loads(&s->loads, s->x, s->region, s->extra, s->model->user);
  }
}

// A contact comes to rest; `fresh`: newly loaded, it sticks up to the sliding level only.
static void rest(SbDynamics *s, size_t i, bool fresh) {
  s->state[i] = SB_CONTACT_STUCK;
  s->since[i] = s->t;
  s->fresh[i] = fresh;
}

// Loads have changed at once: which contacts appear, vanish, hold or let go.
static void reload(SbDynamics *s) {
  const SbDynamicsModel *m = s->model;
  load_region(s);
  for (size_t i = 0; i < m->contacts; i++) {
    const SbDynamicsContact *c = &m->contact[i];
    double level = s->loads.level[i];
    bool active = level > 0.0 || !s->loads.constant;
    if (!active) {
      if (s->state[i] != SB_CONTACT_OFF && !is_rigid(m, i)) {
        jump_deflection(s, i, 0.0);
      }
      s->state[i] = SB_CONTACT_OFF;
      continue;
    }
    if (s->state[i] == SB_CONTACT_OFF) {
      s->since[i] = s->t;
      s->sign[i] = s->v < 0.0 ? -1 : 1;
      s->d[i] = 0.0;
      s->fresh[i] = !is_rigid(m, i);
      s->state[i] = is_rigid(m, i) && s->v != 0.0 ? SB_CONTACT_SLIP : SB_CONTACT_STUCK;
    } else if (s->state[i] == SB_CONTACT_SLIP && !is_rigid(m, i) && c->damping == 0.0) {
      // A higher level must be built up by travel; a lower one lets the seal spring back.
      double to = s->sign[i] * sb_motion_sliding_level(s, i, level, fabs(s->v)) / c->stiffness;
      if (fabs(to) < fabs(s->d[i])) {
        jump_deflection(s, i, to);
      } else if (fabs(to) > fabs(s->d[i])) {
        rest(s, i, true);
      }
    } else if (s->state[i] == SB_CONTACT_SLIP && !is_rigid(m, i)) {
      double rate =
          (s->sign[i] * sb_motion_sliding_level(s, i, level, fabs(s->v)) - c->stiffness * s->d[i]) /
          c->damping;
      if (s->sign[i] * (s->v - rate) < 0.0) {
        rest(s, i, true);
      }
    }
  }
  update_held(s);
}

static void cross_edge(SbDynamics *s, int direction) {
  const SbDynamicsModel *m = s->model;
  size_t edge = direction > 0 ? s->region : s->region - 1;
  s->x = m->edge[edge];
  tell(s, SB_MOTION_EDGE, (int)edge, direction);
  s->region = direction > 0 ? s->region + 1 : s->region - 1;
  if (m->cross != NULL) {
    m->cross(edge, direction, s->extra, m->user);
  }
  reload(s);
}

static void switch_drive(SbDynamics *s) {
  const SbDynamicsModel *m = s->model;
  tell(s, s->push.on ? SB_MOTION_LEAVE_DRIVE : SB_MOTION_TOUCH_DRIVE, 0, 0);
  s->push.residual = 0.0;
  if (s->push.on && m->drive.quantity == SB_DRIVE_OF_POSITION) {
    double y, rate;
    sb_motion_drive_at(s, s->t, &y, &rate);
    s->push.residual = m->drive_damping > 0.0 ? fmax(0.0, y - s->x) : 0.0;
    s->push.since = s->t;
  }
  s->push.on = !s->push.on;
}

// Rigid contacts slide, stick or turn after the stem's speed was set.
static void turn_rigid(SbDynamics *s) {
  for (size_t i = 0; i < s->model->contacts; i++) {
    if (!is_rigid(s->model, i) || s->state[i] == SB_CONTACT_OFF) {
      continue;
    }
    if (s->v != 0.0) {
      s->state[i] = SB_CONTACT_SLIP;
      s->sign[i] = s->v > 0.0 ? 1 : -1;
    } else if (s->state[i] != SB_CONTACT_STUCK) {
      rest(s, i, false);
    }
  }
  update_held(s);
}

static void meet_stop(SbDynamics *s, size_t i) {
  const SbDynamicsStop *p = &s->model->stop[i];
  bool rigid = p->stiffness > 1e300;
  SbDynamicsTouch *touch = &s->touch[i];
  if (touch->on) {
    tell(s, SB_MOTION_LEAVE_STOP, (int)i, 0);
    touch->on = false;
    double e = p->side * (s->x - p->position);
    touch->residual = !rigid && s->stop_damping[i] > 0.0 ? fmax(0.0, e) : 0.0;
    touch->since = s->t;
    update_held(s);
    return;
  }
  tell(s, SB_MOTION_TOUCH_STOP, (int)i, 0);
  if (!rigid) {
    touch->on = true;
    touch->residual = 0.0;
    return;
  }
  double rest = sb_motion_rest_speed(s->model);
  double back = -p->restitution * s->v;
  // A rebound lower than a picometre is none either: bounces would go on below what is resolved.
  double press = p->side * sb_motion_demand(s, s->t, p->position, s->d, &s->loads);
  bool low = press > 0.0 && s->model->mass * back * back < 2e-12 * press;
  if (fabs(back) < rest || low) {
    back = 0.0;
    touch->on = true;
  }
  s->energy.stop += 0.5 * s->model->mass * (s->v - back) * (s->v + back);
  s->x = p->position;
  s->v = back;
  turn_rigid(s);
}

static void rigid_event(SbDynamics *s, int direction) {
  const SbDynamicsModel *m = s->model;
  if (s->held) {
    // Breaks away; the speed is still zero.
    tell(s, SB_MOTION_SLIP, -1, direction);
    for (size_t i = 0; i < m->contacts; i++) {
      if (is_rigid(m, i) && s->state[i] == SB_CONTACT_STUCK) {
        s->state[i] = SB_CONTACT_SLIP;
        s->sign[i] = direction;
      }
    }
    update_held(s);
    return;
  }
  // Comes to rest, or turns if the forces are too large to hold it.
  s->energy.friction += 0.5 * m->mass * s->v * s->v;
  s->v = 0.0;
  tell(s, SB_MOTION_STICK, -1, 0);
  turn_rigid(s);
  double hold = 0.0;
  for (size_t i = 0; i < m->contacts; i++) {
    if (is_rigid(m, i) && s->state[i] == SB_CONTACT_STUCK) {
      hold += sb_motion_holding_level(s, i, s->loads.level[i], s->t);
    }
  }
  double pull = sb_motion_demand(s, s->t, s->x, s->d, &s->loads);
  if (fabs(pull) > hold) {
    rigid_event(s, pull > 0.0 ? 1 : -1);
  }
}

static void contact_event(SbDynamics *s, size_t i, int direction) {
  const SbDynamicsContact *c = &s->model->contact[i];
  if (s->state[i] == SB_CONTACT_SLIP) {
    tell(s, SB_MOTION_STICK, (int)i, 0);
    if (c->damping > 0.0 && s->brisk[i]) {
      // It still crept a little: the spring takes what the damper carried of it.
      jump_deflection(s, i, s->d[i] - c->damping / c->stiffness * sb_motion_patch_speed(s, i));
    }
    rest(s, i, false);
    if (s->t > s->slipped[i] * (1.0 + 1e-14)) {
      s->margin[i] = 0.0;
    } else {
      // Exactly at its limit: rounding cannot decide, so its limit is raised by rounding.
      s->margin[i] = fmax(4.0 * s->margin[i], 1e-12 * s->loads.level[i]);
    }
    return;
  }
  tell(s, SB_MOTION_SLIP, (int)i, direction);
  s->slipped[i] = s->t;
  s->state[i] = SB_CONTACT_SLIP;
  s->sign[i] = direction;
  s->fresh[i] = false;
  if (c->damping == 0.0) {
    double to =
        direction * sb_motion_sliding_level(s, i, s->loads.level[i], fabs(s->v)) / c->stiffness;
    if (fabs(to) < fabs(s->d[i])) {
      jump_deflection(s, i, to);
    }
  }
}

static void apply(SbDynamics *s, int event) {
  s->counters.events += event != EVENT_BREAK;
  switch (event) {
  case EVENT_BREAK:
    return;
  case EVENT_EDGE_UP:
    cross_edge(s, 1);
    return;
  case EVENT_EDGE_DOWN:
    cross_edge(s, -1);
    return;
  case EVENT_DRIVE:
    switch_drive(s);
    return;
  case EVENT_RIGID_UP:
    rigid_event(s, 1);
    return;
  case EVENT_RIGID_DOWN:
    rigid_event(s, -1);
    return;
  default:
    break;
  }
  if (event >= EVENT_CONTACT_DOWN) {
    contact_event(s, (size_t)(event - EVENT_CONTACT_DOWN), -1);
  } else if (event >= EVENT_CONTACT_UP) {
    contact_event(s, (size_t)(event - EVENT_CONTACT_UP), 1);
  } else {
    meet_stop(s, (size_t)(event - EVENT_STOP));
  }
}

// ---- public ----

SbStatus sb_dynamics_init(SbDynamics *s, const SbDynamicsModel *m, SbReport *report) {
  SbStatus status = sb_dynamics_check(m, report);
  if (status != SB_OK) {
    return status;
  }
  *s = (SbDynamics){.model = m, .x = m->start_position, .v = m->start_speed, .event = EVENT_NONE};
  s->parts = (SbDynamicsParts){m->mass, 1.0, 1.0, 1.0, {1.0, 1.0, 1.0, 1.0}};
  memcpy(s->extra, m->extra_start, sizeof s->extra);
  // An edge exactly under the stem counts as crossed.
  while (s->region < m->edges && m->edge[s->region] <= s->x) {
    s->region++;
  }
  for (size_t i = 0; i < m->stops; i++) {
    const SbDynamicsStop *p = &m->stop[i];
    s->stop_damping[i] = damping_for(m->mass, p->stiffness, p->restitution);
    s->touch[i].on = p->stiffness < 1e300 && p->side * (s->x - p->position) > 0.0;
  }
  sb_drive_start(&s->drive, &m->drive);
  sb_drive_piece(&s->piece, &s->drive, &m->drive, 0.0);
  s->push.on = m->drive_bonded;
  if (m->drive.kind != SB_DRIVE_NONE && m->drive.quantity == SB_DRIVE_OF_POSITION) {
    // A platen that starts in the stem's place is already pressed.
    s->push.on = s->push.on || s->piece.value > s->x;
  }
  reload(s);
  // A stem pressed onto a rigid stop rests on it from the start.
  for (size_t i = 0; i < m->stops; i++) {
    const SbDynamicsStop *p = &m->stop[i];
    s->touch[i].on =
        s->touch[i].on || (p->stiffness > 1e300 && s->x == p->position && s->v == 0.0 &&
                           p->side * sb_motion_demand(s, 0.0, s->x, s->d, &s->loads) > 0.0);
  }
  update_held(s);
  for (size_t i = 0; i < m->contacts; i++) {
    s->fresh[i] = false;
    s->since[i] = -m->start_dwell;
    s->slipped[i] = -1.0;
  }
  size_t patches = sb_motion_patches(m);
  s->system = (SbRadauSystem){.n = 2 + patches + m->extras,
                              .powers = SB_DYNAMICS_TERMS,
                              .rates = sb_motion_numerical_rates,
                              .tolerance = m->tolerance > 0.0 ? m->tolerance : 1e-9};
  s->system.floor[0] = 1e-3;
  s->system.floor[1] = 1e-3; // at least; see dynamics_path.c
  for (size_t i = 0; i < patches; i++) {
    s->system.floor[2 + i] = 1e-5;
  }
  for (size_t i = 0; i < m->extras; i++) {
    s->system.floor[2 + patches + i] = m->extra_scale[i];
  }
  s->kinetic_start = 0.5 * m->mass * s->v * s->v;
  s->stored_start = sb_motion_stored_energy(s, 0.0, s->x, s->d);
  s->accumulated_at = -1.0;
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
  long most = s->model->max_events > 0 ? s->model->max_events : 1000000;
  if (!(time >= s->now)) {
    return sb_fail(report, SB_ERROR_RANGE, "the motion cannot go back from %g s to %g s", s->now,
                   time);
  }
  s->asked = time;
  for (;;) {
    if (!s->ready) {
      sb_drive_piece(&s->piece, &s->drive, &s->model->drive, s->t);
      if (s->push.on && sb_motion_finger_gone(s)) {
        switch_drive(s);
      }
      SbStatus status = SB_OK;
      if (s->model->parts != NULL) {
        status = s->model->parts(&s->parts, s->x, s->v, s->model->user, report);
      }
      status = status != SB_OK ? status : sb_motion_find_path(s, report);
      if (status != SB_OK) {
        s->now = s->t;
        return status;
      }
      s->ready = true;
      s->counters.segments++;
      if (s->counters.segments > 4 * most) {
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
    anchor(s, s->t_end);
    s->now = s->t;
    if (!s->loads.constant) {
      // Loads that vary in a region may settle there (a chamber that has emptied).
      load_region(s);
      if (s->loads.constant) {
        reload(s);
      }
    }
    if (event != EVENT_NONE) {
      bool rested = s->held;
      apply(s, event);
      if (rested && !s->held && (event == EVENT_RIGID_UP || event == EVENT_RIGID_DOWN)) {
        SbStatus status = sb_motion_repeat(s, event == EVENT_RIGID_UP ? 1 : -1, report);
        s->now = s->t;
        if (status != SB_OK) {
          return status;
        }
      }
      if (event != EVENT_BREAK && (s->counters.events > most || accumulates(s))) {
        return sb_fail(report, SB_ERROR_NOT_CONVERGED, "%s at %.9g s (%ld events)",
                       s->counters.events > most ? "too many events" : "events accumulate", s->t,
                       s->counters.events);
      }
    }
  }
}

void sb_dynamics_sample(const SbDynamics *s, SbDynamicsSample *out, SbDynamicsEnergy *energy) {
  const SbDynamicsModel *m = s->model;
  double x, v, d[SB_DYNAMICS_CONTACTS], extra[SB_DYNAMICS_EXTRAS], t = s->now;
  sb_motion_state_at(s, t, &x, &v, d, extra);
  if (energy != NULL) {
    sb_motion_energy_at(s, t, x, v, d, energy);
  }
  if (out == NULL) {
    return;
  }
  SbDynamicsLoads loads;
  sb_motion_loads_at(s, x, extra, &loads);
  *out = (SbDynamicsSample){.time = t, .position = x, .speed = v, .region = s->region};
  double rate;
  if (m->drive.kind != SB_DRIVE_NONE) {
    sb_motion_drive_at(s, t, &out->drive_position, &rate);
    if (m->drive.quantity == SB_DRIVE_OF_FORCE) {
      out->drive_position = x;
    }
  }
  out->drive_force = sb_motion_drive_force(s, t, x, v);
  out->loads_force = loads.force;
  out->spring_force = -m->spring_preload - m->spring_stiffness * x;
  double total = s->parts.drive * out->drive_force +
                 s->parts.loads * (out->loads_force + out->spring_force - m->damping * v);
  double holding = 0.0, rigid_stop = 0.0;
  for (size_t i = 0; i < m->contacts; i++) {
    out->contact[i] = s->state[i];
    out->deflection[i] = d[i];
    if (s->state[i] == SB_CONTACT_OFF) {
      continue;
    }
    out->viscous[i] = -m->contact[i].viscous * v;
    out->friction[i] = sb_motion_contact_force(s, i, x, v, d[i], loads.level[i]) + out->viscous[i];
    total += s->parts.contact[i] * out->friction[i];
    if (is_rigid(m, i) && s->state[i] == SB_CONTACT_STUCK) {
      holding += sb_motion_holding_level(s, i, loads.level[i], t);
    }
  }
  for (size_t i = 0; i < m->stops; i++) {
    if (s->touch[i].on && m->stop[i].stiffness > 1e300) {
      rigid_stop = m->stop[i].side;
      continue;
    }
    out->stop_force[i] = sb_motion_stop_force(s, i, t, x, v);
    total -= s->parts.stop * m->stop[i].side * out->stop_force[i];
  }
  // What holds a stem at rest: a rigid stop first, else the rigid contacts by their strength.
  if (s->held && rigid_stop != 0.0) {
    for (size_t i = 0; i < m->stops; i++) {
      if (s->touch[i].on && m->stop[i].stiffness > 1e300) {
        out->stop_force[i] = m->stop[i].side * total;
      }
    }
    total = 0.0;
  } else if (s->held) {
    for (size_t i = 0; i < m->contacts && holding > 0.0; i++) {
      if (is_rigid(m, i) && s->state[i] == SB_CONTACT_STUCK) {
        out->friction[i] = -total * sb_motion_holding_level(s, i, loads.level[i], t) / holding;
      }
    }
    total = 0.0;
  }
  out->acceleration = total / s->parts.mass;
  memcpy(out->extra, extra, sizeof extra);
}

bool sb_dynamics_at_rest(const SbDynamics *s) {
  SbDynamicsSample sample;
  if (!s->ready || !s->linear || s->event != EVENT_BREAK || !sb_drive_done(&s->drive)) {
    return false;
  }
  sb_dynamics_sample(s, &sample, NULL);
  return s->held || fabs(sample.speed) < 1e-12;
}

double sb_dynamics_force_peak(const SbDynamics *s) {
  return s->force_peak;
}

SbDynamicsCounters sb_dynamics_counters(const SbDynamics *s) {
  SbDynamicsCounters c = s->counters;
  c.newton_iterations = s->radau.newton_iterations;
  c.evaluations = s->radau.evaluations;
  return c;
}
