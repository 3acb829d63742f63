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

static SbStatus solve(SbStudy *out, SbStribeckPoint *points, const SbModel *model, int which,
                      double load, const SbStudyHooks *hooks, SbReport *report) {
  SbFilmProblem problem;
  sb_sliding_film_problem(&problem, model, SB_OUTER, (SbSealPressure){0, 0}, load, 0);
  problem.surface = models[which].model;
  problem.gt_product = model->gt_product;
  problem.sigma = model->sigma;
  problem.sigma_over_beta = model->sigma_over_beta;
  problem.shear_strength = model->shear_strength;
  problem.load_coefficient = model->load_coefficient;
  if (hooks != NULL) {
    problem.cancelled = hooks->cancelled;
    problem.cancelled_data = hooks->data;
  }
  SbReport local = {0};
  SbStatus status = sb_film_stribeck(points, POINTS, &problem, model->study.speed_min,
                                     model->study.speed_max, NULL, &local);
  if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
    if (report != NULL) {
      *report = local;
    }
    return status;
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
    return sb_succeed(report);
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
  return sb_succeed(report);
}

// The cycle's friction at the same speeds, its parts independent of each other.
static SbStatus draw_cycle(SbStudy *out, SbStudySeries *friction, const SbModel *model,
                           SbReport *report) {
  SbSlidingMemory *memory = NULL;
  SbStatus status = sb_sliding_memory_create(&memory, report);
  SbSealPressure pressure = sb_model_seal_pressure(model, SB_OUTER, SB_CHAMBER_AT_REST);
  for (int i = 0; status == SB_OK && i < POINTS; i++) {
    double speed = model->study.speed_min *
                   pow(model->study.speed_max / model->study.speed_min, i / (POINTS - 1.0));
    SbSliding state;
    status = sb_study_sliding(out, &state, model, SB_OUTER, pressure, speed, memory, report);
    sb_study_point(friction, speed,
                   state.load > 0 ? sb_sliding_friction(&state) / state.load : NAN);
  }
  sb_sliding_memory_destroy(memory);
  return status;
}

// The outer seal's net load per length as fitted.
static SbStatus net_load(SbStudy *out, double *load, const SbModel *model, SbReport *report) {
  SbSlidingMemory *memory = NULL;
  SbStatus status = sb_sliding_memory_create(&memory, report);
  SbSliding state = {0};
  if (status == SB_OK) {
    SbSealPressure pressure = sb_model_seal_pressure(model, SB_OUTER, SB_CHAMBER_AT_REST);
    status = sb_study_sliding(out, &state, model, SB_OUTER, pressure, 0, memory, report);
  }
  sb_sliding_memory_destroy(memory);
  *load = state.load_net;
  if (status == SB_OK && !(state.load_net > 0)) {
    return sb_fail_parameter(report, SB_ERROR_INFEASIBLE, "seal.section_diameter",
                             "the outer seal bears no load: there is no film to speak of");
  }
  return status;
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

SbStatus sb_study_stribeck(SbStudy *out, const SbModel *model, const SbStudyHooks *hooks,
                           SbReport *report) {
  double load = 0;
  SbStatus status = net_load(out, &load, model, report);
  SbStribeckPoint *points = calloc(MODELS * POINTS, sizeof *points);
  if (status == SB_OK && points == NULL) {
    status = sb_fail(report, SB_ERROR_MEMORY, "no memory for a study");
  }
  sb_study_axis(&out->x, "sliding speed", "m/s", "mm/s", true);
  SbStudyPanel *friction = sb_study_panel(out, "coefficient of friction", "1", "", true);
  SbStudyPanel *share = sb_study_panel(out, "load that asperities bear", "1", "%", false);
  SbStudyPanel *film = sb_study_panel(out, "central film over roughness", "1", "", true);
  for (int m = 0; status == SB_OK && m < MODELS; m++) {
    SbStribeckPoint *own = points + m * POINTS;
    status = solve(out, own, model, m, load, hooks, report);
    SbStudySeries *f = sb_study_series(friction, SB_STUDY_CURVE, "%s", models[m].name);
    SbStudySeries *s = sb_study_series(share, SB_STUDY_CURVE, "%s", models[m].name);
    SbStudySeries *h = sb_study_series(film, SB_STUDY_CURVE, "%s", models[m].name);
    for (int i = 0; status == SB_OK && i < POINTS; i++) {
      bool good = own[i].converged;
      out->error = fmax(out->error, good ? own[i].error : 0);
      sb_study_point(f, own[i].speed, good ? own[i].coefficient : NAN);
      sb_study_point(s, own[i].speed, good ? own[i].asperity_share : NAN);
      sb_study_point(h, own[i].speed, good ? own[i].film_ratio : NAN);
    }
    if (status == SB_OK) {
      status = sb_study_step(hooks, 0.9 * (m + 1) / MODELS, report);
    }
  }
  if (status == SB_OK) {
    status = draw_cycle(out, sb_study_series(friction, SB_STUDY_REFERENCE, "as the cycle takes it"),
                        model, report);
  }
  if (status == SB_OK) {
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
  }
  free(points);
  return status;
}
