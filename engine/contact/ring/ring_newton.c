// Newton iteration for the ring: consistent tangent, active-set contact, damped corrections.
//
// One iteration assembles, factorises once, applies the correction (shortened if a node would move
// too far or a point would invert) and updates the active set from the linear model's reactions. It
// has converged when the balance holds in all free rows, nodes in contact are on their surfaces,
// and the active set is constant.
#include "engine/contact/ring/ring_private.h"

#include <math.h>
#include <string.h>

// Iterations per load step; few on a sealed path, short of its fold.
enum { ITERATIONS_MAX = 24, SEALED_ITERATIONS = 14 };
enum { SINGLE_AFTER = 14, RECENTRES_MAX = 6, MORE = 10 };

static const double NEARLY = 1e-2;

// A short step that is so far from its balance after so many iterations does not find it.
enum { FAR_AFTER = 8 };
static const double FAR = 1.0;

// For the first iterations the nodes of a state from another mesh stay at their interpolated
// positions; its contact is fixed until the balance is this close, or for so many iterations.
enum { STUCK = 2, FIXED_MAX = 8 };
static const double NEAR_FIXED = 1e-3;

static const double DET_SHARE = 0.35, DAMPING = 10.0;
static const double RESIDUAL_TOLERANCE = 1e-11, PASSED_TOLERANCE = 1e-7, PATH_TOLERANCE = 1e-9,
                    DRIFT_FORCE = 1e-13;

// Stiffness of a weak spring, far below any elastic stiffness (about 10). It only determines the
// position of a ring without axial support. The ring drifts until the spring is slack; the spring
// is removed as soon as a wall or friction supports the ring.
static const double AXIAL_SPRING = 1e-7;

// Largest nodal correction of one iteration, in section diameters. A correction that must be
// shortened below STUMBLE of it counts as a failure; after so many the solve ends.
static const double CORRECTION_MAX = 0.15, STUMBLE = 0.1;
enum { STUMBLES_MAX = 4 };

// Nodes that enter and leave the contact alternately leave the residual constant, to this fraction;
// after so many such iterations the solve ends too.
static const double SAME = 0.02;
enum { REPEATS_MAX = 6 };

// With a constant contact the residual decreases in every iteration, except where a node's friction
// starts or its law has a kink. There it can alternate between two or three values for ever. After
// so many iterations that do not reduce it to this fraction of its minimum with constant contact, a
// half step is taken. It usually succeeds if the residual is not rounding, but some rings lose
// their path by it, so that only quick ones use it.
static const double FALLS = 0.5, BENDS = 1e-7;
enum { ROUND_MAX = 4 };

// A damped solve instead takes half of a step of constant contact, up to so many times, while it
// does not reduce the residual.
enum { BACKS_MAX = 5 };

// Returns whether something supports the ring axially.
static bool leans(const SbRingContact *contact) {
  for (int i = 0; i < contact->count; i++) {
    if (sb_ring_touch(contact, i, SB_RING_WALL_RIGHT)->held ||
        sb_ring_touch(contact, i, SB_RING_WALL_LEFT)->held) {
      return true;
    }
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      if (sb_ring_contact_sticks(contact, i, (SbRingSurface)s)) {
        return true;
      }
    }
  }
  return false;
}

static double largest(const double *v, int n) {
  double m = 0.0;
  for (int i = 0; i < n; i++) {
    m = fmax(m, fabs(v[i]));
  }
  return m;
}

// Moves the spring's rest position to the ring; returns true if that changed the spring's force.
static bool recentre(SbRingFem *fem, double force_scale) {
  if (fem->axial_spring == 0.0) {
    return false;
  }
  int nodes = fem->mesh->nodes;
  double drift = 0.0;
  for (int i = 0; i < nodes; i++) {
    drift += (fem->u[2 * i + 1] - fem->saved[SB_RING_START][2 * i + 1] - fem->axial_rest) / nodes;
  }
  fem->axial_rest += drift;
  return fabs(drift) * fem->axial_spring * nodes > DRIFT_FORCE * force_scale;
}

