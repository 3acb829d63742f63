// The tooltips of the undo and redo buttons: which edit they would undo or redo.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Returns the edit that undo (or redo) would change: "Outer seal: section diameter 1.7 → 1.58 mm".
// NULL: there is none. Translated.
char *sb_undo_hints_text(const SbDocument *document, bool redo);

// Keeps the tooltips of both buttons up to date until `undo` is destroyed. `session` and `redo` are
// borrowed until then.
void sb_undo_hints_attach(SbSession *session, GtkWidget *undo, GtkWidget *redo);
