// The section of the valve at the playhead, with its toolbar.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Returns a new view (floating reference): toolbar and picture in one column. `session` is borrowed
// and must outlive it. The functions below take this widget.
GtkWidget *sb_section_view_new(SbSession *session);

// Zooms by one step, in (direction > 0) or out (< 0), or back to the full valve (0).
void sb_section_view_zoom(GtkWidget *view, int direction);

// Shows the cutaway in place of the section, or the section again.
void sb_section_view_toggle_cutaway(GtkWidget *view);

// Turns the camera of the cutaway by a number of steps of 5 degrees to the right and upwards;
// negative: to the left and downwards. Does nothing while the section is shown.
void sb_section_view_turn(GtkWidget *view, int right, int up);

// Sets the function that is called when a handle on the section selects parameter `id`; `typed` is
// the text with which the user began to type a value (NULL: none).
void sb_section_view_listen(GtkWidget *view,
                            void (*chosen)(void *data, SbParamId id, const char *typed),
                            void *data);

// Gives the picture the keyboard focus, so that keys of the playhead (the space bar among them)
// work.
void sb_section_view_focus(GtkWidget *view);

// To be called when a key is pressed in the window. Returns whether a handle used it; FALSE if the
// picture does not have the focus.
gboolean sb_section_view_key(GtkWidget *view, const GdkEventKey *event);

// Adds the widget `start` below the text that is shown over the picture while there is no run. The
// view takes the widget as a child.
void sb_section_view_add_start(GtkWidget *view, GtkWidget *start);
