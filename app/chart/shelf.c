// The panels of a study (study.h) filled from a run's shelf.
#include "app/chart/shelf.h"

#include "app/chart/study.h"
#include "engine/base/label.h"
#include "engine/valve/figures/figures.h"

#include <glib.h>
#include <math.h>

static const double YEAR = 365 * 86400.0;

// Propellant lost by all paths that there are.
static double sum_of(const SbShelf *shelf, size_t i) {
  const double plastic = shelf->point[i].plastic;
  return shelf->point[i].permeated + shelf->point[i].passed + (isnan(plastic) ? 0 : plastic);
}

// Curves over time of the three ways out.
static void fill_losses(SbStudy *study, const SbShelf *shelf) {
  SbStudyPanel *sums =
      sb_study_panel(study, &(SbStudyAxis){SB_LABEL("lost, summed"), "kg", "mg", false},
                     SB_LABEL("the loss is not known"));
  SbStudyPanel *rates =
      sb_study_panel(study, &(SbStudyAxis){SB_LABEL("lost a year"), "kg", "mg", false},
                     SB_LABEL("the loss is not known"));
  SbStudySeries *all = sb_study_series(sums, SB_STUDY_CURVE, SB_LABEL("all paths"));
  SbStudySeries *rubber = sb_study_series(sums, SB_STUDY_CURVE, SB_LABEL("through the rubber"));
  SbStudySeries *contact = sb_study_series(sums, SB_STUDY_CURVE, SB_LABEL("along the contact"));
  SbStudySeries *plastic = sb_study_series(sums, SB_STUDY_CURVE, SB_LABEL("through the plastic"));
  SbStudySeries *rate = sb_study_series(rates, SB_STUDY_CURVE, SB_LABEL("all paths"));
  double before = 0;
  for (size_t i = 0; i < shelf->points; i++) {
    const double time = shelf->point[i].time;
    const double sum = sum_of(shelf, i);
    sb_study_point(all, time, sum);
    sb_study_point(rubber, time, shelf->point[i].permeated);
    sb_study_point(contact, time, shelf->point[i].passed);
    if (!isnan(shelf->point[i].plastic)) {
      sb_study_point(plastic, time, shelf->point[i].plastic);
    }
    if (i > 0) {
      const double step = time - shelf->point[i - 1].time;
      sb_study_point(rate, time - step / 2, (sum - before) / step * YEAR);
    }
    before = sum;
  }
}

static void fill_rest(SbStudy *study, const SbShelf *shelf) {
  SbStudyPanel *water =
      sb_study_panel(study, &(SbStudyAxis){SB_LABEL("water absorbed"), "kg", "mg", false},
                     SB_LABEL("the water is not known"));
  SbStudyPanel *left = sb_study_panel(study, &(SbStudyAxis){SB_LABEL("doses left"), "1", "", false},
                                      SB_LABEL("the loss is not known"));
  SbStudySeries *moisture = sb_study_series(water, SB_STUDY_CURVE, SB_LABEL("water"));
  SbStudySeries *doses = sb_study_series(left, SB_STUDY_CURVE, SB_LABEL("doses"));
  for (size_t i = 0; i < shelf->points; i++) {
    sb_study_point(moisture, shelf->point[i].time, shelf->point[i].moisture);
    if (!isnan(shelf->point[i].permeated + shelf->point[i].passed)) {
      sb_study_point(doses, shelf->point[i].time, shelf->point[i].doses);
    }
  }
}

// The paths side by side: a year as the valve is now, all of the time, shares of that.
static void fill_table(SbStudy *study, const SbShelf *shelf) {
  static const char *const names[] = {SB_LABEL("rubber"), SB_LABEL("contact"), SB_LABEL("plastic"),
                                      SB_LABEL("sum")};
  const size_t last = shelf->points - 1;
  const double rubber = shelf->permeation - (isnan(shelf->plastic) ? 0 : shelf->plastic);
  const double year[] = {YEAR * rubber, YEAR * shelf->interface, YEAR * shelf->plastic,
                         shelf->loss_per_year};
  const double time[] = {shelf->point[last].permeated, shelf->point[last].passed,
                         shelf->point[last].plastic, shelf->loss};
  static const struct {
    const char *name, *si, *unit;
  } rows[] = {{SB_LABEL("lost a year, as the valve is now"), "kg", "mg"},
              {SB_LABEL("lost over the shelf time"), "kg", "mg"},
              {SB_LABEL("fraction of the loss"), "1", "%"}};
  g_strlcpy(study->row_heading, SB_LABEL("path"), sizeof study->row_heading);
  study->column_count = G_N_ELEMENTS(names);
  study->row_count = G_N_ELEMENTS(rows);
  for (size_t r = 0; r < G_N_ELEMENTS(rows); r++) {
    SbStudyRow *row = &study->row[r];
    g_strlcpy(row->name, rows[r].name, sizeof row->name);
    g_strlcpy(row->si, rows[r].si, sizeof row->si);
    g_strlcpy(row->unit, rows[r].unit, sizeof row->unit);
    for (size_t c = 0; c < G_N_ELEMENTS(names); c++) {
      row->value[c] = r == 0 ? year[c] : r == 1 ? time[c] : time[c] / shelf->loss;
    }
  }
  for (size_t c = 0; c < G_N_ELEMENTS(names); c++) {
    g_strlcpy(study->column[c].name, names[c], sizeof study->column[c].name);
    g_strlcpy(study->column[c].si, "kg", sizeof study->column[c].si);
    g_strlcpy(study->column[c].unit, "mg", sizeof study->column[c].unit);
    study->column[c].digits = 4;
  }
}

static void add_note(SbStudy *study, const char *text) {
  if (study->note_count < SB_STUDY_NOTES) {
    g_strlcpy(study->note[study->note_count++], text, sizeof study->note[0]);
  }
}

// What stands beside the numbers wherever they are: above all that a rubber's are typical ones.
static void fill_notes(SbStudy *study, const SbSummary *summary) {
  static const char *const told[] = {"shelf-typical", "shelf-slab"};
  for (size_t i = 0; i < summary->warnings.count; i++) {
    const SbWarning *warning = &summary->warnings.item[i];
    for (size_t k = 0; k < G_N_ELEMENTS(told); k++) {
      if (g_str_equal(warning->code, told[k])) {
        add_note(study, warning->text);
      }
    }
  }
  if (isnan(summary->shelf.loss_per_year)) {
    add_note(study, sb_figure_reason(summary, sb_figure_find("shelf.loss_kg_per_year")));
  }
  if (isnan(summary->shelf.moisture_per_year)) {
    add_note(study, sb_figure_reason(summary, sb_figure_find("shelf.moisture_kg_per_year")));
  }
}

void sb_shelf_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data) {
  const SbSummary *summary = data->run.summary;
  if (summary == NULL || summary->shelf.points == 0) {
    return;
  }
  g_autofree SbStudy *study = g_new0(SbStudy, 1);
  study->x = (SbStudyAxis){SB_LABEL("time on the shelf"), "s", SB_LABEL("month"), false};
  fill_losses(study, &summary->shelf);
  fill_rest(study, &summary->shelf);
  fill_table(study, &summary->shelf);
  fill_notes(study, summary);
  study->complete = true;
  sb_study_draw(cr, rect, theme, study);
}
