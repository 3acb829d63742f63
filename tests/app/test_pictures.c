// Golden pictures of the charts in both themes, each with a slightly wrong partner that must be
// caught.
#include "app/chart/dashboard.h"
#include "app/chart/hysteresis.h"
#include "app/chart/page.h"
#include "app/chart/profiles.h"
#include "app/chart/timeline.h"
#include "tests/app/picture.h"
#include "tests/app/synthetic.h"

#include <glib.h>
#include <math.h>
#include <string.h>

typedef void (*Draw)(cairo_t *, SbRect, const SbTheme *, const SbChartData *, unsigned);

static cairo_surface_t *draw_view(Draw draw, const SbChartData *data, int width, int height,
                                  double scale, bool dark, unsigned flags) {
  const SbTheme *theme = sb_theme(dark);
  cairo_surface_t *surface = picture_new(width, height, scale);
  cairo_t *cr = cairo_create(surface);
  SbColor ground = theme->role[SB_ROLE_BACKGROUND];
  cairo_set_source_rgb(cr, ground.r, ground.g, ground.b);
  cairo_paint(cr);
  draw(cr, (SbRect){0, 0, width, height}, theme, data, flags);
  cairo_destroy(cr);
  return surface;
}

static void check_view(Draw draw, const SbChartData *data, const char *name, int width, int height,
                       double scale, bool dark, unsigned flags) {
  cairo_surface_t *surface = draw_view(draw, data, width, height, scale, dark, flags);
  picture_check(surface, name);
  cairo_surface_destroy(surface);
}

static void check_rejected(Draw draw, const SbChartData *data, const char *name, int width,
                           int height, double scale, bool dark, unsigned flags) {
  cairo_surface_t *surface = draw_view(draw, data, width, height, scale, dark, flags);
  g_assert_true(picture_rejects(surface, name));
  cairo_surface_destroy(surface);
}

static Synthetic run, weaker, off;

#define ROUGHNESS                                                                                  \
  "roughness \xe2\x88\x92"                                                                         \
  "30 %"

// A stand-in for the section: two rectangles, so that the page's layout is part of the picture.
static void draw_section(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                         void *user) {
  SbColor housing = theme->role[SB_ROLE_HOUSING], stem = theme->role[SB_ROLE_STEM];
  cairo_set_source_rgb(cr, housing.r, housing.g, housing.b);
  cairo_rectangle(cr, rect.x + 20, rect.y + 40, rect.width - 40, 0.4 * rect.height);
  cairo_fill(cr);
  cairo_set_source_rgb(cr, stem.r, stem.g, stem.b);
  cairo_rectangle(cr, rect.x + 20, rect.y + 0.6 * rect.height, rect.width - 40, 0.3 * rect.height);
  cairo_fill(cr);
}

// A run whose outer profile is `factor` wider in pressure.
static SbContactProfile wrong_profile[2];
static double wrong_pressure[2][201];

static const SbContactProfile *wrong_profiles(const void *source, uint32_t index) {
  return index < 2 ? &wrong_profile[index] : NULL;
}

static SbChartRun run_with_film(const SbChartRun *from, double factor) {
  SbChartRun out = *from;
  for (int i = 0; i < 2; i++) {
    wrong_profile[i] = *from->profile(from->source, (uint32_t)i);
    for (size_t k = 0; k < 201; k++) {
      wrong_pressure[i][k] = wrong_profile[i].pressure[k] * factor;
    }
    wrong_profile[i].pressure = wrong_pressure[i];
  }
  out.profile = wrong_profiles;
  return out;
}

static void pin(SbChartData *data, const SbChartData *pinned) {
  data->pin[0] = (SbChartPin){&pinned->run, ROUGHNESS, 0, pinned->playhead};
  data->pin_count = 1;
}

static void test_hysteresis(void) {
  SbChartData data, wrong;
  synthetic_data(&data, &run, 7.27);
  SbChartData pinned;
  synthetic_data(&pinned, &weaker, 7.27);
  pin(&data, &pinned);
  check_view(sb_hysteresis_draw, &data, "hysteresis", 640, 560, 1, false, SB_CHART_PANEL);
  check_view(sb_hysteresis_draw, &data, "hysteresis-dark", 640, 560, 1, true, SB_CHART_PANEL);
  // A loop whose friction is 1 % too large.
  synthetic_data(&wrong, &off, 7.27);
  pin(&wrong, &pinned);
  check_rejected(sb_hysteresis_draw, &wrong, "hysteresis", 640, 560, 1, false, SB_CHART_PANEL);
  check_rejected(sb_hysteresis_draw, &wrong, "hysteresis-dark", 640, 560, 1, true, SB_CHART_PANEL);
}

