// A valve's life: the actuations after the first, each by the run's own motion model.
//
// Roughness changes from its value when new to its value when run in as exp(-n/actuations).
// Literature in the thesis gives 1.7 um new and 0.2 um run in (Rana); the rate is not given and is
// an input. The asperity product and the height deviation are scaled together, with constant tip
// radius and density of the asperities (zeta beta sigma and sigma are both proportional to sigma).
// Without coupled asperities fit and film do not depend on roughness, so those of the first
// actuation are reused and only the rough contact is recomputed. Coupled asperities share the
// film's load: some actuations are solved as complete runs with their roughness. Results between
// them follow from parabolas in the roughness, whose intervals are halved until they agree with
// solved values to the run's tolerance. A stem that does not return ends the life, because there is
// no further stroke. The frames of one later actuation follow those of the first directly; profiles
// and shapes are those of the first. Not modelled: wear and swelling of the section, storage and
// loss of propellant between actuations; without coupling, the effect of roughness on the film.
#include "engine/film/laws.h"
#include "engine/valve/figures/figures.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Gives the solved sliding states a surface `factor` times as rough as the model's.
static SbStatus resurface(SbRun *run, double factor, SbReport *report) {
  SbStatus status = SB_OK;
  for (int i = 0; i < SB_RUN_PROFILE_SLOTS && status == SB_OK; i++) {
    const int motion = i % SB_RUN_MOTIONS;
    const SbSlidingTask task = {
        .model = run->model,
        .seal = i / (SB_CYCLE_CHAMBERS * SB_RUN_MOTIONS),
        .speed = sb_model_way(run->model) * (motion == SB_CYCLE_IN ? run->speed : -run->speed),
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
  // Reactions are only stored for the frames of the actuation that is shown.
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
    sb_run_begin_work(one, &quiet);
    status = sb_run_move(one, &quiet, &own);
    run->work->done += one->work->done;
    if (status != SB_OK) {
      return sb_fail_input(report, status, own.input, "actuation %ld: %s", n + 1, own.text);
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
      // A stuck stem has no full cycle, so no leakage of one (sb_run_leave_out()).
      .leakage = summary->closes ? summary->leakage_per_cycle : NAN,
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

// Some actuations of a life solved as runs of their own.
typedef struct {
  SbRun *run; // of the first
  SbRun *one;
  const SbRunHooks *hooks;
  // Of each actuation: the fraction of the chamber that is filled, and the mass that remains in it
  // [kg].
  double *filled, *kept;
  bool *known;
  long solved;
} Solved;

static double roughness_of(const SbModel *model, long n) {
  const SbRunningIn *law = &model->running_in;
  return law->end + (law->start - law->end) * exp(-(double)n / law->actuations);
}

// Copies the results of a run of actuation n.
static void take(Solved *s, const SbRun *run, long n) {
  const SbModel *model = run->model;
  const SbSummary *summary = &run->summary;
  s->run->life[n] = yield_of(run, n, roughness_of(s->run->model, n));
  s->filled[n] = isnan(summary->filled_share) ? 1 : summary->filled_share;
  s->kept[n] = model->supply.volume * model->density * s->filled[n] - summary->dose_mass;
  s->known[n] = true;
}

// Solves actuation n unless it is, with its frames if they are to be shown.
static SbStatus solve_one(Solved *s, long n, bool shown, SbReport *report) {
  SbRun *run = s->run;
  if (s->known[n] && !shown) {
    return SB_OK;
  }
  const double roughness = roughness_of(run->model, n);
  const SbOverride worn[] = {{SB_P_LIFE_ROUGHNESS_NEW, roughness},
                             {SB_P_LIFE_ROUGHNESS_RUN_IN, roughness}};
  SbPlan plan = run->plan;
  plan.life = plan.profiles = plan.section_fields = false;
  plan.film_history = plan.film_history && shown;
  plan.bodies = plan.bodies && shown;
  SbModel *model;
  SbReport own = {0};
  SbStatus status = sb_model_derive(&model, run->model, worn, 2, &own);
  if (status == SB_OK) {
    status = sb_run_renew(s->one, model, &plan, &own);
    sb_model_destroy(model);
  }
  if (status == SB_OK) {
    const SbRunHooks quiet = {.cancelled = s->hooks->cancelled, .data = s->hooks->data};
    status = sb_run_execute(s->one, &quiet, &own);
    run->work->done += s->one->work->done;
  }
  const SbSummary *summary = &s->one->summary;
  if (status == SB_OK && s->one->lacks.status != SB_OK) { // no contact, no motion
    status = sb_fail(&own, SB_ERROR_INFEASIBLE, "%s", s->one->lacks.text);
  }
  if (status == SB_ERROR_CANCELLED) {
    return sb_fail(report, status, "cancelled after 1 actuation");
  }
  if (status != SB_OK) {
    return sb_fail_input(report, status, own.input, "actuation %ld: %s", n + 1, own.text);
  }
  s->solved++;
  take(s, s->one, n);
  run->summary.energy.closure = fmax(run->summary.energy.closure, summary->energy.closure);
  run->summary.steps += summary->steps;
  run->summary.rejected_steps += summary->rejected_steps;
  sb_run_add_counters(&run->summary.counters, &summary->counters);
  if (summary->returned > 0) { // the life's end has its own
    sb_warnings_merge(&run->summary.warnings, &summary->warnings);
  }
  if (s->hooks->progress != NULL) {
    static const double LIKELY = 4;
    s->hooks->progress(s->hooks->data, 1 - run->after_frames * LIKELY / (LIKELY + s->solved),
                       run->count);
  }
  return SB_OK;
}

// Members that depend on the roughness.
static void members(double *out[6], SbLifeActuation *of) {
  double *const all[] = {&of->lambda,     &of->leakage,         &of->carried,
                         &of->force_peak, &of->force_breakaway, &of->force_return};
  memcpy(out, all, sizeof all);
}

// Actuation n, by the parabola through three that are solved.
static void between(Solved *s, const long at[3], long n) {
  SbLifeActuation *life = s->run->life;
  const double r = roughness_of(s->run->model, n);
  SbLifeActuation found = {.roughness = r, .returned = life[at[0]].returned};
  double *sum[6], *one[6];
  members(sum, &found);
  s->filled[n] = s->kept[n] = 0;
  for (int k = 0; k < 3; k++) {
    const long i = at[(k + 1) % 3], j = at[(k + 2) % 3];
    const double here = life[at[k]].roughness, a = life[i].roughness, b = life[j].roughness;
    const double weight = (r - a) * (r - b) / ((here - a) * (here - b));
    members(one, &life[at[k]]);
    for (int m = 0; m < 6; m++) {
      *sum[m] += weight * *one[m];
    }
    s->filled[n] += weight * s->filled[at[k]];
    s->kept[n] += weight * s->kept[at[k]];
  }
  life[n] = found;
}

// Returns the difference of a guess from the solved actuation: forces divided by that of the first
// slip, which is due to friction alone, or by the peak; volumes divided by the carried or the net
// one, whichever is larger, because a gasket valve's stem carries liquid on its return only.
static double apart(SbLifeActuation *guess, SbLifeActuation *found) {
  const double slip = found->force_breakaway, force = slip > 0 ? slip : found->force_peak;
  const double volume = fmax(found->carried, fabs(found->leakage)); // of a net one that is known
  const double unit[] = {found->lambda, volume, volume, force, force, force};
  double *a[6], *b[6], most = 0;
  members(a, guess);
  members(b, found);
  for (int i = 0; i < 6; i++) {
    const bool none = isnan(*a[i]) && isnan(*b[i]);
    const double off = none || *a[i] == *b[i] ? 0 : fabs(*a[i] - *b[i]) / fabs(unit[i]);
    most = isnan(off) ? INFINITY : fmax(most, off);
  }
  return most;
}

// Actuation between two whose roughness is nearest to the middle of theirs.
static long middle_of(const SbModel *model, long a, long b) {
  const double aim = 0.5 * (roughness_of(model, a) + roughness_of(model, b));
  long low = a, high = b; // the roughness is monotonic
  while (high - low > 1) {
    const long n = low + (high - low) / 2;
    const bool before = (roughness_of(model, n) - aim) * (roughness_of(model, a) - aim) > 0;
    *(before ? &low : &high) = n;
  }
  return low > a ? low : a + 1;
}

// Every actuation between two that are solved, up to one whose stem stays in: by parabolas, where
// that over both halves meets the middle of each.
static SbStatus fill(Solved *s, long a, long b, SbReport *report) {
  static const double RUN_IN = 1e-9;
  const SbModel *model = s->run->model;
  SbLifeActuation *life = s->run->life;
  if (b - a < 2 || !(life[a].returned > 0)) {
    return SB_OK;
  }
  if (fabs(life[b].roughness - life[a].roughness) <= RUN_IN * life[a].roughness) {
    for (long n = a + 1; n < b; n++) {
      life[n] = life[a];
      s->filled[n] = s->filled[a];
      s->kept[n] = s->kept[a];
    }
    return SB_OK;
  }
  const long m = middle_of(model, a, b);
  SbStatus status = solve_one(s, m, false, report);
  bool met = status == SB_OK && life[b].returned > 0 && life[m].returned > 0 && m - a > 1;
  const long half[2][2] = {{a, m}, {m, b}}, whole[] = {a, m, b};
  long quarter[2] = {m, m};
  for (int k = 0; k < 2 && met && half[k][1] - half[k][0] > 1; k++) {
    quarter[k] = middle_of(model, half[k][0], half[k][1]);
    between(s, whole, quarter[k]);
    SbLifeActuation guess = life[quarter[k]];
    status = solve_one(s, quarter[k], false, report);
    met = status == SB_OK && life[quarter[k]].returned > 0 &&
          apart(&guess, &life[quarter[k]]) <= model->tolerance;
  }
  for (int k = 0; k < 2 && status == SB_OK; k++) {
    const long at[] = {half[k][0], quarter[k], half[k][1]};
    for (long n = at[0] + 1; n < at[2] && met; n++) {
      if (n != at[1]) {
        between(s, at, n);
      }
    }
    status = met ? status : fill(s, half[k][0], half[k][1], report);
  }
  return status;
}

// All actuations of a life with coupled asperities, and the frames of the one that is shown.
static SbStatus solve_life(SbRun *run, SbRun *one, const SbRunHooks *hooks, SbReport *report) {
  const long last = run->model->life_actuations - 1, shown = run->model->life_shown - 1;
  const size_t at = run->count;
  Solved s = {.run = run, .one = one, .hooks = hooks};
  const size_t count = (size_t)last + 1;
  s.filled = calloc(count, sizeof *s.filled);
  s.kept = calloc(count, sizeof *s.kept);
  s.known = calloc(count, sizeof *s.known);
  if (s.filled == NULL || s.kept == NULL || s.known == NULL) {
    free(s.filled);
    free(s.kept);
    free(s.known);
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a life of %ld actuations", last + 1);
  }
  take(&s, run, 0);
  const bool lives = run->life[0].returned > 0;
  SbStatus status = lives ? solve_one(&s, last, false, report) : SB_OK;
  status = status == SB_OK && lives ? fill(&s, 0, last, report) : status;
  long end = 0; // of the last one whose stem came back, or the first that stayed in
  while (status == SB_OK && end < last && run->life[end].returned > 0) {
    end++;
  }
  if (status == SB_OK && shown > 0 && shown <= end) {
    status = solve_one(&s, shown, true, report);
    if (status == SB_OK) {
      show(run, one, at);
    }
  }
  for (long n = 1; n <= end && status == SB_OK; n++) {
    const double metered = sb_chamber_dose(&run->model->supply, n + 1);
    run->life[n].dose =
        run->model->canister_pressure > 0 ? fmax(metered * s.filled[n] - s.kept[n], 0) : 0;
  }
  free(s.filled);
  free(s.kept);
  free(s.known);
  return status;
}

// Adds actuation `n` (from 0) to the sums of a life.
static void add_actuation(SbRun *run, long n, const SbLifeActuation *now) {
  SbLife *life = &run->summary.life;
  run->life[n] = *now;
  life->leakage += now->leakage;
  life->carried += now->carried;
  life->return_least = fmin(life->return_least, now->force_return); // without NaN
  life->failure = now->returned > 0 ? 0 : n + 1;
  life->first = run->life[0];
  life->done = n + 1;
}

SbStatus sb_run_rest_of_life(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  const SbModel *model = run->model;
  const bool coupled = sb_contact_law(model)->shares;
  const long count = model->life_actuations;
  const size_t shown = run->count;
  SbPlan single = run->plan;
  single.life = false;
  SbRun *one;
  SbStatus status = sb_run_create(&one, model, &single, report);
  if (status != SB_OK) {
    return status;
  }
  SbLife *life = &run->summary.life;
  if (coupled) {
    status = solve_life(run, one, hooks, report);
    life->first = run->life[0];
    life->done = 1;
  } else {
    one->follows = true;
    // Frames refer to the shapes of the first actuation: lent, not owned.
    memcpy(one->shape, run->shape, sizeof run->shape);
  }
  life->leakage = life->carried = 0; // all else is NaN so far
  for (long n = 0; n < count && status == SB_OK && life->failure == 0; n++) {
    const double roughness = roughness_of(model, n);
    if (!coupled && sb_run_cancelled(hooks, NULL)) {
      status = sb_fail(report, SB_ERROR_CANCELLED, "cancelled after %ld actuations", n);
    } else if (n > 0 && !coupled) {
      status = actuate(one, run, n, roughness, hooks, report);
    }
    if (status != SB_OK) {
      break;
    }
    const SbLifeActuation now = coupled ? run->life[n] : yield_of(n > 0 ? one : run, n, roughness);
    add_actuation(run, n, &now);
    if (n > 0 && n + 1 == model->life_shown && !coupled) {
      show(run, one, shown);
    }
    if (n > 0 && n % 8 == 0 && hooks->progress != NULL) {
      hooks->progress(hooks->data, 1 - run->after_frames * (1 - (double)n / (double)count), shown);
    }
  }
  if (!coupled) {
    memset(one->shape, 0, sizeof one->shape);
  }
  sb_run_destroy(one);
  // "last" and the sums refer to the full life: unknown if it ended early.
  if (life->done == count) {
    life->last = run->life[count - 1];
  } else {
    life->leakage = life->carried = NAN;
  }
  if (life->failure > 0) {
    sb_warn_serious(&run->summary.warnings, "life-no-return", sb_input(SB_P_SURFACE_GT_PRODUCT),
                    "the life ends at actuation %ld of %ld: its stem does not return",
                    life->failure, count);
  }
  return status;
}
