// Executes a plan: sliding states, the cycle's segments, frames, figures.
//
// Nothing here steps in time. The steady sliding states are solved once each, the cycle's events
// are located exactly (motion/cycle.h), and a frame is an evaluation at its time, so that figures
// do not depend on the number of frames. Frames live in one array allocated at creation; the count
// is published with release order after each frame is complete, which is what lets another thread
// read while this one writes.
#include "engine/run.h"

#include "engine/leak/percolation.h"
#include "engine/leak/stroke.h"
#include "engine/motion/cycle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
  MOTIONS = 3, // sliding in, sliding out, at rest
  REST = 2,
  PROFILE_SLOTS = SB_SEAL_COUNT * SB_CYCLE_CHAMBERS * MOTIONS,
  OUTSIDE_POINTS = 60,
  PROFILE_POINTS = SB_FIT_PROFILE_MAX + 2 * OUTSIDE_POINTS
};

typedef struct {
  SbContactProfile view;
  double *data; // x, pressure, film, asperity pressure
} Profile;

struct SbRun {
  SbModel model;
  SbPlan plan;
  SbCycle cycle;
  SbSummary summary;
  SbSlidingMemory *memory[SB_SEAL_COUNT];
  Profile profile[PROFILE_SLOTS];
  SbFrame *frames;
  size_t capacity;
  atomic_size_t published;
};

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

SbStatus sb_run_create(SbRun **out, const SbModel *model, const SbPlan *plan, SbReport *report) {
  *out = NULL;
  SbRun *run = calloc(1, sizeof *run);
  if (run == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a run");
  }
  run->model = *model;
  run->plan = *plan;
  run->capacity = (size_t)model->frames + SB_CYCLE_SEGMENTS_MAX + 1;
  // Left untouched until used: a run that is cancelled early never pays for the rest.
  run->frames = malloc(run->capacity * sizeof *run->frames);
  SbStatus status = SB_OK;
  for (int i = 0; i < SB_SEAL_COUNT && status == SB_OK; i++) {
    status = sb_sliding_memory_create(&run->memory[i], report);
  }
  if (run->frames == NULL || status != SB_OK) {
    sb_run_destroy(run);
    return sb_fail_parameter(report, SB_ERROR_MEMORY, "output.frames", "no memory for %d frames",
                             model->frames);
  }
  *out = run;
  return sb_succeed(report);
}

void sb_run_destroy(SbRun *run) {
  if (run == NULL) {
    return;
  }
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    sb_sliding_memory_destroy(run->memory[i]);
  }
  for (int i = 0; i < PROFILE_SLOTS; i++) {
    free(run->profile[i].data);
  }
  free(run->frames);
  free(run);
}

// ---------------------------------------------------------------------------------------------------
// Sliding states and profiles

static uint32_t profile_slot(int seal, SbChamber chamber, int motion) {
  return (uint32_t)((seal * SB_CYCLE_CHAMBERS + (int)chamber) * MOTIONS + motion);
}

// Gap of a Hertz contact of half-width a outside it, at distance xi a from its middle (Johnson,
// Contact Mechanics, section 4.2), over R/a^2 [-].
static double hertz_gap(double xi) {
  double root = sqrt(fmax(xi * xi - 1, 0));
  return (xi * root - log(xi + root)) / 2;
}

