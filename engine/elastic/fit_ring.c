// The finite-strain ring as a contact model: rigid bore, groove floor and groove walls, the
// groove's middle at x = 0, the fluid on one side. Load is that of the whole ring; per length it is
// given at the bore. Equations and validity: engine/elastic/ring. Leaves out the housing's
// elasticity (2.6 GPa against 2.5 MPa: below 0.1 %), friction and the gap that a vented land
// leaves.
#include "engine/elastic/fit_models.h"

#include "engine/elastic/ring/ring.h"

#include <math.h>

SbStatus sb_fit_ring(SbFit *out, const SbFitProblem *in, SbReport *report) {
  const SbRingBody body = {.section_diameter = in->section_diameter,
                           .inner_diameter = in->inner_diameter,
                           .modulus = in->modulus,
                           .poisson_ratio = in->poisson_ratio};
  SbRingLoad load = SB_RING_LOAD_INIT;
  load.bore_radius = 0.5 * in->bore_diameter;
  load.floor_radius = load.bore_radius - in->radial_space;
  load.wall_right = 0.5 * in->gland_width;
  load.wall_left = -load.wall_right;
  load.pressure_left = fmax(0.0, in->pressure);
  load.pressure_right = fmax(0.0, -in->pressure);
  const SbRingOptions options = {.poll = in->cancel, .poll_data = in->cancel_data};
  const double tolerance = in->tolerance > 0.0 ? fmin(0.1, fmax(1e-5, in->tolerance)) : 1e-3;
  SbRing *ring = NULL;
  SbRingResult result;
  SbRingError error;
  SbStatus status = sb_ring_fit(&ring, &result, &error, &body, &load, tolerance, &options,
                                &out->warnings, report);
  if (status != SB_OK) {
    return status;
  }
  out->circumference = M_PI * in->bore_diameter;
  out->touches = result.touching;
  out->contact_left = result.contact_left;
  out->contact_right = result.contact_right;
  out->contact_width = result.contact_right - result.contact_left;
  out->load = result.bore_force;
  out->load_per_length = out->load / out->circumference;
  out->pressure_peak = result.pressure_peak;
  out->solver.converged = true;
  out->solver.unknowns = (size_t)result.unknowns;
  out->solver.newton_iterations = (size_t)result.newton_iterations;
  out->solver.error_estimate.load = error.load;
  out->solver.error_estimate.pressure_peak = error.peak;
  out->solver.error_estimate.contact_width = error.width;
  const int count = sb_ring_profile(ring, out->profile_x, out->profile_p, NULL, SB_FIT_PROFILE_MAX);
  out->profile_count = (size_t)(count < SB_FIT_PROFILE_MAX ? count : SB_FIT_PROFILE_MAX);
  sb_ring_destroy(ring);
  return SB_OK;
}
