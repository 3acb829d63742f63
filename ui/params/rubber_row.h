// The row of the parameter panel that chooses the rubber by name: those that ship, the user's own,
// and those beside the document.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

GtkWidget *sb_rubber_row_new(SbSession *session);

// Takes over what the document says.
void sb_rubber_row_refresh(GtkWidget *row);
