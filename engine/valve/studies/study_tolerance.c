// What the tolerances of the sizes do to the valve: load of both seals, break-away force and least
// return force, each size moved over its own tolerance band, the worst case and the root of the sum
// of squares.
//
// Every point is a whole quasi-static cycle of its own. Abscissa: the size's place in its band, -1
// to +1. Root sum of squares: nominal -+ sqrt(sum of half differences squared), independent sizes,
// so linear. Worst case: the corner that the signs of those differences choose, solved anew; it is
// the worst of all corners where every figure rises or falls with every size, which the curves
// show. The groove's width is left out: nothing here depends on it.
#include "engine/valve/run/run.h"
#include "engine/valve/studies/study_private.h"

#include <math.h>
#include <stdlib.h>

enum { SIZES = 7, STEPS = 2, FIGURES = 4 }; // STEPS on either side

static const char *const size_names[SIZES] = {
    "section, outer ring",
    "section, inner ring",
    "inner diameter, outer ring",
    "inner diameter, inner ring",
    "radial space",
    "bore",
    "stem",
};

static const char *const column_names[SIZES] = {
    "by d, outer", "by d, inner", "by ID, outer", "by ID, inner", "by g", "by bore", "by stem"};

static const struct {
  const char *name;
  bool drawn;
} figures[FIGURES] = {{"load of the outer seal", true},
                      {"load of the inner seal", false},
                      {"break-away force", true},
                      {"least return force", true}};

double sb_study_tolerance_cost(const SbModel *model) {
  double fit = sb_cost_fit(model->fit);
  double film = sb_cost_film(model->film);
  return (2 * STEPS * SIZES + 1 + 2 * FIGURES) * (2 * fit + 10 * film + SB_COST_ACTUATION);
}

static double tolerance_of(const SbModel *model, int size) {
  switch (size) {
  case 0:
    return model->seal[SB_OUTER].section_diameter_tolerance;
  case 1:
    return model->seal[SB_INNER].section_diameter_tolerance;
  case 2:
    return model->seal[SB_OUTER].inner_diameter_tolerance;
  case 3:
    return model->seal[SB_INNER].inner_diameter_tolerance;
  case 4:
    return model->radial_space_tolerance;
  case 5:
    return model->bore_diameter_tolerance;
  default:
    return model->stem_diameter_tolerance;
  }
}

// A copy of the model with its sizes at `place` of their bands; false if they do not go together.
static bool move_sizes(SbModel *out, const SbModel *model, const double place[SIZES]) {
  double by[SIZES];
  for (int i = 0; i < SIZES; i++) {
    by[i] = place[i] * tolerance_of(model, i);
  }
  *out = *model;
  out->seal[SB_OUTER].stored.section_diameter += by[0];
  out->seal[SB_INNER].stored.section_diameter += by[1];
  out->seal[SB_OUTER].stored.inner_diameter += by[2];
  out->seal[SB_INNER].stored.inner_diameter += by[3];
  out->radial_space += by[4];
  out->bore_diameter += by[5];
  out->bore_circumference = M_PI * out->bore_diameter;
  out->stem_diameter += by[6];
  out->pressure_force = out->canister_pressure * M_PI / 4 * out->stem_diameter * out->stem_diameter;
  bool good = out->stem_diameter <= out->bore_diameter;
  for (int seal = 0; good && seal < SB_SEAL_COUNT; seal++) {
    good = sb_model_size_seal(out, seal, NULL);
  }
  return good;
}

// The study's cancel as a run's.
static bool run_cancelled(void *data) {
  const SbStudyHooks *hooks = data;
  return hooks->cancelled(hooks->data);
}

static SbStatus solve(SbStudy *out, double value[FIGURES], const SbModel *scene,
                      const double place[SIZES], const SbStudyHooks *hooks, SbReport *report) {
  for (int i = 0; i < FIGURES; i++) {
    value[i] = NAN;
  }
  SbModel model;
  if (!move_sizes(&model, scene, place)) {
    sb_warn(&out->warnings, "study-gap-tolerance", "bore.diameter",
            "some corner of the tolerances leaves no valve that could be put together");
    return sb_succeed(report);
  }
  SbPlan plan;
  sb_plan_make(&plan, &model);
  SbRun *run = NULL;
  SbReport local = {0};
  SbStatus status = sb_run_create(&run, &model, &plan, &local);
  if (status == SB_OK) {
    SbRunHooks own = {NULL, hooks != NULL && hooks->cancelled != NULL ? run_cancelled : NULL,
                      (void *)(uintptr_t)hooks};
    status = sb_run_execute(run, &own, &local);
  }
  if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
    sb_run_destroy(run);
    if (report != NULL) {
      *report = local;
    }
    return status;
  }
  if (status == SB_OK) {
    const SbSummary *summary = sb_run_summary(run);
    value[0] = summary->seal[SB_OUTER].load;
    value[1] = summary->seal[SB_INNER].load;
    value[2] = summary->force_breakaway;
    value[3] = summary->stage[SB_STAGE_E].reached ? summary->force_return_min : NAN;
    out->solves += summary->counters.ring_solves + summary->counters.disc_solves +
                   summary->counters.reynolds_solves;
    if (isfinite(summary->error_load)) {
      out->error = fmax(out->error, summary->error_load);
    }
  } else {
    sb_warn(&out->warnings, "study-gap-tolerance", local.parameter, "no cycle at some sizes: %s",
            local.text);
    out->complete = out->complete && status != SB_ERROR_NOT_CONVERGED;
  }
  sb_run_destroy(run);
  return sb_succeed(report);
}

