// Lindley's load and widths and Kuran's width, thesis eq. 2.7-2.13; see the header.
#include "engine/contact/closed/lindley.h"

#include <math.h>

void sb_lindley(SbLindley *out, SbLindleyVariant variant, double squeeze, double poisson_ratio,
                SbWarnings *warnings) {
  *out = (SbLindley){0};
  if (!(squeeze > 0.0)) {
    return;
  }
  const double s = squeeze;
  const bool initial = variant == SB_LINDLEY_INITIAL;
  const double s_max = initial ? SB_LINDLEY_INITIAL_MAX : SB_LINDLEY_SQUEEZE_MAX;
  if (s > s_max) {
    sb_warn(warnings, "lindley-squeeze", "seal.section_diameter",
            "squeeze %.3g %% is beyond %.3g %%, the range of Lindley's formula", 100.0 * s,
            100.0 * s_max);
  }
  if (poisson_ratio < 0.45) {
    sb_warn(warnings, "incompressible-assumed", "seal.poisson_ratio",
            "the formula is for incompressible rubber, not Poisson's ratio %.3g", poisson_ratio);
  }
  out->load_factor = 1.25 * s * sqrt(s) + (initial ? 0.0 : 50.0 * pow(s, 6.0));
  switch (variant) {
  case SB_LINDLEY_SIMPLE_WIDTH:
    out->width_ratio = 2.4 * s;
    break;
  case SB_LINDLEY_KURAN:
    out->width_ratio = 2.5 * s;
    break;
  default:
    out->width_ratio = sqrt(6.0 / M_PI * out->load_factor);
    break;
  }
}
