// The finite-strain ring as a contact model. Floor and bore are cylinders without a land gap; the
// fluid is on one side, and a flat groove wall on the other.
//
// The ring starts in the middle of its groove. The wall on the side of the lower pressure is half
// the gland's width from the section's centre; without pressure the ring does not contact it. The
// other wall is left out unless the solved section is wider than the groove. Then both walls are
// present, and if no state between them is found the groove is refused as overfilled. Walls are
// frictionless and rigid. The load is that of the bore, around the bore's circumference. A dragged
// ring has both walls, and friction on bore, floor and walls (ring_drag.c).
#include "engine/contact/fit_models.h"

#include <math.h>
#include <string.h>

// Of the bore's sliding, as SbRingLoad's.
static int drag_direction(const SbFitProblem *in) {
  return (in->drag < 0.0) == (in->pressure < 0.0) ? 1 : -1;
}

// Largest Poisson's ratio with which a gasket between plates is solved. Beyond it the rubber in the
// corners between plate and stem hardly moves, and Newton's method loses the path of its friction.
// The load is linear in 1 - 2 nu. BULK is its slope over the load, twice that of the default
// gasket, whose load at 0.4999 is 1 % above that at 0.495 (extrapolated from 0.49 and 0.495).
static const double GASKET_POISSON_MOST = 0.495, BULK = 2.4;

// Returns the relative effect of the neglected bulk modulus on the load.
static double bulk_error(const SbFitProblem *in) {
  return in->gasket ? 2.0 * BULK * fmax(0.0, in->poisson_ratio - GASKET_POISSON_MOST) : 0.0;
}

void sb_fit_ring_problem(SbRingBody *body, SbRingLoad *load, const SbFitProblem *in) {
  *body = (SbRingBody){.profile = in->profile,
                       .section_diameter = in->section_diameter,
                       .inner_diameter = in->inner_diameter,
                       .modulus = in->modulus,
                       .poisson_ratio = in->gasket ? fmin(in->poisson_ratio, GASKET_POISSON_MOST)
                                                   : in->poisson_ratio,
                       .mooney_share = in->mooney_share,
                       .inward = in->gasket};
  *load = (SbRingLoad)SB_RING_LOAD_INIT;
  load->bore_radius = (in->gasket ? -0.5 : 0.5) * in->bore_diameter;
  load->floor_radius = in->gasket ? -INFINITY : load->bore_radius - in->radial_space;
  load->pressure_left = fmax(0.0, in->pressure);
  load->pressure_right = fmax(0.0, -in->pressure);
  // A drawn floor may lead the ring to the other wall.
  const bool both = in->gasket || in->dragged || in->groove != NULL;
  if (both || in->pressure > 0.0) {
    load->wall_right = 0.5 * in->gland_width;
  }
  if (both || in->pressure < 0.0) {
    load->wall_left = -0.5 * in->gland_width;
  }
  if (in->gasket) {
    load->friction_wall = in->wall_friction;
  } else {
    load->wall_draft = in->wall_draft;
    load->floor_corner = in->groove_corner;
    load->wall_chamfer = in->groove_chamfer;
    load->wall_top = 0.5 * in->land_diameter;
    load->groove = in->groove;
  }
  if (in->dragged) {
    load->bore_slides = drag_direction(in);
    load->friction_bore = fabs(in->drag);
    load->shear = in->shear;
    load->law = in->law;
    load->friction_floor = in->floor_friction;
    load->friction_wall = in->wall_friction;
    load->rests_on_wall = in->start_at_wall;
  }
}

