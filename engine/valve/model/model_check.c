// Checks of a model before any computation, remarks on unusual values, and warnings about its
// validity.
#include "engine/contact/rough/persson.h"
#include "engine/valve/model/gasket.h"

#include "engine/fluid/fluid.h"
#include "engine/valve/model/motion_kind.h"

#include <math.h>
#include <string.h>

// The stem must fit into the bore and the groove must leave a core.
static void check_sizes(const SbModel *model, SbProblems *problems) {
  double stem = model->stem_diameter;
  double floor = model->bore_diameter - 2 * model->radial_space;
  if (stem > model->bore_diameter) {
    sb_model_refuse(problems, "bore.diameter", stem, NAN,
                    "the bore is smaller than the stem (stem.pressure_diameter %.4g mm)",
                    stem * 1e3);
  }
  if (floor <= 0) {
    sb_model_refuse(problems, "gland.radial_space", NAN, model->bore_diameter / 2,
                    "the groove leaves no stem: twice the radial space exceeds the bore diameter");
  } else if (stem <= floor) {
    sb_model_refuse(
        problems, "stem.pressure_diameter", floor, model->bore_diameter,
        "the stem's land is below the floor of its groove (%.4g mm): nothing retains the ring",
        floor * 1e3);
  } else {
    const double depth = (stem - floor) / 2, corner = fmin(model->axial_width, depth) / 2;
    if (model->groove_corner > corner) {
      sb_model_refuse(problems, "gland.corner_radius", 0, corner,
                      "the groove's corners meet: it is %.4g mm wide and %.4g mm deep",
                      1e3 * model->axial_width, 1e3 * depth);
    } else if (model->groove_chamfer > depth - model->groove_corner) {
      sb_model_refuse(problems, "gland.edge_chamfer", 0, depth - model->groove_corner,
                      "the edges' chamfers leave no walls in a groove %.4g mm deep", 1e3 * depth);
    }
  }
}

// A drawn groove has its own walls and corners.
static void check_groove(const SbModel *model, SbProblems *problems) {
  static const SbParamId others[] = {SB_P_GLAND_DRAFT, SB_P_GLAND_CORNER_RADIUS,
                                     SB_P_GLAND_EDGE_CHAMFER};
  for (size_t i = 0; sb_model_groove(model) != NULL && i < sizeof others / sizeof *others; i++) {
    if (sb_params_get(&model->params, others[i]) > 0) {
      sb_model_refuse(problems, sb_param(others[i])->key, 0, 0,
                      "is of grooves that are not drawn (gland.profile_file)");
    }
  }
}

// A variant that models.fit does not have: the sentence names those that it has.
static void check_variant(const SbModel *model, SbProblems *problems) {
  char variant[40], all[160] = "";
  const char *name;
  for (int i = 0; (name = sb_fit_variant_name(model->fit, i)) != NULL; i++) {
    const size_t used = strlen(all);
    sb_text(all + used, sizeof all - used, "%s%s", i > 0 ? ", " : "", name);
  }
  sb_model_choice_name(model, SB_P_MODELS_FIT_VARIANT, variant, sizeof variant);
  sb_model_refuse(problems, "models.fit_variant", NAN, NAN,
                  "models.fit = %s has no variant %s, but %s", sb_fit_kind(model->fit)->name,
                  variant, all);
}

// Refuses ranges of studies that do not rise. In the catalogue the lower end precedes the upper
// one.
static void check_ranges(const SbModel *model, SbProblems *problems) {
  static const SbParamId largest[] = {SB_P_STUDY_SQUEEZE_MAX, SB_P_STUDY_SPEED_MAX,
                                      SB_P_STUDY_LOAD_MAX, SB_P_STUDY_TIME_MAX,
                                      SB_P_STUDY_TEMPERATURE_MAX};
  for (size_t i = 0; i < sizeof largest / sizeof largest[0]; i++) {
    double least = sb_params_get(&model->params, largest[i] - 1);
    if (!(sb_params_get(&model->params, largest[i]) > least)) {
      sb_model_refuse(problems, sb_param(largest[i])->key, least, NAN,
                      "the range of the study does not rise");
    }
  }
}

