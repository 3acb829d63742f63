// Deformed sections of the rings for the views that draw them: those that the states of contact
// were solved with, and a row of the inner ring over the land's edge.
//
// The row: the inner ring at rest while the land's edge and the chamfer beside it pass over it,
// until the free ring clears the chamfer. Friction on floor and bore holds the ring where it is
// against the chamfer's push; neither stroke's drag is in it, so that one row serves both. A frame
// takes the last one whose land reaches at least as far over the ring as the frame's own, and its
// contact: the drawn ring never stands in the housing, and the gap that this leaves is at most the
// chamfer's rise over one place of the row. That the chamfer still presses the ring when its
// contact has left the land is drawn, but has no part in the cycle's forces.
//
// Frames only refer to shapes, so that a film of any length costs the same.
#include "engine/contact/ring/ring.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <stdlib.h>

// Of the row over the land's edge: less on the floor lets the chamfer push the ring to its wall.
static const double edge_floor_friction = 0.5;
static const double edge_bore_friction = 0.2;

static uint32_t slot(int seal, int index) {
  return (uint32_t)(seal * SB_RUN_SEAL_SHAPES + index);
}

// The last place of the land's edge in the row that is not beyond x; -1 before the first.
// SB_RUN_EDGES: the ring is free.
static int edge_of(const SbRun *run, double x) {
  double share = (x - run->edge_begin) / (run->edge_end - run->edge_begin);
  return !(share >= 0) ? -1 : share >= 1 ? SB_RUN_EDGES : (int)(share * SB_RUN_EDGES);
}

uint32_t sb_run_shape_index(const SbRun *run, int seal, SbChamber chamber, int motion, double s) {
  if (!run->plan.section_fields) {
    return UINT32_MAX;
  }
  double first = run->cycle.state[SB_INNER][SB_CHAMBER_AT_REST][SB_CYCLE_IN].contact_left;
  int edge = seal == SB_INNER && s > 0 ? edge_of(run, first + s - run->model->land_edge) : -1;
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

SbStatus sb_run_keep_shape(SbRun *run, int seal, int index, const SbRing *ring, SbReport *report) {
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
  double floor = sb_ring_load(ring)->floor_radius;
  for (size_t i = 0; i < n; i++) {
    place[2 * i + 1] -= floor;
    field[SB_FIELD_VON_MISES * n + i] = (float)fields.mises[i];
    field[SB_FIELD_HYDROSTATIC * n + i] = (float)-fields.hydrostatic[i];
    field[SB_FIELD_SHEAR * n + i] = (float)fields.shear[i];
    field[SB_FIELD_CONTACT * n + i] = (float)fields.contact[i];
    field[SB_FIELD_DISPLACEMENT * n + i] = (float)hypot(work[2 * i], work[2 * i + 1]);
  }
  free(work);
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
                              .drag = result.bore_drag};
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

SbStatus sb_run_solve_edge(SbRun *run, int seal, SbCounters *counts, const SbRingOptions *options,
                           SbReport *report) {
  const SbModel *model = run->model;
  SbFitProblem problem;
  SbRingBody body;
  SbRingLoad load;
  SbRing *ring;
  SbSealPressure pressure = sb_model_seal_pressure(model, seal, SB_CHAMBER_AT_REST);
  sb_model_fit_problem(&problem, model, seal, pressure.left - pressure.right);
  sb_fit_ring_problem(&body, &load, &problem);
  load.wall_left = -model->axial_width / 2;
  load.wall_right = model->axial_width / 2;
  SbRingLoad free_load = load;
  free_load.bore_radius += model->seal[seal].section_diameter;
  free_load.pressure_left = free_load.pressure_right = 0;
  counts->ring_solves++;
  SbStatus status = sb_ring_create(&ring, &body, &free_load, options, report);
  status = status == SB_OK ? sb_run_keep_shape(run, seal, SB_RUN_SHAPE_FREE, ring, report) : status;
  sb_ring_destroy(ring);
  if (status != SB_OK) {
    return status;
  }
  double begin = run->cycle.state[seal][SB_CHAMBER_AT_REST][SB_RUN_REST].contact_left;
  double end =
      clear_of(&run->shape[slot(seal, SB_RUN_SHAPE_FREE)].view, model->radial_space, &load);
  load.friction_floor = edge_floor_friction;
  load.friction_bore = edge_bore_friction;
  counts->ring_solves++;
  status = sb_ring_create(&ring, &body, &load, options, report);
  for (int i = 0; i < SB_RUN_EDGES && status == SB_OK && end > begin; i++) {
    load.land_left = begin + (double)i / SB_RUN_EDGES * (end - begin);
    counts->ring_solves++;
    counts->field_evaluations++;
    status = sb_ring_step(ring, &load, report);
    // One that has no equilibrium leaves a gap in the row.
    status = status == SB_OK ? sb_run_keep_shape(run, seal, SB_RUN_SHAPE_EDGE + i, ring, report)
             : status == SB_ERROR_NOT_CONVERGED ? SB_OK
                                                : status;
  }
  sb_ring_destroy(ring);
  if (status == SB_OK && end > begin) {
    run->edge_begin = begin;
    run->edge_end = end;
  }
  return status;
}