// Pressure and film over one contact, from what the seal's memory has just solved. With a solved
// film it is the solver's own profile; with a closed form it is the fitment's pressure, the central
// film held uniform (the law knows no shape) and the dry gap outside.
static SbStatus make_profile(SbRun *run, int seal, SbSealPressure pressure, const SbSliding *state,
                             Profile *profile, SbReport *report) {
  const SbFit *fit = sb_sliding_fit(run->memory[seal]);
  const SbFilm *film = sb_sliding_film(run->memory[seal]);
  bool solved = run->model.film == SB_MODEL_FILM_REYNOLDS && state->film_central > 0;
  size_t capacity = solved ? film->points : (size_t)PROFILE_POINTS;
  double *data = calloc(4 * capacity, sizeof *data);
  if (data == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a profile");
  }
  double *x = data;
  double *p = data + capacity;
  double *h = data + 2 * capacity;
  size_t n = 0;
  if (solved) {
    n = film->points;
    memcpy(x, film->x, n * sizeof *x);
    memcpy(p, film->pressure, n * sizeof *p);
    memcpy(h, film->film, n * sizeof *h);
  } else if (state->touches) {
    double a = fit->contact_width / 2;
    double middle = (fit->contact_left + fit->contact_right) / 2;
    double scale = a * a / run->model.seal[seal].radius;
    for (int i = OUTSIDE_POINTS; i > 0; i--) {
      double xi = 1 + pow(i / (double)OUTSIDE_POINTS, 2);
      x[n] = middle - xi * a;
      p[n] = pressure.left;
      h[n++] = state->film_central + scale * hertz_gap(xi);
    }
    for (size_t i = 0; i < fit->profile_count; i++) {
      x[n] = fit->profile_x[i];
      p[n] = fmax(fit->profile_p[i], x[n] < middle ? pressure.left : pressure.right);
      h[n++] = state->film_central;
    }
    for (int i = 1; i <= OUTSIDE_POINTS; i++) {
      double xi = 1 + pow(i / (double)OUTSIDE_POINTS, 2);
      x[n] = middle + xi * a;
      p[n] = pressure.right;
      h[n++] = state->film_central + scale * hertz_gap(xi);
    }
  }
  free(profile->data);
  profile->data = data;
  profile->view = (SbContactProfile){
      .count = n,
      .x = x,
      .pressure = p,
      .film = h,
      .asperity_pressure = data + 3 * capacity,
      .model = solved ? "reynolds" : sb_fit_model_name((SbFitModel)run->model.fit),
  };
  run->summary.counters.profile_evaluations++;
  return SB_OK;
}

// Whether the cycle can visit this state at all: the outer seal does in every chamber state, the
// inner one slides only while it touches the land.
static bool state_needed(int seal, SbChamber chamber) {
  return seal == SB_OUTER || chamber != SB_CHAMBER_OPEN;
}

static SbStatus solve_states(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  SbSummary *summary = &run->summary;
  SbSlidingCounts counts = {0};
  SbStatus worst = SB_OK;
  summary->error_film = NAN;
  summary->error_load = 0;
  run->cycle.states.model = &run->model;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    for (int chamber = 0; chamber < SB_CYCLE_CHAMBERS; chamber++) {
      SbSealPressure pressure = sb_model_seal_pressure(&run->model, seal, (SbChamber)chamber);
      for (int motion = 0; motion < MOTIONS && state_needed(seal, (SbChamber)chamber); motion++) {
        if (hooks != NULL && hooks->cancelled != NULL && hooks->cancelled(hooks->data)) {
          return sb_fail(report, SB_ERROR_CANCELLED, "cancelled");
        }
        if (motion == REST && !run->plan.profiles) {
          continue;
        }
        double speed = motion == SB_CYCLE_IN ? run->model.speed
                       : motion == REST      ? 0
                                             : -run->model.speed;
        SbSliding rest;
        SbSliding *state = motion == REST ? &rest : &run->cycle.states.state[seal][chamber][motion];
        SbStatus status = sb_sliding_solve(state, &run->model, seal, pressure, speed,
                                           run->memory[seal], &counts, &summary->warnings, report);
        if (status == SB_ERROR_NOT_CONVERGED) {
          worst = status;
        } else if (status != SB_OK) {
          return status;
        }
        summary->error_load = fmax(summary->error_load,
                                   sb_sliding_fit(run->memory[seal])->solver.error_estimate.load);
        if (!isnan(state->film_error)) {
          summary->error_film =
              fmax(isnan(summary->error_film) ? 0 : summary->error_film, state->film_error);
        }
        if (run->plan.profiles) {
          status =
              make_profile(run, seal, pressure, state,
                           &run->profile[profile_slot(seal, (SbChamber)chamber, motion)], report);
          if (status != SB_OK) {
            return status;
          }
        }
      }
    }
  }
  summary->counters.fit_solves = counts.fit_solves;
  summary->counters.disc_solves = counts.disc_solves;
  summary->counters.ring_solves = counts.ring_solves;
  summary->counters.reynolds_solves = counts.reynolds_solves;
  summary->newton_iterations = counts.newton_iterations;
  return worst;
}

// ---------------------------------------------------------------------------------------------------
// Frames

// Time at platen position X of a segment: the platen moves at constant speed, up and back.
static double time_of(const SbRun *run, const SbCycleSegment *segment, double X) {
  double top = run->cycle.platen_top;
  return (segment->platen > 0 ? X : 2 * top - X) / run->model.speed;
}

