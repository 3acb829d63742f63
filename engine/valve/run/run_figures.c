// Figures of a run: those of each seal, sliding in the middle of B-C, and its leakage at rest; and
// the reasons of missing figures, for a run that ended early or by the choice of models.
#include "engine/contact/rough/percolation.h"
#include "engine/film/laws.h"
#include "engine/fluid/fluid.h"
#include "engine/valve/figures/figures.h"
#include "engine/valve/model/motion_kind.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <stdio.h>

// Central film [m] at the middle of B-C by a model, whichever the run's own is.
static double film_by(SbRun *run, int seal, const SbSealState *state, SbFilmModel film_model) {
  if (run->model->profile != SB_SEAL_PROFILE_CIRCLE) {
    return NAN;
  }
  if (!run->plan.film_laws || !state->touches || !(state->load_net > 0)) {
    return NAN;
  }
  SbFilmProblem problem;
  SbReport report = {0};
  sb_sliding_film_problem(&problem, run->model, seal,
                          sb_model_seal_pressure(run->model, seal, SB_CHAMBER_AT_REST),
                          state->load_net, run->mid_speed);
  problem.model = film_model;
  run->summary.counters.reynolds_solves += sb_film_kind(film_model)->coupled;
  if (sb_film_solve(&run->film, &problem, NULL, &report) == SB_OK) {
    if (sb_film_kind(film_model)->coupled) {
      run->compared_error[seal] =
          run->film.solver.error_film_central + SB_FILM_LAW_LOAD_POWER * state->net_error;
    }
    return run->film.film_central;
  }
  char name[48];
  snprintf(name, sizeof name, "film_by_model.%s", sb_film_kind(film_model)->name);
  sb_seal_reason(&run->summary, seal, name, "%s", report.text);
  return NAN;
}

// Returns the input to change if a seal's contact pressure is too low.
static int pressed_by(const SbModel *model) {
  return sb_input(sb_valve_type(model)->pressed_by);
}

// Whether a seal presses the bore in every state of the cycle that the plan solves: no before not
// known, which is a state whose fit did not converge, before yes.
static SbAnswer presses(const SbRun *run, int seal) {
  const bool whole = run->plan.seal[seal] == SB_DEPTH_WHOLE;
  const int motions = !whole ? 1 : run->plan.ring ? SB_RUN_MOTIONS : SB_RUN_REST;
  SbAnswer answer = SB_ANSWER_YES;
  for (int i = 0; i < SB_CYCLE_CHAMBERS * motions; i++) {
    const int chamber = i / motions;
    const int solved = whole ? chamber : sb_run_first_equal_chamber(run, seal, chamber);
    const SbSealState *state = &run->cycle.state[seal][solved][i % motions];
    if (seal == SB_INNER && chamber == (int)SB_CHAMBER_OPEN) {
      continue; // it has left the land
    }
    if (isnan(state->load)) {
      answer = SB_ANSWER_UNKNOWN;
    } else if (!state->touches || state->load_net <= 0 || state->opened) {
      return SB_ANSWER_NO;
    }
  }
  return answer;
}

// Reports a seal that does not press the bore.
static void report_open(SbRun *run, int seal, bool touches) {
  sb_seal_reason(&run->summary, seal, "leak*", "%s",
                 touches
                     ? "in a state of the cycle the fluid opens the contact or carries it alone, "
                       "or the rubber leaves the bore: the path is open"
                     : "the seal has no contact with the bore under its pressures: the path is "
                       "open");
  sb_seal_reason(&run->summary, seal, "closing*", "the rubber does not press the bore");
  sb_warn_serious(&run->summary.warnings, "seal-open", pressed_by(run->model),
                  "the %s seal is open: it does not press the bore under its pressures",
                  sb_seal_name(seal));
}

