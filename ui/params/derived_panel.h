// What follows from the values: squeeze, stretch, gland fill, return force, each with a band.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

GtkWidget *sb_derived_panel_new(SbSession *session);
