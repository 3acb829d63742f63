// The bench's cases; see bench.h. Reference films: an independent hp-collocation solver, relative
// error 1e-6 (Swift-Stieber, flooded, half-plane). Reference discs and rings: spectral disc and an
// independent finite-strain finite element program, to the digits given; pressed ones have no other
// program's answer, but this one's: the ring on meshes of 8000 to 10000 unknowns, which agree to
// 3e-4, the disc at a tolerance of 3e-6.
#include "engine/valve/answer/bench.h"

#include "engine/base/clock.h"
#include "engine/contact/fit.h"
#include "engine/contact/ring/ring.h"
#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/film/film.h"
#include "engine/valve/run/run.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct Case Case;
struct Case {
  const char *solver;
  SbStatus (*run)(SbBenchCase *out, const Case *c, SbReport *report);
  double
      parameter; // M of a film, squeeze of a disc [1], pressure of a ring [Pa], motion of a cycle
  double tolerance;
  double expected[3]; // films: H* minimum, centre, flux; fits: load per length or load
  double besides;     // pressure of a disc [Pa], film model of a cycle
};

static double relative(double value, double expected) {
  return fabs(value / expected - 1);
}

// F_2 at lambda <= 0, where its closed form does not cancel.
static SbStatus run_asperity(SbBenchCase *out, const Case *c, SbReport *report) {
  double l = c->parameter;
  SbGtIntegrals integrals;
  SbStatus status = sb_gt_integrals(&integrals, l, report);
  double tail = erfc(l / M_SQRT2) / 2;
  double density = exp(-l * l / 2) / sqrt(2 * M_PI);
  out->error = relative(integrals.F2, (1 + l * l) * tail - l * density);
  snprintf(out->name, sizeof out->name, "F2 at lambda = %g", l);
  return status;
}

static SbStatus run_wedge(SbBenchCase *out, const Case *c, SbReport *report) {
  SbFilm *film = malloc(sizeof *film);
  if (film == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a film");
  }
  SbFilmProblem problem;
  sb_film_problem_init(&problem);
  problem.model = SB_FILM_RIGID;
  problem.load = c->expected[0];
  problem.radius = problem.viscosity = 1e-3;
  problem.modulus = 1e9;
  problem.speed = 2;
  SbStatus status = sb_film_solve(film, &problem, NULL, report);
  out->error = relative(film->film_min, 1e-6);
  free(film);
  snprintf(out->name, sizeof out->name, "load without end pressures");
  return status;
}

// Cold: no solver memory, so that mesh, kernel and continuation are all in the time.
static SbStatus run_film(SbBenchCase *out, const Case *c, SbReport *report) {
  SbFilm *film = malloc(sizeof *film);
  if (film == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a film");
  }
  double U = 1e-10;
  double R = 1e-3;
  SbFilmProblem problem;
  sb_film_problem_init(&problem);
  problem.radius = R;
  problem.modulus = 1e6;
  problem.viscosity = 1e-3;
  problem.speed = 2 * U * problem.modulus * R / problem.viscosity;
  problem.load = c->parameter * sqrt(2 * U) * problem.modulus * R;
  problem.tolerance = c->tolerance;
  SbStatus status = sb_film_solve(film, &problem, NULL, report);
  double unit = R * sqrt(2 * U);
  double figure[3] = {film->film_min / unit, film->film_central / unit, film->film_flux / unit};
  out->wall_s = film->solver.wall_s;
  out->unknowns = film->solver.unknowns;
  out->iterations = (size_t)film->solver.newton_iterations;
  out->error_estimate = fmax(film->solver.error_film_min,
                             fmax(film->solver.error_film_central, film->solver.error_film_flux));
  snprintf(out->name, sizeof out->name, "M = %g, tolerance %g", c->parameter, c->tolerance);
  // Errors are smaller than those of the reference: where the finest solution agrees with it, that
  // is what the others are measured by. No error is known of a solution on the finest mesh itself.
  const double reference_error = 1e-6;
  if (status == SB_OK && report != NULL) {
    problem.tolerance = 1e-8;
    bool finest = sb_film_solve(film, &problem, NULL, NULL) == SB_OK;
    double best[3] = {film->film_min / unit, film->film_central / unit, film->film_flux / unit};
    out->error = 0;
    for (int i = 0; i < 3; i++) {
      bool agrees = finest && relative(best[i], c->expected[i]) < reference_error;
      out->error = fmax(out->error, relative(figure[i], agrees ? best[i] : c->expected[i]));
    }
    out->error = out->error > 0 ? out->error : NAN;
  }
  free(film);
  return status;
}

static const SbRingBody thesis_ring = {.section_diameter = 1.61e-3,
                                       .inner_diameter = 2.84e-3,
                                       .modulus = 2.5e6,
                                       .poisson_ratio = 0.49};

