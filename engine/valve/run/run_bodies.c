// The valve's constrained parts in a run: their motion under the joints' conditions, and the joint
// reactions at every frame.
//
// The parts of thesis table 4.1 in the joints of table 4.3. At the start of every segment of the
// motion (mechanism/dynamics.h) all parts are moved to the stem's position, onto the joints, and
// the Jacobian of the joints' conditions is factorised there. Its null vector is the remaining
// motion and gives the effective mass of the stroke. The parts must move together, so that each
// force counts fully. The loads act at their parts: the drive on the block, friction on each seal,
// pressure and return spring on the stem top, the stops on the stem bottom; the reactions of all
// but the drive act on the housing (with the canister, which is sealed to it). At every frame the
// multipliers' system is solved with the loads on their parts, for the reactions, and every moving
// part's acceleration is compared with the stroke's. Parts that move relative to each other by
// levers are refused, because dynamics.h does not have their loads.
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DRIVE, INNER_FRICTION, OUTER_FRICTION, PRESSURE, STOPS, LOADS };

static const size_t loaded[LOADS] = {SB_VALVE_BLOCK, SB_VALVE_INNER_SEAL, SB_VALVE_OUTER_SEAL,
                                     SB_VALVE_STEM_TOP, SB_VALVE_STEM_BOTTOM};

struct SbRunBodies {
  SbAssembly assembly;       // at the last stem displacement
  SbAssemblyTangent tangent; // there
  double at;                 // that displacement [m]
  double mass;               // as assembled [kg]
  SbReaction *reaction;      // [frames][joints]
  SbAssemblyWork work;
};

static const double axis[3] = {1, 0, 0};

SbStatus sb_run_bodies_move(double *mass, SbRun *run, double x, double v, SbReport *report) {
  SbRunBodies *bodies = run->bodies;
  const SbAssemblyTangent *tangent = &bodies->tangent;
  double error;
  SbStatus status = sb_assembly_slide(&bodies->assembly, &bodies->tangent, x - bodies->at, v,
                                      &error, &bodies->work, report);
  if (status != SB_OK) {
    return status;
  }
  bodies->at = x;
  run->summary.bodies.joint_error = fmax(run->summary.bodies.joint_error, error);
  for (int load = 0; load < LOADS; load++) {
    // Travel of what feels a load, per the stem's: what 1 N counts there by virtual work.
    double housing = load == DRIVE ? 0 : tangent->velocity[SB_VALVE_HOUSING][0];
    double travel = tangent->velocity[loaded[load]][0] - housing;
    if (fabs(travel - 1) > 1e-9) {
      return sb_fail_input(
          report, SB_ERROR_INFEASIBLE, sb_input(SB_P_MODELS_MOTION),
          "'%s' moves %.9g times as far as the stem: the parts must have one displacement",
          bodies->assembly.body[loaded[load]].name, travel);
    }
  }
  if (fabs(tangent->mass - bodies->mass) > 1e-9 * bodies->mass) {
    return sb_fail_input(report, SB_ERROR_INFEASIBLE, sb_input(SB_P_MODELS_MOTION),
                         "the mass that the stroke sees changes from %.9g to %.9g kg", bodies->mass,
                         tangent->mass);
  }
  *mass = tangent->mass;
  return SB_OK;
}

