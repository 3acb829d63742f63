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

// A row of shapes of one seal in work; `load` is that of the fitted ring.
typedef struct {
  SbRun *run;
  int seal;
  SbRingBody body;
  SbRingLoad load;
  SbRingOptions options;
  SbRing *ring; // NULL before the first
  SbReport *report;
} Task;

static bool poll(void *data) {
  return sb_run_cancelled(data, NULL);
}

static uint32_t slot(int seal, int index) {
  return (uint32_t)(seal * SB_RUN_SEAL_SHAPES + index);
}

// The last place of the land's edge that is not beyond s; -1 before the first. SB_RUN_EDGES: the
// ring is free.
static int edge_of(const SbRun *run, double s) {
  double begin = run->edge_begin;
  double end = run->edge_end;
  double edge = begin + s - run->model->land_edge;
  if (!(end > begin) || edge < begin) {
    return -1;
  }
  return edge >= end ? SB_RUN_EDGES : (int)((edge - begin) / (end - begin) * SB_RUN_EDGES);
}

uint32_t sb_run_shape_index(const SbRun *run, int seal, SbChamber chamber, int motion, double s) {
  if (!run->plan.section_fields) {
    return UINT32_MAX;
  }
  int edge = seal == SB_INNER ? edge_of(run, s) : -1;
  // A place without a solution takes the one before.
  while (edge >= 0 && edge < SB_RUN_EDGES &&
         run->shape[slot(seal, SB_RUN_SHAPE_EDGE + edge)].view.nodes == 0) {
    edge--;
  }
  uint32_t found =
      slot(seal, edge >= 0 ? SB_RUN_SHAPE_EDGE + edge
                           : sb_run_first_alike(run, seal, (int)chamber) * SB_RUN_MOTIONS + motion);
  return run->shape[found].view.nodes > 0 ? found : UINT32_MAX;
}

// Fits a ring of its own; its states are kept from then on.
static SbStatus fit(Task *task) {
  sb_ring_destroy(task->ring);
  task->ring = NULL;
  task->run->summary.counters.ring_solves++;
  return sb_ring_create(&task->ring, &task->body, &task->load, &task->options, task->report);
}

// Copies the present state of the ring into a slot.
static SbStatus keep(Task *task, int index) {
  SbRunShape *shape = &task->run->shape[slot(task->seal, index)];
  int nodes, triangles, outline;
  sb_ring_sizes(task->ring, &nodes, &triangles, &outline);
  size_t n = (size_t)nodes, corners = 3 * (size_t)triangles;
  double *work = malloc(6 * n * sizeof *work);
  double *place = malloc(2 * n * sizeof *place + SB_FIELD_COUNT * n * sizeof(float) +
                         (corners + (size_t)outline) * sizeof(int));
  if (work == NULL || place == NULL) {
    free(work);
    free(place);
    return sb_fail(task->report, SB_ERROR_MEMORY, "no memory for a ring's shape");
  }
  float *field = (float *)(place + 2 * n);
  int *triangle = (int *)(field + SB_FIELD_COUNT * n);
  SbRingFields fields = {.place = place,
                         .displacement = work,
                         .mises = work + 2 * n,
                         .hydrostatic = work + 3 * n,
                         .shear = work + 4 * n,
                         .contact = work + 5 * n,
                         .triangle = triangle,
                         .outline = triangle + corners};
  sb_ring_fields(task->ring, &fields);
  for (size_t i = 0; i < n; i++) {
    place[2 * i + 1] -= task->load.floor_radius;
    field[SB_FIELD_VON_MISES * n + i] = (float)fields.mises[i];
    field[SB_FIELD_HYDROSTATIC * n + i] = (float)-fields.hydrostatic[i];
    field[SB_FIELD_SHEAR * n + i] = (float)fields.shear[i];
    field[SB_FIELD_CONTACT * n + i] = (float)fields.contact[i];
    field[SB_FIELD_DISPLACEMENT * n + i] = (float)hypot(work[2 * i], work[2 * i + 1]);
  }
  free(work);
  SbRingResult result;
  sb_ring_result(task->ring, &result);
  free(shape->data);
  shape->data = place;
  shape->view = (SbSealShape){.nodes = n,
                              .triangles = (size_t)triangles,
                              .outline = (size_t)outline,
                              .place = place,
                              .triangle = triangle,
                              .outline_node = triangle + corners,
                              .contact_left = result.touching ? result.contact_left : 0,
                              .contact_right = result.touching ? result.contact_right : 0,
                              .load = result.bore_force,
                              .drag = result.bore_drag};
  for (size_t f = 0; f < SB_FIELD_COUNT; f++) {
    shape->view.field[f] = field + f * n;
  }
  task->run->summary.counters.field_evaluations++;
  return SB_OK;
}

