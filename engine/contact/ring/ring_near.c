// States near a solved one, of another body at another load.
//
// The active set of a dragged ring's contact does not settle if its ends move through the short
// elements of a fitted mesh. Therefore a coarse copy of the solved ring, on a mesh without short
// ends, is solved first as a predictor: its displacement, and the displacement of its contacts. The
// fitted mesh is shifted with the contacts (ring_ends.c), displaced in the same way, and solved,
// with its contact fixed until the balance is nearly reached. If that fails, the solved ring's own
// mesh is moved in parts; if that fails too, the coarse ring is transferred to a fitted mesh. If
// larger elements are sufficient, the coarse copy, or a coarser one, replaces the ring. The last
// solve is the same balance as that of any ring. The path only enters through friction on floor and
// walls, which sees the motion from the solved ring to the new one as monotonic.
//
// Long: the attempts share the coarse copy, its displacement and the transfer to a mesh.
#include "engine/contact/ring/ring_private.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

// Elements of the coarse copy over those of the ring, and of its contacts' ends over those: of
// these the fewest iterations, by trial.
static const double COARSE = 1.5, COARSE_EDGE = 0.5;

// Where elements so much larger than the ring's are enough, the coarse copy is fitted to them: 15
// iterations on fewer elements, where following the ring's own mesh takes 10 to 50 (over 20 states
// of two scenes).
static const double LARGER = 1.3;

// Element size of a second coarse copy divided by that of the fitted mesh. Single nodes of the
// first copy can prevent a solution; with other elements these are other nodes. Of 480 rings after
// random edits of two scenes the first copy failed for 9, of which the second solved 5, in a fifth
// of the time of the path from the free ring.
static const double COARSER = 2.0;

// Largest distance of the contact's ends from the short elements of the mesh, divided by the size
// of the others. From 0.1 to 0.3 loads of a study scatter by 0.11 % and widths by 0.25 % (120
// samples).
static const double OUTGROWN = 0.2;

// Smallest part of a step; the same for a copy that can replace the ring, which is abandoned sooner
// in favour of the next method.
static const double PART_LEAST = 1.0 / 8.0, PART_LARGER = 0.5;

// Residual below which nodes that have no state (they enter and leave the contact alternately)
// remain in contact against a small tension, as on a continuation path.
static const double PASSES = 1e-2;

struct SbRingGuide {
  const SbRing *ring;
  pthread_mutex_t lock; // of what follows, which is made at the first question
  bool made;
  SbRing *coarse;             // NULL: there is none
  SbRingShift *shift, *along; // of the ring's mesh and of the coarse one, by nothing
};

SbStatus sb_ring_guide_create(SbRingGuide **out, const SbRing *ring, SbReport *report) {
  *out = calloc(1, sizeof **out);
  if (*out == NULL || pthread_mutex_init(&(*out)->lock, NULL) != 0) {
    free(*out);
    *out = NULL;
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a ring's coarse copy");
  }
  (*out)->ring = ring;
  return sb_succeed(report);
}

void sb_ring_guide_destroy(SbRingGuide *guide) {
  if (guide != NULL) {
    sb_ring_destroy(guide->coarse);
    sb_ring_shift_destroy(guide->shift);
    sb_ring_shift_destroy(guide->along);
    pthread_mutex_destroy(&guide->lock);
    free(guide);
  }
}

// Returns the radius of the surface on which a ring is supported.
static double seat(const SbRingLoad *load) {
  return isfinite(load->floor_radius) ? load->floor_radius : load->bore_radius;
}

// Returns the distance of a wall from the plane z = 0, at half the height of the groove.
static double wall_place(const SbRingLoad *load, SbRingSurface wall) {
  const double x[2] = {0.5 * (load->floor_radius + load->bore_radius), 0.0};
  const SbRingFrame frame = sb_ring_frame(load, wall, x);
  return frame.gap / fabs(frame.n[1]);
}

