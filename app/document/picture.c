// Reads the scene out of a PNG. Only the chunks that it needs reach libpng; see picture.h.
#include "app/document/picture.h"

#include <string.h>

void sb_png_failed(png_structp png, png_const_charp text) {
  SbPngFailure *failure = png_get_error_ptr(png);
  g_strlcpy(failure->text, text, sizeof failure->text);
  longjmp(failure->back, 1);
}

void sb_png_warned(png_structp png, png_const_charp text) {}

// What of the file is still to be read.
typedef struct {
  const guchar *at;
  size_t left;
} PngBytes;

static void png_take_bytes(png_structp png, png_bytep data, png_size_t length) {
  PngBytes *bytes = png_get_io_ptr(png);
  if (length > bytes->left) {
    png_error(png, "it ends too early");
  }
  memcpy(data, bytes->at, length);
  bytes->at += length;
  bytes->left -= length;
}

// A picture of the same head and, of its other chunks before the pixels, only the first text under
// our key: libpng would unpack any number of others, each up to its limit. NULL if a chunk is
// longer than the file: libpng takes memory for that, up to gigabytes, before it looks for the
// bytes.
static GByteArray *keep_scene_chunk(const guchar *data, size_t length) {
  enum { SIGNATURE = 8, FRAME = 12 };
  GByteArray *kept = g_byte_array_new();
  g_byte_array_append(kept, data, (guint)MIN(length, SIGNATURE));
  bool found = false;
  for (size_t at = SIGNATURE; at + FRAME <= length;) {
    const guchar *name = data + at + 4;
    size_t chunk = (size_t)data[at] << 24 | (size_t)data[at + 1] << 16 | (size_t)data[at + 2] << 8 |
                   data[at + 3];
    if (memcmp(name, "IDAT", 4) == 0) {
      g_byte_array_append(kept, data + at, FRAME - 4); // where libpng stops
      break;
    }
    if (chunk > length - at - FRAME) {
      g_byte_array_unref(kept);
      return NULL;
    }
    bool text = memcmp(name, "iTXt", 4) == 0 || memcmp(name, "tEXt", 4) == 0 ||
                memcmp(name, "zTXt", 4) == 0;
    bool ours = text && !found && chunk >= sizeof SB_PICTURE_SCENE_KEY &&
                memcmp(name + 4, SB_PICTURE_SCENE_KEY, sizeof SB_PICTURE_SCENE_KEY) == 0;
    if (ours || memcmp(name, "IHDR", 4) == 0 || memcmp(name, "PLTE", 4) == 0) {
      found = found || ours;
      g_byte_array_append(kept, data + at, (guint)(chunk + FRAME));
    }
    at += chunk + FRAME;
  }
  return kept;
}

char *sb_picture_find_scene(const void *data, size_t length, GError **error) {
  GByteArray *kept = keep_scene_chunk(data, length);
  if (kept == NULL) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "not a readable PNG: it is cut off");
    return NULL;
  }
  SbPngFailure failure = {.text = ""};
  png_structp png =
      png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure, sb_png_failed, sb_png_warned);
  png_infop info = png ? png_create_info_struct(png) : NULL;
  if (!info) {
    png_destroy_read_struct(&png, NULL, NULL);
    g_byte_array_unref(kept);
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO, "no memory for the picture");
    return NULL;
  }
  if (setjmp(failure.back)) {
    png_destroy_read_struct(&png, &info, NULL);
    g_byte_array_unref(kept);
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "not a readable PNG: %s", failure.text);
    return NULL;
  }
  PngBytes bytes = {kept->data, kept->len};
  png_set_read_fn(png, &bytes, png_take_bytes);
  png_set_chunk_malloc_max(png, 4000000);
  png_read_info(png, info);
  png_textp text = NULL;
  int count = 0;
  char *found = NULL;
  png_get_text(png, info, &text, &count);
  if (count > 0 && text[0].text) {
    found = g_strdup(text[0].text);
  }
  png_destroy_read_struct(&png, &info, NULL);
  g_byte_array_unref(kept);
  if (!found) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "this PNG holds no scene");
  }
  return found;
}
