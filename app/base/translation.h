// The language of the window. Its texts and pictures are in the language of the locale, which only
// the window and the workbench in a terminal set: tables, reports and pictures of the command line
// are in English. Files are in English everywhere, so that they are the same on every computer.
// Texts of the engine and of studies are translated here, where they are displayed. Names of
// choices ("reynolds") are those of the files and are never translated.
#pragma once

#include <glib.h>
#include <locale.h>

// Loads the translations for the program's locale, which must be set before. To be called once.
void sb_translation_begin(void);

// Returns the translation of a text of the engine or of a table (label, title, help, name); `text`
// itself if it has none; "" for NULL. Borrowed from `text`, or static.
const char *sb_translation(const char *text);

// Returns a name that is followed by a comma and a value, "as designed, 15.5 %", with the name
// translated, or the translation of the full text if there is one.
char *sb_translation_of_case(const char *text);

// Switches this thread to English, for texts of a file that are otherwise displayed. Returns the
// value for sb_translation_resume(), which must follow in the same thread.
locale_t sb_translation_pause(void);

// Ends sb_translation_pause().
void sb_translation_resume(locale_t paused);

// Returns a label as a part of a sentence: translated, else in lower case.
char *sb_translation_inside(const char *label);
