// Forces of each mode of dynamics.h, once as coefficients for the closed form and once as numbers
// for the numerical path, and the quantities whose sign announces an event.
#include "engine/mechanism/dynamics_internal.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

void sb_motion_drive_at(const SbDynamics *s, double t, double *value, double *rate) {
  if (s->piece.curved) {
    sb_drive_sine(&s->model->drive, t, value, rate);
  } else {
    *value = s->piece.value + s->piece.rate * (t - s->piece.at);
    *rate = s->piece.rate;
  }
}

double sb_motion_touch_residual(const SbDynamicsTouch *touch, double stiffness, double damping,
                                double t, double *fading) {
  *fading = damping > 0.0 ? stiffness / damping : 0.0;
  double faded = *fading * (t - touch->since);
  // exp(-746) is 0, but slow to find.
  return touch->residual != 0.0 && faded < 746.0 ? touch->residual * exp(-faded) : 0.0;
}

double sb_motion_drive_force(const SbDynamics *s, double t, double x, double v) {
  const SbDynamicsModel *m = s->model;
  if (m->drive.kind == SB_DRIVE_NONE || !s->push.on) {
    return 0.0;
  }
  double value, rate;
  sb_motion_drive_at(s, t, &value, &rate);
  if (m->drive.quantity == SB_DRIVE_OF_FORCE) {
    return value - m->drive_damping * v;
  }
  return m->drive_stiffness * (value - x) + m->drive_damping * (rate - v);
}

bool sb_motion_speed_dependent(const SbDynamicsModel *m, size_t i) {
  return m->speed_factor != NULL ||
         (m->contact[i].stribeck_speed > 0.0 && m->contact[i].static_ratio != 1.0);
}

double sb_motion_sliding_level(const SbDynamics *s, size_t i, double level, double speed) {
  const SbDynamicsModel *m = s->model;
  const SbDynamicsContact *c = &m->contact[i];
  speed = fmax(speed, 0.0);
  if (m->speed_factor != NULL) {
    return level * m->speed_factor(i, speed, m->user);
  }
  if (c->stribeck_speed > 0.0) {
    double fall = exp(-pow(speed / c->stribeck_speed, c->stribeck_exponent));
    return level * (1.0 + (c->static_ratio - 1.0) * fall);
  }
  return level;
}

double sb_motion_holding_level(const SbDynamics *s, size_t i, double level, double t) {
  const SbDynamicsContact *c = &s->model->contact[i];
  if (s->fresh[i]) {
    return sb_motion_sliding_level(s, i, level, 0.0);
  }
  double ratio = c->static_ratio;
  if (c->dwell_gain > 0.0) {
    ratio += c->dwell_gain * log1p(fmax(0.0, t - s->since[i]) / c->dwell_time);
  }
  return level * ratio;
}

double sb_motion_contact_force(const SbDynamics *s, size_t i, double x, double v, double deflection,
                               double level) {
  const SbDynamicsContact *c = &s->model->contact[i];
  if (s->state[i] == SB_CONTACT_STUCK) {
    return is_rigid(s->model, i) ? 0.0 : -c->stiffness * deflection - c->damping * v;
  }
  if (s->state[i] == SB_CONTACT_SLIP) {
    return -s->sign[i] * sb_motion_sliding_level(s, i, level, s->sign[i] * v);
  }
  return 0.0;
}

void sb_motion_loads_at(const SbDynamics *s, double x, const double *extra,
                        SbDynamicsLoads *loads) {
  if (s->loads.constant || s->model->loads == NULL) {
    *loads = s->loads;
  } else {
    *loads = (SbDynamicsLoads){0};
    s->model->loads(loads, x, s->region, extra, s->model->user);
  }
}

double sb_motion_demand(const SbDynamics *s, double t, double x, const double *deflection,
                        const SbDynamicsLoads *loads) {
  const SbDynamicsModel *m = s->model;
  const SbDynamicsParts *parts = &s->parts;
  double sum = parts->loads * (loads->force - m->spring_preload - m->spring_stiffness * x) +
               parts->drive * sb_motion_drive_force(s, t, x, 0.0);
  for (size_t i = 0; i < m->stops; i++) {
    if (s->touch[i].on && m->stop[i].stiffness < 1e300) {
      sum -= parts->stop * m->stop[i].stiffness * (x - m->stop[i].position);
    }
  }
  for (size_t i = 0; i < m->contacts; i++) {
    if (!is_rigid(m, i)) {
      sum +=
          parts->contact[i] * sb_motion_contact_force(s, i, x, 0.0, deflection[i], loads->level[i]);
    }
  }
  return sum;
}

