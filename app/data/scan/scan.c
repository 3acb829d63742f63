// See scan.h.
#include "app/data/scan/scan.h"

#include "app/base/reader.h"
#include "app/base/unit.h"
#include "app/data/scan/scan_private.h"

#include <math.h>

gboolean sb_scan_fail(GError **error, const char *name, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *text = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  g_autofree char *whole = g_strconcat(name, ": ", text, NULL);
  g_autofree char *shown = sb_printable(whole, strlen(whole));
  g_set_error_literal(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, shown);
  return FALSE;
}

gboolean sb_scan_allocate(SbScan *out, guint64 columns, guint64 rows, const char *name,
                          GError **error) {
  const guint64 most = SB_HEIGHTS_POINTS_MAX;
  if (columns == 0 || rows == 0 || columns > most || rows > most / columns) {
    return sb_scan_fail(error, name,
                        "%" G_GUINT64_FORMAT " x %" G_GUINT64_FORMAT
                        " points (allowed at most %" G_GUINT64_FORMAT ")",
                        columns, rows, most);
  }
  out->heights.columns = out->heights.stride = (size_t)columns;
  out->heights.rows = (size_t)rows;
  out->heights.z = g_try_new(double, (gsize)(columns * rows));
  if (out->heights.z == NULL) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO,
                "%s: no memory for %" G_GUINT64_FORMAT " points", name, columns * rows);
  }
  return out->heights.z != NULL;
}

double sb_scan_length(const char *unit) {
  g_autofree char *name = g_strstrip(g_strdup(unit));
  const gsize end = strlen(name);
  if (end > 2 && (*name == '[' || *name == '(') && strchr("])", name[end - 1]) != NULL) {
    name[end - 1] = *name = ' ';
    g_strstrip(name);
  }
  // As old instruments write it.
  if (g_ascii_strcasecmp(name, "mkm") == 0 || strcmp(name, "\xb5m") == 0) {
    return 1e-6;
  }
  double value = 0;
  g_autofree char *one = g_strconcat("1 ", name, NULL);
  return *name != '\0' && g_utf8_validate(one, -1, NULL) &&
                 sb_quantity_parse(&value, one, "m", "µm", NULL) && value > 0
             ? value
             : 0;
}

gboolean sb_scan_parse(SbScan *out, const char *data, gsize length, const SbScanChoices *choices,
                       const char *name, GError **error) {
  static const struct {
    const char *start;
    SbScanReader *read;
  } formats[] = {{"GWYP", sb_scan_parse_gwy},       {"DIGITAL SURF", sb_scan_parse_sur},
                 {"PK\x03\x04", sb_scan_parse_x3p}, {"aISO-1.0", sb_scan_parse_sdf},
                 {"aBCR-1.0", sb_scan_parse_sdf},   {"bISO-1.0", sb_scan_parse_sdf},
                 {"bBCR-1.0", sb_scan_parse_sdf},   {"", sb_scan_parse_text}};
  *out = (SbScan){.notes = g_ptr_array_new_with_free_func(g_free)};
  gsize format = 0;
  for (gsize skip; skip = strlen(formats[format].start),
                   skip > length || memcmp(data, formats[format].start, skip) != 0;) {
    format++;
  }
  const gboolean text = *formats[format].start == '\0', container = format == 0;
  if (!text && (choices->unit > 0 || choices->lateral_unit > 0)) {
    sb_scan_clear(out);
    return sb_scan_fail(error, name, "states its own units: --unit applies to text files only");
  }
  if (!container && choices->channel != NULL) {
    sb_scan_clear(out);
    return sb_scan_fail(error, name, "has no channels: --channel is for .gwy");
  }
  const guchar *bytes = (const guchar *)data;
  gboolean good =
      formats[format].read(out, (SbScanBytes){bytes, bytes + length, name}, choices, error);
  SbHeights *h = &out->heights;
  if (good && choices->spacing > 0) {
    h->dx = h->dy = choices->spacing;
  }
  if (good && !(isfinite(h->dx) && h->dx > 0 && (h->rows == 1 || (isfinite(h->dy) && h->dy > 0)))) {
    good = sb_scan_fail(error, name, "has no distance between its points");
  }
  for (gsize i = 0; good && i < h->columns * h->rows; i++) {
    h->z[i] = isfinite(h->z[i]) ? h->z[i] : NAN;
  }
  if (!good) {
    sb_scan_clear(out);
  }
  return good;
}

gboolean sb_scan_read(SbScan *out, const char *path, const SbScanChoices *choices, GError **error) {
  *out = (SbScan){0};
  g_autoptr(GPtrArray) issues = sb_issues_new();
  gsize length = 0;
  g_autofree char *data = sb_reader_load(&length, path, path, SB_SCAN_BYTES_MAX, issues);
  if (data == NULL) {
    g_autofree char *line = sb_issue_line(issues->pdata[0]);
    g_set_error_literal(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, line);
    return FALSE;
  }
  if (!sb_scan_parse(out, data, length, choices, path, error)) {
    return FALSE;
  }
  out->sha256 = g_compute_checksum_for_data(G_CHECKSUM_SHA256, (const guchar *)data, length);
  return TRUE;
}

void sb_scan_clear(SbScan *scan) {
  g_free(scan->heights.z);
  g_free(scan->title);
  g_free(scan->sha256);
  if (scan->notes != NULL) {
    g_ptr_array_unref(scan->notes);
  }
  *scan = (SbScan){0};
}
