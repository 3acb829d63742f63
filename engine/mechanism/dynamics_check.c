// What dynamics.h refuses, by name.
#include "engine/base/check.h"
#include "engine/mechanism/dynamics_internal.h"
#include "engine/mechanism/inputs.h"

#include <math.h>

static SbStatus check_contact(const SbDynamicsModel *m, size_t i, SbReport *report) {
  const SbDynamicsContact *c = &m->contact[i];
  SbStatus status = SB_CHECK(
      report,
      {SB_MECHANISM_IN_STATIC_RATIO, "static over sliding friction", c->static_ratio, 1.0, DBL_MAX},
      {0, "a contact's gain by rest", c->dwell_gain, 0.0, INFINITY},
      {0, "its time of rest [s]", c->dwell_time, c->dwell_gain > 0.0 ? DBL_MIN : -INFINITY,
       INFINITY},
      {0, "its Stribeck speed [m/s]", c->stribeck_speed, 0.0, INFINITY},
      {0, "its Stribeck exponent", c->stribeck_exponent,
       c->stribeck_speed > 0.0 ? DBL_MIN : -INFINITY, INFINITY},
      {0, "its tangential stiffness [N/m]", c->stiffness, DBL_MIN, INFINITY},
      {0, "its tangential damping [N s/m]", c->damping, SB_NOT_NEGATIVE});
  if (status != SB_OK) {
    return status;
  }
  if (!is_rigid(m, i) && c->damping == 0.0 && sb_motion_speed_dependent(m, i)) {
    return sb_fail(report, SB_ERROR_INPUT,
                   "contact %zu: friction that depends on speed through an elastic seal needs "
                   "tangential damping above 0",
                   i);
  }
  return sb_succeed(report);
}

static SbStatus check_stop(const SbDynamicsStop *p, size_t i, SbReport *report) {
  if (!isfinite(p->position) || (p->side != 1 && p->side != -1)) {
    return sb_fail(report, SB_ERROR_INPUT, "stop %zu needs a position and a side of +1 or -1", i);
  }
  return SB_CHECK(report, {0, "a stop's stiffness [N/m]", p->stiffness, DBL_MIN, INFINITY},
                  {0, "its restitution", p->restitution, rigid(p->stiffness) ? 0.0 : 0.01, 1.0});
}

SbStatus sb_dynamics_check(const SbDynamicsModel *m, SbReport *report) {
  bool driven = m->drive.kind != SB_DRIVE_NONE;
  bool sprung = driven && m->drive.quantity == SB_DRIVE_OF_POSITION;
  SbStatus status =
      SB_CHECK(report, {0, "the moving mass [kg]", m->mass, SB_ABOVE_ZERO},
               {0, "the stem's damping [N s/m]", m->damping, SB_NOT_NEGATIVE},
               {0, "the return spring's stiffness [N/m]", m->spring_stiffness, SB_NOT_NEGATIVE},
               {0, "the return spring's preload [N]", m->spring_preload, SB_FINITE},
               {0, "the start's position [m]", m->start_position, SB_FINITE},
               {0, "the start's speed [m/s]", m->start_speed, SB_FINITE},
               {0, "the rest before the start [s]", m->start_dwell, 0.0, INFINITY},
               {0, "the tolerance", m->tolerance, 0.0, 1e-5},
               {SB_MECHANISM_IN_DRIVE, "the drive's damping [N s/m]",
                driven ? m->drive_damping : 0.0, SB_NOT_NEGATIVE},
               {SB_MECHANISM_IN_DRIVE, "the drive's stiffness [N/m]",
                sprung ? m->drive_stiffness : 1.0, DBL_MIN, 1e300});
  if (status != SB_OK) {
    return status;
  }
  if (m->contacts > SB_DYNAMICS_CONTACTS || m->stops > SB_DYNAMICS_STOPS ||
      m->edges > SB_DYNAMICS_EDGES) {
    return sb_fail(report, SB_ERROR_RANGE, "too many contacts, stops or edges");
  }
  for (size_t i = 0; i < m->contacts && status == SB_OK; i++) {
    status = check_contact(m, i, report);
  }
  for (size_t i = 0; i < m->stops && status == SB_OK; i++) {
    status = check_stop(&m->stop[i], i, report);
  }
  if (status != SB_OK) {
    return SB_ERROR_RANGE;
  }
  for (size_t i = 0; i < m->edges; i++) {
    if (!isfinite(m->edge[i]) || (i > 0 && !(m->edge[i] > m->edge[i - 1]))) {
      return sb_fail(report, SB_ERROR_INPUT, "edges must increase (edge %zu)", i);
    }
  }
  if (m->extra_rate != NULL && (!(m->extra_scale > 0.0) || !isfinite(m->extra_start))) {
    return sb_fail(report, SB_ERROR_RANGE, "the extra state needs a start and a scale above 0");
  }
  return sb_drive_check(&m->drive, report);
}
