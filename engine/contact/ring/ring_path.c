// Load steps of the ring, in parts whose largest change is moderate and which are halved if
// Newton's method fails.
//
// If that is not sufficient, the equilibrium is unstable or far (the section snaps through at the
// land's edge, friction is released, a wall is reached across the groove). The load is then
// constant, and the ring follows in steps of a viscous motion, M c (u_n - u_n-1) + R(u_n) = 0 with
// reference volume M and decreasing c (pseudo-transient continuation, Kelley and Keyes 1998);
// friction sees every step. The viscosity is removed at the end, so the result is an equilibrium. A
// ring that keeps moving has none; the report describes its motion. Not modelled: inertia. If
// several equilibria can be reached, the result is that of an overdamped motion.
//
// Rolling. The hoop stress resists the rotation of a ring's section nearly like the sine of the
// angle, so the drag that it can carry has its maximum near a quarter turn. Steady sliding was
// found at rotations up to 1.55 rad, decreasing drag from 2.05 rad on (dry and under fluid, with
// and without friction on floor and wall). A section that rotates beyond ROLLED still has
// equilibria for a given position of the bore, but rolls with it at a decreasing drag: there is no
// sliding state, and the step is refused. The rotation is the mean of the section's points,
// followed along the path so that it does not wrap.
#include "engine/contact/ring/ring_private.h"

#include <math.h>

// Largest changes of one part: pressure in shear moduli, places in section diameters.
static const double PRESSURE_STEP = 0.8, LAND_STEP = 0.15;

// Viscosities, in shear moduli per section diameter squared: first, smallest one before it is
// removed, largest; number of steps and removals that are tried.
static const double VISCOSITY = 30.0, VISCOSITY_LEAST = 0.3, VISCOSITY_MOST = 3e4;
enum { TRANSIENT_STEPS = 50, DROPS_MAX = 4, TRANSIENTS_MAX = 9 };

// Newton iterations after which a load step ends at its next failure.
enum { ITERATIONS_MOST = 1000 };

// Smallest fraction of a part before it ends. Smallest number of parts of a sealed path, and their
// smallest fraction: a step that loses the contact passed its fold.
static const double STEP_LEAST = 1.0 / 64.0, SEALED_PARTS = 4.0, SEALED_LEAST = 1.0 / 8.0;

// A motion beyond which the ring counts as gone, in section diameters; the turn beyond which it
// rolls and the largest one of a part, in radians.
static const double GONE = 1.5, ROLLED = 2.0, TURN_STEP = 0.5;

// Number of parts that a load step is first taken in.
static double parts(const SbRingLoad *a, const SbRingLoad *b) {
  double pressure =
      fmax(fabs(b->pressure_left - a->pressure_left), fabs(b->pressure_right - a->pressure_right));
  double from[2] = {a->land_left, a->land_right}, to[2] = {b->land_left, b->land_right};
  double most = pressure / PRESSURE_STEP;
  for (int k = 0; k < 2; k++) {
    double way = fmin(SB_RING_REACH, fmax(-SB_RING_REACH, to[k])) -
                 fmin(SB_RING_REACH, fmax(-SB_RING_REACH, from[k]));
    most = fmax(most, fabs(way) / LAND_STEP);
  }
  return ceil(fmax(1.0, most));
}

