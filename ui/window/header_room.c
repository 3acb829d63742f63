// Words go below a width, the document's name below another.
#include "ui/window/header_room.h"

#include "ui/views/later.h"
#include "ui/window/model_switch.h"

enum { WHOLE = 1440, NAMED = 1200, TABS = 440 };

typedef struct {
  GtkWidget *window;
  SbHeaderParts parts;
  int level;     // how much of it is there
  SbLater later; // fits it to a new width
} Room;

static int level_of(int width) {
  return width >= WHOLE ? 2 : width >= NAMED ? 1 : 0;
}

static void fit_header(Room *room, int width) {
  const int level = room->level = level_of(width);
  for (int i = 0; i < 2; i++) {
    gtk_widget_set_visible(room->parts.words[i], level == 2);
  }
  gtk_widget_set_visible(room->parts.document, level > 0);
  gtk_box_set_homogeneous(GTK_BOX(room->parts.pages), level == 2);
  gtk_widget_set_size_request(room->parts.pages, level == 2 ? TABS : -1, -1);
  gtk_widget_set_size_request(room->parts.progress, level == 2 ? 120 : 30, -1);
  sb_model_switch_set_short(room->parts.model_switch, level < 2);
}

static void on_header_later(gpointer data) {
  Room *room = data;
  fit_header(room, gtk_widget_get_allocated_width(room->window));
}

// Not inside an allocation, where nothing may come or go.
static void on_header_allocate(GtkWidget *widget, GdkRectangle *allocation, Room *room) {
  if (level_of(allocation->width) != room->level) {
    sb_later_ensure(&room->later, room->window, 0, on_header_later, room);
  }
}

static void on_header_destroy(GtkWidget *widget, Room *room) {
  g_signal_handlers_disconnect_by_data(widget, room);
}

void sb_header_room_attach(GtkWidget *window, const SbHeaderParts *parts, int width) {
  Room *room = g_new0(Room, 1);
  room->window = window;
  room->parts = *parts;
  g_object_set_data_full(G_OBJECT(window), "header-room", room, g_free);
  g_signal_connect(window, "size-allocate", G_CALLBACK(on_header_allocate), room);
  g_signal_connect(window, "destroy", G_CALLBACK(on_header_destroy), room);
  // Before the window has a size: what is wide at first could not become narrow.
  fit_header(room, width);
}