// Combinations that no model has, and ranges that do not rise.
static void check_combinations(const SbModel *model, SbProblems *problems) {
  // The quasi-static balance must not be used silently with options that only the motion with
  // inertia has. At their minimum values they have no effect.
  static const SbParamId inertial[] = {SB_P_DRIVE_KIND, SB_P_DRIVE_CYCLES,
                                       SB_P_FRICTION_STRIBECK_SPEED,
                                       SB_P_FRICTION_TANGENTIAL_STIFFNESS};
  static const char needs_inertia[] =
      "needs models.motion = dynamic; the quasi-static cycle supports only the machine";
  const SbMotionKind *motion = sb_motion_kind(model);
  const bool balance = !motion->inertia;
  const bool lives = model->life_actuations > 1;
  check_ranges(model, problems);
  for (size_t i = 0; balance && i < sizeof inertial / sizeof inertial[0]; i++) {
    const SbParam *param = sb_param(inertial[i]);
    if (sb_params_get(&model->params, inertial[i]) > param->min) {
      sb_model_refuse(problems, param->key, NAN, NAN, "%s", needs_inertia);
    }
  }
  if (balance && model->pressure_map == SB_MAP_PORTS) {
    sb_model_refuse(problems, "canister.pressure_map", NAN, NAN, "%s", needs_inertia);
  }
  if (!balance && model->stribeck_speed > 0 && model->tangential_stiffness > 0 &&
      !(model->damping_ratio > 0)) {
    sb_model_refuse(
        problems, "drive.damping_ratio", 1e-3, 2,
        "must be above 0 where friction that depends on speed (friction.stribeck_speed) acts "
        "through an elastic seal (friction.tangential_stiffness)");
  }
  if (lives && !motion->lives) {
    sb_model_refuse(problems, "life.actuations", NAN, 1,
                    "needs models.motion = quasi-static or dynamic");
  }
  if (model->life_shown > model->life_actuations) {
    sb_model_refuse(problems, "life.shown", 0, model->life_actuations,
                    "is beyond the life's last actuation (life.actuations %d)",
                    model->life_actuations);
  }
  if (model->fit_variant < 0) {
    check_variant(model, problems);
  }
  SbSpectrum spectrum;
  if (sb_rough_kind(model->surface)->spectrum &&
      sb_spectrum_from_asperities(&spectrum, model->sigma, model->sigma_over_beta,
                                  model->gt_product, NULL) == SB_ERROR_INFEASIBLE) {
    sb_model_refuse(
        problems, "surface.gt_product", 0.025, NAN,
        "no random surface has so small an asperity product (models.surface = persson)");
  }
  if (model->work_of_adhesion > 0 && !sb_rough_kind(model->surface)->asperities) {
    sb_model_refuse(problems, "models.adhesion", NAN, NAN,
                    "asperities: tips that stick are those of models.surface = greenwood-tripp");
  }
}

// Checks options that only a round section has.
static void check_profile(const SbModel *model, SbProblems *problems) {
  const bool gasket = model->kind == SB_VALVE_GASKET;
  const char *key = gasket ? "valve.kind" : "seal.profile";
  const char *name = gasket ? "gasket" : sb_seal_profile_name(model->profile);
  if (model->profile == SB_SEAL_PROFILE_CIRCLE) {
    return;
  }
  if (!sb_fit_kind(model->fit)->section) {
    sb_model_refuse(problems, "models.fit", NAN, NAN,
                    "%s supports round sections only: %s = %s requires the ring",
                    sb_fit_kind(model->fit)->name, key, name);
  }
  if (!sb_film_kind(model->film)->coupled) {
    sb_model_refuse(problems, "models.film", NAN, NAN,
                    "%s is a closed form for a round section: %s = %s needs reynolds",
                    sb_film_kind(model->film)->name, key, name);
  }
  if (!sb_motion_kind(model)->valve) {
    sb_model_refuse(problems, "models.motion", NAN, NAN,
                    "the rig's contacts are those of round sections, not of %s = %s", key, name);
  }
}

// A named fluid has figures at the canister's temperature, and takes the ethanol.
static void check_fluid(const SbModel *model, SbProblems *problems) {
  const SbFluid *fluid = &sb_fluids[model->fluid];
  SbFluidState state;
  SbReport report = {0};
  if (model->fluid == 0 && model->ethanol > 0) {
    sb_model_refuse(problems, "fluid.ethanol", NAN, 0, "needs a propellant by name (fluid.name)");
  } else if (model->fluid > 0) {
    const SbStatus status =
        sb_fluid_state(&state, NULL, fluid, model->temperature, model->ethanol, &report);
    if (status == SB_ERROR_INPUT) {
      sb_model_refuse(problems, "fluid.ethanol", NAN, 0, "%s", report.text);
    } else if (status != SB_OK) {
      sb_model_refuse(problems, "canister.temperature", fluid->temperature_min,
                      fluid->temperature_max, "%s", report.text);
    }
  }
}

