// Steady contact states of a run: each is solved once and shared by all frames.
//
// The two seals share nothing: where their rings are solved, each has a thread, and what both add
// to the run is joined in the seals' order, so that results do not depend on the threads. The one
// that is done first solves rings for the other (run_ahead.h).
#include "engine/valve/figures/figures.h"
#include "engine/valve/run/run_ahead.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A seal's states in work, and what they add to the run.
typedef struct {
  SbRun *run;
  const SbRunHooks *hooks; // NULL on a thread of its own, which calls no hooks
  atomic_bool *stop;       // the run is cancelled
  SbWork work;             // the seal's part of the run's
  SbRunAhead *ahead;       // rings of both seals; NULL: none
  int seal;
  SbStatus status; // the worst, with the first report of it
  SbReport report, lacks, failed;
  double friction_error, static_error, error_film, error_load, error_width, fault, order;
  SbCounters counters;
  SbWarnings warnings;
  bool solved[SB_CYCLE_CHAMBERS][SB_RUN_MOTIONS]; // without a failure
} Lane;

// One state in work.
typedef struct {
  SbRun *run;
  Lane *lane;
  int seal, chamber, motion;
  SbSealPressure pressure;
  SbSealState *state;
} Task;

// Returns whether the plan needs this state and the cycle can reach it: the outer seal does in
// every chamber state, the inner one slides only while it is on the land.
static bool state_needed(const Task *task) {
  const SbRun *run = task->run;
  const int seal = task->seal, chamber = task->chamber, motion = task->motion;
  if (seal == SB_INNER && chamber == (int)SB_CHAMBER_OPEN) {
    return false;
  }
  switch (run->plan.seal[seal]) {
  case SB_DEPTH_SIZES:
    return false;
  case SB_DEPTH_FITMENT:
  case SB_DEPTH_SLIDING:
    return chamber == (int)SB_CHAMBER_AT_REST && motion == SB_CYCLE_IN;
  case SB_DEPTH_LEAK:
    return motion == SB_CYCLE_IN && sb_run_first_equal_chamber(run, seal, chamber) == chamber;
  case SB_DEPTH_WHOLE:
    break;
  }
  return motion != SB_RUN_REST || run->plan.profiles || run->plan.ring;
}

// Reports the failure and its place: solver, seal, stages, position; and the results that exist
// nevertheless. Figures that need it report it too.
static void report_failure(const Task *task, SbReport *report) {
  static const char *const stages[] = {"A to C", "C to F", "F to A"};
  static const char *const ways[] = {"in-stroke", "return", "at rest"};
  SbRun *run = task->run;
  const SbModel *model = run->model;
  const SbSealState *state = task->state;
  bool fitted = sb_sliding_fit(run->memory[task->seal])->solver.converged;
  bool placed = fitted && isfinite(state->contact_left);
  bool complete = isfinite(sb_sliding_friction(state));
  char place[96];
  if (placed) {
    snprintf(place, sizeof place, "x %.3g to %.3g mm", 1e3 * state->contact_left,
             1e3 * state->contact_right);
  } else {
    snprintf(place, sizeof place, "%.4g MPa", 1e-6 * (task->pressure.left - task->pressure.right));
  }
  const SbReport cause = *report;
  (void)sb_fail_input(
      report, cause.status, sb_input_resolve(cause.input),
      "%s (%s), %s seal, stages %s, %s, %s: %s; available: %s", fitted ? "film" : "fitment",
      !fitted                         ? sb_fit_kind(model->fit)->name
      : sb_contact_law(model)->shares ? "with asperities"
                                      : "reynolds",
      sb_seal_name(task->seal), stages[task->chamber], ways[task->motion], place, cause.text,
      complete ? "the last solution"
      : fitted ? "its fitment, the other states"
               : "the other states");
  sb_warn_serious(&task->lane->warnings, "not-converged", report->input, "%s", report->text);
  if (task->motion != SB_RUN_REST && !complete && task->lane->lacks.status == SB_OK) {
    task->lane->lacks = *report;
  }
  if (task->chamber == SB_CHAMBER_AT_REST && task->motion == SB_CYCLE_IN) {
    task->lane->failed = *report;
  }
}

static bool cancelled(void *data) {
  const Lane *lane = data;
  if (lane->hooks != NULL && sb_run_cancelled(lane->hooks, NULL)) {
    atomic_store(lane->stop, true);
  }
  return atomic_load(lane->stop);
}