// Returns the displacement, at another load, of the wall on which a ring is supported. *laid: the
// ring was on this wall before friction dragged it.
static double wall_moves(const SbRing *ring, const SbRingLoad *target, bool *laid) {
  const SbRingContact *contact = ring->contact;
  const SbRingLoad *now = &contact->is.now;
  const double pressed = now->pressure_left - now->pressure_right;
  bool left = false, right = false;
  for (int i = 0; i < contact->count; i++) {
    left = left || sb_ring_touch(contact, i, SB_RING_WALL_LEFT)->held;
    right = right || sb_ring_touch(contact, i, SB_RING_WALL_RIGHT)->held;
  }
  const int side = (int)right - (int)left;
  *laid = side * pressed > 0.0 || (now->rests_on_wall && side * now->bore_slides > 0);
  const SbRingSurface wall = side < 0 ? SB_RING_WALL_LEFT : SB_RING_WALL_RIGHT;
  return side != 0 ? side * (wall_place(target, wall) - wall_place(now, wall)) : 0.0;
}

// Moves a ring that was on its wall initially together with the wall.
static double along_wall(const SbRing *ring, const SbRingLoad *target) {
  bool laid;
  const double moves = wall_moves(ring, target, &laid);
  return laid ? moves : 0.0;
}

double sb_ring_travel_fault(const SbRing *ring, const SbRingLoad *target) {
  const SbRingContact *contact = ring->contact;
  const SbRingLoad *now = &contact->is.now;
  bool laid;
  const double moves = fabs(wall_moves(ring, target, &laid));
  const double travel = 0.5 * (now->wall_right - now->wall_left) - ring->outline.half;
  double floor = 0.0;
  if (laid || !(moves > 0.0) || now->bore_slides == 0) {
    return 0.0;
  }
  for (int i = 0; i < contact->count; i++) {
    floor += sb_ring_touch(contact, i, SB_RING_FLOOR)->force;
  }
  return now->friction_floor * fmax(floor, 0.0) * (moves < travel ? moves / travel : 1.0);
}

// Sets the state of another mesh with the same nodes: displacements that leave the ring in its
// position on floor and wall, and its contact.
static void lay_alike(SbRing *to, const SbRing *from, const SbRingLoad *target,
                      const SbRingShift *shift) {
  const double rise = seat(target) - seat(&from->contact->is.now);
  const double along = along_wall(from, target);
  SbRingFem *fem = to->fem;
  SbRingContactState *is = &to->contact->is;
  for (int i = 0; i < fem->mesh->nodes; i++) {
    double x[2], more[2] = {0.0}, place[2];
    sb_ring_fem_place(from->fem, i, place);
    if (shift != NULL) {
      sb_ring_shift_node(shift, from, i, x, more);
    }
    fem->u[2 * i] = place[0] + rise + more[0] - fem->mesh->x[2 * i];
    fem->u[2 * i + 1] = place[1] + along + more[1] - fem->mesh->x[2 * i + 1];
  }
  memcpy(fem->inner, from->fem->inner,
         sizeof(double) * SB_RING_INNER * (size_t)fem->mesh->elements);
  memcpy(is->touch, from->contact->is.touch,
         sizeof *is->touch * SB_RING_SURFACES * (size_t)to->contact->count);
  is->turn = from->contact->is.turn;
  memcpy(is->crest, from->contact->is.crest, sizeof is->crest);
  is->excess = from->contact->is.excess;
}

// Shifts a copy of a ring's mesh.
static void shift_mesh(SbRingMesh *mesh, const SbRing *ring, const SbRingShift *shift) {
  for (int i = 0; i < mesh->nodes; i++) {
    double x[2], place[2];
    sb_ring_shift_node(shift, ring, i, x, place);
    mesh->x[2 * i] += x[0];
    mesh->x[2 * i + 1] += x[1];
  }
  for (int i = 0; i < mesh->loop_count; i++) {
    mesh->angle[i] += sb_ring_shift_angle(shift, mesh->angle[i]);
  }
}

