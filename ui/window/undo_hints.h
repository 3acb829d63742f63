// Says at the undo and redo buttons what they would change: "Section diameter 1.7 → 1.58 mm".
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

void sb_undo_hints_attach(SbSession *session, GtkWidget *undo, GtkWidget *redo);
