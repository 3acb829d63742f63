// States near a solved one, to first order: the implicit function theorem at the equilibrium.
//
// With a constant active set (contact, stick and slip, wetted faces, the law's branches) the
// balance R(u, q) = 0 is smooth in the displacements u and in all inputs q of a ring: its body, the
// load, the bore's law. At a solved state u0 of q0 its tangent K = dR/du is factorised once, and
//
//   du = -K^-1 R(u0, q)
//
// is the state's change to first order in q - q0: one assembly and one back-substitution. R(u0, q)
// is that of the moved mesh with every node in its position on the floor, so that sticking nodes do
// not move. Contact forces are those of the linear model, R(u0, q) + K du, as in Newton's method
// (ring_newton.c); all else is computed from the moved state as from a solved one. Errors are of
// second order, plus violations of the active set, which are reported.
#include "engine/contact/ring/ring_private.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

struct SbRingTangent {
  const SbRing *ring;
  const void *law;
  pthread_mutex_t lock; // of the factors with their workspace, which several threads may want
  SbRing *base;         // the ring in its position, with its factors; NULL before the first use
  SbRingShift *shift;   // of its mesh, by nothing yet; as long as `base`
  bool stays;           // the mesh stays with the material
};

void sb_ring_tangent_fix_meshes(SbRingTangent *tangent) {
  tangent->stays = true;
}

SbStatus sb_ring_tangent_create(SbRingTangent **out, const SbRing *ring, const void *law,
                                SbReport *report) {
  *out = calloc(1, sizeof **out);
  if (*out == NULL || pthread_mutex_init(&(*out)->lock, NULL) != 0) {
    free(*out);
    *out = NULL;
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a ring's tangent");
  }
  (*out)->ring = ring;
  (*out)->law = law;
  return sb_succeed(report);
}

void sb_ring_tangent_destroy(SbRingTangent *tangent) {
  if (tangent != NULL) {
    sb_ring_destroy(tangent->base);
    sb_ring_shift_destroy(tangent->shift);
    pthread_mutex_destroy(&tangent->lock);
    free(tangent);
  }
}

// Computes residual and conditions of a ring at its load, in its initial position, with the wetted
// faces and the motion measured from there.
static SbStatus balance(SbRing *ring, double axial_spring, SbReport *report) {
  SbRingFem *fem = ring->fem;
  SbRingContact *contact = ring->contact;
  sb_ring_save(contact, SB_RING_START);
  fem->axial_spring = axial_spring;
  fem->axial_rest = fem->axial_damping = fem->viscosity = 0.0;
  if (!sb_ring_fem_assemble(fem)) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "the ring's mesh turned inside out");
  }
  contact->settled = true;
  sb_ring_contact_apply(contact);
  return SB_OK;
}

// Stores how the pressures of the base's contacts are recovered.
static void hold_recovery(SbRing *base) {
  for (int s = 0; s < SB_RING_SURFACES; s++) {
    SbRingPatch patch;
    SbDryContact pressure;
    SbRingHeld held = {.known = true};
    if (sb_ring_patch(base, (SbRingSurface)s, &patch) &&
        sb_ring_ends(base, (SbRingSurface)s, &patch, &pressure)) {
      held.terms = pressure.count;
      held.end[0] = pressure.left;
      held.end[1] = pressure.right;
    }
    base->held[s] = held;
  }
}

// Creates the ring of the tangent with its factors. The caller has locked the mutex.
static SbStatus factorise(SbRingTangent *tangent, SbReport *report) {
  const SbRing *ring = tangent->ring;
  SbRing *base;
  SbStatus status =
      sb_ring_create_moved(&base, ring, &ring->body, &ring->load, &ring->options, NULL, report);
  if (status != SB_OK) {
    return status;
  }
  // The load as it was solved, with a law that remains valid.
  base->contact->is.now = ring->contact->is.now;
  base->contact->is.now.law = tangent->law;
  memcpy(base->contact->is.crest, ring->contact->is.crest, sizeof ring->contact->is.crest);
  status = balance(base, ring->fem->axial_spring, report);
  status = status == SB_OK ? sb_ring_fem_factor(base->fem, report) : status;
  if (status != SB_OK) {
    sb_ring_destroy(base);
    return status;
  }
  sb_ring_contact_forces(base->contact);
  hold_recovery(base);
  base->fault = sb_ring_contact_fault(base->contact);
  tangent->shift = sb_ring_shift_create(base);
  if (tangent->shift == NULL) {
    sb_ring_destroy(base);
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a ring's tangent");
  }
  sb_ring_shift_begin(tangent->shift, base);
  tangent->base = base;
  return SB_OK;
}

