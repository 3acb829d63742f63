// Errors of a run's figures.
//
// A seal's figures have the errors of their state: those of its fit (ring, disc), of its film and
// of the dry contact, which the solvers estimate, in the proportions in which the figure depends on
// them. Figures of the motion depend on every state together. The motion is therefore repeated with
// states perturbed by their errors: once with all kinetic frictions larger, once with all static
// ones, once with the ends of the inner contact off; and with coarser steps if it is integrated.
// The sum of the differences is the error. Everything that follows from inputs by closed forms has
// the error 0.
//
// The errors of the terms are added at their worst. They include discretisation and iteration, not
// the choice of the model.
#include "engine/valve/run/run_errors.h"
#include "engine/valve/figures/figures.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- The motion

void sb_run_begin_errors(SbRun *run) {
  memset(run->motion_error, 0, sizeof run->motion_error);
  run->speed_error[SB_CYCLE_IN] = run->speed_error[SB_CYCLE_OUT] = 0;
  run->leak_error = 0;
}

void sb_run_lose_errors(SbRun *run) {
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    run->motion_error[i] = NAN;
  }
  run->leak_error = NAN;
}

void sb_run_add_errors(SbRun *run, const SbSummary *one, const SbSummary *other, double share) {
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    if (sb_figure(i)->error != SB_BY_MOTION) {
      continue;
    }
    const double a = sb_figure_value(one, i), b = sb_figure_value(other, i);
    // NaN where only one of them has the event.
    run->motion_error[i] += isnan(a) && isnan(b) ? 0 : share * fabs(a - b);
  }
}

// Increases the kinetic friction of all states by its error; perturb_static() does so with static
// friction, separately, because a jump of the stem depends on their difference. Returns false if no
// state has an error.
static bool perturb_kinetic(SbRun *run) {
  SbSealState *all = &run->cycle.state[0][0][0];
  bool any = false;
  for (int i = 0; i < SB_SEAL_COUNT * SB_CYCLE_CHAMBERS * SB_RUN_MOTIONS; i++) {
    any = sb_run_add_kinetic_error(&all[i]) || any;
  }
  run->cycle.kinetic_error_added = any;
  return any;
}

bool sb_run_add_kinetic_error(SbSealState *state) {
  const double slides = sb_sliding_friction(state);
  const bool known = state->friction_error > 0 && slides > 0;
  const double times = known ? 1 + state->friction_error / slides : 1;
  state->boundary_area *= times;
  state->boundary_load *= times;
  state->friction_viscous *= times;
  return known;
}

static bool perturb_static(SbRun *run) {
  SbSealState *all = &run->cycle.state[0][0][0];
  bool any = false;
  for (int i = 0; i < SB_SEAL_COUNT * SB_CYCLE_CHAMBERS * SB_RUN_MOTIONS; i++) {
    if (all[i].static_error > 0 && all[i].friction_static > 0) {
      const double times = 1 + all[i].static_error / all[i].friction_static;
      all[i].friction_static *= times;
      all[i].rest_area *= times;
      all[i].rest_load *= times;
      any = true;
    }
  }
  return any;
}

// Moves the ends of the inner contact by the error of its width, with the signs that add up: the
// position where a contact meets the land's edge on the return is a sum of widths of both
// directions; where it leaves the land there, their difference (sb_cycle_edge_begin()). Returns
// false if no state has an error.
static bool perturb_contact(SbRun *run) {
  const bool meets = sb_valve_type(run->model)->open_beyond;
  SbSealState *all = &run->cycle.state[SB_INNER][0][0];
  bool any = false;
  for (int i = 0; i < SB_CYCLE_CHAMBERS * SB_RUN_MOTIONS; i++) {
    SbSealState *state = &all[i];
    const double by = state->width_error * (state->contact_right - state->contact_left);
    if (by > 0) {
      const double out = !meets && i % SB_RUN_MOTIONS == SB_CYCLE_OUT ? -by : by;
      state->contact_left -= out;
      state->contact_right += out;
      any = true;
    }
  }
  return any;
}

bool sb_run_perturb(SbRun *run, int index) {
  static bool (*const perturb[SB_RUN_PERTURBATIONS])(SbRun *) = {perturb_kinetic, perturb_static,
                                                                 perturb_contact};
  return perturb[index](run);
}

