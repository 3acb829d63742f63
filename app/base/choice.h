// What resolves a refusal: the key that decides, and the values that are plausible. A message
// states the problem first and ends with its remedy, in the words of the command line or of a file.
// The window shows the problem alone and offers the values.
#pragma once

#include <glib.h>
#include <stddef.h>

// A choice. Its strings are owned by the error or issue that contains it.
typedef struct {
  char *key;     // name of an option ("unit") or of a key of a group ("columns"); NULL: no choice
  char **value;  // plausible values of the key, ended by NULL; the value "" leaves out the key
  size_t remedy; // number of bytes at the end of the message that state the remedy
} SbChoice;

// Sets a choice to copies of `key` (may be NULL: no choice) and of the values, one a line of
// `values`; NULL: no values, "": the one value "".
void sb_choice_init(SbChoice *choice, const char *key, const char *values, size_t remedy);

// Sets a choice to a copy of `from`.
void sb_choice_copy(SbChoice *choice, const SbChoice *from);

// Frees the content and zeroes it.
void sb_choice_clear(SbChoice *choice);

// Returns the message without its remedy. Freed by g_free().
char *sb_choice_problem(const SbChoice *choice, const char *message);

// ---- Words for the columns of a table ----
// A layout has a word for each column, "time, -, force"; "-" stands for none.

// Writes `word` ("": "-") for a column, from 1, into the layout; columns that the layout does not
// have yet become "-". Frees *layout, a string of g_malloc(), and sets it to the new layout. Column
// 0 changes nothing.
void sb_choice_place(char **layout, size_t column, const char *word);

// Returns one layout a line: for each column whose bit is set (bit k of `columns`: column k + 1)
// and for each of `words` (one a line), a copy of `layout` with this word in this column. NULL if
// no bit is set. Freed by g_free().
char *sb_choice_layouts(const char *layout, guint64 columns, const char *words);
