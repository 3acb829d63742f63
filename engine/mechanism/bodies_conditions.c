// The joints' conditions on velocities and positions, and which of them repeat others. See
// bodies.h.
#include "engine/mechanism/bodies_internal.h"
#include "engine/mechanism/vector3.h"

#include <lapacke.h>
#include <stdio.h>

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

void sb_bodies_conditions(Conditions *c, const SbAssembly *a, double length) {
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
    if (joint->kind != SB_JOINT_TRANSLATIONAL && joint->kind != SB_JOINT_CYLINDRICAL) {
      point_row(c, a, joint, axis, arm_i, arm_j, length);
    }
    point_row(c, a, joint, e1, arm_i, arm_j, length);
    point_row(c, a, joint, e2, arm_i, arm_j, length);
    if (joint->kind == SB_JOINT_REVOLUTE || joint->kind == SB_JOINT_CYLINDRICAL) {
      // Any turn about the axis is free: only the axis itself must stay aligned.
      double local[3], now[3], tilt[3], frame[9];
      rotation(frame, joint->twist);
      turn_back(local, frame, joint->frame_j);
      turn(now, ri, local);
      cross(tilt, axis, now);
      memcpy(angle, tilt, sizeof tilt);
    } else if (joint->kind != SB_JOINT_SPHERICAL) {
      spin_row(c, a, joint, axis, angle, length);
    }
    if (joint->kind != SB_JOINT_SPHERICAL) {
      spin_row(c, a, joint, e1, angle, length);
      spin_row(c, a, joint, e2, angle, length);
    }
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

double sb_bodies_extent(const SbAssembly *a) {
  double most = 0.0;
  for (size_t n = 0; n < a->joints; n++) {
    most = fmax(most, sqrt(dot(a->joint[n].local_i, a->joint[n].local_i)));
    most = fmax(most, a->body[a->joint[n].j].ground
                          ? 0.0
                          : sqrt(dot(a->joint[n].local_j, a->joint[n].local_j)));
  }
  return most > 0.0 ? most : 1e-3;
}

size_t sb_bodies_rank(SbAssemblyWork *work, const SbAssembly *a, size_t rows) {
  const Conditions *c = &work->conditions;
  lapack_int n = 6 * (lapack_int)(a->bodies - 1), *pivot = work->pivot;
  double *out = work->matrix;
  for (size_t r = 0; r < rows; r++) {
    pivot[r] = 0;
    for (size_t b = 0; b < a->bodies; b++) {
      if (!a->body[b].ground) {
        memcpy(out, &c->jacobian[r][6 * b], 6 * sizeof *out);
        out += 6;
      }
    }
  }
  lapack_int most = (lapack_int)rows < n ? (lapack_int)rows : n, rank = 0;
  if (LAPACKE_dgeqp3(LAPACK_COL_MAJOR, n, (lapack_int)rows, work->matrix, n, pivot, work->right) ==
      0) {
    while (rank < most && fabs(work->matrix[rank * (n + 1)]) > 1e-9) {
      rank++;
    }
  }
  return (size_t)rank;
}

void sb_bodies_free_motion(double *motion, SbAssemblyWork *work, const SbAssembly *a, size_t rank,
                           size_t index) {
  lapack_int n = 6 * (lapack_int)(a->bodies - 1);
  memset(motion, 0, (size_t)n * sizeof *motion);
  motion[rank + index] = 1.0;
  // The columns of Q behind the rank are orthogonal to all conditions.
  (void)LAPACKE_dormqr(LAPACK_COL_MAJOR, 'L', 'N', n, 1, (lapack_int)rank, work->matrix, n,
                       work->right, motion, n);
}

const char *sb_joint_kind_name(SbJointKind kind) {
  return kind == SB_JOINT_FIXED           ? "fixed"
         : kind == SB_JOINT_TRANSLATIONAL ? "translational"
         : kind == SB_JOINT_REVOLUTE      ? "revolute"
         : kind == SB_JOINT_SPHERICAL     ? "spherical"
                                          : "cylindrical";
}

// The body that what remains free moves most, judged by how much of its six motions is left.
static size_t freest(const SbAssembly *a, SbAssemblyWork *work, size_t rank) {
  double motion[COLUMNS], left[SB_BODIES_MAX] = {0};
  size_t best = 0;
  for (size_t i = 0; rank + i < 6 * (a->bodies - 1); i++) {
    const double *at = motion;
    sb_bodies_free_motion(motion, work, a, rank, i);
    for (size_t b = 0; b < a->bodies; b++) {
      for (int k = 0; k < 6 && !a->body[b].ground; k++, at++) {
        left[b] += *at * *at;
      }
    }
  }
  for (size_t b = 1; b < a->bodies; b++) {
    best = left[b] > left[best] ? b : best;
  }
  return best;
}

SbStatus sb_assembly_mobility(SbMobility *m, const SbAssembly *a, int expected,
                              SbAssemblyWork *work, SbReport *report) {
  *m = (SbMobility){0};
  size_t grounds = 0;
  for (size_t b = 0; b < a->bodies; b++) {
    grounds += a->body[b].ground;
  }
  if (grounds != 1) {
    snprintf(m->text, sizeof m->text, "an assembly needs one ground, not %zu", grounds);
    return sb_fail(report, SB_ERROR_INPUT, "%s", m->text);
  }
  Conditions *c = &work->conditions;
  sb_bodies_conditions(c, a, sb_bodies_extent(a));
  size_t rank = sb_bodies_rank(work, a, c->rows);
  m->constraints = (int)c->rows;
  m->gruebler = 6 * ((int)a->bodies - 1) - m->constraints;
  m->redundant = m->constraints - (int)rank;
  m->freedom = 6 * ((int)a->bodies - 1) - (int)rank;
  int n = snprintf(m->text, sizeof m->text, "%zu parts, %d constraints, %d degree%s of freedom",
                   a->bodies, m->constraints, m->freedom, m->freedom == 1 ? "" : "s");
  size_t used = (size_t)n;
  if (m->redundant > 0) {
    // The first row that those before it imply.
    size_t r = 1;
    while (sb_bodies_rank(work, a, r) == r) {
      r++;
    }
    const SbJoint *joint = &a->joint[c->joint[r - 1]];
    snprintf(m->text + used, sizeof m->text - used,
             "; over-constrained: %d condition%s repeated, first by the %s joint of '%s' and '%s'",
             m->redundant, m->redundant == 1 ? " is" : "s are", sb_joint_kind_name(joint->kind),
             a->body[joint->i].name, a->body[joint->j].name);
    return sb_fail(report, SB_ERROR_INFEASIBLE, "%s", m->text);
  }
  if (expected >= 0 && m->freedom > expected) {
    snprintf(m->text + used, sizeof m->text - used,
             "; under-constrained: %d expected, '%s' is the freest part", expected,
             a->body[freest(a, work, rank)].name);
    return sb_fail(report, SB_ERROR_INFEASIBLE, "%s", m->text);
  }
  if (expected >= 0 && m->freedom < expected) {
    snprintf(m->text + used, sizeof m->text - used, "; over-constrained: %d expected", expected);
    return sb_fail(report, SB_ERROR_INFEASIBLE, "%s", m->text);
  }
  return sb_succeed(report);
}
