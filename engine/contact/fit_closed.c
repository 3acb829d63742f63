// The closed forms as contact models: Karaszkiewicz, Hertz, Lindley with Kuran, Green and English,
// each turned into the common result. They take the free section and the free mean diameter, know
// nothing of stretch or walls, and all but the first nothing of the fluid's pressure.
#include "engine/contact/fit_models.h"

#include <float.h>
#include <math.h>

#include "engine/contact/closed/green_english.h"
#include "engine/contact/closed/hertz.h"
#include "engine/contact/closed/karaszkiewicz.h"
#include "engine/contact/closed/lindley.h"
#include "engine/contact/closed/reduced_modulus.h"

// Closed forms hold to rounding and have no unknowns. The profile is the elliptic one of the
// model's width and load, on Chebyshev-spaced points.
static void fill(SbFit *out, double circumference, double width, double load_per_length) {
  enum { POINTS = 257 };
  out->circumference = circumference;
  out->contact_width = width;
  out->contact_left = -0.5 * width;
  out->contact_right = 0.5 * width;
  out->load_per_length = load_per_length;
  out->load = load_per_length * circumference;
  out->touches = width > 0.0;
  out->pressure_peak = out->touches ? 4.0 * load_per_length / (M_PI * width) : 0.0;
  out->solver.converged = true;
  out->solver.error_estimate.load = 16.0 * DBL_EPSILON;
  out->solver.error_estimate.pressure_peak = 16.0 * DBL_EPSILON;
  out->solver.error_estimate.contact_width = 16.0 * DBL_EPSILON;
  out->profile_count = out->touches ? POINTS : 0;
  for (size_t i = 0; i < out->profile_count; i++) {
    double angle = M_PI * ((double)i / (POINTS - 1) - 0.5);
    out->profile_x[i] = 0.5 * width * sin(angle);
    out->profile_p[i] = out->pressure_peak * (i == 0 || i == POINTS - 1 ? 0.0 : cos(angle));
  }
}

static void warn_pressure_ignored(SbFit *out, const SbFitProblem *in) {
  if (in->pressure != 0.0 && out->touches) {
    sb_warn(&out->warnings, "pressure-ignored", "canister.pressure",
            "the model %s knows no fluid pressure: %.3g MPa left out", sb_fit_model_name(in->model),
            1e-6 * in->pressure);
  }
}

SbStatus sb_fit_karaszkiewicz(SbFit *out, const SbFitProblem *in, SbReport *report) {
  const SbKaraszkiewiczInput input = {
      .section_diameter = in->section_diameter,
      .inner_diameter = in->inner_diameter,
      .radial_space = in->radial_space,
      .modulus = in->modulus,
      .poisson_ratio = in->poisson_ratio,
      .pressure = in->pressure,
  };
  SbKaraszkiewicz k;
  SbStatus status = sb_karaszkiewicz(&k, &input, &out->warnings, report);
  if (status == SB_OK) {
    fill(out, k.circumference, k.contact_width, k.load_per_length);
  }
  return status;
}

// The disc of the free section between flats that approach by d - g.
SbStatus sb_fit_hertz(SbFit *out, const SbFitProblem *in, SbReport *report) {
  SbHertz h;
  const double nu = in->poisson_ratio;
  SbStatus status = sb_hertz_from_approach(
      &h, in->section_diameter - in->radial_space, 0.5 * in->section_diameter,
      sb_reduced_modulus(in->modulus, nu, in->housing_modulus, in->housing_poisson),
      in->modulus / (1.0 - nu * nu), &out->warnings, report);
  if (status == SB_OK) {
    fill(out, M_PI * (in->inner_diameter + in->section_diameter), 2.0 * h.half_width,
         h.load_per_length);
    warn_pressure_ignored(out, in);
  }
  return status;
}

// Load F/(pi d D E) and width b/d of the fits by Lindley and by Green and English.
static void fill_fit(SbFit *out, const SbFitProblem *in, double load_factor, double width_ratio) {
  if (!(out->squeeze > 0.0)) {
    sb_warn(&out->warnings, "no-contact", "seal.section_diameter",
            "the ring does not touch the bore (squeeze %.3g %%): load 0", 100.0 * out->squeeze);
  }
  fill(out, M_PI * (in->inner_diameter + in->section_diameter), width_ratio * in->section_diameter,
       load_factor * in->section_diameter * in->modulus);
  warn_pressure_ignored(out, in);
}

SbStatus sb_fit_lindley(SbFit *out, const SbFitProblem *in, SbReport *report) {
  SbLindley l;
  sb_lindley(&l, (SbLindleyVariant)in->variant, out->squeeze, in->poisson_ratio, &out->warnings);
  fill_fit(out, in, l.load_factor, l.width_ratio);
  return sb_succeed(report);
}

SbStatus sb_fit_green_english(SbFit *out, const SbFitProblem *in, SbReport *report) {
  SbGreenEnglish g;
  sb_green_english(&g, (SbGreenEnglishRow)in->variant, out->squeeze, in->poisson_ratio,
                   &out->warnings);
  fill_fit(out, in, g.load_factor, g.width_ratio);
  return sb_succeed(report);
}
