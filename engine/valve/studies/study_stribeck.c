// Stribeck curve: coefficient of friction, the asperities' share of the load, and the film against
// the sliding speed, film and asperities solved in one Newton (film/ehl.h, film/stribeck.h).
//
// The outer seal's net load at its pressures of B-C without its end pressures, both surface models
// beside each other: Greenwood and Tripp (whose real area the default shear strength was set with)
// and Persson (whose real area is much larger for a soft seal, so that the same shear strength
// gives too much friction; docs/thesis.md, 10). The load coefficient m acts on the asperities' load
// here, where the cycle takes the total. The cycle's own friction, film and roughness not knowing
// of each other, is drawn as a reference.
#include "engine/film/stribeck.h"
#include "engine/valve/sliding.h"
#include "engine/valve/studies/study_private.h"

#include <math.h>
#include <string.h>

enum { POINTS = 41, MODELS = 2 };

static const struct {
  const char *name;
  SbRoughModel model;
} models[MODELS] = {{"Greenwood & Tripp", SB_ROUGH_GREENWOOD_TRIPP}, {"Persson", SB_ROUGH_PERSSON}};

// Solves one surface model's curve; points that have no answer are not converged.
static void solve_surface(SbStudyWork *work, SbStribeckPoint *points, int which, double load) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  SbFilmProblem problem;
  sb_sliding_film_problem(&problem, model, SB_OUTER, (SbSealPressure){0, 0}, load, 0);
  problem.surface = models[which].model;
  problem.gt_product = model->gt_product;
  problem.sigma = model->sigma;
  problem.sigma_over_beta = model->sigma_over_beta;
  problem.shear_strength = model->shear_strength;
  problem.load_coefficient = model->load_coefficient;
  problem.cancelled = work->hooks.cancelled;
  problem.cancelled_data = work->hooks.data;
  SbReport local = {0};
  SbStatus status = work->status != SB_OK
                        ? work->status
                        : sb_film_stribeck(points, POINTS, &problem, work->lo, work->hi, &local);
  if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
    (void)sb_study_goes_on(work, status, &local);
    return;
  }
  // The scene's own surface is the subject; gaps of the other are a warning.
  bool own = model->surface == models[which].model;
  if (status != SB_OK) {
    // This surface model has no answer at all: the other may.
    sb_warn(&out->warnings, "study-gap-surface", local.parameter, "%s: %s", models[which].name,
            local.text);
    out->complete = out->complete && (status != SB_ERROR_NOT_CONVERGED || !own);
    return;
  }
  for (int i = 0; i < POINTS; i++) {
    out->solves++;
    out->error = fmax(out->error, points[i].error);
    if (!points[i].converged) {
      out->complete = out->complete && !own;
      sb_warn(&out->warnings, "study-gap-stribeck", "study.speed_min",
              "%s: the mixed film did not converge at %.3g mm/s and perhaps elsewhere",
              models[which].name, points[i].speed * 1e3);
    }
  }
}

// A row every so many points of a curve.
static void put_rows(SbStudy *out, const SbStribeckPoint *points) {
  for (int i = 0; i < POINTS; i += 5) {
    const SbStribeckPoint *p = &points[i];
    SbStudyRow *row = p->speed < 1 ? sb_study_row(out, "%.3g mm/s", p->speed * 1e3)
                                   : sb_study_row(out, "%.3g m/s", p->speed);
    if (p->converged) {
      const double value[] = {p->film_central,   p->film_min,       p->film_ratio,
                              p->boundary,       p->viscous,        p->coefficient,
                              p->asperity_share, p->real_area_share};
      memcpy(row->value, value, sizeof value);
    }
  }
}

static void make(SbStudyWork *work) {
  static const char *const cycle[] = {"seals.outer.coefficient_of_friction"};
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  sb_study_fix_machine(work);
  work->total = INFINITY; // these questions are no measure of the progress
  double load = sb_study_net_load(work);
  if (work->status == SB_OK && !(load > 0)) {
    work->status = sb_fail_parameter(work->report, SB_ERROR_INFEASIBLE, "seal.section_diameter",
                                     "the outer seal bears no load: there is no film to speak of");
  }
  if (work->status != SB_OK) {
    return;
  }
  for (int m = 0; m < MODELS; m++) {
    SbStribeckPoint points[POINTS] = {0};
    solve_surface(work, points, m, load);
    for (size_t p = 0; p < out->panel_count; p++) {
      SbStudySeries *series = sb_study_series(&out->panel[p], SB_STUDY_CURVE, models[m].name);
      for (int i = 0; i < POINTS; i++) {
        const SbStribeckPoint *at = &points[i];
        const double value[] = {at->coefficient, at->asperity_share, at->film_ratio};
        sb_study_point(series, sb_study_place(work, i, POINTS), at->converged ? value[p] : NAN);
      }
    }
    if (m == 0) {
      put_rows(out, points);
    }
    sb_study_step(work, 0.9 * (m + 1) / MODELS);
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
  sb_study_mark_scene(work, model->speed, "drive");
  sb_study_note(out,
                "Net load %.0f N/m, roughness %.3g \xc2\xb5m, shear strength %.3g MPa, m %.3g on "
                "the asperities' load (the cycle: on the total).",
                load, model->sigma * 1e6, model->shear_strength * 1e-6, model->load_coefficient);
}

const SbStudyDesign sb_study_stribeck = {
    .x = {"sliding speed", "m/s", "mm/s", true},
    .panel = {{"coefficient of friction", "1", "", true},
              {"load that asperities bear", "1", "%"},
              {"central film over roughness", "1", "", true}},
    .range = offsetof(SbStudyRange, speed_min),
    .row_heading = "Greenwood & Tripp at",
    .column = {{"central film", "m", "nm"},
               {"least film", "m", "nm"},
               {"film over roughness", "1", ""},
               {"boundary friction", "N/m", "N/m"},
               {"viscous friction", "N/m", "N/m"},
               {"coefficient", "1", ""},
               {"asperities bear", "1", "%"},
               {"real area", "1", "%"}},
    .models = "mixed film: reynolds with Greenwood & Tripp or Persson in one solve, half-plane",
    .validity = "isoviscous, no end pressures; Greenwood & Tripp: small real area; the shear "
                "strength was set with Greenwood & Tripp's",
    .solves = {.mixed = MODELS * POINTS},
    .make = make,
};
