// Joins fitment, film, surface and friction for one seal; see sliding.h for the equations.
//
// With a fitment model that gives a pressure of its own the solved film lies on this body: its
// edges, its pressure, its compliance; the half-plane's film stands beside it. The film's load is
// the net one: the fluid on either side carries its own step, so a contact from l to r under the
// total load W leaves W - p_left (0 - l) - p_right (r - 0) to the film (README, Definitions). What
// it leaves out: beside the film, asperities do not take load off it (they carry 1 to 14 % of it at
// its least, docs/thesis.md, 10; coupled they share it); the closed forms know no inlet starvation.
#include "engine/valve/sliding.h"

#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/contact/rough/persson.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct SbSlidingMemory {
  SbFit fit;
  SbFilm film;        // of the half-plane, or of a law
  SbFilm fitted_film; // of the fitted body
  bool fitted_last;   // which of them the last evaluation gave
  SbFilm rest;        // dry rough contact, coupled asperities only
  SbFilmProfile film_profile, fitted_profile, rest_profile;
  bool rest_fitted; // on the fitted body
  double rest_load;
  SbSealPressure rest_pressure;
  bool rested;
  SbFilmSolver *solver; // NULL until a film is solved: laws need none
  bool fitted;
  double fitted_pressure; // difference for which `fit` stands
  int fitted_seal;
};

double sb_sliding_friction(const SbSliding *state) {
  return state->boundary_area + state->boundary_load + state->viscous;
}

SbStatus sb_sliding_memory_create(SbSlidingMemory **out, SbReport *report) {
  *out = calloc(1, sizeof **out);
  if (*out == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a seal's workspace");
  }
  return sb_succeed(report);
}

void sb_sliding_memory_destroy(SbSlidingMemory *memory) {
  if (memory != NULL) {
    sb_film_solver_destroy(memory->solver);
    free(memory);
  }
}

static SbStatus film_solve(SbFilm *out, const SbFilmProblem *problem, SbSlidingMemory *memory,
                           SbReport *report) {
  if (problem->model == SB_FILM_REYNOLDS && memory->solver == NULL) {
    SbStatus status = sb_film_solver_create(&memory->solver, report);
    if (status != SB_OK) {
      return status;
    }
  }
  SbFilmProblem lent = *problem;
  lent.profile = out == &memory->film          ? &memory->film_profile
                 : out == &memory->fitted_film ? &memory->fitted_profile
                                               : &memory->rest_profile;
  return sb_film_solve(out, &lent, memory->solver, report);
}

void sb_sliding_memory_forget(SbSlidingMemory *memory) {
  memory->fitted = false;
  memory->rested = false;
}

const SbFit *sb_sliding_fit(const SbSlidingMemory *memory) {
  return &memory->fit;
}

const SbFilm *sb_sliding_film(const SbSlidingMemory *memory) {
  return memory->fitted_last ? &memory->fitted_film : &memory->film;
}

void sb_sliding_fit_problem(SbFitProblem *out, const SbModel *model, int seal, double pressure) {
  const SbSealModel *ring = &model->seal[seal];
  *out = (SbFitProblem){
      .model = model->fit,
      .section_diameter = ring->section_diameter,
      .inner_diameter = ring->inner_diameter,
      .modulus = ring->modulus,
      .poisson_ratio = ring->poisson_ratio,
      .mooney_share = ring->mooney_share,
      .housing_modulus = model->housing_modulus,
      .housing_poisson = model->housing_poisson_ratio,
      .radial_space = model->radial_space,
      .bore_diameter = model->bore_diameter,
      .gland_width = model->axial_width,
      .pressure = pressure,
      .tolerance = model->tolerance,
  };
}

