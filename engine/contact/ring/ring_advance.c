// Load steps of the ring: their size, and what to do where the next equilibrium is not near.
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
#include "engine/contact/ring/ring_newton.h"

#include <math.h>

// Largest changes of one part: pressure in shear moduli, places in section diameters. Ends of the
// land outside REACH touch nothing.
static const double PRESSURE_STEP = 0.8, LAND_STEP = 0.15, REACH = 1.5;

// Viscosities, in shear moduli per section diameter squared: first, least before it is dropped,
// most; and how many steps and droppings are tried.
static const double VISCOSITY = 30.0, VISCOSITY_LEAST = 0.3, VISCOSITY_MOST = 3e4;
enum { VISCOUS_STEPS = 50, DROPS_MAX = 4, WALKS_MAX = 3 };

// Newton iterations after which a load step is given up at its next failure.
enum { ITERATIONS_MOST = 1000 };

// A motion beyond which the ring counts as gone, in section diameters; the turn beyond which it
// rolls and the largest one of a part, in radians.
static const double GONE = 1.5, ROLLED = 2.0, TURN_STEP = 0.5;

static double finite_land(double end, double side) {
  return isfinite(end) ? end : side * REACH;
}

// The setting at a share t of the way; discrete choices are the target's. An end of the land that
// is set or removed comes from or goes to where it touches nothing.
static SbRingSetting between(const SbRingSetting *a, const SbRingSetting *b, double t) {
  SbRingSetting s = *b;
#define MIX(field)                                                                                 \
  s.field =                                                                                        \
      isfinite(a->field) && isfinite(b->field) ? a->field + t * (b->field - a->field) : b->field
  MIX(bore);
  MIX(floor);
  MIX(wall_left);
  MIX(wall_right);
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
  if (isfinite(a->land_left) || isfinite(b->land_left)) {
    double from = finite_land(a->land_left, -1.0), to = finite_land(b->land_left, -1.0);
    s.land_left = from + t * (to - from);
  }
  if (isfinite(a->land_right) || isfinite(b->land_right)) {
    double from = finite_land(a->land_right, 1.0), to = finite_land(b->land_right, 1.0);
    s.land_right = from + t * (to - from);
  }
  return s;
}

static double land_way(double from, double to, double side) {
  from = fmin(REACH, fmax(-REACH, finite_land(from, side)));
  to = fmin(REACH, fmax(-REACH, finite_land(to, side)));
  return fabs(to - from);
}

// Number of parts that a load step is first taken in.
static double parts(const SbRingSetting *a, const SbRingSetting *b) {
  double pressure =
      fmax(fabs(b->pressure_left - a->pressure_left), fabs(b->pressure_right - a->pressure_right));
  double land =
      fmax(land_way(a->land_left, b->land_left, -1.0), land_way(a->land_right, b->land_right, 1.0));
  return ceil(fmax(1.0, fmax(pressure / PRESSURE_STEP, land / LAND_STEP)));
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
  *turn = contact->turn + remainder(atan2(cross, dot) - contact->turn, 2.0 * M_PI);
  return now[1] / sum;
}

// Takes the section's turn over from a new equilibrium, unless it cannot be one of the path: turned
// too far in one part, or rolling on.
static SbStatus take_turn(SbRingContact *contact, SbReport *report) {
  double turn;
  (void)place_of_section(contact, &turn);
  if (fabs(turn - contact->turn) > TURN_STEP) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "the section turns by %.3g rad at once",
                   turn - contact->turn);
  }
  if (fabs(turn) > ROLLED && fabs(turn) > fabs(contact->turn)) {
    contact->rolls = true;
    return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                   "the ring rolls: its section has turned by %.3g rad, where no drag holds it",
                   fabs(turn));
  }
  contact->turn = turn;
  contact->rolls = false;
  return SB_OK;
}

