// Parts and joints of an assembly. See bodies.h.
#include "engine/mechanism/bodies.h"
#include "engine/mechanism/vector3.h"

#include <stdio.h>

static bool finite3(const double a[3]) {
  return isfinite(a[0]) && isfinite(a[1]) && isfinite(a[2]);
}

SbStatus sb_assembly_add(SbAssembly *a, size_t *index, const char *name, double mass,
                         const double inertia[3], const double position[3], SbReport *report) {
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
  SbBody *b = &a->body[a->bodies];
  *b = (SbBody){.mass = mass, .orientation = {1.0, 0.0, 0.0, 0.0}};
  snprintf(b->name, sizeof b->name, "%s", name);
  memcpy(b->inertia, inertia, sizeof b->inertia);
  memcpy(b->position, position, sizeof b->position);
  if (index != NULL) {
    *index = a->bodies;
  }
  a->bodies++;
  return sb_succeed(report);
}

SbStatus sb_assembly_add_ground(SbAssembly *a, size_t *index, SbReport *report) {
  const double one[3] = {1.0, 1.0, 1.0}, origin[3] = {0};
  size_t at;
  SbStatus status = sb_assembly_add(a, &at, "ground", 1.0, one, origin, report);
  if (status == SB_OK) {
    a->body[at].ground = true;
    if (index != NULL) {
      *index = at;
    }
  }
  return status;
}

SbStatus sb_assembly_join(SbAssembly *a, size_t *index, SbJointKind kind, size_t i, size_t j,
                          const double point[3], const double axis[3], SbReport *report) {
  if (a->joints >= SB_JOINTS_MAX) {
    return sb_fail(report, SB_ERROR_RANGE, "no more than %d joints", SB_JOINTS_MAX);
  }
  if (i >= a->bodies || j >= a->bodies || i == j) {
    return sb_fail(report, SB_ERROR_INPUT, "a joint needs two different parts");
  }
  double along[3] = {1.0, 0.0, 0.0};
  if (kind != SB_JOINT_FIXED) {
    double size = sqrt(dot(axis, axis));
    if (!(size > 0.0) || !isfinite(size)) {
      return sb_fail(report, SB_ERROR_INPUT, "the joint of '%s' and '%s' needs an axis",
                     a->body[i].name, a->body[j].name);
    }
    for (int k = 0; k < 3; k++) {
      along[k] = axis[k] / size;
    }
  }
  SbJoint *joint = &a->joint[a->joints];
  *joint = (SbJoint){.kind = kind, .i = i, .j = j};
  memcpy(joint->point, point, sizeof joint->point);
  memcpy(joint->axis, along, sizeof joint->axis);
  // A frame whose first axis is the joint's, kept in body j.
  double e1[3], e2[3], helper[3] = {0};
  helper[fabs(along[0]) < 0.6 ? 0 : 1] = 1.0;
  cross(e1, along, helper);
  double size = sqrt(dot(e1, e1));
  for (int k = 0; k < 3; k++) {
    e1[k] /= size;
  }
  cross(e2, along, e1);
  double ri[9], rj[9], arm[3];
  rotation(ri, a->body[i].orientation);
  rotation(rj, a->body[j].orientation);
  for (int k = 0; k < 3; k++) {
    arm[k] = point[k] - a->body[i].position[k];
  }
  turn_back(joint->local_i, ri, arm);
  for (int k = 0; k < 3; k++) {
    arm[k] = point[k] - a->body[j].position[k];
  }
  turn_back(joint->local_j, rj, arm);
  turn_back(joint->frame_j, rj, along);
  turn_back(joint->frame_j + 3, rj, e1);
  turn_back(joint->frame_j + 6, rj, e2);
  const double *q = a->body[j].orientation, back[4] = {q[0], -q[1], -q[2], -q[3]};
  multiply(joint->twist, back, a->body[i].orientation);
  if (index != NULL) {
    *index = a->joints;
  }
  a->joints++;
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
