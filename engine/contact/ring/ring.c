// The ring object: checks its input, makes it dimensionless, fits it into the groove and steps it.
//
// How it finds its first states: ring_place.c; its other meshes: ring_remesh.c. Equations and
// validity: ring_fem.c, ring_contact.c, ring_newton.c. Leaves out twist, buckling out of the
// section's plane, adhesion.
//
// Long: input, scale, groove and steps of one object, whose state is changed here only.
#include "engine/base/check.h"
#include "engine/contact/ring/ring_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double SIZE_DEFAULT = 0.05, SQUEEZE_MOST = 0.6, STRETCH_MOST = 0.6, CRIMP_MOST = 0.5;

// Largest displacement of the contact's ends, divided by the elements' size, before a sliding
// ring's mesh is fitted again: its short elements are at the ends.
static const double OUTGROWN = 0.1;

// Largest penetration of a section into itself, in section heights, due to the finite stiffness
// that separates its sides.
static const double FOLDED = 0.02;

static SbStatus check_body(const SbRingBody *body, SbReport *report) {
  return SB_CHECK(
      report,
      {SB_CONTACT_IN_SECTION_DIAMETER, "the section diameter [m]", body->section_diameter,
       SB_ABOVE_ZERO},
      {SB_CONTACT_IN_INNER_DIAMETER, "the inner diameter [m]",
       body->plane_strain ? 1.0 : body->inner_diameter, SB_ABOVE_ZERO},
      {SB_CONTACT_IN_MODULUS, "the modulus [Pa]", body->modulus, SB_ABOVE_ZERO},
      {SB_CONTACT_IN_POISSON_RATIO, "the ring model's Poisson's ratio", body->poisson_ratio, 0.3,
       0.49995},
      {SB_CONTACT_IN_MOONEY_SHARE, "the Mooney fraction", body->mooney_share, 0.0, 0.5});
}

// The stem in the bore of a ring that seals inwards, and the walls that clamp it.
static SbStatus check_clamped(const SbRingBody *body, const SbRingOutline *outline,
                              const SbRingLoad *load, SbReport *report) {
  const double width = load->wall_right - load->wall_left;
  const double thick = 2.0 * outline->half * body->section_diameter;
  const double stem = -2.0 * load->bore_radius / body->inner_diameter;
  return SB_CHECK(report,
                  {SB_CONTACT_IN_CRIMP, "the gasket's crimp", 1.0 - width / thick, 0.0, CRIMP_MOST},
                  {SB_CONTACT_IN_GASKET_BORE, "the stem's diameter over the gasket's bore", stem,
                   0.5, 1.0 + STRETCH_MOST});
}

static bool has_land(const SbRingLoad *load) {
  return load->land_left > -HUGE_VAL || load->land_right < HUGE_VAL;
}

