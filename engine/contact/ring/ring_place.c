// Places the ring in its groove and applies the fluid: initial guesses, support by the wall, the
// ring that only the fluid closes.
//
// Fitting starts from a volume-preserving guess (uniform stretch and part of the squeeze), in which
// every node beyond a surface is moved onto it. The contact's active set releases the nodes that
// are too many. Pressure is applied afterwards, to the ring pushed against its wall. There is no
// friction up to this fitted state.
#include "engine/contact/ring/ring_private.h"

#include <math.h>
#include <string.h>

// Volume-preserving guess: uniform stretch and a share of the squeeze, sunk into the floor by what
// a stretched ring flattens there (about 0.3 of its inner stretch, measured), so that the contacts
// start with some width.
static void guess(SbRing *ring, const SbRingLoad *s, double share) {
  bool plane = ring->body.plane_strain;
  double inner = ring->centre - 0.5;
  double low = fmax(s->floor_radius, fmin(inner, s->bore_radius - 1.0));
  double space = s->bore_radius - low;
  double stretch = plane ? 1.0 : (low + 0.5 * fmin(space, 1.0)) / ring->centre;
  double flat = plane ? 0.0 : fmin(0.1, 0.3 * fmax(0.0, low / inner - 1.0));
  double thickness = 1.0 / sqrt(stretch);
  double squeeze = fmax(0.0, thickness - flat - space);
  thickness -= share * squeeze;
  double centre = low - flat - 0.5 * (1.0 - share) * squeeze + 0.5 * thickness;
  stretch = plane ? 1.0 : centre / ring->centre;
  // An end of the land under the ring pushes it to the wall on the open side; start there, since
  // without friction the state in the middle of the groove is not stable.
  double half = ring->outline.half / (stretch * thickness), shift = 0.0;
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
  ring->contact->is.turn = 0.0;
}

// Does the same for a ring that is clamped and seals inwards: r^2 - R^2/c is uniform where the
// axial compression is c; the bore widens with the free ring's, or is on the stem.
static void guess_clamped(SbRing *ring, const SbRingLoad *s) {
  const double c = fmin(1.0, (s->wall_right - s->wall_left) / (2.0 * ring->outline.half));
  const double free = -ring->centre - 0.5, bore = fmax(-s->bore_radius, free / sqrt(c));
  const double middle = 0.5 * (s->wall_left + s->wall_right);
  SbRingFem *fem = ring->fem;
  for (int i = 0; i < ring->mesh->nodes; i++) {
    const double r = ring->mesh->x[2 * i], z = ring->mesh->x[2 * i + 1];
    fem->u[2 * i] = -sqrt(bore * bore + (r * r - free * free) / c) - r;
    fem->u[2 * i + 1] = middle + c * z - z;
  }
  memset(fem->inner, 0, sizeof(double) * SB_RING_INNER * (size_t)ring->mesh->elements);
  ring->contact->is.turn = 0.0;
}

