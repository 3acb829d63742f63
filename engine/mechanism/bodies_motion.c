// Accelerations, reactions and settling of bodies.h, and the motion that the joints leave to an
// assembly of one degree of freedom: the null vector of their Jacobian, found by factoring it
// wherever the parts are, and travel along it. Rotations are scaled by a length so that forces and
// torques, masses and moments are of one size; masses by the largest one. At most 15 x 6 + 120
// unknowns: dense LAPACK.
#include "engine/mechanism/bodies_internal.h"
#include "engine/mechanism/vector3.h"

#include <lapacke.h>

// Angular momentum of a body that spins [kg m2/s], ground axes.
static void spin_momentum(double momentum[3], const SbBody *b, const double spin[3]) {
  double r[9], local[3];
  rotation(r, b->orientation);
  turn_back(local, r, spin);
  for (int k = 0; k < 3; k++) {
    local[k] *= b->inertia[k];
  }
  turn(momentum, r, local);
}

// Moves a body by `share` times a small displacement [m] and turn [rad].
static void move(SbBody *b, const double displacement[3], const double angle[3], double share) {
  double q[4] = {1.0};
  for (int k = 0; k < 3; k++) {
    b->position[k] += share * displacement[k];
    q[k + 1] = 0.5 * share * angle[k];
  }
  multiply(b->orientation, q, b->orientation);
  normalise(b->orientation);
}

static double largest_mass(const SbAssembly *a) {
  double most = 0.0;
  for (size_t b = 0; b < a->bodies; b++) {
    most = fmax(most, a->body[b].mass);
  }
  return most > 0.0 ? most : 1.0;
}

SbStatus sb_bodies_solve(const SbAssembly *a, SbAssemblyWork *work, double mass, double length,
                         double *top, double *bottom, SbReport *report) {
  const Conditions *c = &work->conditions;
  size_t columns = 6 * a->bodies, size = columns + c->rows;
  double *matrix = work->matrix, *right = work->right;
  memset(matrix, 0, size * size * sizeof *matrix);
  for (size_t b = 0; b < a->bodies; b++) {
    // Of a body in (m a, I spin_rate/length) per unit of `mass`, ground axes.
    for (size_t k = 0; k < 3; k++) {
      double unit[3] = {0}, momentum[3];
      unit[k] = 1.0;
      spin_momentum(momentum, &a->body[b], unit);
      matrix[(6 * b + k) * (size + 1)] = a->body[b].mass / mass;
      for (size_t l = 0; l < 3; l++) {
        matrix[(6 * b + 3 + k) * size + 6 * b + 3 + l] = momentum[l] / (mass * length * length);
      }
    }
  }
  for (size_t r = 0; r < c->rows; r++) {
    for (size_t k = 0; k < columns; k++) {
      matrix[(columns + r) * size + k] = c->jacobian[r][k];
      matrix[k * size + columns + r] = c->jacobian[r][k];
    }
  }
  memcpy(right, top, columns * sizeof *right);
  memcpy(right + columns, bottom, c->rows * sizeof *right);
  lapack_int n = (lapack_int)size;
  // By columns, which for a symmetric matrix are its rows: by rows LAPACKE would allocate.
  lapack_int info = LAPACKE_dgesv(LAPACK_COL_MAJOR, n, 1, matrix, n, work->pivot, right, n);
  if (info != 0) {
    return sb_fail(report, SB_ERROR_INFEASIBLE, "the joints' conditions repeat each other");
  }
  memcpy(top, right, columns * sizeof *right);
  memcpy(bottom, right + columns, c->rows * sizeof *right);
  return SB_OK;
}

SbStatus sb_assembly_forces(SbAssemblyForces *out, const SbAssembly *a, SbAssemblyWork *work,
                            SbReport *report) {
  SbMobility mobility;
  SbStatus status = sb_assembly_mobility(&mobility, a, -1, work, report);
  return status != SB_OK ? status : sb_bodies_forces(out, a, work, report);
}

SbStatus sb_bodies_forces(SbAssemblyForces *out, const SbAssembly *a, SbAssemblyWork *work,
                          SbReport *report) {
  Conditions *c = &work->conditions;
  double length = sb_bodies_extent(a), mass = largest_mass(a), top[COLUMNS], bottom[ROWS];
  sb_bodies_conditions(c, a, length);
  for (size_t b = 0; b < a->bodies; b++) {
    // Euler: torque - spin x (I spin).
    const SbBody *body = &a->body[b];
    double momentum[3], gyro[3];
    spin_momentum(momentum, body, body->spin);
    cross(gyro, body->spin, momentum);
    for (size_t k = 0; k < 3; k++) {
      top[6 * b + k] = body->force[k] / mass;
      top[6 * b + 3 + k] = (body->torque[k] - gyro[k]) / (mass * length);
    }
  }
  for (size_t r = 0; r < c->rows; r++) {
    bottom[r] = -c->rate[r];
  }
  SbStatus status = sb_bodies_solve(a, work, mass, length, top, bottom, report);
  if (status != SB_OK) {
    return status;
  }
  memset(out, 0, sizeof *out);
  for (size_t k = 0; k < 6 * a->bodies; k++) {
    *(k % 6 < 3 ? &out->acceleration[k / 6][k % 3] : &out->spin_rate[k / 6][k % 3]) =
        top[k] / (k % 6 < 3 ? 1.0 : length);
  }
  // On the first body: minus the multipliers times the rows. Those of the joint's point have no
  // moment about it.
  for (size_t r = 0; r < c->rows; r++) {
    size_t first = 6 * a->joint[c->joint[r]].body[0];
    SbReaction *reaction = &out->reaction[c->joint[r]];
    for (size_t k = 0; k < 3; k++) {
      if (c->turns[r]) {
        reaction->torque[k] -= bottom[r] * mass * length * c->jacobian[r][first + 3 + k];
      } else {
        reaction->force[k] -= bottom[r] * mass * c->jacobian[r][first + k];
      }
    }
  }
  return sb_succeed(report);
}

