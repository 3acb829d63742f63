// Thesis, linear disc and finite-strain ring side by side: load, peak and width at the thesis'
// pressures, what the sizes d and ID do to them, and the coefficient of friction that each width
// and load gives.
//
// Cases: pressure 0, 0.13, 0.29, 0.55 and 0.7 MPa on the outer seal, and d and ID by 0.02 mm up and
// down at the canister's pressure (thesis tables 7.2 to 7.4 and 7.9). Sensitivity: half the
// difference between up and down. Printed values are shown where the scene's ring and gland are the
// thesis'; the two loads of table 7.9 from its W* = F/(pi 4.64 mm)/(E' R).
//
// Coefficient of friction. Table 7.8's predicted 0.4 (0.388 by its own figures) is the share of the
// shear strength alone at rest, tau_0 pi^2 (zeta beta sigma)^2 F_2(0) A / F with A = width x pi D
// and F the load (docs/thesis.md): "by shear strength". With the load coefficient m on
// the total load, which the 5 N and 8 N of the cycle need, it is larger by m: "with m". Measured:
// 0.51.
#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/numeric/root.h"
#include "engine/valve/figures/figures.h"
#include "engine/valve/studies/study_private.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { THESIS, DISC_THESIS, DISC, RING, KARASZKIEWICZ, MODELS, TABLE_MODELS = 4 };
enum { CONTACT = 3 }; // load, peak, width

static const struct {
  const char *name;
  SbStudyStyle style;
} models[MODELS] = {
    [THESIS] = {SB_LABEL("thesis, printed"), SB_STUDY_DOTS},
    [DISC_THESIS] = {"disc-thesis", SB_STUDY_CURVE},
    [DISC] = {SB_LABEL("disc"), SB_STUDY_CURVE},
    [RING] = {SB_LABEL("ring"), SB_STUDY_CURVE},
    [KARASZKIEWICZ] = {"Karaszkiewicz", SB_STUDY_REFERENCE},
};

enum { PRESSURES = SB_MODELS_PRESSURES, SIZES = SB_MODELS_SIZES };
static const double pressures[PRESSURES] = {0, 0.13e6, 0.29e6, 0.55e6, 0.7e6};

#define STEP 0.02e-3 // of d and ID [m]

// Sizes that each model is solved with; a line is a model with one of them.
static const struct {
  double section, inner;
} sizes[SIZES] = {{0, 0}, {STEP, 0}, {-STEP, 0}, {0, STEP}, {0, -STEP}};

static int line_of(int model, int size) {
  return 100 + size * MODELS + model; // behind those of the grid
}

// Printed "current analysis": tables 7.2, 7.3, 7.4; the loads at 0.13 and 0.7 MPa from W* of 7.9.
// Load, peak and width at the pressures, then with the other sizes at 0.55 MPa.
#define WSTAR_LOAD(w) ((w)*6.5725e6 * 0.805e-3 * M_PI * 4.64e-3)

static const struct {
  int size;
  double pressure, contact[CONTACT];
} printed[] = {
    {0, 0, {4.371, 637195.3, 0.5900e-3}},        {0, 0.13e6, {WSTAR_LOAD(0.07981), NAN, NAN}},
    {0, 0.29e6, {8.469, 942625.8, 0.7682e-3}},   {0, 0.55e6, {12.395, 1197543.7, 0.8886e-3}},
    {0, 0.7e6, {WSTAR_LOAD(0.19055), NAN, NAN}}, {1, 0.55e6, {13.181, 1230639.8, 0.8996e-3}},
    {2, 0.55e6, {11.611, 1163127.0, 0.8543e-3}}, {3, 0.55e6, {12.520, 1205035.1, 0.8886e-3}},
    {4, 0.55e6, {12.271, 1189737.8, 0.8886e-3}},
};

static bool near(double a, double b) {
  return fabs(a - b) <= 1e-6 * fabs(b);
}

// The scene's outer ring and gland are those of the thesis' tables.
static bool is_thesis(const SbModel *model) {
  const SbSealModel *seal = &model->seal[SB_OUTER];
  return near(seal->section_diameter, 1.61e-3) && near(seal->inner_diameter, 2.84e-3) &&
         near(seal->modulus, 2.5e6) && near(seal->poisson_ratio, 0.49) &&
         near(model->radial_space, 1.36e-3) && near(model->bore_diameter, 6e-3);
}

