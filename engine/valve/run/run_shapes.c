// Deformed sections of the rings for the views that draw them: those of the solved states of
// contact, and a row of the inner ring over the land's edge.
//
// There is a row for each direction of sliding: the inner ring while the land's edge and the
// adjacent chamfer pass over it, until the free ring clears the chamfer. It begins with the sliding
// ring. From then on nodes in contact are fixed, so that the shear of sliding remains, and the
// floor supports the ring against the chamfer's push. (Steady sliding over the chamfer does not
// exist: it pushes the ring away.) A ring that rolls begins with the one at rest. A frame uses the
// last shape whose land covers at least as much of the ring as the frame's land, and its contact.
// So the drawn ring never penetrates the housing, and the remaining gap is at most the chamfer's
// rise over one position of the row. The pressure of the chamfer on the ring after its contact has
// left the land is drawn, but does not affect the cycle's forces.
//
// Frames only refer to shapes, so a film of any length costs the same.
#include "engine/contact/ring/ring.h"
#include "engine/permeation/diffusion.h"
#include "engine/permeation/wetted_ring.h"
#include "engine/valve/run/run_private.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

// Friction of the rows over the land's edge. With less on the floor the chamfer pushes the ring to
// its wall; on the bore it is larger than any law, so that nodes in contact stay where sliding left
// them.
static const double edge_floor_friction = 0.5;
static const double edge_bore_friction = 1.5;

// Side of the rows' contact elements over the section's diameter: they are only drawn.
static const double edge_element_size = 0.08;

// Limit of Newton iterations of one position of a row: 5 to 60 are needed. Over the last part of
// the chamfer the ring may have no equilibrium, which would take hundreds to detect.
enum { PLACE_ITERATIONS = 100 };

// Polls for a cancel, and ends a position that takes too long.
typedef struct {
  const SbRingOptions *asks;
  int left;
} Budget;

static bool spent(void *data) {
  Budget *budget = data;
  return budget->left-- <= 0 || budget->asks->poll(budget->asks->poll_data);
}

static uint32_t slot(int seal, int index) {
  return (uint32_t)(seal * SB_RUN_SEAL_SHAPES + index);
}

// The last place of the land's edge in a row that is not beyond x; -1 before the first.
// SB_RUN_EDGES: the ring is free.
static int edge_of(const SbRunEdge *edge, double x) {
  double share = (x - edge->begin) / (edge->end - edge->begin);
  return !(share >= 0) ? -1 : share >= 1 ? SB_RUN_EDGES : (int)(share * SB_RUN_EDGES);
}

static int edge_shape(int way, int place) {
  return place >= SB_RUN_EDGES ? SB_RUN_SHAPE_FREE : SB_RUN_SHAPE_EDGE + way * SB_RUN_EDGES + place;
}

uint32_t sb_run_shape_over_edge(const SbRun *run, int way, double s) {
  if (!sb_valve_type(run->model)->drawn_over_edge) {
    return slot(SB_INNER, SB_RUN_SHAPE_FREE);
  }
  double first = run->cycle.state[SB_INNER][SB_CHAMBER_AT_REST][SB_CYCLE_IN].contact_left;
  int place = edge_of(&run->edge[way], first + s - run->model->land_edge);
  // A place without a solution takes the one before.
  while (place >= 0 && run->shape[slot(SB_INNER, edge_shape(way, place))].view.nodes == 0) {
    place--;
  }
  return place >= 0 ? slot(SB_INNER, edge_shape(way, place)) : UINT32_MAX;
}

uint32_t sb_run_shape_index(const SbRun *run, int seal, SbChamber chamber, int motion) {
  if (!run->plan.section_fields) {
    return UINT32_MAX;
  }
  int alike = sb_run_first_equal_chamber(run, seal, (int)chamber);
  uint32_t found = slot(seal, alike * SB_RUN_MOTIONS + motion);
  return run->shape[found].view.nodes > 0 ? found : UINT32_MAX;
}

// Computes the steady flux of permeation through a ring that separates canister and air; 0 of one
// that does not, or that is open.
static void fill_permeation(float *out, const SbRun *run, int seal, const SbRing *ring, size_t n) {
  SbWettedMesh *mesh = NULL;
  SbDiffusion *diffusion = NULL;
  double *flux = malloc((n + 1) * sizeof *flux);
  bool solved = flux != NULL && run->plan.permeation && seal == sb_shelf_seal(run->model) &&
                sb_wetted_ring_create(&mesh, ring, false, NULL) == SB_OK;
  if (solved) {
    sb_wetted_mesh_quarter(mesh);
    solved = sb_diffusion_create(&diffusion, mesh, NULL) == SB_OK &&
             sb_diffusion_gradient(flux, diffusion, NULL) == SB_OK;
  }
  for (size_t i = 0; i < n; i++) {
    out[i] = solved ? (float)flux[i] : 0;
  }
  sb_diffusion_destroy(diffusion);
  sb_wetted_mesh_destroy(mesh);
  free(flux);
}