void sb_model_check(const SbModel *model, SbProblems *problems) {
  check_fluid(model, problems);
  check_profile(model, problems);
  if (model->kind == SB_VALVE_GASKET) {
    sb_gasket_check(model, problems);
  } else {
    check_sizes(model, problems);
    check_groove(model, problems);
  }
  check_combinations(model, problems);
}

// Returns whether only storage.temperature is given: scenes of earlier versions had one temperature
// for storage and use.
static bool stored_only(const SbModel *model) {
  return model->params.given[SB_P_STORAGE_TEMPERATURE] &&
         !model->params.given[SB_P_CANISTER_TEMPERATURE];
}

static const char stored_only_text[] = "storage.temperature applies to storage only: the valve is "
                                       "used at canister.temperature, which "
                                       "is not given";

void sb_model_remarks(const SbModel *model, SbProblems *out) {
  out->count = 0;
  if (stored_only(model)) {
    sb_model_refuse(out, "storage.temperature", NAN, NAN, "%s", stored_only_text);
  }
  // Position of the vent between the contacts, without their widths (run_ports.c includes them).
  double hole = model->shape.vent_diameter;
  double nearest = model->land_edge - model->stroke - hole / 2;
  double furthest = model->land_edge + model->shape.seal_spacing + hole / 2;
  if (model->kind == SB_VALVE_GASKET) {
    const double opens = sb_gasket_port_opens(model);
    if (opens >= model->stroke) {
      sb_model_refuse(
          out, "stem.port_travel", NAN, model->stroke + model->port_diameter / 2,
          "the side port does not reach the chamber before the stop: no dose leaves it");
    } else if (opens <= model->land_edge) {
      sb_model_refuse(out, "stem.port_travel", model->land_edge + model->port_diameter / 2, NAN,
                      "the side port reaches the chamber before the chamber gasket has closed: the "
                      "canister empties through it");
    }
    return;
  }
  if (model->pressure_map == SB_MAP_PORTS && hole > 0 &&
      (model->shape.vent_position <= nearest || model->shape.vent_position >= furthest)) {
    sb_model_refuse(
        out, "bore.vent_position", fmax(nearest, 0), furthest,
        "the dose chamber never reaches the vent between rest and stop: it does not empty");
  }
}

void sb_model_modulus(SbModulusChange *out, const SbModel *model, double temperature) {
  const SbParamId id = SB_P_RUBBER_MODULUS_SLOPE;
  SbParamDefault slope;
  sb_params_default(&slope, &model->params, id);
  const double modulus = model->seal[SB_OUTER].stored.modulus;
  *out = (SbModulusChange){.factor = sb_rubber_stiffening(&model->rubber, modulus, temperature),
                           .tag = slope.tag,
                           .source = slope.source};
  if (model->rubber.entropic) {
    out->tag = "entropy elasticity";
    out->source = "proportional to the absolute temperature (rubber.entropic)";
  } else if (model->params.given[id]) {
    out->tag = "given";
    out->source = sb_param(id)->key;
  }
}

void sb_model_warn_modulus(const SbModel *model, double temperature, SbWarnings *warnings) {
  static const double NEAR = 20; // K, at the slope of filled nitrile 3 % of the modulus
  static const char nitrile[] = "that of filled nitrile falls by 0.16 % per kelvin";
  const SbParamId id = SB_P_RUBBER_MODULUS_SLOPE;
  SbParamDefault slope;
  sb_params_default(&slope, &model->params, id);
  const bool measured = model->params.given[id] || slope.from != NULL;
  const double away = fabs(temperature - SB_SIZES_TEMPERATURE);
  if (model->rubber.entropic && away > (measured ? 0 : NEAR)) {
    char known[SB_TEXT];
    sb_text(known, sizeof known,
            "the slope that is known of this rubber, %.3g %% per kelvin, is not used",
            100 * sb_params_get(&model->params, id));
    sb_warn(warnings, "modulus-entropic", sb_input(SB_P_RUBBER_ENTROPIC),
            "the modulus at %.4g °C is that at 20 °C times the absolute temperature "
            "(rubber.entropic), as in unfilled gum: %s",
            temperature - 273.15, measured ? known : nitrile);
  } else if (!model->rubber.entropic && !measured && away > NEAR) {
    sb_warn(warnings, "modulus-temperature", sb_input(id),
            "the modulus at %.4g °C is assumed equal to that at 20 °C (inferred: no measurement of "
            "this rubber is known); %s",
            temperature - 273.15, nitrile);
  }
}

