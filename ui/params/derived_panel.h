// Panel of quantities that follow from the values: squeeze, stretch, gland fill, return force, each
// with the band of usual values.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Returns a new widget (floating reference) that follows the values of `session`, which is borrowed
// and must outlive it.
GtkWidget *sb_derived_panel_new(SbSession *session);