// Returns the friction that the shear strength alone gives at rest, divided by the load.
static double coefficient(const SbModel *model, double load, double width) {
  const SbRoughSurface surface = sb_model_surface(model, SB_OUTER, 1);
  double area = width * model->bore_circumference * sb_rough_area_share(&surface, 0);
  return load > 0 ? model->shear_strength * area / load : NAN;
}

// A line of assets/studies/models.study under the number that it has here.
static void derive(double *value, SbStudyWork *work, int line, double pressure) {
  enum { GRID = MODELS - 1, SOLVED = GRID - 1 }; // without what is printed, and Karaszkiewicz
  value[CONTACT] = coefficient(work->scene, value[0], value[2]);
  const int rest = line - GRID, of = rest % (2 * SOLVED);
  const int own = line < GRID ? line_of(DISC_THESIS + line, 0)
                              : line_of(DISC_THESIS + of / 2, 1 + rest / (2 * SOLVED) * 2 + of % 2);
  memcpy(sb_study_put(work, own, pressure), value, (CONTACT + 1) * sizeof *value);
}

static void put_printed(SbStudyWork *work) {
  for (size_t r = 0; r < sizeof printed / sizeof printed[0] && is_thesis(work->scene); r++) {
    double *value = sb_study_put(work, line_of(THESIS, printed[r].size), printed[r].pressure);
    memcpy(value, printed[r].contact, sizeof printed[r].contact);
    value[CONTACT] = coefficient(work->scene, value[0], value[2]);
  }
}

// Columns of the table.
enum { LOAD_DISC = 2, LOAD_RING = 3 };

// Contacts with a size, or half their difference from those with another (`less` > 0).
static void fill_row(double *value, SbStudyWork *work, int size, int less, double pressure) {
  double other[SB_STUDY_COLUMNS];
  sb_study_cells(value, work, pressure, line_of(0, size));
  sb_study_cells(other, work, pressure, line_of(0, less));
  const double disc = value[LOAD_DISC], ring = value[LOAD_RING];
  if (less == 0 && isfinite(disc) && isfinite(ring) && (disc > 0) != (ring > 0)) {
    sb_warn(&work->out->warnings, "disc-ring-contact", SB_CONTACT_IN_MODEL,
            "at %.3g MPa the linear disc %s and the solved ring %s: the ring counts",
            1e-6 * pressure, disc > 0 ? "touches" : "does not touch",
            ring > 0 ? "touches" : "does not");
  }
  for (size_t k = 0; less > 0 && k < work->out->column_count; k++) {
    value[k] = (value[k] - other[k]) / 2;
  }
}

static void put_table(SbStudyWork *work) {
  const SbModel *model = work->scene;
  const SbSealModel *ring = &model->seal[SB_OUTER];
  const double canister = model->canister_pressure;
  for (int p = 0; p < PRESSURES; p++) {
    double *value = sb_study_row(work->out, "%.2f MPa", pressures[p] * 1e-6)->value;
    fill_row(value, work, 0, 0, pressures[p]);
  }
  for (int size = 1; size < SIZES; size++) {
    bool section = sizes[size].section != 0;
    double diameter = section ? ring->section_diameter + sizes[size].section
                              : ring->inner_diameter + sizes[size].inner;
    fill_row(sb_study_row(work->out, "%s %.2f mm", section ? "d" : "ID", 1e3 * diameter)->value,
             work, size, 0, canister);
  }
  fill_row(sb_study_row(work->out, "for d + 0.02 mm")->value, work, 1, 2, canister);
  fill_row(sb_study_row(work->out, "for ID + 0.02 mm")->value, work, 3, 4, canister);
  SbStudyRow *area = sb_study_row(work->out, SB_LABEL("friction by shear strength"));
  SbStudyRow *both = sb_study_row(work->out, SB_LABEL("friction with m"));
  sb_text(area->si, sizeof area->si, "1");
  sb_text(both->si, sizeof both->si, "1");
  for (int m = 0; m < TABLE_MODELS; m++) {
    area->value[m] = sb_study_at(work, line_of(m, 0), canister)[3];
    both->value[m] = area->value[m] + model->load_coefficient;
  }
}

