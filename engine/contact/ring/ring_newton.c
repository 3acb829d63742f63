// Newton iteration for the ring: consistent tangent, active-set contact, damped corrections.
//
// One iteration assembles, factorises once, takes the correction (shortened if a node would move
// too far or a point turn inside out) and renews the held set from the linear model's reactions. It
// has converged when the balance holds on all free rows, held nodes lie on their surfaces and the
// held set is steady.
//
// A load step is taken in parts whose largest change is moderate, halved where Newton fails. Where
// that is not enough the equilibrium is unstable or far (the land's edge lets the section snap
// through, friction lets go, a wall is reached across the groove): the setting is then held and the
// ring follows in steps of a viscous motion, M c (u_n - u_n-1) + R(u_n) = 0 with reference volume M
// and falling c (pseudo-transient continuation, Kelley and Keyes 1998), friction seeing every step.
// The viscosity is gone at the end, so that what is returned is an equilibrium. A ring that keeps
// moving has none; the report says how it leaves. Leaves out inertia: where several equilibria can
// be reached it is the one of an overdamped motion.
//
// Rolling. What resists the turning of a ring's section is its hoop stress, by nearly the sine of
// the turn, so that the drag it bears is greatest near a quarter turn. Steady sliding was found at
// turns up to 1.55 rad, falling drag from 2.05 rad on (dry and under fluid, with and without
// friction on floor and wall). A section that turns beyond ROLLED has equilibria at a given place
// of the bore still, but rolls on with it at a falling drag: no sliding state, and the step is
// refused. The turn is the mean one of the section's points, followed along the path so that it
// does not wrap.
#include "engine/contact/ring/ring_private.h"

#include <math.h>

// Iterations per load step; few on a sealed path, short of its fold.
enum { ITERATIONS_MAX = 24, SEALED_ITERATIONS = 14 };
enum { SINGLE_AFTER = 14, RECENTRES_MAX = 6, MORE = 10 };

static const double NEARLY = 1e-2;

static const double DET_SHARE = 0.35, DAMPING = 10.0;
static const double RESIDUAL_TOLERANCE = 1e-10, GAP_TOLERANCE = 1e-11, DRIFT_FORCE = 1e-13;

// Far below any elastic stiffness (about 10): it only fixes where a ring that nothing holds axially
// stands. The ring is let drift until the spring is slack, and it vanishes as soon as a wall or
// friction holds.
static const double AXIAL_SPRING = 1e-7;

// Largest nodal correction of one iteration, in section diameters. One that has to be cut shorter
// than STUMBLE of it is a stumble; after so many the solve is given up.
static const double CORRECTION_MAX = 0.15, STUMBLE = 0.1;
enum { STUMBLES_MAX = 4 };

// Whether something holds the ring axially.
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

// Moves the spring's rest to where the ring stands; true if that changed its force.
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
                sb_ring_surface_name(surface), wall ? x[0] - contact->is.now.floor_radius : x[1],
                wall ? "above the floor" : "from its middle", residual);
}

SbStatus sb_ring_newton(SbRing *ring, SbRingPath path, SbReport *report) {
  const int iterations_max = path == SB_RING_SEALED ? SEALED_ITERATIONS : ITERATIONS_MAX;
  SbRingContact *contact = ring->contact;
  SbRingFem *fem = ring->fem;
  int changes = 0, stumbles = 0, recentres = 0;
  bool slack = false;
  double step = 1.0, det_before = 1.0;
  sb_ring_contact_begin(contact);
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
    // A steady contact near its balance may take a little longer.
    bool near = changes == 0 && residual < NEARLY && it < iterations_max + MORE;
    bool spent = it >= iterations_max && !near;
    if (spent || stumbles > STUMBLES_MAX || !isfinite(residual)) {
      fail(contact, residual, changes, it, report);
      if (report != NULL) {
        report->residual = residual;
        report->iteration = it;
      }
      return SB_ERROR_NOT_CONVERGED;
    }
    ring->count.iterations++;
    SbStatus status = sb_ring_fem_solve(fem, report);
    if (status != SB_OK) {
      return status;
    }
    double length = largest(fem->du, 2 * fem->mesh->nodes);
    step = length > CORRECTION_MAX ? CORRECTION_MAX / length : 1.0;
    step = fmin(step, sb_ring_contact_limit(contact));
    sb_ring_fem_save(fem, 0);
    sb_ring_fem_advance(fem, step);
    changes = sb_ring_contact_update(contact, it >= SINGLE_AFTER) + (step < 1.0 ? 1 : 0);
    double damping = DAMPING * (it < 8 ? 1.0 : it < 16 ? 0.1 : 0.01);
    fem->axial_damping = changes > 0 ? damping / fem->mesh->nodes : 0.0;
  }
}

// ---- load steps

// Largest changes of one part: pressure in shear moduli, places in section diameters.
static const double PRESSURE_STEP = 0.8, LAND_STEP = 0.15;

// Viscosities, in shear moduli per section diameter squared: first, least before it is dropped,
// most; and how many steps and droppings are tried.
static const double VISCOSITY = 30.0, VISCOSITY_LEAST = 0.3, VISCOSITY_MOST = 3e4;
enum { TRANSIENT_STEPS = 50, DROPS_MAX = 4, TRANSIENTS_MAX = 3 };

// Newton iterations after which a load step is given up at its next failure.
enum { ITERATIONS_MOST = 1000 };

