// Parts and joints of an assembly, the joints' conditions on velocities and positions, and which of
// them repeat others; the thesis' valve as one. See bodies.h.
#include "engine/mechanism/bodies_internal.h"
#include "engine/mechanism/vector3.h"

#include <lapacke.h>
#include <stdio.h>

static bool finite3(const double a[3]) {
  return isfinite(a[0]) && isfinite(a[1]) && isfinite(a[2]);
}

void sb_assembly_start(SbAssembly *a) {
  *a = (SbAssembly){0};
  a->body[SB_GROUND] = (SbBody){.name = "ground", .orientation = {1.0}};
}

SbStatus sb_assembly_add(SbAssembly *a, const char *name, double mass, const double inertia[3],
                         const double position[3], SbReport *report) {
  if (a->bodies >= SB_BODIES_MAX) {
    return sb_fail(report, SB_ERROR_RANGE, "no more than %d parts", SB_BODIES_MAX);
  }
  if (!(mass > 0.0) || !isfinite(mass) || !finite3(inertia) || !finite3(position) ||
      !(inertia[0] > 0.0) || !(inertia[1] > 0.0) || !(inertia[2] > 0.0)) {
    return sb_fail(report, SB_ERROR_RANGE, "part '%s': mass and moments must be above 0", name);
  }
  // A moment larger than the sum of the two others belongs to no body (rounded tables allowed for).
  for (int i = 0; i < 3; i++) {
    if (inertia[i] > 1.001 * (inertia[(i + 1) % 3] + inertia[(i + 2) % 3])) {
      return sb_fail(report, SB_ERROR_RANGE,
                     "part '%s': a moment of inertia exceeds the sum of the others", name);
    }
  }
  SbBody *b = &a->body[a->bodies++];
  *b = (SbBody){.mass = mass, .orientation = {1.0}};
  snprintf(b->name, sizeof b->name, "%s", name);
  memcpy(b->inertia, inertia, sizeof b->inertia);
  memcpy(b->position, position, sizeof b->position);
  return sb_succeed(report);
}

SbStatus sb_assembly_join(SbAssembly *a, SbJointKind kind, size_t i, size_t j,
                          const double point[3], const double axis[3], SbReport *report) {
  if (a->joints >= SB_JOINTS_MAX) {
    return sb_fail(report, SB_ERROR_RANGE, "no more than %d joints", SB_JOINTS_MAX);
  }
  if ((i >= a->bodies && i != SB_GROUND) || (j >= a->bodies && j != SB_GROUND) || i == j) {
    return sb_fail(report, SB_ERROR_INPUT, "a joint needs two different parts");
  }
  double size = sqrt(dot(axis, axis)), frame[3][3], helper[3] = {0};
  if (!(size > 0.0) || !isfinite(size)) {
    return sb_fail(report, SB_ERROR_INPUT, "the joint of '%s' and '%s' needs an axis",
                   a->body[i].name, a->body[j].name);
  }
  // A frame whose first axis is the joint's, stored in the axes of both bodies.
  helper[fabs(axis[0]) < 0.6 * size ? 0 : 1] = 1.0;
  cross(frame[1], axis, helper);
  double across = sqrt(dot(frame[1], frame[1]));
  for (int k = 0; k < 3; k++) {
    frame[0][k] = axis[k] / size;
    frame[1][k] /= across;
  }
  cross(frame[2], frame[0], frame[1]);
  SbJoint *joint = &a->joint[a->joints++];
  *joint = (SbJoint){.kind = kind, .body = {i, j}};
  for (int side = 0; side < 2; side++) {
    const SbBody *body = &a->body[joint->body[side]];
    double r[9], arm[3];
    rotation(r, body->orientation);
    for (int k = 0; k < 3; k++) {
      arm[k] = point[k] - body->position[k];
      turn_back(joint->frame[side][k], r, frame[k]);
    }
    turn_back(joint->point[side], r, arm);
  }
  return sb_succeed(report);
}

