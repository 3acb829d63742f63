// The fluid's pressure on the ring's open sides: a follower load with its consistent tangent.
//
// Three-point Gauss rule, exact for quadratic sides: f = -int N p n dA, n and dA of the deformed
// side. The left pressure acts up to the crests of bore and floor contact, the right pressure
// beyond. Under a ring that has left the floor the higher of both acts, up to the crest at the wall
// of the lower one, if that wall supports the ring. Behind a ring that seals inwards the lower of
// both acts, from the crest at the wall of the higher one. A side is closed if all three of its
// nodes are in contact with a surface; the pressure that the fluid would exert there is stored as
// the part that the contact must exceed. Not modelled: flow and pressure drop.
#include "engine/contact/ring/ring_contact.h"

#include <math.h>
#include <string.h>

// Returns the vertex with the largest contact pressure on a surface; without contact the one
// nearest to an angle. It is a vertex because each side has one fluid: with a division at the
// middle node of a side that is partly in contact, its open part would have the fluid of the other
// flank. A contact of a middle node only is divided after that node.
static int crest(const SbRingContact *contact, SbRingSurface surface, double angle) {
  const double *angles = contact->fem->mesh->angle;
  int best = -1, nearest = 0;
  double most = -1.0;
  for (int i = 0; i < contact->count; i += 2) {
    const SbRingTouch *touch = sb_ring_touch(contact, i, surface);
    double pressure = touch->held ? touch->force / fmax(contact->weight[i], 1e-30) : -1.0;
    if (pressure > most) {
      most = pressure;
      best = i;
    }
    best = best < 0 && sb_ring_touch(contact, i - 1, surface)->held ? i : best;
    nearest = fabs(angles[i] - angle) < fabs(angles[nearest] - angle) ? i : nearest;
  }
  return best >= 0 ? best : nearest;
}

// Does the same for a sliding bore: the division is not at the crest, which moves along a long flat
// contact and changes friction, but at the end of the first part that seals the higher pressure. -1
// if there is none.
static int first_part(const SbRingContact *contact, int start, int way, double high) {
  enum { INTO = 1 }; // vertices of the part before
  int inside = 0, at = -1;
  double most = 0.0;
  for (int k = 0; k < contact->count; k += 2) {
    const int i = sb_ring_wrap(contact, start + way * k);
    const SbRingTouch *touch = sb_ring_touch(contact, i, SB_RING_BORE);
    if (touch->held) {
      at = inside++ <= INTO ? i : at;
      most = fmax(most, touch->force / fmax(contact->weight[i], 1e-30));
    } else if (most > high) {
      break;
    } else {
      inside = 0;
      most = 0.0;
    }
  }
  return most > high ? at : -1;
}

// Does the same if a contact may have several crests, with hollows that only the other fluid fills
// as long as one crest seals the higher pressure: the first crest above that pressure, from the
// bore (to the bore: from the floor) over the flank of the higher pressure.
static int first_crest(const SbRingContact *contact, SbRingSurface surface, double angle) {
  static const double FALLS = 0.8; // to this share of a crest, or to the fluid's, it is passed
  const SbRingLoad *now = &contact->is.now;
  const double high = fmax(now->pressure_left, now->pressure_right);
  if (!contact->lobes || now->pressure_left == now->pressure_right) {
    return crest(contact, surface, angle);
  }
  const bool left = now->pressure_left > now->pressure_right;
  const int way = (surface == SB_RING_BORE) == left ? 1 : -1;
  const int start = surface == SB_RING_BORE ? 0 : crest(contact, SB_RING_BORE, 0.0);
  const bool slides = surface == SB_RING_BORE && now->bore_slides != 0;
  int best = slides && contact->fem->around >= 0.0 ? first_part(contact, start, way, high) : -1;
  double most = high;
  if (best >= 0) {
    return best;
  }
  for (int k = 0; k < contact->count; k += 2) {
    const int i = sb_ring_wrap(contact, start + way * k);
    const SbRingTouch *touch = sb_ring_touch(contact, i, surface);
    const double pressure = touch->held ? touch->force / fmax(contact->weight[i], 1e-30) : 0.0;
    if (pressure > most) {
      most = pressure;
      best = i;
    } else if (best >= 0 && pressure < fmax(high, FALLS * most)) {
      break;
    }
  }
  return best >= 0 ? best : crest(contact, surface, angle);
}

