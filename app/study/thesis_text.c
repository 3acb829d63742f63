// Texts of the thesis' items with values in them: cells of the printed row, computed figures.
#include "app/study/thesis_private.h"

#include "app/base/unit.h"

#include <math.h>
#include <string.h>

char *sb_thesis_with_cells(const SbThesisPlace *at, const char *text) {
  const char *open = strchr(text, '['), *close = open != NULL ? strchr(open, ']') : NULL;
  if (close == NULL || at->work->printed == NULL) {
    return g_strdup(text);
  }
  g_autofree char *column = g_strndup(open + 1, (gsize)(close - open - 1));
  const char *cell = sb_printed_cell(at->work->printed, (guint)MAX(at->row, 0), column);
  return g_strdup_printf("%.*s%s%s", (int)(open - text), text, cell != NULL ? cell : "", close + 1);
}

static void put_value(GString *out, double value, const char *si, const char *shown, int digits) {
  char text[SB_NUMBER_SIZE];
  g_string_append(out, isfinite(value)
                           ? sb_number_round(text, sb_quantity_to_shown(value, si, shown), digits)
                           : "?");
}

// "COLUMN" or "COLUMN:FROM:TO" of the printed row.
static void put_cell(GString *out, const SbThesisPlace *at, const char *inside) {
  g_auto(GStrv) part = g_strsplit(inside, ":", 3);
  const char *cell = at->work->printed != NULL
                         ? sb_printed_cell(at->work->printed, (guint)MAX(at->row, 0), part[0])
                         : NULL;
  double value, half;
  if (g_strv_length(part) == 3 && sb_printed_number(&value, &half, cell)) {
    put_value(out, value, part[1], part[2], 6);
  } else {
    g_autofree char *words = g_strdelimit(g_strdup(cell != NULL ? cell : "?"), "_", ' ');
    g_string_append(out, words);
  }
}

// "GRID: EXPRESSION, SI shown", at the grid's first sample, to three digits.
static void put_expression(GString *out, const SbThesisPlace *from, const char *inside,
                           const char *group, const char *key) {
  SbThesisPlace at = *from;
  g_auto(GStrv) part = g_strsplit(inside, ",", 2);
  g_auto(GStrv) unit = g_strsplit(part[1] != NULL ? g_strstrip(part[1]) : "1", " ", 2);
  const char *expression, *shown = unit[1] != NULL             ? unit[1]
                                   : strcmp(unit[0], "1") == 0 ? ""
                                                               : unit[0];
  double value = NAN;
  if (sb_thesis_grid(&at.grid, &expression, at.work, g_strstrip(part[0]), group, key)) {
    (void)sb_thesis_value(&value, &at, expression, group, key);
  }
  put_value(out, value, unit[0], shown, 3);
  g_string_append_printf(out, "%s%s", *shown != '\0' ? " " : "", shown);
}

char *sb_thesis_filled(const SbThesisPlace *at, const char *text, const char *group,
                       const char *key) {
  GString *out = g_string_new(NULL);
  for (const char *c = text; *c != '\0'; c++) {
    const char *close = *c == '{' ? strchr(c, '}') : NULL;
    if (close == NULL) {
      g_string_append_c(out, *c);
      continue;
    }
    g_autofree char *inside = g_strndup(c + 1, (gsize)(close - c - 1));
    if (*inside == '=') {
      put_expression(out, at, inside + 1, group, key);
    } else {
      put_cell(out, at, inside);
    }
    c = close;
  }
  return g_string_free(out, FALSE);
}
