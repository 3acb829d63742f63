// The ring object: checks its input, makes it dimensionless, fits it into the groove and steps it.
//
// Fitting starts from a volume-preserving guess (uniform stretch and part of the squeeze) with
// every node beyond a surface held there; the contact's active set lets go of what is too much.
// Pressure comes after, from the ring pushed against its wall. Equations and validity: ring_fem.c,
// ring_contact.c, ring_newton.c. Leaves out twist, buckling out of the section's plane, adhesion.
#include "engine/elastic/ring/ring_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double SIZE_DEFAULT = 0.05, SQUEEZE_MOST = 0.6;

static SbStatus check_body(const SbRingBody *body, SbReport *report) {
  if (!(body->section_diameter > 0.0) || !isfinite(body->section_diameter)) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "seal.section_diameter",
                             "the section diameter %g m is not positive", body->section_diameter);
  }
  if (!body->plane_strain && (!(body->inner_diameter > 0.0) || !isfinite(body->inner_diameter))) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "seal.inner_diameter",
                             "the inner diameter %g m is not positive", body->inner_diameter);
  }
  if (!(body->modulus > 0.0) || !isfinite(body->modulus)) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "seal.modulus",
                             "the modulus %g Pa is not positive", body->modulus);
  }
  if (!(body->poisson_ratio >= 0.3 && body->poisson_ratio <= 0.49995)) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "seal.poisson_ratio",
                             "the ring model takes Poisson's ratio from 0.3 to 0.49995, not %g",
                             body->poisson_ratio);
  }
  if (!(body->mooney_share >= 0.0 && body->mooney_share <= 0.5)) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "seal.mooney_share",
                             "the Mooney share %g lies outside 0 .. 0.5", body->mooney_share);
  }
  return SB_OK;
}

static SbStatus check_load(const SbRingBody *body, const SbRingLoad *load, SbReport *report) {
  const double numbers[] = {load->floor_radius,   load->bore_radius,   load->pressure_left,
                            load->pressure_right, load->bore_position, load->friction_bore,
                            load->friction_floor, load->friction_wall, load->bore_traction,
                            load->chamfer_angle,  load->edge_length};
  for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
    if (!isfinite(numbers[i])) {
      return sb_fail(report, SB_ERROR_INPUT, "a number of the ring's load is not finite");
    }
  }
  if (isnan(load->wall_left) || isnan(load->wall_right) || isnan(load->land_left) ||
      isnan(load->land_right)) {
    return sb_fail(report, SB_ERROR_INPUT, "a place of the ring's groove is not a number");
  }
  double space = load->bore_radius - load->floor_radius;
  if (!(space > 0.0)) {
    return sb_fail_parameter(report, SB_ERROR_INFEASIBLE, "bore.diameter",
                             "the bore (radius %.4g m) is not larger than the groove floor "
                             "(radius %.4g m)",
                             load->bore_radius, load->floor_radius);
  }
  if (!body->plane_strain && !(load->floor_radius > 0.0)) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "gland.radial_space",
                             "the groove floor's radius %.4g m is not positive",
                             load->floor_radius);
  }
  double stretch = body->plane_strain ? 0.0 : 2.0 * load->floor_radius / body->inner_diameter - 1.0;
  if (stretch > 0.6) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "seal.inner_diameter",
                             "the ring would be stretched by %.0f %%; the model ends at 60 %%",
                             100.0 * stretch);
  }
  if (1.0 - space / body->section_diameter > SQUEEZE_MOST) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "gland.radial_space",
                             "the ring would be squeezed by %.0f %%; the model ends at %.0f %%",
                             100.0 * (1.0 - space / body->section_diameter), 100.0 * SQUEEZE_MOST);
  }
  double width = load->wall_right - load->wall_left;
  if (!(width > 0.0)) {
    return sb_fail_parameter(report, SB_ERROR_INFEASIBLE, "gland.axial_width",
                             "the groove has no width");
  }
  // A nearly incompressible section cannot be larger than its groove; its volume is kept.
  double d = body->section_diameter;
  double area = 0.25 * M_PI * d * d;
  if (!body->plane_strain) {
    area *= (body->inner_diameter + d) / (load->floor_radius + load->bore_radius);
  }
  bool land = load->land_left > -HUGE_VAL || load->land_right < HUGE_VAL;
  if (!land && isfinite(width) && area > 0.985 * width * space) {
    return sb_fail_parameter(report, SB_ERROR_INFEASIBLE, "gland.axial_width",
                             "the groove is overfilled: the section needs %.3g mm2 of %.3g mm2",
                             1e6 * area, 1e6 * width * space);
  }
  if (load->friction_bore < 0.0 || load->friction_floor < 0.0 || load->friction_wall < 0.0 ||
      load->friction_bore > 2.0 || load->friction_floor > 2.0 || load->friction_wall > 2.0) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "friction.load_coefficient",
                             "a coefficient of friction lies outside 0 .. 2");
  }
  if (load->pressure_left < 0.0 || load->pressure_right < 0.0 ||
      fmax(load->pressure_left, load->pressure_right) > 4.0 * body->modulus) {
    return sb_fail_parameter(
        report, SB_ERROR_RANGE, "canister.pressure",
        "the ring model takes gauge pressures from 0 to four times the modulus");
  }
  if (land &&
      (!(load->chamfer_angle >= 0.0 && load->chamfer_angle <= 1.2) || !(load->edge_length > 0.0))) {
    return sb_fail_parameter(
        report, SB_ERROR_RANGE, "bore.land_edge",
        "the land's edge needs a chamfer of 0 .. 1.2 rad and a positive length");
  }
  return SB_OK;
}

