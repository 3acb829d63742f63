// One window with a session of its own.
#pragma once

#include "app/session/session.h"
#include "ui/window/application.h"

#define SB_TYPE_WINDOW (sb_window_get_type())
G_DECLARE_FINAL_TYPE(SbWindow, sb_window, SB, WINDOW, GtkApplicationWindow)

// Returns a new window of `application` with a new document. GTK owns it; it is freed when it is
// destroyed.
GtkWidget *sb_window_new(SbApplication *application);

// Returns the session of the window; borrowed.
SbSession *sb_window_session(SbWindow *window);

// Opens a file in the window; if the present document has changes, the user is asked first. Errors
// are shown in the window.
void sb_window_open(SbWindow *window, GFile *file);

// Returns TRUE while the document of the window is new and unchanged.
gboolean sb_window_is_fresh(SbWindow *window);
