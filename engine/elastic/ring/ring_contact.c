// Unilateral contact of the ring with smooth rigid surfaces, friction and fluid pressure.
//
// Contact is a primal-dual active set (Hintermueller, Ito and Kunisch 2002) on boundary nodes: held
// nodes satisfy gap = 0 as an equation of their own, the normal force is the residual of the
// balance they replace, so neither penetration nor tension is left at the end. Coulomb friction
// enters as the row (t - s mu n) . R = 0 where it slides (s: sign of the force) and as no relative
// motion since the start of the step where it sticks; it is exact, without a regularising
// stiffness. The fluid is a follower load with its consistent tangent (three-point Gauss, exact for
// quadratic sides), left pressure up to the crests of bore and floor contact, right pressure
// beyond. Leaves out adhesion and a finite friction elasticity.
#include "engine/elastic/ring/ring_contact.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// A node that keeps changing between sticking and sliding has no discrete solution of Coulomb's law
// (it happens at coefficients near 1, where the continuous problem may have none either). It is
// left sticking after this many changes, and what exceeds the law is reported.
enum { FLIPS_MAX = 5 };

// An end node of a contact can have no state with friction at all: pulled when held, whether it
// sticks or slides, and inside the surface when let go. (Under fluid it jumps by mu p when caught.)
// After being caught so often it is held without friction, which always has a solution; its
// friction is taken up again in the next step, and what is missing is reported.
enum { CATCHES_MAX = 3 };

// Share of the edge's rounding that a held node may move along it in one iteration.
static const double EDGE_SHARE = 0.5;

static const double GAUSS_X[3] = {-0.774596669241483377, 0.0, 0.774596669241483377};
static const double GAUSS_W[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};

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
  contact->share = calloc(2 * n, sizeof(double));
  contact->weight = calloc(n, sizeof(double));
  contact->fluid = calloc(2 * n, sizeof(double));
  contact->pressed = calloc(2 * n, sizeof(double));
  contact->anchor = calloc(2 * n, sizeof(double));
  for (int place = 0; place < 2; place++) {
    contact->saved[place] = calloc(n * SB_RING_SURFACES, sizeof(SbRingTouch));
  }
  if (contact->touch == NULL || contact->closed == NULL || contact->share == NULL ||
      contact->weight == NULL || contact->fluid == NULL || contact->pressed == NULL ||
      contact->anchor == NULL || contact->saved[0] == NULL || contact->saved[1] == NULL) {
    sb_ring_contact_destroy(contact);
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's contact");
  }
  *out = contact;
  return SB_OK;
}

void sb_ring_contact_destroy(SbRingContact *contact) {
  if (contact != NULL) {
    free(contact->touch);
    free(contact->closed);
    free(contact->share);
    free(contact->weight);
    free(contact->fluid);
    free(contact->pressed);
    free(contact->anchor);
    for (int place = 0; place < 2; place++) {
      free(contact->saved[place]);
    }
    free(contact);
  }
}

// Height above zero whose slope rises smoothly from 0 to 1 over a length (twice differentiable, so
// that Newton does not stumble where the chamfer sets in).
static double ramp(double x, double length, double *slope, double *curvature) {
  if (x <= 0.0) {
    *slope = *curvature = 0.0;
    return 0.0;
  }
  if (x < length) {
    double t = x / length;
    *slope = t * t * (3.0 - 2.0 * t);
    *curvature = 6.0 * t * (1.0 - t) / length;
    return length * t * t * t * (1.0 - 0.5 * t);
  }
  *slope = 1.0;
  *curvature = 0.0;
  return x - 0.5 * length;
}

