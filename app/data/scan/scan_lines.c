// Text files of numbers: lines, header entries, numbers. What separates numbers is blanks, tabs,
// semicolons or commas; a comma between digits is the decimal mark where there are no points and
// something else separates. Two tabs, semicolons or commas without a number between them miss one.
#include "app/data/scan/scan_private.h"

#include "app/base/number.h"
#include "app/base/text_table.h"

#include <math.h>

enum { HEADER_MAX = 1000, LINE_MAX_BYTES = 4096 };

static void entry_free(gpointer data) {
  SbScanEntry *entry = data;
  g_free(entry->key);
  g_free(entry->value);
  g_free(entry->unit);
  g_free(entry);
}

void sb_scan_text_clear(SbScanText *text) {
  g_ptr_array_unref(text->entries);
  g_ptr_array_unref(text->units);
  g_array_unref(text->numbers);
}

// ---- Numbers ----

static gboolean is_separator(guchar c) {
  return c == ' ' || c == '\t' || c == ',' || c == ';';
}

// What instruments write where there is no height.
static gboolean is_missing(const guchar *word, gsize length) {
  static const char *const words[] = {"nan",  "-nan", "bad", "void", "nodata",  "null",   "inf",
                                      "-inf", "*",    "***", "---",  "1.#qnan", "-1.#ind"};
  for (gsize i = 0; i < G_N_ELEMENTS(words); i++) {
    if (strlen(words[i]) == length &&
        g_ascii_strncasecmp((const char *)word, words[i], length) == 0) {
      return TRUE;
    }
  }
  return FALSE;
}

// Numbers at the end of single precision mark void points.
static const double void_low = 0x1p127 * (1 - 1e-4), void_high = 0x1p128;

// Adds a line's numbers; how many, -1 for a line that is not numbers alone (then none are added).
// *open: a tab, semicolon or comma ends it, behind which a number may be missing.
static gint64 take_row(GArray *numbers, gboolean *open, const guchar *p, const guchar *end,
                       char decimal) {
  const guint before = numbers->len;
  const double none = NAN;
  gboolean wants = TRUE; // a hard separator or the line's begin came last
  while (p < end && numbers->len - before <= SB_HEIGHTS_POINTS_MAX) {
    if (is_separator(*p) && *p != (guchar)decimal) {
      if (*p != ' ') {
        if (wants && numbers->len > before) {
          g_array_append_val(numbers, none);
        }
        wants = TRUE;
      }
      p++;
      continue;
    }
    double value = NAN;
    const guchar *stop = p;
    while (stop < end && (!is_separator(*stop) || *stop == (guchar)decimal)) {
      stop++;
    }
    const gsize length = (gsize)(stop - p);
    if (!is_missing(p, length) &&
        !sb_text_table_number_of(&value, (const char *)p, length, decimal)) {
      g_array_set_size(numbers, before);
      return -1;
    }
    if (fabs(value) >= void_low && fabs(value) <= void_high) {
      value = NAN;
    }
    g_array_append_val(numbers, value);
    wants = FALSE;
    p = stop;
  }
  *open = wants;
  return (gint64)(numbers->len - before);
}

// The decimal mark of what begins like numbers in the first million bytes; 0 with an error where
// all lines read in two ways.
static char find_decimal(const SbScanBytes *bytes, GError **error) {
  const guchar *stop = bytes->end - bytes->at > 1 << 20 ? bytes->at + (1 << 20) : bytes->end;
  gsize lines = 0, commas = 0, points = 0, others = 0;
  for (const guchar *p = bytes->at; p < stop;) {
    const guchar *end = memchr(p, '\n', (gsize)(stop - p));
    end = end != NULL ? end : stop;
    while (p < end && g_ascii_isspace(*p)) {
      p++;
    }
    gboolean number = p < end && (g_ascii_isdigit(*p) || *p == '-' || *p == '+' || *p == '.');
    lines += number;
    for (guchar before = '\0'; number && p < end; before = *p++) {
      const guchar next = p + 1 < end ? p[1] : '\0';
      commas += *p == ',' && g_ascii_isdigit(before) && g_ascii_isdigit(next);
      points += *p == '.';
      others += *p == '\t' || *p == ';' || (*p == ' ' && next > ' ' && before != ',');
    }
    p = end + (end < stop);
  }
  if (commas == 0 || points > 0) {
    return '.';
  }
  if (others == 0 && commas == lines) {
    sb_scan_fail(error, bytes->name,
                 "is ambiguous: one column with decimal commas or two "
                 "columns of whole numbers; write decimal points, or separate by semicolons");
    return 0;
  }
  return others > 0 ? ',' : '.';
}

// ---- Header ----

// Text in the first brackets of a word, removed there; empty without. Owned by the caller.
static char *take_brackets(char *text) {
  char *open = strpbrk(text, "[(");
  char *close = open != NULL ? strpbrk(open, "])") : NULL;
  if (close == NULL) {
    return g_strdup("");
  }
  char *inside = g_strstrip(g_strndup(open + 1, (gsize)(close - open - 1)));
  memmove(open, close + 1, strlen(close + 1) + 1);
  return inside;
}

