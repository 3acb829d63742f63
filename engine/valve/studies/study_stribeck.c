// Stribeck curve: coefficient of friction, the asperities' share of the load, and the film against
// the sliding speed, film and asperities solved in one Newton (film/ehl.h).
//
// The outer seal's net load at its pressures of B-C without its end pressures, both surface models
// beside each other: Greenwood and Tripp (whose real area the default shear strength was set with)
// and Persson (whose real area is much larger for a soft seal, so that the same shear strength
// gives too much friction; docs/thesis.md, 10). The load coefficient m acts on the asperities' load
// here, where the cycle takes the total. The cycle's own friction, film and roughness not knowing
// of each other, is drawn as a reference.
#include "engine/valve/studies/study_private.h"

#include <math.h>

enum { POINTS = 41, MODELS = 2 };
enum { COEFFICIENT, SHARE, RATIO, CENTRAL, LEAST, BOUNDARY, VISCOUS, AREA };

static const struct {
  const char *name;
  SbRoughModel model;
} models[MODELS] = {{"Greenwood & Tripp", SB_ROUGH_GREENWOOD_TRIPP}, {"Persson", SB_ROUGH_PERSSON}};

// What one surface model has at a speed: the panels' values and those of the table.
static void solve(double *value, SbStudyWork *work, int line, double speed) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  SbFilmProblem problem;
  SbReport report = {0};
  sb_study_film_problem(&problem, work, work->load, speed);
  problem.surface = models[line].model;
  problem.gt_product = model->gt_product;
  problem.sigma = model->sigma;
  problem.sigma_over_beta = model->sigma_over_beta;
  problem.shear_strength = model->shear_strength;
  problem.load_coefficient = model->load_coefficient;
  SbStatus status = sb_study_film(work, &problem, &report);
  if (status != SB_OK) {
    if (status == SB_ERROR_NOT_CONVERGED) {
      // The scene's own surface is the subject; gaps of the other are a warning.
      out->complete = out->complete && model->surface != models[line].model;
      sb_warn(&out->warnings, "study-gap-stribeck", "study.speed_min",
              "%s: the mixed film did not converge at %.3g mm/s and perhaps elsewhere",
              models[line].name, speed * 1e3);
    } else if (work->status == SB_OK) {
      // This surface model has no answer at all: the other may.
      sb_warn(&out->warnings, "study-gap-surface", report.parameter, "%s: %s", models[line].name,
              report.text);
    }
    return;
  }
  const SbFilm *film = &work->film;
  value[RATIO] = film->film_ratio;
  value[CENTRAL] = film->film_central;
  value[LEAST] = film->film_min;
  value[BOUNDARY] = film->friction_boundary;
  value[VISCOUS] = film->friction_couette + film->friction_cavity; // full film and ruptured one
  value[COEFFICIENT] = (value[BOUNDARY] + value[VISCOUS]) / work->load;
  value[SHARE] = film->asperity_share;
  value[AREA] = film->real_area_share;
}

static void make(SbStudyWork *work) {
  static const char *const cycle[] = {"seals.outer.coefficient_of_friction"};
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  work->load = sb_study_net_load(work);
  if (work->status == SB_OK && !(work->load > 0)) {
    work->status = sb_fail_parameter(work->report, SB_ERROR_INFEASIBLE, "seal.section_diameter",
                                     "the outer seal bears no load: there is no film to speak of");
  }
  if (work->status != SB_OK) {
    return;
  }
  for (int m = 0; m < MODELS; m++) {
    sb_study_curves(work, SB_STUDY_CURVE, models[m].name, m, NULL, POINTS);
  }
  for (int i = 0; i < POINTS; i += 5) {
    const double speed = sb_study_place(work, i, POINTS);
    SbStudyRow *row = speed < 1 ? sb_study_row(out, "%.3g mm/s", speed * 1e3)
                                : sb_study_row(out, "%.3g m/s", speed);
    sb_study_cells(row->value, work, speed, 0);
  }
  // The cycle's friction at the same speeds, its parts independent of each other.
  SbStudySeries *friction =
      sb_study_series(&out->panel[0], SB_STUDY_REFERENCE, "as the cycle takes it");
  for (int i = 0; i < POINTS; i++) {
    SbOverride at = {SB_P_DRIVE_SPEED, sb_study_place(work, i, POINTS)};
    double value;
    sb_study_ask(work, &value, cycle, 1, &at, 1);
    sb_study_point(friction, at.value, value);
  }
  sb_study_level(work, &out->panel[2], "film = roughness", 1);
  sb_study_mark(work, model->speed, "drive");
  sb_study_note(out,
                "Net load %.0f N/m, roughness %.3g \xc2\xb5m, shear strength %.3g MPa, m %.3g on "
                "the asperities' load (the cycle: on the total).",
                work->load, model->sigma * 1e6, model->shear_strength * 1e-6,
                model->load_coefficient);
}

const SbStudyDesign sb_study_stribeck = {
    .x = "sliding speed [mm/s]",
    .x_logarithmic = true,
    .panel = {"coefficient of friction", "load that asperities bear [%]",
              "central film over roughness"},
    .logarithmic = {true, false, true},
    .range = offsetof(SbStudyRange, speed_min),
    .row_heading = "Greenwood & Tripp at",
    .column = {"central film [nm]", "least film [nm]", "film over roughness",
               "boundary friction [N/m]", "viscous friction [N/m]", "coefficient",
               "asperities bear [%]", "real area [%]"},
    .value = {CENTRAL, LEAST, RATIO, BOUNDARY, VISCOUS, COEFFICIENT, SHARE, AREA},
    .models = "mixed film: reynolds with Greenwood & Tripp or Persson in one solve, half-plane",
    .validity = "isoviscous, no end pressures; Greenwood & Tripp: small real area; the shear "
                "strength was set with Greenwood & Tripp's",
    .solves = {.mixed = MODELS * POINTS},
    .solve = solve,
    .make = make,
};