// The thesis valve's ring, 15.5 % squeezed, against its groove's wall if pressed; a disc of its
// section without stretch.
static SbStatus run_fit(SbBenchCase *out, const Case *c, bool ring, SbReport *report) {
  SbFit *fit = malloc(sizeof *fit);
  if (fit == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a fit");
  }
  const double d = thesis_ring.section_diameter, bore = 6e-3;
  const double gap = ring ? 1.36e-3 : d * (1 - c->parameter);
  const SbFitProblem problem = {
      .model = ring ? SB_FIT_RING : SB_FIT_DISC,
      .section_diameter = d,
      .inner_diameter = ring ? thesis_ring.inner_diameter : bore - gap - d,
      .modulus = thesis_ring.modulus,
      .poisson_ratio = thesis_ring.poisson_ratio,
      .radial_space = gap,
      .bore_diameter = bore,
      .gland_width = ring ? 2e-3 : 3e-3,
      .pressure = ring ? c->parameter : c->besides,
      .tolerance = c->tolerance,
  };
  SbStatus status = sb_fit_solve(fit, &problem, report);
  out->error = relative(ring ? fit->load : fit->load_per_length, c->expected[0]);
  out->unknowns = fit->solver.unknowns;
  out->iterations = fit->solver.newton_iterations;
  out->error_estimate = fit->solver.error_estimate.load;
  const size_t steps = fit->ring.load_steps;
  if (ring) {
    snprintf(out->name, sizeof out->name, "%.2f MPa, tolerance %g, %zu load step%s",
             1e-6 * problem.pressure, c->tolerance, steps, steps == 1 ? "" : "s");
  } else {
    snprintf(out->name, sizeof out->name, "squeeze %.4g %%, %.4g MPa, tolerance %g",
             100 * c->parameter, 1e-6 * problem.pressure, c->tolerance);
  }
  free(fit);
  return status;
}

static SbStatus run_disc(SbBenchCase *out, const Case *c, SbReport *report) {
  return run_fit(out, c, false, report);
}

static SbStatus run_ring(SbBenchCase *out, const Case *c, SbReport *report) {
  return run_fit(out, c, true, report);
}

// Steps of a cycle from one equilibrium to the next: bore and pressure move, friction on all
// surfaces. The time is one step's; the error is that of its axial balance.
static SbStatus run_ring_step(SbBenchCase *out, const Case *c, SbReport *report) {
  enum { STEPS = 10 };
  SbRingLoad load = SB_RING_LOAD_INIT;
  load.floor_radius = 1.64e-3;
  load.bore_radius = 3e-3;
  load.pressure_left = c->parameter;
  load.wall_left = -1e-3;
  load.wall_right = 1e-3;
  load.friction_bore = load.friction_floor = load.friction_wall = 0.2;
  SbRingOptions options = {.fit_mesh = true};
  SbRing *ring = NULL;
  SbStatus status = sb_ring_create(&ring, &thesis_ring, &load, &options, report);
  SbRingResult before = {0};
  SbRingResult after = {0};
  if (status == SB_OK) {
    sb_ring_result(ring, &before);
  }
  double start = sb_clock_seconds();
  for (int i = 0; i < STEPS && status == SB_OK; i++) {
    load.bore_position += 1e-5;
    load.pressure_left *= 1.01;
    status = sb_ring_step(ring, &load, report);
  }
  out->wall_s = (sb_clock_seconds() - start) / STEPS;
  if (status == SB_OK) {
    sb_ring_result(ring, &after);
  }
  sb_ring_destroy(ring);
  out->error = after.axial_imbalance;
  out->unknowns = (size_t)after.unknowns;
  out->iterations = (size_t)(after.newton_iterations - before.newton_iterations) / STEPS;
  snprintf(out->name, sizeof out->name, "balance after a warm step of 10 um, friction 0.2");
  return status;
}

// The whole cycle, by closed forms or with solved films; its error is what the energy balance does
// not close.
static SbStatus run_cycle(SbBenchCase *out, const Case *c, SbReport *report) {
  SbParams params;
  sb_params_init(&params);
  SbModel *model = NULL;
  SbRun *run = NULL;
  SbStatus status = sb_params_set(&params, SB_P_MODELS_MOTION, c->parameter, report);
  if (status == SB_OK) {
    status = sb_params_set(&params, SB_P_MODELS_FILM, c->besides, report);
  }
  if (status == SB_OK && sb_model_create(&model, &params, NULL, NULL, NULL) != SB_OK) {
    status = sb_fail(report, SB_ERROR_INPUT, "the default valve does not compile");
  }
  if (status == SB_OK) {
    SbPlan plan;
    sb_plan_make(&plan, model);
    status = sb_run_create(&run, model, &plan, report);
  }
  sb_model_destroy(model);
  if (status == SB_OK) {
    status = sb_run_execute(run, NULL, report);
    const SbSummary *summary = sb_run_summary(run);
    out->error = summary->energy.closure;
    out->error_estimate = summary->error_energy;
    out->iterations = summary->steps;
    snprintf(out->name, sizeof out->name, "energy of the thesis cycle, %zu frames%s",
             summary->frames, sb_film_kind((SbFilmModel)c->besides)->coupled ? ", films" : "");
  }
  sb_run_destroy(run);
  return status;
}

