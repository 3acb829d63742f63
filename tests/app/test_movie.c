// Films: frame count, tags and colours as an outside decoder sees them; cancelled, killed and
// starved of disk.
#include "app/export/colour.h"
#include "app/export/movie.h"

#include <glib.h>
#include <glib/gstdio.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

typedef struct {
  int width, height;
  uint32_t colour; // of the left half; the right half is mid grey
  size_t cancel_at;
  size_t drawn;
  bool noise;
  unsigned delay_us;
} Painter;

static SbStatus paint(void *data, size_t frame, uint8_t *pixels, size_t stride, SbReport *report) {
  (void)report;
  Painter *painter = data;
  uint32_t seed = (uint32_t)frame * 2654435761u + 1u;
  for (int j = 0; j < painter->height; j++) {
    uint32_t *row = (uint32_t *)(void *)(pixels + (size_t)j * stride);
    for (int i = 0; i < painter->width; i++) {
      seed = seed * 1664525u + 1013904223u;
      row[i] = painter->noise           ? 0xFF000000u | seed >> 8
               : i < painter->width / 2 ? 0xFF000000u | painter->colour
                                        : 0xFF808080u;
    }
  }
  painter->drawn = frame + 1;
  if (painter->delay_us > 0) {
    g_usleep(painter->delay_us);
  }
  return SB_OK;
}

static bool cancelled(void *data) {
  const Painter *painter = data;
  return painter->cancel_at > 0 && painter->drawn >= painter->cancel_at;
}

static SbStatus write_film(const char *path, Painter *painter, size_t frames, SbMovieResult *result,
                           SbReport *report) {
  SbMovieOptions options = {.width = painter->width,
                            .height = painter->height,
                            .fps_num = 30,
                            .fps_den = 1,
                            .frames = frames,
                            .threads = 1,
                            .bit_exact = true,
                            .title = "test",
                            .comment = "made by a test"};
  SbMovieHooks hooks = {NULL, cancelled, painter};
  return sb_movie_write(path, &options, paint, painter, &hooks, result, report);
}

static char *directory;

static char *in_directory(const char *name) {
  return g_build_filename(directory, name, NULL);
}

// Output of a command; the test is skipped where ffprobe is missing.
static char *run_tool(const char *command) {
  char *out = NULL;
  int status = 0;
  GError *error = NULL;
  char *argv[] = {(char *)"/bin/sh", (char *)"-c", (char *)command, NULL};
  g_assert_true(g_spawn_sync(NULL, argv, NULL, G_SPAWN_STDERR_TO_DEV_NULL, NULL, NULL, &out, NULL,
                             &status, &error));
  g_assert_cmpint(status, ==, 0);
  return out;
}

static bool have_ffprobe(void) {
  char *found = g_find_program_in_path("ffprobe");
  g_free(found);
  if (found == NULL) {
    g_test_skip("ffprobe is not installed");
  }
  return found != NULL;
}

static char *probe(const char *path, const char *entries) {
  char *quoted = g_shell_quote(path);
  char *command = g_strdup_printf("ffprobe -v error -count_frames -select_streams v -show_entries "
                                  "%s -of default=nw=1 %s",
                                  entries, quoted);
  char *out = run_tool(command);
  g_free(command);
  g_free(quoted);
  return out;
}

// Primary colours and greys against the equations, to a rounding.
static void test_colour(void) {
  static const uint32_t pixels[4] = {0xFFFF0000u, 0xFFFF0000u, 0xFFFF0000u, 0xFFFF0000u};
  uint8_t y[4], cb[1], cr[1];
  uint8_t *plane[3] = {y, cb, cr};
  const int stride[3] = {2, 1, 1};
  sb_colour_to_yuv420(plane, stride, (const uint8_t *)pixels, 8, 2, 2);
  g_assert_cmpint(y[0], ==, 63);
  g_assert_cmpint(cb[0], ==, 102);
  g_assert_cmpint(cr[0], ==, 240);
  for (uint32_t grey = 0; grey < 256; grey++) {
    uint32_t row[4];
    for (int i = 0; i < 4; i++) {
      row[i] = 0xFF000000u | grey * 0x010101u;
    }
    sb_colour_to_yuv420(plane, stride, (const uint8_t *)row, 8, 2, 2);
    g_assert_cmpint(y[3], ==, (int)(16 + 219 * grey / 255.0 + 0.5));
    g_assert_cmpint(cb[0], ==, 128);
    g_assert_cmpint(cr[0], ==, 128);
  }
}

