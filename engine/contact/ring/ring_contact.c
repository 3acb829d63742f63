// Unilateral contact of the ring with smooth rigid surfaces: the active set and its forces.
//
// Contact is a primal-dual active set (Hintermueller, Ito and Kunisch 2002) on boundary nodes: held
// nodes satisfy gap = 0 as an equation of their own, the normal force is the residual of the
// balance they replace, so neither penetration nor tension is left at the end. Friction enters the
// same nodes' tangential rows (ring_friction.c), the fluid every side that is not closed
// (ring_fluid.c); the surfaces are those of ring_groove.c. Leaves out adhesion and a finite
// friction elasticity.
#include "engine/contact/ring/ring_contact.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Share of the edge's rounding that a held node may move along it in one iteration.
static const double EDGE_SHARE = 0.5;

SbStatus sb_ring_contact_create(SbRingContact **out, SbRingFem *fem, SbReport *report) {
  *out = NULL;
  SbRingContact *contact = calloc(1, sizeof *contact);
  if (contact == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's contact");
  }
  size_t n = (size_t)fem->mesh->loop_count;
  contact->fem = fem;
  contact->count = (int)n;
  contact->force_scale = 1.0;
  contact->touch = calloc(n * SB_RING_SURFACES, sizeof(SbRingTouch));
  contact->closed = calloc(n, sizeof(bool));
  contact->share = calloc(9 * n, sizeof(double)); // and what follows it
  contact->saved[0] = calloc(2 * n * SB_RING_SURFACES, sizeof(SbRingTouch));
  if (contact->touch == NULL || contact->closed == NULL || contact->share == NULL ||
      contact->saved[0] == NULL) {
    sb_ring_contact_destroy(contact);
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's contact");
  }
  contact->pressed = contact->share + 2 * n;
  contact->fluid = contact->share + 4 * n;
  contact->anchor = contact->share + 6 * n;
  contact->weight = contact->share + 8 * n;
  contact->saved[1] = contact->saved[0] + n * SB_RING_SURFACES;
  *out = contact;
  return SB_OK;
}

void sb_ring_contact_destroy(SbRingContact *contact) {
  if (contact != NULL) {
    free(contact->touch);
    free(contact->closed);
    free(contact->share);
    free(contact->saved[0]);
    free(contact);
  }
}

void sb_ring_contact_place(const SbRingContact *contact, int i, double x[2]) {
  sb_ring_fem_place(contact->fem, contact->fem->mesh->loop[i], x);
}

void sb_ring_contact_detect(SbRingContact *contact) {
  for (int i = 0; i < contact->count; i++) {
    double x[2], g[2], curvature;
    sb_ring_contact_place(contact, i, x);
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      SbRingTouch *touch = &contact->touch[SB_RING_SURFACES * i + s];
      touch->held = sb_ring_gap(&contact->now, (SbRingSurface)s, x, g, &curvature) <= 1e-12;
      touch->slip = 0;
    }
  }
}

double sb_ring_contact_apply(SbRingContact *contact) {
  SbRingFem *fem = contact->fem;
  sb_ring_contact_load_fluid(contact);
  double worst = 0.0;
  for (int i = 0; i < contact->count; i++) {
    SbRingCondition *condition = &fem->condition[fem->mesh->loop[i]];
    memset(condition, 0, sizeof *condition);
    double x[2];
    sb_ring_contact_place(contact, i, x);
    for (int s = 0; s < SB_RING_SURFACES && condition->count < 2; s++) {
      const SbRingTouch *touch = &contact->touch[SB_RING_SURFACES * i + s];
      if (!touch->held) {
        continue;
      }
      double n[2], t[2], gap, curvature;
      sb_ring_frame(&contact->now, (SbRingSurface)s, x, n, t, &gap, &curvature);
      worst = fmax(worst, fabs(gap));
      double *row = condition->direction[condition->count];
      row[0] = n[0];
      row[1] = n[1];
      condition->gap[condition->count] = -gap;
      if (condition->count == 1) {
        condition->count = 2; // held in a corner
        break;
      }
      condition->count = 1;
      condition->direction[1][0] = t[0];
      condition->direction[1][1] = t[1];
      condition->curve = curvature;
      double friction = contact->now.friction[s];
      if (s == SB_RING_BORE && contact->now.use_traction) {
        condition->drive = contact->now.traction * contact->weight[i];
      } else if (friction > 0.0 && !touch->smooth && touch->slip == 0) {
        condition->gap[1] = -sb_ring_contact_slipped(contact, (SbRingSurface)s, i, x, t);
        bool corner = false;
        for (int other = s + 1; other < SB_RING_SURFACES; other++) {
          corner = corner || contact->touch[SB_RING_SURFACES * i + other].held;
        }
        if (!corner) {
          condition->count = 2;
          break;
        }
      } else {
        condition->mix = touch->smooth ? 0.0 : -touch->slip * friction;
      }
    }
  }
  return worst;
}

