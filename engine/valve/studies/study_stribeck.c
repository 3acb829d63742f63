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
#include <stdlib.h>

enum { POINTS = 41, MODELS = 2 };

static const struct {
  const char *name;
  SbRoughModel model;
} models[MODELS] = {{"Greenwood & Tripp", SB_ROUGH_GREENWOOD_TRIPP}, {"Persson", SB_ROUGH_PERSSON}};

double sb_study_stribeck_cost(const SbModel *model) {
  return MODELS * POINTS * SB_COST_FILM_MIXED;
}

// Solves one surface model's curve; points that have no answer are not converged.
static void solve(SbStudyWork *work, SbStribeckPoint *points, int which, double load) {
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
  if (work->hooks != NULL) {
    problem.cancelled = work->hooks->cancelled;
    problem.cancelled_data = work->hooks->data;
  }
  SbReport local = {0};
  SbStatus status = work->status != SB_OK
                        ? work->status
                        : sb_film_stribeck(points, POINTS, &problem, model->study.speed_min,
                                           model->study.speed_max, &local);
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
    for (int i = 0; i < POINTS; i++) {
      points[i].converged = false;
    }
    return;
  }
  for (int i = 0; i < POINTS; i++) {
    out->solves++;
    if (!points[i].converged) {
      out->complete = out->complete && !own;
      sb_warn(&out->warnings, "study-gap-stribeck", "study.speed_min",
              "%s: the mixed film did not converge at %.3g mm/s and perhaps elsewhere",
              models[which].name, points[i].speed * 1e3);
    }
  }
}

// The cycle's friction at the same speeds, its parts independent of each other.
static void draw_cycle(SbStudyWork *work, SbStudySeries *friction) {
  static const char *const path[] = {"seals.outer.coefficient_of_friction"};
  const SbStudyRange *range = &work->scene->study;
  for (int i = 0; i < POINTS; i++) {
    SbOverride at = {SB_P_DRIVE_SPEED, range->speed_min * pow(range->speed_max / range->speed_min,
                                                              i / (POINTS - 1.0))};
    double value;
    sb_study_ask(work, &value, path, 1, &at, 1);
    sb_study_point(friction, at.value, value);
  }
}

// A row every so many points.
static void put_rows(SbStudy *out, const SbStribeckPoint *points) {
  sb_text(out->row_heading, sizeof out->row_heading, "Greenwood & Tripp at");
  sb_study_column(out, "central film", "m", "nm");
  sb_study_column(out, "least film", "m", "nm");
  sb_study_column(out, "film over roughness", "1", "");
  sb_study_column(out, "boundary friction", "N/m", "N/m");
  sb_study_column(out, "viscous friction", "N/m", "N/m");
  sb_study_column(out, "coefficient", "1", "");
  sb_study_column(out, "asperities bear", "1", "%");
  sb_study_column(out, "real area", "1", "%");
  for (int i = 0; i < POINTS; i += 5) {
    const SbStribeckPoint *p = &points[i];
    SbStudyRow *row = p->speed < 1 ? sb_study_row(out, NULL, NULL, "%.3g mm/s", p->speed * 1e3)
                                   : sb_study_row(out, NULL, NULL, "%.3g m/s", p->speed);
    if (p->converged) {
      const double value[] = {p->film_central,   p->film_min,       p->film_ratio,
                              p->boundary,       p->viscous,        p->coefficient,
                              p->asperity_share, p->real_area_share};
      for (size_t k = 0; k < sizeof value / sizeof value[0]; k++) {
        row->value[k] = value[k];
      }
    }
  }
}

void sb_study_stribeck(SbStudyWork *work) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  sb_study_fix_machine(work);
  work->total = INFINITY; // these questions are no measure of the progress
  double load = sb_study_net_load(work);
  if (work->status == SB_OK && !(load > 0)) {
    work->status = sb_fail_parameter(work->report, SB_ERROR_INFEASIBLE, "seal.section_diameter",
                                     "the outer seal bears no load: there is no film to speak of");
  }
  SbStribeckPoint *points = calloc(MODELS * POINTS, sizeof *points);
  if (points == NULL) {
    work->status = sb_fail(work->report, SB_ERROR_MEMORY, "no memory for a study");
  }
  if (work->status != SB_OK) {
    free(points);
    return;
  }
  sb_study_axis(&out->x, "sliding speed", "m/s", "mm/s", true);
  SbStudyPanel *friction = sb_study_panel(out, "coefficient of friction", "1", "", true);
  sb_study_panel(out, "load that asperities bear", "1", "%", false);
  SbStudyPanel *film = sb_study_panel(out, "central film over roughness", "1", "", true);
  for (int m = 0; m < MODELS; m++) {
    SbStribeckPoint *own = points + m * POINTS;
    solve(work, own, m, load);
    sb_study_curve(out, SB_STUDY_CURVE, models[m].name);
    for (int i = 0; i < POINTS; i++) {
      const double y[] = {own[i].coefficient, own[i].asperity_share, own[i].film_ratio};
      static const double none[] = {NAN, NAN, NAN};
      out->error = fmax(out->error, own[i].converged ? own[i].error : 0);
      sb_study_put(out, own[i].speed, own[i].converged ? y : none);
    }
    sb_study_step(work, 0.9 * (m + 1) / MODELS);
  }
  draw_cycle(work, sb_study_series(friction, SB_STUDY_REFERENCE, "as the cycle takes it"));
  put_rows(out, points);
  SbStudySeries *limit = sb_study_series(film, SB_STUDY_REFERENCE, "film = roughness");
  sb_study_point(limit, model->study.speed_min, 1);
  sb_study_point(limit, model->study.speed_max, 1);
  if (model->speed >= model->study.speed_min && model->speed <= model->study.speed_max) {
    sb_study_mark(out, model->speed, "drive");
  }
  sb_text(out->models, sizeof out->models,
          "mixed film: reynolds with Greenwood & Tripp or Persson in one solve, half-plane");
  sb_text(out->validity, sizeof out->validity,
          "isoviscous, no end pressures; Greenwood & Tripp: small real area; the shear strength "
          "was set with Greenwood & Tripp's");
  sb_study_note(out,
                "Net load %.0f N/m, roughness %.3g \xc2\xb5m, shear strength %.3g MPa, m %.3g on "
                "the asperities' load (the cycle: on the total).",
                load, model->sigma * 1e6, model->shear_strength * 1e-6, model->load_coefficient);
  free(points);
}
