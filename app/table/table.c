// A table of results and its outputs; see the header.
#include "app/table/table.h"

#include "app/base/unit.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

struct SbTable {
  const SbTableColumn *column;
  size_t columns;
  GPtrArray *row; // of SbTableRow, whose texts are in `texts`
  GStringChunk *texts;
};

SbTable *sb_table_new(const SbTableColumn *columns, size_t count) {
  SbTable *table = g_new(SbTable, 1);
  *table =
      (SbTable){columns, count, g_ptr_array_new_with_free_func(g_free), g_string_chunk_new(1024)};
  return table;
}

void sb_table_free(SbTable *table) {
  if (table != NULL) {
    g_ptr_array_unref(table->row);
    g_string_chunk_free(table->texts);
    g_free(table);
  }
}

// Returns a copy of a text for the life of the table.
static const char *keep(SbTable *table, const char *text) {
  return text != NULL ? g_string_chunk_insert(table->texts, text) : NULL;
}

static SbTableRow *add_row(SbTable *table) {
  SbTableRow *row = g_malloc0(sizeof *row + table->columns * sizeof row->cell[0]);
  g_ptr_array_add(table->row, row);
  return row;
}

void sb_table_add(SbTable *table, const SbTableCell *cells) {
  SbTableRow *row = add_row(table);
  for (size_t k = 0; k < table->columns; k++) {
    row->cell[k] = cells[k];
    const char *own = keep(table, cells[k].own);
    row->cell[k].own = NULL;
    row->cell[k].text = own != NULL ? own : keep(table, cells[k].text);
    row->cell[k].shown = own != NULL ? own : keep(table, cells[k].shown);
    g_free(cells[k].own);
  }
}

void sb_table_mark(SbTable *table, SbTableMark mark) {
  ((SbTableRow *)table->row->pdata[table->row->len - 1])->mark = mark;
}

void sb_table_note(SbTable *table, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *text = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  add_row(table)->note = keep(table, text);
}

const SbTableColumn *sb_table_columns(const SbTable *table, size_t *count) {
  *count = table->columns;
  return table->column;
}

const SbTableRow *sb_table_row(const SbTable *table, size_t index) {
  return index < table->row->len ? table->row->pdata[index] : NULL;
}

char *sb_table_shown(const SbTableCell *cell) {
  if (cell->shown != NULL || cell->kind == SB_CELL_TEXT || cell->kind == SB_CELL_ABSENT) {
    return g_strdup(cell->shown != NULL ? cell->shown : cell->text != NULL ? cell->text : "");
  }
  if (cell->unit != NULL) {
    return sb_quantity_round(cell->number, cell->si, cell->unit, cell->digits);
  }
  char digits[SB_NUMBER_SIZE];
  return g_strdup(!isfinite(cell->number)        ? "-"
                  : cell->kind == SB_CELL_NUMBER ? sb_number_format(digits, cell->number)
                  : cell->number > 0             ? "yes"
                                                 : "no");
}

// ---- Text ----

// Number of characters of the longest cell of column `k`.
static int longest(const SbTable *table, size_t k) {
  glong width = 0;
  for (guint i = 0; i < table->row->len; i++) {
    const SbTableRow *row = table->row->pdata[i];
    g_autofree char *text = sb_table_shown(&row->cell[k]);
    width = MAX(width, g_utf8_strlen(text, -1));
  }
  return (int)width;
}

// Appends a text in a layout; `width` is that of "*".
static void put_cell(GString *out, const char *layout, int width, const char *text) {
  const char *field = strchr(layout, '%'), *digits = field + 1 + (field[1] == '-');
  width = *digits == '*' ? width : atoi(digits);
  if (*text == '\0' && width == 0) {
    return;
  }
  const int gap = MAX(width - (int)g_utf8_strlen(text, -1), 0);
  const bool left = field[1] == '-';
  g_string_append_len(out, layout, field - layout);
  g_string_append_printf(out, "%*s%s%*s%s", left ? 0 : gap, "", text, left ? gap : 0, "",
                         strchr(field, 's') + 1);
}

// Appends a line of text: the row `row`, or the headings if it is NULL.
static void put_line(GString *out, const SbTable *table, const SbTableRow *row, const int *width) {
  for (size_t k = 0; k < table->columns; k++) {
    const SbTableColumn *column = &table->column[k];
    if (column->layout != NULL) {
      g_autofree char *text = row != NULL ? sb_table_shown(&row->cell[k]) : g_strdup(column->head);
      put_cell(out, column->layout, width[k], text != NULL ? text : "");
    }
  }
  g_string_append_c(out, '\n');
}

char *sb_table_text(const SbTable *table) {
  GString *out = g_string_new(NULL);
  g_autofree int *width = g_new0(int, table->columns);
  bool headed = false;
  for (size_t k = 0; k < table->columns; k++) {
    const char *layout = table->column[k].layout;
    width[k] = layout != NULL && strchr(layout, '*') != NULL ? longest(table, k) : 0;
    headed = headed || table->column[k].head != NULL;
  }
  if (headed && table->row->len > 0) {
    put_line(out, table, NULL, width);
  }
  for (guint i = 0; i < table->row->len; i++) {
    const SbTableRow *row = table->row->pdata[i];
    if (row->note != NULL) {
      g_string_append_printf(out, "%s\n", row->note);
    } else {
      put_line(out, table, row, width);
    }
  }
  return g_string_free(out, FALSE);
}

// ---- Files ----