static SbStatus solve_fit(SbSlidingMemory *memory, const SbModel *model, int seal, double pressure,
                          SbSlidingCounts *counts, SbReport *report) {
  if (memory->fitted && memory->fitted_pressure == pressure && memory->fitted_seal == seal) {
    return SB_OK;
  }
  SbFitProblem problem;
  sb_sliding_fit_problem(&problem, model, seal, pressure);
  problem.surface_wanted =
      model->film == SB_FILM_REYNOLDS || model->asperities == SB_MODEL_ASPERITIES_COUPLED;
  SbStatus status = sb_fit_solve(&memory->fit, &problem, report);
  counts->fit_solves++;
  counts->disc_solves += problem.model == SB_FIT_DISC || problem.model == SB_FIT_DISC_THESIS;
  counts->ring_solves += problem.model == SB_FIT_RING;
  counts->newton_iterations += memory->fit.solver.newton_iterations;
  memory->fitted = status == SB_OK;
  memory->fitted_pressure = pressure;
  memory->fitted_seal = seal;
  return status;
}

void sb_sliding_film_problem(SbFilmProblem *out, const SbModel *model, int seal,
                             SbSealPressure pressure, double load_net, double speed) {
  sb_film_problem_init(out);
  out->load = load_net;
  out->speed = speed;
  out->radius = model->seal[seal].radius;
  out->modulus = model->seal[seal].reduced_modulus;
  out->viscosity = model->viscosity;
  out->pressure_left = pressure.left;
  out->pressure_right = pressure.right;
  out->pressure_viscosity = model->pressure_viscosity;
  out->eyring_stress = model->eyring_stress;
  // A fluid beside the seal that is below its vapour pressure has boiled away: the film then
  // breaks at the pressure around it.
  out->rupture_pressure = fmin(model->rupture_pressure, fmin(pressure.left, pressure.right));
  out->tolerance = model->tolerance;
  out->profile_points = 1500; // drawn and written, not differentiated
}

// Gives a surface the gap whose dry contact has the fitment's pressure, and solves that for a
// check. A gap of many polynomials may touch again outside the contact; then fewer do.
static SbStatus match_fit(SbSurfaceCompliance *surface, double load, const SbFit *fit, double left,
                          double right, SbReport *report) {
  enum { ORDER = 8, LEAST = 3 };
  SbStatus status = SB_ERROR_INPUT;
  for (int order = ORDER; order >= LEAST && status != SB_OK; order--) {
    SbDryContact dry;
    status = sb_compliance_match(surface, order, fit->profile_count, fit->profile_x, fit->profile_p,
                                 left, right, report);
    if (status == SB_OK) {
      status = sb_dry_contact(&dry, surface, load, left, right, report);
    }
  }
  return status;
}

SbStatus sb_sliding_surface(SbSurfaceCompliance *out, double *load, const SbFit *fit,
                            const SbModel *model, int seal, SbSealPressure pressure,
                            SbWarnings *warnings, SbReport *report) {
  bool own = fit->model == SB_FIT_DISC || fit->model == SB_FIT_RING;
  if (!own || fit->profile_count < 12) {
    return sb_fail(report, SB_ERROR_INPUT, "the fitment model gives no pressure of a body");
  }
  const SbSealModel *ring = &model->seal[seal];
  double low = fmin(pressure.left, pressure.right);
  double left = pressure.left - low;
  double right = pressure.right - low;
  *load = fit->load_per_length + left * fit->contact_left - right * fit->contact_right;
  if (fit->surface.modes > 0) {
    // Condensed against a rigid bore; the housing gives way as a half-plane beside it.
    double rubber = 2 * ring->modulus / (1 - ring->poisson_ratio * ring->poisson_ratio);
    *out = fit->surface;
    out->modulus = 1 / (1 / out->modulus + 1 / ring->reduced_modulus - 1 / rubber);
    if (match_fit(out, *load, fit, left, right, report) == SB_OK) {
      return SB_OK;
    }
  }
  if (fit->model == SB_FIT_RING && warnings != NULL) {
    sb_warn(warnings, "film-disc-surface", "models.fit",
            "the %s ring's surface beside its contact is too steep for a film on it: the film "
            "takes the ring's pressure, but gives way like a linear disc",
            sb_seal_name(seal));
  }
  double radius = 0.5 * fit->section_diameter_fitted;
  double middle = 0.5 * (fit->contact_left + fit->contact_right);
  // The disc's middle is the contact's: pressure against the wall moves both.
  double reach = 0.7 * fit->contact_width;
  SbStatus status = sb_compliance_disc(out, radius, ring->modulus, ring->poisson_ratio,
                                       fmin(reach, 0.9 * radius), report);
  if (status != SB_OK) {
    return status;
  }
  out->left += middle;
  out->right += middle;
  out->modulus = ring->reduced_modulus;
  return match_fit(out, *load, fit, left, right, report);
}

