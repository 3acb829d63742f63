// Exports of real runs: each format is what it says, carries its texts, appears whole or not at
// all.
#include "app/document/picture.h"
#include "app/export/render.h"
#include "app/export/still.h"
#include "tests/app/picture.h"
#include "tests/crc.h"
#include "tests/executed.h"

#include <errno.h>
#include <fcntl.h>
#include <gio/gio.h>
#include <glib.h>
#include <glib/gstdio.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

static SbRun *run;
static char *folder;

static SbRun *compute(void) {
  SbParams params;
  sb_params_init(&params);
  SbModel *model = NULL;
  unsigned views = SB_VIEW_HYSTERESIS | SB_VIEW_PROFILES;
  g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_VIEWS, views, NULL), ==, SB_OK);
  g_assert_cmpint(sb_model_create(&model, &params, NULL, NULL, NULL), ==, SB_OK);
  SbRun *out = executed_run(model);
  sb_model_destroy(model);
  return out;
}

static char *path_of(const char *name) {
  return g_build_filename(folder, name, NULL);
}

static const char scene[] =
    "[sealbench]\nformat = 1\nkind = scene\n# Dichtung \xc3\xb8 1,61 mm <&>\n";

static SbRenderOptions options_for(const char *view) {
  return (SbRenderOptions){.view = view,
                           .title = "Piston valve <one> & only",
                           .subtitle = "piston.valve",
                           .hash = "4f21c09a77",
                           .scene = scene};
}

static void assert_written(bool good, GError *error) {
  g_assert_no_error(error);
  g_assert_true(good);
}

static char *read_scene(const char *path, GError **error) {
  g_autofree char *data = NULL;
  gsize length = 0;
  g_assert_true(g_file_get_contents(path, &data, &length, NULL));
  return sb_picture_find_scene(data, length, error);
}

static void test_png(void) {
  g_autofree char *path = path_of("loop.png");
  GError *error = NULL;
  SbRenderOptions options = options_for("hysteresis");
  options.width = 640;
  options.height = 480;
  options.scale = 2;
  assert_written(sb_render_still(run, &options, path, &error), error);
  cairo_surface_t *back = cairo_image_surface_create_from_png(path);
  g_assert_cmpint(cairo_image_surface_get_width(back), ==, 1280);
  g_assert_cmpint(cairo_image_surface_get_height(back), ==, 960);
  cairo_surface_destroy(back);
  // The scene comes back byte for byte.
  g_autofree char *text = read_scene(path, &error);
  g_assert_no_error(error);
  g_assert_cmpstr(text, ==, scene);
  // The same run gives the same bytes.
  g_autofree char *again = path_of("again.png");
  assert_written(sb_render_still(run, &options, again, &error), error);
  g_autofree char *a = NULL, *b = NULL;
  gsize na = 0, nb = 0;
  g_assert_true(g_file_get_contents(path, &a, &na, NULL) &&
                g_file_get_contents(again, &b, &nb, NULL));
  g_assert_cmpmem(a, na, b, nb);
}

static void test_vector(void) {
  GError *error = NULL;
  static const char *const names[] = {"hysteresis", "profiles", "dashboard"};
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    SbRenderOptions options = options_for(names[i]);
    g_autofree char *svg = path_of("view.svg");
    g_autofree char *pdf = path_of("view.PDF");
    assert_written(sb_render_still(run, &options, svg, &error), error);
    assert_written(sb_render_still(run, &options, pdf, &error), error);
    g_autofree char *text = NULL, *bytes = NULL;
    gsize length;
    g_assert_true(g_file_get_contents(svg, &text, NULL, NULL));
    g_assert_nonnull(strstr(text, "<metadata><sealbench"));
    g_assert_nonnull(strstr(text, "&lt;one&gt; &amp; only"));
    g_assert_nonnull(strstr(text, "1,61 mm &lt;&amp;&gt;"));
    // Vector, with no picture inside.
    g_assert_null(strstr(text, "<image"));
    GMarkupParser none = {0};
    GMarkupParseContext *parse = g_markup_parse_context_new(&none, 0, NULL, NULL);
    g_assert_true(g_markup_parse_context_parse(parse, text, -1, &error));
    g_assert_true(g_markup_parse_context_end_parse(parse, &error));
    g_markup_parse_context_free(parse);
    g_assert_true(g_file_get_contents(pdf, &bytes, &length, NULL));
    g_assert_cmpuint(length, >, 2000);
    g_assert_cmpint(strncmp(bytes, "%PDF-1.", 7), ==, 0);
    g_assert_cmpint(strncmp(bytes + length - 6, "%%EOF\n", 6), ==, 0);
  }
}