SbRingSetting sb_ring_setting(const SbRing *ring, const SbRingLoad *load) {
  double l = ring->length, p = ring->stress;
  SbRingSetting s = {
      .bore = load->bore_radius / l,
      .floor = load->floor_radius / l,
      .wall_left = load->wall_left / l,
      .wall_right = load->wall_right / l,
      .land_left = load->land_left / l,
      .land_right = load->land_right / l,
      .chamfer_slope = tan(load->chamfer_angle),
      .edge_length = load->edge_length / l,
      .pressure_left = load->pressure_left / p,
      .pressure_right = load->pressure_right / p,
      .slide = load->bore_position / l,
      .traction = load->bore_traction / p,
      .use_traction = load->use_bore_traction,
  };
  s.friction[SB_RING_BORE] = load->friction_bore;
  s.friction[SB_RING_FLOOR] = load->friction_floor;
  s.friction[SB_RING_WALL_LEFT] = s.friction[SB_RING_WALL_RIGHT] = load->friction_wall;
  return s;
}

static SbRingLoad load_of(const SbRing *ring, const SbRingSetting *s) {
  double l = ring->length, p = ring->stress;
  SbRingLoad load = {
      .floor_radius = s->floor * l,
      .bore_radius = s->bore * l,
      .wall_left = s->wall_left * l,
      .wall_right = s->wall_right * l,
      .land_left = s->land_left * l,
      .land_right = s->land_right * l,
      .chamfer_angle = atan(s->chamfer_slope),
      .edge_length = s->edge_length * l,
      .pressure_left = s->pressure_left * p,
      .pressure_right = s->pressure_right * p,
      .bore_position = s->slide * l,
      .friction_bore = s->friction[SB_RING_BORE],
      .friction_floor = s->friction[SB_RING_FLOOR],
      .friction_wall = s->friction[SB_RING_WALL_RIGHT],
      .bore_traction = s->traction * p,
      .use_bore_traction = s->use_traction,
  };
  return load;
}

static SbRingNewton newton_options(const SbRing *ring) {
  SbRingNewton newton = {
      .iterations_max = ring->options.iterations_max,
      .step_least = ring->options.step_least,
      .stumbles_max = 4,
      .walks = true,
      .correction_max = 0.15,
      .poll = ring->options.poll,
      .poll_data = ring->options.poll_data,
  };
  return newton;
}

// Half the material angle that a squeeze brings into contact (width/d ~ 1.1 sqrt(squeeze), measured
// on plane-strain solutions from 2 to 40 %); only for meshing.
static double contact_angle(double squeeze) {
  return asin(fmin(0.93, 1.15 * sqrt(fmax(0.0, squeeze)) + 0.04));
}

