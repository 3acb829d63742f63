// Readers of a model: its values, what follows from them without computation, and the inputs
// of the solvers of gland and surface.
#include "engine/valve/model/model.h"

#include "engine/valve/model/motion_kind.h"

#include <string.h>

// The free section's profile, grown by a factor.
static SbSealProfile profile_of(const SbModel *model, double grown) {
  return (SbSealProfile){.kind = model->profile,
                         .axial_height = grown * model->profile_axial_height,
                         .corner_radius = grown * model->profile_corner_radius,
                         .valley_depth = grown * model->profile_valley_depth,
                         .web_width = grown * model->profile_web_width,
                         .flange_height = grown * model->profile_flange_height,
                         .lip_thickness = grown * model->profile_lip_thickness,
                         .lip_depth = grown * model->profile_lip_depth,
                         .lip_flare = grown * model->profile_lip_flare,
                         .drawn = model->data != NULL ? model->data->profile : (SbSealDrawing){0}};
}

SbSealProfile sb_model_profile(const SbModel *model, int seal) {
  const SbSealModel *ring = &model->seal[seal];
  return profile_of(model, ring->section_diameter / ring->stored.section_diameter);
}

const SbGrooveDrawing *sb_model_groove(const SbModel *model) {
  const bool drawn = model->data != NULL && model->data->groove.count > 0;
  return drawn && model->kind != SB_VALVE_GASKET ? &model->data->groove : NULL;
}

bool sb_model_same(const SbModel *a, const SbModel *b) {
  return a == b || (a != NULL && b != NULL && memcmp(a, b, sizeof *a) == 0);
}

double sb_model_value(const SbModel *model, SbParamId id) {
  return sb_params_get(&model->params, id);
}

int sb_model_number(const SbModel *model, SbParamId id) {
  return (int)sb_params_get(&model->params, id);
}

uint64_t sb_model_methods(const SbModel *model) {
  enum { CHOICES = 16 }; // more than any of these parameters has
  uint64_t out = (uint64_t)sb_model_number(model, SB_P_VALVE_KIND);
  out = out * CHOICES + (uint64_t)sb_model_number(model, SB_P_SEAL_PROFILE);
  for (int id = SB_P_MODELS_FIT; id <= SB_P_MODELS_MOTION; id++) {
    out = out * CHOICES + (uint64_t)sb_model_number(model, (SbParamId)id);
  }
  return out;
}

bool sb_model_default(SbParamDefault *out, const SbModel *model, SbParamId id) {
  sb_params_default(out, &model->params, id);
  return !model->params.given[id] && out->from != NULL;
}

void sb_model_choice_name(const SbModel *model, SbParamId id, char *name, size_t size) {
  sb_param_choice_name(sb_param(id), sb_model_number(model, id), name, size);
}

const SbFitKind *sb_model_fit(const SbModel *model) {
  return sb_fit_kind(model->fit);
}

bool sb_model_has_spring(const SbModel *model) {
  return model->spring_stiffness > 0 || model->spring_preload > 0;
}

const SbSealModel *sb_model_seal(const SbModel *model, int seal) {
  return &model->seal[seal];
}

const SbValveShape *sb_model_shape(const SbModel *model) {
  return &model->shape;
}

const SbValveParts *sb_model_parts(const SbModel *model) {
  return &model->parts;
}

const SbRig *sb_model_rig(const SbModel *model) {
  return &model->rig;
}

const SbSectionLook *sb_model_look(const SbModel *model) {
  return &model->look;
}

double sb_model_pressure_force(const SbModel *model) {
  return model->pressure_force;
}

double sb_model_sigma(const SbModel *model) {
  return model->sigma;
}

int sb_model_shown_actuation(const SbModel *model) {
  return model->life_shown;
}

const SbModelSeries *sb_model_measured(const SbModel *model) {
  return model->data != NULL && model->data->measured.count > 0 ? &model->data->measured : NULL;
}

const SbValveOutlines *sb_model_outlines(const SbModel *model) {
  return model->data != NULL ? &model->data->outlines : NULL;
}

void sb_model_gland(SbGland *out, const SbModel *model, int seal) {
  const SbSealModel *ring = &model->seal[seal];
  *out = (SbGland){
      .profile = profile_of(model, 1),
      .section_diameter = ring->stored.section_diameter,
      .section_diameter_tolerance = ring->section_diameter_tolerance,
      .inner_diameter = ring->stored.inner_diameter,
      .inner_diameter_tolerance = ring->inner_diameter_tolerance,
      .radial_space = sb_model_value(model, SB_P_GLAND_RADIAL_SPACE),
      .radial_space_tolerance = model->radial_space_tolerance,
      .axial_width = model->axial_width,
      .draft = model->groove_draft,
      .corner_radius = model->groove_corner,
      .groove = sb_model_groove(model),
      .axial_width_tolerance = model->axial_width_tolerance,
      .bore_diameter = sb_model_value(model, SB_P_BORE_DIAMETER),
      .bore_diameter_tolerance = model->bore_diameter_tolerance,
      .land_diameter = model->stem_diameter,
      .land_diameter_tolerance = model->stem_diameter_tolerance,
      .poisson_ratio = ring->poisson_ratio,
      .volume_swell = ring->storage.volume_swell,
  };
}

SbRoughSurface sb_model_surface(const SbModel *model, int seal, double roughness) {
  return (SbRoughSurface){.model = model->surface,
                          .product = roughness * model->gt_product,
                          .sigma = roughness * model->sigma,
                          .sigma_over_beta = roughness * model->sigma_over_beta,
                          .modulus = model->seal[seal].reduced_modulus,
                          .work = model->work_of_adhesion};
}

SbSealPressure sb_model_seal_pressure(const SbModel *model, int seal, SbChamber chamber) {
  double canister = model->canister_pressure;
  if (model->kind == SB_VALVE_GASKET) {
    const double held = chamber == SB_CHAMBER_CLOSED ? 0 : canister; // vented, else full
    return seal == SB_INNER ? (SbSealPressure){canister, held} : (SbSealPressure){held, 0};
  }
  // With ports the pressure is in between: vented means none, closed means all of it.
  bool vented_at_rest = model->pressure_map != SB_MAP_CHAMBER_FILLED;
  double in_chamber = chamber == SB_CHAMBER_AT_REST && vented_at_rest ? 0 : canister;
  if (seal == SB_INNER) {
    return (SbSealPressure){canister, in_chamber};
  }
  return (SbSealPressure){in_chamber, 0};
}
