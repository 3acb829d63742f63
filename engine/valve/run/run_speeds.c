// A run's steady states at any speed: one table for each seal, chamber and direction
// (valve/states/speed_states.h), created when an instant first needs a speed other than the
// states'. Equivalent seals, chambers and directions share one.
//
// Between the vented and the filled chamber, contact and film are interpolated between the two at
// the same speed, and friction follows from them. This is exact while the chamber's pressure is
// constant, which is all but the milliseconds of filling and venting.
#include "engine/valve/run/run_errors.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <stdlib.h>

static SbSlidingTask task_of(SbRun *run, int seal, int chamber, int direction, double speed) {
  return (SbSlidingTask){.model = run->model,
                         .seal = seal,
                         .pressure = sb_model_seal_pressure(run->model, seal, (SbChamber)chamber),
                         .speed =
                             sb_model_way(run->model) * (direction == SB_CYCLE_IN ? speed : -speed),
                         .memory = run->memory[seal],
                         .counts = &run->summary.counters,
                         .warnings = &run->summary.warnings,
                         .supply = sb_run_supply(run, seal, (SbChamber)chamber, direction)};
}

static bool same_contact(const SbSealState *a, const SbSealState *b) {
  return a->contact_left == b->contact_left && a->contact_right == b->contact_right &&
         a->load_net == b->load_net;
}

static SbStatus make(SbRun *run, int seal, int chamber, int direction, const SbSlidingBody *body,
                     SbReport *report) {
  SbSpeedStates **table = &run->speeds[seal][chamber][direction];
  const SbSealState *state = &run->cycle.state[seal][chamber][direction];
  const SbSlidingTask task = task_of(run, seal, chamber, direction, run->speed);
  const SbSupply *was = *table != NULL ? &(*table)->task.supply : NULL;
  if (was != NULL && same_contact(&(*table)->base, state) && was->limited == task.supply.limited &&
      was->layer == task.supply.layer) {
    // Its solved states remain valid: the same contact on the same supply, solved at another speed.
    (*table)->base = *state;
    (*table)->task = task;
    (*table)->beside_known = false;
    return SB_OK;
  }
  const size_t solves = *table != NULL ? (*table)->solves : 0;
  *table = *table != NULL ? *table : malloc(sizeof **table);
  if (*table == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for states over the speed");
  }
  sb_speed_states_init(*table, &task, state, body);
  (*table)->solves = solves;
  (*table)->roughness = run->roughness;
  (*table)->near = !run->plan.inertia;
  return SB_OK;
}

SbStatus sb_run_create_speeds(SbRun *run, int seal, int chamber, int direction,
                              const SbSlidingBody *body, SbReport *report) {
  bool there = run->speeds[seal][chamber][direction] != NULL;
  return body != NULL || there ? make(run, seal, chamber, direction, body, report) : SB_OK;
}

enum { TABLES = SB_SEAL_COUNT * SB_CYCLE_CHAMBERS * SB_RUN_REST };

// One of the run's sliding states.
typedef struct {
  int seal, chamber, direction;
} Place;

static const SbSpeedStates *table_of(const SbRun *run, Place at) {
  return run->speeds[at.seal][at.chamber][at.direction];
}

static bool on_body(const SbRun *run, Place at) {
  const SbSpeedStates *table = table_of(run, at);
  return table != NULL && table->on_body;
}

static bool same_ring(const SbSealModel *a, const SbSealModel *b) {
  return a->section_diameter == b->section_diameter && a->inner_diameter == b->inner_diameter &&
         a->modulus == b->modulus && a->poisson_ratio == b->poisson_ratio &&
         a->mooney_share == b->mooney_share;
}

// Returns whether two are solutions of the same problem at any speed, perhaps from other starts:
// the same contact of equal rings under the same pressures on the same supply. Both directions are
// equivalent under equal pressures, except on a body, which belongs to one direction.
static bool alike(const SbRun *run, Place a, Place b) {
  const SbModel *model = run->model;
  const SbSealState *one = &run->cycle.state[a.seal][a.chamber][a.direction];
  const SbSealState *other = &run->cycle.state[b.seal][b.chamber][b.direction];
  const SbSealPressure p = sb_model_seal_pressure(model, a.seal, (SbChamber)a.chamber);
  const SbSealPressure q = sb_model_seal_pressure(model, b.seal, (SbChamber)b.chamber);
  if (!one->touches || !same_contact(one, other) || p.left != q.left || p.right != q.right ||
      !(fabs(one->film_central / other->film_central - 1) < 1e-5) ||
      !same_ring(&model->seal[a.seal], &model->seal[b.seal]) ||
      on_body(run, a) != on_body(run, b)) {
    return false;
  }
  const SbSupply s = sb_run_supply(run, a.seal, (SbChamber)a.chamber, a.direction);
  const SbSupply t = sb_run_supply(run, b.seal, (SbChamber)b.chamber, b.direction);
  return s.limited == t.limited && fabs(s.layer - t.layer) <= 1e-7 * t.layer &&
         (a.direction == b.direction || (p.left == p.right && !on_body(run, a)));
}

