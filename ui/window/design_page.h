// The page of the window that searches for a better design: a map over two parameters, limits, the
// effects of tolerances, and the search of `sealbench design`.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Returns a new page (floating reference), which holds a reference to `session`. With closed forms
// the map is computed after each edit; with the models of the document, whose evaluations take
// long, on request. The user can write a point of the map or the best design to the document, or
// keep it as a pin.
GtkWidget *sb_design_page_new(SbSession *session);