// Checks each number of a load by itself.
static SbStatus check_numbers(const SbRingBody *body, const SbRingLoad *load, SbReport *report) {
  const int friction = SB_CONTACT_IN_DRAG, fluid = SB_CONTACT_IN_PRESSURE;
  const int edge = SB_CONTACT_IN_LAND_EDGE;
  const bool land = has_land(load);
  const double width = load->wall_right - load->wall_left;
  return SB_CHECK(
      report,
      {0, "the groove floor's radius [m]", body->inward ? 0.0 : load->floor_radius, SB_FINITE},
      {0, "the bore's radius [m]", load->bore_radius, SB_FINITE},
      {0, "the bore's position [m]", load->bore_position, SB_FINITE},
      {0, "the bore's shear [Pa]", load->bore_traction, SB_FINITE},
      {0, "the left wall's place [m]", load->wall_left, -INFINITY, INFINITY},
      {0, "the right wall's place [m]", load->wall_right, -INFINITY, INFINITY},
      {SB_CONTACT_IN_WALL_DRAFT, "the walls' draft [rad]", load->wall_draft, 0.0, 0.35},
      {SB_CONTACT_IN_GROOVE_CORNER, "the radius of the groove's corners [m]", load->floor_corner,
       0.0, load->floor_corner > 0.0 ? 0.5 * width : 1.0},
      {SB_CONTACT_IN_GROOVE_CHAMFER, "the chamfer of the groove's edges [m]", load->wall_chamfer,
       0.0, load->wall_chamfer > 0.0 ? load->wall_top - load->floor_radius : 1.0},
      {0, "the land's left end [m]", load->land_left, -INFINITY, INFINITY},
      {0, "the land's right end [m]", load->land_right, -INFINITY, INFINITY},
      {friction, "the friction on the bore, as a fraction of its law,", load->friction_bore, 0.0,
       2.0},
      {friction, "the coefficient of friction on the floor", load->friction_floor, 0.0, 2.0},
      {friction, "the coefficient of friction on the walls", load->friction_wall, 0.0, 2.0},
      {fluid, "the pressure on the ring [Pa]", load->pressure_left, 0.0, 4.0 * body->modulus},
      {fluid, "the pressure on the ring [Pa]", load->pressure_right, 0.0, 4.0 * body->modulus},
      {edge, "the chamfer [rad]", land ? load->chamfer_angle : 0.0, 0.0, 1.2},
      {edge, "the length of the land's edge [m]", land ? load->edge_length : 1.0, SB_ABOVE_ZERO});
}

// Checks the squeeze, the stretch and the room of a ring between its groove and the bore.
static SbStatus check_groove(const SbRingBody *body, const SbRingOutline *outline,
                             const SbRingLoad *load, SbReport *report) {
  const double width = load->wall_right - load->wall_left;
  double space = load->bore_radius - load->floor_radius;
  if (!(space > 0.0)) {
    return sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_BORE_DIAMETER,
                         "the bore (radius %.4g m) is not larger than the groove floor "
                         "(radius %.4g m)",
                         load->bore_radius, load->floor_radius);
  }
  double floor = body->plane_strain ? 1.0 : load->floor_radius, d = body->section_diameter;
  double stretch = body->plane_strain ? 0.0 : 2.0 * load->floor_radius / body->inner_diameter - 1.0;
  SbStatus status = SB_CHECK(
      report, {SB_CONTACT_IN_RADIAL_SPACE, "the groove floor's radius [m]", floor, SB_ABOVE_ZERO},
      {SB_CONTACT_IN_INNER_DIAMETER, "the ring's stretch on the floor", stretch, -DBL_MAX,
       STRETCH_MOST},
      {SB_CONTACT_IN_RADIAL_SPACE, "the ring's squeeze", 1.0 - space / d, -DBL_MAX, SQUEEZE_MOST});
  if (status != SB_OK) {
    return status;
  }
  if (!(width > 0.0)) {
    return sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_GLAND_WIDTH,
                         "the groove has no width");
  }
  // A nearly incompressible section cannot be larger than its groove; its volume is constant.
  double area = outline->area * d * d;
  if (!body->plane_strain) {
    const double centroid = 0.5 * body->inner_diameter + (0.5 + outline->centroid) * d;
    area *= 2.0 * centroid / (load->floor_radius + load->bore_radius);
  }
  const double room = load->groove != NULL && isfinite(width)
                          ? sb_groove_drawn_area(load->groove, width, space)
                          : width * space;
  if (!has_land(load) && isfinite(width) && area > SB_RING_FILL_MOST * room) {
    char least[64] = "";
    if (load->groove == NULL) {
      sb_text(least, sizeof least, "; the groove must be at least %.4g mm wide",
              ceil(1e6 * area / (SB_RING_FILL_MOST * space)) / 1e3);
    }
    return sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_GLAND_WIDTH,
                         "the groove is overfilled: the section needs %.3g mm2 of %.3g mm2%s",
                         1e6 * area, 1e6 * room, least);
  }
  return SB_OK;
}

static SbStatus check_load(const SbRingBody *body, const SbRingOutline *outline,
                           const SbRingLoad *load, SbReport *report) {
  const SbStatus status = check_numbers(body, load, report);
  if (status != SB_OK) {
    return status;
  }
  return body->inward ? check_clamped(body, outline, load, report)
                      : check_groove(body, outline, load, report);
}