// A pressure difference with nothing to lean on: push the ring against its wall.
static SbStatus lean(SbRing *ring, const SbRingLoad *s, bool *leaned, SbReport *report) {
  SbRingContact *contact = ring->contact;
  double difference = s->pressure_left - s->pressure_right;
  bool holds = sb_ring_has_friction(s); // it leans already, or friction decides how far it goes
  bool land = s->land_left > -INFINITY || s->land_right < INFINITY;
  *leaned = false;
  SbRingPatch patch;
  if (difference == 0.0 && land && !holds && sb_ring_patch(ring, SB_RING_BORE, &patch)) {
    // A chamfer under the contact pushes towards its open side; without friction the ring would
    // otherwise balance on the land's edge, which is not stable.
    if (s->land_right < patch.place[1] && isfinite(s->wall_right)) {
      difference = 1e-3;
    } else if (s->land_left > patch.place[0] && isfinite(s->wall_left)) {
      difference = -1e-3;
    }
  }
  SbRingSurface wall = difference > 0.0 ? SB_RING_WALL_RIGHT : SB_RING_WALL_LEFT;
  double place = difference > 0.0 ? s->wall_right : s->wall_left;
  if (difference != 0.0 && !isfinite(place) && !holds && !land) {
    return sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_GLAND_WIDTH,
                         "no groove wall supports the ring against the pressure");
  }
  double least = INFINITY;
  for (int i = 0; i < contact->count; i++) {
    double x[2];
    sb_ring_contact_place(contact, i, x);
    holds = holds || sb_ring_touch(contact, i, wall)->held;
    least = fmin(least, isfinite(place) ? sb_ring_frame(s, wall, x).gap : INFINITY);
  }
  *leaned = difference != 0.0 && isfinite(place) && !holds;
  if (!*leaned) {
    return SB_OK;
  }
  // Sunk in by a little more than it takes, so that the wall contact starts with some width.
  double sunk = fmin(0.06, fmax(0.003, 0.05 * fabs(difference)));
  double shift = difference > 0.0 ? least + sunk : -least - sunk;
  for (int i = 0; i < ring->mesh->nodes; i++) {
    ring->fem->u[2 * i + 1] += shift;
  }
  for (int i = 0; i < contact->count; i++) {
    double x[2];
    sb_ring_contact_place(contact, i, x);
    for (int side = 0; side < 2; side++) {
      const SbRingSurface other = side == 0 ? SB_RING_WALL_RIGHT : SB_RING_WALL_LEFT;
      sb_ring_touch(contact, i, other)->held =
          other == wall && sb_ring_frame(s, wall, x).gap <= 0.0;
    }
  }
  return SB_OK;
}

// To another load, leaning first where that is wanted. If pushing the ring to its wall was too
// rough, it is followed there instead.
SbStatus sb_ring_press(SbRing *ring, const SbRingLoad *target, SbReport *report) {
  bool leaned;
  sb_ring_save(ring->contact, SB_RING_BEFORE);
  SbStatus status = lean(ring, target, &leaned, report);
  if (status != SB_OK) {
    return status;
  }
  int steps = ring->count.steps;
  status = sb_ring_advance(ring, target, leaned ? SB_RING_DIRECT : SB_RING_FOLLOW, report);
  if (leaned && status == SB_ERROR_NOT_CONVERGED) {
    if (ring->count.steps == steps) {
      sb_ring_restore(ring->contact, SB_RING_BEFORE);
    }
    status = sb_ring_advance(ring, target, SB_RING_FOLLOW, report);
  }
  return status;
}

// Pressurises a ring that has no contact with the bore by itself. The sealed state, which the fluid
// maintains once something has closed the gap, ends in a fold as the gap increases, at a finite
// contact width. It is followed outwards from a bore in contact as far as possible. Beyond that the
// fluid passes the ring.
static SbStatus press_open(SbRing *ring, const SbRingLoad *target, SbReport *report) {
  static const double CLOSED = 0.05;
  double top = 0.0;
  for (int i = 0; i < ring->contact->count; i++) {
    double x[2];
    sb_ring_contact_place(ring->contact, i, x);
    top = fmax(top, x[0]);
  }
  SbRingLoad tight = *target;
  tight.bore_radius = fmin(target->bore_radius, top - CLOSED);
  SbRingLoad dry = tight;
  dry.pressure_left = dry.pressure_right = 0.0;
  SbStatus status = sb_ring_advance(ring, &dry, SB_RING_FOLLOW, report);
  if (status == SB_OK) {
    status = sb_ring_press(ring, &tight, report);
  }
  if (status != SB_OK) {
    return status;
  }
  status = sb_ring_advance(ring, target, SB_RING_SEALED, report);
  if (status != SB_ERROR_NOT_CONVERGED) {
    return status;
  }
  double l = ring->length, p = fmax(target->pressure_left, target->pressure_right);
  const SbRingLoad *now = &ring->contact->is.now;
  return sb_fail_input(
      report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_RADIAL_SPACE,
      "the fluid passes the ring: without pressure it has no contact with the bore, and %.3g MPa "
      "presses it against the bore up to a radial space of %.5g mm, not %.5g mm",
      1e-6 * p * ring->stress, 1e3 * l * (now->bore_radius - now->floor_radius),
      1e3 * l * (target->bore_radius - target->floor_radius));
}

