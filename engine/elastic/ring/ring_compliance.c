// Normal compliance of the ring at its bore contact: static condensation of the converged tangent.
//
// The tangent stiffness of the present equilibrium (large strain, prestress, follower fluid and all
// other contacts held as they are) is factorised once with the bore's nodes set free; one solve per
// node gives its column. Exact for the discrete ring to first order in the change of pressure, as
// long as no other contact opens or closes; along the bore the nodes are free (frictionless), as
// under a film. The columns belong to nodal forces: a pressure p acts with the forces area_j p_j.
// Leaves out the split into half-plane kernel and smooth rest that films much thinner than the mesh
// need.
#include "engine/elastic/ring/ring_private.h"

#include <math.h>
#include <string.h>

// Loop places of the bore's held nodes and `margin` neighbours on both sides; returns their number.
static int surface_nodes(const SbRing *ring, int margin, int *first) {
  SbRingPatch patch;
  if (!sb_ring_patch(ring, SB_RING_BORE, &patch)) {
    return 0;
  }
  *first = patch.first - margin;
  int count = patch.last - patch.first + 1 + 2 * margin;
  return count < ring->contact->count ? count : 0;
}

int sb_ring_compliance_size(const SbRing *ring, int margin) {
  int first;
  return surface_nodes(ring, margin < 0 ? 0 : margin, &first);
}

// Tangent of the present contact pressure as a follower load that is fixed in space, as a film's
// is: forces on material points would roll the section over (a load that travels with the point it
// acts on leaves its support), which is neither what a rigid bore nor what a film does. The force
// per axial length is kept, not the pressure, so that forces are the unknowns throughout.
static void add_follower(SbRing *ring) {
  static const double XI[3] = {-0.774596669241483377, 0.0, 0.774596669241483377};
  static const double WEIGHT[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  SbRingFem *fem = ring->fem;
  int loop = ring->contact->count;
  double turn = fem->axisymmetric ? 2.0 * M_PI : 1.0;
  SbRingPatch patch;
  if (!sb_ring_patch(ring, SB_RING_BORE, &patch)) {
    return;
  }
  // Whole sides within the contact; at its ends the pressure is the fluid's.
  int begin = patch.first + patch.first % 2, end = patch.last - patch.last % 2;
  for (int start = begin; start < end; start += 2) {
    int node[3];
    double p[3], r[3], z[3];
    for (int a = 0; a < 3; a++) {
      int place = (start + a) % loop;
      node[a] = fem->mesh->loop[place];
      p[a] = sb_ring_node_pressure(ring, place, SB_RING_BORE);
      r[a] = fem->mesh->x[2 * node[a]] + fem->u[2 * node[a]];
      z[a] = fem->mesh->x[2 * node[a] + 1] + fem->u[2 * node[a] + 1];
    }
    p[0] = start == begin ? patch.end_pressure[0] : p[0];
    p[2] = start + 2 == end ? patch.end_pressure[1] : p[2];
    // The straight line through the ends is smooth where nodal pressures zigzag.
    double slope = (p[2] - p[0]) / (z[2] - z[0]);
    for (int q = 0; q < 3; q++) {
      double xi = XI[q];
      double n[3] = {0.5 * xi * (xi - 1.0), 1.0 - xi * xi, 0.5 * xi * (xi + 1.0)};
      double d[3] = {xi - 0.5, -2.0 * xi, xi + 0.5};
      double rr = 0.0, dr = 0.0, zz = 0.0, dz = 0.0;
      for (int a = 0; a < 3; a++) {
        rr += n[a] * r[a];
        dr += d[a] * r[a];
        zz += n[a] * z[a];
        dz += d[a] * z[a];
      }
      double pressure = p[0] + slope * (zz - z[0]);
      double radius = fem->axisymmetric ? rr : 1.0, c = WEIGHT[q] * turn;
      for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) {
          sb_ring_fem_add(fem, node[a], 0, node[b], 1,
                          c * n[a] * radius * (pressure * d[b] + slope * n[b] * dz));
          sb_ring_fem_add(fem, node[a], 1, node[b], 0, -c * n[a] * pressure * radius * d[b]);
          sb_ring_fem_add(fem, node[a], 1, node[b], 1, -c * n[a] * radius * slope * n[b] * dr);
        }
      }
    }
  }
}

SbStatus sb_ring_compliance(SbRing *ring, int margin, double *x, double *area, double *c,
                            SbReport *report) {
  int first = 0, count = surface_nodes(ring, margin < 0 ? 0 : margin, &first);
  if (count == 0) {
    return sb_fail(report, SB_ERROR_INFEASIBLE, "the ring does not touch the bore");
  }
  SbRingFem *fem = ring->fem;
  SbRingContact *contact = ring->contact;
  int loop = contact->count;
  fem->axial_damping = 0.0;
  if (!sb_ring_fem_assemble(fem)) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "the ring's state is not an equilibrium");
  }
  sb_ring_contact_apply(contact);
  add_follower(ring);

  // Free the bore's nodes; a node that a wall holds as well keeps the wall.
  for (int i = 0; i < loop; i++) {
    SbRingTouch *touch = &contact->touch[SB_RING_SURFACES * i];
    if (!touch[SB_RING_BORE].held) {
      continue;
    }
    SbRingCondition *condition = &fem->condition[fem->mesh->loop[i]];
    bool wall = touch[SB_RING_WALL_RIGHT].held || touch[SB_RING_WALL_LEFT].held;
    memset(condition, 0, sizeof *condition);
    if (wall) {
      condition->count = 1;
      condition->direction[0][1] = 1.0;
      condition->direction[1][0] = 1.0;
    }
  }
  void *factor = NULL;
  SbStatus status = sb_ring_fem_factor(fem, &factor, report);
  for (int j = 0; status == SB_OK && j < count; j++) {
    int place = (first + j + loop) % loop;
    int node = fem->mesh->loop[place];
    x[j] = (fem->mesh->x[2 * node + 1] + fem->u[2 * node + 1]) * ring->length;
    double unit = ring->body.plane_strain ? ring->length : ring->length * ring->length;
    area[j] = contact->weight[place] * unit;
    // A unit inward force.
    memset(fem->rhs, 0, sizeof(double) * 2 * (size_t)fem->mesh->nodes);
    fem->rhs[2 * node] = -1.0;
    status = sb_ring_fem_apply_factor(fem, factor, report);
    for (int i = 0; i < count; i++) {
      int other = fem->mesh->loop[(first + i + loop) % loop];
      c[i * count + j] = -fem->du[2 * other] * ring->length / ring->force;
    }
  }
  sb_ring_fem_free_factor(&factor);
  // Leave the object as it was: forces and shares of the present state.
  if (sb_ring_fem_assemble(fem)) {
    sb_ring_contact_apply(contact);
    sb_ring_contact_forces(contact);
  }
  return status == SB_OK ? sb_succeed(report) : status;
}
