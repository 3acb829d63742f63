// The line above the views with the verdict on the valve: whether it seals, presses, returns,
// doses, leaks, fits; each with its sign and the figure that decides it. A click on an answer shows
// its reason and its instant.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Returns a new line (floating reference). `session` is borrowed and must outlive it.
GtkWidget *sb_verdict_strip_new(SbSession *session);