// First mesh: fine where bore, floor and, under pressure, the low-pressure flank will touch.
static void first_plan(SbRingMeshPlan *plan, const SbRing *ring, const SbRingSetting *s,
                       double size) {
  memset(plan, 0, sizeof *plan);
  plan->centre = ring->centre;
  plan->radius = 0.5;
  plan->size_max = 0.16;
  plan->growth = 0.5;
  plan->layers = (int)fmax(4.0, floor(0.5 + 2.2 * log(0.5 / size) / log(2.0) * 0.8));
  double angle = contact_angle(1.0 - (s->bore - s->floor));
  plan->zone[plan->zone_count++] = (SbRingZone){-angle, angle, size};
  plan->zone[plan->zone_count++] = (SbRingZone){M_PI - angle, M_PI + angle, size};
  if (s->pressure_left > s->pressure_right && s->wall_right < INFINITY) {
    plan->zone[plan->zone_count++] = (SbRingZone){0.0, M_PI, 1.5 * size};
  }
  if (s->pressure_left < s->pressure_right && s->wall_left > -INFINITY) {
    plan->zone[plan->zone_count++] = (SbRingZone){-M_PI, 0.0, 1.5 * size};
  }
}

static SbStatus build(SbRing *ring, const SbRingMeshPlan *plan, SbReport *report) {
  const SbRingBody *body = &ring->body;
  double mu = ring->stress;
  double bulk = body->modulus / (3.0 * (1.0 - 2.0 * body->poisson_ratio));
  SbRingMaterial material = {
      .c1 = 0.5 * (1.0 - body->mooney_share), .c2 = 0.5 * body->mooney_share, .bulk = bulk / mu};
  SbStatus status = sb_ring_mesh_create(&ring->mesh, plan, report);
  if (status == SB_OK) {
    status = sb_ring_fem_create(&ring->fem, ring->mesh, material, !body->plane_strain, report);
  }
  if (status == SB_OK) {
    status = sb_ring_contact_create(&ring->contact, ring->fem, report);
  }
  if (status == SB_OK) {
    ring->contact->force_scale = body->plane_strain ? 1.0 : 2.0 * M_PI * ring->centre;
  }
  return status;
}

static void drop(SbRing *ring) {
  sb_ring_contact_destroy(ring->contact);
  sb_ring_fem_destroy(ring->fem);
  sb_ring_mesh_destroy(ring->mesh);
  ring->contact = NULL;
  ring->fem = NULL;
  ring->mesh = NULL;
}

// Volume-preserving guess: uniform stretch and a share of the squeeze, sunk into the floor by what
// a stretched ring flattens there (about 0.3 of its inner stretch, measured), so that the contacts
// start with some width.
static void guess(SbRing *ring, const SbRingSetting *s, double share) {
  bool plane = ring->body.plane_strain;
  double inner = ring->centre - 0.5;
  double low = fmax(s->floor, fmin(inner, s->bore - 1.0));
  double space = s->bore - low;
  double stretch = plane ? 1.0 : (low + 0.5 * fmin(space, 1.0)) / ring->centre;
  double flat = plane ? 0.0 : fmin(0.1, 0.3 * fmax(0.0, low / inner - 1.0));
  double thickness = 1.0 / sqrt(stretch);
  double squeeze = fmax(0.0, thickness - flat - space);
  thickness -= share * squeeze;
  double centre = low - flat - 0.5 * (1.0 - share) * squeeze + 0.5 * thickness;
  stretch = plane ? 1.0 : centre / ring->centre;
  // An end of the land under the ring pushes it to the wall on the open side; start there, since
  // without friction the state in the middle of the groove is not stable.
  double half = 0.5 / (stretch * thickness), shift = 0.0;
  if (fabs(s->land_right) < 0.6 && isfinite(s->wall_right)) {
    shift = s->wall_right - half;
  } else if (fabs(s->land_left) < 0.6 && isfinite(s->wall_left)) {
    shift = s->wall_left + half;
  }
  SbRingFem *fem = ring->fem;
  for (int i = 0; i < ring->mesh->nodes; i++) {
    double r = ring->mesh->x[2 * i], z = ring->mesh->x[2 * i + 1];
    fem->u[2 * i] = centre + thickness * (r - ring->centre) - r;
    fem->u[2 * i + 1] = z / (stretch * thickness) + shift - z;
  }
  memset(fem->inner, 0, sizeof(double) * SB_RING_INNER * (size_t)ring->mesh->elements);
}

