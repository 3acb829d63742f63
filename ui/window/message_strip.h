// The strip above the section: an error of the values or of the run with the button that corrects
// it, a note that the pictures show an earlier run, or an important result of the run.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Returns a new strip (floating reference), hidden while there is no message. `session` is borrowed
// and must outlive it.
GtkWidget *sb_message_strip_new(SbSession *session);
