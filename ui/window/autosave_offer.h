// Asks in a dialog what to do with unsaved changes that a process which no longer runs has left.
#pragma once

#include "app/session/autosave.h"

#include <gtk/gtk.h>

// Once the window stands, the first time in a process; never after the window's end. All borrowed.
void sb_autosave_offer(SbSession *session, SbAutosave *autosave, GtkWindow *window);