void sb_assembly_apply(SbAssembly *a, size_t body, const double force[3], const double point[3]) {
  SbBody *b = &a->body[body];
  double arm[3], torque[3];
  for (int k = 0; k < 3; k++) {
    arm[k] = point[k] - b->position[k];
  }
  cross(torque, arm, force);
  for (int k = 0; k < 3; k++) {
    b->force[k] += force[k];
    b->torque[k] += torque[k];
  }
}

void sb_assembly_clear_forces(SbAssembly *a) {
  for (size_t i = 0; i < a->bodies; i++) {
    memset(a->body[i].force, 0, sizeof a->body[i].force);
    memset(a->body[i].torque, 0, sizeof a->body[i].torque);
  }
}

// ---- conditions ----

// Motions that each kind of joint prevents: of its point along the axis, rotation about the axis,
// tilt of the axis. The point is always fixed across the axis.
static const struct {
  const char *name;
  bool along, about, tilt;
} joint_kind[] = {
    [SB_JOINT_FIXED] = {"fixed", true, true, true},
    [SB_JOINT_TRANSLATIONAL] = {"translational", false, true, true},
    [SB_JOINT_REVOLUTE] = {"revolute", true, false, true},
    [SB_JOINT_SPHERICAL] = {"spherical", true, false, false},
    [SB_JOINT_CYLINDRICAL] = {"cylindrical", false, false, true},
};

const char *sb_joint_kind_name(SbJointKind kind) {
  return joint_kind[kind].name;
}

// A joint of bodies i (0) and j (1) at its present position, ground axes.
typedef struct {
  const SbBody *body[2];
  double arm[2][3];     // from the bodies' centres to their points of the joint [m]
  double axes[2][3][3]; // its frame as either body carries it
  double gap[3];        // between the two points [m]
  double length;
} Pose;

// Adds the row e . (motion of i less that of j) with e turning with body j: of the joint's point
// or, if it `turns`, of the bodies' rotation.
static void add_row(Conditions *c, size_t n, const SbJoint *joint, const Pose *p, const double e[3],
                    bool turns, double error) {
  const SbBody *i = p->body[0], *j = p->body[1];
  size_t r = c->rows++, at[2] = {6 * joint->body[0], 6 * joint->body[1]};
  double turned[3], relative[3];
  memset(c->jacobian[r], 0, sizeof c->jacobian[r]);
  c->joint[r] = n;
  c->turns[r] = turns;
  c->error[r] = error;
  cross(turned, j->spin, e);
  for (size_t k = 0; k < 3; k++) {
    c->jacobian[r][at[0] + (turns ? 3 : 0) + k] = e[k];
    c->jacobian[r][at[1] + (turns ? 3 : 0) + k] = -e[k];
    relative[k] = i->spin[k] - j->spin[k];
  }
  c->rate[r] = p->length * dot(turned, relative);
  if (turns) {
    return;
  }
  // From both centres to the point of i, about which e turns.
  double reach[3], moment[2][3], wi[3], wj[3], ci[3], cj[3], twice[3];
  for (int k = 0; k < 3; k++) {
    reach[k] = p->arm[1][k] + p->gap[k];
  }
  cross(moment[0], p->arm[0], e);
  cross(moment[1], reach, e);
  cross(wi, i->spin, p->arm[0]);
  cross(wj, j->spin, p->arm[1]);
  for (size_t k = 0; k < 3; k++) {
    c->jacobian[r][at[0] + 3 + k] = moment[0][k] / p->length;
    c->jacobian[r][at[1] + 3 + k] = -moment[1][k] / p->length;
    relative[k] = i->velocity[k] + wi[k] - j->velocity[k] - wj[k];
  }
  // Second derivative without the accelerations.
  cross(ci, i->spin, wi);
  cross(cj, j->spin, wj);
  cross(twice, j->spin, turned);
  c->rate[r] = dot(e, ci) - dot(e, cj) + 2.0 * dot(turned, relative) + dot(twice, p->gap);
}

