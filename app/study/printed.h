// A printed table as a file of comma-separated text: comment lines (#) with its source, a heading,
// rows. Cells stay text, for a number's digits tell how far it was rounded.
#pragma once

#include <glib.h>
#include <stdbool.h>

typedef struct {
  char **name;         // of the columns
  GPtrArray *rows;     // of char **, a cell a column
  GPtrArray *comments; // of char *, without the mark
} SbPrinted;

enum { SB_PRINTED_ROWS_MAX = 10000 };

// NULL with an issue. Owned by the caller.
SbPrinted *sb_printed_load(const char *path, GPtrArray *issues);

// Takes NULL.
void sb_printed_free(SbPrinted *printed);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbPrinted, sb_printed_free)

// Cell of a row; NULL: there is no such column. Borrowed.
const char *sb_printed_cell(const SbPrinted *printed, guint row, const char *column);

// A cell's number, and half a unit of its last digit; false: it is none.
bool sb_printed_number(double *out, double *half, const char *cell);
