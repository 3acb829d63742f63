// The map of a measured surface and a profile's line: golden pictures with partners that must fail.
#include "app/chart/surface_map.h"
#include "tests/app/picture.h"

#include <glib.h>
#include <math.h>

enum { COLUMNS = 120, ROWS = 80, WIDTH = 420, HEIGHT = 300 };

static cairo_surface_t *drawn(int rows, double sign, bool dark) {
  static double z[COLUMNS * ROWS];
  for (int k = 0; k < COLUMNS * ROWS; k++) {
    const double x = k % COLUMNS, y = k / COLUMNS;
    z[k] = sign * 1e-6 * (sin(x / 9) + cos(y / 7) + 0.4 * sin((x + y) / 3));
    if (hypot(x - 90, y - 25) < 8) {
      z[k] = NAN;
    }
  }
  const SbHeights h = {COLUMNS, (size_t)rows, COLUMNS, 2e-6, 2e-6, z};
  cairo_surface_t *surface = picture_new(WIDTH, HEIGHT, 1);
  cairo_t *cr = cairo_create(surface);
  sb_surface_map_draw(cr, (SbRect){0, 0, WIDTH, HEIGHT}, sb_theme(dark), &h, 1e-6);
  cairo_destroy(cr);
  return surface;
}

static void check(int rows, bool dark, const char *name) {
  cairo_surface_t *right = drawn(rows, 1, dark), *wrong = drawn(rows, -1, dark);
  picture_check(right, name);
  g_assert_true(picture_rejects(wrong, name));
  cairo_surface_destroy(right);
  cairo_surface_destroy(wrong);
}

static void test_map(void) {
  check(ROWS, false, "surface-map");
  check(ROWS, true, "surface-map-dark");
}

static void test_profile(void) {
  check(1, false, "surface-profile");
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/surface-map/map", test_map);
  g_test_add_func("/surface-map/profile", test_profile);
  return g_test_run();
}
