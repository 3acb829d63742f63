// Animations in WebP, APNG and GIF: number and duration of the pictures, endless repetition, and
// pixels as another program decodes them; nothing is left of a cancelled one.
#include "app/base/identity.h"
#include "app/export/formats.h"
#include "app/export/movie.h"
#include "app/export/quantise.h"

#include "tests/crc.h"

#include <glib.h>
#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

// Longer than a block of GIF, with a character that XML escapes.
#define REMARK_PART "Models: fit ring < 1 and film reynolds; "
#define REMARK      REMARK_PART REMARK_PART REMARK_PART REMARK_PART REMARK_PART REMARK_PART REMARK_PART

enum { WIDTH = 61, HEIGHT = 33, PICTURES = 24 };

static char *directory;

static const SbMovieFormat animations[] = {SB_MOVIE_WEBP, SB_MOVIE_APNG, SB_MOVIE_GIF};

static char *path_of(SbMovieFormat format) {
  static const char *const names[] = {"a.mp4", "a.webp", "a.apng", "a.gif"};
  return g_build_filename(directory, names[format], NULL);
}

// A red ground with a blue bar that moves by one column a picture.
static uint32_t colour_at(size_t picture, int x) {
  return (size_t)x == picture ? 0xFF1959A0u : 0xFFC82814u;
}

typedef struct {
  size_t cancel_at, drawn; // 0: never
} Painter;

static SbStatus paint(void *data, size_t picture, uint8_t *pixels, size_t stride,
                      SbReport *report) {
  Painter *painter = data;
  for (int y = 0; y < HEIGHT; y++) {
    uint32_t *row = (uint32_t *)(void *)(pixels + (size_t)y * stride);
    for (int x = 0; x < WIDTH; x++) {
      row[x] = colour_at(picture, x);
    }
  }
  painter->drawn = picture + 1;
  return SB_OK;
}

static bool cancelled(void *data) {
  const Painter *painter = data;
  return painter->cancel_at > 0 && painter->drawn >= painter->cancel_at;
}

static SbStatus write_animation(SbMovieFormat format, int fps, Painter *painter,
                                SbMovieResult *result, SbReport *report) {
  const SbMovieOptions options = {.format = format,
                                  .width = WIDTH,
                                  .height = HEIGHT,
                                  .fps_num = fps,
                                  .fps_den = 1,
                                  .frames = PICTURES,
                                  .comment = REMARK};
  const SbMovieHooks hooks = {NULL, cancelled, painter};
  g_autofree char *path = path_of(format);
  return sb_movie_write(path, &options, paint, painter, &hooks, result, report);
}

static char *contents(const char *path, gsize *length) {
  char *bytes = NULL;
  g_autoptr(GError) error = NULL;
  g_file_get_contents(path, &bytes, length, &error);
  g_assert_no_error(error);
  return bytes;
}

// What a file contains: pictures, their time in seconds, and how often they are shown (0: without
// end).
typedef struct {
  size_t pictures;
  double seconds;
  unsigned plays;
  GString *remark; // owned
} Content;

static unsigned little(const guint8 *at, int bytes) {
  unsigned value = 0;
  for (int i = bytes - 1; i >= 0; i--) {
    value = value << 8 | at[i];
  }
  return value;
}

static unsigned big(const guint8 *at, int bytes) {
  unsigned value = 0;
  for (int i = 0; i < bytes; i++) {
    value = value << 8 | at[i];
  }
  return value;
}

// WebP container: https://developers.google.com/speed/webp/docs/riff_container
static Content read_webp(const guint8 *data, gsize length) {
  Content content = {.plays = 99, .remark = g_string_new(NULL)};
  bool has_xmp = false;
  g_assert_cmpint(memcmp(data, "RIFF", 4), ==, 0);
  g_assert_cmpuint(little(data + 4, 4) + 8, ==, length);
  for (gsize at = 12; at + 8 <= length;) {
    const guint8 *body = data + at + 8;
    const unsigned size = little(data + at + 4, 4);
    if (memcmp(data + at, "ANIM", 4) == 0) {
      content.plays = little(body + 4, 2);
    } else if (memcmp(data + at, "ANMF", 4) == 0) {
      content.pictures++;
      content.seconds += 1e-3 * little(body + 12, 3);
    } else if (memcmp(data + at, "VP8X", 4) == 0) {
      g_assert_cmpuint(little(body + 4, 3) + 1, ==, WIDTH);
      g_assert_cmpuint(little(body + 7, 3) + 1, ==, HEIGHT);
      has_xmp = (body[0] & 4) != 0;
    } else if (memcmp(data + at, "XMP ", 4) == 0) {
      g_assert_true(has_xmp);
      g_string_append_len(content.remark, (const char *)body, size);
    }
    at += 8 + size + (size & 1);
  }
  return content;
}