SbStatus sb_ring_check(const SbRingBody *body, const SbRingLoad *load, SbReport *report) {
  SbRingOutline outline;
  SbStatus status = check_body(body, report);
  if (status == SB_OK) {
    status = sb_ring_outline_of_profile(&outline, &body->profile, body->section_diameter, report);
  }
  return status == SB_OK ? check_load(body, &outline, load, report) : status;
}

// Half the material angle that a squeeze brings into contact (width/d ~ 1.1 sqrt(squeeze), measured
// on plane-strain solutions from 2 to 40 %); only for meshing.
static double contact_angle(double squeeze) {
  return asin(fmin(0.93, 1.15 * sqrt(fmax(0.0, squeeze)) + 0.04));
}

bool sb_ring_is_circle(const SbRing *ring) {
  return ring->body.profile.kind == SB_SEAL_PROFILE_CIRCLE;
}

// Finds the angles between which a section is within `depth` of the bore, or of the floor (about
// pi).
static SbRingZone zone_within(const SbRingOutline *outline, double depth, bool at_floor) {
  enum { STEPS = 720 };
  SbRingZone zone = {0.0, 0.0, 0.0};
  for (int i = -STEPS; i <= STEPS; i++) {
    double angle = M_PI * i / STEPS, x[2];
    sb_ring_outline_place(outline, sb_ring_outline_arc(outline, angle + (at_floor ? M_PI : 0.0)),
                          x);
    if (0.5 - (at_floor ? -x[0] : x[0]) < depth) {
      zone.from = fmin(zone.from, angle);
      zone.to = fmax(zone.to, angle);
    }
  }
  zone.from += at_floor ? M_PI : 0.0;
  zone.to += at_floor ? M_PI : 0.0;
  return zone;
}

SbRingMeshPlan sb_ring_empty_plan(const SbRing *ring, double size_max, double size) {
  return (SbRingMeshPlan){.centre = ring->centre,
                          .radius = 0.5,
                          .outline = sb_ring_is_circle(ring) ? NULL : &ring->outline,
                          .size_max = size_max,
                          .growth = 0.5,
                          .layers = (int)fmax(4.0, floor(0.5 + 1.76 * log2(0.5 / size)))};
}

// First mesh: fine where bore, floor and, under pressure, the low-pressure flank will have contact.
static SbRingMeshPlan first_plan(const SbRing *ring, const SbRingLoad *s, double size) {
  SbRingMeshPlan plan = sb_ring_empty_plan(ring, 0.16, size);
  const double squeeze = 1.0 - (s->bore_radius - s->floor_radius);
  double angle = contact_angle(squeeze);
  SbRingZone touching[2] = {{-angle, angle, size}, {M_PI - angle, M_PI + angle, size}};
  for (int k = 0; k < 2; k++) {
    if (!sb_ring_is_circle(ring)) {
      const double sunk = isfinite(squeeze) ? fmax(0.0, squeeze) : 0.0;
      touching[k] = zone_within(&ring->outline, 0.03 + 0.5 * sunk, k == 1);
      touching[k].size = size;
    }
    plan.zone[plan.zone_count++] = touching[k];
  }
  if (ring->body.inward) {
    plan.zone[1] = (SbRingZone){-M_PI, M_PI, 1.5 * size}; // clamped all over
    return plan;
  }
  if (s->pressure_left > s->pressure_right && s->wall_right < INFINITY) {
    plan.zone[plan.zone_count++] = (SbRingZone){0.0, M_PI, 1.5 * size};
  }
  if (s->pressure_left < s->pressure_right && s->wall_left > -INFINITY) {
    plan.zone[plan.zone_count++] = (SbRingZone){-M_PI, 0.0, 1.5 * size};
  }
  return plan;
}

