// The export dialog: a picture, a drawing or a film of the shown run.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Opens it over `parent`; it destroys itself. Does nothing while no complete or partial run is
// shown.
void sb_export_dialog_open(GtkWindow *parent, SbSession *session);

// Asks before a file is replaced; true if there is none or the answer is yes.
gboolean sb_export_may_replace(GtkWindow *parent, const char *path);
