// Steady sliding of the bore over the ring: the path of its states as a function of the friction m,
// a factor of the bore's law, or Coulomb's coefficient.
//
// The bore slides under the whole contact, so friction has one direction, and no small motions of
// the bore are needed: t . R = m x law(n . R) at each of its nodes (ring_contact.c). Floor and
// walls have a history: it begins at the ring fitted without friction, in the middle of its groove
// or at the wall, and continues with the increasing drag.
//
// The states are followed by the arc length of their path in the plane of m and the section's
// rotation (Riks 1979; Crisfield 1981, with a plane across the last secant as constraint), because
// the drag that a ring can carry has a maximum: the hoop stress resists the rotation nearly like
// the sine of the angle. Beyond the maximum the section rolls at a decreasing drag. A maximum is
// accepted only if the drag then falls to FALL of it and the rotation is FALL_TURN larger; single
// nodes that stick or are released change m by less. A ring whose load grows to JAM times the load
// without friction is wedged: it jams. As the contact moves around the section, the mesh is fitted
// again at the same rotation.
//
// The state without friction can be unstable: a slender section that is squeezed stays upright by
// symmetry, and Newton's method finds this equilibrium too. Then no state of the path is close to
// it. The first drag tips such a section. The viscous motion of ring_path.c leads to a stable state
// at a small friction, where the path begins. Not modelled: a path that leads the upright section
// in an unstable state to a friction at which it is stable again.
#include "engine/contact/ring/ring_private.h"

#include <math.h>
#include <string.h>

// Steps along the path: first, largest and smallest; the length over which its direction is
// determined; the rotation after which the mesh is fitted again, also on an easy path; steps of the
// search for the limit. A search ends within half of CLIMB's rotation, where a flat maximum is
// known to a few per cent.
static const double ARC = 0.05, ARC_MOST = 0.15, ARC_LEAST = 5e-4, SECANT = 0.02, REFIT_TURN = 0.1,
                    EASY_TURN = 0.5, CLIMB = 0.1;

// Newton iterations of a quick and of a slow step, of a whole path and of an easy one at most;
// meshes that are tried at a place where no step succeeds, and by how much each is finer.
enum { QUICK = 7, SLOW = 14, ITERATIONS_MOST = 4000, EASY_MOST = 600, MESHES = 3 };
static const double FINER = 0.12;

// The greatest coefficient is passed where it has fallen to this share of it and the section turned
// on by FALL_TURN, or over OVER in all (rad); a path that ends has met it if it has not risen by
// more than that over FLAT_TURN. An easy path, whose limit is searched for afterwards, need not go
// so far beyond it. The load over that without friction at which the ring is wedged.
static const double FALL = 0.97, EASY_FALL = 0.985, FALL_TURN = 0.1, FLAT_TURN = 0.15, OVER = 3.0,
                    JAM = 10.0;

// Drag divided by load from which on a gasket's path that ends has reached its limit. Its plates
// fix the section, which does not rotate. Where friction exceeds about half of the pressure the
// rubber next to its edges folds, and waves of detachment move through the contact (Schallamach
// 1971, Wear 17:301), for which there is no steady state. A path that ends below this value was not
// found.
static const double DETACHES = 0.5, DETACHED_LEAST = 0.01;

// Largest force of the wall behind a ring, divided by the drag, at which the drag has released it:
// its friction at the end of the path is known to about this.
static const double LOOSE = 0.01;

bool sb_ring_rest_on_wall(SbRing *ring) {
  SbRingContact *contact = ring->contact;
  const SbRingLoad *now = &contact->is.now;
  const SbRingSurface wall = now->bore_slides > 0 ? SB_RING_WALL_RIGHT : SB_RING_WALL_LEFT;
  const SbRingSurface behind = now->bore_slides > 0 ? SB_RING_WALL_LEFT : SB_RING_WALL_RIGHT;
  double least = INFINITY, drag = 0.0, leans = 0.0;
  bool holds = false;
  for (int i = 0; i < contact->count; i++) {
    least = fmin(least, sb_ring_frame_at(contact, i, wall).gap);
    holds = holds || sb_ring_touch(contact, i, wall)->held;
    leans += sb_ring_touch(contact, i, behind)->force;
    drag += fabs(sb_ring_touch(contact, i, SB_RING_BORE)->tangent);
  }
  const bool moves = isfinite(least) && !holds && leans <= LOOSE * drag;
  for (int i = 0; i < contact->count && moves; i++) {
    *sb_ring_touch(contact, i, behind) = (SbRingTouch){0};
  }
  for (int i = 0; i < ring->mesh->nodes && moves; i++) {
    ring->fem->u[2 * i + 1] += now->bore_slides * least;
  }
  return moves;
}

