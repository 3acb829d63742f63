// The line at the bottom of the window: playhead, models, run time, error estimate, and the
// warnings with a list behind a button.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Returns a new status bar (floating reference). `session` is borrowed and must outlive it.
GtkWidget *sb_status_bar_new(SbSession *session);