double sb_ring_gap(const SbRingSetting *setting, SbRingSurface surface, const double x[2],
                   double gradient[2], double *curvature) {
  *curvature = 0.0;
  switch (surface) {
  case SB_RING_BORE: {
    double s1, c1, s2, c2;
    double opening = ramp(x[1] - setting->land_right, setting->edge_length, &s1, &c1) +
                     ramp(setting->land_left - x[1], setting->edge_length, &s2, &c2);
    gradient[0] = -1.0;
    gradient[1] = setting->chamfer_slope * (s1 - s2);
    *curvature = setting->chamfer_slope * (c1 + c2);
    return setting->bore + setting->chamfer_slope * opening - x[0];
  }
  case SB_RING_FLOOR:
    gradient[0] = 1.0;
    gradient[1] = 0.0;
    return x[0] - setting->floor;
  case SB_RING_WALL_RIGHT:
    gradient[0] = 0.0;
    gradient[1] = -1.0;
    return setting->wall_right - x[1];
  case SB_RING_WALL_LEFT:
    gradient[0] = 0.0;
    gradient[1] = 1.0;
    return x[1] - setting->wall_left;
  case SB_RING_SURFACES:
    break;
  }
  gradient[0] = gradient[1] = 0.0;
  return INFINITY;
}

static void node_place(const SbRingContact *contact, int i, double x[2]) {
  const SbRingFem *fem = contact->fem;
  int node = fem->mesh->loop[i];
  x[0] = fem->mesh->x[2 * node] + fem->u[2 * node];
  x[1] = fem->mesh->x[2 * node + 1] + fem->u[2 * node + 1];
}

void sb_ring_contact_detect(SbRingContact *contact) {
  for (int i = 0; i < contact->count; i++) {
    double x[2], g[2], curvature;
    node_place(contact, i, x);
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      SbRingTouch *touch = &contact->touch[SB_RING_SURFACES * i + s];
      touch->held = sb_ring_gap(&contact->now, (SbRingSurface)s, x, g, &curvature) <= 1e-12;
      touch->slip = 0;
    }
  }
}

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

static const SbRingTouch *held_touch(const SbRingContact *contact, int i, int s) {
  const SbRingTouch *touch = &contact->touch[SB_RING_SURFACES * i + s];
  return touch->held ? touch : NULL;
}

// Unit normal (into the free side) and tangent of a surface at a place; `curvature` is the normal's
// turn towards the tangent per axial length.
static void frame(const SbRingContact *contact, SbRingSurface surface, const double x[2],
                  double n[2], double t[2], double *gap, double *curvature) {
  double g[2];
  *gap = sb_ring_gap(&contact->now, surface, x, g, curvature);
  double length = hypot(g[0], g[1]);
  n[0] = g[0] / length;
  n[1] = g[1] / length;
  *gap /= length;
  bool along_z = surface == SB_RING_BORE || surface == SB_RING_FLOOR;
  t[0] = along_z ? (surface == SB_RING_BORE ? -n[1] * n[0] / fabs(n[0]) : 0.0) : 1.0;
  t[1] = along_z ? fabs(n[0]) : 0.0;
  *curvature /= length * length;
}

