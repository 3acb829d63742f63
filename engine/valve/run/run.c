// Executes a plan: sliding states, the cycle's segments, frames, figures.
//
// Nothing here steps in time. The steady sliding states are solved once each, the cycle's events
// are located exactly (cycle.h), and a frame is an evaluation at its time, so that figures
// do not depend on the number of frames. Frames live in one array allocated at creation; the count
// is published with release order after each frame is complete, which is what lets another thread
// read while this one writes.
#include "engine/base/clock.h"
#include "engine/numeric/sampling.h"
#include "engine/valve/figures/figures.h"
#include "engine/valve/model/motion_kind.h"
#include "engine/valve/run/contradiction.h"
#include "engine/valve/run/run_errors.h"
#include "engine/valve/run/run_private.h"

#ifdef SB_ASSERT_RUNS
#include <assert.h>
#endif
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Frames of one actuation, or two if a life shows a second one; or the rig's samples.
static size_t frames_at_most(const SbModel *model, const SbPlan *plan) {
  if (!sb_motion_kind(model)->valve) {
    return sb_rig_samples(&model->rig);
  }
  size_t one = (size_t)plan->frames + SB_RUN_EVENT_FRAMES + 2 * (size_t)model->cycles;
  return plan->life && model->life_shown > 1 ? 2 * one : one;
}

SbStatus sb_run_create(SbRun **out, const SbModel *model, const SbPlan *plan, SbReport *report) {
  SbRun *run = calloc(1, sizeof *run);
  SbStatus status = run != NULL ? SB_OK : sb_fail(report, SB_ERROR_MEMORY, "no memory for a run");
  if (run != NULL) {
    run->work = &run->own_work;
  }
  for (int i = 0; i < SB_SEAL_COUNT && status == SB_OK; i++) {
    status = sb_sliding_memory_create(&run->memory[i], report);
  }
  status = status == SB_OK ? sb_run_renew(run, model, plan, report) : status;
  if (status != SB_OK) {
    sb_run_destroy(run);
    run = NULL;
  }
  *out = run;
  return status;
}

// Frees and clears everything that belongs to one execution, except the seals' states.
static void clear_execution(SbRun *run) {
  for (int i = 0; i < SB_RUN_PROFILE_SLOTS; i++) {
    free(run->profile[i].data);
  }
  for (int i = 0; i < SB_RUN_SHAPES; i++) {
    free(run->shape[i].data);
  }
  sb_run_bodies_destroy(run->bodies);
  free(run->life);
  sb_model_destroy(run->model);
  memset((char *)run + offsetof(SbRun, model), 0, sizeof *run - offsetof(SbRun, model));
}

static void begin(SbRun *run, const SbModel *model, const SbPlan *plan) {
  run->model = model;
  run->plan = *plan;
  run->speed = run->mid_speed = run->back_speed = model->speed;
  run->roughness = 1;
  run->capacity = frames_at_most(model, plan);
}

SbStatus sb_run_renew(SbRun *run, const SbModel *model, const SbPlan *plan, SbReport *report) {
  SbModel *kept; // copied before the run's model is freed, which may be this one
  if (sb_model_copy(&kept, model) != SB_OK) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a run");
  }
  const SbPlan own = *plan;
  clear_execution(run);
  sb_run_free_speeds(run);
  run->solved.solved = run->solved.stand = false;
  begin(run, kept, &own);
  plan = &run->plan;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    sb_sliding_memory_forget(run->memory[i]);
  }
  if (run->capacity > run->room) {
    free(run->frames);
    // Not initialised, so a run that is cancelled early does not use all of the memory.
    run->frames = malloc(run->capacity * sizeof *run->frames);
    run->room = run->frames != NULL ? run->capacity : 0;
  }
  run->life = plan->life ? calloc((size_t)kept->life_actuations, sizeof *run->life) : NULL;
  if (run->frames == NULL || (plan->life && run->life == NULL)) {
    return sb_fail_input(report, SB_ERROR_MEMORY, sb_input(SB_P_OUTPUT_FRAMES),
                         "no memory for %d frames", plan->frames);
  }
  return sb_succeed(report);
}

