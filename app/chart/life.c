// The panels of a study (study.h) filled from a run's life. Of a long life at most SB_STUDY_POINTS
// actuations are drawn, evenly spaced with the first and the last; every one is in life.csv.
#include "app/chart/life.h"
#include "app/chart/study.h"
#include "engine/base/label.h"

#include <glib.h>
#include <math.h>

static void fill(SbStudy *study, const SbChartRun *run) {
  study->x = (SbStudyAxis){SB_LABEL("actuation"), "1", "", false};
  SbStudyPanel *force =
      sb_study_panel(study, &(SbStudyAxis){SB_LABEL("force"), "N", "N", false}, "");
  SbStudyPanel *film = sb_study_panel(
      study, &(SbStudyAxis){SB_LABEL("over the given roughness"), "1", "", false}, "");
  SbStudyPanel *leak =
      sb_study_panel(study, &(SbStudyAxis){SB_LABEL("leakage, summed"), "m3", "nl", false}, "");
  SbStudySeries *breakaway = sb_study_series(force, SB_STUDY_CURVE, SB_LABEL("break-away"));
  SbStudySeries *back = sb_study_series(force, SB_STUDY_CURVE, SB_LABEL("return, sliding"));
  SbStudySeries *rough = sb_study_series(film, SB_STUDY_CURVE, SB_LABEL("roughness"));
  SbStudySeries *lambda = sb_study_series(film, SB_STUDY_CURVE, SB_LABEL("λ against the first"));
  SbStudySeries *carried = sb_study_series(leak, SB_STUDY_CURVE, SB_LABEL("carried out"));
  SbStudySeries *net = sb_study_series(leak, SB_STUDY_CURVE, SB_LABEL("net"));
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
    sb_study_point(breakaway, n, one->force_breakaway);
    sb_study_point(back, n, one->force_return);
    sb_study_point(rough, n, one->roughness);
    sb_study_point(lambda, n, run->life[0].lambda > 0 ? one->lambda / run->life[0].lambda : NAN);
    sb_study_point(carried, n, sum[0]);
    sb_study_point(net, n, sum[1]);
  }
  study->complete = true;
}

void sb_life_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data) {
  g_autofree SbStudy *study = g_new0(SbStudy, 1);
  if (data->run.life_count > 0) {
    fill(study, &data->run);
    sb_study_draw(cr, rect, theme, study);
  }
}
