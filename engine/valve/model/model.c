// Compiles parameters to the model: overrides resolved, derived sizes computed, senseless
// combinations refused.
//
// Derived sizes (thesis section 5.2 and 6.4.1; docs/results.md, Definitions): squeeze eps = (d -
// g)/d on the free section; fitted mean diameter D - g; mean stretch eps_z = (D - g - (ID + d))/(ID
// + d); section after stretch d (1 - nu eps_z), the uniform-shrink estimate (the finite-strain ring
// is flatter, 1.500 mm against 1.576 mm for the thesis valve).
#include "engine/valve/model/gasket.h"

#include "engine/contact/closed_forms.h"
#include "engine/contact/fit.h"
#include "engine/fluid/fluid.h"
#include "engine/mechanism/chamber.h"
#include "engine/valve/model/motion_kind.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *sb_seal_name(int seal) {
  return seal == SB_OUTER ? "outer" : "inner";
}

void sb_model_refuse(SbProblems *problems, const char *key, double min, double max,
                     const char *format, ...) {
  if (problems != NULL && problems->count < SB_PROBLEMS_MAX) {
    SbProblem *problem = &problems->item[problems->count++];
    sb_text(problem->key, sizeof problem->key, "%s", key);
    problem->min = min;
    problem->max = max;
    va_list arguments;
    va_start(arguments, format);
    sb_message_v(problem->text, sizeof problem->text, format, arguments);
    va_end(arguments);
  }
}

