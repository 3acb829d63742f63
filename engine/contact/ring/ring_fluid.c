// The fluid's pressure on the ring's open sides: a follower load with its consistent tangent.
//
// Three-point Gauss, exact for quadratic sides: f = -int N p n dA, n and dA of the deformed side.
// Left pressure stands up to the crests of bore and floor contact, right pressure beyond. A side is
// closed by contact when a surface holds all three of its nodes; what the fluid would press there
// is kept as the share that the contact must exceed. Leaves out flow and pressure drop.
#include "engine/contact/ring/ring_contact.h"

#include <math.h>
#include <string.h>

// The boundary place where a surface pushes hardest; `fallback` if it does not touch.
static int crest(const SbRingContact *contact, SbRingSurface surface, int fallback) {
  int best = -1;
  double most = -1.0;
  for (int i = 0; i < contact->count; i++) {
    const SbRingTouch *touch = &contact->touch[SB_RING_SURFACES * i + surface];
    if (touch->held) {
      double pressure = touch->force / fmax(contact->weight[i], 1e-30);
      if (pressure > most) {
        most = pressure;
        best = i;
      }
    }
  }
  return best >= 0 ? best : fallback;
}

// Nearest boundary node to an angle.
static int node_at(const SbRingMesh *mesh, double angle) {
  int best = 0;
  for (int i = 0; i < mesh->loop_count; i++) {
    if (fabs(mesh->angle[i] - angle) < fabs(mesh->angle[best] - angle)) {
      best = i;
    }
  }
  return best;
}

// Brings the fluid's force on one node of an open side into the balance. What presses a held node
// on its surface is kept apart: it changes no motion, but without it the node's contact force, and
// with it friction, would jump whenever the neighbour is caught or let go.
static void load_node(SbRingContact *contact, const int at[3], int a, const double force[2],
                      double k[2][3][2]) {
  SbRingFem *fem = contact->fem;
  int node = fem->mesh->loop[at[a]], held = 0;
  double n[2] = {0.0, 0.0}, t[2] = {0.0, 0.0}, gap, curvature = 0.0, x[2];
  sb_ring_contact_place(contact, at[a], x);
  for (int s = 0; s < SB_RING_SURFACES; s++) {
    if (contact->touch[SB_RING_SURFACES * at[a] + s].held) {
      sb_ring_frame(&contact->now, (SbRingSurface)s, x, n, t, &gap, &curvature);
      held++;
    }
  }
  // What remains of a force vector v in the balance: P v, all of it, its tangential part, or
  // nothing.
  double p[2][2];
  for (int i = 0; i < 2; i++) {
    for (int j = 0; j < 2; j++) {
      p[i][j] = held > 1 ? 0.0 : (i == j ? 1.0 : 0.0) - (held == 1 ? n[i] * n[j] : 0.0);
    }
  }
  for (int i = 0; i < 2; i++) {
    double acting = p[i][0] * force[0] + p[i][1] * force[1];
    contact->fluid[2 * at[a] + i] += acting;
    contact->pressed[2 * at[a] + i] += force[i] - acting;
    contact->share[2 * at[a] + i] += force[i] - acting;
    fem->residual[2 * node + i] -= acting;
    if (held == 1 && curvature != 0.0) {
      double along = t[0] * force[0] + t[1] * force[1], across = n[0] * force[0] + n[1] * force[1];
      sb_ring_fem_add(fem, node, i, node, 1, curvature * (t[i] * across + n[i] * along));
    }
    for (int b = 0; b < 3; b++) {
      for (int j = 0; j < 2; j++) {
        double value = p[i][0] * k[0][b][j] + p[i][1] * k[1][b][j];
        if (value != 0.0) {
          sb_ring_fem_add(fem, node, i, fem->mesh->loop[at[b]], j, value);
        }
      }
    }
  }
}

