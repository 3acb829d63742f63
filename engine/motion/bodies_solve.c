// Conditions, freedom, accelerations and reactions of bodies.h. Rotations are scaled by a length so
// that forces and torques, masses and moments are of one size; masses by the largest one. At most
// 16 x 6 + 120 unknowns: dense LAPACK.
#include "engine/motion/bodies.h"
#include "engine/motion/vector3.h"

#include <lapacke.h>
#include <stdio.h>

enum {
  ROWS = 6 * SB_JOINTS_MAX,
  COLUMNS = 6 * SB_BODIES_MAX,
  SIZE = ROWS + COLUMNS,
};

// ---- conditions ----

typedef struct {
  size_t rows;
  double jacobian[ROWS][COLUMNS]; // of (velocity, length x spin) of each body
  double rate[ROWS];              // what the rows' second derivative has beside J a
  double error[ROWS];             // violation of the position conditions
  size_t joint[ROWS];
} Conditions;

// One row: e . (rate of the points' distance), with e turning with body j.
static void point_row(Conditions *c, const SbAssembly *a, const SbJoint *joint, const double e[3],
                      const double arm_i[3], const double arm_j[3], double length) {
  const SbBody *bi = &a->body[joint->i], *bj = &a->body[joint->j];
  double *row = c->jacobian[c->rows], d[3], speed[3], t[3], wi[3], wj[3];
  for (int k = 0; k < 3; k++) {
    d[k] = bi->position[k] + arm_i[k] - bj->position[k] - arm_j[k];
  }
  cross(wi, bi->spin, arm_i);
  cross(wj, bj->spin, arm_j);
  for (int k = 0; k < 3; k++) {
    speed[k] = bi->velocity[k] + wi[k] - bj->velocity[k] - wj[k];
    row[6 * joint->i + (size_t)k] = e[k];
    row[6 * joint->j + (size_t)k] = -e[k];
  }
  cross(t, arm_i, e);
  for (int k = 0; k < 3; k++) {
    row[6 * joint->i + 3 + (size_t)k] = t[k] / length;
  }
  // arm_j + d: the point of i seen from body j, about which e turns.
  double reach[3] = {arm_j[0] + d[0], arm_j[1] + d[1], arm_j[2] + d[2]};
  cross(t, reach, e);
  for (int k = 0; k < 3; k++) {
    row[6 * joint->j + 3 + (size_t)k] = -t[k] / length;
  }
  // Second derivative without the accelerations.
  double ci[3], cj[3], et[3], ett[3];
  cross(ci, bi->spin, wi);
  cross(cj, bj->spin, wj);
  cross(et, bj->spin, e);
  cross(ett, bj->spin, et);
  c->rate[c->rows] = dot(e, ci) - dot(e, cj) + 2.0 * dot(et, speed) + dot(ett, d);
  c->error[c->rows] = dot(e, d);
  c->rows++;
}

static void spin_row(Conditions *c, const SbAssembly *a, const SbJoint *joint, const double e[3],
                     const double angle[3], double length) {
  const SbBody *bi = &a->body[joint->i], *bj = &a->body[joint->j];
  double *row = c->jacobian[c->rows], et[3], relative[3];
  for (int k = 0; k < 3; k++) {
    row[6 * joint->i + 3 + (size_t)k] = e[k];
    row[6 * joint->j + 3 + (size_t)k] = -e[k];
    relative[k] = bi->spin[k] - bj->spin[k];
  }
  cross(et, bj->spin, e);
  c->rate[c->rows] = length * dot(et, relative);
  c->error[c->rows] = length * dot(e, angle);
  c->rows++;
}

