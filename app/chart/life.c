// The panels of a study (study.h) filled from a run's life. Of a long life at most SB_STUDY_POINTS
// actuations are drawn, evenly spaced with the first and the last; every one is in life.csv.
#include "app/chart/life.h"
#include "app/chart/study.h"

#include <glib.h>
#include <math.h>
#include <string.h>

static SbStudySeries *add_series(SbStudyPanel *panel, const char *name, SbStudyStyle style) {
  SbStudySeries *series = &panel->series[panel->series_count++];
  g_strlcpy(series->name, name, sizeof series->name);
  series->style = style;
  return series;
}

static void put(SbStudySeries *series, double x, double y) {
  series->x[series->count] = x;
  series->y[series->count++] = y;
}

static SbStudyPanel *add_panel(SbStudy *study, const char *quantity, const char *si,
                               const char *unit) {
  SbStudyPanel *panel = &study->panel[study->panel_count++];
  g_strlcpy(panel->y.quantity, quantity, sizeof panel->y.quantity);
  g_strlcpy(panel->y.si, si, sizeof panel->y.si);
  g_strlcpy(panel->y.unit, unit, sizeof panel->y.unit);
  return panel;
}

static void fill(SbStudy *study, const SbChartRun *run) {
  g_strlcpy(study->x.quantity, "actuation", sizeof study->x.quantity);
  g_strlcpy(study->x.si, "1", sizeof study->x.si);
  SbStudyPanel *force = add_panel(study, "force", "N", "N");
  SbStudyPanel *film = add_panel(study, "over the given roughness", "1", "");
  SbStudyPanel *leak = add_panel(study, "leakage, summed", "m3", "nl");
  SbStudySeries *breakaway = add_series(force, "break-away", SB_STUDY_CURVE);
  SbStudySeries *back = add_series(force, "least return", SB_STUDY_CURVE);
  SbStudySeries *rough = add_series(film, "roughness", SB_STUDY_CURVE);
  SbStudySeries *lambda = add_series(film, "λ against the first", SB_STUDY_CURVE);
  SbStudySeries *carried = add_series(leak, "carried out", SB_STUDY_CURVE);
  SbStudySeries *net = add_series(leak, "net", SB_STUDY_CURVE);
  double sum[2] = {0, 0};
  size_t points = MIN(run->life_count, SB_STUDY_POINTS), drawn = 0;
  for (size_t i = 0; i < run->life_count; i++) {
    const SbLifeActuation *one = &run->life[i];
    sum[0] += one->carried;
    sum[1] += one->leakage;
    size_t wanted = points > 1 ? drawn * (run->life_count - 1) / (points - 1) : 0;
    if (i != wanted) {
      continue;
    }
    drawn++;
    double n = (double)i + 1;
    put(breakaway, n, one->force_breakaway);
    put(back, n, one->force_return);
    put(rough, n, one->roughness);
    put(lambda, n, run->life[0].lambda > 0 ? one->lambda / run->life[0].lambda : NAN);
    put(carried, n, sum[0]);
    put(net, n, sum[1]);
  }
  study->complete = true;
}

void sb_life_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data) {
  SbStudy *study = g_new0(SbStudy, 1);
  if (data->run.life_count > 0) {
    fill(study, &data->run);
    sb_study_draw(cr, rect, theme, study);
  }
  g_free(study);
}
