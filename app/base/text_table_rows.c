// Reads the rows of a table; see text_table.h.
#include "app/base/text_table_private.h"

// Converts times of day to seconds since midnight of the first row. add_days() returns false if it
// is ambiguous whether a date advances by a day or by a month.
typedef struct {
  bool begun;
  SbTextTableClock last;
  double day; // seconds of whole days so far
} Days;

static bool add_days(double *out, Days *days, const SbTextTableClock *clock) {
  const SbTextTableClock last = days->begun ? days->last : *clock;
  const bool midnight = clock->day == 0 && clock->seconds < last.seconds - 43200;
  days->day += 86400.0 * ((double)clock->day - last.day + midnight);
  days->begun = true;
  days->last = *clock;
  *out = days->day + clock->seconds;
  return clock->day == last.day ||
         (clock->day > 0 && last.day > 0 && !clock->ambiguous && !last.ambiguous);
}

static const char ambiguous_date[] = "is ambiguous: the date advances by a day or by a month";

// The cells of a line.
typedef struct {
  size_t cells;
  bool any, good;    // a wanted cell has a number; all wanted cells do, or have no value
  size_t unreadable; // wanted cells that are not empty and have none
} Line;

// Reads the requested columns of a line to row[count]. Returns what is wrong, static, or NULL.
static const char *read_line(Line *out, double *row, Days *days, const SbTextTable *table,
                             const size_t *column, size_t count, const GString *text) {
  SbTextTableCell cell[SB_TEXT_TABLE_COLUMNS_MAX];
  const char *wrong = NULL;
  const size_t cells = sb_text_table_split(cell, text->str, text->len, table->dialect.separator);
  *out = (Line){.cells = cells, .good = cells <= table->columns};
  for (size_t k = 0; k < count && cells <= table->columns; k++) {
    const size_t at = column[k];
    SbTextTableClock clock;
    row[k] = NAN;
    if (at >= cells || cell[at].length == 0) {
      continue;
    }
    bool read;
    if (!table->column[at].clock) {
      read = sb_text_table_number(&row[k], &cell[at], &table->dialect, NULL);
    } else if ((read = sb_text_table_clock(&clock, &cell[at], table->dialect.dates)) && out->good &&
               !add_days(&row[k], &days[k], &clock)) {
      wrong = ambiguous_date;
    }
    out->any |= read;
    out->good &= read || sb_text_table_void(&cell[at]);
    out->unreadable += !read;
  }
  return wrong;
}

// Counts a line that is left out; stores the first one, preferably not a damaged row.
static void leave_line(SbTextTableRows *out, int number, const GString *text, bool damaged) {
  *(damaged ? &out->damaged : &out->skipped) += 1;
  if (out->left_text == NULL || (!damaged && out->skipped == 1)) {
    g_free(out->left_text);
    out->left_line = number;
    out->left_text = sb_printable(text->str, text->len);
  }
}

bool sb_text_table_read(SbTextTableRows *out, double **value, const SbTextTable *table,
                        const size_t *column, size_t count, GPtrArray *issues) {
  *out = (SbTextTableRows){0};
  Days days[SB_TEXT_TABLE_COLUMNS_MAX] = {0};
  double row[SB_TEXT_TABLE_COLUMNS_MAX];
  SbTextTableBlock block = {.names = g_strdup(table->file->names)};
  const char *wrong = NULL;
  bool blank = false, cut = false, other = false, label = false; // label: of the last row
  const size_t lines = table->file->line->len, room = MIN(lines + 1, SB_TEXT_TABLE_ROWS_MAX);
  size_t begun = 0, number = 0; // blocks of rows; of the line
  for (size_t k = 0; k < count; k++) {
    value[k] = g_try_new(double, room);
    wrong = value[k] == NULL ? "needs too much memory for its rows" : wrong;
  }
  for (Line line = {0}; wrong == NULL && number < lines; line = (Line){0}) {
    const GString *text = sb_text_table_line(table, number++);
    if (number <= table->header_lines) {
      if (sb_text_table_is_row(table, text)) {
        leave_line(out, (int)number, text, false);
      }
      continue;
    }
    if (text->len > 0 && strspn(text->str, "#%!") == 0) {
      wrong = read_line(&line, row, days, table, column, count, text);
    }
    other = line.cells != table->columns && (other || (blank && line.cells > 0));
    const bool like = line.good && line.any && !other;
    blank = line.cells == 0;
    const guint64 texts = // all cells are read if there is no other column
        like && count <= table->columns ? sb_text_table_shape(text, &table->dialect).texts : 0;
    const bool labelled = (texts & ~table->file->texts) != 0;
    begun += like && (cut || block.headed || labelled != label);
    label = like ? labelled : label;
    cut = !like && (cut || blank);
    sb_text_table_block_next(&block, like, text, table);
    if (like && (block.names == NULL || g_strcmp0(block.names, table->file->names) == 0)) {
      wrong = wrong == NULL && out->rows == room ? "has too many rows" : wrong;
      for (size_t k = 0; k < count && wrong == NULL; k++) {
        value[k][out->rows] = column[k] < table->columns ? row[k] : (double)begun;
      }
      out->rows += wrong == NULL;
    } else if (line.cells > 0 && (line.any || line.unreadable > 0 || !line.good)) {
      const bool damaged = memchr(text->str, '\0', text->len) != NULL || (other && line.good) ||
                           (line.cells == table->columns && line.any && line.unreadable == 1);
      leave_line(out, (int)number, text, damaged);
    }
  }
  for (size_t k = 0; k < count; k++) { // freed where its size becomes 0
    value[k] = g_renew(double, value[k], wrong == NULL ? MAX(out->rows, 1) : 0);
  }
  if (wrong != NULL) {
    const bool date = wrong == ambiguous_date;
    sb_issues_add_choice(issues, table->file->shown, (int)number, date ? "dates" : NULL,
                         date ? "day-month\nmonth-day" : NULL, !date, "%s", wrong);
    g_clear_pointer(&out->left_text, g_free);
  }
  g_free(block.names);
  return wrong == NULL;
}