// A pressure difference with nothing to lean on: push the ring against its wall.
static SbStatus lean(SbRing *ring, const SbRingSetting *s, bool *leaned, SbReport *report) {
  SbRingContact *contact = ring->contact;
  double difference = s->pressure_left - s->pressure_right;
  bool rubs = s->use_traction;
  *leaned = false;
  for (int k = 0; k < SB_RING_SURFACES; k++) {
    rubs = rubs || s->friction[k] > 0.0;
  }
  bool land = s->land_left > -INFINITY || s->land_right < INFINITY;
  SbRingPatch patch;
  if (difference == 0.0 && land && !rubs && sb_ring_patch(ring, SB_RING_BORE, &patch)) {
    // A chamfer under the contact pushes towards its open side; without friction the ring would
    // otherwise balance on the land's edge, which is not stable.
    if (s->land_right < patch.place[1] && isfinite(s->wall_right)) {
      difference = 1e-3;
    } else if (s->land_left > patch.place[0] && isfinite(s->wall_left)) {
      difference = -1e-3;
    }
  }
  if (difference == 0.0) {
    return SB_OK;
  }
  SbRingSurface wall = difference > 0.0 ? SB_RING_WALL_RIGHT : SB_RING_WALL_LEFT;
  double place = difference > 0.0 ? s->wall_right : s->wall_left;
  if (!isfinite(place)) {
    return rubs || land ? SB_OK
                        : sb_fail_parameter(report, SB_ERROR_INFEASIBLE, "gland.axial_width",
                                            "no groove wall holds the ring against the pressure");
  }
  double least = INFINITY;
  for (int i = 0; i < contact->count; i++) {
    int node = ring->mesh->loop[i];
    double z = ring->mesh->x[2 * node + 1] + ring->fem->u[2 * node + 1];
    if (contact->touch[SB_RING_SURFACES * i + wall].held) {
      return SB_OK;
    }
    double gap = fabs(place - z);
    least = fmin(least, gap);
  }
  if (rubs) {
    return SB_OK; // friction decides how far it goes
  }
  // Sunk in by a little more than it takes, so that the wall contact starts with some width.
  double sunk = fmin(0.06, fmax(0.003, 0.05 * fabs(difference)));
  double shift = difference > 0.0 ? least + sunk : -least - sunk;
  *leaned = true;
  for (int i = 0; i < ring->mesh->nodes; i++) {
    ring->fem->u[2 * i + 1] += shift;
  }
  for (int i = 0; i < contact->count; i++) {
    int node = ring->mesh->loop[i];
    double z = ring->mesh->x[2 * node + 1] + ring->fem->u[2 * node + 1];
    SbRingTouch *touch = &contact->touch[SB_RING_SURFACES * i];
    touch[wall].held = difference > 0.0 ? z >= place : z <= place;
    touch[difference > 0.0 ? SB_RING_WALL_LEFT : SB_RING_WALL_RIGHT].held = false;
  }
  return SB_OK;
}

// To another setting, leaning first where that is wanted. If pushing the ring to its wall was too
// rough, it is followed there instead.
static SbStatus press(SbRing *ring, const SbRingSetting *target, SbReport *report) {
  SbRingNewton newton = newton_options(ring);
  bool leaned;
  sb_ring_fem_save(ring->fem, 2);
  sb_ring_contact_save(ring->contact, 1);
  SbStatus status = lean(ring, target, &leaned, report);
  if (status != SB_OK) {
    return status;
  }
  int steps = ring->count.steps;
  newton.walks = !leaned;
  status = sb_ring_advance(ring->contact, target, &newton, &ring->count, report);
  if (leaned && status == SB_ERROR_NOT_CONVERGED) {
    if (ring->count.steps == steps) {
      sb_ring_fem_restore(ring->fem, 2);
      sb_ring_contact_restore(ring->contact, 1);
    }
    newton.walks = true;
    status = sb_ring_advance(ring->contact, target, &newton, &ring->count, report);
  }
  return status;
}