static void build(Conditions *c, const SbAssembly *a, double length) {
  memset(c, 0, sizeof *c);
  for (size_t n = 0; n < a->joints; n++) {
    const SbJoint *joint = &a->joint[n];
    const SbBody *bi = &a->body[joint->i], *bj = &a->body[joint->j];
    double ri[9], rj[9], arm_i[3], arm_j[3], axis[3], e1[3], e2[3], angle[3];
    rotation(ri, bi->orientation);
    rotation(rj, bj->orientation);
    turn(arm_i, ri, joint->local_i);
    turn(arm_j, rj, joint->local_j);
    turn(axis, rj, joint->frame_j);
    turn(e1, rj, joint->frame_j + 3);
    turn(e2, rj, joint->frame_j + 6);
    // Small rotation of i against where j says it should be, ground axes.
    double want[4], back[4], small[4];
    multiply(want, bj->orientation, joint->twist);
    back[0] = want[0];
    for (int k = 1; k < 4; k++) {
      back[k] = -want[k];
    }
    multiply(small, bi->orientation, back);
    for (int k = 0; k < 3; k++) {
      angle[k] = 2.0 * small[k + 1] * (small[0] < 0.0 ? -1.0 : 1.0);
    }
    size_t first = c->rows;
    if (joint->kind != SB_JOINT_TRANSLATIONAL) {
      point_row(c, a, joint, axis, arm_i, arm_j, length);
    }
    point_row(c, a, joint, e1, arm_i, arm_j, length);
    point_row(c, a, joint, e2, arm_i, arm_j, length);
    if (joint->kind == SB_JOINT_REVOLUTE) {
      // Any turn about the axis is free: only the axis itself must stay aligned.
      double local[3], now[3], tilt[3], frame[9];
      rotation(frame, joint->twist);
      turn_back(local, frame, joint->frame_j);
      turn(now, ri, local);
      cross(tilt, axis, now);
      memcpy(angle, tilt, sizeof tilt);
    } else {
      spin_row(c, a, joint, axis, angle, length);
    }
    spin_row(c, a, joint, e1, angle, length);
    spin_row(c, a, joint, e2, angle, length);
    for (size_t r = first; r < c->rows; r++) {
      c->joint[r] = n;
    }
  }
  // Ground does not move: its columns go.
  for (size_t b = 0; b < a->bodies; b++) {
    for (size_t r = 0; a->body[b].ground && r < c->rows; r++) {
      memset(&c->jacobian[r][6 * b], 0, 6 * sizeof(double));
    }
  }
}

// Length that makes rotations comparable with translations: the assembly's extent.
static double extent(const SbAssembly *a) {
  double most = 0.0;
  for (size_t n = 0; n < a->joints; n++) {
    most = fmax(most, sqrt(dot(a->joint[n].local_i, a->joint[n].local_i)));
    most = fmax(most, a->body[a->joint[n].j].ground
                          ? 0.0
                          : sqrt(dot(a->joint[n].local_j, a->joint[n].local_j)));
  }
  return most > 0.0 ? most : 1e-3;
}

// Orthogonalises the rows one by one (twice, for rounding). Independent rows stay in `basis`.
static size_t independent_rows(double basis[ROWS][COLUMNS], bool *repeated, const Conditions *c,
                               size_t columns) {
  size_t rank = 0;
  for (size_t r = 0; r < c->rows; r++) {
    double v[COLUMNS], before = 0.0, after = 0.0;
    memcpy(v, c->jacobian[r], sizeof v);
    for (size_t k = 0; k < columns; k++) {
      before += v[k] * v[k];
    }
    for (int pass = 0; pass < 2; pass++) {
      for (size_t b = 0; b < rank; b++) {
        double s = 0.0;
        for (size_t k = 0; k < columns; k++) {
          s += v[k] * basis[b][k];
        }
        for (size_t k = 0; k < columns; k++) {
          v[k] -= s * basis[b][k];
        }
      }
    }
    for (size_t k = 0; k < columns; k++) {
      after += v[k] * v[k];
    }
    repeated[r] = !(after > 1e-18 * before);
    if (!repeated[r]) {
      for (size_t k = 0; k < columns; k++) {
        basis[rank][k] = v[k] / sqrt(after);
      }
      rank++;
    }
  }
  return rank;
}

const char *sb_joint_kind_name(SbJointKind kind) {
  return kind == SB_JOINT_FIXED           ? "fixed"
         : kind == SB_JOINT_TRANSLATIONAL ? "translational"
                                          : "revolute";
}

// The body that what remains free moves most, judged by how much of its six motions is left.
static size_t freest(const SbAssembly *a, double basis[ROWS][COLUMNS], size_t rank) {
  size_t best = 0;
  double most = -1.0;
  for (size_t b = 0; b < a->bodies; b++) {
    double left = a->body[b].ground ? -1.0 : 6.0;
    for (size_t k = 6 * b; k < 6 * b + 6; k++) {
      for (size_t r = 0; r < rank; r++) {
        left -= basis[r][k] * basis[r][k];
      }
    }
    if (left > most) {
      most = left;
      best = b;
    }
  }
  return best;
}

