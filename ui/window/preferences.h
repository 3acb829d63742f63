// What the program remembers between sessions: theme, window size, last folder. Kept as a GKeyFile
// in the user's configuration folder, so that it works uninstalled and without a settings service;
// a folder that cannot be written means only that nothing is remembered.
#pragma once

#include <glib.h>

// The stored text, or `fallback`. Owned by the caller; NULL only if `fallback` is.
char *sb_preferences_string(const char *key, const char *fallback);
void sb_preferences_set_string(const char *key, const char *value);

int sb_preferences_int(const char *key, int fallback);
void sb_preferences_set_int(const char *key, int value);
