// What a review writes down: notes on the whole, on kept designs and on bookmarks, and the list of
// bookmarks, behind one button.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// The button, with its popover. Its notes are saved with the document.
GtkWidget *sb_notes_button_new(SbSession *session);
