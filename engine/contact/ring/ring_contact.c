// Unilateral contact of the ring with smooth rigid surfaces and its Coulomb friction: active sets
// and their forces.
//
// Contact is a primal-dual active set (Hintermueller, Ito and Kunisch 2002) on boundary nodes.
// Nodes in contact satisfy gap = 0 as an equation of their own; the normal force is the residual of
// the balance that this equation replaces. So neither penetration nor tension is left at the end.
// The fluid loads every side that is not closed (ring_fluid.c); the surfaces are those of
// ring_groove.c.
//
// Friction enters the tangential rows of the same nodes. A sticking node has not moved along its
// surface since the start of the step, and |t . R| <= mu n . R. A sliding node has t . R = s mu n .
// R, s the sign of the force on the ring, and moves against it. On the bore mu n . R may be any law
// of the local pressure, a fraction of area times shear(n . R / area). Both are exact, without a
// regularising stiffness. The states follow the motion like the active set of the normal contact.
// Not modelled: adhesion, rate, wear, a separate static coefficient.
//
// Long: the sets of the normal contact and of friction change the states of the same nodes.
#include "engine/contact/ring/ring_contact.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Largest motion of a node in contact along the edge in one iteration, divided by the edge's
// rounding.
static const double EDGE_SHARE = 0.5;

// A node that alternates between sticking and sliding has no discrete solution of Coulomb's law (at
// coefficients near 1, where the continuous problem may have none either). After this many changes
// it remains sticking, and the excess over the law is reported.
enum { FLIPS_MAX = 5 };

// An end node of a contact can have no state with friction: in contact it is pulled, whether it
// sticks or slides, and released it is inside the surface. (Under fluid its friction jumps by mu p
// when it enters the contact.) After so many entries it is in contact without friction, which
// always has a solution; its friction is restored in the next step, and the missing part is
// reported. On a continuation path, whose states only lead to others, such a node stays in contact
// against a small tension, in units of force; a larger one would change the path.
enum { CATCHES_MAX = 3, PASSED_MAX = 1 };
static const double PULL = 1e-3;

// Under fluid a node at the end of a contact would have the friction of the fluid's pressure as
// soon as it enters the contact, and could have no state: in contact it is pulled, released it
// returns. Therefore its friction develops smoothly over the first excess of its pressure above the
// fluid's: over this fraction of the fluid's pressure, or WET_MOST shear moduli if that is less;
// for a section with several crests, over the excess of its whole contact if that is less, because
// a flat lip may nowhere exceed the fluid by more. The drag is then the law's integral over the
// recovered pressure to 0.3 % (tests/engine), on a continuation path to some per cent. On an easy
// path friction develops more gradually, so that hardly any node is without a state, but the limit
// of sliding is not accurate.
static const double WET = 0.15, WET_MOST = 0.7;

// Neighbouring nodes at the end of a contact can enter and leave it alternately for ever. A node
// that has entered the contact or changed its slip so often in a solve changes again only if it has
// the largest violation.
enum { FREE = 2 };

SbStatus sb_ring_contact_create(SbRingContact **out, SbRingFem *fem, SbReport *report) {
  *out = NULL;
  SbRingContact *contact = calloc(1, sizeof *contact);
  if (contact == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's contact");
  }
  size_t n = (size_t)fem->mesh->loop_count;
  contact->fem = fem;
  contact->count = (int)n;
  contact->force_scale = contact->onset = 1.0;
  contact->is.excess = INFINITY;
  contact->is.touch = calloc(3 * n * SB_RING_SURFACES, sizeof(SbRingTouch)); // and the saved ones
  contact->closed = calloc(n, sizeof(bool));
  contact->share = calloc(8 * n, sizeof(double)); // and what follows it
  if (contact->is.touch == NULL || contact->closed == NULL || contact->share == NULL) {
    sb_ring_contact_destroy(contact);
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's contact");
  }
  contact->pressed = contact->share + 2 * n;
  contact->fluid = contact->share + 4 * n;
  contact->weight = contact->share + 6 * n;
  contact->wet = contact->share + 7 * n;
  contact->saved[SB_RING_START].touch = contact->is.touch + n * SB_RING_SURFACES;
  contact->saved[SB_RING_BEFORE].touch = contact->is.touch + 2 * n * SB_RING_SURFACES;
  *out = contact;
  return SB_OK;
}