static SbStatus solve_counted(SbFilm *film, const SbFilmProblem *problem, SbSlidingMemory *memory,
                              SbSlidingCounts *counts, SbReport *report) {
  SbStatus status = film_solve(film, problem, memory, report);
  counts->reynolds_solves++;
  counts->newton_iterations += (size_t)film->solver.newton_iterations;
  return status;
}

// The film on the fitted body in place of the half-plane's; false where there is none or it fails.
static bool solve_fitted(SbFilm *film, const SbFilmProblem *plane, const SbModel *model, int seal,
                         SbSealPressure pressure, SbSlidingMemory *memory, SbSlidingCounts *counts,
                         SbWarnings *warnings) {
  if (memory->fit.model != SB_FIT_DISC && memory->fit.model != SB_FIT_RING) {
    return false;
  }
  SbReport report = {0};
  SbSurfaceCompliance surface;
  SbFilmProblem problem = *plane;
  problem.compliance = &surface;
  SbStatus status = sb_sliding_surface(&surface, &problem.load, &memory->fit, model, seal, pressure,
                                       warnings, &report);
  if (status == SB_OK) {
    problem.modulus = surface.modulus;
    status = solve_counted(film, &problem, memory, counts, &report);
  }
  if (status != SB_OK) {
    sb_warn(warnings, "film-half-plane", "models.fit",
            "no film on the fitted %s seal (%s): it is the half-plane's", sb_seal_name(seal),
            report.text);
  }
  return status == SB_OK;
}

// A solver that stopped before its first solution has no figures; one that stopped above the
// tolerance has those of its last, with their error.
static bool has_film(const SbFilm *film, SbStatus status) {
  return status == SB_OK || (status == SB_ERROR_NOT_CONVERGED && film->film_central > 0);
}

// A seal's film figures are those of `film`, solved on the half-plane or on the fitted body; NaN
// stays where it has none.
static void take_film(SbSliding *out, const SbFilm *film, SbStatus status, bool fitted,
                      const SbFit *fit) {
  if (!has_film(film, status)) {
    return;
  }
  out->film_fitted = fitted;
  out->film_min = film->film_min;
  out->film_central = film->film_central;
  out->film_error = fmax(film->solver.error_film_min, film->solver.error_film_central);
  if (fitted && fit->model == SB_FIT_RING) {
    // A thin film goes with the power -0.8 of the strength of the pressure's root at its inlet,
    // which goes with peak over root of width but hangs on few nodes of the ring's mesh: measured,
    // it is out by up to five times their relative errors.
    out->film_error +=
        0.8 * 5 *
        (fit->solver.error_estimate.pressure_peak + 0.5 * fit->solver.error_estimate.contact_width);
  }
}

// Layer that the return stroke finds on the bore: what the in-stroke carried through the contact,
// flow over the wall's speed, at the drive's speed and the same pressures. 0 floods the inlet.
static SbStatus carried_layer(double *layer, const SbFilmProblem *back, const SbModel *model,
                              SbSlidingMemory *memory, SbSlidingCounts *counts, SbReport *report) {
  SbFilmProblem in = *back;
  in.speed = model->speed;
  in.inlet_film = 0;
  SbStatus status = solve_counted(&memory->film, &in, memory, counts, report);
  *layer = status == SB_OK ? fabs(memory->film.flow / in.speed) : 0;
  return status;
}