static void draw_dashboard(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                           unsigned flags) {
  sb_dashboard_draw(cr, rect, theme, data, flags, draw_section, NULL);
}

static void test_dashboard(void) {
  SbChartData data, pinned, wrong;
  synthetic_data(&data, &run, 7.27);
  synthetic_data(&pinned, &weaker, 7.27);
  pin(&data, &pinned);
  check_view(draw_dashboard, &data, "dashboard", 1920, 1080, 1, false, 0);
  check_view(draw_dashboard, &data, "dashboard-dark", 1920, 1080, 1, true, 0);
  // The playhead three frames further.
  wrong = data;
  wrong.playhead += 3;
  check_rejected(draw_dashboard, &wrong, "dashboard", 1920, 1080, 1, false, 0);
  check_rejected(draw_dashboard, &wrong, "dashboard-dark", 1920, 1080, 1, true, 0);
}

static void test_profiles(void) {
  SbChartData data, wrong;
  synthetic_data(&data, &run, 7.27);
  check_view(sb_profiles_draw, &data, "profiles", 1280, 280, 1, false, SB_CHART_PANEL);
  check_view(sb_profiles_draw, &data, "profiles-dark", 1280, 280, 1, true, SB_CHART_PANEL);
  check_view(sb_profiles_draw, &data, "profiles-window", 400, 460, 1, false, SB_CHART_COMPACT);
  wrong = data;
  SbChartRun thick = run_with_film(&wrong.run, 1.05);
  wrong.run = thick;
  check_rejected(sb_profiles_draw, &wrong, "profiles", 1280, 280, 1, false, SB_CHART_PANEL);
  check_rejected(sb_profiles_draw, &wrong, "profiles-dark", 1280, 280, 1, true, SB_CHART_PANEL);
  check_rejected(sb_profiles_draw, &wrong, "profiles-window", 400, 460, 1, false, SB_CHART_COMPACT);
}

// States that a window meets. What is drawn must differ from the finished picture (nobody may take
// a partial run for a whole one), and nothing may fail.
static void test_states(void) {
  SbChartData done, data;
  synthetic_data(&done, &run, 7.27);
  cairo_surface_t *finished = draw_view(draw_dashboard, &done, 1600, 900, 1, false, 0);

  SbTrace *half_trace = sb_trace_create(run.model);
  size_t half = 3 * run.count / 5;
  sb_trace_extend(half_trace, run.frames, half, 0);
  SbChartRun half_run = done.run;
  half_run.count = half;
  half_run.trace = half_trace;
  half_run.summary = NULL;
  static const SbChartMarker markers[] = {{28.2, "M1"}, {41, "stuck"}};
  for (int state = 0; state < 6; state++) {
    data = done;
    data.run = half_run;
    const char *name = "";
    switch (state) {
    case 0:
      name = "state-empty";
      data.run = (SbChartRun){.state = SB_CHART_EMPTY, .model = run.model};
      break;
    case 1:
      name = "state-running";
      data.run.state = SB_CHART_RUNNING;
      data.progress = 0.6;
      data.earlier = &done.run;
      data.playhead = half - 1;
      break;
    case 2:
      name = "state-partial";
      data.run.state = SB_CHART_PARTIAL;
      data.run.summary = &run.summary;
      break;
    case 3:
      name = "state-failed";
      data.run.state = SB_CHART_FAILED;
      data.run.summary = &run.summary;
      data.failure = "Reynolds did not converge: residual 3e-4 after 40 iterations at 14.7 s "
                     "(fluid.viscosity)";
      break;
    case 4:
      name = "state-stale";
      data.run = done.run;
      data.stale = "shows the last good run, axial width 2.0 mm";
      data.marker = markers;
      data.marker_count = 2;
      break;
    default:
      // A trace that lags behind, and no model, summary or profiles at all.
      name = "state-bare";
      data = (SbChartData){.run = {.state = SB_CHART_RUNNING,
                                   .frames = run.frames,
                                   .count = run.count,
                                   .trace = half_trace}};
      break;
    }
    for (int dark = 0; dark < 2; dark++) {
      cairo_surface_t *shown = draw_view(draw_dashboard, &data, 1600, 900, 1, dark, 0);
      g_assert_cmpint(cairo_surface_status(shown), ==, CAIRO_STATUS_SUCCESS);
      if (!dark) {
        picture_show(shown, name);
        g_assert_cmpfloat(picture_distance(finished, shown, NULL), >, 1e-3);
      }
      cairo_surface_destroy(shown);
    }
    // The window's column too.
    cairo_surface_t *column =
        draw_view(sb_hysteresis_draw, &data, 392, 400, 1, false, SB_CHART_COMPACT);
    g_autofree char *column_name = g_strconcat(name, "-column", NULL);
    picture_show(column, column_name);
    cairo_surface_destroy(column);
  }
  cairo_surface_destroy(finished);
  sb_trace_destroy(half_trace);
}