// Splits a nodal force into the touches' normal and tangential parts.
static void split_force(SbRingContact *contact, int i, const double x[2], const double force[2]) {
  int held[SB_RING_SURFACES], count = 0;
  double n[2][2], t[2][2], gap, curvature;
  for (int s = 0; s < SB_RING_SURFACES; s++) {
    SbRingTouch *touch = &contact->touch[SB_RING_SURFACES * i + s];
    if (touch->held && count < 2) {
      sb_ring_frame(&contact->now, (SbRingSurface)s, x, n[count], t[count], &gap, &curvature);
      held[count++] = s;
    } else {
      touch->force = touch->tangent = 0.0;
    }
  }
  if (count == 1) {
    SbRingTouch *touch = &contact->touch[SB_RING_SURFACES * i + held[0]];
    touch->force = n[0][0] * force[0] + n[0][1] * force[1];
    touch->tangent = t[0][0] * force[0] + t[0][1] * force[1];
  } else if (count == 2) {
    // Two surfaces: normal forces only.
    double det = n[0][0] * n[1][1] - n[0][1] * n[1][0];
    SbRingTouch *a = &contact->touch[SB_RING_SURFACES * i + held[0]];
    SbRingTouch *b = &contact->touch[SB_RING_SURFACES * i + held[1]];
    a->force = (force[0] * n[1][1] - force[1] * n[1][0]) / det;
    b->force = (n[0][0] * force[1] - n[0][1] * force[0]) / det;
    a->tangent = b->tangent = 0.0;
  }
}

// Holds a node or lets it go.
static void toggle(SbRingContact *contact, int at) {
  SbRingTouch *touch = &contact->touch[at];
  contact->unsteady = at;
  touch->held = !touch->held;
  touch->slip = 0;
  if (touch->held) {
    sb_ring_contact_begin_friction(contact, at / SB_RING_SURFACES,
                                   (SbRingSurface)(at % SB_RING_SURFACES));
  }
}

int sb_ring_contact_update(SbRingContact *contact, bool single) {
  SbRingFem *fem = contact->fem;
  int changes = 0;
  double tiny = 1e-11 * contact->force_scale;
  int worst_release = -1, worst_catch = -1;
  double least = -tiny, deepest = -1e-11;
  for (int i = 0; i < contact->count; i++) {
    int node = fem->mesh->loop[i];
    double x[2], force[2];
    sb_ring_contact_place(contact, i, x);
    if (fem->condition[node].count > 0) {
      sb_ring_fem_reaction(fem, node, force);
      split_force(contact, i, x, force);
    }
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      int at = SB_RING_SURFACES * i + s;
      const SbRingTouch *touch = &contact->touch[at];
      double n[2], t[2], gap, curvature;
      sb_ring_frame(&contact->now, (SbRingSurface)s, x, n, t, &gap, &curvature);
      // The fluid would push this node off the surface, along n, by its share.
      double excess =
          touch->force - n[0] * contact->share[2 * i] - n[1] * contact->share[2 * i + 1];
      if (!touch->held && gap < deepest) {
        worst_catch = at;
        deepest = single ? gap : deepest;
      } else if (touch->held && excess < least) {
        worst_release = at;
        least = single ? excess : least;
      } else {
        continue;
      }
      if (!single) {
        toggle(contact, at);
        changes++;
      }
    }
  }
  if (single && worst_release >= 0) {
    toggle(contact, worst_release);
    changes++;
  }
  if (single && worst_catch >= 0) {
    toggle(contact, worst_catch);
    changes++;
  }
  // Friction follows once the contact is steady: changing both at once does not converge.
  return changes > 0 ? changes : sb_ring_contact_update_slip(contact, single);
}