// Adds the fluid's force on one node of an open side to the balance. The part that presses a node
// in contact onto its surface is stored separately: it changes no motion, but without it the node's
// contact force, and with it friction, would jump whenever the neighbour enters or leaves the
// contact.
static void load_node(SbRingContact *contact, int i, const int nodes[3], const double force[2],
                      double k[2][3][2]) {
  SbRingFem *fem = contact->fem;
  int node = fem->mesh->loop[i], held = 0;
  SbRingFrame frame = {.curvature = 0.0};
  for (int s = 0; s < SB_RING_SURFACES; s++) {
    if (sb_ring_touch(contact, i, s)->held) {
      frame = sb_ring_frame_at(contact, i, (SbRingSurface)s);
      held++;
    }
  }
  const double *n = frame.n, *t = frame.t;
  // Part of a force vector v that remains in the balance: P v, all of it, its tangential part, or
  // nothing.
  for (int r = 0; r < 2; r++) {
    double p[2] = {0.0, 0.0};
    for (int c = 0; c < 2 && held < 2; c++) {
      p[c] = (r == c ? 1.0 : 0.0) - (held == 1 ? n[r] * n[c] : 0.0);
    }
    double acting = p[0] * force[0] + p[1] * force[1];
    contact->fluid[2 * i + r] += acting;
    contact->pressed[2 * i + r] += force[r] - acting;
    contact->share[2 * i + r] += force[r] - acting;
    fem->residual[2 * node + r] -= acting;
    if (held == 1 && frame.curvature != 0.0) {
      double along = t[0] * force[0] + t[1] * force[1], across = n[0] * force[0] + n[1] * force[1];
      sb_ring_fem_add(fem, node, r, node, frame.axis,
                      frame.curvature * (t[r] * across + n[r] * along));
    }
    for (int b = 0; b < 3; b++) {
      for (int c = 0; c < 2; c++) {
        double value = p[0] * k[0][b][c] + p[1] * k[1][b][c];
        if (value != 0.0) {
          sb_ring_fem_add(fem, node, r, nodes[b], c, value);
        }
      }
    }
  }
}

void sb_ring_side_load(const SbRingContact *contact, int side, SbRingSidePressure pressure,
                       double force[3][2], double tangent[3][2][3][2], double area[3]) {
  const SbRingFem *fem = contact->fem;
  double r[3], z[3], turn = fem->around != 0.0 ? fem->around : 1.0;
  for (int a = 0; a < 3; a++) {
    double x[2];
    sb_ring_contact_place(contact, 2 * side + a, x);
    r[a] = x[0];
    z[a] = x[1];
    area[a] = 0.0;
  }
  memset(force, 0, sizeof(double[3][2]));
  memset(tangent, 0, sizeof(double[3][2][3][2]));
  for (int q = 0; q < 3; q++) {
    double n[3], d[3];
    sb_ring_side_shape(SB_RING_X3[q], n, d);
    double dr = sb_ring_side_sum(d, r), dz = sb_ring_side_sum(d, z);
    double radius = fem->around != 0.0 ? sb_ring_side_sum(n, r) : 1.0;
    double p = pressure.value + pressure.slope * (sb_ring_side_sum(n, z) - z[0]);
    for (int a = 0; a < 3; a++) {
      // Outward normal times length is (dz, -dr): the ring is pushed by -p (dz, -dr) radius turn.
      double c = SB_RING_W3[q] * turn * n[a];
      area[a] += c * radius * sqrt(dr * dr + dz * dz);
      force[a][0] -= c * p * radius * dz;
      force[a][1] += c * p * radius * dr;
      for (int b = 0; b < 3; b++) {
        double hoop = fem->around != 0.0 && !pressure.fixed ? n[b] : 0.0;
        double rise = pressure.slope * n[b];
        tangent[a][0][b][0] += c * p * hoop * dz;
        tangent[a][0][b][1] += c * radius * (p * d[b] + rise * dz);
        tangent[a][1][b][0] -= c * p * (hoop * dr + radius * d[b]);
        tangent[a][1][b][1] -= c * radius * rise * dr;
      }
    }
  }
}

