// The thesis' valve as an assembly. See bodies.h.
#include "engine/mechanism/bodies_internal.h"

#include <math.h>
#include <string.h>

static const struct {
  const char *name;
  double x; // of the centre [m]
} valve_parts[SB_VALVE_GROUND] = {{"valve housing", 0.0},     {"stem centre", 0.0},
                                  {"stem top", 10e-3},        {"stem bottom", -12e-3},
                                  {"inner seal", 3e-3},       {"outer seal", -3e-3},
                                  {"actuating block", -20e-3}};

const char *sb_valve_part_name(int part) {
  return part == SB_VALVE_GROUND ? "ground" : valve_parts[part].name;
}

SbStatus sb_assembly_valve(SbAssembly *a, const SbValveParts *parts, SbReport *report) {
  static const struct {
    size_t i, j;
    double x;
  } joint[SB_VALVE_JOINTS] = {
      {SB_VALVE_HOUSING, SB_VALVE_GROUND, 0.0},
      {SB_VALVE_STEM_CENTRE, SB_VALVE_STEM_TOP, 5e-3},
      {SB_VALVE_STEM_BOTTOM, SB_VALVE_STEM_CENTRE, -6e-3},
      {SB_VALVE_INNER_SEAL, SB_VALVE_STEM_CENTRE, 3e-3},
      {SB_VALVE_OUTER_SEAL, SB_VALVE_STEM_CENTRE, -3e-3},
      {SB_VALVE_BLOCK, SB_VALVE_STEM_BOTTOM, -19e-3},
      {SB_VALVE_BLOCK, SB_VALVE_GROUND, -20e-3},
  };
  const double axis[3] = {1.0, 0.0, 0.0};
  *a = (SbAssembly){0};
  SbStatus status = SB_OK;
  for (int i = 0; i < SB_VALVE_GROUND && status == SB_OK; i++) {
    const SbValvePart *part = &parts->part[i];
    double at[3] = {valve_parts[i].x, 0.0, 0.0};
    double inertia[3] = {part->axial, part->transverse, part->transverse};
    status = sb_assembly_add(a, NULL, valve_parts[i].name, part->mass, inertia, at, report);
  }
  if (status == SB_OK) {
    status = sb_assembly_add_ground(a, NULL, report);
  }
  for (int i = 0; i < SB_VALVE_JOINTS && status == SB_OK; i++) {
    double at[3] = {joint[i].x, 0.0, 0.0};
    if (parts->joint[i] != SB_JOINT_NONE) {
      status = sb_assembly_join(a, NULL, (SbJointKind)parts->joint[i], joint[i].i, joint[i].j, at,
                                axis, report);
    }
  }
  return status;
}