// What a run's options cannot reach, told once.
static void option_warnings(SbWarnings *warnings, const SbModel *model, int seal,
                            const SbFilmProblem *problem) {
  bool asked = model->pressure_viscosity > 0 || model->eyring_stress > 0 ||
               model->rupture_pressure != 0 || model->inlet_carried;
  if (asked && problem->model != SB_FILM_REYNOLDS) {
    sb_warn(warnings, "film-options", "models.film",
            "pressure viscosity, Eyring stress, rupture pressure and a carried inlet act on the "
            "solved film only (models.film = reynolds), not on a power law");
  } else if (problem->rupture_pressure < model->rupture_pressure) {
    sb_warn(warnings, "rupture-ambient", "fluid.rupture_pressure",
            "the film of the %s seal breaks at the %.3g MPa around it: the rupture pressure of "
            "%.3g MPa is higher",
            sb_seal_name(seal), 1e-6 * problem->rupture_pressure, 1e-6 * model->rupture_pressure);
  }
  if (model->hamaker > 0 && model->asperities != SB_MODEL_ASPERITIES_COUPLED) {
    sb_warn(warnings, "adhesion-beside", "models.adhesion",
            "adhesion acts in the solve of film and asperities together only (models.asperities = "
            "coupled): left out here");
  }
}

static SbStatus solve_film(SbSliding *out, const SbModel *model, int seal, SbSealPressure pressure,
                           double speed, SbSlidingMemory *memory, SbSlidingCounts *counts,
                           SbWarnings *warnings, SbReport *report) {
  SbFilmProblem problem;
  sb_sliding_film_problem(&problem, model, seal, pressure, out->load_net, speed);
  problem.model = model->film;
  option_warnings(warnings, model, seal, &problem);
  if (model->inlet_carried && speed < 0 && problem.model == SB_FILM_REYNOLDS) {
    SbStatus carried = carried_layer(&problem.inlet_film, &problem, model, memory, counts, report);
    if (carried != SB_OK) {
      return carried;
    }
  }
  memory->fitted_last = false;
  SbStatus status = film_solve(&memory->film, &problem, memory, report);
  if (problem.model == SB_FILM_REYNOLDS) {
    counts->reynolds_solves++;
    counts->newton_iterations += (size_t)memory->film.solver.newton_iterations;
  }
  if (status != SB_OK && status != SB_ERROR_NOT_CONVERGED) {
    return status;
  }
  const SbFilm *best = &memory->film;
  take_film(out, best, status, false, &memory->fit);
  if (problem.model == SB_FILM_REYNOLDS) {
    out->film_reynolds = out->film_central;
  } else {
    out->film_error = NAN;
  }
  if (problem.model == SB_FILM_REYNOLDS && status == SB_OK &&
      solve_fitted(&memory->fitted_film, &problem, model, seal, pressure, memory, counts,
                   warnings)) {
    best = &memory->fitted_film;
    take_film(out, best, SB_OK, true, &memory->fit);
    memory->fitted_last = true;
  }
  sb_warnings_merge(warnings, &best->warnings);
  return status;
}

// The film problem with asperities in it.
static void coupled_problem(SbFilmProblem *out, const SbModel *model, int seal,
                            SbSealPressure pressure, double load_net, double speed) {
  sb_sliding_film_problem(out, model, seal, pressure, load_net, speed);
  out->surface = model->surface;
  out->gt_product = model->gt_product;
  out->sigma = model->sigma;
  out->sigma_over_beta = model->sigma_over_beta;
  out->hamaker = model->hamaker;
  out->shear_strength = model->shear_strength;
  out->load_coefficient = model->load_coefficient;
}

// Solves it on the fitted body, or on the half-plane where that cannot be.
static SbStatus solve_rough(SbFilm *film, bool *fitted, const SbFilmProblem *plane,
                            const SbModel *model, int seal, SbSealPressure pressure,
                            SbSlidingMemory *memory, SbSlidingCounts *counts, SbWarnings *warnings,
                            SbReport *report) {
  *fitted = solve_fitted(film, plane, model, seal, pressure, memory, counts, warnings);
  return *fitted ? SB_OK : solve_counted(film, plane, memory, counts, report);
}