// Solves the percolation of a contact with the real area out->rest_area_share. Sets *problem; its
// contact_pressure is the uniform pressure that would cause this area.
static SbStatus percolate(SbPercolation *leak, SbPercolationProblem *problem, const SbRun *run,
                          int seal, const SbSealState *out, SbReport *report) {
  const SbModel *model = run->model;
  const SbSealPressure pressure = sb_model_seal_pressure(model, seal, SB_CHAMBER_AT_REST);
  const double modulus = model->seal[seal].reduced_modulus;
  if (!sb_rough_kind(model->surface)->spectrum) {
    return sb_fail_input(report, SB_ERROR_INFEASIBLE, sb_input(SB_P_MODELS_SURFACE),
                         "Greenwood and Tripp's independent asperities are not valid near "
                         "full contact (models.surface = persson does)");
  }
  if (isnan(out->rest_area_share)) {
    return sb_fail(report, SB_ERROR_INFEASIBLE, "the real contact at rest is not known");
  }
  SbSpectrum spectrum;
  SbStatus status = sb_spectrum_from_asperities(&spectrum, model->sigma, model->sigma_over_beta,
                                                model->gt_product, report);
  if (status != SB_OK) {
    return status;
  }
  *problem = (SbPercolationProblem){
      .spectrum = &spectrum,
      .modulus = modulus,
      .contact_pressure =
          sb_persson_pressure(&spectrum, spectrum.q1, modulus, out->rest_area_share),
      .viscosity = model->viscosity,
      .pressure_drop = fabs(pressure.left - pressure.right),
      .width = out->contact_width,
      .circumference = model->bore_circumference,
  };
  status = sb_percolation_solve(leak, problem, report);
  problem->spectrum = NULL;
  return status;
}

// Reports why the leak at rest is not known.
static void report_unknown_leak(SbRun *run, int seal, const SbReport *report) {
  static const char *const figures[] = {"leakage_static*", "closing_pressure*", "leak_sensitivity"};
  for (size_t i = 0; i < sizeof figures / sizeof figures[0]; i++) {
    sb_seal_reason(&run->summary, seal, figures[i], "leak at rest: %s", report->text);
  }
  if (sb_rough_kind(run->model->surface)->spectrum) { // else a choice of models, no surprise
    sb_warn(&run->summary.warnings, "static-leak-unknown", report->input,
            "the leak at rest is not computed: %s", report->text);
  }
}

