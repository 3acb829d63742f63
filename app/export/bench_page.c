// The bench's page: the true error of every solver that has a mesh to pay for, over the time of one
// solve; below it every case with its unknowns, iterations, own error estimate and observed order.
// It is laid out and drawn as a study is (app/chart/study.h). Leaves out closed forms from the
// panel: they have no error to buy.
#include "app/export/bench_page.h"

#include "app/chart/page.h"
#include "app/chart/study.h"
#include "app/export/still.h"

#include <glib.h>
#include <math.h>
#include <string.h>

// One solver's true errors over the time of a solve.
static void add_series(SbStudyPanel *panel, const char *solver, const SbBenchCase *cases,
                       size_t count) {
  SbStudySeries *series = sb_study_series(panel, SB_STUDY_DOTS, solver);
  for (size_t i = 0; i < count && series->count < SB_STUDY_POINTS; i++) {
    if (strcmp(cases[i].solver, solver) == 0 && isfinite(cases[i].error_estimate)) {
      sb_study_point(series, cases[i].wall_s, cases[i].error);
    }
  }
}

static void add_table(SbStudy *study, const SbBenchCase *cases, size_t count) {
  static const SbStudyColumn columns[] = {
      {"unknowns", "1", "", 0, false}, {"iterations", "1", "", 0, false},
      {"time", "s", "ms", 3, false},   {"error", "1", "", 2, false},
      {"estimate", "1", "", 2, false}, {"observed order", "1", "", 2, false}};
  g_strlcpy(study->row_heading, "solver and case", sizeof study->row_heading);
  study->column_count = G_N_ELEMENTS(columns);
  memcpy(study->column, columns, sizeof columns);
  for (size_t i = 0; i < MIN(count, (size_t)SB_STUDY_ROWS); i++) {
    const SbBenchCase *c = &cases[i];
    SbStudyRow *row = &study->row[study->row_count++];
    g_snprintf(row->name, sizeof row->name, "%s, %s", c->solver, c->name);
    const double value[] = {c->unknowns > 0 ? (double)c->unknowns : NAN,
                            c->iterations > 0 ? (double)c->iterations : NAN,
                            c->wall_s,
                            c->error,
                            c->error_estimate,
                            c->order};
    memcpy(row->value, value, sizeof value);
  }
}

static void draw(cairo_t *cr, double width, double height, void *user) {
  const SbStudy *study = user;
  const SbTheme *theme = sb_theme(false);
  SbPage page = sb_page_begin(cr, (SbRect){0, 0, width, height}, width, height, theme);
  SbChartData data = {.title = "Error against time",
                      .subtitle = "cold solves on one core, median of the repeats"};
  data.run.state = SB_CHART_DONE;
  sb_page_header_draw(cr, page.whole, theme, &data, SB_CHART_WHOLE);
  sb_study_draw(cr, page.body, theme, study);
  char version[64];
  g_snprintf(version, sizeof version, "Sealbench %s", sb_version());
  SbPageFoot foot = {
      "reynolds, disc, ring; the cases and their known answers: engine/valve/answer/bench.c",
      "relative, maximum over the figures of a case", version, NULL};
  sb_page_foot_draw(cr, page.whole, theme, &foot);
  cairo_restore(cr);
}

bool sb_bench_put(FILE *stream, const SbBenchCase *cases, size_t count, GError **error) {
  g_autofree SbStudy *study = g_new0(SbStudy, 1);
  study->x = (SbStudyAxis){"time of one solve", "s", "ms", true};
  SbStudyPanel *panel =
      sb_study_panel(study, &(SbStudyAxis){"relative error", "1", "", true}, "no case finished");
  add_series(panel, "reynolds", cases, count);
  add_series(panel, "disc", cases, count);
  add_series(panel, "ring", cases, count);
  add_table(study, cases, count);
  SbStill still = {.width = 1280,
                   .title = "Bench",
                   .comment = "Error against time for every solver",
                   .draw = draw,
                   .user = study};
  // Panel and table share the page about evenly (sb_study_layout).
  still.height = SB_PAGE_HEADER + 1.9 * sb_study_table_height(study) + SB_PAGE_FOOTER + 24;
  return sb_still_put(stream, &still, ".png", error);
}