// A step, or as much of it as has an equilibrium; *whole tells which.
static SbStatus step(Task *task, const SbRingLoad *to, bool *whole) {
  SbStatus status = sb_ring_step(task->ring, to, task->report);
  task->run->summary.counters.ring_solves++;
  *whole = status == SB_OK;
  return status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY ? status : SB_OK;
}

// Drags the ring by a force [N, in-stroke > 0], as an even shear over the contact, whose area
// changes with it: in shares of the force, the shear by the last two states' secant. Where the
// equilibrium ends on the way less of the force is borne.
static SbStatus drag(Task *task, double force) {
  static const double shares[] = {0.5, 0.8, 1, 1, 1};
  SbWarnings *warnings = &task->run->summary.warnings;
  SbRingResult at;
  sb_ring_result(task->ring, &at);
  SbRingLoad load = *sb_ring_load(task->ring);
  load.use_bore_traction = true;
  double width = at.contact_right - at.contact_left;
  double rate = 1 / (task->run->model->bore_circumference * width), shear = 0, borne = 0;
  bool goes_on = at.touching;
  SbStatus status = SB_OK;
  for (size_t i = 0; i < sizeof shares / sizeof *shares && goes_on && status == SB_OK; i++) {
    load.bore_traction = shear + rate * (shares[i] * force - borne);
    bool whole;
    status = step(task, &load, &whole);
    sb_ring_result(task->ring, &at);
    double reached = sb_ring_load(task->ring)->bore_traction;
    rate = at.bore_drag != borne ? (reached - shear) / (at.bore_drag - borne) : 0;
    shear = reached;
    borne = at.bore_drag;
    goes_on =
        at.touching && fabs(borne / force - 1) > drag_tolerance && (whole || borne / force > 1);
  }
  if (status == SB_OK && !(fabs(at.bore_drag / force - 1) <= drag_tolerance)) {
    sb_warn_about(warnings, sb_seal_name(task->seal));
    sb_warn(warnings, "ring-drag", "friction.shear_strength",
            "the drawn %s ring bears %.0f %% of its friction force, turned by %.0f°, then %s",
            sb_seal_name(task->seal), 100 * at.bore_drag / force, fabs(at.turn) * 180 / M_PI,
            at.state == SB_RING_ROLLS ? "rolls" : "finds no equilibrium");
    sb_warn_about(warnings, NULL);
  }
  return status;
}

// At rest, dragged by the in-stroke, dragged by the return, for one chamber state. Each from the
// fitted ring, so that one way of sliding does not carry the other's history.
static SbStatus solve_dragged(Task *task, int chamber) {
  const int order[SB_RUN_MOTIONS] = {SB_RUN_REST, SB_CYCLE_IN, SB_CYCLE_OUT};
  const SbSealState *state = task->run->cycle.state[task->seal][chamber];
  task->options.fit_mesh = true;
  task->load.friction_floor = floor_friction;
  task->load.friction_wall = wall_friction;
  SbStatus status = SB_OK;
  for (int i = 0; i < SB_RUN_MOTIONS && status == SB_OK; i++) {
    status = fit(task);
    if (status == SB_OK && order[i] != SB_RUN_REST) {
      double friction = sb_sliding_friction(&state[order[i]]);
      status = drag(task, order[i] == SB_CYCLE_IN ? friction : -friction);
    }
    status = status == SB_OK ? keep(task, chamber * SB_RUN_MOTIONS + order[i]) : status;
  }
  return status;
}

