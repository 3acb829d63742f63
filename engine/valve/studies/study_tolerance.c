// What the tolerances of the sizes do to the valve: load of both seals, break-away force and least
// return force, each size moved over its own tolerance band, the worst case and the root of the sum
// of squares.
//
// Every point is a whole quasi-static cycle of its own. Abscissa: the size's place in its band, -1
// to +1. Root sum of squares: nominal -+ sqrt(sum of half differences squared), independent sizes,
// so linear. Worst case: the corner that the signs of those differences choose, solved anew; it is
// the worst of all corners where every figure rises or falls with every size, which the curves
// show. The groove's width is left out: nothing here depends on it.
#include "engine/valve/studies/study_private.h"

#include <math.h>
#include <string.h>

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

// The figures with the sizes at `place` of their bands, about the base's own.
static void solve(SbStudyWork *work, double value[FIGURES], const double place[SIZES]) {
  static const char *const paths[FIGURES] = {"seals.outer.load_N", "seals.inner.load_N",
                                             "cycle.force_breakaway_N", "cycle.force_return_min_N"};
  static const SbParamId sizes[SIZES] = {
      SB_P_SEAL_OUTER_SECTION_DIAMETER, SB_P_SEAL_INNER_SECTION_DIAMETER,
      SB_P_SEAL_OUTER_INNER_DIAMETER,   SB_P_SEAL_INNER_INNER_DIAMETER,
      SB_P_GLAND_RADIAL_SPACE,          SB_P_BORE_DIAMETER,
      SB_P_STEM_PRESSURE_DIAMETER};
  SbOverride override[SIZES];
  for (int i = 0; i < SIZES; i++) {
    override[i].id = sizes[i];
    override[i].value =
        sb_params_get(&work->base.params, sizes[i]) + place[i] * tolerance_of(&work->base, i);
  }
  sb_study_ask(work, value, paths, FIGURES, override, SIZES);
  const SbSummary *summary = sb_evaluator_summary(work->evaluator);
  if (summary == NULL || !summary->stage[SB_STAGE_E].reached) {
    value[3] = NAN; // the stem never turned back
  }
  if (summary != NULL) {
    work->out->error = fmax(work->out->error, summary->error_force); // leaves out what is NaN
  }
}

// What the curves say: values[size][step][figure].
typedef struct {
  double value[SIZES][2 * STEPS + 1][FIGURES];
} Grid;

static void fill(SbStudyWork *work, Grid *grid) {
  double nominal[FIGURES];
  const double middle[SIZES] = {0};
  solve(work, nominal, middle);
  for (int size = 0; size < SIZES; size++) {
    for (int k = 0; k <= 2 * STEPS; k++) {
      double place[SIZES] = {0};
      place[size] = (k - STEPS) / (double)STEPS;
      if (k == STEPS) {
        memcpy(grid->value[size][k], nominal, sizeof nominal);
      } else {
        solve(work, grid->value[size][k], place);
      }
    }
  }
}

static void table(SbStudyWork *work, const Grid *grid) {
  SbStudy *out = work->out;
  sb_text(out->row_heading, sizeof out->row_heading, "figure");
  sb_study_column(out, "nominal", "N", "N");
  sb_study_column(out, "worst case, least", "N", "N");
  sb_study_column(out, "worst case, most", "N", "N");
  sb_study_column(out, "root sum square, least", "N", "N");
  sb_study_column(out, "root sum square, most", "N", "N");
  for (int size = 0; size < SIZES; size++) {
    sb_study_column(out, column_names[size], "N", "N");
  }
  for (int f = 0; f < FIGURES; f++) {
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
    for (int side = 0; side < 2; side++) {
      double place[SIZES], value[FIGURES];
      for (int size = 0; size < SIZES; size++) {
        place[size] = side == 0 ? -corner[size] : corner[size];
      }
      solve(work, value, place);
      row->value[1 + side] = value[f];
    }
  }
}

void sb_study_tolerance(SbStudyWork *work) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  if (model->motion == SB_MODEL_MOTION_RIG) {
    work->status = sb_fail_parameter(work->report, SB_ERROR_INFEASIBLE, "models.motion",
                                     "the rig has no valve whose sizes could vary");
    return;
  }
  sb_study_fix_machine(work);
  Grid grid;
  fill(work, &grid);
  table(work, &grid);
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
  sb_param_choice_name(sb_param(SB_P_MODELS_FILM), (int)model->film, film, sizeof film);
  sb_text(out->models, sizeof out->models, "fit %s, film %s, quasi-static cycle of the machine",
          sb_fit_model_name(model->fit), film);
  sb_text(out->validity, sizeof out->validity,
          "worst case: where every figure rises or falls with every size; root sum of squares: "
          "independent sizes, linear");
  sb_study_note(out,
                "Half-widths: d %.3g and %.3g mm, ID %.3g and %.3g mm (outer, inner), g %.3g mm, "
                "D %.3g mm, stem %.3g mm. \"by\": half the difference between the band's ends.",
                1e3 * tolerance_of(model, 0), 1e3 * tolerance_of(model, 1),
                1e3 * tolerance_of(model, 2), 1e3 * tolerance_of(model, 3),
                1e3 * tolerance_of(model, 4), 1e3 * tolerance_of(model, 5),
                1e3 * tolerance_of(model, 6));
}
