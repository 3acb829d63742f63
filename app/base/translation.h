// The engine's and the exports' words in the language of the window. Those layers speak English
// everywhere, so that files, tables and pictures say the same wherever they are made; names that
// stand in the window beside its own words are translated here. Names of choices ("reynolds") are
// what stands in the files and are never translated.
#pragma once

#include <glib.h>

// Finds the translations for the program's locale, which is set before. Once.
void sb_translation_begin(void);

// A parameter's label, a study's title or help, a view's, a size's, a field's or a band's name in
// the user's language; the text itself where it has no translation. Borrowed; NULL gives "".
const char *sb_translation(const char *text);

// A label as it stands inside a sentence: small in English, as it is in a translation (German nouns
// keep their capitals). Owned by the caller (g_free).
char *sb_translation_inside(const char *label);