// Reports where the contact did not settle.
static void fail(const SbRing *ring, double residual, int changes, int iterations,
                 SbReport *report) {
  const SbRingContact *contact = ring->contact;
  if (contact->unsteady < 0 || changes == 0) {
    (void)sb_fail(report, SB_ERROR_NOT_CONVERGED,
                  "no balance of forces (residual %.2g) after %d iterations", residual, iterations);
    return;
  }
  double x[2];
  sb_ring_contact_place(contact, contact->unsteady / SB_RING_SURFACES, x);
  SbRingSurface surface = (SbRingSurface)(contact->unsteady % SB_RING_SURFACES);
  const SbRingLoad *now = &contact->is.now;
  const bool wall = surface == SB_RING_WALL_RIGHT || surface == SB_RING_WALL_LEFT;
  const bool inward = ring->body.inward; // it has no floor, and its radii are negative
  (void)sb_fail(report, SB_ERROR_NOT_CONVERGED,
                "the contact at the %s does not settle %.2f section diameters %s (residual %.2g)",
                sb_ring_surface_name(surface),
                !wall    ? x[1]
                : inward ? now->bore_radius - x[0]
                         : x[0] - now->floor_radius,
                !wall    ? "from its middle"
                : inward ? "from the stem"
                         : "above the floor",
                residual);
}

// Returns the distance of the state from its position on the path; 0 if the friction factor is
// given.
static double off_path(const SbRing *ring) {
  const SbRingArc *arc = &ring->arc;
  double at[2] = {sb_ring_turn(ring->contact, NULL, NULL, NULL),
                  arc->unit * ring->contact->is.now.friction_bore};
  return arc->free ? arc->direction[0] * (at[0] - arc->base[0]) +
                         arc->direction[1] * (at[1] - arc->base[1]) - arc->length
                   : 0.0;
}

// Solves for the correction; on a path for that of the share of the bore's law too, *change, by a
// second solution with the same factors (bordering).
static SbStatus correct(SbRing *ring, double *change, SbReport *report) {
  SbRingFem *fem = ring->fem;
  const SbRingContact *contact = ring->contact;
  SbStatus status = sb_ring_fem_solve(fem, report);
  *change = 0.0;
  if (status != SB_OK || !ring->arc.free || contact->stuck) {
    return status;
  }
  size_t n = 2 * (size_t)fem->mesh->nodes;
  memcpy(fem->du_path, fem->du, sizeof(double) * n);
  memset(fem->rhs, 0, sizeof(double) * n);
  for (int i = 0; i < contact->count; i++) {
    const SbRingTouch *touch = sb_ring_touch(contact, i, SB_RING_BORE);
    int node = fem->mesh->loop[i];
    const double *r = &fem->residual[2 * node], *normal = fem->condition[node].direction[0];
    if (touch->held && !touch->smooth && fem->condition[node].count == 1) {
      int row = fabs(normal[0]) >= fabs(normal[1]) ? 1 : 0;
      const double force = normal[0] * r[0] + normal[1] * r[1];
      const double fluid = sb_ring_fluid_at(contact, i, normal);
      fem->rhs[2 * node + row] =
          contact->is.now.bore_slides * sb_ring_grip(contact, i, SB_RING_BORE, force, fluid).force;
    }
  }
  status = sb_ring_fem_apply_factor(fem, report);
  double given, by_friction;
  (void)sb_ring_turn(contact, fem->du_path, &given, NULL);
  (void)sb_ring_turn(contact, fem->du, &by_friction, NULL);
  const double *direction = ring->arc.direction;
  const double across = direction[0] * by_friction + direction[1] * ring->arc.unit;
  // Friction that does not turn the section cannot correct its turn.
  *change = across != 0.0 ? -(off_path(ring) + direction[0] * given) / across : 0.0;
  for (size_t k = 0; k < n; k++) {
    fem->du[k] = fem->du_path[k] + *change * fem->du[k];
  }
  return status;
}

// Returns to the state before the last step and takes half of that step.
static void take_half(SbRing *ring, double *step, double friction, double change) {
  sb_ring_fem_restore(ring->fem, 0);
  *step *= 0.5;
  sb_ring_fem_advance(ring->fem, *step);
  ring->contact->is.now.friction_bore = friction + *step * change;
}

