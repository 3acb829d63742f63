// The designs that are kept to compare with: a chip for each that is drawn, and a list of all of
// them to draw, name, use and drop.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

GtkWidget *sb_pin_bar_new(SbSession *session);
