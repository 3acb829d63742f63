// Film models: checks of the problem, scales, fluid, and the choice of the model.
//
// Scales after Hertz (line contact): b = R sqrt(8 W / pi), p_H = 2 w / (pi b), film b^2 / R (thesis
// eq. 6.33-6.44 with the factor 8 of docs/thesis.md, 6). With them the isoviscous problem depends
// on lambda alone. End pressures: see sb_film_dry_pressure and docs/verification.md.
#include "engine/film/film.h"

#include "engine/base/clock.h"
#include "engine/film/ehl.h"
#include "engine/film/scale.h"

#include <cblas.h>
#include <gsl/gsl_vector.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

typedef SbStatus Solve(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                       SbReport *report);

static const struct {
  SbFilmKind kind;
  Solve *closed; // NULL: the coupled solver
} models[SB_FILM_MODEL_COUNT] = {
    [SB_FILM_THESIS] = {{.name = "thesis",
                         .help = "power law of the thesis, eq. 7.5",
                         .power_law = true},
                        sb_film_solve_law},
    [SB_FILM_KARASZKIEWICZ] = {{.name = "karaszkiewicz",
                                .help = "power law of Karaszkiewicz, thesis eq. 7.6",
                                .power_law = true},
                               sb_film_solve_law},
    [SB_FILM_ASYMPTOTIC] = {{.name = "asymptotic",
                             .help = "exact limit of thin films on a half-plane"},
                            sb_film_solve_law},
    [SB_FILM_REYNOLDS] = {{.name = "reynolds",
                           .help = "coupled elastohydrodynamic solution",
                           .coupled = true},
                          NULL},
    [SB_FILM_INVERSE] = {{.name = "inverse",
                          .help = "Blok's inverse film of a smooth dry pressure",
                          .from_dry = true},
                         sb_film_solve_inverse},
    [SB_FILM_MOES] = {{.name = "moes", .help = "blend of the rigid and the elastic limit"},
                      sb_film_solve_law},
    [SB_FILM_RIGID] = {{.name = "rigid", .help = "rigid analytical wedge, thesis section 6.1"},
                       sb_film_solve_rigid},
};

const SbFilmKind *sb_film_kind(SbFilmModel model) {
  return (unsigned)model < SB_FILM_MODEL_COUNT ? &models[model].kind : NULL;
}

bool sb_film_model_from_name(SbFilmModel *out, const char *name) {
  for (int i = 0; name != NULL && i < SB_FILM_MODEL_COUNT; i++) {
    if (strcmp(models[i].kind.name, name) == 0) {
      *out = (SbFilmModel)i;
      return true;
    }
  }
  return false;
}

void sb_film_problem_init(SbFilmProblem *problem) {
  *problem = (SbFilmProblem){.model = SB_FILM_REYNOLDS, .tolerance = 1e-3};
}

SbStatus sb_film_solver_create(SbFilmSolver **out, SbReport *report) {
  *out = malloc(sizeof **out); // a solve uses few of its 20 MB
  if (*out == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "out of memory");
  }
  sb_ehl_init(*out);
  return sb_succeed(report);
}

void sb_film_solver_destroy(SbFilmSolver *solver) {
  free(solver);
}

void sb_film_solver_forget(SbFilmSolver *solver) {
  solver->last.ready = solver->base.solved = false;
}

// Asperities or adhesion take rough rows.
bool sb_film_rough(const SbFilmProblem *problem) {
  return problem->surface != SB_ROUGH_NONE || problem->hamaker > 0.0;
}

// Gaps at which the pull closes the film.
static SbSnapWindow snap_gap(const SbRoughLaw *law, const SbFilmProblem *problem,
                             const SbFilmScale *scale) {
  const SbSnapContact contact = {.hamaker = problem->hamaker,
                                 .modulus = problem->modulus,
                                 .width = 2 * scale->half_width,
                                 .viscosity = problem->viscosity,
                                 .speed = problem->speed};
  return sb_rough_snap_in(law, &contact);
}

// Warns that *out is the film without attraction, and that with attraction lubrication is in the
// boundary regime.
static void snap_in(SbFilm *out, const SbFilmProblem *problem, double closed) {
  out->valid = false;
  strcpy(out->regime, "boundary");
  const bool tips = problem->work_of_adhesion > 0;
  sb_warn_serious(
      &out->warnings, "film-snap-in", tips ? SB_FILM_IN_WORK_OF_ADHESION : SB_FILM_IN_HAMAKER,
      "adhesion closes gaps below %.3g nm (film without it %.3g nm): boundary lubrication, work "
      "of adhesion %.2g J/m2; the figures are those without adhesion",
      closed * 1e9, out->film_min * 1e9,
      tips ? problem->work_of_adhesion : sb_vdw_work(problem->hamaker));
}

