// See series.h. One complaint is enough: the first thing wrong ends the reading.
#include "app/document/series.h"

#include "app/base/reader.h"
#include "app/base/text_table.h"
#include "app/base/unit.h"

#include <math.h>
#include <string.h>

enum { COLUMNS = 2 };

typedef struct {
  const char *name;
  GPtrArray *issues;
  bool speed;            // in the second column, in place of a drive's quantity
  bool temperature;      // likewise
  double scale[COLUMNS]; // to SI
  double offset;         // of a temperature, added
  SbModelSeries *out;
} Reader;

// Ranges of the columns [SI].
static const double time_max = 1e6, displacement_max = 0.2, force_max = 1e5, speed_max = 100;
static const double shelf_max = 3.2e9, cold = 173.15, hot = 423.15; // of a shelf's temperatures

// "displacement [mm]" -> quantity, and the unit's size in SI.
static bool read_heading(Reader *r, const SbTextTable *table, size_t column) {
  const SbTextTableColumn *heading = sb_text_table_column(table, column);
  const char *si = NULL;
  r->scale[column] = 1;
  if (column == 0 && strcmp(heading->name, "time") == 0) {
    si = "s";
  } else if (column == 1 && r->temperature) {
    si = strcmp(heading->name, "temperature") == 0 ? "K" : NULL;
  } else if (column == 1 && r->speed) {
    si = strcmp(heading->name, "speed") == 0 ? "m/s" : NULL;
  } else if (column == 1 && strcmp(heading->name, "displacement") == 0) {
    si = "m";
    r->out->quantity = SB_DRIVE_OF_POSITION;
  } else if (column == 1 && strcmp(heading->name, "force") == 0) {
    si = "N";
    r->out->quantity = SB_DRIVE_OF_FORCE;
  }
  g_autofree char *one = g_strdup_printf("1 %s", heading->unit);
  const char *allowed = column == 0      ? "time [s]"
                        : r->temperature ? "temperature [degC] or [K]"
                        : r->speed       ? "speed [m/s]"
                                         : "displacement [mm] or force [N]";
  const int line = (int)sb_text_table_header_lines(table);
  if (*heading->name == '\0') {
    sb_issues_add(r->issues, r->name, line, NULL, allowed, "column %zu has no heading", column + 1);
  } else if (si == NULL) {
    sb_issues_add(r->issues, r->name, line, NULL, allowed,
                  "column %zu: \"%s\" is an unknown quantity", column + 1, heading->name);
  } else if (r->temperature && column == 1) {
    // A point of a scale: what 0 and 1 of its unit are.
    g_autofree char *none = g_strdup_printf("0 %s", heading->unit);
    double unit = 0;
    if (!sb_quantity_parse(&r->offset, none, "K", "°C", NULL) ||
        !sb_quantity_parse(&unit, one, "K", "°C", NULL)) {
      sb_issues_add(r->issues, r->name, line, NULL, "K, degC",
                    "column %zu: \"%s\" is not a unit of %s", column + 1, heading->unit,
                    heading->name);
      return false;
    }
    r->scale[column] = unit - r->offset;
  } else if (!(heading->clock && column == 0) &&
             !(sb_quantity_parse(&r->scale[column], one, si, si, NULL) && r->scale[column] > 0)) {
    sb_issues_add(r->issues, r->name, line, NULL, si, "column %zu: \"%s\" is not a unit of %s",
                  column + 1, heading->unit, heading->name);
    si = NULL;
  }
  return si != NULL;
}