double sb_ring_turn(const SbRingContact *contact, const double *du, double *change, double *place) {
  const SbRingFem *fem = contact->fem;
  const SbRingMesh *mesh = fem->mesh;
  double sum = 0.0, now[2] = {0.0, 0.0}, then[2] = {0.0, 0.0};
  for (int i = 0; i < mesh->nodes; i++) {
    sum += fem->mass[i];
    for (int k = 0; k < 2; k++) {
      now[k] += fem->mass[i] * (mesh->x[2 * i + k] + fem->u[2 * i + k]);
      then[k] += fem->mass[i] * mesh->x[2 * i + k];
    }
  }
  // Sums of a x b and a . b over free and present places about their means, and of a and du.
  double cross[2] = {0.0, 0.0}, dot[2] = {0.0, 0.0};
  for (int i = 0; i < mesh->nodes; i++) {
    double a[2], b[2];
    for (int k = 0; k < 2; k++) {
      a[k] = mesh->x[2 * i + k] - then[k] / sum;
      b[k] = mesh->x[2 * i + k] + fem->u[2 * i + k] - now[k] / sum;
    }
    cross[0] += fem->mass[i] * (a[0] * b[1] - a[1] * b[0]);
    dot[0] += fem->mass[i] * (a[0] * b[0] + a[1] * b[1]);
    if (du != NULL) {
      cross[1] += fem->mass[i] * (a[0] * du[2 * i + 1] - a[1] * du[2 * i]);
      dot[1] += fem->mass[i] * (a[0] * du[2 * i] + a[1] * du[2 * i + 1]);
    }
  }
  if (du != NULL) {
    *change = (dot[0] * cross[1] - cross[0] * dot[1]) / (dot[0] * dot[0] + cross[0] * cross[0]);
  }
  if (place != NULL) {
    *place = now[1] / sum;
  }
  return contact->is.turn + remainder(atan2(cross[0], dot[0]) - contact->is.turn, 2.0 * M_PI);
}

// Takes the section's turn over from a new equilibrium, unless it cannot be one of the path: turned
// too far in one part, or rolling on.
static SbStatus take_turn(SbRing *ring, SbReport *report) {
  SbRingContact *contact = ring->contact;
  double turn = sb_ring_turn(contact, NULL, NULL, NULL);
  if (fabs(turn - contact->is.turn) > TURN_STEP) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "the section turns by %.3g rad in one step",
                   turn - contact->is.turn);
  }
  if (contact->is.now.bore_slides == 0 && fabs(turn) > ROLLED &&
      fabs(turn) > fabs(contact->is.turn)) {
    ring->state = SB_RING_ROLLS;
    return sb_fail(
        report, SB_ERROR_NOT_CONVERGED,
        "the ring rolls: its section has turned by %.3g rad, where no friction force balances it",
        fabs(turn));
  }
  contact->is.turn = turn;
  ring->state = SB_RING_SLIDES;
  return SB_OK;
}

SbStatus sb_ring_attempt(SbRing *ring, SbRingPath path, SbReport *report) {
  SbRingContact *contact = ring->contact;
  SbRingPatch patch;
  SbStatus status = sb_ring_newton(ring, path, report);
  ring->fem->viscosity = 0.0;
  status = status == SB_OK ? take_turn(ring, report) : status;
  if (status == SB_OK && path == SB_RING_SEALED && !sb_ring_patch(ring, SB_RING_BORE, &patch)) {
    status = sb_fail(report, SB_ERROR_NOT_CONVERGED, "the contact is lost");
  }
  if (status != SB_OK) {
    sb_ring_restore(contact, SB_RING_START);
  }
  return status;
}

// Follows the ring at another load from the present state to an equilibrium, or, with `off`, until
// it has no contact with the bore, which is then true.
static SbStatus pseudo_transient(SbRing *ring, const SbRingLoad *load, bool *off,
                                 SbReport *report) {
  SbRingContact *contact = ring->contact;
  SbStatus status = SB_ERROR_NOT_CONVERGED;
  double c = VISCOSITY;
  int drops = 0;
  double from, to;
  (void)sb_ring_turn(contact, NULL, NULL, &from);
  for (int i = 0; i < TRANSIENT_STEPS && c <= VISCOSITY_MOST; i++) {
    bool drop = c < VISCOSITY_LEAST;
    ring->fem->viscosity = drop ? 0.0 : c;
    sb_ring_save(contact, SB_RING_START);
    contact->is.now = *load;
    int before = ring->count.iterations;
    status = sb_ring_attempt(ring, SB_RING_FOLLOW, report);
    if (ring->state == SB_RING_ROLLS || status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY ||
        (status == SB_OK && drop)) {
      return status;
    }
    SbRingPatch patch;
    if (status == SB_OK && off != NULL && !sb_ring_patch(ring, SB_RING_BORE, &patch)) {
      *off = true;
      ring->fem->viscosity = 0.0;
      return SB_OK;
    }
    if (status == SB_OK) {
      (void)sb_ring_turn(contact, NULL, NULL, &to);
      if (fabs(to - from) > GONE) {
        return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                       "the ring slides away: no groove wall supports it axially");
      }
      int used = ring->count.iterations - before;
      c *= used <= 6 ? 0.3 : used <= 12 ? 0.6 : 1.0;
      continue;
    }
    if (drop && ++drops >= DROPS_MAX) {
      return status;
    }
    c *= drop ? 10.0 : 8.0;
  }
  return status == SB_OK ? sb_fail(report, SB_ERROR_NOT_CONVERGED, "the ring does not come to rest")
                         : status;
}

