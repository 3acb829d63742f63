// Newton iteration for the ring: consistent tangent, active-set contact, damped corrections, and
// bisection of the load step where it fails.
//
// One iteration assembles, factorises once, takes the correction (shortened if a node would move
// too far or a point turn inside out) and renews the held set from the linear model's reactions. It
// has converged when the balance holds on all free rows, held nodes lie on their surfaces and the
// held set is steady. A point of no return (rolling off, a leak through, collapse) shows as a step
// that shrinks below the least share: the caller is told at which setting equilibrium ended.
#include "engine/elastic/ring/ring_newton.h"

#include <math.h>
#include <string.h>

enum { GENTLE_AFTER = 14 };

static const double DET_SHARE = 0.35, DAMPING = 10.0;
static const double PRESSURE_STEP = 0.8;
static const double RESIDUAL_TOLERANCE = 1e-10, GAP_TOLERANCE = 1e-11;

// Far below any elastic stiffness (about 10): it only fixes where a ring that nothing holds axially
// stands. Its force is below 1e-8 of the loads and vanishes as soon as a wall or friction holds.
static const double AXIAL_SPRING = 1e-7;

static bool leans(const SbRingContact *contact) {
  for (int i = 0; i < contact->count; i++) {
    const SbRingTouch *touch = &contact->touch[SB_RING_SURFACES * i];
    if (touch[SB_RING_WALL_RIGHT].held || touch[SB_RING_WALL_LEFT].held) {
      return true;
    }
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      bool given = s == SB_RING_BORE && contact->now.use_traction;
      if (touch[s].held && touch[s].slip == 0 && contact->now.friction[s] > 0.0 && !given) {
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

SbStatus sb_ring_newton(SbRingContact *contact, const SbRingNewton *options, SbRingCount *count,
                        SbReport *report) {
  SbRingFem *fem = contact->fem;
  int changes = 0;
  double step = 1.0, det_before = 1.0;
  sb_ring_contact_begin(contact);
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
    if (it > 0 && changes == 0 && residual <= RESIDUAL_TOLERANCE && gap <= GAP_TOLERANCE) {
      sb_ring_contact_forces(contact);
      return SB_OK;
    }
    if (it >= options->iterations_max || !isfinite(residual)) {
      sb_fail(report, SB_ERROR_NOT_CONVERGED,
              "ring contact: residual %.2g, %d contact changes left after %d iterations", residual,
              changes, it);
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
    sb_ring_fem_save(fem, 0);
    sb_ring_fem_advance(fem, step);
    changes = sb_ring_contact_update(contact, it >= GENTLE_AFTER) + (step < 1.0 ? 1 : 0);
    double damping = DAMPING * (it < 8 ? 1.0 : it < 16 ? 0.1 : 0.01);
    fem->axial_damping = changes > 0 ? damping / fem->mesh->nodes : 0.0;
  }
}

// The setting at a share t of the way; discrete choices are the target's.
static SbRingSetting between(const SbRingSetting *a, const SbRingSetting *b, double t) {
  SbRingSetting s = *b;
#define MIX(field)                                                                                 \
  s.field =                                                                                        \
      isfinite(a->field) && isfinite(b->field) ? a->field + t * (b->field - a->field) : b->field
  MIX(bore);
  MIX(floor);
  MIX(wall_left);
  MIX(wall_right);
  MIX(land_left);
  MIX(land_right);
  MIX(chamfer_slope);
  MIX(edge_length);
  MIX(pressure_left);
  MIX(pressure_right);
  MIX(slide);
  MIX(traction);
  for (int i = 0; i < SB_RING_SURFACES; i++) {
    MIX(friction[i]);
  }
#undef MIX
  return s;
}

static void mark_anchor(SbRingContact *contact) {
  const SbRingFem *fem = contact->fem;
  for (int i = 0; i < contact->count; i++) {
    int node = fem->mesh->loop[i];
    for (int k = 0; k < 2; k++) {
      contact->anchor[2 * i + k] = fem->mesh->x[2 * node + k] + fem->u[2 * node + k];
    }
  }
  contact->slide_start = contact->now.slide;
}

SbStatus sb_ring_advance(SbRingContact *contact, const SbRingSetting *target,
                         const SbRingNewton *options, SbRingCount *count, SbReport *report) {
  SbRingFem *fem = contact->fem;
  SbRingSetting start = contact->now;
  // Pressure changes beyond about one shear modulus are taken in parts.
  double jump = fmax(fabs(target->pressure_left - start.pressure_left),
                     fabs(target->pressure_right - start.pressure_right));
  double done = 0.0, share = 1.0 / ceil(fmax(1.0, jump / PRESSURE_STEP));
  while (done < 1.0) {
    SbRingSetting good = contact->now;
    mark_anchor(contact);
    sb_ring_fem_save(fem, 1);
    sb_ring_contact_save(contact);
    double next = fmin(1.0, done + share);
    contact->now = next >= 1.0 ? *target : between(&start, target, next);
    int before = count->iterations;
    SbStatus status = sb_ring_newton(contact, options, count, report);
    if (status == SB_OK) {
      done = next;
      count->steps++;
      int used = count->iterations - before;
      share = used <= 8 ? 2.0 * share : share;
      continue;
    }
    // Back to the last good state and half the step.
    contact->now = good;
    sb_ring_fem_restore(fem, 1);
    sb_ring_contact_restore(contact);
    count->rejected++;
    share *= 0.5;
    if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY || share < options->step_least) {
      if (status == SB_ERROR_NOT_CONVERGED && report != NULL) {
        char reason[160];
        memcpy(reason, report->text, sizeof reason - 1);
        reason[sizeof reason - 1] = '\0';
        double residual = report->residual;
        int iteration = report->iteration;
        sb_fail(report, status, "equilibrium lost at %.3g of the step: %s", done, reason);
        report->residual = residual;
        report->iteration = iteration;
      }
      // Forces and conditions of the state that is kept.
      if (sb_ring_fem_assemble(fem)) {
        sb_ring_contact_apply(contact);
        sb_ring_contact_forces(contact);
      }
      return status;
    }
  }
  return sb_succeed(report);
}
