// The motion that the joints leave to an assembly of one degree of freedom: the null vector of
// their Jacobian, found by factoring it wherever the parts are, and travel along it. See bodies.h.
#include "engine/mechanism/bodies_internal.h"
#include "engine/mechanism/vector3.h"

static SbStatus not_one(const SbAssembly *a, SbAssemblyWork *work, SbReport *report) {
  SbMobility mobility;
  SbStatus status = sb_assembly_mobility(&mobility, a, 1, work, report);
  return status != SB_OK
             ? status
             : sb_fail(report, SB_ERROR_INFEASIBLE,
                       "the joints' conditions are too close to repeating each other (%s)",
                       mobility.text);
}

// Kinetic energy's mass: twice the energy of the tangent's motion.
static double mass_of(const SbAssembly *a, const SbAssemblyTangent *t) {
  double sum = 0.0;
  for (size_t b = 0; b < a->bodies; b++) {
    if (!a->body[b].ground) {
      double momentum[3];
      sb_bodies_momentum(momentum, &a->body[b], t->spin[b]);
      sum += a->body[b].mass * dot(t->velocity[b], t->velocity[b]) + dot(t->spin[b], momentum);
    }
  }
  return sum;
}

SbStatus sb_assembly_tangent(SbAssemblyTangent *t, const SbAssembly *a, size_t body,
                             const double axis[3], SbAssemblyWork *work, SbReport *report) {
  Conditions *c = &work->conditions;
  double length = sb_bodies_extent(a);
  sb_bodies_conditions(c, a, length);
  double motion[COLUMNS];
  size_t size = 6 * (a->bodies - 1);
  if (c->rows + 1 != size || sb_bodies_rank(work, a, c->rows) != c->rows) {
    return not_one(a, work, report);
  }
  sb_bodies_free_motion(motion, work, a, c->rows, 0);
  // `axis` may be that of *t.
  double unit = sqrt(dot(axis, axis));
  *t = (SbAssemblyTangent){.body = body, .axis = {axis[0] / unit, axis[1] / unit, axis[2] / unit}};
  const double *from = motion;
  for (size_t b = 0; b < a->bodies; b++) {
    for (size_t k = 0; k < 3 && !a->body[b].ground; k++) {
      t->velocity[b][k] = from[k];
      t->spin[b][k] = from[3 + k] / length;
    }
    from += a->body[b].ground ? 0 : 6;
  }
  double along = dot(t->velocity[body], t->axis);
  if (!(fabs(along) > 1e-6)) {
    return sb_fail(report, SB_ERROR_INFEASIBLE, "'%s' does not move along the axis",
                   a->body[body].name);
  }
  for (size_t b = 0; b < a->bodies; b++) {
    for (int k = 0; k < 3; k++) {
      t->velocity[b][k] /= along;
      t->spin[b][k] /= along;
    }
  }
  t->mass = mass_of(a, t);
  return sb_succeed(report);
}

SbStatus sb_assembly_slide(SbAssembly *a, SbAssemblyTangent *t, double distance, double speed,
                           double *error, SbAssemblyWork *work, SbReport *report) {
  double start = dot(a->body[t->body].position, t->axis), worst = 0.0, before = INFINITY;
  double size = fabs(start) + fabs(distance) + sb_bodies_extent(a);
  for (int iteration = 0; iteration < 30; iteration++) {
    double left = start + distance - dot(a->body[t->body].position, t->axis), off = 0.0;
    // As far as rounding lets it.
    if (left == 0.0 || (fabs(left) < 1e-14 * size && fabs(left) > 0.1 * before)) {
      if (error != NULL) {
        *error = worst;
      }
      for (size_t b = 0; b < a->bodies; b++) {
        for (int k = 0; k < 3; k++) {
          a->body[b].velocity[k] = speed * t->velocity[b][k];
          a->body[b].spin[k] = speed * t->spin[b][k];
        }
      }
      return sb_succeed(report);
    }
    before = fabs(left);
    for (size_t b = 0; b < a->bodies; b++) {
      sb_bodies_move(&a->body[b], t->velocity[b], t->spin[b], left);
    }
    SbStatus status = sb_bodies_settle_positions(a, &off, work, report);
    status = status != SB_OK ? status : sb_assembly_tangent(t, a, t->body, t->axis, work, report);
    if (status != SB_OK) {
      return status;
    }
    worst = fmax(worst, off);
  }
  return sb_fail(report, SB_ERROR_NOT_CONVERGED, "'%s' cannot move %.9g m along its axis",
                 a->body[t->body].name, distance);
}