// Right-hand side of the base's equations, whose conditioned rows are replaced (ring_sparse.c), for
// the residual and the conditions of another ring.
static void right_side(SbRingFem *base, const SbRingFem *other) {
  for (int i = 0; i < base->mesh->nodes; i++) {
    const SbRingCondition *held = &base->condition[i], *now = &other->condition[i];
    const double *r = &other->residual[2 * i];
    double *rhs = &base->rhs[2 * i];
    rhs[0] = -r[0];
    rhs[1] = -r[1];
    if (held->count == 0) {
      continue;
    }
    const double *n = held->direction[0];
    const int fixed = fabs(n[0]) >= fabs(n[1]) ? 0 : 1;
    const double *row = &base->value[SB_RING_BLOCK * base->diagonal[i] + 2 * fixed];
    const double scale = hypot(row[0], row[1]);
    rhs[fixed] = scale * now->gap[0];
    if (held->count == 2) {
      rhs[1 - fixed] = scale * now->gap[1];
    } else {
      const double *m = now->direction[0], *t = now->direction[1];
      rhs[1 - fixed] =
          now->drive - (t[0] + now->mix * m[0]) * r[0] - (t[1] + now->mix * m[1]) * r[1];
    }
  }
}

// The bore's law on the other ring's nodes along the branch that it has at the base's pressures: it
// may bend there.
static void hold_law(SbRing *other, const SbRing *base) {
  SbRingContact *contact = other->contact;
  const SbRingLoad *now = &contact->is.now;
  if (now->shear == NULL || now->bore_slides == 0 || now->use_bore_traction) {
    return;
  }
  const double share = now->bore_slides * now->friction_bore;
  for (int i = 0; i < contact->count; i++) {
    const int node = base->mesh->loop[i];
    const SbRingCondition *was = &base->fem->condition[node];
    SbRingCondition *is = &other->fem->condition[node];
    const SbRingTouch *touch = sb_ring_touch(base->contact, i, SB_RING_BORE);
    const double *area[2] = {base->contact->weight, contact->weight};
    if (!touch->held || touch->smooth || was->count != 1 || share == 0.0 || !(area[0][i] > 0.0)) {
      continue;
    }
    const double *n = was->direction[0], *force = &base->fem->residual[2 * node];
    const double normal = (n[0] * force[0] + n[1] * force[1]) * area[1][i] / area[0][i];
    const double fluid = sb_ring_fluid_at(contact, i, n);
    is->mix = was->mix;
    is->drive =
        share * sb_ring_grip(contact, i, SB_RING_BORE, normal, fluid).force + is->mix * normal;
  }
}

// Moves the other ring by the solution and gives its contact the linear model's forces.
static void move(SbRing *other, const SbRingFem *base) {
  SbRingFem *fem = other->fem;
  SbRingContact *contact = other->contact;
  double *reaction = fem->rhs; // of boundary nodes, in their places
  for (int i = 0; i < contact->count; i++) {
    const int node = fem->mesh->loop[i];
    double *sum = &reaction[2 * node];
    sum[0] = sum[1] = 0.0;
    if (base->condition[node].count == 0) {
      continue;
    }
    for (int k = base->row_start[node]; k < base->row_start[node + 1]; k++) {
      const double *a = &base->raw[SB_RING_BLOCK * k], *u = &fem->du[2 * base->column[k]];
      sum[0] += a[0] * u[0] + a[1] * u[1];
      sum[1] += a[2] * u[0] + a[3] * u[1];
    }
    sum[0] += fem->residual[2 * node];
    sum[1] += fem->residual[2 * node + 1];
  }
  sb_ring_fem_advance(fem, 1.0);
  sb_ring_contact_load_fluid(contact);
  for (int i = 0; i < contact->count; i++) {
    const int node = fem->mesh->loop[i];
    memcpy(&fem->residual[2 * node], &reaction[2 * node], sizeof(double[2]));
  }
  sb_ring_contact_forces(contact);
  contact->settled = false;
  contact->is.turn = sb_ring_turn(contact, NULL, NULL, NULL);
}

