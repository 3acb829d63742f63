// The dialog that exports a picture, a drawing or a movie of the displayed run.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Opens the dialog over `parent`; it destroys itself. It holds a reference to `session`. Does
// nothing unless a complete or partial run is displayed.
void sb_export_dialog_open(GtkWindow *parent, SbSession *session);

// Returns whether `path` may be written: TRUE if there is no such file. Otherwise a modal dialog
// asks whether to replace it, and the answer is returned.
gboolean sb_export_may_replace(GtkWindow *parent, const char *path);
