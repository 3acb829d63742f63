// State and energies of dynamics.h inside a segment. Every term is integrated by itself, from the
// motion and the forces; kinetic and stored energy are read from the state. Their balance is a
// check.
#include "engine/mechanism/dynamics_internal.h"

#include <math.h>
#include <string.h>

double sb_motion_stored_energy(const SbDynamics *s, double t, const SbDynamicsState *z) {
  const SbDynamicsModel *m = s->model;
  double sum = m->spring_preload * z->x + 0.5 * m->spring_stiffness * z->x * z->x;
  for (size_t i = 0; i < m->contacts; i++) {
    sum += is_rigid(m, i) ? 0.0 : 0.5 * m->contact[i].stiffness * z->d[i] * z->d[i];
  }
  for (size_t w = 0; w < SB_DYNAMICS_WALLS; w++) {
    double e = sb_motion_deflection(s, w, t, z->x);
    sum += e != 0.0 ? 0.5 * s->wall[w].stiffness * e * e : 0.0;
  }
  return sum;
}

double sb_motion_relaxed(const SbDynamics *s, size_t w, double t0, double t1) {
  if (s->wall[w].on || s->wall[w].residual == 0.0) {
    return 0.0;
  }
  double a = sb_motion_deflection(s, w, t0, 0.0), b = sb_motion_deflection(s, w, t1, 0.0);
  return 0.5 * s->wall[w].stiffness * (a - b) * (a + b);
}

// In the order of SbDynamicsEnergy.
enum { DRIVE, PRESSURE, FRICTION, VISCOUS, SEAL, STOP, MACHINE };

void sb_motion_add_energy(double *term, const SbDynamics *s, const Point *p, const Stretch *over) {
  const SbDynamicsModel *m = s->model;
  term[PRESSURE] += p->loads.force * over->travel;
  term[VISCOUS] += m->damping * over->square;
  for (size_t w = 0; w < SB_DYNAMICS_PLATEN; w++) {
    term[STOP] += p->wall[w].c * over->square;
  }
  const Force *f = &p->wall[SB_DYNAMICS_PLATEN];
  if (s->wall[SB_DYNAMICS_PLATEN].on && sb_motion_by_force(m)) {
    term[DRIVE] += f->f0 * over->travel + f->f1 * over->ramp - f->c * over->square;
  } else if (s->wall[SB_DYNAMICS_PLATEN].on) {
    // The platen moves at its own speed against the integral of the force.
    double rate = f->f1 / f->k;
    term[DRIVE] +=
        rate * (f->f0 * over->time + f->f1 * over->late - f->k * over->area - f->c * over->travel);
    term[MACHINE] += f->c * (rate * (rate * over->time - 2.0 * over->travel) + over->square);
  }
  for (size_t i = 0; i < m->contacts; i++) {
    if (s->state[i] == SB_CONTACT_OFF) {
      continue;
    }
    term[VISCOUS] += m->contact[i].viscous * over->square;
    term[SEAL] += m->contact[i].damping * over->fade[i];
    if (s->state[i] == SB_CONTACT_SLIP) {
      term[FRICTION] -= p->contact[i].f0 * (over->travel - over->shift[i]);
    }
  }
}

// The closed-form motion over tau, which ends in z.
static void stretch_to(Stretch *over, const SbDynamics *s, double tau, const SbDynamicsState *z) {
  SbOscillatorState end = sb_oscillator_at(&s->motion, tau);
  *over = (Stretch){.time = tau,
                    .late = 0.5 * tau * tau,
                    .travel = end.travel,
                    .area = end.area,
                    .square = sb_oscillator_square(&s->motion, tau)};
  over->ramp = tau * over->travel - over->area;
  for (size_t i = 0; i < s->model->contacts; i++) {
    const SbDynamicsContact *c = &s->model->contact[i];
    double rate0, rate1;
    over->shift[i] = z->d[i] - s->at.d[i];
    if (is_rigid(s->model, i) || s->state[i] == SB_CONTACT_STUCK) {
      over->fade[i] = is_rigid(s->model, i) ? 0.0 : over->square;
      continue;
    }
    // d' of a patch that relaxes falls as exp(-stiffness/damping tau).
    (void)sb_motion_deflection_at(s, i, 0.0, 0.0, &rate0);
    (void)sb_motion_deflection_at(s, i, tau, over->travel, &rate1);
    over->fade[i] = 0.5 * c->damping / c->stiffness * (rate0 - rate1) * (rate0 + rate1);
  }
}

void sb_motion_state_at(const SbDynamics *s, double tau, SbDynamicsState *z) {
  *z = s->at;
  if (tau <= 0.0) {
    return;
  }
  if (s->linear) {
    double rate;
    SbOscillatorState at = sb_oscillator_at(&s->motion, tau);
    z->x = s->at.x + at.travel;
    z->v = at.v;
    for (size_t i = 0; i < s->model->contacts; i++) {
      z->d[i] = sb_motion_deflection_at(s, i, tau, at.travel, &rate);
    }
    return;
  }
  const SbRadauStep *step = tau <= s->step[0].h ? &s->step[0] : &s->step[1];
  tau -= step == s->step ? 0.0 : s->step[0].h;
  sb_radau_dense(step, &s->system, step->h > 0.0 ? tau / step->h : 1.0, z->z, NULL);
  if (s->held) {
    z->x = s->at.x;
    z->v = 0.0;
  }
}

void sb_motion_energy_at(const SbDynamics *s, double tau, const SbDynamicsState *z,
                         SbDynamicsEnergy *e) {
  *e = s->energy;
  if (tau > 0.0 && s->linear) {
    Point p;
    Stretch over;
    sb_motion_point(&p, s, s->t, &s->at);
    stretch_to(&over, s, tau, z);
    sb_motion_add_energy(e->term, s, &p, &over);
  } else if (tau > 0.0) {
    double from = 0.0, q[SB_RADAU_POWERS];
    for (const SbRadauStep *step = s->step; step < s->step + 2; step++) {
      if (step->h > 0.0 && tau > from) {
        double theta = (tau - from) / step->h;
        sb_radau_dense(step, &s->system, step == s->step ? fmin(1.0, theta) : theta, NULL, q);
        for (int k = 0; k < SB_DYNAMICS_TERMS; k++) {
          e->term[k] += q[k];
        }
      }
      from += step->h;
    }
  }
  for (size_t w = 0; w < SB_DYNAMICS_WALLS; w++) {
    *(w == SB_DYNAMICS_PLATEN ? &e->machine : &e->stop) +=
        sb_motion_relaxed(s, w, s->t, s->t + tau);
  }
  e->kinetic = 0.5 * s->mass * z->v * z->v - s->kinetic_start;
  e->stored = sb_motion_stored_energy(s, s->t + tau, z) - s->stored_start;
  double external = e->drive + e->pressure;
  e->largest = fmax(e->largest, fabs(external));
  double rest =
      external - e->friction - e->viscous - e->seal - e->stop - e->machine - e->kinetic - e->stored;
  e->closure = e->largest > 0.0 ? fabs(rest) / e->largest : 0.0;
}
