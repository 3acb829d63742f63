// Names of the curves of a study's panel, at their ends or in the gutter; see study.c.
#include "app/chart/study_private.h"

#include "app/base/translation.h"

#include <glib.h>
#include <string.h>

typedef struct {
  const SbStudySeries *series;
  SbPoint end;
} Name;

static int by_height(const void *a, const void *b) {
  double d = ((const Name *)a)->end.y - ((const Name *)b)->end.y;
  return d < 0 ? -1 : d > 0;
}

static void draw_gutter(SbStudyPlot *plot, Name *name, int count, double width) {
  SbCanvas *c = plot->canvas;
  SbRect r = plot->at.plot;
  SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_INK);
  double y[SB_STUDY_SERIES];
  qsort(name, (size_t)count, sizeof *name, by_height);
  for (int i = 0; i < count; i++) {
    y[i] = name[i].end.y;
  }
  sb_labels_spread(y, count, 14, r.y - 4, r.y + r.height);
  double x = r.x + r.width + 20;
  for (int i = 0; i < count; i++) {
    SbStroke look = sb_study_series_look(plot->study, name[i].series);
    sb_canvas_line(c, (SbStroke){look.role, 1, look.dash}, name[i].end.x + 4, name[i].end.y, x - 4,
                   y[i]);
    g_autofree char *shown = sb_translation_of_case(name[i].series->name);
    sb_canvas_text_fit_ends(c, shown, &style, x, y[i] + 4.3, width - 22);
  }
}

int sb_study_name_series(SbStudyPlot *plot, SbPoint **points, double gutter) {
  SbCanvas *c = plot->canvas;
  SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_INK);
  Name name[SB_STUDY_SERIES];
  int count = 0, named = 0;
  double far = plot->at.plot.x + 0.86 * plot->at.plot.width;
  for (size_t s = 0; s < plot->panel->series_count; s++) {
    const SbStudySeries *series = &plot->panel->series[s];
    size_t last = series->count;
    while (last > 0 && !sb_study_inside(plot, points[s][last - 1])) {
      last--;
    }
    if (last == 0) {
      continue;
    }
    named++;
    SbPoint end = points[s][last - 1];
    if (end.x >= far && gutter > 0) {
      name[count++] = (Name){series, end};
      continue;
    }
    const SbPlace places[] = {{end.x + 7, end.y + 4, SB_LEFT},   {end.x + 5, end.y - 7, SB_LEFT},
                              {end.x + 5, end.y + 15, SB_LEFT},  {end.x, end.y - 9, SB_MIDDLE},
                              {end.x - 6, end.y - 6, SB_RIGHT},  {end.x - 6, end.y + 14, SB_RIGHT},
                              {end.x + 14, end.y - 20, SB_LEFT}, {end.x + 14, end.y + 28, SB_LEFT},
                              {end.x, end.y - 22, SB_RIGHT},     {end.x, end.y + 30, SB_RIGHT}};
    g_autofree char *shown = sb_translation_of_case(series->name);
    sb_labels_put(plot->labels, c, shown, &style, places, G_N_ELEMENTS(places));
  }
  if (count > 0) {
    draw_gutter(plot, name, count, gutter);
  }
  return named;
}