void sb_ring_contact_destroy(SbRingContact *contact) {
  if (contact != NULL) {
    free(contact->is.touch);
    free(contact->closed);
    free(contact->share);
    free(contact);
  }
}

SbRingFrame sb_ring_frame_at(const SbRingContact *contact, int i, SbRingSurface surface) {
  double x[2];
  sb_ring_contact_place(contact, i, x);
  return sb_ring_frame(&contact->is.now, surface, x);
}

void sb_ring_contact_detect(SbRingContact *contact) {
  for (int i = 0; i < contact->count; i++) {
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      SbRingTouch *touch = sb_ring_touch(contact, i, s);
      touch->held = sb_ring_frame_at(contact, i, (SbRingSurface)s).gap <= 1e-12;
      touch->slip = 0;
    }
  }
}

// ---- friction

// Returns whether a node is in contact with a surface with Coulomb friction whose direction is
// unknown.
static bool rubs(const SbRingContact *contact, int i, SbRingSurface surface) {
  return sb_ring_touch(contact, i, surface)->held &&
         !(surface == SB_RING_BORE && contact->is.now.bore_slides != 0) &&
         sb_ring_friction(&contact->is.now, surface) > 0.0;
}

double sb_ring_fluid_at(const SbRingContact *contact, int i, const double n[2]) {
  return n[0] * contact->share[2 * i] + n[1] * contact->share[2 * i + 1];
}

SbRingGrip sb_ring_grip(const SbRingContact *contact, int i, SbRingSurface surface, double normal,
                        double fluid) {
  const SbRingLoad *now = &contact->is.now;
  const double area = contact->weight[i];
  SbRingGrip grip = {normal, 1.0, 0.0, 0.0};
  if (surface == SB_RING_BORE && now->shear != NULL && area > 0.0) {
    // A node under tension, before it is released, continues the beginning of the law.
    const double pressure = fmax(0.0, normal) / area;
    const double shear =
        now->shear(pressure * contact->stress, &grip.by_normal, now->law) / contact->stress;
    grip.force = area * shear + grip.by_normal * fmin(0.0, normal);
    grip.by_area = (grip.force - grip.by_normal * normal) / area;
  }
  if (surface == SB_RING_BORE && now->bore_slides != 0 && fluid > 0.0) {
    const double most = fmin(WET_MOST, contact->is.excess);
    const bool high = fluid > most * area;
    const double over = contact->onset * WET * (high ? most * area : fluid);
    const double share = fmax(0.0, (normal - fluid) / over);
    if (share < 1.0) {
      const double part = share * share * (3.0 - 2.0 * share);
      const double rise = 6.0 * share * (1.0 - share) / over * grip.force;
      grip.force *= part;
      grip.by_normal = part * grip.by_normal + rise;
      grip.by_area = part * grip.by_area - (high ? rise * (normal - fluid) / area : 0.0);
      grip.by_fluid = -rise * (high ? 1.0 : normal / fluid);
    }
  }
  return grip;
}

// Returns the largest friction at a node under its present normal force.
static double bears(const SbRingContact *contact, int i, SbRingSurface surface) {
  const double normal = sb_ring_touch(contact, i, surface)->force;
  return sb_ring_friction(&contact->is.now, surface) *
         sb_ring_grip(contact, i, surface, normal, 0.0).force;
}

bool sb_ring_contact_sticks(const SbRingContact *contact, int i, SbRingSurface surface) {
  const SbRingTouch *touch = sb_ring_touch(contact, i, surface);
  return !touch->smooth && touch->slip == 0 && rubs(contact, i, surface);
}

// Motion of a boundary node along t relative to the surface since the start of the step.
static double slipped(const SbRingContact *contact, SbRingSurface surface, int i,
                      const double t[2]) {
  const double *u = &contact->fem->u[2 * contact->fem->mesh->loop[i]];
  const double *start = &contact->fem->saved[SB_RING_START][2 * contact->fem->mesh->loop[i]];
  double moved = t[0] * (u[0] - start[0]) + t[1] * (u[1] - start[1]);
  if (surface == SB_RING_BORE) {
    moved -=
        t[1] * (contact->is.now.bore_position - contact->saved[SB_RING_START].now.bore_position);
  }
  return moved;
}

