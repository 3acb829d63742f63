// Lines of a table's bytes, in UTF-8; see text_table_private.h.
#include "app/base/text_table_private.h"

#include <errno.h>
#include <string.h>

static bool is_wide(const SbTextTableLines *lines) {
  return lines->encoding == SB_TEXT_TABLE_UTF16LE || lines->encoding == SB_TEXT_TABLE_UTF16BE;
}

void sb_text_table_seek(SbTextTableLines *lines, size_t from) {
  char mark[3] = "";
  (void)fseeko(lines->stream, (off_t)from, SEEK_SET);
  const size_t got = fread(mark, 1, sizeof mark, lines->stream);
  const bool wide = got >= 2 && is_wide(lines) &&
                    (memcmp(mark, "\xff\xfe", 2) == 0 || memcmp(mark, "\xfe\xff", 2) == 0);
  from += wide ? 2 : got == 3 && memcmp(mark, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
  (void)fseeko(lines->stream, (off_t)from, SEEK_SET);
  lines->left = lines->length - MIN(from, lines->length);
  lines->number = 0;
}

// The next byte, or unit of UTF-16; EOF at the end, or with bytes left where they cannot be read.
static int next_unit(SbTextTableLines *lines) {
  const size_t size = is_wide(lines) ? 2 : 1;
  if (lines->left < size) {
    lines->left = 0;
    return EOF;
  }
  const int one = getc_unlocked(lines->stream);
  const int two = size > 1 ? getc_unlocked(lines->stream) : 0;
  if (one == EOF || two == EOF) {
    return EOF;
  }
  lines->left -= size;
  return lines->encoding == SB_TEXT_TABLE_UTF16BE ? one << 8 | two : one | two << 8;
}

// Converts bytes of an old encoding; without one of their codes, each byte is a character.
static void convert(GString *line, SbTextTableEncoding encoding) {
  gsize length;
  g_autofree char *old = g_strndup(line->str, line->len);
  const gsize old_length = line->len;
  const char *from = encoding == SB_TEXT_TABLE_LATIN1 ? "CP1252"
                     : encoding == SB_TEXT_TABLE_GBK  ? "GB18030"
                                                      : "CP932";
  g_autofree char *known = g_convert(old, (gssize)old_length, "UTF-8", from, NULL, &length, NULL);
  g_string_truncate(line, 0);
  g_string_append_len(line, known, known != NULL ? (gssize)length : 0);
  for (gsize i = 0; known == NULL && i < old_length; i++) {
    g_string_append_unichar(line, (guchar)old[i]);
  }
}

const GString *sb_text_table_next(SbTextTableLines *lines) {
  const bool wide = is_wide(lines);
  bool high = false;
  int unit = EOF;
  if (lines->wrong != NULL || lines->left == 0) {
    return NULL;
  }
  lines->number++;
  g_string_truncate(lines->line, 0);
  while (lines->line->len < SB_TEXT_TABLE_LINE_MAX && (unit = next_unit(lines)) != EOF &&
         unit != lines->line_end) {
    high |= unit >= 0x80;
    if (wide && unit >= 0x80) {
      g_string_append_unichar(lines->line, unit >= 0xd800 && unit < 0xe000 ? '?' : (gunichar)unit);
    } else {
      g_string_append_c(lines->line, (char)unit);
    }
  }
  if (lines->line->len >= SB_TEXT_TABLE_LINE_MAX || (unit == EOF && lines->left > 0)) {
    lines->wrong = unit != EOF             ? "has a line of more than 64 MiB"
                   : ferror(lines->stream) ? g_strerror(errno)
                                           : "was cut short while it was read";
    return NULL;
  }
  while (lines->line->len > 0 && lines->line->str[lines->line->len - 1] == '\r') {
    g_string_truncate(lines->line, lines->line->len - 1);
  }
  const bool old = lines->encoding != SB_TEXT_TABLE_UTF8 && !wide;
  if (old && high && !g_utf8_validate(lines->line->str, (gssize)lines->line->len, NULL)) {
    convert(lines->line, lines->encoding); // programs mix encodings
  }
  return lines->line;
}
