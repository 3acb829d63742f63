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

// Sets a choice to copies of `key` and of the values, one a line of `values`; NULL: no values.
void sb_choice_init(SbChoice *choice, const char *key, const char *values, size_t remedy);

// Sets a choice to a copy of `from`.
void sb_choice_copy(SbChoice *choice, const SbChoice *from);

// Frees the content and zeroes it.
void sb_choice_clear(SbChoice *choice);

// Returns the message without its remedy. Freed by g_free().
char *sb_choice_problem(const SbChoice *choice, const char *message);

// ---- Words for the columns of a table ----
// A layout has a word for each column, "time, -, force"; "-" stands for none.

// Writes `word` for a column, from 1, into *layout, which is replaced; 0: changes nothing.
void sb_choice_place(char **layout, size_t column, const char *word);

// Returns the layouts, one a line, with each of `words` (one a line) in each of the columns, or
// NULL without columns: bit k of `columns` is that of column k + 1. Freed by g_free().
char *sb_choice_layouts(const char *layout, guint64 columns, const char *words);
