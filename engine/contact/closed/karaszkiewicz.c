// Karaszkiewicz's ring in its groove, thesis eq. 5.1-5.7; see the header.
#include "engine/contact/closed/karaszkiewicz.h"

#include "engine/base/check.h"

#include <math.h>

SbStatus sb_karaszkiewicz(SbKaraszkiewicz *out, const SbKaraszkiewiczInput *in,
                          SbWarnings *warnings, SbReport *report) {
  *out = (SbKaraszkiewicz){0};
  SbStatus status = SB_CHECK(
      report,
      {"seal.section_diameter", "the section diameter [m]", in->section_diameter, SB_ABOVE_ZERO},
      {"seal.inner_diameter", "the inner diameter [m]", in->inner_diameter, SB_ABOVE_ZERO},
      {"gland.radial_space", "the radial space [m]", in->radial_space, SB_ABOVE_ZERO},
      {"seal.modulus", "the modulus [Pa]", in->modulus, SB_ABOVE_ZERO},
      {"seal.poisson_ratio", "Poisson's ratio", in->poisson_ratio, SB_POISSON},
      {"canister.pressure", "the pressure [Pa]", in->pressure, SB_FINITE});
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
