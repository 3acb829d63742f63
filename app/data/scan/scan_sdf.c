// Surface data files (ISO 25178-71, before it BCR): a header, then NumProfiles rows of NumPoints
// heights. The text form, aISO-1.0, has lines "Key = value" and ends its parts by "*"; the binary
// form, bISO-1.0, has 81 bytes of header and little-endian numbers. Scales are in metres; heights
// are numbers times Zscale, or void: BAD, NaN, the least integer. Ignores compression, check sums.
#include "app/data/scan/scan_private.h"

enum { HEADER = 81 };

bool sb_scan_parse_sdf(SbScan *out, SbScanBytes file, const SbScanChoices *wish, GError **error) {
  static const char name[] = "surface data file";
  if (*file.at == 'a') { // a matrix and header (scan_text_keys.def), less lines between and behind
    g_autofree char *text = g_strndup((const char *)file.at, (gsize)(file.end - file.at));
    g_auto(GStrv) parts = g_strsplit(text, "\n*", 3);
    g_autofree char *both = g_strconcat(parts[0], "\n", parts[1], NULL);
    const SbScanBytes own = {(const guchar *)both, (const guchar *)both + strlen(both)};
    const bool good = sb_scan_parse_text(out, own, wish, error);
    out->format = name;
    return good;
  }
  out->format = name;
  if (file.end - file.at < HEADER) {
    return sb_app_error_input(error, "is cut short: no header of %d file", HEADER);
  }
  const guchar *h = file.at;
  const size_t columns = sb_bytes_u16(h + 42), rows = sb_bytes_u16(h + 44), type = h[79];
  const double scale = sb_bytes_double(h + 62);
  file.at += HEADER;
  if (!(columns >= 1 && rows >= 1 && isfinite(scale) && scale != 0)) {
    return sb_app_error_input(error, "has no NumPoints, NumProfiles or Zscale");
  }
  if (type >= strlen(SB_SCAN_KINDS) || h[78] > 0) {
    return sb_app_error_input(error, "has compressed data or an unknown data type");
  }
  out->heights.dx = sb_bytes_double(h + 46);
  out->heights.dy = sb_bytes_double(h + 54);
  const double none[] = {NAN, NAN, NAN, NAN, G_MININT8, G_MININT16, G_MININT32, NAN};
  return sb_scan_take_grid(out, columns, rows, SB_SCAN_KINDS[type], file, scale, none[type], error);
}