static void test_tags(void) {
  if (!have_ffprobe()) {
    return;
  }
  char *path = in_directory("tags.mp4");
  Painter painter = {.width = 129, .height = 97, .colour = 0xFF0000};
  SbMovieResult result;
  SbReport report = {0};
  g_assert_cmpint(write_film(path, &painter, 45, &result, &report), ==, SB_OK);
  g_assert_cmpuint(result.frames, ==, 45);
  char *out = probe(path, "stream=codec_name,pix_fmt,color_range,color_space,color_transfer,"
                          "color_primaries,width,height,nb_read_frames,r_frame_rate:format="
                          "duration:format_tags=comment");
  static const char *const expected[] = {"codec_name=h264",
                                         "pix_fmt=yuv420p",
                                         "color_range=tv",
                                         "color_space=bt709",
                                         "color_transfer=bt709",
                                         "color_primaries=bt709",
                                         "width=130",
                                         "height=98",
                                         "nb_read_frames=45",
                                         "r_frame_rate=30/1",
                                         "duration=1.500000",
                                         "TAG:comment=made by a test"};
  for (size_t i = 0; i < G_N_ELEMENTS(expected); i++) {
    if (strstr(out, expected[i]) == NULL) {
      g_error("no \"%s\" in:\n%s", expected[i], out);
    }
  }
  g_free(out);
  // The index comes before the pictures.
  char *bytes = NULL;
  gsize length = 0;
  g_assert_true(g_file_get_contents(path, &bytes, &length, NULL));
  const char *moov = NULL, *mdat = NULL;
  for (gsize i = 0; i + 4 < length; i++) {
    moov = moov == NULL && memcmp(bytes + i, "moov", 4) == 0 ? bytes + i : moov;
    mdat = mdat == NULL && memcmp(bytes + i, "mdat", 4) == 0 ? bytes + i : mdat;
  }
  g_assert_true(moov != NULL && mdat != NULL && moov < mdat);
  g_free(bytes);
  // Decoded by somebody else, red is red and grey is grey.
  char *command = g_strdup_printf("ffmpeg -v error -i '%s' -frames:v 1 -vf "
                                  "scale=in_color_matrix=bt709:out_range=pc -f rawvideo -pix_fmt "
                                  "rgb24 - | od -An -tu1 -v -w3 | sed -n '6533p;6500p'",
                                  path);
  out = run_tool(command);
  int r[2], g[2], b[2];
  g_assert_cmpint(sscanf(out, "%d %d %d %d %d %d", &r[0], &g[0], &b[0], &r[1], &g[1], &b[1]), ==,
                  6);
  // Pixel 6499 is column 129 of row 49 (grey), 6532 is column 32 of row 50 (red).
  g_assert_cmpint(ABS(r[1] - 255), <=, 3);
  g_assert_cmpint(g[1], <=, 3);
  g_assert_cmpint(b[1], <=, 3);
  g_assert_cmpint(ABS(r[0] - 128), <=, 3);
  g_assert_cmpint(ABS(g[0] - 128), <=, 3);
  g_assert_cmpint(ABS(b[0] - 128), <=, 3);
  g_free(out);
  g_free(command);
  g_free(path);
}

// The same bytes twice.
static void test_repeatable(void) {
  char *first = in_directory("one.mp4"), *second = in_directory("two.mp4");
  char *a = NULL, *b = NULL;
  gsize a_length = 0, b_length = 0;
  for (int i = 0; i < 2; i++) {
    Painter painter = {.width = 64, .height = 48, .colour = 0x1959A0};
    SbReport report = {0};
    g_assert_cmpint(write_film(i == 0 ? first : second, &painter, 10, NULL, &report), ==, SB_OK);
  }
  g_assert_true(g_file_get_contents(first, &a, &a_length, NULL));
  g_assert_true(g_file_get_contents(second, &b, &b_length, NULL));
  g_assert_cmpmem(a, a_length, b, b_length);
  g_free(a);
  g_free(b);
  g_free(first);
  g_free(second);
}

static void test_cancel(void) {
  if (!have_ffprobe()) {
    return;
  }
  char *path = in_directory("cancel.mp4");
  Painter painter = {.width = 64, .height = 48, .colour = 0xFF0000, .cancel_at = 12};
  SbMovieResult result;
  SbReport report = {0};
  g_assert_cmpint(write_film(path, &painter, 100, &result, &report), ==, SB_ERROR_CANCELLED);
  g_assert_true(result.partial);
  g_assert_cmpuint(result.frames, ==, 12);
  char *out = probe(path, "stream=nb_read_frames:format_tags=comment");
  g_assert_nonnull(strstr(out, "nb_read_frames=12"));
  g_assert_nonnull(strstr(out, "comment=partial: 12 of 100 frames; made by a test"));
  g_free(out);
  g_free(path);
}

static size_t entries(void) {
  GDir *dir = g_dir_open(directory, 0, NULL);
  size_t count = 0;
  while (g_dir_read_name(dir) != NULL) {
    count++;
  }
  g_dir_close(dir);
  return count;
}

