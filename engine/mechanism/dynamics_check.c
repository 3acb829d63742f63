// What dynamics.h refuses, by name.
#include "engine/mechanism/dynamics_internal.h"

#include <math.h>

static SbStatus check_contact(const SbDynamicsModel *m, size_t i, SbReport *report) {
  const SbDynamicsContact *c = &m->contact[i];
  if (!(c->static_ratio >= 1.0) || !isfinite(c->static_ratio)) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "friction.static_ratio",
                             "static over sliding friction must be at least 1, not %g",
                             c->static_ratio);
  }
  if (!(c->dwell_gain >= 0.0) || (c->dwell_gain > 0.0 && !(c->dwell_time > 0.0))) {
    return sb_fail(report, SB_ERROR_RANGE, "contact %zu: dwell strengthening needs a time above 0",
                   i);
  }
  if (!(c->stribeck_speed >= 0.0) || (c->stribeck_speed > 0.0 && !(c->stribeck_exponent > 0.0)) ||
      !(c->viscous >= 0.0) || !isfinite(c->viscous)) {
    return sb_fail(report, SB_ERROR_RANGE, "contact %zu: Stribeck or viscous law out of range", i);
  }
  if (!(c->stiffness > 0.0) || !(c->damping >= 0.0) || !isfinite(c->damping)) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "contact %zu: tangential stiffness must be above 0, damping not below", i);
  }
  if (!is_rigid(m, i) && c->damping == 0.0 && sb_motion_speed_dependent(m, i)) {
    return sb_fail(report, SB_ERROR_INPUT,
                   "contact %zu: friction that depends on speed through an elastic seal needs "
                   "tangential damping above 0",
                   i);
  }
  for (size_t k = 0; k < i; k++) {
    if (is_rigid(m, i) && is_rigid(m, k) && c->dwell_gain > 0.0 && m->contact[k].dwell_gain > 0.0 &&
        m->contact[k].dwell_time != c->dwell_time) {
      return sb_fail(report, SB_ERROR_INPUT, "rigid contacts must share one dwell time");
    }
  }
  return sb_succeed(report);
}

static SbStatus check_stop(const SbDynamicsStop *p, size_t i, SbReport *report) {
  bool rigid = p->stiffness > 1e300;
  if (!isfinite(p->position) || (p->side != 1 && p->side != -1)) {
    return sb_fail(report, SB_ERROR_INPUT, "stop %zu needs a position and a side of +1 or -1", i);
  }
  if (!(p->stiffness > 0.0) || !(p->restitution >= (rigid ? 0.0 : 0.01)) ||
      !(p->restitution <= 1.0)) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "stop %zu: stiffness must be above 0 and restitution between %g and 1", i,
                   rigid ? 0.0 : 0.01);
  }
  return sb_succeed(report);
}

SbStatus sb_dynamics_check(const SbDynamicsModel *m, SbReport *report) {
  if (!(m->mass > 0.0) || !isfinite(m->mass)) {
    return sb_fail(report, SB_ERROR_RANGE, "the moving mass must be above 0, not %g kg", m->mass);
  }
  if (!(m->damping >= 0.0) || !(m->spring_stiffness >= 0.0) || !isfinite(m->damping) ||
      !isfinite(m->spring_stiffness) || !isfinite(m->spring_preload)) {
    return sb_fail(report, SB_ERROR_RANGE, "damping and return spring must not be negative");
  }
  if (m->contacts > SB_DYNAMICS_CONTACTS || m->stops > SB_DYNAMICS_STOPS ||
      m->edges > SB_DYNAMICS_EDGES || m->extras > SB_DYNAMICS_EXTRAS) {
    return sb_fail(report, SB_ERROR_RANGE, "too many contacts, stops, edges or extra states");
  }
  for (size_t i = 0; i < m->contacts; i++) {
    if (check_contact(m, i, report) != SB_OK) {
      return SB_ERROR_RANGE;
    }
  }
  for (size_t i = 0; i < m->stops; i++) {
    if (check_stop(&m->stop[i], i, report) != SB_OK) {
      return SB_ERROR_RANGE;
    }
  }
  for (size_t i = 0; i < m->edges; i++) {
    if (!isfinite(m->edge[i]) || (i > 0 && !(m->edge[i] > m->edge[i - 1]))) {
      return sb_fail(report, SB_ERROR_INPUT, "edges must increase (edge %zu)", i);
    }
  }
  for (size_t i = 0; i < m->extras; i++) {
    if (!(m->extra_scale[i] > 0.0) || !isfinite(m->extra_start[i])) {
      return sb_fail(report, SB_ERROR_RANGE, "extra state %zu needs a start and a scale above 0",
                     i);
    }
  }
  if (!isfinite(m->start_position) || !isfinite(m->start_speed) || !(m->start_dwell >= 0.0)) {
    return sb_fail(report, SB_ERROR_RANGE, "start position, speed or dwell out of range");
  }
  if (!(m->tolerance >= 0.0) || m->tolerance > 1e-5) {
    return sb_fail(report, SB_ERROR_RANGE, "tolerance must lie between 0 and 1e-5");
  }
  if (m->drive.kind != SB_DRIVE_NONE) {
    bool force = m->drive.quantity == SB_DRIVE_OF_FORCE;
    if (!(m->drive_damping >= 0.0) || !isfinite(m->drive_damping) ||
        (!force && !(m->drive_stiffness > 0.0 && m->drive_stiffness < 1e300))) {
      return sb_fail_parameter(report, SB_ERROR_RANGE, "drive.stiffness",
                               "the drive needs a finite stiffness above 0, not %g N/m",
                               m->drive_stiffness);
    }
  }
  return sb_drive_check(&m->drive, report);
}
