// What a model takes from its parameters as they stand; what follows from them and what does not go
// together is model.c.
#include "engine/valve/model_private.h"

#include <math.h>

#define VALUE(id) sb_params_get(params, SB_P_##id)

static SbRubber read_rubber(const SbParams *params, double fluid_density) {
  return (SbRubber){
      .reference_temperature = VALUE(RUBBER_REFERENCE_TEMPERATURE),
      .terms = 3,
      .g = {VALUE(RUBBER_RELAXATION_SHARE_1), VALUE(RUBBER_RELAXATION_SHARE_2),
            VALUE(RUBBER_RELAXATION_SHARE_3)},
      .tau = {VALUE(RUBBER_RELAXATION_TIME_1), VALUE(RUBBER_RELAXATION_TIME_2),
              VALUE(RUBBER_RELAXATION_TIME_3)},
      .shift = (SbShift)VALUE(RUBBER_SHIFT),
      .wlf_c1 = VALUE(RUBBER_WLF_C1),
      .wlf_c2 = VALUE(RUBBER_WLF_C2),
      .relaxation_energy = VALUE(RUBBER_RELAXATION_ENERGY),
      .entropic = VALUE(RUBBER_ENTROPIC) != 0.0,
      .thermal_expansion = VALUE(RUBBER_THERMAL_EXPANSION),
      .network_rate = VALUE(RUBBER_NETWORK_RATE),
      .network_energy = VALUE(RUBBER_NETWORK_ENERGY),
      .network_reform = VALUE(RUBBER_NETWORK_REFORM),
      .swell_mass = VALUE(RUBBER_SWELL_MASS),
      .rubber_density = VALUE(RUBBER_DENSITY),
      .fluid_density = fluid_density,
      .diffusion = VALUE(RUBBER_DIFFUSION),
      .diffusion_energy = VALUE(RUBBER_DIFFUSION_ENERGY),
      .swell_modulus = VALUE(RUBBER_SWELL_MODULUS),
  };
}

// The rig's rings obey the friction.* keys: the static ratio, its growth with rest, the loss with
// speed and the shear stiffness of one ring. Dampers as drive.damping_ratio says.
static SbRig read_rig(const SbModel *model, const SbParams *params) {
  SbRig rig = {
      .load = VALUE(RIG_LOAD),
      .mass = VALUE(RIG_MASS),
      .coefficient = VALUE(RIG_COEFFICIENT),
      .speed = VALUE(RIG_SPEED),
      .thread_stiffness = VALUE(RIG_THREAD_STIFFNESS),
      .duration = VALUE(RIG_DURATION),
      .rate = VALUE(RIG_RATE),
      .rest = model->rest,
      .contact = {.static_ratio = model->static_ratio,
                  .dwell_gain = model->dwell_gain,
                  .dwell_time = model->dwell_time,
                  .stribeck_speed = model->stribeck_speed,
                  .stribeck_exponent = 1,
                  .stiffness = INFINITY},
  };
  rig.thread_damping = model->damping_ratio * 2 * sqrt(rig.thread_stiffness * rig.mass);
  if (model->tangential_stiffness > 0) {
    rig.contact.stiffness = model->tangential_stiffness;
    rig.contact.damping =
        model->damping_ratio * 2 * sqrt(model->tangential_stiffness * rig.mass / SB_RIG_RINGS);
  }
  return rig;
}

void sb_model_read(SbModel *model, const SbParams *params) {
  model->params = *params;
#define SB_MODEL_FIELD(type, name, id) model->name = (type)VALUE(id);
#define SB_MODEL_MEMBER                SB_MODEL_FIELD
#include "engine/valve/model.def"
  model->pressure_viscosity = VALUE(MODELS_VISCOSITY) > 0 ? VALUE(FLUID_PRESSURE_VISCOSITY) : 0;
  model->surface = VALUE(MODELS_SURFACE) > 0 ? SB_ROUGH_PERSSON : SB_ROUGH_GREENWOOD_TRIPP;
  model->hamaker = VALUE(MODELS_ADHESION) > 0 ? VALUE(SURFACE_HAMAKER_CONSTANT) : 0;
  model->look.full = VALUE(OUTPUT_SECTION) == 1;
  model->look.cutaway = VALUE(OUTPUT_SECTION) == 2;
  model->rubber = read_rubber(params, model->density);
  model->rig = read_rig(model, params);
  model->life_shown = model->life_shown > 0 ? model->life_shown : model->life_actuations;
  model->running_in = (SbRunningIn){
      .start = VALUE(LIFE_ROUGHNESS_NEW),
      .end = VALUE(LIFE_ROUGHNESS_RUN_IN),
      .actuations = VALUE(LIFE_RUNNING_IN),
  };
  model->bore_circumference = M_PI * model->bore_diameter;
  model->pressure_force =
      model->canister_pressure * M_PI / 4 * model->stem_diameter * model->stem_diameter;
}
