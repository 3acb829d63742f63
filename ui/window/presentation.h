// A full-screen window for a projector: one picture of the run with large texts, and keys that step
// through stages, bookmarks, pinned runs and pictures.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Opens the presentation of `session`; its keys move the playhead of the session. It ends by Escape
// or F5, or with `window`. It holds a reference to `session`. Does nothing if the section cannot be
// drawn.
void sb_presentation_open(GtkWindow *window, SbSession *session);
