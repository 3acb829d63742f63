// The window of studies: shows one study of the present document at a time, computes it on a
// thread of its own, and marks it when the values have changed since.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Opens the window over `parent` with the first study that the scene requests (output.studies),
// else the first one; it destroys itself. It holds a reference to `session`.
void sb_study_window_open(GtkWindow *parent, SbSession *session);
