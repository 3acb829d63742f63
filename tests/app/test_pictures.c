// Golden pictures of the charts in both themes, each with a slightly wrong partner that must be
// caught.
#include "app/chart/hysteresis.h"
#include "tests/app/picture.h"
#include "tests/app/synthetic.h"

#include <glib.h>
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

static void test_hysteresis(void) {
  SbChartData data, wrong;
  synthetic_data(&data, &run, 7.27);
  SbChartData pinned;
  synthetic_data(&pinned, &weaker, 7.27);
  data.pinned = &pinned.run;
  data.pinned_name = "roughness \xe2\x88\x92"
                     "30 %";
  check_view(sb_hysteresis_draw, &data, "hysteresis", 640, 560, 1, false, SB_CHART_PANEL);
  check_view(sb_hysteresis_draw, &data, "hysteresis-dark", 640, 560, 1, true, SB_CHART_PANEL);
  // A loop whose friction is 1 % too large.
  synthetic_data(&wrong, &off, 7.27);
  wrong.pinned = data.pinned;
  wrong.pinned_name = data.pinned_name;
  check_rejected(sb_hysteresis_draw, &wrong, "hysteresis", 640, 560, 1, false, SB_CHART_PANEL);
  check_rejected(sb_hysteresis_draw, &wrong, "hysteresis-dark", 640, 560, 1, true, SB_CHART_PANEL);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  synthetic_init(&run, 1250, 1);
  synthetic_init(&weaker, 1250, 0.64);
  synthetic_init(&off, 1250, 1.01);
  g_test_add_func("/pictures/hysteresis", test_hysteresis);
  int result = g_test_run();
  synthetic_clear(&run);
  synthetic_clear(&weaker);
  synthetic_clear(&off);
  return result;
}