static void fill_seal(SbSealFrame *out, const SbRun *run, int seal, const SbCycleSegment *segment,
                      double s, double share_of_limit) {
  SbChamber chamber = segment->chamber;
  const SbSliding *state = &run->cycle.states.state[seal][chamber][segment->direction];
  SbSealPressure pressure = sb_model_seal_pressure(&run->model, seal, chamber);
  double width_share;
  double load_share;
  sb_cycle_land_share(&run->cycle, seal, chamber, segment->direction, s, &width_share, &load_share);
  bool moving = segment->mode != SB_CYCLE_STICK;
  double width = state->contact_right - state->contact_left;

  // The edge takes the contact away from the canister side.
  *out = (SbSealFrame){
      .land_fraction = (float)width_share,
      .pressure_left = (float)pressure.left,
      .pressure_right = (float)pressure.right,
      .profile = run->plan.profiles && state->touches
                     ? profile_slot(seal, chamber, moving ? segment->direction : REST)
                     : UINT32_MAX,
      .contact_left = state->contact_right - width_share * width,
      .contact_right = state->contact_right,
      .load = load_share * state->load,
      .pressure_peak = width_share > 0.5 ? state->pressure_peak : 0,
  };
  if (width_share > 0 && width_share <= 0.5) {
    double c = 1 - 2 * (1 - width_share);
    out->pressure_peak = state->pressure_peak * sqrt(fmax(1 - c * c, 0));
  }
  if (!moving) {
    out->friction = share_of_limit;
    out->friction_boundary = share_of_limit;
    return;
  }
  double sign = segment->direction == SB_CYCLE_IN ? 1 : -1;
  bool contact = width_share > 0;
  out->film_min = contact ? state->film_min : 0;
  out->film_central = contact ? state->film_central : 0;
  out->lambda = contact ? state->lambda : 0;
  out->friction_viscous = sign * state->viscous * width_share;
  out->friction = sign * sb_cycle_seal_friction(&run->cycle, seal, chamber, segment->direction, s);
  out->friction_boundary = out->friction - out->friction_viscous;
}

static void fill_frame(SbFrame *out, const SbRun *run, const SbCycleSegment *segment, double X,
                       double s) {
  const SbCycle *cycle = &run->cycle;
  double stop_force;
  double friction = sb_cycle_balance(cycle, segment, X, s, &stop_force);
  *out = (SbFrame){
      .time = time_of(run, segment, X),
      .displacement = s,
      .platen = X,
      .force = sb_cycle_force(cycle, X, s),
      .pressure_force = run->model.pressure_force,
      .stop_force = stop_force,
      .stage = (uint8_t)segment->stage,
      .chamber = (uint8_t)segment->chamber,
  };
  if (segment->mode == SB_CYCLE_SLIP && segment->platen1 != segment->platen0) {
    // ds/dX by a central difference of the balance, inside the segment.
    double h = 1e-4 * (segment->platen1 - segment->platen0);
    double low =
        fabs(X - h - segment->platen0) <= fabs(segment->platen1 - segment->platen0) ? X - h : X;
    low = (low - segment->platen0) * (segment->platen1 - low) >= 0 ? low : X;
    double high = (X + h - segment->platen0) * (segment->platen1 - X - h) >= 0 ? X + h : X;
    out->velocity = segment->platen * run->model.speed *
                    (sb_cycle_stem(cycle, segment, high) - sb_cycle_stem(cycle, segment, low)) /
                    (high - low);
  }

  // A stuck stem's friction is split between the seals in proportion to what each can bear.
  double total = sb_cycle_friction(cycle, segment->chamber, segment->direction, s);
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    double own = sb_cycle_seal_friction(cycle, seal, segment->chamber, segment->direction, s);
    fill_seal(&out->seal[seal], run, seal, segment, s, total > 0 ? friction * own / total : 0);
  }
}

static void publish(SbRun *run, size_t count) {
  atomic_store_explicit(&run->published, count, memory_order_release);
}

static void mark_stage(SbSummary *summary, SbStage stage, const SbFrame *frame, size_t index) {
  if (!summary->stage[stage].reached) {
    summary->stage[stage] =
        (SbStageMark){true, frame->time, frame->displacement, frame->force, index};
  }
}

