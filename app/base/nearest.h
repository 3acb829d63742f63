// "do you mean": the name of a list that is most similar to a mistyped word.
#pragma once

// The search. The names are borrowed: they must be valid until sb_nearest_hint().
typedef struct {
  const char *word; // borrowed
  const char *best; // most similar name so far; NULL: none is similar
  int least;        // number of edits between `word` and `best`
} SbNearest;

// Returns a search for `word` without a name.
SbNearest sb_nearest(const char *word);

// Compares one name.
void sb_nearest_try(SbNearest *nearest, const char *name);

// Compares the names of a list "first|second".
void sb_nearest_try_list(SbNearest *nearest, const char *names);

// Returns ", do you mean NAME?", or an empty text if no name is similar.
char *sb_nearest_hint(const SbNearest *nearest);
