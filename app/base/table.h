// Tables of numbers in text files, as test machines and loggers export them: what separates cells,
// which mark is decimal, which encoding, where the numbers begin, what their columns are called and
// in which units. Recognised from the file, told, and replaced by what the caller wishes.
//
// Cells are separated by tab, semicolon, comma or blanks, and may stand in double quotes. Numbers
// have a decimal point or comma, may have the other one (or an apostrophe) between thousands, and
// are rounded once: the same digits give the same double in every dialect. A time may be a clock's,
// 10:15:00.25, with or without a date. Lines that begin with # are comments, anything else before
// the first row is a header; its last lines with as many cells as the rows give names and units.
//
// A file that reads in two ways (all commas before three digits: decimals or thousands?) is
// refused with both readings named. The file stays open and is read a piece at a time, so that
// memory is what the columns that are asked for take; one that is cut short meanwhile is refused.
#pragma once

#include "app/base/issue.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum {
  SB_TABLE_ANY_ENCODING, // to be found
  SB_TABLE_UTF8,
  SB_TABLE_LATIN1, // Windows' superset of it too, as far as letters and µ go
  SB_TABLE_UTF16LE,
  SB_TABLE_UTF16BE,
  SB_TABLE_ENCODING_COUNT
} SbTableEncoding;

// "utf-8", "latin-1", "utf-16le", "utf-16be"; borrowed.
const char *sb_table_encoding_name(SbTableEncoding encoding);

typedef struct {
  SbTableEncoding encoding;
  char separator; // '\t', ';', ',' or ' ' for blanks; 0: to be found
  char decimal;   // '.' or ','; 0: to be found
  char thousands; // found: '.', ',', '\'' or 0 for none
} SbTableDialect;

enum { SB_TABLE_COLUMNS_MAX = 64 };

typedef struct {
  char *name; // without its unit; empty where the file has none
  char *unit; // as the file has it; empty where it has none
  bool numeric, clock;
} SbTableColumn;

typedef struct SbTable SbTable;

// Recognises a file, or bytes that are copied; `wish` (may be NULL) says what is known already,
// `name` stands in messages. NULL with one issue. Owned by the caller.
SbTable *sb_table_open(const char *path, const SbTableDialect *wish, GPtrArray *issues);
SbTable *sb_table_parse(const void *bytes, size_t length, const SbTableDialect *wish,
                        const char *name, GPtrArray *issues);

// Takes NULL.
void sb_table_free(SbTable *table);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbTable, sb_table_free)

const SbTableDialect *sb_table_dialect(const SbTable *table);
size_t sb_table_columns(const SbTable *table);
const SbTableColumn *sb_table_column(const SbTable *table, size_t index); // borrowed
size_t sb_table_header_lines(const SbTable *table);                       // before the first row

// Names a column, in place of what its header says (NULL: as it is).
void sb_table_rename(SbTable *table, size_t index, const char *name, const char *unit);

enum { SB_TABLE_ROWS_MAX = 50000000 };

// Reads `count` columns of all rows: value[k][row] of column[k], clocks in seconds (from midnight
// of the first day), NaN for an empty cell. The arrays are owned by the caller (g_free). A row is
// `damaged` if a cell of it cannot be read while others can, or if it contains a NUL. Other lines
// between rows are `skipped`. Both are left out; the number and text of the first line that is left
// out (owned by the caller, NULL for none). False with one issue: no memory, too many rows, or days
// and months that read in two ways.
typedef struct {
  size_t rows, damaged, skipped;
  int left_line;
  char *left_text;
} SbTableRows;
bool sb_table_read(SbTableRows *out, double **value, const SbTable *table, const size_t *column,
                   size_t count, GPtrArray *issues);

// A text that is one number with this decimal mark and nothing between thousands; false, *out
// untouched, where it is none.
bool sb_table_number_of(double *out, const char *text, size_t length, char decimal);