size_t sb_text_table_changes(const SbTextTable *table, size_t column) {
  SbTextTableCell cell[SB_TEXT_TABLE_COLUMNS_MAX], last = {0};
  size_t changes = 0;
  for (size_t i = table->header_lines; i < table->file->line->len; i++) {
    const GString *line = sb_text_table_line(table, i);
    if (sb_text_table_is_row(table, line) &&
        column < sb_text_table_split(cell, line->str, line->len, table->dialect.separator) &&
        cell[column].length > 0) {
      changes += last.length > 0 && (cell[column].length != last.length ||
                                     memcmp(cell[column].text, last.text, last.length) != 0);
      last = cell[column];
    }
  }
  return changes;
}

// Appends and counts the numbers of a line, without empty last cells beyond `columns`; -1: a text.
static gssize append_cells(GArray *out, const GString *line, size_t columns, size_t most,
                           const SbTextTableDialect *dialect) {
  const char *at = line->str;
  SbTextTableCell cell;
  const guint begin = out->len;
  size_t count = 0, filled = 0;
  for (; count <= most && sb_text_table_cell(&cell, &at, line->str + line->len, dialect->separator);
       count++) {
    double value;
    if (!sb_text_table_number(&value, &cell, dialect, NULL)) {
      return -1;
    }
    filled = cell.length > 0 ? count + 1 : filled;
    g_array_append_val(out, value);
  }
  count = filled > 0 ? MAX(filled, MIN(count, columns)) : 0;
  g_array_set_size(out, begin + (guint)count);
  return (gssize)count;
}

bool sb_text_table_read_matrix(SbTextTableMatrix *out, const SbTextTable *table, size_t most,
                               GPtrArray *issues) {
  *out = (SbTextTableMatrix){.value = g_array_new(FALSE, FALSE, sizeof(double))};
  SbTextTableBlock block = {.names = g_strdup(table->file->names)};
  bool good = true;
  int number = 0;
  while (good && (guint)number < table->file->line->len) {
    const GString *text = sb_text_table_line(table, (size_t)number++);
    const bool above = (size_t)number <= table->header_lines, headed = block.headed;
    const size_t columns = out->rows > 0 ? out->columns : table->file->shape.cells;
    const guint begin = out->value->len;
    const bool data = text->len > 0 && strspn(text->str, "#%!") == 0;
    const gssize count = data ? append_cells(out->value, text, columns, most, &table->dialect) : 0;
    if (!above && (count != 0 || text->len == 0)) {
      sb_text_table_block_next(&block, count > 0, text, table);
    }
    const bool other = above || g_strcmp0(block.names, table->file->names) != 0;
    if (count > 0 && other) {
      out->other_line = out->other == 0 ? number : out->other_line;
      out->other++;
    } else if (count > 0) {
      out->columns = out->rows == 0 ? (size_t)count : out->columns;
      out->ragged = out->ragged == 0 && (size_t)count != out->columns ? number : out->ragged;
      out->rows++;
    }
    g_array_set_size(out->value, other || count < 0 ? begin : out->value->len);
    if (!above && ((count < 0 && !block.headed) || (count > 0 && headed && !other))) {
      g_autofree char *shown = sb_printable(text->str, MIN(text->len, 40));
      good = sb_issues_add(
          issues, table->file->shown, number, NULL, NULL,
          count < 0 ? "numbers expected, not \"%s\"" : "begins the table again: \"%s\"", shown);
    } else if ((count > 0 && (size_t)count > most) || out->value->len > 3 * most) {
      good = sb_issues_add(issues, table->file->shown, number, NULL, NULL, "has too many numbers");
    }
  }
  g_free(block.names);
  if (good && 2 * out->other >= out->rows) {
    good = sb_issues_add(
        issues, table->file->shown, out->other_line, NULL, NULL,
        "%zu rows of numbers are another table than the %zu of the longest: remove one", out->other,
        out->rows);
  }
  if (!good) {
    g_clear_pointer(&out->value, g_array_unref);
  }
  return good;
}
