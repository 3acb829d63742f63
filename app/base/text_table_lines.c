// Lines of a table's bytes; see text_table_private.h.
#include "app/base/text_table_private.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

enum { PIECE = 1 << 18 };

static bool refuse(SbTextTableLines *lines, const char *why) {
  lines->wrong = why;
  lines->left = 0;
  return false;
}

// Reads on behind what is at hand, which moves to the start of the piece; false where nothing is
// left.
static bool read_on(SbTextTableLines *lines) {
  const size_t kept = (size_t)(lines->end - lines->at);
  if (lines->left == 0) {
    return false;
  }
  if (kept >= SB_TEXT_TABLE_LINE_MAX) {
    return refuse(lines, "has a line of more than 16 MiB");
  }
  if (lines->piece != NULL) {
    memmove(lines->piece, lines->at, kept);
  }
  if (2 * kept >= lines->room) {
    lines->room = MAX(2 * lines->room, PIECE);
    lines->piece = g_realloc(lines->piece, lines->room);
  }
  ssize_t got;
  do {
    got = pread(lines->bytes->file, lines->piece + kept, MIN(lines->room - kept, lines->left),
                (off_t)(lines->bytes->length - lines->left));
  } while (got < 0 && errno == EINTR);
  lines->at = lines->piece;
  lines->end = lines->piece + kept + MAX(got, 0);
  lines->left -= (size_t)MAX(got, 0);
  return got > 0 || refuse(lines, got < 0 ? g_strerror(errno) : "was cut short while it was read");
}

void sb_text_table_lines_init(SbTextTableLines *lines, const SbTextTableBytes *bytes, size_t from,
                              SbTextTableEncoding encoding) {
  const bool wide = encoding == SB_TEXT_TABLE_UTF16LE || encoding == SB_TEXT_TABLE_UTF16BE;
  *lines = (SbTextTableLines){.bytes = bytes,
                              .encoding = encoding,
                              .line_end = '\n',
                              .wide = wide ? g_string_new(NULL) : NULL};
  if (bytes->file < 0) {
    lines->at = bytes->bytes + from;
    lines->end = bytes->bytes + bytes->length;
  } else {
    lines->left = bytes->length - from;
    (void)read_on(lines);
  }
  const size_t length = (size_t)(lines->end - lines->at);
  if (wide && length >= 2) {
    const int first = encoding == SB_TEXT_TABLE_UTF16LE ? 0 : 1;
    lines->at += lines->at[first] == 0xff && lines->at[1 - first] == 0xfe ? 2 : 0;
  } else if (length >= 3 && memcmp(lines->at, "\xef\xbb\xbf", 3) == 0) {
    lines->at += 3;
  }
  if (!wide) {
    const size_t looked = MIN((size_t)(lines->end - lines->at), 65536);
    const bool old = looked > 0 && memchr(lines->at, '\n', looked) == NULL &&
                     memchr(lines->at, '\r', looked) != NULL;
    lines->line_end = old ? '\r' : '\n';
  }
}

void sb_text_table_lines_clear(SbTextTableLines *lines) {
  g_free(lines->piece);
  if (lines->wide != NULL) {
    g_string_free(lines->wide, TRUE);
  }
}

size_t sb_text_table_lines_place(const SbTextTableLines *lines) {
  return lines->bytes->length - lines->left - (size_t)(lines->end - lines->at);
}

static void next_wide(SbTextTableLines *lines) {
  const int low = lines->encoding == SB_TEXT_TABLE_UTF16LE ? 0 : 1;
  GString *out = lines->wide;
  g_string_truncate(out, 0);
  while (lines->end - lines->at >= 2 || read_on(lines)) {
    if (lines->end - lines->at < 2) {
      continue;
    }
    const guint unit = (guint)lines->at[low] | (guint)lines->at[1 - low] << 8;
    lines->at += 2;
    if (unit == '\n') {
      return;
    }
    if (out->len >= SB_TEXT_TABLE_LINE_MAX) {
      (void)refuse(lines, "has a line of more than 16 MiB");
      break;
    }
    if (unit < 0x80) {
      g_string_append_c(out, (char)unit);
    } else {
      g_string_append_unichar(out, unit >= 0xd800 && unit < 0xe000 ? '?' : unit);
    }
  }
  lines->at = lines->end;
}

// Up to the line's end, or the last byte's.
static const guint8 *find_end(SbTextTableLines *lines) {
  for (size_t looked = 0;;) {
    const size_t known = (size_t)(lines->end - lines->at);
    const guint8 *stop =
        known > looked ? memchr(lines->at + looked, lines->line_end, known - looked) : NULL;
    if (stop != NULL || !read_on(lines)) {
      return stop;
    }
    looked = known;
  }
}

bool sb_text_table_next(SbTextTableLines *lines, const char **text, size_t *length) {
  if (lines->wrong != NULL || (lines->at >= lines->end && !read_on(lines))) {
    return false;
  }
  lines->number++;
  if (lines->wide != NULL) {
    next_wide(lines);
    *text = lines->wide->str;
    *length = lines->wide->len;
  } else {
    const guint8 *stop = find_end(lines);
    const guint8 *last = stop != NULL ? stop : lines->end;
    *text = (const char *)lines->at;
    *length = (size_t)(last - lines->at);
    lines->at = stop != NULL ? stop + 1 : lines->end;
  }
  while (*length > 0 && (*text)[*length - 1] == '\r') {
    --*length;
  }
  return lines->wrong == NULL;
}
