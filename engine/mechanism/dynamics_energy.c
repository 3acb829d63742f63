// State and energies of dynamics.h inside a segment. Every term is integrated by itself, from the
// motion and the forces; kinetic and stored energy are read from the state. Their balance is a
// check.
#include "engine/mechanism/dynamics_internal.h"

#include <math.h>
#include <string.h>

double sb_motion_stored_energy(const SbDynamics *s, double t, double x, const double *d) {
  const SbDynamicsModel *m = s->model;
  double sum = m->spring_preload * x + 0.5 * m->spring_stiffness * x * x, fading;
  for (size_t i = 0; i < m->contacts; i++) {
    if (!is_rigid(m, i)) {
      sum += 0.5 * m->contact[i].stiffness * d[i] * d[i];
    }
  }
  for (size_t i = 0; i < m->stops; i++) {
    const SbDynamicsStop *p = &m->stop[i];
    if (p->stiffness < 1e300) {
      double e = s->touch[i].on ? x - p->position
                                : sb_motion_touch_residual(&s->touch[i], p->stiffness,
                                                           s->stop_damping[i], t, &fading);
      sum += 0.5 * p->stiffness * e * e;
    }
  }
  if (m->drive.kind != SB_DRIVE_NONE && m->drive.quantity == SB_DRIVE_OF_POSITION) {
    double y, rate, e;
    if (s->push.on) {
      sb_motion_drive_at(s, t, &y, &rate);
      e = y - x;
    } else {
      e = sb_motion_touch_residual(&s->push, m->drive_stiffness, m->drive_damping, t, &fading);
    }
    sum += 0.5 * m->drive_stiffness * e * e;
  }
  return sum;
}

static double residual_loss(const SbDynamicsTouch *touch, double k, double c, double t0,
                            double t1) {
  double fading;
  if (touch->on || touch->residual == 0.0) {
    return 0.0;
  }
  double a = sb_motion_touch_residual(touch, k, c, t0, &fading),
         b = sb_motion_touch_residual(touch, k, c, t1, &fading);
  return 0.5 * k * (a - b) * (a + b);
}

double sb_motion_stops_relax(const SbDynamics *s, double t0, double t1) {
  double sum = 0.0;
  for (size_t i = 0; i < s->model->stops; i++) {
    sum += residual_loss(&s->touch[i], s->model->stop[i].stiffness, s->stop_damping[i], t0, t1);
  }
  return sum;
}

// Adds what the closed-form motion does over (0, tau).
static void closed_energy(const SbDynamics *s, double tau, double x, double v,
                          SbDynamicsEnergy *e) {
  const SbDynamicsModel *m = s->model;
  double travel = 0.0;
  sb_oscillator_at(&s->motion, tau, &travel, NULL, NULL);
  double v2 = s->held ? 0.0 : sb_oscillator_integral_v2(&s->motion, tau);
  double area = sb_oscillator_integral_x(&s->motion, tau);
  e->pressure += s->loads.force * travel;
  e->viscous += m->damping * v2;
  if (s->push.on && m->drive.kind != SB_DRIVE_NONE) {
    double y, rate, c = m->drive_damping;
    sb_motion_drive_at(s, s->t, &y, &rate);
    if (m->drive.quantity == SB_DRIVE_OF_FORCE) {
      e->drive += y * travel + rate * (tau * x - area) - c * v2;
    } else {
      double impulse =
          m->drive_stiffness * (tau * (y + 0.5 * rate * tau) - area) + c * (rate * tau - travel);
      e->drive += rate * impulse;
      e->machine += c * (rate * rate * tau - 2.0 * rate * travel + v2);
    }
  }
  for (size_t i = 0; i < m->stops; i++) {
    if (s->touch[i].on) {
      e->stop += s->stop_damping[i] * v2;
    }
  }
  for (size_t i = 0; i < m->contacts; i++) {
    const SbDynamicsContact *c = &m->contact[i];
    if (s->state[i] == SB_CONTACT_OFF) {
      continue;
    }
    e->viscous += c->viscous * v2;
    if (s->state[i] == SB_CONTACT_STUCK) {
      e->seal += is_rigid(m, i) ? 0.0 : c->damping * v2;
      continue;
    }
    double rate0, rate1, level = s->sign[i] * s->loads.level[i];
    double d0 = sb_motion_deflection_at(s, i, 0.0, 0.0, &rate0);
    double d1 = sb_motion_deflection_at(s, i, tau, travel, &rate1);
    e->friction += level * (travel - (d1 - d0));
    if (c->damping > 0.0 && !is_rigid(m, i)) {
      // The damper of a relaxing patch: integral of c d'^2 with d' = rate0 exp(-fading tau).
      double fading = c->stiffness / c->damping;
      e->seal += 0.5 * c->damping / fading * (rate0 - rate1) * (rate0 + rate1);
    }
  }
}

