// The language of the window. Its words and what it draws, on the screen and as a picture, are in
// the language of the locale, which only the window and the terminal's workbench set: tables,
// reports and pictures of the command line are English. Files are English everywhere, so that they
// say the same wherever they are made. The engine and the tables of studies know nothing of
// languages: their names are translated here, where they are shown. Names of choices ("reynolds")
// are what stands in the files and are never translated.
#pragma once

#include <glib.h>
#include <locale.h>

// Finds the translations for the program's locale, which is set before. Once.
void sb_translation_begin(void);

// A parameter's label, a study's title or help, a view's, a size's, a field's or a band's name in
// the user's language; the text itself where it has no translation. Borrowed; NULL gives "".
const char *sb_translation(const char *text);

// Of a name with a value after it, "as designed, 15.5 %", what stands before the comma; all of it
// where all has a translation. Owned by the caller (g_free).
char *sb_translation_of_case(const char *text);

// English on this thread until it is resumed: for what goes into a file and is made of words that
// are drawn elsewhere. Resume with what pause gave.
locale_t sb_translation_pause(void);
void sb_translation_resume(locale_t paused);

// A label as it stands inside a sentence: small in English, as it is in a translation (German nouns
// keep their capitals). Owned by the caller (g_free).
char *sb_translation_inside(const char *label);