void sb_run_keep_rings(SbRun *run) {
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    sb_sliding_memory_store(run->memory[i]);
  }
}

void sb_run_end_rings(SbRun *run) {
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    sb_sliding_memory_end(run->memory[i]);
  }
}

void sb_run_prepare_rings(const SbRun *run, bool (*stop)(void *data), void *data) {
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    sb_sliding_memory_prepare(run->memory[i], stop, data);
  }
}

static void start_from(SbRun *run, const SbRun *base, bool tangent) {
  run->predicted = tangent && base != NULL;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    sb_sliding_memory_start(run->memory[i], base != NULL ? base->memory[i] : NULL, tangent,
                            run->plan.profiles || run->plan.section_fields);
  }
}

void sb_run_start_from(SbRun *run, const SbRun *base) {
  start_from(run, base, false);
}

void sb_run_predict_from(SbRun *run, const SbRun *base) {
  start_from(run, base, true);
}

void sb_run_rings_beside(SbRun *run, SbRingsBeside how) {
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    sb_sliding_memory_rings(run->memory[i], how);
  }
}

SbStatus sb_run_renew_same(SbRun *run, const SbModel *model, SbReport *report) {
  const SbPlan plan = run->plan;
  SbModel *kept;
  if (!run->solved.solved) {
    return sb_run_renew(run, model, &plan, report);
  }
  if (sb_model_copy(&kept, model) != SB_OK) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a run");
  }
  clear_execution(run);
  begin(run, kept, &plan);
  run->solved.stand = true;
  return sb_succeed(report);
}

void sb_run_destroy(SbRun *run) {
  if (run == NULL) {
    return;
  }
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    sb_sliding_memory_destroy(run->memory[i]);
  }
  clear_execution(run);
  sb_run_free_speeds(run);
  free(run->frames);
  free(run);
}

void sb_run_publish(SbRun *run, size_t count) {
  run->count = count;
  if (!run->hold) {
    atomic_store_explicit(&run->published, count, memory_order_release);
  }
}

void sb_run_mark_stage(SbRun *run, SbStage stage, const SbFrame *frame, size_t index) {
  SbStageMark *mark = &run->summary.stage[stage];
  if (!mark->reached) {
    *mark = (SbStageMark){true, frame->time, frame->displacement, frame->force, index};
  }
}

void sb_run_progress(const SbRun *run, const SbRunHooks *hooks, double fraction, size_t frames) {
  double share = run->before_frames;
  if (hooks->progress != NULL) {
    hooks->progress(hooks->data,
                    frames == 0 ? share * fraction
                                : share + (1 - share - run->after_frames) * fraction,
                    frames);
  }
}

bool sb_run_cancelled(const SbRunHooks *hooks, SbReport *report) {
  if (hooks->cancelled != NULL && hooks->cancelled(hooks->data)) {
    (void)sb_fail(report, SB_ERROR_CANCELLED, "cancelled");
    return true;
  }
  return false;
}

bool sb_run_poll(SbRun *run, const SbRunHooks *hooks, size_t count, double fraction,
                 SbReport *report) {
  if (count % 64 != 0) {
    return false;
  }
  sb_run_publish(run, count);
  if (count % 4096 == 0) {
    sb_run_progress(run, hooks, fraction, count);
  }
  return sb_run_cancelled(hooks, report);
}