// Returns whether the effect of friction on floor and walls between two loads is below the error of
// a ring dragged from scratch: loads are within 0.3 % of it over these changes. A ring without drag
// has no such effect.
static bool is_near(const SbRingLoad *a, const SbRingLoad *b) {
  static const double PRESSURE = 0.35, PRESSURE_LEAST = 0.1, SPACE = 0.03, FAR = 3.0;
  const double before = a->pressure_left - a->pressure_right;
  const double after = b->pressure_left - b->pressure_right;
  const double space = (a->bore_radius - a->floor_radius) - (b->bore_radius - b->floor_radius);
  const double times = b->bore_slides != 0 ? 1.0 : FAR;
  const double most = fmax(PRESSURE * fabs(before), before != 0.0 ? PRESSURE_LEAST : 0.0);
  return a->groove == b->groove && fabs(after - before) <= times * most &&
         fabs(space) <= times * SPACE;
}

// Solves at a load, if necessary with single nodes fixed in contact.
static SbStatus attempt(SbRing *ring, const SbRingLoad *load, SbReport *report) {
  ring->contact->is.now = *load;
  SbStatus status = sb_ring_attempt(ring, SB_RING_DIRECT, report);
  if (status == SB_ERROR_NOT_CONVERGED && report->residual < PASSES) {
    ring->contact->is.now = *load;
    ring->passing = true;
    status = sb_ring_attempt(ring, SB_RING_DIRECT, report);
    ring->passing = false;
  }
  return status;
}

// A friction law between two others.
typedef struct {
  SbRingShear shear[2];
  const void *law[2];
  double part;
} LawBetween;

static double shear_between(double pressure, double *slope, const void *law) {
  const LawBetween *on = law;
  double before;
  const double from = on->shear[0](pressure, &before, on->law[0]);
  const double to = on->shear[1](pressure, slope, on->law[1]);
  *slope = before + on->part * (*slope - before);
  return from + on->part * (to - from);
}

// Puts a law in place of that of every load that a ring remembers.
static void take_law(SbRing *ring, SbRingShear shear, const void *law) {
  SbRingContact *contact = ring->contact;
  contact->is.now.shear = shear;
  contact->is.now.law = law;
  for (size_t i = 0; i < sizeof contact->saved / sizeof *contact->saved; i++) {
    contact->saved[i].now.shear = shear;
    contact->saved[i].now.law = law;
  }
}

// Steps from one load to another, in one step or in parts of at least the given size.
// SB_RING_BEFORE is the initial position.
static SbStatus go_near(SbRing *ring, const SbRingLoad *from, const SbRingLoad *to, double least,
                        SbReport *report) {
  SbRingLoad start = *from;
  start.floor_radius = to->floor_radius; // its position
  start.bore_radius += seat(to) - seat(from);
  start.wall_left += along_wall(ring, to);
  start.wall_right += along_wall(ring, to);
  LawBetween between = {{from->shear, to->shear}, {from->law, to->law}, 0.0};
  const bool law = from->shear != NULL && to->shear != NULL;
  start.shear = to->shear;
  start.law = to->law;
  ring->contact->is.now = start;
  sb_ring_save(ring->contact, SB_RING_BEFORE);
  SbStatus status = SB_OK;
  double done = 0.0, share = 1.0;
  while (done < 1.0 && share >= least) {
    const double next = fmin(1.0, done + share);
    SbRingLoad load = next < 1.0 ? sb_ring_load_between(&start, to, next) : *to;
    if (law && next < 1.0) {
      between.part = next;
      load.shear = shear_between;
      load.law = &between;
    }
    sb_ring_save(ring->contact, SB_RING_START);
    status = attempt(ring, &load, report);
    ring->count.steps++;
    if (status == SB_OK) {
      done = next;
    } else if (status == SB_ERROR_NOT_CONVERGED) {
      share *= 0.5;
    } else {
      break;
    }
  }
  take_law(ring, to->shear, to->law);
  return status;
}

// Returns whether another body's free section is this one's but for its size.
static bool same_outline(const SbRing *ring, const SbRingBody *body) {
  SbRingOutline other;
  if (ring->body.profile.kind != body->profile.kind) {
    return false;
  }
  if (body->profile.kind == SB_SEAL_PROFILE_CIRCLE) {
    return true;
  }
  bool same =
      sb_ring_outline_of_profile(&other, &body->profile, body->section_diameter, NULL) == SB_OK &&
      other.count == ring->outline.count;
  for (int i = 0; i < other.count && same; i++) {
    const SbRingOutlinePart *a = &ring->outline.part[i], *b = &other.part[i];
    same = fabs(a->at - b->at) < 1e-12 && hypot(a->to[0] - b->to[0], a->to[1] - b->to[1]) < 1e-12;
  }
  return same;
}