void sb_run_leak_error(SbRun *run) {
  double error[2];
  for (int way = 0; way < 2; way++) {
    error[way] = 0;
    for (int chamber = 0; chamber < SB_CYCLE_CHAMBERS; chamber++) { // fmax() leaves out NaN
      error[way] = fmax(error[way], run->cycle.state[SB_OUTER][chamber][way].central_error);
    }
  }
  // A gasket's stem carries liquid out on its way back.
  const int out = sb_model_way(run->model) > 0 ? SB_CYCLE_IN : SB_CYCLE_OUT;
  run->leak_error += run->model->bore_circumference *
                     (error[out] * run->bore.out + error[1 - out] * run->bore.back);
}

// ---- A seal's state

static double positive(double error) {
  return error > 0 ? error : 0; // NaN: a closed form
}

// Returns the motion, an index of the cycle's states, whose state a figure describes.
static int motion_of(const SbFigure *figure) {
  return figure->direction == SB_DIRECTION_OUT ? SB_CYCLE_OUT : SB_CYCLE_IN;
}

static double leak_error(const SbSealState *state) {
  const double share = state->leak_area_share;
  // Near full contact the pressure changes as the open part does.
  const double pressure = state->rest_error * share / fmax(1 - share, 1e-12);
  return fabs(state->leak_sensitivity) * (pressure + state->rest_error) + state->width_error;
}

// Relative error of a figure that a seal's state has.
static double relative_of_state(const SbRun *run, const SbFigure *figure,
                                const SbSealState *state) {
  const double film = positive(state->central_error);
  const double speed = run->speed_error[motion_of(figure)];
  switch ((int)figure->error) {
  case SB_BY_LOAD:
    return state->load_error;
  case SB_BY_MEAN:
    return state->net_error + state->width_error;
  case SB_BY_PEAK:
    return state->peak_error;
  case SB_BY_WIDTH:
    return state->width_error;
  case SB_BY_FILM_LEAST:
    return positive(state->film_error) + speed;
  case SB_BY_FILM:
    return film + speed;
  case SB_BY_FILM_LAW:
    return SB_FILM_LAW_LOAD_POWER * state->net_error + speed;
  case SB_BY_AREA:
    return state->area_error + speed;
  case SB_BY_REST_AREA:
    return state->rest_error;
  case SB_BY_SHARE:
    return state->share_error + speed;
  case SB_BY_LEAK:
    return leak_error(state);
  case SB_BY_SLOPE:
    return state->leak_sensitivity != 0 ? leak_error(state) / fabs(state->leak_sensitivity) : 0;
  case SB_BY_SPEED:
    return speed;
  default:
    return NAN;
  }
}

// Returns the error of a section's rotation [degrees]. The rotation of a rubbing section scatters
// more than its load (1.6 to 7 % where loads scatter by 0.1 %). A section with little rotation is
// known to the same fraction of the angle by which its contact shears it, about mean pressure over
// modulus.
static double turn_error(const SbRun *run, int seal, const SbSealState *state, double value) {
  const double width = state->contact_right - state->contact_left;
  const double strain =
      width > 0 ? state->load_per_length / width / run->model->seal[seal].modulus : 0;
  return (state->load_error + state->width_error) * (5 * fabs(value) + strain * 180 / M_PI);
}

// Relative error of the time of the squeeze-out, which is that of the solved speed: the displayed
// state has nearly the same relative errors. Film and asperities depend on the speed, too.
static double squeeze_error(const SbRun *run, int seal, const SbSealState *state, double speed) {
  SbSealState off = *state;
  off.central_error = positive(state->central_error) + speed;
  off.share_error += speed;
  const SbSlidingTask task = {.model = run->model, .seal = seal, .memory = run->memory[seal]};
  return sb_sliding_squeeze_error(&off, &task);
}

