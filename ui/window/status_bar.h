// The line at the bottom: where the playhead is, models, run time, error estimate, warnings.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

GtkWidget *sb_status_bar_new(SbSession *session);
