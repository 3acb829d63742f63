// Places of the borders between the window's columns (paned_layout.h).
#include "ui/window/paned_layout.h"
#include "ui/views/later.h"
#include "ui/window/preferences.h"

// Widths of the look in its window of 1600 px, and the least that still reads well.
enum {
  LOOK_WINDOW = 1600,
  LOOK_LEFT = 346,
  LOOK_RIGHT = 424,
  LEAST_LEFT = 316,
  LEAST_RIGHT = 284,
  MOST_RIGHT = 720 // of a very wide window
};

// Below it three columns leave the section less than their own widths.
enum { THREE_COLUMNS = 1150 };

typedef struct {
  GtkPaned *columns, *views;
  GtkWidget *charts; // toggle of the right column
  int width;         // of the window that the borders were placed for
  SbLater later;     // shows or hides the right column
} PanedLayout;

static int scaled(int width, int look, int least, int most) {
  return CLAMP(width * look / LOOK_WINDOW, least, most);
}

// Not inside an allocation: the column leaves or joins the layout.
static void on_pane_later(gpointer data) {
  PanedLayout *layout = data;
  gboolean narrow = layout->width < THREE_COLUMNS;
  if (gtk_widget_get_visible(layout->charts) != narrow) {
    gtk_widget_set_visible(layout->charts, narrow);
    gtk_widget_set_visible(gtk_paned_get_child2(layout->views), !narrow);
  }
}

// A new width: the widths that a hand has given, or the look's share of this window.
static void on_pane_allocate(GtkPaned *paned, GdkRectangle *allocation, PanedLayout *layout) {
  if (layout->width == allocation->width || allocation->width < 200) {
    return;
  }
  layout->width = allocation->width;
  sb_later_ensure(&layout->later, layout->columns, 0, on_pane_later, layout);
  int left = sb_preferences_int("left-column", 0);
  int right = sb_preferences_int("right-column", 0);
  if (left < LEAST_LEFT || left > allocation->width / 2) {
    left = scaled(allocation->width, LOOK_LEFT, LEAST_LEFT, LOOK_LEFT);
  }
  if (right < LEAST_RIGHT || right > allocation->width / 2) {
    right = scaled(allocation->width, LOOK_RIGHT, LEAST_RIGHT, MOST_RIGHT);
  }
  gtk_paned_set_position(layout->columns, left);
  gtk_paned_set_position(layout->views, MAX(allocation->width - left - right - 2, 1));
}

// Only what a hand moved is remembered.
static gboolean on_release(GtkPaned *paned, GdkEventButton *event, PanedLayout *layout) {
  sb_preferences_set_int("left-column", gtk_paned_get_position(layout->columns));
  GtkWidget *right = gtk_paned_get_child2(layout->views);
  sb_preferences_set_int("right-column", gtk_widget_get_allocated_width(right));
  return GDK_EVENT_PROPAGATE;
}

void sb_paned_layout_attach(GtkPaned *columns, GtkPaned *views, GtkWidget *charts) {
  PanedLayout *self = g_new0(PanedLayout, 1);
  self->columns = columns;
  self->views = views;
  self->charts = charts;
  g_object_set_data_full(G_OBJECT(columns), "columns", self, g_free);
  g_object_bind_property(gtk_paned_get_child2(views), "visible", charts, "active",
                         G_BINDING_BIDIRECTIONAL | G_BINDING_SYNC_CREATE);
  gtk_widget_set_size_request(gtk_paned_get_child1(columns), LEAST_LEFT, -1);
  gtk_widget_set_size_request(gtk_paned_get_child2(views), LEAST_RIGHT, -1);
  g_signal_connect(columns, "size-allocate", G_CALLBACK(on_pane_allocate), self);
  g_signal_connect(columns, "button-release-event", G_CALLBACK(on_release), self);
  g_signal_connect(views, "button-release-event", G_CALLBACK(on_release), self);
}