SbStatus sb_bodies_settle_positions(SbAssembly *a, double *error, SbAssemblyWork *work,
                                    SbReport *report) {
  double length = sb_bodies_extent(a), mass = largest_mass(a), worst = INFINITY;
  Conditions *c = &work->conditions;
  for (int iteration = 0; iteration < 20; iteration++) {
    double top[COLUMNS] = {0}, bottom[ROWS], now = 0.0;
    sb_bodies_conditions(c, a, length);
    for (size_t r = 0; r < c->rows; r++) {
      bottom[r] = -c->error[r];
      now = fmax(now, fabs(c->error[r]));
    }
    *error = iteration == 0 ? now : *error;
    if (now <= 1e-15 * length || (iteration > 1 && now >= 0.5 * worst && now < 1e-12 * length)) {
      worst = now;
      break;
    }
    worst = now;
    SbStatus status = sb_bodies_solve(a, work, mass, length, top, bottom, report);
    if (status != SB_OK) {
      return status;
    }
    for (size_t b = 0; b < a->bodies; b++) {
      const double *by = &top[6 * b], angle[3] = {by[3] / length, by[4] / length, by[5] / length};
      move(&a->body[b], by, angle, 1.0);
    }
  }
  if (!(worst < 1e-9 * length)) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                   "the parts cannot be brought onto their joints (%.3g m off)", worst);
  }
  return sb_succeed(report);
}

// ---- the motion that is left ----

SbStatus sb_assembly_tangent(SbAssemblyTangent *t, const SbAssembly *a, size_t body,
                             const double axis[3], SbAssemblyWork *work, SbReport *report) {
  Conditions *c = &work->conditions;
  double length = sb_bodies_extent(a), motion[COLUMNS];
  sb_bodies_conditions(c, a, length);
  if (c->rows + 1 != 6 * a->bodies || sb_bodies_rank(work, a, c->rows) != c->rows) {
    SbMobility mobility;
    SbStatus status = sb_assembly_mobility(&mobility, a, 1, work, report);
    return status != SB_OK
               ? status
               : sb_fail(report, SB_ERROR_INFEASIBLE,
                         "the joints' conditions are too close to repeating each other (%s)",
                         mobility.text);
  }
  sb_bodies_free_motion(motion, work, a, c->rows, 0);
  memcpy(work->tangent_jacobian, c->jacobian, c->rows * sizeof *c->jacobian);
  // `axis` may be that of *t.
  double unit = sqrt(dot(axis, axis));
  *t = (SbAssemblyTangent){.body = body, .axis = {axis[0] / unit, axis[1] / unit, axis[2] / unit}};
  double along = dot(&motion[6 * body], t->axis);
  if (!(fabs(along) > 1e-6)) {
    return sb_fail(report, SB_ERROR_INFEASIBLE, "'%s' does not move along the axis",
                   a->body[body].name);
  }
  for (size_t b = 0; b < a->bodies; b++) {
    for (size_t k = 0; k < 3; k++) {
      t->velocity[b][k] = motion[6 * b + k] / along;
      t->spin[b][k] = motion[6 * b + 3 + k] / length / along;
    }
    // The mass that the kinetic energy shows: twice that of the tangent's motion.
    double momentum[3];
    spin_momentum(momentum, &a->body[b], t->spin[b]);
    t->mass += a->body[b].mass * dot(t->velocity[b], t->velocity[b]) + dot(t->spin[b], momentum);
  }
  return sb_succeed(report);
}

// Returns whether the parts are on their joints, and these have the Jacobian of the last tangent,
// except for rounding: parts that slide together. *off is the violation of the joints [m].
static bool stays_tangent(double *off, const SbAssembly *a, SbAssemblyWork *work) {
  static const double ROUNDING = 1e-13;
  const double length = sb_bodies_extent(a);
  Conditions *c = &work->conditions;
  sb_bodies_conditions(c, a, length);
  *off = 0.0;
  for (size_t r = 0; r < c->rows; r++) {
    *off = fmax(*off, fabs(c->error[r]));
    if (!(fabs(c->error[r]) <= ROUNDING * length)) {
      return false;
    }
    for (size_t k = 0; k < 6 * a->bodies; k++) {
      if (!(fabs(c->jacobian[r][k] - work->tangent_jacobian[r][k]) <= ROUNDING)) {
        return false;
      }
    }
  }
  return true;
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
      move(&a->body[b], t->velocity[b], t->spin[b], left);
    }
    if (stays_tangent(&off, a, work)) {
      worst = fmax(worst, off);
      continue;
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
