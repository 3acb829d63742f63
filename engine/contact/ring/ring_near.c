// A ring near another: the same mesh and active set, another body and load.
//
// In the element solver's units (section diameters, initial shear moduli) a body is its centre's
// radius, its bulk modulus and its Mooney share: the mesh is shifted radially, the material
// replaced, and the state is the old one's in those units, from which Newton's method converges
// quadratically.
#include "engine/contact/ring/ring_private.h"

#include <string.h>

// The mesh shifted radially. Owned.
static SbStatus shifted(SbRingMesh **out, const SbRingMesh *mesh, double shift, SbReport *report) {
  SbRingMesh *copy = *out = sb_ring_mesh_allocate(mesh->nodes, mesh->elements, mesh->loop_count);
  if (copy == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's mesh");
  }
  copy->nodes = mesh->nodes;
  copy->elements = mesh->elements;
  copy->loop_count = mesh->loop_count;
  for (int i = 0; i < mesh->nodes; i++) {
    copy->x[2 * i] = mesh->x[2 * i] + shift;
    copy->x[2 * i + 1] = mesh->x[2 * i + 1];
  }
  memcpy(copy->tri, mesh->tri, 6 * (size_t)mesh->elements * sizeof *copy->tri);
  memcpy(copy->loop, mesh->loop, (size_t)mesh->loop_count * sizeof *copy->loop);
  memcpy(copy->angle, mesh->angle, (size_t)mesh->loop_count * sizeof *copy->angle);
  return SB_OK;
}

// Displacements so that every node lies where it did: the groove's radii hardly change, the free
// ring's may. The contact's state with them.
static void take_state(SbRing *out, const SbRing *ring, double shift) {
  const SbRingFem *from = ring->fem;
  SbRingFem *to = out->fem;
  const int nodes = ring->mesh->nodes;
  memcpy(to->u, from->u, 2 * (size_t)nodes * sizeof *to->u);
  memcpy(to->inner, from->inner, SB_RING_INNER * (size_t)ring->mesh->elements * sizeof *to->inner);
  for (int i = 0; i < nodes; i++) {
    to->u[2 * i] -= shift;
  }
  const SbRingContactState *was = &ring->contact->is;
  SbRingContactState *is = &out->contact->is;
  memcpy(is->touch, was->touch,
         sizeof *is->touch * SB_RING_SURFACES * (size_t)ring->contact->count);
  is->turn = was->turn;
  memcpy(is->crest, was->crest, sizeof is->crest);
  sb_ring_save(out->contact, SB_RING_START);
  out->contact->settled = true;
}

SbStatus sb_ring_near(SbRing **out, const SbRing *ring, const SbRingBody *body,
                      const SbRingLoad *load, SbReport *report) {
  *out = NULL;
  if (ring->state == SB_RING_ROLLS || ring->state == SB_RING_JAMS) {
    return sb_fail(report, SB_ERROR_INFEASIBLE,
                   "the ring rolls or jams: its state is that of the greatest drag");
  }
  SbRing *other;
  SbStatus status = sb_ring_beside(&other, ring, report);
  if (status != SB_OK) {
    return status;
  }
  const double d = body->section_diameter;
  other->body = *body;
  other->load = *load;
  other->length = d;
  other->stress = body->modulus / (2.0 * (1.0 + body->poisson_ratio));
  other->force = other->stress * d * (body->plane_strain ? 1.0 : d);
  other->centre =
      body->plane_strain ? load->floor_radius / d + 0.5 : 0.5 * (body->inner_diameter + d) / d;
  other->arc.free = false;
  const double shift = other->centre - ring->centre;
  status = shifted(&other->mesh, ring->mesh, shift, report);
  status = status == SB_OK ? sb_ring_build(other, report) : status;
  if (status == SB_OK) {
    const double share = ring->contact->is.now.friction_bore;
    take_state(other, ring, shift);
    other->contact->is.now = sb_ring_load_in(load, other->length, other->stress);
    other->contact->is.now.friction_bore = share;
    status = sb_ring_newton_held(other, report);
    other->contact->settled = false;
  }
  if (status != SB_OK) {
    sb_ring_destroy(other);
    return status;
  }
  *out = other;
  return sb_succeed(report);
}
