// The actions of the window: one table for keyboard shortcuts and for the search in the parameter
// panel, which finds actions, too.
#pragma once

#include <gtk/gtk.h>

// An action. Strings are static.
typedef struct {
  const char *name;      // detailed name of a GAction: "win.page::design"
  const char *accels[3]; // shortcuts as gtk_accelerator_parse(), ends with NULL
  const char *title;     // untranslated, may contain a mnemonic (_); NULL: only by shortcut
  const char *words;     // untranslated synonyms, separated by blanks; NULL: none
} SbAction;

// Returns the table of *count actions. Static.
const SbAction *sb_actions(size_t *count);

// Returns a new widget (floating reference), a box of buttons for the actions that were found,
// empty at first.
GtkWidget *sb_action_finder_new(void);

// Shows in `finder`, of sb_action_finder_new(), a button for each action whose translated title or
// synonyms contain `needle` (folded by g_utf8_casefold()), at most a few; none for a text of one or
// no character. Hides `finder` if there is none. Returns their number.
int sb_action_finder_search(GtkWidget *finder, const char *needle);