// Long: the conditions that shorten, repeat or end an iteration depend on the same counters.
SbStatus sb_ring_newton(SbRing *ring, SbRingPath path, SbReport *report) {
  const int iterations_max = path == SB_RING_SEALED ? SEALED_ITERATIONS : ITERATIONS_MAX;
  SbRingContact *contact = ring->contact;
  SbRingFem *fem = ring->fem;
  int changes = 0, stumbles = 0, recentres = 0, repeats = 0, rounds = 0, backs = 0;
  double last = INFINITY, least = INFINITY;
  bool slack = false;
  unsigned folded = contact->folds;
  double step = 1.0, det_before = 1.0, friction = contact->is.now.friction_bore, change = 0.0;
  sb_ring_contact_begin(contact);
  contact->passed = ring->passing;
  contact->onset = ring->easy ? ring->onset : 1.0;
  const double tolerance = ring->passing ? PASSED_TOLERANCE : RESIDUAL_TOLERANCE;
  fem->axial_rest = 0.0;
  fem->axial_damping = DAMPING / fem->mesh->nodes;
  for (int it = 0;; it++) {
    if (ring->options.poll != NULL && ring->options.poll(ring->options.poll_data)) {
      return sb_fail(report, SB_ERROR_CANCELLED, "cancelled");
    }
    // Assemble; shorten the step while a point is turned inside out or nearly so.
    fem->axial_spring = leans(contact) ? 0.0 : AXIAL_SPRING / fem->mesh->nodes;
    bool good = sb_ring_fem_assemble(fem);
    for (int back = 0; it > 0 && back < 12; back++) {
      if (good && fem->det_min >= DET_SHARE * det_before) {
        break;
      }
      take_half(ring, &step, friction, change);
      good = sb_ring_fem_assemble(fem);
      changes++;
    }
    if (!good) {
      return sb_fail(report, SB_ERROR_NOT_CONVERGED, "the ring's mesh turned inside out");
    }
    det_before = fem->det_min;
    contact->stuck = contact->fixed && contact->carried && it < STUCK;
    double gap = sb_ring_contact_apply(contact);
    double residual = sb_ring_fem_free_residual(fem) / contact->force_scale;
    // The first step leaves the balance of the state before.
    if (ring->damped && it > 1 && changes == 0 && !slack && !contact->fixed && residual > BENDS &&
        residual > last && backs < BACKS_MAX) {
      take_half(ring, &step, friction, change);
      backs++;
      it--;
      continue;
    }
    backs = 0;
    if (it > 0 && changes == 0 && !slack && !contact->fixed && residual <= tolerance &&
        gap <= tolerance && fabs(off_path(ring)) <= PATH_TOLERANCE) {
      slack = recentres++ < RECENTRES_MAX && recentre(fem, contact->force_scale);
      if (slack) {
        continue; // assembled again, then solved once more
      }
      sb_ring_contact_forces(contact);
      return SB_OK;
    }
    slack = false;
    contact->fixed = contact->fixed && residual > NEAR_FIXED && it < FIXED_MAX;
    stumbles += step < STUMBLE ? 1 : 0;
    repeats = changes > 0 && fabs(residual - last) < SAME * last ? repeats + 1 : 0;
    const bool folds = contact->folds != folded;
    folded = contact->folds;
    const bool falls = changes > 0 || folds || contact->fixed || residual < FALLS * least ||
                       (ring->damped && it <= 1);
    rounds = falls ? 0 : rounds + 1;
    least = falls ? residual : least;
    last = residual;
    // A steady contact near its balance may take a little longer.
    bool near = changes == 0 && residual < NEARLY && it < iterations_max + MORE;
    bool spent = (it >= iterations_max && !near) ||
                 (path == SB_RING_DIRECT && it >= FAR_AFTER && residual > FAR);
    if (spent || stumbles > STUMBLES_MAX || repeats > REPEATS_MAX ||
        (rounds > ROUND_MAX && !ring->damped) || !isfinite(residual)) {
      fail(ring, residual, changes, it, report);
      if (report != NULL) {
        report->residual = residual;
        report->iteration = it;
      }
      return SB_ERROR_NOT_CONVERGED;
    }
    ring->count.iterations++;
    friction = contact->is.now.friction_bore;
    SbStatus status = correct(ring, &change, report);
    if (status != SB_OK) {
      return status;
    }
    double length = largest(fem->du, 2 * fem->mesh->nodes);
    step = length > CORRECTION_MAX ? CORRECTION_MAX / length : 1.0;
    step = fmin(step, sb_ring_contact_limit(contact));
    step *= ring->options.quick && !ring->damped && rounds > 0 && residual > BENDS ? 0.5 : 1.0;
    sb_ring_fem_save(fem, 0);
    sb_ring_fem_advance(fem, step);
    contact->is.now.friction_bore = friction + step * change;
    changes = sb_ring_contact_update(contact, it >= SINGLE_AFTER) + (step < 1.0 ? 1 : 0);
    double damping = DAMPING * (it < 8 ? 1.0 : it < 16 ? 0.1 : 0.01);
    fem->axial_damping = changes > 0 ? damping / fem->mesh->nodes : 0.0;
  }
}