// Film, rough contact and friction from one solution each, sliding and at rest.
static SbStatus solve_coupled(SbSliding *out, const SbModel *model, int seal,
                              SbSealPressure pressure, double speed, SbSlidingMemory *memory,
                              SbSlidingCounts *counts, SbWarnings *warnings, SbReport *report) {
  SbFilmProblem problem;
  SbStatus worst = SB_OK, last = SB_OK;
  bool same = memory->rested && memory->rest_load == out->load_net &&
              memory->rest_pressure.left == pressure.left &&
              memory->rest_pressure.right == pressure.right;
  if (!same) {
    coupled_problem(&problem, model, seal, pressure, out->load_net, 0);
    SbStatus status = solve_rough(&memory->rest, &memory->rest_fitted, &problem, model, seal,
                                  pressure, memory, counts, warnings, report);
    if (status != SB_OK && status != SB_ERROR_NOT_CONVERGED) {
      return status;
    }
    worst = last = status;
    memory->rested = status == SB_OK;
    memory->rest_load = out->load_net;
    memory->rest_pressure = pressure;
  }
  memory->fitted_last = false;
  bool fitted = memory->rest_fitted;
  if (speed != 0) {
    coupled_problem(&problem, model, seal, pressure, out->load_net, speed);
    option_warnings(warnings, model, seal, &problem);
    if (model->inlet_carried) {
      sb_warn(warnings, "inlet-flooded", "models.inlet",
              "with coupled asperities the inlet is flooded both ways: what a rough contact leaves "
              "on the bore is not known");
    }
    SbStatus status = solve_rough(&memory->film, &fitted, &problem, model, seal, pressure, memory,
                                  counts, warnings, worst == SB_OK ? report : NULL);
    if (status != SB_OK && status != SB_ERROR_NOT_CONVERGED) {
      return status;
    }
    worst = status != SB_OK ? status : worst;
    last = status;
  } else {
    memory->film = memory->rest;
  }
  const SbFilm *film = &memory->film;
  sb_warnings_merge(warnings, &film->warnings);
  // Lengths of the half-plane's contact over the fitted one's; forces over its circumference.
  double area = (out->contact_right - out->contact_left) * model->bore_circumference;
  double fit_width = out->contact_right - out->contact_left;
  double width = fitted ? fit_width : 2 * film->hertz_half_width;
  double rest_width = memory->rest_fitted ? fit_width : 2 * memory->rest.hertz_half_width;
  double circumference = out->load / out->load_per_length;
  take_film(out, film, last, fitted, &memory->fit);
  if (has_film(film, last)) {
    out->lambda = film->film_ratio;
    out->area_share = fmin(film->real_area / width, 1);
    out->asperity_share = film->asperity_share;
    out->boundary_area = model->shear_strength * out->area_share * area;
    out->boundary_load = model->load_coefficient * film->asperity_load * circumference;
    out->viscous = fabs(film->friction_couette + film->friction_cavity) / width * area;
  }
  const SbFilm *rest = &memory->rest;
  if (memory->rested || rest->film_central > 0) {
    out->friction_static = model->static_ratio *
                           (model->shear_strength * fmin(rest->real_area / rest_width, 1) * area +
                            model->load_coefficient * rest->asperity_load * circumference);
  }
  out->friction_error =
      fmax(film->solver.error_contact * (out->boundary_area + out->boundary_load) +
               out->film_error * out->viscous,
           rest->solver.error_contact * out->friction_static);
  return worst;
}

// Share of the area in real contact, sliding and at rest. Greenwood and Tripp's depends on the
// film, Persson's on the net pressure that the solids must carry.
static SbStatus real_area(SbSliding *out, double *rest_share, const SbModel *model, int seal,
                          SbWarnings *warnings, SbReport *report) {
  if (model->surface == SB_ROUGH_PERSSON) {
    SbSpectrum spectrum;
    SbStatus status = sb_spectrum_from_asperities(&spectrum, model->sigma, model->sigma_over_beta,
                                                  model->gt_product, report);
    if (status != SB_OK) {
      return status;
    }
    double pressure = fmax(out->load_net, 0) / (out->contact_right - out->contact_left);
    out->area_share =
        sb_persson_area_share(&spectrum, spectrum.q1, model->seal[seal].reduced_modulus, pressure);
    *rest_share = out->area_share;
    sb_warn(
        warnings, "persson-shear-strength", "friction.shear_strength",
        "Persson's real contact is %.0f %% here; the default shear strength was set with Greenwood "
        "and Tripp's few per cent",
        100 * out->area_share);
    return SB_OK;
  }
  SbGtIntegrals integrals;
  SbStatus status = sb_gt_integrals(&integrals, 0, NULL);
  if (status == SB_OK) {
    *rest_share = sb_gt_area_share(model->gt_product, integrals.F2);
  }
  // Without a film there is no real contact under it either.
  out->area_share = NAN;
  if (status == SB_OK && !isnan(out->lambda)) {
    status = sb_gt_integrals(&integrals, out->lambda, NULL);
    out->area_share = status == SB_OK ? sb_gt_area_share(model->gt_product, integrals.F2) : NAN;
  }
  if (status != SB_OK) {
    return sb_fail(report, status, "no asperity contact of the %s seal at λ = %g",
                   sb_seal_name(seal), out->lambda);
  }
  if (out->area_share > 0.3) {
    sb_warn(
        warnings, "real-area-large", "surface.gt_product",
        "asperities of the %s seal touch on %.0f %% of the area: Greenwood and Tripp's asperities "
        "are no longer independent",
        sb_seal_name(seal), 100 * out->area_share);
  }
  return SB_OK;
}