// Returns whether one of the four triangles that an element is drawn as is turned over.
static bool turned_over(const SbRing *ring) {
  static const int PART[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
  for (int i = 0; i < 4 * ring->mesh->elements; i++) {
    double x[3][2];
    for (int k = 0; k < 3; k++) {
      sb_ring_fem_place(ring->fem, ring->mesh->tri[i / 4 * 6 + PART[i % 4][k]], x[k]);
    }
    if (!((x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) > (x[1][1] - x[0][1]) * (x[2][0] - x[0][0]))) {
      return true;
    }
  }
  return false;
}

// The stiffness that separates a section in self-contact acts only in its hollows (ring_fold.c) and
// carries at most some shear moduli.
SbStatus sb_ring_check_apart(const SbRing *ring, SbReport *report) {
  const char *name = sb_seal_profile_name(ring->body.profile.kind);
  if (!sb_ring_is_circle(ring) && turned_over(ring)) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "an element of the %s section is turned over",
                   name);
  }
  if (ring->contact->folded > FOLDED) {
    return sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_PROFILE,
                         "the %s section folds onto itself and would be pressed into itself by "
                         "%.2g of its height",
                         name, ring->contact->folded);
  }
  if (!sb_ring_is_circle(ring) && sb_ring_crosses_itself(ring->contact)) {
    // If elements are larger than a corner's rounding they may be the cause: finer ones are tried.
    return sb_fail_input(report, SB_ERROR_NOT_CONVERGED, SB_CONTACT_IN_PROFILE,
                         "the %s section folds onto itself next to its hollows: contact with "
                         "itself is not modelled there",
                         name);
  }
  return SB_OK;
}

SbStatus sb_ring_build_on_mesh(SbRing *ring, SbReport *report) {
  const SbRingBody *body = &ring->body;
  double mu = ring->stress;
  double bulk = body->modulus / (3.0 * (1.0 - 2.0 * body->poisson_ratio));
  SbRingMaterial material = {
      .c1 = 0.5 * (1.0 - body->mooney_share), .c2 = 0.5 * body->mooney_share, .bulk = bulk / mu};
  const double around = body->plane_strain ? 0.0 : body->inward ? -2.0 * M_PI : 2.0 * M_PI;
  SbStatus status = sb_ring_fem_create(&ring->fem, ring->mesh, material, around, report);
  if (status == SB_OK) {
    status = sb_ring_contact_create(&ring->contact, ring->fem, report);
  }
  if (status == SB_OK) {
    ring->contact->stress = ring->stress;
    ring->contact->lobes = !sb_ring_is_circle(ring) || ring->load.groove != NULL;
    ring->contact->force_scale = body->plane_strain ? 1.0 : around * ring->centre;
  }
  return status;
}

SbStatus sb_ring_build(SbRing *ring, const SbRingMeshPlan *plan, SbReport *report) {
  SbStatus status = sb_ring_mesh_create(&ring->mesh, plan, report);
  return status == SB_OK ? sb_ring_build_on_mesh(ring, report) : status;
}

void sb_ring_drop(SbRing *ring) {
  sb_ring_contact_destroy(ring->contact);
  sb_ring_fem_destroy(ring->fem);
  sb_ring_mesh_destroy(ring->mesh);
  ring->contact = NULL;
  ring->fem = NULL;
  ring->mesh = NULL;
}

void sb_ring_end_best(SbRing *ring, bool take) {
  SbRing other = *ring;
  other.mesh = ring->best.mesh;
  other.fem = ring->best.fem;
  other.contact = ring->best.contact;
  bool here = ring->best.here;
  ring->best = other.best = (SbRingBest){0};
  if (take && !here) {
    sb_ring_drop(ring);
    *ring = other;
  } else {
    sb_ring_drop(&other);
  }
  if (take) {
    sb_ring_restore(ring->contact, SB_RING_BEFORE);
    sb_ring_contact_settle(ring->contact);
  }
}

static SbStatus slide_at_once(SbRing *ring, const SbRingLoad *target, SbReport *report);