// Where asperities that stick leave the range of their law.
static void stick_warnings(SbFilm *out, const SbAsperity *tip) {
  sb_asperity_warn(&out->warnings, tip);
  if (out->real_area_share > 0.3) {
    sb_warn(&out->warnings, "adhesion-dense", SB_FILM_IN_WORK_OF_ADHESION,
            "sticking asperities touch on %.0f %% of the area: they are no longer independent",
            100 * out->real_area_share);
  }
}

// The coupled solver. Attraction that would close the film (rough_law.h) is reported beforehand:
// the film without it, and a warning.
static SbStatus solve_coupled(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                              SbFilmSolver *solver, SbReport *report) {
  static const double TOUCHING = 1e-6; // smallest mean fraction of real contact that counts
  const bool tips = problem->work_of_adhesion > 0;
  const SbRoughLaw *law = NULL;
  SbSnapWindow closed = {0, 0};
  if (problem->hamaker > 0.0 || tips) {
    if (problem->surface != SB_ROUGH_NONE) {
      SbStatus made = sb_ehl_rough_law(&law, solver, problem, report);
      if (made != SB_OK) {
        return made;
      }
    }
    closed = snap_gap(law, problem, scale);
  }
  if (!(closed.high > 0)) {
    SbStatus status = sb_ehl_solve(out, problem, scale, solver, report);
    if (tips && status == SB_OK) {
      stick_warnings(out, &law->tip);
    }
    return status;
  }
  SbFilmProblem without = *problem;
  without.hamaker = without.work_of_adhesion = 0;
  SbStatus status = sb_ehl_solve(out, &without, scale, solver, report);
  if (status != SB_OK) {
    return status;
  }
  if (tips && out->real_area < TOUCHING * 2 * scale->half_width) {
    return SB_OK; // surfaces without contact do not adhere
  }
  // Thick enough, unless attraction itself reduces it; or at rest, pressed together beyond.
  const bool rests = tips && problem->speed == 0;
  if (out->film_min > closed.high || (rests && out->film_central < closed.low)) {
    sb_film_begin(out, problem, scale);
    status = sb_ehl_solve(out, problem, scale, solver, report);
    const bool outside = out->film_min > closed.high || (rests && out->film_central < closed.low);
    if (status == SB_OK ? outside : status != SB_ERROR_NOT_CONVERGED) {
      if (tips && status == SB_OK) {
        stick_warnings(out, &law->tip);
      }
      return status;
    }
    sb_film_begin(out, &without, scale);
    status = sb_ehl_solve(out, &without, scale, solver, report);
  }
  snap_in(out, problem, closed.high);
  return status;
}