SbStatus sb_ring_create_moved(SbRing **out, const SbRing *ring, const SbRingBody *body,
                              const SbRingLoad *load, const SbRingOptions *options,
                              const SbRingShift *shift, SbReport *report) {
  SbRing *other = NULL;
  *out = NULL;
  SbStatus status = sb_ring_check(body, load, report);
  if (status == SB_OK && !same_outline(ring, body)) {
    status = sb_fail(report, SB_ERROR_NOT_CONVERGED, "the ring near it has another profile");
  }
  if (status == SB_OK && (ring->state != SB_RING_SLIDES || ring->arc.free ||
                          ring->contact->is.now.bore_slides != load->bore_slides)) {
    status = sb_fail(report, SB_ERROR_NOT_CONVERGED,
                     "the ring that starts it slides in another direction");
  }
  status = status == SB_OK ? sb_ring_create_like(&other, ring, report) : status;
  if (status != SB_OK) {
    return status;
  }
  const double size = ring->options.element_size;
  other->options = *options;
  other->options.element_size = size;
  sb_ring_set_body(other, body, load);
  status = sb_ring_mesh_copy(&other->mesh, ring->mesh, other->centre - ring->centre, report);
  if (status == SB_OK && shift != NULL) {
    shift_mesh(other->mesh, ring, shift);
    for (int k = 0; k < 2; k++) {
      other->fitted_end[k] += sb_ring_shift_angle(shift, ring->fitted_end[k]);
    }
  }
  status = status == SB_OK ? sb_ring_build_on_mesh(other, report) : status;
  if (status != SB_OK) {
    sb_ring_destroy(other);
    return status;
  }
  const SbRingLoad target = sb_ring_load_in(load, other->length, other->stress);
  lay_alike(other, ring, &target, shift);
  other->contact->is.now = target;
  *out = other;
  return SB_OK;
}

// Creates the coarse copy, if there can be one. The caller has locked the mutex. The copy is not
// cancelled, because all callers use it.
static void make_coarse(SbRingGuide *guide) {
  const SbRing *ring = guide->ring;
  guide->made = true;
  if (!(ring->fitted_size > 0.0) || sb_ring_create_like(&guide->coarse, ring, NULL) != SB_OK) {
    return;
  }
  guide->coarse->options.poll = NULL;
  SbStatus status =
      sb_ring_remesh(guide->coarse, ring, COARSE * ring->fitted_size, COARSE_EDGE, NULL);
  if (status == SB_OK) {
    guide->shift = sb_ring_shift_create(ring);
    guide->along = sb_ring_shift_create(guide->coarse);
  }
  if (guide->shift == NULL || guide->along == NULL) {
    sb_ring_destroy(guide->coarse);
    guide->coarse = NULL;
    return;
  }
  sb_ring_shift_begin(guide->shift, ring);
  sb_ring_shift_begin(guide->along, guide->coarse);
}

void sb_ring_guide_make(SbRingGuide *guide) {
  pthread_mutex_lock(&guide->lock);
  if (!guide->made) {
    make_coarse(guide);
  }
  pthread_mutex_unlock(&guide->lock);
}

// Displaces a ring in its initial position by the displacement of another one since its own initial
// position (its SB_RING_BEFORE).
static SbStatus displace(SbRing *ring, const SbRing *way, SbReport *report) {
  const int nodes = way->fem->mesh->nodes;
  double *by = malloc(sizeof(double) * 2 * (size_t)nodes);
  double *here = malloc(sizeof(double) * 2 * (size_t)ring->fem->mesh->nodes);
  if (by == NULL || here == NULL) {
    free(by);
    free(here);
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a ring's displacement");
  }
  for (int i = 0; i < 2 * nodes; i++) {
    by[i] = way->fem->u[i] - way->fem->saved[SB_RING_BEFORE][i];
  }
  sb_ring_fem_interpolate(here, ring->fem->mesh, by, way->fem->mesh);
  for (int i = 0; i < 2 * ring->fem->mesh->nodes; i++) {
    ring->fem->u[i] += here[i];
  }
  free(by);
  free(here);
  return SB_OK;
}

