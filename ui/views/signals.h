// Handlers of signals that end with a widget.
#pragma once

#include <gtk/gtk.h>

// Disconnects all handlers of `instance` whose data is `data` when `widget` is destroyed.
// `instance` must exist until then.
void sb_signals_end_with(GtkWidget *widget, gpointer instance, gpointer data);
