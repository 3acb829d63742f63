// Reads the scene out of a PNG: the first text chunk under our key before the pixels. No other
// chunk is unpacked, and this one to SB_PICTURE_SCENE_MAX at most. Chunks by the PNG specification,
// third edition, 5.3 and 11.3.3.
#include "app/document/picture.h"

#include <gio/gio.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

// Bytes still to be read.
typedef struct {
  const uint8_t *at;
  size_t left;
} Bytes;

static uint32_t big_endian(const uint8_t *at) {
  return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

// CRC-32 of the specification's annex D, without its table: it is computed of one chunk.
static uint32_t check_sum(const uint8_t *data, size_t length) {
  uint32_t sum = 0xffffffffu;
  for (size_t i = 0; i < length; i++) {
    sum ^= data[i];
    for (int k = 0; k < 8; k++) {
      sum = sum >> 1 ^ (0xedb88320u & (0u - (sum & 1u)));
    }
  }
  return ~sum;
}

static char *unreadable(GError **error, const char *why) {
  g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "not a readable PNG: %s", why);
  return NULL;
}

// What lies packed in `bytes`, as a text.
static char *unpack(Bytes bytes, GError **error) {
  enum { PIECE = 1 << 13 };
  g_autoptr(GZlibDecompressor) zlib = g_zlib_decompressor_new(G_ZLIB_COMPRESSOR_FORMAT_ZLIB);
  g_autoptr(GByteArray) out = g_byte_array_new();
  GConverterResult result = G_CONVERTER_CONVERTED;
  while (result != G_CONVERTER_FINISHED) {
    uint8_t piece[PIECE];
    size_t used = 0, made = 0;
    result = g_converter_convert(G_CONVERTER(zlib), bytes.at, bytes.left, piece, sizeof piece,
                                 G_CONVERTER_INPUT_AT_END, &used, &made, NULL);
    if (result == G_CONVERTER_ERROR || out->len + made > SB_PICTURE_SCENE_MAX) {
      return unreadable(error, "its scene cannot be unpacked");
    }
    g_byte_array_append(out, piece, (guint)made);
    bytes.at += used;
    bytes.left -= used;
  }
  return g_strndup((const char *)out->data, out->len);
}

// Steps over a text and the 0 behind it; false if it does not end.
static bool skip_text(Bytes *bytes) {
  const uint8_t *end = memchr(bytes->at, 0, bytes->left);
  if (end == NULL) {
    return false;
  }
  bytes->left -= (size_t)(end + 1 - bytes->at);
  bytes->at = end + 1;
  return true;
}

static bool skip(Bytes *bytes, size_t count) {
  if (count > bytes->left) {
    return false;
  }
  bytes->at += count;
  bytes->left -= count;
  return true;
}

// The text of a chunk of type `name`.
static char *chunk_text(const char name[4], Bytes bytes, GError **error) {
  bool international = memcmp(name, "iTXt", 4) == 0;
  bool packed = memcmp(name, "zTXt", 4) == 0;
  bool good = skip_text(&bytes);
  if (good && (international || packed)) {
    packed = packed || (bytes.left > 0 && bytes.at[0] == 1);
    good = skip(&bytes, international ? 2 : 1);
    if (good && international) {
      good = skip_text(&bytes) && skip_text(&bytes);
    }
  }
  if (!good) {
    return unreadable(error, "its scene ends too early");
  }
  return packed ? unpack(bytes, error) : g_strndup((const char *)bytes.at, bytes.left);
}

char *sb_picture_find_scene(const void *data, size_t length, GError **error) {
  static const uint8_t start[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n',
                                  0,    0,   0,   13,  'I',  'H',  'D',  'R'};
  enum { SIGNATURE = 8, FRAME = 12 };
  if (length < sizeof start || memcmp(data, start, sizeof start) != 0) {
    return unreadable(error, "it does not begin as one");
  }
  const uint8_t *bytes = data;
  for (size_t at = SIGNATURE; at + FRAME <= length;) {
    const char *name = (const char *)bytes + at + 4;
    size_t chunk = big_endian(bytes + at);
    if (memcmp(name, "IDAT", 4) == 0) {
      break;
    }
    if (chunk > length - at - FRAME) {
      return unreadable(error, "it is cut off");
    }
    bool text = memcmp(name, "iTXt", 4) == 0 || memcmp(name, "tEXt", 4) == 0 ||
                memcmp(name, "zTXt", 4) == 0;
    if (text && chunk >= sizeof SB_PICTURE_SCENE_KEY &&
        memcmp(name + 4, SB_PICTURE_SCENE_KEY, sizeof SB_PICTURE_SCENE_KEY) == 0) {
      if (chunk > SB_PICTURE_SCENE_MAX ||
          check_sum(bytes + at + 4, chunk + 4) != big_endian(bytes + at + 8 + chunk)) {
        return unreadable(error, "its scene is damaged");
      }
      return chunk_text(name, (Bytes){bytes + at + 8, chunk}, error);
    }
    at += chunk + FRAME;
  }
  g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "this PNG contains no scene");
  return NULL;
}