void sb_ring_side_area_slope(const SbRingContact *contact, int side, int a, double slope[3][2]) {
  const double around = contact->fem->around;
  double r[3], z[3];
  for (int k = 0; k < 3; k++) {
    double x[2];
    sb_ring_contact_place(contact, 2 * side + k, x);
    r[k] = x[0];
    z[k] = x[1];
    slope[k][0] = slope[k][1] = 0.0;
  }
  for (int q = 0; q < 3; q++) {
    double n[3], d[3];
    sb_ring_side_shape(SB_RING_X3[q], n, d);
    double dr = sb_ring_side_sum(d, r), dz = sb_ring_side_sum(d, z), length = hypot(dr, dz);
    double radius = around != 0.0 ? sb_ring_side_sum(n, r) : 1.0;
    double c = SB_RING_W3[q] * (around != 0.0 ? around : 1.0) * n[a];
    for (int b = 0; b < 3; b++) {
      slope[b][0] += c * ((around != 0.0 ? n[b] * length : 0.0) + radius * d[b] * dr / length);
      slope[b][1] += c * radius * d[b] * dz / length;
    }
  }
}

// Returns whether all three nodes of a side are in contact with a surface.
static bool closes(const SbRingContact *contact, int side) {
  for (int s = 0; s < SB_RING_SURFACES; s++) {
    if (sb_ring_touch(contact, 2 * side, s)->held &&
        sb_ring_touch(contact, 2 * side + 1, s)->held &&
        sb_ring_touch(contact, 2 * side + 2, s)->held) {
      return true;
    }
  }
  return false;
}

bool sb_ring_contact_on_right(const SbRingContact *contact, int side) {
  // The right pressure acts between the crests over the right flank.
  const int count = contact->count, middle = 2 * side + 1;
  const int bore = contact->is.crest[0], floor_at = contact->is.crest[1];
  const int past = floor_at > bore ? floor_at : floor_at + count;
  return (middle > bore && middle < past) || (middle + count > bore && middle + count < past);
}

static bool touches(const SbRingContact *contact, SbRingSurface surface) {
  for (int i = 0; i < contact->count; i++) {
    if (sb_ring_touch(contact, i, surface)->held) {
      return true;
    }
  }
  return false;
}

// Returns the vertex that separates the fluids on the other side than the bore: at the floor, or at
// the wall of the lower pressure if a ring has left the floor and is supported there. A ring that
// seals inwards has no floor: at the wall of the higher pressure.
static int inner_crest(const SbRingContact *contact) {
  const SbRingLoad *now = &contact->is.now;
  const bool left = now->pressure_left > now->pressure_right;
  const bool inward = contact->fem->around < 0.0;
  const SbRingSurface wall = inward == left ? SB_RING_WALL_LEFT : SB_RING_WALL_RIGHT;
  const bool lifted = now->pressure_left != now->pressure_right &&
                      !touches(contact, SB_RING_FLOOR) && touches(contact, wall);
  return inward || lifted
             ? first_crest(contact, wall, wall == SB_RING_WALL_LEFT ? -0.5 * M_PI : 0.5 * M_PI)
             : first_crest(contact, SB_RING_FLOOR, -M_PI);
}

void sb_ring_contact_load_fluid(SbRingContact *contact) {
  if (!contact->settled) {
    contact->is.crest[0] = first_crest(contact, SB_RING_BORE, 0.0);
    contact->is.crest[1] = inner_crest(contact);
  }
  const int count = contact->count;
  memset(contact->share, 0, 8 * sizeof(double) * (size_t)count); // and what follows it
  for (int side = 0; side < count / 2; side++) {
    contact->closed[side] = closes(contact, side);
    SbRingSidePressure pressure = {.value = sb_ring_contact_on_right(contact, side)
                                                ? contact->is.now.pressure_right
                                                : contact->is.now.pressure_left};
    contact->wet[side] = pressure.value;
    double force[3][2], k[3][2][3][2], area[3];
    int nodes[3];
    sb_ring_side_load(contact, side, pressure, force, k, area);
    for (int a = 0; a < 3; a++) {
      nodes[a] = contact->fem->mesh->loop[sb_ring_wrap(contact, 2 * side + a)];
    }
    for (int a = 0; a < 3; a++) {
      int i = sb_ring_wrap(contact, 2 * side + a);
      contact->weight[i] += area[a];
      if (contact->closed[side]) {
        contact->share[2 * i] += force[a][0];
        contact->share[2 * i + 1] += force[a][1];
      } else if (pressure.value != 0.0) {
        load_node(contact, i, nodes, force[a], k[a]);
      }
    }
  }
}
