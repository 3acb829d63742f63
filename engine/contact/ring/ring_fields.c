// The deformed ring for drawing, and its section for others: nodes, triangles, outline and nodal
// stresses, computed on request.
//
// Stresses are Cauchy stresses of the elements at their nodes, averaged over the elements that
// share a node. Each six-node triangle is divided into four three-node ones. Triangles and outline
// are counter-clockwise with the axial coordinate to the right and the radius upwards.
#include "engine/contact/ring/ring_private.h"

#include <math.h>
#include <string.h>

static void swap(int *a, int *b) {
  const int kept = *a;
  *a = *b;
  *b = kept;
}

void sb_ring_sizes(const SbRing *ring, int *nodes, int *triangles, int *outline) {
  *nodes = ring->mesh->nodes;
  *triangles = 4 * ring->mesh->elements;
  *outline = ring->mesh->loop_count;
}

static void stresses(const SbRing *ring, const SbRingFields *out) {
  static const double L1[6] = {0.0, 1.0, 0.0, 0.5, 0.5, 0.0};
  static const double L2[6] = {0.0, 0.0, 1.0, 0.0, 0.5, 0.5};
  const SbRingMesh *mesh = ring->mesh;
  double *field[3] = {out->mises, out->hydrostatic, out->shear};
  int *visits = ring->fem->work_int; // elements at each node
  memset(visits, 0, sizeof(int) * (size_t)mesh->nodes);
  for (int i = 0; i < 6 * mesh->elements; i++) {
    visits[mesh->tri[i]]++;
  }
  for (int k = 0; k < 3; k++) {
    memset(field[k], 0, sizeof(double) * (size_t)mesh->nodes);
  }
  for (int i = 0; i < 6 * mesh->elements; i++) {
    double s[4], jacobian;
    sb_ring_fem_stress(ring->fem, i / 6, L1[i % 6], L2[i % 6], s, &jacobian);
    double mean = (s[0] + s[1] + s[3]) / 3.0;
    double d0 = s[0] - mean, d1 = s[1] - mean, d3 = s[3] - mean;
    double mises = sqrt(1.5 * (d0 * d0 + d1 * d1 + d3 * d3 + 2.0 * s[2] * s[2]));
    double value[3] = {mises, mean, s[2]};
    int node = mesh->tri[i];
    for (int k = 0; k < 3; k++) {
      field[k][node] += value[k] * ring->stress / visits[node];
    }
  }
}

// Contact pressure at nodes in contact, else the fluid's.
static void boundary_pressure(const SbRing *ring, double *contact) {
  const SbRingContact *c = ring->contact;
  memset(contact, 0, sizeof(double) * (size_t)ring->mesh->nodes);
  for (int i = 0; i < c->count; i++) {
    double p = 0.0;
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      p = fmax(p, sb_ring_node_pressure(ring, i, (SbRingSurface)s));
    }
    if (p == 0.0) {
      p = hypot(c->fluid[2 * i], c->fluid[2 * i + 1]) / c->weight[i];
    }
    contact[ring->mesh->loop[i]] = p * ring->stress;
  }
}

void sb_ring_fields(const SbRing *ring, const SbRingFields *out) {
  static const int PART[12] = {0, 5, 3, 3, 4, 1, 5, 2, 4, 3, 5, 4};
  const SbRingMesh *mesh = ring->mesh;
  const double *u = ring->fem->u;
  for (int i = 0; i < mesh->nodes; i++) {
    for (int k = 0; k < 2; k++) {
      out->place[2 * i + k] = (mesh->x[2 * i + 1 - k] + u[2 * i + 1 - k]) * ring->length;
      out->displacement[2 * i + k] = u[2 * i + 1 - k] * ring->length;
    }
  }
  stresses(ring, out);
  boundary_pressure(ring, out->contact);
  for (int i = 0; i < 12 * mesh->elements; i++) {
    out->triangle[i] = mesh->tri[i / 12 * 6 + PART[i % 12]];
  }
  for (int i = 0; i < mesh->loop_count; i++) {
    out->outline[i] = mesh->loop[mesh->loop_count - 1 - i];
  }
  if (!ring->body.inward) {
    return;
  }
  for (int i = 0; i < mesh->nodes; i++) {
    out->place[2 * i + 1] = -out->place[2 * i + 1];
    out->displacement[2 * i + 1] = -out->displacement[2 * i + 1];
    out->shear[i] = -out->shear[i];
  }
  for (int i = 0; i < 4 * mesh->elements; i++) {
    swap(&out->triangle[3 * i + 1], &out->triangle[3 * i + 2]);
  }
  for (int i = 0; i < mesh->loop_count / 2; i++) {
    swap(&out->outline[i], &out->outline[mesh->loop_count - 1 - i]);
  }
}

void sb_ring_section_sizes(const SbRing *ring, int *nodes, int *elements, int *sides) {
  *nodes = ring->mesh->nodes;
  *elements = ring->mesh->elements;
  *sides = ring->mesh->loop_count / 2;
}

// Returns the vertex of the loop that is nearest to an end of a contact, among those near its last
// node in contact, `at`.
static int vertex_at_end(const SbRing *ring, int at, int axis, double place) {
  enum { AROUND = 4 };
  int best = at;
  double least = HUGE_VAL;
  for (int i = at - AROUND; i <= at + AROUND; i++) {
    double x[2];
    sb_ring_contact_place(ring->contact, i, x);
    if (sb_ring_wrap(ring->contact, i) % 2 == 0 && fabs(x[axis] - place) < least) {
      least = fabs(x[axis] - place);
      best = i;
    }
  }
  return best;
}

