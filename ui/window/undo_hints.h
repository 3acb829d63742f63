// Says at the undo and redo buttons what they would change: "Section diameter 1.7 → 1.58 mm".
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// "Outer seal: section diameter 1.7 → 1.58 mm": the edit that undo (or redo) is about to take back
// (or make again); NULL if there is none. Owned by the caller (g_free).
char *sb_undo_hints_text(const SbDocument *document, bool redo);

void sb_undo_hints_attach(SbSession *session, GtkWidget *undo, GtkWidget *redo);