double sb_motion_stop_force(const SbDynamics *s, size_t i, double t, double x, double v) {
  const SbDynamicsStop *p = &s->model->stop[i];
  if (!s->touch[i].on) {
    return 0.0;
  }
  if (p->stiffness > 1e300) {
    SbDynamicsLoads loads;
    sb_motion_loads_at(s, x, s->extra, &loads);
    return p->side * sb_motion_demand(s, t, x, s->d, &loads);
  }
  return p->stiffness * p->side * (x - p->position) + s->stop_damping[i] * p->side * v;
}

// Adds f0 + f1 tau - k (x - x0) - c v, acting where `lever` is that part's travel per x.
static void act(Linear *l, double lever, double f0, double f1, double k, double c) {
  l->f0 += lever * f0;
  l->f1 += lever * f1;
  l->k += lever * k;
  l->c += lever * c;
}

void sb_motion_linear_forces(const SbDynamics *s, Linear *l) {
  const SbDynamicsModel *m = s->model;
  const SbDynamicsParts *parts = &s->parts;
  *l = (Linear){.size = fabs(s->loads.force) + fabs(m->spring_preload)};
  act(l, parts->loads, s->loads.force - m->spring_preload - m->spring_stiffness * s->x, 0.0,
      m->spring_stiffness, m->damping);
  if (s->push.on && m->drive.kind != SB_DRIVE_NONE) {
    double value, rate;
    sb_motion_drive_at(s, s->t, &value, &rate);
    double k = m->drive_stiffness, c = m->drive_damping;
    if (m->drive.quantity == SB_DRIVE_OF_FORCE) {
      act(l, parts->drive, value, rate, 0.0, c);
      l->size += fabs(value);
    } else {
      act(l, parts->drive, k * (value - s->x) + c * rate, k * rate, k, c);
      l->size += k * (fabs(value) + fabs(rate * s->t) + fabs(s->x));
    }
  }
  for (size_t i = 0; i < m->stops; i++) {
    if (s->touch[i].on && m->stop[i].stiffness < 1e300) {
      double k = m->stop[i].stiffness;
      act(l, parts->stop, -k * (s->x - m->stop[i].position), 0.0, k, s->stop_damping[i]);
      l->size += m->stop[i].stiffness * (fabs(s->x) + fabs(m->stop[i].position));
    }
  }
  for (size_t i = 0; i < m->contacts; i++) {
    const SbDynamicsContact *c = &m->contact[i];
    if (s->state[i] == SB_CONTACT_OFF) {
      continue;
    }
    double lever = parts->contact[i];
    act(l, lever, 0.0, 0.0, 0.0, c->viscous);
    if (s->state[i] == SB_CONTACT_SLIP) {
      l->f0 -= lever * s->sign[i] * s->loads.level[i];
      l->size += s->loads.level[i];
    } else if (!is_rigid(m, i)) {
      act(l, lever, -c->stiffness * s->d[i], 0.0, c->stiffness, c->damping);
      l->size += c->stiffness * fabs(s->d[i]);
    }
  }
}

double sb_motion_deflection_at(const SbDynamics *s, size_t i, double tau, double travel,
                               double *rate) {
  const SbDynamicsContact *c = &s->model->contact[i];
  *rate = 0.0;
  if (is_rigid(s->model, i) || s->state[i] == SB_CONTACT_OFF) {
    return 0.0;
  }
  if (s->state[i] == SB_CONTACT_STUCK) {
    return s->d[i] + travel; // its rate is the stem's
  }
  if (c->damping <= 0.0) {
    return s->d[i];
  }
  double fading = c->stiffness / c->damping;
  double end = s->sign[i] * s->loads.level[i] / c->stiffness;
  double left = (s->d[i] - end) * exp(-fading * tau);
  *rate = -fading * left;
  return end + left;
}

