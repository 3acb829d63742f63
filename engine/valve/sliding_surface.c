// The surface of a fitted body as the film takes it; see sb_sliding_surface() in sliding.h.
#include "engine/valve/sliding.h"

#include <math.h>

// Gives a surface the gap whose dry contact has the fitment's pressure, and solves that for a
// check. A gap of many polynomials may touch again outside the contact; then fewer do.
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
  bool own = fit->model == SB_FIT_DISC || fit->model == SB_FIT_RING;
  if (!own || fit->profile_count < 12) {
    return sb_fail(report, SB_ERROR_INPUT, "the fitment model gives no pressure of a body");
  }
  const SbSealModel *ring = &model->seal[seal];
  double low = fmin(pressure.left, pressure.right);
  double left = pressure.left - low;
  double right = pressure.right - low;
  *load = fit->load_per_length + left * fit->contact_left - right * fit->contact_right;
  if (fit->surface.modes > 0) {
    // Condensed against a rigid bore; the housing gives way as a half-plane beside it.
    double rubber = 2 * ring->modulus / (1 - ring->poisson_ratio * ring->poisson_ratio);
    *out = fit->surface;
    out->modulus = 1 / (1 / out->modulus + 1 / ring->reduced_modulus - 1 / rubber);
    if (match_fit(out, *load, fit, left, right, report) == SB_OK) {
      return SB_OK;
    }
  }
  if (fit->model == SB_FIT_RING && warnings != NULL) {
    sb_warn(warnings, "film-disc-surface", "models.fit",
            "the %s ring's surface beside its contact is too steep for a film on it: the film "
            "takes the ring's pressure, but gives way like a linear disc",
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
