// The row of the parameter panel that chooses the rubber by name: the shipped ones, the user's own,
// and those next to the document.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Returns a new row (floating reference) that shows and sets the rubber of the document of
// `session`, which is borrowed and must outlive the row.
GtkWidget *sb_rubber_row_new(SbSession *session);

// Shows the rubber that the document names. To be called after "params-changed".
void sb_rubber_row_refresh(GtkWidget *row);
