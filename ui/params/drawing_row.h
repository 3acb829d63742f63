// The rows of the parameter panel that choose a file which draws something: the seals' section, the
// outline of their grooves.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

typedef enum { SB_DRAWING_SECTION, SB_DRAWING_GROOVE } SbDrawingKind;

GtkWidget *sb_drawing_row_new(SbSession *session, SbDrawingKind kind);

// Takes over what the document says.
void sb_drawing_row_refresh(GtkWidget *row);
