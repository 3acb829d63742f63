// The valve's constrained parts in a run: their freedom, the mass that the stroke sees, and what
// each joint bears at every frame.
//
// The parts of thesis table 4.1 in the joints of table 4.3 slide along one axis and do not turn, so
// that mass matrix and conditions are the same at every place: accelerations and multipliers
// (motion/bodies.h) are linear in the loads with constant coefficients. They are solved once for a
// unit of each load and added up for a frame. The loads act where they arise: the drive on the
// block, friction on each seal, pressure and return spring on the stem top, the stops on the stem
// bottom; all but the drive push the housing (with the canister, which is sealed to it) back.
// Every frame's accelerations of all moving parts are compared with the stroke's.
#include "engine/run_dynamic.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { DRIVE, INNER_FRICTION, OUTER_FRICTION, PRESSURE, STOPS, LOADS };

static const size_t loaded[LOADS] = {SB_VALVE_BLOCK, SB_VALVE_INNER_SEAL, SB_VALVE_OUTER_SEAL,
                                     SB_VALVE_STEM_TOP, SB_VALVE_STEM_BOTTOM};

struct SbRunBodies {
  SbAssembly assembly;
  double mass;
  SbAssemblyForces unit[LOADS]; // answers to 1 N
  SbReaction *reaction;         // [frames][joints]
};

SbStatus sb_run_bodies_create(SbRun *run, SbReport *report) {
  SbBodiesSummary *summary = &run->summary.bodies;
  sb_run_bodies_destroy(run->bodies);
  SbRunBodies *bodies = calloc(1, sizeof *bodies);
  run->bodies = bodies;
  if (bodies == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the valve's parts");
  }
  SbAssembly *assembly = &bodies->assembly;
  SbMobility mobility;
  const double axis[3] = {1, 0, 0};
  const double back[3] = {-1, 0, 0};
  SbStatus status = sb_assembly_valve(assembly, &run->model.parts, report);
  status = status != SB_OK ? status : sb_assembly_mobility(&mobility, assembly, 1, report);
  status = status != SB_OK
               ? status
               : sb_assembly_effective_mass(&bodies->mass, assembly, SB_VALVE_BLOCK, axis, report);
  for (int load = 0; load < LOADS && status == SB_OK; load++) {
    sb_assembly_clear_forces(assembly);
    sb_assembly_apply(assembly, loaded[load], axis, assembly->body[loaded[load]].position);
    if (load != DRIVE) {
      sb_assembly_apply(assembly, SB_VALVE_HOUSING, back,
                        assembly->body[SB_VALVE_HOUSING].position);
    }
    status = sb_assembly_forces(&bodies->unit[load], assembly, report);
  }
  if (status != SB_OK) {
    return status;
  }
  bodies->reaction = malloc(run->capacity * assembly->joints * sizeof *bodies->reaction);
  if (bodies->reaction == NULL) {
    return sb_fail_parameter(report, SB_ERROR_MEMORY, "output.frames",
                             "no memory for the joints' reactions of %d frames", run->model.frames);
  }
  summary->gruebler = mobility.gruebler;
  summary->constraints = mobility.constraints;
  summary->freedom = mobility.freedom;
  snprintf(summary->text, sizeof summary->text, "%s", mobility.text);
  summary->moving_mass = bodies->mass;
  summary->joints = assembly->joints;
  for (size_t i = 0; i < assembly->joints; i++) {
    SbJointSummary *joint = &summary->joint[i];
    *joint = (SbJointSummary){.axial_min = INFINITY, .axial_max = -INFINITY};
    snprintf(joint->name, sizeof joint->name, "%s, %s", assembly->body[assembly->joint[i].i].name,
             assembly->body[assembly->joint[i].j].name);
    snprintf(joint->kind, sizeof joint->kind, "%s", sb_joint_kind_name(assembly->joint[i].kind));
  }
  return SB_OK;
}

void sb_run_bodies_destroy(SbRunBodies *bodies) {
  if (bodies != NULL) {
    free(bodies->reaction);
    free(bodies);
  }
}

double sb_run_bodies_mass(const SbRunBodies *bodies) {
  return bodies->mass;
}

void sb_run_bodies_frame(SbRun *run, size_t index, const SbDynamicsSample *sample) {
  const SbRunBodies *bodies = run->bodies;
  SbBodiesSummary *summary = &run->summary.bodies;
  const double load[LOADS] = {
      [DRIVE] = sample->drive_force,
      [INNER_FRICTION] = sample->friction[SB_INNER],
      [OUTER_FRICTION] = sample->friction[SB_OUTER],
      [PRESSURE] = sample->loads_force + sample->spring_force,
      [STOPS] = sample->stop_force[SB_REST_STOP] - sample->stop_force[SB_END_STOP],
  };
  for (size_t i = 0; i < summary->joints; i++) {
    SbReaction *out = &bodies->reaction[index * summary->joints + i];
    *out = (SbReaction){0};
    for (int k = 0; k < LOADS; k++) {
      const SbReaction *unit = &bodies->unit[k].reaction[i];
      for (int axis = 0; axis < 3; axis++) {
        out->force[axis] += load[k] * unit->force[axis];
        out->torque[axis] += load[k] * unit->torque[axis];
      }
    }
    SbJointSummary *joint = &summary->joint[i];
    joint->axial_min = fmin(joint->axial_min, out->force[0]);
    joint->axial_max = fmax(joint->axial_max, out->force[0]);
    joint->transverse_max = fmax(joint->transverse_max, hypot(out->force[1], out->force[2]));
    joint->torque_max =
        fmax(joint->torque_max, hypot(out->torque[0], hypot(out->torque[1], out->torque[2])));
  }

  // All moving parts must do what the stroke does.
  double size = 0;
  for (int k = 0; k < LOADS; k++) {
    size += fabs(load[k]);
  }
  for (size_t b = SB_VALVE_STEM_CENTRE; b <= SB_VALVE_BLOCK && size > 0; b++) {
    double acceleration = 0;
    for (int k = 0; k < LOADS; k++) {
      acceleration += load[k] * bodies->unit[k].acceleration[b][0];
    }
    double miss = fabs(acceleration - sample->acceleration) * bodies->mass / size;
    summary->acceleration_error = fmax(summary->acceleration_error, miss);
  }
}

const SbReaction *sb_run_reactions(const SbRun *run, size_t frame) {
  const SbRunBodies *bodies = run->bodies;
  return bodies != NULL && bodies->reaction != NULL
             ? &bodies->reaction[frame * run->summary.bodies.joints]
             : NULL;
}
