// Lines that wrap at words, for people at a terminal; files and pipes get every line as it is.
#pragma once

#include <glib.h>

// Columns of a terminal, 80 where it does not report them; 0: the descriptor is not a terminal.
int sb_wrap_columns(int fd);

// Columns that a text takes on a terminal.
int sb_wrap_width(const char *text);

// `text`, one line without its end, broken at spaces so that each line has at most `columns`
// columns. Continuation lines are indented to the last column of the line, or by four more spaces
// than the line. Lines with escape sequences stay as they are, and so do words that are too long.
// Owned by the caller (g_free).
char *sb_wrap_line(const char *text, int columns);

// From now on standard output wraps its lines if it is a terminal; to be called once, before
// anything is printed. sb_wrap_end() prints the rest of a line that has no end.
void sb_wrap_standard_output(void);
void sb_wrap_end(void);
