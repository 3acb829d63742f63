// Lines that wrap at words on a terminal; files and pipes get every line unchanged.
#pragma once

#include <glib.h>

// Returns the number of columns of the terminal `fd` (80 if it does not report them), or 0 if the
// descriptor is not a terminal.
int sb_wrap_columns(int fd);

// Returns the number of columns that a UTF-8 text takes on a terminal.
int sb_wrap_width(const char *text);

// Returns the one line `text` (without newline) broken at spaces, so that each line has at most
// `columns` columns; unchanged if `columns` is too small (0, for example). Continuation lines are
// indented to the start of the last column of a table line, else by four more spaces than the line.
// Lines with escape sequences and words that are too long are not broken.
char *sb_wrap_line(const char *text, int columns);

// Replaces `stdout` by a stream that wraps its lines if standard output is a terminal; does nothing
// otherwise. Call it once, before anything is printed, in the main thread.
void sb_wrap_standard_output(void);

// Prints the rest of a line that has no newline and ends the wrapping. To be called before the
// program ends.
void sb_wrap_end(void);
