// Which parts of the window's header are hidden or shortened when the window is narrow.
#pragma once

#include <gtk/gtk.h>

// Widgets of the header. Borrowed; they live as long as the window.
typedef struct {
  GtkWidget *words[2];     // labels next to icons
  GtkWidget *document;     // the name of the document
  GtkWidget *pages;        // a GtkBox of tabs; of equal width in a wide window
  GtkWidget *progress;     // the progress bar
  GtkWidget *model_switch; // from sb_model_switch_new()
} SbHeaderParts;

// Adapts the parts to `width`, the initial width of `window` [pixels], and then to every later
// width until the window is destroyed. `parts` is copied.
void sb_header_room_attach(GtkWidget *window, const SbHeaderParts *parts, int width);
