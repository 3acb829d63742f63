// Lines, cells and numbers of tables, shared by the files text_table*.c.
#pragma once

#include "app/base/text_table.h"

#include <math.h>
#include <string.h>

// A cell; borrowed from its line, not terminated by 0.
typedef struct {
  const char *text;
  size_t length;
} SbTextTableCell;

// Reads the cell that begins at *at, without blanks and quotes around it, and moves *at behind its
// separator (NULL: behind the last cell). Returns false if no cell is left.
bool sb_text_table_cell(SbTextTableCell *cell, const char **at, const char *end, char separator);

// Splits a line into cell[SB_TEXT_TABLE_COLUMNS_MAX]; returns their number, less empty last ones.
size_t sb_text_table_split(SbTextTableCell *cell, const char *line, size_t length, char separator);

// Returns whether a cell is empty or has a word that instruments write where they have no value.
bool sb_text_table_void(const SbTextTableCell *cell);

// Bits that state which marks numbers have.
enum {
  SB_TEXT_TABLE_SAW_DECIMAL = 1,
  SB_TEXT_TABLE_SAW_GROUPS = 2, // a mark between thousands
  SB_TEXT_TABLE_SAW_LONG = 4,   // four digits or more and no mark between them
  SB_TEXT_TABLE_SAW_BLANK = 8,  // a blank between thousands
  SB_TEXT_TABLE_SAW_PADDED = 16 // a zero before other digits, or -0: no program writes integers so
};

// Reads a number and sets bits of *saw (may be NULL). Returns false, *out unchanged, for a text.
bool sb_text_table_number(double *out, const SbTextTableCell *cell,
                          const SbTextTableDialect *dialect, unsigned *saw);

// A time of day, with a date.
typedef struct {
  double seconds; // since midnight [s]
  guint32 day;    // number of the date's day, from a fixed one; 0: no date, or none that exists
  bool ambiguous; // day and month may be in either order
} SbTextTableClock;

// Reads a cell as a time of day; `dates` (of a dialect) states the order of day and month. Returns
// false if it is none.
bool sb_text_table_clock(SbTextTableClock *out, const SbTextTableCell *cell, char dates);

// Kinds of a line's cells, a bit each.
typedef struct {
  size_t cells;    // of a matrix all; else at most SB_TEXT_TABLE_COLUMNS_MAX
  size_t span;     // cells with the empty ones at the end
  size_t decimals; // number of digits behind each mark, with SB_TEXT_TABLE_PAIRS; else 0
  guint64 numeric, clocks, texts; // bit k: cell k is a number, a time of day, a text
  unsigned saw;                   // marks of the numbers
} SbTextTableShape;

// Returns the kinds of a line's cells in this dialect; of a comment or an empty line all 0.
SbTextTableShape sb_text_table_shape(const GString *line, const SbTextTableDialect *dialect);

// Where a line is among the blocks of a file. Initialise with {0}; the caller frees `names`.
typedef struct {
  char *names;    // names and units above the block; NULL: none. Freed by g_free()
  bool after_row; // the last line was a row of the table
  bool headed;    // names or units were found behind the last row
} SbTextTableBlock;

// The text of a table.
typedef struct SbTextTableFile {
  char *shown;            // the file, for messages
  GString *text;          // its lines in UTF-8, each with a terminating 0
  GArray *line;           // of GString: views of these lines without their ends, read-only
  SbTextTableShape shape; // of its rows
  guint64 texts;          // columns that are texts in most rows
  char *names;            // names and units above its rows; NULL: none
} SbTextTableFile;

// Returns line `index`, from 0.
static inline const GString *sb_text_table_line(const SbTextTable *table, size_t index) {
  return &g_array_index(table->file->line, GString, index);
}

// Returns whether a line has values where the rows of the table have them.
bool sb_text_table_is_row(const SbTextTable *table, const GString *line);

// Moves to the next line: `row` states whether it is a row of the table.
void sb_text_table_block_next(SbTextTableBlock *block, bool row, const GString *line,
                              const SbTextTable *table);

// Fills the table's header, and names and units of its columns, from the lines above its rows.
void sb_text_table_take_header(SbTextTable *table);

// Returns the cells of a header line as UTF-8, ended by NULL.
char **sb_text_table_header_cells(const SbTextTable *table, const GString *line);