void sb_motion_state_at(const SbDynamics *s, double t, double *x, double *v, double *d,
                        double *extra) {
  const SbDynamicsModel *m = s->model;
  if (t <= s->t) {
    *x = s->x;
    *v = s->v;
    memcpy(d, s->d, sizeof s->d);
    memcpy(extra, s->extra, sizeof s->extra);
    return;
  }
  memcpy(extra, s->extra, sizeof s->extra);
  memcpy(d, s->d, sizeof s->d);
  if (s->linear) {
    double tau = t - s->t, rate, travel;
    sb_oscillator_at(&s->motion, tau, &travel, v, NULL);
    *x = s->x + travel;
    for (size_t i = 0; i < m->contacts; i++) {
      d[i] = sb_motion_deflection_at(s, i, tau, travel, &rate);
    }
    return;
  }
  double z[SB_RADAU_MAX];
  const SbRadauStep *step = t <= s->middle ? &s->step[0] : &s->step[1];
  sb_radau_dense(step, &s->system, step->h > 0.0 ? fmin(1.0, (t - step->t) / step->h) : 1.0, z,
                 NULL);
  *x = s->held ? s->x : z[0];
  *v = s->held ? 0.0 : z[1];
  size_t patches = sb_motion_patches(m);
  memcpy(d, z + 2, patches * sizeof *d);
  memcpy(extra, z + 2 + patches, m->extras * sizeof *extra);
}

void sb_motion_energy_at(const SbDynamics *s, double t, double x, double v, const double *d,
                         SbDynamicsEnergy *e) {
  const SbDynamicsModel *m = s->model;
  *e = s->energy;
  if (t > s->t && s->linear) {
    closed_energy(s, t - s->t, x, v, e);
  } else if (t > s->t) {
    for (int i = 0; i < 2; i++) {
      const SbRadauStep *step = &s->step[i];
      double q[SB_RADAU_POWERS];
      if (step->h <= 0.0 || t <= step->t) {
        continue;
      }
      sb_radau_dense(step, &s->system, fmin(1.0, (t - step->t) / step->h), NULL, q);
      for (int k = 0; k < SB_DYNAMICS_TERMS; k++) {
        e->term[k] += q[k];
      }
    }
  }
  e->stop += sb_motion_stops_relax(s, s->t, t);
  e->machine += residual_loss(&s->push, m->drive_stiffness, m->drive_damping, s->t, t);
  e->kinetic = 0.5 * s->parts.mass * v * v - s->kinetic_start;
  e->stored = sb_motion_stored_energy(s, t, x, d) - s->stored_start;
  double external = e->drive + e->pressure;
  e->largest = fmax(e->largest, fabs(external));
  double rest =
      external - e->friction - e->viscous - e->seal - e->stop - e->machine - e->kinetic - e->stored;
  e->closure = e->largest > 0.0 ? fabs(rest) / e->largest : 0.0;
}