// Returns the bore's load on which friction acts. Writes the drag, and the drag of the full law,
// both divided by that load.
static double bore_load(const SbRingContact *contact, double *drag, double *whole) {
  double sum = 0.0, along = 0.0, most = 0.0;
  for (int i = 0; i < contact->count; i++) {
    const SbRingTouch *touch = sb_ring_touch(contact, i, SB_RING_BORE);
    if (touch->held) {
      SbRingFrame frame = sb_ring_frame_at(contact, i, SB_RING_BORE);
      const double *fluid = &contact->pressed[2 * i];
      const double open = frame.n[0] * fluid[0] + frame.n[1] * fluid[1];
      sum += touch->force + open;
      along += touch->tangent;
      most += sb_ring_grip(contact, i, SB_RING_BORE, touch->force + open,
                           sb_ring_fluid_at(contact, i, frame.n) + open)
                  .force;
    }
  }
  *drag = sum > 0.0 ? fabs(along) / sum : 0.0;
  *whole = most > 0.0 ? most / sum : 1.0;
  return sum;
}

void sb_ring_fix_turn(SbRing *ring) {
  const SbRingContactState *is = &ring->contact->is;
  ring->arc = (SbRingArc){true, {1.0, 0.0}, {is->turn, 0.0}, 0.0, 1.0};
}

// Fits a mesh to the present contact at the same rotation: near a maximum it may have no state at
// the same coefficient. If that fails the present mesh remains.
static SbStatus fit_mesh(SbRing *ring, double size, double unit, SbReport *report) {
  sb_ring_fix_turn(ring);
  ring->arc.unit = unit;
  SbStatus status = sb_ring_refit(ring, size, report);
  return status == SB_ERROR_NOT_CONVERGED ? SB_OK : status;
}

// Reports where the path could not be followed further.
static SbStatus end_of_path(const SbRing *ring, SbReport *report) {
  SbReport reason = report != NULL ? *report : (SbReport){0};
  sb_ring_contact_settle(ring->contact);
  return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                 "steady sliding was followed to a friction of %.4g, where the section has turned "
                 "by %.3g rad: %s",
                 ring->contact->is.now.friction_bore, ring->contact->is.turn, reason.text);
}

// The path's greatest friction has been passed, or the ring is wedged.
static SbStatus end_at_limit(SbRing *ring, SbRingState state, double share, double drag) {
  ring->state = state;
  ring->share_limit = share;
  ring->drag_limit = drag;
  return SB_OK;
}

// Solves the state at the requested coefficient directly from the present one.
static SbStatus state_at(SbRing *ring, double aim, SbReport *report) {
  ring->arc.free = false;
  sb_ring_save(ring->contact, SB_RING_START);
  ring->contact->is.now.friction_bore = aim;
  return sb_ring_attempt(ring, SB_RING_DIRECT, report);
}

// The next state of the path, at most the one at the wanted coefficient: of a quick path that one
// where the step would pass it, and only where there is none so the step.
static SbStatus next_state(SbRing *ring, const double direction[2], double length, double unit,
                           double aim, SbReport *report) {
  SbRingContactState *is = &ring->contact->is;
  const double base[2] = {is->turn, unit * is->now.friction_bore};
  if (ring->options.quick && base[1] + length * direction[1] > unit * aim &&
      state_at(ring, aim, report) == SB_OK) {
    return SB_OK;
  }
  ring->arc = (SbRingArc){true, {direction[0], direction[1]}, {base[0], base[1]}, length, unit};
  sb_ring_save(ring->contact, SB_RING_START);
  SbStatus status = sb_ring_attempt(ring, SB_RING_DIRECT, report);
  if (status == SB_OK && is->now.friction_bore > aim) {
    sb_ring_restore(ring->contact, SB_RING_START);
    status = state_at(ring, aim, report);
  }
  ring->arc.free = false;
  return status;
}

// Solves a state of the path like any other, at the coefficient `aim`. Single nodes of its mesh
// without a state stay in contact against a small tension; a mesh fitted to the contact has a
// state.
static SbStatus settle_at(SbRing *ring, double aim, SbReport *report) {
  SbStatus status = SB_ERROR_NOT_CONVERGED;
  sb_ring_save(ring->contact, SB_RING_START);
  for (int i = 0; i < 2 && status == SB_ERROR_NOT_CONVERGED; i++) {
    ring->passing = i == 1;
    ring->contact->is.now.friction_bore = aim;
    status = sb_ring_attempt(ring, SB_RING_DIRECT, report);
  }
  ring->passing = false;
  return status;
}