// Copies the results of a solved ring, except its error estimates.
static void take_result(SbFit *out, const SbFitProblem *in, SbRing *ring,
                        const SbRingResult *result) {
  out->circumference = M_PI * in->bore_diameter;
  out->touches = result->touching;
  out->solver.converged = true;
  out->solver.unknowns = (size_t)result->unknowns;
  out->solver.newton_iterations = (size_t)result->newton_iterations;
  out->ring.floor_load = result->floor_force;
  out->ring.wall_load = fmax(result->wall_left_force, result->wall_right_force);
  out->ring.thickness = result->thickness;
  out->ring.volume_change = result->volume_change;
  out->ring.axial_imbalance = result->axial_imbalance;
  const double sign = in->pressure < 0.0 ? -1.0 : 1.0;
  out->ring.drag = sign * result->bore_drag + 0.0;
  out->ring.turn = sign * result->turn;
  out->ring.state = result->state;
  out->ring.fault = result->fault;
  out->ring.order = result->order;
  const bool slides = result->state == SB_RING_SLIDES || result->state == SB_RING_NO_CONTACT;
  out->ring.drag_limit = slides ? NAN : result->drag_limit;
  if (!slides) {
    sb_warn_serious(&out->warnings, result->state == SB_RING_ROLLS ? "ring-rolls" : "ring-jams",
                    SB_CONTACT_IN_FLOOR_FRICTION,
                    "the ring %s at a drag of %.4g of its load: the figures are those at this drag",
                    result->state == SB_RING_ROLLS ? "rolls" : "jams", result->drag_limit);
  }
  out->ring.load_steps = (size_t)result->load_steps;
  out->ring.rejected_steps = (size_t)result->rejected_steps;
  if (result->touching) {
    out->contact_left = result->contact_left;
    out->contact_right = result->contact_right;
    out->contact_width = result->contact_right - result->contact_left;
    out->load = result->bore_force;
    out->load_per_length = result->bore_force / out->circumference;
    out->pressure_peak = result->pressure_peak;
    const int points = sb_ring_profile(ring, out->profile_x, out->profile_p, SB_FIT_PROFILE_MAX);
    out->profile_count = points < SB_FIT_PROFILE_MAX ? (size_t)points : SB_FIT_PROFILE_MAX;
    // Without it the film uses the surface of another model and warns.
    if (in->surface_wanted && sb_ring_surface(ring, &out->surface, NULL) != SB_OK) {
      out->surface.modes = 0;
    }
  }
}

// Minimum errors of rings. An estimate is a third of the largest difference that was found.
typedef struct {
  double load, peak, width;
} Floor;

// Minimum errors of a dragged ring, or of a gasket between its plates, that has friction on floor
// and walls under pressure. Its state depends on the coarse meshes of its continuation path. With a
// law other than Coulomb's, other meshes and path tolerances change loads by up to 1.2 % and widths
// by up to 0.6 %; its last two meshes do not show this. Over a range of 0.8 % of the radial space,
// loads of piston.scene scatter by 0.1 %, peaks by 0.12 %, widths by 0.19 % rms (campaign
// estimates). Without pressure (dry) the scatter is at most 0.11 %, 0.05 % and 0.33 %.
static const Floor PATH = {0.004, 0.002, 0.002}, DRY = {4e-4, 3e-4, 1.3e-3};

// Those of a gasket: tolerances of 2e-2 and 1e-4 change its load by up to 0.41 %, its width by up
// to 0.19 %, and its peak by up to 7.7 % (gasket.scene and gasket-hand.scene, 0.97 to 1.03 mm
// thick, campaign estimates). The peak is at the sharp edge of the contact, where the pressure of
// the finite elements has a root, and depends on single nodes, although the peaks of two meshes may
// agree. Estimates are a third of these changes, rounded up.
static const Floor GASKET = {0.002, 0.026, 0.001};

// Load that such a ring's mesh aims at, and is wanted to.
static const double PATH_AIM = 0.004, PATH_WANTED = 0.012;

// A gasket's aim over the tolerance, below PATH_AIM, and its smallest aim. Its edge, and with it
// the error of its mesh, is smaller than a ring's contact, so that a smaller tolerance has a finer
// mesh: from 2e-2 to 1e-4, loads change by up to 0.25 %, and by 0.005 % where the mesh is the same
// (gasket-hand.scene).
static const double GASKET_AIM = 4, GASKET_AIM_LEAST = 4e-4;

static bool rubs_as_dragged(const SbFitProblem *in) {
  const bool rubs = in->floor_friction > 0.0 || in->wall_friction > 0.0;
  return rubs && (in->gasket || in->shear != NULL);
}

static bool keeps_path(const SbFitProblem *in) {
  return rubs_as_dragged(in) && (in->gasket || in->pressure != 0.0);
}

// A dragged round ring whose requested tolerance is at least ENOUGH follows a quick path on larger
// elements, which takes 0.45 of the usual time. Its state then differs from the usual one, by at
// most 0.4 % in load for 85 random rings with a bounded friction law.
static const double ENOUGH = 0.01;
static const Floor LARGE = {0.003, 0.003, 0.003};

// If such a ring is continued from the state of another one, its load differs by up to 4.4 % from
// that of a ring fitted from scratch (120 random edits of two scenes), most if it is pulled back
// under fluid.
static const double LED = 0.015;

// A ring without drag has no continuation path. Fitting it from scratch is then faster than
// starting from another ring, whose mesh is finer.
static bool takes_large(const SbFitProblem *in) {
  return in->dragged && in->tolerance >= ENOUGH && in->profile.kind == SB_SEAL_PROFILE_CIRCLE;
}