double sb_ring_contact_limit(const SbRingContact *contact) {
  const SbRingFem *fem = contact->fem;
  double step = 1.0;
  for (int i = 0; i < contact->count; i++) {
    if (contact->touch[SB_RING_SURFACES * i + SB_RING_BORE].held) {
      double x[2], g[2], before, after;
      sb_ring_contact_place(contact, i, x);
      sb_ring_gap(&contact->now, SB_RING_BORE, x, g, &before);
      double move = fem->du[2 * fem->mesh->loop[i] + 1];
      x[1] += move;
      sb_ring_gap(&contact->now, SB_RING_BORE, x, g, &after);
      if (before != 0.0 || after != 0.0) {
        step = fmin(step, EDGE_SHARE * contact->now.edge_length / fmax(fabs(move), 1e-30));
      }
    }
  }
  return step;
}

void sb_ring_contact_begin(SbRingContact *contact) {
  contact->unsteady = -1;
  for (int i = 0; i < SB_RING_SURFACES * contact->count; i++) {
    contact->touch[i].flips = contact->touch[i].catches = 0;
    contact->touch[i].smooth = false;
  }
}

void sb_ring_contact_forces(SbRingContact *contact) {
  const SbRingFem *fem = contact->fem;
  for (int i = 0; i < contact->count; i++) {
    double x[2];
    sb_ring_contact_place(contact, i, x);
    split_force(contact, i, x, &fem->residual[2 * fem->mesh->loop[i]]);
  }
  contact->slip_excess = sb_ring_contact_slip_excess(contact);
  // For the record, the fluid on open sides is the fluid's again, not the contact's.
  for (int i = 0; i < contact->count; i++) {
    double x[2], force[2];
    sb_ring_contact_place(contact, i, x);
    for (int k = 0; k < 2; k++) {
      force[k] = fem->residual[2 * fem->mesh->loop[i] + k] - contact->pressed[2 * i + k];
      contact->fluid[2 * i + k] += contact->pressed[2 * i + k];
      contact->share[2 * i + k] -= contact->pressed[2 * i + k];
    }
    split_force(contact, i, x, force);
  }
}

void sb_ring_contact_settle(SbRingContact *contact) {
  SbRingFem *fem = contact->fem;
  // Neither the spring nor the damper of the attempts acts on it.
  sb_ring_fem_save(fem, 1);
  fem->axial_rest = 0.0;
  contact->settled = true;
  if (sb_ring_fem_assemble(fem)) {
    sb_ring_contact_apply(contact);
    sb_ring_contact_forces(contact);
  }
  contact->settled = false;
}

void sb_ring_contact_total(const SbRingContact *contact, SbRingSurface surface, double force[2]) {
  force[0] = force[1] = 0.0;
  for (int i = 0; i < contact->count; i++) {
    const SbRingTouch *touch = &contact->touch[SB_RING_SURFACES * i + surface];
    if (touch->held) {
      double x[2], n[2], t[2], gap, curvature;
      sb_ring_contact_place(contact, i, x);
      sb_ring_frame(&contact->now, surface, x, n, t, &gap, &curvature);
      for (int k = 0; k < 2; k++) {
        force[k] += touch->force * n[k] + touch->tangent * t[k];
      }
    }
  }
}

void sb_ring_contact_save(SbRingContact *contact, int place) {
  memcpy(contact->saved[place], contact->touch,
         sizeof(SbRingTouch) * SB_RING_SURFACES * (size_t)contact->count);
  memcpy(contact->saved_crest[place], contact->crest, sizeof contact->crest);
}

void sb_ring_contact_restore(SbRingContact *contact, int place) {
  memcpy(contact->touch, contact->saved[place],
         sizeof(SbRingTouch) * SB_RING_SURFACES * (size_t)contact->count);
  memcpy(contact->crest, contact->saved_crest[place], sizeof contact->crest);
}
