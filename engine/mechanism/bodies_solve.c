// Accelerations, reactions and settling of bodies.h. Rotations are scaled by a length so that
// forces and torques, masses and moments are of one size; masses by the largest one. At most
// 16 x 6 + 120 unknowns: dense LAPACK.
#include "engine/mechanism/bodies_internal.h"
#include "engine/mechanism/vector3.h"

#include <lapacke.h>
#include <stdio.h>

void sb_bodies_momentum(double momentum[3], const SbBody *b, const double spin[3]) {
  double r[9], local[3];
  rotation(r, b->orientation);
  turn_back(local, r, spin);
  for (int k = 0; k < 3; k++) {
    local[k] *= b->inertia[k];
  }
  turn(momentum, r, local);
}

void sb_bodies_move(SbBody *b, const double displacement[3], const double angle[3], double share) {
  double q[4] = {1.0};
  for (int k = 0; k < 3; k++) {
    b->position[k] += share * displacement[k];
    q[k + 1] = 0.5 * share * angle[k];
  }
  multiply(b->orientation, q, b->orientation);
  normalise(b->orientation);
}

// Mass matrix block of a body in (m a, I spin_rate/length) per unit of `mass`, ground axes.
static void mass_block(double block[6][6], const SbBody *b, double mass, double length) {
  memset(block, 0, 36 * sizeof(double));
  for (int k = 0; k < 3; k++) {
    double unit[3] = {0}, momentum[3];
    unit[k] = 1.0;
    sb_bodies_momentum(momentum, b, unit);
    block[k][k] = b->mass / mass;
    for (int l = 0; l < 3; l++) {
      block[3 + k][3 + l] = momentum[l] / (mass * length * length);
    }
  }
}

static double largest_mass(const SbAssembly *a) {
  double most = 0.0;
  for (size_t b = 0; b < a->bodies; b++) {
    most = fmax(most, a->body[b].ground ? 0.0 : a->body[b].mass);
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
    double block[6][6];
    mass_block(block, &a->body[b], mass, length);
    for (size_t k = 0; k < 6; k++) {
      for (size_t l = 0; l < 6; l++) {
        double value = a->body[b].ground ? (k == l ? 1.0 : 0.0) : block[k][l];
        matrix[(6 * b + k) * size + 6 * b + l] = value;
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
  double length = sb_bodies_extent(a), mass = largest_mass(a), top[COLUMNS] = {0}, bottom[ROWS];
  sb_bodies_conditions(c, a, length);
  for (size_t b = 0; b < a->bodies; b++) {
    const SbBody *body = &a->body[b];
    if (body->ground) {
      continue;
    }
    // Euler: torque - spin x (I spin).
    double momentum[3], gyro[3];
    sb_bodies_momentum(momentum, body, body->spin);
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
  for (size_t b = 0; b < a->bodies; b++) {
    for (size_t k = 0; k < 3; k++) {
      out->acceleration[b][k] = top[6 * b + k];
      out->spin_rate[b][k] = top[6 * b + 3 + k] / length;
    }
  }
  // Reaction on body i: minus the multipliers times the rows, moved from its centre to the point.
  for (size_t r = 0; r < c->rows; r++) {
    const SbJoint *joint = &a->joint[c->joint[r]];
    size_t side = a->body[joint->i].ground ? joint->j : joint->i;
    double sign = side == joint->i ? -1.0 : 1.0;
    SbReaction *reaction = &out->reaction[c->joint[r]];
    double rotate[9], arm[3], force[3], torque[3], moment[3];
    rotation(rotate, a->body[joint->i].orientation);
    turn(arm, rotate, joint->local_i);
    for (int k = 0; k < 3; k++) {
      arm[k] += a->body[joint->i].position[k] - a->body[side].position[k];
    }
    for (size_t k = 0; k < 3; k++) {
      force[k] = sign * bottom[r] * mass * c->jacobian[r][6 * side + k];
      torque[k] = sign * bottom[r] * mass * length * c->jacobian[r][6 * side + 3 + k];
    }
    cross(moment, arm, force);
    for (size_t k = 0; k < 3; k++) {
      reaction->force[k] += force[k];
      reaction->torque[k] += torque[k] - moment[k];
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
      double *move = &top[6 * b];
      double angle[3] = {move[3] / length, move[4] / length, move[5] / length};
      sb_bodies_move(&a->body[b], move, angle, a->body[b].ground ? 0.0 : 1.0);
    }
  }
  if (!(worst < 1e-9 * length)) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                   "the parts cannot be brought onto their joints (%.3g m off)", worst);
  }
  return sb_succeed(report);
}