// What the surfaces make of a contact whose load, width and film are known: real area, friction.
static SbStatus rough_contact(SbSliding *out, const SbModel *model, int seal, double speed,
                              SbWarnings *warnings, SbReport *report) {
  double area = (out->contact_right - out->contact_left) * model->bore_circumference;
  double rest_share = NAN;
  out->lambda = out->film_central / model->sigma;
  SbStatus status = real_area(out, &rest_share, model, seal, warnings, report);
  if (status != SB_OK) {
    return status;
  }
  out->boundary_area = model->shear_strength * out->area_share * area;
  out->boundary_load = model->load_coefficient * out->load;
  out->viscous = 0;
  if (speed != 0) {
    // fmin() would take a film that was not computed for the greatest shear.
    double shear = model->viscosity * fabs(speed) / out->film_central;
    shear = shear > model->shear_strength ? model->shear_strength : shear;
    out->viscous = shear * (1 - out->area_share) * area;
    if (out->film_error > 0) {
      SbGtIntegrals thinner;
      bool persson = model->surface == SB_ROUGH_PERSSON;
      double share = NAN;
      if (sb_gt_integrals(&thinner, out->lambda * (1 - out->film_error), NULL) == SB_OK) {
        share = sb_gt_area_share(model->gt_product, thinner.F2) - out->area_share;
      }
      out->friction_error = out->film_error * out->viscous +
                            (persson ? 0 : model->shear_strength * fabs(share) * area);
    }
  }
  out->friction_static =
      model->static_ratio * (model->shear_strength * rest_share * area + out->boundary_load);
  return SB_OK;
}

static const char *about(int seal) {
  return seal == SB_OUTER ? "outer seal" : "inner seal";
}

// A film that cannot be, because the fluid opens the contact, is a result, not a failure. Otherwise
// passes on the report.
static SbStatus opened_by_fluid(SbSliding *out, SbStatus status, const SbReport *own, int seal,
                                SbWarnings *warnings, SbReport *report) {
  if (status != SB_ERROR_INFEASIBLE || strcmp(own->parameter, "canister.pressure") != 0) {
    if (status != SB_OK && report != NULL) {
      *report = *own;
    }
    return status;
  }
  out->opened = true;
  sb_warn(warnings, "film-opened", "canister.pressure",
          "the fluid's pressure opens the contact of the %s seal: no film lies in it",
          sb_seal_name(seal));
  return SB_OK;
}

SbStatus sb_sliding_resurface(SbSliding *state, const SbModel *model, int seal, double speed,
                              SbWarnings *warnings, SbReport *report) {
  sb_warn_about(warnings, about(seal));
  SbStatus status = state->touches ? rough_contact(state, model, seal, speed, warnings, report)
                                   : sb_succeed(report);
  sb_warn_about(warnings, NULL);
  return status;
}

