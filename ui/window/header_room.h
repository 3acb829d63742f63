// What the window's header leaves out where it is narrow.
#pragma once

#include <gtk/gtk.h>

typedef struct {
  GtkWidget *words[2]; // beside icons that say enough
  GtkWidget *document; // its name, which the window's title has too
  GtkWidget *pages;    // the tabs: of one width where there is room
  GtkWidget *progress, *model_switch;
} SbHeaderParts;

// Follows the width of the window; `width` is what it opens with.
void sb_header_room_attach(GtkWidget *window, const SbHeaderParts *parts, int width);