// Solves at a load from the guess of another. A failure restores the state before: Newton's last
// iterate has no balance of forces, and must not be judged as a state (sb_ring_crease()).
static SbStatus start(SbRing *ring, const SbRingLoad *load, const SbRingLoad *guessed, double share,
                      SbReport *report) {
  sb_ring_save(ring->contact, SB_RING_BEFORE);
  ring->contact->is.now = *load;
  if (ring->body.inward) {
    guess_clamped(ring, guessed);
  } else {
    guess(ring, guessed, share);
  }
  sb_ring_contact_detect(ring->contact);
  const SbStatus status = sb_ring_newton(ring, SB_RING_FOLLOW, report);
  if (status != SB_OK) {
    sb_ring_restore(ring->contact, SB_RING_BEFORE);
  }
  return status;
}

// Follows the free ring, which has no contact, over a stem that grows to the groove floor, then
// under a bore that closes, then under the ends of the land. It needs no guess, and ends at an
// equilibrium: the wanted one, or the last before the path is lost.
static SbStatus stretch_and_squeeze(SbRing *ring, const SbRingLoad *dry, SbReport *report) {
  static const double APART = 0.01; // gap of the free ring, in section diameters
  SbRingLoad wide = *dry;
  wide.land_right = fmax(dry->land_right, SB_RING_REACH);
  wide.land_left = fmin(dry->land_left, -SB_RING_REACH);
  wide.bore_radius = fmax(dry->bore_radius, dry->floor_radius + 1.0 + APART);
  SbRingLoad free = wide;
  free.floor_radius = fmin(dry->floor_radius, ring->centre - 0.5 - APART);
  free.bore_radius = fmax(wide.bore_radius, ring->centre + 0.5 + APART);
  SbRingLoad squeezed = wide;
  squeezed.bore_radius = dry->bore_radius;
  SbStatus status = start(ring, &free, &free, 0.0, report);
  status = status == SB_OK ? sb_ring_advance(ring, &wide, SB_RING_FOLLOW, report) : status;
  status = status == SB_OK ? sb_ring_advance(ring, &squeezed, SB_RING_FOLLOW, report) : status;
  return status == SB_OK ? sb_ring_advance(ring, dry, SB_RING_FOLLOW, report) : status;
}

// The greatest contact pressure on a surface.
static double crest_of(const SbRing *ring, SbRingSurface surface) {
  double most = 0.0;
  for (int i = 0; i < ring->contact->count; i += 2) {
    most = fmax(most, sb_ring_node_pressure(ring, i, surface));
  }
  return most;
}

// Crests over the fluid's pressure, near which a path of a clamped ring ends because of them.
static const double NEAR = 1.5;

// Reports that the fluid passes, if a pressure rise ended near such a state: the contacts of a
// clamped ring on stem and plate end in a fold as the fluid reaches the pressure of their crests.
static SbStatus tell_passed(const SbRing *ring, const SbRingLoad *load, SbStatus status,
                            SbReport *report) {
  const SbRingLoad *now = &ring->contact->is.now;
  const bool left = load->pressure_left > load->pressure_right;
  const double on_stem = crest_of(ring, SB_RING_BORE);
  const double on_plate = crest_of(ring, left ? SB_RING_WALL_LEFT : SB_RING_WALL_RIGHT);
  const double most = fmin(on_stem, on_plate);
  const double reached = fmax(now->pressure_left, now->pressure_right);
  const double wanted = fmax(load->pressure_left, load->pressure_right);
  if (!ring->body.inward || status != SB_ERROR_NOT_CONVERGED || most > NEAR * wanted) {
    return status;
  }
  status = sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_CRIMP,
                         "the fluid passes the gasket along the %s: the contact there, %.3g MPa "
                         "at most, was followed to %.3g of %.3g MPa",
                         on_stem < on_plate ? "stem" : "plate", 1e-6 * most * ring->stress,
                         1e-6 * reached * ring->stress, 1e-6 * wanted * ring->stress);
  return sb_fail_because(report, status, SB_CAUSE_FLUID_PASSES);
}