// Fits the ring without fluid and friction, then brings on the fluid.
static SbStatus fit_and_press(SbRing *ring, const SbRingSetting *smooth, SbReport *report) {
  SbRingNewton newton = newton_options(ring);
  SbRingSetting dry = *smooth;
  dry.pressure_left = dry.pressure_right = 0.0;
  SbStatus status = SB_ERROR_NOT_CONVERGED;
  // Guesses with different shares of the squeeze, then a small squeeze that grows.
  static const double SHARE[] = {0.4, 0.0};
  for (size_t i = 0; i < sizeof SHARE / sizeof SHARE[0] && status == SB_ERROR_NOT_CONVERGED; i++) {
    ring->contact->now = dry;
    guess(ring, &dry, SHARE[i]);
    sb_ring_contact_detect(ring->contact);
    status = sb_ring_newton(ring->contact, &newton, &ring->count, report);
  }
  if (status == SB_ERROR_NOT_CONVERGED) {
    SbRingSetting wide = dry;
    wide.bore = fmax(dry.bore, dry.floor + 0.85);
    guess(ring, &wide, 0.4);
    // The ends of the land come in from outside.
    wide.land_right = fmax(dry.land_right, 1.5);
    wide.land_left = fmin(dry.land_left, -1.5);
    ring->contact->now = wide;
    sb_ring_contact_detect(ring->contact);
    status = sb_ring_newton(ring->contact, &newton, &ring->count, report);
    SbRingSetting squeezed = wide;
    squeezed.bore = dry.bore;
    if (status == SB_OK) {
      status = sb_ring_advance(ring->contact, &squeezed, &newton, &ring->count, report);
    }
    if (status == SB_OK) {
      status = sb_ring_advance(ring->contact, &dry, &newton, &ring->count, report);
    }
  }
  if (status != SB_OK) {
    return status;
  }
  ring->count.steps = ring->count.steps > 0 ? ring->count.steps : 1;
  if (smooth->pressure_left != 0.0 || smooth->pressure_right != 0.0) {
    status = press(ring, smooth, report);
  }
  return status;
}

static SbStatus assemble_ring(SbRing *ring, const SbRingSetting *target, SbReport *report) {
  SbRingSetting smooth = *target;
  smooth.use_traction = false;
  memset(smooth.friction, 0, sizeof smooth.friction);
  SbStatus status = fit_and_press(ring, &smooth, report);
  if (status == SB_OK && ring->options.fit_mesh) {
    status = sb_ring_refit(ring, ring->options.element_size, report);
  }
  bool rubs = target->use_traction;
  for (int k = 0; k < SB_RING_SURFACES; k++) {
    rubs = rubs || target->friction[k] > 0.0;
  }
  if (status == SB_OK && rubs) {
    SbRingNewton newton = newton_options(ring);
    status = sb_ring_advance(ring->contact, target, &newton, &ring->count, report);
  }
  return status;
}

SbStatus sb_ring_create(SbRing **out, const SbRingBody *body, const SbRingLoad *load,
                        const SbRingOptions *options, SbReport *report) {
  *out = NULL;
  SbStatus status = check_body(body, report);
  if (status == SB_OK) {
    status = check_load(body, load, report);
  }
  if (status != SB_OK) {
    return status;
  }
  SbRing *ring = calloc(1, sizeof *ring);
  if (ring == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring");
  }
  ring->body = *body;
  ring->load = *load;
  ring->options = options != NULL ? *options : (SbRingOptions){0};
  SbRingOptions *o = &ring->options;
  o->element_size = o->element_size > 0.0 ? fmin(0.1, fmax(0.004, o->element_size)) : SIZE_DEFAULT;
  o->iterations_max = o->iterations_max > 0 ? o->iterations_max : 24;
  o->step_least = o->step_least > 0.0 ? o->step_least : 1.0 / 64.0;
  double d = body->section_diameter;
  ring->length = d;
  ring->stress = body->modulus / (2.0 * (1.0 + body->poisson_ratio));
  ring->force = ring->stress * d * (body->plane_strain ? 1.0 : d);
  ring->centre =
      body->plane_strain ? load->floor_radius / d + 0.5 : 0.5 * (body->inner_diameter + d) / d;
  SbRingSetting target = sb_ring_setting(ring, load);
  // A ring that barely resists rolling can stumble over single nodes of a mesh: try finer ones.
  static const double FINER[] = {1.0, 0.8, 0.6};
  status = SB_ERROR_NOT_CONVERGED;
  for (size_t i = 0; i < sizeof FINER / sizeof FINER[0] && status == SB_ERROR_NOT_CONVERGED; i++) {
    SbRingMeshPlan plan;
    first_plan(&plan, ring, &target, FINER[i] * o->element_size);
    drop(ring);
    status = build(ring, &plan, report);
    if (status == SB_OK) {
      status = assemble_ring(ring, &target, report);
    }
  }
  if (status != SB_OK) {
    sb_ring_destroy(ring);
    return status;
  }
  *out = ring;
  return sb_succeed(report);
}