static SbStatus assemble_ring(SbRing *ring, const SbRingLoad *load, SbReport *report) {
  SbRingLoad target = *load, smooth = *load;
  smooth.use_bore_traction = false;
  smooth.friction_bore = smooth.friction_floor = 0.0;
  smooth.friction_wall = ring->body.inward ? target.friction_wall : 0.0;
  smooth.bore_slides = 0;
  SbStatus status = sb_ring_fit_and_press(ring, &smooth, report);
  if (status == SB_OK && ring->options.fit_mesh) {
    status = sb_ring_refit(ring, ring->options.element_size, report);
  }
  if (status == SB_OK && sb_ring_has_friction(&target)) {
    target.pressure_left = ring->contact->is.now.pressure_left; // none where it passes the ring
    target.pressure_right = ring->contact->is.now.pressure_right;
    if (target.bore_slides != 0) {
      ring->contact->is.now = target;
      ring->contact->is.now.friction_bore = 0.0;
      if (target.rests_on_wall) {
        sb_ring_rest_on_wall(ring);
      }
      const bool easy = ring->easy;
      status = sb_ring_drag(ring, target.friction_bore, report);
      if (status == SB_OK && easy && ring->state == SB_RING_SLIDES) {
        status = slide_at_once(ring, &target, report);
      }
      if (status == SB_OK && ring->state != SB_RING_SLIDES && !ring->body.inward) {
        sb_ring_fix_turn(ring);
      }
      if (status == SB_OK && ring->options.fit_mesh) {
        status = sb_ring_refit(ring, ring->options.element_size, report);
      }
    } else {
      status = sb_ring_advance(ring, &target, SB_RING_FOLLOW, report);
    }
  }
  return status;
}

// Reports, for a path that ended at a creased surface, that there is no smooth state beyond.
// `crease` is that of the states at which it ended.
static SbStatus tell_crease(const SbRing *ring, double crease, SbStatus status, SbReport *report) {
  if (status != SB_ERROR_NOT_CONVERGED || sb_ring_is_circle(ring) || crease <= SB_RING_CREASE) {
    return status;
  }
  const SbReport reason = report != NULL ? *report : (SbReport){0};
  status = sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_PROFILE,
                         "the %s section's surface creases where it is pressed to %.2f of its "
                         "length (rubber's does from %.2f on): %s",
                         sb_seal_profile_name(ring->body.profile.kind), 1.0 / sqrt(crease),
                         1.0 / sqrt(SB_RING_CREASE), reason.text);
  return sb_fail_because(report, status, SB_CAUSE_CREASES);
}

