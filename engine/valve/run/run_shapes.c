// Deformed sections of the rings for the views that draw them, by the finite-strain ring.
//
// One equilibrium for each seal, pressure difference and way of sliding: fitted and pressed first,
// then dragged by the seal's own friction as a uniform shear on the bore contact, held by Coulomb
// friction on floor and wall. Where the drag is more than the ring can bear without rolling, the
// last equilibrium on the way is kept; the part of the force that it bears, its turn, and whether
// it rolls are told.
//
// A row of them for the inner ring while the land's edge and the chamfer beside it pass over it,
// until the free ring clears the chamfer. Friction on floor and bore holds the ring where it is
// against the chamfer's push; neither stroke's drag is in it, so that one row serves both. A frame
// takes the last one whose land reaches at least as far over the ring as the frame's own: the drawn
// ring never stands in the housing, and the gap that this leaves is at most the chamfer's rise over
// one place of the row. That the chamfer still presses the ring when its contact has left the land
// is drawn, but has no part in the cycle's forces.
//
// Frames only refer to shapes, so that a film of any length costs the same.
#include "engine/contact/ring/ring.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <stdlib.h>

// Friction of rubber on the plastic of groove floor and wall, for the drawing only.
static const double floor_friction = 0.3;
static const double wall_friction = 0.1;
// Of the force that the drawn ring bears, over its friction, before it is told.
static const double drag_tolerance = 0.02;
// Of the row over the land's edge: less on the floor lets the chamfer push the ring to its wall.
static const double edge_floor_friction = 0.5;
static const double edge_bore_friction = 0.2;

typedef struct {
  const SbRunHooks *hooks;
} Poll;

static bool poll(void *data) {
  const Poll *p = data;
  return p->hooks != NULL && p->hooks->cancelled != NULL && p->hooks->cancelled(p->hooks->data);
}

static uint32_t slot(int seal, int index) {
  return (uint32_t)(seal * SB_RUN_SEAL_SHAPES + index);
}

// The last place of the land's edge that is not beyond s; -1 before the first. SB_RUN_EDGES: the
// ring is free.
static int edge_of(const SbRun *run, double s) {
  double begin = run->edge_begin;
  double end = run->edge_end;
  double edge = begin + s - run->model.land_edge;
  if (!(end > begin) || edge < begin) {
    return -1;
  }
  return edge >= end ? SB_RUN_EDGES : (int)((edge - begin) / (end - begin) * SB_RUN_EDGES);
}

uint32_t sb_run_shape_index(const SbRun *run, int seal, SbChamber chamber, int motion, double s) {
  if (!run->plan.section_fields) {
    return UINT32_MAX;
  }
  int index = (int)chamber * SB_RUN_MOTIONS + motion;
  int edge = seal == SB_INNER ? edge_of(run, s) : -1;
  // A place without a solution takes the one before.
  while (edge >= 0 && edge < SB_RUN_EDGES &&
         run->shape[slot(seal, SB_RUN_SHAPE_EDGE + edge)].view.nodes == 0) {
    edge--;
  }
  if (edge >= 0) {
    index = edge < SB_RUN_EDGES ? SB_RUN_SHAPE_EDGE + edge : SB_RUN_SHAPE_FREE;
  }
  uint32_t found = run->shape_slot[slot(seal, index)];
  return found < SB_RUN_SHAPES && run->shape[found].view.nodes > 0 ? found : UINT32_MAX;
}