SbStatus sb_run_bodies_create(SbRun *run, SbReport *report) {
  SbBodiesSummary *summary = &run->summary.bodies;
  SbRunBodies *bodies = calloc(1, sizeof *bodies);
  run->bodies = bodies;
  if (bodies == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the valve's parts");
  }
  SbAssembly *assembly = &bodies->assembly;
  SbMobility mobility;
  SbStatus status = sb_assembly_valve(assembly, &run->model->parts, report);
  status = status != SB_OK ? status
                           : sb_assembly_mobility(&mobility, assembly, 1, &bodies->work, report);
  status = status != SB_OK ? status
                           : sb_assembly_tangent(&bodies->tangent, assembly, SB_VALVE_STEM_CENTRE,
                                                 axis, &bodies->work, report);
  if (status != SB_OK) {
    return status;
  }
  bodies->reaction = malloc(run->capacity * assembly->joints * sizeof *bodies->reaction);
  if (bodies->reaction == NULL) {
    return sb_fail_input(report, SB_ERROR_MEMORY, sb_input(SB_P_OUTPUT_FRAMES),
                         "no memory for the joints' reactions of %d frames", run->plan.frames);
  }
  bodies->mass = bodies->tangent.mass;
  summary->joint_error = 0;
  summary->acceleration_error = 0;
  summary->gruebler = mobility.gruebler;
  summary->constraints = mobility.constraints;
  summary->freedom = mobility.freedom;
  snprintf(summary->text, sizeof summary->text, "%s", mobility.text);
  summary->moving_mass = bodies->mass;
  summary->joints = assembly->joints;
  for (size_t i = 0; i < assembly->joints; i++) {
    SbJointSummary *joint = &summary->joint[i];
    *joint = (SbJointSummary){.axial_min = INFINITY, .axial_max = -INFINITY};
    snprintf(joint->name, sizeof joint->name, "%s, %s",
             assembly->body[assembly->joint[i].body[0]].name,
             assembly->body[assembly->joint[i].body[1]].name);
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

SbStatus sb_run_bodies_frame(SbRun *run, size_t index, const SbDynamicsSample *sample,
                             SbReport *report) {
  SbRunBodies *bodies = run->bodies;
  SbAssembly *assembly = &bodies->assembly;
  SbBodiesSummary *summary = &run->summary.bodies;
  // Friction of the frame; that of the motion is linear in bands of speed.
  const SbSealFrame *seal = run->frames[index].seal;
  const double inner = -seal[SB_INNER].friction, outer = -seal[SB_OUTER].friction;
  const double more = inner + outer - sample->friction[SB_INNER] - sample->friction[SB_OUTER];
  const double load[LOADS] = {
      [DRIVE] = sample->drive_force,
      [INNER_FRICTION] = inner,
      [OUTER_FRICTION] = outer,
      [PRESSURE] = sample->loads_force + sample->spring_force,
      [STOPS] = sample->stop_force[SB_REST_STOP] - sample->stop_force[SB_END_STOP],
  };
  double mass;
  SbStatus status = sb_run_bodies_move(&mass, run, sample->position, sample->speed, report);
  if (status != SB_OK) {
    return status;
  }
  double size = 0;
  sb_assembly_clear_forces(assembly);
  for (int k = 0; k < LOADS; k++) {
    const double force[3] = {load[k], 0, 0}, back[3] = {-load[k], 0, 0};
    sb_assembly_apply(assembly, loaded[k], force, assembly->body[loaded[k]].position);
    if (k != DRIVE) {
      sb_assembly_apply(assembly, SB_VALVE_HOUSING, back,
                        assembly->body[SB_VALVE_HOUSING].position);
    }
    size += fabs(load[k]);
  }
  SbAssemblyForces forces;
  status = sb_assembly_forces(&forces, assembly, &bodies->work, report);
  if (status != SB_OK) {
    return status;
  }
  memcpy(&bodies->reaction[index * summary->joints], forces.reaction,
         summary->joints * sizeof *forces.reaction);
  for (size_t i = 0; i < summary->joints; i++) {
    const SbReaction *at = &forces.reaction[i];
    SbJointSummary *joint = &summary->joint[i];
    joint->axial_min = fmin(joint->axial_min, at->force[0]);
    joint->axial_max = fmax(joint->axial_max, at->force[0]);
    joint->transverse_max = fmax(joint->transverse_max, hypot(at->force[1], at->force[2]));
    joint->torque_max =
        fmax(joint->torque_max, hypot(at->torque[0], hypot(at->torque[1], at->torque[2])));
  }
  for (size_t b = SB_VALVE_STEM_CENTRE; b <= SB_VALVE_BLOCK && size > 0; b++) {
    double off = forces.acceleration[b][0] - sample->acceleration;
    double miss = fabs(off * bodies->mass - more) / size;
    summary->acceleration_error = fmax(summary->acceleration_error, miss);
  }
  return SB_OK;
}

void sb_run_bodies_show(SbRun *run, size_t at, const SbRun *from, size_t count) {
  size_t joints = run->summary.bodies.joints;
  if (run->bodies != NULL && from->bodies != NULL) {
    memcpy(&run->bodies->reaction[at * joints], from->bodies->reaction,
           count * joints * sizeof *from->bodies->reaction);
  }
}

const SbReaction *sb_run_reactions(const SbRun *run, size_t frame) {
  const SbRunBodies *bodies = run->bodies;
  return bodies != NULL && bodies->reaction != NULL
             ? &bodies->reaction[frame * run->summary.bodies.joints]
             : NULL;
}