// Sets the file size limit so that writing fails in the middle.
static void test_disk_full(void) {
  static const char *const names[] = {"full.png", "full.svg", "full.pdf"};
  SbRenderOptions options = options_for("hysteresis");
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    g_autofree char *path = path_of(names[i]);
    g_assert_true(g_file_set_contents(path, "earlier", -1, NULL));
    struct rlimit old, small = {3000, 3000};
    getrlimit(RLIMIT_FSIZE, &old);
    small.rlim_max = old.rlim_max;
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    GError *error = NULL;
    bool good = sb_render_still(run, &options, path, &error);
    setrlimit(RLIMIT_FSIZE, &old);
    signal(SIGXFSZ, handler);
    g_assert_false(good);
    g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_IO);
    g_test_message("%s", error->message);
    g_assert_null(strchr(error->message, '\n'));
    g_error_free(error);
    g_autofree char *text = NULL;
    g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
    g_assert_cmpstr(text, ==, "earlier");
  }
  // Nothing is left beside them.
  GDir *dir = g_dir_open(folder, 0, NULL);
  const char *name;
  while ((name = g_dir_read_name(dir))) {
    g_assert_null(strstr(name, ".part"));
  }
  g_dir_close(dir);
}

static void expect_input_error(const SbRenderOptions *options, const char *name) {
  g_autofree char *path = path_of(name);
  GError *error = NULL;
  g_assert_false(sb_render_still(run, options, path, &error));
  g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT);
  g_test_message("%s", error->message);
  g_error_free(error);
  g_assert_false(g_file_test(path, G_FILE_TEST_EXISTS));
}

static void test_bad_requests(void) {
  SbRenderOptions options = options_for("hysteresis");
  expect_input_error(&options, "loop.gif");
  options.width = 4;
  expect_input_error(&options, "a.png");
  options.width = 20000;
  expect_input_error(&options, "a.png");
  options.width = NAN;
  options.height = 10;
  expect_input_error(&options, "a.png");
  options = options_for("hysteresis");
  options.scale = 100;
  expect_input_error(&options, "a.png");
  options = options_for("nothing");
  expect_input_error(&options, "a.png");
  options = options_for("section");
  expect_input_error(&options, "a.png");
  options = options_for("hysteresis");
  options.at = "G";
  expect_input_error(&options, "a.png");
  options.at = "7.27";
  expect_input_error(&options, "a.png");
  options.at = "1 h";
  expect_input_error(&options, "a.png");
  GError *error = NULL;
  options.at = NULL;
  g_assert_false(sb_render_still(run, &options, "/nonexistent/a.png", &error));
  g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_IO);
  g_clear_error(&error);
  g_autofree char *path = path_of("plain.png");
  g_assert_true(g_file_set_contents(path, "not a png", -1, NULL));
  g_assert_null(read_scene(path, &error));
  g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT);
  g_clear_error(&error);
}

// A picture whose other chunks unpack to gigabytes costs no more than the file: they are not read.
static void test_bombs(void) {
  g_autofree char *path = path_of("bomb.png");
  SbRenderOptions options = options_for("hysteresis");
  GError *error = NULL;
  assert_written(sb_render_still(run, &options, path, &error), error);
  g_autofree char *picture = NULL;
  gsize length = 0;
  g_assert_true(g_file_get_contents(path, &picture, &length, NULL));
  // zTXt, key "a", of 3.9 MB of zeros, below libpng's limit for one chunk; 900 of them.
  enum { ZEROS = 3900000, BOMBS = 900, HEAD = 33 };
  g_autoptr(GZlibCompressor) deflate = g_zlib_compressor_new(G_ZLIB_COMPRESSOR_FORMAT_ZLIB, 9);
  g_autofree guint8 *zeros = g_malloc0(ZEROS);
  guint8 chunk[8192] = "....zTXta\0";
  gsize read = 0, packed = 0;
  g_assert_cmpint(g_converter_convert(G_CONVERTER(deflate), zeros, ZEROS, chunk + 11,
                                      sizeof chunk - 15, G_CONVERTER_INPUT_AT_END, &read, &packed,
                                      NULL),
                  ==, G_CONVERTER_FINISHED);
  gsize size = packed + 3;
  guint32 words[2] = {GUINT32_TO_BE((guint32)size), GUINT32_TO_BE(crc(chunk + 4, size + 4))};
  memcpy(chunk, &words[0], 4);
  memcpy(chunk + 8 + size, &words[1], 4);
  GByteArray *bytes = g_byte_array_new();
  g_byte_array_append(bytes, (guint8 *)picture, HEAD);
  for (int i = 0; i < BOMBS; i++) {
    g_byte_array_append(bytes, chunk, (guint)(size + 12));
  }
  g_byte_array_append(bytes, (guint8 *)picture + HEAD, (guint)(length - HEAD));
  struct rusage before, after;
  getrusage(RUSAGE_SELF, &before);
  g_autofree char *text = sb_picture_find_scene(bytes->data, bytes->len, &error);
  getrusage(RUSAGE_SELF, &after);
  g_assert_no_error(error);
  g_assert_cmpstr(text, ==, scene);
  g_assert_cmpint(after.ru_maxrss - before.ru_maxrss, <, 100 << 10);
  g_assert_cmpint(after.ru_utime.tv_sec - before.ru_utime.tv_sec, <=, 1);
  g_byte_array_unref(bytes);
}