// Evenly spaced frames, and one at the end of every segment so that corners are sharp.
static SbStatus emit_frames(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  const SbCycle *cycle = &run->cycle;
  SbSummary *summary = &run->summary;
  size_t total = (size_t)run->model.frames;
  size_t next = 0;  // evenly spaced frame to come
  size_t count = 0; // frames written
  double duration = 2 * cycle->platen_top / run->model.speed;
  for (size_t i = 0; i < cycle->count; i++) {
    const SbCycleSegment *segment = &cycle->segment[i];
    double end = time_of(run, segment, segment->platen1);
    for (; next < total && segment->mode != SB_CYCLE_JUMP; next++) {
      double t = duration * (double)next / (double)(total - 1);
      if (t >= end) {
        break;
      }
      double X =
          segment->platen > 0 ? run->model.speed * t : 2 * cycle->platen_top - run->model.speed * t;
      X = fmin(fmax(X, fmin(segment->platen0, segment->platen1)),
               fmax(segment->platen0, segment->platen1));
      fill_frame(&run->frames[count], run, segment, X, sb_cycle_stem(cycle, segment, X));
      count++;
      if (count % 256 == 0) {
        publish(run, count);
        if (hooks != NULL && hooks->cancelled != NULL && hooks->cancelled(hooks->data)) {
          return sb_fail(report, SB_ERROR_CANCELLED, "cancelled");
        }
        if (hooks != NULL && hooks->progress != NULL && count % 4096 == 0) {
          hooks->progress(hooks->data, (double)next / (double)total, count);
        }
      }
    }
    // The corner. An event's figures are those just before it.
    fill_frame(&run->frames[count], run, segment, segment->platen1, segment->stem1);
    if (count == 0) {
      mark_stage(summary, SB_STAGE_A, &run->frames[0], 0);
    }
    if (segment->event >= 0) {
      run->frames[count].on_event = 1;
      mark_stage(summary, (SbStage)segment->event, &run->frames[count], count);
    }
    count++;
    publish(run, count);
  }
  if (count > 0 && !summary->stage[SB_STAGE_A].reached) {
    mark_stage(summary, SB_STAGE_A, &run->frames[0], 0);
  }
  summary->frames = count;
  summary->duration = duration;
  return SB_OK;
}

// ---------------------------------------------------------------------------------------------------
// Figures

static double film_by(const SbRun *run, int seal, const SbSliding *state, SbFilmModel film_model) {
  SbFilmProblem problem;
  SbFilm *film = calloc(1, sizeof *film);
  double central = NAN;
  if (film != NULL && state->touches && state->load_net > 0) {
    SbSealPressure pressure = sb_model_seal_pressure(&run->model, seal, SB_CHAMBER_AT_REST);
    sb_sliding_film_problem(&problem, &run->model, seal, pressure, state->load_net,
                            run->model.speed);
    problem.model = film_model;
    if (sb_film_solve(film, &problem, NULL, NULL) == SB_OK) {
      central = film->film_central;
    }
  }
  free(film);
  return central;
}

