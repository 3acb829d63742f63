// See series.h. One complaint is enough: the first thing wrong ends the reading.
#include "app/document/series.h"

#include "app/base/reader.h"
#include "app/base/text_table.h"
#include "app/base/unit.h"

#include <string.h>

enum { COLUMNS = 2 };

// What a column may hold: its name, units and range [si], and the range for the user.
typedef struct {
  SbSeriesKind kind;
  size_t column;
  const char *name, *si, *shown;
  double low, high;
  const char *allowed;
} Quantity;

static const Quantity quantities[] = {
    {SB_SERIES_DRIVE, 0, "time", "s", "s", -1e6, 1e6, "0 to 1e6 s"},
    {SB_SERIES_DRIVE, 1, "displacement", "m", "m", -0.2, 0.2, "at most 200 mm in either direction"},
    {SB_SERIES_DRIVE, 1, "force", "N", "N", -1e5, 1e5, "at most 1e5 N in either direction"},
    {SB_SERIES_SPEED, 0, "time", "s", "s", -1e6, 1e6, "0 to 1e6 s"},
    {SB_SERIES_SPEED, 1, "speed", "m/s", "m/s", -100, 100, "at most 100 m/s in either direction"},
    {SB_SERIES_TEMPERATURE, 0, "time", "s", "s", -3.2e9, 3.2e9, "0 to 3.2e9 s"},
    {SB_SERIES_TEMPERATURE, 1, "temperature", "K", "°C", 173.15, 423.15, "-100 to 150 degC"},
};

// Headings of the second column, for the user.
static const char *const headings[] = {[SB_SERIES_DRIVE] = "displacement [mm] or force [N]",
                                       [SB_SERIES_SPEED] = "speed [m/s]",
                                       [SB_SERIES_TEMPERATURE] = "temperature [degC] or [K]"};

// A column of a file.
typedef struct {
  const Quantity *quantity;
  double scale, offset; // value [si] = scale * number + offset
} Column;

// "displacement [mm]" -> quantity, and what 0 and 1 of the unit are in SI.
static bool read_heading(Column *out, SbSeriesKind kind, const SbTextTable *table, size_t column,
                         const char *name, GPtrArray *issues) {
  const SbTextTableColumn *heading = &table->column[column];
  const char *allowed = column == 0 ? "time [s]" : headings[kind];
  const int line = (int)table->header_lines;
  *out = (Column){.scale = 1};
  for (size_t i = 0; i < G_N_ELEMENTS(quantities); i++) {
    const Quantity *q = &quantities[i];
    if (q->kind == kind && q->column == column && strcmp(q->name, heading->name) == 0) {
      out->quantity = q;
    }
  }
  const Quantity *q = out->quantity;
  if (q == NULL) {
    return sb_issues_add(issues, name, line, NULL, allowed,
                         *heading->name == '\0' ? "column %zu has no heading"
                                                : "column %zu: \"%s\" is an unknown quantity",
                         column + 1, heading->name);
  }
  g_autofree char *none = g_strdup_printf("0 %s", heading->unit);
  g_autofree char *one = g_strdup_printf("1 %s", heading->unit);
  double unit = 0;
  if (heading->clock && column == 0) {
    return true;
  }
  const bool good = sb_quantity_parse(&out->offset, none, q->si, q->shown, NULL) &&
                    sb_quantity_parse(&unit, one, q->si, q->shown, NULL) && unit > out->offset;
  out->scale = unit - out->offset;
  return good ||
         sb_issues_add(issues, name, line, NULL, sb_quantity_is_point(q->shown) ? "K, degC" : q->si,
                       "column %zu: \"%s\" is not a unit of %s", column + 1, heading->unit,
                       heading->name);
}

static bool read_table(SbModelSeries *out, SbSeriesKind kind, const SbTextTable *table,
                       const char *name, GPtrArray *issues) {
  Column columns[COLUMNS];
  double *value[COLUMNS];
  SbTextTableRows rows;
  if (table->columns != COLUMNS) {
    return sb_issues_add(issues, name, 0, NULL, "two columns", "has %zu columns", table->columns);
  }
  if (!read_heading(&columns[0], kind, table, 0, name, issues) ||
      !read_heading(&columns[1], kind, table, 1, name, issues)) {
    return false;
  }
  if (kind == SB_SERIES_DRIVE) {
    const bool force = strcmp(columns[1].quantity->name, "force") == 0;
    out->quantity = force ? SB_DRIVE_OF_FORCE : SB_DRIVE_OF_POSITION;
  }
  if (!sb_text_table_read(&rows, value, table, (const size_t[]){0, 1}, COLUMNS, issues)) {
    return false;
  }
  bool good =
      rows.left_text == NULL || sb_issues_add(issues, name, rows.left_line, NULL, "two numbers",
                                              "\"%s\" is not a row of the series", rows.left_text);
  for (size_t row = 0; row < rows.rows && good; row++) {
    double si[COLUMNS];
    for (int i = 0; i < COLUMNS && good; i++) {
      const Quantity *q = columns[i].quantity;
      si[i] = value[i][row] * columns[i].scale + columns[i].offset;
      good = (si[i] >= q->low && si[i] <= q->high) ||
             sb_issues_add(issues, name, 0, NULL, q->allowed, "row %zu: column %d is out of range",
                           row + 1, i + 1);
    }
    if (good && out->count == SB_MODEL_SERIES_MAX) {
      good = sb_issues_add(issues, name, 0, NULL, NULL, "has more than the %d rows of a series",
                           SB_MODEL_SERIES_MAX);
    } else if (good && out->count > 0 && !(si[0] > out->time[out->count - 1])) {
      good = sb_issues_add(issues, name, 0, NULL, NULL,
                           "row %zu: its time does not come after the row before", row + 1);
    } else if (good) {
      out->time[out->count] = si[0];
      out->value[out->count++] = si[1];
    }
  }
  g_free(value[0]);
  g_free(value[1]);
  g_free(rows.left_text);
  return good;
}

bool sb_series_read(SbModelSeries *out, SbSeriesKind kind, const char *text, size_t length,
                    const char *path, GPtrArray *issues) {
  out->count = 0;
  g_autofree char *own =
      text == NULL ? sb_reader_load(&length, path, path, SB_SERIES_BYTES_MAX, issues) : NULL;
  text = text != NULL ? text : own;
  g_autoptr(SbTextTable) table =
      text != NULL ? sb_text_table_parse(text, length, NULL, path, issues) : NULL;
  const bool good = table != NULL && read_table(out, kind, table, path, issues);
  if (!good) {
    sb_issues_forget_key(issues, "decimal points, dates as 2026-02-03, separators ; or tab");
  }
  const double start = good ? out->time[0] : 0;
  out->count = good ? out->count : 0;
  for (size_t i = 0; i < out->count; i++) {
    out->time[i] -= start;
  }
  return good;
}