// Absolute error of a seal's figure.
static double of_seal(const SbRun *run, const SbFigure *figure, double value) {
  const int seal = figure->seal;
  const SbSealState *state = &run->shown[seal][motion_of(figure)];
  const double speed = run->speed_error[motion_of(figure)];
  const double friction = sb_sliding_friction(state);
  switch ((int)figure->error) {
  case SB_BY_INPUT:
    return 0;
  case SB_BY_EDGE:
    return state->width_error * (state->contact_right - state->contact_left);
  case SB_BY_FILM_SOLVED:
    return fabs(value) *
           (fmax(run->compared_error[seal],
                 sb_contact_law(run->model)->shares ? 0 : positive(state->central_error)) +
            speed);
  case SB_BY_BOUNDARY:
    return state->boundary_error;
  case SB_BY_TURN:
    return turn_error(run, seal, state, value);
  case SB_BY_VISCOUS:
    return state->viscous_error + speed * fabs(value);
  case SB_BY_FRICTION:
    return state->friction_error + speed * fabs(value);
  case SB_BY_STATIC:
    return state->static_error;
  case SB_BY_SQUEEZE_OUT:
    return fabs(value) * squeeze_error(run, seal, state, speed);
  case SB_BY_COEFFICIENT:
    return fabs(value) * (state->load_error + state->friction_error / fmax(friction, 1e-300));
  default:
    return fabs(value) * relative_of_state(run, figure, state);
  }
}

// ---- Dose, life, shelf, rig

static double of_path(const SbRun *run, const char *path) {
  return sb_figure_error_absolute(&run->summary, sb_figure_find(path));
}

static double of_dose(const SbRun *run, const SbFigure *figure) {
  const SbSummary *summary = &run->summary;
  const SbModel *model = run->model;
  const double times =
      of_path(run, "cycle.stages.C.time_s") + of_path(run, "cycle.stages.F.time_s");
  const double filled = summary->filled_share < 1 ? times / model->filling_time : 0;
  switch ((int)figure->error) {
  case SB_BY_FILLED:
    return filled;
  case SB_BY_KEPT:
    return run->kept_error;
  case SB_BY_DOSE:
    return filled * model->supply.volume * model->density + run->kept_error;
  default: { // what permeates is a closed form
    const SbSealState *outer = &summary->seal[SB_OUTER];
    return 86400 * fabs(outer->leakage_static) * leak_error(outer) / model->supply.volume;
  }
  }
}

static double of_life(const SbRun *run, const SbFigure *figure, double value) {
  const bool coupled = sb_contact_law(run->model)->shares;
  // Between solved actuations parabolas are used, checked to the tolerance.
  const double between = coupled ? run->model->tolerance : 0;
  const SbLife *life = &run->summary.life;
  switch ((int)figure->error) {
  case SB_BY_LIFE_PEAK:
    return of_path(run, "cycle.force_peak_N");
  case SB_BY_LIFE_BREAKAWAY:
    return of_path(run, "cycle.force_breakaway_N");
  case SB_BY_LIFE_RETURN:
    return of_path(run, "cycle.force_return_min_N") +
           (figure->offset == offsetof(SbSummary, life.return_least)
                ? between * positive(life->first.force_breakaway)
                : 0);
  case SB_BY_LIFE_NET:
    return (double)life->done * of_path(run, "cycle.leakage_per_cycle_m3") +
           between * positive(life->carried);
  default: {
    const SbSealState *outer = &run->shown[SB_OUTER][SB_CYCLE_IN];
    const bool sum = figure->offset == offsetof(SbSummary, life.carried);
    return fabs(value) * (positive(outer->central_error) + (sum ? between : 0));
  }
  }
}

static double of_shelf(const SbRun *run, const SbFigure *figure, double value) {
  const SbShelf *shelf = &run->summary.shelf;
  const double ring = positive(shelf->error);
  const SbShelfSeal *seal = &shelf->seal[sb_shelf_seal(run->model)];
  const double channels = positive(fabs(seal->sensitivity) * shelf->pressure_error);
  const double passes = positive(shelf->interface), through = positive(shelf->permeation);
  const double both = (ring * through + channels * passes) / fmax(through + passes, 1e-300);
  switch ((int)figure->error) {
  case SB_BY_PERMEATION:
    return fabs(value) * ring;
  case SB_BY_CHANNELS:
    return fabs(value) * channels;
  case SB_BY_SLOPE:
    return fabs(value) * shelf->pressure_error;
  case SB_BY_SHELF_PRESSURE:
    return fabs(value) * shelf->pressure_error;
  case SB_BY_LOSS:
    return fabs(value) * both;
  case SB_BY_MASS_LEFT:
    return positive(shelf->loss) * both;
  default:
    return both > 0 ? 1 : 0; // whole doses
  }
}

static double of_rig(const SbRun *run, const SbFigure *figure) {
  const SbRig *rig = &run->model->rig;
  if (figure->quantity == SB_FIGURE_QUANTITY_TIME) {
    return 1 / rig->rate;
  }
  // Between two samples the thread is wound up by speed/rate: the largest sample misses the peak by
  // half of that on average.
  const double force = 0.5 * rig->thread_stiffness * rig->speed / rig->rate;
  return figure->quantity == SB_FIGURE_QUANTITY_FORCE ? force : force / rig->load;
}