// APNG chunks: https://www.w3.org/TR/png-3/
static Content read_apng(const guint8 *data, gsize length) {
  Content content = {.plays = 99, .remark = g_string_new(NULL)};
  unsigned announced = 0;
  for (gsize at = 8; at + 12 <= length; at += 12 + big(data + at, 4)) {
    const guint8 *body = data + at + 8;
    const unsigned size = big(data + at, 4);
    g_assert_cmphex(big(body + size, 4), ==, crc(data + at + 4, size + 4));
    if (memcmp(data + at + 4, "iTXt", 4) == 0) {
      g_assert_cmpint(memcmp(body, "Comment\0\0\0\0", 12), ==, 0);
      g_string_append_len(content.remark, (const char *)body + 12, size - 12);
    }
    if (memcmp(data + at + 4, "acTL", 4) == 0) {
      announced = big(body, 4);
      content.plays = big(body + 4, 4);
    } else if (memcmp(data + at + 4, "fcTL", 4) == 0) {
      content.pictures++;
      content.seconds += (double)big(body + 20, 2) / big(body + 22, 2);
    }
  }
  g_assert_cmpuint(announced, ==, content.pictures);
  return content;
}

// Skips blocks of a length and that many bytes; returns what follows the empty one.
static gsize skip_blocks(const guint8 *data, gsize at) {
  while (data[at] != 0) {
    at += 1u + data[at];
  }
  return at + 1;
}

// GIF89a: https://www.w3.org/Graphics/GIF/spec-gif89a.txt
static Content read_gif(const guint8 *data, gsize length) {
  Content content = {.plays = 99, .remark = g_string_new(NULL)};
  gsize at = 13 + ((data[10] & 0x80) != 0 ? 3u << ((data[10] & 7) + 1) : 0);
  while (at < length && data[at] != 0x3B) {
    if (data[at] == 0x21) {
      if (data[at + 1] == 0xF9) {
        content.seconds += 1e-2 * little(data + at + 4, 2);
      } else if (data[at + 1] == 0xFF && memcmp(data + at + 3, "NETSCAPE2.0", 11) == 0) {
        content.plays = little(data + at + 16, 2);
      } else if (data[at + 1] == 0xFE) {
        for (gsize k = at + 2; data[k] != 0; k += 1u + data[k]) {
          g_string_append_len(content.remark, (const char *)data + k + 1, data[k]);
        }
      }
      at = skip_blocks(data, at + 2);
    } else {
      g_assert_cmpuint(data[at], ==, 0x2C);
      content.pictures++;
      at += 10 + ((data[at + 9] & 0x80) != 0 ? 3u << ((data[at + 9] & 7) + 1) : 0);
      at = skip_blocks(data, at + 1);
    }
  }
  g_assert_cmpuint(at, ==, length - 1);
  return content;
}

static void test_content(void) {
  static Content (*const read[])(const guint8 *, gsize) = {
      [SB_MOVIE_WEBP] = read_webp, [SB_MOVIE_APNG] = read_apng, [SB_MOVIE_GIF] = read_gif};
  for (size_t i = 0; i < G_N_ELEMENTS(animations); i++) {
    const SbMovieFormat format = animations[i];
    g_autofree char *path = path_of(format);
    g_test_message("%s", path);
    Painter painter = {0};
    SbMovieResult result = {0};
    SbReport report = {0};
    g_assert_cmpint(write_animation(format, 12, &painter, &result, &report), ==, SB_OK);
    g_assert_cmpuint(result.frames, ==, PICTURES);
    gsize length = 0;
    g_autofree char *bytes = contents(path, &length);
    const Content content = read[format]((const guint8 *)bytes, length);
    g_assert_cmpuint(content.pictures, ==, PICTURES);
    g_assert_cmpuint(content.plays, ==, 0);
    // 24 pictures at 12 a second; GIF counts in hundredths of a second.
    g_assert_cmpfloat(fabs(content.seconds - 2), <=, 0.02);
    g_autofree char *identity = sb_identity_text();
    g_autofree char *text = g_strconcat(identity, "; ", REMARK, NULL);
    g_autofree char *escaped = g_markup_escape_text(text, -1);
    g_assert_nonnull(strstr(content.remark->str, format == SB_MOVIE_WEBP ? escaped : text));
    g_string_free(content.remark, TRUE);
    g_unlink(path);
  }
}