#define RANGE(member) offsetof(SbFilmProblem, member)
// Wide enough for every seal and narrow enough that nothing overflows.
static const SbFilmRange ranges[] = {
    {"load", 0, "N/m", RANGE(load), 1e-6, 1e9},
    {"speed", SB_FILM_IN_SPEED, "m/s", RANGE(speed), -1e4, 1e4},
    {"radius", SB_FILM_IN_RADIUS, "m", RANGE(radius), 1e-7, 1e3},
    {"reduced modulus", SB_FILM_IN_MODULUS, "Pa", RANGE(modulus), 1.0, 1e13},
    {"viscosity", SB_FILM_IN_VISCOSITY, "Pa.s", RANGE(viscosity), 1e-9, 1e6},
    {"pressure left", SB_FILM_IN_PRESSURE, "Pa", RANGE(pressure_left), -1e6, 1e10},
    {"pressure right", SB_FILM_IN_PRESSURE, "Pa", RANGE(pressure_right), -1e6, 1e10},
    {"tolerance", 0, "", RANGE(tolerance), 1e-8, 0.1},
    {"pressure viscosity", SB_FILM_IN_PRESSURE_VISCOSITY, "1/Pa", RANGE(pressure_viscosity), 0.0,
     1e-5},
    {"Eyring stress", SB_FILM_IN_EYRING_STRESS, "Pa", RANGE(eyring_stress), 0.0, 1e12},
    {"inlet film", 0, "m", RANGE(inlet_film), 0.0, 1.0},
    {"rupture pressure", SB_FILM_IN_RUPTURE_PRESSURE, "Pa", RANGE(rupture_pressure), -1e6, 1e9},
    {"asperity product", SB_FILM_IN_ASPERITY_PRODUCT, "", RANGE(gt_product), 0.0, 100.0},
    {"sigma", SB_FILM_IN_SIGMA, "m", RANGE(sigma), 0.0, 1.0},
    {"sigma/beta", SB_FILM_IN_SIGMA_OVER_BETA, "", RANGE(sigma_over_beta), 0.0, 1e3},
    {"percolation threshold", 0, "", RANGE(percolation_threshold), 0.0, 0.7},
    {"roughness split", 0, "", RANGE(roughness_split), -0.99, 1.0},
    {"Hamaker constant", SB_FILM_IN_HAMAKER, "J", RANGE(hamaker), 0.0, 1e-17},
    {"work of adhesion", SB_FILM_IN_WORK_OF_ADHESION, "J/m2", RANGE(work_of_adhesion), 0.0, 100.0},
    {"shear strength", SB_FILM_IN_SHEAR_STRENGTH, "Pa", RANGE(shear_strength), 0.0, 1e12},
    {"load coefficient", SB_FILM_IN_LOAD_COEFFICIENT, "", RANGE(load_coefficient), 0.0, 100.0},
};
#undef RANGE

const SbFilmRange *sb_film_ranges(size_t *count) {
  *count = sizeof ranges / sizeof ranges[0];
  return ranges;
}

static SbStatus check(const SbFilmProblem *problem, SbReport *report) {
  if ((int)problem->model < 0 || problem->model >= SB_FILM_MODEL_COUNT) {
    return sb_fail(report, SB_ERROR_INPUT, "there is no film model number %d", (int)problem->model);
  }
  for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
    const SbFilmRange *r = &ranges[i];
    double value = *(const double *)(const void *)((const char *)problem + r->offset);
    // The comparison is written so that a NaN fails it.
    if (!(value >= r->min && value <= r->max)) {
      return sb_fail_input(report, SB_ERROR_RANGE, r->input, "%s %g %s is outside %g ... %g",
                           r->name, value, r->unit, r->min, r->max);
    }
  }
  if ((int)problem->surface < 0 || problem->surface >= SB_ROUGH_COUNT) {
    return sb_fail(report, SB_ERROR_INPUT, "there is no surface model number %d",
                   (int)problem->surface);
  }
  if (problem->work_of_adhesion > 0 &&
      (problem->hamaker > 0 || !sb_rough_kind(problem->surface)->asperities)) {
    return sb_fail_input(report, SB_ERROR_INPUT, SB_FILM_IN_WORK_OF_ADHESION,
                         "tips that stick are those of the surface greenwood-tripp, in "
                         "place of van der Waals' pull");
  }
  if (sb_film_rough(problem) && !models[problem->model].kind.coupled) {
    return sb_fail(report, SB_ERROR_INPUT,
                   "asperities and adhesion need the model reynolds, not %s",
                   models[problem->model].kind.name);
  }
  return SB_OK;
}

SbFilmScale sb_film_scale(const SbFilmProblem *problem) {
  SbFilmScale s = {0};
  double ER = problem->modulus * problem->radius;
  s.U = problem->viscosity * fabs(problem->speed) / 2.0 / ER;
  s.W = problem->load / ER;
  s.half_width = problem->radius * sqrt(8.0 * s.W / M_PI);
  s.pressure = 2.0 * problem->load / (M_PI * s.half_width);
  s.film = s.half_width * s.half_width / problem->radius;
  s.M = s.U > 0.0 ? s.W / sqrt(2.0 * s.U) : 0.0;
  s.lambda = 0.75 * M_PI * M_PI * s.U / (s.W * s.W);
  bool forward = problem->speed >= 0.0;
  // Only the coupled solver knows a rupture pressure; it works with pressures above it.
  bool coupled = models[problem->model].kind.coupled && problem->speed != 0.0;
  double rupture = coupled ? problem->rupture_pressure : 0.0;
  if (sb_film_rough(problem) && problem->speed == 0.0) {
    rupture = fmin(problem->rupture_pressure, 0.0); // no cavitation at rest, except below ambient
  }
  s.inlet = ((forward ? problem->pressure_left : problem->pressure_right) - rupture) / s.pressure;
  s.outlet = ((forward ? problem->pressure_right : problem->pressure_left) - rupture) / s.pressure;
  s.kappa = 1.0 - (s.inlet - s.outlet) / M_PI;
  s.kappa_outlet = 2.0 - s.kappa;
  return s;
}

