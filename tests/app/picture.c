// Golden pictures with a tolerance: 2 per channel on at most 0.1 % of pixels, which is what
// different processors make of the same drawing.
#include "tests/app/picture.h"

#include <glib.h>
#include <stdlib.h>

enum { CHANNEL_TOLERANCE = 2 };
static const double share_tolerance = 1e-3;

cairo_surface_t *picture_new(int width, int height, double scale) {
  cairo_surface_t *surface =
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, (int)(width * scale), (int)(height * scale));
  cairo_surface_set_device_scale(surface, scale, scale);
  return surface;
}

double picture_distance(cairo_surface_t *a, cairo_surface_t *b, const char *difference) {
  int width = cairo_image_surface_get_width(a), height = cairo_image_surface_get_height(a);
  if (width != cairo_image_surface_get_width(b) || height != cairo_image_surface_get_height(b)) {
    return 1;
  }
  cairo_surface_flush(a);
  cairo_surface_flush(b);
  cairo_surface_t *shown = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  const unsigned char *pa = cairo_image_surface_get_data(a), *pb = cairo_image_surface_get_data(b);
  unsigned char *pd = cairo_image_surface_get_data(shown);
  int sa = cairo_image_surface_get_stride(a), sb = cairo_image_surface_get_stride(b);
  int sd = cairo_image_surface_get_stride(shown);
  long wrong = 0;
  for (int y = 0; y < height; y++) {
    for (int x = 0; x < width; x++) {
      int worst = 0;
      for (int k = 0; k < 3; k++) {
        int d = abs(pa[y * sa + 4 * x + k] - pb[y * sb + 4 * x + k]);
        worst = MAX(worst, d);
        pd[y * sd + 4 * x + k] = (unsigned char)MIN(255, 8 * d);
      }
      wrong += worst > CHANNEL_TOLERANCE;
    }
  }
  cairo_surface_mark_dirty(shown);
  if (difference) {
    cairo_surface_write_to_png(shown, difference);
  }
  cairo_surface_destroy(shown);
  return (double)wrong / ((double)width * height);
}

static cairo_surface_t *golden(const char *name) {
  g_autofree char *file = g_strdup_printf("%s/%s.png", SB_GOLDEN_DIR, name);
  return cairo_image_surface_create_from_png(file);
}

void picture_show(cairo_surface_t *surface, const char *name) {
  const char *out = g_getenv("SB_PICTURES");
  if (out) {
    g_autofree char *file = g_strdup_printf("%s/%s.png", out, name);
    cairo_surface_write_to_png(surface, file);
  }
}

void picture_check(cairo_surface_t *actual, const char *name) {
  picture_show(actual, name);
  if (g_getenv("SB_GOLDEN_UPDATE")) {
    g_autofree char *file = g_strdup_printf("%s/%s.png", SB_GOLDEN_DIR, name);
    g_assert_cmpint(cairo_surface_write_to_png(actual, file), ==, CAIRO_STATUS_SUCCESS);
    return;
  }
  cairo_surface_t *expected = golden(name);
  g_assert_cmpint(cairo_surface_status(expected), ==, CAIRO_STATUS_SUCCESS);
  double share = picture_distance(expected, actual, NULL);
  if (share > share_tolerance) {
    g_autofree char *e = g_strdup_printf("%s-expected.png", name);
    g_autofree char *a = g_strdup_printf("%s-actual.png", name);
    g_autofree char *d = g_strdup_printf("%s-difference.png", name);
    cairo_surface_write_to_png(expected, e);
    cairo_surface_write_to_png(actual, a);
    picture_distance(expected, actual, d);
    g_autofree char *here = g_get_current_dir();
    g_test_message("%s: %.3f %% of pixels differ; see %s/%s", name, 100 * share, here, d);
    g_test_fail();
  }
  cairo_surface_destroy(expected);
}

bool picture_rejects(cairo_surface_t *wrong, const char *name) {
  cairo_surface_t *expected = golden(name);
  bool rejects = cairo_surface_status(expected) == CAIRO_STATUS_SUCCESS &&
                 picture_distance(expected, wrong, NULL) > share_tolerance;
  cairo_surface_destroy(expected);
  return rejects;
}
