// Panel of design quantities of both glands with their usual bands, below the parameters.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Returns a new expander (floating reference), closed, that follows the values of `session`, which
// is borrowed and must outlive it.
GtkWidget *sb_gland_panel_new(SbSession *session);
