// Constrained bodies stepped in all their coordinates, to hold the reduced form against.
#pragma once

#include "engine/mechanism/bodies_internal.h"

#include <math.h>
#include <string.h>

static SbAssemblyWork assembly_work;

typedef struct {
  double position[SB_BODIES_MAX][3], orientation[SB_BODIES_MAX][4];
  double velocity[SB_BODIES_MAX][3], spin[SB_BODIES_MAX][3];
} BodyRates;

static inline SbStatus rates_of(BodyRates *out, SbAssembly *a, double time,
                                void (*apply)(SbAssembly *, double, void *), void *user,
                                SbReport *report) {
  SbAssemblyForces forces;
  if (apply != NULL) {
    sb_assembly_clear_forces(a);
    apply(a, time, user);
  }
  SbStatus status = sb_bodies_forces(&forces, a, &assembly_work, report);
  if (status != SB_OK) {
    return status;
  }
  for (size_t b = 0; b < a->bodies; b++) {
    const SbBody *body = &a->body[b];
    const double *q = body->orientation, *w = body->spin;
    memcpy(out->position[b], body->velocity, sizeof out->position[b]);
    memcpy(out->velocity[b], forces.acceleration[b], sizeof out->velocity[b]);
    memcpy(out->spin[b], forces.spin_rate[b], sizeof out->spin[b]);
    out->orientation[b][0] = -0.5 * (w[0] * q[1] + w[1] * q[2] + w[2] * q[3]);
    out->orientation[b][1] = 0.5 * (w[0] * q[0] + w[1] * q[3] - w[2] * q[2]);
    out->orientation[b][2] = 0.5 * (w[1] * q[0] + w[2] * q[1] - w[0] * q[3]);
    out->orientation[b][3] = 0.5 * (w[2] * q[0] + w[0] * q[2] - w[1] * q[1]);
  }
  return SB_OK;
}

static inline void move_bodies(SbAssembly *a, const SbAssembly *from, const BodyRates *rates,
                               double h) {
  for (size_t b = 0; b < a->bodies; b++) {
    SbBody *to = &a->body[b];
    const SbBody *was = &from->body[b];
    double size = 0.0;
    for (int k = 0; k < 3; k++) {
      to->position[k] = was->position[k] + h * rates->position[b][k];
      to->velocity[k] = was->velocity[k] + h * rates->velocity[b][k];
      to->spin[k] = was->spin[k] + h * rates->spin[b][k];
    }
    for (int k = 0; k < 4; k++) {
      to->orientation[k] = was->orientation[k] + h * rates->orientation[b][k];
      size += to->orientation[k] * to->orientation[k];
    }
    for (int k = 0; k < 4; k++) {
      to->orientation[k] /= sqrt(size);
    }
  }
}

// Brings positions onto the joints, and takes from the velocities what violates their conditions by
// the smallest change in the sense of the masses.
static inline SbStatus settle(SbAssembly *a, SbReport *report) {
  double length = sb_bodies_extent(a), error;
  SbStatus status = sb_bodies_settle_positions(a, &error, &assembly_work, report);
  if (status != SB_OK) {
    return status;
  }
  SbAssemblyConditions *c = &assembly_work.conditions;
  double top[COLUMNS] = {0}, bottom[ROWS];
  sb_bodies_conditions(c, a, length);
  for (size_t r = 0; r < c->rows; r++) {
    bottom[r] = 0.0;
    for (size_t b = 0; b < a->bodies; b++) {
      for (size_t k = 0; k < 3; k++) {
        bottom[r] -= c->jacobian[r][6 * b + k] * a->body[b].velocity[k] +
                     c->jacobian[r][6 * b + 3 + k] * a->body[b].spin[k] * length;
      }
    }
  }
  status = sb_bodies_solve(a, &assembly_work, 1.0, length, top, bottom, report);
  for (size_t b = 0; b < a->bodies && status == SB_OK; b++) {
    for (size_t k = 0; k < 3; k++) {
      a->body[b].velocity[k] += top[6 * b + k];
      a->body[b].spin[k] += top[6 * b + 3 + k] / length;
    }
  }
  return status;
}

// Advances by h with the classical Runge-Kutta method (order 4), the applied forces held or set
// anew at each stage by `apply` (may be NULL), and brings positions back onto the joints.
static inline SbStatus assembly_step(SbAssembly *a, double time, double h,
                                     void (*apply)(SbAssembly *assembly, double time, void *user),
                                     void *user, SbReport *report) {
  SbAssembly start = *a;
  BodyRates k1, k2, k3, k4, mean;
  SbStatus status = rates_of(&k1, a, time, apply, user, report);
  if (status == SB_OK) {
    move_bodies(a, &start, &k1, 0.5 * h);
    status = rates_of(&k2, a, time + 0.5 * h, apply, user, report);
  }
  if (status == SB_OK) {
    move_bodies(a, &start, &k2, 0.5 * h);
    status = rates_of(&k3, a, time + 0.5 * h, apply, user, report);
  }
  if (status == SB_OK) {
    move_bodies(a, &start, &k3, h);
    status = rates_of(&k4, a, time + h, apply, user, report);
  }
  if (status != SB_OK) {
    *a = start;
    return status;
  }
  const double *p1 = &k1.position[0][0], *p2 = &k2.position[0][0];
  const double *p3 = &k3.position[0][0], *p4 = &k4.position[0][0];
  double *p = &mean.position[0][0];
  for (size_t i = 0; i < sizeof mean / sizeof *p; i++) {
    p[i] = (p1[i] + 2.0 * (p2[i] + p3[i]) + p4[i]) / 6.0;
  }
  move_bodies(a, &start, &mean, h);
  return settle(a, report);
}
