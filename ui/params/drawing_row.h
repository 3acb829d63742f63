// Rows of the parameter panel that choose a drawing file: the seals' section or the groove.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Which drawing a row chooses: seal.profile_file or gland.profile_file.
typedef enum { SB_DRAWING_SECTION, SB_DRAWING_GROOVE } SbDrawingKind;

// Returns a new row (floating reference). A file that the user chooses is read in the background
// and set in `session`, which is borrowed and must outlive the row; a problem is shown in the row.
GtkWidget *sb_drawing_row_new(SbSession *session, SbDrawingKind kind);

// Shows the file that the document names. To be called after "params-changed".
void sb_drawing_row_refresh(GtkWidget *row);