SbStatus sb_assembly_mobility(SbMobility *m, const SbAssembly *a, int expected, SbReport *report) {
  *m = (SbMobility){0};
  size_t grounds = 0;
  for (size_t b = 0; b < a->bodies; b++) {
    grounds += a->body[b].ground;
  }
  if (grounds != 1) {
    snprintf(m->text, sizeof m->text, "an assembly needs one ground, not %zu", grounds);
    return sb_fail(report, SB_ERROR_INPUT, "%s", m->text);
  }
  Conditions c;
  build(&c, a, extent(a));
  double basis[ROWS][COLUMNS];
  bool repeated[ROWS] = {false};
  size_t rank = independent_rows(basis, repeated, &c, 6 * a->bodies);
  m->constraints = (int)c.rows;
  m->gruebler = 6 * ((int)a->bodies - 1) - m->constraints;
  m->redundant = m->constraints - (int)rank;
  m->freedom = 6 * ((int)a->bodies - 1) - (int)rank;
  int n = snprintf(m->text, sizeof m->text, "%zu parts, %d constraints, %d degree%s of freedom",
                   a->bodies, m->constraints, m->freedom, m->freedom == 1 ? "" : "s");
  size_t used = (size_t)n;
  if (m->redundant > 0) {
    size_t r = 0;
    while (!repeated[r]) {
      r++;
    }
    const SbJoint *joint = &a->joint[c.joint[r]];
    snprintf(m->text + used, sizeof m->text - used,
             "; over-constrained: %d condition%s repeated, first by the %s joint of '%s' and '%s'",
             m->redundant, m->redundant == 1 ? " is" : "s are", sb_joint_kind_name(joint->kind),
             a->body[joint->i].name, a->body[joint->j].name);
    return sb_fail(report, SB_ERROR_INFEASIBLE, "%s", m->text);
  }
  if (expected >= 0 && m->freedom > expected) {
    snprintf(m->text + used, sizeof m->text - used,
             "; under-constrained: %d expected, '%s' is the freest part", expected,
             a->body[freest(a, basis, rank)].name);
    return sb_fail(report, SB_ERROR_INFEASIBLE, "%s", m->text);
  }
  if (expected >= 0 && m->freedom < expected) {
    snprintf(m->text + used, sizeof m->text - used, "; over-constrained: %d expected", expected);
    return sb_fail(report, SB_ERROR_INFEASIBLE, "%s", m->text);
  }
  return sb_succeed(report);
}

// ---- accelerations ----

