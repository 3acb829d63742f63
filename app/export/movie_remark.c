// Text in the files of animations. See movie_remark.h. All three formats are lists of blocks: the
// text is a block before the last one, or behind it.
#include "app/export/movie_remark.h"

#include <errno.h>
#include <glib.h>
#include <stdio.h>
#include <string.h>

static void put_big(GByteArray *out, uint32_t value) {
  const uint32_t bytes = GUINT32_TO_BE(value);
  g_byte_array_append(out, (const uint8_t *)&bytes, sizeof bytes);
}

static void put_little(GByteArray *out, uint32_t value) {
  const uint32_t bytes = GUINT32_TO_LE(value);
  g_byte_array_append(out, (const uint8_t *)&bytes, sizeof bytes);
}

static void put_text(GByteArray *out, const char *text, size_t length) {
  g_byte_array_append(out, (const uint8_t *)text, (guint)length);
}

// The check sum of a PNG chunk's name and data (PNG 3, annex D).
static uint32_t check_sum(const uint8_t *data, size_t size) {
  uint32_t sum = 0xFFFFFFFFu;
  for (size_t i = 0; i < size; i++) {
    sum ^= data[i];
    for (int bit = 0; bit < 8; bit++) {
      sum = sum >> 1 ^ ((sum & 1) != 0 ? 0xEDB88320u : 0);
    }
  }
  return ~sum;
}

static void put_chunk(GByteArray *out, const char *body, size_t length) {
  put_big(out, (uint32_t)length - 4);
  put_text(out, body, length);
  put_big(out, check_sum((const uint8_t *)body, length));
}

// The chunk and the end of the file, which it replaces.
static void make_apng(GByteArray *out, const char *text) {
  static const char head[] = "iTXtComment\0\0\0\0"; // not compressed, no language; ends with \0
  g_autoptr(GByteArray) body = g_byte_array_new();
  put_text(body, head, sizeof head);
  put_text(body, text, strlen(text));
  put_chunk(out, (const char *)body->data, body->len);
  put_chunk(out, "IEND", 4);
}

static void make_gif(GByteArray *out, const char *text) {
  put_text(out, "\x21\xFE", 2);
  for (size_t left = strlen(text); left > 0;) {
    const uint8_t size = (uint8_t)MIN(left, 255);
    g_byte_array_append(out, &size, 1);
    put_text(out, text, size);
    text += size;
    left -= size;
  }
  put_text(out, "\0\x3B", 2);
}

static void make_webp(GByteArray *out, const char *text) {
  g_autofree char *plain = g_markup_escape_text(text, -1);
  g_autofree char *packet = g_strdup_printf(
      "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
      "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\"><rdf:Description rdf:about=\"\" "
      "xmlns:dc=\"http://purl.org/dc/elements/1.1/\"><dc:description><rdf:Alt><rdf:li "
      "xml:lang=\"x-default\">%s</rdf:li></rdf:Alt></dc:description></rdf:Description></rdf:RDF>"
      "</x:xmpmeta>",
      plain);
  const size_t length = strlen(packet);
  put_text(out, "XMP ", 4);
  put_little(out, (uint32_t)length);
  put_text(out, packet, length + length % 2); // an odd one is padded by its 0
}

// Writes the size of the file into its head, and that it has an XMP chunk.
static bool mark_webp(FILE *file) {
  enum { SIZE_AT = 4, FLAGS_AT = 20, XMP = 4 };
  const long length = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
  const uint32_t size = GUINT32_TO_LE((uint32_t)length - 8);
  int flags = EOF;
  return length > 0 && fseek(file, SIZE_AT, SEEK_SET) == 0 &&
         fwrite(&size, sizeof size, 1, file) == 1 && fseek(file, FLAGS_AT, SEEK_SET) == 0 &&
         (flags = fgetc(file)) != EOF && fseek(file, FLAGS_AT, SEEK_SET) == 0 &&
         fputc(flags | XMP, file) != EOF;
}

static bool has_place(FILE *file, SbMovieFormat format) {
  char head[16];
  return format != SB_MOVIE_WEBP ||
         (fread(head, sizeof head, 1, file) == 1 && memcmp(head + 12, "VP8X", 4) == 0);
}

SbStatus sb_movie_remark(const char *path, SbMovieFormat format, const char *text,
                         SbReport *report) {
  static const struct {
    void (*make)(GByteArray *out, const char *text);
    long end; // bytes of the end of the file that the text replaces
  } how[SB_MOVIE_FORMATS] = {
      [SB_MOVIE_WEBP] = {make_webp, 0},
      [SB_MOVIE_APNG] = {make_apng, 12},
      [SB_MOVIE_GIF] = {make_gif, 1},
  };
  if (how[format].make == NULL) {
    return SB_OK;
  }
  g_autoptr(GByteArray) block = g_byte_array_new();
  how[format].make(block, text);
  FILE *file = fopen(path, "r+be");
  bool good = file != NULL;
  if (good && has_place(file, format)) {
    good = fseek(file, -how[format].end, SEEK_END) == 0 &&
           fwrite(block->data, block->len, 1, file) == 1 &&
           (format != SB_MOVIE_WEBP || mark_webp(file));
  }
  const int wrong = errno;
  if (file != NULL && fclose(file) != 0) {
    return sb_fail(report, SB_ERROR_IO, "writing the film: %s", g_strerror(errno));
  }
  return good ? SB_OK : sb_fail(report, SB_ERROR_IO, "writing the film: %s", g_strerror(wrong));
}
