// Unsaved changes of a window, kept in a file of the user's data folder while there are any: after
// a crash the next start offers them. Nothing is written over the user's own file.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

typedef struct SbAutosave SbAutosave;

// Follows `session`; its file is written at most SB_AUTOSAVE_DELAY ms after a change, by way of a
// temporary one, and removed once there is nothing to save. The first one of the process offers, in
// a dialog over `window`, what a process that no longer runs has left behind. Owned by the caller.
enum { SB_AUTOSAVE_DELAY = 1000 };
SbAutosave *sb_autosave_new(SbSession *session, GtkWindow *window);

// The window has closed in good order: removes its file. NULL is allowed.
void sb_autosave_free(SbAutosave *autosave);
