// Compiles parameters to the model: overrides resolved, derived sizes computed, senseless
// combinations refused.
//
// Derived sizes (thesis section 5.2 and 6.4.1; README, Definitions): squeeze eps = (d -
// g)/d on the free section; fitted mean diameter D - g; mean stretch eps_z = (D - g - (ID + d))/(ID
// + d); section after stretch d (1 - nu eps_z), the uniform-shrink estimate (the finite-strain ring
// is flatter, 1.500 mm against 1.576 mm for the thesis valve).
#include "engine/valve/model.h"

#include "engine/contact/closed_forms.h"
#include "engine/contact/fit.h"
#include "engine/mechanism/chamber.h"
#include "engine/valve/model_private.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *sb_seal_name(int seal) {
  return seal == SB_OUTER ? "outer" : "inner";
}

static void SB_PRINTF(5, 6) add_problem(SbProblems *problems, const char *key, double min,
                                        double max, const char *format, ...) {
  if (problems == NULL || problems->count == SB_PROBLEMS_MAX) {
    return;
  }
  SbProblem *problem = &problems->item[problems->count++];
  sb_text(problem->key, sizeof problem->key, "%s", key);
  problem->min = min;
  problem->max = max;
  va_list arguments;
  va_start(arguments, format);
  sb_text_v(problem->text, sizeof problem->text, format, arguments);
  va_end(arguments);
}

// Works out a seal from its `stored` ring, its Poisson's ratio and the gland. False (with problems
// added) where they make no sense.
static bool size_seal(SbModel *model, int index, SbProblems *problems) {
  SbSealModel *seal = &model->seal[index];
  bool outer = index == SB_OUTER;
  SbParamId diameter_id =
      outer ? SB_P_SEAL_OUTER_SECTION_DIAMETER : SB_P_SEAL_INNER_SECTION_DIAMETER;
  SbParamId inner_id = outer ? SB_P_SEAL_OUTER_INNER_DIAMETER : SB_P_SEAL_INNER_INNER_DIAMETER;
  seal->stored.radial_space = model->radial_space;
  SbReport report = {0};
  if (sb_rubber_state(&seal->storage, &model->rubber, &seal->stored, NULL, &report) != SB_OK) {
    add_problem(problems, report.parameter, NAN, NAN, "%s", report.text);
    return false;
  }
  seal->section_diameter = seal->storage.section_diameter;
  seal->inner_diameter = seal->storage.inner_diameter;
  seal->modulus = seal->storage.modulus;
  // Small strains: warned of from a quarter of the modulus on. Somewhere above 0.55 of it the
  // pressure parts the flats of some gaps: no contact state is left.
  if (model->fit == SB_FIT_DISC && model->canister_pressure > 0.5 * seal->modulus) {
    add_problem(problems, "canister.pressure", 0, 0.5 * seal->modulus,
                "is beyond the linear disc (models.fit), which holds to half the rubber's modulus "
                "of %.4g MPa; the ring goes further",
                seal->modulus * 1e-6);
    return false;
  }
  double nu = seal->poisson_ratio;
  seal->reduced_modulus =
      sb_reduced_modulus(seal->modulus, nu, model->housing_modulus, model->housing_poisson_ratio);
  seal->radius = seal->section_diameter / 2;

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
  seal->gland_fill = M_PI / 4 * d * d / (g * model->axial_width) * mean_free / mean_fitted;

  // Beyond 60 % no model here means anything; the fit models warn long before.
  bool good = true;
  if (seal->squeeze > 0.6) {
    add_problem(problems, sb_param(diameter_id)->key, NAN, g / 0.4,
                "squeezes the %s seal by %.0f %%, more than 60 %%", sb_seal_name(index),
                100 * seal->squeeze);
    good = false;
  }
  if (seal->stretch_inner > 1) {
    add_problem(problems, sb_param(inner_id)->key, floor / 2, NAN,
                "stretches the %s seal by %.0f %% onto the groove floor, more than 100 %%",
                sb_seal_name(index), 100 * seal->stretch_inner);
    good = false;
  }
  return good;
}

