// "do you mean": of a list of names the one most like a mistyped word.
#pragma once

typedef struct {
  const char *word, *best; // best: borrowed, NULL while no name is like the word
  int least;               // edits between them
} SbNearest;

// Starts with no name; `word` is borrowed.
SbNearest sb_nearest(const char *word);

// Offers one name, or those of a list "first|second".
void sb_nearest_try(SbNearest *nearest, const char *name);
void sb_nearest_try_list(SbNearest *nearest, const char *names);

// ", do you mean NAME?", or an empty text. Owned by the caller.
char *sb_nearest_hint(const SbNearest *nearest);
