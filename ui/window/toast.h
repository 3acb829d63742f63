// One line at the foot of a window about what is done: "pages.pdf is written". It goes by itself;
// it stands over the foot of the pictures, not over the timeline or the status.
#pragma once

#include <gtk/gtk.h>

// Gives a window its line, over all that it holds now.
void sb_toast_attach(GtkWindow *window);

// Shows a text in place of the one before, with a button for an action if `action` is not NULL. It
// goes after some seconds unless it `stays`.
void sb_toast_show(GtkWindow *window, const char *text, const char *button, const char *action,
                   gboolean stays);

// Takes it away.
void sb_toast_hide(GtkWindow *window);
