// Coulomb friction of the ring's contact nodes: which stick, which slide, and which way.
//
// A sticking node has not moved along its surface since the start of the step and |t . R| <= mu
// n . R; a sliding one has t . R = s mu n . R, s the sign of the force on the ring, and moves
// against it. Both are exact, without a regularising stiffness; the states follow the motion like
// the active set of the normal contact. Leaves out rate, wear and a static coefficient of its own.
#include "engine/contact/ring/ring_contact.h"

#include <math.h>

// A node that keeps changing between sticking and sliding has no discrete solution of Coulomb's law
// (it happens at coefficients near 1, where the continuous problem may have none either). It is
// left sticking after this many changes, and what exceeds the law is reported.
enum { FLIPS_MAX = 5 };

// An end node of a contact can have no state with friction at all: pulled when held, whether it
// sticks or slides, and inside the surface when let go. (Under fluid it jumps by mu p when caught.)
// After being caught so often it is held without friction, which always has a solution; its
// friction is taken up again in the next step, and what is missing is reported.
enum { CATCHES_MAX = 3 };

bool sb_ring_contact_rubs(const SbRingContact *contact, int i, SbRingSurface surface) {
  bool given = surface == SB_RING_BORE && contact->now.use_traction;
  return contact->touch[SB_RING_SURFACES * i + surface].held &&
         contact->now.friction[surface] > 0.0 && !given;
}

double sb_ring_contact_slipped(const SbRingContact *contact, SbRingSurface surface, int i,
                               const double x[2], const double t[2]) {
  double moved =
      t[0] * (x[0] - contact->anchor[2 * i]) + t[1] * (x[1] - contact->anchor[2 * i + 1]);
  if (surface == SB_RING_BORE) {
    moved -= t[1] * (contact->now.slide - contact->slide_start);
  }
  return moved;
}

// How far a held node is from Coulomb's law, in units of force: too large a sticking force, or a
// slip that its own friction would have to drive. The new slip state is given too.
static double slip_fault(const SbRingContact *contact, SbRingSurface surface, int i,
                         signed char *state) {
  const SbRingTouch *touch = &contact->touch[SB_RING_SURFACES * i + surface];
  double friction = contact->now.friction[surface];
  *state = touch->slip;
  if (!sb_ring_contact_rubs(contact, i, surface) || touch->smooth) {
    return 0.0;
  }
  double tiny = 1e-11 * contact->force_scale;
  if (touch->slip == 0) {
    double over = fabs(touch->tangent) - friction * touch->force;
    *state = touch->tangent > 0.0 ? 1 : -1;
    return over > tiny ? over : 0.0;
  }
  double x[2], n[2], t[2], gap, curvature;
  sb_ring_contact_place(contact, i, x);
  sb_ring_frame(&contact->now, surface, x, n, t, &gap, &curvature);
  double against = sb_ring_contact_slipped(contact, surface, i, x, t) * touch->slip;
  *state = 0;
  // A length as a force by a stiffness of order one per unit of boundary.
  return against > 1e-11 ? against * contact->weight[i] : 0.0;
}

static void flip(SbRingTouch *touch, signed char state) {
  touch->flips++;
  touch->slip = touch->flips >= FLIPS_MAX ? 0 : state;
}

int sb_ring_contact_update_slip(SbRingContact *contact, bool single) {
  int changes = 0, worst = -1;
  double most = 0.0;
  signed char worst_state = 0;
  for (int i = 0; i < contact->count; i++) {
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      signed char state;
      double fault = slip_fault(contact, (SbRingSurface)s, i, &state);
      SbRingTouch *touch = &contact->touch[SB_RING_SURFACES * i + s];
      if (touch->flips >= FLIPS_MAX) {
        continue;
      }
      if (fault > 0.0 && !single) {
        flip(touch, state);
        contact->unsteady = SB_RING_SURFACES * i + s;
        changes++;
      } else if (fault > most) {
        most = fault;
        worst = SB_RING_SURFACES * i + s;
        worst_state = state;
      }
    }
  }
  if (worst >= 0) {
    flip(&contact->touch[worst], worst_state);
    contact->unsteady = worst;
    changes++;
  }
  return changes;
}

// Friction against the node's motion in this step. A node that comes back, since the surface would
// have had to pull it in that state, tries the others in turn.
void sb_ring_contact_begin_friction(SbRingContact *contact, int i, SbRingSurface surface) {
  SbRingTouch *touch = &contact->touch[SB_RING_SURFACES * i + surface];
  if (contact->now.friction[surface] > 0.0) {
    double x[2], n[2], t[2], gap, curvature;
    sb_ring_contact_place(contact, i, x);
    sb_ring_frame(&contact->now, surface, x, n, t, &gap, &curvature);
    double moved = sb_ring_contact_slipped(contact, surface, i, x, t);
    int state = moved > 1e-9 ? -1 : moved < -1e-9 ? 1 : 0, turn = touch->catches % 3;
    touch->slip = (signed char)(turn < 2 ? state * (1 - turn) : -state);
  }
  touch->smooth = touch->catches >= CATCHES_MAX;
  touch->catches++;
}

double sb_ring_contact_slip_excess(const SbRingContact *contact) {
  double sum = 0.0;
  for (int i = 0; i < SB_RING_SURFACES * contact->count; i++) {
    const SbRingTouch *touch = &contact->touch[i];
    SbRingSurface surface = (SbRingSurface)(i % SB_RING_SURFACES);
    double friction = contact->now.friction[surface];
    if (!sb_ring_contact_rubs(contact, i / SB_RING_SURFACES, surface)) {
      continue;
    }
    if (touch->smooth) {
      sum += friction * touch->force;
    } else if (touch->slip == 0) {
      sum += fmax(0.0, fabs(touch->tangent) - friction * touch->force);
    }
  }
  return sum;
}