// Fluid force on the three nodes of one side, and its tangent if the side is open.
static void load_side(SbRingContact *contact, int side, double pressure, bool closed) {
  SbRingFem *fem = contact->fem;
  int at[3] = {2 * side, 2 * side + 1, (2 * side + 2) % contact->count};
  double x[3][2], force[3][2] = {{0.0}}, k[3][2][3][2] = {{{{0.0}}}};
  for (int a = 0; a < 3; a++) {
    sb_ring_contact_place(contact, at[a], x[a]);
  }
  double turn = fem->axisymmetric ? 2.0 * M_PI : 1.0;
  for (int q = 0; q < 3; q++) {
    double w = SB_RING_W3[q], n[3], d[3];
    sb_ring_side_shape(SB_RING_X3[q], n, d);
    double r = 0.0, dr = 0.0, dz = 0.0;
    for (int a = 0; a < 3; a++) {
      r += n[a] * x[a][0];
      dr += d[a] * x[a][0];
      dz += d[a] * x[a][1];
    }
    double radius = fem->axisymmetric ? r : 1.0;
    for (int a = 0; a < 3; a++) {
      contact->weight[at[a]] += w * n[a] * turn * radius * sqrt(dr * dr + dz * dz);
    }
    if (pressure == 0.0) {
      continue;
    }
    // Outward normal times length is (dz, -dr): the ring is pushed by -p (dz, -dr) radius turn.
    double c = w * turn * pressure;
    for (int a = 0; a < 3; a++) {
      force[a][0] -= c * n[a] * radius * dz;
      force[a][1] += c * n[a] * radius * dr;
      for (int b = 0; b < 3; b++) {
        double hoop = fem->axisymmetric ? n[b] : 0.0;
        k[a][0][b][0] += c * n[a] * hoop * dz;
        k[a][0][b][1] += c * n[a] * radius * d[b];
        k[a][1][b][0] -= c * n[a] * (hoop * dr + radius * d[b]);
      }
    }
  }
  if (pressure == 0.0) {
    return;
  }
  for (int a = 0; a < 3; a++) {
    if (closed) {
      contact->share[2 * at[a]] += force[a][0];
      contact->share[2 * at[a] + 1] += force[a][1];
    } else {
      load_node(contact, at, a, force[a], k[a]);
    }
  }
}

static bool holds(const SbRingContact *contact, int i, int surface) {
  return contact->touch[SB_RING_SURFACES * i + surface].held;
}

void sb_ring_contact_load_fluid(SbRingContact *contact) {
  const SbRingMesh *mesh = contact->fem->mesh;
  int sides = contact->count / 2;
  // Between the crests over the right flank stands the right pressure.
  if (!contact->settled) {
    contact->crest[0] = crest(contact, SB_RING_BORE, node_at(mesh, 0.0));
    contact->crest[1] = crest(contact, SB_RING_FLOOR, 0);
  }
  int bore = contact->crest[0], floor_at = contact->crest[1];
  int past = floor_at > bore ? floor_at : floor_at + contact->count;
  memset(contact->share, 0, sizeof(double) * 2 * (size_t)contact->count);
  memset(contact->fluid, 0, sizeof(double) * 2 * (size_t)contact->count);
  memset(contact->pressed, 0, sizeof(double) * 2 * (size_t)contact->count);
  memset(contact->weight, 0, sizeof(double) * (size_t)contact->count);
  for (int side = 0; side < sides; side++) {
    bool closed = false;
    for (int s = 0; s < SB_RING_SURFACES && !closed; s++) {
      closed = holds(contact, 2 * side, s) && holds(contact, 2 * side + 1, s) &&
               holds(contact, (2 * side + 2) % contact->count, s);
    }
    contact->closed[side] = closed;
    int middle = 2 * side + 1;
    bool right = (middle > bore && middle < past) ||
                 (middle + contact->count > bore && middle + contact->count < past);
    load_side(contact, side, right ? contact->now.pressure_right : contact->now.pressure_left,
              closed);
  }
}
