// A row of the parameter panel that is of no parameter: a title, what chooses, and below it what is
// wrong with the choice.
#pragma once

#include <gtk/gtk.h>

// `chooser` is named by the title; `tip` says what the row does.
GtkWidget *sb_own_row_new(const char *title, const char *tip, GtkWidget *chooser);

// Says what is wrong; NULL: nothing.
void sb_own_row_complain(GtkWidget *row, const char *text);