// Moves a ring from its state without friction to the state at the friction `share` that its
// viscous motion reaches. An easy path ends instead.
static SbStatus tip(SbRing *ring, double share, SbReport *report) {
  SbRingLoad dragged = ring->contact->is.now;
  dragged.friction_bore = share;
  return sb_ring_advance(ring, &dragged, SB_RING_FOLLOW, report);
}

// Follows the states of a ring that slides by the arc length of their path until the friction
// coefficient is `aim`, or until the ring rolls or jams. Returns SB_ERROR_NOT_CONVERGED where the
// path has no further state.
// Long: the branches of a step (accepted, halved, on another mesh, moved to the wall, at the limit)
// share its length and direction and the record of the largest friction.
static SbStatus follow(SbRing *ring, double aim, SbReport *report) {
  double length = ARC, direction[2] = {0.0, 1.0}, most = 0.0, most_turn = 0.0, level = 0.0,
         level_turn = 0.0;
  double fitted = ring->contact->is.turn, drag = 0.0, limit = 0.0;
  double unit, now, still = bore_load(ring->contact, &drag, &unit);
  double anchor[2] = {fitted, unit * ring->contact->is.now.friction_bore};
  int meshes = 0, first = ring->count.iterations; // meshes tried since the last step
  bool crossed = false;                           // the ring was moved to the wall
  bool begun = ring->easy; // the path has a first state with friction, or may not be tipped
  ring->state = SB_RING_SLIDES;
  ring->passing = true;
  while (ring->contact->is.now.friction_bore < aim) {
    const SbRingContactState *is = &ring->contact->is;
    int before = ring->count.iterations;
    SbStatus status = next_state(ring, direction, length, unit, aim, report);
    int used = ring->count.iterations - before;
    if (ring->easy && ring->count.iterations - first > EASY_MOST) {
      return sb_fail(report, SB_ERROR_NOT_CONVERGED, "an easy path ends after many steps");
    }
    const bool spent = ring->count.iterations - first >= ITERATIONS_MOST;
    bool refit = fabs(is->turn - fitted) > (ring->easy && !ring->soft ? EASY_TURN : REFIT_TURN);
    if (status == SB_OK && spent && is->now.friction_bore < aim) {
      status = sb_fail(report, SB_ERROR_NOT_CONVERGED,
                       "the continuation requires more than %d iterations", ITERATIONS_MOST);
    }
    if (status == SB_ERROR_NOT_CONVERGED) {
      const bool detaches = ring->body.inward && limit > DETACHES;
      ring->count.rejected++;
      length *= 0.5;
      if (detaches && (length < DETACHED_LEAST || spent)) {
        return end_at_limit(ring, SB_RING_ROLLS, most, limit);
      }
      // No wall carries the ring: if the drag has reached the friction of the floor and the fluid's
      // push, a higher drag has no state here. The ring is moved through its groove to the wall
      // once, with its shape unchanged, and the path continues there.
      if (length < ARC_LEAST && !spent && !crossed && sb_ring_rest_on_wall(ring)) {
        crossed = true;
        length = ARC;
        continue;
      }
      if (length < ARC_LEAST || spent) {
        // A path that stops at single nodes of one mesh continues on another.
        refit = ++meshes <= MESHES && !spent;
        if (!refit && !spent && !begun) {
          begun = true;
          status = tip(ring, fmin(aim, ARC / unit), report);
          most_turn = level_turn = anchor[0] = is->turn; // the path begins here
          anchor[1] = unit * is->now.friction_bore;
          if (status == SB_OK) {
            meshes = 0;
            length = ARC;
            continue;
          }
          if (status != SB_ERROR_NOT_CONVERGED) {
            return status;
          }
        }
        if (!refit && fabs(is->turn - level_turn) > FLAT_TURN) {
          return end_at_limit(ring, SB_RING_ROLLS, most, limit);
        }
        if (!refit) {
          return end_of_path(ring, report);
        }
        length = ARC;
      }
    } else if (status == SB_OK) {
      ring->count.steps++;
      meshes = 0;
      begun = true;
      double load = bore_load(ring->contact, &drag, &now);
      if (is->now.friction_bore > most) {
        most = is->now.friction_bore;
        most_turn = is->turn;
        limit = drag;
        sb_ring_save(ring->contact, SB_RING_BEFORE);
        ring->best.here = true;
      }
      if (FALL * is->now.friction_bore > level) {
        level = is->now.friction_bore;
        level_turn = is->turn;
      }
      const bool past = fabs(is->turn - most_turn) > FALL_TURN;
      bool rolls = (is->now.friction_bore < (ring->easy ? EASY_FALL : FALL) * most && past) ||
                   fabs(is->turn) > OVER;
      if (rolls || load > JAM * still) {
        return end_at_limit(ring, rolls ? SB_RING_ROLLS : SB_RING_JAMS, most, limit);
      }
      double way[2] = {is->turn - anchor[0], unit * is->now.friction_bore - anchor[1]};
      double norm = hypot(way[0], way[1]);
      for (int k = 0; k < 2 && norm > SECANT; k++) {
        direction[k] = way[k] / norm;
        anchor[k] += way[k];
      }
      length = used <= QUICK ? fmin(ARC_MOST, 1.5 * length)
               : used > SLOW ? fmax(ARC_LEAST, 0.7 * length)
                             : length;
    }
    // The last state of a quick path gets its mesh once it is settled.
    refit = refit && !(ring->options.quick && is->now.friction_bore >= aim);
    if (refit && (status == SB_OK || status == SB_ERROR_NOT_CONVERGED)) {
      status = fit_mesh(ring, (1.0 - FINER * meshes) * ring->options.element_size, unit, report);
      fitted = ring->contact->is.turn;
    }
    if (status != SB_OK && status != SB_ERROR_NOT_CONVERGED) {
      return status;
    }
  }
  // Another mesh at a fixed rotation may have passed the coefficient.
  ring->arc.free = false;
  return ring->easy ? sb_succeed(report) : settle_at(ring, aim, report);
}

