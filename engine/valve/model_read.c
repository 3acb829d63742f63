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
  model->radial_space = VALUE(GLAND_RADIAL_SPACE);
  model->axial_width = VALUE(GLAND_AXIAL_WIDTH);
  model->bore_diameter = VALUE(BORE_DIAMETER);
  model->radial_space_tolerance = VALUE(GLAND_RADIAL_SPACE_TOLERANCE);
  model->axial_width_tolerance = VALUE(GLAND_AXIAL_WIDTH_TOLERANCE);
  model->bore_diameter_tolerance = VALUE(BORE_DIAMETER_TOLERANCE);
  model->stem_diameter_tolerance = VALUE(STEM_PRESSURE_DIAMETER_TOLERANCE);
  model->land_edge = VALUE(BORE_LAND_EDGE);
  model->housing_modulus = VALUE(HOUSING_MODULUS);
  model->housing_poisson_ratio = VALUE(HOUSING_POISSON_RATIO);
  model->canister_pressure = VALUE(CANISTER_PRESSURE);
  model->pressure_map = (SbPressureMap)VALUE(CANISTER_PRESSURE_MAP);
  model->stem_mass = VALUE(STEM_MASS);
  model->viscosity = VALUE(FLUID_VISCOSITY);
  model->pressure_viscosity = VALUE(MODELS_VISCOSITY) > 0 ? VALUE(FLUID_PRESSURE_VISCOSITY) : 0;
  model->eyring_stress = VALUE(FLUID_EYRING_STRESS);
  model->rupture_pressure = VALUE(FLUID_RUPTURE_PRESSURE);
  model->inlet_carried = VALUE(MODELS_INLET) > 0;
  model->density = VALUE(FLUID_DENSITY);
  model->gt_product = VALUE(SURFACE_GT_PRODUCT);
  model->sigma = VALUE(SURFACE_SIGMA);
  model->sigma_over_beta = VALUE(SURFACE_SIGMA_OVER_BETA);
  model->hamaker_constant = VALUE(SURFACE_HAMAKER_CONSTANT);
  model->shear_strength = VALUE(FRICTION_SHEAR_STRENGTH);
  model->load_coefficient = VALUE(FRICTION_LOAD_COEFFICIENT);
  model->static_ratio = VALUE(FRICTION_STATIC_RATIO);
  model->speed = VALUE(DRIVE_SPEED);
  model->stroke = VALUE(DRIVE_STROKE);
  model->reversal_force = VALUE(DRIVE_REVERSAL_FORCE);
  model->stiffness = VALUE(DRIVE_STIFFNESS);
  model->drive = (SbDriveChoice)VALUE(DRIVE_KIND);
  model->peak_force = VALUE(DRIVE_PEAK_FORCE);
  model->rise_time = VALUE(DRIVE_RISE_TIME);
  model->hold_time = VALUE(DRIVE_HOLD_TIME);
  model->finger_damping = VALUE(DRIVE_FINGER_DAMPING);
  model->amplitude = VALUE(DRIVE_AMPLITUDE);
  model->frequency = VALUE(DRIVE_FREQUENCY);
  model->cycles = (int)VALUE(DRIVE_CYCLES);
  model->damping_ratio = VALUE(DRIVE_DAMPING_RATIO);
  model->rest = VALUE(DRIVE_REST);
  model->dwell_gain = VALUE(FRICTION_DWELL_GAIN);
  model->dwell_time = VALUE(FRICTION_DWELL_TIME);
  model->stribeck_speed = VALUE(FRICTION_STRIBECK_SPEED);
  model->tangential_stiffness = VALUE(FRICTION_TANGENTIAL_STIFFNESS);
  model->stop_stiffness = VALUE(HOUSING_STOP_STIFFNESS);
  model->stop_restitution = VALUE(HOUSING_STOP_RESTITUTION);
  model->spring_stiffness = VALUE(STEM_SPRING_STIFFNESS);
  model->spring_preload = VALUE(STEM_SPRING_PRELOAD);
  model->chamber_at_once = VALUE(CHAMBER_FLOW) != 0;
  model->discharge_coefficient = VALUE(CHAMBER_DISCHARGE_COEFFICIENT);
  model->chamber_stiffness = VALUE(CHAMBER_STIFFNESS);
  model->vent_on_return = VALUE(BORE_VENT_WAY) != 0;
  model->refill_travel = VALUE(BORE_REFILL_TRAVEL);
  model->refill_area = VALUE(BORE_REFILL_AREA);
  model->tolerance = VALUE(OUTPUT_TOLERANCE);
  model->motion_tolerance = VALUE(OUTPUT_MOTION_TOLERANCE);
  model->actuations = (int)VALUE(OUTPUT_ACTUATIONS);
  model->frames = (int)VALUE(OUTPUT_FRAMES);
  model->fit = (SbFitModel)VALUE(MODELS_FIT);
  model->film = (SbFilmModel)VALUE(MODELS_FILM);
  model->film_history = VALUE(MODELS_FILM_TIME) != 0;
  model->rest_film = VALUE(FLUID_REST_FILM);
  model->surface = VALUE(MODELS_SURFACE) > 0 ? SB_ROUGH_PERSSON : SB_ROUGH_GREENWOOD_TRIPP;
  model->asperities = (SbModelAsperities)VALUE(MODELS_ASPERITIES);
  model->hamaker = VALUE(MODELS_ADHESION) > 0 ? VALUE(SURFACE_HAMAKER_CONSTANT) : 0;
  model->motion = (SbModelMotion)VALUE(MODELS_MOTION);
  model->views = (unsigned)VALUE(OUTPUT_VIEWS);
  model->studies = (unsigned)VALUE(OUTPUT_STUDIES);
  model->study.squeeze_min = VALUE(STUDY_SQUEEZE_MIN);
  model->study.squeeze_max = VALUE(STUDY_SQUEEZE_MAX);
  model->study.speed_min = VALUE(STUDY_SPEED_MIN);
  model->study.speed_max = VALUE(STUDY_SPEED_MAX);
  model->study.load_min = VALUE(STUDY_LOAD_MIN);
  model->study.load_max = VALUE(STUDY_LOAD_MAX);
  model->study.time_min = VALUE(STUDY_TIME_MIN);
  model->study.time_max = VALUE(STUDY_TIME_MAX);
  model->look.field = (int)VALUE(OUTPUT_FIELD);
  model->look.insets = (int)VALUE(OUTPUT_INSETS);
  model->look.full = VALUE(OUTPUT_SECTION) == 1;
  model->look.cutaway = VALUE(OUTPUT_SECTION) == 2;
  model->look.azimuth = VALUE(OUTPUT_AZIMUTH);
  model->look.elevation = VALUE(OUTPUT_ELEVATION);
  model->look.undeformed = VALUE(OUTPUT_UNDEFORMED) > 0;
  model->look.field_max = VALUE(OUTPUT_FIELD_MAX);
  model->shape.entry_diameter = VALUE(BORE_ENTRY_DIAMETER);
  model->shape.entry_length = VALUE(BORE_ENTRY_LENGTH);
  model->shape.land_length = VALUE(BORE_LAND_LENGTH);
  model->shape.vent_position = VALUE(BORE_VENT_POSITION);
  model->shape.vent_diameter = VALUE(BORE_VENT_DIAMETER);
  model->shape.seal_spacing = VALUE(STEM_SEAL_SPACING);
  model->shape.nose_length = VALUE(STEM_NOSE_LENGTH);
  model->shape.chamber_depth = VALUE(STEM_CHAMBER_DEPTH);
  model->shape.chamber_length = VALUE(STEM_CHAMBER_LENGTH);
  model->shape.shoulder_length = VALUE(STEM_SHOULDER_LENGTH);
  model->shape.rod_diameter = VALUE(STEM_ROD_DIAMETER);
  model->rubber = read_rubber(params, model->density);
  model->rig = read_rig(model, params);
  model->life_actuations = (int)VALUE(LIFE_ACTUATIONS);
  int shown = (int)VALUE(LIFE_SHOWN);
  model->life_shown = shown > 0 ? shown : model->life_actuations;
  model->running_in = (SbRunningIn){
      .start = VALUE(LIFE_ROUGHNESS_NEW),
      .end = VALUE(LIFE_ROUGHNESS_RUN_IN),
      .actuations = VALUE(LIFE_RUNNING_IN),
  };
  model->rig_prominence = VALUE(RIG_PROMINENCE);
  model->bore_circumference = M_PI * model->bore_diameter;
  model->stem_diameter = VALUE(STEM_PRESSURE_DIAMETER);
  model->pressure_force =
      model->canister_pressure * M_PI / 4 * model->stem_diameter * model->stem_diameter;
}