// "Width: 5 µm", "x-pixels = 512", "ncols 512".
static void take_entry(SbScanText *out, const char *line) {
  gsize at = strcspn(line, "=:");
  if (line[at] == '\0') {
    at = strcspn(line, " \t");
  }
  if (line[at] == '\0' || at == 0) {
    return;
  }
  g_autofree char *key = g_strndup(line, at);
  SbScanEntry *entry = g_new0(SbScanEntry, 1);
  entry->unit = take_brackets(key);
  GString *plain = g_string_new(NULL);
  for (const char *c = key; *c != '\0'; c++) {
    if (g_ascii_isalnum(*c)) {
      g_string_append_c(plain, g_ascii_tolower(*c));
    }
  }
  entry->key = g_string_free(plain, FALSE);
  entry->value = g_strstrip(g_strdup(line + at + 1));
  double ignored;
  const gsize number = sb_number_read(&ignored, entry->value);
  if (number > 0 && *entry->unit == '\0') {
    g_free(entry->unit);
    entry->unit = g_strstrip(g_strdup(entry->value + number));
  }
  g_ptr_array_add(out->entries, entry);
}

// "x [mm], z [µm]", "X (mm);Z (µm)": the units of a line's columns in place of those before.
static void take_units(SbScanText *out, const char *line) {
  g_autofree char *copy = g_strdup(line);
  g_autoptr(GPtrArray) units = g_ptr_array_new_with_free_func(g_free);
  for (char *unit; *(unit = take_brackets(copy)) != '\0' || (g_free(unit), FALSE);) {
    g_ptr_array_add(units, unit);
  }
  if (units->len > 0) {
    g_ptr_array_unref(out->units);
    out->units = g_steal_pointer(&units);
  }
}

static void take_header(SbScanText *out, const guchar *p, const guchar *end) {
  while (p < end && strchr("#;%!/ \t", *p) != NULL && *p != '\0') {
    p++;
  }
  const gsize length = MIN((gsize)(end - p), LINE_MAX_BYTES);
  if (length == 0 || out->entries->len >= HEADER_MAX) {
    return;
  }
  g_autofree char *line = g_strndup((const char *)p, length);
  if (!g_utf8_validate(line, -1, NULL)) {
    char *converted = g_convert(line, -1, "UTF-8", "ISO-8859-1", NULL, NULL, NULL);
    if (converted == NULL) {
      return;
    }
    g_free(line);
    line = converted;
  }
  take_entry(out, line);
  if (strchr(line, '=') == NULL) {
    take_units(out, line);
  }
}

// ---- All of it ----

static gboolean read_lines(SbScanText *out, SbScanBytes bytes, GError **error) {
  const char decimal = find_decimal(&bytes, error);
  if (decimal == 0) {
    return FALSE;
  }
  int line = 0;
  for (const guchar *p = bytes.at; p < bytes.end;) {
    const guchar *next = memchr(p, '\n', (gsize)(bytes.end - p));
    const guchar *end = next != NULL ? next : bytes.end, *begin = p;
    p = next != NULL ? next + 1 : bytes.end;
    line++;
    while (end > begin && (end[-1] == '\r' || end[-1] == ' ')) {
      end--;
    }
    while (begin < end && *begin == ' ') {
      begin++;
    }
    if (begin == end) {
      continue;
    }
    const gboolean comment = strchr("#%!", *begin) != NULL;
    gboolean open = FALSE;
    gint64 count = comment ? -1 : take_row(out->numbers, &open, begin, end, decimal);
    if (open && out->rows > 0 && count + 1 == (gint64)out->columns) {
      const double none = NAN;
      g_array_append_val(out->numbers, none);
      count++;
    }
    if (count < 0 && !comment && out->rows > 0) {
      return sb_scan_fail(error, out->name, "line %d: numbers expected, not \"%.*s\"", line,
                          (int)MIN(end - begin, 40), (const char *)begin);
    }
    if (count < 0 && out->rows == 0) {
      take_header(out, begin, end);
    }
    if (count > 0) {
      out->columns = out->rows == 0 ? (gsize)count : out->columns;
      out->ragged = out->ragged == 0 && (gsize)count != out->columns ? line : out->ragged;
      out->rows++;
    }
    const gint64 most = SB_HEIGHTS_POINTS_MAX;
    if (count > most || out->numbers->len > 3 * most) {
      return sb_scan_fail(error, out->name, "has too many numbers");
    }
  }
  return out->rows > 0 || sb_scan_fail(error, out->name, "is not a scan: it contains no numbers");
}

gboolean sb_scan_text_read(SbScanText *out, SbScanBytes bytes, GError **error) {
  *out = (SbScanText){.name = bytes.name,
                      .entries = g_ptr_array_new_with_free_func(entry_free),
                      .units = g_ptr_array_new_with_free_func(g_free),
                      .numbers = g_array_new(FALSE, FALSE, sizeof(double))};
  const gsize length = (gsize)(bytes.end - bytes.at);
  const gboolean wide =
      length >= 2 && (memcmp(bytes.at, "\xff\xfe", 2) == 0 || memcmp(bytes.at, "\xfe\xff", 2) == 0);
  g_autofree char *converted = NULL;
  if (wide) {
    gsize count = 0;
    converted =
        g_convert((const char *)bytes.at, (gssize)length, "UTF-8", "UTF-16", NULL, &count, NULL);
    if (converted == NULL) {
      return sb_scan_fail(error, out->name, "is not sound UTF-16");
    }
    bytes.at = (const guchar *)converted;
    bytes.end = bytes.at + count;
  } else if (length >= 3 && memcmp(bytes.at, "\xef\xbb\xbf", 3) == 0) {
    bytes.at += 3;
  }
  if (bytes.at < bytes.end && memchr(bytes.at, '\0', (gsize)(bytes.end - bytes.at)) != NULL) {
    return sb_scan_fail(error, out->name, "is not a scan that is known (text, .gwy, .sur or .x3p)");
  }
  return read_lines(out, bytes, error);
}
