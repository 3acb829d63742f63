// Effects of the tolerances of the sizes on the valve: load of both seals, break-away force,
// minimum return force and dose, each size varied over its own tolerance band; the worst case; and
// the root of the sum of squares.
//
// Every point is a complete quasi-static cycle. Abscissa: the size's position in its band, -1 to
// +1. Root sum of squares: nominal -+ sqrt(sum of half differences squared), independent sizes, so
// linear. Worst case: the corner that the signs of those differences select, computed by a cycle of
// its own. It is the worst of all corners if every figure is monotonic in every size, which the
// curves show. The groove's width is omitted, because nothing here depends on it.
#include "engine/valve/studies/study_private.h"

#include "engine/valve/model/motion_kind.h"

#include <math.h>

enum { SIZES = SB_TOLERANCE_SIZES, STEPS = SB_TOLERANCE_STEPS, FIGURES = SB_TOLERANCE_FIGURES };
enum { LOAD_OUTER, BREAKAWAY, RETURN, LOAD_INNER, DOSE, TURNED };

// A line of assets/studies/tolerance.study is a size. The corners follow: a bit for each size that
// varies in the opposite direction.
enum { CORNERS = SIZES };

// The sizes' places in their bands there; names, and the half-width of the band.
static const struct {
  const char *place, *name;
  SbParamId band;
} sizes[SIZES] = {
    {"outer_section", SB_LABEL("section, outer ring"), SB_P_SEAL_OUTER_SECTION_DIAMETER_TOLERANCE},
    {"inner_section", SB_LABEL("section, inner ring"), SB_P_SEAL_INNER_SECTION_DIAMETER_TOLERANCE},
    {"outer_inside", SB_LABEL("inner diameter, outer ring"),
     SB_P_SEAL_OUTER_INNER_DIAMETER_TOLERANCE},
    {"inner_inside", SB_LABEL("inner diameter, inner ring"),
     SB_P_SEAL_INNER_INNER_DIAMETER_TOLERANCE},
    {"space", SB_LABEL("radial space"), SB_P_GLAND_RADIAL_SPACE_TOLERANCE},
    {"bore", SB_LABEL("bore"), SB_P_BORE_DIAMETER_TOLERANCE},
    {"stem", SB_LABEL("stem"), SB_P_STEM_PRESSURE_DIAMETER_TOLERANCE},
};

static void derive(double *value, SbStudyWork *work, int line, double x) {
  (void)work, (void)line, (void)x;
  if (isnan(value[TURNED])) {
    value[RETURN] = NAN; // the stem never turned back
  }
}

#define SHARE 0.75 // of the work that the grid is, the corners aside

static void corner(double *row, const SbStudyWork *work, int line, double x) {
  for (int i = 0; i < SIZES; i++) {
    row[sb_study_grid_column(work, sizes[i].place)] = ((line - CORNERS) >> i & 1) == 0 ? x : -x;
  }
}

static void put_row(SbStudyWork *work, const char *name, int figure) {
  SbStudy *out = work->out;
  SbStudyRow *row = sb_study_row(out, "%s", name);
  double squares = 0;
  int line = CORNERS;
  for (int size = 0; size < SIZES; size++) {
    double half = (sb_study_at(work, size, 1)[figure] - sb_study_at(work, size, -1)[figure]) / 2;
    row->value[5 + size] = half;
    squares += half * half;
    line += half >= 0 ? 0 : 1 << size;
  }
  const SbStudyPlace ends[] = {{line, -1, corner}, {line, 1, corner}};
  const double done = SHARE + (1 - SHARE) * (double)out->row_count / FIGURES;
  sb_study_more(work, ends, 2, done - (1 - SHARE) / FIGURES, done);
  const double nominal = sb_study_at(work, 0, 0)[figure];
  row->value[0] = nominal;
  row->value[1] = sb_study_at(work, line, -1)[figure];
  row->value[2] = sb_study_at(work, line, 1)[figure];
  row->value[3] = nominal - sqrt(squares);
  row->value[4] = nominal + sqrt(squares);
}

static void make(SbStudyWork *work) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  if (!sb_motion_kind(model)->valve) {
    work->status = sb_fail_input(work->report, SB_ERROR_INFEASIBLE, sb_input(SB_P_MODELS_MOTION),
                                 "the rig has no valve whose sizes could vary");
    return;
  }
  work->lo = -1;
  work->hi = 1;
  double band[SIZES]; // [mm]
  for (int size = 0; size < SIZES; size++) {
    sb_study_curves(work, SB_STUDY_CURVE, sizes[size].name, size, NULL, 2 * STEPS + 1);
    band[size] = 1e3 * sb_params_get(&model->params, sizes[size].band);
  }
  put_row(work, SB_LABEL("load of the outer seal"), LOAD_OUTER);
  put_row(work, SB_LABEL("load of the inner seal"), LOAD_INNER);
  put_row(work, SB_LABEL("break-away force"), BREAKAWAY);
  put_row(work, SB_LABEL("return margin"), RETURN);
  put_row(work, SB_LABEL("dose"), DOSE);
  SbStudyRow *dose = &out->row[out->row_count - 1];
  sb_text(dose->si, sizeof dose->si, "kg");
  sb_text(dose->unit, sizeof dose->unit, "mg");
  sb_message(out->models, sizeof out->models, "fit %s, film %s, quasi-static cycle of the machine",
             sb_fit_kind(model->fit)->name, sb_film_kind(model->film)->name);
  sb_study_note(out,
                "Half-widths: d %.3g and %.3g mm, ID %.3g and %.3g mm (outer, inner), g %.3g mm, "
                "D %.3g mm, stem %.3g mm. \"by\": half the difference between the band's ends.",
                band[0], band[1], band[2], band[3], band[4], band[5], band[6]);
}

enum { CYCLES = 2 * STEPS * SIZES + 1 + 2 * FIGURES };

const SbStudyDesign sb_study_tolerance = {
    .x = SB_LABEL("place in the size's tolerance band"),
    .panel = {SB_QUANTITY("load of the outer seal", "N"), SB_QUANTITY("break-away force", "N"),
              SB_QUANTITY("return margin", "N")},
    .row_heading = SB_LABEL("figure"),
    .column = {SB_QUANTITY("nominal", "N"), SB_QUANTITY("worst case, minimum", "N"),
               SB_QUANTITY("worst case, maximum", "N"),
               SB_QUANTITY("root sum square, minimum", "N"),
               SB_QUANTITY("root sum square, maximum", "N"), SB_QUANTITY("by d, outer", "N"),
               SB_QUANTITY("by d, inner", "N"), SB_QUANTITY("by ID, outer", "N"),
               SB_QUANTITY("by ID, inner", "N"), SB_QUANTITY("by g", "N"),
               SB_QUANTITY("by bore", "N"), SB_QUANTITY("by stem", "N")},
    .validity = "worst case: where every figure rises or falls with every size; root sum of "
                "squares: independent sizes, linear",
    .grid = true,
    .share = SHARE,
    .forces = true,
    .derive = derive,
    .make = make,
};