// Computes the leakage at rest through the real contact that static friction uses: its real area.
static void static_leak(SbRun *run, int seal, SbSealState *out) {
  const SbModel *model = run->model;
  const SbSealState *state = &run->cycle.state[seal][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
  const SbSealPressure pressure = sb_model_seal_pressure(model, seal, SB_CHAMBER_AT_REST);
  SbWarnings *warnings = &run->summary.warnings;
  SbPercolationProblem problem;
  SbPercolation leak;
  SbReport report = {0};
  bool open = presses(run, seal) == SB_ANSWER_NO;
  out->leak_state = open ? SB_LEAK_OPEN : SB_LEAK_NOT_COMPUTED;
  if (open) {
    report_open(run, seal, state->touches);
  }
  if (!state->touches || !(state->load_net > 0)) {
    return;
  }
  out->leak_area_share = NAN;
  if (percolate(&leak, &problem, run, seal, out, &report) != SB_OK) {
    report_unknown_leak(run, seal, &report);
    return;
  }
  out->leak_area_share = out->rest_area_share;
  out->closing_pressure = leak.closing_pressure;
  if (!open && leak.constriction_gap >= SB_PERCOLATION_OPEN_GAP * model->sigma) {
    open = true;
    sb_seal_reason(
        &run->summary, seal, "leak*",
        "channels of %.3g times the roughness cross the contact: it is open beyond the leak's "
        "law",
        leak.constriction_gap / model->sigma);
  }
  if (!open) {
    // Into the canister where it is below ambient.
    out->leakage_static = pressure.left < pressure.right ? -leak.leak_rate : leak.leak_rate;
    out->leak_sensitivity = leak.sensitivity;
  }
  out->leak_state = open ? SB_LEAK_OPEN : leak.percolates ? SB_LEAK_PERCOLATING : SB_LEAK_CLOSED;
  if (leak.percolates) {
    sb_warn_serious(
        warnings, "static-leak", pressed_by(model),
        "the %s seal leaks at rest: %.3g MPa of contact pressure, open channels close at %.3g MPa",
        sb_seal_name(seal), problem.contact_pressure * 1e-6, leak.closing_pressure * 1e-6);
  } else if (!open && problem.contact_pressure < 1.5 * leak.closing_pressure) {
    sb_warn(
        warnings, "static-leak-near", pressed_by(model),
        "the %s seal is near its leak at rest: %.3g MPa of contact pressure, channels open below "
        "%.3g MPa",
        sb_seal_name(seal), problem.contact_pressure * 1e-6, leak.closing_pressure * 1e-6);
  }
}

// Copies a state to the figures of its stroke.
static void fill_contact(SbContact *out, const SbSealState *state, double speed) {
  bool touches = state->load > 0;
  *out = (SbContact){
      .known = !isnan(state->load),
      .section = touches ? state->section : SB_RING_NO_CONTACT,
      .width = state->contact_right - state->contact_left,
      .left = touches ? state->contact_left : NAN,
      .right = touches ? state->contact_right : NAN,
      .load = state->load,
      .pressure_peak = state->pressure_peak,
      .film_min = state->film_min,
      .film_central = state->film_central,
      .real_area_share = state->real_area_share,
      .friction = sb_sliding_friction(state),
      .speed = speed,
      .rotation = state->rotation,
  };
}

double sb_run_filled_share(const SbSummary *summary, const SbModel *model) {
  const SbStageMark *opens = &summary->stage[SB_STAGE_C], *closes = &summary->stage[SB_STAGE_F];
  const bool both = opens->reached && closes->reached && isfinite(model->filling_time);
  if (sb_valve_type(model)->fills_at_rest) {
    return NAN; // without a time limit
  }
  return both ? fmin(1, (closes->time - opens->time) / model->filling_time) : NAN;
}

// Returns the time [s] for which the vent is open in the first actuation: on the return, or in both
// directions; INFINITY if it is open at the end. Uses every `step`-th frame.
static double vent_time(const SbRun *run, double low, double high, size_t step) {
  const SbModel *model = run->model;
  const bool both_ways = !model->vent_on_return;
  bool open = false;
  double time = 0;
  size_t count = run->count;
  while (run->period > 0 && count > 1 && run->frames[count - 1].time > run->period) {
    count--;
  }
  for (size_t i = 0, next; i + 1 < count; i = next) {
    next = i + step < count ? i + step : count - 1;
    const SbFrame *from = &run->frames[i], *to = &run->frames[next];
    const double a = from->displacement, b = to->displacement;
    const double least = fmin(a, b), most = fmax(a, b);
    const double inside = fmin(most, high) - fmax(least, low);
    open = inside >= 0 && (open || both_ways || (b < a && a >= high));
    if (open) {
      time += (to->time - from->time) * (most > least ? inside / (most - least) : 1);
    }
    open = open && b >= low && b < high;
  }
  return open ? INFINITY : time;
}

// Returns the mass that remains in the chamber after venting [kg]. If the model has no vent,
// venting has unlimited time. Uses every `step`-th frame.
static double kept(const SbRun *run, size_t step) {
  const SbModel *model = run->model;
  const SbValveType *type = sb_valve_type(model);
  double low, high, time = INFINITY;
  if (type->fills_at_rest || (model->pressure_map == SB_MAP_PORTS && !model->chamber_at_once)) {
    time = type->vent(&low, &high, &run->cycle) ? vent_time(run, low, high, step) : 0;
  }
  const double hole = model->outlet_diameter;
  return model->canister_pressure > 0
             ? sb_chamber_remaining(&model->supply,
                                    model->discharge_coefficient * M_PI / 4 * hole * hole,
                                    model->canister_pressure, time)
             : NAN;
}

// Liquid that permeates the outer ring from the chamber [m3/s]: P S p M/rho with the propellant's
// partial pressure p, none outside, through the slab of shelf.h. 0 without a permeability or by a
// fluid without a molar mass.
static double permeation(const SbModel *model) {
  return model->permeability * sb_shelf_slab(model, SB_OUTER) *
         (model->canister_pressure + model->ambient_pressure) * sb_fluids[model->fluid].mass /
         model->density;
}

double sb_run_dose(const SbRun *run, double metered) {
  const double filled = sb_run_filled_share(&run->summary, run->model);
  if (!sb_run_delivers(run)) {
    return NAN;
  }
  return run->model->canister_pressure > 0
             ? fmax(metered * (isnan(filled) ? 1 : filled) - kept(run, 1), 0)
             : 0; // nothing drives out what is not above ambient
}

void sb_run_summarise_seals(SbRun *run) {
  const SbModel *model = run->model;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    SbSealState *out = &run->summary.seal[seal];
    const SbSealState *state = &run->cycle.state[seal][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
    (void)sb_run_sliding(out, run, seal, SB_CYCLE_IN, run->mid_speed, NULL);
    fill_contact(&run->summary.contact[seal].in_stroke, out, run->mid_speed);
    SbSealState *shown = run->shown[seal];
    run->compared_error[seal] = 0;
    if (run->plan.seal[seal] == SB_DEPTH_WHOLE) {
      SbSealState *back = &shown[SB_CYCLE_OUT];
      (void)sb_run_sliding(back, run, seal, SB_CYCLE_OUT, run->back_speed, NULL);
      fill_contact(&run->summary.contact[seal].back, back, -run->back_speed);
    }
    out->contact_width = out->contact_right - out->contact_left;
    out->contact_pressure = out->contact_width > 0 ? out->load_net / out->contact_width : NAN;
    if (!out->touches) {
      out->contact_left = out->contact_right = NAN;
    }
    out->film_karaszkiewicz = film_by(run, seal, state, SB_FILM_KARASZKIEWICZ);
    out->film_thesis = film_by(run, seal, state, SB_FILM_THESIS);
    out->film_asymptotic = film_by(run, seal, state, SB_FILM_ASYMPTOTIC);
    if (sb_contact_law(model)->shares) {
      out->film_reynolds = film_by(run, seal, state, SB_FILM_REYNOLDS);
    }
    out->friction_boundary = out->boundary_area + out->boundary_load;
    out->coefficient_of_friction = out->load > 0 ? sb_sliding_friction(out) / out->load : NAN;
    out->leakage_per_stroke = sb_leak_stroke(model->bore_diameter, 2 * out->layer, model->stroke);
    if (run->plan.seal[seal] >= SB_DEPTH_LEAK) {
      static_leak(run, seal, out);
    }
    shown[SB_CYCLE_IN] = *out;
  }
  sb_figures_of_model(&run->summary, model);
  SbSummary *summary = &run->summary;
  summary->prime_loss =
      86400 * (summary->seal[SB_OUTER].leakage_static + permeation(model)) / model->supply.volume;
  summary->filled_share = sb_run_filled_share(summary, model);
  summary->kept_mass = model->supply.vapour > 0 ? kept(run, 1) : NAN;
  // Straight lines between frames: twice as far apart they are wrong by four times as much.
  const double coarse = model->canister_pressure > 0 ? kept(run, 2) - kept(run, 1) : 0;
  run->kept_error = isfinite(coarse) ? fabs(coarse) : 0;
  summary->dose_mass = sb_run_dose(run, model->supply.volume * model->density);
  if (summary->filled_share < 1) {
    sb_warn(&summary->warnings, "chamber-not-filled", sb_input(SB_P_DRIVE_SPEED),
            "the chamber requires %.3g ms to fill and is open to the canister for %.0f %% of that",
            1e3 * model->filling_time, 100 * summary->filled_share);
  }
}

void sb_run_leakage(SbSummary *summary, const SbModel *model, const SbBore *bore) {
  const double circumference = model->bore_circumference;
  // Equal films in both directions leave rounding only.
  const double net = bore->out - bore->back;
  summary->leakage_per_cycle = fabs(net) <= 1e-12 * bore->out ? 0 : circumference * net;
  if (summary->closes && fabs(net) < summary->error_film * bore->out) {
    sb_warn(&summary->warnings, "leakage-uncertain", sb_input(SB_P_OUTPUT_TOLERANCE),
            "the leakage of a cycle, %.2g nl, is less than the error of the transport in each "
            "direction, %.2g nl",
            1e12 * circumference * net, 1e12 * summary->error_film * circumference * bore->out);
  }
}

// Why figures of a run, or of a seal (`name` is what follows "seals.NAME."), are missing.
typedef struct {
  bool when;
  const char *name, *why;
} Reason;

// Of the whole run for a seal below 0.
static void give(SbSummary *summary, int seal, const Reason *reasons, size_t count) {
  for (const Reason *reason = reasons; reason < reasons + count; reason++) {
    if (reason->when && seal < 0) {
      sb_reason(summary, reason->name, "%s", reason->why);
    } else if (reason->when) {
      sb_seal_reason(summary, seal, reason->name, "%s", reason->why);
    }
  }
}

// Sets why figures of a seal are missing. `closed`: its film is a closed form.
static void give_reasons_of_seal(SbSummary *summary, const SbModel *model, int seal, bool closed) {
  const bool done = !isnan(summary->seal[seal].load); // else the run ended before
  const SbFitKind *fit = sb_fit_kind(model->fit);
  const SbValveType *type = sb_valve_type(model);
  char still[96];
  snprintf(still, sizeof still, "models.fit = %s has no section that friction could turn",
           fit->name);
  const Reason reasons[] = {
      {!fit->section, "contact.in_stroke.rotation_deg", still},
      {!fit->section, "contact.return.rotation_deg", still},
      {summary->seal[seal].load == 0, "*",
       "the seal has no contact with the bore under its pressures"},
      {type->no_gland != NULL, "gland_fill", type->no_gland},
      {model->profile != SB_SEAL_PROFILE_CIRCLE, "film_by_model*",
       "seal.profile is not a circle: the film laws are those of cylinders"},
      {closed, "film_by_model.reynolds", "models.film is a closed form: no film was solved"},
      {!sb_contact_law(model)->shares, "asperity_load_share",
       "models.asperities = beside: asperities and film do not share the load"},
      {done, "film*", "the fluid opens the contact or carries it alone: no film law applies"},
      {done, "lambda", "there is no film"},
      {done, "asperity_load_share", "there is no film that could carry a part of the load"},
      {done, "squeeze*", "there is no film to squeeze out"},
      {done, "real_area_share", "there is no film"},
      {done, "friction*", "there is no film"},
      {done, "coefficient*", "there is no film, so no friction of the contact"},
      {done, "leakage_per_stroke_m3", "there is no film that could transport it"},
      {done, "contact.*", "the seal is not in contact there, or there is no film"},
  };
  give(summary, seal, reasons, sizeof reasons / sizeof reasons[0]);
}

// Sets why figures of the full run are missing; `well`: it did not fail.
static void give_reasons_of_run(SbRun *run, bool well) {
  SbSummary *summary = &run->summary;
  const SbModel *model = run->model;
  const bool rig = !sb_motion_kind(model)->valve;
  const Reason before[] = {
      {!run->plan.life, "life.*", "life.actuations = 1: a life has 2 actuations or more"},
      {rig, "shelf.*", "the sliding plate (models.motion = rig) has no can"},
      {rig, "solver.error_estimate.permeation",
       "the sliding plate (models.motion = rig) has no can"},
      {run->plan.shelf == SB_SHELF_NOTHING, "shelf.*",
       "not requested: output.views has no shelf, and no limit is on it"},
      {run->plan.shelf == SB_SHELF_NOTHING, "solver.error_estimate.permeation",
       "no loss on the shelf was computed"},
      {run->plan.shelf == SB_SHELF_RATES, "shelf.*", "sums over the shelf time were not requested"},
      {run->lacks.status != SB_OK, "life.*", run->lacks.text},
      {!rig, "rig.*", "models.motion is not rig: no plate is pulled"},
      {rig && well, "rig.*",
       "the force has no peak: the plate did not break away, or slid smoothly"},
      {rig, "cycle.force_breakaway_N", "the plate never slips"},
      {rig, "cycle.stages.B*", "the plate never slips"},
      {rig, "cycle.*", "the sliding plate (models.motion = rig) has no valve's cycle"},
      {rig, "seals.*", "the sliding plate (models.motion = rig) has no valve's seals"},
      {rig, "solver.*", "the sliding plate (models.motion = rig) solves no film or fit"},
      {well, "cycle.force_breakaway_N", "the stem never slips: stage B is not reached"},
      {rig, "people.*", "the sliding plate (models.motion = rig) is not pressed by a person"},
      {well, "people.*", "the stem never slips: stage B is not reached"},
      {rig, "dose.*", "the sliding plate (models.motion = rig) gives no dose"},
      {!(model->canister_pressure > 0), "dose.fill*", "nothing drives liquid into the chamber"},
      {!(model->canister_pressure > 0), "dose.kept_mass_kg", "nothing drives liquid out"},
      {!(model->supply.vapour > 0), "dose.kept_mass_kg", "the fluid's vapour has no figures"},
      {sb_valve_type(model)->fills_at_rest, "dose.filled_share",
       "a gasket valve's chamber fills at rest, before the stroke"},
      {well, "dose.filled_share", "the stem does not open and close the chamber: C to F"},
      {well, "dose.prime_loss_per_day", "the outer seal's leak at rest is not known"},
  };
  give(summary, -1, before, sizeof before / sizeof before[0]);
}

void sb_run_set_reasons(SbRun *run, SbStatus status, const SbReport *report) {
  SbSummary *summary = &run->summary;
  const SbModel *model = run->model;
  const SbLife *life = &summary->life;
  const bool well = status == SB_OK;
  const bool closed = !sb_contact_law(model)->shares && !sb_film_kind(model->film)->coupled;
  if (life->failure > 0) {
    sb_reason(summary, "life.*", "the life ends at actuation %ld: its stem does not return",
              life->failure);
  } else if (life->done > 0) {
    sb_reason(summary, "life.*", "the life was not computed beyond actuation %ld", life->done);
  }
  give_reasons_of_run(run, well);
  for (int i = 0; well && i < SB_STAGE_COUNT; i++) {
    char pattern[32];
    snprintf(pattern, sizeof pattern, "cycle.stages.%s.*", sb_stage_name((SbStage)i));
    sb_reason(summary, pattern, "the cycle does not reach stage %s", sb_stage_name((SbStage)i));
  }
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    give_reasons_of_seal(summary, model, seal, closed);
  }
  if (well) {
    const char *outer = sb_figure_reason(summary, sb_figure_find("seals.outer.film_central_m"));
    sb_reason(summary, "cycle.leakage*", "outer seal: %s",
              outer != NULL ? outer : "it is not in contact in all of the cycle's states");
  }
  // The error is that of the loss, and is missing for the reason of the loss.
  const char *loss = sb_figure_reason(summary, sb_figure_find("shelf.permeation_kg_per_s"));
  const char *no_loss = loss != NULL ? loss : "the permeation is a closed form";
  const Reason after[] = {
      {closed, "solver.error_estimate.film", "models.film is a closed form"},
      {!run->plan.film_history, "solver.error_estimate.film_history",
       "models.film_time = steady: no film was followed in time"},
      {well, "solver.error_estimate.film*", "no seal has a film to solve"},
      // The remaining figures would follow after the point where the run ended.
      {status == SB_ERROR_CANCELLED, "*", "the run was stopped before"},
      {well, "solver.error_estimate.permeation", no_loss},
      {!well, "*", report->text[0] != '\0' ? report->text : sb_status_text(status)},
  };
  give(summary, -1, after, sizeof after / sizeof after[0]);
}
