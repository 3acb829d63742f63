// A valve's life: the actuations after the first, each by the run's own motion model.
//
// Roughness runs in from its value when new to its value when run in as exp(-n/actuations).
// Literature in the thesis gives 1.7 um new and 0.2 um run in (Rana); how fast is not given: an
// input. The asperity product and the height deviation are scaled together, tip radius and density
// of the asperities held (zeta beta sigma and sigma both go with sigma). Fitment and film know no
// roughness, so the first actuation's are reused and only the rough contact is evaluated anew. A
// stem that stays in ends the life: there is no stroke left. The frames of one later actuation
// follow those of the first, as if nothing lay between. Leaves out: wear and swelling of the
// section, storage and loss of propellant between actuations, what the film's thickness owes to
// roughness.
#include "engine/film/laws.h"
#include "engine/valve/figures.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <string.h>

// Gives the solved sliding states a surface `factor` times as rough as the model's.
static SbStatus resurface(SbRun *run, double factor, SbReport *report) {
  SbStatus status = SB_OK;
  for (int i = 0; i < SB_RUN_PROFILE_SLOTS && status == SB_OK; i++) {
    const int motion = i % SB_RUN_MOTIONS;
    const SbSlidingTask task = {
        .model = run->model,
        .seal = i / (SB_CYCLE_CHAMBERS * SB_RUN_MOTIONS),
        .speed = motion == SB_CYCLE_IN ? run->speed : -run->speed,
        .warnings = &run->summary.warnings,
    };
    if (motion != SB_RUN_REST) {
      status = sb_sliding_resurface(&run->cycle.state[0][0][0] + i, &task, factor, report);
    }
  }
  return status;
}

// Computes actuation n (0 is the first, which `run` was) in `one`: fitments and films are those of
// the first, the surface is not.
static SbStatus actuate(SbRun *one, SbRun *run, long n, double roughness, const SbRunHooks *hooks,
                        SbReport *report) {
  one->cycle = run->cycle;
  // Reactions are for frames, and only those of the actuation shown are kept.
  one->plan.bodies = run->plan.bodies && n + 1 == run->model->life_shown;
  one->speed = run->speed;
  one->mid_speed = run->mid_speed;
  one->back_speed = run->back_speed;
  memset(&one->summary, 0, sizeof one->summary);
  sb_figures_clear(&one->summary);
  sb_run_publish(one, 0);
  one->roughness = roughness / run->model->running_in.start;
  SbStatus status = resurface(one, one->roughness, report);
  status = status == SB_OK ? sb_run_copy_speeds(one, run, report) : status;
  if (status == SB_OK) {
    const SbRunHooks quiet = {.cancelled = hooks->cancelled, .data = hooks->data};
    SbReport own = {0};
    status = sb_run_move(one, &quiet, &own);
    if (status != SB_OK) {
      return sb_fail_parameter(report, status, own.parameter, "actuation %ld: %.230s", n + 1,
                               own.text);
    }
  }
  run->summary.energy.closure = fmax(run->summary.energy.closure, one->summary.energy.closure);
  run->summary.steps += one->summary.steps;
  run->summary.rejected_steps += one->summary.rejected_steps;
  sb_run_add_counters(&run->summary.counters, &one->summary.counters);
  sb_warnings_merge(&run->summary.warnings, &one->summary.warnings);
  return status;
}

static SbLifeActuation yield_of(const SbRun *run, long n, double roughness) {
  const SbSummary *summary = &run->summary;
  const SbSealState *outer = &run->cycle.state[SB_OUTER][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
  const SbStageMark *slip = &summary->stage[SB_STAGE_B];
  return (SbLifeActuation){
      .roughness = roughness,
      .lambda = outer->lambda,
      .leakage = summary->leakage_per_cycle,
      .carried = sb_leak_stroke(run->model->bore_diameter, 2 * outer->layer, run->model->stroke),
      .force_peak = summary->force_peak,
      .force_breakaway = slip->reached ? slip->force : NAN,
      .force_return = summary->force_return_min,
      .returned = summary->returned,
      // Filled by the actuation before, which was like this one.
      .dose = sb_run_dose(run, sb_chamber_dose(&run->model->supply, n + 1)),
  };
}

// Puts the frames of `one` behind the first `at`, those of the first actuation.
static void show(SbRun *run, const SbRun *one, size_t at) {
  size_t count = one->count;
  double start = at > 0 ? run->frames[at - 1].time : 0;
  count = at + count < run->capacity ? count : run->capacity - at;
  for (size_t i = 0; i < count; i++) {
    run->frames[at + i] = one->frames[i];
    run->frames[at + i].time += start;
    run->frames[at + i].on_event = 0; // stage marks are the first actuation's
  }
  sb_run_bodies_show(run, at, one, count);
  sb_run_publish(run, at + count);
}

SbStatus sb_run_rest_of_life(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  const SbModel *model = run->model;
  const SbRunningIn *law = &model->running_in;
  const long count = model->life_actuations;
  const size_t shown = run->count;
  SbPlan single = run->plan;
  single.life = false;
  SbRun *one;
  SbStatus status = sb_run_create(&one, model, &single, report);
  if (status != SB_OK) {
    return status;
  }
  one->follows = true;
  // Frames refer to the shapes of the first actuation: lent, not owned.
  memcpy(one->shape, run->shape, sizeof run->shape);
  SbLife *life = &run->summary.life;
  life->leakage = life->carried = 0; // all else is NaN so far
  for (long n = 0; n < count && status == SB_OK && life->failure == 0; n++) {
    double roughness = law->end + (law->start - law->end) * exp(-(double)n / law->actuations);
    if (sb_run_cancelled(hooks, NULL)) {
      status = sb_fail(report, SB_ERROR_CANCELLED, "cancelled after %ld actuations", n);
    } else if (n > 0) {
      status = actuate(one, run, n, roughness, hooks, report);
    }
    if (status != SB_OK) {
      break;
    }
    const SbLifeActuation now = yield_of(n > 0 ? one : run, n, roughness);
    run->life[n] = now;
    life->leakage += now.leakage;
    life->carried += now.carried;
    life->return_least = fmin(life->return_least, now.force_return); // without NaN
    life->failure = now.returned > 0 ? 0 : n + 1;
    life->first = run->life[0];
    life->done = n + 1;
    if (n > 0 && n + 1 == model->life_shown) {
      show(run, one, shown);
    }
    if (n > 0 && n % 8 == 0 && hooks->progress != NULL) {
      hooks->progress(hooks->data, 1 - run->after_frames * (1 - (double)n / (double)count), shown);
    }
  }
  memset(one->shape, 0, sizeof one->shape);
  sb_run_destroy(one);
  // What is "last", and the sums, stand for the whole life: unknown for one that ended before its
  // time.
  if (life->done == count) {
    life->last = run->life[count - 1];
  } else {
    life->leakage = life->carried = NAN;
  }
  if (life->failure > 0) {
    sb_warn(&run->summary.warnings, "life-no-return", "surface.gt_product",
            "the life ends at actuation %ld of %ld: its stem does not return", life->failure,
            count);
  }
  return status;
}
