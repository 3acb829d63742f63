// Figures of each seal: sliding in the middle of B-C, and the leak at rest.
#include "engine/leak/percolation.h"
#include "engine/leak/stroke.h"
#include "engine/run_private.h"

#include <math.h>
#include <stdlib.h>

static double film_by(SbRun *run, int seal, const SbSliding *state, SbFilmModel film_model) {
  SbFilmProblem problem;
  SbFilm *film = calloc(1, sizeof *film);
  double central = NAN;
  if (film != NULL && state->touches && state->load_net > 0) {
    SbSealPressure pressure = sb_model_seal_pressure(&run->model, seal, SB_CHAMBER_AT_REST);
    sb_sliding_film_problem(&problem, &run->model, seal, pressure, state->load_net, run->speed);
    problem.model = film_model;
    run->summary.counters.reynolds_solves += film_model == SB_FILM_REYNOLDS;
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
  if (!state->touches || state->load_net <= 0 ||
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
      .film_reynolds = run->model.asperities == SB_MODEL_ASPERITIES_COUPLED
                           ? film_by(run, seal, state, SB_FILM_REYNOLDS)
                           : state->film_reynolds,
      .real_area_share = state->area_share,
      .asperity_share = state->asperity_share,
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

void sb_run_summarise_seals(SbRun *run) {
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    summarise_seal(run, seal);
  }
}