// Moves from a state at a fixed rotation to the state of maximum friction, in rotations of CLIMB.
static void climb(SbRing *ring) {
  const SbRingContactState *is = &ring->contact->is;
  for (int side = -1; side <= 1; side += 2) {
    for (bool better = true; better;) {
      const double best = is->now.friction_bore;
      ring->arc = (SbRingArc){true, {side, 0.0}, {is->turn, 0.0}, CLIMB, 1.0};
      sb_ring_save(ring->contact, SB_RING_START);
      sb_ring_save(ring->contact, SB_RING_BEFORE);
      better = sb_ring_attempt(ring, SB_RING_DIRECT, NULL) == SB_OK && is->now.friction_bore > best;
    }
    sb_ring_restore(ring->contact, SB_RING_BEFORE);
  }
  sb_ring_contact_settle(ring->contact);
}

// Solves the state of the greatest friction, at its turn, as strictly as any other. That of an easy
// path is led there; it ends where there is none, that of any other stays.
static SbStatus settle_limit(SbRing *ring, bool easy, SbReport *report) {
  static const double ONSET[] = {3.5, 2.0, 1.4}; // from SB_RING_EASY to the usual one, in halves
  const SbRingState state = ring->state;
  double before, after, whole;
  (void)bore_load(ring->contact, &before, &whole);
  ring->easy = easy;
  for (size_t i = 0; easy && i < sizeof ONSET / sizeof ONSET[0]; i++) {
    sb_ring_fix_turn(ring);
    sb_ring_save(ring->contact, SB_RING_START);
    ring->onset = ONSET[i];
    (void)sb_ring_attempt(ring, SB_RING_DIRECT, NULL);
  }
  ring->easy = false;
  sb_ring_fix_turn(ring);
  sb_ring_save(ring->contact, SB_RING_START);
  SbStatus status = sb_ring_attempt(ring, SB_RING_DIRECT, report);
  if (status == SB_OK) {
    if (easy) {
      climb(ring);
    }
    (void)bore_load(ring->contact, &after, &whole);
    ring->share_limit = ring->contact->is.now.friction_bore;
    ring->drag_limit *= after / before;
  } else if (status == SB_ERROR_NOT_CONVERGED && !easy) {
    sb_ring_contact_settle(ring->contact);
    status = sb_succeed(report);
  }
  ring->arc.free = false;
  ring->state = state;
  return status;
}

// Solves the state of a gasket at its limit as strictly as any other, at its coefficient: the
// rotation, which hardly changes along the path, contains no information. If that fails the state
// of the path remains.
static SbStatus settle_detached(SbRing *ring, SbReport *report) {
  const SbRingState state = ring->state;
  SbStatus status = settle_at(ring, ring->contact->is.now.friction_bore, report);
  if (status == SB_ERROR_NOT_CONVERGED) {
    sb_ring_contact_settle(ring->contact);
    status = sb_succeed(report);
  }
  ring->arc.free = false;
  ring->state = state;
  return status;
}

SbStatus sb_ring_drag(SbRing *ring, double aim, SbReport *report) {
  SbStatus status = follow(ring, aim, report);
  ring->passing = false;
  status = status == SB_ERROR_NOT_CONVERGED ? sb_ring_let_past(ring, report) : status;
  const bool limit = status == SB_OK && ring->state != SB_RING_SLIDES;
  const bool easy = ring->easy;
  ring->easy = false;
  sb_ring_end_best(ring, limit);
  if (limit && ring->body.inward) {
    return settle_detached(ring, report);
  }
  return limit ? settle_limit(ring, easy, report) : status;
}