void sb_csv_cell(FILE *stream, const SbTableCell *cell) {
  char digits[SB_NUMBER_SIZE];
  if (cell->kind != SB_CELL_TEXT) {
    const bool known = cell->kind != SB_CELL_ABSENT && !isnan(cell->number);
    fputs(known ? sb_number_format(digits, cell->number) : "", stream);
    return;
  }
  const char *text = cell->text != NULL ? cell->text : "";
  const bool quoted = strpbrk(text, ",;\"\r\n\t") != NULL;
  fputs(quoted ? "\"" : "", stream);
  fputs(*text != '\0' && strchr("=+-@\t\r", *text) != NULL ? "'" : "", stream);
  for (; *text != '\0'; text++) {
    fputs(*text == '"' ? "\"" : "", stream);
    fputc(*text, stream);
  }
  fputs(quoted ? "\"" : "", stream);
}

void sb_csv_row(FILE *stream, const SbTableCell *cells, size_t count) {
  for (size_t k = 0; k < count; k++) {
    fputs(k > 0 ? "," : "", stream);
    sb_csv_cell(stream, &cells[k]);
  }
  fputc('\n', stream);
}

// Writes the row `row`, or the headings if it is NULL.
static void put_csv(FILE *stream, const SbTable *table, const SbTableRow *row) {
  const char *before = "";
  for (size_t k = 0; k < table->columns; k++) {
    const SbTableCell heading = sb_cell_text(table->column[k].key);
    if (heading.text != NULL) {
      fputs(before, stream);
      sb_csv_cell(stream, row != NULL ? &row->cell[k] : &heading);
      before = ",";
    }
  }
  fputc('\n', stream);
}

void sb_table_csv(FILE *stream, const SbTable *table) {
  put_csv(stream, table, NULL);
  for (guint i = 0; i < table->row->len && ferror(stream) == 0; i++) {
    const SbTableRow *row = table->row->pdata[i];
    if (row->note == NULL) {
      put_csv(stream, table, row);
    }
  }
}

void sb_json_cell(SbJson *json, const char *key, const SbTableCell *cell) {
  if (cell->kind == SB_CELL_TEXT) {
    sb_json_string(json, key, cell->text);
  } else if (cell->kind == SB_CELL_NUMBER) {
    sb_json_number(json, key, cell->number);
  } else if (cell->kind == SB_CELL_ANSWER) {
    sb_json_answer(json, key,
                   isnan(cell->number) ? SB_ANSWER_UNKNOWN
                   : cell->number > 0  ? SB_ANSWER_YES
                                       : SB_ANSWER_NO);
  }
}

void sb_table_json(SbJson *json, const char *key, const SbTable *table) {
  const bool named = table->column[0].key == NULL;
  (named ? sb_json_object : sb_json_array)(json, key);
  for (guint i = 0; i < table->row->len; i++) {
    const SbTableRow *row = table->row->pdata[i];
    if (row->note != NULL) {
      continue;
    }
    sb_json_object(json, named ? row->cell[0].text : NULL);
    for (size_t k = 0; k < table->columns; k++) {
      if (table->column[k].key != NULL) {
        sb_json_cell(json, table->column[k].key, &row->cell[k]);
      }
    }
    sb_json_object_end(json);
  }
  (named ? sb_json_object_end : sb_json_array_end)(json);
}

// ---- Pages ----

// Appends the row `row`, or the headings if it is NULL.
static void put_html(GString *out, const SbTable *table, const SbTableRow *row) {
  if (row != NULL && row->note != NULL) {
    return;
  }
  g_string_append(out,
                  row != NULL && row->mark == SB_TABLE_WRONG ? "<tr class=\"fails\">" : "<tr>");
  for (size_t k = 0; k < table->columns; k++) {
    const char *label = table->column[k].label;
    if (label != NULL) {
      const bool number = row != NULL && row->cell[k].kind == SB_CELL_NUMBER;
      g_autofree char *plain = row != NULL ? sb_table_shown(&row->cell[k]) : g_strdup(label);
      g_autofree char *text = g_markup_escape_text(plain, -1);
      const char *element = row != NULL ? "td" : "th";
      g_string_append_printf(out, "<%s%s>%s</%s>", element, number ? " class=\"n\"" : "", text,
                             element);
    }
  }
  g_string_append(out, "</tr>\n");
}

char *sb_table_html(const SbTable *table) {
  GString *out = g_string_new("<table>");
  put_html(out, table, NULL);
  for (guint i = 0; i < table->row->len; i++) {
    put_html(out, table, table->row->pdata[i]);
  }
  return g_string_free(g_string_append(out, "</table>\n"), FALSE);
}

char *sb_table_markdown(const SbTable *table) {
  GString *out = g_string_new("|"), *rule = g_string_new("\n|");
  for (size_t k = 0; k < table->columns; k++) {
    const char *label = table->column[k].label;
    if (label != NULL) {
      g_string_append_printf(out, "%s%s |", *label != '\0' ? " " : "", label);
      g_string_append(rule, "---|");
    }
  }
  g_string_append(out, rule->str);
  g_string_free(rule, TRUE);
  for (guint i = 0; i < table->row->len; i++) {
    const SbTableRow *row = table->row->pdata[i];
    g_string_append(out, row->note == NULL ? "\n|" : "");
    for (size_t k = 0; k < table->columns && row->note == NULL; k++) {
      if (table->column[k].label != NULL) {
        g_autofree char *text = sb_table_shown(&row->cell[k]);
        g_string_append_printf(out, " %s |", text);
      }
    }
  }
  return g_string_free(g_string_append_c(out, '\n'), FALSE);
}