static SbStatus solve(SbSliding *out, const SbModel *model, int seal, SbSealPressure pressure,
                      double speed, SbSlidingMemory *memory, SbSlidingCounts *counts,
                      SbWarnings *warnings, SbReport *report) {
  (void)sb_succeed(report);
  *out = (SbSliding){.contact_left = NAN,
                     .contact_right = NAN,
                     .load = NAN,
                     .load_per_length = NAN,
                     .load_net = NAN,
                     .pressure_peak = NAN,
                     .film_min = NAN,
                     .film_central = NAN,
                     .film_reynolds = NAN,
                     .film_error = NAN,
                     .lambda = NAN,
                     .area_share = NAN,
                     .asperity_share = NAN,
                     .boundary_area = NAN,
                     .boundary_load = NAN,
                     .viscous = NAN,
                     .friction_static = NAN};

  // Fitment. The fit takes the difference; the common part only shifts the fluid's level.
  SbStatus status = solve_fit(memory, model, seal, pressure.left - pressure.right, counts, report);
  if (status != SB_OK && status != SB_ERROR_NOT_CONVERGED) {
    return status;
  }
  const SbFit *fit = &memory->fit;
  sb_warnings_merge(warnings, &fit->warnings);
  // One that stopped above the tolerance counts, with its error; else it holds another load's.
  bool close = fit->solver.error_estimate.load > 0 && fit->solver.error_estimate.load < 1;
  out->touches = fit->touches || status != SB_OK;
  if (status != SB_OK && !(fit->touches && close)) {
    return status;
  }
  if (!fit->touches) {
    out->contact_left = out->contact_right = 0;
    out->load = out->load_per_length = out->load_net = out->pressure_peak = 0;
    out->boundary_area = out->boundary_load = out->viscous = out->friction_static = 0;
    return status;
  }
  out->contact_left = fit->contact_left;
  out->contact_right = fit->contact_right;
  out->load = fit->load;
  out->load_per_length = fit->load_per_length;
  out->pressure_peak = fit->pressure_peak;
  // Closed forms that know no pressure give the rubber's share alone: nothing to take off.
  bool holds_fluid = fit->model != SB_FIT_HERTZ && fit->model != SB_FIT_LINDLEY &&
                     fit->model != SB_FIT_GREEN_ENGLISH;
  double fluid = fabs(pressure.left - pressure.right) * fit->contact_width / 2;
  out->load_net = fit->load_per_length - (holds_fluid ? fluid : 0);

  SbReport own = {0};
  SbReport *first = status == SB_OK ? report : NULL; // the first failure is told
  if (model->asperities == SB_MODEL_ASPERITIES_COUPLED && out->load_net > 0) {
    SbStatus coupled =
        solve_coupled(out, model, seal, pressure, speed, memory, counts, warnings, &own);
    coupled = opened_by_fluid(out, coupled, &own, seal, warnings, first);
    return coupled != SB_OK ? coupled : status;
  }

  // Film, only when sliding.
  if (speed == 0) {
    out->film_min = out->film_central = 0;
  } else if (out->load_net <= 0) {
    out->opened = true;
    sb_warn(warnings, "film-no-net-load", "canister.pressure",
            "the fluid alone carries the %s seal: no film law applies", sb_seal_name(seal));
  } else {
    SbStatus film = solve_film(out, model, seal, pressure, speed, memory, counts, warnings, &own);
    film = opened_by_fluid(out, film, &own, seal, warnings, first);
    if (film != SB_OK && film != SB_ERROR_NOT_CONVERGED) {
      return film;
    }
    status = film != SB_OK ? film : status;
  }

  SbStatus area_status =
      rough_contact(out, model, seal, speed, warnings, status == SB_OK ? report : NULL);
  if (area_status != SB_OK) {
    return area_status;
  }

  // Regime and validity.
  if (speed != 0 && out->film_central > 0) {
    if (out->lambda < 1) {
      sb_warn(warnings, "boundary-regime", "surface.sigma",
              "λ = %.2g at the %s seal: boundary regime, the film is thinner than the roughness",
              out->lambda, sb_seal_name(seal));
    }
  }
  return status;
}

SbStatus sb_sliding_solve(SbSliding *out, const SbModel *model, int seal, SbSealPressure pressure,
                          double speed, SbSlidingMemory *memory, SbSlidingCounts *counts,
                          SbWarnings *warnings, SbReport *report) {
  sb_warn_about(warnings, about(seal));
  SbStatus status = solve(out, model, seal, pressure, speed, memory, counts, warnings, report);
  sb_warn_about(warnings, NULL);
  return status;
}