// Solves a ring in its initial position from the displacement of another one; `passing`: with
// single nodes fixed in contact.
static SbStatus go_along(SbRing *ring, const SbRing *way, bool passing, SbReport *report) {
  SbStatus status = displace(ring, way, report);
  if (status == SB_OK) {
    ring->contact->fixed = !passing;
    ring->passing = passing;
    status = sb_ring_attempt(ring, SB_RING_DIRECT, report);
    ring->contact->fixed = ring->passing = false;
  }
  return status;
}

// Solves the ring on its mesh, shifted and displaced like the coarse one.
static SbStatus follow(SbRing **out, SbRingGuide *guide, const SbRing *way, const SbRingBody *body,
                       const SbRingLoad *load, const SbRingOptions *options, SbReport *report) {
  SbRing *other;
  SbRingShift shift = *guide->shift, along = *guide->along;
  const bool follows = sb_ring_shift_follow(&along, way) && sb_ring_shift_like(&shift, &along);
  *out = NULL;
  SbStatus status = sb_ring_create_moved(&other, guide->ring, body, load, options,
                                         follows ? &shift : NULL, report);
  if (status != SB_OK) {
    return status;
  }
  sb_ring_save(other->contact, SB_RING_START);
  status = go_along(other, way, false, report);
  if (status == SB_ERROR_NOT_CONVERGED && report->residual < PASSES) {
    status = go_along(other, way, true, report);
  }
  other->count.steps++;
  if (status != SB_OK) {
    sb_ring_destroy(other);
    return status;
  }
  *out = other;
  return SB_OK;
}

// Returns whether elements much larger than the solved ring's are sufficient, if its mesh was
// fitted to its contacts; other rings have large elements already.
static bool takes_larger(const SbRing *ring, const SbRingBody *body, const SbRingLoad *load,
                         const SbRingOptions *options) {
  return ring->fitted_size > 0.0 &&
         sb_ring_fit_size(body, load, options->tolerance) > LARGER * ring->fitted_size;
}

// Fits the mesh to the contact again: directly on one of three meshes, else like that of any ring.
// The second mesh starts from scratch.
static SbStatus fit_larger(SbRing *way, double size, SbReport *report) {
  way->at_once = true;
  SbStatus status = sb_ring_refit(way, size, report);
  way->at_once = false;
  return status == SB_ERROR_NOT_CONVERGED ? sb_ring_refit(way, size, report) : status;
}

// A coarse copy in the ring's place, on a mesh of its own that is fitted to the contact.
static SbStatus near_copy(SbRing **out, const SbRing *copy, const SbRingBody *body,
                          const SbRingLoad *load, const SbRingOptions *options, SbReport *report) {
  SbRing *way;
  *out = NULL;
  SbStatus status = sb_ring_create_moved(&way, copy, body, load, options, NULL, report);
  if (status == SB_OK) {
    const SbRingLoad target = way->contact->is.now;
    status = go_near(way, &copy->contact->is.now, &target, PART_LARGER, report);
  }
  if (status == SB_OK) {
    status = fit_larger(way, sb_ring_fit_size(body, load, options->tolerance), report);
  }
  if (status != SB_OK) {
    sb_ring_destroy(way);
    return status;
  }
  *out = way;
  return sb_succeed(report);
}

// The coarse copy in the ring's place, or a coarser one.
static SbStatus near_larger(SbRing **out, SbRingGuide *guide, const SbRingBody *body,
                            const SbRingLoad *load, const SbRingOptions *options,
                            SbReport *report) {
  sb_ring_guide_make(guide);
  SbStatus status = SB_ERROR_NOT_CONVERGED;
  if (guide->coarse != NULL) {
    status = near_copy(out, guide->coarse, body, load, options, report);
  }
  if (status != SB_ERROR_NOT_CONVERGED) {
    return status;
  }
  SbRing *copy;
  status = sb_ring_create_like(&copy, guide->ring, report);
  if (status == SB_OK) {
    copy->options.poll = options->poll;
    copy->options.poll_data = options->poll_data;
    const double size = COARSER * guide->ring->fitted_size;
    status = sb_ring_remesh(copy, guide->ring, size, COARSE_EDGE, report);
  }
  if (status == SB_OK) {
    status = near_copy(out, copy, body, load, options, report);
  }
  sb_ring_destroy(copy);
  return status;
}

