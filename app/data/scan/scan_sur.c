// Digital Surf's surfaces, format 2.00: a header of 512 bytes, a comment, a private zone, then
// integers row after row. Heights are value times z spacing in the z step's unit; the offset of
// heights does not matter here. Where points may be missing, the value two below the least marks
// them. Leaves out series, colours and the compressed form of later programs.
#include "app/data/scan/scan_private.h"

enum { SUR_HEADER = 512, PROFILE = 1, SURFACE = 2 };

// A text field, cut at its end, in UTF-8.
static char *field(const guchar *p, gsize size) {
  g_autofree char *raw = g_strndup((const char *)p, size);
  g_strstrip(raw);
  return g_utf8_validate(raw, -1, NULL)
             ? g_steal_pointer(&raw)
             : g_convert(raw, -1, "UTF-8", "ISO-8859-1", NULL, NULL, NULL);
}

// Reads the spacing of an axis [m]; false with an error for what is no length.
static bool read_spacing(double *out, const guchar *h, int axis, GError **error) {
  g_autofree char *unit = field(h + 180 + 16 * axis, 16);
  const double step = sb_bytes_float(h + 120 + 4 * axis);
  *out = (axis < 2 ? fabs(step) : step) * sb_scan_length(unit);
  return (isfinite(*out) && *out != 0) ||
         sb_app_error_input(error, "the spacing along %c, %g \"%s\", is not a length", "xyz"[axis],
                            step, unit);
}

bool sb_scan_parse_sur(SbScan *out, SbScanBytes file, const SbScanChoices *wish, GError **error) {
  const guchar *h = file.at;
  out->format = "Digital Surf";
  if (file.end - file.at < SUR_HEADER) {
    return sb_app_error_input(error, "is cut short: no header of %d file", SUR_HEADER);
  }
  const int kind = (gint16)sb_bytes_u16(h + 18), bits = (gint16)sb_bytes_u16(h + 98);
  const gint32 columns = (gint32)sb_bytes_u32(h + 108), rows = (gint32)sb_bytes_u32(h + 112);
  if (sb_bytes_u16(h + 12) != 0) {
    return sb_app_error_input(error, "is not in the byte order of format 2.00 for PCs");
  }
  if (kind != PROFILE && kind != SURFACE) {
    return sb_app_error_input(
        error, "contains an object of type %d (allowed 1, a profile, or 2, a surface)", kind);
  }
  if (bits != 16 && bits != 32) {
    return sb_app_error_input(error, "has points of %d bits (allowed 16 or 32)", bits);
  }
  const glong begin = SUR_HEADER + sb_bytes_u16(h + 334) + sb_bytes_u16(h + 336);
  file.at += MIN(begin, file.end - file.at);
  double step = 0;
  const double absent = sb_bytes_u16(h + 86) != 0 ? (double)(gint32)sb_bytes_u32(h + 100) - 2 : NAN;
  if (!read_spacing(&step, h, 2, error) || !read_spacing(&out->heights.dx, h, 0, error) ||
      (rows > 1 && !read_spacing(&out->heights.dy, h, 1, error)) ||
      !sb_scan_take_grid(out, (size_t)columns, (size_t)rows, bits == 16 ? 'h' : 'i', file, step,
                         absent, error)) {
    return false;
  }
  out->title = field(h + 20, 30);
  if (sb_bytes_u16(h + 290) != 0) {
    sb_note_add(out->notes, "the header says that heights were inverted; they are used unchanged");
  }
  if (sb_bytes_u16(h + 14) > 1) {
    sb_note_add(out->notes, "the first of %d objects", sb_bytes_u16(h + 14));
  }
  return true;
}
