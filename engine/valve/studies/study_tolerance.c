// What the tolerances of the sizes do to the valve: load of both seals, break-away force, least
// return force and dose, each size moved over its own tolerance band, the worst case and the root
// of the sum of squares.
//
// Every point is a whole quasi-static cycle of its own. Abscissa: the size's place in its band, -1
// to +1. Root sum of squares: nominal -+ sqrt(sum of half differences squared), independent sizes,
// so linear. Worst case: the corner that the signs of those differences choose, solved anew; it is
// the worst of all corners where every figure rises or falls with every size, which the curves
// show. The groove's width is left out: nothing here depends on it.
#include "engine/valve/studies/study_private.h"

#include <math.h>
#include <string.h>

enum { SIZES = 7, STEPS = 2, FIGURES = 5 }; // STEPS on either side of the nominal size
enum { LOAD_OUTER, BREAKAWAY, RETURN, LOAD_INNER, DOSE };

// A line of the study is a set of sizes, a bit for each, and those of it that move the other way.
enum { EVERY = (1 << SIZES) - 1, REVERSED = SIZES };

static const struct {
  const char *name;
  SbParamId size, band; // and the half-width of its tolerance band
} sizes[SIZES] = {
    {"section, outer ring", SB_P_SEAL_OUTER_SECTION_DIAMETER,
     SB_P_SEAL_OUTER_SECTION_DIAMETER_TOLERANCE},
    {"section, inner ring", SB_P_SEAL_INNER_SECTION_DIAMETER,
     SB_P_SEAL_INNER_SECTION_DIAMETER_TOLERANCE},
    {"inner diameter, outer ring", SB_P_SEAL_OUTER_INNER_DIAMETER,
     SB_P_SEAL_OUTER_INNER_DIAMETER_TOLERANCE},
    {"inner diameter, inner ring", SB_P_SEAL_INNER_INNER_DIAMETER,
     SB_P_SEAL_INNER_INNER_DIAMETER_TOLERANCE},
    {"radial space", SB_P_GLAND_RADIAL_SPACE, SB_P_GLAND_RADIAL_SPACE_TOLERANCE},
    {"bore", SB_P_BORE_DIAMETER, SB_P_BORE_DIAMETER_TOLERANCE},
    {"stem", SB_P_STEM_PRESSURE_DIAMETER, SB_P_STEM_PRESSURE_DIAMETER_TOLERANCE},
};

// The figures with the sizes of a line at x of their bands, about the base's own.
static void solve(double *value, SbStudyWork *work, int line, double x) {
  static const char *const paths[FIGURES] = {"seals.outer.load_N", "cycle.force_breakaway_N",
                                             "cycle.force_return_min_N", "seals.inner.load_N",
                                             "cycle.dose_mass_kg"};
  if (x == 0 && line != 0) {
    memcpy(value, sb_study_at(work, 0, 0), FIGURES * sizeof *value); // nominal, whatever moves
    return;
  }
  SbOverride override[SIZES];
  const SbParams *base = &work->base.params;
  for (int i = 0; i < SIZES; i++) {
    double place = (line >> i & 1) == 0 ? 0 : (line >> REVERSED >> i & 1) == 0 ? x : -x;
    override[i].id = sizes[i].size;
    override[i].value =
        sb_params_get(base, sizes[i].size) + place * sb_params_get(base, sizes[i].band);
  }
  sb_study_ask(work, value, paths, FIGURES, override, SIZES);
  const SbSummary *summary = sb_evaluator_summary(work->evaluator);
  if (summary == NULL || !summary->stage[SB_STAGE_E].reached) {
    value[RETURN] = NAN; // the stem never turned back
  }
  if (summary != NULL) {
    work->out->error = fmax(work->out->error, summary->error_force); // leaves out what is NaN
  }
}

static void put_row(SbStudyWork *work, const char *name, int figure) {
  SbStudyRow *row = sb_study_row(work->out, "%s", name);
  double squares = 0;
  int corner = EVERY;
  for (int size = 0; size < SIZES; size++) {
    const int line = 1 << size;
    double half = (sb_study_at(work, line, 1)[figure] - sb_study_at(work, line, -1)[figure]) / 2;
    row->value[5 + size] = half;
    squares += half * half;
    corner |= half >= 0 ? 0 : line << REVERSED;
  }
  const double nominal = sb_study_at(work, 0, 0)[figure];
  row->value[0] = nominal;
  row->value[1] = sb_study_at(work, corner, -1)[figure];
  row->value[2] = sb_study_at(work, corner, 1)[figure];
  row->value[3] = nominal - sqrt(squares);
  row->value[4] = nominal + sqrt(squares);
}

static void make(SbStudyWork *work) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  if (model->motion == SB_MODEL_MOTION_RIG) {
    work->status = sb_fail_parameter(work->report, SB_ERROR_INFEASIBLE, "models.motion",
                                     "the rig has no valve whose sizes could vary");
    return;
  }
  work->lo = -1;
  work->hi = 1;
  double band[SIZES]; // [mm]
  for (int size = 0; size < SIZES; size++) {
    sb_study_curves(work, SB_STUDY_CURVE, sizes[size].name, 1 << size, NULL, 2 * STEPS + 1);
    band[size] = 1e3 * sb_params_get(&model->params, sizes[size].band);
  }
  put_row(work, "load of the outer seal", LOAD_OUTER);
  put_row(work, "load of the inner seal", LOAD_INNER);
  put_row(work, "break-away force", BREAKAWAY);
  put_row(work, "least return force", RETURN);
  put_row(work, "dose", DOSE);
  SbStudyRow *dose = &out->row[out->row_count - 1];
  sb_text(dose->si, sizeof dose->si, "kg");
  sb_text(dose->unit, sizeof dose->unit, "mg");
  sb_text(out->models, sizeof out->models, "fit %s, film %s, quasi-static cycle of the machine",
          sb_fit_model_name(model->fit), sb_film_model_name(model->film));
  sb_study_note(out,
                "Half-widths: d %.3g and %.3g mm, ID %.3g and %.3g mm (outer, inner), g %.3g mm, "
                "D %.3g mm, stem %.3g mm. \"by\": half the difference between the band's ends.",
                band[0], band[1], band[2], band[3], band[4], band[5], band[6]);
}

enum { CYCLES = 2 * STEPS * SIZES + 1 + 2 * FIGURES };

const SbStudyDesign sb_study_tolerance = {
    .x = "place in the size's tolerance band",
    .panel = {"load of the outer seal [N]", "break-away force [N]", "least return force [N]"},
    .row_heading = "figure",
    .column = {"nominal [N]", "worst case, least [N]", "worst case, most [N]",
               "root sum square, least [N]", "root sum square, most [N]", "by d, outer [N]",
               "by d, inner [N]", "by ID, outer [N]", "by ID, inner [N]", "by g [N]", "by bore [N]",
               "by stem [N]"},
    .validity = "worst case: where every figure rises or falls with every size; root sum of "
                "squares: independent sizes, linear",
    .solves = {.fits = 2 * CYCLES, .films = 10 * CYCLES, .cycles = CYCLES},
    .solve = solve,
    .make = make,
};