// Returns the deviation of a node in contact from Coulomb's law, in units of force: an excessive
// sticking force, or a slip that its own friction would have to drive. Also returns the new slip
// state.
static double slip_fault(const SbRingContact *contact, SbRingSurface surface, int i,
                         signed char *state) {
  const SbRingTouch *touch = sb_ring_touch(contact, i, surface);
  *state = touch->slip;
  if (!rubs(contact, i, surface) || touch->smooth) {
    return 0.0;
  }
  if (touch->slip == 0) {
    double over = fabs(touch->tangent) - bears(contact, i, surface);
    *state = touch->tangent > 0.0 ? 1 : -1;
    return over > 1e-11 * contact->force_scale ? over : 0.0;
  }
  SbRingFrame frame = sb_ring_frame_at(contact, i, surface);
  double against = slipped(contact, surface, i, frame.t) * touch->slip - contact->slid;
  *state = 0;
  // A length as a force by a stiffness of order one per unit of boundary.
  return against > 1e-11 ? against * contact->weight[i] : 0.0;
}

double sb_ring_contact_fault(const SbRingContact *contact) {
  double sum = 0.0;
  for (int at = 0; at < SB_RING_SURFACES * contact->count; at++) {
    const int i = at / SB_RING_SURFACES, s = at % SB_RING_SURFACES;
    const SbRingTouch *touch = &contact->is.touch[at];
    const SbRingFrame frame = sb_ring_frame_at(contact, i, (SbRingSurface)s);
    const double *share = &contact->share[2 * i];
    signed char state;
    sum += touch->held ? fmax(0.0, frame.n[0] * share[0] + frame.n[1] * share[1] - touch->force)
                       : fmax(0.0, -frame.gap) * contact->weight[i];
    sum += slip_fault(contact, (SbRingSurface)s, i, &state);
  }
  return sum;
}

static void flip(SbRingContact *contact, int at, signed char state) {
  SbRingTouch *touch = &contact->is.touch[at];
  touch->flips++;
  touch->slip = touch->flips >= FLIPS_MAX ? 0 : state;
  contact->unsteady = at;
}

// Renews stick and slip, with `single` only at the worst fault; returns how many changed.
static int update_slip(SbRingContact *contact, bool single) {
  int changes = 0, worst = -1;
  double most = 0.0;
  signed char worst_state = 0;
  for (int at = 0; at < SB_RING_SURFACES * contact->count; at++) {
    signed char state;
    double fault =
        slip_fault(contact, (SbRingSurface)(at % SB_RING_SURFACES), at / SB_RING_SURFACES, &state);
    if (contact->is.touch[at].flips >= FLIPS_MAX) {
      continue;
    }
    if (fault > 0.0 && !(single && contact->is.touch[at].flips >= FREE)) {
      flip(contact, at, state);
      changes++;
    } else if (fault > most) {
      most = fault;
      worst = at;
      worst_state = state;
    }
  }
  if (worst >= 0) {
    flip(contact, worst, worst_state);
    changes++;
  }
  return changes;
}

// The first slip state of a node that a surface has just caught: friction against its motion in
// this step. A node that comes back, since the surface would have had to pull it in that state,
// tries the others in turn.
static void begin_friction(SbRingContact *contact, int i, SbRingSurface surface) {
  SbRingTouch *touch = sb_ring_touch(contact, i, surface);
  if (sb_ring_friction(&contact->is.now, surface) > 0.0) {
    SbRingFrame frame = sb_ring_frame_at(contact, i, surface);
    double moved = slipped(contact, surface, i, frame.t);
    int state = moved > 1e-9 ? -1 : moved < -1e-9 ? 1 : 0, turn = touch->catches % 3;
    touch->slip = (signed char)(turn < 2 ? state * (1 - turn) : -state);
  }
  touch->smooth = touch->catches >= CATCHES_MAX;
  touch->catches++;
}

