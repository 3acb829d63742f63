// A row of the parameter panel for a choice that is no parameter of the catalogue: a title, a
// widget that chooses, and below them a line for an error.
#pragma once

#include <gtk/gtk.h>

// Returns a new row (floating reference). `title` and `tip` (the tooltip) are translated texts of
// the caller, and are copied. The row takes `chooser` as a child and gives it the title as its
// accessible name.
GtkWidget *sb_own_row_new(const char *title, const char *tip, GtkWidget *chooser);

// Shows `text`, a translated sentence, as the error of the choice; NULL removes it.
void sb_own_row_show_error(GtkWidget *row, const char *text);