// One seal's own quantities. Returns false (with problems added) where they make no sense.
static bool compile_seal(SbModel *model, int index, const SbParams *params, SbProblems *problems) {
  SbSealModel *seal = &model->seal[index];
  // The key of the seal's own, which takes the common one's value where it is not given.
#define OWN(name)                                                                                  \
  sb_params_get(params, index == SB_OUTER ? SB_P_SEAL_OUTER_##name : SB_P_SEAL_INNER_##name)
  seal->stored = (SbRubberStorage){
      .section_diameter = OWN(SECTION_DIAMETER),
      .inner_diameter = OWN(INNER_DIAMETER),
      .modulus = OWN(MODULUS),
      .storage_time = sb_params_get(params, SB_P_STORAGE_TIME),
      .temperature = sb_params_get(params, SB_P_STORAGE_TEMPERATURE),
      .recovery_time = sb_params_get(params, SB_P_STORAGE_RECOVERY_TIME),
  };
  seal->section_diameter_tolerance = OWN(SECTION_DIAMETER_TOLERANCE);
  seal->inner_diameter_tolerance = OWN(INNER_DIAMETER_TOLERANCE);
  seal->poisson_ratio = OWN(POISSON_RATIO);
  seal->mooney_share = OWN(MOONEY_SHARE);
#undef OWN
  return size_seal(model, index, problems);
}

// What only the motion with inertia can do. The quasi-static balance is not silently asked for it.
static bool compile_quasi_static(const SbModel *model, SbProblems *problems) {
  const struct {
    const char *key;
    bool used;
  } uses[] = {
      {"drive.kind", model->drive != SB_MODEL_DRIVE_MACHINE},
      {"drive.cycles", model->cycles > 1},
      {"canister.pressure_map", model->pressure_map == SB_MAP_PORTS},
      {"friction.dwell_gain", model->dwell_gain > 0},
      {"friction.stribeck_speed", model->stribeck_speed > 0},
      {"friction.tangential_stiffness", model->tangential_stiffness > 0},
      {"stem.spring_stiffness", model->spring_stiffness > 0},
      {"stem.spring_preload", model->spring_preload > 0},
  };
  bool good = true;
  for (size_t i = 0; i < sizeof uses / sizeof uses[0]; i++) {
    if (uses[i].used) {
      add_problem(problems, uses[i].key, NAN, NAN,
                  "needs models.motion = dynamic; the quasi-static cycle knows only the machine");
      good = false;
    }
  }
  return good;
}

// Ranges must rise.
static bool compile_study(const SbModel *model, SbProblems *problems) {
  const struct {
    const char *key;
    double min, max;
  } ranges[] = {
      {"study.squeeze_max", model->study.squeeze_min, model->study.squeeze_max},
      {"study.speed_max", model->study.speed_min, model->study.speed_max},
      {"study.load_max", model->study.load_min, model->study.load_max},
      {"study.time_max", model->study.time_min, model->study.time_max},
  };
  bool good = true;
  for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
    if (!(ranges[i].max > ranges[i].min)) {
      add_problem(problems, ranges[i].key, ranges[i].min, NAN,
                  "the range of the study does not rise");
      good = false;
    }
  }
  return good;
}

// Metered volume and doses; with ports there must be a chamber.
static bool compile_dose(SbModel *model, const SbParams *params, SbProblems *problems) {
  const SbValveShape *shape = &model->shape;
  model->metered_volume = sb_chamber_metered_volume(&(SbDoseGeometry){
      .bore = model->bore_diameter,
      .land = model->stem_diameter,
      .floor = model->bore_diameter - 2 * model->radial_space,
      .spacing = shape->seal_spacing,
      .groove = model->axial_width,
      .recess_depth = shape->chamber_depth,
      .recess_length = shape->chamber_length,
      .rings = {{model->seal[SB_OUTER].section_diameter, model->seal[SB_OUTER].inner_diameter},
                {model->seal[SB_INNER].section_diameter, model->seal[SB_INNER].inner_diameter}},
  });
  model->doses = sb_chamber_doses(model->metered_volume, sb_params_get(params, SB_P_CANISTER_FILL),
                                  sb_params_get(params, SB_P_CANISTER_RESIDUE));
  if (model->pressure_map == SB_MAP_PORTS && !(model->metered_volume > 0)) {
    add_problem(problems, "stem.seal_spacing", NAN, NAN,
                "leaves no dose chamber between the seals (%.3g µl), which "
                "canister.pressure_map = ports needs",
                model->metered_volume * 1e9);
    return false;
  }
  return true;
}

