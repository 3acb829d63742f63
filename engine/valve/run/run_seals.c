// Figures of each seal: sliding in the middle of B-C, and the leak at rest.
#include "engine/contact/rough/percolation.h"
#include "engine/film/stroke.h"
#include "engine/valve/figures.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static double film_by(SbRun *run, int seal, const SbSliding *state, SbFilmModel film_model) {
  SbFilmProblem problem;
  SbFilm *film = run->plan.film_laws ? calloc(1, sizeof *film) : NULL;
  double central = NAN;
  if (film != NULL && state->touches && state->load_net > 0) {
    SbSealPressure pressure = sb_model_seal_pressure(&run->model, seal, SB_CHAMBER_AT_REST);
    sb_sliding_film_problem(&problem, &run->model, seal, pressure, state->load_net, run->speed);
    problem.model = film_model;
    run->summary.counters.reynolds_solves += film_model == SB_FILM_REYNOLDS;
    SbReport report = {0};
    if (sb_film_solve(film, &problem, NULL, &report) == SB_OK) {
      central = film->film_central;
    }
    if (isnan(central)) {
      char name[48];
      snprintf(name, sizeof name, "film_by_model.%s", sb_film_model_name(film_model));
      sb_seal_reason(&run->summary, seal, name, "%s", report.text);
    }
  }
  free(film);
  return central;
}

// Whether a seal presses the bore in every state in which the cycle needs it to.
static bool presses(const SbRun *run, int seal) {
  for (int chamber = 0; chamber < SB_CYCLE_CHAMBERS; chamber++) {
    bool needed = seal == SB_OUTER || chamber != SB_CHAMBER_OPEN;
    int alike = sb_run_first_alike(run, seal, chamber);
    const SbSliding *state = &run->cycle.states.state[seal][alike][SB_CYCLE_IN];
    if (needed && (!state->touches || state->load_net <= 0 || state->opened)) {
      return false;
    }
  }
  return true;
}

// Leak at rest under the pressure that the rubber itself exerts on the bore (net of the fluid's
// step).
static void static_leak(SbRun *run, int seal, SbSealSummary *out) {
  const SbModel *model = &run->model;
  const SbSliding *state = &run->cycle.states.state[seal][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
  SbSealPressure pressure = sb_model_seal_pressure(model, seal, SB_CHAMBER_AT_REST);
  SbSpectrum spectrum;
  SbPercolation leak;
  SbReport report = {0};
  bool open = !presses(run, seal);
  out->leak_state = open ? SB_LEAK_OPEN : SB_LEAK_NOT_COMPUTED;
  if (open) {
    sb_seal_reason(&run->summary, seal, "leak*", "%s",
                   state->touches
                       ? "the rubber presses the bore no more than the fluid does, or leaves "
                         "it in a state of the cycle: the path is open"
                       : "the seal does not touch the bore under its pressures: the path is "
                         "open");
    sb_seal_reason(&run->summary, seal, "closing*", "the rubber does not press the bore");
    sb_warn(&run->summary.warnings, "seal-open", "gland.radial_space",
            "the %s seal is open: it does not press the bore under its pressures",
            sb_seal_name(seal));
  }
  if (!state->touches || !(state->load_net > 0)) {
    return;
  }
  SbStatus status = sb_spectrum_from_asperities(&spectrum, model->sigma, model->sigma_over_beta,
                                                model->gt_product, &report);
  SbPercolationProblem problem = {
      .spectrum = &spectrum,
      .modulus = model->seal[seal].reduced_modulus,
      .contact_pressure = out->contact_pressure,
      .viscosity = model->viscosity,
      .pressure_drop = fabs(pressure.left - pressure.right),
      .width = out->contact_width,
      .circumference = model->bore_circumference,
  };
  status = status != SB_OK ? status : sb_percolation_solve(&leak, &problem, &report);
  if (status != SB_OK) {
    static const char *const figures[] = {"leakage_static*", "closing_pressure*",
                                          "leak_sensitivity"};
    for (size_t i = 0; i < sizeof figures / sizeof figures[0]; i++) {
      sb_seal_reason(&run->summary, seal, figures[i], "leak at rest: %s", report.text);
    }
    sb_warn(&run->summary.warnings, "static-leak-unknown", report.parameter,
            "the leak at rest is not computed: %s", report.text);
    return;
  }
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
    out->leakage_static = leak.leak_rate;
    out->leak_sensitivity = leak.sensitivity;
  }
  out->leak_state = open ? SB_LEAK_OPEN : leak.percolates ? SB_LEAK_PERCOLATING : SB_LEAK_CLOSED;
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
  out->contact_width = state->contact_right - state->contact_left;
  out->contact_left = state->touches ? state->contact_left : NAN;
  out->contact_right = state->touches ? state->contact_right : NAN;
  out->load = state->load;
  out->load_per_length = state->load_per_length;
  out->contact_pressure = state->load_net / (state->contact_right - state->contact_left);
  out->pressure_peak = state->pressure_peak;
  out->film_min = state->film_min;
  out->film_central = state->film_central;
  out->film_karaszkiewicz = film_by(run, seal, state, SB_FILM_KARASZKIEWICZ);
  out->film_thesis = film_by(run, seal, state, SB_FILM_THESIS);
  out->film_asymptotic = film_by(run, seal, state, SB_FILM_ASYMPTOTIC);
  out->film_reynolds = run->model.asperities == SB_MODEL_ASPERITIES_COUPLED
                           ? film_by(run, seal, state, SB_FILM_REYNOLDS)
                           : state->film_reynolds;
  out->real_area_share = state->area_share;
  out->asperity_share = state->asperity_share;
  out->lambda = state->lambda;
  out->friction_boundary = state->boundary_area + state->boundary_load;
  out->friction_viscous = state->viscous;
  out->friction_static = state->friction_static;
  out->leakage_static = out->closing_pressure = out->leak_sensitivity = NAN;
  double friction = sb_sliding_friction(state);
  out->coefficient_of_friction = state->load > 0 ? friction / state->load : NAN;
  out->leakage_per_stroke =
      sb_leak_stroke(run->model.bore_diameter, state->film_central, run->model.stroke);
  if (run->plan.seal[seal] >= SB_DEPTH_LEAK) {
    static_leak(run, seal, out);
  }
}

void sb_run_summarise_seals(SbRun *run) {
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    summarise_seal(run, seal);
  }
}