enum { OF_SEAL = SB_CYCLE_CHAMBERS * SB_RUN_REST };

// The first that is like this one, of indices `from` to before `end`.
static Place first_like(const SbRun *run, Place own, int from, int end) {
  for (int i = from; i < end; i++) {
    const Place at = {i / (SB_CYCLE_CHAMBERS * SB_RUN_REST), i / SB_RUN_REST % SB_CYCLE_CHAMBERS,
                      i % SB_RUN_REST};
    if (alike(run, at, own)) {
      return at;
    }
  }
  return own;
}

void sb_run_state_at(SbSealState *out, SbRun *run, int seal, int chamber, int direction,
                     double speed) {
  const SbSealState *state = &run->cycle.state[seal][chamber][direction];
  if (fabs(speed) == run->speed || !state->touches || !(state->film_central > 0)) {
    *out = *state;
    return;
  }
  const Place at = first_like(run, (Place){seal, chamber, direction}, 0, TABLES);
  SbSpeedStates **table = &run->speeds[at.seal][at.chamber][at.direction];
  if (*table == NULL && make(run, at.seal, at.chamber, at.direction, NULL, NULL) != SB_OK) {
    run->out_of_memory = true;
    *out = *state;
    return;
  }
  sb_speed_state(out, *table, speed);
  const SbSpeedStates *of = *table;
  if (of->error > 0) { // what interpolation leaves
    out->film_error += of->error;
    out->central_error += of->error;
    out->friction_error += of->friction_error * sb_sliding_friction(out);
  }
  if (run->cycle.kinetic_error_added) {
    (void)sb_run_add_kinetic_error(out);
  }
}

int sb_run_mid_stroke_chamber(int way) {
  return way == SB_CYCLE_IN ? SB_CHAMBER_AT_REST : SB_CHAMBER_CLOSED;
}

void sb_run_prefetch_speeds(SbRun *run, int seal, int chamber, int way, SbCounters *counters,
                            SbWarnings *warnings) {
  static const double FASTER = 1.03;
  const Place own = {seal, chamber, way};
  // The other seal's states may be in work.
  const Place at = first_like(run, own, seal * OF_SEAL, (seal + 1) * OF_SEAL);
  SbSpeedStates *table = run->speeds[seal][at.chamber][at.direction];
  if (table != NULL) {
    const SbSlidingTask task = table->task;
    SbSealState state;
    table->task.counts = counters;
    table->task.warnings = warnings;
    sb_speed_state(&state, table, FASTER * run->speed);
    table->task = task;
  }
}

SbStatus sb_run_sliding(SbSealState *out, SbRun *run, int seal, int way, double speed,
                        SbReport *report) {
  sb_run_state_at(out, run, seal, sb_run_mid_stroke_chamber(way), way, speed);
  run->summary.work = run->work->done;
  return sb_run_close_speeds(run, report);
}

const SbSlidingBody *sb_run_film_of(SbFilmProblem *out, SbRun *run, int seal, int chamber,
                                    int direction) {
  const SbSpeedStates *table = run->speeds[seal][chamber][direction];
  const SbSlidingBody *body = table != NULL && table->on_body ? &table->body : NULL;
  SbSlidingTask task = task_of(run, seal, chamber, direction, run->speed);
  sb_sliding_film_of(out, &run->cycle.state[seal][chamber][direction], &task, body);
  return body;
}

void sb_run_set_film(SbSealState *state, SbRun *run, int seal, int chamber, int direction,
                     double speed, const SbFilm *film, bool fitted) {
  SbSlidingTask task = task_of(run, seal, chamber, direction, fmax(fabs(speed), SB_SPEED_LEAST));
  task.warnings = NULL;
  sb_sliding_set_film(state, &task, film, fitted, run->roughness);
}

// Computes lambda, real area and friction of `state`, whose film the caller has changed, at |speed|
// [m/s] by sb_sliding_refilm().
static void refilm(SbSealState *state, SbRun *run, int seal, int chamber, int direction,
                   double speed) {
  SbSlidingTask task = task_of(run, seal, chamber, direction, fmax(fabs(speed), SB_SPEED_LEAST));
  task.warnings = NULL;
  (void)sb_sliding_refilm(state, &task, run->roughness, NULL);
}

