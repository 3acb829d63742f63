// The two discs as contact models: the stretch shrinks the section, the flats stand for stem and
// bore, and load per length times the fitted mean circumference pi (D - g) is the load.
#include "engine/contact/fit_models.h"

#include <math.h>

#include "engine/contact/disc/disc.h"
#include "engine/contact/disc/disc_thesis.h"

// Variants of `disc`: kernel, and whether the fluid is on both flanks.
enum { BOTH_FLANKS = SB_DISC_VARIANT_COUNT };

SbStatus sb_fit_disc(SbFit *out, const SbFitProblem *in, SbReport *report) {
  const bool both = in->variant >= BOTH_FLANKS;
  const double p = fabs(in->pressure);
  const SbDiscProblem problem = {
      .variant = (SbDiscVariant)(in->variant % BOTH_FLANKS),
      .diameter = out->section_diameter_fitted,
      .space = in->radial_space,
      .modulus = in->modulus,
      .poisson_ratio = in->poisson_ratio,
      .pressure_left = both || in->pressure > 0.0 ? p : 0.0,
      .pressure_right = both || in->pressure < 0.0 ? p : 0.0,
      .tolerance = in->tolerance,
  };
  SbDisc disc;
  const SbStatus status = sb_disc_solve(&disc, &problem, &out->warnings, report);
  if (status != SB_OK && status != SB_ERROR_NOT_CONVERGED) {
    return status;
  }
  out->circumference = M_PI * (in->bore_diameter - in->radial_space);
  out->touches = disc.touches;
  out->contact_left = disc.contact_left;
  out->contact_right = disc.contact_right;
  out->contact_width = disc.contact_width;
  out->load_per_length = disc.load_per_length;
  out->load = disc.load_per_length * out->circumference;
  out->pressure_peak = disc.pressure_peak;
  out->solver.converged = disc.converged;
  out->solver.unknowns = disc.unknowns;
  out->solver.newton_iterations = disc.newton_iterations;
  out->solver.error_estimate.load = disc.error_estimate.load;
  out->solver.error_estimate.pressure_peak = disc.error_estimate.pressure_peak;
  out->solver.error_estimate.contact_width = disc.error_estimate.contact_width;

  // Profile at points that crowd towards the edges.
  enum { POINTS = 257 };
  out->profile_count = disc.touches ? POINTS : 0;
  for (size_t i = 0; i < out->profile_count; i++) {
    const double t = sin(M_PI * ((double)i / (POINTS - 1) - 0.5));
    const double x = 0.5 * ((1.0 - t) * disc.contact_left + (1.0 + t) * disc.contact_right);
    out->profile_x[i] = x;
    out->profile_p[i] = sb_disc_pressure(&disc, x);
  }
  return status;
}

// Solves with the thesis' nodes and with twice as many, which shows what the nodes cost.
SbStatus sb_fit_disc_thesis(SbFit *out, const SbFitProblem *in, SbReport *report) {
  const SbDiscThesisInput input = {
      .section_diameter = in->section_diameter,
      .section_fitted = out->section_diameter_fitted,
      .radial_space = in->radial_space,
      .modulus = in->modulus,
      .poisson_ratio = in->poisson_ratio,
      .pressure = fabs(in->pressure),
  };
  const double degree = M_PI / 180.0;
  SbDiscThesis disc;
  SbDiscThesis fine;
  SbStatus status = sb_disc_thesis(&disc, &input, degree, &out->warnings, report);
  if (status == SB_OK) {
    status = sb_disc_thesis(&fine, &input, 0.5 * degree, NULL, report);
  }
  if (status != SB_OK) {
    return status;
  }
  out->circumference = M_PI * (in->bore_diameter - in->radial_space);
  out->touches = disc.touches;
  out->contact_width = disc.contact_width;
  out->contact_left = -0.5 * disc.contact_width;
  out->contact_right = 0.5 * disc.contact_width;
  out->load_per_length = disc.load_per_length;
  out->load = disc.load_per_length * out->circumference;
  out->pressure_peak = disc.pressure_peak;
  out->solver.converged = true;
  out->solver.unknowns = disc.nodes;
  out->solver.newton_iterations = disc.iterations;
  if (!disc.touches) {
    return sb_succeed(report);
  }

  // The nodes' error in load and peak is first order in their distance, twice the difference; the
  // edge is known to half a node, which leaves its square where the difference happens to vanish.
  const double half_node = 0.5 * degree * cos(asin(disc.contact_width / in->section_diameter)) *
                           in->section_diameter / disc.contact_width;
  out->solver.error_estimate.load =
      2.0 * fabs(fine.load_per_length / disc.load_per_length - 1.0) + 0.25 * half_node * half_node;
  out->solver.error_estimate.pressure_peak =
      2.0 * fabs(fine.pressure_peak / disc.pressure_peak - 1.0) + 0.25 * half_node * half_node;
  out->solver.error_estimate.contact_width =
      fmax(half_node, 2.0 * fabs(fine.contact_width / disc.contact_width - 1.0));

  // Nodal pressures, on the free circle as the thesis plots them, and zero at the edges.
  const size_t side = disc.nodes;
  out->profile_count = 2 * side + 1;
  for (size_t i = 1; i + 1 < out->profile_count; i++) {
    const double k = (double)i - (double)side;
    out->profile_x[i] = 0.5 * in->section_diameter * sin(k * degree);
    out->profile_p[i] = disc.pressure[(size_t)fabs(k)];
  }
  out->profile_x[0] = out->contact_left;
  out->profile_p[0] = 0.0;
  out->profile_x[2 * side] = out->contact_right;
  out->profile_p[2 * side] = 0.0;
  return sb_succeed(report);
}
