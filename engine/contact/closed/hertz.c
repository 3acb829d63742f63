// Hertz line contact and the disc between two flats (thesis 6.33-6.35, Johnson 5.58); see the
// header.
#include "engine/contact/closed/hertz.h"

#include "engine/base/check.h"
#include "engine/numeric/root.h"

#include <math.h>

double sb_hertz_half_width(double load_per_length, double radius, double reduced_modulus) {
  return load_per_length > 0.0 ? sqrt(8.0 * load_per_length * radius / (M_PI * reduced_modulus))
                               : 0.0;
}

// Fills everything from the half-width.
static void fill(SbHertz *out, double b, double radius, double reduced_modulus,
                 double disc_modulus) {
  out->half_width = b;
  out->load_per_length = M_PI * reduced_modulus * b * b / (8.0 * radius);
  out->pressure_peak = reduced_modulus * b / (4.0 * radius);
  out->approach = b > 0.0 ? 2.0 * out->load_per_length / (M_PI * disc_modulus) *
                                (2.0 * log(4.0 * radius / b) - 1.0)
                          : 0.0;
}

static void warn_width(SbWarnings *warnings, double b, double radius) {
  if (b > SB_HERTZ_WIDTH_MAX * radius) {
    sb_warn(warnings, "hertz-width", "gland.radial_space",
            "contact half-width is %.2g of the radius: Hertz theory wants it small (below %g)",
            b / radius, SB_HERTZ_WIDTH_MAX);
  }
}

// Approach over k R, less the one wanted, at half-width t R.
static double approach_of_width(double *slope, double t, const void *target) {
  *slope = 4.0 * t * (log(4.0 / t) - 1.0);
  return t * t * (2.0 * log(4.0 / t) - 1.0) - *(const double *)target;
}

SbStatus sb_hertz_from_approach(SbHertz *out, double approach, double radius,
                                double reduced_modulus, double disc_modulus, SbWarnings *warnings,
                                SbReport *report) {
  *out = (SbHertz){0};
  SbStatus status =
      SB_CHECK(report, {"seal.section_diameter", "the contact's radius [m]", radius, SB_ABOVE_ZERO},
               {"seal.modulus", "the reduced modulus [Pa]", reduced_modulus, SB_ABOVE_ZERO},
               {"seal.modulus", "the disc's modulus [Pa]", disc_modulus, SB_ABOVE_ZERO},
               {"", "the approach [m]", approach, SB_FINITE});
  if (status != SB_OK) {
    return status;
  }
  if (!(approach > 0.0)) {
    sb_warn(warnings, "no-contact", "gland.radial_space",
            "the disc does not touch (approach %.3g mm): load 0", 1e3 * approach);
    return sb_succeed(report);
  }

  // With t = b/R the approach is k t^2 (2 ln(4/t) - 1) R, rising up to t = 4/e and
  // meaningful below t = 1.
  const double target = 4.0 * disc_modulus / reduced_modulus * approach / radius;
  if (target >= 2.0 * log(4.0) - 1.0) {
    return sb_fail_parameter(report, SB_ERROR_INFEASIBLE, "gland.radial_space",
                             "an approach of %.3g radii makes Hertz's contact wider than the disc",
                             approach / radius);
  }
  double t = sb_newton_bracketed(approach_of_width, &target, 0.0, 1.0, sqrt(target / 6.0));
  fill(out, t * radius, radius, reduced_modulus, disc_modulus);
  warn_width(warnings, out->half_width, radius);
  return sb_succeed(report);
}