static void test_timeline(void) {
  static const SbChartMarker markers[] = {{28.2, "M1"}};
  SbChartData data;
  synthetic_data(&data, &run, 14.7);
  data.marker = markers;
  data.marker_count = 1;
  check_view(sb_timeline_draw, &data, "timeline", 1100, 104, 1, false, 0);
  check_view(sb_timeline_draw, &data, "timeline-dark", 1100, 104, 1, true, 0);
  data.playhead += 4;
  check_rejected(sb_timeline_draw, &data, "timeline", 1100, 104, 1, false, 0);
  check_rejected(sb_timeline_draw, &data, "timeline-dark", 1100, 104, 1, true, 0);
}

// A third of the pressure on asperities, and forces of thousands of newtons.
static void test_unusual(void) {
  static double share[201];
  SbChartData data;
  synthetic_data(&data, &run, 7.27);
  SbChartRun rough = run_with_film(&data.run, 1);
  for (int i = 0; i < 201; i++) {
    share[i] = wrong_profile[SB_OUTER].pressure[i] / 3;
  }
  wrong_profile[SB_OUTER].asperity_pressure = share;
  data.run = rough;
  cairo_surface_t *shown = draw_view(sb_profiles_draw, &data, 1280, 280, 1, false, SB_CHART_PANEL);
  picture_show(shown, "profiles-asperities");
  g_assert_true(picture_rejects(shown, "profiles"));
  cairo_surface_destroy(shown);

  Synthetic strong;
  synthetic_init(&strong, 1250, 1);
  for (size_t i = 0; i < strong.count; i++) {
    strong.frames[i].force *= -1000;
    strong.frames[i].displacement *= 100;
  }
  sb_trace_destroy(strong.trace);
  strong.trace = sb_trace_create(NULL);
  sb_trace_extend(strong.trace, strong.frames, strong.count, 0);
  synthetic_data(&data, &strong, 7.27);
  shown = draw_view(sb_hysteresis_draw, &data, 400, 400, 1, false, SB_CHART_COMPACT);
  picture_show(shown, "hysteresis-strong");
  cairo_surface_destroy(shown);
  synthetic_clear(&strong);
}

// Frames that no engine should make: any bits at all. Nothing may crash, and cairo stays sound.
static void test_hostile(void) {
  GRand *rand = g_rand_new_with_seed(5);
  static const double odd[] = {NAN, INFINITY, -INFINITY, 0, 1e308, -1e308, 1e-320, -1};
  for (int turn = 0; turn < 40; turn++) {
    enum { COUNT = 60 };
    SbFrame frames[COUNT];
    for (int i = 0; i < COUNT; i++) {
      double *value[] = {&frames[i].time,
                         &frames[i].displacement,
                         &frames[i].velocity,
                         &frames[i].force,
                         &frames[i].seal[0].contact_left,
                         &frames[i].seal[0].contact_right,
                         &frames[i].seal[0].load,
                         &frames[i].seal[0].pressure_peak,
                         &frames[i].seal[0].film_min,
                         &frames[i].seal[0].film_central};
      memset(&frames[i], 0, sizeof frames[i]);
      for (size_t k = 0; k < G_N_ELEMENTS(value); k++) {
        *value[k] = g_rand_int_range(rand, 0, 4) == 0 ? odd[g_rand_int_range(rand, 0, 8)]
                                                      : g_rand_double_range(rand, -1, 1);
      }
      frames[i].stage = (uint8_t)g_rand_int_range(rand, 0, 256);
      frames[i].on_event = (uint8_t)g_rand_int_range(rand, 0, 2);
      frames[i].seal[0].profile = g_rand_int(rand);
      frames[i].seal[1] = frames[i].seal[0];
    }
    SbTrace *trace = sb_trace_create(NULL);
    sb_trace_extend(trace, frames, COUNT, 0);
    SbChartData data = {.run = {.state = (SbChartState)(turn % 5),
                                .frames = frames,
                                .count = COUNT,
                                .trace = trace,
                                .summary = &run.summary,
                                .model = turn % 2 ? run.model : NULL},
                        .playhead = (size_t)turn};
    cairo_surface_t *shown = draw_view(draw_dashboard, &data, 700, 500, 1, turn % 2, 0);
    g_assert_cmpint(cairo_surface_status(shown), ==, CAIRO_STATUS_SUCCESS);
    cairo_surface_destroy(shown);
    size_t frame;
    const SbRect rect = {0, 0, 300, 300};
    sb_hysteresis_hit(&frame, rect, &data, 0, 100, 100, 1000);
    sb_timeline_hit(&frame, rect, &data, 100);
    sb_trace_destroy(trace);
  }
  g_rand_free(rand);
}