// Stores the ring of a state for drawing, and the inner ring's row over the land's edge. Shapes
// that cannot be solved are not drawn.
static SbStatus keep_shapes(const Task *of, const SbRing *ring, SbReport *report) {
  Lane *lane = of->lane;
  const SbRingOptions options = {.poll = sb_work_step, .poll_data = &lane->work};
  const bool in = of->chamber == (int)SB_CHAMBER_AT_REST && of->motion == SB_CYCLE_IN;
  const bool out = of->chamber == (int)SB_CHAMBER_CLOSED && of->motion == SB_CYCLE_OUT;
  int index = of->chamber * SB_RUN_MOTIONS + of->motion;
  lane->counters.field_evaluations++;
  SbStatus status = sb_run_store_shape(of->run, of->seal, index, ring, report);
  if (status != SB_OK || !of->run->plan.over_edge || of->seal != SB_INNER || !(in || out)) {
    return status;
  }
  SbReport own = {0}; // `report` may already say why the state did not converge
  status = sb_run_solve_edge(of->run, of->motion, ring, &lane->counters, &options, &own);
  status = sb_work_status(&lane->work, status, &own);
  if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
    *report = own;
  }
  if (status == SB_OK || status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
    return status;
  }
  sb_warn_serious(&lane->warnings, "ring-shape", sb_input(SB_P_MODELS_FIT),
                  "no solved shape of the inner ring over the land's edge: drawn schematically");
  return SB_OK;
}

// The earlier chamber whose state is this one: under the same pressures, on the same supply; -1:
// none.
static int find_alike(const Task *of) {
  const SbRun *run = of->run;
  const int first = sb_run_first_equal_chamber(run, of->seal, of->chamber);
  if (first == of->chamber || !of->lane->solved[first][of->motion]) {
    return -1;
  }
  const SbSupply a = sb_run_supply(run, of->seal, (SbChamber)first, of->motion);
  const SbSupply b = sb_run_supply(run, of->seal, (SbChamber)of->chamber, of->motion);
  return a.limited == b.limited && a.layer == b.layer ? first : -1;
}

// Takes the state, the surface and the profile of that chamber.
static SbStatus take_alike(const Task *of, int from, SbReport *report) {
  SbRun *run = of->run;
  const SbRunProfile *profile = &run->profile[sb_run_profile_slot(of->seal, from, of->motion)];
  *of->state = run->cycle.state[of->seal][from][of->motion];
  if (of->motion != SB_RUN_REST) {
    const SbSpeedStates *table = run->speeds[of->seal][from][of->motion];
    SbStatus kept =
        sb_run_create_speeds(run, of->seal, of->chamber, of->motion,
                             table != NULL && table->on_body ? &table->body : NULL, report);
    if (kept != SB_OK) {
      return kept;
    }
  }
  if (run->plan.profiles && profile->data != NULL) {
    const SbContactProfile *view = &profile->view;
    SbRunProfile *own = &run->profile[sb_run_profile_slot(of->seal, of->chamber, of->motion)];
    const size_t n = view->count;
    double *x = malloc(SB_PROFILE_ROWS * n * sizeof *x + 1);
    if (x == NULL) {
      return sb_fail(report, SB_ERROR_MEMORY, "no memory for a profile");
    }
    memcpy(x, profile->data, SB_PROFILE_ROWS * n * sizeof *x);
    free(own->data);
    own->data = x;
    own->view = sb_run_profile_view(x, n, view->model);
    of->lane->counters.profile_evaluations++;
  }
  return SB_OK;
}

// Number of a state among those of both seals.
static int slot_of(const Task *of) {
  return (int)sb_run_profile_slot(of->seal, of->chamber, of->motion);
}

static SbSlidingTask sliding_task(const Task *of) {
  static const double way[SB_RUN_MOTIONS] = {[SB_CYCLE_IN] = 1, [SB_CYCLE_OUT] = -1};
  const SbRun *run = of->run;
  return (SbSlidingTask){run->model,
                         of->seal,
                         of->pressure,
                         sb_model_way(run->model) * way[of->motion] * run->speed,
                         run->memory[of->seal],
                         &of->lane->counters,
                         &of->lane->warnings,
                         sb_run_supply(run, of->seal, (SbChamber)of->chamber, of->motion)};
}

// Returns whether a state's ring begins the row over the land's edge. If it is not the last one in
// its direction, *ring is NULL, and the ring is solved for the row.
static bool begins_row(const Task *of, const SbRing **ring) {
  const SbPlan *plan = &of->run->plan;
  const SbSlidingTask task = sliding_task(of);
  *ring = sb_sliding_ring_of(&task);
  return plan->section_fields && plan->ring && of->seal == SB_INNER &&
         of->chamber == (int)SB_CHAMBER_CLOSED && of->motion == SB_CYCLE_OUT;
}

