// One fit to a tolerance, with the error estimated from meshes of different size.
//
// A coarse mesh with assumed contact zones finds the contacts. Meshes with vertices at the contact
// ends follow, each started from the previous one, until the estimate meets the tolerance. The
// estimate is a fraction of the last change, but at least a minimum that was determined with much
// finer meshes for squeeze 10-40 %, pressure 0-2 MPa at E = 2.5 MPa (tests/engine/test_ring_fit.c).
// The contact ends contribute least without fluid pressure; under pressure the load changes with
// the position of its end, in proportion to p/E or, with little squeeze, to the fraction of the
// load that the fluid carries.
#include "engine/contact/ring/ring_private.h"

#include <math.h>

enum { REFINEMENTS = 3 };

// Element size at a tolerance of 1e-3, ratio of sizes, and the share of the change between two
// meshes that is taken for the finer one's error.
static const double SIZE = 0.03, RATIO = 0.6, SHARE = 0.6;
static const double SIZE_LEAST = 0.008, SIZE_MOST = 0.05;

// From this tolerance on the largest elements are larger: loads and widths 0.5 % from those of a
// tolerance of 1e-3, films 1.5 % (ring-cycle).
static const double COARSE = 0.01;

// Of a dragged ring's load on the mesh of its path, whose elements are not the contact's, a third
// of the largest error found: 3 %, and where it rolls over a chamfer 5 % in one of 30.
static const double UNFITTED = 0.01, UNFITTED_CHAMFER = 0.02;

// Fraction of the bore's friction that may be missing without a report.
static const double LACK = 0.01;

// Error of a section whose surface creases or nearly does, per unit of size: the depth of the
// crease depends on the elements there (X squeezed by 20 and 25 %: 0.4 and 1.1 % at 0.05).
static const double CREASED = 0.25, NEAR_CREASE = 0.85;

// Floors at SIZE, per unit of size.
static double load_floor(const SbRingBody *body, const SbRingLoad *load) {
  return 2e-4 + 2e-3 * fmax(load->pressure_left, load->pressure_right) / body->modulus;
}

// If the fluid carries much of the load, the position of the contact's ends shifts a larger part of
// it.
static double fluid_floor(const SbRingResult *result, const SbRingBody *body,
                          const SbRingLoad *load) {
  double pressure = fmax(load->pressure_left, load->pressure_right);
  double around = body->plane_strain ? 1.0 : 2.0 * M_PI * fabs(load->bore_radius);
  double fluid = pressure * around * (result->contact_right - result->contact_left);
  return 2e-4 + 1e-3 * fmin(1.0, fluid / result->bore_force);
}

// Turn that nothing but a loss of balance gives a section that nothing drags [rad].
static const double ROLLED = 0.35;

static double change(double fine, double coarse) {
  return fine != 0.0 ? fabs(coarse / fine - 1.0) : 0.0;
}

// Additional error of parts in bending at SIZE. For webs and lobes it decreases with the fourth
// power of the size, like the error of their energy (T by 5 to 15 %: 0.2 % at 0.05, 0.03 % at SIZE;
// X by 15 %: 0.6 and 0.04 %). For lips, whose tips have short contacts, it decreases irregularly
// (by 10 to 20 %: 0.2 % at 0.05, 0.1 % at SIZE and at two thirds of it).
static double bent(const SbRing *ring, double relative) {
  if (sb_ring_outline_has_sides(&ring->outline)) {
    return 1.5e-3 * relative;
  }
  const bool bends =
      sb_ring_bends(&ring->body.profile) || ring->body.profile.kind == SB_SEAL_PROFILE_X;
  return bends ? 1e-3 * pow(relative, 4.0) : 0.0;
}

static void estimate(SbRingResult *fine, const SbRingResult *coarse, const SbRing *ring,
                     double size, double floor_load) {
  double relative = size / SIZE;
  double load = change(fine->bore_force, coarse->bore_force);
  double peak = change(fine->pressure_peak, coarse->pressure_peak);
  double width = change(fine->contact_right - fine->contact_left,
                        coarse->contact_right - coarse->contact_left);
  fine->error.load = fmax(fmax(SHARE * load, floor_load * relative), bent(ring, relative));
  fine->error.peak = fmax(SHARE * peak, 4e-4 * relative);
  fine->error.width = fmax(SHARE * width, 1.5e-3 * relative);
}

double sb_ring_fit_size(const SbRingBody *body, const SbRingLoad *load, double tolerance) {
  const double size = SIZE * fmin(sqrt(tolerance / 1e-3), tolerance / load_floor(body, load));
  return fmin(tolerance < COARSE ? SIZE_MOST : SB_RING_LARGE, fmax(SIZE_LEAST, size));
}