// The comparison itself: two grey levels pass, three do not, nor does another size.
static void test_comparison(void) {
  cairo_surface_t *a = picture_new(100, 100, 1), *b = picture_new(100, 100, 1);
  cairo_surface_t *c = picture_new(100, 101, 1);
  for (int delta = 0; delta < 4; delta++) {
    cairo_t *cr = cairo_create(b);
    cairo_set_source_rgb(cr, delta / 255.0, 0, 0);
    cairo_rectangle(cr, 10, 10, 4, 5); // 0.2 %
    cairo_fill(cr);
    cairo_destroy(cr);
    double share = picture_distance(a, b, NULL);
    g_assert_cmpfloat(share, ==, delta > 2 ? 0.002 : 0);
  }
  g_assert_cmpfloat(picture_distance(a, c, NULL), ==, 1);
  cairo_surface_destroy(a);
  cairo_surface_destroy(b);
  cairo_surface_destroy(c);
}

// The errors of two forces as in the table of `sealbench run`; none where a figure is exact.
static void test_errors(void) {
  const int margin = sb_figure_find("cycle.force_return_margin_N");
  const int start = sb_figure_find("cycle.force_breakaway_N");
  g_autofree SbSummary *summary = g_new0(SbSummary, 1);
  sb_figures_clear(summary);
  summary->force_breakaway = 25.83;
  summary->error[start] = 0.0876;
  summary->force_return_margin = 4.9;
  char text[300];
  sb_page_errors_text(text, sizeof text, summary);
  g_assert_cmpstr(text, ==,
                  "Break-away force \xc2\xb1 0.09 N  \xc2\xb7  Return margin error not known");
  summary->error[margin] = 0.2031;
  sb_page_errors_text(text, sizeof text, summary);
  g_assert_cmpstr(text, ==,
                  "Break-away force \xc2\xb1 0.09 N  \xc2\xb7  Return margin \xc2\xb1 0.20 N");
  summary->error[start] = summary->error[margin] = 0;
  sb_page_errors_text(text, sizeof text, summary);
  g_assert_cmpstr(text, ==, "rounding only");
}

// Friction so large that the stem does not return: the axis goes below zero.
static void test_no_return(void) {
  Synthetic stuck;
  synthetic_init(&stuck, 1250, 1.3);
  SbChartData data;
  synthetic_data(&data, &stuck, 36);
  check_view(sb_hysteresis_draw, &data, "hysteresis-no-return", 640, 560, 1, false, SB_CHART_PANEL);
  data.playhead += 20;
  check_rejected(sb_hysteresis_draw, &data, "hysteresis-no-return", 640, 560, 1, false,
                 SB_CHART_PANEL);
  synthetic_clear(&stuck);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  synthetic_init(&run, 1250, 1);
  synthetic_init(&weaker, 1250, 0.64);
  synthetic_init(&off, 1250, 1.01);
  g_test_add_func("/pictures/hysteresis", test_hysteresis);
  g_test_add_func("/pictures/profiles", test_profiles);
  g_test_add_func("/pictures/dashboard", test_dashboard);
  g_test_add_func("/pictures/unusual", test_unusual);
  g_test_add_func("/pictures/hostile", test_hostile);
  g_test_add_func("/pictures/comparison", test_comparison);
  g_test_add_func("/pictures/timeline", test_timeline);
  g_test_add_func("/pictures/states", test_states);
  g_test_add_func("/pictures/errors", test_errors);
  g_test_add_func("/pictures/no-return", test_no_return);
  int result = g_test_run();
  synthetic_clear(&run);
  synthetic_clear(&weaker);
  synthetic_clear(&off);
  return result;
}
