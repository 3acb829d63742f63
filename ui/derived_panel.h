// What follows from the values: squeeze, stretch, gland fill, return force, each with a band.
#pragma once

#include "ui/session.h"

#include <gtk/gtk.h>

GtkWidget *sb_derived_panel_new(SbSession *session);