SbFilmFluid sb_film_fluid(const SbFilmProblem *problem, double pressure, double film) {
  const double stress = problem->eyring_stress;
  const double shear = problem->viscosity * fabs(problem->speed) / film; // of a unit film
  return (SbFilmFluid){.rupture = problem->rupture_pressure / pressure,
                       .barus = problem->pressure_viscosity * pressure,
                       .eyring = stress > 0.0 ? shear / stress : 0.0};
}

// exp(-alpha p).
static double fluidity(const SbFilmFluid *fluid, double pressure) {
  return exp(-fluid->barus * (pressure + fluid->rupture));
}

void sb_film_mobility(double *m, double *m_film, double *m_pressure, const SbFilmFluid *fluid,
                      double film, double pressure) {
  double thin = fluidity(fluid, pressure);
  double shear = fluid->eyring / (thin * film);
  double root = sqrt(1.0 + shear * shear);
  *m = thin * root;
  *m_film = -thin * shear * shear / (root * film);
  *m_pressure = fluid->barus * thin * (shear * shear / root - root);
}

double sb_film_shear(const SbFilmFluid *fluid, double film, double pressure) {
  double thin = fluidity(fluid, pressure);
  double shear = fluid->eyring / (thin * film);
  return (shear > 0.0 ? asinh(shear) / shear : 1.0) / (thin * film);
}

double sb_film_dry_gap(double X) {
  double a = fabs(X);
  if (a <= 1.0) {
    return 0.0;
  }
  // 1/2 [a sqrt(a^2 - 1) - ln(a + sqrt(a^2 - 1))], by its series where the two terms cancel.
  double t = a - 1.0;
  if (t < 1e-3) {
    return sqrt(2.0) * t * sqrt(t) * (2.0 / 3.0 + t * (1.0 / 10.0 - t / 112.0));
  }
  double r = sqrt(t * (a + 1.0));
  return 0.5 * (a * r - log(a + r));
}

double sb_film_ends(double X, double inlet, double outlet) {
  double step = asin(fmin(fmax(X, -1.0), 1.0)) / M_PI;
  return inlet * (0.5 - step) + outlet * (0.5 + step);
}

double sb_film_dry_pressure(double X, double inlet, double outlet) {
  return sqrt(fmax((1.0 - X) * (1.0 + X), 0.0)) + sb_film_ends(X, inlet, outlet);
}

void sb_film_begin(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale) {
  memset(out, 0, sizeof *out);
  SbFilmProfile *profile = problem->profile;
  if (profile != NULL) {
    out->x = profile->x;
    out->pressure = profile->pressure;
    out->film = profile->film;
    out->asperity_pressure = profile->asperity_pressure;
  }
  out->model = problem->model;
  out->hertz_half_width = scale->half_width;
  out->hertz_pressure = scale->pressure;
  out->moes_M = scale->M;
  out->moes_U = scale->U;
  out->moes_W = scale->W;
  out->lambda = scale->lambda;
  // Moes: below about 0.5 deformation hardly matters, above about 20 there is a Hertz contact.
  const char *regime = scale->U <= 0.0   ? "dry"
                       : scale->M < 0.5  ? "isoviscous-rigid"
                       : scale->M < 20.0 ? "transition"
                                         : "isoviscous-elastic";
  strncpy(out->regime, regime, sizeof out->regime - 1);
  out->film_ratio = NAN;
  out->valid = true;
}

// A film from the flow frame into the seal's.
static void turn(SbFilm *out) {
  double *const along[] = {&out->position_film_min, &out->position_rupture,
                           &out->friction_couette,  &out->friction_poiseuille,
                           &out->friction_cavity,   &out->friction_boundary};
  for (int k = 0; k < 6; k++) {
    *along[k] = 0.0 - *along[k]; // no negative zero
  }
  double *const column[] = {out->x, out->pressure, out->film, out->asperity_pressure};
  for (size_t k = 0; k < 4 && out->points > 0; k++) {
    gsl_vector_view turned = gsl_vector_view_array(column[k], out->points);
    gsl_vector_reverse(&turned.vector);
  }
  cblas_dscal((int)out->points, -1.0, out->x, 1);
}

