// The window of studies: one of them at a time, of the present document, computed beside the window
// and marked when the values have changed since.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Opens it over `parent`, at the study that the scene asks for; it destroys itself.
void sb_study_window_open(GtkWindow *parent, SbSession *session);
