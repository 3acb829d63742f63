// Meshes that follow their contacts.
//
// On a mesh that is fixed to the material, a contact's ends move through its nodes, and results
// oscillate from node to node (discretisation error). The oscillation is small, but its slopes are
// as large as those of the state, and it is larger for films, which depend on the pressure at an
// end. Solved rings have meshes that are fitted to their contacts. A state near one of them has its
// mesh, with the nodes shifted along the section's surface like the contacts. Each contact is that
// of the base, displaced and widened by the mean and the deviation of its pressure. These are sums
// of nodal forces and depend little on the mesh, unlike single ends. Shifts are linear in the angle
// between ends and decrease inwards with the square of the radius. The material does not move:
// deformed positions change with the nodes by the deformation gradient, the mean of the adjacent
// elements.
#include "engine/contact/ring/ring_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// In the order of the angle, and the axis along them.
enum { CONTACTS = SB_RING_SURFACES, LEAST_NODES = 5 };
static const SbRingSurface AROUND[CONTACTS] = {SB_RING_BORE, SB_RING_WALL_RIGHT, SB_RING_FLOOR,
                                               SB_RING_WALL_LEFT};
static const int AXIS[CONTACTS] = {1, 0, 1, 0};

// Mean and deviation of a contact's pressure along its surface.
static void moments(const SbRing *ring, int at, const SbRingPatch *patch, double out[2]) {
  double sum[3] = {0.0}, middle = 0.5 * (patch->place[0] + patch->place[1]);
  for (int i = patch->first; i <= patch->last; i++) {
    const SbRingTouch *touch = sb_ring_touch(ring->contact, i, AROUND[at]);
    double x[2];
    sb_ring_contact_place(ring->contact, i, x);
    const double z = x[AXIS[at]] - middle, force = touch->held ? touch->force : 0.0;
    sum[0] += force;
    sum[1] += force * z;
    sum[2] += force * z * z;
  }
  const double mean = sum[1] / sum[0];
  out[0] = middle + mean;
  out[1] = sqrt(sum[2] / sum[0] - mean * mean);
}

// Places along a surface and material angles of a boundary side's nodes.
static void side_of(const SbRing *ring, int side, int axis, double z[3], double angle[3]) {
  const SbRingContact *contact = ring->contact;
  for (int a = 0; a < 3; a++) {
    const int at = 2 * side + a;
    double x[2];
    sb_ring_contact_place(contact, at, x);
    z[a] = x[axis];
    angle[a] = ring->mesh->angle[sb_ring_wrap(contact, at)] +
               2.0 * M_PI * floor((double)at / contact->count);
  }
}

// Finds the side next to a boundary node that contains a position; false: none.
static bool find_side(int *out, const SbRing *ring, int node, int axis, double place) {
  enum { SIDES = 24 };
  const int middle = (int)floor(0.5 * node);
  for (int k = 0; k <= 2 * SIDES; k++) {
    double z[3], angle[3];
    *out = middle + (k % 2 == 0 ? k / 2 : -(k + 1) / 2);
    side_of(ring, *out, axis, z, angle);
    if ((place - z[0]) * (place - z[2]) <= 0.0 && z[0] != z[2]) {
      return true;
    }
  }
  return false;
}

// Material angle of a place on a side, or up to its half beyond its nodes; farther away, on the
// side there. Not a number: none.
static double angle_on(const SbRing *ring, int side, int axis, double place) {
  double z[3], angle[3], n[3], d[3];
  side_of(ring, side, axis, z, angle);
  const double beyond = fabs(place - 0.5 * (z[0] + z[2])) - fabs(z[2] - z[0]);
  if (beyond > 0.0) {
    if (!find_side(&side, ring, 2 * side + 1, axis, place)) {
      return NAN;
    }
    side_of(ring, side, axis, z, angle);
  }
  sb_ring_side_at(z, place, n, d);
  return sb_ring_side_sum(n, angle);
}

void sb_ring_shift_begin(SbRingShift *shift, const SbRing *ring) {
  shift->count = 0;
  if (ring->body.profile.kind != SB_SEAL_PROFILE_CIRCLE) {
    return; // nodes go round a circle's centre; other meshes stay with the material
  }
  for (int s = 0; s < CONTACTS; s++) {
    SbRingPatch *patch = &shift->patch[s];
    shift->held[s] =
        sb_ring_patch(ring, AROUND[s], patch) && patch->last - patch->first + 1 >= LEAST_NODES;
    if (!shift->held[s]) {
      continue;
    }
    moments(ring, s, patch, shift->moment[s]);
    for (int k = 0; k < 2; k++) {
      const int node = k == 0 ? patch->first : patch->last;
      int *side = &shift->side[shift->count];
      const bool known = find_side(side, ring, node, AXIS[s], patch->place[k]);
      const double angle = known ? angle_on(ring, *side, AXIS[s], patch->place[k]) : NAN;
      const double least = shift->count == 0 ? -INFINITY : shift->end[shift->count - 1];
      if (!(angle > least) || (shift->count > 0 && !(angle < shift->end[0] + 2.0 * M_PI))) {
        shift->count = 0; // the mesh stays
        return;
      }
      shift->end[shift->count] = angle;
      shift->by[shift->count++] = 0.0;
    }
  }
}

