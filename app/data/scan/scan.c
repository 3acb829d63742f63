// See scan.h.
#include "app/base/reader.h"
#include "app/base/unit.h"
#include "app/data/scan/scan_private.h"

bool sb_scan_allocate(SbScan *out, size_t columns, size_t rows, GError **error) {
  const size_t most = SB_HEIGHTS_POINTS_MAX;
  if (columns == 0 || rows == 0 || columns > most || rows > most / columns) {
    return sb_app_error_input(error, "%zu x %zu points (allowed at most %zu)", columns, rows, most);
  }
  out->heights.columns = out->heights.stride = columns;
  out->heights.rows = rows;
  out->heights.z = g_try_new(double, columns *rows);
  if (out->heights.z == NULL) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO, "no memory for %zu points", columns * rows);
  }
  return out->heights.z != NULL;
}

bool sb_scan_take_grid(SbScan *out, size_t columns, size_t rows, char kind, SbScanBytes bytes,
                       double scale, double missing, GError **error) {
  static const guint8 sizes[] = {1, 2, 4, 4, 1, 2, 4, 8};
  const size_t size = sizes[strcspn(SB_SCAN_KINDS, (char[]){kind, '\0'})];
  const size_t room = (size_t)(bytes.end - bytes.at) / size;
  if (columns > 0 && rows > 0 && (columns > room || rows > room / columns)) {
    return sb_app_error_input(error, "is cut short: %zu x %zu points announced", columns, rows);
  }
  const bool good = sb_scan_allocate(out, columns, rows, error);
  for (size_t i = 0; good && i < columns * rows; i++) {
    const guchar *p = bytes.at + i * size;
    const double value = kind == 'B'   ? *p
                         : kind == 'H' ? sb_bytes_u16(p)
                         : kind == 'I' ? sb_bytes_u32(p)
                         : kind == 'b' ? (gint8)*p
                         : kind == 'h' ? (gint16)sb_bytes_u16(p)
                         : kind == 'i' ? (gint32)sb_bytes_u32(p)
                         : kind == 'f' ? sb_bytes_float(p)
                                       : sb_bytes_double(p);
    out->heights.z[i] = value == missing || fabs(value) > 3.4e38 ? NAN : scale * value;
  }
  return good;
}

double sb_scan_length(const char *unit) {
  g_autofree char *name = g_strstrip(g_strdelimit(g_strdup(unit), "[]()", ' '));
  double value = 0;
  unit = g_utf8_validate(name, -1, NULL) ? sb_text_table_unit(name) : NULL;
  unit = unit != NULL ? unit : name;
  return *name != '\0' && sb_unit_scale(&value, unit, "m", "µm", NULL) ? value : 0;
}

static bool read_format(SbScan *out, SbScanBytes file, const SbScanChoices *wish, GError **error) {
  static const struct {
    const char *start;
    SbScanReader *read;
  } formats[] = {{"GWYP", sb_scan_parse_gwy},       {"DIGITAL SURF", sb_scan_parse_sur},
                 {"PK\x03\x04", sb_scan_parse_x3p}, {"aISO-1.0", sb_scan_parse_sdf},
                 {"aBCR-1.0", sb_scan_parse_sdf},   {"bISO-1.0", sb_scan_parse_sdf},
                 {"bBCR-1.0", sb_scan_parse_sdf},   {"", sb_scan_parse_text}};
  gsize format = 0;
  while (!sb_bytes_begin(file.at, (gsize)(file.end - file.at), formats[format].start)) {
    format++;
  }
  if (*formats[format].start != '\0' && (wish->unit > 0 || wish->lateral_unit > 0)) {
    return sb_app_error_choose(error, wish->unit > 0 ? "unit" : "lateral-unit", "",
                               "states its own units, which only a text file may lack");
  }
  if (format != 0 && wish->channel != NULL) {
    return sb_app_error_choose(error, "channel", "", "has no channels, which a .gwy has");
  }
  if (!formats[format].read(out, file, wish, error)) {
    return false;
  }
  SbHeights *h = &out->heights;
  if (wish->spacing > 0) {
    h->dx = h->dy = wish->spacing;
  }
  if (!(isfinite(h->dx) && h->dx > 0 && (h->rows == 1 || (isfinite(h->dy) && h->dy > 0)))) {
    return sb_app_error_input(error, "has no distance between its points");
  }
  for (gsize i = 0; i < h->columns * h->rows; i++) {
    h->z[i] = isfinite(h->z[i]) ? h->z[i] : NAN;
  }
  return true;
}

gboolean sb_scan_read(SbScan *out, const char *data, gsize length, const SbScanChoices *choices,
                      const char *path, GError **error) {
  const int code = SB_APP_ERROR_INPUT;
  g_autofree char *own =
      data == NULL ? sb_reader_load_file(&length, path, path, SB_SCAN_BYTES_MAX, code, error)
                   : NULL;
  const guchar *bytes = (const guchar *)(data != NULL ? data : own);
  *out = (SbScan){.notes = g_ptr_array_new_with_free_func(g_free)};
  const bool good =
      bytes != NULL && read_format(out, (SbScanBytes){bytes, bytes + length}, choices, error);
  if (good) {
    out->sha256 = g_compute_checksum_for_data(G_CHECKSUM_SHA256, bytes, length);
  } else {
    sb_app_error_prefix(bytes != NULL ? error : NULL, path);
    sb_scan_clear(out);
  }
  return good;
}

void sb_scan_clear(SbScan *scan) {
  g_free(scan->heights.z);
  g_free(scan->title);
  g_free(scan->sha256);
  g_clear_pointer(&scan->notes, g_ptr_array_unref);
  *scan = (SbScan){0};
}