// Leak at rest under the pressure that the rubber itself exerts on the bore (net of the fluid's
// step).
static void static_leak(SbRun *run, int seal, SbSealSummary *out) {
  const SbModel *model = &run->model;
  const SbSliding *state = &run->cycle.states.state[seal][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
  SbSealPressure pressure = sb_model_seal_pressure(model, seal, SB_CHAMBER_AT_REST);
  SbSpectrum spectrum;
  SbPercolation leak;
  out->leakage_static = out->closing_pressure = out->leak_sensitivity = NAN;
  if (!state->touches ||
      sb_spectrum_from_asperities(&spectrum, model->sigma, model->sigma_over_beta,
                                  model->gt_product, NULL) != SB_OK) {
    return;
  }
  SbPercolationProblem problem = {
      .spectrum = &spectrum,
      .modulus = model->seal[seal].reduced_modulus,
      .contact_pressure = fmax(state->load_net, 0) / out->contact_width,
      .viscosity = model->viscosity,
      .pressure_drop = fabs(pressure.left - pressure.right),
      .width = out->contact_width,
      .circumference = model->bore_circumference,
  };
  if (sb_percolation_solve(&leak, &problem, NULL) != SB_OK) {
    return;
  }
  out->leakage_static = leak.leak_rate;
  out->closing_pressure = leak.closing_pressure;
  out->leak_sensitivity = leak.sensitivity;
  if (leak.percolates) {
    sb_warn(
        &run->summary.warnings, "static-leak", "gland.radial_space",
        "the %s seal leaks at rest: %.3g MPa of contact pressure, open channels close at %.3g MPa",
        sb_seal_name(seal), problem.contact_pressure * 1e-6, leak.closing_pressure * 1e-6);
  } else if (problem.contact_pressure < 1.5 * leak.closing_pressure) {
    sb_warn(
        &run->summary.warnings, "static-leak-near", "gland.radial_space",
        "the %s seal is near its leak at rest: %.3g MPa of contact pressure, channels open below "
        "%.3g MPa",
        sb_seal_name(seal), problem.contact_pressure * 1e-6, leak.closing_pressure * 1e-6);
  }
}

static void summarise_seal(SbRun *run, int seal) {
  const SbSliding *state = &run->cycle.states.state[seal][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
  SbSealSummary *out = &run->summary.seal[seal];
  *out = (SbSealSummary){
      .contact_width = state->contact_right - state->contact_left,
      .contact_left = state->contact_left,
      .contact_right = state->contact_right,
      .load = state->load,
      .load_per_length = state->load_per_length,
      .pressure_peak = state->pressure_peak,
      .film_min = state->film_min,
      .film_central = state->film_central,
      .film_karaszkiewicz = film_by(run, seal, state, SB_FILM_KARASZKIEWICZ),
      .film_thesis = film_by(run, seal, state, SB_FILM_THESIS),
      .film_asymptotic = film_by(run, seal, state, SB_FILM_ASYMPTOTIC),
      .film_reynolds = state->film_reynolds,
      .lambda = state->lambda,
      .friction_boundary = state->boundary_area + state->boundary_load,
      .friction_viscous = state->viscous,
      .friction_static = state->friction_static,
  };
  double friction = sb_sliding_friction(state);
  out->coefficient_of_friction = state->load > 0 ? friction / state->load : NAN;
  out->leakage_per_stroke =
      sb_leak_stroke(run->model.bore_diameter, state->film_central, run->model.stroke);
  static_leak(run, seal, out);
}

// Film dragged out under the outer seal on the way in, less what comes back (thesis equation 5.21).
static double cycle_leakage(const SbRun *run) {
  double net = 0;
  for (size_t i = 0; i < run->cycle.count; i++) {
    const SbCycleSegment *segment = &run->cycle.segment[i];
    const SbSliding *outer =
        &run->cycle.states.state[SB_OUTER][segment->chamber][segment->direction];
    net += sb_leak_stroke(run->model.bore_diameter, outer->film_central,
                          segment->stem1 - segment->stem0);
  }
  return net;
}

static void summarise(SbRun *run) {
  SbSummary *summary = &run->summary;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    summarise_seal(run, seal);
  }
  sb_cycle_energy(&run->cycle, &summary->energy);
  summary->returns = run->cycle.returns;
  summary->force_return_min = run->cycle.force_return_min;
  summary->force_breakaway =
      summary->stage[SB_STAGE_B].reached ? summary->stage[SB_STAGE_B].force : NAN;
  summary->force_peak = 0;
  for (size_t i = 0; i < run->cycle.count; i++) {
    const SbCycleSegment *segment = &run->cycle.segment[i];
    summary->force_peak =
        fmax(summary->force_peak, sb_cycle_force(&run->cycle, segment->platen1, segment->stem1));
  }
  summary->leakage_per_cycle = cycle_leakage(run);
  summary->steps = run->cycle.count;
  summary->error_force = summary->error_load;
  summary->error_energy = fmax(summary->energy.closure, summary->error_load);
  if (!summary->returns) {
    sb_warn(&summary->warnings, "no-return", "surface.gt_product",
            "the stem does not return: least return force %.3g N", summary->force_return_min);
  }
}

SbStatus sb_run_execute(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  double start = now();
  SbSummary *summary = &run->summary;
  *summary = (SbSummary){.error_film = NAN};
  publish(run, 0);
  SbStatus status = solve_states(run, hooks, report);
  if (status == SB_OK || status == SB_ERROR_NOT_CONVERGED) {
    SbStatus build = sb_cycle_build(&run->cycle, status == SB_OK ? report : NULL);
    status = build != SB_OK ? build : status;
    SbStatus frames = emit_frames(run, hooks, report);
    status = frames != SB_OK ? frames : status;
    summarise(run);
  }
  if (hooks != NULL && hooks->progress != NULL && status == SB_OK) {
    size_t count = atomic_load_explicit(&run->published, memory_order_relaxed);
    hooks->progress(hooks->data, 1, count);
  }
  summary->status = status;
  summary->converged = status == SB_OK;
  summary->frames = atomic_load_explicit(&run->published, memory_order_relaxed);
  summary->wall_s = now() - start;
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
  return index < PROFILE_SLOTS && run->profile[index].data != NULL ? &run->profile[index].view
                                                                   : NULL;
}

const SbSummary *sb_run_summary(const SbRun *run) {
  return &run->summary;
}

const SbModel *sb_run_model(const SbRun *run) {
  return &run->model;
}

const SbPlan *sb_run_plan(const SbRun *run) {
  return &run->plan;
}
