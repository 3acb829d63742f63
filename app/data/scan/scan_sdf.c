// Surface data files (ISO 25178-71, before it BCR): a header, then NumProfiles rows of NumPoints
// heights. The text form, aISO-1.0, has lines "Key = value" and ends its parts by "*"; the binary
// form, bISO-1.0, has a header of 81 bytes and little-endian numbers. Scales are in metres; heights
// are numbers times Zscale. BAD, NaN and the smallest signed integer are missing points. Leaves out
// compressed data and the check sum.
#include "app/data/scan/scan_private.h"

#include "app/base/text_table.h"

#include <math.h>

enum { COLUMNS, ROWS, X_STEP, Y_STEP, Z_STEP, Z_RESOLUTION, COMPRESSION, TYPE, CHECK, KEYS };
enum { HEADER = 81, VERSION = 8, TYPES = 8 };

// Keys, and the places of their values in the binary header.
static const struct {
  const char *name;
  gsize at, size;
} keys[KEYS] = {{"NumPoints", 42, 2},   {"NumProfiles", 44, 2}, {"Xscale", 46, 8},
                {"Yscale", 54, 8},      {"Zscale", 62, 8},      {"Zresolution", 70, 8},
                {"Compression", 78, 1}, {"DataType", 79, 1},    {"CheckType", 80, 1}};
static const gsize sizes[TYPES] = {1, 2, 4, 4, 1, 2, 4, 8};

// Moves to the end of the next word and returns its start; NULL at the end.
static const char *next_word(const char **at, const char *end) {
  const char *start = *at;
  while (start < end && g_ascii_isspace(*start)) {
    start++;
  }
  for (*at = start; *at < end && !g_ascii_isspace(**at) && **at != '=';) {
    ++*at;
  }
  return start < end ? start : NULL;
}

// Reads the lines "Key = value" up to the one that is "*".
static void read_keys(double *value, const char **at, const char *end) {
  for (const char *word; (word = next_word(at, end)) != NULL && *word != '*';) {
    const gsize length = (gsize)(*at - word);
    while (*at < end && (**at == ' ' || **at == '\t' || **at == '=')) {
      ++*at;
    }
    for (int k = 0; k < KEYS; k++) {
      if (strlen(keys[k].name) == length && g_ascii_strncasecmp(word, keys[k].name, length) == 0) {
        g_autofree char *text = g_strndup(*at, MIN((gsize)(end - *at), 40));
        (void)sb_text_table_number_at(&value[k], text, '.');
      }
    }
    while (*at < end && **at != '\n' && **at != '\r') {
      ++*at;
    }
  }
}

static double read_binary(const guchar *p, int type) {
  switch (type) {
  case 0:
    return *p;
  case 1:
    return sb_scan_u16(p);
  case 2:
    return sb_scan_u32(p);
  case 3:
    return sb_scan_float(p);
  case 4:
    return *p == 0x80 ? NAN : (double)(gint8)*p;
  case 5:
    return sb_scan_u16(p) == 0x8000 ? NAN : (double)(gint16)sb_scan_u16(p);
  case 6:
    return sb_scan_u32(p) == 0x80000000u ? NAN : (double)(gint32)sb_scan_u32(p);
  default:
    return sb_scan_double(p);
  }
}

gboolean sb_scan_parse_sdf(SbScan *out, SbScanBytes bytes, const SbScanChoices *choices,
                           GError **error) {
  const char *at = (const char *)bytes.at + VERSION, *const end = (const char *)bytes.end;
  const gsize length = (gsize)(bytes.end - bytes.at);
  const gboolean text = *bytes.at == 'a';
  double value[KEYS];
  out->format = "surface data file";
  for (int k = 0; k < KEYS; k++) {
    const guchar *p = bytes.at + keys[k].at;
    value[k] = text || length < HEADER ? NAN
               : keys[k].size == 8     ? sb_scan_double(p)
               : keys[k].size == 2     ? sb_scan_u16(p)
                                       : *p;
  }
  if (text) {
    read_keys(value, &at, end);
    at += at < end; // the mark behind the header
  }
  if (!(value[COLUMNS] >= 1 && value[ROWS] >= 1 && value[COLUMNS] <= 65535 &&
        value[ROWS] <= 65535 && isfinite(value[Z_STEP]) && value[Z_STEP] != 0)) {
    return sb_scan_fail(error, bytes.name, "has no NumPoints, NumProfiles or Zscale");
  }
  const guint64 columns = (guint64)value[COLUMNS], rows = (guint64)value[ROWS];
  const int type = value[TYPE] >= 0 && value[TYPE] < TYPES ? (int)value[TYPE] : text ? 7 : -1;
  if (type < 0 || value[COMPRESSION] > 0) {
    return sb_scan_fail(error, bytes.name, "has compressed data or an unknown data type");
  }
  const gsize room = text ? (gsize)(end - at) / 2 + 1 : (length - HEADER) / sizes[type];
  if (columns * rows > room) {
    return sb_scan_fail(error, bytes.name,
                        "is cut short: %" G_GUINT64_FORMAT " x %" G_GUINT64_FORMAT
                        " points announced",
                        columns, rows);
  }
  if (!sb_scan_allocate(out, columns, rows, bytes.name, error)) {
    return FALSE;
  }
  for (guint64 i = 0; i < columns * rows; i++) {
    double number = NAN;
    const char *word = text ? next_word(&at, end) : NULL;
    if (text && (word == NULL || *word == '*')) {
      return sb_scan_fail(error, bytes.name,
                          "is cut short: %" G_GUINT64_FORMAT " points of %" G_GUINT64_FORMAT, i,
                          columns * rows);
    }
    if (text) {
      g_autofree char *copy = g_strndup(word, MIN((gsize)(at - word), 40));
      if (sb_text_table_number_at(&number, copy, '.') == 0 &&
          g_ascii_strcasecmp(copy, "BAD") != 0 && g_ascii_strcasecmp(copy, "NaN") != 0) {
        return sb_scan_fail(error, bytes.name, "numbers expected, not \"%s\"", copy);
      }
    } else {
      number = read_binary(bytes.at + HEADER + i * sizes[type], type);
    }
    out->heights.z[i] = number * value[Z_STEP];
  }
  out->heights.dx = value[X_STEP];
  out->heights.dy = value[Y_STEP];
  return TRUE;
}