static const Case cases[] = {
    {"greenwood-tripp", run_asperity, -4, 0, {0}, 0},
    {"wedge", run_wedge, 0, 0, {4.894968}, 0},
    {"reynolds", run_film, 1, 1e-3, {3.06313643, 3.27656797, 3.79061479}, 0},
    {"reynolds", run_film, 1, 1e-7, {3.06313643, 3.27656797, 3.79061479}, 0},
    {"reynolds", run_film, 5, 1e-3, {1.59060139, 2.03650729, 2.01593519}, 0},
    {"reynolds", run_film, 5, 1e-7, {1.59060139, 2.03650729, 2.01593519}, 0},
    {"reynolds", run_film, 20, 1e-3, {1.12468687, 1.42051119, 1.41937373}, 0},
    {"reynolds", run_film, 20, 1e-7, {1.12468687, 1.42051119, 1.41937373}, 0},
    {"reynolds", run_film, 100, 1e-3, {0.796100592, 1.00142813, 1.00138870}, 0},
    {"reynolds", run_film, 100, 1e-7, {0.796100592, 1.00142813, 1.00138870}, 0},
    {"reynolds", run_film, 1000, 1e-3, {0.498582133, 0.626358505, 0.626358192}, 0},
    {"reynolds", run_film, 1000, 1e-7, {0.498582133, 0.626358505, 0.626358192}, 0},
    {"reynolds", run_film, 10000, 1e-3, {0.314215466, 0.394658764, 0.394658762}, 0},
    {"reynolds", run_film, 10000, 1e-7, {0.314215466, 0.394658764, 0.394658762}, 0},
    {"disc", run_disc, 0.02, 1e-2, {27.20480692135}, 0},
    {"disc", run_disc, 0.02, 1e-3, {27.20480692135}, 0},
    {"disc", run_disc, 0.04, 1e-3, {62.94421156184}, 0},
    {"disc", run_disc, 0.10, 1e-3, {199.5995305575}, 0},
    {"disc", run_disc, 0.10, 1e-3, {607.3427}, 0.55e6},
    {"ring", run_ring, 0, 1e-2, {4.772}, 0},
    {"ring", run_ring, 0, 1e-3, {4.772}, 0},
    {"ring", run_ring, 0.55e6, 1e-3, {13.493}, 0},
    {"ring", run_ring_step, 0.29e6, 0, {0}, 0},
    {"quasi-static", run_cycle, SB_MODEL_MOTION_QUASI_STATIC, 0, {0}, SB_FILM_THESIS},
    {"dynamic", run_cycle, SB_MODEL_MOTION_DYNAMIC, 0, {0}, SB_FILM_THESIS},
    {"quasi-static", run_cycle, SB_MODEL_MOTION_QUASI_STATIC, 0, {0}, SB_FILM_REYNOLDS},
};

size_t sb_bench_count(void) {
  return sizeof cases / sizeof cases[0];
}

SbStatus sb_bench_run(SbBenchCase *out, size_t index, int repeats, const SbBenchCase *previous,
                      SbReport *report) {
  enum { REPEATS_MAX = 50 };
  const Case *c = &cases[index];
  *out = (SbBenchCase){.error = NAN, .error_estimate = NAN, .order = NAN};
  snprintf(out->solver, sizeof out->solver, "%s", c->solver);
  SbReport first = {0};
  SbStatus status = c->run(out, c, report != NULL ? report : &first);
  if (status != SB_OK) {
    out->error = NAN;
    return status;
  }
  double wall[REPEATS_MAX];
  int n = repeats < 1 ? 1 : repeats > REPEATS_MAX ? REPEATS_MAX : repeats;
  for (int i = 0; i < n && status == SB_OK; i++) {
    double start = sb_clock_seconds();
    out->wall_s = 0;
    status = c->run(out, c, report);
    // A case that measures the time of a part of itself has set it.
    wall[i] = out->wall_s > 0 ? out->wall_s : sb_clock_seconds() - start;
  }
  out->wall_s = gsl_stats_median(wall, 1, (size_t)n);

  // Order between two meshes of one case, where the digits of the ring's reference show one.
  const double resolved = c->run == run_ring ? 1e-4 : 0;
  if (previous != NULL && index > 0 && cases[index - 1].run == c->run &&
      cases[index - 1].parameter == c->parameter && cases[index - 1].besides == c->besides &&
      out->unknowns != previous->unknowns && out->error > resolved && previous->error > resolved) {
    out->order = -log(out->error / previous->error) /
                 log((double)out->unknowns / (double)previous->unknowns);
  }
  return status;
}
