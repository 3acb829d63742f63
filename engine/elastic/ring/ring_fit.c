// One fitment to a tolerance, with the error estimated from two meshes.
//
// A coarse mesh with assumed contact zones finds the contacts; two meshes with vertices at the
// contact ends and sizes in the ratio 1 : 0.6 follow, each started from the one before. On such
// meshes load and peak converge with about the second power of the size (measured in
// tests/engine/test_ring_fit.c), so the finer one's error is a fraction of their difference.
#include "engine/elastic/ring/ring_private.h"

#include <math.h>

// Element size at a tolerance of 1e-3, and the share of the change between the two meshes that is
// taken for the finer one's error.
static const double SIZE = 0.03, SHARE = 0.6;

SbStatus sb_ring_fit(SbRing **out, SbRingResult *result, SbRingError *error, const SbRingBody *body,
                     const SbRingLoad *load, double tolerance, const SbRingOptions *options,
                     SbWarnings *warnings, SbReport *report) {
  if (out != NULL) {
    *out = NULL;
  }
  *error = (SbRingError){0};
  if (!(tolerance >= 1e-5 && tolerance <= 0.1)) {
    return sb_fail(report, SB_ERROR_RANGE, "the ring's tolerance %g lies outside 1e-5 .. 0.1",
                   tolerance);
  }
  double size = SIZE * sqrt(tolerance / 1e-3);
  size = fmin(0.05, fmax(0.008, size));
  SbRingOptions first = options != NULL ? *options : (SbRingOptions){0};
  first.element_size = size / 0.6;
  first.fit_mesh = false;
  SbRing *ring = NULL;
  SbStatus status = sb_ring_create(&ring, body, load, &first, report);
  SbRingResult coarse = {0};
  if (status == SB_OK) {
    status = sb_ring_refit(ring, size / 0.6, report);
  }
  if (status == SB_OK) {
    sb_ring_result(ring, &coarse);
    status = sb_ring_refit(ring, size, report);
  }
  if (status != SB_OK) {
    sb_ring_destroy(ring);
    return status;
  }
  sb_ring_result(ring, result);
  if (!result->touching) {
    sb_warn(warnings, "ring-no-contact", "bore.diameter",
            "the fitted ring does not touch the bore: radial thickness %.4g mm in %.4g mm",
            1e3 * result->thickness, 1e3 * (load->bore_radius - load->floor_radius));
  } else {
    double width = result->contact_right - result->contact_left;
    double coarse_width = coarse.contact_right - coarse.contact_left;
    double load_change = fabs(coarse.bore_force / result->bore_force - 1.0);
    double peak_change = fabs(coarse.pressure_peak / result->pressure_peak - 1.0);
    double width_change = fabs(coarse_width / width - 1.0);
    double relative = size / SIZE;
    double pressed = fmax(load->pressure_left, load->pressure_right) / body->modulus;
    error->load = fmax(SHARE * load_change, (2e-4 + 2e-3 * pressed) * relative);
    error->peak = fmax(SHARE * peak_change, 4e-4 * relative);
    error->width = fmax(SHARE * width_change, 1.5e-3 * relative);
    if (error->load > tolerance) {
      sb_warn(warnings, "ring-tolerance", "", "the ring's load is known to %.2g only, not %.2g",
              error->load, tolerance);
    }
  }
  if (out != NULL) {
    *out = ring;
  } else {
    sb_ring_destroy(ring);
  }
  return sb_succeed(report);
}