// An easy path comes first if floor and walls have no friction, so that a state does not depend on
// earlier ones: it needs a part of the steps. With friction it leads to states that depend on it by
// some tenths of a per cent, and it is easier only under fluid. It is then used for quick rings
// only, and its limit is not theirs. A ring that barely resists rolling can fail at single nodes of
// a mesh, and a corner that closes inverts large elements: finer ones are tried. Where all of them
// fail the path of a dragged ring is followed once more with damped corrections, which would change
// the states of other rings slightly (valve 796 of the campaign random-valves, seed 1). A path of
// sliding can end at single nodes: only if that of every mesh ended at a crease it is the reason.
static SbStatus lay_ring(SbRing *ring, const SbRingLoad *target, SbReport *report) {
  enum { ITERATIONS_ALL = 5000 }; // after which no other path is begun but of a circle
  static const double FINER[] = {1.0, 1.0, 0.8, 0.6, 0.4};
  const bool slides = target->bore_slides != 0 && target->friction_bore > 0.0;
  const bool smooth = target->friction_floor == 0.0 && target->friction_wall == 0.0;
  SbStatus status = SB_ERROR_NOT_CONVERGED;
  double crease = target->bore_slides != 0 ? INFINITY : 1.0;
  const size_t tries = sizeof FINER / sizeof FINER[0] - (sb_ring_is_circle(ring) ? 1 : 0);
  const bool fluid = target->pressure_left != target->pressure_right;
  const bool easy = slides && (smooth || (fluid && ring->options.quick));
  const int before = ring->count.iterations;
  SbReport own = {0},
           told = {0}; // of a trial; of the first one with the full law, which is reported
  for (size_t i = easy ? 0 : 1;
       i < tries + (slides ? 1 : 0) && status == SB_ERROR_NOT_CONVERGED &&
       (sb_ring_is_circle(ring) || ring->count.iterations - before < ITERATIONS_ALL);
       i++) {
    ring->easy = i == 0;
    ring->damped = i == tries;
    ring->soft = i == 0 && !smooth;
    ring->onset = ring->soft ? SB_RING_SOFT : SB_RING_EASY;
    const double finer = ring->damped ? 1.0 : FINER[i];
    SbRingMeshPlan plan = first_plan(ring, target, finer * ring->options.element_size);
    sb_ring_drop(ring);
    ring->arc.free = false;
    ring->state = SB_RING_SLIDES;
    ring->share_limit = ring->drag_limit = 0.0;
    status = sb_ring_build(ring, &plan, &own);
    if (status == SB_OK) {
      status = assemble_ring(ring, target, &own);
    }
    if (status == SB_OK && ring->soft && ring->state != SB_RING_SLIDES) {
      status = sb_fail(&own, SB_ERROR_NOT_CONVERGED, "an easy path with friction has a limit");
    }
    if (status == SB_OK) {
      status = sb_ring_check_apart(ring, &own);
    }
    if (status == SB_ERROR_NOT_CONVERGED) {
      const double here = ring->contact != NULL ? sb_ring_crease(ring->contact) : 1.0;
      crease = target->bore_slides != 0 ? fmin(crease, here) : fmax(crease, here);
    }
    told = i <= 1 || status != SB_ERROR_NOT_CONVERGED ? own : told;
  }
  if (report != NULL) {
    *report = told;
  }
  return tell_crease(ring, crease, status, report);
}

void sb_ring_set_body(SbRing *ring, const SbRingBody *body, const SbRingLoad *load) {
  const double d = body->section_diameter;
  ring->body = *body;
  ring->load = *load;
  ring->length = d;
  ring->stress = body->modulus / (2.0 * (1.0 + body->poisson_ratio));
  ring->force = ring->stress * d * (body->plane_strain ? 1.0 : d);
  ring->centre = body->plane_strain ? load->floor_radius / d + 0.5
                 : body->inward     ? -0.5 * (body->inner_diameter + d) / d
                                    : 0.5 * (body->inner_diameter + d) / d;
  // A profile that makes no outline has been refused.
  (void)sb_ring_outline_of_profile(&ring->outline, &body->profile, d, NULL);
}

SbStatus sb_ring_create(SbRing **out, const SbRingBody *body, const SbRingLoad *load,
                        const SbRingOptions *options, SbReport *report) {
  *out = NULL;
  SbStatus status = sb_ring_check(body, load, report);
  if (status != SB_OK) {
    return status;
  }
  SbRing *ring = calloc(1, sizeof *ring);
  if (ring == NULL || (ring->recovery = sb_ring_recovery_create()) == NULL) {
    free(ring);
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring");
  }
  ring->options = options != NULL ? *options : (SbRingOptions){0};
  SbRingOptions *o = &ring->options;
  ring->passing = o->drawn;
  o->element_size = o->element_size > 0.0 ? fmin(0.1, fmax(0.004, o->element_size)) : SIZE_DEFAULT;
  sb_ring_set_body(ring, body, load);
  const SbRingLoad target = sb_ring_load_in(load, ring->length, ring->stress);
  status = lay_ring(ring, &target, report);
  if (status != SB_OK) {
    sb_ring_destroy(ring);
    return status;
  }
  *out = ring;
  return sb_succeed(report);
}

void sb_ring_destroy(SbRing *ring) {
  if (ring != NULL) {
    sb_ring_drop(ring);
    free(ring->recovery);
    free(ring);
  }
}

