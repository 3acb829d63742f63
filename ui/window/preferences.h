// Values that the program remembers between sessions: theme, window size, last folder. They are in
// the file sealbench/window.ini (GKeyFile) of the user's configuration folder. It is read at the
// first call; every change is written immediately. If it cannot be written, the values last until
// the process ends. `key` is any name of a GKeyFile key.
#pragma once

#include <glib.h>

// Returns the value of `key`, or a copy of `fallback` (may be NULL, then NULL) if there is none.
char *sb_preferences_string(const char *key, const char *fallback);

// Stores a text.
void sb_preferences_set_string(const char *key, const char *value);

// Returns the value of `key`, or `fallback` if there is none or it is not a number.
int sb_preferences_int(const char *key, int fallback);

// Stores an integer.
void sb_preferences_set_int(const char *key, int value);
