// The notes of a review: a button with a popover in which the user writes notes on the document, on
// saved designs and on bookmarks, and edits the list of bookmarks.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Returns a new button (floating reference) with its popover, for the document of `session`, which
// is borrowed and must outlive it. Notes and bookmarks are saved with the document.
GtkWidget *sb_notes_button_new(SbSession *session);