// Clears figures that only a complete motion has, of one that ended early.
static void clear_motion(SbRun *run, const char *why) {
  SbSummary *summary = &run->summary; // stages that were reached remain
  summary->force_peak = summary->force_return_min = summary->leakage_per_cycle = NAN;
  summary->force_return_margin = summary->force_press = summary->stuck_at = NAN;
  summary->force_return_margin_anywhere = summary->force_return_margin_stop = NAN;
  summary->duration = summary->error_force = summary->error_energy = NAN;
  summary->energy = (SbEnergy){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
  summary->outcome = SB_OUTCOME_UNKNOWN;
  summary->returns = summary->closes = false;
  summary->returned = NAN;
  sb_reason(summary, "cycle.*", "%s", why);
  sb_reason(summary, "solver.error_estimate.force", "%s", why);
  sb_reason(summary, "solver.error_estimate.energy", "%s", why);
}

// As sb_run_fail_at(), at the stem's last frame.
static SbStatus fail_at_last(const SbRun *run, SbReport *report, SbStatus status,
                             const char *solver, const SbReport *cause, const char *available) {
  const SbFrame *last = &run->frames[run->count - 1];
  const SbRunPlace place = {solver,     "stem",   (SbStage)last->stage, last->displacement,
                            last->time, available};
  return sb_run_fail_at(report, status, &place, cause);
}

SbStatus sb_run_move(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  static const char *const names[] = {"quasi-static", "dynamic", "rig", "bodies"};
  SbSummary *summary = &run->summary;
  if (run->lacks.status != SB_OK) {
    clear_motion(run, run->lacks.text);
    return SB_OK;
  }
  SbReport own = {0};
  sb_run_begin_errors(run);
  SbStatus status =
      run->plan.inertia ? sb_run_dynamic(run, hooks, &own) : sb_run_quasi_static(run, hooks, &own);
  if (status == SB_OK && summary->energy.closure > SB_RUN_CLOSURE) {
    status = sb_fail(&own, SB_ERROR_NOT_CONVERGED, "the energies' balance is open by %.2g",
                     summary->energy.closure);
  }
  if (status == SB_ERROR_NOT_CONVERGED && run->count > 0) {
    const SbReport cause = own;
    char solver[60];
    snprintf(solver, sizeof solver, "motion (%s), both seals", names[run->model->motion]);
    (void)fail_at_last(run, &own, status, solver, &cause,
                       "the seals, the frames and stages before");
  }
  if (status != SB_OK) {
    clear_motion(run, status == SB_ERROR_CANCELLED ? "the run was stopped before" : own.text);
    if (report != NULL) {
      *report = own;
    }
  }
  return status;
}

// Returns whether what was computed so far is worth going on with: a film or motion that did not
// converge leaves its best state.
static bool usable(SbStatus status) {
  return status == SB_OK || status == SB_ERROR_NOT_CONVERGED;
}

// Share of people, of normally distributed strength, who are weaker than a force.
static double weaker(double force, double mean, double deviation) {
  return isnan(force) ? NAN : sb_normal_share((force - mean) / deviation);
}

void sb_run_set_user_fractions(SbSummary *summary, const SbModel *model) {
  const double mean[] = {[SB_WOMEN] = model->women_strength, [SB_MEN] = model->men_strength};
  const double deviation[] = {[SB_WOMEN] = model->women_deviation, [SB_MEN] = model->men_deviation};
  for (int users = 0; users < SB_USERS; users++) {
    summary->below_peak[users] = weaker(summary->force_peak, mean[users], deviation[users]);
    summary->below_breakaway[users] =
        weaker(summary->force_breakaway, mean[users], deviation[users]);
  }
}

// Warnings of an outcome other than that of a stem which returns with a margin.
static void warn_of_outcome(SbSummary *summary) {
  const double margin = summary->force_return_margin;
  switch (summary->outcome) {
  case SB_OUTCOME_NEVER_MOVED:
    sb_warn_serious(&summary->warnings, "no-slip", sb_input(SB_P_FRICTION_STATIC_RATIO),
                    "the stem never slips: the drive's %.3g N are not enough", summary->force_peak);
    break;
  case SB_OUTCOME_STUCK:
    sb_warn_serious(&summary->warnings, "no-return", sb_input(SB_P_SURFACE_GT_PRODUCT),
                    "the stem does not return: it is stuck at %.3g mm, return margin %.3g N",
                    1e3 * summary->stuck_at, margin);
    break;
  case SB_OUTCOME_RETURNED:
    if (margin < 0) {
      sb_warn_serious(
          &summary->warnings, "static-hold", sb_input(SB_P_FRICTION_STATIC_RATIO),
          "the stem returns without stopping; if it stops on the return path, static friction "
          "can exceed the pressure force by %.3g N",
          -margin);
    }
    break;
  case SB_OUTCOME_HELD:
  case SB_OUTCOME_UNKNOWN:
    break;
  }
}

// Figures of all actuations, and what users can do, from the figures of the motion.
static void conclude(SbRun *run, bool moved) {
  SbSummary *summary = &run->summary;
  summary->leakage_carried = run->model->actuations * summary->seal[SB_OUTER].leakage_per_stroke;
  summary->leakage_net = run->model->actuations * summary->leakage_per_cycle;
  sb_run_leave_out(run);
  if (summary->stage[SB_STAGE_B].reached) {
    summary->force_breakaway = summary->stage[SB_STAGE_B].force;
  }
  if (moved) {
    sb_run_set_user_fractions(summary, run->model);
    warn_of_outcome(summary);
  }
}

// The valve's actuation: sliding states, then the motion.
static SbStatus execute_valve(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  const SbPlan *plan = &run->plan;
  sb_model_warn(run->model, &run->summary.warnings);
  // Solved rings take seconds, everything else before the frames milliseconds.
  run->before_frames = plan->ring ? 0.9 : 0;
  run->after_frames = run->life != NULL ? 0.9 * (1 - run->before_frames) : 0;
  SbStatus status = SB_OK;
  if (run->solved.stand) {
    if (sb_run_cancelled(hooks, report)) {
      return SB_ERROR_CANCELLED;
    }
    sb_run_restore_states(run);
  } else {
    status = sb_run_solve_states(run, hooks, report);
    if (!usable(status)) {
      return status;
    }
    sb_run_store_states(run, status);
  }
  run->hold = plan->film_history;
  if (plan->motion) {
    SbStatus motion = sb_run_move(run, hooks, status == SB_OK ? report : NULL);
    status = motion != SB_OK ? motion : status;
  }
  if (run->hold) {
    run->hold = false;
    if (usable(status)) {
      SbStatus film = sb_run_film_history(run, run->count, hooks, status == SB_OK ? report : NULL);
      status = film != SB_OK ? film : status;
    }
    sb_run_publish(run, run->count);
  }
  sb_run_summarise_seals(run);
  if (plan->shelf != SB_SHELF_NOTHING) {
    SbStatus shelf = sb_run_shelf(run, hooks, status == SB_OK ? report : NULL);
    status = shelf != SB_OK ? shelf : status;
  }
  bool moved = plan->motion && run->lacks.status == SB_OK;
  if (status == SB_OK && run->life != NULL && moved) {
    status = sb_run_rest_of_life(run, hooks, report);
  }
  conclude(run, status == SB_OK && moved);
  return status;
}

void sb_run_begin_work(SbRun *run, const SbRunHooks *hooks) {
  const size_t limit = (size_t)run->model->work_limit;
  run->own_work = (SbWork){.limit = limit > hooks->work_used ? limit - hooks->work_used : 0,
                           .cancelled = hooks->cancelled,
                           .data = hooks->data};
}

#ifdef SB_ASSERT_RUNS
// Ends the program with a message if the run's figures contradict each other.
static void assert_no_contradiction(const SbRun *run) {
  char text[SB_TEXT];
  if (sb_summary_contradiction(text, sizeof text, &run->summary, run->model)) {
    __assert_fail(text, __FILE__, __LINE__, __func__);
  }
}
#endif

// The motion has ended, but the budget of work did not last for what follows it, such as the error
// estimates: the report names where the motion ended.
static SbStatus name_spent(const SbRun *run, SbReport *report) {
  SbReport cause;
  const SbStatus status = sb_work_status(run->work, SB_ERROR_CANCELLED, &cause);
  return run->count == 0
             ? sb_fail_input(report, status, cause.input, "%s", cause.text)
             : fail_at_last(run, report, status, "motion (its error estimate), both seals", &cause,
                            "the seals and the motion");
}

SbStatus sb_run_execute(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  const SbRunHooks none = {0};
  double start = sb_clock_seconds();
  SbSummary *summary = &run->summary;
  hooks = hooks != NULL ? hooks : &none;
  memset(summary, 0, sizeof *summary); // too large for a temporary on a small stack
  sb_figures_clear(summary);
  sb_figures_of_model(summary, run->model);
  (void)sb_succeed(&run->lacks);
  run->hold = false;
  sb_run_publish(run, 0);
  run->before_frames = run->after_frames = 0;
  sb_run_begin_work(run, hooks);
  SbReport local = {0};
  report = report != NULL ? report : &local;
  SbStatus status = sb_motion_kind(run->model)->valve ? execute_valve(run, hooks, report)
                                                      : sb_run_rig(run, hooks, report);
  if (status == SB_OK && run->work->spent) {
    status = name_spent(run, report);
    sb_warn(&summary->warnings, "work-limit", report->input, "%s", report->text);
  }
  for (int i = 0; i < SB_SEAL_COUNT; i++) { // later users of the states have no budget
    sb_sliding_memory_poll(run->memory[i], hooks->cancelled, hooks->data);
  }
  summary->work = run->work->done;
  sb_run_set_reasons(run, status, report);
  sb_run_fill_errors(run);
  status = sb_run_check_errors(run, status, report);
  sb_verdict_fill(summary, run->model);
  summary->frames = run->count;
  if (hooks->progress != NULL && status == SB_OK) {
    hooks->progress(hooks->data, 1, summary->frames);
  }
  summary->status = status;
  summary->converged = status == SB_OK;
  summary->wall_s = sb_clock_seconds() - start;
#ifdef SB_ASSERT_RUNS
  assert_no_contradiction(run);
#endif
  return status;
}

const SbFrame *sb_run_frames(const SbRun *run, size_t *count) {
  *count = atomic_load_explicit(&run->published, memory_order_acquire);
  return run->frames;
}

size_t sb_run_capacity(const SbRun *run) {
  return run->capacity;
}

const SbContactProfile *sb_run_profile(const SbRun *run, uint32_t index) {
  return index < SB_RUN_PROFILE_SLOTS && run->profile[index].data != NULL
             ? &run->profile[index].view
             : NULL;
}

const SbSealShape *sb_run_shape(const SbRun *run, uint32_t index) {
  return index < SB_RUN_SHAPES && run->shape[index].view.nodes > 0 ? &run->shape[index].view : NULL;
}

const SbLifeActuation *sb_run_life(const SbRun *run, size_t *count) {
  *count = run->life != NULL ? (size_t)run->summary.life.done : 0;
  return run->life;
}

const SbSummary *sb_run_summary(const SbRun *run) {
  return &run->summary;
}

const SbModel *sb_run_model(const SbRun *run) {
  return run->model;
}

const SbPlan *sb_run_plan(const SbRun *run) {
  return &run->plan;
}

void sb_run_add_counters(SbCounters *sum, const SbCounters *more) {
  sum->fit_solves += more->fit_solves;
  sum->disc_solves += more->disc_solves;
  sum->ring_solves += more->ring_solves;
  sum->reynolds_solves += more->reynolds_solves;
  sum->speed_nodes += more->speed_nodes;
  sum->newton_iterations += more->newton_iterations;
  sum->film_steps += more->film_steps;
  sum->field_evaluations += more->field_evaluations;
  sum->profile_evaluations += more->profile_evaluations;
}
