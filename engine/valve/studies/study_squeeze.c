// Load, peak pressure and width of the contact over the squeeze, by every fitment model beside the
// finite-strain ring.
//
// The bore moves and the groove floor stays, D = D_floor + 2 g with g = d (1 - s): the stretch on
// the floor stays as it is and the squeeze alone changes. No pressure, no walls, no friction. The
// closed forms and the discs' circumferences are those of the definitions in elastic/fit.h.
// Lindley, Green and English, Hertz and Karaszkiewicz know no stretch, so a second ring without
// stretch (its inner diameter the floor's) shows how much of a difference that is: a ring stretched
// by 15 % flattens and does not touch at all below some 7 % of squeeze.
#include "engine/valve/studies/study_private.h"

#include <math.h>

enum { RING, RING_UNSTRETCHED, DISC, DISC_THESIS, LINDLEY, GREEN, HERTZ, KARASZKIEWICZ, MODELS };

static const struct {
  const char *name;
  SbFitModel model;
  SbStudyStyle style;
  int points;     // over the range
  bool stretched; // as the scene stretches it
} models[MODELS] = {
    [RING] = {"ring", SB_FIT_RING, SB_STUDY_CURVE, 20, true},
    [RING_UNSTRETCHED] = {"ring, not stretched", SB_FIT_RING, SB_STUDY_CURVE, 20, false},
    [DISC] = {"disc", SB_FIT_DISC, SB_STUDY_CURVE, 39, true},
    [DISC_THESIS] = {"disc-thesis", SB_FIT_DISC_THESIS, SB_STUDY_CURVE, 39, true},
    [LINDLEY] = {"Lindley", SB_FIT_LINDLEY, SB_STUDY_REFERENCE, 77, true},
    [GREEN] = {"Green & English", SB_FIT_GREEN_ENGLISH, SB_STUDY_REFERENCE, 77, true},
    [HERTZ] = {"Hertz", SB_FIT_HERTZ, SB_STUDY_REFERENCE, 77, true},
    [KARASZKIEWICZ] = {"Karaszkiewicz", SB_FIT_KARASZKIEWICZ, SB_STUDY_REFERENCE, 77, true},
};

// Squeezes of the table beside the design's own.
static const double table_squeeze[] = {0.10, 0.20, 0.30, 0.40};
enum { TABLE = sizeof table_squeeze / sizeof table_squeeze[0] };

double sb_study_squeeze_cost(const SbModel *model) {
  return 2 * (20 + 1 + TABLE) * SB_COST_RING + 2 * (39 + 1 + TABLE) * SB_COST_DISC;
}

// One model at one squeeze.
static SbStudyContact solve(SbStudyWork *work, int index, double squeeze) {
  const SbModel *scene = work->scene;
  double floor = scene->bore_diameter - 2 * scene->radial_space;
  double inner = models[index].stretched ? scene->seal[SB_OUTER].inner_diameter : floor;
  SbOverride override[SB_STUDY_SQUEEZED + 2];
  sb_study_squeezed(override, work, squeeze);
  override[3] = (SbOverride){SB_P_MODELS_FIT, models[index].model};
  override[4] = (SbOverride){SB_P_SEAL_OUTER_INNER_DIAMETER, inner};
  return sb_study_contact(work, override, SB_STUDY_SQUEEZED + 2);
}

static double difference(double value, double ring) {
  return ring > 0 ? value / ring - 1 : NAN;
}

void sb_study_squeeze(SbStudyWork *work) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  const double lo = model->study.squeeze_min, hi = model->study.squeeze_max;
  const double design = model->seal[SB_OUTER].squeeze;
  // The fitment alone, by its own tolerance: no film wants the ring's surface.
  const SbOverride dry[] = {{SB_P_CANISTER_PRESSURE, 0},
                            {SB_P_MODELS_FILM, SB_FILM_THESIS},
                            {SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_BESIDE}};
  sb_study_fix_outer(work);
  sb_study_fix(work, dry, sizeof dry / sizeof dry[0]);
  sb_study_axis(&out->x, "squeeze of the free section", "1", "%", false);
  sb_study_panel(out, "load", "N", "N", false);
  sb_study_panel(out, "peak pressure", "Pa", "MPa", false);
  sb_study_panel(out, "contact width", "m", "mm", false);
  sb_study_mark(out, design, "as designed, %.1f %%", 100 * design);

  SbStudyContact at_design[MODELS], at_table[MODELS][TABLE];
  for (int m = 0; m < MODELS; m++) {
    sb_study_curve(out, models[m].style, models[m].name);
    for (int i = 0; i < models[m].points; i++) {
      double s = lo + (hi - lo) * i / (models[m].points - 1);
      SbStudyContact f = solve(work, m, s);
      sb_study_put(out, s, (const double[]){f.load, f.peak, f.width});
    }
    at_design[m] = solve(work, m, design);
    for (int k = 0; k < TABLE; k++) {
      at_table[m][k] = solve(work, m, table_squeeze[k]);
    }
  }

  sb_text(out->row_heading, sizeof out->row_heading, "as designed, %.1f %%", 100 * design);
  sb_study_column(out, "load", "N", "N");
  sb_study_column(out, "load against ring", "1", "%");
  sb_study_column(out, "peak", "Pa", "MPa");
  sb_study_column(out, "peak against ring", "1", "%");
  sb_study_column(out, "width", "m", "mm");
  sb_study_column(out, "width against ring", "1", "%");
  for (int k = 0; k < TABLE; k++) {
    char name[40];
    sb_text(name, sizeof name, "load against ring at %.0f %%", 100 * table_squeeze[k]);
    sb_study_column(out, name, "1", "%");
  }
  for (int m = 0; m < MODELS; m++) {
    SbStudyRow *row = sb_study_row(out, NULL, NULL, "%s", models[m].name);
    const SbStudyContact *f = &at_design[m], *r = &at_design[RING];
    row->value[0] = f->load;
    row->value[1] = difference(f->load, r->load);
    row->value[2] = f->peak;
    row->value[3] = difference(f->peak, r->peak);
    row->value[4] = f->width;
    row->value[5] = difference(f->width, r->width);
    for (int k = 0; k < TABLE; k++) {
      row->value[6 + k] = difference(at_table[m][k].load, at_table[RING][k].load);
    }
  }
  sb_text(out->models, sizeof out->models,
          "ring, disc, disc-thesis, Lindley (eq. 2.8, 2.10), Green & English (radial), Hertz, "
          "Karaszkiewicz");
  sb_text(out->validity, sizeof out->validity,
          "Lindley to 25 %%, Green & English to 32 %%, Karaszkiewicz 7 to 25 %%, discs: linear "
          "strain, an estimate beyond 10 %%; ring: neo-Hookean");
  sb_study_note(out,
                "No pressure, walls or friction. The bore moves, the groove floor stays: the "
                "stretch is the scene's (%.1f %% inner).",
                100 * model->seal[SB_OUTER].stretch_inner);
  sb_study_note(out, "The closed forms know no stretch; compare them with the ring that is not "
                     "stretched too.");
}