// Copies the present state of a ring into a slot.
static SbStatus keep(SbRun *run, uint32_t index, const SbRing *ring, double floor_radius,
                     SbReport *report) {
  int nodes;
  int triangles;
  int outline;
  sb_ring_sizes(ring, &nodes, &triangles, &outline);
  size_t n = (size_t)nodes;
  SbRunShape *shape = &run->shape[index];
  double *work = malloc(8 * n * sizeof *work);
  shape->real = malloc(2 * n * sizeof *shape->real);
  shape->floats = malloc(SB_FIELD_COUNT * n * sizeof *shape->floats);
  shape->integers = malloc((3 * (size_t)triangles + (size_t)outline) * sizeof *shape->integers);
  if (work == NULL || shape->real == NULL || shape->floats == NULL || shape->integers == NULL) {
    free(work);
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a ring's shape");
  }
  SbRingFields fields = {
      .place = shape->real,
      .displacement = work,
      .mises = work + 2 * n,
      .hydrostatic = work + 3 * n,
      .shear = work + 4 * n,
      .contact = work + 5 * n,
      .triangle = shape->integers,
      .outline = shape->integers + 3 * triangles,
  };
  sb_ring_fields(ring, &fields);
  for (size_t i = 0; i < n; i++) {
    shape->real[2 * i + 1] -= floor_radius;
    shape->floats[SB_FIELD_VON_MISES * n + i] = (float)fields.mises[i];
    shape->floats[SB_FIELD_HYDROSTATIC * n + i] = (float)-fields.hydrostatic[i];
    shape->floats[SB_FIELD_SHEAR * n + i] = (float)fields.shear[i];
    shape->floats[SB_FIELD_CONTACT * n + i] = (float)fields.contact[i];
    shape->floats[SB_FIELD_DISPLACEMENT * n + i] =
        (float)hypot(fields.displacement[2 * i], fields.displacement[2 * i + 1]);
  }
  free(work);
  SbRingResult result;
  sb_ring_result(ring, &result);
  shape->view = (SbSealShape){
      .nodes = n,
      .triangles = (size_t)triangles,
      .outline = (size_t)outline,
      .place = shape->real,
      .triangle = shape->integers,
      .outline_node = shape->integers + 3 * triangles,
      .contact_left = result.touching ? result.contact_left : 0,
      .contact_right = result.touching ? result.contact_right : 0,
      .load = result.bore_force,
      .drag = result.bore_drag,
  };
  for (int f = 0; f < SB_FIELD_COUNT; f++) {
    shape->view.field[f] = shape->floats + (size_t)f * n;
  }
  run->summary.counters.field_evaluations++;
  return SB_OK;
}

static SbRingBody ring_body(const SbModel *model, int seal) {
  const SbSealModel *s = &model->seal[seal];
  return (SbRingBody){
      .section_diameter = s->section_diameter,
      .inner_diameter = s->inner_diameter,
      .modulus = s->modulus,
      .poisson_ratio = s->poisson_ratio,
      .mooney_share = s->mooney_share,
  };
}

static SbRingLoad ring_load(const SbModel *model, SbSealPressure pressure) {
  SbRingLoad load = SB_RING_LOAD_INIT;
  double low = fmin(pressure.left, pressure.right);
  load.bore_radius = model->bore_diameter / 2;
  load.floor_radius = load.bore_radius - model->radial_space;
  load.wall_left = -model->axial_width / 2;
  load.wall_right = model->axial_width / 2;
  load.pressure_left = pressure.left - low;
  load.pressure_right = pressure.right - low;
  return load;
}

// A step, or as much of it as has an equilibrium; *whole tells which.
static SbStatus step(SbRun *run, SbRing *ring, const SbRingLoad *to, bool *whole,
                     SbReport *report) {
  SbStatus status = sb_ring_step(ring, to, report);
  run->summary.counters.ring_solves++;
  *whole = status == SB_OK;
  return status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY ? status : SB_OK;
}

// Drags the ring by a force [N, in-stroke > 0], as an even shear over the contact, whose area
// changes with it: in shares of the force, the shear by the last two states' secant. *at is the
// state found, with less of the force where the equilibrium ends on the way.
static SbStatus drag(SbRun *run, SbRing *ring, double force, SbRingResult *at, SbReport *report) {
  static const double shares[] = {0.5, 0.8, 1, 1, 1};
  sb_ring_result(ring, at);
  SbRingLoad load = *sb_ring_load(ring);
  load.use_bore_traction = true;
  double width = at->contact_right - at->contact_left;
  double rate = 1 / (run->model.bore_circumference * width), shear = 0, borne = 0;
  bool goes_on = at->touching;
  SbStatus status = SB_OK;
  for (size_t i = 0; i < sizeof shares / sizeof *shares && goes_on && status == SB_OK; i++) {
    load.bore_traction = shear + rate * (shares[i] * force - borne);
    bool whole;
    status = step(run, ring, &load, &whole, report);
    sb_ring_result(ring, at);
    double reached = sb_ring_load(ring)->bore_traction;
    rate = at->bore_drag != borne ? (reached - shear) / (at->bore_drag - borne) : 0;
    shear = reached;
    borne = at->bore_drag;
    goes_on =
        at->touching && fabs(borne / force - 1) > drag_tolerance && (whole || borne / force > 1);
  }
  return status;
}

