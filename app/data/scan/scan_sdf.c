// Surface data files (ISO 25178-71, before it BCR): a header, then NumProfiles rows of NumPoints
// heights. The text form, aISO-1.0, has lines "Key = value" and ends its parts by "*"; the binary
// form, bISO-1.0, has a header of 81 bytes and little-endian numbers. Scales are in metres; heights
// are numbers times Zscale. BAD, NaN and the smallest signed integer are missing points. Leaves out
// compressed data and the check sum.
#include "app/data/scan/scan_private.h"

enum { COLUMNS, ROWS, X_STEP, Y_STEP, Z_STEP, COMPRESSION, TYPE, KEYS };
enum { HEADER = 81 };

// The text form: a matrix and header (scan_text_keys.def), without the lines between and behind.
static bool read_text(SbScan *out, SbScanBytes file, const SbScanChoices *wish, GError **error) {
  g_autofree char *text = g_strndup((const char *)file.at, (gsize)(file.end - file.at));
  g_auto(GStrv) parts = g_strsplit(text, "\n*", 3);
  g_autofree char *both = g_strconcat(parts[0], "\n", parts[1], NULL);
  const guchar *start = (const guchar *)both;
  return sb_scan_parse_text(out, (SbScanBytes){start, start + strlen(both)}, wish, error);
}

bool sb_scan_parse_sdf(SbScan *out, SbScanBytes file, const SbScanChoices *wish, GError **error) {
  static const gsize place[KEYS] = {42, 44, 46, 54, 62, 78, 79};
  static const gsize size[KEYS] = {2, 2, 8, 8, 8, 1, 1};
  double value[KEYS];
  const bool text = *file.at == 'a', good = text && read_text(out, file, wish, error);
  out->format = "surface data file";
  if (text) {
    return good;
  }
  if (file.end - file.at < HEADER) {
    return sb_app_error_input(error, "is cut short: no header of %d file", HEADER);
  }
  for (int k = 0; k < KEYS; k++) {
    const guchar *p = file.at + place[k];
    value[k] = size[k] == 8 ? sb_bytes_double(p) : size[k] == 2 ? sb_bytes_u16(p) : *p;
  }
  file.at += HEADER;
  if (!(value[COLUMNS] >= 1 && value[ROWS] >= 1 && isfinite(value[Z_STEP]) && value[Z_STEP] != 0)) {
    return sb_app_error_input(error, "has no NumPoints, NumProfiles or Zscale");
  }
  if (value[TYPE] >= SB_SCAN_KINDS || value[COMPRESSION] > 0) {
    return sb_app_error_input(error, "has compressed data or an unknown data type");
  }
  out->heights.dx = value[X_STEP];
  out->heights.dy = value[Y_STEP];
  const SbScanKind kind = (SbScanKind)value[TYPE];
  const double least[SB_SCAN_KINDS] = {NAN, NAN, NAN, NAN, G_MININT8, G_MININT16, G_MININT32, NAN};
  return sb_scan_take_grid(out, (size_t)value[COLUMNS], (size_t)value[ROWS], kind, file,
                           value[Z_STEP], least[kind], error);
}