// Where the land's edge is when the chamfer just clears the free ring.
static double clear_of(const SbSealShape *free_ring, double height, const SbRingLoad *load) {
  double end = -HUGE_VAL;
  for (size_t i = 0; i < free_ring->nodes; i++) {
    double above = free_ring->place[2 * i + 1] - height;
    if (above > 0) {
      double rise = above / tan(load->chamfer_angle);
      end = fmax(end, free_ring->place[2 * i] + rise + load->edge_length / 2);
    }
  }
  return end;
}

// The free inner ring, and the ring while the edge passes from the left end of its contact until it
// is free.
static SbStatus solve_edge(Task *task) {
  SbRun *run = task->run;
  const SbModel *model = run->model;
  const SbRingLoad fitted = task->load;
  task->load.bore_radius += model->seal[task->seal].section_diameter;
  task->load.pressure_left = task->load.pressure_right = 0;
  SbStatus status = fit(task);
  status = status == SB_OK ? keep(task, SB_RUN_SHAPE_FREE) : status;
  task->load = fitted;
  task->load.friction_floor = edge_floor_friction;
  task->load.friction_bore = edge_bore_friction;
  status = status == SB_OK ? fit(task) : status;
  double begin = run->cycle.state[SB_INNER][SB_CHAMBER_AT_REST][SB_CYCLE_IN].contact_left;
  double end = clear_of(&run->shape[slot(task->seal, SB_RUN_SHAPE_FREE)].view, model->radial_space,
                        &task->load);
  for (int i = 0; i < SB_RUN_EDGES && status == SB_OK && end > begin; i++) {
    SbRingLoad edged = task->load;
    edged.land_left = begin + (double)i / SB_RUN_EDGES * (end - begin);
    bool whole;
    status = step(task, &edged, &whole);
    status = status == SB_OK && whole ? keep(task, SB_RUN_SHAPE_EDGE + i) : status;
  }
  if (status == SB_OK && end > begin) {
    run->edge_begin = begin;
    run->edge_end = end;
  }
  return status;
}

// All shapes of a seal that a chamber state needs.
static SbStatus solve_chamber(SbRun *run, int seal, int chamber, const SbRunHooks *hooks,
                              SbReport *report) {
  const SbModel *model = run->model;
  SbFitProblem problem;
  SbSealPressure pressure = sb_model_seal_pressure(model, seal, (SbChamber)chamber);
  sb_model_fit_problem(&problem, model, seal, pressure.left - pressure.right);
  Task task = {.run = run, .seal = seal, .report = report, .options = {.poll = poll}};
  task.options.poll_data = (void *)hooks;
  sb_fit_ring_problem(&task.body, &task.load, &problem);
  task.load.wall_left = -model->axial_width / 2;
  task.load.wall_right = model->axial_width / 2;
  const SbRingLoad fitted = task.load;
  SbStatus status = solve_dragged(&task, chamber);
  if (status == SB_OK && seal == SB_INNER && chamber == SB_CHAMBER_AT_REST) {
    task.load = fitted;
    task.options.fit_mesh = false;
    status = solve_edge(&task);
  }
  sb_ring_destroy(task.ring);
  return status;
}

SbStatus sb_run_solve_shapes(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  const double states = SB_SEAL_COUNT * SB_CYCLE_CHAMBERS;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    for (int chamber = 0; chamber < SB_CYCLE_CHAMBERS; chamber++) {
      if (!run->cycle.state[seal][chamber][SB_CYCLE_IN].touches ||
          sb_run_first_alike(run, seal, chamber) != chamber) {
        continue;
      }
      sb_run_progress(run, hooks, 0.3 + 0.7 * (seal * SB_CYCLE_CHAMBERS + chamber) / states, 0);
      SbStatus status = solve_chamber(run, seal, chamber, hooks, report);
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