// Follows the ring at the present setting from the state before to an equilibrium.
static SbStatus walk(SbRingContact *contact, const SbRingNewton *options, SbRingCount *count,
                     SbReport *report) {
  SbRingFem *fem = contact->fem;
  SbStatus status = SB_ERROR_NOT_CONVERGED;
  double c = VISCOSITY;
  int drops = 0;
  double turn, from = place_of_section(contact, &turn);
  sb_ring_fem_save(fem, 2);
  for (int i = 0; i < VISCOUS_STEPS && c <= VISCOSITY_MOST; i++) {
    bool drop = c < VISCOSITY_LEAST;
    fem->viscosity = drop ? 0.0 : c;
    sb_ring_fem_save(fem, 1);
    sb_ring_contact_save(contact, 0);
    int before = count->iterations;
    status = sb_ring_newton(contact, options, count, report);
    fem->viscosity = 0.0;
    status = status == SB_OK ? take_turn(contact, report) : status;
    if (contact->rolls || (status == SB_OK && drop)) {
      return status;
    }
    if (status == SB_OK) {
      mark_anchor(contact);
      if (fabs(place_of_section(contact, &turn) - from) > GONE) {
        return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                       "the ring leaves its place, nothing holds it axially");
      }
      int used = count->iterations - before;
      c *= used <= 6 ? 0.3 : used <= 12 ? 0.6 : 1.0;
      continue;
    }
    if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
      return status;
    }
    sb_ring_fem_restore(fem, 1);
    sb_ring_contact_restore(contact, 0);
    if (drop && ++drops >= DROPS_MAX) {
      return status;
    }
    c *= drop ? 10.0 : 8.0;
  }
  return status == SB_OK ? sb_fail(report, SB_ERROR_NOT_CONVERGED, "the ring does not come to rest")
                         : status;
}

// Keeps the reason and puts before it where equilibrium ended.
static void explain(const SbRingContact *contact, double done, SbReport *report) {
  if (report == NULL) {
    return;
  }
  SbReport reason = *report;
  (void)sb_fail(report, SB_ERROR_NOT_CONVERGED, "equilibrium lost at %.3g of the step: %.160s",
                done, reason.text);
  report->residual = reason.residual;
  report->iteration = reason.iteration;
}

SbStatus sb_ring_advance(SbRingContact *contact, const SbRingSetting *target,
                         const SbRingNewton *options, SbRingCount *count, SbReport *report) {
  SbRingFem *fem = contact->fem;
  SbRingSetting start = contact->now;
  double part = 1.0 / parts(&start, target);
  double done = 0.0, share = part;
  int walks = 0, first = count->iterations;
  contact->rolls = false;
  while (done < 1.0) {
    SbRingSetting good = contact->now;
    mark_anchor(contact);
    sb_ring_fem_save(fem, 1);
    sb_ring_contact_save(contact, 0);
    double next = fmin(1.0, done + share);
    contact->now = next >= 1.0 ? *target : between(&start, target, next);
    int before = count->iterations;
    SbStatus status = sb_ring_newton(contact, options, count, report);
    status = status == SB_OK ? take_turn(contact, report) : status;
    if (status == SB_OK) {
      done = next;
      count->steps++;
      int used = count->iterations - before;
      share = used <= 8 ? 2.0 * share : share;
      continue;
    }
    // Back to the last good state and half the step.
    sb_ring_fem_restore(fem, 1);
    sb_ring_contact_restore(contact, 0);
    count->rejected++;
    bool stop = status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY || contact->rolls ||
                count->iterations - first > ITERATIONS_MOST;
    if (!stop && options->walks && share <= 0.25 * part && walks < WALKS_MAX) {
      walks++;
      double turn = contact->turn;
      sb_ring_contact_save(contact, 1);
      status = walk(contact, options, count, report);
      if (status == SB_OK) {
        done = next;
        share = 0.5 * part;
        count->steps++;
        continue;
      }
      sb_ring_fem_restore(fem, 2);
      sb_ring_contact_restore(contact, 1);
      contact->turn = turn;
      stop = status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY || contact->rolls ||
             count->iterations - first > ITERATIONS_MOST;
    }
    contact->now = good;
    share *= 0.5;
    if (stop || share < options->step_least * part) {
      if (status == SB_ERROR_NOT_CONVERGED) {
        explain(contact, done, report);
      }
      // Forces and conditions of the state that is kept.
      mark_anchor(contact);
      sb_ring_contact_settle(contact);
      return status;
    }
  }
  return sb_succeed(report);
}
