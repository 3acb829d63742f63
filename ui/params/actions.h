// What the window does by name: one table for keys, and for the search over parameters, which
// offers actions too.
#pragma once

#include <gtk/gtk.h>

typedef struct {
  const char *name;      // detailed: "win.page::design"
  const char *accels[3]; // NULL: none, or no more
  const char *title;     // to be translated; may hold a mnemonic; NULL: by key alone
  const char *words;     // what else it is called
} SbAction;

const SbAction *sb_actions(size_t *count);

// A box of buttons for the actions that match, none at first.
GtkWidget *sb_action_finder_new(void);

// Shows the actions whose title or other words hold `needle`, case-folded, at most a few; none for
// an empty text. Returns how many.
int sb_action_finder_search(GtkWidget *finder, const char *needle);