// Sets the model's fields from the values of the parameters, and converts parameters that replace
// another one.
static void take_values(SbModel *model, const SbParams *params) {
  SbParams effective;
  sb_params_resolve(&effective, params);
  model->params = *params;
#define VALUE(id)                                     effective.value[SB_P_##id]
#define SB_REAL(id, stage, where, place, ...)         model->place = VALUE(id);
#define SB_INT(id, stage, where, place, ...)          model->place = (int)VALUE(id);
#define SB_CHOICE(id, stage, type, where, place, ...) model->place = (type)VALUE(id);
#define SB_FLAGS(id, stage, where, place, ...)        model->place = (unsigned)VALUE(id);
#define SB_SEAL(id, stage, where, place, ...)                                                      \
  model->seal[SB_OUTER].place = VALUE(SEAL_OUTER_##id);                                            \
  model->seal[SB_INNER].place = VALUE(SEAL_INNER_##id);
#include "engine/valve/model/params.def"
#undef VALUE
  // The catalogue counts the names of all models, the model those of its own.
  char variant[40];
  sb_param_choice_name(sb_param(SB_P_MODELS_FIT_VARIANT), model->fit_variant, variant,
                       sizeof variant);
  model->fit_variant = sb_fit_variant_find(model->fit, variant);
  model->pressure_viscosity = model->barus ? model->pressure_viscosity : 0;
  if (model->adhesion != SB_MODEL_ADHESION_ASPERITIES) {
    model->work_of_adhesion = 0;
  } else if (!(model->work_of_adhesion > 0)) {
    model->work_of_adhesion = sb_vdw_work(model->hamaker);
  }
  model->hamaker = model->adhesion == SB_MODEL_ADHESION_ON ? model->hamaker : 0;
  model->load_coefficient =
      model->friction == SB_MODEL_FRICTION_THESIS ? model->load_coefficient : 0;
  model->surface = model->persson ? SB_ROUGH_PERSSON : SB_ROUGH_GREENWOOD_TRIPP;
  model->life_shown = model->life_shown > 0 ? model->life_shown : model->life_actuations;
  model->rubber.terms = 3;
  const bool glass = model->rubber.glass_temperature > sb_param(SB_P_RUBBER_GLASS_TEMPERATURE)->min;
  model->rubber.glass_temperature = glass ? model->rubber.glass_temperature : 0;
  model->rubber.fluid_density = model->density;
  // stem.pressure_diameter keeps its value, so that the pressure force depends on the pressure
  // only.
  const double grown = 1 + model->housing_expansion * (model->temperature - SB_SIZES_TEMPERATURE);
  if (model->kind == SB_VALVE_GASKET) {
    sb_gasket_take(model);
  }
  model->radial_space *= grown;
  model->bore_diameter *= grown;
  model->bore_circumference = M_PI * model->bore_diameter;
  model->pressure_force =
      model->canister_pressure * M_PI / 4 * model->stem_diameter * model->stem_diameter;
  if (model->life_first > 1) {
    // Run in so far: the law forgets how it got there.
    SbRunningIn *law = &model->running_in;
    law->start =
        law->end + (law->start - law->end) * exp(-(model->life_first - 1) / law->actuations);
    model->supply.empty = false;
  }
  if (model->life_actuations > 1 || model->life_first > 0) {
    // The scene's surface is the reference; the run starts with that of its first actuation.
    model->gt_product *= model->running_in.start;
    model->sigma *= model->running_in.start;
    model->sigma_over_beta *= model->running_in.start;
  }
}

SbDynamicsContact sb_model_contact(const SbModel *model, double static_ratio, double mass) {
  const double stiffness = model->tangential_stiffness;
  // A contact that ages starts from the sliding level; where its film is known, its law comes with
  // the level (breakaway.h).
  const bool ages = model->contact_ageing;
  return (SbDynamicsContact){
      .static_ratio = ages ? 1 : static_ratio,
      .dwell_gain = ages ? model->ageing_gain : model->dwell_gain,
      .dwell_time = ages ? model->ageing_time : model->dwell_time,
      .stribeck_speed = model->stribeck_speed,
      .stribeck_exponent = 1,
      .stiffness = stiffness > 0 ? stiffness : INFINITY,
      .damping = model->damping_ratio * 2 * sqrt(stiffness * mass),
  };
}

// The rig's rings use the friction.* keys: the static ratio, its growth with dwell, the decrease
// with speed, and the tangential stiffness of one ring. Dampers follow from drive.damping_ratio.
static void compile_rig(SbModel *model, SbProblems *problems) {
  SbRig *rig = &model->rig;
  rig->rest = model->rest;
  rig->contact = sb_model_contact(model, model->static_ratio, rig->mass / SB_RIG_RINGS);
  rig->thread_damping = model->damping_ratio * 2 * sqrt(rig->thread_stiffness * rig->mass);
  // As many samples as there may be frames.
  const double samples = rig->duration * rig->rate;
  if (!sb_motion_kind(model)->valve && !(samples >= 2 && samples <= 2e7)) {
    sb_model_refuse(problems, "rig.duration", 2 / rig->rate, 2e7 / rig->rate,
                    "results in %.3g samples at %.4g Hz, not between 2 and 20 million", samples,
                    rig->rate);
  }
}

// Refuses a ring that its groove squeezes or stretches beyond every model. Beyond 60 % squeeze no
// model is meaningful; the fit models warn much earlier.
static void check_fit(const SbModel *model, int index, SbProblems *problems) {
  const SbSealModel *seal = &model->seal[index];
  const bool outer = index == SB_OUTER;
  const double g = model->radial_space, floor = model->bore_diameter - 2 * g;
  if (seal->squeeze > 0.6) {
    sb_model_refuse(problems, outer ? "seal.outer.section_diameter" : "seal.inner.section_diameter",
                    NAN, g / 0.4, "squeezes the %s seal by %.0f %%, more than 60 %%",
                    sb_seal_name(index), 100 * seal->squeeze);
  }
  if (seal->stretch_inner > 1) {
    sb_model_refuse(problems, outer ? "seal.outer.inner_diameter" : "seal.inner.inner_diameter",
                    floor / 2, NAN,
                    "stretches the %s seal by %.0f %% onto the groove floor, more than 100 %%",
                    sb_seal_name(index), 100 * seal->stretch_inner);
  }
}

// Works out a seal from its `stored` ring, its Poisson's ratio and the gland.
static void compile_seal(SbModel *model, int index, SbProblems *problems) {
  SbSealModel *seal = &model->seal[index];
  seal->stored.storage_time = model->storage_time;
  seal->stored.temperature = model->storage_temperature;
  seal->stored.use_temperature = model->temperature;
  seal->stored.recovery_time = model->recovery_time;
  seal->stored.radial_space = model->radial_space;
  SbReport report = {0};
  if (sb_rubber_state(&seal->storage, &model->rubber, &seal->stored, NULL, &report) != SB_OK) {
    sb_model_refuse(problems, sb_input_key(report.input), NAN, NAN, "%s", report.text);
    return;
  }
  seal->section_diameter = seal->storage.section_diameter;
  seal->inner_diameter = seal->storage.inner_diameter;
  seal->modulus = seal->storage.modulus;
  double nu = seal->poisson_ratio;
  seal->reduced_modulus =
      sb_reduced_modulus(seal->modulus, nu, model->housing_modulus, model->housing_poisson_ratio);
  seal->radius = seal->section_diameter / 2;
  if (model->kind == SB_VALVE_GASKET) {
    sb_gasket_derive(seal, model);
    return;
  }

  double d = seal->section_diameter;
  double g = model->radial_space;
  double mean_free = seal->inner_diameter + d;
  double mean_fitted = model->bore_diameter - g;
  double floor = model->bore_diameter - 2 * g;
  seal->squeeze = (d - g) / d;
  seal->stretch_mean = (mean_fitted - mean_free) / mean_free;
  seal->stretch_inner = (floor - seal->inner_diameter) / seal->inner_diameter;
  seal->section_fitted = d * (1 - nu * seal->stretch_mean);
  seal->interference = seal->section_fitted - g;
  const SbSealProfile profile = sb_model_profile(model, index);
  SbRingOutline outline;
  double area, centroid;
  if (profile.kind == SB_SEAL_PROFILE_FILE && profile.drawn.count == 0) {
    sb_model_refuse(problems, "seal.profile_file", NAN, NAN,
                    "seal.profile = file needs the file of a section");
  } else if (sb_ring_outline_of_profile(&outline, &profile, d, &report) != SB_OK) {
    sb_model_refuse(problems, sb_input_key(report.input), NAN, NAN, "%s", report.text);
  }
  sb_seal_profile_area(&area, &centroid, &profile, d);
  const double groove = sb_groove_area(g, model->axial_width, model->groove_draft,
                                       model->groove_corner, sb_model_groove(model));
  seal->gland_fill = area * d * d / groove * (mean_free + 2 * centroid * d) / mean_fitted;
  check_fit(model, index, problems);
}

// Metered volume and doses; with ports there must be a chamber.
static void compile_dose(SbModel *model, SbProblems *problems) {
  const SbValveShape *shape = &model->shape;
  const bool gasket = model->kind == SB_VALVE_GASKET;
  // Housing and stem expand equally, and so does the space between them.
  const double grown = model->bore_diameter / sb_model_value(model, SB_P_BORE_DIAMETER);
  const SbDoseGeometry between = {
      .bore = model->bore_diameter,
      .land = model->stem_diameter * grown,
      .floor = model->bore_diameter - 2 * model->radial_space,
      .spacing = shape->seal_spacing * grown,
      .groove = model->axial_width * grown,
      .recess_depth = shape->chamber_depth * grown,
      .recess_length = shape->chamber_length * grown,
      .rings = {{model->seal[SB_OUTER].section_diameter, model->seal[SB_OUTER].inner_diameter},
                {model->seal[SB_INNER].section_diameter, model->seal[SB_INNER].inner_diameter}},
  };
  model->supply.volume = gasket ? sb_gasket_volume(model) : sb_chamber_metered_volume(&between);
  model->supply.density = model->density;
  SbFluidState state;
  if (model->fluid > 0 && sb_fluid_state(&state, NULL, &sb_fluids[model->fluid], model->temperature,
                                         model->ethanol, NULL) == SB_OK) {
    const double vapour = state.figure[SB_FLUID_VAPOUR].value;
    model->supply.vapour = isnan(vapour) ? 0 : fmin(vapour, model->density);
    model->supply.pressure = state.figure[SB_FLUID_PRESSURE].value;
    const double gas = sb_fluid_vapour(&sb_fluids[model->fluid], model->temperature,
                                       fmin(model->ambient_pressure, model->supply.pressure));
    model->supply.gas = model->ethanol > 0 || isnan(gas) ? 0 : gas;
  }
  model->outlet_diameter = gasket ? model->port_diameter : shape->vent_diameter;
  model->passage_area = gasket ? sb_gasket_neck(model)
                               : M_PI / 4 * (model->bore_diameter - model->stem_diameter) *
                                     (model->bore_diameter + model->stem_diameter);
  model->filling_time =
      sb_chamber_filling(model->supply.volume, model->discharge_coefficient * model->passage_area,
                         model->canister_pressure, model->density);
  if (model->pressure_map == SB_MAP_PORTS && !(model->supply.volume > 0)) {
    sb_model_refuse(
        problems, "stem.seal_spacing", NAN, NAN,
        "leaves no dose chamber between the seals (%.3g µl), which canister.pressure_map = "
        "ports needs",
        model->supply.volume * 1e9);
  }
}

// Checks that the joints leave exactly one degree of freedom, the stroke.
static void check_joints(const SbModel *model, SbAssemblyWork *work, SbProblems *problems) {
  SbAssembly assembly;
  SbMobility mobility;
  SbReport report = {0};
  const double axis[3] = {1, 0, 0};
  SbAssemblyTangent tangent;
  SbStatus status = sb_assembly_valve(&assembly, &model->parts, &report);
  status = status != SB_OK ? status : sb_assembly_mobility(&mobility, &assembly, 1, work, &report);
  status = status != SB_OK ? status
                           : sb_assembly_tangent(&tangent, &assembly, SB_VALVE_STEM_CENTRE, axis,
                                                 work, &report);
  if (status != SB_OK) {
    // The first joint that is not the catalogue's, which has them in the valve's order.
    int changed = 0;
    while (changed < SB_VALVE_BLOCK_GROUND &&
           model->parts.joint[changed] ==
               (int)sb_param(SB_P_JOINT_HOUSING_GROUND + changed)->fallback) {
      changed++;
    }
    sb_model_refuse(problems, sb_param(SB_P_JOINT_HOUSING_GROUND + changed)->key, NAN, NAN, "%s",
                    report.text);
  }
}

// Parts and joints. The stem's mass, where it is given, is shared by its three parts as theirs are
// to each other; otherwise it is their sum.
static void compile_parts(SbModel *model, SbProblems *problems) {
  SbValvePart *part = model->parts.part;
  for (int i = 0; i < SB_VALVE_PARTS; i++) {
    if (part[i].axial > 2 * part[i].transverse * 1.001) {
      // The catalogue has mass, axial and transverse moment of each part in a row.
      sb_model_refuse(problems, sb_param(SB_P_PART_HOUSING_INERTIA_AXIAL + 3 * i)->key, NAN,
                      2 * part[i].transverse,
                      "no body has an axial moment of inertia above twice its transverse one");
    }
  }
  double sum = part[SB_VALVE_STEM_CENTRE].mass + part[SB_VALVE_STEM_TOP].mass +
               part[SB_VALVE_STEM_BOTTOM].mass;
  model->stem_mass = model->params.given[SB_P_STEM_MASS] ? model->stem_mass : sum;
  double share = model->stem_mass / sum;
  for (int i = SB_VALVE_STEM_CENTRE; i <= SB_VALVE_STEM_BOTTOM; i++) {
    part[i].mass *= share;
    part[i].axial *= share;
    part[i].transverse *= share;
  }
  model->moving_mass = model->stem_mass + part[SB_VALVE_INNER_SEAL].mass +
                       part[SB_VALVE_OUTER_SEAL].mass + part[SB_VALVE_BLOCK].mass;
}

SbStatus sb_model_compile(SbModel *out, const SbParams *params, const SbModelData *data,
                          SbProblems *problems) {
  struct {
    SbModel model;
    SbAssemblyWork work;
    SbProblems problems;
  } *made = calloc(1, sizeof *made); // too large for a small stack
  if (made == NULL) {
    return SB_ERROR_MEMORY;
  }
  SbModel *model = &made->model;
  SbProblems *found = &made->problems;
  take_values(model, params);
  model->data = data;
  sb_model_check(model, found);
  compile_rig(model, found);
  for (int i = 0; found->count == 0 && i < SB_SEAL_COUNT; i++) {
    compile_seal(model, i, found);
  }
  size_t before = found->count;
  compile_parts(model, found);
  if (found->count == before && sb_motion_kind(model)->joints) {
    check_joints(model, &made->work, found);
  }
  if (found->count == 0) {
    compile_dose(model, found);
  }
  if (problems != NULL) {
    *problems = *found;
  }
  SbStatus status = found->count > 0 ? SB_ERROR_INPUT : SB_OK;
  if (status == SB_OK) {
    // Member by member: the padding stays zero, for copies are compared as bytes.
    memcpy(model->params.value, params->value, sizeof params->value);
    memcpy(model->params.given, params->given, sizeof params->given);
    *out = *model;
  }
  free(made);
  return status;
}

// Reports the first of the problems, with its range.
static SbStatus tell_problem(const SbProblems *problems, SbReport *report) {
  const SbProblem *problem = &problems->item[0];
  int id = sb_param_find(problem->key);
  const char *si =
      id >= 0 && strcmp(sb_param((SbParamId)id)->si, "1") != 0 ? sb_param((SbParamId)id)->si : "";
  char low[48] = "", high[48] = "";
  if (isfinite(problem->min)) {
    sb_text(low, sizeof low, "; at least %.6g %s", problem->min, si);
  }
  if (isfinite(problem->max)) {
    sb_text(high, sizeof high, "; at most %.6g %s", problem->max, si);
  }
  return sb_fail_input(report, SB_ERROR_INPUT, sb_input_find(problem->key), "%s: %s%s%s",
                       problem->key, problem->text, low, high);
}

// With what documents bring besides.
static SbStatus complete(SbModel *out, const SbParams *params, const SbModelData *data,
                         const SbLimits *limits, SbProblems *problems) {
  if (problems != NULL) {
    problems->count = 0;
  }
  if (sb_params_get(params, SB_P_DRIVE_KIND) == SB_MODEL_DRIVE_MEASURED &&
      (data == NULL || data->measured.count == 0)) {
    sb_model_refuse(problems, "drive.file", NAN, NAN,
                    "drive.kind = measured needs the CSV file of a measured series");
    return SB_ERROR_INPUT;
  }
  if (sb_params_get(params, SB_P_SHELF_HISTORY) == SB_SHELF_FILE &&
      (data == NULL || data->shelf.count == 0)) {
    sb_model_refuse(problems, "shelf.file", NAN, NAN,
                    "shelf.history = file needs the CSV file of temperatures over time");
    return SB_ERROR_INPUT;
  }
  const SbLimits none = {0}, kept = limits != NULL ? *limits : none; // it may be out's
  SbStatus status = sb_model_compile(out, params, data, problems);
  if (status == SB_OK) {
    out->limits = kept;
  }
  return status;
}

SbStatus sb_model_override(SbModel *out, const SbModel *base, const SbOverride *overrides,
                           size_t count, SbReport *report) {
  SbParams params = base->params;
  for (size_t i = 0; i < count; i++) {
    SbReport own = {0};
    SbStatus status = sb_params_set(&params, overrides[i].id, overrides[i].value, &own);
    if (status != SB_OK) {
      return sb_fail_input(report, status, own.input, "%s: %s", sb_input_key(own.input), own.text);
    }
  }
  sb_params_keep_fluid(&params, &base->params);
  if (sb_params_get(&params, SB_P_DRIVE_KIND) == SB_MODEL_DRIVE_MEASURED &&
      sb_model_measured(base) == NULL) {
    return sb_fail_input(report, SB_ERROR_INPUT, sb_input(SB_P_DRIVE_KIND),
                         "drive.kind: measured needs a measured series");
  }
  SbProblems *problems = malloc(sizeof *problems); // too large for a small stack
  SbStatus status = problems == NULL ? SB_ERROR_MEMORY
                                     : complete(out, &params, base->data, &base->limits, problems);
  if (status == SB_ERROR_INPUT) {
    status = tell_problem(problems, report);
  } else if (status != SB_OK) {
    status = sb_fail(report, status, "no memory for a model");
  } else {
    status = sb_succeed(report);
  }
  free(problems);
  return status;
}

// Hands a model that was made over, holding its data, or none.
static SbStatus hand_over(SbModel **out, SbModel *model, SbStatus status) {
  if (status != SB_OK) {
    free(model);
  } else if (model->data != NULL) {
    sb_model_data_hold(model->data);
  }
  *out = status == SB_OK ? model : NULL;
  return status;
}

// ---- From outside

SbStatus sb_model_create(SbModel **out, const SbParams *params, const SbModelData *data,
                         const SbLimits *limits, SbProblems *problems) {
  SbModel *model = calloc(1, sizeof *model);
  return hand_over(out, model,
                   model != NULL ? complete(model, params, data, limits, problems)
                                 : SB_ERROR_MEMORY);
}

SbStatus sb_model_derive(SbModel **out, const SbModel *base, const SbOverride *overrides,
                         size_t count, SbReport *report) {
  SbModel *model = calloc(1, sizeof *model);
  return hand_over(out, model,
                   model != NULL ? sb_model_override(model, base, overrides, count, report)
                                 : sb_fail(report, SB_ERROR_MEMORY, "no memory for a model"));
}

SbStatus sb_model_copy(SbModel **out, const SbModel *model) {
  SbModel *copy = calloc(1, sizeof *copy);
  if (copy != NULL) {
    memcpy(copy, model, sizeof *copy); // with its padding: copies are compared as bytes
  }
  return hand_over(out, copy, copy != NULL ? SB_OK : SB_ERROR_MEMORY);
}

void sb_model_destroy(const SbModel *model) {
  if (model != NULL) {
    sb_model_data_release(model->data);
    free((SbModel *)model);
  }
}
