#include "engine/valve/studies/hold.h"

#include "engine/valve/model/model.h"
#include "engine/valve/run/valve_type.h"

#include <string.h>

const char *sb_hold_names(void) {
#define HOLD_NAME(code, name, help) ", " name
  static const char names[] = SB_HOLDS(HOLD_NAME);
#undef HOLD_NAME
  return names + 2;
}

bool sb_hold_from_name(SbHold *out, const char *name) {
  static const char *const names[SB_HOLD_COUNT] = {
#define HOLD_NAME(code, name, help) [code] = name,
      SB_HOLDS(HOLD_NAME)
#undef HOLD_NAME
  };
  for (int i = 0; i < SB_HOLD_COUNT; i++) {
    if (strcmp(names[i], name) == 0) {
      *out = (SbHold)i;
      return true;
    }
  }
  return false;
}

SbStatus sb_model_hold(SbModel **out, const SbModel *scene, SbHold hold, SbReport *report) {
  const SbSealModel *ring = &scene->seal[SB_OUTER];
  const SbOverride machine[] = {
      {SB_P_MODELS_MOTION, SB_MODEL_MOTION_QUASI_STATIC},
      {SB_P_DRIVE_KIND, SB_MODEL_DRIVE_MACHINE},
      // Options that only the motion with inertia has.
      {SB_P_DRIVE_CYCLES, 1},
      {SB_P_FRICTION_DWELL_GAIN, 0},
      {SB_P_FRICTION_STRIBECK_SPEED, 0},
      {SB_P_FRICTION_TANGENTIAL_STIFFNESS, 0},
      {SB_P_CANISTER_PRESSURE_MAP,
       scene->pressure_map == SB_MAP_PORTS ? SB_MAP_CHAMBER_VENTED : scene->pressure_map},
  };
  const SbOverride outer[] = {
      {SB_P_STORAGE_TIME, 0},
      {SB_P_STORAGE_TEMPERATURE, scene->rubber.reference_temperature},
      // Quantities at the temperature of use.
      {SB_P_CANISTER_TEMPERATURE, SB_SIZES_TEMPERATURE},
      {SB_P_GLAND_RADIAL_SPACE, scene->radial_space},
      {SB_P_BORE_DIAMETER, scene->bore_diameter},
      {SB_P_CANISTER_PRESSURE, scene->canister_pressure},
      {SB_P_FLUID_VISCOSITY, scene->viscosity},
      {SB_P_FLUID_DENSITY, scene->density},
      {SB_P_SEAL_OUTER_SECTION_DIAMETER, ring->section_diameter},
      {SB_P_SEAL_OUTER_INNER_DIAMETER, ring->inner_diameter},
      {SB_P_SEAL_OUTER_MODULUS, ring->modulus},
      {SB_P_SEAL_INNER_SECTION_DIAMETER, ring->section_diameter},
      {SB_P_SEAL_INNER_INNER_DIAMETER, ring->inner_diameter},
      {SB_P_SEAL_INNER_MODULUS, ring->modulus},
      {SB_P_CANISTER_PRESSURE_MAP, SB_MAP_CHAMBER_FILLED},
  };
  if (hold == SB_HOLD_MACHINE) {
    return sb_model_derive(out, scene, machine, sizeof machine / sizeof machine[0], report);
  }
  if (hold == SB_HOLD_OUTER && sb_valve_type(scene)->no_gland != NULL) {
    return sb_fail_input(report, SB_ERROR_INPUT, sb_input(SB_P_VALVE_KIND),
                         "outer-seal is of rings in their grooves; a gasket valve has none");
  }
  if (hold == SB_HOLD_OUTER) {
    return sb_model_derive(out, scene, outer, sizeof outer / sizeof outer[0], report);
  }
  // As if the scene gave none of them.
  static const SbParamId follow[] = {SB_P_CANISTER_PRESSURE, SB_P_FLUID_VISCOSITY,
                                     SB_P_FLUID_DENSITY};
  SbModel *copy;
  SbStatus status = sb_model_copy(&copy, scene);
  if (status != SB_OK) {
    return sb_fail(report, status, "no memory for a model");
  }
  for (size_t i = 0; i < sizeof follow / sizeof follow[0]; i++) {
    copy->params.given[follow[i]] = false;
  }
  status = sb_model_derive(out, copy, NULL, 0, report);
  sb_model_destroy(copy);
  return status;
}
