// A line above the bottom of a window that reports what was done: "pages.pdf is written". It hides
// itself after some seconds. It covers neither the timeline nor the status bar.
#pragma once

#include <gtk/gtk.h>

// Gives a window its line, above its present content. To be called once for a window, before
// sb_toast_show(); the line is freed with the window.
void sb_toast_attach(GtkWindow *window);

// Shows `text`, which the caller has translated, in place of the earlier one. `action`: name of an
// action ("win.show-report") for a button with the translated label `button`; NULL: no button,
// `button` is not used. `stays`: the line does not hide itself; it is shown until another line
// replaces it.
void sb_toast_show(GtkWindow *window, const char *text, const char *button, const char *action,
                   gboolean stays);
