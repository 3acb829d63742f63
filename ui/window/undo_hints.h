// The tooltips of the undo and redo buttons: which edit they would undo or redo.
#pragma once

#include "app/document/document.h"

#include <gtk/gtk.h>

// Returns the edit that undo (or redo) would change: "Outer seal: section diameter 1.7 → 1.58 mm".
// NULL: there is none. Translated.
char *sb_undo_hints_text(const SbDocument *document, bool redo);

// Sets the tooltip and the accessible description of an undo (or redo) button to its next edit.
void sb_undo_hints_show(GtkWidget *button, const SbDocument *document, bool redo);