// Solves one state and takes its errors, its surface, its profile and its shape.
// SB_ERROR_NOT_CONVERGED with what there is all the same.
static SbStatus solve_state(const Task *of, SbReport *report) {
  SbRun *run = of->run;
  Lane *lane = of->lane;
  SbSealState *state = of->state;
  SbSlidingMemory *memory = run->memory[of->seal];
  const bool fitment = run->plan.seal[of->seal] == SB_DEPTH_FITMENT;
  const SbSlidingTask task = sliding_task(of);
  SbSlidingMemory *ahead = NULL;
  if (lane->ahead != NULL) {
    ahead = sb_run_ahead_take(lane->ahead, slot_of(of), &lane->work, cancelled, lane);
  }
  sb_sliding_memory_prefetched(memory, ahead);
  SbStatus status =
      fitment ? sb_sliding_fitment(state, &task, report) : sb_sliding_solve(state, &task, report);
  status = sb_work_status(&lane->work, status, report);
  sb_sliding_memory_prefetched(memory, NULL);
  sb_sliding_memory_destroy(ahead);
  if (status == SB_ERROR_NOT_CONVERGED) {
    report_failure(of, report);
  } else if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
    return status;
  } else if (status != SB_OK) {
    const SbReport cause = *report;
    return sb_fail_input(report, status, sb_input_resolve(cause.input), "%s seal: %s",
                         sb_seal_name(of->seal), cause.text);
  } else if (!fitment && of->motion != SB_RUN_REST && !isfinite(sb_sliding_friction(state)) &&
             lane->lacks.status == SB_OK) {
    (void)sb_fail(&lane->lacks, SB_ERROR_INFEASIBLE,
                  "the fluid opens the contact of the %s seal or carries it alone: no law gives "
                  "film and friction",
                  sb_seal_name(of->seal));
  }
  if (!fitment && of->motion != SB_RUN_REST && state->film_central > 0) {
    SbStatus kept = sb_run_create_speeds(run, of->seal, of->chamber, of->motion,
                                         sb_sliding_body(memory), report);
    if (kept != SB_OK) {
      return kept;
    }
  }
  const SbFit *fit = sb_sliding_fit(memory);
  if (isfinite(state->load)) {
    lane->error_load = fmax(lane->error_load, fit->solver.error_estimate.load);
    lane->fault = fmax(lane->fault, fit->ring.fault);
    lane->order = fmax(lane->order, fit->ring.order);
    lane->error_width = fmax(lane->error_width, fit->solver.error_estimate.contact_width);
  }
  // fmax() leaves out what was not computed.
  lane->friction_error = fmax(lane->friction_error, state->friction_error);
  lane->static_error = fmax(lane->static_error, state->static_error);
  lane->error_film = fmax(lane->error_film, state->film_error);
  const SbRing *ring = sb_sliding_ring(memory);
  SbStatus kept = run->plan.profiles ? sb_run_make_profile(run, of->seal, of->chamber, of->motion,
                                                           of->pressure, state, report)
                                     : SB_OK;
  lane->counters.profile_evaluations += run->plan.profiles && kept == SB_OK ? 1 : 0;
  if (kept == SB_OK && run->plan.section_fields && ring != NULL && state->load > 0) {
    kept = keep_shapes(of, ring, report);
  }
  return kept != SB_OK ? kept : status;
}

// Returns whether a status ends a seal's states.
static bool fatal(SbStatus status) {
  return status != SB_OK && status != SB_ERROR_NOT_CONVERGED;
}

// Solves states near the one just solved that will be needed, if any.
static void ask_beside(const Task *of) {
  const SbRun *run = of->run;
  const SbPlan *plan = &run->plan;
  if (of->motion == SB_RUN_REST || !plan->motion || plan->inertia || !plan->frame_films) {
    return;
  }
  const SbSealPressure asked = sb_model_seal_pressure(
      run->model, of->seal, (SbChamber)sb_run_mid_stroke_chamber(of->motion));
  if (asked.left == of->pressure.left && asked.right == of->pressure.right) {
    sb_run_prefetch_speeds(of->run, of->seal, of->chamber, of->motion, &of->lane->counters,
                           &of->lane->warnings);
  }
}

