// The page of the window that compares propellants in the present valve.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Returns a new page (floating reference), which holds a reference to `session`. While the page is
// visible and the values have changed, it computes the study "propellants"; a change of only the
// propellant or the temperature does not require it.
GtkWidget *sb_propellants_page_new(SbSession *session);
