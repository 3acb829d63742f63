// State, energies and largest force of the motion in a segment of dynamics.h, and what is read of
// it. Every term of energy is integrated separately, from the motion and the forces; kinetic and
// stored energy are computed from the state. Their balance is a check.
#include "engine/mechanism/dynamics_internal.h"
#include "engine/numeric/root.h"

#include <float.h>
#include <math.h>

// The closed-form motion from a point over tau, which ends in z.
static void stretch_to(Stretch *over, const SbDynamics *s, const Point *p, double tau,
                       const SbDynamicsState *z) {
  const Force *platen = &p->wall[SB_DYNAMICS_PLATEN];
  SbOscillatorState end = sb_oscillator_at(&s->motion, tau);
  *over = (Stretch){.time = tau,
                    .travel = end.travel,
                    .square = sb_oscillator_square(&s->motion, tau),
                    .ramp = tau * end.travel - end.area};
  if (platen->k > 0.0) {
    // If only the platen's spring acts on the stem, its motion is that of the platen plus the
    // oscillation, to the last digit: a stiff machine's force follows from these small differences.
    const double rate = platen->f1 / platen->k;
    const double pull = s->held ? 0.0 : (p->sum.f1 - p->sum.k * rate) / s->mass;
    over->lag = sb_oscillator_lag(&s->motion, tau, rate, pull);
  }
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
  double found[SB_RADAU_MAX];
  tau -= step == s->step ? 0.0 : s->step[0].h;
  sb_radau_dense(step, &s->system, step->h > 0.0 ? fmin(1.0, tau / step->h) : 1.0, found, NULL);
  for (size_t i = 0; i < s->system.n; i++) {
    z->z[s->unknown[i]] = found[i];
  }
}

void sb_motion_energy_at(const SbDynamics *s, double tau, const SbDynamicsState *z,
                         SbDynamicsEnergy *e) {
  *e = s->energy;
  if (tau > 0.0 && s->linear) {
    Point p;
    Stretch over;
    sb_motion_point(&p, s, s->t, &s->at);
    stretch_to(&over, s, &p, tau, z);
    sb_motion_add_energy(e->term, s, &p, &over);
  } else if (tau > 0.0) {
    double from = 0.0, q[SB_RADAU_POWERS];
    for (const SbRadauStep *step = s->step; step < s->step + 2; step++) {
      if (step->h > 0.0 && tau > from) {
        sb_radau_dense(step, &s->system, fmin(1.0, (tau - from) / step->h), NULL, q);
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
  e->largest_stored = fmax(e->largest_stored, fabs(e->stored));
  const double scale = e->largest > 0.0 ? e->largest : e->largest_stored;
  e->closure = scale > 0.0 ? fabs(rest) / scale : 0.0;
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
                 sb_radau_pair(there.step, &error, local, &s->system, s->t, s->step[0].z0, at,
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
    double middle = fmin(s->step[0].h, lasts);
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
  // A growing swing does so by a factor of e at most.
  swing *= o->damping < 0.0 ? 6.0 : 2.0;
  double trend = fmax(0.0, f->f1 - f->k * o->trend1) * lasts;
  if (!(rising.constant + rising.of_v * p.v > 0.0) || first + swing + trend < peak) {
    return peak;
  }
  bool found;
  double at = sb_event_first(&rising, o, lasts, &found);
  return found ? fmax(peak, push_at(s, fmin(at, lasts))) : peak;
}

void sb_dynamics_sample(const SbDynamics *s, SbDynamicsSample *out, SbDynamicsEnergy *energy) {
  const SbDynamicsModel *m = s->model;
  SbDynamicsState z;
  sb_motion_state_at(s, s->now - s->t, &z);
  if (energy != NULL) {
    sb_motion_energy_at(s, s->now - s->t, &z, energy);
  }
  if (out == NULL) {
    return;
  }
  Point p;
  double holding = 0.0, total = 0.0;
  sb_motion_point(&p, s, s->now, &z);
  *out = (SbDynamicsSample){.time = s->now,
                            .position = z.x,
                            .speed = z.v,
                            .acceleration = s->held ? 0.0 : force_of(&p.sum, &p) / s->mass,
                            .drive_force = force_of(&p.wall[SB_DYNAMICS_PLATEN], &p),
                            .loads_force = p.loads.force,
                            .spring_force = -m->spring_preload - m->spring_stiffness * z.x,
                            .extra = z.extra,
                            .region = s->region};
  if (m->drive.kind != SB_DRIVE_NONE) {
    out->drive_position = sb_motion_by_force(m) ? z.x : sb_motion_drive_at(s, s->now).value;
  }
  // Reactions on a stem at rest: a rigid stop first, else the rigid contacts by their limits.
  total = s->held ? p.sum.f0 : 0.0;
  for (size_t i = 0; i < m->stops; i++) {
    bool holds = s->wall[i].on && rigid(s->wall[i].stiffness);
    out->stop_force[i] = s->wall[i].push * (holds ? -total : force_of(&p.wall[i], &p));
    total = holds ? 0.0 : total;
  }
  for (size_t i = 0; i < m->contacts; i++) {
    out->contact[i] = s->state[i];
    out->deflection[i] = z.d[i];
    out->friction[i] = force_of(&p.contact[i], &p) + force_of(&p.beside[i], &p);
    bool holds = is_rigid(m, i) && s->state[i] == SB_CONTACT_STUCK;
    holding += holds ? sb_motion_holding(s, &p, i, total > 0.0 ? 1 : -1) : 0.0;
  }
  for (size_t i = 0; i < m->contacts && total != 0.0 && holding > 0.0; i++) {
    if (is_rigid(m, i) && s->state[i] == SB_CONTACT_STUCK) {
      out->friction[i] = -total * sb_motion_holding(s, &p, i, total > 0.0 ? 1 : -1) / holding;
    }
  }
}

double sb_dynamics_force_peak(const SbDynamics *s) {
  SbDynamics until_now = *s;
  until_now.t_end = s->now;
  return sb_motion_force_peak(&until_now, s->force_peak);
}

bool sb_dynamics_at_rest(const SbDynamics *s) {
  SbDynamicsState z;
  if (!s->ready || !s->linear || s->event != EVENT_BREAK || isfinite(s->piece.until)) {
    return false;
  }
  sb_motion_state_at(s, s->now - s->t, &z);
  return s->held || fabs(z.v) < 1e-12;
}
