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

// Tells `chosen` which parameter a handle on the section means, with what was typed (NULL:
// nothing).
void sb_section_view_listen(GtkWidget *view,
                            void (*chosen)(void *data, SbParamId id, const char *typed),
                            void *data);

// A key while the picture has the focus; TRUE if a handle took it.
gboolean sb_section_view_key(GtkWidget *view, const GdkEventKey *event);

// Puts a widget below what stands over the picture while nothing has run.
void sb_section_view_add_start(GtkWidget *view, GtkWidget *start);
