// Karaszkiewicz's ring in its groove, thesis eq. 5.1-5.7; see the header.
#include "engine/contact/closed/karaszkiewicz.h"

#include <math.h>

static bool positive(double value) {
  return isfinite(value) && value > 0.0;
}

static SbStatus check(const SbKaraszkiewiczInput *in, SbReport *report) {
  if (!positive(in->section_diameter)) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "seal.section_diameter",
                             "section diameter %g m is not positive", in->section_diameter);
  }
  if (!positive(in->inner_diameter)) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "seal.inner_diameter",
                             "inner diameter %g m is not positive", in->inner_diameter);
  }
  if (!positive(in->radial_space)) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "gland.radial_space",
                             "radial space %g m is not positive", in->radial_space);
  }
  if (!positive(in->modulus)) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "seal.modulus",
                             "modulus %g Pa is not positive", in->modulus);
  }
  if (!(in->poisson_ratio >= 0.0 && in->poisson_ratio < 0.5)) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "seal.poisson_ratio",
                             "Poisson's ratio %g is not in [0, 0.5)", in->poisson_ratio);
  }
  if (!isfinite(in->pressure)) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "canister.pressure",
                             "pressure is not a finite number");
  }
  return SB_OK;
}

SbStatus sb_karaszkiewicz(SbKaraszkiewicz *out, const SbKaraszkiewiczInput *in,
                          SbWarnings *warnings, SbReport *report) {
  *out = (SbKaraszkiewicz){0};
  SbStatus status = check(in, report);
  if (status != SB_OK) {
    return status;
  }
  const double d = in->section_diameter;
  const double eps = (d - in->radial_space) / d;
  out->squeeze = eps;
  out->circumference = M_PI * (in->inner_diameter + d);

  // A ring smaller than its space carries nothing.
  if (!(eps > 0.0)) {
    sb_warn(warnings, "no-contact", "seal.section_diameter",
            "the ring does not touch the bore (squeeze %.3g %%): load 0", 100.0 * eps);
    return sb_succeed(report);
  }
  out->touches = true;
  if (eps < SB_KARASZKIEWICZ_SQUEEZE_MIN || eps > SB_KARASZKIEWICZ_SQUEEZE_MAX) {
    sb_warn(warnings, "karaszkiewicz-squeeze", "seal.section_diameter",
            "squeeze %.3g %% is outside 7 to 25 %%, the range of Karaszkiewicz's formulae",
            100.0 * eps);
  }

  // Width 5.2, mean pressure 5.4, load and elliptic peak.
  const double p = fabs(in->pressure);
  const double unloaded = 2.0 * eps + 0.13;
  const double growth = 0.39 / (1.0 - eps) - 0.5 * unloaded;
  const double nu = in->poisson_ratio;
  out->contact_width = d * (unloaded - growth * expm1(-4.6 * p / in->modulus));
  out->mean_pressure = M_PI / 6.0 * unloaded * in->modulus + nu / (1.0 - nu) * p;
  out->pressure_peak = 4.0 / M_PI * out->mean_pressure;
  out->load_per_length = out->mean_pressure * out->contact_width;
  out->load = out->load_per_length * out->circumference;
  return sb_succeed(report);
}
