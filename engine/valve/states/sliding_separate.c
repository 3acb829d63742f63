// A ring's film and rough contact, one after the other (models.asperities = beside): the smooth
// film carries the full load, and its thickness gives the real area. A row of contact_law.c;
// equations in sliding.h.
#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/contact/rough/persson.h"
#include "engine/valve/states/sliding_private.h"

#include <math.h>

// Fraction of the area in real contact, sliding and at rest. Greenwood and Tripp's depends on the
// film, Persson's on the net pressure that the solids carry.
static SbStatus real_area(SbSealState *out, const SbSlidingTask *task, double roughness,
                          SbReport *report) {
  const SbModel *model = task->model;
  const SbRoughSurface surface = sb_model_surface(model, task->seal, roughness);
  if (sb_rough_kind(model->surface)->spectrum) {
    SbSpectrum spectrum;
    SbStatus status = sb_spectrum_from_asperities(&spectrum, surface.sigma, surface.sigma_over_beta,
                                                  surface.product, report);
    if (status != SB_OK) {
      return status;
    }
    double pressure = fmax(out->load_net, 0) / (out->contact_right - out->contact_left);
    out->real_area_share = out->rest_area_share =
        sb_persson_area_share(&spectrum, spectrum.q1, surface.modulus, pressure);
    const double error = out->net_error + out->width_error;
    if (error > 0) {
      const double other =
          sb_persson_area_share(&spectrum, spectrum.q1, surface.modulus, pressure * (1 + error));
      out->area_error = out->rest_error = fabs(other / out->real_area_share - 1);
    }
    sb_sliding_warn_strength(task, out->real_area_share);
    return SB_OK;
  }
  if (surface.work > 0) {
    const SbAsperity tip = sb_rough_tip(&surface);
    sb_asperity_warn(task->warnings, &tip);
  }
  out->rest_area_share = sb_rough_area_share(&surface, 0);
  // Without a film there is no real contact under it either.
  out->real_area_share = sb_rough_area_share(&surface, out->lambda);
  if (out->central_error > 0) {
    const double thinner = sb_rough_area_share(&surface, out->lambda * (1 - out->central_error));
    out->area_error = fabs(thinner / out->real_area_share - 1);
  }
  if (isnan(out->real_area_share) && !isnan(out->lambda)) {
    return sb_fail(report, SB_ERROR_RANGE, "no asperity contact of the %s seal at λ = %g",
                   sb_seal_name(task->seal), out->lambda);
  }
  if (out->real_area_share > 0.3) {
    sb_warn(
        task->warnings, "real-area-large", SB_FILM_IN_ASPERITY_PRODUCT,
        "asperities of the %s seal touch on %.0f %% of the area: Greenwood and Tripp's asperities "
        "are no longer independent",
        sb_seal_name(task->seal), 100 * out->real_area_share);
  }
  return SB_OK;
}

SbStatus sb_sliding_rub(SbSealState *out, const SbSlidingTask *task, double roughness,
                        SbReport *report) {
  const SbModel *model = task->model;
  double area = (out->contact_right - out->contact_left) * model->bore_circumference;
  out->lambda = out->film_central / (roughness * model->sigma);
  SbStatus status = real_area(out, task, roughness, report);
  if (status != SB_OK) {
    return status;
  }
  out->boundary_area = model->shear_strength * out->real_area_share * area;
  out->boundary_load = model->load_coefficient * out->load;
  out->friction_viscous = 0;
  if (task->speed != 0 && out->film_central != 0) {
    // fmin() would take a film that was not computed for the greatest shear.
    double shear = model->viscosity * fabs(task->speed) / out->film_central;
    shear = shear > model->shear_strength ? model->shear_strength : shear;
    out->friction_viscous = shear * (1 - out->real_area_share) * area;
  }
  sb_sliding_kinetic_errors(out, 0);
  return SB_OK;
}

SbStatus sb_sliding_rough_contact(SbSealState *out, const SbSlidingTask *task, double roughness,
                                  SbReport *report) {
  const SbModel *model = task->model;
  SbStatus status = sb_sliding_rub(out, task, roughness, report);
  if (status != SB_OK) {
    return status;
  }
  out->rest_area = model->shear_strength * out->rest_area_share *
                   (out->contact_right - out->contact_left) * model->bore_circumference;
  out->rest_load = out->boundary_load;
  status = sb_sliding_set_static(out, task, report);
  sb_sliding_set_static_error(out);
  return status;
}

SbStatus sb_separate_update_errors(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  const SbSlidingMemory *memory = task->memory;
  if (out->film_central > 0 && sb_film_kind(task->model->film)->coupled) {
    sb_sliding_film_errors(out, memory->last, &memory->now->fit);
  } else if (out->film_central > 0) {
    sb_sliding_law_errors(out);
  }
  return sb_sliding_rough_contact(out, task, 1, report);
}

SbStatus sb_separate_solve(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  SbWarnings *warnings = task->warnings;
  const int seal = task->seal;
  SbStatus status = SB_OK;
  SbReport own = {0};
  // Film, only when sliding on a liquid.
  if (!sb_sliding_has_film(task)) {
    out->film_min = out->film_central = out->layer = 0;
  } else if (out->load_net <= 0) {
    out->opened = true;
    sb_warn(warnings, "film-no-net-load", sb_input(SB_P_CANISTER_PRESSURE),
            "the fluid alone carries the %s seal: no film law applies", sb_seal_name(seal));
  } else {
    status = sb_sliding_solve_film(task, out, &own);
    status = sb_sliding_opened_by_fluid(out, status, &own, seal, warnings, report);
    if (!sb_sliding_usable(status)) {
      return status;
    }
  }
  SbStatus area = sb_sliding_rough_contact(out, task, 1, status == SB_OK ? report : NULL);
  if (area != SB_OK) {
    return area;
  }
  // Regime and validity.
  if (task->speed != 0 && out->film_central > 0 && out->lambda < 1) {
    sb_warn(warnings, "boundary-regime", sb_input(SB_P_SURFACE_SIGMA),
            "λ = %.2g at the %s seal: boundary regime, the film is thinner than the roughness",
            out->lambda, sb_seal_name(seal));
  }
  return status;
}

double sb_ring_dry_gap(const SbModel *model, int seal, double over, double half) {
  return half * half / model->seal[seal].radius * sb_film_dry_gap(over);
}