double sb_motion_patch_speed(const SbDynamics *s, size_t i) {
  const SbDynamicsContact *c = &s->model->contact[i];
  if (is_rigid(s->model, i) || c->damping == 0.0) {
    return s->v;
  }
  double level = sb_motion_sliding_level(s, i, s->loads.level[i], s->sign[i] * s->v);
  return s->v - (s->sign[i] * level - c->stiffness * s->d[i]) / c->damping;
}

// ---- event functions of the closed-form path ----

static bool drive_function(const SbDynamics *s, SbEventFunction *g) {
  const SbDynamicsModel *m = s->model;
  if (m->drive.kind == SB_DRIVE_NONE || m->drive_bonded || sb_motion_finger_gone(s)) {
    return false;
  }
  double value, rate, side = s->push.on ? 1.0 : -1.0;
  sb_motion_drive_at(s, s->t, &value, &rate);
  // The drive's value carries the rounding of the time since its piece began.
  *g = (SbEventFunction){.noise = fabs(s->piece.value) + fabs(value) + fabs(rate * s->t)};
  if (m->drive.quantity == SB_DRIVE_OF_FORCE) {
    g->constant = side * value;
    g->rate = side * rate;
    g->of_v = -side * m->drive_damping;
    return true;
  }
  double k = m->drive_stiffness, c = m->drive_damping;
  g->noise += fabs(s->x) + length_noise;
  if (s->push.on) {
    g->noise *= k;
    g->constant = k * (value - s->x) + c * rate;
    g->rate = k * rate;
    g->of_x = -k;
    g->of_v = -c;
    return true;
  }
  // Left behind: met again when the gap closes on what is still deflected.
  g->constant = s->x - value;
  g->rate = -rate;
  g->of_x = 1.0;
  g->relax = sb_motion_touch_residual(&s->push, k, c, s->t, &g->relax_rate);
  return true;
}

static bool stop_function(const SbDynamics *s, size_t i, const Linear *l, SbEventFunction *g) {
  const SbDynamicsStop *p = &s->model->stop[i];
  double side = p->side, gap = side * (p->position - s->x);
  *g = (SbEventFunction){.noise = fabs(p->position) + fabs(s->x) + length_noise};
  if (!s->touch[i].on) {
    // One that was left still deflected comes back to a stem that friction holds meanwhile.
    if (s->held && s->touch[i].residual == 0.0) {
      return false;
    }
    g->constant = gap;
    g->of_x = -side;
    g->relax = sb_motion_touch_residual(&s->touch[i], p->stiffness, s->stop_damping[i], s->t,
                                        &g->relax_rate);
    return true;
  }
  if (p->stiffness > 1e300) {
    *g = (SbEventFunction){.constant = side * l->f0, .rate = side * l->f1, .noise = l->size};
    return true;
  }
  g->noise *= p->stiffness;
  g->constant = -p->stiffness * gap;
  g->of_x = side * p->stiffness;
  g->of_v = side * s->stop_damping[i];
  return true;
}

// Adds the level that contact i can hold from now on.
static void add_holding(const SbDynamics *s, size_t i, SbEventFunction *g) {
  const SbDynamicsContact *c = &s->model->contact[i];
  double level = s->loads.level[i];
  g->constant += s->margin[i];
  if (s->fresh[i]) {
    g->constant += sb_motion_sliding_level(s, i, level, 0.0);
    return;
  }
  g->constant += level * c->static_ratio;
  if (c->dwell_gain > 0.0) {
    // Rigid contacts share one dwell time and rest together, so that gains add.
    g->log_gain += level * c->dwell_gain;
    g->log_time = c->dwell_time;
    g->log_start = fmax(0.0, s->t - s->since[i]);
  }
}

static bool on_rigid_stop(const SbDynamics *s) {
  for (size_t i = 0; i < s->model->stops; i++) {
    if (s->touch[i].on && s->model->stop[i].stiffness > 1e300) {
      return true;
    }
  }
  return false;
}