static void take_errors(SbFit *out, const SbFitProblem *in, bool on_large,
                        const SbRingResult *result) {
  static const Floor none = {0.0, 0.0, 0.0};
  const Floor *rubs = in->gasket ? &GASKET : keeps_path(in) ? &PATH : &DRY;
  const Floor *path = rubs_as_dragged(in) ? rubs : &none;
  const Floor *large = on_large ? &LARGE : &none;
  const double bulk = bulk_error(in);
  sb_fit_errors(out, bulk + fmax(result->error.load, fmax(path->load, large->load)),
                bulk + fmax(result->error.peak, fmax(path->peak, large->peak)),
                fmax(result->error.width, fmax(path->width, large->width)));
}

// Returns whether a solved section reaches the groove's wall that its load leaves out.
static bool loses_wall(const SbRingLoad *load, const SbFitProblem *in, const SbRingResult *result) {
  const bool both = isfinite(load->wall_left) && isfinite(load->wall_right);
  return !both && result->axial_right - result->axial_left > in->gland_width;
}

// Solves a ring that is wider than its groove between both walls.
static SbStatus between_walls(SbRing **ring, SbRingResult *result, const SbRingBody *body,
                              SbRingLoad *load, const SbRingOptions *options,
                              const SbFitProblem *in, SbFit *out, SbReport *report) {
  const double width = result->axial_right - result->axial_left;
  sb_ring_destroy(*ring);
  *ring = NULL;
  load->wall_right = 0.5 * in->gland_width;
  load->wall_left = -load->wall_right;
  const SbStatus status = sb_ring_fit(ring, result, body, load, options, &out->warnings, report);
  if (status == SB_ERROR_NOT_CONVERGED || status == SB_ERROR_INFEASIBLE) {
    char least[64] = "widen the groove";
    if (out->gland_fill > SB_RING_FILL_MOST) {
      sb_text(least, sizeof least, "the groove must be at least %.4g mm wide",
              ceil(1e6 * in->gland_width * out->gland_fill / SB_RING_FILL_MOST) / 1e3);
    }
    return sb_fail_input(
        report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_GLAND_WIDTH,
        "the groove is overfilled: without its second wall the ring is %.3g mm wide in a groove of "
        "%.3g mm (gland fill %.3g %%), and no state between both walls was found; %s",
        1e3 * width, 1e3 * in->gland_width, 100.0 * out->gland_fill, least);
  }
  return status;
}

// Returns the error of the load that the mesh of such a ring aims at.
static double path_aim(const SbFitProblem *in, double wanted) {
  const double least = in->gasket ? GASKET_AIM_LEAST : PATH_AIM;
  return fmax(wanted, fmin(PATH_AIM, fmax(least, GASKET_AIM * wanted)));
}

// Returns the options of a solve.
static SbRingOptions options_of(const SbFitProblem *in) {
  const double wanted = in->tolerance > 0.0 ? in->tolerance : 1e-3;
  // A film depends on the root of the pressure at the contact's ends, which scatters with the mesh
  // about ten times as much as the load. The load of a dragged ring is only as accurate as its
  // friction, and its finest meshes often fail: a third of the tolerance. The same applies to a
  // ring at rest in a valve whose rings have friction and a requested tolerance of at least ENOUGH,
  // because no film slides over it. The size is not below a third of the path's error: loads and
  // films then differ by 0.5 % from those of a mesh of half the size.
  const bool path = keeps_path(in);
  const bool third = in->dragged || (wanted >= ENOUGH && in->floor_friction > 0.0);
  const double finer = !in->surface_wanted ? 1.0 : third ? 0.35 : 0.1;
  const double aim = path ? path_aim(in, wanted) : finer * wanted;
  return (SbRingOptions){.tolerance = fmin(0.1, fmax(1e-5, aim)),
                         .wanted = path ? fmax(wanted, PATH_WANTED) : wanted,
                         .poll = in->cancel,
                         .poll_data = in->cancel_data};
}

