// Tables of numbers in text files, as test machines, loggers and instruments export them.
// Separator, decimal mark, encoding, first row, names and units of the columns are recognised from
// the file; the caller can specify them instead.
// Cells are separated by tab, semicolon, comma, | or blanks, and may be in double quotes. Numbers
// have a decimal point or comma, may have the other one (or an apostrophe or blank) between
// thousands, may have a typographic minus, and are rounded once: equal digits give equal doubles. A
// time can be a time of day, 10:15:00.25, with or without a date. Lines that begin with #, % or !
// are comments. The table is the longest block of rows with the same cells. A line of names above
// rows begins a block, directly after a row if it names each column, as does a line of units;
// blocks under the same names and units are one. Other rows, such as those of a results table, are
// not read. The lines above the table are its header: its last ones give names and units. A unit is
// in brackets, follows "in", "/", "_" or a blank, or is in a line of units. An ambiguous file (all
// commas before three digits: decimals or thousands?) is refused with both interpretations in the
// message. The text is in memory until the table is freed.
#pragma once

#include "app/base/issue.h"

#include <stdbool.h>
#include <stddef.h>

// Encoding of the text.
typedef enum {
  SB_TEXT_TABLE_ANY_ENCODING, // to be recognised
  SB_TEXT_TABLE_UTF8,
  SB_TEXT_TABLE_LATIN1, // also Windows-1252, for letters and µ
  SB_TEXT_TABLE_UTF16LE,
  SB_TEXT_TABLE_UTF16BE,
  SB_TEXT_TABLE_SHIFT_JIS,
  SB_TEXT_TABLE_GBK
} SbTextTableEncoding;

// Names of the encodings for users, "any" first, ended by NULL.
extern const char *const sb_text_table_encodings[];

// Separator of a matrix: each second comma, as the others are decimal marks.
enum { SB_TEXT_TABLE_PAIRS = 1 };

// Format of a table.
typedef struct {
  SbTextTableEncoding encoding;
  char separator; // '\t', ';', ',', '|', ' ' for blanks, SB_TEXT_TABLE_PAIRS; 0: to be recognised
  char decimal;   // '.' or ','; 0: to be recognised
  char thousands; // only recognised: '.' or ','; 0: neither
  char dates;     // first number of an ambiguous date: 'd' day, 'm' month; 0: refused
  bool matrix;    // all cells are numbers or void (NaN); then one column is enough
} SbTextTableDialect;

// Largest number of columns.
enum { SB_TEXT_TABLE_COLUMNS_MAX = 64 };

// A column.
typedef struct {
  char *name;   // without its unit; empty: none
  char *unit;   // its usual spelling where the file's is known, else the file's; empty: none
  char *other;  // another unit that the file states in the name or in a line of units; NULL: none
  bool numeric; // its cells are numbers
  bool clock;   // its cells are times of day
} SbTextTableColumn;

// A table. All but names and units of columns is read-only.
typedef struct {
  SbTextTableDialect dialect;
  char **header;       // lines above the first row as UTF-8, without comment signs and with ; for
                       // tabs, ended by NULL
  size_t header_lines; // number of lines before the first row
  size_t columns;
  SbTextTableColumn column[SB_TEXT_TABLE_COLUMNS_MAX]; // [columns]
  struct SbTextTableFile *file;                        // internal
} SbTextTable;

// Recognises the format of the `length` bytes of a file, whose path in messages is `name`; `wish`
// (NULL: nothing) specifies what is known. Returns NULL with one issue if it is not a table.
SbTextTable *sb_text_table_parse(const void *bytes, size_t length, const SbTextTableDialect *wish,
                                 const char *name, GPtrArray *issues);

// Frees a table.
void sb_text_table_free(SbTextTable *table);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbTextTable, sb_text_table_free)

// Largest number of rows.
enum { SB_TEXT_TABLE_ROWS_MAX = 50000000 };

// What was read.
typedef struct {
  size_t rows;    // rows in the arrays
  size_t damaged; // rows left out: unreadable cell, NUL, or other columns behind a blank line
  size_t skipped; // other lines between rows, and rows of other blocks above them, left out
  int left_line;  // number of the first skipped line, from 1; if none is, of the first row left out
  char *left_text; // its text, freed by g_free(); NULL: no line was left out
} SbTextTableRows;

// Reads the columns column[count] (indices) of all rows: value[k] becomes an array [rows] of the
// numbers of column[k] in the file's units (g_free()), times of day in seconds from midnight of the
// first day, NaN for an empty cell; for the index table->columns, the row's block, from 0, cut at
// blank lines and names, and where rows with a label in a column without texts begin or end.
// Returns false with one issue: memory, too many rows, ambiguous dates.
bool sb_text_table_read(SbTextTableRows *out, double **value, const SbTextTable *table,
                        const size_t *column, size_t count, GPtrArray *issues);

// Returns how often the text of a column changes from row to row; empty cells are as above them.
size_t sb_text_table_changes(const SbTextTable *table, size_t column);

// Numbers of a matrix, row after row.
typedef struct {
  GArray *value;        // of double; NaN: void. Freed by g_array_unref()
  size_t rows, columns; // lines; numbers of the first one
  int ragged;           // number of the first line with another count of numbers; 0: none
  size_t other;         // rows of other blocks, not read
  int other_line;       // number of the first one
} SbTextTableMatrix;

// Reads all numbers of a table that was opened with `matrix`, at most `most` of a line and 3 `most`
// altogether. Returns false with one issue, *out then empty, if there are more, if a line directly
// behind a row has a cell that is not a number, or if other blocks have half as many rows.
bool sb_text_table_read_matrix(SbTextTableMatrix *out, const SbTextTable *table, size_t most,
                               GPtrArray *issues);

// Reads the number at the start of `text`, with a decimal point, or with a comma if `decimal` is
// ',' or not just 3 digits follow it. Returns the number of bytes read; 0, *out unchanged: none.
size_t sb_text_table_number_at(double *out, const char *text, char decimal);

// Returns the usual spelling of a unit, as app/base/unit.h reads it: "s" for "Sek."; NULL: unknown.
const char *sb_text_table_unit(const char *text);