static double error_of(const SbRun *run, int index) {
  const SbFigure *figure = sb_figure(index);
  const double value = sb_figure_value(&run->summary, index);
  switch (figure->error) {
  case SB_BY_INPUT:
    return 0;
  case SB_BY_RESIDUAL:
    return NAN;
  case SB_BY_MOTION:
    return run->motion_error[index];
  case SB_BY_NET_LEAK: {
    const bool all = figure->offset == offsetof(SbSummary, leakage_net);
    return (all ? (double)run->model->actuations : 1) * run->leak_error;
  }
  case SB_BY_FILLED:
  case SB_BY_KEPT:
  case SB_BY_DOSE:
  case SB_BY_PRIME:
    return of_dose(run, figure);
  case SB_BY_SAMPLES:
    return of_rig(run, figure);
  case SB_BY_LIFE_PEAK:
  case SB_BY_LIFE_BREAKAWAY:
  case SB_BY_LIFE_RETURN:
  case SB_BY_LIFE_FILM:
  case SB_BY_LIFE_NET:
    return of_life(run, figure, value);
  case SB_BY_PERMEATION:
  case SB_BY_CHANNELS:
  case SB_BY_LOSS:
  case SB_BY_MASS_LEFT:
  case SB_BY_DOSES_LEFT:
  case SB_BY_SHELF_PRESSURE:
    return of_shelf(run, figure, value);
  default:
    break;
  }
  if (figure->error == SB_BY_SLOPE && figure->seal == SB_SEAL_COUNT) {
    return of_shelf(run, figure, value);
  }
  if (figure->seal == SB_SEAL_COUNT) { // of the valve, through its outer seal
    SbFigure outer = *figure;
    outer.seal = SB_OUTER;
    return of_seal(run, &outer, value);
  }
  return of_seal(run, figure, value);
}

void sb_run_fill_errors(SbRun *run) {
  SbSummary *summary = &run->summary;
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    summary->error[i] = isfinite(sb_figure_value(summary, i)) ? error_of(run, i) : NAN;
  }
}

// The figure with the largest error that is reported, of the catalogue or of its groups; -1: none.
static int largest(const SbSummary *summary, double *error, int *count) {
  int worst = -1;
  *error = 0;
  *count = 0;
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const bool group = sb_figure_is_estimate(sb_figure(i));
    const double own = group                                        ? sb_figure_value(summary, i)
                       : sb_figure_error_reason(summary, i) == NULL ? sb_figure_error(summary, i)
                                                                    : NAN;
    *count += own > SB_ERROR_LARGE;
    if (own > *error) {
      *error = own;
      worst = i;
    }
  }
  return worst;
}

SbStatus sb_run_check_errors(SbRun *run, SbStatus status, SbReport *report) {
  SbSummary *summary = &run->summary;
  double error;
  int count;
  const int worst = largest(summary, &error, &count);
  if (!(error > SB_ERROR_LARGE)) {
    return status;
  }
  char others[64] = "";
  if (count > 1) {
    snprintf(others, sizeof others, " (and %d other estimates are above 30 %%)", count - 1);
  }
  sb_warn(&summary->warnings, "error-estimate-large", sb_input(SB_P_OUTPUT_TOLERANCE),
          "the estimated error of %s is %.0f %%%s: reduce output.tolerance, or add output.frames",
          sb_figure(worst)->path, 100 * error, others);
  if (error > SB_ERROR_USELESS && status == SB_OK) {
    status = sb_fail_input(report, SB_ERROR_NOT_CONVERGED, sb_input(SB_P_OUTPUT_TOLERANCE),
                           "the estimated error of %s is %.0f %%, more than the value",
                           sb_figure(worst)->path, 100 * error);
  }
  return status;
}

double sb_run_error_friction(const SbRun *run) {
  // Friction that holds a stem throughout is the push, however large it could become.
  const bool moves = run->summary.outcome != SB_OUTCOME_NEVER_MOVED;
  const double peak = moves ? run->summary.force_peak : 0;
  double error = 0;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    error += fmax(run->friction_error[seal], run->static_error[seal]);
  }
  return peak > 0 ? error / peak : 0;
}