// Brings the fluid's force on one node of an open side into the balance. What presses a held node
// on its surface is kept apart: it changes no motion, but without it the node's contact force, and
// with it friction, would jump whenever the neighbour is caught or let go.
static void load_node(SbRingContact *contact, const int at[3], int a, const double force[2],
                      double k[2][3][2]) {
  SbRingFem *fem = contact->fem;
  int node = fem->mesh->loop[at[a]], held = 0;
  double n[2] = {0.0, 0.0}, t[2] = {0.0, 0.0}, gap, curvature = 0.0, x[2];
  node_place(contact, at[a], x);
  for (int s = 0; s < SB_RING_SURFACES; s++) {
    if (contact->touch[SB_RING_SURFACES * at[a] + s].held) {
      frame(contact, (SbRingSurface)s, x, n, t, &gap, &curvature);
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
    node_place(contact, at[a], x[a]);
  }
  double turn = fem->axisymmetric ? 2.0 * M_PI : 1.0;
  for (int q = 0; q < 3; q++) {
    double xi = GAUSS_X[q], w = GAUSS_W[q];
    double n[3] = {0.5 * xi * (xi - 1.0), 1.0 - xi * xi, 0.5 * xi * (xi + 1.0)};
    double d[3] = {xi - 0.5, -2.0 * xi, xi + 0.5};
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

static void load_boundary(SbRingContact *contact) {
  const SbRingMesh *mesh = contact->fem->mesh;
  int sides = contact->count / 2;
  // Between the crests over the right flank stands the right pressure.
  int bore = crest(contact, SB_RING_BORE, node_at(mesh, 0.0));
  int floor_at = crest(contact, SB_RING_FLOOR, 0);
  int past = floor_at > bore ? floor_at : floor_at + contact->count;
  memset(contact->share, 0, sizeof(double) * 2 * (size_t)contact->count);
  memset(contact->fluid, 0, sizeof(double) * 2 * (size_t)contact->count);
  memset(contact->pressed, 0, sizeof(double) * 2 * (size_t)contact->count);
  memset(contact->weight, 0, sizeof(double) * (size_t)contact->count);
  for (int side = 0; side < sides; side++) {
    bool closed = false;
    for (int s = 0; s < SB_RING_SURFACES && !closed; s++) {
      closed = held_touch(contact, 2 * side, s) != NULL &&
               held_touch(contact, 2 * side + 1, s) != NULL &&
               held_touch(contact, (2 * side + 2) % contact->count, s) != NULL;
    }
    contact->closed[side] = closed;
    int middle = 2 * side + 1;
    bool right = (middle > bore && middle < past) ||
                 (middle + contact->count > bore && middle + contact->count < past);
    load_side(contact, side, right ? contact->now.pressure_right : contact->now.pressure_left,
              closed);
  }
}

// Relative motion along t since the start of the step.
static double slipped(const SbRingContact *contact, SbRingSurface surface, int i, const double x[2],
                      const double t[2]) {
  double moved =
      t[0] * (x[0] - contact->anchor[2 * i]) + t[1] * (x[1] - contact->anchor[2 * i + 1]);
  if (surface == SB_RING_BORE) {
    moved -= t[1] * (contact->now.slide - contact->slide_start);
  }
  return moved;
}

double sb_ring_contact_apply(SbRingContact *contact) {
  SbRingFem *fem = contact->fem;
  load_boundary(contact);
  double worst = 0.0;
  for (int i = 0; i < contact->count; i++) {
    SbRingCondition *condition = &fem->condition[fem->mesh->loop[i]];
    memset(condition, 0, sizeof *condition);
    double x[2];
    node_place(contact, i, x);
    for (int s = 0; s < SB_RING_SURFACES && condition->count < 2; s++) {
      const SbRingTouch *touch = held_touch(contact, i, s);
      if (touch == NULL) {
        continue;
      }
      double n[2], t[2], gap, curvature;
      frame(contact, (SbRingSurface)s, x, n, t, &gap, &curvature);
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
        condition->gap[1] = -slipped(contact, (SbRingSurface)s, i, x, t);
        bool corner = false;
        for (int other = s + 1; other < SB_RING_SURFACES; other++) {
          corner = corner || held_touch(contact, i, other) != NULL;
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
      frame(contact, (SbRingSurface)s, x, n[count], t[count], &gap, &curvature);
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

// How far a held node is from Coulomb's law, in units of force: too large a sticking force, or a
// slip that its own friction would have to drive. The new slip state is given too.
static double slip_fault(const SbRingContact *contact, SbRingSurface surface, int i,
                         signed char *state) {
  const SbRingTouch *touch = &contact->touch[SB_RING_SURFACES * i + surface];
  double friction = contact->now.friction[surface];
  *state = touch->slip;
  bool given = surface == SB_RING_BORE && contact->now.use_traction;
  if (!touch->held || touch->smooth || friction <= 0.0 || given) {
    return 0.0;
  }
  double tiny = 1e-11 * contact->force_scale;
  if (touch->slip == 0) {
    double over = fabs(touch->tangent) - friction * touch->force;
    *state = touch->tangent > 0.0 ? 1 : -1;
    return over > tiny ? over : 0.0;
  }
  double x[2], n[2], t[2], gap, curvature;
  node_place(contact, i, x);
  frame(contact, surface, x, n, t, &gap, &curvature);
  double against = slipped(contact, surface, i, x, t) * touch->slip;
  *state = 0;
  // A length as a force by a stiffness of order one per unit of boundary.
  return against > 1e-11 ? against * contact->weight[i] : 0.0;
}

static void flip(SbRingTouch *touch, signed char state) {
  touch->flips++;
  touch->slip = touch->flips >= FLIPS_MAX ? 0 : state;
}

// Renews stick and slip; with `gentle` only the worst fault.
static int update_slip(SbRingContact *contact, bool gentle) {
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
      if (fault > 0.0 && !gentle) {
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

// Slip state of a node that is being caught: friction against its motion in this step. A node that
// comes back, since the surface would have had to pull it in that state, tries the others in turn.
static signed char caught_slip(const SbRingContact *contact, SbRingSurface surface, int i,
                               const double x[2], const double t[2]) {
  if (contact->now.friction[surface] <= 0.0) {
    return 0;
  }
  double moved = slipped(contact, surface, i, x, t);
  signed char state = moved > 1e-9 ? -1 : moved < -1e-9 ? 1 : 0;
  int turn = contact->touch[SB_RING_SURFACES * i + surface].catches % 3;
  return turn < 2 ? (signed char)(state * (1 - turn)) : (signed char)(-state);
}

int sb_ring_contact_update(SbRingContact *contact, bool gentle) {
  SbRingFem *fem = contact->fem;
  int changes = 0;
  double tiny = 1e-11 * contact->force_scale;
  int worst_release = -1, worst_catch = -1;
  double least = -tiny, deepest = -1e-11;
  for (int i = 0; i < contact->count; i++) {
    int node = fem->mesh->loop[i];
    double x[2], force[2];
    node_place(contact, i, x);
    if (fem->condition[node].count > 0) {
      sb_ring_fem_reaction(fem, node, force);
      split_force(contact, i, x, force);
    }
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      int at = SB_RING_SURFACES * i + s;
      SbRingTouch *touch = &contact->touch[at];
      double n[2], t[2], gap, curvature;
      frame(contact, (SbRingSurface)s, x, n, t, &gap, &curvature);
      // The fluid would push this node off the surface, along n, by its share.
      double excess =
          touch->force - n[0] * contact->share[2 * i] - n[1] * contact->share[2 * i + 1];
      if (!touch->held && gap < deepest) {
        worst_catch = at;
        deepest = gentle ? gap : deepest;
      } else if (touch->held && excess < least) {
        worst_release = at;
        least = gentle ? excess : least;
      } else {
        continue;
      }
      if (!gentle) {
        touch->held = !touch->held;
        touch->slip = touch->held ? caught_slip(contact, (SbRingSurface)s, i, x, t) : 0;
        contact->unsteady = at;
        touch->smooth = touch->catches >= CATCHES_MAX;
        touch->catches += touch->held ? 1 : 0;
        changes++;
      }
    }
  }
  if (gentle && worst_release >= 0) {
    contact->touch[worst_release].held = false;
    contact->unsteady = worst_release;
    changes++;
  }
  if (gentle && worst_catch >= 0) {
    int i = worst_catch / SB_RING_SURFACES;
    SbRingSurface s = (SbRingSurface)(worst_catch % SB_RING_SURFACES);
    double x[2], n[2], t[2], gap, curvature;
    node_place(contact, i, x);
    frame(contact, s, x, n, t, &gap, &curvature);
    contact->touch[worst_catch].held = true;
    contact->unsteady = worst_catch;
    contact->touch[worst_catch].slip = caught_slip(contact, s, i, x, t);
    contact->touch[worst_catch].smooth = contact->touch[worst_catch].catches >= CATCHES_MAX;
    contact->touch[worst_catch].catches++;
    changes++;
  }
  // Friction follows once the contact is steady: both at once chase each other.
  return changes > 0 ? changes : update_slip(contact, gentle);
}

double sb_ring_contact_limit(const SbRingContact *contact) {
  const SbRingFem *fem = contact->fem;
  double step = 1.0;
  for (int i = 0; i < contact->count; i++) {
    if (contact->touch[SB_RING_SURFACES * i + SB_RING_BORE].held) {
      double x[2], g[2], before, after;
      node_place(contact, i, x);
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

const char *sb_ring_surface_name(SbRingSurface surface) {
  switch (surface) {
  case SB_RING_BORE:
    return "bore";
  case SB_RING_FLOOR:
    return "groove floor";
  case SB_RING_WALL_RIGHT:
    return "right groove wall";
  case SB_RING_WALL_LEFT:
    return "left groove wall";
  case SB_RING_SURFACES:
    break;
  }
  return "";
}

void sb_ring_contact_begin(SbRingContact *contact) {
  contact->unsteady = -1;
  for (int i = 0; i < SB_RING_SURFACES * contact->count; i++) {
    contact->touch[i].flips = contact->touch[i].catches = 0;
    contact->touch[i].smooth = false;
  }
}

// Sum of what exceeds Coulomb's law at sticking nodes and of the friction that is left out.
static double slip_excess(const SbRingContact *contact) {
  double sum = 0.0;
  for (int i = 0; i < SB_RING_SURFACES * contact->count; i++) {
    const SbRingTouch *touch = &contact->touch[i];
    double friction = contact->now.friction[i % SB_RING_SURFACES];
    bool given = i % SB_RING_SURFACES == SB_RING_BORE && contact->now.use_traction;
    if (touch->held && touch->smooth && friction > 0.0 && !given) {
      sum += friction * touch->force;
    } else if (touch->held && touch->slip == 0 && friction > 0.0 && !given) {
      sum += fmax(0.0, fabs(touch->tangent) - friction * touch->force);
    }
  }
  return sum;
}

void sb_ring_contact_forces(SbRingContact *contact) {
  const SbRingFem *fem = contact->fem;
  for (int i = 0; i < contact->count; i++) {
    double x[2];
    node_place(contact, i, x);
    split_force(contact, i, x, &fem->residual[2 * fem->mesh->loop[i]]);
  }
  contact->slip_excess = slip_excess(contact);
  // For the record, the fluid on open sides is the fluid's again, not the contact's.
  for (int i = 0; i < contact->count; i++) {
    double x[2], force[2];
    node_place(contact, i, x);
    for (int k = 0; k < 2; k++) {
      force[k] = fem->residual[2 * fem->mesh->loop[i] + k] - contact->pressed[2 * i + k];
      contact->fluid[2 * i + k] += contact->pressed[2 * i + k];
      contact->share[2 * i + k] -= contact->pressed[2 * i + k];
    }
    split_force(contact, i, x, force);
  }
}

void sb_ring_contact_total(const SbRingContact *contact, SbRingSurface surface, double force[2]) {
  force[0] = force[1] = 0.0;
  for (int i = 0; i < contact->count; i++) {
    const SbRingTouch *touch = held_touch(contact, i, surface);
    if (touch != NULL) {
      double x[2], n[2], t[2], gap, curvature;
      node_place(contact, i, x);
      frame(contact, surface, x, n, t, &gap, &curvature);
      for (int k = 0; k < 2; k++) {
        force[k] += touch->force * n[k] + touch->tangent * t[k];
      }
    }
  }
}

void sb_ring_contact_save(SbRingContact *contact, int place) {
  memcpy(contact->saved[place], contact->touch,
         sizeof(SbRingTouch) * SB_RING_SURFACES * (size_t)contact->count);
}

void sb_ring_contact_restore(SbRingContact *contact, int place) {
  memcpy(contact->touch, contact->saved[place],
         sizeof(SbRingTouch) * SB_RING_SURFACES * (size_t)contact->count);
}