void sb_model_warn_fluid(const SbModel *model, SbParamId id, SbWarnings *warnings) {
  const int other = sb_params_other_fluid(&model->params, id);
  if (other >= 0) {
    sb_warn(warnings, "fluid-property", sb_input(id),
            "%s is that of %s, not of the valve's %s (fluid.figures): its effects are those of "
            "another fluid",
            sb_param(id)->key, sb_fluids[other].label, sb_fluids[model->fluid].label);
  }
}

// Whether every run of the model uses a parameter that depends on the fluid.
static bool uses_figure(const SbModel *model, SbParamId id) {
  const bool stored = model->storage_time > 0;
  return id == SB_P_RUBBER_SWELL_MASS          ? stored
         : id == SB_P_RUBBER_DIFFUSION         ? stored && model->rubber.swell_mass > 0
         : id == SB_P_HOUSING_PERMEABILITY     ? model->shelf.plastic_length > 0
         : id == SB_P_FLUID_PRESSURE_VISCOSITY ? model->barus
                                               : id != SB_P_FLUID_VAPOUR_VISCOSITY;
}

void sb_model_warn(const SbModel *model, SbWarnings *warnings) {
  for (int i = 0; i < SB_SIZE_CHECKS; i++) {
    char text[SB_TEXT];
    SbParamId id;
    const char *code = sb_params_size_check(text, &id, &model->params, i);
    if (code != NULL) {
      sb_warn(warnings, code, sb_input(id), "%s", text);
    }
  }
  sb_model_warn_modulus(model, model->temperature, warnings);
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    SbRubberState ignored;
    // Its constants were checked when the model was compiled: only the warnings are of interest.
    (void)sb_rubber_state(&ignored, &model->rubber, &model->seal[i].stored, warnings, NULL);
  }
  if (stored_only(model)) {
    sb_warn(warnings, "storage-only", sb_input(SB_P_STORAGE_TEMPERATURE), "%s", stored_only_text);
  }
  const bool gasket = model->kind == SB_VALVE_GASKET;
  if (model->data != NULL && model->data->groove.count > 0 &&
      (gasket || !sb_fit_kind(model->fit)->section)) {
    sb_warn(warnings, "groove-unused", SB_INPUT_GROOVE_FILE,
            "only solved rings (models.fit = ring) meet the walls of a drawn groove: %s",
            gasket ? "a gasket's valve has none" : "closed forms use gland.radial_space only");
  }
  SbParamDefault swell;
  sb_params_default(&swell, &model->params, SB_P_RUBBER_SWELL_MASS);
  if (model->params.rubber != NULL && model->storage_time > 0 && swell.from == NULL &&
      !model->params.given[SB_P_RUBBER_SWELL_MASS]) {
    sb_warn(warnings, "swell-unknown", sb_input(SB_P_RUBBER_SWELL_MASS),
            "%s has no value of its swell in this fluid: no swell is computed",
            model->params.rubber->name);
  }
  for (int i = 0; sb_params_of_fluid(i) >= 0; i++) {
    const SbParamId id = (SbParamId)sb_params_of_fluid(i);
    if (uses_figure(model, id)) {
      sb_model_warn_fluid(model, id, warnings);
    }
  }
  SbFluidState state;
  if (model->fluid > 0) {
    (void)sb_fluid_state(&state, warnings, &sb_fluids[model->fluid], model->temperature,
                         model->ethanol, NULL);
  }
  if (model->canister_pressure < 0) {
    sb_warn(warnings, "pressure-below-ambient", sb_input(SB_P_CANISTER_PRESSURE),
            "the canister is %.4g kPa below ambient: nothing is delivered, and air leaks in and "
            "flows through ports, computed with the liquid's density and viscosity",
            -1e-3 * model->canister_pressure);
  }
}
