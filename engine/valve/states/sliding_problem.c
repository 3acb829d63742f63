// Problems of the solvers of fit and film for a seal; see sliding.h.
#include "engine/valve/states/contact_law.h"

#include <math.h>

void sb_model_fit_problem(SbFitProblem *out, const SbModel *model, int seal, double pressure) {
  static const SbFitNames names = {.profile = "seal.profile = ",
                                   .fitted = " (models.section = fitted does not)",
                                   .ring = " (models.fit = ring shows it)"};
  const SbSealModel *ring = &model->seal[seal];
  *out = (SbFitProblem){
      .names = &names,
      .model = model->fit,
      .profile = sb_model_profile(model, seal),
      .variant = model->fit_variant,
      .fitted_section = model->fitted_section,
      .section_diameter = ring->section_diameter,
      .inner_diameter = ring->inner_diameter,
      .modulus = ring->modulus,
      .poisson_ratio = ring->poisson_ratio,
      .mooney_share = ring->mooney_share,
      .housing_modulus = model->housing_modulus,
      .housing_poisson = model->housing_poisson_ratio,
      .radial_space = model->radial_space,
      .bore_diameter = model->bore_diameter,
      .gland_width = model->axial_width,
      .wall_draft = model->groove_draft,
      .groove_corner = model->groove_corner,
      .groove_chamfer = model->groove_chamfer,
      .land_diameter = model->stem_diameter,
      .groove = sb_model_groove(model),
      .floor_friction = model->floor_friction,
      .wall_friction = model->wall_friction,
      .start_at_wall = model->start_at_wall,
      .gasket = sb_contact_law(model)->around_stem,
      .pressure = pressure,
      .tolerance = model->tolerance,
  };
}

void sb_sliding_film_problem(SbFilmProblem *out, const SbModel *model, int seal,
                             SbSealPressure pressure, double load_net, double speed) {
  sb_film_problem_init(out);
  out->load = load_net;
  out->speed = speed;
  out->radius = model->seal[seal].radius;
  out->modulus = model->seal[seal].reduced_modulus;
  out->viscosity = model->viscosity;
  out->pressure_left = pressure.left;
  out->pressure_right = pressure.right;
  out->pressure_viscosity = model->pressure_viscosity;
  out->eyring_stress = model->eyring_stress;
  // A fluid next to the seal that is below its vapour pressure has evaporated: the film then
  // cavitates at the pressure around it.
  out->rupture_pressure = fmin(model->rupture_pressure, fmin(pressure.left, pressure.right));
  out->tolerance = model->tolerance;
  out->profile_points = 1500; // drawn and written, not differentiated
}

// Gives a surface the gap whose dry contact has the pressure of the fit, and solves that contact as
// a check. A gap of many polynomials may have a second contact outside; then fewer are used.
static SbStatus match_fit(SbSurfaceCompliance *surface, double load, const SbFit *fit, double left,
                          double right, SbReport *report) {
  enum { ORDER = 8, LEAST = 3 };
  SbStatus status = SB_ERROR_INPUT;
  for (int order = ORDER; order >= LEAST && status != SB_OK; order--) {
    SbDryContact dry;
    status = sb_compliance_match(surface, order, fit->profile_count, fit->profile_x, fit->profile_p,
                                 left, right, report);
    if (status == SB_OK) {
      status = sb_dry_contact(&dry, surface, load, left, right, report);
    }
  }
  return status;
}

SbStatus sb_sliding_surface(SbSurfaceCompliance *out, double *load, const SbFit *fit,
                            const SbModel *model, int seal, SbSealPressure pressure,
                            SbWarnings *warnings, SbReport *report) {
  const SbFitKind *kind = sb_fit_kind(fit->model);
  if (!kind->body || fit->profile_count < 12) {
    return sb_fail(report, SB_ERROR_INPUT, "the fitment model gives no pressure of a body");
  }
  const SbSealModel *ring = &model->seal[seal];
  double low = fmin(pressure.left, pressure.right);
  double left = pressure.left - low;
  double right = pressure.right - low;
  *load = fit->load_per_length + left * fit->contact_left - right * fit->contact_right;
  if (fit->surface.modes > 0) {
    // Condensed against a rigid bore; the housing's compliance is that of a half-plane, in
    // addition.
    double rubber = 2 * ring->modulus / (1 - ring->poisson_ratio * ring->poisson_ratio);
    *out = fit->surface;
    out->modulus = 1 / (1 / out->modulus + 1 / ring->reduced_modulus - 1 / rubber);
    if (match_fit(out, *load, fit, left, right, report) == SB_OK) {
      return SB_OK;
    }
  }
  if (kind->section && warnings != NULL) {
    sb_warn(warnings, "film-disc-surface", sb_input(SB_P_MODELS_FIT),
            "the %s ring's surface next to its contact is too steep for a film on it: the film "
            "uses the ring's pressure, but the compliance of a linear disc",
            sb_seal_name(seal));
  }
  double radius = 0.5 * fit->section_diameter_fitted;
  double middle = 0.5 * (fit->contact_left + fit->contact_right);
  // The disc's middle is the contact's: pressure against the wall moves both.
  double reach = 0.7 * fit->contact_width;
  SbStatus status = sb_compliance_disc(out, radius, ring->modulus, ring->poisson_ratio,
                                       fmin(reach, 0.9 * radius), report);
  if (status != SB_OK) {
    return status;
  }
  out->left += middle;
  out->right += middle;
  out->modulus = ring->reduced_modulus;
  return match_fit(out, *load, fit, left, right, report);
}
