// A dialog about unsaved changes of a process that has ended without saving them.
#pragma once

#include "app/session/autosave.h"

#include <gtk/gtk.h>

// Shows the dialog 300 ms later for the files of sb_autosave_find(), one after another, until the
// user restores one or postpones the decision; not if the document was edited by then. A restored
// file becomes the document of `session`, which `autosave` saves from then on. Only the first call
// in a process does so, and never after `window` is destroyed. All arguments are borrowed until
// `window` is destroyed.
void sb_autosave_offer(SbSession *session, SbAutosave *autosave, GtkWindow *window);
