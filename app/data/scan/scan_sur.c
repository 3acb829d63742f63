// Digital Surf's surfaces, format 2.00: a header of 512 bytes, a comment, a private zone, then
// integers row after row. Heights are value times z spacing in the z step's unit; the offset of
// heights does not matter here. Where points may be missing, the value two below the least marks
// them. Leaves out series, colours and the compressed form of later programs.
#include "app/data/scan/scan_private.h"

#include <math.h>

enum { HEADER = 512, PROFILE = 1, SURFACE = 2 };

// A text field, cut at its end, in UTF-8.
static char *field(const guchar *p, gsize size) {
  g_autofree char *raw = g_strndup((const char *)p, size);
  g_strstrip(raw);
  return g_utf8_validate(raw, -1, NULL)
             ? g_steal_pointer(&raw)
             : g_convert(raw, -1, "UTF-8", "ISO-8859-1", NULL, NULL, NULL);
}

// Spacing of an axis [m]; 0 with an error for what is no length.
static double spacing(const guchar *h, int axis, const char *name, GError **error) {
  static const char *const names = "xyz";
  g_autofree char *unit = field(h + 180 + 16 * axis, 16);
  const double step = sb_scan_float(h + 120 + 4 * axis), metres = sb_scan_length(unit);
  if (!(metres > 0) || !isfinite(step) || step == 0) {
    sb_scan_fail(error, name, "the spacing along %c, %g \"%s\", is not a length", names[axis], step,
                 unit);
    return 0;
  }
  return step * metres;
}

gboolean sb_scan_parse_sur(SbScan *out, SbScanBytes bytes, const SbScanChoices *choices,
                           GError **error) {
  const guchar *h = bytes.at;
  const char *name = bytes.name;
  const guint64 length = (guint64)(bytes.end - bytes.at);
  out->format = "Digital Surf";
  if (length < HEADER) {
    return sb_scan_fail(error, name, "is cut short: no header of %d bytes", HEADER);
  }
  const int kind = (gint16)sb_scan_u16(h + 18), bits = (gint16)sb_scan_u16(h + 98);
  const gint64 columns = (gint32)sb_scan_u32(h + 108), rows = (gint32)sb_scan_u32(h + 112);
  const int comment = sb_scan_u16(h + 334), private = sb_scan_u16(h + 336);
  if (sb_scan_u16(h + 12) != 0) {
    return sb_scan_fail(error, name, "is not in the byte order of format 2.00 for PCs");
  }
  if (kind != PROFILE && kind != SURFACE) {
    return sb_scan_fail(error, name,
                        "contains an object of type %d (allowed 1, a profile, or 2, a "
                        "surface)",
                        kind);
  }
  if (bits != 16 && bits != 32) {
    return sb_scan_fail(error, name, "has points of %d bits (allowed 16 or 32)", bits);
  }
  if (columns < 1 || rows < 1) {
    return sb_scan_fail(error, name, "has sizes below 1 in its header");
  }
  const guint64 begin = HEADER + (guint64)comment + (guint64) private, size = (guint64)bits / 8;
  const guint64 room = length > begin ? (length - begin) / size : 0;
  if ((guint64)columns > room || (guint64)rows > room / (guint64)columns) {
    return sb_scan_fail(
        error, name, "is cut short: %" G_GINT64_FORMAT " x %" G_GINT64_FORMAT " points announced",
        columns, rows);
  }
  const double z_step = spacing(h, 2, name, error);
  if (z_step == 0 || (out->heights.dx = fabs(spacing(h, 0, name, error))) == 0 ||
      (rows > 1 && (out->heights.dy = fabs(spacing(h, 1, name, error))) == 0) ||
      !sb_scan_allocate(out, (guint64)columns, (guint64)rows, name, error)) {
    return FALSE;
  }
  const gboolean special = sb_scan_u16(h + 86) != 0;
  const gint64 missing = (gint64)(gint32)sb_scan_u32(h + 100) - 2;
  const guchar *p = h + begin;
  for (gint64 i = 0; i < columns * rows; i++, p += size) {
    const gint64 value = bits == 16 ? (gint16)sb_scan_u16(p) : (gint32)sb_scan_u32(p);
    out->heights.z[i] = special && value == missing ? NAN : (double)value * z_step;
  }
  out->title = field(h + 20, 30);
  if (sb_scan_u16(h + 290) != 0) {
    g_ptr_array_add(
        out->notes,
        g_strdup("the header says that heights were inverted; they are used unchanged"));
  }
  if (sb_scan_u16(h + 14) > 1) {
    g_ptr_array_add(out->notes,
                    g_strdup_printf("the first of %d objects", (int)sb_scan_u16(h + 14)));
  }
  return TRUE;
}