void sb_ring_destroy(SbRing *ring) {
  if (ring != NULL) {
    drop(ring);
    free(ring);
  }
}

SbStatus sb_ring_step(SbRing *ring, const SbRingLoad *load, SbReport *report) {
  SbStatus status = check_load(&ring->body, load, report);
  if (status != SB_OK) {
    return status;
  }
  SbRingSetting target = sb_ring_setting(ring, load);
  SbRingNewton newton = newton_options(ring);
  const SbRingSetting *now = &ring->contact->now;
  double before = now->pressure_left - now->pressure_right;
  double after = target.pressure_left - target.pressure_right;
  if (before * after < 0.0) {
    // The pressure changes sides: by way of equal pressures, where the ring may cross the groove.
    SbRingSetting even = *now;
    even.pressure_left = even.pressure_right = fmin(target.pressure_left, target.pressure_right);
    status = sb_ring_advance(ring->contact, &even, &newton, &ring->count, report);
  }
  if (status == SB_OK) {
    status = press(ring, &target, report);
  }
  ring->load = status == SB_OK ? *load : load_of(ring, &ring->contact->now);
  return status;
}

const SbRingLoad *sb_ring_load(const SbRing *ring) {
  return &ring->load;
}

// Zones of fine elements under one contact, finer still at its ends, where vertices are put.
static void plan_patch(SbRingMeshPlan *plan, const SbRingPatch *patch, double size, double edge) {
  plan->zone[plan->zone_count++] = (SbRingZone){patch->angle[0], patch->angle[1], size};
  for (int k = 0; k < 2; k++) {
    double angle = patch->angle[k];
    plan->zone[plan->zone_count++] = (SbRingZone){angle, angle, edge};
    // Vertices are named within -pi .. pi.
    angle -= angle > M_PI ? 2.0 * M_PI : 0.0;
    plan->vertex[plan->vertex_count++] = angle;
  }
}

SbStatus sb_ring_refit(SbRing *ring, double element_size, SbReport *report) {
  SbRing fresh = *ring;
  SbRingMeshPlan plan = {.centre = ring->centre,
                         .radius = 0.5,
                         .size_max = fmin(0.16, 3.2 * element_size),
                         .growth = 0.5};
  plan.layers = (int)fmax(4.0, floor(0.5 + 2.2 * log(0.5 / element_size) / log(2.0) * 0.8));
  SbRingPatch patch[SB_RING_SURFACES];
  bool touches[SB_RING_SURFACES];
  for (int s = 0; s < SB_RING_SURFACES; s++) {
    touches[s] = sb_ring_patch(ring, (SbRingSurface)s, &patch[s]);
    if (touches[s]) {
      plan_patch(&plan, &patch[s], element_size, 0.3 * element_size);
    }
  }
  SbStatus status = build(&fresh, &plan, report);
  if (status != SB_OK) {
    drop(&fresh);
    return status;
  }
  // Same setting and, by material angle, the same held nodes.
  sb_ring_fem_transfer(fresh.fem, ring->fem);
  SbRingContact *contact = fresh.contact;
  contact->now = ring->contact->now;
  for (int i = 0; i < contact->count; i++) {
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      bool held = false;
      for (int turn = 0; turn < 2 && touches[s]; turn++) {
        double angle = fresh.mesh->angle[i] + 2.0 * M_PI * turn;
        held = held || (angle > patch[s].angle[0] - 1e-9 && angle < patch[s].angle[1] + 1e-9);
      }
      contact->touch[SB_RING_SURFACES * i + s].held = held;
    }
  }
  SbRingNewton newton = newton_options(ring);
  status = sb_ring_newton(contact, &newton, &fresh.count, report);
  if (status == SB_ERROR_NOT_CONVERGED) {
    // Too far from the transferred state: walk the whole way again on the new mesh.
    SbRingSetting setting = ring->contact->now;
    status = fit_and_press(&fresh, &setting, report);
  }
  if (status != SB_OK) {
    drop(&fresh);
    ring->count = fresh.count;
    return status;
  }
  drop(ring);
  *ring = fresh;
  return sb_succeed(report);
}
