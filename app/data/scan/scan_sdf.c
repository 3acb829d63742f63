// Surface data files (ISO 25178-71, before it BCR): a header, then NumProfiles rows of NumPoints
// heights. The text form, aISO-1.0, has lines "Key = value" and ends its parts by "*"; the binary
// form, bISO-1.0, has a header of 81 bytes and little-endian numbers. Scales are in metres; heights
// are numbers times Zscale. BAD, NaN and the smallest signed integer are missing points. Leaves out
// compressed data and the check sum.
#include "app/data/scan/scan_private.h"

#include <math.h>

enum { COLUMNS, ROWS, X_STEP, Y_STEP, Z_STEP, COMPRESSION, TYPE, KEYS };
enum { HEADER = 81, VERSION = 8 };

#define BLANKS " \t\r\n\v\f"

// Keys, and the places of their values in the binary header.
static const struct {
  const char *name;
  gsize at, size;
} keys[KEYS] = {{"NumPoints", 42, 2}, {"NumProfiles", 44, 2}, {"Xscale", 46, 8},  {"Yscale", 54, 8},
                {"Zscale", 62, 8},    {"Compression", 78, 1}, {"DataType", 79, 1}};

// Skips the characters `skipped`, returns a copy of the text from there to the first of the
// characters `ends`, and moves to that. Empty at the end.
static char *take_sdf_text(SbScanBytes *bytes, const char *skipped, const char *ends) {
  while (bytes->at < bytes->end && *bytes->at != '\0' && strchr(skipped, *bytes->at) != NULL) {
    bytes->at++;
  }
  const guchar *start = bytes->at;
  while (bytes->at < bytes->end && (*bytes->at == '\0' || strchr(ends, *bytes->at) == NULL)) {
    bytes->at++;
  }
  return g_strndup((const char *)start, MIN((gsize)(bytes->at - start), 40));
}

// Reads the lines "Key = value" up to the one that is "*".
static void read_keys(double *value, SbScanBytes *bytes) {
  for (bool more = true; more;) {
    g_autofree char *key = take_sdf_text(bytes, BLANKS "=", BLANKS "=");
    more = *key != '\0' && *key != '*';
    g_autofree char *text = more ? take_sdf_text(bytes, " \t=", "\r\n") : NULL;
    for (int k = 0; k < KEYS && more; k++) {
      if (g_ascii_strcasecmp(key, keys[k].name) == 0) {
        (void)sb_text_table_number_at(&value[k], text, '.');
      }
    }
  }
}

static bool read_text(SbScan *out, SbScanBytes bytes, const double *value, GError **error) {
  const guint64 points = (guint64)value[COLUMNS] * (guint64)value[ROWS];
  if (points > (guint64)(bytes.end - bytes.at) / 2 + 1) {
    return sb_app_error_input(error, "is cut short: %.0f x %.0f points announced", value[COLUMNS],
                              value[ROWS]);
  }
  if (!sb_scan_allocate(out, (guint64)value[COLUMNS], (guint64)value[ROWS], error)) {
    return false;
  }
  for (guint64 i = 0; i < points; i++) {
    double number = NAN;
    g_autofree char *word = take_sdf_text(&bytes, BLANKS, BLANKS);
    if (*word == '\0' || *word == '*') {
      return sb_app_error_input(
          error, "is cut short: %" G_GUINT64_FORMAT " points of %" G_GUINT64_FORMAT, i, points);
    }
    if (sb_text_table_number_at(&number, word, '.') == 0 && g_ascii_strcasecmp(word, "BAD") != 0 &&
        g_ascii_strcasecmp(word, "NaN") != 0) {
      return sb_app_error_input(error, "numbers expected, not \"%s\"", word);
    }
    out->heights.z[i] = number * value[Z_STEP];
  }
  return true;
}

bool sb_scan_parse_sdf(SbScan *out, SbScanBytes bytes, const SbScanChoices *choices,
                       GError **error) {
  const bool text = *bytes.at == 'a', whole = bytes.end - bytes.at >= HEADER;
  double value[KEYS];
  out->format = "surface data file";
  for (int k = 0; k < KEYS; k++) {
    const guchar *p = bytes.at + keys[k].at;
    value[k] = text || !whole      ? NAN
               : keys[k].size == 8 ? sb_bytes_double(p)
               : keys[k].size == 2 ? sb_bytes_u16(p)
                                   : *p;
  }
  bytes.at += text || !whole ? VERSION : HEADER;
  if (text) {
    read_keys(value, &bytes);
  }
  if (!(value[COLUMNS] >= 1 && value[ROWS] >= 1 && value[COLUMNS] <= 65535 &&
        value[ROWS] <= 65535 && isfinite(value[Z_STEP]) && value[Z_STEP] != 0)) {
    return sb_app_error_input(error, "has no NumPoints, NumProfiles or Zscale");
  }
  const bool known = text || (value[TYPE] >= 0 && value[TYPE] < SB_SCAN_KINDS);
  if (!known || value[COMPRESSION] > 0) {
    return sb_app_error_input(error, "has compressed data or an unknown data type");
  }
  out->heights.dx = value[X_STEP];
  out->heights.dy = value[Y_STEP];
  if (text) {
    return read_text(out, bytes, value, error);
  }
  const SbScanKind kind = (SbScanKind)value[TYPE];
  const double least[SB_SCAN_KINDS] = {NAN, NAN, NAN, NAN, G_MININT8, G_MININT16, G_MININT32, NAN};
  return sb_scan_take_grid(out, (guint64)value[COLUMNS], (guint64)value[ROWS], kind, bytes,
                           value[Z_STEP], least[kind], error);
}