// Parts and joints. The stem's mass, where it is given, is shared by its three parts as theirs are
// to each other; otherwise it is their sum.
static bool compile_parts(SbModel *model, SbAssemblyWork *work, const SbParams *params,
                          SbProblems *problems) {
  static const SbParamId mass[SB_VALVE_GROUND] = {
      SB_P_PART_HOUSING_MASS,     SB_P_PART_STEM_CENTRE_MASS, SB_P_PART_STEM_TOP_MASS,
      SB_P_PART_STEM_BOTTOM_MASS, SB_P_PART_INNER_SEAL_MASS,  SB_P_PART_OUTER_SEAL_MASS,
      SB_P_PART_BLOCK_MASS};
  static const SbParamId joint[SB_VALVE_JOINTS] = {
      SB_P_JOINT_HOUSING_GROUND, SB_P_JOINT_CENTRE_TOP,   SB_P_JOINT_BOTTOM_CENTRE,
      SB_P_JOINT_INNER_CENTRE,   SB_P_JOINT_OUTER_CENTRE, SB_P_JOINT_BLOCK_BOTTOM,
      SB_P_JOINT_BLOCK_GROUND};
  SbValvePart *part = model->parts.part;
  bool good = true;
  for (int i = 0; i < SB_VALVE_GROUND; i++) {
    // The catalogue has mass, axial and transverse moment in a row.
    part[i] = (SbValvePart){sb_params_get(params, mass[i]), sb_params_get(params, mass[i] + 1),
                            sb_params_get(params, mass[i] + 2)};
    if (part[i].axial > 2 * part[i].transverse * 1.001) {
      add_problem(problems, sb_param(mass[i] + 1)->key, NAN, 2 * part[i].transverse,
                  "no body has an axial moment of inertia above twice its transverse one");
      good = false;
    }
  }
  for (int i = 0; i < SB_VALVE_JOINTS; i++) {
    model->parts.joint[i] = (int)sb_params_get(params, joint[i]);
  }
  double sum = part[SB_VALVE_STEM_CENTRE].mass + part[SB_VALVE_STEM_TOP].mass +
               part[SB_VALVE_STEM_BOTTOM].mass;
  double share = 1;
  if (params->given[SB_P_STEM_MASS]) {
    share = model->stem_mass / sum;
  } else {
    model->stem_mass = sum;
  }
  for (int i = SB_VALVE_STEM_CENTRE; i <= SB_VALVE_STEM_BOTTOM; i++) {
    part[i].mass *= share;
    part[i].axial *= share;
    part[i].transverse *= share;
  }
  model->moving_mass = model->stem_mass + part[SB_VALVE_INNER_SEAL].mass +
                       part[SB_VALVE_OUTER_SEAL].mass + part[SB_VALVE_BLOCK].mass;
  if (!good || model->motion != SB_MODEL_MOTION_BODIES) {
    return good;
  }

  // What the joints leave free must be the stroke, once.
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
    int changed = SB_VALVE_BLOCK_GROUND;
    for (int i = SB_VALVE_JOINTS - 1; i >= 0; i--) {
      changed = model->parts.joint[i] != (int)sb_param(joint[i])->fallback ? i : changed;
    }
    add_problem(problems, sb_param(joint[changed])->key, NAN, NAN, "%s", report.text);
    return false;
  }
  return true;
}