// Reports that the fluid passes a clamped ring that has lost the stem: it was in contact before the
// fluid came, and a load step has led past the fold to a state without contact. The fluid then has
// no seal between its sides, so that this state is not one of the ring.
static SbStatus fail_if_lifted(const SbRing *ring, SbReport *report) {
  const SbRingLoad *now = &ring->contact->is.now;
  const double wanted = fmax(now->pressure_left, now->pressure_right);
  SbRingPatch patch;
  if (!ring->body.inward || now->pressure_left == now->pressure_right ||
      sb_ring_patch(ring, SB_RING_BORE, &patch)) {
    return SB_OK;
  }
  const SbStatus status = sb_fail_input(
      report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_CRIMP,
      "the fluid passes the gasket along the stem: %.3g MPa lifts the gasket off the stem",
      1e-6 * wanted * ring->stress);
  return sb_fail_because(report, status, SB_CAUSE_FLUID_PASSES);
}

// Returns the last crest on the bore that holds the pressure `high`, over the contact from `first`.
static int last_crest(const SbRing *ring, int first, double high) {
  const SbRingContact *contact = ring->contact;
  const int way = contact->is.now.pressure_left > contact->is.now.pressure_right ? 2 : -2;
  int last = first;
  for (int k = 1; k < contact->count / 2; k++) {
    const int i = sb_ring_wrap(contact, first + way * k);
    last = sb_ring_node_pressure(ring, i, SB_RING_BORE) > high ? i : last;
  }
  return last;
}

SbStatus sb_ring_let_past(SbRing *ring, SbReport *report) {
  SbRingContact *contact = ring->contact;
  const SbRingLoad now = contact->is.now;
  const SbReport reason = report != NULL ? *report : (SbReport){0};
  const double high = fmax(now.pressure_left, now.pressure_right);
  const int first = contact->is.crest[0];
  const double holds = sb_ring_node_pressure(ring, first, SB_RING_BORE);
  if (!ring->body.inward || now.pressure_left == now.pressure_right || holds > NEAR * high) {
    return SB_ERROR_NOT_CONVERGED;
  }
  bool lifted;
  sb_ring_save(contact, SB_RING_BEFORE);
  contact->settled = true;
  contact->is.crest[0] = last_crest(ring, first, high);
  SbStatus status = sb_ring_moves_off(ring, &lifted, report);
  sb_ring_restore(contact, SB_RING_BEFORE);
  sb_ring_contact_settle(contact);
  if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
    return status;
  }
  if (!lifted) {
    if (report != NULL) {
      *report = reason;
    }
    return SB_ERROR_NOT_CONVERGED;
  }
  status =
      sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_CRIMP,
                    "the fluid passes the gasket along the stem: sliding with %.3g of the "
                    "friction leaves %.3g MPa of contact at the gasket's edge, and %.3g MPa "
                    "beyond this edge lift the gasket off the stem",
                    now.friction_bore, 1e-6 * holds * ring->stress, 1e-6 * high * ring->stress);
  return sb_fail_because(report, status, SB_CAUSE_FLUID_PASSES);
}

// Brings the fluid on a ring that has been fitted without.
static SbStatus press_fitted(SbRing *ring, const SbRingLoad *load, SbReport *report) {
  SbRingPatch patch;
  const bool touches = sb_ring_patch(ring, SB_RING_BORE, &patch);
  if (ring->options.alone && !touches) {
    ring->load.pressure_left = ring->load.pressure_right = 0.0;
    return SB_OK;
  }
  if (load->pressure_left == 0.0 && load->pressure_right == 0.0) {
    return SB_OK;
  }
  const bool differ = load->pressure_left != load->pressure_right;
  const bool rises = touches || !differ || ring->body.inward;
  SbStatus status = rises ? sb_ring_press(ring, load, report) : press_open(ring, load, report);
  status = status == SB_OK && touches ? fail_if_lifted(ring, report) : status;
  return tell_passed(ring, load, status, report);
}