static bool rigid_function(const SbDynamics *s, int side, const Linear *l, SbEventFunction *g) {
  *g = (SbEventFunction){0};
  bool any = false;
  for (size_t i = 0; i < s->model->contacts; i++) {
    if (!is_rigid(s->model, i) || s->state[i] == SB_CONTACT_OFF) {
      continue;
    }
    any = true;
    if (s->state[i] == SB_CONTACT_SLIP) {
      // Slowing down for ever is coming to rest.
      *g = (SbEventFunction){.constant = s->brisk[i] ? -sb_motion_rest_speed(s->model) : 0.0,
                             .of_v = s->sign[i]};
      return side > 0;
    }
    add_holding(s, i, g);
  }
  g->constant -= side * l->f0;
  g->noise = l->size;
  g->rate = -side * l->f1;
  // On a rigid stop the stop carries first.
  return any && !on_rigid_stop(s);
}

static bool contact_function(const SbDynamics *s, size_t i, int side, SbEventFunction *g) {
  const SbDynamicsContact *c = &s->model->contact[i];
  if (is_rigid(s->model, i) || s->state[i] == SB_CONTACT_OFF) {
    return false;
  }
  *g = (SbEventFunction){0};
  if (s->state[i] == SB_CONTACT_SLIP) {
    g->constant = s->brisk[i] ? -sb_motion_rest_speed(s->model) : 0.0;
    g->of_v = s->sign[i];
    if (c->damping > 0.0) {
      g->relax_rate = c->stiffness / c->damping;
      double level = sb_motion_sliding_level(s, i, s->loads.level[i], s->sign[i] * s->v);
      double end = s->sign[i] * level / c->stiffness;
      g->relax = s->sign[i] * g->relax_rate * (s->d[i] - end);
      g->noise = g->relax_rate * (fabs(s->d[i]) + fabs(end));
    } else if (s->held) {
      return false;
    }
    return side > 0;
  }
  add_holding(s, i, g);
  g->constant -= side * c->stiffness * s->d[i];
  g->noise = c->stiffness * fabs(s->d[i]);
  g->of_x = -side * c->stiffness;
  g->of_v = -side * c->damping;
  return true;
}

bool sb_motion_event_function(const SbDynamics *s, int event, const Linear *l, SbEventFunction *g) {
  const SbDynamicsModel *m = s->model;
  switch (event) {
  case EVENT_EDGE_UP:
    if (s->held || s->region >= m->edges) {
      return false;
    }
    *g = (SbEventFunction){.constant = m->edge[s->region] - s->x, .of_x = -1.0};
    return true;
  case EVENT_EDGE_DOWN:
    if (s->held || s->region == 0) {
      return false;
    }
    *g = (SbEventFunction){.constant = s->x - m->edge[s->region - 1], .of_x = 1.0};
    return true;
  case EVENT_DRIVE:
    return drive_function(s, g);
  case EVENT_RIGID_UP:
    return rigid_function(s, 1, l, g);
  case EVENT_RIGID_DOWN:
    return rigid_function(s, -1, l, g);
  default:
    break;
  }
  if (event >= EVENT_CONTACT_DOWN) {
    size_t i = (size_t)(event - EVENT_CONTACT_DOWN);
    return i < m->contacts && contact_function(s, i, -1, g);
  }
  if (event >= EVENT_CONTACT_UP) {
    size_t i = (size_t)(event - EVENT_CONTACT_UP);
    return i < m->contacts && contact_function(s, i, 1, g);
  }
  if (event >= EVENT_STOP) {
    size_t i = (size_t)(event - EVENT_STOP);
    return i < m->stops && stop_function(s, i, l, g);
  }
  return false;
}

// ---- the numerical path ----

void sb_motion_anchor_at(SbDynamics *at, Linear *l, const SbDynamics *s, double t,
                         const double *z) {
  // All but the steps, which are large and not asked for.
  memcpy(at, s, offsetof(SbDynamics, step));
  at->t = t;
  at->x = z[0];
  at->v = z[1];
  size_t patches = sb_motion_patches(s->model);
  memcpy(at->d, z + 2, patches * sizeof *z);
  sb_motion_loads_at(s, z[0], z + 2 + patches, &at->loads);
  sb_motion_linear_forces(at, l);
  if (at->held) {
    l->f0 = sb_motion_demand(at, at->t, at->x, at->d, &at->loads);
  }
}