// Mass matrix block of a body in (m a, I spin_rate/length) per unit of `mass`, ground axes.
static void mass_block(double block[6][6], const SbBody *b, double mass, double length) {
  double r[9];
  memset(block, 0, 36 * sizeof(double));
  rotation(r, b->orientation);
  for (int k = 0; k < 3; k++) {
    block[k][k] = b->mass / mass;
    for (int l = 0; l < 3; l++) {
      double sum = 0.0;
      for (int p = 0; p < 3; p++) {
        sum += r[3 * k + p] * b->inertia[p] * r[3 * l + p];
      }
      block[3 + k][3 + l] = sum / (mass * length * length);
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

// Solves the system for one right side: top (bodies, per mass) and bottom (conditions). The answer
// replaces them: accelerations (spins times length), multipliers per mass.
static SbStatus solve(const SbAssembly *a, const Conditions *c, double mass, double length,
                      double *top, double *bottom, SbReport *report) {
  size_t columns = 6 * a->bodies, size = columns + c->rows;
  double matrix[SIZE * SIZE], right[SIZE];
  lapack_int pivot[SIZE];
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
  lapack_int info = LAPACKE_dgesv(LAPACK_ROW_MAJOR, n, 1, matrix, n, pivot, right, 1);
  if (info != 0) {
    return sb_fail(report, SB_ERROR_INFEASIBLE, "the joints' conditions repeat each other");
  }
  memcpy(top, right, columns * sizeof *right);
  memcpy(bottom, right + columns, c->rows * sizeof *right);
  return SB_OK;
}

SbStatus sb_assembly_forces(SbAssemblyForces *out, const SbAssembly *a, SbReport *report) {
  SbMobility mobility;
  SbStatus status = sb_assembly_mobility(&mobility, a, -1, report);
  if (status != SB_OK) {
    return status;
  }
  Conditions c;
  double length = extent(a), mass = largest_mass(a), top[COLUMNS] = {0}, bottom[ROWS];
  build(&c, a, length);
  for (size_t b = 0; b < a->bodies; b++) {
    const SbBody *body = &a->body[b];
    if (body->ground) {
      continue;
    }
    // Euler: torque - spin x (I spin).
    double r[9], local[3], momentum[3], gyro[3];
    rotation(r, body->orientation);
    turn_back(local, r, body->spin);
    for (int k = 0; k < 3; k++) {
      local[k] *= body->inertia[k];
    }
    turn(momentum, r, local);
    cross(gyro, body->spin, momentum);
    for (size_t k = 0; k < 3; k++) {
      top[6 * b + k] = body->force[k] / mass;
      top[6 * b + 3 + k] = (body->torque[k] - gyro[k]) / (mass * length);
    }
  }
  for (size_t r = 0; r < c.rows; r++) {
    bottom[r] = -c.rate[r];
  }
  status = solve(a, &c, mass, length, top, bottom, report);
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
  for (size_t r = 0; r < c.rows; r++) {
    const SbJoint *joint = &a->joint[c.joint[r]];
    size_t side = a->body[joint->i].ground ? joint->j : joint->i;
    double sign = side == joint->i ? -1.0 : 1.0;
    SbReaction *reaction = &out->reaction[c.joint[r]];
    double rotate[9], arm[3], force[3], torque[3], moment[3];
    rotation(rotate, a->body[joint->i].orientation);
    turn(arm, rotate, joint->local_i);
    for (int k = 0; k < 3; k++) {
      arm[k] += a->body[joint->i].position[k] - a->body[side].position[k];
    }
    for (size_t k = 0; k < 3; k++) {
      force[k] = sign * bottom[r] * mass * c.jacobian[r][6 * side + k];
      torque[k] = sign * bottom[r] * mass * length * c.jacobian[r][6 * side + 3 + k];
    }
    cross(moment, arm, force);
    for (size_t k = 0; k < 3; k++) {
      reaction->force[k] += force[k];
      reaction->torque[k] += torque[k] - moment[k];
    }
  }
  return sb_succeed(report);
}

SbStatus sb_assembly_effective_mass(double *out, const SbAssembly *a, size_t body,
                                    const double axis[3], SbReport *report) {
  SbMobility mobility;
  SbStatus status = sb_assembly_mobility(&mobility, a, 1, report);
  if (status != SB_OK) {
    return status;
  }
  // A unit push there, nothing else, everything at rest: mass = push over acceleration.
  SbAssembly still = *a;
  double size = sqrt(dot(axis, axis)), push[3];
  sb_assembly_clear_forces(&still);
  for (size_t b = 0; b < still.bodies; b++) {
    memset(still.body[b].velocity, 0, sizeof still.body[b].velocity);
    memset(still.body[b].spin, 0, sizeof still.body[b].spin);
  }
  for (int k = 0; k < 3; k++) {
    push[k] = axis[k] / size;
  }
  sb_assembly_apply(&still, body, push, still.body[body].position);
  SbAssemblyForces forces;
  status = sb_assembly_forces(&forces, &still, report);
  if (status != SB_OK) {
    return status;
  }
  double along = dot(forces.acceleration[body], push);
  if (!(along * largest_mass(a) > 1e-12)) {
    return sb_fail(report, SB_ERROR_INFEASIBLE, "'%s' does not move along the axis",
                   a->body[body].name);
  }
  *out = 1.0 / along;
  return sb_succeed(report);
}

SbStatus sb_assembly_settle(SbAssembly *a, SbReport *report) {
  double length = extent(a), mass = largest_mass(a), worst = INFINITY;
  Conditions c;
  for (int iteration = 0; iteration < 20; iteration++) {
    double top[COLUMNS] = {0}, bottom[ROWS], now = 0.0;
    build(&c, a, length);
    for (size_t r = 0; r < c.rows; r++) {
      bottom[r] = -c.error[r];
      now = fmax(now, fabs(c.error[r]));
    }
    if (now <= 1e-15 * length || (iteration > 1 && now >= 0.5 * worst && now < 1e-12 * length)) {
      worst = now;
      break;
    }
    worst = now;
    SbStatus status = solve(a, &c, mass, length, top, bottom, report);
    if (status != SB_OK) {
      return status;
    }
    for (size_t b = 0; b < a->bodies; b++) {
      SbBody *body = &a->body[b];
      double q[4] = {1.0};
      for (size_t k = 0; k < 3 && !body->ground; k++) {
        body->position[k] += top[6 * b + k];
        q[k + 1] = 0.5 * top[6 * b + 3 + k] / length;
      }
      multiply(body->orientation, q, body->orientation);
      normalise(body->orientation);
    }
  }
  if (!(worst < 1e-9 * length)) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                   "the parts cannot be brought onto their joints (%.3g m off)", worst);
  }
  // Velocities: remove what violates the conditions.
  double top[COLUMNS] = {0}, bottom[ROWS];
  build(&c, a, length);
  for (size_t r = 0; r < c.rows; r++) {
    bottom[r] = 0.0;
    for (size_t b = 0; b < a->bodies; b++) {
      for (size_t k = 0; k < 3; k++) {
        bottom[r] -= c.jacobian[r][6 * b + k] * a->body[b].velocity[k] +
                     c.jacobian[r][6 * b + 3 + k] * a->body[b].spin[k] * length;
      }
    }
  }
  SbStatus status = solve(a, &c, mass, length, top, bottom, report);
  for (size_t b = 0; b < a->bodies && status == SB_OK; b++) {
    for (size_t k = 0; k < 3 && !a->body[b].ground; k++) {
      a->body[b].velocity[k] += top[6 * b + k];
      a->body[b].spin[k] += top[6 * b + 3 + k] / length;
    }
  }
  return status == SB_OK ? sb_succeed(report) : status;
}