void sb_bodies_conditions(Conditions *c, const SbAssembly *a, double length) {
  c->rows = 0;
  for (size_t n = 0; n < a->joints; n++) {
    const SbJoint *joint = &a->joint[n];
    Pose p = {.length = length};
    for (int side = 0; side < 2; side++) {
      p.body[side] = &a->body[joint->body[side]];
      double r[9];
      rotation(r, p.body[side]->orientation);
      turn(p.arm[side], r, joint->point[side]);
      for (int k = 0; k < 3; k++) {
        turn(p.axes[side][k], r, joint->frame[side][k]);
        p.gap[k] += (side == 0 ? 1.0 : -1.0) * (p.body[side]->position[k] + p.arm[side][k]);
      }
    }
    // Small angles of i's frame in j's, about its three axes.
    double(*const e)[3] = p.axes[1];
    const double *axis = p.axes[0][0];
    const double angle[3] = {dot(p.axes[0][1], e[2]), -dot(axis, e[2]), dot(axis, e[1])};
    for (int k = joint_kind[joint->kind].along ? 0 : 1; k < 3; k++) {
      add_row(c, n, joint, &p, e[k], false, dot(e[k], p.gap));
    }
    for (int k = 0; k < 3; k++) {
      if (k == 0 ? joint_kind[joint->kind].about : joint_kind[joint->kind].tilt) {
        add_row(c, n, joint, &p, e[k], true, length * angle[k]);
      }
    }
  }
}

double sb_bodies_extent(const SbAssembly *a) {
  double most = 0.0;
  for (size_t n = 0; n < a->joints; n++) {
    for (int side = 0; side < 2; side++) {
      const double *arm = a->joint[n].point[side];
      most = a->joint[n].body[side] == SB_GROUND ? most : fmax(most, sqrt(dot(arm, arm)));
    }
  }
  return most > 0.0 ? most : 1e-3;
}