// Sum of what exceeds Coulomb's law at sticking nodes and of the friction that is left out.
static double slip_excess(const SbRingContact *contact) {
  double sum = 0.0;
  for (int i = 0; i < contact->count; i++) {
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      const SbRingTouch *touch = sb_ring_touch(contact, i, s);
      if (rubs(contact, i, (SbRingSurface)s) && (touch->smooth || touch->slip == 0)) {
        double limit = bears(contact, i, (SbRingSurface)s);
        sum += touch->smooth ? limit : fmax(0.0, fabs(touch->tangent) - limit);
      }
    }
  }
  return sum;
}

// ---- conditions and forces

// Adds the dependence of a node's prescribed traction on its area and on the fluid's force on it,
// which change with the nodes of its sides.
static void lean_on_sides(const SbRingContact *contact, int i, const SbRingGrip *grip, double share,
                          const double n[2], SbRingCondition *condition) {
  const int first = i - (i % 2 != 0 ? 1 : 2), count = i % 2 != 0 ? 3 : SB_RING_BESIDE;
  condition->beside_count = count;
  for (int k = 0; k < count; k++) {
    condition->beside[k] = contact->fem->mesh->loop[sb_ring_wrap(contact, first + k)];
  }
  for (int from = first; from + 2 < first + count; from += 2) {
    const int side = sb_ring_wrap(contact, from) / 2, a = i - from;
    const SbRingSidePressure pressure = {.value = contact->wet[side]};
    double area[3][2], force[3][2], fluid[3][2][3][2], whole[3];
    sb_ring_side_area_slope(contact, side, a, area);
    sb_ring_side_load(contact, side, pressure, force, fluid, whole);
    for (int k = 0; k < 3; k++) {
      for (int c = 0; c < 2; c++) {
        const double by_fluid = n[0] * fluid[a][0][k][c] + n[1] * fluid[a][1][k][c];
        condition->drive_slope[from - first + k][c] +=
            share * (grip->by_area * area[k][c] - grip->by_fluid * by_fluid);
      }
    }
  }
}

// Returns whether a later surface is in contact with the node too.
static bool corner(const SbRingContact *contact, int i, int surface) {
  for (int other = surface + 1; other < SB_RING_SURFACES; other++) {
    if (sb_ring_touch(contact, i, other)->held) {
      return true;
    }
  }
  return false;
}

double sb_ring_contact_apply(SbRingContact *contact) {
  SbRingFem *fem = contact->fem;
  sb_ring_contact_load_fluid(contact);
  contact->folded = sb_ring_fold_apply(contact);
  double worst = 0.0;
  for (int i = 0; i < contact->count; i++) {
    SbRingCondition *condition = &fem->condition[fem->mesh->loop[i]];
    *condition = (SbRingCondition){0};
    for (int s = 0; s < SB_RING_SURFACES && condition->count < 2; s++) {
      const SbRingTouch *touch = sb_ring_touch(contact, i, s);
      if (!touch->held) {
        continue;
      }
      SbRingFrame frame = sb_ring_frame_at(contact, i, (SbRingSurface)s);
      worst = fmax(worst, fabs(frame.gap));
      memcpy(condition->direction[condition->count], frame.n, sizeof frame.n);
      condition->gap[condition->count] = -frame.gap;
      if (condition->count == 1) {
        condition->count = 2; // in contact with both surfaces of a corner
        break;
      }
      condition->count = 1;
      memcpy(condition->direction[1], frame.t, sizeof frame.t);
      condition->curve = frame.curvature;
      condition->axis = frame.axis;
      if (contact->stuck) {
        condition->count = corner(contact, i, s) ? 1 : 2;
      } else if (s == SB_RING_BORE && contact->is.now.use_bore_traction) {
        condition->drive = contact->is.now.bore_traction * contact->weight[i];
      } else if (sb_ring_contact_sticks(contact, i, (SbRingSurface)s)) {
        condition->gap[1] = -slipped(contact, (SbRingSurface)s, i, frame.t);
        condition->count = corner(contact, i, s) ? 1 : 2;
      } else if (!touch->smooth) {
        bool known = s == SB_RING_BORE && contact->is.now.bore_slides != 0;
        int slip = known ? contact->is.now.bore_slides : touch->slip;
        const double *force = &fem->residual[2 * fem->mesh->loop[i]];
        const double share = slip * sb_ring_friction(&contact->is.now, (SbRingSurface)s);
        const double normal = frame.n[0] * force[0] + frame.n[1] * force[1];
        const SbRingGrip grip = sb_ring_grip(contact, i, (SbRingSurface)s, normal,
                                             sb_ring_fluid_at(contact, i, frame.n));
        condition->mix = -share * grip.by_normal;
        condition->drive = share * (grip.force - grip.by_normal * normal);
        if (grip.by_area != 0.0 || grip.by_fluid != 0.0) {
          lean_on_sides(contact, i, &grip, share, frame.n, condition);
        }
      }
    }
  }
  return worst;
}

