// See series.h. One complaint is enough: the first thing wrong ends the reading.
#include "app/document/series.h"

#include "app/base/reader.h"
#include "app/document/unit.h"

#include <math.h>
#include <string.h>

enum { COLUMNS = 2 };

typedef struct {
  const char *name;
  GPtrArray *issues;
  int line;
  bool speed;            // in the second column, in place of a drive's quantity
  double scale[COLUMNS]; // to SI
  SbModelSeries *out;
} Reader;

// Ranges of the columns [SI].
static const double time_max = 1e6, displacement_max = 0.2, force_max = 1e5, speed_max = 100;

// One issue: `"text" what`, or `what` alone. Always false.
static bool fail(Reader *r, int column, const char *allowed, const char *text, const char *what) {
  static const char *const names[COLUMNS] = {"column 1 (time): ", "column 2: "};
  char *shown = text != NULL ? sb_printable(text, MIN(strlen(text), 40)) : NULL;
  sb_issues_add(r->issues, r->name, r->line, NULL, allowed, "%s%s%s%s%s",
                column >= 0 ? names[column] : "", shown != NULL ? "\"" : "",
                shown != NULL ? shown : "", shown != NULL ? "\" " : "", what);
  g_free(shown);
  return false;
}

// "displacement [mm]" -> quantity, and the unit's size in SI.
static bool read_heading(Reader *r, int column, char *cell) {
  g_strstrip(cell);
  char *open = strchr(cell, '[');
  char *close = open != NULL ? strchr(open, ']') : NULL;
  if (open == NULL || close == NULL || close[1] != '\0') {
    return fail(r, column,
                column == 0 ? "time [s]"
                : r->speed  ? "speed [m/s]"
                            : "displacement [mm] or force [N]",
                cell, "is not a heading with a unit");
  }
  char *unit = g_strndup(open + 1, (gsize)(close - open - 1));
  *open = '\0';
  g_strchomp(cell);
  const char *si = NULL;
  if (column == 0 && strcmp(cell, "time") == 0) {
    si = "s";
  } else if (column == 1 && r->speed) {
    si = strcmp(cell, "speed") == 0 ? "m/s" : NULL;
  } else if (column == 1 && strcmp(cell, "displacement") == 0) {
    si = "m";
    r->out->quantity = SB_DRIVE_OF_POSITION;
  } else if (column == 1 && strcmp(cell, "force") == 0) {
    si = "N";
    r->out->quantity = SB_DRIVE_OF_FORCE;
  }
  char *one = g_strdup_printf("1 %s", unit);
  bool good =
      si != NULL && sb_quantity_parse(&r->scale[column], one, si, si, NULL) && r->scale[column] > 0;
  if (si == NULL) {
    fail(r, column,
         column == 0 ? "time"
         : r->speed  ? "speed"
                     : "displacement, force",
         cell, "is an unknown quantity");
  } else if (!good) {
    fail(r, column, si, unit, "is no unit for it");
  }
  g_free(one);
  g_free(unit);
  return good;
}

static bool read_row(Reader *r, char **cells) {
  double value[COLUMNS];
  const bool force = !r->speed && r->out->quantity == SB_DRIVE_OF_FORCE;
  const double limit[COLUMNS] = {time_max, r->speed ? speed_max
                                           : force  ? force_max
                                                    : displacement_max};
  const char *const allowed[COLUMNS] = {"0 to 1e6 s", r->speed ? "at most 100 m/s either way"
                                                      : force  ? "at most 1e5 N either way"
                                                               : "at most 200 mm either way"};
  for (int i = 0; i < COLUMNS; i++) {
    if (!sb_number_parse(&value[i], g_strstrip(cells[i]))) {
      return fail(r, i, NULL, cells[i], "is not a number");
    }
    value[i] *= r->scale[i];
    if (!(fabs(value[i]) <= limit[i])) {
      return fail(r, i, allowed[i], cells[i], "is out of range");
    }
  }
  SbModelSeries *out = r->out;
  if (out->count == SB_MODEL_SERIES_MAX) {
    char *most = g_strdup_printf("at most %d rows", SB_MODEL_SERIES_MAX);
    fail(r, -1, most, NULL, "the series is too long");
    g_free(most);
    return false;
  }
  if (out->count > 0 && !(value[0] > out->time[out->count - 1])) {
    return fail(r, 0, NULL, cells[0], "does not come after the row before");
  }
  out->time[out->count] = value[0];
  out->value[out->count++] = value[1];
  return true;
}

static bool read_lines(Reader *r, char **lines) {
  bool headed = false;
  for (int i = 0; lines[i] != NULL; i++) {
    r->line = i + 1;
    char *line = g_strstrip(lines[i]);
    if (*line == '\0' || *line == '#') {
      continue;
    }
    char **cells = g_strsplit_set(line, ",;\t", COLUMNS + 1);
    bool good = g_strv_length(cells) == COLUMNS;
    if (!good) {
      fail(r, -1, "two columns", line, "has not two columns");
    } else if (!headed) {
      headed = true;
      good = read_heading(r, 0, cells[0]) && read_heading(r, 1, cells[1]);
    } else {
      good = read_row(r, cells);
    }
    g_strfreev(cells);
    if (!good) {
      return false;
    }
  }
  r->line = 0;
  if (r->out->count < 2) {
    return fail(r, -1, "at least two rows", NULL, "has too few rows for a series");
  }
  return true;
}

static bool parse(SbModelSeries *out, bool speed, const char *text, size_t length, const char *name,
                  GPtrArray *issues) {
  out->count = 0;
  Reader r = {.name = name, .issues = issues, .speed = speed, .out = out};
  if (memchr(text, '\0', length) != NULL || !g_utf8_validate(text, (gssize)length, NULL)) {
    return fail(&r, -1, NULL, NULL, "is not UTF-8 text");
  }
  size_t mark = length >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
  char *copy = g_strndup(text + mark, length - mark);
  char **lines = g_strsplit(copy, "\n", -1);
  bool good = read_lines(&r, lines);
  double start = good ? out->time[0] : 0;
  for (size_t i = 0; i < out->count; i++) {
    out->time[i] -= start;
  }
  out->count = good ? out->count : 0;
  g_strfreev(lines);
  g_free(copy);
  return good;
}

bool sb_series_parse(SbModelSeries *out, const char *text, size_t length, const char *name,
                     GPtrArray *issues) {
  return parse(out, false, text, length, name, issues);
}

static bool read_file(SbModelSeries *out, bool speed, const char *path, GPtrArray *issues) {
  size_t length = 0;
  out->count = 0;
  char *text = sb_reader_load(&length, path, path, SB_SERIES_BYTES_MAX, issues);
  bool good = text != NULL && parse(out, speed, text, length, path, issues);
  g_free(text);
  return good;
}

bool sb_series_read(SbModelSeries *out, const char *path, GPtrArray *issues) {
  return read_file(out, false, path, issues);
}

bool sb_series_read_speed(SbModelSeries *out, const char *path, GPtrArray *issues) {
  return read_file(out, true, path, issues);
}
