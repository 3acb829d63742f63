// Opening and saving in a window: dialogs, recent files, drops, and the question before changes are
// lost.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

typedef struct SbWindowFiles SbWindowFiles;

// Serves `window`; fills the menu of `recent` and takes files dropped on the window. Owned by the
// caller.
SbWindowFiles *sb_window_files_new_for(GtkWindow *window, SbSession *session,
                                       GtkMenuButton *recent);
void sb_window_files_free(SbWindowFiles *files);

// Each asks first if changes would be lost. Open, new and save act from the main loop, after the
// call.
void sb_window_files_open_dialog(SbWindowFiles *files);
void sb_window_files_open(SbWindowFiles *files, GFile *file);
void sb_window_files_new(SbWindowFiles *files);

// Saves; asks for a name if there is none or if `as`.
void sb_window_files_save(SbWindowFiles *files, gboolean as);

// Asks what becomes of the document's file, which another program has changed.
void sb_window_files_resolve(SbWindowFiles *files);

// True if nothing would be lost, or the user saved or said that it may be.
gboolean sb_window_files_may_discard(SbWindowFiles *files);

// Recent files and the scenes that ship as buttons, for a window with nothing in it.
GtkWidget *sb_window_files_start(SbWindowFiles *files);