// At rest, dragged by the in-stroke, dragged by the return, for one seal and chamber state.
static SbStatus solve_dragged(SbRun *run, int seal, SbChamber chamber, Poll *hooks,
                              SbReport *report) {
  const SbModel *model = &run->model;
  SbRingBody body = ring_body(model, seal);
  SbRingLoad load = ring_load(model, sb_model_seal_pressure(model, seal, chamber));
  load.friction_floor = floor_friction;
  load.friction_wall = wall_friction;
  SbRingOptions options = {.fit_mesh = true, .poll = poll, .poll_data = hooks};
  const int order[SB_RUN_MOTIONS] = {SB_RUN_REST, SB_CYCLE_IN, SB_CYCLE_OUT};
  for (int i = 0; i < SB_RUN_MOTIONS; i++) {
    // Each from the fitted ring, so that one way of sliding does not carry the other's history.
    SbRing *ring = NULL;
    SbStatus status = sb_ring_create(&ring, &body, &load, &options, report);
    run->summary.counters.ring_solves++;
    if (status != SB_OK) {
      return status;
    }
    if (order[i] != SB_RUN_REST) {
      const SbSliding *state = &run->cycle.states.state[seal][chamber][order[i]];
      double force = (order[i] == SB_CYCLE_IN ? 1 : -1) * sb_sliding_friction(state);
      SbRingResult at;
      status = drag(run, ring, force, &at, report);
      if (status == SB_OK && !(fabs(at.bore_drag / force - 1) <= drag_tolerance)) {
        sb_warn_about(&run->summary.warnings, sb_seal_name(seal));
        sb_warn(&run->summary.warnings, "ring-drag", "friction.shear_strength",
                "the drawn %s ring bears %.0f %% of its friction force, turned by %.0f°, then %s",
                sb_seal_name(seal), 100 * at.bore_drag / force, fabs(at.turn) * 180 / M_PI,
                at.state == SB_RING_ROLLS ? "rolls" : "finds no equilibrium");
        sb_warn_about(&run->summary.warnings, NULL);
      }
    }
    if (status == SB_OK) {
      status = keep(run, slot(seal, (int)chamber * SB_RUN_MOTIONS + order[i]), ring,
                    load.floor_radius, report);
    }
    sb_ring_destroy(ring);
    if (status != SB_OK) {
      return status;
    }
  }
  return SB_OK;
}

// The free ring. Returns in *end where the land's edge is when the chamfer just clears it.
static SbStatus solve_free(SbRun *run, Poll *hooks, double *end, SbReport *report) {
  const SbModel *model = &run->model;
  SbRingBody body = ring_body(model, SB_INNER);
  SbRingLoad load = ring_load(model, (SbSealPressure){0});
  SbRingOptions options = {.poll = poll, .poll_data = hooks};
  load.bore_radius += model->seal[SB_INNER].section_diameter;
  SbRing *ring = NULL;
  SbStatus status = sb_ring_create(&ring, &body, &load, &options, report);
  run->summary.counters.ring_solves++;
  uint32_t index = slot(SB_INNER, SB_RUN_SHAPE_FREE);
  if (status == SB_OK) {
    status = keep(run, index, ring, load.floor_radius, report);
  }
  sb_ring_destroy(ring);
  if (status != SB_OK) {
    return status;
  }
  const double *place = run->shape[index].real;
  *end = -HUGE_VAL;
  for (size_t i = 0; i < run->shape[index].view.nodes; i++) {
    double height = place[2 * i + 1] - model->radial_space;
    if (height > 0) {
      double rise = height / tan(load.chamfer_angle);
      *end = fmax(*end, place[2 * i] + rise + load.edge_length / 2);
    }
  }
  return SB_OK;
}

