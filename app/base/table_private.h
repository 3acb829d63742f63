// Lines, cells and numbers of tables, shared by the files table*.c.
#pragma once

#include "app/base/table.h"

// Where a table's bytes are: in memory, or in a file that is read a piece at a time. A mapping
// would end the program where the file is cut short meanwhile.
typedef struct {
  int file;      // -1: in memory
  guint8 *bytes; // [length] there
  size_t length;
} SbTableBytes;

enum { SB_TABLE_LINE_MAX = 1 << 24 };

// Reads a text of any of the encodings line by line.
typedef struct {
  const SbTableBytes *bytes;
  const guint8 *at, *end; // what is at hand
  size_t left;            // bytes of the file behind that
  guint8 *piece;          // of a file; NULL in memory
  size_t room;
  SbTableEncoding encoding;
  char line_end;     // '\n', or '\r' of files that have no other
  int number;        // of the line last read, from 1
  GString *wide;     // a line of UTF-16 in UTF-8; NULL elsewhere
  const char *wrong; // why lines ended before the file did; NULL: they did not
} SbTableLines;

// Begins at byte `from`.
void sb_table_lines_init(SbTableLines *lines, const SbTableBytes *bytes, size_t from,
                         SbTableEncoding encoding);
void sb_table_lines_clear(SbTableLines *lines);

// The next line without its end; borrowed until the next one. In UTF-16's files UTF-8, elsewhere
// the bytes of the file. False at the end, and with `wrong` where a file cannot be read on.
bool sb_table_next(SbTableLines *lines, const char **text, size_t *length);

// Bytes in front of the next line.
size_t sb_table_lines_place(const SbTableLines *lines);

typedef struct {
  const char *text;
  size_t length;
} SbTableCell;

// Splits a line; at most SB_TABLE_COLUMNS_MAX cells, those behind are dropped. Blanks around a cell
// and the quotes of one go.
size_t sb_table_split(SbTableCell *cell, const char *line, size_t length, char separator);

// What numbers showed of their marks.
enum {
  SB_TABLE_SAW_DECIMAL = 1,
  SB_TABLE_SAW_GROUPS = 2, // a mark between thousands
  SB_TABLE_SAW_LONG = 4    // four digits or more and no mark between them
};

// A cell as a number; false, *out untouched, where it is none. `saw` (may be NULL) is added to.
bool sb_table_number(double *out, const SbTableCell *cell, const SbTableDialect *dialect,
                     unsigned *saw);

// A time of day, with the three numbers of a date (0 without) and what stands between those.
typedef struct {
  double seconds;
  int date[3];
  char mark;
} SbTableClock;
bool sb_table_clock(SbTableClock *out, const SbTableCell *cell);

// Days of a date since an arbitrary one; false where day and month may be either.
bool sb_table_days(long *days, const SbTableClock *clock);

struct SbTable {
  char *shown;
  SbTableBytes bytes;
  SbTableDialect dialect;
  size_t columns, header_lines;
  SbTableColumn column[SB_TABLE_COLUMNS_MAX];
};

// A piece of a line as printable UTF-8; owned by the caller.
char *sb_table_utf8(const char *text, size_t length, SbTableEncoding encoding);
