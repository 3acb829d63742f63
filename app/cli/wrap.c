// Wraps lines at words; see the header.
#include "app/cli/wrap.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { COLUMNS_DEFAULT = 80, COLUMNS_LEAST = 20, INDENT = 4 };

int sb_wrap_columns(int fd) {
  struct winsize size = {0};
  if (isatty(fd) == 0) {
    return 0;
  }
  return ioctl(fd, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : COLUMNS_DEFAULT;
}

static int char_width(gunichar c) {
  return g_unichar_iszerowidth(c) ? 0 : g_unichar_iswide(c) ? 2 : 1;
}

// Columns of the first `length` bytes.
static int width_of(const char *text, size_t length) {
  int width = 0;
  for (const char *c = text; c < text + length && *c != '\0'; c = g_utf8_next_char(c)) {
    width += char_width(g_utf8_get_char(c));
  }
  return width;
}

int sb_wrap_width(const char *text) {
  return width_of(text, strlen(text));
}

// Where continuation lines begin: under the last column, which follows at least two spaces, if that
// leaves half of the line; else further right than the line itself.
static int hanging_indent(const char *text, int columns) {
  const size_t first = strspn(text, " ");
  int indent = (int)first + INDENT;
  for (const char *gap = strstr(text + first, "  "); gap != NULL; gap = strstr(gap, "  ")) {
    gap += strspn(gap, " ");
    const int at = width_of(text, (size_t)(gap - text));
    if (*gap != '\0' && at <= columns / 2) {
      indent = at;
    }
  }
  return MIN(indent, columns / 2);
}

// Bytes of the part that goes on the present line: up to the last space within `room` columns; a
// word that is longer than the line stays whole.
static size_t fitting(const char *text, int room) {
  size_t fits = 0;
  for (const char *end = text; *end != '\0';) {
    const char *next = end + strspn(end, " ");
    next += strcspn(next, " ");
    if (fits > 0 && width_of(text, (size_t)(next - text)) > room) {
      break;
    }
    fits = (size_t)(next - text);
    end = next;
  }
  return fits;
}

char *sb_wrap_line(const char *text, int columns) {
  if (columns < COLUMNS_LEAST || strchr(text, '\033') != NULL || !g_utf8_validate(text, -1, NULL) ||
      sb_wrap_width(text) <= columns) {
    return g_strdup(text);
  }
  const int indent = hanging_indent(text, columns);
  GString *out = g_string_new(NULL);
  int room = columns;
  for (const char *at = text; *at != '\0';) {
    const size_t bytes = fitting(at, room);
    g_string_append_len(out, at, (gssize)bytes);
    at += bytes;
    at += strspn(at, " ");
    if (*at != '\0') {
      g_string_append_printf(out, "\n%*s", indent, "");
      room = columns - indent;
    }
  }
  return g_string_free(out, FALSE);
}

// ---- Standard output ----

static struct {
  GString *line; // without an end so far; NULL: lines are not wrapped
  int fd;
} output;

static bool write_all(const char *text, size_t length) {
  while (length > 0) {
    const ssize_t written = write(output.fd, text, length);
    if (written < 0 && errno != EINTR) {
      return false;
    }
    text += MAX(written, 0);
    length -= (size_t)MAX(written, 0);
  }
  return true;
}

static bool write_line(const char *end) {
  g_autofree char *wrapped = sb_wrap_line(output.line->str, sb_wrap_columns(output.fd));
  g_string_truncate(output.line, 0);
  return write_all(wrapped, strlen(wrapped)) && write_all(end, strlen(end));
}

static ssize_t on_write(void *cookie, const char *text, size_t length) {
  for (const char *at = text, *end = text + length; at < end;) {
    const char *stop = memchr(at, '\n', (size_t)(end - at));
    g_string_append_len(output.line, at, stop != NULL ? stop - at : end - at);
    if (stop != NULL && !write_line("\n")) {
      return 0;
    }
    at = stop != NULL ? stop + 1 : end;
  }
  return (ssize_t)length;
}

void sb_wrap_standard_output(void) {
  if (sb_wrap_columns(STDOUT_FILENO) == 0) {
    return;
  }
  FILE *stream = fopencookie(NULL, "w", (cookie_io_functions_t){.write = on_write});
  if (stream != NULL) {
    output.fd = STDOUT_FILENO;
    output.line = g_string_new(NULL);
    setvbuf(stream, NULL, _IOLBF, BUFSIZ);
    stdout = stream;
  }
}

void sb_wrap_end(void) {
  if (output.line != NULL && output.line->len > 0) {
    (void)write_line("");
  }
}
