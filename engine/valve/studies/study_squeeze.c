// Load, peak pressure and width of the contact against the squeeze, by every fit model, compared
// with the finite-strain ring.
//
// The grid is that of assets/studies/squeeze.study; lines in its order. The circumferences of
// closed forms and discs are those of the definitions in contact/fit.h. Lindley, Green and English,
// Hertz and Karaszkiewicz do not include stretch. A second ring without stretch (its inner diameter
// is the floor's) shows how much of the difference this is: a ring stretched by 15 % flattens and
// has no contact at all below about 7 % of squeeze.
#include "engine/valve/studies/study_private.h"

#include <math.h>

enum { RING, RING_UNSTRETCHED, DISC, DISC_THESIS, LINDLEY, GREEN, HERTZ, KARASZKIEWICZ, MODELS };
enum { CONTACT = 3 }; // load, peak, width

static const struct {
  const char *name;
  SbStudyStyle style;
  int points; // over the range
} models[MODELS] = {
    [RING] = {SB_LABEL("ring"), SB_STUDY_CURVE, SB_SQUEEZE_RING_POINTS},
    [RING_UNSTRETCHED] = {SB_LABEL("ring, not stretched"), SB_STUDY_CURVE, SB_SQUEEZE_RING_POINTS},
    [DISC] = {SB_LABEL("disc"), SB_STUDY_CURVE, SB_SQUEEZE_DISC_POINTS},
    [DISC_THESIS] = {"disc-thesis", SB_STUDY_CURVE, SB_SQUEEZE_DISC_POINTS},
    [LINDLEY] = {"Lindley", SB_STUDY_REFERENCE, 77},
    [GREEN] = {"Green & English", SB_STUDY_REFERENCE, 77},
    [HERTZ] = {"Hertz", SB_STUDY_REFERENCE, 77},
    [KARASZKIEWICZ] = {"Karaszkiewicz", SB_STUDY_REFERENCE, 77},
};

// Squeezes of the table in addition to the design's own.
enum { TABLE = SB_SQUEEZE_TABLE };
static const double table_squeeze[TABLE] = {0.10, 0.20, 0.30, 0.40};

static double against_ring(SbStudyWork *work, int line, double squeeze, int quantity) {
  const double value = sb_study_at(work, line, squeeze)[quantity];
  const double ring = sb_study_at(work, RING, squeeze)[quantity];
  return ring > 0 ? value / ring - 1 : NAN;
}

static void make(SbStudyWork *work) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  const double design = model->seal[SB_OUTER].squeeze;
  sb_study_mark(work, design, SB_LABEL("as designed") ", %.1f %%", 100 * design);
  sb_text(out->row_heading, sizeof out->row_heading, SB_LABEL("as designed") ", %.1f %%",
          100 * design);
  for (int m = 0; m < MODELS; m++) {
    sb_study_curves(work, models[m].style, models[m].name, m, NULL, models[m].points);
    double *value = sb_study_row(out, "%s", models[m].name)->value;
    for (int q = 0; q < CONTACT; q++) {
      value[2 * q] = sb_study_at(work, m, design)[q];
      value[2 * q + 1] = against_ring(work, m, design, q);
    }
    for (int k = 0; k < TABLE; k++) {
      value[2 * CONTACT + k] = against_ring(work, m, table_squeeze[k], 0);
    }
  }
  sb_study_note(out,
                "No pressure, walls or friction. The bore moves, the groove floor stays: the "
                "stretch is the scene's (%.1f %% inner).",
                100 * model->seal[SB_OUTER].stretch_inner);
  sb_study_note(out,
                "The closed forms do not include stretch; compare them with the ring that is not "
                "stretched too.");
}

const SbStudyDesign sb_study_squeeze = {
    .x = SB_QUANTITY("squeeze of the free section", "%"),
    .panel = {SB_QUANTITY("load", "N"), SB_QUANTITY("peak pressure", "MPa"),
              SB_QUANTITY("contact width", "mm")},
    .range = offsetof(SbStudyRange, squeeze_min),
    .column = {SB_QUANTITY("load", "N"), SB_QUANTITY("load against ring", "%"),
               SB_QUANTITY("peak", "MPa"), SB_QUANTITY("peak against ring", "%"),
               SB_QUANTITY("width", "mm"), SB_QUANTITY("width against ring", "%"),
               SB_QUANTITY("load against ring at 10 %", "%"),
               SB_QUANTITY("load against ring at 20 %", "%"),
               SB_QUANTITY("load against ring at 30 %", "%"),
               SB_QUANTITY("load against ring at 40 %", "%")},
    .difference =
        {[1] = true, [3] = true, [5] = true, [6] = true, [7] = true, [8] = true, [9] = true},
    .models = "ring, disc, disc-thesis, Lindley (eq. 2.8, 2.10), Green & English (radial), Hertz, "
              "Karaszkiewicz",
    .validity = "Lindley to 25 %, Green & English to 32 %, Karaszkiewicz 7 to 25 %, discs: linear "
                "strain, an estimate beyond 10 %; ring: neo-Hookean",
    .grid = true,
    .make = make,
};
