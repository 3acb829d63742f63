// Actions of a design review in a window: report, bookmarks, full screen, presentation.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Adds the actions "report", "cancel-report", "show-report", "bookmark", "clear-bookmarks",
// "full-screen" and "present" to `window`. `session` is borrowed and must outlive the window.
void sb_review_attach(GtkApplicationWindow *window, SbSession *session);