// Moves a vertex by a part of a side along an axis, and the mid-side nodes of its sides with it.
static void move_vertex(const SbRing *ring, const SbRingSection *out, int vertex, int axis,
                        double by) {
  const SbRingMesh *mesh = ring->mesh;
  int *moved = ring->fem->work_int; // mid-side nodes that have followed
  memset(moved, 0, sizeof *moved * (size_t)mesh->nodes);
  out->place[2 * vertex + axis] += by;
  for (int i = 0; i < 6 * mesh->elements; i++) {
    const int *tri = &mesh->tri[i / 6 * 6], k = i % 6;
    if (k < 3 && tri[k] == vertex) {
      const int beside[2] = {tri[3 + k], tri[3 + (k + 2) % 3]};
      for (int j = 0; j < 2; j++) {
        out->place[2 * beside[j] + axis] += moved[beside[j]] ? 0.0 : 0.5 * by;
        moved[beside[j]] = 1;
      }
    }
  }
}

// A hollow between lobes that the fluid of the higher pressure has reached.
static bool is_wetted_hollow(const SbRing *ring, SbRingSurface surface, int side) {
  const SbRingLoad *now = &ring->contact->is.now;
  return !sb_ring_side_touches(ring, surface, side) && now->pressure_left != now->pressure_right &&
         sb_ring_contact_on_right(ring->contact, side) ==
             (now->pressure_right > now->pressure_left);
}

// Closes the sides of a surface's contact. Its ends are those of its recovered pressure, not its
// last nodes in contact; vertices are moved to them.
static void close_contact(const SbRing *ring, const SbRingSection *out, SbRingSurface surface) {
  const SbRingContact *contact = ring->contact;
  const int axis = surface == SB_RING_BORE || surface == SB_RING_FLOOR ? 1 : 0;
  SbRingPatch patch;
  SbDryContact smooth;
  int vertex[2];
  if (!sb_ring_patch(ring, surface, &patch)) {
    return;
  }
  (void)sb_ring_ends(ring, surface, &patch, &smooth);
  for (int e = 0; e < 2; e++) {
    vertex[e] = vertex_at_end(ring, e == 0 ? patch.first : patch.last, axis, patch.place[e]);
  }
  vertex[1] = vertex[1] > vertex[0] ? vertex[1] : vertex[0] + 2;
  for (int i = vertex[0]; i < vertex[1]; i += 2) {
    const int side = sb_ring_wrap(contact, i) / 2;
    if (!is_wetted_hollow(ring, surface, side)) {
      out->side[side] = SB_RING_SIDE_CLOSED;
    }
  }
  for (int e = 0; e < 2; e++) {
    const int node = ring->mesh->loop[sb_ring_wrap(contact, vertex[e])];
    double x[2], before[2], after[2];
    sb_ring_contact_place(contact, vertex[e], x);
    sb_ring_contact_place(contact, vertex[e] - 2, before);
    sb_ring_contact_place(contact, vertex[e] + 2, after);
    const double by = patch.place[e] - x[axis];
    if (fabs(by) < 0.6 * fmin(hypot(x[0] - before[0], x[1] - before[1]),
                              hypot(x[0] - after[0], x[1] - after[1]))) {
      move_vertex(ring, out, node, axis, by * ring->length);
    }
  }
}

// Gives a ring that seals inwards its radii; the orientation of elements and boundary is then
// reversed.
static void turn_outwards(const SbRing *ring, const SbRingSection *out) {
  const int sides = ring->mesh->loop_count / 2;
  for (int i = 0; i < ring->mesh->nodes; i++) {
    out->place[2 * i] = -out->place[2 * i];
  }
  for (int i = 0; i < ring->mesh->elements; i++) {
    swap(&out->triangle[6 * i + 1], &out->triangle[6 * i + 2]);
    swap(&out->triangle[6 * i + 3], &out->triangle[6 * i + 5]);
  }
  for (int i = 1; i < sides; i++) { // the first node stays
    swap(&out->loop[i], &out->loop[2 * sides - i]);
  }
  for (int i = 0; i < sides / 2; i++) {
    const unsigned char side = out->side[i];
    out->side[i] = out->side[sides - 1 - i];
    out->side[sides - 1 - i] = side;
  }
}

void sb_ring_section(const SbRing *ring, const SbRingSection *out) {
  const SbRingMesh *mesh = ring->mesh;
  for (int i = 0; i < 2 * mesh->nodes; i++) {
    out->place[i] = (mesh->x[i] + ring->fem->u[i]) * ring->length;
  }
  memcpy(out->triangle, mesh->tri, 6 * sizeof *mesh->tri * (size_t)mesh->elements);
  memcpy(out->loop, mesh->loop, sizeof *mesh->loop * (size_t)mesh->loop_count);
  for (int side = 0; side < mesh->loop_count / 2; side++) {
    out->side[side] =
        sb_ring_contact_on_right(ring->contact, side) ? SB_RING_SIDE_RIGHT : SB_RING_SIDE_LEFT;
  }
  for (int surface = 0; surface < SB_RING_SURFACES; surface++) {
    close_contact(ring, out, (SbRingSurface)surface);
  }
  if (ring->body.inward) {
    turn_outwards(ring, out);
  }
}
