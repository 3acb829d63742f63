// The cycle in time, with the controls of the playhead.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

GtkWidget *sb_timeline_view_new(SbSession *session);
