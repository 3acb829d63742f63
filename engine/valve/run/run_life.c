// A valve's life: the actuations after the first, each by the run's own motion model.
//
// Roughness runs in (motion/life.h): the asperity product and the height deviation are scaled
// together, tip radius and density of the asperities held (zeta beta sigma and sigma both go with
// sigma). Fitment and film know no roughness, so the first actuation's are reused and only the
// rough contact is evaluated anew. A stem that stays in ends the life. The frames of one later
// actuation follow those of the first, as if nothing lay between. Leaves out: wear of the section,
// storage and loss of propellant between actuations, what the film's thickness owes to roughness.
#include "engine/film/stroke.h"
#include "engine/valve/figures.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  SbRun *run;
  SbRun *one; // what computes an actuation
  const SbRunHooks *hooks;
  size_t first_frames;
} Lived;

// The model with a surface `factor` times as rough.
static void roughen(SbModel *out, const SbModel *model, double factor) {
  *out = *model;
  out->gt_product = model->gt_product * factor;
  out->sigma = model->sigma * factor;
  out->sigma_over_beta = model->sigma_over_beta * factor;
}

SbStatus sb_run_resurface(SbRun *run, double factor, SbReport *report) {
  SbModel base = run->model;
  roughen(&run->model, &base, factor);
  run->cycle.states.model = &run->model;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    for (int chamber = 0; chamber < SB_CYCLE_CHAMBERS; chamber++) {
      for (int direction = 0; direction < SB_CYCLE_DIRECTIONS; direction++) {
        double speed = direction == SB_CYCLE_IN ? run->speed : -run->speed;
        SbStatus status =
            sb_sliding_resurface(&run->cycle.states.state[seal][chamber][direction], &run->model,
                                 seal, speed, &run->summary.warnings, report);
        if (status != SB_OK) {
          return status;
        }
      }
    }
  }
  return SB_OK;
}

static void yield_of(SbLifeActuation *out, const SbRun *run) {
  const SbSummary *summary = &run->summary;
  const SbSliding *outer = &run->cycle.states.state[SB_OUTER][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
  out->lambda = outer->lambda;
  out->leakage = summary->leakage_per_cycle;
  out->carried = sb_leak_stroke(run->model.bore_diameter, outer->film_central, run->model.stroke);
  out->force_peak = summary->force_peak;
  const SbStageMark *slip = &summary->stage[SB_STAGE_B];
  out->force_breakaway = slip->reached ? slip->force : NAN;
  out->force_return = summary->force_return_min;
  out->returned = summary->returned;
}

// Puts the frames of `one` behind those of the first actuation.
static void show(Lived *lived) {
  SbRun *run = lived->run;
  size_t count = atomic_load_explicit(&lived->one->published, memory_order_relaxed);
  size_t at = lived->first_frames;
  double start = at > 0 ? run->frames[at - 1].time : 0;
  for (size_t i = 0; i < count && at + i < run->capacity; i++) {
    run->frames[at + i] = lived->one->frames[i];
    run->frames[at + i].time += start;
    run->frames[at + i].on_event = 0; // stage marks are the first actuation's
  }
  count = at + count < run->capacity ? count : run->capacity - at;
  sb_run_bodies_show(run, at, lived->one, count);
  sb_run_publish(run, at + count);
}

static SbStatus actuate(SbLifeActuation *out, long n, double roughness, void *user,
                        SbReport *report) {
  Lived *lived = user;
  SbRun *run = lived->run, *one = lived->one;
  if (n == 0) {
    yield_of(out, run);
    return SB_OK;
  }
  // The first actuation's fitment and film with this one's surface.
  one->model = run->model;
  one->cycle = run->cycle;
  // Reactions are for frames, and only those of the actuation shown are kept.
  one->plan.bodies = run->plan.bodies && n + 1 == run->model.life_shown;
  one->speed = run->speed;
  one->film_exponent = run->film_exponent;
  memset(&one->summary, 0, sizeof one->summary);
  sb_figures_clear(&one->summary);
  sb_run_publish(one, 0);
  SbStatus status = sb_run_resurface(one, roughness / run->model.running_in.start, report);
  SbRunHooks quiet = {NULL, lived->hooks != NULL ? lived->hooks->cancelled : NULL,
                      lived->hooks != NULL ? lived->hooks->data : NULL};
  SbReport own = {0};
  if (status == SB_OK) {
    status = sb_run_move(one, &quiet, &own);
    if (status != SB_OK) {
      return sb_fail_parameter(report, status, own.parameter, "actuation %ld: %.230s", n + 1,
                               own.text);
    }
  }
  if (status != SB_OK) {
    return status;
  }
  yield_of(out, one);
  run->summary.energy.closure = fmax(run->summary.energy.closure, one->summary.energy.closure);
  run->summary.steps += one->summary.steps;
  run->summary.rejected_steps += one->summary.rejected_steps;
  sb_warnings_merge(&run->summary.warnings, &one->summary.warnings);
  if (n + 1 == run->model.life_shown) {
    show(lived);
  }
  if (lived->hooks != NULL && lived->hooks->progress != NULL && n % 8 == 0) {
    double before = 1 - run->after_frames;
    lived->hooks->progress(lived->hooks->data,
                           before + run->after_frames * (double)n / run->model.life_actuations,
                           lived->first_frames);
  }
  return SB_OK;
}

static bool cancelled(void *user) {
  const Lived *lived = user;
  return sb_run_cancelled(lived->hooks, NULL);
}

// What is "last" stands for the whole life: unknown for one that ended before its time.
static void fill_figures(SbSummary *summary, const SbLifeActuation *each, long count) {
  long done = summary->life.done;
  if (done > 0) {
    summary->life_breakaway_first = each[0].force_breakaway;
    summary->life_lambda_first = each[0].lambda;
  }
  if (done == count) {
    const SbLifeActuation *last = &each[done - 1];
    summary->life_roughness = last->roughness;
    summary->life_breakaway_last = last->force_breakaway;
    summary->life_return_last = last->force_return;
    summary->life_lambda_last = last->lambda;
  }
}

SbStatus sb_run_rest_of_life(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  Lived lived = {.run = run,
                 .hooks = hooks,
                 .first_frames = atomic_load_explicit(&run->published, memory_order_relaxed)};
  SbPlan single = run->plan;
  single.life = false;
  SbStatus status = sb_run_create(&lived.one, &run->model, &single, report);
  if (status != SB_OK) {
    return status;
  }
  lived.one->follows = true;
  // Frames refer to the shapes of the first actuation: lent, not owned.
  memcpy(lived.one->shape, run->shape, sizeof run->shape);
  memcpy(lived.one->shape_slot, run->shape_slot, sizeof run->shape_slot);
  SbLife *life = &run->summary.life;
  status = sb_life_run(life, run->life, &run->model.running_in, run->model.life_actuations, actuate,
                       cancelled, &lived, report);
  memset(lived.one->shape, 0, sizeof lived.one->shape);
  sb_run_destroy(lived.one);
  fill_figures(&run->summary, run->life, run->model.life_actuations);
  if (life->failure > 0) {
    sb_warn(&run->summary.warnings, "life-no-return", "surface.gt_product",
            "the life ends at actuation %ld of %d: its stem does not return", life->failure,
            run->model.life_actuations);
  }
  return status;
}