// Puts the ring over the stem, then closes the walls on it, against their friction; then applies
// the fluid. In the reverse order the load is 1.7 times as high if nothing slips on the walls, and
// 0.19 times if they have friction only while the stem is inserted (gasket of docs/verification.md:
// 36, 62 and 6.7 N).
static SbStatus clamp_and_press(SbRing *ring, const SbRingLoad *load, SbReport *report) {
  const double middle = 0.5 * (load->wall_left + load->wall_right);
  SbRingLoad dry = *load;
  dry.pressure_left = dry.pressure_right = 0.0;
  SbRingLoad open = dry;
  open.friction_wall = 0.0;
  open.wall_left = middle - ring->outline.half;
  open.wall_right = middle + ring->outline.half;
  SbStatus status = start(ring, &open, &open, 0.0, report);
  if (status == SB_OK) {
    ring->contact->is.now.friction_wall = load->friction_wall;
    status = sb_ring_advance(ring, &dry, SB_RING_FOLLOW, report);
  }
  return status == SB_OK ? press_fitted(ring, load, report) : status;
}

// Fits the ring without fluid and friction, that of clamping walls but for, then brings on the
// fluid.
SbStatus sb_ring_fit_and_press(SbRing *ring, const SbRingLoad *smooth, SbReport *report) {
  SbRingLoad dry = *smooth;
  dry.pressure_left = dry.pressure_right = 0.0;
  if (ring->body.inward && smooth->friction_wall > 0.0) {
    return clamp_and_press(ring, smooth, report);
  }
  // Guesses with different shares of the squeeze, then a small squeeze that grows, and the ends of
  // the land that come in from outside. Where no guess has led to an equilibrium, the ring is
  // followed from its free state.
  SbStatus status = start(ring, &dry, &dry, 0.4, report);
  if (status == SB_ERROR_NOT_CONVERGED) {
    status = start(ring, &dry, &dry, 0.0, report);
  }
  bool balanced = false; // a guess has led to an equilibrium, from which no path has led on
  static const double SPACE[] = {0.85, 0.97};
  for (int i = 0; i < 2 && status == SB_ERROR_NOT_CONVERGED; i++) {
    SbRingLoad wide = dry;
    wide.bore_radius = fmax(dry.bore_radius, dry.floor_radius + SPACE[i]);
    SbRingLoad guessed = wide; // with the ring at the wall that the land's end will push it to
    wide.land_right = fmax(dry.land_right, SB_RING_REACH);
    wide.land_left = fmin(dry.land_left, -SB_RING_REACH);
    status = start(ring, &wide, &guessed, 0.4, report);
    balanced = balanced || status == SB_OK;
    wide.bore_radius = dry.bore_radius;
    if (status == SB_OK) {
      status = sb_ring_advance(ring, &wide, SB_RING_FOLLOW, report);
    }
    if (status == SB_OK) {
      status = sb_ring_advance(ring, &dry, SB_RING_FOLLOW, report);
    }
  }
  // A drawn groove takes its shape with the ring in it, squeezed or not yet.
  for (int i = 0; i < 3 && status == SB_ERROR_NOT_CONVERGED && dry.groove != NULL; i++) {
    SbRingLoad wide = dry;
    wide.bore_radius =
        i > 0 ? fmax(dry.bore_radius, dry.floor_radius + SPACE[i - 1]) : wide.bore_radius;
    SbRingLoad flat = wide;
    flat.groove_share = 0.0;
    status = start(ring, &flat, &flat, 0.4, report);
    balanced = balanced || status == SB_OK;
    status = status == SB_OK ? sb_ring_advance(ring, &wide, SB_RING_FOLLOW, report) : status;
    status = status == SB_OK ? sb_ring_advance(ring, &dry, SB_RING_FOLLOW, report) : status;
  }
  if (status == SB_ERROR_NOT_CONVERGED && !balanced && !ring->body.inward) {
    status = stretch_and_squeeze(ring, &dry, report);
  }
  if (status != SB_OK) {
    return status;
  }
  ring->count.steps = ring->count.steps > 0 ? ring->count.steps : 1;
  return press_fitted(ring, smooth, report);
}
