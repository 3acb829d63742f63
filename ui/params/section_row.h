// The row of the parameter panel that chooses the file which draws the seals' section.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

GtkWidget *sb_section_row_new(SbSession *session);

// Takes over what the document says.
void sb_section_row_refresh(GtkWidget *row);