static void make(SbStudyWork *work) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  put_printed(work);
  work->lo = pressures[0];
  work->hi = pressures[PRESSURES - 1];
  for (int m = 0; m < MODELS; m++) {
    sb_study_curves(work, models[m].style, models[m].name, line_of(m, 0), pressures, PRESSURES);
  }
  sb_study_level(work, &out->panel[3], "measured 0.51", 0.51);
  sb_study_level(work, &out->panel[3], "table 7.8: 0.4", 0.4);
  sb_study_mark(work, model->canister_pressure, SB_LABEL("canister"));
  put_table(work);
  sb_message(out->models, sizeof out->models, "disc-thesis, disc, ring, Karaszkiewicz%s",
             is_thesis(model) ? "; printed: thesis tables 7.2 to 7.4, 7.8, 7.9" : "");
  sb_study_note(out,
                "Friction by shear strength: real area at rest x shear strength over the "
                "load, as table 7.8; with m: the load coefficient %.3g added.",
                model->load_coefficient);
  if (!is_thesis(model)) {
    sb_study_note(out, "Ring and gland are not the thesis': its printed values are left out.");
  }
}

// Returns the ordinate of a curve at x, linear between its points; NaN beyond them.
static double ordinate(const SbStudySeries *curve, double x) {
  if (curve->count < 2 || x < curve->x[0] || x > curve->x[curve->count - 1]) {
    return NAN;
  }
  const size_t i = sb_interval(curve->x, curve->count, x);
  const double f = (x - curve->x[i]) / (curve->x[i + 1] - curve->x[i]);
  return (1 - f) * curve->y[i] + f * curve->y[i + 1];
}

void sb_study_spread(double spread[SB_FIGURE_COUNT], const SbStudy *study, const SbModel *model) {
  static const char *const panels[CONTACT] = {"load_N", "pressure_peak_Pa", "contact_width_m"};
  for (size_t i = 0; study->kind == SB_STUDY_MODELS && i < CONTACT && i < study->panel_count; i++) {
    double low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < study->panel[i].series_count; k++) {
      const SbStudySeries *curve = &study->panel[i].series[k];
      if (curve->style != SB_STUDY_DOTS) { // what is printed was not computed
        const double y = ordinate(curve, model->canister_pressure);
        low = fmin(low, y);
        high = fmax(high, y);
      }
    }
    char path[64];
    snprintf(path, sizeof path, "seals.outer.%s", panels[i]);
    double *of = &spread[sb_figure_find(path)];
    *of = fmax(*of, high - low);
  }
}

const SbStudyDesign sb_study_models = {
    .x = SB_QUANTITY("pressure on the outer seal", "MPa"),
    .panel = {SB_QUANTITY("load", "N"), SB_QUANTITY("peak pressure", "MPa"),
              SB_QUANTITY("contact width", "mm"),
              SB_LABEL("friction coefficient by shear strength")},
    .row_heading = SB_LABEL("case"),
    .column = {SB_QUANTITY("load thesis", "N"), "load disc-thesis [N]",
               SB_QUANTITY("load disc", "N"), SB_QUANTITY("load ring", "N"),
               SB_QUANTITY("peak thesis", "MPa"), "peak disc-thesis [MPa]",
               SB_QUANTITY("peak disc", "MPa"), SB_QUANTITY("peak ring", "MPa"),
               SB_QUANTITY("width thesis", "mm"), "width disc-thesis [mm]",
               SB_QUANTITY("width disc", "mm"), SB_QUANTITY("width ring", "mm")},
    .line = {THESIS, DISC_THESIS, DISC, RING, THESIS, DISC_THESIS, DISC, RING, THESIS, DISC_THESIS,
             DISC, RING},
    .value = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2},
    .validity = "disc-thesis: pressure on both flanks; disc: linear strain; ring: neo-Hookean, "
                "pressure from the canister against the groove wall",
    .grid = true,
    .derive = derive,
    .make = make,
};
