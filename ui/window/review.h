// Actions of a design review in a window: the report as pages, bookmarks, full screen,
// presentation.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Adds them to the window: "report", "cancel-report", "show-report", "bookmark",
// "clear-bookmarks", "full-screen", "present".
void sb_review_attach(GtkApplicationWindow *window, SbSession *session);
