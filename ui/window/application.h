// The application: one process with any number of windows (SbWindow), the files of the command
// line, theme, help.
#pragma once

#include <gtk/gtk.h>

#define SB_TYPE_APPLICATION (sb_application_get_type())
G_DECLARE_FINAL_TYPE(SbApplication, sb_application, SB, APPLICATION, GtkApplication)

// Returns a new application, to be run by g_application_run(); freed by g_object_unref().
SbApplication *sb_application_new(void);
