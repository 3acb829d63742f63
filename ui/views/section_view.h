// The section of the valve at the playhead, with its toolbar.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// The toolbar and the picture in one column.
GtkWidget *sb_section_view_new(SbSession *session);

// Zoom by one step (positive: in), or back to the whole valve (0).
void sb_section_view_zoom(GtkWidget *view, int direction);

// Shows the cutaway in place of the section, or the section again.
void sb_section_view_toggle_cutaway(GtkWidget *view);

// Turns the cutaway's camera by steps to the right and up. Nothing while the section shows.
void sb_section_view_turn(GtkWidget *view, int right, int up);

// Puts a widget below what stands over the picture while nothing has run.
void sb_section_view_add_start(GtkWidget *view, GtkWidget *start);