// The first picture of a WebP as a file of its own, which decoders of stills read.
static void cut_first(const char *path) {
  gsize length = 0;
  g_autofree char *bytes = contents(path, &length);
  const guint8 *data = (const guint8 *)bytes;
  gsize at = 12;
  while (memcmp(data + at, "ANMF", 4) != 0) {
    at += 8 + little(data + at + 4, 4);
  }
  const unsigned size = little(data + at + 4, 4) - 16;
  GByteArray *still = g_byte_array_new();
  const guint32 whole = GUINT32_TO_LE(size + 4);
  g_byte_array_append(still, (const guint8 *)"RIFF", 4);
  g_byte_array_append(still, (const guint8 *)&whole, 4);
  g_byte_array_append(still, (const guint8 *)"WEBP", 4);
  g_byte_array_append(still, data + at + 8 + 16, size);
  g_assert_true(g_file_set_contents(path, (const char *)still->data, still->len, NULL));
  g_byte_array_unref(still);
}

// Pictures as ffmpeg decodes them: all pixels are those that were drawn. Both colours are in the
// palette of GIF, and the other formats lose nothing.
static void test_pixels(void) {
  g_autofree char *found = g_find_program_in_path("ffmpeg");
  if (found == NULL) {
    g_test_skip("ffmpeg is not installed");
    return;
  }
  for (size_t i = 0; i < G_N_ELEMENTS(animations); i++) {
    const SbMovieFormat format = animations[i];
    g_autofree char *path = path_of(format);
    g_autofree char *raw = g_build_filename(directory, "raw", NULL);
    g_test_message("%s", path);
    Painter painter = {0};
    SbReport report = {0};
    g_assert_cmpint(write_animation(format, 12, &painter, NULL, &report), ==, SB_OK);
    size_t pictures = PICTURES;
    if (format == SB_MOVIE_WEBP) { // ffmpeg 5 decodes stills only
      cut_first(path);
      pictures = 1;
    }
    const char *const argv[] = {found,      "-v",        "error",       "-y", "-i",
                                path,       "-fps_mode", "passthrough", "-f", "rawvideo",
                                "-pix_fmt", "rgb24",     raw,           NULL};
    int status = 1;
    g_assert_true(g_spawn_sync(NULL, (char **)argv, NULL, G_SPAWN_DEFAULT, NULL, NULL, NULL, NULL,
                               &status, NULL));
    g_assert_cmpint(status, ==, 0);
    gsize length = 0;
    g_autofree char *bytes = contents(raw, &length);
    g_assert_cmpuint(length, ==, pictures * WIDTH * HEIGHT * 3);
    for (gsize k = 0; k < length / 3; k++) {
      const guint8 *pixel = (const guint8 *)bytes + 3 * k;
      const uint32_t drawn = colour_at(k / (WIDTH * HEIGHT), (int)(k % WIDTH));
      g_assert_cmphex(big(pixel, 3), ==, drawn & 0xFFFFFFu);
    }
    g_unlink(path);
    g_unlink(raw);
  }
}

// A cancelled animation leaves nothing, and an earlier file as it was.
static void test_cancel(void) {
  for (size_t i = 0; i < G_N_ELEMENTS(animations); i++) {
    g_autofree char *path = path_of(animations[i]);
    for (int earlier = 0; earlier < 2; earlier++) {
      if (earlier == 1) {
        g_assert_true(g_file_set_contents(path, "earlier", -1, NULL));
      }
      Painter painter = {.cancel_at = 9};
      SbMovieResult result = {0};
      SbReport report = {0};
      const SbStatus status = write_animation(animations[i], 12, &painter, &result, &report);
      g_assert_cmpint(status, ==, SB_ERROR_CANCELLED);
      g_assert_cmpuint(result.frames, ==, 0);
      g_assert_false(result.partial);
      g_autoptr(GDir) dir = g_dir_open(directory, 0, NULL);
      size_t files = 0;
      while (g_dir_read_name(dir) != NULL) {
        files++;
      }
      g_assert_cmpuint(files, ==, earlier);
    }
    gsize length = 0;
    g_autofree char *text = contents(path, &length);
    g_assert_cmpstr(text, ==, "earlier");
    g_unlink(path);
  }
}

