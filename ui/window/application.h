// The application: windows, files given on the command line, theme, help.
#pragma once

#include <gtk/gtk.h>

#define SB_TYPE_APPLICATION (sb_application_get_type())
G_DECLARE_FINAL_TYPE(SbApplication, sb_application, SB, APPLICATION, GtkApplication)

SbApplication *sb_application_new(void);