// The state of an easy path may be far from the one that is fitted: by another path where there is
// one, fitted to its contacts too. *path_end is the result of that path on its mesh.
static SbStatus slowly(SbRing **ring, SbRingResult *path_end, double size,
                       const SbRingOptions *options, SbReport *report) {
  SbRingOptions slow = *options;
  SbRing *other;
  slow.quick = false;
  SbStatus status = sb_ring_create(&other, &(*ring)->body, &(*ring)->load, &slow, report);
  if (status == SB_OK) {
    sb_ring_destroy(*ring);
    *ring = other;
    sb_ring_result(other, path_end);
    status = sb_ring_refit(other, size, report);
  }
  return status;
}

// Refines the mesh until the estimated error of the load is at most `enough`. *size: size of the
// first of these meshes; afterwards that of the mesh that was good enough or did not converge.
static SbStatus refine(SbRing *ring, SbRingResult *result, double *size, double enough,
                       double floor_load, SbReport *report) {
  for (int i = 0; i < REFINEMENTS; i++) {
    const SbRingResult coarse = *result;
    const SbStatus status = sb_ring_refit(ring, *size, report);
    if (status != SB_OK) {
      return status;
    }
    sb_ring_result(ring, result);
    estimate(result, &coarse, ring, *size, floor_load);
    if (result->error.load <= enough || *size <= SIZE_LEAST) {
      break;
    }
    *size = fmax(SIZE_LEAST, RATIO * *size);
  }
  return SB_OK;
}

// Estimates the errors of a result whose finer mesh, of this size, did not converge. `unfitted`:
// smallest error of the load.
static void estimate_unrefined(SbRingResult *result, double unfitted, double floor_load,
                               double size) {
  result->error.load = fmax(unfitted, fmax(result->error.load, 4.0 * floor_load * size / SIZE));
  result->error.peak = fmax(result->error.peak, 4e-3 * size / SIZE);
  result->error.width = fmax(result->error.width, 6e-3 * size / SIZE);
}

// Warns of a surface that creases, with the error of the load that a crease or nearly one causes,
// and of a section that has rolled.
static void check_shape(SbRingResult *result, const SbRing *ring, double size,
                        SbWarnings *warnings) {
  const double crease = sb_ring_crease(ring->contact);
  if (crease > SB_RING_CREASE) {
    sb_warn(warnings, "surface-creases", SB_CONTACT_IN_PROFILE,
            "the free surface is pressed to %.2f of its length somewhere, where rubber creases "
            "(from %.2f on): the ring is solved with a smooth one",
            1.0 / sqrt(crease), 1.0 / sqrt(SB_RING_CREASE));
  }
  if (crease > NEAR_CREASE * SB_RING_CREASE) {
    result->error.load = fmax(result->error.load, CREASED * size);
  }
  const double turn = fabs(sb_ring_turn(ring->contact, NULL, NULL, NULL));
  if (ring->load.bore_slides == 0 && !sb_ring_is_circle(ring) && turn > ROLLED) {
    sb_warn(warnings, "section-rolled", SB_CONTACT_IN_PROFILE,
            "the section has rolled by %.0f degrees as it was fitted: another state of another "
            "load, upright, may exist next to it",
            turn * 180.0 / M_PI);
  }
}

// Adds the errors of the friction to those of the mesh. `path_end`: result on the mesh of the path.
static void add_friction_errors(SbRingResult *result, const SbRing *ring,
                                const SbRingResult *path_end) {
  if (ring->load.bore_slides != 0) {
    // The last two meshes may have the same node at the peak, whose pressure the friction along the
    // path determines. The path's mesh is as fine as they are, so that the full change is the
    // error.
    const double moved = change(result->pressure_peak, path_end->pressure_peak);
    result->error.peak = fmax(result->error.peak, moved);
  }
  // Error of a lip that the fluid nearly lifts: small at an end of a contact, large along a flat
  // one.
  const double lack = sb_ring_friction_lack(ring);
  if (lack > LACK) {
    result->error.load = fmax(result->error.load, lack);
  }
  // Deviation of single nodes from Coulomb's law.
  result->error.load = fmax(result->error.load, result->friction_excess / result->bore_force);
}