// A killed film leaves an earlier file alone and nothing beside it.
static void test_kill(void) {
  char *path = in_directory("kill.mp4");
  g_assert_true(g_file_set_contents(path, "earlier", -1, NULL));
  size_t before = entries();
  pid_t child = fork();
  if (child == 0) {
    Painter painter = {.width = 320, .height = 240, .noise = true, .delay_us = 2000};
    g_assert_cmpint(write_film(path, &painter, 100000, NULL, NULL), ==, SB_OK);
    _exit(1);
  }
  g_usleep(300000);
  g_assert_cmpint(waitpid(child, NULL, WNOHANG), ==, 0);
  // What it wrote has no name yet, so that nothing is left of it.
  kill(child, SIGKILL);
  waitpid(child, NULL, 0);
  g_assert_cmpuint(entries(), ==, before);
  char *text = NULL;
  g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
  g_assert_cmpstr(text, ==, "earlier");
  g_free(text);
  Painter painter = {.width = 64, .height = 48, .colour = 0xFF0000};
  SbReport report = {0};
  g_assert_cmpint(write_film(path, &painter, 3, NULL, &report), ==, SB_OK);
  g_assert_cmpuint(entries(), ==, before);
  g_free(path);
}

// A full disk: one clear sentence, nothing left, the earlier file intact.
static void test_full_disk(void) {
  char *mount_point = in_directory("small");
  g_mkdir(mount_point, 0700);
  if (mount("none", mount_point, "tmpfs", 0, "size=192k") != 0) {
    g_test_skip("mounting a tmpfs is not permitted here");
    g_free(mount_point);
    return;
  }
  char *path = g_build_filename(mount_point, "film.mp4", NULL);
  g_assert_true(g_file_set_contents(path, "earlier", -1, NULL));
  Painter painter = {.width = 320, .height = 240, .noise = true};
  SbReport report = {0};
  SbStatus status = write_film(path, &painter, 60, NULL, &report);
  char *text = NULL;
  g_file_get_contents(path, &text, NULL, NULL);
  GDir *dir = g_dir_open(mount_point, 0, NULL);
  size_t count = 0;
  while (g_dir_read_name(dir) != NULL) {
    count++;
  }
  g_dir_close(dir);
  umount(mount_point);
  g_assert_cmpint(status, ==, SB_ERROR_IO);
  g_assert_nonnull(strstr(report.text, "disk is full"));
  g_assert_cmpstr(text, ==, "earlier");
  g_assert_cmpuint(count, ==, 1);
  g_free(text);
  g_free(path);
  g_free(mount_point);
}

static void test_sizes(void) {
  char *path = in_directory("size.mp4");
  SbReport report = {0};
  Painter plain = {.width = 64, .height = 48, .colour = 0x00FF00};
  // A device gets the finished film, whose index is moved to the front at the end.
  g_assert_cmpint(write_film("/dev/null", &plain, 3, NULL, &report), ==, SB_OK);
  g_assert_cmpint(write_film("/dev/full", &plain, 3, NULL, &report), ==, SB_ERROR_IO);
  g_assert_nonnull(strstr(report.text, "/dev/full: No space left"));
  Painter smallest = {.width = 16, .height = 16, .colour = 0xFF0000};
  g_assert_cmpint(write_film(path, &smallest, 3, NULL, &report), ==, SB_OK);
  Painter tiny = {.width = 15, .height = 200, .colour = 0xFF0000};
  g_assert_cmpint(write_film(path, &tiny, 3, NULL, &report), ==, SB_ERROR_RANGE);
  g_assert_nonnull(strstr(report.text, "16"));
  Painter huge = {.width = 8193, .height = 200, .colour = 0xFF0000};
  g_assert_cmpint(write_film(path, &huge, 3, NULL, &report), ==, SB_ERROR_RANGE);
  g_assert_cmpuint(sb_movie_frames(10, 30, 1), ==, 300);
  g_assert_cmpuint(sb_movie_frames(1.0 / 3, 30000, 1001), ==, 10);
  g_assert_cmpuint(sb_movie_frames(0, 30, 1), ==, 1);
  g_free(path);
}

// 7680 x 4320 works; slow, hence not in the fast suite.
static void test_large(void) {
  char *path = in_directory("large.mp4");
  SbReport report = {0};
  Painter painter = {.width = 7680, .height = 4320, .colour = 0xFF0000};
  g_assert_cmpint(write_film(path, &painter, 2, NULL, &report), ==, SB_OK);
  g_free(path);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  directory = g_dir_make_tmp("sealbench-movie-XXXXXX", NULL);
  g_test_add_func("/movie/colour", test_colour);
  g_test_add_func("/movie/tags", test_tags);
  g_test_add_func("/movie/repeatable", test_repeatable);
  g_test_add_func("/movie/cancel", test_cancel);
  g_test_add_func("/movie/kill", test_kill);
  g_test_add_func("/movie/full-disk", test_full_disk);
  g_test_add_func("/movie/sizes", test_sizes);
  if (g_test_slow()) {
    g_test_add_func("/movie/large", test_large);
  }
  int result = g_test_run();
  char *argv_rm[] = {(char *)"rm", (char *)"-rf", directory, NULL};
  g_spawn_sync(NULL, argv_rm, NULL, G_SPAWN_SEARCH_PATH, NULL, NULL, NULL, NULL, NULL, NULL);
  g_free(directory);
  return result;
}