// Solves a ring from its start, or if it has none or that fails along the path of a cold ring.
// *large: on a mesh of large elements.
static SbStatus solve_ring(SbRing **ring, SbRingResult *result, bool *large, const SbFitProblem *in,
                           const SbRingBody *body, const SbRingLoad *load,
                           const SbRingOptions *options, SbWarnings *warnings, SbReport *report) {
  SbStatus status = SB_ERROR_NOT_CONVERGED;
  const bool tangent = in->start != NULL && in->start->tangent != NULL;
  if (tangent) {
    status = (in->start->beside ? sb_ring_tangent_solve : sb_ring_tangent_at)(
        ring, in->start->tangent, body, load, options, report);
  } else if (in->start != NULL && (in->dragged || in->tolerance < ENOUGH)) {
    status = sb_ring_near(ring, in->start->ring, in->start->guide, body, load, options, NULL);
  }
  if (status == SB_OK) {
    sb_ring_result(*ring, result);
    const double led = keeps_path(in) && !tangent && takes_large(in) ? LED : 0.0;
    result->error.load = fmax(in->start->error_load, led);
    result->error.peak = in->start->error_peak;
    result->error.width = in->start->error_width;
  }
  *large = takes_large(in);
  if (status == SB_ERROR_NOT_CONVERGED && !tangent) {
    SbRingOptions cold = *options;
    cold.element_size = *large ? SB_RING_LARGE : 0.0;
    cold.quick = *large;
    SbReport first = {0};
    status = sb_ring_fit(ring, result, body, load, &cold, warnings, &first);
    const bool ended = status == SB_ERROR_NOT_CONVERGED || first.cause == SB_CAUSE_CREASES;
    if (ended && in->dragged && !*large) {
      // Single nodes end a path, and others make another mesh's.
      SbReport own = {0};
      *large = true;
      cold.element_size = SB_RING_LARGE;
      const SbStatus second = sb_ring_fit(ring, result, body, load, &cold, warnings, &own);
      if (second != SB_ERROR_NOT_CONVERGED) { // else the error of the first path is reported
        status = second;
        first = own;
      }
    }
    if (report != NULL) {
      *report = first;
    }
  }
  return status;
}

SbStatus sb_fit_ring(SbFit *out, const SbFitProblem *in, SbReport *report) {
  SbRingBody body;
  SbRingLoad load;
  sb_fit_ring_problem(&body, &load, in);
  const SbRingOptions options = options_of(in);
  SbRing *ring = NULL;
  SbRingResult result;
  bool large;
  SbStatus status =
      solve_ring(&ring, &result, &large, in, &body, &load, &options, &out->warnings, report);
  if (status == SB_OK && loses_wall(&load, in, &result)) {
    large = false;
    status = between_walls(&ring, &result, &body, &load, &options, in, out, report);
  }
  if (status != SB_OK) {
    return status;
  }
  take_errors(out, in, large, &result);
  if (result.missed) {
    sb_warn(&out->warnings, "ring-tolerance", 0,
            "the ring's load is known to %.2g only, not to %.2g", out->solver.error_estimate.load,
            options.wanted);
  }
  take_result(out, in, ring, &result);
  if (bulk_error(in) > 0.0) {
    sb_warn(&out->warnings, "gasket-bulk", SB_CONTACT_IN_POISSON_RATIO,
            "the gasket is solved with a Poisson ratio of %.4g, not %.4g: its load may differ by "
            "%.2g %%",
            GASKET_POISSON_MOST, in->poisson_ratio, 100.0 * bulk_error(in));
  }
  if (in->kept != NULL) {
    sb_ring_destroy(*in->kept);
    *in->kept = ring;
  } else {
    sb_ring_destroy(ring);
  }
  return sb_succeed(report);
}

SbStatus sb_fit_again(SbFit *out, const SbFitProblem *in, SbReport *report) {
  SbRingBody body;
  SbRingLoad load;
  SbRingResult before, result;
  SbRing *ring = *in->kept;
  sb_fit_ring_problem(&body, &load, in);
  sb_ring_result(ring, &before);
  SbStatus status = sb_ring_step(ring, &load, report);
  if (status != SB_OK) {
    return status;
  }
  sb_ring_result(ring, &result);
  result.newton_iterations -= before.newton_iterations;
  memset(&out->warnings, 0, sizeof out->warnings);
  take_result(out, in, ring, &result);
  return sb_succeed(report);
}

SbStatus sb_fit_mirror(SbFit *out, const SbFitProblem *in, const SbFit *fit, const SbRing *ring,
                       SbReport *report) {
  SbRing *mirror;
  SbRingResult result;
  SbStatus status = sb_ring_mirror(&mirror, ring, in->law, report);
  if (status != SB_OK) {
    return status;
  }
  sb_ring_result(mirror, &result);
  *out = *fit;
  memset(&out->warnings, 0, sizeof out->warnings);
  take_result(out, in, mirror, &result);
  sb_ring_destroy(*in->kept);
  *in->kept = mirror;
  return sb_succeed(report);
}