// The inner ring while the edge passes from the left end of its contact until it is free.
static SbStatus solve_edge(SbRun *run, Poll *hooks, SbReport *report) {
  const SbModel *model = &run->model;
  double begin = run->cycle.states.state[SB_INNER][SB_CHAMBER_AT_REST][SB_CYCLE_IN].contact_left;
  double end;
  SbStatus status = solve_free(run, hooks, &end, report);
  if (status != SB_OK) {
    return status;
  }
  SbRingBody body = ring_body(model, SB_INNER);
  SbRingLoad load = ring_load(model, sb_model_seal_pressure(model, SB_INNER, SB_CHAMBER_AT_REST));
  load.friction_floor = edge_floor_friction;
  load.friction_bore = edge_bore_friction;
  SbRingOptions options = {.poll = poll, .poll_data = hooks};
  SbRing *ring = NULL;
  status = sb_ring_create(&ring, &body, &load, &options, report);
  run->summary.counters.ring_solves++;
  for (int i = 0; i < SB_RUN_EDGES && status == SB_OK && end > begin; i++) {
    SbRingLoad edged = load;
    edged.land_left = begin + (double)i / SB_RUN_EDGES * (end - begin);
    bool whole;
    status = step(run, ring, &edged, &whole, report);
    if (status == SB_OK && whole) {
      status = keep(run, slot(SB_INNER, SB_RUN_SHAPE_EDGE + i), ring, load.floor_radius, report);
    }
  }
  sb_ring_destroy(ring);
  if (status == SB_OK && end > begin) {
    run->edge_begin = begin;
    run->edge_end = end;
  }
  return status;
}

// Whether two chamber states put the same pressure step on a seal, so that one solution serves
// both.
static bool same_pressure(const SbModel *model, int seal, SbChamber a, SbChamber b) {
  SbSealPressure p = sb_model_seal_pressure(model, seal, a);
  SbSealPressure q = sb_model_seal_pressure(model, seal, b);
  return p.left - p.right == q.left - q.right;
}

SbStatus sb_run_solve_shapes(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  Poll p = {hooks};
  for (uint32_t i = 0; i < SB_RUN_SHAPES; i++) {
    run->shape_slot[i] = i;
  }
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    for (int chamber = 0; chamber < SB_CYCLE_CHAMBERS; chamber++) {
      if (!run->cycle.states.state[seal][chamber][SB_CYCLE_IN].touches) {
        continue;
      }
      // Reuse an earlier chamber state of equal pressure.
      int before = -1;
      for (int c = 0; c < chamber && before < 0; c++) {
        bool known = run->cycle.states.state[seal][c][SB_CYCLE_IN].touches;
        before =
            known && same_pressure(&run->model, seal, (SbChamber)c, (SbChamber)chamber) ? c : -1;
      }
      if (before >= 0) {
        for (int m = 0; m < SB_RUN_MOTIONS; m++) {
          run->shape_slot[slot(seal, chamber * SB_RUN_MOTIONS + m)] =
              run->shape_slot[slot(seal, before * SB_RUN_MOTIONS + m)];
        }
        continue;
      }
      sb_run_progress(run, hooks,
                      0.3 + 0.7 * (seal * SB_CYCLE_CHAMBERS + chamber) /
                                (SB_SEAL_COUNT * SB_CYCLE_CHAMBERS),
                      0);
      SbStatus status = solve_dragged(run, seal, (SbChamber)chamber, &p, report);
      if (status == SB_OK && seal == SB_INNER && chamber == SB_CHAMBER_AT_REST) {
        status = solve_edge(run, &p, report);
      }
      if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
        return status;
      }
      if (status != SB_OK) {
        sb_warn(&run->summary.warnings, "ring-shape", "models.fit",
                "no solved shape of the %s ring in one of its states: drawn schematically",
                sb_seal_name(seal));
      }
    }
  }
  return sb_succeed(report);
}