// A stale run says so on the page and in the file.
static void test_stale(void) {
  GError *error = NULL;
  g_autofree char *svg = path_of("stale.svg");
  SbRenderOptions options = options_for("hysteresis");
  options.stale = "shows the last good run, axial width 2.0 mm";
  assert_written(sb_render_still(run, &options, svg, &error), error);
  g_autofree char *text = NULL;
  g_assert_true(g_file_get_contents(svg, &text, NULL, NULL));
  g_assert_nonnull(strstr(text, "Stale: shows the last good run"));
  g_assert_nonnull(strstr(text, "Models: fit "));
  g_assert_nonnull(strstr(text, "Error estimates: "));
  // The amber ground, 0xFBF1DC, is on the page.
  g_assert_nonnull(strstr(text, "rgb(98.431373%,94.509804%,86.27451%)"));
}

static void test_instants(void) {
  size_t frame, count;
  GError *error = NULL;
  const SbFrame *frames = sb_run_frames(run, &count);
  const SbSummary *s = sb_run_summary(run);
  for (int i = 0; i < SB_STAGE_COUNT; i++) {
    g_assert_true(sb_render_frame_at(&frame, run, sb_stage_name((SbStage)i), &error));
    g_assert_cmpuint(frame, ==, s->stage[i].frame);
  }
  g_assert_true(sb_render_frame_at(&frame, run, "7270ms", &error));
  g_assert_cmpfloat(fabs(frames[frame].time - 7.27), <, 0.6 * s->duration / (double)count + 1e-3);
  g_assert_true(sb_render_frame_at(&frame, run, NULL, &error));
  g_assert_cmpint(frames[frame].stage, ==, SB_STAGE_B);
}

// Every view at every size that may be asked for draws without a cairo error, small ones included.
static void test_sizes(void) {
  static const double sizes[][2] = {{16, 16}, {64, 400}, {320, 200}, {1280, 720}, {500, 1600}};
  static const char *const names[] = {"hysteresis", "profiles", "dashboard"};
  g_autofree char *path = path_of("size.png");
  for (size_t v = 0; v < G_N_ELEMENTS(names); v++) {
    for (size_t i = 0; i < G_N_ELEMENTS(sizes); i++) {
      SbRenderOptions options = options_for(names[v]);
      options.width = sizes[i][0];
      options.height = sizes[i][1];
      options.dark = i % 2;
      GError *error = NULL;
      assert_written(sb_render_still(run, &options, path, &error), error);
    }
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  folder = g_dir_make_tmp("sealbench-still-XXXXXX", NULL);
  g_assert_nonnull(folder);
  run = compute();
  g_test_add_func("/still/png", test_png);
  g_test_add_func("/still/vector", test_vector);
  g_test_add_func("/still/disk-full", test_disk_full);
  g_test_add_func("/still/bad-requests", test_bad_requests);
  g_test_add_func("/still/bombs", test_bombs);
  g_test_add_func("/still/stale", test_stale);
  g_test_add_func("/still/instants", test_instants);
  g_test_add_func("/still/sizes", test_sizes);
  int result = g_test_run();
  GDir *dir = g_dir_open(folder, 0, NULL);
  const char *name;
  while ((name = g_dir_read_name(dir))) {
    g_autofree char *path = path_of(name);
    g_unlink(path);
  }
  g_dir_close(dir);
  g_rmdir(folder);
  g_free(folder);
  sb_run_destroy(run);
  return result;
}