static SbStatus compile(SbModel *model, SbAssemblyWork *work, const SbParams *params,
                        SbProblems *problems) {
  if (problems != NULL) {
    problems->count = 0;
  }
  sb_model_read(model, params);
  double pressure_diameter = model->stem_diameter;

  // The stem must fit into the bore and the groove must leave a core.
  bool good = true;
  if (pressure_diameter > model->bore_diameter) {
    add_problem(problems, "bore.diameter", pressure_diameter, NAN,
                "the bore is smaller than the stem (stem.pressure_diameter %.4g mm)",
                pressure_diameter * 1e3);
    good = false;
  }
  if (2 * model->radial_space >= model->bore_diameter) {
    add_problem(problems, "gland.radial_space", NAN, model->bore_diameter / 2,
                "the groove leaves no stem: twice the radial space exceeds the bore diameter");
    good = false;
  }
  double floor = model->bore_diameter - 2 * model->radial_space;
  if (floor > 0 && pressure_diameter <= floor) {
    add_problem(problems, "stem.pressure_diameter", floor, model->bore_diameter,
                "the stem's land lies below the floor of its groove (%.4g mm): nothing holds the "
                "ring",
                floor * 1e3);
    good = false;
  }
  good = compile_study(model, problems) && good;
  if (model->motion == SB_MODEL_MOTION_QUASI_STATIC) {
    good = compile_quasi_static(model, problems) && good;
  }
  if (model->motion != SB_MODEL_MOTION_QUASI_STATIC && model->stribeck_speed > 0 &&
      model->tangential_stiffness > 0 && !(model->damping_ratio > 0)) {
    add_problem(
        problems, "drive.damping_ratio", 1e-3, 2,
        "must be above 0 where friction that depends on speed (friction.stribeck_speed) acts "
        "through an elastic seal (friction.tangential_stiffness)");
    good = false;
  }
  if (model->life_shown > model->life_actuations) {
    add_problem(problems, "life.shown", 0, model->life_actuations,
                "is beyond the life's last actuation (life.actuations %d)", model->life_actuations);
    good = false;
  }
  if (model->life_actuations > 1 &&
      (model->motion == SB_MODEL_MOTION_RIG || model->motion == SB_MODEL_MOTION_BODIES)) {
    add_problem(problems, "life.actuations", NAN, 1,
                "needs models.motion = quasi-static or dynamic");
    good = false;
  }
  // Running-in changes the surface, and with it a film that shares its load with asperities.
  if (model->life_actuations > 1 && model->asperities == SB_MODEL_ASPERITIES_COUPLED) {
    add_problem(problems, "models.asperities", NAN, NAN,
                "coupled: a life of %d actuations keeps its film and needs beside",
                model->life_actuations);
    good = false;
  }
  if (model->life_actuations > 1) {
    // The scene's surface is the reference; the run starts with the new valve's.
    model->gt_product *= model->running_in.start;
    model->sigma *= model->running_in.start;
    model->sigma_over_beta *= model->running_in.start;
  }
  // As many samples as there may be frames.
  const double samples = model->rig.duration * model->rig.rate;
  if (model->motion == SB_MODEL_MOTION_RIG && !(samples >= 2 && samples <= 2e7)) {
    add_problem(problems, "rig.duration", 2 / model->rig.rate, 2e7 / model->rig.rate,
                "makes %.3g samples at %.4g Hz, not between 2 and 20 million", samples,
                model->rig.rate);
    good = false;
  }
  for (int i = 0; good && i < SB_SEAL_COUNT; i++) {
    good = compile_seal(model, i, params, problems) && good;
  }
  good = compile_parts(model, work, params, problems) && good;
  good = good && compile_dose(model, params, problems);
  if (!good) {
    return SB_ERROR_INPUT;
  }
  return SB_OK;
}

SbStatus sb_model_compile(SbModel *out, const SbParams *params, SbProblems *problems) {
  struct {
    SbModel model;
    SbAssemblyWork work;
  } *made = calloc(1, sizeof *made); // too large for a small stack
  if (made == NULL) {
    return SB_ERROR_MEMORY;
  }
  SbStatus status = compile(&made->model, &made->work, params, problems);
  if (status == SB_OK) {
    // Member by member: the padding stays zero, for copies are compared as bytes.
    memcpy(made->model.params.value, params->value, sizeof params->value);
    memcpy(made->model.params.given, params->given, sizeof params->given);
    *out = made->model;
  }
  free(made);
  return status;
}

// What the first of the problems says, with its range.
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
  return sb_fail_parameter(report, SB_ERROR_INPUT, problem->key, "%s: %s%s%s", problem->key,
                           problem->text, low, high);
}

