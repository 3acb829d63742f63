// The page of the window on which propellants are compared in the present valve.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Computes the study "propellants" whenever it is in view and of earlier values; what only the
// choice of propellant or the temperature changes is not computed again.
GtkWidget *sb_propellants_page_new(SbSession *session);