size_t sb_bodies_rank(SbAssemblyWork *work, const SbAssembly *a, size_t rows) {
  lapack_int n = 6 * (lapack_int)a->bodies, *pivot = work->pivot;
  for (size_t r = 0; r < rows; r++) {
    pivot[r] = 0;
    memcpy(&work->matrix[r * (size_t)n], work->conditions.jacobian[r], (size_t)n * sizeof(double));
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
  lapack_int n = 6 * (lapack_int)a->bodies;
  memset(motion, 0, (size_t)n * sizeof *motion);
  motion[rank + index] = 1.0;
  // The columns of Q behind the rank are orthogonal to all conditions.
  (void)LAPACKE_dormqr(LAPACK_COL_MAJOR, 'L', 'N', n, 1, (lapack_int)rank, work->matrix, n,
                       work->right, motion, n);
}

// The body that what remains free moves most, judged by how much of its six motions is left.
static size_t freest(const SbAssembly *a, SbAssemblyWork *work, size_t rank) {
  double motion[COLUMNS], left[SB_BODIES_MAX] = {0};
  size_t best = 0;
  for (size_t i = 0; rank + i < 6 * a->bodies; i++) {
    sb_bodies_free_motion(motion, work, a, rank, i);
    for (size_t k = 0; k < 6 * a->bodies; k++) {
      left[k / 6] += motion[k] * motion[k];
    }
  }
  for (size_t b = 1; b < a->bodies; b++) {
    best = left[b] > left[best] ? b : best;
  }
  return best;
}

SbStatus sb_assembly_mobility(SbMobility *m, const SbAssembly *a, int expected,
                              SbAssemblyWork *work, SbReport *report) {
  Conditions *c = &work->conditions;
  sb_bodies_conditions(c, a, sb_bodies_extent(a));
  size_t rank = sb_bodies_rank(work, a, c->rows);
  int columns = 6 * (int)a->bodies, rows = (int)c->rows;
  *m = (SbMobility){.constraints = rows,
                    .gruebler = columns - rows,
                    .redundant = rows - (int)rank,
                    .freedom = columns - (int)rank};
  int n = snprintf(m->text, sizeof m->text, "%zu parts, %d constraints, %d degree%s of freedom",
                   a->bodies + 1, rows, m->freedom, m->freedom == 1 ? "" : "s");
  char *more = m->text + n;
  size_t room = sizeof m->text - (size_t)n;
  if (m->redundant > 0) {
    // The first row that those before it imply.
    size_t r = 1;
    while (sb_bodies_rank(work, a, r) == r) {
      r++;
    }
    const SbJoint *joint = &a->joint[c->joint[r - 1]];
    snprintf(more, room,
             "; over-constrained: %d condition%s repeated, first by the %s joint of '%s' and '%s'",
             m->redundant, m->redundant == 1 ? " is" : "s are", sb_joint_kind_name(joint->kind),
             a->body[joint->body[0]].name, a->body[joint->body[1]].name);
  } else if (expected >= 0 && m->freedom > expected) {
    snprintf(more, room, "; under-constrained: %d expected, '%s' is the freest part", expected,
             a->body[freest(a, work, rank)].name);
  } else if (expected >= 0 && m->freedom < expected) {
    snprintf(more, room, "; over-constrained: %d expected", expected);
  } else {
    return sb_succeed(report);
  }
  return sb_fail(report, SB_ERROR_INFEASIBLE, "%s", m->text);
}

// ---- the valve ----

static const struct {
  const char *name;
  double x; // of the centre [m]
} valve_parts[SB_VALVE_PARTS] = {{"valve housing", 0.0},     {"stem centre", 0.0},
                                 {"stem top", 10e-3},        {"stem bottom", -12e-3},
                                 {"inner seal", 3e-3},       {"outer seal", -3e-3},
                                 {"actuating block", -20e-3}};

const char *sb_valve_part_name(int part) {
  return valve_parts[part].name;
}

SbStatus sb_assembly_valve(SbAssembly *a, const SbValveParts *parts, SbReport *report) {
  static const struct {
    size_t i, j;
    double x;
  } joint[SB_VALVE_JOINTS] = {
      {SB_VALVE_HOUSING, SB_GROUND, 0.0},
      {SB_VALVE_STEM_CENTRE, SB_VALVE_STEM_TOP, 5e-3},
      {SB_VALVE_STEM_BOTTOM, SB_VALVE_STEM_CENTRE, -6e-3},
      {SB_VALVE_INNER_SEAL, SB_VALVE_STEM_CENTRE, 3e-3},
      {SB_VALVE_OUTER_SEAL, SB_VALVE_STEM_CENTRE, -3e-3},
      {SB_VALVE_BLOCK, SB_VALVE_STEM_BOTTOM, -19e-3},
      {SB_VALVE_BLOCK, SB_GROUND, -20e-3},
  };
  const double axis[3] = {1.0, 0.0, 0.0};
  SbStatus status = SB_OK;
  sb_assembly_start(a);
  for (int i = 0; i < SB_VALVE_PARTS && status == SB_OK; i++) {
    const SbValvePart *part = &parts->part[i];
    double at[3] = {valve_parts[i].x, 0.0, 0.0};
    double inertia[3] = {part->axial, part->transverse, part->transverse};
    status = sb_assembly_add(a, valve_parts[i].name, part->mass, inertia, at, report);
  }
  for (int i = 0; i < SB_VALVE_JOINTS && status == SB_OK; i++) {
    double at[3] = {joint[i].x, 0.0, 0.0};
    if (parts->joint[i] != SB_JOINT_NONE) {
      status = sb_assembly_join(a, (SbJointKind)parts->joint[i], joint[i].i, joint[i].j, at, axis,
                                report);
    }
  }
  return status;
}