// Solves by the coarse copy. If only the copy succeeds, the caller gets it in *kept, owned.
static SbStatus near_guided(SbRing **out, SbRing **kept, SbRingGuide *guide, const SbRingBody *body,
                            const SbRingLoad *load, const SbRingOptions *options,
                            SbReport *report) {
  SbRing *way;
  *out = *kept = NULL;
  sb_ring_guide_make(guide);
  if (guide->coarse == NULL) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "the ring has no coarse copy");
  }
  SbStatus status = sb_ring_create_moved(&way, guide->coarse, body, load, options, NULL, report);
  if (status != SB_OK) {
    return status;
  }
  const SbRingLoad target = way->contact->is.now;
  status = go_near(way, &guide->coarse->contact->is.now, &target, PART_LEAST, report);
  const bool arrived = status == SB_OK;
  status = arrived ? follow(out, guide, way, body, load, options, report) : status;
  if (status == SB_OK) {
    (*out)->count.iterations += way->count.iterations;
  }
  if (arrived && status == SB_ERROR_NOT_CONVERGED) {
    *kept = way;
  } else {
    sb_ring_destroy(way);
  }
  return status;
}

// From the solved ring's state, on its own mesh.
static SbStatus near_alike(SbRing **out, const SbRing *ring, const SbRingBody *body,
                           const SbRingLoad *load, const SbRingOptions *options, SbReport *report) {
  SbRing *other;
  *out = NULL;
  SbStatus status = sb_ring_create_moved(&other, ring, body, load, options, NULL, report);
  if (status != SB_OK) {
    return status;
  }
  const SbRingLoad target = other->contact->is.now;
  status = go_near(other, &ring->contact->is.now, &target, PART_LEAST, report);
  if (status != SB_OK) {
    sb_ring_destroy(other);
    return status;
  }
  *out = other;
  return SB_OK;
}

SbStatus sb_ring_near(SbRing **out, const SbRing *ring, SbRingGuide *guide, const SbRingBody *body,
                      const SbRingLoad *load, const SbRingOptions *options, SbReport *report) {
  SbRing *other = NULL, *way = NULL;
  SbReport own; // of what is tried
  *out = NULL;
  SbStatus status = sb_ring_check(body, load, report);
  if (status != SB_OK) {
    return status;
  }
  const double d = body->section_diameter;
  const double mu = body->modulus / (2.0 * (1.0 + body->poisson_ratio));
  const SbRingLoad target = sb_ring_load_in(load, d, mu);
  if (!is_near(&ring->contact->is.now, &target)) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "the ring is not near");
  }
  if (guide != NULL && takes_larger(ring, body, load, options)) {
    status = near_larger(&other, guide, body, load, options, &own);
  } else {
    status = guide != NULL ? near_guided(&other, &way, guide, body, load, options, &own)
                           : SB_ERROR_NOT_CONVERGED;
    if (status == SB_ERROR_NOT_CONVERGED) {
      status = near_alike(&other, ring, body, load, options, &own);
    }
    if (status == SB_ERROR_NOT_CONVERGED && way != NULL) {
      status = sb_ring_refit(way, ring->fitted_size, &own);
      if (status == SB_OK) {
        other = way;
        way = NULL;
      }
    }
    sb_ring_destroy(way);
  }
  // If the finer ends of the mesh are no longer at the contact's ends: fitted again, unless that
  // fails.
  if (status == SB_OK && sb_ring_outgrown(other, OUTGROWN)) {
    status = sb_ring_refit(other, other->fitted_size, &own);
    status = status == SB_ERROR_NOT_CONVERGED ? SB_OK : status;
  }
  if (status != SB_OK) {
    sb_ring_destroy(other);
    if (report != NULL) {
      *report = own;
    }
    return status;
  }
  *out = other;
  return sb_succeed(report);
}
