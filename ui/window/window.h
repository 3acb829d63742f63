// One window on one session.
#pragma once

#include "app/session/session.h"
#include "ui/window/application.h"

#define SB_TYPE_WINDOW (sb_window_get_type())
G_DECLARE_FINAL_TYPE(SbWindow, sb_window, SB, WINDOW, GtkApplicationWindow)

GtkWidget *sb_window_new(SbApplication *application);

// What it works on; borrowed.
SbSession *sb_window_session(SbWindow *window);

// Opens a file in the window; errors are shown in it.
void sb_window_open(SbWindow *window, GFile *file);

// True while the window holds nothing but an untouched new document.
gboolean sb_window_is_fresh(SbWindow *window);
