// A printed table as a file of comma-separated text: comment lines (#) with its source, a heading
// and rows. Cells are texts, because the digits of a number show how it was rounded.
#pragma once

#include <glib.h>
#include <stdbool.h>

// A table. Freed by sb_printed_free().
typedef struct {
  char **name;         // of the columns, ends with NULL
  GPtrArray *rows;     // of char **: a cell for each column, ends with NULL
  GPtrArray *comments; // of char *: comment lines without the mark
} SbPrinted;

// Largest number of rows.
enum { SB_PRINTED_ROWS_MAX = 10000 };

// Reads the file `path`. Returns NULL with an issue.
SbPrinted *sb_printed_load(const char *path, GPtrArray *issues);

// Frees a table.
void sb_printed_free(SbPrinted *printed);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbPrinted, sb_printed_free)

// Returns the cell of row `row` (from 0) in the column of this name; NULL: there is no such column.
const char *sb_printed_cell(const SbPrinted *printed, guint row, const char *column);

// Reads the number of a cell to *out, and half of the unit of its last digit to *half, both in the
// cell's unit. Returns false, with both not changed, if the cell is not a number. `cell` may be
// NULL, which is not a number.
bool sb_printed_number(double *out, double *half, const char *cell);