static bool take_row(Reader *r, size_t row, double *const *value) {
  const bool force = !r->speed && r->out->quantity == SB_DRIVE_OF_FORCE;
  const double limit[COLUMNS] = {r->temperature ? shelf_max : time_max, r->temperature ? hot
                                                                        : r->speed     ? speed_max
                                                                        : force        ? force_max
                                                                                : displacement_max};
  const char *const allowed[COLUMNS] = {r->temperature ? "0 to 3.2e9 s" : "0 to 1e6 s",
                                        r->temperature ? "-100 to 150 degC"
                                        : r->speed     ? "at most 100 m/s in either direction"
                                        : force        ? "at most 1e5 N in either direction"
                                                       : "at most 200 mm in either direction"};
  SbModelSeries *out = r->out;
  double si[COLUMNS];
  for (int i = 0; i < COLUMNS; i++) {
    si[i] = value[i][row] * r->scale[i] + (i == 1 ? r->offset : 0);
    if (!(fabs(si[i]) <= limit[i]) || (i == 1 && r->temperature && si[i] < cold)) {
      sb_issues_add(r->issues, r->name, 0, NULL, allowed[i], "row %zu: column %d is out of range",
                    row + 1, i + 1);
      return false;
    }
  }
  if (out->count == SB_MODEL_SERIES_MAX) {
    sb_issues_add(r->issues, r->name, 0, NULL, NULL, "has more than the %d rows of a series",
                  SB_MODEL_SERIES_MAX);
    return false;
  }
  if (out->count > 0 && !(si[0] > out->time[out->count - 1])) {
    sb_issues_add(r->issues, r->name, 0, NULL, NULL,
                  "row %zu: its time does not come after the row before", row + 1);
    return false;
  }
  out->time[out->count] = si[0];
  out->value[out->count++] = si[1];
  return true;
}

static bool read_rows(Reader *r, const SbTextTable *table) {
  static const size_t column[COLUMNS] = {0, 1};
  double *value[COLUMNS];
  SbTextTableRows rows;
  if (!sb_text_table_read(&rows, value, table, column, COLUMNS, r->issues)) {
    return false;
  }
  bool good = rows.left_text == NULL;
  if (!good) {
    sb_issues_add(r->issues, r->name, rows.left_line, NULL, "two numbers",
                  "\"%s\" is not a row of the series", rows.left_text);
  }
  for (size_t i = 0; i < rows.rows && good; i++) {
    good = take_row(r, i, value);
  }
  for (int i = 0; i < COLUMNS; i++) {
    g_free(value[i]);
  }
  g_free(rows.left_text);
  return good;
}

static bool parse(SbModelSeries *out, bool speed, bool temperature, const char *text, size_t length,
                  const char *name, GPtrArray *issues) {
  out->count = 0;
  Reader r = {
      .name = name, .issues = issues, .speed = speed, .temperature = temperature, .out = out};
  g_autoptr(SbTextTable) table = sb_text_table_parse(text, length, NULL, name, issues);
  bool good = table != NULL;
  if (good && sb_text_table_columns(table) != COLUMNS) {
    sb_issues_add(issues, name, 0, NULL, "two columns", "has %zu columns",
                  sb_text_table_columns(table));
    good = false;
  }
  for (size_t i = 0; i < COLUMNS && good; i++) {
    good = read_heading(&r, table, i);
  }
  good = good && read_rows(&r, table);
  double start = good ? out->time[0] : 0;
  for (size_t i = 0; i < out->count; i++) {
    out->time[i] -= start;
  }
  out->count = good ? out->count : 0;
  return good;
}

bool sb_series_parse(SbModelSeries *out, const char *text, size_t length, const char *name,
                     GPtrArray *issues) {
  return parse(out, false, false, text, length, name, issues);
}

static bool read_file(SbModelSeries *out, bool speed, bool temperature, const char *path,
                      GPtrArray *issues) {
  size_t length = 0;
  out->count = 0;
  g_autofree char *text = sb_reader_load(&length, path, path, SB_SERIES_BYTES_MAX, issues);
  return text != NULL && parse(out, speed, temperature, text, length, path, issues);
}

bool sb_series_read(SbModelSeries *out, const char *path, GPtrArray *issues) {
  return read_file(out, false, false, path, issues);
}

bool sb_series_read_speed(SbModelSeries *out, const char *path, GPtrArray *issues) {
  return read_file(out, true, false, path, issues);
}

bool sb_series_read_temperature(SbModelSeries *out, const char *path, GPtrArray *issues) {
  return read_file(out, false, true, path, issues);
}