SbStatus sb_run_store_shape(SbRun *run, int seal, int index, const SbRing *ring, SbReport *report) {
  SbRunShape *shape = &run->shape[slot(seal, index)];
  int nodes, triangles, outline;
  sb_ring_sizes(ring, &nodes, &triangles, &outline);
  size_t n = (size_t)nodes, corners = 3 * (size_t)triangles;
  double *work = malloc(6 * n * sizeof *work);
  double *place = malloc(2 * n * sizeof *place + SB_FIELD_COUNT * n * sizeof(float) +
                         (corners + (size_t)outline) * sizeof(int));
  if (work == NULL || place == NULL) {
    free(work);
    free(place);
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a ring's shape");
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
  sb_ring_fields(ring, &fields);
  const SbModel *model = run->model;
  const double floor = sb_valve_type(model)->base_radius(model, sb_ring_load(ring));
  for (size_t i = 0; i < n; i++) {
    place[2 * i + 1] -= floor;
    field[SB_FIELD_VON_MISES * n + i] = (float)fields.mises[i];
    field[SB_FIELD_HYDROSTATIC * n + i] = (float)-fields.hydrostatic[i];
    field[SB_FIELD_SHEAR * n + i] = (float)fields.shear[i];
    field[SB_FIELD_CONTACT * n + i] = (float)fields.contact[i];
    field[SB_FIELD_DISPLACEMENT * n + i] = (float)hypot(work[2 * i], work[2 * i + 1]);
  }
  free(work);
  fill_permeation(field + SB_FIELD_PERMEATION * n, run, seal, ring, n);
  SbRingResult result;
  sb_ring_result(ring, &result);
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
                              .drag = sb_model_way(model) * result.bore_drag};
  for (size_t f = 0; f < SB_FIELD_COUNT; f++) {
    shape->view.field[f] = field + f * n;
  }
  return SB_OK;
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

// The free inner ring: out of the bore, or clamped around the stem's neck.
static SbStatus solve_free(SbRun *run, const SbRingBody *body, SbRingLoad load,
                           const SbRingOptions *options, SbReport *report) {
  SbRing *ring;
  load.bore_radius =
      body->inward ? -0.3 * body->inner_diameter : load.bore_radius + body->section_diameter;
  load.pressure_left = load.pressure_right = 0;
  load.bore_slides = 0;
  load.friction_bore = load.friction_floor = 0;
  load.friction_wall = body->inward ? load.friction_wall : 0;
  SbStatus status = sb_ring_create(&ring, body, &load, options, report);
  status =
      status == SB_OK ? sb_run_store_shape(run, SB_INNER, SB_RUN_SHAPE_FREE, ring, report) : status;
  sb_ring_destroy(ring);
  return status;
}

SbStatus sb_run_solve_edge(SbRun *run, int way, const SbRing *from, SbCounters *counts,
                           const SbRingOptions *options, SbReport *report) {
  const SbRunShape *whole = &run->shape[slot(SB_INNER, SB_RUN_SHAPE_FREE)];
  SbFitProblem problem;
  SbRingBody body;
  SbRingLoad load;
  SbRingResult state;
  sb_model_fit_problem(&problem, run->model, SB_INNER, 0);
  sb_fit_ring_problem(&body, &load, &problem);
  load = *sb_ring_load(from);
  sb_ring_result(from, &state);
  SbStatus status = SB_OK;
  if (whole->view.nodes == 0) {
    counts->ring_solves++;
    counts->field_evaluations++;
    status = solve_free(run, &body, load, options, report);
  }
  if (status != SB_OK || !sb_valve_type(run->model)->drawn_over_edge) {
    return status;
  }
  double begin = state.contact_left;
  // Clear of the free ring, and of the contact that sliding has moved.
  double end = fmax(clear_of(&whole->view, run->model->radial_space, &load),
                    state.contact_right + load.edge_length);
  // Fixed from there on in its position; a ring that rolls: from its position at rest.
  SbRingLoad held = load;
  held.bore_slides = 0;
  held.shear = NULL;
  held.friction_bore = edge_bore_friction;
  held.friction_floor = fmax(load.friction_floor, edge_floor_friction);
  SbRing *ring;
  Budget budget = {options, INT_MAX};
  const SbRingOptions coarse = {
      .element_size = edge_element_size, .drawn = true, .poll = spent, .poll_data = &budget};
  counts->ring_solves++;
  status = state.state == SB_RING_SLIDES ? sb_ring_copy(&ring, from, &coarse, report)
                                         : sb_ring_create(&ring, &body, &held, &coarse, report);
  for (int i = 0; i < SB_RUN_EDGES && status == SB_OK && end > begin; i++) {
    held.land_left = begin + (double)i / SB_RUN_EDGES * (end - begin);
    counts->ring_solves++;
    counts->field_evaluations++;
    budget.left = PLACE_ITERATIONS;
    status = sb_ring_step(ring, &held, report);
    if (status == SB_ERROR_CANCELLED && budget.left < 0) {
      status = SB_ERROR_NOT_CONVERGED;
    }
    status = status == SB_OK ? sb_run_store_shape(run, SB_INNER, edge_shape(way, i), ring, report)
                             : status;
  }
  sb_ring_destroy(ring);
  if (end > begin) {
    run->edge[way] = (SbRunEdge){begin, end};
  }
  // Beyond a position without an equilibrium the last shape is used.
  return status == SB_ERROR_NOT_CONVERGED ? SB_OK : status;
}
