// The page of the window on which the valve is fitted to measured loops.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Fits the document's parameters that are ticked to its own data, or to a file that is imported;
// what was recognised of that can be said otherwise. Estimates go into the document on request.
GtkWidget *sb_calibrate_page_new(SbSession *session);
