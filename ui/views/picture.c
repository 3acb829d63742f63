// A drawing area whose picture is kept in an image in memory. Drawing thousands of strokes and
// glyphs there and handing over one image is several times cheaper than sending each to the display
// server, and other parts of the window can be redrawn without it. The interval between drawings
// spreads the work of several pictures over the frames while something moves.
#include "ui/views/picture.h"

struct SbPicture {
  GtkWidget *area;
  SbPictureDraw draw;
  void *data;
  cairo_surface_t *surface;
  int width, height, scale;
  gboolean changed;
  gint64 drawn; // [us]
  guint timer;
};

static void make(SbPicture *picture, int width, int height, int scale) {
  if (picture->surface == NULL || width != picture->width || height != picture->height ||
      scale != picture->scale) {
    g_clear_pointer(&picture->surface, cairo_surface_destroy);
    picture->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, MAX(width, 1) * scale,
                                                  MAX(height, 1) * scale);
    cairo_surface_set_device_scale(picture->surface, scale, scale);
    picture->width = width;
    picture->height = height;
    picture->scale = scale;
  }
  cairo_t *cr = cairo_create(picture->surface);
  picture->draw(cr, width, height, picture->data);
  cairo_destroy(cr);
  picture->changed = FALSE;
  picture->drawn = g_get_monotonic_time();
}

static gboolean on_draw(GtkWidget *widget, cairo_t *cr, SbPicture *picture) {
  int width = gtk_widget_get_allocated_width(widget);
  int height = gtk_widget_get_allocated_height(widget);
  int scale = gtk_widget_get_scale_factor(widget);
  if (picture->changed || width != picture->width || height != picture->height ||
      scale != picture->scale) {
    make(picture, width, height, scale);
  }
  cairo_set_source_surface(cr, picture->surface, 0, 0);
  cairo_paint(cr);
  if (gtk_widget_has_visible_focus(widget)) {
    gtk_render_focus(gtk_widget_get_style_context(widget), cr, 3, 3, width - 6, height - 6);
  }
  return GDK_EVENT_PROPAGATE;
}

static gboolean on_timer(gpointer data) {
  SbPicture *picture = data;
  picture->timer = 0;
  gtk_widget_queue_draw(picture->area);
  return G_SOURCE_REMOVE;
}

static void cancel_timer(SbPicture *picture) {
  if (picture->timer != 0) {
    g_source_remove(picture->timer);
    picture->timer = 0;
  }
}

void sb_picture_change(SbPicture *picture, int interval) {
  picture->changed = TRUE;
  gint64 wait = interval - (g_get_monotonic_time() - picture->drawn) / 1000;
  if (wait <= 0) {
    cancel_timer(picture);
    gtk_widget_queue_draw(picture->area);
  } else if (picture->timer == 0) {
    picture->timer = g_timeout_add((guint)wait, on_timer, picture);
  }
}

// Another theme: the colours are not the picture's own.
static void on_style(SbPicture *picture) {
  picture->changed = TRUE;
}

static void on_destroy(GtkWidget *widget, SbPicture *picture) {
  cancel_timer(picture);
  g_clear_pointer(&picture->surface, cairo_surface_destroy);
  picture->width = -1;
}

SbPicture *sb_picture_attach(GtkWidget *area, SbPictureDraw draw, void *data) {
  SbPicture *picture = g_new0(SbPicture, 1);
  picture->area = area;
  picture->draw = draw;
  picture->data = data;
  picture->changed = TRUE;
  g_object_set_data_full(G_OBJECT(area), "sb-picture", picture, g_free);
  g_signal_connect(area, "draw", G_CALLBACK(on_draw), picture);
  g_signal_connect_swapped(area, "style-updated", G_CALLBACK(on_style), picture);
  g_signal_connect(area, "destroy", G_CALLBACK(on_destroy), picture);
  return picture;
}
