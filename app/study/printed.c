#include "app/study/printed.h"

#include "app/base/issue.h"
#include "app/base/number.h"
#include "app/base/reader.h"

#include <math.h>
#include <string.h>

enum { BYTES_MAX = 1 << 20 };

// Cells of a line, trimmed; what stands in double quotes may hold commas.
static char **split(const char *line) {
  g_autoptr(GPtrArray) cells = g_ptr_array_new();
  g_autoptr(GString) cell = g_string_new(NULL);
  bool quoted = false;
  for (const char *at = line;; at++) {
    if (*at == '"') {
      quoted = !quoted;
    } else if (*at == '\0' || (*at == ',' && !quoted)) {
      g_ptr_array_add(cells, g_strstrip(g_strdup(cell->str)));
      g_string_truncate(cell, 0);
      if (*at == '\0') {
        break;
      }
    } else {
      g_string_append_c(cell, *at);
    }
  }
  g_ptr_array_add(cells, NULL);
  return (char **)g_ptr_array_free(g_steal_pointer(&cells), FALSE);
}

static bool take_line(SbPrinted *printed, const char *path, int number, const char *line,
                      GPtrArray *issues) {
  if (*line == '\0') {
    return true;
  }
  if (*line == '#') {
    g_ptr_array_add(printed->comments, g_strstrip(g_strdup(line + 1)));
    return true;
  }
  char **cells = split(line);
  if (printed->name == NULL) {
    printed->name = cells;
    return true;
  }
  g_ptr_array_add(printed->rows, cells);
  if (g_strv_length(cells) != g_strv_length(printed->name)) {
    return sb_issues_add(issues, path, number, NULL, NULL, "the row has %u cells, the heading %u",
                         g_strv_length(cells), g_strv_length(printed->name));
  }
  return printed->rows->len <= SB_PRINTED_ROWS_MAX ||
         sb_issues_add(issues, path, number, NULL, NULL, "has more than %d rows",
                       SB_PRINTED_ROWS_MAX);
}

SbPrinted *sb_printed_load(const char *path, GPtrArray *issues) {
  size_t length = 0;
  g_autofree char *text = sb_reader_load(&length, path, path, BYTES_MAX, issues);
  if (text == NULL) {
    return NULL;
  }
  if (!g_utf8_validate(text, (gssize)length, NULL)) {
    sb_issues_add(issues, path, 0, NULL, NULL, "is not UTF-8");
    return NULL;
  }
  g_autoptr(SbPrinted) printed = g_new0(SbPrinted, 1);
  printed->rows = g_ptr_array_new_with_free_func((GDestroyNotify)g_strfreev);
  printed->comments = g_ptr_array_new_with_free_func(g_free);
  g_auto(GStrv) lines = g_strsplit(text, "\n", -1);
  for (int i = 0; lines[i] != NULL; i++) {
    if (!take_line(printed, path, i + 1, g_strstrip(lines[i]), issues)) {
      return NULL;
    }
  }
  if (printed->name == NULL) {
    sb_issues_add(issues, path, 0, NULL, NULL, "has no heading");
    return NULL;
  }
  return g_steal_pointer(&printed);
}

void sb_printed_free(SbPrinted *printed) {
  if (printed != NULL) {
    g_strfreev(printed->name);
    g_ptr_array_unref(printed->rows);
    g_ptr_array_unref(printed->comments);
    g_free(printed);
  }
}

const char *sb_printed_cell(const SbPrinted *printed, guint row, const char *column) {
  for (guint k = 0; printed->name[k] != NULL; k++) {
    if (strcmp(printed->name[k], column) == 0 && row < printed->rows->len) {
      return ((char **)printed->rows->pdata[row])[k];
    }
  }
  return NULL;
}

bool sb_printed_number(double *out, double *half, const char *cell) {
  size_t exponent = 0;
  double value = 0;
  if (cell == NULL || sb_number_scan(cell, &exponent) != strlen(cell) ||
      !sb_number_parse(&value, cell)) {
    return false;
  }
  // The unit of the last digit: places behind the point, and the exponent's power.
  const char *point = memchr(cell, '.', exponent);
  const double places = point != NULL ? (double)(cell + exponent - point - 1) : 0;
  const double power = cell[exponent] != '\0' ? g_ascii_strtod(cell + exponent + 1, NULL) : 0;
  *out = value;
  *half = 0.5 * pow(10, power - places);
  return true;
}