// GIF has delays of whole hundredths of a second.
static void test_rate(void) {
  Painter painter = {0};
  SbReport report = {0};
  g_assert_cmpint(write_animation(SB_MOVIE_GIF, 51, &painter, NULL, &report), ==, SB_ERROR_RANGE);
  g_assert_nonnull(strstr(report.text, "1/1000 to 50"));
  g_assert_cmpint(write_animation(SB_MOVIE_GIF, 50, &painter, NULL, &report), ==, SB_OK);
  g_autofree char *path = path_of(SB_MOVIE_GIF);
  g_unlink(path);
}

// Few colours stay exact, however many pixels the others have; many colours are as close as 255
// entries can be: a ramp of red over blue has 256 x 256 colours, of which an entry stands for 16 x
// 16, so that none is further than 16 from its entry in either channel.
static void test_palette(void) {
  enum { SIDE = 256 };
  g_autofree uint32_t *pixels = g_new(uint32_t, SIDE * SIDE);
  g_autofree uint8_t *index = g_new(uint8_t, SIDE * SIDE);
  SbQuantiser *quantiser = sb_quantiser_create();
  for (int i = 0; i < SIDE * SIDE; i++) {
    pixels[i] = i % 1000 == 0 ? 0xFF010203u : i % 7 == 0 ? 0xFFFEFDFCu : 0xFFFFFFFFu;
  }
  const uint32_t *entry =
      sb_quantise(quantiser, index, SIDE, (const uint8_t *)pixels, 4 * SIDE, SIDE, SIDE);
  for (int i = 0; i < SIDE * SIDE; i++) {
    // White and near white share a bin of 8 values a channel: the larger number wins.
    g_assert_cmphex(entry[index[i]], ==, i % 1000 == 0 ? 0xFF010203u : 0xFFFFFFFFu);
    pixels[i] = 0xFF008000u | (uint32_t)(i % SIDE) << 16 | (uint32_t)(i / SIDE);
  }
  // A picture of other colours makes another palette.
  entry = sb_quantise(quantiser, index, SIDE, (const uint8_t *)pixels, 4 * SIDE, SIDE, SIDE);
  for (int i = 0; i < SIDE * SIDE; i++) {
    g_assert_cmpuint(index[i], <, 255);
    for (int shift = 0; shift < 24; shift += 8) {
      const int by = (int)(entry[index[i]] >> shift & 0xFF) - (int)(pixels[i] >> shift & 0xFF);
      g_assert_cmpint(ABS(by), <=, 16);
    }
  }
  sb_quantiser_destroy(quantiser);
}

static void test_formats(void) {
  g_autofree char *all = sb_export_endings(SB_FORMAT_ALL, 0, ", ", " or ");
  g_assert_cmpstr(all, ==, ".png, .svg, .pdf, .mp4, .webp, .apng or .gif");
  g_autofree char *films = sb_export_endings(1 << SB_FORMAT_FILM, 1, "|", "|");
  g_assert_cmpstr(films, ==, "mp4|webp|apng|gif");
  g_assert_cmpint(sb_export_format("a/b.WebP")->film, ==, SB_MOVIE_WEBP);
  g_assert_null(sb_export_format("webp"));
  g_assert_null(sb_export_format("a.bmp"));
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  directory = g_dir_make_tmp("sealbench-animation-XXXXXX", NULL);
  g_test_add_func("/animation/content", test_content);
  g_test_add_func("/animation/pixels", test_pixels);
  g_test_add_func("/animation/cancel", test_cancel);
  g_test_add_func("/animation/rate", test_rate);
  g_test_add_func("/animation/palette", test_palette);
  g_test_add_func("/animation/formats", test_formats);
  const int failures = g_test_run();
  g_rmdir(directory);
  g_free(directory);
  return failures;
}
