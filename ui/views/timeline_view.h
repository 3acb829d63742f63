// The cycle against time, with the controls of the playhead.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Returns a new timeline (floating reference) that shows and moves the playhead of `session`, which
// is borrowed and must outlive it.
GtkWidget *sb_timeline_view_new(SbSession *session);
