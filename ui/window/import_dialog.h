// Dialogs that import a file with a preview of what was recognised, each choice of which may be
// changed: a measured loop beside the document's runs, a scan into its surface, the bodies of a
// drawing as its valve's parts.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// A loop from `path`, with what the document's data say of it already; NULL asks for a file. The
// group [data] of the document has it afterwards.
void sb_import_measured(GtkWindow *parent, SbSession *session, const char *path);

// A scan in the same way, which becomes surface.gt_product, .sigma and .sigma_over_beta.
void sb_import_scan(GtkWindow *parent, SbSession *session, const char *path);

// A drawing in the same way: asks for a file, a copy of the document with the valve's parts shaped
// by the bodies, writes that and opens it in `parent` (an SbWindow).
void sb_import_drawing(GtkWindow *parent, SbSession *session, const char *path);