// Flags films thinner than a few molecules and shapes that the models do not cover.
static void warn_common(SbFilm *out, const SbFilmProblem *problem) {
  // The circle departs from its parabola by (x/R)^2/4, and the film builds up over sqrt(2 R h).
  if (problem->compliance == NULL && problem->speed != 0.0 &&
      out->film_min > SB_FILM_THICK * problem->radius) {
    out->valid = false;
    sb_warn(&out->warnings, "film-thick", SB_FILM_IN_VISCOSITY,
            "minimum film %.3g mm is %.2g of the radius: a parabola does not approximate the "
            "cylinder at this distance",
            out->film_min * 1e3, out->film_min / problem->radius);
  }
  if (problem->speed != 0.0 && out->film_min < 2e-9) {
    sb_warn(&out->warnings, "film-below-continuum", SB_FILM_IN_SPEED,
            "minimum film %.3g nm is thinner than the continuum limit of about 2 nm: formal result",
            out->film_min * 1e9);
  }
}

// Solves smooth surfaces at rest. `dry`: the contact of a fitted body, NULL without one.
static SbStatus solve_rest(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                           const SbDryContact *dry, SbReport *report) {
  SbStatus status;
  if (dry != NULL) {
    sb_film_rest_fitted(out, problem, dry);
    status = sb_succeed(report);
  } else {
    status = sb_film_solve_dry(out, scale, report);
  }
  if (sb_film_rough(problem)) { // no film at all between smooth surfaces at rest
    snap_in(out, problem, snap_gap(NULL, problem, scale).high);
  }
  return status;
}

// Solves the film by the coupled solver, with its profile. `memory`: the caller's solver, NULL for
// one that is only used here.
static SbStatus solve_timed(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                            SbFilmSolver *memory, SbReport *report) {
  SbFilmSolver *own = NULL;
  SbStatus status = memory == NULL ? sb_film_solver_create(&own, report) : SB_OK;
  SbFilmSolver *solver = memory != NULL ? memory : own;
  const double begin = sb_clock_seconds();
  if (status == SB_OK) {
    status = solve_coupled(out, problem, scale, solver, report);
  }
  out->solver.wall_s = sb_clock_seconds() - begin;
  if (out->film_central > 0.0) {
    sb_ehl_profile(out, problem, solver->now, scale);
  }
  sb_film_solver_destroy(own);
  return status;
}

SbStatus sb_film_solve(SbFilm *out, const SbFilmProblem *problem, SbFilmSolver *memory,
                       SbReport *report) {
  memset(out, 0, sizeof *out);
  SbStatus status = check(problem, report);
  if (status != SB_OK) {
    return status;
  }
  SbFilmScale scale = sb_film_scale(problem);
  sb_film_begin(out, problem, &scale);
  Solve *closed = models[problem->model].closed;
  const bool fitted = problem->compliance != NULL && closed == NULL;
  SbDryContact dry;
  if (fitted) {
    status = sb_film_scale_fitted(&scale, &dry, problem, report);
    if (status != SB_OK) {
      return status;
    }
  }
  if (scale.kappa <= 0.02 || scale.kappa_outlet <= 0.02) {
    status = sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_FILM_IN_PRESSURE,
                           "the end pressures differ by %.3g of the Hertz pressure; near "
                           "pi they open the contact",
                           fabs(scale.inlet - scale.outlet));
    return sb_fail_because(report, status, SB_CAUSE_FLUID_OPENS);
  }
  if (scale.U <= 0.0 && problem->surface == SB_ROUGH_NONE) {
    status = solve_rest(out, problem, &scale, fitted ? &dry : NULL, report);
  } else {
    if (closed != NULL) {
      status = closed(out, problem, &scale, report);
      out->solver.converged = status == SB_OK;
    } else {
      status = solve_timed(out, problem, &scale, memory, report);
    }
    if (problem->speed < 0.0) {
      turn(out);
    }
    out->flow = 0.5 * problem->speed * out->film_flux;
  }
  if (status == SB_ERROR_NOT_CONVERGED) {
    out->valid = false;
  }
  if (status == SB_OK || (status == SB_ERROR_NOT_CONVERGED && out->film_central > 0.0)) {
    warn_common(out, problem);
  }
  return status;
}