SbStatus sb_ring_moves_off(SbRing *ring, bool *off, SbReport *report) {
  const SbRingLoad load = ring->contact->is.now;
  *off = false;
  return pseudo_transient(ring, &load, off, report);
}

// Puts the position where equilibrium ended before the reason.
static void explain(double done, SbReport *report) {
  if (report == NULL) {
    return;
  }
  SbReport reason = *report;
  (void)sb_fail(report, SB_ERROR_NOT_CONVERGED, "equilibrium lost at %.3g of the step: %s", done,
                reason.text);
  report->residual = reason.residual;
  report->iteration = reason.iteration;
}

// Returns whether a smaller step cannot help either.
static bool gives_up(const SbRing *ring, SbStatus status, int iterations) {
  return status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY ||
         ring->state == SB_RING_ROLLS || iterations > ITERATIONS_MOST;
}

SbStatus sb_ring_advance(SbRing *ring, const SbRingLoad *target, SbRingPath path,
                         SbReport *report) {
  SbRingContact *contact = ring->contact;
  SbRingCount *count = &ring->count;
  SbRingLoad start = contact->is.now;
  bool sealed = path == SB_RING_SEALED;
  double part = 1.0 / fmax(sealed ? SEALED_PARTS : 1.0, parts(&start, target));
  double least = part * (sealed ? SEALED_LEAST : STEP_LEAST);
  double done = 0.0, share = part;
  int transients = 0, first = count->iterations;
  ring->state = SB_RING_SLIDES;
  ring->arc.free = false;
  while (done < 1.0) {
    double next = fmin(1.0, done + share);
    SbRingLoad load = next >= 1.0 ? *target : sb_ring_load_between(&start, target, next);
    sb_ring_save(contact, SB_RING_START);
    contact->is.now = load;
    int before = count->iterations;
    SbStatus status = sb_ring_attempt(ring, path, report);
    if (status == SB_OK) {
      share = count->iterations - before <= 8 ? 2.0 * share : share;
    } else {
      count->rejected++;
    }
    bool stop = status != SB_OK && gives_up(ring, status, count->iterations - first);
    if (status != SB_OK && !stop && path == SB_RING_FOLLOW && share <= 0.25 * part &&
        transients < TRANSIENTS_MAX) {
      transients++;
      sb_ring_save(contact, SB_RING_BEFORE);
      status = pseudo_transient(ring, &load, NULL, report);
      if (status == SB_OK) {
        share = 0.5 * part;
      } else {
        sb_ring_restore(contact, SB_RING_BEFORE);
        stop = gives_up(ring, status, count->iterations - first);
      }
    }
    if (status == SB_OK) {
      done = next;
      count->steps++;
      continue;
    }
    share *= 0.5;
    if (stop || share < least) {
      if (status == SB_ERROR_NOT_CONVERGED) {
        explain(done, report);
      }
      sb_ring_contact_settle(contact); // forces and conditions of the present state
      return status;
    }
  }
  return sb_succeed(report);
}