bool sb_ring_shift_follow(SbRingShift *shift, const SbRing *other) {
  for (int s = 0, at = 0; s < CONTACTS; s++) {
    if (!shift->held[s]) {
      continue;
    }
    const SbRingPatch *patch = &shift->patch[s];
    const double *was = shift->moment[s];
    // To first order the nodes are those of the base, by which the shift is smooth.
    SbRingPatch own;
    double now[2];
    if (!other->first_order && !sb_ring_patch(other, AROUND[s], &own)) {
      return false;
    }
    moments(other, s, other->first_order ? patch : &own, now);
    for (int k = 0; k < 2; k++, at++) {
      const double place = now[0] + (patch->place[k] - was[0]) * now[1] / was[1];
      const double angle = angle_on(other, shift->side[at], AXIS[s], place);
      shift->by[at] = angle - shift->end[at];
      if (!isfinite(angle)) {
        return false;
      }
    }
  }
  return shift->count > 0;
}

bool sb_ring_shift_like(SbRingShift *shift, const SbRingShift *other) {
  if (shift->count != other->count || memcmp(shift->held, other->held, sizeof shift->held) != 0) {
    return false;
  }
  memcpy(shift->by, other->by, sizeof shift->by);
  return shift->count > 0;
}

// Shift of the surface at an angle for shifts of the ends.
static double shift_at(const SbRingShift *of, double angle) {
  const double *end = of->end, *shift = of->by;
  angle += 2.0 * M_PI * ceil((end[0] - angle) / (2.0 * M_PI));
  for (int i = 0; i < of->count; i++) {
    const int next = (i + 1) % of->count;
    const double to = end[next] + (next == 0 ? 2.0 * M_PI : 0.0);
    if (angle <= to) {
      const double part = (angle - end[i]) / (to - end[i]);
      return shift[i] + part * (shift[next] - shift[i]);
    }
  }
  return shift[0];
}

// The deformation gradient at the nodes, mean of the elements': [nodes](rr, rz, zr, zz).
static void gradients(double *out, const SbRing *ring, int *around) {
  static const double corner[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  const SbRingMesh *mesh = ring->mesh;
  for (int e = 0; e < mesh->elements; e++) {
    const int *node = &mesh->tri[6 * e];
    for (int k = 0; k < 6; k++) {
      double n[6], d[2][6], from[2][2] = {{0}}, to[2][2] = {{0}};
      sb_ring_shape(corner[k][0], corner[k][1], n, d[0], d[1]);
      for (int a = 0; a < 6; a++) {
        double x[2];
        sb_ring_fem_place(ring->fem, node[a], x);
        for (int c = 0; c < 2; c++) {
          for (int l = 0; l < 2; l++) {
            from[c][l] += d[l][a] * mesh->x[2 * node[a] + c];
            to[c][l] += d[l][a] * x[c];
          }
        }
      }
      const double det = from[0][0] * from[1][1] - from[0][1] * from[1][0];
      const double back[2][2] = {{from[1][1] / det, -from[0][1] / det},
                                 {-from[1][0] / det, from[0][0] / det}};
      double *f = &out[4 * node[k]];
      for (int c = 0; c < 2; c++) {
        f[2 * c] += to[c][0] * back[0][0] + to[c][1] * back[1][0];
        f[2 * c + 1] += to[c][0] * back[0][1] + to[c][1] * back[1][1];
      }
      around[node[k]]++;
    }
  }
  for (int n = 0; n < mesh->nodes; n++) {
    for (int k = 0; k < 4; k++) {
      out[4 * n + k] /= around[n];
    }
  }
}

SbRingShift *sb_ring_shift_create(const SbRing *ring) {
  const size_t nodes = (size_t)ring->mesh->nodes;
  SbRingShift *out = calloc(1, sizeof *out);
  int *around = calloc(nodes, sizeof *around);
  if (out != NULL) {
    out->gradient = calloc(4 * nodes, sizeof *out->gradient);
  }
  if (out == NULL || out->gradient == NULL || around == NULL) {
    sb_ring_shift_destroy(out);
    out = NULL;
  } else {
    gradients(out->gradient, ring, around);
  }
  free(around);
  return out;
}

void sb_ring_shift_destroy(SbRingShift *shift) {
  if (shift != NULL) {
    free(shift->gradient);
    free(shift);
  }
}

void sb_ring_shift_node(const SbRingShift *shift, const SbRing *ring, int i, double x[2],
                        double place[2]) {
  const double *at = &ring->mesh->x[2 * i], *f = &shift->gradient[4 * i];
  const double out = at[0] - ring->centre, along = at[1];
  const double angle = atan2(along, out), square = out * out + along * along;
  const double turn = shift_at(shift, angle) * 4.0 * square;
  const double c = cos(turn) - 1.0, s = sin(turn);
  x[0] = c * out - s * along;
  x[1] = s * out + c * along;
  place[0] = f[0] * x[0] + f[1] * x[1];
  place[1] = f[2] * x[0] + f[3] * x[1];
}

double sb_ring_shift_angle(const SbRingShift *shift, double angle) {
  return shift_at(shift, angle);
}