// Refines a ring that has contact with the bore, and estimates the errors of its result. `fitted`:
// status of the ring's first fitted mesh; size: that of the next one; `wanted` and `tolerance`: of
// the options.
static SbStatus fit_contact(SbRing *ring, SbRingResult *result, const SbRingResult *path_end,
                            SbStatus fitted, double size, double wanted, double tolerance,
                            SbWarnings *warnings, SbReport *report) {
  const SbRingLoad *load = &ring->load;
  const bool slides = load->bore_slides != 0,
             edges = load->wall_chamfer > 0.0 || load->groove != NULL;
  const double floor_load =
      fmax(load_floor(&ring->body, load), fluid_floor(result, &ring->body, load));
  SbStatus status = fitted;
  if (status == SB_OK) {
    // Beyond its first mesh a sliding ring needs no more than what is wanted: finer ones stumble.
    status = refine(ring, result, &size, slides ? wanted : tolerance, floor_load, report);
  }
  if (status == SB_ERROR_NOT_CONVERGED) { // the coarser solution is used, with its error
    const double off = edges ? UNFITTED_CHAMFER : UNFITTED;
    estimate_unrefined(result, fitted != SB_OK && slides ? off : 0.0, floor_load, size);
    status = SB_OK;
  }
  if (status == SB_OK) {
    check_shape(result, ring, size, warnings);
    add_friction_errors(result, ring, path_end);
    result->missed = result->error.load > wanted;
  }
  return status;
}

static void warn_no_contact(const SbRingBody *body, const SbRingLoad *load,
                            const SbRingResult *result, SbWarnings *warnings) {
  const bool fluid = load->pressure_left != 0.0 || load->pressure_right != 0.0;
  const char *past = fluid ? " and lets the fluid past" : "";
  if (body->inward) {
    sb_warn_serious(warnings, "no-contact", SB_CONTACT_IN_GASKET_BORE,
                    "the clamped gasket has no contact with the stem%s: its free bore is %.4g mm "
                    "wide, the stem %.4g mm",
                    past, 1e3 * body->inner_diameter, 2e3 * fabs(load->bore_radius));
    return;
  }
  sb_warn_serious(
      warnings, "no-contact", SB_CONTACT_IN_BORE_DIAMETER,
      "the fitted ring has no contact with the bore%s: radial thickness %.4g mm in %.4g mm", past,
      1e3 * result->thickness, 1e3 * (load->bore_radius - load->floor_radius));
}

SbStatus sb_ring_fit(SbRing **out, SbRingResult *result, const SbRingBody *body,
                     const SbRingLoad *load, const SbRingOptions *options, SbWarnings *warnings,
                     SbReport *report) {
  if (out != NULL) {
    *out = NULL;
  }
  SbRingOptions first = options != NULL ? *options : (SbRingOptions){0};
  double tolerance = first.tolerance > 0.0 ? first.tolerance : 1e-3;
  double wanted = first.wanted > 0.0 ? first.wanted : tolerance;
  if (!(tolerance >= 1e-5 && tolerance <= 0.1)) {
    return sb_fail(report, SB_ERROR_RANGE, "the ring's tolerance %g is outside 1e-5 .. 0.1",
                   tolerance);
  }
  double size = sb_ring_fit_size(body, load, tolerance);
  // A dragged ring follows its path on this mesh.
  const double path = first.element_size > 0.0 ? first.element_size : SIZE / RATIO;
  first.element_size = load->bore_slides != 0 ? path : fmin(0.08, fmax(SIZE, size) / RATIO);
  first.fit_mesh = false;
  // The fluid passes a ring without contact: no pressure acts on it.
  first.alone = true;
  SbRing *ring = NULL;
  SbStatus status = sb_ring_create(&ring, body, load, &first, report);
  if (status != SB_OK) {
    return status;
  }
  SbRingResult path_end; // on the mesh of the path
  sb_ring_result(ring, &path_end);
  status = sb_ring_refit(ring, size / RATIO, report);
  if (status == SB_ERROR_NOT_CONVERGED && ring->soft) {
    status = slowly(&ring, &path_end, size / RATIO, &first, report);
  }
  sb_ring_result(ring, result);
  if (!result->touching) {
    // A load of 0 needs no finer mesh: the state of the path's mesh is the result.
    status = status == SB_ERROR_NOT_CONVERGED ? SB_OK : status;
    warn_no_contact(body, load, result, warnings);
  } else {
    status =
        fit_contact(ring, result, &path_end, status, size, wanted, tolerance, warnings, report);
  }
  if (status != SB_OK) {
    sb_ring_destroy(ring);
    return status;
  }
  if (out != NULL) {
    *out = ring;
  } else {
    sb_ring_destroy(ring);
  }
  return sb_succeed(report);
}
