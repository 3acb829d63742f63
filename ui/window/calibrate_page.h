// The page of the window that fits parameters of the valve to measured loops.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Returns a new page (floating reference), which holds a reference to `session`. It fits the
// parameters that the user ticks to the measured data of the document, or of a file that is
// imported in the page. Estimates are written to the document only on request.
GtkWidget *sb_calibrate_page_new(SbSession *session);