bool sb_ring_outgrown(const SbRing *ring, double most) {
  SbRingPatch patch;
  double moved = 0.0;
  if (ring->fitted_size > 0.0 && sb_ring_patch(ring, SB_RING_BORE, &patch)) {
    for (int k = 0; k < 2; k++) {
      const double from = fmin(patch.angle[k], ring->fitted_end[k]);
      const double to = fmax(patch.angle[k], ring->fitted_end[k]);
      moved = fmax(moved, sb_ring_mesh_arc(ring->mesh, from, to));
    }
  }
  return moved > most * ring->fitted_size;
}

void sb_ring_set_data(SbRing *ring, const void *law, void *poll_data) {
  SbRingContact *contact = ring->contact;
  ring->load.law = contact->is.now.law = law;
  for (size_t i = 0; i < sizeof contact->saved / sizeof *contact->saved; i++) {
    contact->saved[i].now.law = law;
  }
  ring->options.poll_data = poll_data;
}

const SbRingLoad *sb_ring_load(const SbRing *ring) {
  return &ring->load;
}

// Solves steady sliding near the present state; if single nodes of the mesh prevent it, on other
// meshes. If none succeeds the ring's state is unchanged, perhaps on another mesh.
static SbStatus slide_at_once(SbRing *ring, const SbRingLoad *target, SbReport *report) {
  const double size = ring->fitted_size;
  SbStatus status = SB_ERROR_NOT_CONVERGED;
  for (int i = 0; i < (size > 0.0 ? SB_RING_TRIES : 1) && status == SB_ERROR_NOT_CONVERGED; i++) {
    status = i > 0 ? sb_ring_refit_once(ring, sb_ring_try[i] * size, report) : SB_OK;
    if (status == SB_OK) {
      sb_ring_save(ring->contact, SB_RING_START);
      ring->contact->is.now = *target;
      status = sb_ring_attempt(ring, SB_RING_DIRECT, report);
    }
  }
  ring->fitted_size = size;
  return status;
}

// Changes to steady sliding: directly from steady sliding in the same direction, or from scratch if
// the difference is too large. If neither succeeds the ring is unchanged.
static SbStatus slide_on(SbRing *ring, const SbRingLoad *target, SbReport *report) {
  SbRing fresh = *ring;
  fresh.mesh = NULL;
  fresh.fem = NULL;
  fresh.contact = NULL;
  SbStatus status = SB_ERROR_NOT_CONVERGED;
  if (ring->state == SB_RING_SLIDES && ring->contact->is.now.bore_slides == target->bore_slides) {
    ring->arc.free = false;
    status = slide_at_once(ring, target, report);
    fresh.count = ring->count;
  }
  bool moved = status == SB_OK && sb_ring_outgrown(ring, OUTGROWN);
  ring->count.steps += status == SB_OK ? 1 : 0;
  if (status == SB_ERROR_NOT_CONVERGED) {
    fresh.count.rejected++;
    status = lay_ring(&fresh, target, report);
    if (status == SB_OK) {
      sb_ring_drop(ring);
      *ring = fresh;
    } else {
      sb_ring_drop(&fresh);
      sb_ring_contact_settle(ring->contact);
    }
    moved = status == SB_OK && ring->fitted_size > 0.0;
  }
  return moved ? sb_ring_refit(ring, ring->fitted_size, report) : status;
}

SbStatus sb_ring_step(SbRing *ring, const SbRingLoad *load, SbReport *report) {
  SbStatus status = check_load(&ring->body, &ring->outline, load, report);
  if (status != SB_OK) {
    return status;
  }
  SbRingLoad target = sb_ring_load_in(load, ring->length, ring->stress);
  const SbRingLoad *now = &ring->contact->is.now;
  double before = now->pressure_left - now->pressure_right;
  double after = target.pressure_left - target.pressure_right;
  if (target.bore_slides != 0) {
    status = slide_on(ring, &target, report);
  } else if (before * after < 0.0) {
    // The pressure changes sides: through equal pressures, where the ring may cross the groove.
    SbRingLoad even = *now;
    even.pressure_left = even.pressure_right = fmin(target.pressure_left, target.pressure_right);
    status = sb_ring_advance(ring, &even, SB_RING_FOLLOW, report);
  }
  if (status == SB_OK && target.bore_slides == 0) {
    status = sb_ring_press(ring, &target, report);
  }
  if (status == SB_OK) {
    status = sb_ring_check_apart(ring, report);
  }
  ring->load = status == SB_OK ? *load
                               : sb_ring_load_in(&ring->contact->is.now, 1.0 / ring->length,
                                                 1.0 / ring->stress);
  return status;
}

