// One table of results and its outputs: text for a terminal, CSV, JSON, HTML, Markdown and the
// pages of a report (app/export/report_pages.h). Its rows are filled once; each output has the
// columns that its field of SbTableColumn names. Numbers of files are exact and in SI units; people
// read the text of a cell.
#pragma once

#include "app/table/json.h"

#include <math.h>
#include <stdio.h>

// A column. A field that is NULL leaves the column out of the outputs of that field.
typedef struct {
  const char *key; // heading in CSV, name of the member in JSON
  // In text: one "%12s" (right-aligned) or "%-12s" with the least number of characters, "%*s" or
  // "%-*s" for the width of the longest cell, or "%s", which an empty cell leaves out with the
  // texts around it: ", %s". Nothing else is written between columns.
  const char *layout;
  const char *label; // heading in HTML, Markdown and reports
  const char *head;  // heading in text; NULL: none
  double width;      // on pages of a report, relative to the other columns there, > 0
} SbTableColumn;

typedef enum { SB_CELL_ABSENT, SB_CELL_TEXT, SB_CELL_NUMBER, SB_CELL_ANSWER } SbTableCellKind;

// A cell. `text` and `shown` are borrowed; a table copies them. Each cell with `own` must be added
// to a table.
typedef struct {
  SbTableCellKind kind;  // ABSENT: an empty cell, and no member in JSON
  double number;         // NaN: empty in CSV, null in JSON, "-" in text; of an answer 0 no, 1 yes
  const char *text;      // in files; NULL: an empty cell, null in JSON
  const char *shown;     // for people; NULL: `text`, or the number
  const char *si, *unit; // of a number in files and for people, static; NULL: as it is
  int digits;            // of a number with a unit for people, at most
  char *own;             // for people, and `text` of a text; sb_table_add() frees it. NULL: none
} SbTableCell;

// Returns a cell with a text; NULL: an empty one.
static inline SbTableCell sb_cell_text(const char *text) {
  return (SbTableCell){.kind = SB_CELL_TEXT, .text = text};
}

// Returns a cell with a number; NaN: not known.
static inline SbTableCell sb_cell_number(double number) {
  return (SbTableCell){.kind = SB_CELL_NUMBER, .number = number};
}

// Returns a cell with an answer: 0 no, 1 yes, NaN unknown.
static inline SbTableCell sb_cell_answer(double answer) {
  return (SbTableCell){.kind = SB_CELL_ANSWER, .number = answer};
}

// Returns a cell with the number `value` [si], for people as sb_quantity_round() writes it.
static inline SbTableCell sb_cell_quantity(double value, const char *si, const char *unit,
                                           int digits) {
  return (SbTableCell){
      .kind = SB_CELL_NUMBER, .number = value, .si = si, .unit = unit, .digits = digits};
}

// Returns a cell with `text` in files and the text `shown` for people.
static inline SbTableCell sb_cell_text_as(const char *text, const char *shown) {
  return (SbTableCell){.kind = SB_CELL_TEXT, .text = text, .shown = shown};
}

// Returns a cell with `number` in files and the text `shown` for people.
static inline SbTableCell sb_cell_number_as(double number, const char *shown) {
  return (SbTableCell){.kind = SB_CELL_NUMBER, .number = number, .shown = shown};
}

// Returns a cell with `number` in files and, for people, the text `shown`, which sb_table_add()
// frees.
static inline SbTableCell sb_cell_number_own(double number, char *shown) {
  return (SbTableCell){.kind = SB_CELL_NUMBER, .number = number, .own = shown};
}

// Returns a cell with a text that sb_table_add() frees; NULL: an empty one.
static inline SbTableCell sb_cell_own(char *text) {
  return (SbTableCell){.kind = SB_CELL_TEXT, .own = text};
}

// Returns a cell without a value in files, whose number people read as `shown`, which
// sb_table_add() frees; NULL: an empty one.
static inline SbTableCell sb_cell_shown(char *shown) {
  return (SbTableCell){.kind = SB_CELL_NUMBER, .number = NAN, .shown = "", .own = shown};
}

typedef struct SbTable SbTable;

// How a row is marked: by the colours of a report, and a wrong one in HTML by the class "fails".
typedef enum { SB_TABLE_PLAIN, SB_TABLE_DOUBT, SB_TABLE_WRONG } SbTableMark;

// A row of a table.
typedef struct {
  const char *note; // a line of text in place of cells; NULL: cells
  SbTableMark mark;
  SbTableCell cell[]; // [columns] of the table; without `own`
} SbTableRow;

// Returns an empty table with columns[count], borrowed. Freed by sb_table_free().
SbTable *sb_table_new(const SbTableColumn *columns, size_t count);

// Frees a table.
void sb_table_free(SbTable *table);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbTable, sb_table_free)

// Adds a row of one cell for each column.
void sb_table_add(SbTable *table, const SbTableCell *cells);

// The cells of a row for sb_table_add().
#define SB_CELLS(...) ((const SbTableCell[]){__VA_ARGS__})

// Marks the row that was added last, which must exist.
void sb_table_mark(SbTable *table, SbTableMark mark);

// Adds a line between the rows: a subheading, in text and reports alone.
void sb_table_note(SbTable *table, const char *format, ...) G_GNUC_PRINTF(2, 3);

// Returns the columns and writes their number to *count.
const SbTableColumn *sb_table_columns(const SbTable *table, size_t *count);

// Returns row `index`, counted from 0 with the notes; NULL behind the last. Borrowed.
const SbTableRow *sb_table_row(const SbTable *table, size_t index);

// Returns what people read of a cell. Freed by g_free().
char *sb_table_shown(const SbTableCell *cell);

// Returns the table for a terminal: headings, if a column has one, and a line for each row. Freed
// by g_free().
char *sb_table_text(const SbTable *table);

// Writes a cell of CSV: in quotes if it contains a separator, a quote or a line end, and with an
// apostrophe before a text that a spreadsheet would compute as a formula.
void sb_csv_cell(FILE *stream, const SbTableCell *cell);

// Writes a comma and a cell of CSV.
static inline void sb_csv_put(FILE *stream, SbTableCell cell) {
  fputc(',', stream);
  sb_csv_cell(stream, &cell);
}

// Writes a row of CSV with its line end. Errors of writing remain in the stream (ferror()).
void sb_csv_row(FILE *stream, const SbTableCell *cells, size_t count);

// Writes the headings and the rows of CSV, in UTF-8 with a point in numbers in every locale.
void sb_table_csv(FILE *stream, const SbTable *table);

// Writes a member with the value of a cell; none for an ABSENT cell.
void sb_json_cell(SbJson *json, const char *key, const SbTableCell *cell);

// Writes the rows as objects: elements of an array or, if the first column has no key, members of
// an object that are named by its texts.
void sb_table_json(SbJson *json, const char *key, const SbTable *table);

// Returns the table as an HTML element <table>, numbers with the class "n". Freed by g_free().
char *sb_table_html(const SbTable *table);

// Returns the table as Markdown. Freed by g_free().
char *sb_table_markdown(const SbTable *table);
