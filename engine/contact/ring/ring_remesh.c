// A ring's state on another mesh, fitted to its contacts.
//
// Vertices are at the contacts' ends, and elements are smallest there. The state is transferred by
// material positions, the nodes in contact by material angle, and solved on the new mesh: with its
// contact fixed until the balance is nearly reached; else through the state of the same rotation;
// else from the free ring.
#include "engine/contact/ring/ring_private.h"

#include <math.h>

// Arc of a bore contact, in section diameters, below which its elements become smaller with it, and
// the smallest fraction of their size.
static const double WIDE = 0.3, NARROW_LEAST = 0.12;

// Largest change of the friction by another mesh at a fixed rotation: of its factor, and of its
// coefficient if that is small.
static const double SAME_STATE = 0.05, SAME_COEFFICIENT = 0.005;

// Largest element divided by those of the contacts. Lips and webs bend away from them: at rest half
// of it (of a dragged ring another mesh is another path, whose load has an error of 1.2 %).
static double growth_of(const SbRing *ring) {
  const bool rests = ring->contact->is.now.bore_slides == 0;
  return rests && sb_ring_bends(&ring->body.profile) ? 1.6 : 3.2;
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

// Sets the slip states of a mesh's nodes in contact: those of the nearest nodes of another mesh.
static void carry_slip(SbRingContact *to, const SbRingContact *from) {
  for (int i = 0; i < to->count; i++) {
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      double nearest = INFINITY;
      for (int k = 0; k < from->count && sb_ring_touch(to, i, s)->held; k++) {
        const double away =
            fabs(remainder(to->fem->mesh->angle[i] - from->fem->mesh->angle[k], 2.0 * M_PI));
        if (sb_ring_touch(from, k, s)->held && away < nearest) {
          nearest = away;
          sb_ring_touch(to, i, s)->slip = sb_ring_touch(from, k, s)->slip;
        }
      }
    }
  }
}

// Solves on a mesh from the state on another one, whose contacts are `patch`, with the same load
// and, by material angle, the same nodes in contact. `fixed`: with their slip states, fixed until
// the balance is nearly reached; else sticking at first.
static SbStatus carry_over(SbRing *fresh, const SbRing *ring, const SbRingPatch *patch,
                           const bool *touches, bool fixed, SbReport *report) {
  SbRingContact *contact = fresh->contact;
  sb_ring_fem_transfer(fresh->fem, ring->fem);
  contact->is.now = ring->contact->is.now;
  contact->is.turn = ring->contact->is.turn;
  sb_ring_fem_save(fresh->fem, SB_RING_START);
  contact->is.excess = ring->contact->is.excess;
  for (int i = 0; i < contact->count; i++) {
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      bool held = false;
      for (int turn = 0; turn < 2 && touches[s]; turn++) {
        double angle = fresh->mesh->angle[i] + 2.0 * M_PI * turn;
        held = held || (angle > patch[s].angle[0] - 1e-9 && angle < patch[s].angle[1] + 1e-9);
      }
      *sb_ring_touch(contact, i, s) = (SbRingTouch){.held = held};
    }
  }
  contact->fixed = contact->carried = fixed;
  if (fixed) {
    carry_slip(contact, ring->contact);
  }
  // The transfer moves nodes about by less than this: it turns no slip round.
  static const double SLID = 1e-3;
  contact->slid = SLID;
  SbStatus status = sb_ring_newton(fresh, SB_RING_FOLLOW, report);
  contact->fixed = contact->carried = contact->stuck = false;
  contact->slid = 0.0;
  // At a fixed rotation the coefficient depends on the mesh; a very different one is that of
  // another state.
  const double was = ring->contact->is.now.friction_bore;
  const double change = fabs(contact->is.now.friction_bore - was);
  if (fresh->arc.free && status == SB_OK &&
      !(change <
        fmax(SAME_STATE * was, ring->options.quick ? SAME_COEFFICIENT / fresh->arc.unit : 0.0))) {
    status = sb_fail(report, SB_ERROR_NOT_CONVERGED, "the finer mesh slides in another state");
  }
  return status;
}

// Does the same through the state of the same rotation: near the maximum drag the rotation at a
// given friction depends on the mesh.
static SbStatus carry_turn(SbRing *fresh, const SbRing *ring, const SbRingPatch *patch,
                           const bool *touches, SbReport *report) {
  SbRingContact *contact = fresh->contact;
  const double share = ring->contact->is.now.friction_bore;
  contact->is.turn = ring->contact->is.turn;
  sb_ring_fix_turn(fresh);
  SbStatus status = carry_over(fresh, ring, patch, touches, true, report);
  fresh->arc.free = false;
  if (status == SB_OK) {
    sb_ring_save(contact, SB_RING_START);
    contact->is.now.friction_bore = share;
    status = sb_ring_attempt(fresh, SB_RING_DIRECT, report);
  }
  return status;
}

