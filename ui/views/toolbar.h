// Parts of toolbars, with accessible names. The caller passes translated texts, unless stated
// otherwise; they are copied.
#pragma once

#include <gtk/gtk.h>

// Returns a new horizontal box (floating reference) whose buttons are joined without gaps.
GtkWidget *sb_toolbar_linked(void);

// Appends to `box` a button with the icon `icon` (name in the icon theme) that activates `action`
// ("win.zoom-in"). `name` is its accessible name, `tip` its tooltip.
void sb_toolbar_button(GtkBox *box, const char *icon, const char *name, const char *tip,
                       const char *action);

// Appends to `box` a combo box with items[count], which are untranslated (the function translates
// them by sb_translation()); the first is active. `name` is its accessible name, `tip` its
// accessible description. It may be narrower than its longest item. Returns the combo box, owned by
// `box`.
GtkWidget *sb_toolbar_combo(GtkBox *box, const char *const *items, int count, const char *name,
                            const char *tip);