// Least share of a part before it is given up. Parts of a sealed path at least, and their least
// share: a step that loses the contact went past its fold.
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

// Mean axial place of the section; in *turn its turn since it was free, that of all which look the
// same that is nearest to the last one known.
static double place_of_section(const SbRingContact *contact, double *turn) {
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
  double cross = 0.0, dot = 0.0;
  for (int i = 0; i < mesh->nodes; i++) {
    double a[2], b[2];
    for (int k = 0; k < 2; k++) {
      a[k] = mesh->x[2 * i + k] - then[k] / sum;
      b[k] = mesh->x[2 * i + k] + fem->u[2 * i + k] - now[k] / sum;
    }
    cross += fem->mass[i] * (a[0] * b[1] - a[1] * b[0]);
    dot += fem->mass[i] * (a[0] * b[0] + a[1] * b[1]);
  }
  *turn = contact->is.turn + remainder(atan2(cross, dot) - contact->is.turn, 2.0 * M_PI);
  return now[1] / sum;
}

// Takes the section's turn over from a new equilibrium, unless it cannot be one of the path: turned
// too far in one part, or rolling on.
static SbStatus take_turn(SbRingContact *contact, SbReport *report) {
  double turn;
  (void)place_of_section(contact, &turn);
  if (fabs(turn - contact->is.turn) > TURN_STEP) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "the section turns by %.3g rad at once",
                   turn - contact->is.turn);
  }
  if (fabs(turn) > ROLLED && fabs(turn) > fabs(contact->is.turn)) {
    contact->rolls = true;
    return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                   "the ring rolls: its section has turned by %.3g rad, where no drag holds it",
                   fabs(turn));
  }
  contact->is.turn = turn;
  contact->rolls = false;
  return SB_OK;
}

// Solves at the present load; back to the start of the part where that fails.
static SbStatus attempt(SbRing *ring, SbRingPath path, SbReport *report) {
  SbRingContact *contact = ring->contact;
  SbRingPatch patch;
  SbStatus status = sb_ring_newton(ring, path, report);
  ring->fem->viscosity = 0.0;
  status = status == SB_OK ? take_turn(contact, report) : status;
  if (status == SB_OK && path == SB_RING_SEALED && !sb_ring_patch(ring, SB_RING_BORE, &patch)) {
    status = sb_fail(report, SB_ERROR_NOT_CONVERGED, "the contact is lost");
  }
  if (status != SB_OK) {
    sb_ring_restore(contact, SB_RING_START);
  }
  return status;
}

// Follows the ring at another load from the present state to an equilibrium.
static SbStatus pseudo_transient(SbRing *ring, const SbRingLoad *load, SbReport *report) {
  SbRingContact *contact = ring->contact;
  SbStatus status = SB_ERROR_NOT_CONVERGED;
  double c = VISCOSITY;
  int drops = 0;
  double turn, from = place_of_section(contact, &turn);
  for (int i = 0; i < TRANSIENT_STEPS && c <= VISCOSITY_MOST; i++) {
    bool drop = c < VISCOSITY_LEAST;
    ring->fem->viscosity = drop ? 0.0 : c;
    sb_ring_save(contact, SB_RING_START);
    contact->is.now = *load;
    int before = ring->count.iterations;
    status = attempt(ring, SB_RING_FOLLOW, report);
    if (contact->rolls || status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY ||
        (status == SB_OK && drop)) {
      return status;
    }
    if (status == SB_OK) {
      if (fabs(place_of_section(contact, &turn) - from) > GONE) {
        return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                       "the ring leaves its place, nothing holds it axially");
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

// Keeps the reason and puts before it where equilibrium ended.
static void explain(double done, SbReport *report) {
  if (report == NULL) {
    return;
  }
  SbReport reason = *report;
  (void)sb_fail(report, SB_ERROR_NOT_CONVERGED, "equilibrium lost at %.3g of the step: %.160s",
                done, reason.text);
  report->residual = reason.residual;
  report->iteration = reason.iteration;
}

// Whether a smaller step cannot help either.
static bool gives_up(const SbRingContact *contact, SbStatus status, int iterations) {
  return status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY || contact->rolls ||
         iterations > ITERATIONS_MOST;
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
  contact->rolls = false;
  while (done < 1.0) {
    double next = fmin(1.0, done + share);
    SbRingLoad load = next >= 1.0 ? *target : sb_ring_load_between(&start, target, next);
    sb_ring_save(contact, SB_RING_START);
    contact->is.now = load;
    int before = count->iterations;
    SbStatus status = attempt(ring, path, report);
    if (status == SB_OK) {
      share = count->iterations - before <= 8 ? 2.0 * share : share;
    } else {
      count->rejected++;
    }
    bool stop = status != SB_OK && gives_up(contact, status, count->iterations - first);
    if (status != SB_OK && !stop && path == SB_RING_FOLLOW && share <= 0.25 * part &&
        transients < TRANSIENTS_MAX) {
      transients++;
      sb_ring_save(contact, SB_RING_BEFORE);
      status = pseudo_transient(ring, &load, report);
      if (status == SB_OK) {
        share = 0.5 * part;
      } else {
        sb_ring_restore(contact, SB_RING_BEFORE);
        stop = gives_up(contact, status, count->iterations - first);
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
      sb_ring_contact_settle(contact); // forces and conditions of the state that is kept
      return status;
    }
  }
  return sb_succeed(report);
}