SbStatus sb_ring_remesh(SbRing *fresh, const SbRing *ring, double element_size, double edge,
                        SbReport *report) {
  SbRingMeshPlan plan =
      sb_ring_empty_plan(ring, fmin(0.16, growth_of(ring) * element_size), element_size);
  SbRingPatch patch[SB_RING_SURFACES];
  bool touches[SB_RING_SURFACES];
  fresh->mesh = NULL;
  fresh->fem = NULL;
  fresh->contact = NULL;
  for (int s = 0; s < SB_RING_SURFACES; s++) {
    touches[s] = sb_ring_patch(ring, (SbRingSurface)s, &patch[s]);
    if (touches[s]) {
      // A narrow bore contact has as many elements as one of WIDE: its load is what is wanted.
      const double arc = sb_ring_mesh_arc(ring->mesh, patch[s].angle[0], patch[s].angle[1]);
      double wide = s == SB_RING_BORE ? arc / WIDE : 1.0;
      double size = element_size * fmin(1.0, fmax(NARROW_LEAST, wide));
      // Friction on the last node includes that of the adjacent fluid: short elements there, less
      // short along a path, which fails at them, and none along an easy path.
      bool slides = s == SB_RING_BORE && ring->contact->is.now.bore_slides != 0;
      double path = ring->easy && ring->options.quick ? 1.0 : 0.15;
      double share = edge > 0.0 ? edge : !slides ? 0.3 : ring->arc.free ? path : 0.07;
      plan_patch(&plan, &patch[s], size, share * size);
    }
  }
  SbStatus status = sb_ring_build(fresh, &plan, report);
  if (status != SB_OK) {
    sb_ring_drop(fresh);
    return status;
  }
  SbRingContact *contact = fresh->contact;
  const bool rubs = sb_ring_has_friction(&ring->contact->is.now);
  status = carry_over(fresh, ring, patch, touches, rubs && !fresh->arc.free, report);
  if (status == SB_ERROR_NOT_CONVERGED && rubs && !ring->at_once) {
    status = carry_over(fresh, ring, patch, touches, fresh->arc.free, report);
    if (status == SB_ERROR_NOT_CONVERGED && !fresh->arc.free && contact->is.now.bore_slides != 0) {
      status = carry_turn(fresh, ring, patch, touches, report);
    }
  } else if (status == SB_ERROR_NOT_CONVERGED && !rubs) {
    // Too far from the transferred state: follow the whole path again on the new mesh.
    SbRingLoad setting = ring->contact->is.now;
    status = sb_ring_fit_and_press(fresh, &setting, report);
  }
  if (status == SB_OK) {
    status = sb_ring_check_apart(fresh, report);
  }
  if (status != SB_OK) {
    sb_ring_drop(fresh);
    return status;
  }
  if (fresh->arc.free) {
    const double share = contact->is.now.friction_bore / ring->contact->is.now.friction_bore;
    fresh->share_limit *= share;
    fresh->drag_limit *= share;
  }
  fresh->fitted_size = element_size;
  for (int k = 0; k < 2; k++) {
    fresh->fitted_end[k] = touches[SB_RING_BORE] ? patch[SB_RING_BORE].angle[k] : NAN;
  }
  return SB_OK;
}

SbStatus sb_ring_refit_once(SbRing *ring, double element_size, SbReport *report) {
  SbRing fresh = *ring;
  SbStatus status = sb_ring_remesh(&fresh, ring, element_size, 0.0, report);
  if (status != SB_OK) {
    ring->count = fresh.count;
    return status;
  }
  if (ring->best.here) {
    sb_ring_end_best(ring, false); // an older one
    fresh.best = (SbRingBest){false, ring->mesh, ring->fem, ring->contact};
  } else {
    sb_ring_drop(ring);
  }
  *ring = fresh;
  return sb_succeed(report);
}

const double sb_ring_try[SB_RING_TRIES] = {1.0, 0.93, 0.87};

SbStatus sb_ring_refit(SbRing *ring, double element_size, SbReport *report) {
  const SbRingState state = ring->state; // of the path, which attempts do not know
  SbStatus status = sb_ring_refit_once(ring, element_size, report);
  for (int i = 1; i < SB_RING_TRIES && status == SB_ERROR_NOT_CONVERGED; i++) {
    if (ring->contact->is.now.bore_slides == 0) {
      break;
    }
    status = sb_ring_refit_once(ring, sb_ring_try[i] * element_size, report);
  }
  ring->state = state;
  return status;
}