// Splits a nodal force into normal and tangential parts of the contacts.
static void split_force(SbRingContact *contact, int i, const double force[2]) {
  SbRingTouch *held[2];
  SbRingFrame frame[2];
  int count = 0;
  for (int s = 0; s < SB_RING_SURFACES; s++) {
    SbRingTouch *touch = sb_ring_touch(contact, i, s);
    touch->force = touch->tangent = 0.0;
    if (touch->held && count < 2) {
      frame[count] = sb_ring_frame_at(contact, i, (SbRingSurface)s);
      held[count++] = touch;
    }
  }
  if (count == 1) {
    const double *n = frame[0].n, *t = frame[0].t;
    held[0]->force = n[0] * force[0] + n[1] * force[1];
    held[0]->tangent = t[0] * force[0] + t[1] * force[1];
  } else if (count == 2) {
    // Two surfaces: normal forces only.
    const double *a = frame[0].n, *b = frame[1].n;
    double det = a[0] * b[1] - a[1] * b[0];
    held[0]->force = (force[0] * b[1] - force[1] * b[0]) / det;
    held[1]->force = (a[0] * force[1] - a[1] * force[0]) / det;
  }
}

// Adds a node to the contact or releases it.
static void toggle(SbRingContact *contact, int at) {
  SbRingTouch *touch = &contact->is.touch[at];
  contact->unsteady = at;
  touch->held = !touch->held;
  touch->slip = 0;
  if (touch->held) {
    begin_friction(contact, at / SB_RING_SURFACES, (SbRingSurface)(at % SB_RING_SURFACES));
  }
}

int sb_ring_contact_update(SbRingContact *contact, bool single) {
  SbRingFem *fem = contact->fem;
  int changes = 0;
  if (contact->fixed) {
    return 0;
  }
  int worst[2] = {-1, -1}; // to be released, to be added
  const double none = -1e-11 * contact->force_scale;
  double least = none, deepest = -1e-11;
  for (int i = 0; i < contact->count; i++) {
    int node = fem->mesh->loop[i];
    const double *share = &contact->share[2 * i];
    if (fem->condition[node].count > 0) {
      double force[2];
      sb_ring_fem_reaction(fem, node, force);
      split_force(contact, i, force);
    }
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      int at = SB_RING_SURFACES * i + s;
      const SbRingTouch *touch = &contact->is.touch[at];
      SbRingFrame frame = sb_ring_frame_at(contact, i, (SbRingSurface)s);
      // The fluid would push this node off the surface, along n, by its share.
      double excess = touch->force - frame.n[0] * share[0] - frame.n[1] * share[1];
      const bool alone = single || touch->catches >= FREE;
      if (!touch->held && frame.gap < (alone ? deepest : -1e-11)) {
        worst[1] = alone ? at : worst[1];
        deepest = alone ? frame.gap : deepest;
      } else if (touch->held && excess < (alone ? least : none) &&
                 !(contact->passed && touch->catches > PASSED_MAX &&
                   excess > -PULL * contact->force_scale)) {
        worst[0] = alone ? at : worst[0];
        least = alone ? excess : least;
      } else {
        continue;
      }
      if (!alone) {
        toggle(contact, at);
        changes++;
      }
    }
  }
  for (int k = 0; k < 2; k++) {
    if (worst[k] >= 0) {
      toggle(contact, worst[k]);
      changes++;
    }
  }
  // Friction follows when the contact is constant: changing both together does not converge.
  return changes > 0 ? changes : update_slip(contact, single);
}

