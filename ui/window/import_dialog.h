// Dialogs that import a file. They show a preview of how it is read, and the user can change each
// choice: a measured loop that is compared with the runs of the document, a scan of its surface,
// and the bodies of a drawing as the parts of its valve.
//
// Each function opens its dialog over `parent` and returns; the dialog destroys itself and holds a
// reference to `session`. `path` is copied; NULL: the user is asked for a file first.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Imports a measured loop as the first entry of the document's measured data (group [data]). If the
// document has this file already, its choices are shown.
void sb_import_measured(GtkWindow *parent, SbSession *session, const char *path);

// Imports a scan; it sets surface.gt_product, surface.sigma and surface.sigma_over_beta.
void sb_import_scan(GtkWindow *parent, SbSession *session, const char *path);

// Imports a drawing: writes a copy of the document whose parts have the shape of the bodies to a
// file that the user chooses, and opens that file in `parent` (an SbWindow).
void sb_import_drawing(GtkWindow *parent, SbSession *session, const char *path);
