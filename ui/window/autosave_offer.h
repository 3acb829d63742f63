// A dialog about unsaved changes of a process that has ended without saving them.
#pragma once

#include "app/session/autosave.h"

#include <gtk/gtk.h>

// Shows the dialog for each such file 300 ms later, unless the document was edited by then. Only
// the first call in a process does so, and never after `window` is destroyed. All arguments are
// borrowed until `window` is destroyed.
void sb_autosave_offer(SbSession *session, SbAutosave *autosave, GtkWindow *window);
