// The saved designs: a chip for each one that is drawn, and a list of all of them in which the user
// draws, names, applies and removes them.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Returns a new bar (floating reference) for the pins of `session`, which is borrowed and must
// outlive it.
GtkWidget *sb_pin_bar_new(SbSession *session);