static void *solve_lane(void *data) {
  enum { STATES = SB_CYCLE_CHAMBERS * SB_RUN_MOTIONS };
  Lane *lane = data;
  SbRun *run = lane->run;
  SbReport own = {0};
  for (int i = 0; i < STATES && !fatal(lane->status); i++) {
    const int chamber = i / SB_RUN_MOTIONS;
    Task task = {run,
                 lane,
                 lane->seal,
                 chamber,
                 i % SB_RUN_MOTIONS,
                 .state = &run->cycle.state[lane->seal][0][0] + i};
    if (!state_needed(&task)) {
      continue;
    }
    if (cancelled(lane)) {
      lane->status = sb_fail(&lane->report, SB_ERROR_CANCELLED, "cancelled");
      break;
    }
    if (lane->hooks != NULL) {
      sb_run_progress(run, lane->hooks, i / (double)STATES, 0);
    }
    task.pressure = sb_model_seal_pressure(run->model, lane->seal, (SbChamber)chamber);
    own = (SbReport){0};
    const SbRing *ring;
    const bool row = begins_row(&task, &ring);
    const int alike = row && ring == NULL ? -1 : find_alike(&task);
    SbStatus status = alike >= 0 ? take_alike(&task, alike, &own) : solve_state(&task, &own);
    if (status == SB_OK && alike >= 0 && row && task.state->load > 0) {
      status = keep_shapes(&task, ring, &own);
    }
    lane->solved[chamber][task.motion] = status == SB_OK;
    if (fatal(status) || (status != SB_OK && lane->status == SB_OK)) {
      lane->report = own; // the first failure to converge is reported
      lane->status = status;
    }
    if (alike < 0 && !fatal(status)) {
      ask_beside(&task);
    }
  }
  return NULL;
}

// A lane on another thread, waited for.
typedef struct {
  Lane *lane;
  pthread_mutex_t lock;
  pthread_cond_t done;
  bool ended;
} Beside;

static void *solve_beside(void *data) {
  Beside *beside = data;
  Lane *lane = beside->lane;
  (void)solve_lane(lane);
  if (lane->ahead != NULL && !fatal(lane->status)) {
    sb_run_ahead_work(lane->ahead, cancelled, lane);
  }
  pthread_mutex_lock(&beside->lock);
  beside->ended = true;
  pthread_cond_signal(&beside->done);
  pthread_mutex_unlock(&beside->lock);
  return NULL;
}

// Adds the rings of a seal's states that may be solved ahead; equal ones are solved once.
static void add_ahead(SbRunAhead *ahead, Lane *lane) {
  SbRun *run = lane->run;
  SbSealPressure pressure[SB_CYCLE_CHAMBERS];
  for (int c = 0; c < SB_CYCLE_CHAMBERS; c++) {
    pressure[c] = sb_model_seal_pressure(run->model, lane->seal, (SbChamber)c);
  }
  for (int i = 0; i < SB_CYCLE_CHAMBERS * SB_RUN_MOTIONS; i++) {
    const int chamber = i / SB_RUN_MOTIONS;
    const Task task = {run, lane, lane->seal, chamber, i % SB_RUN_MOTIONS, pressure[chamber], NULL};
    bool alike = false;
    for (int c = 0; c < chamber; c++) {
      alike = alike || (pressure[c].left == pressure[chamber].left &&
                        pressure[c].right == pressure[chamber].right);
    }
    if (run->plan.seal[lane->seal] == SB_DEPTH_WHOLE && !alike && state_needed(&task)) {
      const SbSlidingTask sliding = sliding_task(&task);
      sb_run_ahead_add(ahead, &sliding, slot_of(&task), &lane->work);
    }
  }
}

// Solves both lanes, the second on a thread of its own; `first` polls for a cancel, for both.
static void solve_together(Lane *first, Lane *second) {
  Beside beside = {second, PTHREAD_MUTEX_INITIALIZER, PTHREAD_COND_INITIALIZER, false};
  const SbRunHooks *hooks = second->hooks;
  pthread_t thread;
  second->hooks = NULL;
  SbRunAhead *ahead = sb_run_ahead_create(); // without one each waits for the other
  if (ahead != NULL) {
    add_ahead(ahead, first);
    add_ahead(ahead, second);
  }
  first->ahead = second->ahead = ahead;
  bool runs = pthread_create(&thread, NULL, solve_beside, &beside) == 0;
  (void)solve_lane(first);
  if (!runs) {
    second->hooks = hooks;
    (void)solve_lane(second);
    sb_run_ahead_destroy(ahead);
    return;
  }
  if (ahead != NULL && !fatal(first->status)) {
    sb_run_ahead_work(ahead, cancelled, first);
  }
  pthread_mutex_lock(&beside.lock);
  while (!beside.ended) {
    struct timespec until;
    timespec_get(&until, TIME_UTC);
    until.tv_nsec += 10000000;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    pthread_cond_timedwait(&beside.done, &beside.lock, &until);
    pthread_mutex_unlock(&beside.lock);
    (void)cancelled(first);
    pthread_mutex_lock(&beside.lock);
  }
  pthread_mutex_unlock(&beside.lock);
  pthread_join(thread, NULL);
  sb_run_ahead_destroy(ahead);
  pthread_cond_destroy(&beside.done);
  pthread_mutex_destroy(&beside.lock);
}