SbStatus sb_ring_create_like(SbRing **out, const SbRing *ring, SbReport *report) {
  SbRing *other = malloc(sizeof *other);
  *out = NULL;
  if (other == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring");
  }
  *other = *ring;
  other->mesh = NULL;
  other->fem = NULL;
  other->contact = NULL;
  other->best = (SbRingBest){0};
  other->count = (SbRingCount){0};
  other->recovery = sb_ring_recovery_create();
  if (other->recovery == NULL) {
    free(other);
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring");
  }
  *out = other;
  return SB_OK;
}

SbStatus sb_ring_copy(SbRing **out, const SbRing *ring, const SbRingOptions *options,
                      SbReport *report) {
  SbStatus status = sb_ring_create_like(out, ring, report);
  if (status != SB_OK) {
    return status;
  }
  (*out)->options = *options;
  (*out)->passing = options->drawn;
  // Fine ends show where the contact ends; friction stumbles over some, others do.
  static const double EDGE[] = {0.3, 0.2, 0.4, 1.0};
  status = SB_ERROR_NOT_CONVERGED;
  for (size_t i = 0; i < sizeof EDGE / sizeof *EDGE && status == SB_ERROR_NOT_CONVERGED; i++) {
    status = sb_ring_remesh(*out, ring, options->element_size, EDGE[i], report);
  }
  if (status != SB_OK) {
    sb_ring_destroy(*out);
    *out = NULL;
  }
  return status;
}

SbStatus sb_ring_mirror(SbRing **out, const SbRing *ring, const void *law, SbReport *report) {
  static const SbRingSurface OTHER[SB_RING_SURFACES] = {[SB_RING_BORE] = SB_RING_BORE,
                                                        [SB_RING_FLOOR] = SB_RING_FLOOR,
                                                        [SB_RING_WALL_RIGHT] = SB_RING_WALL_LEFT,
                                                        [SB_RING_WALL_LEFT] = SB_RING_WALL_RIGHT};
  SbRing *other;
  *out = NULL;
  if (sb_ring_outline_has_sides(&ring->outline)) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "the section's mirror image is another one");
  }
  if (ring->load.groove != NULL) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "the groove may have another mirror image");
  }
  SbStatus status = sb_ring_create_like(&other, ring, report);
  *out = other;
  if (status != SB_OK) {
    return status;
  }
  status = sb_ring_mesh_mirror(&other->mesh, ring->mesh, report);
  status = status == SB_OK ? sb_ring_build_on_mesh(other, report) : status;
  if (status != SB_OK) {
    sb_ring_destroy(other);
    *out = NULL;
    return status;
  }
  sb_ring_fem_mirror(other->fem, ring->fem);
  const SbRingContactState *from = &ring->contact->is;
  SbRingContactState *to = &other->contact->is;
  to->now = sb_ring_load_mirrored(&from->now);
  to->now.law = law;
  to->turn = -from->turn;
  for (int i = 0; i < other->contact->count; i++) {
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      SbRingTouch *touch = sb_ring_touch(other->contact, i, s);
      *touch = *sb_ring_touch(ring->contact, -i, OTHER[s]);
      if (s == SB_RING_BORE || s == SB_RING_FLOOR) { // their tangent is axial
        touch->slip = (signed char)-touch->slip;
      }
    }
  }
  for (int k = 0; k < 2; k++) {
    to->crest[k] = sb_ring_wrap(ring->contact, -from->crest[k]);
    other->fitted_end[k] = -ring->fitted_end[1 - k];
  }
  to->excess = from->excess;
  other->load = sb_ring_load_mirrored(&ring->load);
  other->load.law = law;
  sb_ring_contact_settle(other->contact);
  return SB_OK;
}
