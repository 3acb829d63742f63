// See signals.h.
#include "ui/views/signals.h"

typedef struct {
  gpointer instance, data;
} Handlers;

static void on_signals_destroy(GtkWidget *widget, Handlers *handlers) {
  g_signal_handlers_disconnect_by_data(handlers->instance, handlers->data);
}

static void handlers_free(gpointer data, GClosure *closure) {
  g_free(data);
}

void sb_signals_end_with(GtkWidget *widget, gpointer instance, gpointer data) {
  Handlers *handlers = g_new(Handlers, 1);
  *handlers = (Handlers){instance, data};
  g_signal_connect_data(widget, "destroy", G_CALLBACK(on_signals_destroy), handlers, handlers_free,
                        0);
}