double sb_ring_contact_limit(const SbRingContact *contact) {
  const SbRingFem *fem = contact->fem;
  double step = 1.0;
  for (int i = 0; i < contact->count; i++) {
    if (sb_ring_touch(contact, i, SB_RING_BORE)->held) {
      double x[2], move = fem->du[2 * fem->mesh->loop[i] + 1];
      sb_ring_contact_place(contact, i, x);
      double before = sb_ring_frame(&contact->is.now, SB_RING_BORE, x).curvature;
      x[1] += move;
      double after = sb_ring_frame(&contact->is.now, SB_RING_BORE, x).curvature;
      if (before != 0.0 || after != 0.0) {
        step = fmin(step, EDGE_SHARE * contact->is.now.edge_length / fmax(fabs(move), 1e-30));
      }
    }
  }
  return step;
}

// Takes the bore's excess over the fluid from the last state on this mesh, if it has one.
static void renew_excess(SbRingContact *contact) {
  const SbRingLoad *now = &contact->is.now;
  double most = 0.0;
  for (int i = 0; i < contact->count; i += 2) {
    const SbRingTouch *touch = sb_ring_touch(contact, i, SB_RING_BORE);
    if (touch->held && contact->weight[i] > 0.0) {
      most = fmax(most, touch->force / contact->weight[i]);
    }
  }
  const double excess = most - fmax(now->pressure_left, now->pressure_right);
  contact->is.excess = excess > 0.0 ? excess : contact->is.excess;
}

void sb_ring_contact_begin(SbRingContact *contact) {
  contact->unsteady = -1;
  if (contact->lobes) {
    renew_excess(contact);
  }
  for (int i = 0; i < SB_RING_SURFACES * contact->count; i++) {
    contact->is.touch[i].flips = contact->is.touch[i].catches = 0;
    contact->is.touch[i].smooth = false;
  }
}

void sb_ring_contact_forces(SbRingContact *contact) {
  const SbRingFem *fem = contact->fem;
  for (int i = 0; i < contact->count; i++) {
    split_force(contact, i, &fem->residual[2 * fem->mesh->loop[i]]);
  }
  contact->slip_excess = slip_excess(contact);
  // For the record, the fluid on open sides is the fluid's again, not the contact's.
  for (int i = 0; i < contact->count; i++) {
    double force[2];
    for (int k = 0; k < 2; k++) {
      force[k] = fem->residual[2 * fem->mesh->loop[i] + k] - contact->pressed[2 * i + k];
      contact->fluid[2 * i + k] += contact->pressed[2 * i + k];
      contact->share[2 * i + k] -= contact->pressed[2 * i + k];
    }
    split_force(contact, i, force);
  }
}

void sb_ring_contact_settle(SbRingContact *contact) {
  SbRingFem *fem = contact->fem;
  // Neither the spring nor the damper of the attempts acts on it.
  sb_ring_save(contact, SB_RING_START);
  fem->axial_rest = 0.0;
  contact->settled = true;
  if (sb_ring_fem_assemble(fem)) {
    sb_ring_contact_apply(contact);
    sb_ring_contact_forces(contact);
  }
  contact->settled = false;
}

// Copies a state into the memory of another.
static void copy_state(SbRingContactState *to, const SbRingContactState *from, int count) {
  SbRingTouch *touch = to->touch;
  memcpy(touch, from->touch, sizeof(SbRingTouch) * SB_RING_SURFACES * (size_t)count);
  *to = *from;
  to->touch = touch;
}

void sb_ring_save(SbRingContact *contact, int place) {
  sb_ring_fem_save(contact->fem, place);
  copy_state(&contact->saved[place], &contact->is, contact->count);
}

void sb_ring_restore(SbRingContact *contact, int place) {
  sb_ring_fem_restore(contact->fem, place);
  copy_state(&contact->is, &contact->saved[place], contact->count);
}