// The other ring, on the base's mesh or a shifted one.
static SbStatus linear(SbRing **out, SbRingTangent *tangent, const SbRingBody *body,
                       const SbRingLoad *load, const SbRingOptions *options,
                       const SbRingShift *shift, SbReport *report) {
  const SbRing *ring = tangent->ring;
  SbRingFem *base = tangent->base->fem;
  SbRing *other;
  *out = NULL;
  SbStatus status = sb_ring_create_moved(&other, ring, body, load, options, shift, report);
  if (status != SB_OK) {
    return status;
  }
  other->fem->balance_only = true;
  // Its nodes have the base's neighbours; without memory the order is computed again.
  other->fem->factor = sb_ring_factor_like(base->factor);
  memcpy(other->contact->is.crest, ring->contact->is.crest, sizeof ring->contact->is.crest);
  status = balance(other, ring->fem->axial_spring, report);
  if (status == SB_OK) {
    hold_law(other, tangent->base);
    pthread_mutex_lock(&tangent->lock);
    right_side(base, other->fem);
    status = sb_ring_fem_apply_factor(base, report);
    memcpy(other->fem->du, base->du, sizeof(double) * 2 * (size_t)base->mesh->nodes);
    pthread_mutex_unlock(&tangent->lock);
  }
  if (status != SB_OK) {
    sb_ring_destroy(other);
    return status;
  }
  memcpy(other->held, tangent->base->held, sizeof other->held);
  other->first_order = true;
  move(other, base);
  other->fem->balance_only = false;
  const SbRingLoad target = sb_ring_load_in(load, other->length, other->stress);
  other->fault = fmax(0.0, sb_ring_contact_fault(other->contact) - tangent->base->fault) +
                 sb_ring_travel_fault(ring, &target);
  *out = other;
  return SB_OK;
}

// Does the same on the mesh that follows the other ring's contacts.
static SbStatus follow(SbRing **out, SbRingTangent *tangent, const SbRingBody *body,
                       const SbRingLoad *load, const SbRingOptions *options, SbReport *report) {
  SbRing *other;
  SbRingShift shift = *tangent->shift;
  SbStatus status = linear(&other, tangent, body, load, options, NULL, report);
  if (status != SB_OK) {
    return status;
  }
  if (!sb_ring_shift_follow(&shift, other)) {
    *out = other;
    return SB_OK;
  }
  sb_ring_destroy(other);
  return linear(out, tangent, body, load, options, &shift, report);
}

SbStatus sb_ring_tangent_at(SbRing **out, SbRingTangent *tangent, const SbRingBody *body,
                            const SbRingLoad *load, const SbRingOptions *options,
                            SbReport *report) {
  *out = NULL;
  pthread_mutex_lock(&tangent->lock);
  SbStatus status = tangent->base == NULL ? factorise(tangent, report) : SB_OK;
  pthread_mutex_unlock(&tangent->lock);
  if (status == SB_OK) {
    status = tangent->stays ? linear(out, tangent, body, load, options, NULL, report)
                            : follow(out, tangent, body, load, options, report);
  }
  return status == SB_OK ? sb_succeed(report) : status;
}

// Returns whether two rings on meshes of the same nodes have the same nodes in contact and the same
// slip states.
static bool same_set(const SbRing *a, const SbRing *b) {
  bool same = true;
  for (int i = 0; same && i < SB_RING_SURFACES * a->contact->count; i++) {
    const SbRingTouch *p = &a->contact->is.touch[i], *q = &b->contact->is.touch[i];
    same = p->held == q->held && p->slip == q->slip;
  }
  return same;
}

SbStatus sb_ring_tangent_solve(SbRing **out, SbRingTangent *tangent, const SbRingBody *body,
                               const SbRingLoad *load, const SbRingOptions *options,
                               SbReport *report) {
  SbStatus status = sb_ring_tangent_at(out, tangent, body, load, options, report);
  if (status != SB_OK) {
    return status;
  }
  SbRing *ring = *out;
  ring->first_order = false;
  status = sb_ring_newton(ring, SB_RING_DIRECT, report);
  ring->fault = same_set(ring, tangent->ring) ? 0.0 : INFINITY;
  if (status != SB_OK) {
    sb_ring_destroy(ring);
    *out = NULL;
  }
  return status;
}
