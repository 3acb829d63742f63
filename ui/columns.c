// Places of the borders between the window's columns (columns.h).
#include "ui/columns.h"
#include "ui/preferences.h"

// Widths of the look in its window of 1600 px, and the least that still reads well.
enum { LOOK_WINDOW = 1600, LOOK_LEFT = 346, LOOK_RIGHT = 424, LEAST_LEFT = 316, LEAST_RIGHT = 284 };

typedef struct {
  GtkPaned *columns, *views;
  int width; // of the window that the borders were placed for
} Columns;

static int scaled(int width, int look, int least) {
  return CLAMP(width * look / LOOK_WINDOW, least, look);
}

// A new width: the widths that a hand has given, or the look's share of this window.
static void on_allocate(GtkPaned *paned, GdkRectangle *allocation, Columns *columns) {
  if (columns->width == allocation->width || allocation->width < 200) {
    return;
  }
  columns->width = allocation->width;
  int left = sb_preferences_int("left-column", 0);
  int right = sb_preferences_int("right-column", 0);
  if (left < LEAST_LEFT || left > allocation->width / 2) {
    left = scaled(allocation->width, LOOK_LEFT, LEAST_LEFT);
  }
  if (right < LEAST_RIGHT || right > allocation->width / 2) {
    right = scaled(allocation->width, LOOK_RIGHT, LEAST_RIGHT);
  }
  gtk_paned_set_position(columns->columns, left);
  gtk_paned_set_position(columns->views, allocation->width - left - right - 2);
}

// Only what a hand moved is remembered.
static gboolean on_release(GtkPaned *paned, GdkEventButton *event, Columns *columns) {
  sb_preferences_set_int("left-column", gtk_paned_get_position(columns->columns));
  GtkWidget *right = gtk_paned_get_child2(columns->views);
  sb_preferences_set_int("right-column", gtk_widget_get_allocated_width(right));
  return GDK_EVENT_PROPAGATE;
}

void sb_columns_attach(GtkPaned *columns, GtkPaned *views) {
  Columns *self = g_new0(Columns, 1);
  self->columns = columns;
  self->views = views;
  g_object_set_data_full(G_OBJECT(columns), "columns", self, g_free);
  gtk_widget_set_size_request(gtk_paned_get_child1(columns), LEAST_LEFT, -1);
  gtk_widget_set_size_request(gtk_paned_get_child2(views), LEAST_RIGHT, -1);
  g_signal_connect(columns, "size-allocate", G_CALLBACK(on_allocate), self);
  g_signal_connect(columns, "button-release-event", G_CALLBACK(on_release), self);
  g_signal_connect(views, "button-release-event", G_CALLBACK(on_release), self);
}