bool sb_motion_event_value(const SbDynamics *at, int event, const Linear *l, double *value,
                           double *noise) {
  SbEventFunction g;
  if (!sb_motion_event_function(at, event, l, &g)) {
    return false;
  }
  *value = g.constant + g.of_v * at->v + g.relax;
  if (g.log_gain > 0.0) {
    *value += g.log_gain * log1p(g.log_start / g.log_time);
  }
  double size = fabs(g.constant) + g.noise + fabs(g.relax);
  double speed = 10.0 * at->system.tolerance * at->system.floor[1];
  *noise = 1e-12 * size + fabs(g.of_v) * speed;
  // What slows down to the speed of rest is at rest, whatever the tolerance leaves of its speed.
  for (int i = 0; i < (int)at->model->contacts; i++) {
    bool own = event == (is_rigid(at->model, (size_t)i) ? EVENT_RIGID_UP : EVENT_CONTACT_UP + i);
    if (own && at->brisk[i]) {
      *noise = fmin(*noise, 0.1 * sb_motion_rest_speed(at->model));
    }
  }
  return true;
}

void sb_motion_numerical_rates(double *dz, double *power, double t, const double *z, void *user) {
  const SbDynamics *s = user;
  const SbDynamicsModel *m = s->model;
  double x = z[0], v = s->held ? 0.0 : z[1];
  size_t patches = sb_motion_patches(m);
  const double *extra = z + 2 + patches;
  SbDynamicsLoads loads;
  sb_motion_loads_at(s, x, extra, &loads);
  SbDynamicsEnergy e = {0};
  const SbDynamicsParts *parts = &s->parts;
  double force =
      parts->loads * (loads.force - m->spring_preload - m->spring_stiffness * x - m->damping * v);
  e.pressure = loads.force * v;
  e.viscous = m->damping * v * v;
  // Drive.
  double push = sb_motion_drive_force(s, t, x, v), value, rate;
  force += parts->drive * push;
  sb_motion_drive_at(s, t, &value, &rate);
  if (m->drive.quantity == SB_DRIVE_OF_FORCE) {
    e.drive = push * v;
  } else if (s->push.on) {
    e.drive = push * rate;
    e.machine = m->drive_damping * (rate - v) * (rate - v);
  }
  // Stops.
  for (size_t i = 0; i < m->stops; i++) {
    if (s->touch[i].on && m->stop[i].stiffness < 1e300) {
      force -= parts->stop * m->stop[i].side * sb_motion_stop_force(s, i, t, x, v);
      e.stop += s->stop_damping[i] * v * v;
    }
  }
  // Contacts: what the stem feels, and how the patch's spring follows.
  for (size_t i = 0; i < m->contacts; i++) {
    const SbDynamicsContact *c = &m->contact[i];
    double deflection = patches > 0 ? z[2 + i] : 0.0;
    double on_stem = sb_motion_contact_force(s, i, x, v, deflection, loads.level[i]);
    if (patches > 0) {
      dz[2 + i] = 0.0;
    }
    if (s->state[i] == SB_CONTACT_OFF) {
      continue;
    }
    e.viscous += c->viscous * v * v;
    force += parts->contact[i] * (on_stem - c->viscous * v);
    if (is_rigid(m, i)) {
      e.friction -= on_stem * v;
    } else if (s->state[i] == SB_CONTACT_STUCK) {
      dz[2 + i] = v;
      e.seal += c->damping * v * v;
    } else {
      if (c->damping > 0.0) {
        dz[2 + i] = (-on_stem - c->stiffness * z[2 + i]) / c->damping;
      }
      e.seal += c->damping * dz[2 + i] * dz[2 + i];
      e.friction -= on_stem * (v - dz[2 + i]);
    }
  }
  memcpy(power, e.term, sizeof e.term);
  dz[0] = v;
  dz[1] = s->held ? 0.0 : force / parts->mass;
  if (m->extras > 0) {
    double *rates = dz + 2 + patches;
    for (size_t i = 0; i < m->extras; i++) {
      rates[i] = 0.0;
    }
    if (!s->loads.constant && m->extra_rates != NULL) {
      m->extra_rates(rates, x, v, s->region, extra, m->user);
    }
  }
}