static double between(double a, double b, double t) {
  return t <= 0 ? a : t >= 1 ? b : a + t * (b - a);
}

void sb_run_state_between(SbSealState *out, SbRun *run, int seal, double filled, int direction,
                          double speed) {
  if (filled <= 0 || filled >= 1) {
    sb_run_state_at(out, run, seal, filled > 0 ? SB_CHAMBER_CLOSED : SB_CHAMBER_AT_REST, direction,
                    speed);
    return;
  }
  SbSealState full;
  sb_run_state_at(out, run, seal, SB_CHAMBER_AT_REST, direction, speed);
  sb_run_state_at(&full, run, seal, SB_CHAMBER_CLOSED, direction, speed);
  static const size_t straight[] = {offsetof(SbSealState, contact_left),
                                    offsetof(SbSealState, contact_right),
                                    offsetof(SbSealState, load),
                                    offsetof(SbSealState, load_per_length),
                                    offsetof(SbSealState, load_net),
                                    offsetof(SbSealState, pressure_peak),
                                    offsetof(SbSealState, film_min),
                                    offsetof(SbSealState, film_central),
                                    offsetof(SbSealState, real_area_share),
                                    offsetof(SbSealState, boundary_load),
                                    offsetof(SbSealState, friction_viscous),
                                    offsetof(SbSealState, asperity_share),
                                    offsetof(SbSealState, layer)};
  for (size_t i = 0; i < sizeof straight / sizeof straight[0]; i++) {
    double *a = (double *)((char *)out + straight[i]);
    *a = between(*a, *(const double *)((const char *)&full + straight[i]), filled);
  }
  for (int i = 0; i < SB_SEAL_EDGE_POINTS; i++) {
    out->edge_pressure[i] = between(out->edge_pressure[i], full.edge_pressure[i], filled);
  }
  if (out->touches && full.touches) {
    sb_sliding_full_friction(out);
    refilm(out, run, seal, SB_CHAMBER_AT_REST, direction, speed);
  }
  out->touches = out->touches || full.touches;
}

// Each table that there is.
static SbSpeedStates *table_at(const SbRun *run, int i) {
  return (&run->speeds[0][0][0])[i];
}

SbStatus sb_run_copy_speeds(SbRun *one, const SbRun *run, SbReport *report) {
  for (int i = 0; i < TABLES; i++) {
    const SbSpeedStates *from = table_at(run, i);
    SbSpeedStates **to = &one->speeds[0][0][0] + i;
    if (*to == NULL && from != NULL) {
      *to = malloc(sizeof **to);
      if (*to == NULL) {
        return sb_fail(report, SB_ERROR_MEMORY, "no memory for states over the speed");
      }
      **to = *from;
      (*to)->solves = 0;
      (*to)->task.memory = one->memory[from->task.seal];
      (*to)->task.counts = &one->summary.counters;
      (*to)->task.warnings = &one->summary.warnings;
    }
    if (*to != NULL) {
      (*to)->roughness = one->roughness;
      (*to)->base =
          (&one->cycle.state[0][0][0])[i / SB_RUN_REST * SB_RUN_MOTIONS + i % SB_RUN_REST];
    }
  }
  return SB_OK;
}

SbStatus sb_run_close_speeds(SbRun *run, SbReport *report) {
  SbSummary *summary = &run->summary;
  SbStatus status = run->out_of_memory ? SB_ERROR_MEMORY : SB_OK;
  for (int i = 0; i < TABLES; i++) {
    SbSpeedStates *table = table_at(run, i);
    if (table == NULL) {
      continue;
    }
    status = table->status != SB_OK ? table->status : status;
    summary->counters.speed_nodes += table->solves;
    table->solves = 0;
    if (table->error > 0) {
      summary->error_film = fmax(summary->error_film, table->error);
      // Both seals may use a table. The forces of a motion without inertia are those of the states
      // at its own speed.
      const double friction = table->friction_error * sb_sliding_friction(&table->base);
      for (int seal = 0; run->plan.inertia && seal < SB_SEAL_COUNT; seal++) {
        run->friction_error[seal] = fmax(run->friction_error[seal], friction);
      }
    }
  }
  status = sb_work_status(run->work, status, report);
  return status == SB_OK || status == SB_ERROR_NOT_CONVERGED
             ? status
             : sb_fail(report, status, "%s",
                       status == SB_ERROR_CANCELLED ? "cancelled"
                                                    : "no memory for states over the speed");
}

void sb_run_free_speeds(SbRun *run) {
  for (int i = 0; i < TABLES; i++) {
    free(table_at(run, i));
    (&run->speeds[0][0][0])[i] = NULL;
  }
}