// What the curves say: values[size][step][figure].
typedef struct {
  double value[SIZES][2 * STEPS + 1][FIGURES];
} Grid;

static SbStatus fill(SbStudy *out, Grid *grid, const SbModel *model, const SbStudyHooks *hooks,
                     SbReport *report) {
  double nominal[FIGURES];
  const double middle[SIZES] = {0};
  SbStatus status = solve(out, nominal, model, middle, hooks, report);
  for (int size = 0; status == SB_OK && size < SIZES; size++) {
    for (int k = 0; status == SB_OK && k <= 2 * STEPS; k++) {
      double place[SIZES] = {0};
      place[size] = (k - STEPS) / (double)STEPS;
      if (k == STEPS) {
        for (int f = 0; f < FIGURES; f++) {
          grid->value[size][k][f] = nominal[f];
        }
        continue;
      }
      status = solve(out, grid->value[size][k], model, place, hooks, report);
      if (status == SB_OK) {
        status = sb_study_step(hooks, 0.8 * (size + (k + 1.0) / (2 * STEPS + 1)) / SIZES, report);
      }
    }
  }
  return status;
}

static SbStatus table(SbStudy *out, const Grid *grid, const SbModel *model,
                      const SbStudyHooks *hooks, SbReport *report) {
  sb_text(out->row_heading, sizeof out->row_heading, "figure");
  sb_study_column(out, "nominal", "N", "N");
  sb_study_column(out, "worst case, least", "N", "N");
  sb_study_column(out, "worst case, most", "N", "N");
  sb_study_column(out, "root sum square, least", "N", "N");
  sb_study_column(out, "root sum square, most", "N", "N");
  for (int size = 0; size < SIZES; size++) {
    sb_study_column(out, column_names[size], "N", "N");
  }
  SbStatus status = SB_OK;
  for (int f = 0; status == SB_OK && f < FIGURES; f++) {
    SbStudyRow *row = sb_study_row(out, NULL, NULL, "%s", figures[f].name);
    double nominal = grid->value[0][STEPS][f], squares = 0;
    double corner[SIZES];
    for (int size = 0; size < SIZES; size++) {
      double half = (grid->value[size][2 * STEPS][f] - grid->value[size][0][f]) / 2;
      row->value[5 + size] = half;
      squares += half * half;
      corner[size] = half >= 0 ? 1 : -1;
    }
    row->value[0] = nominal;
    row->value[3] = nominal - sqrt(squares);
    row->value[4] = nominal + sqrt(squares);
    for (int side = 0; status == SB_OK && side < 2; side++) {
      double place[SIZES], value[FIGURES];
      for (int size = 0; size < SIZES; size++) {
        place[size] = side == 0 ? -corner[size] : corner[size];
      }
      status = solve(out, value, model, place, hooks, report);
      row->value[1 + side] = value[f];
    }
    if (status == SB_OK) {
      status = sb_study_step(hooks, 0.8 + 0.2 * (f + 1) / FIGURES, report);
    }
  }
  return status;
}

SbStatus sb_study_tolerance(SbStudy *out, const SbModel *scene, const SbStudyHooks *hooks,
                            SbReport *report) {
  if (scene->motion == SB_MODEL_MOTION_RIG) {
    return sb_fail_parameter(report, SB_ERROR_INFEASIBLE, "models.motion",
                             "the rig has no valve whose sizes could vary");
  }
  // The cycle of the test machine, whatever drives the scene; no views, so nothing else is
  // computed.
  SbModel model = *scene;
  model.motion = SB_MODEL_MOTION_QUASI_STATIC;
  model.drive = SB_MODEL_DRIVE_MACHINE;
  model.views = SB_VIEW_HYSTERESIS;
  model.studies = 0;
  model.frames = 2;
  Grid grid;
  SbStatus status = fill(out, &grid, &model, hooks, report);
  if (status == SB_OK) {
    status = table(out, &grid, &model, hooks, report);
  }
  if (status != SB_OK) {
    return status;
  }
  sb_study_axis(&out->x, "place in the size's tolerance band", "1", "", false);
  for (int f = 0; f < FIGURES; f++) {
    if (!figures[f].drawn) {
      continue;
    }
    SbStudyPanel *panel = sb_study_panel(out, figures[f].name, "N", "N", false);
    for (int size = 0; size < SIZES; size++) {
      SbStudySeries *series = sb_study_series(panel, SB_STUDY_CURVE, "%s", size_names[size]);
      for (int k = 0; k <= 2 * STEPS; k++) {
        sb_study_point(series, (k - STEPS) / (double)STEPS, grid.value[size][k][f]);
      }
    }
  }
  char film[32];
  sb_param_choice_name(sb_param(SB_P_MODELS_FILM), (int)model.film, film, sizeof film);
  sb_text(out->models, sizeof out->models, "fit %s, film %s, quasi-static cycle of the machine",
          sb_fit_model_name(model.fit), film);
  sb_text(out->validity, sizeof out->validity,
          "worst case: where every figure rises or falls with every size; root sum of squares: "
          "independent sizes, linear");
  sb_study_note(out,
                "Half-widths: d %.3g and %.3g mm, ID %.3g and %.3g mm (outer, inner), g %.3g mm, "
                "D %.3g mm, stem %.3g mm. \"by\": half the difference between the band's ends.",
                1e3 * tolerance_of(&model, 0), 1e3 * tolerance_of(&model, 1),
                1e3 * tolerance_of(&model, 2), 1e3 * tolerance_of(&model, 3),
                1e3 * tolerance_of(&model, 4), 1e3 * tolerance_of(&model, 5),
                1e3 * tolerance_of(&model, 6));
  return SB_OK;
}
