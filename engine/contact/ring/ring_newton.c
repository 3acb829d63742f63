// Newton iteration for the ring: consistent tangent, active-set contact, damped corrections.
//
// One iteration assembles, factorises once, takes the correction (shortened if a node would move
// too far or a point turn inside out) and renews the held set from the linear model's reactions. It
// has converged when the balance holds on all free rows, held nodes lie on their surfaces and the
// held set is steady. Load steps and what to do where it fails: ring_advance.c.
#include "engine/contact/ring/ring_newton.h"

#include <math.h>

enum { SINGLE_AFTER = 14, RECENTRES_MAX = 6, MORE = 10 };

static const double NEARLY = 1e-2;

static const double DET_SHARE = 0.35, DAMPING = 10.0;
static const double RESIDUAL_TOLERANCE = 1e-10, GAP_TOLERANCE = 1e-11, DRIFT_FORCE = 1e-13;

// Far below any elastic stiffness (about 10): it only fixes where a ring that nothing holds axially
// stands. The ring is let drift until the spring is slack, and it vanishes as soon as a wall or
// friction holds.
static const double AXIAL_SPRING = 1e-7;

// A correction that has to be cut shorter than this is a stumble.
static const double STUMBLE = 0.1;

static bool leans(const SbRingContact *contact) {
  for (int i = 0; i < contact->count; i++) {
    const SbRingTouch *touch = &contact->touch[SB_RING_SURFACES * i];
    if (touch[SB_RING_WALL_RIGHT].held || touch[SB_RING_WALL_LEFT].held) {
      return true;
    }
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      if (!touch[s].smooth && touch[s].slip == 0 &&
          sb_ring_contact_rubs(contact, i, (SbRingSurface)s)) {
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

// Moves the spring's rest to where the ring stands; true if that changed its force.
static bool recentre(SbRingFem *fem, double force_scale) {
  if (fem->axial_spring == 0.0) {
    return false;
  }
  int nodes = fem->mesh->nodes;
  double drift = 0.0;
  for (int i = 0; i < nodes; i++) {
    drift += (fem->u[2 * i + 1] - fem->saved[1][2 * i + 1] - fem->axial_rest) / nodes;
  }
  fem->axial_rest += drift;
  return fabs(drift) * fem->axial_spring * nodes > DRIFT_FORCE * force_scale;
}

// Says where the contact did not settle.
static void fail(const SbRingContact *contact, double residual, int changes, int iterations,
                 SbReport *report) {
  if (contact->unsteady < 0 || changes == 0) {
    (void)sb_fail(report, SB_ERROR_NOT_CONVERGED,
                  "no balance of forces (residual %.2g) after %d iterations", residual, iterations);
    return;
  }
  double x[2];
  sb_ring_contact_place(contact, contact->unsteady / SB_RING_SURFACES, x);
  SbRingSurface surface = (SbRingSurface)(contact->unsteady % SB_RING_SURFACES);
  bool wall = surface == SB_RING_WALL_RIGHT || surface == SB_RING_WALL_LEFT;
  (void)sb_fail(report, SB_ERROR_NOT_CONVERGED,
                "the contact at the %s does not settle %.2f section diameters %s (residual %.2g)",
                sb_ring_surface_name(surface), wall ? x[0] - contact->now.floor : x[1],
                wall ? "above the floor" : "from its middle", residual);
}

SbStatus sb_ring_newton(SbRingContact *contact, const SbRingNewton *options, SbRingCount *count,
                        SbReport *report) {
  SbRingFem *fem = contact->fem;
  int changes = 0, stumbles = 0, recentres = 0;
  bool slack = false;
  double step = 1.0, det_before = 1.0;
  sb_ring_contact_begin(contact);
  fem->axial_rest = 0.0;
  fem->axial_damping = DAMPING / fem->mesh->nodes;
  for (int it = 0;; it++) {
    if (options->poll != NULL && options->poll(options->poll_data)) {
      return sb_fail(report, SB_ERROR_CANCELLED, "cancelled");
    }
    // Assemble; shorten the step while a point is turned inside out or nearly so.
    fem->axial_spring = leans(contact) ? 0.0 : AXIAL_SPRING / fem->mesh->nodes;
    bool good = sb_ring_fem_assemble(fem);
    for (int back = 0; it > 0 && back < 12; back++) {
      if (good && fem->det_min >= DET_SHARE * det_before) {
        break;
      }
      sb_ring_fem_restore(fem, 0);
      step *= 0.5;
      sb_ring_fem_advance(fem, step);
      good = sb_ring_fem_assemble(fem);
      changes++;
    }
    if (!good) {
      return sb_fail(report, SB_ERROR_NOT_CONVERGED, "the ring's mesh turned inside out");
    }
    det_before = fem->det_min;
    double gap = sb_ring_contact_apply(contact);
    double residual = sb_ring_fem_free_residual(fem) / contact->force_scale;
    count->residual = residual;
    if (it > 0 && changes == 0 && !slack && residual <= RESIDUAL_TOLERANCE &&
        gap <= GAP_TOLERANCE) {
      slack = recentres++ < RECENTRES_MAX && recentre(fem, contact->force_scale);
      if (slack) {
        continue; // assembled anew, then solved once more
      }
      sb_ring_contact_forces(contact);
      return SB_OK;
    }
    slack = false;
    stumbles += step < STUMBLE ? 1 : 0;
    bool hopeless = options->stumbles_max > 0 && stumbles > options->stumbles_max;
    // A steady contact near its balance may take a little longer.
    bool near = changes == 0 && residual < NEARLY && it < options->iterations_max + MORE;
    bool spent = it >= options->iterations_max && !near;
    if (spent || hopeless || !isfinite(residual)) {
      fail(contact, residual, changes, it, report);
      if (report != NULL) {
        report->residual = residual;
        report->iteration = it;
      }
      return SB_ERROR_NOT_CONVERGED;
    }
    count->iterations++;
    SbStatus status = sb_ring_fem_solve(fem, report);
    if (status != SB_OK) {
      return status;
    }
    double length = largest(fem->du, 2 * fem->mesh->nodes);
    step = length > options->correction_max ? options->correction_max / length : 1.0;
    step = fmin(step, sb_ring_contact_limit(contact));
    sb_ring_fem_save(fem, 0);
    sb_ring_fem_advance(fem, step);
    changes = sb_ring_contact_update(contact, it >= SINGLE_AFTER) + (step < 1.0 ? 1 : 0);
    double damping = DAMPING * (it < 8 ? 1.0 : it < 16 ? 0.1 : 0.01);
    fem->axial_damping = changes > 0 ? damping / fem->mesh->nodes : 0.0;
  }
}
