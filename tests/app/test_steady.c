// Ten thousand pictures of a run, drawn as a film draws them, take no more memory than a thousand:
// what is allocated (malloc's own count) and what is resident stay. A leak grows with every sweep
// over the run; the GL below us grows its caches in a few steps, whose moment depends on how its
// threads are scheduled: so the sweep with the least growth is judged. Quick runs look at fewer
// pictures, the argument's at any number: test-app-steady [PICTURES]. The address sanitizer holds
// freed memory back, so there only the drawing is exercised.
#include "app/export/movie_pictures.h"
#include "app/section/painter.h"
#include "tests/executed.h"
#include "tests/sanitized.h"

#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>

static size_t asked; // pictures, by the argument

enum { WIDTH = 320, HEIGHT = 180, SWEEPS = 10, SETTLED = 3 };

// Resident memory [bytes].
static size_t resident(void) {
  char *text = NULL;
  long total = 0;
  long pages = 0;
  g_assert_true(g_file_get_contents("/proc/self/statm", &text, NULL, NULL));
  g_assert_cmpint(sscanf(text, "%ld %ld", &total, &pages), ==, 2);
  g_free(text);
  return (size_t)pages * 4096;
}

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static SbRun *compute(void) {
  SbParams params;
  sb_params_init(&params);
  SbReport report = {0};
  g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_VIEWS, SB_VIEW_SECTION, &report), ==, SB_OK);
  SbModel *model = NULL;
  g_assert_cmpint(sb_model_create(&model, &params, NULL, NULL, NULL), ==, SB_OK);
  SbRun *run = executed_run(model);
  sb_model_destroy(model);
  return run;
}

static void test_section(void) {
  SbRun *run = compute();
  SbReport report = {0};
  SbSectionPainter *painter;
  g_assert_cmpint(sb_section_painter_create(&painter, true, SB_GL_AUTO, &report), ==, SB_OK);
  SbRenderOptions options = {.view = "section",
                             .width = WIDTH,
                             .height = HEIGHT,
                             .section = sb_section_painter_draw,
                             .section_data = painter};
  const size_t pictures = asked > 0 ? asked : g_test_slow() ? 3000 : 500;
  const size_t sweep = pictures / SWEEPS;
  // Back and forth over the run: the film is one sweep of a tenth of the pictures.
  SbRenderMovie movie = {.fps = 100, .duration = (double)pictures / 1000};
  SbMoviePictures *film;
  GError *error = NULL;
  g_assert_true(sb_movie_pictures_open(&film, run, &options, &movie, &error));
  g_assert_cmpuint(sb_movie_pictures_count(film), ==, sweep);
  cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDTH, HEIGHT);
  size_t allocated[SWEEPS];
  size_t in_memory = 0;
  gint64 begin = g_get_monotonic_time();
  for (size_t i = 0; i < pictures; i++) {
    cairo_t *cr = cairo_create(surface);
    sb_movie_pictures_draw(film, i % sweep, cr);
    g_assert_cmpint(cairo_status(cr), ==, CAIRO_STATUS_SUCCESS);
    cairo_destroy(cr);
    if ((i + 1) % sweep == 0) {
      allocated[i / sweep] = mallinfo2().uordblks;
      in_memory = i / sweep <= SETTLED ? resident() : in_memory;
    }
  }
  double taken = 1e-6 * (double)(g_get_monotonic_time() - begin);
  size_t larger = resident();
  double growth[SWEEPS - 1 - SETTLED];
  for (size_t i = 0; i < G_N_ELEMENTS(growth); i++) {
    growth[i] = (double)allocated[SETTLED + i + 1] - (double)allocated[SETTLED + i];
  }
  qsort(growth, G_N_ELEMENTS(growth), sizeof growth[0], compare);
  // A leak grows in every sweep, what caches still take in some.
  const double least = growth[0];
  g_test_message(
      "%.0f pictures a second; allocated %zu kB, then %zu kB, %.1f bytes a picture in the "
      "least sweep; resident %zu, then %zu kB",
      (double)pictures / taken, allocated[SETTLED] / 1024, allocated[SWEEPS - 1] / 1024,
      least / (double)sweep, in_memory / 1024, larger / 1024);
  if (!SB_SANITIZED) {
    g_assert_cmpfloat(least, <, 16.0 * (double)sweep);
    g_assert_cmpuint(larger, <, in_memory + 4 * 1024 * 1024);
  }
  cairo_surface_destroy(surface);
  sb_movie_pictures_close(film);
  sb_section_painter_destroy(painter);
  sb_run_destroy(run);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  if (argc > 1) {
    asked = (size_t)atol(argv[1]);
  }
  g_test_add_func("/steady/section", test_section);
  return g_test_run();
}
