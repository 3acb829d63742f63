// Opening and saving in a window: dialogs, recent files, files that are dropped on the window, and
// the question before changes are lost.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

typedef struct SbWindowFiles SbWindowFiles;

// Returns the file functions of `window`, which fill the menu of `recent` and open files that are
// dropped on the window. All arguments are borrowed. Freed by sb_window_files_free(), before
// `window` is.
SbWindowFiles *sb_window_files_new_for(GtkWindow *window, SbSession *session,
                                       GtkMenuButton *recent);

// Frees it.
void sb_window_files_free(SbWindowFiles *files);

// Shows the dialog that opens a file, after the call, from the main loop. Asks first if changes
// would be lost.
void sb_window_files_open_dialog(SbWindowFiles *files);

// Opens `file` during the call. Asks first if changes would be lost. Errors are shown in the
// window.
void sb_window_files_open(SbWindowFiles *files, GFile *file);

// Replaces the document by a new one, after the call, from the main loop. Asks first if changes
// would be lost.
void sb_window_files_new(SbWindowFiles *files);

// Saves the document, after the call, from the main loop; asks for a name if the document has none
// or if `as` is TRUE.
void sb_window_files_save(SbWindowFiles *files, gboolean as);

// Asks what to do about the document's file, which another program has changed, after the call,
// from the main loop.
void sb_window_files_resolve(SbWindowFiles *files);

// Returns TRUE if the document has no unsaved changes, or the user has saved or discarded them in a
// modal dialog.
gboolean sb_window_files_may_discard(SbWindowFiles *files);

// Returns buttons of the recent files and of the scenes that are shipped, for a window with an
// empty document (floating reference). `files` must outlive it.
GtkWidget *sb_window_files_start(SbWindowFiles *files);
