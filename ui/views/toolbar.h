// The pieces of toolbars, with names for those who do not see them. Texts come translated.
#pragma once

#include <gtk/gtk.h>

// A box whose buttons touch.
GtkWidget *sb_toolbar_linked(void);

// A button with an icon that does `action` ("win.zoom-in").
void sb_toolbar_button(GtkBox *box, const char *icon, const char *name, const char *tip,
                       const char *action);

// A combo box of `count` items, which it translates (sb_translation); the first is active. It may
// be narrower than its longest item.
GtkWidget *sb_toolbar_combo(GtkBox *box, const char *const *items, int count, const char *name,
                            const char *tip);