SbStatus sb_model_override(SbModel *out, const SbModel *base, const SbOverride *overrides,
                           size_t count, SbReport *report) {
  SbParams params = base->params;
  for (size_t i = 0; i < count; i++) {
    SbReport own = {0};
    SbStatus status = sb_params_set(&params, overrides[i].id, overrides[i].value, &own);
    if (status != SB_OK) {
      return sb_fail_parameter(report, status, own.parameter, "%s: %s", own.parameter, own.text);
    }
  }
  if (sb_params_get(&params, SB_P_DRIVE_KIND) == SB_MODEL_DRIVE_MEASURED &&
      sb_model_measured(base) == NULL) {
    return sb_fail_parameter(report, SB_ERROR_INPUT, "drive.kind",
                             "drive.kind: measured needs a measured series");
  }
  SbProblems problems;
  const SbModelData *data = base->data;
  const SbLimits limits = base->limits;
  SbStatus status = sb_model_compile(out, &params, &problems);
  if (status == SB_ERROR_INPUT) {
    return tell_problem(&problems, report);
  }
  if (status != SB_OK) {
    return sb_fail(report, status, "no memory for a model");
  }
  out->data = data;
  out->limits = limits;
  return sb_succeed(report);
}

SbModelData *sb_model_data_create(void) {
  SbModelData *data = calloc(1, sizeof *data);
  if (data != NULL) {
    atomic_init(&data->holders, 1);
  }
  return data;
}

// The count alone changes behind the const.
static atomic_uint *holders(const SbModelData *data) {
  return &((SbModelData *)data)->holders;
}

void sb_model_data_release(const SbModelData *data) {
  if (data != NULL && atomic_fetch_sub_explicit(holders(data), 1, memory_order_acq_rel) == 1) {
    free((SbModelData *)data);
  }
}

void sb_model_keep(SbModel *kept, const SbModel *model) {
  const SbModelData *before = kept->data;
  if (model->data != NULL) {
    atomic_fetch_add_explicit(holders(model->data), 1, memory_order_relaxed);
  }
  memcpy(kept, model, sizeof *kept); // with its padding: copies are compared as bytes
  sb_model_data_release(before);
}

void sb_model_clear(SbModel *kept) {
  sb_model_data_release(kept->data);
  *kept = (SbModel){0};
}

void sb_model_remarks(const SbModel *model, SbProblems *out) {
  out->count = 0;
  // Where the vent lies between the contacts, their widths left out (run_valve.c has them).
  double hole = model->shape.vent_diameter;
  double nearest = model->land_edge - model->stroke - hole / 2;
  double furthest = model->land_edge + model->shape.seal_spacing + hole / 2;
  if (model->pressure_map == SB_MAP_PORTS && hole > 0 &&
      (model->shape.vent_position <= nearest || model->shape.vent_position >= furthest)) {
    add_problem(out, "bore.vent_position", fmax(nearest, 0), furthest,
                "the dose chamber never reaches the vent between rest and stop: it does not empty");
  }
}

void sb_model_warn_storage(const SbModel *model, SbWarnings *warnings) {
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    SbRubberState ignored;
    // Its constants were checked when the model was compiled: only the warnings are of interest.
    (void)sb_rubber_state(&ignored, &model->rubber, &model->seal[i].stored, warnings, NULL);
  }
}

void sb_model_gland(SbGland *out, const SbModel *model, int seal) {
  const SbSealModel *ring = &model->seal[seal];
  *out = (SbGland){
      .section_diameter = ring->stored.section_diameter,
      .section_diameter_tolerance = ring->section_diameter_tolerance,
      .inner_diameter = ring->stored.inner_diameter,
      .inner_diameter_tolerance = ring->inner_diameter_tolerance,
      .radial_space = model->radial_space,
      .radial_space_tolerance = model->radial_space_tolerance,
      .axial_width = model->axial_width,
      .axial_width_tolerance = model->axial_width_tolerance,
      .bore_diameter = model->bore_diameter,
      .bore_diameter_tolerance = model->bore_diameter_tolerance,
      .land_diameter = model->stem_diameter,
      .land_diameter_tolerance = model->stem_diameter_tolerance,
      .poisson_ratio = ring->poisson_ratio,
      .volume_swell = ring->storage.volume_swell,
  };
}

SbSealPressure sb_model_seal_pressure(const SbModel *model, int seal, SbChamber chamber) {
  double canister = model->canister_pressure;
  // With ports the pressure lies between: vented stands for none, closed for all of it.
  bool vented_at_rest = model->pressure_map != SB_MAP_CHAMBER_FILLED;
  double in_chamber = chamber == SB_CHAMBER_AT_REST && vented_at_rest ? 0 : canister;
  if (seal == SB_INNER) {
    return (SbSealPressure){canister, in_chamber};
  }
  return (SbSealPressure){in_chamber, 0};
}