// Adds a lane's to the run.
static void join(SbRun *run, Lane *lane) {
  SbSummary *summary = &run->summary;
  sb_run_add_counters(&summary->counters, &lane->counters);
  // One number for all of the seal's states: the one that is reported.
  char subject[24];
  snprintf(subject, sizeof subject, "%s seal", sb_seal_name(lane->seal));
  sb_warn_replace(&lane->warnings, "ring-tolerance", subject,
                  "%s: the ring's load is known to %.2g only, not to %.2g", subject,
                  lane->error_load, run->model->tolerance);
  sb_warnings_merge(&summary->warnings, &lane->warnings);
  if (lane->failed.status != SB_OK) {
    sb_seal_reason(summary, lane->seal, "*", "%s", lane->failed.text);
  }
  if (run->lacks.status == SB_OK) {
    run->lacks = lane->lacks;
  }
  run->friction_error[lane->seal] = fmax(lane->friction_error, 0);
  run->static_error[lane->seal] = fmax(lane->static_error, 0);
  summary->error_film = fmax(summary->error_film, lane->error_film);
  summary->error_load = fmax(summary->error_load, lane->error_load);
  summary->error_width = fmax(summary->error_width, lane->error_width);
  double *fault = &summary->ring_fault[lane->seal];
  *fault = fmax(*fault, lane->fault);
  summary->ring_order = fmax(summary->ring_order, lane->order);
}

SbStatus sb_run_solve_all(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  SbSummary *summary = &run->summary;
  summary->error_film = NAN;
  summary->error_load = summary->error_width = 0;
  (void)sb_succeed(&run->lacks);
  memset(run->friction_error, 0, sizeof run->friction_error);
  memset(run->static_error, 0, sizeof run->static_error);
  run->cycle.model = run->model;
  Lane *lane = calloc(SB_SEAL_COUNT, sizeof *lane);
  if (lane == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the seals' states");
  }
  atomic_bool stop = false;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    lane[seal].run = run;
    lane[seal].hooks = hooks;
    lane[seal].stop = &stop;
    lane[seal].seal = seal;
    lane[seal].error_film = NAN;
    lane[seal].work = sb_work_part(run->work, SB_SEAL_COUNT);
    lane[seal].work.cancelled = cancelled;
    lane[seal].work.data = &lane[seal];
    sb_sliding_memory_poll(run->memory[seal], sb_work_step, &lane[seal].work);
    // At least the states of the figures are unknown until they are solved.
    sb_sliding_clear(&run->cycle.state[seal][SB_CHAMBER_AT_REST][SB_CYCLE_IN]);
    sb_sliding_clear(&run->cycle.state[seal][SB_CHAMBER_CLOSED][SB_CYCLE_OUT]);
  }
  bool both =
      run->plan.seal[SB_OUTER] > SB_DEPTH_SIZES && run->plan.seal[SB_INNER] > SB_DEPTH_SIZES;
  if (run->plan.ring && both && !hooks->alone) {
    solve_together(&lane[0], &lane[1]);
  } else {
    for (int seal = 0; seal < SB_SEAL_COUNT && (seal == 0 || !fatal(lane[seal - 1].status));
         seal++) {
      (void)solve_lane(&lane[seal]);
    }
  }
  const Lane *worst = &lane[0];
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    join(run, &lane[seal]);
    sb_work_add(run->work, &lane[seal].work);
    sb_sliding_memory_poll(run->memory[seal], sb_work_step, run->work);
    bool worse = worst->status == SB_OK || (fatal(lane[seal].status) && !fatal(worst->status));
    worst = worse ? &lane[seal] : worst;
  }
  SbStatus status = worst->status;
  if (report != NULL && status != SB_OK) {
    *report = worst->report;
  }
  free(lane);
  return status;
}
