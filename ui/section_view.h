// The section of the valve at the playhead, with its toolbar.
#pragma once

#include "ui/session.h"

#include <gtk/gtk.h>

// The toolbar and the picture in one column.
GtkWidget *sb_section_view_new(SbSession *session);

// Zoom by one step (positive: in), or back to the whole valve (0).
void sb_section_view_zoom(GtkWidget *view, int direction);
